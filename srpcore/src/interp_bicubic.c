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

/* (1 - d)^2 (1 + 2 d). */
static cubic_fade fade(double d) {
    cubic_fade r = {1.0 - d * d * (3.0 - 2.0 * d), 6.0 * d * (d - 1.0)};
    return r;
}

static const cubic_kind KIND = {
    .power = {{0.0, 1.0, 0.0, 0.0},
              {-0.5, 0.0, 0.5, 0.0},
              {1.0, -2.5, 2.0, -0.5},
              {-0.5, 1.5, -1.5, 0.5}},
    .lanes = {CUBIC_LANES(0.0, 1.0, 0.0, 0.0), CUBIC_LANES(-0.5, 0.0, 0.5, 0.0),
              CUBIC_LANES(1.0, -2.5, 2.0, -0.5), CUBIC_LANES(-0.5, 1.5, -1.5, 0.5)},
    .fade = fade,
    .second = false,
};

static bool eval_at_pole(const srp_interp *interp, const srp_vec3 *s, const srp_interp_target *to) {
    return cubic_eval_at_pole(interp, s, to, &KIND);
}

SRP_TARGET_CLONES
static bool eval_slopes(const srp_interp *interp, const srp_vec3 *s, const srp_interp_target *to) {
    return cubic_eval_slopes(interp, s, to, &KIND, eval_at_pole);
}

SRP_TARGET_CLONES
static bool eval(const srp_interp *interp, const srp_vec3 *s, const srp_interp_target *to) {
    if (to->jacobian != NULL) {
        return eval_slopes(interp, s, to);
    }
    return cubic_eval_value(interp, s, to, &KIND, eval_at_pole);
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
