/* SPDX-License-Identifier: Apache-2.0 */
/* Normals of plates that nobody gives: added one by one where they help most, turned together. */
#include "facing.h"
#include "plate_columns.h"
#include "plate_fit.h"

#include <srp/const.h>

#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    AXES = 26,         /* directions of a lattice of 3 x 3 x 3 about its middle */
    SPIRAL = 574,      /* more directions, spread evenly: 5 to 6 degrees apart */
    TURNS = 60,        /* steps of turning at most, in the end ... */
    TURNS_BETWEEN = 8, /* ... and after each new plate */
    EXCHANGES = 2      /* times that each plate is taken out and searched anew */
};

/* Steps that gain less than this share of the squared residual end the turning. */
static const double GAIN_MIN = 1e-10;

/* Gains nearer than this are those of mirror images: the first is taken, whatever rounding says. */
static const double TIE = 1e-9;

/* ---- where one plate more helps most ---- */

static srp_vec3 candidate(size_t k) {
    if (k < AXES) {
        int cell = (int)k < AXES / 2 ? (int)k : (int)k + 1; /* without the middle */
        srp_vec3 v = srp_vec3_make(cell % 3 - 1, cell / 3 % 3 - 1, cell / 9 - 1);
        return srp_vec3_scale(1.0 / srp_vec3_norm(v), v);
    }
    double m = (double)(k - AXES), z = 1.0 - (2.0 * m + 1.0) / SPIRAL;
    double turn = SRP_PI * (3.0 - sqrt(5.0)) * m, h = sqrt(1.0 - z * z);
    return srp_vec3_make(h * cos(turn), h * sin(turn), z);
}

/* Solves the part of G x = g that the bits of `which` choose, x >= 0; the gain g.x, or 0. */
static double gain_of_part(const double g[3], double m[3][3], unsigned which) {
    double a[3][4] = {{0.0}};
    for (int i = 0; i < 3; ++i) {
        bool in = (which >> i & 1u) != 0;
        for (int j = 0; j < 3; ++j) {
            a[i][j] = in && (which >> j & 1u) != 0 ? m[i][j] : (double)(i == j && !in);
        }
        a[i][3] = in ? g[i] : 0.0;
    }
    for (int p = 0; p < 3; ++p) { /* positive definite: no pivots needed */
        if (!(a[p][p] > 0.0)) {
            return 0.0;
        }
        for (int i = p + 1; i < 3; ++i) {
            double factor = a[i][p] / a[p][p];
            for (int j = p; j < 4; ++j) {
                a[i][j] -= factor * a[p][j];
            }
        }
    }
    double gain = 0.0;
    for (int p = 2; p >= 0; --p) {
        for (int j = p + 1; j < 3; ++j) {
            a[p][3] -= a[p][j] * a[j][3];
        }
        a[p][3] /= a[p][p];
        if (a[p][3] < 0.0) {
            return 0.0;
        }
        gain += g[p] * a[p][3];
    }
    return gain;
}

/* By how much one plate more can lower the squared residual. */
static double gain_of(const cli_samples *samples, const srp_vec3 *residual, srp_vec3 normal) {
    double g[3] = {0.0}, m[3][3] = {{0.0}}, best = 0.0;
    for (size_t k = 0; k < samples->count; ++k) {
        if (srp_vec3_dot(normal, samples->at[k].s) <= 0.0) {
            continue;
        }
        srp_vec3 column[3];
        cli_plate_columns(normal, samples->at[k].s, column);
        double weight = samples->at[k].weight;
        for (int i = 0; i < 3; ++i) {
            g[i] += weight * srp_vec3_dot(column[i], residual[k]);
            for (int j = 0; j < 3; ++j) {
                m[i][j] += weight * srp_vec3_dot(column[i], column[j]);
            }
        }
    }
    for (unsigned which = 1; which < 8; ++which) {
        best = fmax(best, gain_of_part(g, m, which));
    }
    return best;
}

