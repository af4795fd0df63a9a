/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Triangle meshes: the shape of a spacecraft in body axes, metres, faces outward by the right-hand
 * rule. A mesh names its materials; what they do to light is in material.h.
 */
#ifndef SRP_MESH_H
#define SRP_MESH_H

#include <srp/status.h>
#include <srp/vec3.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

SRP_BEGIN_DECLS

typedef struct srp_mesh srp_mesh;

/* Three 0-based vertex indices, counter-clockwise seen from outside. */
typedef struct srp_triangle {
    uint32_t v[3];
} srp_triangle;

typedef struct srp_mesh_read_params {
    double metres_per_unit; /* [m] > 0; 1 by default */
} srp_mesh_read_params;

SRP_API srp_mesh_read_params srp_mesh_read_params_default(void);

/*
 * A mesh from arrays, which are copied.
 *   vertices            [m] (vertex_count, body frame, each coordinate up to 1e30)
 *   triangles           (triangle_count, indices below vertex_count)
 *   triangle_material   (triangle_count, indices below material_count)
 *   material_names      (material_count, unique, not empty)
 * SRP_BAD_ARGUMENT (an index out of range, a vertex that is not finite or beyond 1e30 m, no
 * triangle), SRP_NO_MEMORY.
 */
SRP_API SRP_CHECK srp_status srp_mesh_create(const srp_vec3 *vertices, size_t vertex_count,
                                             const srp_triangle *triangles, size_t triangle_count,
                                             const uint32_t *triangle_material,
                                             const char *const *material_names,
                                             size_t material_count, srp_mesh **out,
                                             srp_error *error);
SRP_API void srp_mesh_destroy(srp_mesh *mesh);

/* Reads a Wavefront OBJ file. Forms read: docs/file-formats.md. Faces before any `usemtl` get the
 * material "" (which must then be given by name like any other).
 * `params` may be NULL for the defaults.
 * SRP_NOT_FOUND, SRP_IO, SRP_BAD_FORMAT, SRP_BAD_DATA (nothing but degenerate faces; a
 * coordinate beyond 1e30 m),
 * SRP_BAD_ARGUMENT (params), SRP_NO_MEMORY. */
SRP_API SRP_CHECK srp_status srp_mesh_read_obj(const char *path, const srp_mesh_read_params *params,
                                               const srp_log *log, srp_mesh **out,
                                               srp_error *error);

/* The same from memory; `name` stands for the file in messages. */
SRP_API SRP_CHECK srp_status srp_mesh_parse_obj(const char *text, size_t size, const char *name,
                                                const srp_mesh_read_params *params,
                                                const srp_log *log, srp_mesh **out,
                                                srp_error *error);

/* Appends a copy of `part` to `mesh`; materials of the same name become one. On failure `mesh` is
 * as before. SRP_NO_MEMORY, SRP_BAD_ARGUMENT (more than 2^32 - 1 vertices). */
SRP_API SRP_CHECK srp_status srp_mesh_append(srp_mesh *mesh, const srp_mesh *part,
                                             srp_error *error);

/* Views, owned by the mesh, valid until it is changed or destroyed. */
SRP_API size_t srp_mesh_vertex_count(const srp_mesh *mesh);
SRP_API const srp_vec3 *srp_mesh_vertices(const srp_mesh *mesh);
SRP_API size_t srp_mesh_triangle_count(const srp_mesh *mesh);
SRP_API const srp_triangle *srp_mesh_triangles(const srp_mesh *mesh);
SRP_API const uint32_t *srp_mesh_triangle_materials(const srp_mesh *mesh);
SRP_API size_t srp_mesh_material_count(const srp_mesh *mesh);
SRP_API const char *srp_mesh_material_name(const srp_mesh *mesh, size_t index);
/* Files named by `mtllib`, resolved against the OBJ's directory, in order of mention. */
SRP_API size_t srp_mesh_library_count(const srp_mesh *mesh);
SRP_API const char *srp_mesh_library(const srp_mesh *mesh, size_t index);

/* What a mesh is like, for `srp info` and for a user who doubts a result. Counts are of triangles
 * (edges where it says so) after polygons were split. */
typedef struct srp_mesh_report {
    size_t vertices, triangles;
    size_t faces_triangle, faces_quad, faces_larger; /* polygons as the file had them */
    /* Joined by shared edges; closed = no boundary edge. Edges and components are those of the
     * triangles that repeat no other; without area only where they close a crack between others. */
    size_t components, closed_components;
    size_t boundary_edges;     /* edges with one triangle: holes and rims */
    size_t nonmanifold_edges;  /* edges with more than two triangles */
    size_t inconsistent_edges; /* neighbours that disagree about outside */
    size_t inward_components;  /* closed, but wound inside out */
    size_t degenerate;         /* triangles without area */
    size_t duplicate;          /* at the three places of another, same winding */
    size_t opposite;           /* those with another of opposite winding: thin shells */
    srp_vec3 box_min, box_max; /* [m] */
    /* [m^2] of the sides that light can find: of triangles at the same places with the same winding
     * the first counts, whose optics are those that are used. */
    double area;
    srp_vec3 area_vector_sum; /* [m^2] sum of A n: 0 for closed meshes */
    double volume;            /* [m^3] of the closed components */
} srp_mesh_report;

/* SRP_NO_MEMORY. Any thread. */
SRP_API SRP_CHECK srp_status srp_mesh_inspect(const srp_mesh *mesh, srp_mesh_report *out,
                                              srp_error *error);
/* Area per material [m^2], (material count of the mesh), of what srp_mesh_report.area adds up.
 * SRP_NO_MEMORY. Any thread. */
SRP_API SRP_CHECK srp_status srp_mesh_material_areas(const srp_mesh *mesh, double *area,
                                                     srp_error *error);

SRP_END_DECLS

#endif
