/* SPDX-License-Identifier: Apache-2.0 */
#include "plate_fit.h"

#include "nnls.h"
#include "plate_columns.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { U = CLI_FIT_UNKNOWNS };

/* Singular values of the columns, made of length 1, may differ by this before plates count as not
 * to be told apart: rounding of the table's numbers then becomes larger than 1e-6 of the areas. */
static const double CONDITION_MAX = 1e10;
/* Sum of the unit normals of opposite plates, and how strongly these are tied where nothing else
 * tells their areas: far below what the table says, far above rounding. */
static const double OPPOSITE = 1e-6, TIE = 1e-5;

/* ---- the algebra of one fit ---- */

/* Rows are taken in by blocks of samples, at least so many: what is worked on stays in the cache,
 * however fine the table is. */
enum { BLOCK_MIN = 64 };

typedef struct algebra {
    const cli_samples *samples;
    const cli_fit_watch *watch;
    size_t columns, block; /* unknowns; samples of a block */
    gsl_matrix *x;        /* (columns + 3 block, columns) triangle of what was taken in, new rows */
    gsl_vector *y;        /* (columns + 3 block) their right side */
    gsl_vector *tau;      /* (columns) */
    gsl_matrix *r;        /* (columns, columns) triangle: |x b - y| = |r b - z| up to a constant */
    gsl_vector *areas;    /* (columns) a, v, w of each plate */
    gsl_matrix *spread;   /* (columns, columns) covariance of the areas for noise of variance 1 */
    gsl_matrix *scratch;  /* (columns, columns) */
    gsl_matrix *jacobian; /* (columns, columns) area, rho_s, rho_d by a, v, w */
} algebra;

static void algebra_free(algebra *g) {
    gsl_matrix_free(g->x);
    gsl_vector_free(g->y);
    gsl_vector_free(g->tau);
    gsl_matrix_free(g->r);
    gsl_vector_free(g->areas);
    gsl_matrix_free(g->spread);
    gsl_matrix_free(g->scratch);
    gsl_matrix_free(g->jacobian);
}

static bool algebra_make(algebra *g, const cli_samples *samples, const cli_fit_watch *watch,
                         size_t count) {
    size_t n = U * count, block = 2 * count > BLOCK_MIN ? 2 * count : BLOCK_MIN;
    *g = (algebra){samples,
                   watch,
                   n,
                   block,
                   gsl_matrix_alloc(n + 3 * block, n),
                   gsl_vector_alloc(n + 3 * block),
                   gsl_vector_alloc(n),
                   gsl_matrix_calloc(n, n),
                   gsl_vector_alloc(n),
                   gsl_matrix_calloc(n, n),
                   gsl_matrix_alloc(n, n),
                   gsl_matrix_calloc(n, n)};
    return g->x != NULL && g->y != NULL && g->tau != NULL && g->r != NULL && g->areas != NULL &&
           g->spread != NULL && g->scratch != NULL && g->jacobian != NULL;
}

/* Fills the rows behind the triangle with those of samples, times the root of the weight. */
static void set_rows(algebra *g, const srp_vec3 *normals, size_t first, size_t count) {
    for (size_t k = 0; k < count; ++k) {
        const cli_direction *at = &g->samples->at[first + k];
        srp_vec3 value = g->samples->value[first + k];
        size_t row = g->columns + 3 * k;
        double root = sqrt(at->weight);
        double *const to[3] = {gsl_matrix_ptr(g->x, row, 0), gsl_matrix_ptr(g->x, row + 1, 0),
                               gsl_matrix_ptr(g->x, row + 2, 0)};
        for (size_t p = 0; p < g->columns / U; ++p) {
            srp_vec3 column[U];
            cli_plate_columns(normals[p], at->s, column);
            for (size_t u = 0; u < U; ++u) {
                to[0][U * p + u] = root * column[u].x;
                to[1][U * p + u] = root * column[u].y;
                to[2][U * p + u] = root * column[u].z;
            }
        }
        gsl_vector_set(g->y, row, root * value.x);
        gsl_vector_set(g->y, row + 1, root * value.y);
        gsl_vector_set(g->y, row + 2, root * value.z);
    }
}

/* Takes `rows` rows behind the triangle into it, by Householder's reflections (Golub and Van Loan,
 * Matrix Computations, 4th ed., section 6.5.3): as accurate as with all rows at once, which a sum
 * of normal equations is not. False when the algebra fails. */
