/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Light that has met mirrors only, exactly. Internal.
 *
 * Sunlight that a flat facet mirrors is a beam of parallel light again, as wide as the facet's lit
 * part. What it hits first is found like the first hits of sunlight (exact_visible.h), and so on
 * from mirror to mirror: no rays, no sampling error. docs/theory.md, "Mirrored beams".
 */
#ifndef SRP_SRC_MIRRORS_H
#define SRP_SRC_MIRRORS_H

#include "bounce.h"

#include <srp/response.h>
#include <srp/status.h>
#include <srp/vec3.h>

#include <stdbool.h>
#include <stdint.h>

/* Memory for one direction at a time. */
typedef struct srp_mirrors srp_mirrors;

/* NULL when there is no memory. `world` must stay. */
srp_mirrors *srp_mirrors_create(const srp_bounce_world *world);
void srp_mirrors_destroy(srp_mirrors *mirrors);

/* What mirrored light does, after as many bounces as `world` says. */
typedef struct srp_mirrored {
    bool complete; /* no more than `limit` beams; else only the direct part is given */
    srp_bounce_sum sum;
    double unresolved; /* flux that was cut, by the rules of bounce.h [m^2] */
    /* Flux that goes on from mirrors and is scattered on its way, followed or not [m^2]: of the
     * first hits when not complete, else of all hits of light that has met mirrors only. */
    double goes_on, scattered;
} srp_mirrored;

/*
 * Adds direct light from `s` to the (material count + 1) sums, and follows what mirrors make of it,
 * up to `limit` beams. Events are told to world->watch, unless all or diffuse light is sampled.
 * SRP_OK or SRP_NO_MEMORY.
 */
srp_status srp_mirrors_respond(srp_mirrors *mirrors, srp_vec3 s, uint32_t limit, srp_basis *basis,
                               srp_mirrored *out);

#endif
