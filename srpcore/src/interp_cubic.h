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
#include "interp_internal.h"

/* Of the four coefficients around a place in a cell, and of their derivatives. */
typedef struct cubic_weights {
    double value[4], slope[4];
} cubic_weights;

/* What the look-up of one direction is told; by_az NULL: value only. */
typedef struct cubic_job {
    const double *column[4];
    cubic_weights az, el;
    double *value, *by_az, *by_el;
} cubic_job;

/* value, by_az and by_el (per column and row) of `width` components. */
SRP_CLONE_PART void cubic_sum(const cubic_job *job, size_t width, bool slopes) {
    double value[SRP_INTERP_WIDTH_FT] = {0.0}, by_az[SRP_INTERP_WIDTH_FT] = {0.0};
    double by_el[SRP_INTERP_WIDTH_FT] = {0.0};
    for (size_t a = 0; a < 4; ++a) {
        const double *c = job->column[a];
        double wa = job->az.value[a], da = job->az.slope[a];
        for (size_t k = 0; k < width; ++k) {
            double along =
                (job->el.value[0] * c[k] + job->el.value[1] * c[width + k]) +
                (job->el.value[2] * c[2 * width + k] + job->el.value[3] * c[3 * width + k]);
            value[k] += wa * along;
            if (slopes) {
                double slope =
                    (job->el.slope[0] * c[k] + job->el.slope[1] * c[width + k]) +
                    (job->el.slope[2] * c[2 * width + k] + job->el.slope[3] * c[3 * width + k]);
                by_az[k] += da * along;
                by_el[k] += wa * slope;
            }
        }
    }
    for (size_t k = 0; k < width; ++k) {
        job->value[k] = value[k];
        if (slopes) {
            job->by_az[k] = by_az[k];
            job->by_el[k] = by_el[k];
        }
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

SRP_CLONE_PART cubic_pole_sum cubic_blend(const double part[4][3], const double weight[4]) {
    cubic_pole_sum sum = {0.0, 0.0, 0.0};
    for (size_t a = 0; a < 4; ++a) {
        sum.d += weight[a] * part[a][0];
        sum.c += weight[a] * part[a][1];
        sum.b += weight[a] * part[a][2];
    }
    return sum;
}

/* A cell with a pole: value, by_az and by_el per rad of arc. `second`: C is replaced too. */
SRP_CLONE_PART void cubic_at_pole(const srp_interp *interp, const srp_interp_place *place,
                                  const cubic_job *job, cubic_polynomial *polynomial,
                                  cubic_fade fade, bool second) {
    const srp_interp_pole *pole = srp_interp_pole_of(interp, place);
    const double cos_az = place->cos_az, sin_az = place->sin_az;
    const double cos_2az = cos_az * cos_az - sin_az * sin_az, sin_2az = 2.0 * sin_az * cos_az;
    const double d = place->theta * interp->rows_per_rad;
    const double arc = interp->rows_per_rad * srp_interp_arc_ratio(place);
    const double w = fade.weight, dw = fade.slope;
    for (size_t k = 0; k < interp->width; ++k) {
        double part[4][3];
        for (size_t a = 0; a < 4; ++a) {
            double e[4];
            for (size_t b = 0; b < 4; ++b) {
                e[b] = job->column[a][(place->pole > 0 ? 3 - b : b) * interp->width + k];
            }
            polynomial(e, &part[a][0], &part[a][1], &part[a][2]);
        }
        cubic_pole_sum sum = cubic_blend((const double(*)[3])part, job->az.value);
        double fit_d = pole->slope[0][k] * cos_az + pole->slope[1][k] * sin_az - sum.d;
        double fit_c = second ? 0.5 * (pole->curve[0][k] + pole->curve[1][k] * cos_2az +
                                       pole->curve[2][k] * sin_2az) -
                                    sum.c
                              : 0.0;
        job->value[k] =
            pole->value[k] + d * (sum.d + w * fit_d + d * (sum.c + w * fit_c + d * sum.b));
        if (job->by_az == NULL) {
            continue;
        }
        double away = sum.d + w * fit_d + d * (2.0 * (sum.c + w * fit_c) + 3.0 * d * sum.b) +
                      d * dw * (fit_d + d * fit_c);
        job->by_el[k] = -place->pole * away * interp->rows_per_rad;
        sum = cubic_blend((const double(*)[3])part, job->az.slope);
        double columns = interp->columns_per_rad;
        double turn_d = pole->slope[1][k] * cos_az - pole->slope[0][k] * sin_az - columns * sum.d;
        double turn_c =
            second ? pole->curve[2][k] * cos_2az - pole->curve[1][k] * sin_2az - columns * sum.c
                   : 0.0;
        job->by_az[k] = arc * (columns * sum.d + w * turn_d +
                               d * (columns * sum.c + w * turn_c + d * columns * sum.b));
    }
}

/* Adds the linear part to the value. */
SRP_CLONE_PART void cubic_add_linear(const srp_interp *interp, srp_vec3 s, double *value,
                                     size_t width) {
    for (size_t k = 0; k < width; ++k) {
        value[k] += (interp->linear[0][k] + s.x * interp->linear[1][k]) +
                    (s.y * interp->linear[2][k] + s.z * interp->linear[3][k]);
    }
}

/* A look-up but for the weights: what `eval` of a cubic scheme does with them. */
SRP_CLONE_PART void cubic_eval(const srp_interp *interp, const srp_interp_place *place,
                               cubic_job *job) {
    bool slopes = job->by_az != NULL;
    if (interp->width == SRP_INTERP_WIDTH_F) {
        slopes ? cubic_sum(job, SRP_INTERP_WIDTH_F, true)
               : cubic_sum(job, SRP_INTERP_WIDTH_F, false);
    } else {
        slopes ? cubic_sum(job, SRP_INTERP_WIDTH_FT, true)
               : cubic_sum(job, SRP_INTERP_WIDTH_FT, false);
    }
    if (slopes) {
        double az = interp->columns_per_rad / place->cos_el;
        for (size_t k = 0; k < interp->width; ++k) {
            job->by_az[k] *= az;
            job->by_el[k] *= interp->rows_per_rad;
        }
    }
}

#endif
