/* SPDX-License-Identifier: Apache-2.0 */
/* From files to a scene: OBJ files joined, their MTL files found, the user's materials on top. */
#include "error.h"
#include "material_internal.h"
#include "text.h"

#include <srp/scene.h>

#include <stdio.h>
#include <string.h>

/* Reads all OBJ files into one mesh. */
static srp_status read_meshes(const char *const *paths, size_t count,
                              const srp_mesh_read_params *params, const srp_log *log,
                              srp_mesh **out, srp_error *error) {
    srp_mesh *mesh = NULL;
    srp_status status = srp_mesh_read_obj(paths[0], params, log, &mesh, error);
    for (size_t i = 1; status == SRP_OK && i < count; i++) {
        srp_mesh *part = NULL;
        status = srp_mesh_read_obj(paths[i], params, log, &part, error);
        if (status == SRP_OK) {
            status = srp_mesh_append(mesh, part, error);
        }
        srp_mesh_destroy(part);
    }
    if (status != SRP_OK) {
        srp_mesh_destroy(mesh);
        return status;
    }
    *out = mesh;
    return SRP_OK;
}

/* The materials that the user gives, all pinned. */
static srp_materials *pin(const srp_materials *given) {
    const srp_materials none = {0};
    srp_materials *pinned = srp_materials_clone(given == NULL ? &none : given);
    for (size_t i = 0; pinned != NULL && i < pinned->count; i++) {
        pinned->items[i].pinned = pinned->items[i].known;
    }
    return pinned;
}

static bool is_repeated(const srp_mesh *mesh, size_t index) {
    for (size_t i = 0; i < index; i++) {
        if (strcmp(srp_mesh_library(mesh, i), srp_mesh_library(mesh, index)) == 0) {
            return true;
        }
    }
    return false;
}

/* Reads the mesh's MTL files; the names of those that do not exist are listed in `missing`. */
static srp_status read_libraries(const srp_mesh *mesh, srp_materials *materials, const srp_log *log,
                                 char *missing, size_t size, srp_error *error) {
    size_t used = 0;
    missing[0] = '\0';
    for (size_t i = 0; i < srp_mesh_library_count(mesh); i++) {
        const char *path = srp_mesh_library(mesh, i);
        if (is_repeated(mesh, i)) {
            continue;
        }
        srp_error why;
        srp_status status = srp_materials_read_mtl(materials, path, log, &why);
        if (status == SRP_NOT_FOUND) {
            srp_warn_at(log, path, 0, 0, "the MTL file does not exist");
            int length = snprintf(missing + used, size - used, "%s%s", used == 0 ? "" : ", ",
                                  srp_string_excerpt(path).text);
            used += length > 0 && (size_t)length < size - used ? (size_t)length : 0;
            missing[used] = '\0';
        } else if (status != SRP_OK) {
            if (error != NULL) {
                *error = why;
            }
            return status;
        }
    }
    return SRP_OK;
}

/* A material that the user gives and the mesh does not have is most likely a slip of the pen. */
static void warn_of_strangers(const srp_mesh *mesh, const srp_materials *given,
                              const srp_log *log) {
    for (size_t i = 0; given != NULL && i < srp_materials_count(given); i++) {
        const char *name = srp_materials_name(given, i);
        size_t k = 0;
        while (k < srp_mesh_material_count(mesh) &&
               strcmp(srp_mesh_material_name(mesh, k), name) != 0) {
            k++;
        }
        if (k == srp_mesh_material_count(mesh)) {
            srp_warn_at(log, "", 0, 0, "no face has the given material %s",
                        srp_string_excerpt(name).text);
        }
    }
}

srp_status srp_scene_read_obj(const char *const *paths, size_t count,
                              const srp_mesh_read_params *params, const srp_materials *given,
                              const srp_log *log, srp_scene **out, srp_error *error) {
    if (count == 0) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "no OBJ file, expected at least one");
    }
    srp_mesh *mesh = NULL;
    char missing[256];
    srp_status status = read_meshes(paths, count, params, log, &mesh, error);
    if (status != SRP_OK) {
        return status;
    }
    srp_materials *materials = pin(given);
    if (materials == NULL) {
        status = srp_fail(error, SRP_NO_MEMORY, "no memory for materials");
        goto done;
    }
    warn_of_strangers(mesh, given, log);
    status = read_libraries(mesh, materials, log, missing, sizeof missing, error);
    if (status != SRP_OK) {
        goto done;
    }
    srp_error why;
    status = srp_scene_from_mesh(mesh, materials, out, &why);
    if (status == SRP_NOT_FOUND && missing[0] != '\0') {
        status = srp_fail_at(error, status, paths[0], 0, 0, "%s (there is no file %s)", why.message,
                             missing);
    } else if (status != SRP_OK) {
        status = srp_fail_at(error, status, paths[0], 0, 0, "%s", why.message);
    }
    if (status != SRP_OK) {
        srp_advise(error, why.remedy, status);
    }
done:
    srp_mesh_destroy(mesh);
    srp_materials_destroy(materials);
    return status;
}