/* Two directions at right angles to n and to each other. */
static void across(srp_vec3 n, srp_vec3 out[2]) {
    srp_vec3 axis = fabs(n.x) < 0.6 ? srp_vec3_make(1, 0, 0) : srp_vec3_make(0, 1, 0);
    out[0] = srp_vec3_cross(n, axis);
    out[0] = srp_vec3_scale(1.0 / srp_vec3_norm(out[0]), out[0]);
    out[1] = srp_vec3_cross(n, out[0]);
}

/* Off a plane of symmetry, where turning has no reason to leave it, and only rounding would decide:
 * by about a degree, each plate another way. */
static srp_vec3 tilted(srp_vec3 n, size_t plate) {
    const double tilt = 0.02, turn = SRP_PI * (3.0 - sqrt(5.0)) * (double)(plate + 1);
    srp_vec3 t[2];
    across(n, t);
    n = srp_vec3_add_scaled(n, tilt * cos(turn), t[0]);
    n = srp_vec3_add_scaled(n, tilt * sin(turn), t[1]);
    return srp_vec3_scale(1.0 / srp_vec3_norm(n), n);
}

/* `residual` (samples): what is left to explain. Normals nearer than 10 degrees are taken. */
static srp_vec3 best_candidate(const cli_samples *samples, const cli_fit_watch *watch,
                               const srp_vec3 *residual, const srp_vec3 *normals, size_t count) {
    const double near = cos(10.0 * SRP_RAD_PER_DEG);
    double most = -1.0;
    srp_vec3 best = {0.0, 0.0, 1.0};
    for (size_t c = 0; c < AXES + SPIRAL && cli_fit_goes_on(watch); ++c) {
        srp_vec3 normal = candidate(c);
        bool taken = false;
        for (size_t p = 0; p < count; ++p) {
            taken = taken || srp_vec3_dot(normal, normals[p]) > near;
        }
        double gain = taken ? -1.0 : gain_of(samples, residual, normal);
        if (gain > most + TIE * fabs(most)) {
            most = gain;
            best = normal;
        }
    }
    return tilted(best, count);
}

/* ---- turning ---- */

static double squares_of(const cli_samples *samples, const cli_plate_fit *fit) {
    double sum = 0.0;
    for (size_t k = 0; k < samples->count; ++k) {
        srp_vec3 off = srp_vec3_sub(samples->value[k], fit->model[k]);
        sum += samples->at[k].weight * srp_vec3_dot(off, off);
    }
    return sum;
}

/* Derivatives of the force of one plate: by a, v, w and by a turn towards each of `tangent`. */
static void derivatives(const srp_plate *plate, srp_vec3 s, const srp_vec3 tangent[2],
                        srp_vec3 out[5]) {
    double c = srp_vec3_dot(plate->normal, s);
    memset(out, 0, 5 * sizeof *out);
    if (c <= 0.0) {
        return;
    }
    cli_plate_columns(plate->normal, s, out);
    double v = plate->area * plate->optics.rho_s, w = plate->area * plate->optics.rho_d;
    for (int t = 0; t < 2; ++t) {
        double dc = srp_vec3_dot(tangent[t], s);
        srp_vec3 d = srp_vec3_scale(-(plate->area - v) * dc, s);
        d = srp_vec3_add_scaled(d, -4.0 * v * c * dc - 2.0 / 3.0 * w * dc, plate->normal);
        out[3 + t] = srp_vec3_add_scaled(d, -2.0 * v * c * c - 2.0 / 3.0 * w * c, tangent[t]);
    }
}

typedef struct turning {
    size_t count, size; /* plates, unknowns: five of each */
    gsl_matrix *normal, *damped;
    gsl_vector *gradient, *step;
    srp_vec3 *tangent; /* (count, 2) */
    srp_vec3 *trial;   /* (count) */
} turning;

static void turning_free(turning *t) {
    gsl_matrix_free(t->normal);
    gsl_matrix_free(t->damped);
    gsl_vector_free(t->gradient);
    gsl_vector_free(t->step);
    free(t->tangent);
    free(t->trial);
}

