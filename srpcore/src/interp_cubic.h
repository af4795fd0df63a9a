/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What the two cubic schemes share: a sum over 4 x 4 coefficients, and the cells around a pole.
 * Internal; included by one file per scheme, so that each is compiled for its own weights.
 *
 * Around a pole, column a of the stencil is the cubic F + d D_a + d^2 C_a + d^3 B_a in the distance
 * d from the pole (in rows), F the same for all. Blended along azimuth that is one function, but at
 * the pole smooth only if D(az) is a first harmonic, and twice so if C(az) has harmonics 0 and 2
 * alone. On a smooth field that is so up to the error of the scheme. Within the cells at the pole,
 * D(az) (and C(az)) is therefore replaced by its fit H, and fades to itself with a weight w that is
 * 1 at the pole and 0 at the next row, flat at both ends:
 *
 *     F + d [ (1 - w) D + w H_D ] + d^2 [ (1 - w) C + w H_C ] + d^3 B
 *
 * Nodes are met as before, and so is the next cell with its derivatives.
 */
#ifndef SRP_SRC_INTERP_CUBIC_H
#define SRP_SRC_INTERP_CUBIC_H

#include "clones.h"
#include "interp_locate.h"

/* The fade, by d from 0 to 1, and its derivative. */
typedef struct cubic_fade {
    double weight, slope;
} cubic_fade;
typedef cubic_fade cubic_fade_function(double d);

/* Four copies of each. */
#define CUBIC_LANES(a, b, c, d)                                                                    \
    { a, a, a, a, b, b, b, b, c, c, c, c, d, d, d, d }

/* What makes a scheme. A coefficient counts by a cubic in the place in the cell: its power p by
 * power[p] of the four around it, and lanes[p] is that four times each. */
typedef struct cubic_kind {
    double power[4][4], lanes[4][16];
    cubic_fade_function *fade;
    bool second; /* C is replaced too */
} cubic_kind;

SRP_CLONE_PART void cubic_weights(const double (*power)[4], double x, double w[4]) {
    for (size_t a = 0; a < 4; ++a) {
        w[a] = ((power[3][a] * x + power[2][a]) * x + power[1][a]) * x + power[0][a];
    }
}

SRP_CLONE_PART void cubic_slope_weights(const double (*power)[4], double x, double w[4]) {
    for (size_t a = 0; a < 4; ++a) {
        w[a] = (3.0 * power[3][a] * x + 2.0 * power[2][a]) * x + power[1][a];
    }
}

SRP_CLONE_PART void cubic_lane_weights(const double (*lanes)[16], double x, double w[16]) {
    for (size_t a = 0; a < 16; ++a) {
        w[a] = ((lanes[3][a] * x + lanes[2][a]) * x + lanes[1][a]) * x + lanes[0][a];
    }
}

/* The linear part of component k. */
SRP_CLONE_PART double cubic_linear(const srp_interp *interp, srp_vec3 s, size_t k) {
    const double(*linear)[SRP_INTERP_WIDTH_FT] = interp->linear;
    return (linear[0][k] + s.x * linear[1][k]) + (s.y * linear[2][k] + s.z * linear[3][k]);
}

/* f alone. Four rows of a column lie one after the other, so that eight lanes hold two nodes. */
SRP_CLONE_PART void cubic_value_f(const srp_interp *interp, const srp_interp_place *place,
                                  const cubic_kind *kind, double *value) {
    enum { W = SRP_INTERP_WIDTH_F, LANES = 2 * W };
    const srp_interp_stencil at = srp_interp_stencil_of(interp, place->i, place->j, W);
    const double *c0 = at.first, *c1 = c0 + at.column, *c2 = c1 + at.column, *c3 = c2 + at.column;
    double x[4], y[4 * W], part[LANES];
    cubic_lane_weights(kind->lanes, place->q, y);
    cubic_weights(kind->power, place->p, x);
    for (size_t k = 0; k < LANES; ++k) {
        part[k] = (x[0] * (y[k] * c0[k] + y[LANES + k] * c0[LANES + k]) +
                   x[1] * (y[k] * c1[k] + y[LANES + k] * c1[LANES + k])) +
                  (x[2] * (y[k] * c2[k] + y[LANES + k] * c2[LANES + k]) +
                   x[3] * (y[k] * c3[k] + y[LANES + k] * c3[LANES + k]));
    }
    for (size_t k = 0; k < W; ++k) {
        value[k] = (part[k] + part[W + k]) + cubic_linear(interp, place->s, k);
    }
}

/* Rows b and b + 2 of column `c`, component k. */
SRP_CLONE_PART double cubic_rows(const double *c, const double y[4], size_t b, size_t k,
                                 size_t width) {
    return y[b] * c[b * width + k] + y[b + 2] * c[(b + 2) * width + k];
}

