/* SPDX-License-Identifier: Apache-2.0 */
/* The N-plate fit: recovers what it is given, tells its error, keeps its bounds, refuses. */
#include "nnls.h"
#include "plate_fit.h"
#include "srp_check.h"

#include <srp/const.h>
#include <srp/table.h>

#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <limits.h>
#include <string.h>

/* A box: six plates, no number twice. */
static const srp_plate BOX[6] = {
    {{1, 0, 0}, 3.7, {0.31, 0.22, false}}, {{-1, 0, 0}, 4.1, {0.12, 0.43, false}},
    {{0, 1, 0}, 5.3, {0.07, 0.02, false}}, {{0, -1, 0}, 2.9, {0.55, 0.13, false}},
    {{0, 0, 1}, 1.7, {0.21, 0.37, false}}, {{0, 0, -1}, 6.1, {0.44, 0.18, false}},
};

/* The box and two canted panels without backs: every number shows in the table. */
static srp_plate canted[8];
/* A box and both sides of a panel. With four pairs of opposite plates only equal areas are told. */
static srp_plate wings[8];

static srp_vec3 unit(double x, double y, double z) {
    srp_vec3 v = srp_vec3_make(x, y, z);
    return srp_vec3_scale(1.0 / srp_vec3_norm(v), v);
}

static void make_models(void) {
    memcpy(canted, BOX, sizeof BOX);
    canted[6] = (srp_plate){unit(0.83, 0.31, -0.46), 31.3, {0.09, 0.04, false}};
    canted[7] = (srp_plate){unit(0.71, -0.52, 0.38), 28.9, {0.06, 0.33, false}};
    memcpy(wings, canted, sizeof canted);
    for (size_t p = 0; p < 6; ++p) {
        wings[p].area = BOX[p - p % 2].area;
    }
    wings[7] = (srp_plate){srp_vec3_scale(-1.0, wings[6].normal), 31.3, {0.05, 0.35, false}};
}

/* The table of these plates, as srp_method_nplate has it, and its samples. */
static cli_samples table_of(const srp_plate *plates, size_t count, double step_deg) {
    srp_scene *scene;
    srp_prepared *prepared;
    srp_table *table;
    srp_grid grid;
    srp_error error;
    srp_method_params params = srp_method_params_default();
    params.threads = 1;
    assert_ok(srp_grid_from_steps(step_deg, step_deg, &grid, &error), error);
    assert_ok(srp_scene_from_plates(plates, count, &scene, &error), error);
    assert_ok(srp_method_prepare(&srp_method_nplate, scene, &params, &prepared, &error), error);
    assert_ok(srp_table_create(prepared, grid, false, &table, &error), error);
    assert_ok(srp_table_fill(table, prepared, NULL, &error), error);
    cli_samples samples;
    ck_assert(cli_samples_take(table, grid, false, &samples));
    srp_table_destroy(table);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
    return samples;
}

static void normals_of(const srp_plate *plates, size_t count, srp_vec3 *normals) {
    for (size_t p = 0; p < count; ++p) {
        normals[p] = plates[p].normal;
    }
}

static double value_of(const srp_plate *plate, int unknown) {
    return unknown == CLI_FIT_AREA    ? plate->area
           : unknown == CLI_FIT_RHO_S ? plate->optics.rho_s
                                      : plate->optics.rho_d;
}

/* Largest difference of areas, relative, and of shares. */
static double distance(const srp_plate *got, const srp_plate *want, size_t count) {
    double far = 0.0;
    for (size_t p = 0; p < count; ++p) {
        far = fmax(far, fabs(got[p].area / want[p].area - 1.0));
        far = fmax(far, fabs(got[p].optics.rho_s - want[p].optics.rho_s));
        far = fmax(far, fabs(got[p].optics.rho_d - want[p].optics.rho_d));
    }
    return far;
}

