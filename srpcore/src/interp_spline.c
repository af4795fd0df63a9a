/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Cubic B-spline through all nodes. Nodes become coefficients by the recursive filter of M. Unser,
 * A. Aldroubi and M. Eden, "B-spline signal processing: part II", IEEE Trans. Signal Processing 41
 * (1993), on closed circles: of azimuth, and of each meridian with the one opposite. Departure: the
 * circles are summed all round at the start, so that no boundary condition is needed.
 *
 * Where no column lies opposite (an odd number of them), the opposite row is the row's own spline,
 * half a turn further, taken at the columns.
 */
#include "error.h"
#include "interp_cubic.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Coefficients --------------------------------------------------------------------------- */

/* Values at the knots of a closed circle to coefficients, in place: solves
 * (c[k - 1] + 4 c[k] + c[k + 1]) / 6 = x[k]. */
static void filter(double *x, size_t count) {
    const double z = sqrt(3.0) - 2.0;
    double sum = 0.0, power = 1.0;
    for (size_t k = 0; k < count && power != 0.0; ++k) {
        sum += power * x[(count - k) % count];
        power *= z;
    }
    const double whole = 1.0 / (1.0 - pow(z, (double)count));
    x[0] = 6.0 * sum * whole;
    for (size_t k = 1; k < count; ++k) {
        x[k] = 6.0 * x[k] + z * x[k - 1];
    }
    sum = 0.0;
    power = 1.0;
    for (size_t k = 0; k < count && power != 0.0; ++k) {
        sum += power * x[(count - 1 + k) % count];
        power *= z;
    }
    x[count - 1] = -z * sum * whole;
    for (size_t k = count - 1; k-- > 0;) {
        x[k] = z * (x[k + 1] - x[k]);
    }
}

/* Coefficients of a row to those of the row beyond the pole, as seen from its columns. */
static void oppose(const double *row, size_t count, double *out) {
    size_t half = count / 2;
    if (count % 2 == 0) {
        for (size_t i = 0; i < count; ++i) {
            out[i] = row[(i + half) % count];
        }
        return;
    }
    /* Half a turn further is the middle between two columns. */
    for (size_t i = 0; i < count; ++i) {
        double near = row[(i + half) % count] + row[(i + half + 1) % count];
        double far = row[(i + half + count - 1) % count] + row[(i + half + 2) % count];
        out[i] = (23.0 * near + far) / 48.0;
    }
    filter(out, count);
}

typedef struct spline_work {
    double *row; /* one row of one component, a circle of azimuth */
    double
        *opposite; /* (rows + 1, columns): of one component, the rows as the other side sees them */
    double *circle; /* a meridian and the one opposite, 2 rows */
} spline_work;

/* Coefficients along azimuth, in place, and their opposites. */
static void filter_rows(srp_interp *interp, const spline_work *work, size_t k) {
    size_t n = interp->columns;
    for (uint32_t j = 0; j <= interp->rows; ++j) {
        for (uint32_t i = 0; i < n; ++i) {
            work->row[i] = srp_interp_node(interp, (long)i, (long)j)[k];
        }
        filter(work->row, n);
        for (uint32_t i = 0; i < n; ++i) {
            srp_interp_node(interp, (long)i, (long)j)[k] = work->row[i];
        }
        oppose(work->row, n, work->opposite + j * n);
    }
}

/* From there to coefficients along elevation, those beyond the poles included. */
static void filter_columns(srp_interp *interp, const spline_work *work, size_t k) {
    size_t n = interp->columns, m = interp->rows;
    for (size_t i = 0; i < n; ++i) {
        double *x = work->circle;
        for (size_t j = 0; j <= m; ++j) {
            x[j] = srp_interp_node(interp, (long)i, (long)j)[k];
        }
        for (size_t j = 1; j < m; ++j) {
            x[2 * m - j] = work->opposite[j * n + i];
        }
        filter(x, 2 * m);
        for (size_t j = 0; j <= m + 1; ++j) {
            srp_interp_node(interp, (long)i, (long)j)[k] = x[j];
        }
        srp_interp_node(interp, (long)i, -1)[k] = x[2 * m - 1];
    }
}

/* ---- Poles ---------------------------------------------------------------------------------- */