/* Component k, weighted by x and y; the sum goes as in cubic_value_f(), to the bit. */
SRP_CLONE_PART double cubic_sum(srp_interp_stencil at, const double x[4], const double y[4],
                                size_t k, size_t width) {
    const double *c0 = at.first, *c1 = c0 + at.column, *c2 = c1 + at.column, *c3 = c2 + at.column;
    double sum[2];
    for (size_t b = 0; b < 2; ++b) {
        sum[b] = (x[0] * cubic_rows(c0, y, b, k, width) + x[1] * cubic_rows(c1, y, b, k, width)) +
                 (x[2] * cubic_rows(c2, y, b, k, width) + x[3] * cubic_rows(c3, y, b, k, width));
    }
    return sum[0] + sum[1];
}

/* f and t. */
SRP_CLONE_PART void cubic_value_ft(const srp_interp *interp, const srp_interp_place *place,
                                   const cubic_kind *kind, double *value) {
    enum { W = SRP_INTERP_WIDTH_FT };
    const srp_interp_stencil at = srp_interp_stencil_of(interp, place->i, place->j, W);
    double x[4], y[4];
    cubic_weights(kind->power, place->p, x);
    cubic_weights(kind->power, place->q, y);
    for (size_t k = 0; k < W; ++k) {
        value[k] = cubic_sum(at, x, y, k, W) + cubic_linear(interp, place->s, k);
    }
}

/* Value in a cell without a pole. */
SRP_CLONE_PART void cubic_value(const srp_interp *interp, const srp_interp_place *place,
                                const cubic_kind *kind, double *value) {
    if (interp->width == SRP_INTERP_WIDTH_F) {
        cubic_value_f(interp, place, kind, value);
    } else {
        cubic_value_ft(interp, place, kind, value);
    }
}

/* Derivatives there, along both angles per rad of arc, without the linear part. */
SRP_CLONE_PART void cubic_slopes(const srp_interp *interp, const srp_interp_place *place,
                                 const cubic_kind *kind, size_t width, double *by_az,
                                 double *by_el) {
    const srp_interp_stencil at = srp_interp_stencil_of(interp, place->i, place->j, width);
    const double az = interp->columns_per_rad / place->cos_el, el = interp->rows_per_rad;
    double x[4], y[4], dx[4], dy[4];
    cubic_weights(kind->power, place->p, x);
    cubic_weights(kind->power, place->q, y);
    cubic_slope_weights(kind->power, place->p, dx);
    cubic_slope_weights(kind->power, place->q, dy);
    for (size_t k = 0; k < width; ++k) {
        by_az[k] = az * cubic_sum(at, dx, y, k, width);
        by_el[k] = el * cubic_sum(at, x, dy, k, width);
    }
}

typedef struct cubic_pole_sum {
    double d, c, b; /* blended along azimuth */
} cubic_pole_sum;

static inline cubic_pole_sum cubic_blend(const double part[4][3], const double weight[4]) {
    cubic_pole_sum sum = {0.0, 0.0, 0.0};
    for (size_t a = 0; a < 4; ++a) {
        sum.d += weight[a] * part[a][0];
        sum.c += weight[a] * part[a][1];
        sum.b += weight[a] * part[a][2];
    }
    return sum;
}

/* Powers 1 to 3 of the cubic through four coefficients, counted from beyond the pole. */
static inline void cubic_polynomial(const double (*power)[4], const double e[4], double part[3]) {
    for (size_t p = 1; p < 4; ++p) {
        part[p - 1] =
            (power[p][0] * e[0] + power[p][1] * e[1]) + (power[p][2] * e[2] + power[p][3] * e[3]);
    }
}

