/* SPDX-License-Identifier: Apache-2.0 */
/* First-hit visibility by another road than srpcore's, to test against. */
#ifndef SRP_TEST_VISIBILITY_ORACLE_H
#define SRP_TEST_VISIBILITY_ORACLE_H

#include "scene_internal.h"

#include <srp/response.h>

#include <stddef.h>

/*
 * Sums per material as srp_prepared_respond() gives them, (material count + 1) rows, zeroed by the
 * callee. For small scenes: exact, at the cost of the fourth power of the number of triangles.
 *
 * The image is cut into vertical strips at every corner, at every crossing of two edges and at
 * every end and crossing of the segments along which faces cut through each other. Within a strip
 * nothing begins or ends, the visible length of each face on a vertical line is linear in x, and
 * two Gauss points integrate lengths and first moments exactly.
 */
void oracle_strips(const srp_scene *scene, srp_vec3 s, srp_vec3 reference, srp_basis *rows);

/* The same sums from `lines` equally spaced vertical lines, each one exact: for large scenes.
 * Converges to the truth with the square of the spacing, roughly. */
void oracle_lines(const srp_scene *scene, srp_vec3 s, srp_vec3 reference, size_t lines,
                  srp_basis *rows);

#endif