static bool turning_make(turning *t, size_t count) {
    size_t n = 5 * count;
    *t = (turning){count,
                   n,
                   gsl_matrix_alloc(n, n),
                   gsl_matrix_alloc(n, n),
                   gsl_vector_alloc(n),
                   gsl_vector_alloc(n),
                   calloc(2 * count, sizeof *t->tangent),
                   calloc(count, sizeof *t->trial)};
    return t->normal != NULL && t->damped != NULL && t->gradient != NULL && t->step != NULL &&
           t->tangent != NULL && t->trial != NULL;
}

/* Adds one direction: derivatives d of each of the `lit` plates, to the blocks on and
 * below the diagonal, and to the gradient. */
static void add_direction(turning *t, double weight, srp_vec3 off, const size_t *lit,
                          size_t lit_count, srp_vec3 (*d)[5]) {
    for (size_t i = 0; i < lit_count; ++i) {
        for (size_t u = 0; u < 5; ++u) {
            srp_vec3 row = srp_vec3_scale(weight, d[i][u]);
            *gsl_vector_ptr(t->gradient, 5 * lit[i] + u) += srp_vec3_dot(row, off);
            for (size_t j = 0; j <= i; ++j) {
                double *to = gsl_matrix_ptr(t->normal, 5 * lit[i] + u, 5 * lit[j]);
                for (size_t v = 0; v < 5; ++v) {
                    to[v] += srp_vec3_dot(row, d[j][v]);
                }
            }
        }
    }
}

/* Plates that the Sun is not in front of have no part in a direction: about half of them. */
static void sum_directions(turning *t, const cli_samples *samples, const cli_fit_watch *watch,
                           const cli_plate_fit *fit) {
    for (size_t k = 0; k < samples->count && cli_fit_goes_on(watch); ++k) {
        srp_vec3 off = srp_vec3_sub(samples->value[k], fit->model[k]), d[CLI_NORMALS_MAX][5];
        size_t lit[CLI_NORMALS_MAX], lit_count = 0;
        for (size_t p = 0; p < t->count; ++p) {
            if (srp_vec3_dot(fit->plates[p].normal, samples->at[k].s) > 0.0) {
                derivatives(&fit->plates[p], samples->at[k].s, &t->tangent[2 * p], d[lit_count]);
                lit[lit_count++] = p;
            }
        }
        add_direction(t, samples->at[k].weight, off, lit, lit_count, d);
    }
}

static void set_normal_equations(turning *t, const cli_samples *samples, const cli_fit_watch *watch,
                                 const cli_plate_fit *fit) {
    gsl_matrix_set_zero(t->normal);
    gsl_vector_set_zero(t->gradient);
    for (size_t p = 0; p < t->count; ++p) {
        across(fit->plates[p].normal, &t->tangent[2 * p]);
    }
    sum_directions(t, samples, watch, fit);
    /* Unknowns at their bound stay there, and plates without area are not turned. */
    for (size_t p = 0; p < t->count; ++p) {
        const srp_plate *plate = &fit->plates[p];
        double a = plate->area * (1.0 - plate->optics.rho_s - plate->optics.rho_d);
        const bool fixed[5] = {!(a > 1e-14 * plate->area), !(plate->optics.rho_s > 0.0),
                               !(plate->optics.rho_d > 0.0), !(plate->area > 0.0),
                               !(plate->area > 0.0)};
        for (size_t u = 0; u < 5; ++u) {
            size_t j = 5 * p + u;
            for (size_t i = 0; fixed[u] && i < t->size; ++i) {
                gsl_matrix_set(t->normal, i, j, i == j ? 1.0 : 0.0);
                gsl_matrix_set(t->normal, j, i, i == j ? 1.0 : 0.0);
            }
            if (fixed[u]) {
                gsl_vector_set(t->gradient, j, 0.0);
            }
        }
    }
}

