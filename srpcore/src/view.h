/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The plane that faces the Sun. Internal.
 *
 * An orthonormal frame (u, v, s): s to the Sun, u along growing azimuth, v along growing elevation,
 * so that u x v = s. At the poles, where azimuth is undefined, it is that of azimuth 0.
 */
#ifndef SRP_SRC_VIEW_H
#define SRP_SRC_VIEW_H

#include <srp/vec3.h>

#include <math.h>

typedef struct srp_view {
    srp_vec3 u, v, s;
} srp_view;

static inline srp_view srp_view_of(srp_vec3 s) {
    srp_view view;
    double horizontal = sqrt(s.x * s.x + s.y * s.y);
    double cos_az = horizontal > 0.0 ? s.x / horizontal : 1.0;
    double sin_az = horizontal > 0.0 ? s.y / horizontal : 0.0;
    view.s = s;
    view.u = srp_vec3_make(-sin_az, cos_az, 0.0);
    view.v = srp_vec3_make(-s.z * cos_az, -s.z * sin_az, horizontal);
    return view;
}

/* Coordinates of p: image (x, y) and height towards the Sun (z). */
static inline srp_vec3 srp_view_project(const srp_view *view, srp_vec3 p) {
    return srp_vec3_make(srp_vec3_dot(p, view->u), srp_vec3_dot(p, view->v),
                         srp_vec3_dot(p, view->s));
}

/* Back from image coordinates to the body frame. */
static inline srp_vec3 srp_view_lift(const srp_view *view, srp_vec3 q) {
    srp_vec3 p = srp_vec3_scale(q.x, view->u);
    p = srp_vec3_add_scaled(p, q.y, view->v);
    return srp_vec3_add_scaled(p, q.z, view->s);
}

#endif
