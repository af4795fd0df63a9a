/* SPDX-License-Identifier: Apache-2.0 */
/* Closed surfaces that are not simple. Internal. */
#ifndef SRP_SRC_WINDING_H
#define SRP_SRC_WINDING_H

#include "scene_internal.h"

#include <stddef.h>
#include <stdint.h>

/*
 * Methods may skip the backs of a closed component because its front is always hit first. That is
 * wrong where a closed surface crosses itself like a figure of eight, so that one lobe is inside
 * out. Components that such a lobe is found in lose their `closed` mark: both their sides are then
 * looked at, which is always right and merely slower.
 *   component  (triangle_count) of each triangle
 *   facet_of   (triangle_count) facet of each triangle, SRP_NO_NEIGHBOUR for none
 * SRP_NO_MEMORY.
 */
srp_status srp_winding_open_negative(srp_scene *scene, const uint32_t *component,
                                     const uint32_t *facet_of, size_t triangle_count,
                                     srp_error *error);

#endif
