/* SPDX-License-Identifier: Apache-2.0 */
/* What a mesh tells about plates: the normals that it has most of, and the directions in which its
 * parts shade each other. */
#ifndef SRP_CLI_FACING_H
#define SRP_CLI_FACING_H

#include "samples.h"

#include <srp/scene.h>

enum { CLI_NORMALS_MAX = 64 };

/*
 * Normals of the faces of `scene`, by groups within 10 degrees; the mean of each, the group of the
 * largest area first. Faces of open surfaces count on both sides.
 *   wanted   how many; 0 = as many as make 95 % of the area
 *   normals  (CLI_NORMALS_MAX)
 * Returns how many were found; *share of the area is theirs.
 */
size_t cli_facing_normals(const srp_scene *scene, size_t wanted, srp_vec3 *normals, double *share);

/* Cross-section that the faces would catch light with if none shaded another [m^2]. */
double cli_facing_area(const srp_scene *scene, srp_vec3 s);

/*
 * Share of the facing area that is in shadow, for every direction of the samples (count). The lit
 * area is that of the samples where `known`, else computed (method exact). SRP_NO_MEMORY and what
 * the method says.
 */
SRP_CHECK srp_status cli_facing_shaded(const srp_scene *scene, const cli_samples *samples,
                                       bool known, double *shaded, srp_error *error);

#endif