static void check_recovery(const srp_plate *plates, size_t count, double step_deg) {
    cli_samples samples = table_of(plates, count, step_deg);
    srp_vec3 normals[8];
    cli_plate_fit fit;
    normals_of(plates, count, normals);
    for (size_t p = 0; p < count; ++p) {
        normals[p] = srp_vec3_scale(1.7 + (double)p, normals[p]); /* any length */
    }
    ck_assert_int_eq(cli_plate_fit_solve(&samples, normals, count, NULL, &fit), CLI_FIT_DONE);
    double far = distance(fit.plates, plates, count);
    printf("%zu plates from their own table, %g degrees: areas and optics to %.1e\n", count,
           step_deg, far);
    ck_assert(far < 1e-8);
    ck_assert(fit.noise < 1e-12);
    for (size_t k = 0; k < samples.count; ++k) {
        assert_vec3_close(fit.model[k], samples.value[k], 1e-12, 1e-12);
    }
    cli_plate_fit_free(&fit);
    cli_samples_free(&samples);
}

START_TEST(plates_are_recovered_from_their_own_table) {
    make_models();
    check_recovery(BOX, 6, 5.0);
    check_recovery(BOX, 6, 30.0);
    check_recovery(canted, 8, 5.0);
    check_recovery(canted, 8, 20.0);
    check_recovery(wings, 8, 5.0);
    check_recovery(wings, 8, 20.0);
}
END_TEST

START_TEST(values_on_their_bounds_are_recovered) {
    srp_plate plates[6];
    memcpy(plates, BOX, sizeof plates);
    plates[0].optics = (srp_optics){0.0, 0.0, false};
    plates[1].optics = (srp_optics){1.0, 0.0, false};
    plates[2].optics = (srp_optics){0.0, 1.0, false};
    plates[3].optics = (srp_optics){0.37, 0.63, false};
    check_recovery(plates, 6, 10.0);
}
END_TEST

START_TEST(a_plate_that_is_not_there_has_no_area) {
    cli_samples samples = table_of(BOX, 5, 10.0);
    srp_vec3 normals[6];
    cli_plate_fit fit;
    normals_of(BOX, 6, normals);
    ck_assert_int_eq(cli_plate_fit_solve(&samples, normals, 6, NULL, &fit), CLI_FIT_DONE);
    ck_assert(distance(fit.plates, BOX, 5) < 1e-8);
    ck_assert(fit.plates[5].area < 1e-12);
    ck_assert(cli_plate_fit_sigma(&fit, 5, CLI_FIT_RHO_S) < 1e3); /* finite, whatever it is */
    cli_plate_fit_free(&fit);
    cli_samples_free(&samples);
}
END_TEST

/* Normally distributed (Box and Muller). */
static double normal_deviate(uint64_t *state) {
    double u = 1.0 - random_unit(state), v = random_unit(state);
    return sqrt(-2.0 * log(u)) * cos(2.0 * SRP_PI * v);
}

