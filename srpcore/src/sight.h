/* SPDX-License-Identifier: Apache-2.0 */
/* Which sides of which facets can see anything of the scene at all. Internal. */
#ifndef SRP_SRC_SIGHT_H
#define SRP_SRC_SIGHT_H

#include "scene_internal.h"

#include <srp/status.h>

#include <stdint.h>

enum { SRP_SIGHT_FRONT = 1, SRP_SIGHT_BACK = 2 };

/*
 * For every facet, SRP_SIGHT_... joined: a side is blind when no vertex of the scene stands above
 * its plane, beyond rounding; light that leaves a blind side hits nothing. Convex bodies are blind
 * all round as long as nothing else reaches above one of their faces.
 * *out has one byte per facet, for free(). SRP_NO_MEMORY.
 */
srp_status srp_sight_create(const srp_scene *scene, int threads, uint8_t **out, srp_error *error);

#endif
