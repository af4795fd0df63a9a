/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What a ray hits first: a bounding volume hierarchy of width 8 over a scene's facets. Internal.
 *
 * The answer depends on the facets alone, never on the hierarchy, the processor or the number of
 * threads: boxes are padded so that they hide nothing, and what is decided about a facet is decided
 * in double precision by one function that is compiled once. The nearest hit wins, of equally near
 * ones the facet of lower number.
 *
 * Watertight: whether a ray passes an edge on one side or the other is computed from the ray and
 * the edge's two vertices alone, with exactly opposite results for the two facets that share it,
 * and a ray through the edge itself hits both. No ray slips through the edges and vertices of a
 * closed mesh.
 *
 * A ray that leaves a facet cannot hit it. It starts there only up to rounding: perhaps beyond its
 * edge, below its plane, or behind the next facet. Therefore the start is moved, relative to the
 * mesh (the longest side of its box, or its distance from the origin where that is longer): off the
 * plane by 2^-48 to the side to which the ray goes, and towards the middle of the facet until it is
 * clear of the edges by 2^-42 (a quarter of the way at most). This is more than rounding and less
 * than anybody can measure. Afterwards a ray is above all that does not rise above the facet's
 * plane (convex and coplanar neighbours, the other side of a shell), and in front of a concave
 * neighbour, unless both make a wedge of less than a degree. The hit that is told is that of the
 * start as given.
 */
#ifndef SRP_SRC_BVH_H
#define SRP_SRC_BVH_H

#include "scene_internal.h"

#include <srp/status.h>
#include <srp/vec3.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct srp_bvh srp_bvh;

typedef struct srp_ray {
    srp_vec3 origin;    /* [m] finite; at most 2^30 sizes of the mesh away */
    srp_vec3 direction; /* finite, not 0; any length */
    uint32_t from;      /* facet that it leaves; SRP_NO_NEIGHBOUR: none */
} srp_ray;

typedef struct srp_hit {
    double t; /* origin + t direction is hit; > 0, or 0 where only the moved start is in front */
    uint32_t facet; /* into srp_scene.facets; SRP_NO_NEIGHBOUR: nothing is hit */
    bool back;      /* on the side that the normal points away from */
} srp_hit;

/* Of a scene with facets, which it outlives not: the scene must stay. `threads` >= 1 build it; the
 * result is the same for any number. SRP_NO_MEMORY, SRP_BAD_ARGUMENT (no facet). */
SRP_CHECK srp_status srp_bvh_create(const srp_scene *scene, int threads, srp_bvh **out,
                                    srp_error *error);
void srp_bvh_destroy(srp_bvh *bvh);

/* The nearest hit; false, and *out untouched, when there is none. Any thread. */
bool srp_bvh_hit(const srp_bvh *bvh, srp_vec3 origin, srp_vec3 direction, uint32_t from,
                 srp_hit *out);

/* The same for many rays, faster: rays are taken in an order that lets neighbours share what is
 * loaded. hits[k] is what rays[k] hits. Any thread, on the calling one. */
void srp_bvh_hit_many(const srp_bvh *bvh, size_t count, const srp_ray *rays, srp_hit *hits);

/* All p with normal.p <= level [m], body frame. */
typedef struct srp_half_space {
    srp_vec3 normal; /* finite; of any length */
    double level;
} srp_half_space;

enum { SRP_HALF_SPACES_MAX = 8 };

/* Puts all facets that may lie in every one of up to SRP_HALF_SPACES_MAX half-spaces into `facets`,
 * which has room for all of the scene's; some that do not lie there may be among them. Their
 * number. The order depends on the scene and the half-spaces alone. Any thread. */
size_t srp_bvh_gather(const srp_bvh *bvh, const srp_half_space *spaces, size_t count,
                      uint32_t *facets);

#endif