/* Noise of 1 % of the mean force in each number, 100 times: how far from the truth, in sigmas? */
static void check_noise(const srp_plate *plates, size_t count, double step_deg) {
    enum { RUNS = 100 };
    cli_samples samples = table_of(plates, count, step_deg);
    srp_vec3 *clean = calloc(samples.count, sizeof *clean);
    memcpy(clean, samples.value, samples.count * sizeof *clean);
    srp_vec3 normals[8];
    normals_of(plates, count, normals);
    double sigma = 0.01 * cli_samples_mean_length(&samples);
    uint64_t state = 20481;
    size_t inside[8][3] = {{0}}, within = 0, all = 0;
    double squares = 0.0, noise = 0.0;
    for (int run = 0; run < RUNS; ++run) {
        cli_plate_fit fit;
        for (size_t k = 0; k < samples.count; ++k) {
            srp_vec3 d;
            d.x = normal_deviate(&state);
            d.y = normal_deviate(&state);
            d.z = normal_deviate(&state);
            samples.value[k] = srp_vec3_add_scaled(clean[k], sigma, d);
        }
        ck_assert_int_eq(cli_plate_fit_solve(&samples, normals, count, NULL, &fit), CLI_FIT_DONE);
        noise += fit.noise / RUNS;
        for (size_t p = 0; p < count; ++p) {
            for (int u = 0; u < CLI_FIT_UNKNOWNS; ++u) {
                double off = value_of(&fit.plates[p], u) - value_of(&plates[p], u);
                double own = cli_plate_fit_sigma(&fit, p, u);
                inside[p][u] += fabs(off) <= 3.0 * own;
                within += fabs(off) <= 3.0 * own;
                squares += own > 0.0 ? off * off / (own * own) : 0.0;
                ++all;
            }
            ck_assert(srp_optics_check(fit.plates[p].optics, NULL) == SRP_OK);
        }
        cli_plate_fit_free(&fit);
    }
    printf("%zu plates, 1 %% noise, %d runs: %.2f %% of values within 3 sigma, mean square "
           "deviation %.3f sigma^2, noise found %.4f of the true one\n",
           count, RUNS, 100.0 * (double)within / (double)all, squares / (double)all, noise / sigma);
    for (size_t p = 0; p < count; ++p) {
        for (int u = 0; u < CLI_FIT_UNKNOWNS; ++u) {
            ck_assert_msg(inside[p][u] >= 95, "plate %zu, number %d: %zu of %d within 3 sigma", p,
                          u, inside[p][u], RUNS);
        }
    }
    /* Below 1: values near a bound are held nearer to the truth than their own sigma knows. */
    ck_assert(squares / (double)all > 0.7 && squares / (double)all < 1.25);
    assert_close(noise, sigma, 0.01, 0.0); /* without the unknowns taken off: 2 % less */
    free(clean);
    cli_samples_free(&samples);
}

START_TEST(the_error_of_a_noisy_fit_is_known) {
    make_models();
    check_noise(BOX, 6, 20.0);
    check_noise(canted, 8, 10.0);
}
END_TEST

START_TEST(normals_are_found) {
    make_models();
    for (int which = 0; which < 3; ++which) {
        const srp_plate *plates = which == 0 ? BOX : which == 1 ? canted : wings;
        size_t count = which == 0 ? 6 : 8;
        cli_samples coarse = table_of(plates, count, 20.0), fine = table_of(plates, count, 10.0);
        srp_vec3 normals[8];
        ck_assert_int_eq(cli_plate_normals_search(&coarse, &fine, count, NULL, normals),
                         CLI_FIT_DONE);
        cli_plate_fit fit;
        ck_assert_int_eq(cli_plate_fit_solve(&fine, normals, count, NULL, &fit), CLI_FIT_DONE);
        double farthest = 0.0;
        for (size_t p = 0; p < count; ++p) {
            size_t at = 0;
            for (size_t k = 1; k < count; ++k) {
                if (srp_vec3_dot(plates[p].normal, normals[k]) >
                    srp_vec3_dot(plates[p].normal, normals[at])) {
                    at = k;
                }
            }
            srp_vec3 off = srp_vec3_sub(plates[p].normal, normals[at]);
            farthest = fmax(farthest, srp_vec3_norm(off));
            farthest = fmax(farthest, distance(&fit.plates[at], &plates[p], 1));
        }
        printf("%zu plates without normals: normals, areas and optics to %.1e\n", count, farthest);
        ck_assert(farthest < 1e-6);
        cli_plate_fit_free(&fit);
        cli_samples_free(&coarse);
        cli_samples_free(&fine);
    }
}
END_TEST

/* What is symmetric offers a plate and its mirror image alike, and turns no plate off the plane
 * between them: then the last digit must not choose. */
