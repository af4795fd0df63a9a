/* SPDX-License-Identifier: Apache-2.0 */
/* The yardstick: first hits of a fixed window of parallel rays by Embree. */
#ifndef SRP_BENCH_EMBREE_CAST_H
#define SRP_BENCH_EMBREE_CAST_H

#include <srp/mesh.h>
#include <srp/vec3.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct embree_cast embree_cast;

embree_cast *embree_cast_create(const srp_mesh *mesh, bool robust);
void embree_cast_destroy(embree_cast *cast);
/* Version in words. */
const char *embree_cast_version(void);

/*
 * Casts side x side rays over the window [-half, half]^2 about the body origin for each direction,
 * on `threads` threads, in coherent packets of 16; sums up the force f of each direction under
 * absorbing optics from the counts per triangle.
 *   tiles  packets are 4 x 4 rays, else 16 of one row
 */
void embree_cast_run(const embree_cast *cast, size_t count, const srp_vec3 *s, double half,
                     uint32_t side, int threads, bool tiles, srp_vec3 *f);

#endif
