/* SPDX-License-Identifier: Apache-2.0 */
/* What the picture of a session is: camera, arrows and colours of the renderer (srp/render.h), from
 * what is known. No toolkit. */
#ifndef SRP_VIEWER_SCENE_LOOK_H
#define SRP_VIEWER_SCENE_LOOK_H

#include "session.h"

#include <srp/render.h>

enum { LOOK_MAP_SIZE = 256, LOOK_ARROWS_MAX = 4096 };

typedef struct viewer_look {
    srp_render_view view;
    double radius; /* [m] of the ball about the target that holds the spacecraft */
    srp_render_colour map[LOOK_MAP_SIZE];
    srp_render_arrow arrows[LOOK_ARROWS_MAX];
} viewer_look;

/* Eye at (az, el) [deg] of the room, nearer with `zoom`. The engine of the session has a mesh. */
void viewer_look_make(const viewer_session *session, double az_deg, double el_deg, double zoom,
                      int width, int height, viewer_look *out);

#endif