START_TEST(rounding_chooses_no_normals) {
    srp_plate box[6];
    memcpy(box, BOX, sizeof box);
    for (size_t p = 0; p < 6; ++p) {
        box[p].area = p < 2 ? 38.3 : 1.9 + (double)(p / 2);
        box[p].optics = (srp_optics){p == 0 ? 0.07 : 0.17, p == 0 ? 0.03 : 0.31, false};
    }
    for (size_t count = 1; count <= 5; ++count) {
        cli_samples samples = table_of(box, 6, 10.0);
        srp_vec3 normals[5], again[5];
        ck_assert_int_eq(cli_plate_normals_search(&samples, &samples, count, NULL, normals),
                         CLI_FIT_DONE);
        for (size_t k = 0; k < samples.count; ++k) {
            double share = 1.0 + 1e-14 * (double)((int)(k * k % 7) - 3);
            samples.value[k] = srp_vec3_scale(share, samples.value[k]);
        }
        ck_assert_int_eq(cli_plate_normals_search(&samples, &samples, count, NULL, again),
                         CLI_FIT_DONE);
        double farthest = 0.0;
        for (size_t p = 0; p < count; ++p) {
            farthest = fmax(farthest, srp_vec3_norm(srp_vec3_sub(normals[p], again[p])));
        }
        printf("%zu plates, last digits changed: normals move by %.1e\n", count, farthest);
        ck_assert(farthest < 1e-3);
        cli_samples_free(&samples);
    }
}
END_TEST

START_TEST(a_search_fits_as_a_fit_does) {
    make_models();
    cli_samples samples = table_of(canted, 8, 10.0);
    srp_vec3 normals[8];
    cli_plate_fit whole, only;
    normals_of(canted, 8, normals);
    ck_assert_int_eq(cli_plate_fit_solve(&samples, normals, 8, NULL, &whole), CLI_FIT_DONE);
    ck_assert_int_eq(cli_plate_fit_solve_only(&samples, normals, 8, NULL, &only), CLI_FIT_DONE);
    ck_assert(distance(only.plates, whole.plates, 8) == 0.0);
    ck_assert(only.noise == 0.0 && cli_plate_fit_sigma(&only, 3, CLI_FIT_AREA) == 0.0);
    ck_assert(cli_plate_fit_sigma(&whole, 3, CLI_FIT_AREA) > 0.0);
    cli_plate_fit_free(&whole);
    cli_plate_fit_free(&only);
    cli_samples_free(&samples);
}
END_TEST

typedef struct patience {
    long asked, enough; /* times */
} patience;

static bool be_patient(void *user) {
    patience *p = user;
    return ++p->asked <= p->enough;
}

/* Cancelled at any time, it ends before it is asked a few times more, and nothing is written. */
START_TEST(a_fit_ends_when_its_watch_wants) {
    make_models();
    cli_samples coarse = table_of(canted, 8, 20.0), fine = table_of(canted, 8, 10.0);
    srp_vec3 normals[8], watched[8];
    patience p = {0, LONG_MAX};
    const cli_fit_watch watch = {be_patient, &p};
    cli_plate_fit fit = {.count = 77};
    ck_assert_int_eq(cli_plate_normals_search(&coarse, &fine, 8, NULL, normals), CLI_FIT_DONE);
    ck_assert_int_eq(cli_plate_normals_search(&coarse, &fine, 8, &watch, watched), CLI_FIT_DONE);
    ck_assert_mem_eq(watched, normals, sizeof normals);
    const long all = p.asked;
    ck_assert_int_gt(all, 10000);
    memset(watched, 0, sizeof watched);
    for (long part = 0; part < 20; ++part) {
        p = (patience){0, part * (all - 1) / 19};
        ck_assert_int_eq(cli_plate_normals_search(&coarse, &fine, 8, &watch, watched),
                         CLI_FIT_CANCELLED);
        ck_assert_int_le(p.asked, p.enough + 5);
        ck_assert(srp_vec3_norm(watched[0]) == 0.0);
    }
    for (long enough = 0; enough < (long)fine.count; ++enough) {
        p = (patience){0, enough};
        ck_assert_int_eq(cli_plate_fit_solve(&fine, normals, 8, &watch, &fit), CLI_FIT_CANCELLED);
        ck_assert_int_eq(p.asked, enough + 1);
        ck_assert_uint_eq(fit.count, 77);
    }
    cli_samples_free(&coarse);
    cli_samples_free(&fine);
}
END_TEST

