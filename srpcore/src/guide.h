/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Where scattered light of a facet may hit something: importance sampling of diffuse directions.
 * Internal.
 *
 * A direction about the normal is a point (across, around) of the unit square, cosine-weighted when
 * the point is uniform (bounce.c). The square of each side of each facet is cut into cells of equal
 * size, and pilot rays have found what share of each hits anything; cells are then met in
 * proportion to the root of that share, and never less than a fifth as often as without guide. What
 * is sampled more often weighs less: the expectation is the same whatever the pilots found.
 */
#ifndef SRP_SRC_GUIDE_H
#define SRP_SRC_GUIDE_H

#include "bvh.h"
#include "scene_internal.h"

#include <srp/status.h>
#include <srp/vec3.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct srp_guide srp_guide;

/* Guides for all sides that see something (`sight`, sight.h) and scatter light. The result is the
 * same for any number of threads. SRP_NO_MEMORY. */
srp_status srp_guide_create(const srp_scene *scene, const srp_bvh *bvh, const uint8_t *sight,
                            int threads, srp_guide **out, srp_error *error);
void srp_guide_destroy(srp_guide *guide);

/* Moves a uniform point of the unit square to where it is worth more; returns its weight. `guide`
 * may be NULL: nothing moves, the weight is 1. */
double srp_guide_point(const srp_guide *guide, uint32_t facet, bool back, double *across,
                       double *around);

/* For devices that sample by themselves: `srp_guide_count` maps of SRP_GUIDE_FLOATS numbers each (9
 * cumulated shares of rows, then 9 of the cells in each of 8 rows), and the map of each side, or
 * SRP_GUIDE_NONE. */
enum { SRP_GUIDE_SIDE = 8, SRP_GUIDE_FLOATS = (SRP_GUIDE_SIDE + 1) * (SRP_GUIDE_SIDE + 1) };
#define SRP_GUIDE_NONE UINT32_MAX
size_t srp_guide_count(const srp_guide *guide);
const float *srp_guide_map(const srp_guide *guide, size_t k);
uint32_t srp_guide_index(const srp_guide *guide, uint32_t facet, bool back);

/* The direction of a point about a unit normal: uniform points give cosine-weighted directions. */
srp_vec3 srp_guide_direction(srp_vec3 normal, double across, double around);

#endif