/* Normals after a damped step into t->trial; false when the algebra fails. */
static bool set_trial(turning *t, const cli_plate_fit *fit, double damping) {
    gsl_matrix_memcpy(t->damped, t->normal);
    for (size_t j = 0; j < t->size; ++j) {
        double d = gsl_matrix_get(t->damped, j, j);
        gsl_matrix_set(t->damped, j, j, d * (1.0 + damping) + 1e-300);
    }
    if (gsl_linalg_cholesky_decomp1(t->damped) != GSL_SUCCESS ||
        gsl_linalg_cholesky_solve(t->damped, t->gradient, t->step) != GSL_SUCCESS) {
        return false;
    }
    for (size_t p = 0; p < t->count; ++p) {
        srp_vec3 n = fit->plates[p].normal, move = {0.0, 0.0, 0.0};
        for (size_t u = 0; u < 2; ++u) {
            move = srp_vec3_add_scaled(move, gsl_vector_get(t->step, 5 * p + 3 + u),
                                       t->tangent[2 * p + u]);
        }
        double length = srp_vec3_norm(move);
        if (!isfinite(length)) {
            return false;
        }
        n = srp_vec3_add_scaled(n, length > 0.3 ? 0.3 / length : 1.0, move);
        t->trial[p] = srp_vec3_scale(1.0 / srp_vec3_norm(n), n);
    }
    return true;
}

/* Does this end the search? Plates that cannot be told apart only end one way of searching. */
static bool ends_all(cli_fit_status status) {
    return status == CLI_FIT_NO_MEMORY || status == CLI_FIT_CANCELLED;
}

/* Turns the normals of *fit, in place, while that helps. */
static cli_fit_status turn(const cli_samples *samples, const cli_fit_watch *watch,
                           cli_plate_fit *fit, int turns) {
    turning t;
    if (!turning_make(&t, fit->count)) {
        turning_free(&t);
        return CLI_FIT_NO_MEMORY;
    }
    double damping = 1e-3, now = squares_of(samples, fit);
    bool fresh = true;
    cli_fit_status status = CLI_FIT_DONE;
    for (int k = 0; k < turns && damping < 1e8; ++k) {
        cli_plate_fit trial;
        if (fresh) {
            set_normal_equations(&t, samples, watch, fit);
        }
        if (!cli_fit_goes_on(watch)) {
            status = CLI_FIT_CANCELLED;
            break;
        }
        fresh = false;
        status = set_trial(&t, fit, damping)
                     ? cli_plate_fit_solve_only(samples, t.trial, fit->count, watch, &trial)
                     : CLI_FIT_AMBIGUOUS;
        if (ends_all(status)) {
            break;
        }
        double then = status == CLI_FIT_DONE ? squares_of(samples, &trial) : (double)INFINITY;
        if (then < now) {
            bool enough = now - then < GAIN_MIN * now;
            cli_plate_fit_free(fit);
            *fit = trial;
            now = then;
            damping *= 0.1;
            fresh = true;
            if (enough) {
                break;
            }
        } else {
            if (status == CLI_FIT_DONE) {
                cli_plate_fit_free(&trial);
            }
            damping = fmax(damping, 1e-8) * 10.0;
        }
    }
    turning_free(&t);
    return ends_all(status) ? status : CLI_FIT_DONE;
}

/* ---- the search ---- */

/* Fits, turns, and takes the normals over. */
static cli_fit_status settle(const cli_samples *samples, const cli_fit_watch *watch,
                             srp_vec3 *normals, size_t count, int turns, cli_plate_fit *out) {
    cli_plate_fit fit;
    cli_fit_status status = cli_plate_fit_solve_only(samples, normals, count, watch, &fit);
    if (status != CLI_FIT_DONE) {
        return status;
    }
    status = turn(samples, watch, &fit, turns);
    for (size_t p = 0; p < count && status == CLI_FIT_DONE; ++p) {
        normals[p] = fit.plates[p].normal;
    }
    if (status != CLI_FIT_DONE) {
        cli_plate_fit_free(&fit);
        return status;
    }
    *out = fit;
    return CLI_FIT_DONE;
}

static void set_residual(const cli_samples *samples, const cli_plate_fit *fit, srp_vec3 *residual) {
    for (size_t k = 0; k < samples->count; ++k) {
        residual[k] = srp_vec3_sub(samples->value[k], fit->model[k]);
    }
}