START_TEST(bad_problems_are_refused) {
    cli_samples samples = table_of(BOX, 6, 90.0); /* 6 directions, 18 numbers */
    srp_vec3 normals[6];
    cli_plate_fit fit;
    normals_of(BOX, 6, normals);
    ck_assert_int_eq(cli_plate_fit_solve(&samples, normals, 6, NULL, &fit), CLI_FIT_TOO_FEW);
    ck_assert_int_eq(cli_plate_normals_search(&samples, &samples, 4, NULL, normals),
                     CLI_FIT_TOO_FEW);
    cli_samples_free(&samples);

    samples = table_of(BOX, 6, 30.0);
    normals[5] = normals[0]; /* the same plate twice */
    ck_assert_int_eq(cli_plate_fit_solve(&samples, normals, 6, NULL, &fit), CLI_FIT_AMBIGUOUS);
    normals[5] = srp_vec3_make(1.0, 1e-12, 0.0); /* and almost */
    ck_assert_int_eq(cli_plate_fit_solve(&samples, normals, 6, NULL, &fit), CLI_FIT_AMBIGUOUS);
    normals[5] = BOX[5].normal;
    samples.value[7].y = NAN;
    ck_assert_int_eq(cli_plate_fit_solve(&samples, normals, 6, NULL, &fit), CLI_FIT_NOT_FINITE);
    cli_samples_free(&samples);
}
END_TEST

/* Random small problems: the conditions of Karush, Kuhn and Tucker hold. */
START_TEST(non_negative_least_squares_is_optimal) {
    uint64_t state = 7;
    gsl_set_error_handler_off();
    for (int run = 0; run < 300; ++run) {
        size_t n = 1 + (size_t)(random_unit(&state) * 9.0),
               m = n + (size_t)(random_unit(&state) * 9);
        gsl_matrix *a = gsl_matrix_alloc(m, n);
        gsl_vector *b = gsl_vector_alloc(m), *x = gsl_vector_alloc(n), *g = gsl_vector_alloc(n);
        for (size_t i = 0; i < m; ++i) {
            gsl_vector_set(b, i, 2.0 * random_unit(&state) - 1.0);
            for (size_t j = 0; j < n; ++j) {
                gsl_matrix_set(a, i, j, 2.0 * random_unit(&state) - 1.0);
            }
        }
        ck_assert(cli_nnls(a, b, x));
        gsl_blas_dgemv(CblasNoTrans, -1.0, a, x, 1.0, b);
        gsl_blas_dgemv(CblasTrans, 1.0, a, b, 0.0, g);
        for (size_t j = 0; j < n; ++j) {
            double value = gsl_vector_get(x, j), slope = gsl_vector_get(g, j);
            ck_assert(value >= 0.0);
            ck_assert_msg(value > 0.0 ? fabs(slope) < 1e-10 : slope < 1e-10,
                          "run %d: x %g, slope %g", run, value, slope);
        }
        gsl_matrix_free(a);
        gsl_vector_free(b);
        gsl_vector_free(x);
        gsl_vector_free(g);
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("plate_fit");
    TCase *tc = tcase_create("plate_fit");
    tcase_add_test(tc, plates_are_recovered_from_their_own_table);
    tcase_add_test(tc, values_on_their_bounds_are_recovered);
    tcase_add_test(tc, a_plate_that_is_not_there_has_no_area);
    tcase_add_test(tc, the_error_of_a_noisy_fit_is_known);
    tcase_add_test(tc, normals_are_found);
    tcase_add_test(tc, rounding_chooses_no_normals);
    tcase_add_test(tc, a_search_fits_as_a_fit_does);
    tcase_add_test(tc, a_fit_ends_when_its_watch_wants);
    tcase_add_test(tc, bad_problems_are_refused);
    tcase_add_test(tc, non_negative_least_squares_is_optimal);
    suite_add_tcase(suite, tc);
    return run_suite(suite);
}