static bool absorb(algebra *g, size_t rows) {
    size_t n = g->columns;
    gsl_matrix_view x = gsl_matrix_submatrix(g->x, 0, 0, n + rows, n);
    gsl_vector_view y = gsl_vector_subvector(g->y, 0, n + rows);
    if (gsl_linalg_QR_decomp(&x.matrix, g->tau) != GSL_SUCCESS ||
        gsl_linalg_QR_QTvec(&x.matrix, g->tau, &y.vector) != GSL_SUCCESS) {
        return false;
    }
    for (size_t i = 1; i < n; ++i) {
        memset(gsl_matrix_ptr(g->x, i, 0), 0, i * sizeof(double));
    }
    return true;
}

/* Ratio of the extreme singular values of r, its columns made of length 1. */
static cli_fit_status check_condition(algebra *g) {
    size_t n = g->columns;
    gsl_matrix *u = gsl_matrix_alloc(n, n), *v = gsl_matrix_alloc(n, n);
    gsl_vector *s = gsl_vector_alloc(n), *work = gsl_vector_alloc(n);
    cli_fit_status status = CLI_FIT_NO_MEMORY;
    if (u != NULL && v != NULL && s != NULL && work != NULL) {
        gsl_matrix_memcpy(u, g->r);
        status = CLI_FIT_DONE;
        for (size_t j = 0; j < n; ++j) {
            gsl_vector_view column = gsl_matrix_column(u, j);
            double length = gsl_blas_dnrm2(&column.vector);
            if (!(length > 0.0)) {
                status = CLI_FIT_AMBIGUOUS; /* no light on it from anywhere */
            } else {
                gsl_vector_scale(&column.vector, 1.0 / length);
            }
        }
        if (status == CLI_FIT_DONE &&
            (gsl_linalg_SV_decomp(u, v, s, work) != GSL_SUCCESS ||
             !(gsl_vector_get(s, 0) < CONDITION_MAX * gsl_vector_get(s, n - 1)))) {
            status = CLI_FIT_AMBIGUOUS;
        }
    }
    gsl_matrix_free(u);
    gsl_matrix_free(v);
    gsl_vector_free(s);
    gsl_vector_free(work);
    return status;
}

/* What is taken in becomes r. */
static cli_fit_status take_triangle(algebra *g) {
    gsl_matrix_const_view top = gsl_matrix_const_submatrix(g->x, 0, 0, g->columns, g->columns);
    gsl_matrix_memcpy(g->r, &top.matrix);
    return check_condition(g);
}

static cli_fit_status triangulate(algebra *g, const srp_vec3 *normals) {
    gsl_matrix_set_zero(g->x);
    gsl_vector_set_zero(g->y);
    for (size_t k = 0, count; k < g->samples->count; k += count) {
        size_t left = g->samples->count - k;
        count = left < g->block ? left : g->block;
        if (!cli_fit_goes_on(g->watch)) {
            return CLI_FIT_CANCELLED;
        }
        set_rows(g, normals, k, count);
        if (!absorb(g, 3 * count)) {
            return CLI_FIT_NOT_FINITE;
        }
    }
    return take_triangle(g);
}

/* Asks, weakly, opposite plates to be of one area: a row for each pair. */
static cli_fit_status tie_opposites(algebra *g, const srp_vec3 *normals) {
    size_t count = g->columns / U, rows = 0;
    for (size_t p = 0; p < count; ++p) {
        for (size_t q = p + 1; q < count; ++q) {
            srp_vec3 apart = srp_vec3_add(normals[p], normals[q]);
            if (srp_vec3_norm(apart) >= OPPOSITE || rows == 3 * g->block) {
                continue;
            }
            double *row = gsl_matrix_ptr(g->x, g->columns + rows, 0);
            memset(row, 0, g->columns * sizeof *row);
            for (size_t u = 0; u < U; ++u) {
                row[U * p + u] = TIE;
                row[U * q + u] = -TIE;
            }
            gsl_vector_set(g->y, g->columns + rows++, 0.0);
        }
    }
    return absorb(g, rows) ? take_triangle(g) : CLI_FIT_NOT_FINITE;
}

