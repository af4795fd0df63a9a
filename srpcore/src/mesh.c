/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"
#include "limits.h"
#include "mesh_internal.h"

#include <stdlib.h>
#include <string.h>

char *srp_string_copy(const char *text) {
    size_t size = strlen(text) + 1;
    char *copy = malloc(size);
    if (copy != NULL) {
        memcpy(copy, text, size);
    }
    return copy;
}

static void free_strings(char **strings, size_t count) {
    for (size_t i = 0; strings != NULL && i < count; ++i) {
        free(strings[i]);
    }
    free(strings);
}

void srp_mesh_destroy(srp_mesh *mesh) {
    if (mesh == NULL) {
        return;
    }
    free(mesh->vertices);
    free(mesh->triangles);
    free(mesh->triangle_material);
    free_strings(mesh->material_names, mesh->material_count);
    free_strings(mesh->libraries, mesh->library_count);
    free(mesh);
}

static srp_status check_arrays(const srp_vec3 *vertices, size_t vertex_count,
                               const srp_triangle *triangles, size_t triangle_count,
                               const uint32_t *triangle_material, size_t material_count,
                               srp_error *error) {
    if (triangle_count == 0) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "a mesh needs at least one triangle");
    }
    if (vertex_count > SRP_MESH_COUNT_MAX || triangle_count > SRP_MESH_COUNT_MAX) {
        return srp_fail(error, SRP_BAD_ARGUMENT,
                        "%zu vertices and %zu triangles, expected at most %zu of each",
                        vertex_count, triangle_count, SRP_MESH_COUNT_MAX);
    }
    for (size_t i = 0; i < vertex_count; ++i) {
        if (!srp_vec3_is_finite(vertices[i])) {
            return srp_fail(error, SRP_BAD_ARGUMENT, "vertex %zu is not finite", i);
        }
        if (!(srp_vec3_largest(vertices[i]) <= SRP_REACH_MAX)) {
            return srp_fail(error, SRP_BAD_ARGUMENT,
                            "vertex %zu has a coordinate of %g m, expected at most %g m", i,
                            srp_vec3_largest(vertices[i]), SRP_REACH_MAX);
        }
    }
    for (size_t i = 0; i < triangle_count; ++i) {
        for (int k = 0; k < 3; ++k) {
            if (triangles[i].v[k] >= vertex_count) {
                return srp_fail(error, SRP_BAD_ARGUMENT,
                                "triangle %zu names vertex %u, expected less than %zu", i,
                                triangles[i].v[k], vertex_count);
            }
        }
        if (triangle_material[i] >= material_count) {
            return srp_fail(error, SRP_BAD_ARGUMENT,
                            "triangle %zu names material %u, expected less than %zu", i,
                            triangle_material[i], material_count);
        }
    }
    return SRP_OK;
}

static srp_status check_names(const char *const *names, size_t count, srp_error *error) {
    for (size_t i = 0; i < count; ++i) {
        for (size_t j = 0; j < i; ++j) {
            if (strcmp(names[i], names[j]) == 0) {
                return srp_fail(error, SRP_BAD_ARGUMENT, "two materials are named '%s'", names[i]);
            }
        }
    }
    return SRP_OK;
}

/* A copy of `count` items; one spare, so that 0 items are a valid pointer too. */
static void *copy_items(const void *items, size_t count, size_t size) {
    void *copy = calloc(count + 1, size);
    if (copy != NULL && count > 0) {
        memcpy(copy, items, count * size);
    }
    return copy;
}

/* Copies `count` strings behind the `used` ones of *list. */
static bool append_strings(char ***list, size_t *used, const char *const *more, size_t count) {
    char **larger = realloc(*list, (*used + count + 1) * sizeof *larger);
    if (larger == NULL) {
        return false;
    }
    *list = larger;
    for (size_t i = 0; i < count; ++i) {
        larger[*used] = srp_string_copy(more[i]);
        if (larger[*used] == NULL) {
            return false;
        }
        ++*used;
    }
    return true;
}

srp_status srp_mesh_create(const srp_vec3 *vertices, size_t vertex_count,
                           const srp_triangle *triangles, size_t triangle_count,
                           const uint32_t *triangle_material, const char *const *material_names,
                           size_t material_count, srp_mesh **out, srp_error *error) {
    srp_status status = check_arrays(vertices, vertex_count, triangles, triangle_count,
                                     triangle_material, material_count, error);
    if (status == SRP_OK) {
        status = check_names(material_names, material_count, error);
    }
    if (status != SRP_OK) {
        return status;
    }
    srp_mesh *mesh = calloc(1, sizeof *mesh);
    if (mesh == NULL) {
        goto fail;
    }
    mesh->vertices = copy_items(vertices, vertex_count, sizeof *vertices);
    mesh->triangles = copy_items(triangles, triangle_count, sizeof *triangles);
    mesh->triangle_material =
        copy_items(triangle_material, triangle_count, sizeof *triangle_material);
    if (mesh->vertices == NULL || mesh->triangles == NULL || mesh->triangle_material == NULL ||
        !append_strings(&mesh->material_names, &mesh->material_count, material_names,
                        material_count)) {
        goto fail;
    }
    mesh->vertex_count = vertex_count;
    mesh->triangle_count = triangle_count;
    mesh->faces_triangle = triangle_count;
    *out = mesh;
    return SRP_OK;
fail:
    srp_mesh_destroy(mesh);
    return srp_fail(error, SRP_NO_MEMORY, "no memory for a mesh of %zu triangles", triangle_count);
}

