/* SPDX-License-Identifier: Apache-2.0 */
/* Looking over the raytrace method's shoulder, for tests. Internal. */
#ifndef SRP_SRC_RAYTRACE_H
#define SRP_SRC_RAYTRACE_H

#include "bounce.h"
#include "method_internal.h"

/* Has every step of every path told to `watch`, from the threads that trace. `prepared` is one of
 * srp_method_raytrace, and not in use. */
void srp_raytrace_watch(srp_prepared *prepared,
                        void (*watch)(void *user, const srp_bounce_event *event), void *user);

#endif
