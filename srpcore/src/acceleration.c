/* SPDX-License-Identifier: Apache-2.0 */
/* Acceleration of one spacecraft at one instant, and its partials (docs/theory.md, "Orbits"). */
#include "error.h"
#include "mat3.h"

#include <srp/acceleration.h>

#include <math.h>
#include <string.h>

/* [m] of the differences of the share of the Sun, a smooth function over tens of kilometres. */
static const double SHADOW_STEP = 10.0;
/* How far from length 1 a rotated unit vector may be. */
static const double ROTATION_TOLERANCE = 1e-6;

static double fraction(const srp_acceleration_params *params, const srp_acceleration_state *state) {
    return state->count == 0
               ? 1.0
               : srp_sunlight_fraction(state->sun, params->sun_radius, state->count, state->bodies);
}

srp_status srp_acceleration_light(const srp_acceleration_params *params,
                                  const srp_acceleration_state *state,
                                  srp_acceleration_lighting *out, srp_error *error) {
    srp_acceleration_lighting at;
    if (!(state->mass > 0.0 && isfinite(state->mass))) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "a mass of %g kg, expected above 0", state->mass);
    }
    if (state->count > SRP_ACCELERATION_BODIES_MAX) {
        return srp_fail(error, SRP_BAD_ARGUMENT,
                        "%zu bodies that cast shadows, expected at most %d", state->count,
                        SRP_ACCELERATION_BODIES_MAX);
    }
    at.distance = srp_vec3_norm(state->sun);
    if (!(at.distance > 0.0 && isfinite(at.distance))) {
        return srp_fail(error, SRP_BAD_ARGUMENT,
                        "the Sun is at (%g, %g, %g) m from the spacecraft, which is no direction",
                        state->sun.x, state->sun.y, state->sun.z);
    }
    at.s = srp_vec3_scale(1.0 / at.distance, state->sun);
    at.s_body = srp_mat3_apply(state->matrix, at.s);
    const double length = srp_vec3_norm(at.s_body);
    if (!(fabs(length - 1.0) <= ROTATION_TOLERANCE)) {
        return srp_fail(error, SRP_BAD_ARGUMENT,
                        "the attitude turns a unit vector into one of length %.9g: no rotation",
                        length);
    }
    /* Rounding of the matrix: interpolants want a unit vector. */
    at.s_body = srp_vec3_scale(1.0 / length, at.s_body);
    at.seen = fraction(params, state);
    at.factor = params->scale * srp_sunlight_pressure(params->light, at.distance) / state->mass;
    if (!isfinite(at.seen) || !isfinite(at.factor)) {
        return srp_fail(
            error, SRP_BAD_ARGUMENT,
            "a share of the Sun of %g and an acceleration of %g m/s^2 per m^2, expected "
            "finite numbers",
            at.seen, at.factor);
    }
    *out = at;
    return SRP_OK;
}

static void add_direction_part(const srp_acceleration_state *state,
                               const srp_acceleration_lighting *at, srp_vec3 f_inertial,
                               const double df[3][3], double da_dr[3][3]) {
    const double s[3] = {at->s.x, at->s.y, at->s.z}, k = at->seen * at->factor;
    for (int j = 0; j < 3; ++j) {
        srp_vec3 ds = srp_vec3_add_scaled(srp_vec3_scale(-1.0, srp_axis(j)), s[j], at->s);
        ds = srp_mat3_apply(state->matrix, srp_vec3_scale(1.0 / at->distance, ds));
        srp_vec3 column = srp_mat3_apply_transposed(state->matrix, srp_mat3_apply(df, ds));
        column = srp_vec3_add_scaled(column, 2.0 * s[j] / at->distance, f_inertial);
        srp_mat3_add_column(da_dr, j, srp_vec3_scale(k, column));
    }
}

/* The share of the Sun, `step` further along an axis. */
static double fraction_beside(const srp_acceleration_params *params,
                              const srp_acceleration_state *state, int axis, double step) {
    srp_body bodies[SRP_ACCELERATION_BODIES_MAX];
    srp_acceleration_state beside = *state;
    beside.sun = srp_vec3_add_scaled(state->sun, -step, srp_axis(axis));
    beside.bodies = bodies;
    for (size_t i = 0; i < state->count; ++i) {
        bodies[i].position = srp_vec3_add_scaled(state->bodies[i].position, -step, srp_axis(axis));
        bodies[i].radius = state->bodies[i].radius;
    }
    return fraction(params, &beside);
}

void srp_acceleration_add_partials(const srp_acceleration_params *params,
                                   const srp_acceleration_state *state,
                                   const srp_acceleration_lighting *lighting, srp_vec3 f,
                                   const double df[3][3], double da_dr[3][3]) {
    const srp_vec3 f_inertial = srp_mat3_apply_transposed(state->matrix, f);
    add_direction_part(state, lighting, f_inertial, df, da_dr);
    if (lighting->seen < 1.0) {
        for (int j = 0; j < 3; ++j) {
            const double up = fraction_beside(params, state, j, SHADOW_STEP);
            const double down = fraction_beside(params, state, j, -SHADOW_STEP);
            srp_mat3_add_column(
                da_dr, j,
                srp_vec3_scale(lighting->factor * (up - down) / (2.0 * SHADOW_STEP), f_inertial));
        }
    }
}

/* ---- Sources -------------------------------------------------------------------------------- */

static srp_status interp_eval(const void *user, srp_vec3 s_body, srp_vec3 *f, double (*df)[3],
                              srp_error *error) {
    srp_interp_jacobian jacobian;
    const srp_status status =
        srp_interp_eval(user, s_body, f, NULL, df != NULL ? &jacobian : NULL, error);
    if (status == SRP_OK && df != NULL) {
        memcpy(df, jacobian.df, sizeof jacobian.df);
    }
    return status;
}

srp_area_source srp_area_source_interp(const srp_interp *interp) {
    return (srp_area_source){interp_eval, interp};
}

static srp_status spad_eval(const void *user, srp_vec3 s_body, srp_vec3 *f, double (*df)[3],
                            srp_error *error) {
    return srp_spad_eval(user, s_body, f, df, error);
}

srp_area_source srp_area_source_spad(const srp_spad *spad) {
    return (srp_area_source){spad_eval, spad};
}

/* ---- All steps ------------------------------------------------------------------------------ */

srp_status srp_acceleration_eval(const srp_acceleration_params *params, srp_area_source source,
                                 const srp_acceleration_state *state, srp_vec3 *a,
                                 double da_dr[3][3], srp_error *error) {
    srp_acceleration_lighting at;
    double df[3][3];
    srp_vec3 f = {0.0, 0.0, 0.0};
    srp_status status = srp_acceleration_light(params, state, &at, error);
    if (status == SRP_OK && at.seen > 0.0) {
        status = source.eval(source.user, at.s_body, &f, da_dr != NULL ? df : NULL, error);
    }
    if (status != SRP_OK) {
        return status;
    }
    *a = srp_vec3_scale(at.seen * at.factor, srp_mat3_apply_transposed(state->matrix, f));
    if (da_dr != NULL) {
        memset(da_dr, 0, 9 * sizeof(double));
        if (at.seen > 0.0) {
            srp_acceleration_add_partials(params, state, &at, f, (const double(*)[3])df, da_dr);
        }
    }
    return SRP_OK;
}