/* From the samples to r, z and the areas. */
static cli_fit_status find_areas(algebra *g, const srp_vec3 *normals, bool *tied) {
    cli_fit_status status = triangulate(g, normals);
    *tied = status == CLI_FIT_AMBIGUOUS;
    if (*tied) {
        status = tie_opposites(g, normals);
    }
    if (status != CLI_FIT_DONE) {
        return status;
    }
    gsl_vector_view z = gsl_vector_subvector(g->y, 0, g->columns);
    return cli_nnls(g->r, &z.vector, g->areas) ? CLI_FIT_DONE : CLI_FIT_AMBIGUOUS;
}

/* ---- covariance ---- */

/* Partials of area, rho_s, rho_d by a, v, w of each plate; a plate without area has no
 * shares. */
static void set_jacobian(algebra *g) {
    for (size_t p = 0; p < g->columns / U; ++p) {
        double part[U], area = 0.0;
        for (size_t u = 0; u < U; ++u) {
            part[u] = gsl_vector_get(g->areas, U * p + u);
            area += part[u];
        }
        for (size_t u = 0; u < U; ++u) {
            gsl_matrix_set(g->jacobian, U * p + CLI_FIT_AREA, U * p + u, 1.0);
            for (size_t rho = 1; rho < U && area > 0.0; ++rho) {
                double own = u == rho ? area : 0.0;
                gsl_matrix_set(g->jacobian, U * p + rho, U * p + u,
                               (own - part[rho]) / (area * area));
            }
        }
    }
}

/*
 * A number y_i of the weight w_i, in the row x_i, moves the areas by G^-1 x_i w_i, G = x^T W x =
 * r^T r. Noise of the variance q in each therefore gives the areas the covariance q sum of w_i^2
 * (G^-1 x_i)(G^-1 x_i)^T, and the weighted sum of squared residuals the mean
 * q (sum of w_i - sum of w_i^2 x_i G^-1 x_i).
 */
static cli_fit_status add_noise(algebra *g, const srp_vec3 *normals, double *freedom) {
    const cli_samples *samples = g->samples;
    gsl_matrix_set_zero(g->scratch);
    *freedom = 0.0;
    for (size_t k = 0; k < samples->count; ++k) {
        double weight = samples->at[k].weight;
        if (!cli_fit_goes_on(g->watch)) {
            return CLI_FIT_CANCELLED;
        }
        for (int c = 0; c < 3; ++c) {
            double norm;
            for (size_t p = 0; p < g->columns / U; ++p) {
                srp_vec3 column[U];
                cli_plate_columns(normals[p], samples->at[k].s, column);
                for (size_t u = 0; u < U; ++u) {
                    const double of[3] = {column[u].x, column[u].y, column[u].z};
                    gsl_vector_set(g->tau, U * p + u, of[c]);
                }
            }
            gsl_blas_dtrsv(CblasUpper, CblasTrans, CblasNonUnit, g->r, g->tau);
            gsl_blas_ddot(g->tau, g->tau, &norm);
            *freedom += weight - weight * weight * norm;
            gsl_blas_dsyr(CblasLower, weight * weight, g->tau, g->scratch);
        }
    }
    for (size_t i = 0; i < g->columns; ++i) {
        for (size_t j = 0; j < i; ++j) {
            gsl_matrix_set(g->scratch, j, i, gsl_matrix_get(g->scratch, i, j));
        }
    }
    /* The second r^-1 of G^-1 = r^-1 r^-T, once for all rows. */
    gsl_matrix_memcpy(g->spread, g->scratch);
    gsl_blas_dtrsm(CblasLeft, CblasUpper, CblasNoTrans, CblasNonUnit, 1.0, g->r, g->spread);
    gsl_blas_dtrsm(CblasRight, CblasUpper, CblasTrans, CblasNonUnit, 1.0, g->r, g->spread);
    return CLI_FIT_DONE;
}

