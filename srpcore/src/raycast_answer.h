/* SPDX-License-Identifier: Apache-2.0 */
/*
 * First hits sampled by a lattice: what is the same whoever draws the facets, the processor
 * (raycast.c) or OpenGL (gl/). Internal.
 */
#ifndef SRP_SRC_RAYCAST_ANSWER_H
#define SRP_SRC_RAYCAST_ANSWER_H

#include "method_internal.h"
#include "raster_canvas.h"
#include "raster_frame.h"
#include "variation.h"

#include <srp/method.h>

#include <stdbool.h>

/* SRP_BAD_ARGUMENT when cells of a fixed size are too many. */
srp_status srp_raycast_check_lattice(const srp_scene *scene, const srp_method_params *params,
                                     srp_error *error);

/* Per facet: the mean square of its corners' distance from the reference [m^2]; for free(). NULL:
 * no memory. */
double *srp_raycast_measure_levers(const srp_scene *scene, srp_vec3 reference);

/* Projects, fits the lattice and sets up what is drawn on it; `refine`: halvings of the cells. */
void srp_raycast_set_up_frame(const srp_prepared *prepared, srp_raster_frame *frame, srp_vec3 s,
                              unsigned refine);

/* What was counted on a frame. */
typedef struct srp_raycast_count {
    const srp_raster_frame *frame;
    const srp_raster_tally *tally; /* one per facet of the frame */
    const srp_variation *variation;
} srp_raycast_count;

/* Sets the sums per material, and errors, samples and flags of *out. False: the tolerance asks for
 * another round with cells of half the size. */
bool srp_raycast_answer(const srp_prepared *prepared, const double *lever2,
                        const srp_raycast_count *count, srp_basis *basis, srp_response *out);

#endif
