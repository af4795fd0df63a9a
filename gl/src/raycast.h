/* SPDX-License-Identifier: Apache-2.0 */
/* Looking over the raycast method's shoulder, for tests. Internal. */
#ifndef SRP_GL_SRC_RAYCAST_H
#define SRP_GL_SRC_RAYCAST_H

#include "raster_frame.h"

#include <srp/method.h>

#include <stdint.h>

/* Samples [column, column + width) of a row, as they came from OpenGL: 1 + index into frame->facet,
 * or 0. */
typedef void (*srp_gl_raycast_watcher)(void *user, const srp_raster_frame *frame, int32_t column,
                                       int32_t row, int32_t width, const uint32_t *ids);

/* Has every row told to `watch`, from the threads that count. `prepared` is one of raycast on a
 * device of OpenGL, and not in use. */
void srp_gl_raycast_watch(srp_prepared *prepared, srp_gl_raycast_watcher watch, void *user);

#endif