static cli_fit_status find_covariance(algebra *g, const srp_vec3 *normals, cli_plate_fit *fit) {
    double freedom, squares = 0.0;
    if (add_noise(g, normals, &freedom) != CLI_FIT_DONE) {
        return CLI_FIT_CANCELLED;
    }
    for (size_t k = 0; k < g->samples->count; ++k) {
        srp_vec3 off = srp_vec3_sub(fit->model[k], g->samples->value[k]);
        squares += g->samples->at[k].weight * srp_vec3_dot(off, off);
    }
    double variance = freedom > 0.0 ? squares / freedom : (double)INFINITY;
    fit->noise = sqrt(variance);
    set_jacobian(g);
    gsl_matrix_view out = gsl_matrix_view_array(fit->covariance, g->columns, g->columns);
    gsl_blas_dgemm(CblasNoTrans, CblasNoTrans, variance, g->jacobian, g->spread, 0.0, g->scratch);
    gsl_blas_dgemm(CblasNoTrans, CblasTrans, 1.0, g->scratch, g->jacobian, 0.0, &out.matrix);
    return CLI_FIT_DONE;
}

/* ---- the fit ---- */

static void set_plates(const algebra *g, const srp_vec3 *normals, cli_plate_fit *fit) {
    for (size_t p = 0; p < fit->count; ++p) {
        double a = gsl_vector_get(g->areas, U * p);
        double v = gsl_vector_get(g->areas, U * p + 1);
        double w = gsl_vector_get(g->areas, U * p + 2);
        srp_plate *plate = &fit->plates[p];
        plate->normal = normals[p];
        plate->area = a + v + w;
        if (plate->area > 0.0) {
            plate->optics.rho_s = fmin(v / plate->area, 1.0);
            /* By subtraction where nothing is absorbed: the sum must not round to more than 1. */
            plate->optics.rho_d = fmin(w / plate->area, 1.0 - plate->optics.rho_s);
        }
    }
    for (size_t k = 0; k < g->samples->count; ++k) {
        fit->model[k] = cli_plates_force(fit->plates, fit->count, g->samples->at[k].s);
    }
}

static bool fit_make(cli_plate_fit *fit, size_t count, size_t samples) {
    *fit = (cli_plate_fit){count,
                           calloc(count, sizeof *fit->plates),
                           calloc(U * count * U * count, sizeof *fit->covariance),
                           0.0,
                           false,
                           calloc(samples, sizeof *fit->model)};
    return fit->plates != NULL && fit->covariance != NULL && fit->model != NULL;
}

static bool all_finite(const cli_samples *samples) {
    for (size_t k = 0; k < samples->count; ++k) {
        if (!srp_vec3_is_finite(samples->value[k])) {
            return false;
        }
    }
    return true;
}

static cli_fit_status solve(const cli_samples *samples, const srp_vec3 *normals, size_t count,
                            const cli_fit_watch *watch, bool with_covariance, cli_plate_fit *out) {
    if (3 * samples->count <= U * count) {
        return CLI_FIT_TOO_FEW;
    }
    if (!all_finite(samples)) {
        return CLI_FIT_NOT_FINITE;
    }
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    algebra g;
    cli_plate_fit fit = {0, NULL, NULL, 0.0, false, NULL};
    srp_vec3 *unit = calloc(count, sizeof *unit);
    cli_fit_status status = CLI_FIT_NO_MEMORY;
    if (algebra_make(&g, samples, watch, count) && fit_make(&fit, count, samples->count) &&
        unit != NULL) {
        for (size_t p = 0; p < count; ++p) {
            unit[p] = srp_vec3_scale(1.0 / srp_vec3_norm(normals[p]), normals[p]);
        }
        status = find_areas(&g, unit, &fit.tied);
    }
    if (status == CLI_FIT_DONE) {
        set_plates(&g, unit, &fit);
        status = with_covariance ? find_covariance(&g, unit, &fit) : CLI_FIT_DONE;
    }
    gsl_set_error_handler(handler);
    algebra_free(&g);
    free(unit);
    if (status != CLI_FIT_DONE) {
        cli_plate_fit_free(&fit);
        return status;
    }
    *out = fit;
    return CLI_FIT_DONE;
}

cli_fit_status cli_plate_fit_solve(const cli_samples *samples, const srp_vec3 *normals,
                                   size_t count, const cli_fit_watch *watch, cli_plate_fit *out) {
    return solve(samples, normals, count, watch, true, out);
}

cli_fit_status cli_plate_fit_solve_only(const cli_samples *samples, const srp_vec3 *normals,
                                        size_t count, const cli_fit_watch *watch,
                                        cli_plate_fit *out) {
    return solve(samples, normals, count, watch, false, out);
}

bool cli_plate_fit_exists(void) {
    return true;
}
