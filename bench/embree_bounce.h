/* SPDX-License-Identifier: Apache-2.0 */
/* Embree on rays that go anywhere, each on its own or sixteen at a time. */
#ifndef SRP_BENCH_EMBREE_BOUNCE_H
#define SRP_BENCH_EMBREE_BOUNCE_H

#include "bvh.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct embree_bounce embree_bounce;

/* Rays as Embree wants them: float, started a little off the facet. */
typedef struct embree_ray {
    float org[3], dir[3];
} embree_ray;

const char *embree_bounce_version(void);
embree_bounce *embree_bounce_create(const srp_scene *scene, bool robust);
void embree_bounce_destroy(embree_bounce *bounce);
embree_ray embree_bounce_ray(const embree_bounce *bounce, const srp_ray *ray);

/* Facets hit; SRP_NO_NEIGHBOUR: none. */
void embree_bounce_single(const embree_bounce *bounce, size_t count, const embree_ray *rays,
                          uint32_t *hits);
void embree_bounce_wave(const embree_bounce *bounce, size_t count, const embree_ray *rays,
                        uint32_t *hits);

#endif
