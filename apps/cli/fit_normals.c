/* SPDX-License-Identifier: Apache-2.0 */
#include "fit_normals.h"

#include "messages.h"
#include "numbers.h"

#include <srp/plates.h>

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- the shape ---- */

static srp_status freeze(const srp_mesh *mesh, srp_scene **out, srp_error *error) {
    srp_materials *materials = NULL;
    srp_status status = srp_materials_create(&materials, error);
    for (size_t k = 0; k < srp_mesh_material_count(mesh) && status == SRP_OK; ++k) {
        status = srp_materials_set(materials, srp_mesh_material_name(mesh, k),
                                   (srp_optics){0.0, 0.0, false}, true, error);
    }
    if (status == SRP_OK) {
        status = srp_scene_from_mesh(mesh, materials, out, error);
    }
    srp_materials_destroy(materials);
    return status;
}

int cli_shape_load(const char *const *paths, size_t count, double metres_per_unit,
                   srp_scene **out) {
    srp_mesh_read_params params = srp_mesh_read_params_default();
    params.metres_per_unit = metres_per_unit;
    srp_mesh *mesh = NULL;
    srp_error error;
    srp_log log = cli_log();
    srp_status status = srp_mesh_read_obj(paths[0], &params, &log, &mesh, &error);
    for (size_t k = 1; k < count && status == SRP_OK; ++k) {
        srp_mesh *part = NULL;
        status = srp_mesh_read_obj(paths[k], &params, &log, &part, &error);
        if (status == SRP_OK) {
            status = srp_mesh_append(mesh, part, &error);
            srp_mesh_destroy(part);
        }
    }
    if (status == SRP_OK) {
        status = freeze(mesh, out, &error);
    }
    srp_mesh_destroy(mesh);
    return status == SRP_OK ? CLI_DONE : cli_input_error(&error);
}

/* ---- lists ---- */

/* Normals that repeat another, to rounding, are one plate. False when there is no room. */
static bool add_normal(cli_normals *to, srp_vec3 normal) {
    srp_vec3 unit = srp_vec3_scale(1.0 / srp_vec3_norm(normal), normal);
    for (size_t k = 0; k < to->count; ++k) {
        if (srp_vec3_norm(srp_vec3_sub(to->normal[k], unit)) < 1e-9) {
            ++to->merged;
            return true;
        }
    }
    if (to->count == CLI_NORMALS_MAX) {
        return false;
    }
    to->normal[to->count++] = unit;
    return true;
}

static int too_many(const char *path) {
    cli_say_of_file("%s: more than %d normals", path, CLI_NORMALS_MAX);
    return CLI_BAD_INPUT;
}

static int from_plates(const char *path, cli_normals *out) {
    srp_plate *plates = NULL;
    size_t count;
    srp_error error;
    if (srp_plates_read(path, &plates, &count, &error) != SRP_OK) {
        return cli_input_error(&error);
    }
    int status = CLI_DONE;
    for (size_t k = 0; k < count && status == CLI_DONE; ++k) {
        status = add_normal(out, plates[k].normal) ? CLI_DONE : too_many(path);
    }
    srp_plates_free(plates);
    return status;
}

/* One line; an empty one is fine. */
static int read_line(const char *path, size_t number, char *line, cli_normals *out) {
    double v[3];
    size_t count = 0;
    line[strcspn(line, "#\r\n")] = '\0';
    for (char *word = line; *(word += strspn(word, " \t")) != '\0'; ++count) {
        char *end = word + strcspn(word, " \t");
        bool more = *end != '\0';
        *end = '\0';
        if (count == 3 || !cli_read_number(word, &v[count])) {
            count = 4;
            break;
        }
        word = more ? end + 1 : end;
    }
    if (count == 0) {
        return CLI_DONE;
    }
    double length = count == 3 ? srp_vec3_norm(srp_vec3_make(v[0], v[1], v[2])) : 0.0;
    if (!(length > 0.0) || !isfinite(length)) {
        cli_say_of_file("%s:%zu: expected the three finite numbers of a normal, not all of them 0",
                        path, number);
        return CLI_BAD_INPUT;
    }
    return add_normal(out, srp_vec3_make(v[0], v[1], v[2])) ? CLI_DONE : too_many(path);
}

static int from_lines(const char *path, cli_normals *out) {
    char line[512];
    errno = 0;
    FILE *in = fopen(path, "r");
    if (in == NULL) {
        cli_say_of_file("%s: cannot read: %s", path,
                        errno != 0 ? strerror(errno) : "unknown error");
        return CLI_BAD_INPUT;
    }
    int status = CLI_DONE;
    for (size_t number = 1; status == CLI_DONE && fgets(line, sizeof line, in) != NULL; ++number) {
        status = read_line(path, number, line, out);
    }
    if (status == CLI_DONE && ferror(in)) {
        cli_say_of_file("%s: cannot read", path);
        status = CLI_BAD_INPUT;
    }
    fclose(in);
    if (status == CLI_DONE && out->count == 0) {
        cli_say_of_file("%s: holds no normals, expected three numbers in each line", path);
        status = CLI_BAD_INPUT;
    }
    return status;
}

int cli_normals_read(const char *path, cli_normals *out) {
    *out = (cli_normals){.count = 0};
    const char *ending = strrchr(path, '.');
    bool plates = ending != NULL && strcmp(ending, ".plates") == 0;
    int status = plates ? from_plates(path, out) : from_lines(path, out);
    snprintf(out->words, sizeof out->words, "of %.200s", path);
    return status;
}

int cli_normals_of_mesh(const srp_scene *scene, size_t wanted, cli_normals *out) {
    double share = 0.0;
    *out = (cli_normals){.count = 0};
    out->count = cli_facing_normals(scene, wanted, out->normal, &share);
    if (out->count == 0) {
        cli_say("no memory for the faces of the mesh");
        return CLI_MACHINE_FAILED;
    }
    if (out->count < wanted) {
        cli_say("--plates %zu: the mesh has %zu groups of faces within 10 degrees", wanted,
                out->count);
        return CLI_BAD_INPUT;
    }
    snprintf(out->words, sizeof out->words, "of the mesh, %.1f %% of its area", 100.0 * share);
    return CLI_DONE;
}
