/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Cubic in 4 x 4 nodes: along each angle the cubic that meets two nodes and has there the slope of
 * the line through their neighbours (R. G. Keys, "Cubic convolution interpolation for digital image
 * processing", IEEE Trans. ASSP 29, 1981, a = -1/2).
 */
#include "interp_cubic.h"

/* Row beyond a pole: such that the slope at the pole is that of the fit. */
static void extend(srp_interp *interp, uint32_t i, int north) {
    const srp_interp_pole *pole = &interp->poles[north];
    long next = north ? (long)interp->rows - 1 : 1;
    long beyond = north ? (long)interp->rows + 1 : -1;
    double cosine, sine;
    srp_interp_column_direction(interp, i, &cosine, &sine);
    const double *from = srp_interp_node(interp, (long)i, next);
    double *to = srp_interp_node(interp, (long)i, beyond);
    for (size_t k = 0; k < interp->width; ++k) {
        to[k] = from[k] - 2.0 * (pole->slope[0][k] * cosine + pole->slope[1][k] * sine);
    }
}

static srp_status prepare(srp_interp *interp, srp_error *error) {
    (void)error;
    srp_interp_fit_slopes(interp);
    for (int north = 0; north < 2; ++north) {
        for (uint32_t i = 0; i < interp->columns; ++i) {
            extend(interp, i, north);
        }
    }
    srp_interp_repeat_columns(interp);
    return SRP_OK;
}

SRP_CLONE_PART void value_weights(double x, double w[4]) {
    double xx = x * x, xxx = xx * x;
    w[0] = xx - 0.5 * (x + xxx);
    w[1] = 1.0 - 2.5 * xx + 1.5 * xxx;
    w[2] = 0.5 * x + 2.0 * xx - 1.5 * xxx;
    w[3] = 0.5 * (xxx - xx);
}

SRP_CLONE_PART void slope_weights(double x, double w[4]) {
    double xx = x * x;
    w[0] = 2.0 * x - 0.5 - 1.5 * xx;
    w[1] = 4.5 * xx - 5.0 * x;
    w[2] = 0.5 + 4.0 * x - 4.5 * xx;
    w[3] = 1.5 * xx - x;
}

static void polynomial(const double e[4], double *d, double *c, double *b) {
    *d = 0.5 * (e[2] - e[0]);
    *c = e[0] - 2.5 * e[1] + 2.0 * e[2] - 0.5 * e[3];
    *b = 0.5 * (e[3] - e[0]) + 1.5 * (e[1] - e[2]);
}

/* (1 - d)^2 (1 + 2 d). */
static cubic_fade fade(double d) {
    cubic_fade r = {1.0 - d * d * (3.0 - 2.0 * d), 6.0 * d * (d - 1.0)};
    return r;
}

/* Looks for the place again, so that the usual look-up need not keep it for this one. */
static bool eval_at_pole(const srp_interp *interp, const srp_vec3 *s, const srp_interp_target *to) {
    srp_interp_place place;
    double x[4], dx[4], value[SRP_INTERP_WIDTH_FT];
    double by_az[SRP_INTERP_WIDTH_FT], by_el[SRP_INTERP_WIDTH_FT];
    if (!srp_interp_locate(interp, s, &place)) {
        return false;
    }
    value_weights(place.p, x);
    slope_weights(place.p, dx);
    cubic_fade to_fit = fade(srp_interp_theta(&place) * interp->rows_per_rad);
    cubic_at_pole(interp, &place, x, dx, polynomial, to_fit, false, value,
                  to->jacobian != NULL ? by_az : NULL, by_el);
    srp_interp_give_value(interp, value, to);
    if (to->jacobian != NULL) {
        srp_interp_give_slopes(interp, &place, by_az, by_el, to->jacobian);
    }
    return true;
}

SRP_TARGET_CLONES
static bool eval_slopes(const srp_interp *interp, const srp_vec3 *s, const srp_interp_target *to) {
    srp_interp_place place;
    double value[SRP_INTERP_WIDTH_FT], by_az[SRP_INTERP_WIDTH_FT], by_el[SRP_INTERP_WIDTH_FT];
    if (!srp_interp_locate(interp, s, &place)) {
        return false;
    }
    if (srp_interp_pole_at(interp, &place) != 0) {
        return eval_at_pole(interp, s, to);
    }
    cubic_value_inside(interp, &place, value_weights, value);
    cubic_slopes_inside(interp, &place, value_weights, slope_weights, by_az, by_el);
    srp_interp_give_value(interp, value, to);
    srp_interp_give_slopes(interp, &place, by_az, by_el, to->jacobian);
    return true;
}

SRP_TARGET_CLONES
static bool eval(const srp_interp *interp, const srp_vec3 *s, const srp_interp_target *to) {
    srp_interp_place place;
    double value[SRP_INTERP_WIDTH_FT];
    if (to->jacobian != NULL) {
        return eval_slopes(interp, s, to);
    }
    if (!srp_interp_locate(interp, s, &place)) {
        return false;
    }
    if (srp_interp_pole_at(interp, &place) != 0) {
        return eval_at_pole(interp, s, to);
    }
    cubic_value_inside(interp, &place, value_weights, value);
    srp_interp_give_value(interp, value, to);
    return true;
}

const srp_interp_scheme srp_interp_bicubic = {
    .name = "bicubic",
    .summary = "cubic in 4 x 4 nodes; first derivative continuous",
    .continuity = 1,
    .order = 3,
    .capabilities = SRP_INTERP_LOCAL | SRP_INTERP_LINEAR,
    .steps_min = 4,
    .reach = 1,
    .prepare = prepare,
    .eval = eval,
    .extend = extend,
};
