/* SPDX-License-Identifier: Apache-2.0 */
/* What the inside of a mesh looks like to readers and to the scene. Internal. */
#ifndef SRP_SRC_MESH_INTERNAL_H
#define SRP_SRC_MESH_INTERNAL_H

#include <srp/mesh.h>

/* All arrays are from malloc and belong to the mesh; strings too. */
struct srp_mesh {
    size_t vertex_count;
    srp_vec3 *vertices;
    size_t triangle_count;
    srp_triangle *triangles;
    uint32_t *triangle_material;
    size_t material_count;
    char **material_names;
    size_t library_count;
    char **libraries;
    size_t faces_triangle, faces_quad, faces_larger; /* as the file had them */
};

/* Vertices, and triangles times three, are counted in 32 bits. */
#define SRP_MESH_COUNT_MAX ((size_t)(UINT32_MAX / 3 - 1))

/* A copy of a string by malloc, NULL when there is no memory. */
char *srp_string_copy(const char *text);

#endif
