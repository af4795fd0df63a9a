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

/* Of the four coefficients around a place in a cell. */
typedef void cubic_weights(double x, double weight[4]);

/* Sum of four rows of component k. */
SRP_CLONE_PART double cubic_rows(const double *c, const double y[4], size_t k, size_t width) {
    return (y[0] * c[k] + y[1] * c[width + k]) +
           (y[2] * c[2 * width + k] + y[3] * c[3 * width + k]);
}

/* Values of `width` components, the linear part included. */
SRP_CLONE_PART void cubic_value(const srp_interp *interp, const srp_interp_place *place,
                                srp_interp_stencil at, const double x[4], const double y[4],
                                size_t width, double *value) {
    const double *c0 = at.first, *c1 = c0 + at.column, *c2 = c1 + at.column, *c3 = c2 + at.column;
    const double(*linear)[SRP_INTERP_WIDTH_FT] = interp->linear;
    const srp_vec3 s = place->s;
    for (size_t k = 0; k < width; ++k) {
        double low = x[0] * cubic_rows(c0, y, k, width) + x[1] * cubic_rows(c1, y, k, width);
        double high = x[2] * cubic_rows(c2, y, k, width) + x[3] * cubic_rows(c3, y, k, width);
        value[k] =
            ((linear[0][k] + s.x * linear[1][k]) + (s.y * linear[2][k] + s.z * linear[3][k])) +
            (low + high);
    }
}

/* Derivatives along both angles per rad of arc, without the linear part. */
SRP_CLONE_PART void cubic_slopes(const srp_interp *interp, const srp_interp_place *place,
                                 srp_interp_stencil at, const double w[4][4], size_t width,
                                 double *by_az, double *by_el) {
    const double *c0 = at.first, *c1 = c0 + at.column, *c2 = c1 + at.column, *c3 = c2 + at.column;
    const double *x = w[0], *y = w[1], *dx = w[2], *dy = w[3];
    const double az = interp->columns_per_rad / place->cos_el, el = interp->rows_per_rad;
    for (size_t k = 0; k < width; ++k) {
        by_az[k] =
            az * ((dx[0] * cubic_rows(c0, y, k, width) + dx[1] * cubic_rows(c1, y, k, width)) +
                  (dx[2] * cubic_rows(c2, y, k, width) + dx[3] * cubic_rows(c3, y, k, width)));
        by_el[k] =
            el * ((x[0] * cubic_rows(c0, dy, k, width) + x[1] * cubic_rows(c1, dy, k, width)) +
                  (x[2] * cubic_rows(c2, dy, k, width) + x[3] * cubic_rows(c3, dy, k, width)));
    }
}

/* Value in a cell without a pole. */
SRP_CLONE_PART void cubic_value_inside(const srp_interp *interp, const srp_interp_place *place,
                                       cubic_weights *weights, double *value) {
    srp_interp_stencil at = srp_interp_stencil_of(interp, place->i, place->j);
    double x[4], y[4];
    weights(place->p, x);
    weights(place->q, y);
    if (interp->width == SRP_INTERP_WIDTH_F) {
        cubic_value(interp, place, at, x, y, SRP_INTERP_WIDTH_F, value);
    } else {
        cubic_value(interp, place, at, x, y, SRP_INTERP_WIDTH_FT, value);
    }
}

/* Derivatives there. */
SRP_CLONE_PART void cubic_slopes_inside(const srp_interp *interp, const srp_interp_place *place,
                                        cubic_weights *weights, cubic_weights *slope_weights,
                                        double *by_az, double *by_el) {
    srp_interp_stencil at = srp_interp_stencil_of(interp, place->i, place->j);
    double w[4][4];
    weights(place->p, w[0]);
    weights(place->q, w[1]);
    slope_weights(place->p, w[2]);
    slope_weights(place->q, w[3]);
    const double(*all)[4] = (const double(*)[4])w;
    if (interp->width == SRP_INTERP_WIDTH_F) {
        cubic_slopes(interp, place, at, all, SRP_INTERP_WIDTH_F, by_az, by_el);
    } else {
        cubic_slopes(interp, place, at, all, SRP_INTERP_WIDTH_FT, by_az, by_el);
    }
}

/* How the scheme turns four coefficients, counted from beyond the pole, into D, C and B. */
typedef void cubic_polynomial(const double e[4], double *d, double *c, double *b);

/* The fade, by d from 0 to 1, and its derivative. */
typedef struct cubic_fade {
    double weight, slope;
} cubic_fade;

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

/* A cell with a pole: value, by_az and by_el per rad of arc. `second`: C is replaced too. */
static inline void cubic_at_pole(const srp_interp *interp, const srp_interp_place *place,
                                 const double x[4], const double dx[4],
                                 cubic_polynomial *polynomial, cubic_fade fade, bool second,
                                 double *value, double *by_az, double *by_el) {
    const int sign = srp_interp_pole_at(interp, place);
    const srp_interp_pole *pole = &interp->poles[sign > 0];
    const srp_interp_stencil at = srp_interp_stencil_of(interp, place->i, place->j);
    const double cos_az = place->cos_az, sin_az = place->sin_az;
    const double cos_2az = cos_az * cos_az - sin_az * sin_az, sin_2az = 2.0 * sin_az * cos_az;
    const double theta = srp_interp_theta(place), d = theta * interp->rows_per_rad;
    /* Rows per rad of arc along the parallel. */
    const double arc = interp->rows_per_rad * (place->cos_el > 0.0 ? theta / place->cos_el : 1.0);
    const double w = fade.weight, dw = fade.slope, columns = interp->columns_per_rad;
    const double(*linear)[SRP_INTERP_WIDTH_FT] = interp->linear;
    const srp_vec3 s = place->s;
    for (size_t k = 0; k < interp->width; ++k) {
        double part[4][3];
        for (size_t a = 0; a < 4; ++a) {
            double e[4];
            for (size_t b = 0; b < 4; ++b) {
                size_t row = sign > 0 ? 3 - b : b;
                e[b] = at.first[a * at.column + row * interp->width + k];
            }
            polynomial(e, &part[a][0], &part[a][1], &part[a][2]);
        }
        const double(*parts)[3] = (const double(*)[3])part;
        cubic_pole_sum sum = cubic_blend(parts, x);
        double fit_d = pole->slope[0][k] * cos_az + pole->slope[1][k] * sin_az - sum.d;
        double fit_c = second ? 0.5 * (pole->curve[0][k] + pole->curve[1][k] * cos_2az +
                                       pole->curve[2][k] * sin_2az) -
                                    sum.c
                              : 0.0;
        value[k] = pole->value[k] + d * (sum.d + w * fit_d + d * (sum.c + w * fit_c + d * sum.b)) +
                   (linear[0][k] + s.x * linear[1][k] + s.y * linear[2][k] + s.z * linear[3][k]);
        if (by_az == NULL) {
            continue;
        }
        double away = sum.d + w * fit_d + d * (2.0 * (sum.c + w * fit_c) + 3.0 * d * sum.b) +
                      d * dw * (fit_d + d * fit_c);
        by_el[k] = -sign * away * interp->rows_per_rad;
        sum = cubic_blend(parts, dx);
        double turn_d = pole->slope[1][k] * cos_az - pole->slope[0][k] * sin_az - columns * sum.d;
        double turn_c =
            second ? pole->curve[2][k] * cos_2az - pole->curve[1][k] * sin_2az - columns * sum.c
                   : 0.0;
        by_az[k] = arc * (columns * sum.d + w * turn_d +
                          d * (columns * sum.c + w * turn_c + d * columns * sum.b));
    }
}

#endif