/* Index of `name` among the mesh's materials, or their count. */
static size_t find_material(const srp_mesh *mesh, const char *name) {
    size_t index = 0;
    while (index < mesh->material_count && strcmp(mesh->material_names[index], name) != 0) {
        ++index;
    }
    return index;
}

/* A new mesh that is `a` followed by `b`: the original stays whole if anything fails. */
static bool join(const srp_mesh *a, const srp_mesh *b, uint32_t *material_of_b, srp_mesh *out) {
    size_t vertices = a->vertex_count + b->vertex_count;
    size_t triangles = a->triangle_count + b->triangle_count;
    out->vertices = calloc(vertices + 1, sizeof *out->vertices);
    out->triangles = calloc(triangles + 1, sizeof *out->triangles);
    out->triangle_material = calloc(triangles + 1, sizeof *out->triangle_material);
    if (out->vertices == NULL || out->triangles == NULL || out->triangle_material == NULL ||
        !append_strings(&out->libraries, &out->library_count, (const char *const *)a->libraries,
                        a->library_count) ||
        !append_strings(&out->libraries, &out->library_count, (const char *const *)b->libraries,
                        b->library_count) ||
        !append_strings(&out->material_names, &out->material_count,
                        (const char *const *)a->material_names, a->material_count)) {
        return false;
    }
    for (size_t i = 0; i < b->material_count; ++i) {
        const char *name = b->material_names[i];
        size_t index = find_material(out, name);
        if (index == out->material_count &&
            !append_strings(&out->material_names, &out->material_count, &name, 1)) {
            return false;
        }
        material_of_b[i] = (uint32_t)index;
    }
    memcpy(out->vertices, a->vertices, a->vertex_count * sizeof *a->vertices);
    memcpy(out->vertices + a->vertex_count, b->vertices, b->vertex_count * sizeof *b->vertices);
    memcpy(out->triangles, a->triangles, a->triangle_count * sizeof *a->triangles);
    memcpy(out->triangle_material, a->triangle_material,
           a->triangle_count * sizeof *a->triangle_material);
    for (size_t i = 0; i < b->triangle_count; ++i) {
        srp_triangle *triangle = &out->triangles[a->triangle_count + i];
        for (int k = 0; k < 3; ++k) {
            triangle->v[k] = b->triangles[i].v[k] + (uint32_t)a->vertex_count;
        }
        out->triangle_material[a->triangle_count + i] = material_of_b[b->triangle_material[i]];
    }
    out->vertex_count = vertices;
    out->triangle_count = triangles;
    out->faces_triangle = a->faces_triangle + b->faces_triangle;
    out->faces_quad = a->faces_quad + b->faces_quad;
    out->faces_larger = a->faces_larger + b->faces_larger;
    return true;
}

srp_status srp_mesh_append(srp_mesh *mesh, const srp_mesh *part, srp_error *error) {
    if (part->vertex_count > SRP_MESH_COUNT_MAX - mesh->vertex_count ||
        part->triangle_count > SRP_MESH_COUNT_MAX - mesh->triangle_count) {
        return srp_fail(error, SRP_BAD_ARGUMENT,
                        "the joined mesh would have more than %zu vertices or triangles",
                        SRP_MESH_COUNT_MAX);
    }
    srp_mesh *joined = calloc(1, sizeof *joined);
    uint32_t *material_of_part = calloc(part->material_count + 1, sizeof *material_of_part);
    if (joined == NULL || material_of_part == NULL || !join(mesh, part, material_of_part, joined)) {
        free(material_of_part);
        srp_mesh_destroy(joined);
        return srp_fail(error, SRP_NO_MEMORY, "no memory to join two meshes");
    }
    free(material_of_part);
    srp_mesh old = *mesh;
    *mesh = *joined;
    *joined = old;
    srp_mesh_destroy(joined);
    return SRP_OK;
}

size_t srp_mesh_vertex_count(const srp_mesh *mesh) {
    return mesh->vertex_count;
}

const srp_vec3 *srp_mesh_vertices(const srp_mesh *mesh) {
    return mesh->vertices;
}

size_t srp_mesh_triangle_count(const srp_mesh *mesh) {
    return mesh->triangle_count;
}

const srp_triangle *srp_mesh_triangles(const srp_mesh *mesh) {
    return mesh->triangles;
}

const uint32_t *srp_mesh_triangle_materials(const srp_mesh *mesh) {
    return mesh->triangle_material;
}

size_t srp_mesh_material_count(const srp_mesh *mesh) {
    return mesh->material_count;
}

const char *srp_mesh_material_name(const srp_mesh *mesh, size_t index) {
    return index < mesh->material_count ? mesh->material_names[index] : NULL;
}

size_t srp_mesh_library_count(const srp_mesh *mesh) {
    return mesh->library_count;
}

const char *srp_mesh_library(const srp_mesh *mesh, size_t index) {
    return index < mesh->library_count ? mesh->libraries[index] : NULL;
}