/* From no plate to `count`. */
static cli_fit_status grow(const cli_samples *samples, const cli_fit_watch *watch, size_t count,
                           srp_vec3 *normals, srp_vec3 *residual) {
    memcpy(residual, samples->value, samples->count * sizeof *residual);
    for (size_t p = 0; p < count; ++p) {
        cli_plate_fit fit;
        normals[p] = best_candidate(samples, watch, residual, normals, p);
        cli_fit_status status = settle(samples, watch, normals, p + 1, TURNS_BETWEEN, &fit);
        if (status != CLI_FIT_DONE) {
            return status;
        }
        set_residual(samples, &fit, residual);
        cli_plate_fit_free(&fit);
    }
    return CLI_FIT_DONE;
}

/* Takes plate p out and searches it anew; the better of the two stays. *squares is updated. */
static cli_fit_status exchange(const cli_samples *samples, const cli_fit_watch *watch, size_t count,
                               size_t p, srp_vec3 *normals, srp_vec3 *residual, srp_vec3 *trial,
                               double *squares) {
    cli_plate_fit fit;
    memcpy(trial, normals, count * sizeof *trial);
    trial[p] = trial[count - 1];
    cli_fit_status status = cli_plate_fit_solve_only(samples, trial, count - 1, watch, &fit);
    if (status != CLI_FIT_DONE) {
        return status;
    }
    set_residual(samples, &fit, residual);
    cli_plate_fit_free(&fit);
    trial[count - 1] = best_candidate(samples, watch, residual, trial, count - 1);
    status = settle(samples, watch, trial, count, TURNS_BETWEEN, &fit);
    if (status != CLI_FIT_DONE) {
        return ends_all(status) ? status : CLI_FIT_DONE;
    }
    double now = squares_of(samples, &fit);
    if (now < 0.999 * *squares) {
        memcpy(normals, trial, count * sizeof *trial);
        *squares = now;
    }
    cli_plate_fit_free(&fit);
    return CLI_FIT_DONE;
}

static cli_fit_status improve(const cli_samples *samples, const cli_fit_watch *watch, size_t count,
                              srp_vec3 *normals, srp_vec3 *residual, srp_vec3 *trial) {
    cli_plate_fit fit;
    cli_fit_status status = settle(samples, watch, normals, count, TURNS, &fit);
    if (status != CLI_FIT_DONE) {
        return status;
    }
    double squares = squares_of(samples, &fit);
    cli_plate_fit_free(&fit);
    for (size_t k = 0; k < EXCHANGES * count && count > 1 && status == CLI_FIT_DONE; ++k) {
        status = exchange(samples, watch, count, k % count, normals, residual, trial, &squares);
    }
    return status;
}

cli_fit_status cli_plate_normals_search(const cli_samples *search, const cli_samples *all,
                                        size_t count, const cli_fit_watch *watch,
                                        srp_vec3 *normals) {
    if (3 * search->count <= 5 * count || count > CLI_NORMALS_MAX) {
        return CLI_FIT_TOO_FEW;
    }
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    srp_vec3 *found = calloc(count, sizeof *found), *trial = calloc(count, sizeof *trial);
    srp_vec3 *residual = calloc(search->count, sizeof *residual);
    cli_fit_status status = CLI_FIT_NO_MEMORY;
    if (found != NULL && trial != NULL && residual != NULL) {
        status = grow(search, watch, count, found, residual);
        if (status == CLI_FIT_DONE) {
            status = improve(search, watch, count, found, residual, trial);
        }
    }
    cli_plate_fit fit;
    if (status == CLI_FIT_DONE) {
        status = settle(all, watch, found, count, TURNS, &fit);
    }
    if (status == CLI_FIT_DONE) {
        cli_plate_fit_free(&fit);
        memcpy(normals, found, count * sizeof *normals);
    }
    gsl_set_error_handler(handler);
    free(found);
    free(trial);
    free(residual);
    return status;
}