/* 1 - 10 d^3 + 15 d^4 - 6 d^5. */
static cubic_fade fade(double d) {
    cubic_fade r = {1.0 - d * d * d * (10.0 + d * (6.0 * d - 15.0)),
                    -30.0 * d * d * (1.0 - d) * (1.0 - d)};
    return r;
}

static const cubic_kind KIND = {
    .power = {{1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0, 0.0},
              {-0.5, 0.0, 0.5, 0.0},
              {0.5, -1.0, 0.5, 0.0},
              {-1.0 / 6.0, 0.5, -0.5, 1.0 / 6.0}},
    .lanes = {CUBIC_LANES(1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0, 0.0), CUBIC_LANES(-0.5, 0.0, 0.5, 0.0),
              CUBIC_LANES(0.5, -1.0, 0.5, 0.0), CUBIC_LANES(-1.0 / 6.0, 0.5, -0.5, 1.0 / 6.0)},
    .fade = fade,
    .second = true,
};

/* D and C of the meridian over column i; off the pole. */
static void pole_polynomial(const srp_interp *interp, int north, uint32_t i, size_t k, double *d,
                            double *c) {
    double e[4], part[3];
    long last = (long)interp->rows;
    for (long j = 0; j < 4; ++j) {
        e[j] = srp_interp_node(interp, (long)i, north ? last + 1 - j : j - 1)[k];
    }
    cubic_polynomial(KIND.power, e, part);
    *d = part[0];
    *c = part[1];
}

/* First harmonic of the slopes, harmonics 0 and 2 of the curvatures. What the spline has between
 * columns follows from its coefficients, which are filtered here once more. */
static void fit_pole(srp_interp *interp, int north, size_t k) {
    srp_interp_pole *pole = &interp->poles[north];
    uint32_t n = interp->columns;
    /* A harmonic h of the coefficients is one of (4 + 2 cos(h 2 pi / n)) / 6 of the values. */
    double cosine, sine;
    srp_interp_column_direction(interp, 0, &cosine, &sine);
    const double turn = 8.0 * atan(1.0) / n;
    const double first = (4.0 + 2.0 * cos(turn)) / (3.0 * n);
    const double second = n > 4 ? (4.0 + 2.0 * cos(2.0 * turn)) / (3.0 * n) : 0.0;
    for (uint32_t i = 0; i < n; ++i) {
        double d, c;
        srp_interp_column_direction(interp, i, &cosine, &sine);
        pole_polynomial(interp, north, i, k, &d, &c);
        pole->slope[0][k] += first * d * cosine;
        pole->slope[1][k] += first * d * sine;
        pole->curve[0][k] += 2.0 * c / n;
        pole->curve[1][k] += 2.0 * second * c * (cosine * cosine - sine * sine);
        pole->curve[2][k] += 4.0 * second * c * cosine * sine;
    }
}

/* ---- The scheme ----------------------------------------------------------------------------- */

static srp_status prepare(srp_interp *interp, srp_error *error) {
    size_t n = interp->columns, m = interp->rows;
    spline_work work;
    work.row = malloc(n * sizeof *work.row);
    work.opposite = malloc(n * (m + 1) * sizeof *work.opposite);
    work.circle = malloc(2 * m * sizeof *work.circle);
    srp_status status = SRP_OK;
    if (work.row == NULL || work.opposite == NULL || work.circle == NULL) {
        status =
            srp_fail(error, SRP_NO_MEMORY, "no memory for a spline through %zu nodes", n * (m + 1));
    }
    for (size_t k = 0; k < interp->width && status == SRP_OK; ++k) {
        filter_rows(interp, &work, k);
        filter_columns(interp, &work, k);
        fit_pole(interp, 0, k);
        fit_pole(interp, 1, k);
    }
    free(work.row);
    free(work.opposite);
    free(work.circle);
    srp_interp_repeat_columns(interp);
    return status;
}

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

const srp_interp_scheme srp_interp_spline = {
    .name = "spline",
    .summary = "cubic B-spline through all nodes; second derivative continuous",
    .continuity = 2,
    .order = 4,
    .capabilities = SRP_INTERP_LINEAR,
    .steps_min = 4,
    .prepare = prepare,
    .eval = eval,
};
