/* SPDX-License-Identifier: Apache-2.0 */
/* Vectors of three doubles, by value. */
#ifndef SRP_VEC3_H
#define SRP_VEC3_H

#include <math.h>
#include <stdbool.h>

typedef struct srp_vec3 {
    double x, y, z;
} srp_vec3;

static inline srp_vec3 srp_vec3_make(double x, double y, double z) {
    srp_vec3 r;
    r.x = x;
    r.y = y;
    r.z = z;
    return r;
}

static inline srp_vec3 srp_vec3_add(srp_vec3 a, srp_vec3 b) {
    return srp_vec3_make(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline srp_vec3 srp_vec3_sub(srp_vec3 a, srp_vec3 b) {
    return srp_vec3_make(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline srp_vec3 srp_vec3_scale(double k, srp_vec3 a) {
    return srp_vec3_make(k * a.x, k * a.y, k * a.z);
}

/* a + k b */
static inline srp_vec3 srp_vec3_add_scaled(srp_vec3 a, double k, srp_vec3 b) {
    return srp_vec3_make(a.x + k * b.x, a.y + k * b.y, a.z + k * b.z);
}

static inline double srp_vec3_dot(srp_vec3 a, srp_vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline srp_vec3 srp_vec3_cross(srp_vec3 a, srp_vec3 b) {
    return srp_vec3_make(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline double srp_vec3_norm(srp_vec3 a) {
    return sqrt(srp_vec3_dot(a, a));
}

static inline bool srp_vec3_is_finite(srp_vec3 a) {
    return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

/* The mirror image of v in a plane through the origin; n is its unit normal. */
static inline srp_vec3 srp_vec3_mirrored(srp_vec3 v, srp_vec3 n) {
    return srp_vec3_add_scaled(v, -2.0 * srp_vec3_dot(v, n), n);
}

#endif
