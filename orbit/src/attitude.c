/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"
#include "mat3.h"

#include <srp/const.h>
#include <srp/orbit/attitude.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

void srp_attitude_release(srp_attitude *attitude) {
    if (attitude->destroy != NULL) {
        attitude->destroy(attitude->user);
    }
    attitude->destroy = NULL;
    attitude->user = NULL;
}

/* (q4^2 - v.v) 1 + 2 v v^T - 2 q4 [v x] */
void srp_attitude_matrix_of_quaternion(const double q[4], double matrix[3][3]) {
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    matrix[0][0] = w * w + x * x - y * y - z * z;
    matrix[0][1] = 2.0 * (x * y + w * z);
    matrix[0][2] = 2.0 * (x * z - w * y);
    matrix[1][0] = 2.0 * (x * y - w * z);
    matrix[1][1] = w * w - x * x + y * y - z * z;
    matrix[1][2] = 2.0 * (y * z + w * x);
    matrix[2][0] = 2.0 * (x * z + w * y);
    matrix[2][1] = 2.0 * (y * z - w * x);
    matrix[2][2] = w * w - x * x - y * y + z * z;
}

static srp_status normalise(const double q[4], double out[4], srp_error *error) {
    const double n = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(n > 0.0 && isfinite(n))) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "a quaternion of length %g", n);
    }
    for (int i = 0; i < 4; ++i) {
        out[i] = q[i] / n;
    }
    return SRP_OK;
}

/* ---- Inertial, spinner ----------------------------------------------------------------------- */

typedef struct spinner {
    double start[3][3];
    srp_vec3 axis;
    double rate;
} spinner;

static int inertial_eval(const void *user, const srp_force_state *state, double matrix[3][3]) {
    (void)state;
    memcpy(matrix, ((const spinner *)user)->start, 9 * sizeof(double));
    return 0;
}

/* Axes turned by phi about a: cos 1 + (1 - cos) a a^T - sin [a x]. */
static void turn_about(srp_vec3 axis, double phi, double out[3][3]) {
    const double c = cos(phi), s = sin(phi);
    const double a[3] = {axis.x, axis.y, axis.z};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            out[i][j] = (1.0 - c) * a[i] * a[j] + (i == j ? c : 0.0);
        }
    }
    out[0][1] += s * axis.z;
    out[1][0] -= s * axis.z;
    out[1][2] += s * axis.x;
    out[2][1] -= s * axis.x;
    out[2][0] += s * axis.y;
    out[0][2] -= s * axis.y;
}

static int spinner_eval(const void *user, const srp_force_state *state, double matrix[3][3]) {
    const spinner *spin = user;
    double turned[3][3];
    turn_about(spin->axis, fmod(spin->rate * state->t, 2.0 * SRP_PI), turned);
    srp_mat3_multiply((const double(*)[3])turned, (const double(*)[3])spin->start, matrix);
    return 0;
}

static srp_status make_spinner(const double q[4], srp_vec3 axis, double rate, const char *name,
                               int (*eval)(const void *, const srp_force_state *, double[3][3]),
                               srp_attitude *out, srp_error *error) {
    double unit[4];
    srp_status status = normalise(q, unit, error);
    if (status != SRP_OK) {
        return status;
    }
    spinner *spin = malloc(sizeof *spin);
    if (spin == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for an attitude");
    }
    srp_attitude_matrix_of_quaternion(unit, spin->start);
    spin->axis = axis;
    spin->rate = rate;
    *out = (srp_attitude){name, 0, eval, free, spin};
    return SRP_OK;
}

srp_status srp_attitude_inertial(const double q[4], srp_attitude *out, srp_error *error) {
    return make_spinner(q, srp_axis(2), 0.0, "inertial", inertial_eval, out, error);
}

srp_status srp_attitude_spinner(const double q[4], srp_vec3 axis_body, double rate,
                                srp_attitude *out, srp_error *error) {
    const double n = srp_vec3_norm(axis_body);
    if (!(n > 0.0 && isfinite(n) && isfinite(rate))) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "an axis of length %g, a rate of %g rad/s", n,
                        rate);
    }
    return make_spinner(q, srp_vec3_scale(1.0 / n, axis_body), rate, "spinner", spinner_eval, out,
                        error);
}

