/* SPDX-License-Identifier: Apache-2.0 */
/* The raytrace method from within: looking over its shoulder, and taking its rays over. Internal.
 */
#ifndef SRP_SRC_RAYTRACE_H
#define SRP_SRC_RAYTRACE_H

#include "bounce.h"
#include "method_internal.h"
#include "raster_frame.h"

/* Has every step of every path told to `watch`, from the threads that trace. `prepared` is one of
 * srp_method_raytrace, and not in use. */
void srp_raytrace_watch(srp_prepared *prepared,
                        void (*watch)(void *user, const srp_bounce_event *event), void *user);

/* The paths of a direction, as a tracer gets them: those of all samples in rows [row_begin,
 * row_end) of which srp_bounce_starts() holds. */
typedef struct srp_raytrace_beam {
    const srp_bounce_world *world;
    const srp_raster_frame *frame;
    uint64_t seed; /* of this direction */
    int32_t row_begin, row_end;
} srp_raytrace_beam;

/* Whoever traces in place of the processor: sets *sums, zeroed, to what srp_bounce_wave would find.
 * From any thread; SRP_OK, or a failure that `respond` then calls a lack of memory. */
typedef struct srp_raytrace_tracer {
    srp_status (*trace)(void *user, const srp_raytrace_beam *beam, srp_bounce_sums *sums);
    void *user;
} srp_raytrace_tracer;

/* `prepared` is one of srp_method_raytrace, and not in use. `user` stays the caller's. */
void srp_raytrace_set_tracer(srp_prepared *prepared, srp_raytrace_tracer tracer);
srp_raytrace_tracer srp_raytrace_get_tracer(const srp_prepared *prepared);

/* What its paths meet; NULL when no facet begins any. */
const srp_bounce_world *srp_raytrace_world(const srp_prepared *prepared);

#endif
