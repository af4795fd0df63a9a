/* SPDX-License-Identifier: Apache-2.0 */
#include "nnls.h"

#include <float.h>
#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>

typedef struct work {
    const gsl_matrix *a;
    const gsl_vector *b;
    bool *free; /* (n) which unknowns are not at their bound */
    size_t count;
    gsl_matrix *part; /* columns of the free ones */
    gsl_vector *tau, *rest, *solution, *trial, *gradient;
} work;

static void work_free(work *w) {
    free(w->free);
    gsl_matrix_free(w->part);
    gsl_vector_free(w->tau);
    gsl_vector_free(w->rest);
    gsl_vector_free(w->solution);
    gsl_vector_free(w->trial);
    gsl_vector_free(w->gradient);
}

static bool work_make(work *w, const gsl_matrix *a, const gsl_vector *b) {
    size_t m = a->size1, n = a->size2;
    *w = (work){a,
                b,
                calloc(n, sizeof *w->free),
                0,
                gsl_matrix_alloc(m, n),
                gsl_vector_alloc(n),
                gsl_vector_alloc(m),
                gsl_vector_alloc(n),
                gsl_vector_alloc(n),
                gsl_vector_alloc(n)};
    return w->free != NULL && w->part != NULL && w->tau != NULL && w->rest != NULL &&
           w->solution != NULL && w->trial != NULL && w->gradient != NULL;
}

/* Least squares over the free unknowns into w->trial, 0 for the others. */
static bool solve_free(work *w) {
    size_t m = w->a->size1, n = w->a->size2, k = 0;
    for (size_t j = 0; j < n; ++j) {
        if (w->free[j]) {
            gsl_vector_const_view from = gsl_matrix_const_column(w->a, j);
            gsl_matrix_set_col(w->part, k++, &from.vector);
        }
    }
    gsl_matrix_view part = gsl_matrix_submatrix(w->part, 0, 0, m, k);
    gsl_vector_view tau = gsl_vector_subvector(w->tau, 0, k);
    gsl_vector_view solution = gsl_vector_subvector(w->solution, 0, k);
    if (gsl_linalg_QR_decomp(&part.matrix, &tau.vector) != GSL_SUCCESS ||
        gsl_linalg_QR_lssolve(&part.matrix, &tau.vector, w->b, &solution.vector, w->rest) !=
            GSL_SUCCESS) {
        return false;
    }
    k = 0;
    for (size_t j = 0; j < n; ++j) {
        double value = w->free[j] ? gsl_vector_get(w->solution, k++) : 0.0;
        if (!isfinite(value)) {
            return false;
        }
        gsl_vector_set(w->trial, j, value);
    }
    return true;
}

/* The bound unknown whose growth helps most, n when none does. The gradient of what fits to
 * rounding is noise: `noise` times the length of the column and of b. */
static size_t most_helpful(work *w, const gsl_vector *x) {
    const double noise = 64.0 * DBL_EPSILON * gsl_blas_dnrm2(w->b);
    size_t n = w->a->size2, best = n;
    double most = 0.0;
    gsl_vector_memcpy(w->rest, w->b);
    gsl_blas_dgemv(CblasNoTrans, -1.0, w->a, x, 1.0, w->rest);
    gsl_blas_dgemv(CblasTrans, 1.0, w->a, w->rest, 0.0, w->gradient);
    for (size_t j = 0; j < n; ++j) {
        gsl_vector_const_view column = gsl_matrix_const_column(w->a, j);
        double length = gsl_blas_dnrm2(&column.vector);
        double help = length > 0.0 ? gsl_vector_get(w->gradient, j) / length : 0.0;
        if (!w->free[j] && help > noise && help > most) {
            most = help;
            best = j;
        }
    }
    return best;
}

/* Goes from x towards w->trial as far as nothing becomes negative, and binds what becomes 0. */
static void step_back(work *w, gsl_vector *x) {
    double share = 1.0;
    for (size_t j = 0; j < x->size; ++j) {
        double now = gsl_vector_get(x, j), then = gsl_vector_get(w->trial, j);
        if (w->free[j] && then <= 0.0) {
            share = fmin(share, now / (now - then));
        }
    }
    for (size_t j = 0; j < x->size; ++j) {
        double now = gsl_vector_get(x, j), then = gsl_vector_get(w->trial, j);
        double value = now + share * (then - now);
        if (w->free[j] && then <= 0.0 && value <= 4.0 * DBL_EPSILON * now) {
            w->free[j] = false;
            value = 0.0;
        }
        gsl_vector_set(x, j, value);
    }
}

static bool all_positive(const work *w) {
    for (size_t j = 0; j < w->trial->size; ++j) {
        if (w->free[j] && gsl_vector_get(w->trial, j) <= 0.0) {
            return false;
        }
    }
    return true;
}

static bool any_free(const work *w) {
    for (size_t j = 0; j < w->a->size2; ++j) {
        if (w->free[j]) {
            return true;
        }
    }
    return false;
}

/* One unknown more; false when the algebra fails. */
static bool add_unknown(work *w, size_t j, gsl_vector *x) {
    w->free[j] = true;
    while (any_free(w)) {
        if (!solve_free(w)) {
            return false;
        }
        if (all_positive(w)) {
            gsl_vector_memcpy(x, w->trial);
            return true;
        }
        step_back(w, x);
    }
    gsl_vector_set_zero(x);
    return true;
}

bool cli_nnls(const gsl_matrix *a, const gsl_vector *b, gsl_vector *x) {
    work w;
    bool good = work_make(&w, a, b);
    gsl_vector_set_zero(x);
    size_t last = a->size2;
    for (size_t turn = 0; good && turn < 10 * a->size2; ++turn) {
        size_t j = most_helpful(&w, x);
        if (j == a->size2 || j == last) {
            break; /* the best there is, or what was just taken back: rounding */
        }
        good = add_unknown(&w, j, x);
        last = w.free[j] ? a->size2 : j;
    }
    work_free(&w);
    return good;
}