/* A cell with a pole: value, by_az and by_el (unless by_az is NULL) per rad of arc. */
static inline void cubic_at_pole(const srp_interp *interp, const srp_interp_place *place,
                                 const cubic_kind *kind, double *value, double *by_az,
                                 double *by_el) {
    const int sign = srp_interp_pole_at(interp, place);
    const srp_interp_pole *pole = &interp->poles[sign > 0];
    const srp_interp_stencil at = srp_interp_stencil_of(interp, place->i, place->j, interp->width);
    double cos_az, sin_az;
    srp_interp_turn(place, &cos_az, &sin_az);
    const double cos_2az = cos_az * cos_az - sin_az * sin_az, sin_2az = 2.0 * sin_az * cos_az;
    const double theta = srp_interp_theta(place), d = theta * interp->rows_per_rad;
    /* Rows per rad of arc along the parallel. */
    const double arc = interp->rows_per_rad * (place->cos_el > 0.0 ? theta / place->cos_el : 1.0);
    const cubic_fade fade = kind->fade(d);
    const double w = fade.weight, dw = fade.slope, columns = interp->columns_per_rad;
    double x[4], dx[4];
    cubic_weights(kind->power, place->p, x);
    cubic_slope_weights(kind->power, place->p, dx);
    for (size_t k = 0; k < interp->width; ++k) {
        double part[4][3];
        for (size_t a = 0; a < 4; ++a) {
            double e[4];
            for (size_t b = 0; b < 4; ++b) {
                size_t row = sign > 0 ? 3 - b : b;
                e[b] = at.first[a * at.column + row * interp->width + k];
            }
            cubic_polynomial(kind->power, e, part[a]);
        }
        const double(*parts)[3] = (const double(*)[3])part;
        cubic_pole_sum sum = cubic_blend(parts, x);
        double fit_d = pole->slope[0][k] * cos_az + pole->slope[1][k] * sin_az - sum.d;
        double fit_c = kind->second ? 0.5 * (pole->curve[0][k] + pole->curve[1][k] * cos_2az +
                                             pole->curve[2][k] * sin_2az) -
                                          sum.c
                                    : 0.0;
        value[k] = pole->value[k] + d * (sum.d + w * fit_d + d * (sum.c + w * fit_c + d * sum.b)) +
                   cubic_linear(interp, place->s, k);
        if (by_az == NULL) {
            continue;
        }
        double away = sum.d + w * fit_d + d * (2.0 * (sum.c + w * fit_c) + 3.0 * d * sum.b) +
                      d * dw * (fit_d + d * fit_c);
        by_el[k] = -sign * away * interp->rows_per_rad;
        sum = cubic_blend(parts, dx);
        double turn_d = pole->slope[1][k] * cos_az - pole->slope[0][k] * sin_az - columns * sum.d;
        double turn_c = kind->second ? pole->curve[2][k] * cos_2az - pole->curve[1][k] * sin_2az -
                                           columns * sum.c
                                     : 0.0;
        by_az[k] = arc * (columns * sum.d + w * turn_d +
                          d * (columns * sum.c + w * turn_c + d * columns * sum.b));
    }
}

/* Looks for the place again, so that the usual look-up need not keep it for this one. */
static inline bool cubic_eval_at_pole(const srp_interp *interp, const srp_vec3 *s,
                                      const srp_interp_target *to, const cubic_kind *kind) {
    srp_interp_place place;
    double value[SRP_INTERP_WIDTH_FT], by_az[SRP_INTERP_WIDTH_FT], by_el[SRP_INTERP_WIDTH_FT];
    if (!srp_interp_locate(interp, s, &place)) {
        return false;
    }
    cubic_at_pole(interp, &place, kind, value, to->jacobian != NULL ? by_az : NULL, by_el);
    srp_interp_give_value(interp, value, to);
    if (to->jacobian != NULL) {
        srp_interp_give_slopes(interp, &place, by_az, by_el, to->jacobian);
    }
    return true;
}

/* False unless s is a unit vector. Cells with a pole are left to `at_pole`. */
typedef bool cubic_eval_function(const srp_interp *interp, const srp_vec3 *s,
                                 const srp_interp_target *to);

SRP_CLONE_PART bool cubic_eval_value(const srp_interp *interp, const srp_vec3 *s,
                                     const srp_interp_target *to, const cubic_kind *kind,
                                     cubic_eval_function *at_pole) {
    srp_interp_place place;
    double value[SRP_INTERP_WIDTH_FT];
    if (!srp_interp_locate(interp, s, &place)) {
        return false;
    }
    if (srp_interp_pole_at(interp, &place) != 0) {
        return at_pole(interp, s, to);
    }
    cubic_value(interp, &place, kind, value);
    srp_interp_give_value(interp, value, to);
    return true;
}

SRP_CLONE_PART bool cubic_eval_slopes(const srp_interp *interp, const srp_vec3 *s,
                                      const srp_interp_target *to, const cubic_kind *kind,
                                      cubic_eval_function *at_pole) {
    srp_interp_place place;
    double value[SRP_INTERP_WIDTH_FT], by_az[SRP_INTERP_WIDTH_FT], by_el[SRP_INTERP_WIDTH_FT];
    if (!srp_interp_locate(interp, s, &place)) {
        return false;
    }
    if (srp_interp_pole_at(interp, &place) != 0) {
        return at_pole(interp, s, to);
    }
    cubic_value(interp, &place, kind, value);
    if (interp->width == SRP_INTERP_WIDTH_F) {
        cubic_slopes(interp, &place, kind, SRP_INTERP_WIDTH_F, by_az, by_el);
    } else {
        cubic_slopes(interp, &place, kind, SRP_INTERP_WIDTH_FT, by_az, by_el);
    }
    srp_interp_give_value(interp, value, to);
    srp_interp_give_slopes(interp, &place, by_az, by_el, to->jacobian);
    return true;
}

#endif