/* ---- Two directions -------------------------------------------------------------------------- */

static const char *const TARGETS[SRP_TARGET_COUNT] = {"nadir", "sun", "velocity", "orbit_normal",
                                                      "north"};

const char *srp_target_name(srp_target target) {
    return (unsigned)target < SRP_TARGET_COUNT ? TARGETS[target] : NULL;
}

bool srp_target_find(const char *name, srp_target *out) {
    for (int i = 0; i < SRP_TARGET_COUNT; ++i) {
        if (strcmp(name, TARGETS[i]) == 0) {
            *out = (srp_target)i;
            return true;
        }
    }
    return false;
}

typedef struct pointing {
    srp_target align, constrain;
    double body[3][3]; /* columns: align, across both, and the third */
} pointing;

static srp_vec3 direction_of(srp_target target, const srp_force_state *state) {
    switch (target) {
    case SRP_TARGET_NADIR:
        return srp_unit(srp_vec3_scale(-1.0, state->r));
    case SRP_TARGET_SUN:
        return srp_unit(srp_vec3_sub(state->bodies[SRP_SUN], state->r));
    case SRP_TARGET_VELOCITY:
        return srp_unit(state->v);
    case SRP_TARGET_ORBIT_NORMAL:
        return srp_unit(srp_vec3_cross(state->r, state->v));
    default:
        return srp_axis(2);
    }
}

/* Columns: first, first x second, and the third of them. */
static void triad(srp_vec3 first, srp_vec3 across, double out[3][3]) {
    const srp_vec3 third = srp_vec3_cross(first, across);
    const srp_vec3 column[3] = {first, across, third};
    for (int j = 0; j < 3; ++j) {
        out[0][j] = column[j].x;
        out[1][j] = column[j].y;
        out[2][j] = column[j].z;
    }
}

/* Two directions this near to one line [rad] do not say how the body is turned about it. */
static const double IN_LINE = 1e-9;

static int pointing_eval(const void *user, const srp_force_state *state, double matrix[3][3]) {
    const pointing *p = user;
    const srp_vec3 first = direction_of(p->align, state);
    const srp_target instead[] = {p->constrain, SRP_TARGET_ORBIT_NORMAL, SRP_TARGET_NORTH};
    srp_vec3 across = srp_vec3_cross(first, srp_axis(0));
    for (int i = 0; i < 3; ++i) {
        const srp_vec3 try = srp_vec3_cross(first, direction_of(instead[i], state));
        if (srp_vec3_norm(try) > IN_LINE) {
            across = try;
            break;
        }
    }
    double inertial[3][3];
    triad(first, srp_unit(across), inertial);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            matrix[i][j] = p->body[i][0] * inertial[j][0] + p->body[i][1] * inertial[j][1] +
                           p->body[i][2] * inertial[j][2];
        }
    }
    return isfinite(matrix[0][0] + matrix[1][1] + matrix[2][2]) ? 0 : -1;
}

srp_status srp_attitude_pointing_create(const srp_attitude_pointing *in, srp_attitude *out,
                                        srp_error *error) {
    const srp_vec3 first = srp_unit(in->align_body), second = srp_unit(in->constrain_body);
    const srp_vec3 across = srp_vec3_cross(first, second);
    if ((unsigned)in->align >= SRP_TARGET_COUNT || (unsigned)in->constrain >= SRP_TARGET_COUNT ||
        in->align == in->constrain) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "two targets that differ are needed");
    }
    if (!(srp_vec3_norm(across) > IN_LINE)) {
        return srp_fail(error, SRP_BAD_ARGUMENT,
                        "body axes (%g, %g, %g) and (%g, %g, %g): expected two directions that are "
                        "not in one line",
                        in->align_body.x, in->align_body.y, in->align_body.z, in->constrain_body.x,
                        in->constrain_body.y, in->constrain_body.z);
    }
    pointing *p = malloc(sizeof *p);
    if (p == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for an attitude");
    }
    p->align = in->align;
    p->constrain = in->constrain;
    triad(first, srp_unit(across), p->body);
    *out = (srp_attitude){"pointing", SRP_ATTITUDE_OF_STATE, pointing_eval, free, p};
    return SRP_OK;
}
