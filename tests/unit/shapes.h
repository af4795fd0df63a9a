/* SPDX-License-Identifier: Apache-2.0 */
/* Small shapes that several tests need. */
#ifndef SRP_TEST_SHAPES_H
#define SRP_TEST_SHAPES_H

#include <srp/material.h>
#include <srp/mesh.h>
#include <srp/scene.h>

#include <stddef.h>

/* A box between two corners, 12 triangles wound outwards, of one material. */
srp_mesh *shape_box(srp_vec3 low, srp_vec3 high, const char *material);

/* A mesh of one material from arrays. */
srp_mesh *shape_mesh(const srp_vec3 *vertices, size_t vertex_count, const srp_triangle *triangles,
                     size_t triangle_count, const char *material);

/* Appends `part` to `mesh` and destroys it. */
void shape_join(srp_mesh *mesh, srp_mesh *part);

/* A scene of `mesh`, all of whose materials get `optics`; destroys the mesh. */
srp_scene *shape_scene(srp_mesh *mesh, srp_optics optics);

/* Three square mirrors of side 1 in the coordinate planes, seen from their inside. */
srp_scene *shape_corner_cube(void);
/* Cross-section that it sends back along s, after three hits; s.x >= s.y >= s.z > 0. */
double shape_corner_cube_returns(srp_vec3 s);

#endif
