/* SPDX-License-Identifier: Apache-2.0 */
/* The propagator beside closed forms: two bodies, a spring; energy, the way back, orders, partials.
 */
#include "mat3.h"
#include "orbit_fixture.h"

#include <gsl/gsl_errno.h>

static const double DAY = 86400.0;
static srp_ephemeris *sky;

static void set_up(void) {
    gsl_set_error_handler_off();
    sky = fixture_sky("2024-03-20T00:00:00 UTC", 12.0);
}

static void tear_down(void) {
    srp_ephemeris_destroy(sky);
}

static srp_propagator *make(const srp_force_list *list, const srp_propagator_params *params) {
    srp_propagator *p = NULL;
    srp_error error;
    assert_ok(srp_propagator_create(list, params, &p, &error), error);
    return p;
}

static void start(srp_propagator *p, srp_vec3 r, srp_vec3 v) {
    srp_error error;
    assert_ok(srp_propagator_start(p, 0.0, r, v, &error), error);
}

static void go(srp_propagator *p, double t) {
    srp_error error;
    assert_ok(srp_propagator_advance(p, t, NULL, &error), error);
    ck_assert(srp_propagator_time(p) == t);
}

static void state_of(double a, double e, srp_vec3 *r, srp_vec3 *v) {
    const srp_elements el = {a, e, 0.7, 1.2, 2.3, 0.4};
    srp_error error;
    assert_ok(srp_elements_to_state(FIXTURE_MU, &el, r, v, &error), error);
}

/* ---- Elements ----------------------------------------------------------------------------------
 */

START_TEST(elements_and_states_are_inverse) {
    uint64_t random = 23;
    for (int i = 0; i < 300; ++i) {
        const double e =
            i % 3 == 2 ? 1.0 + 2.0 * random_unit(&random) : 0.95 * random_unit(&random);
        const double q = 7e6 + 4e7 * random_unit(&random), widest = e > 1.0 ? acos(-1.0 / e) : 3.1;
        const srp_elements want = {q / (1.0 - e),
                                   e,
                                   0.05 + 3.0 * random_unit(&random),
                                   6.2 * random_unit(&random),
                                   6.2 * random_unit(&random),
                                   0.9 * widest * random_unit(&random)};
        srp_vec3 r, v;
        srp_error error;
        assert_ok(srp_elements_to_state(FIXTURE_MU, &want, &r, &v, &error), error);
        const srp_elements got = srp_elements_from_state(FIXTURE_MU, r, v);
        assert_close(got.a, want.a, 1e-10, 0.0);
        assert_close(got.e, want.e, 1e-11, 1e-13);
        assert_close(got.i, want.i, 1e-12, 0.0);
        assert_close(remainder(got.raan - want.raan, 2.0 * SRP_PI), 0.0, 0.0, 1e-12);
        assert_close(remainder(got.argp + got.nu - want.argp - want.nu, 2.0 * SRP_PI), 0.0, 0.0,
                     1e-12);
        assert_close(remainder(got.nu - want.nu, 2.0 * SRP_PI) * want.e, 0.0, 0.0, 1e-11);
    }
    srp_vec3 r = {1, 2, 3}, v = {1, 2, 3};
    srp_error error;
    const srp_elements bad[] = {{1e7, 1.5, 0, 0, 0, 0},
                                {-1e7, 0.5, 0, 0, 0, 0},
                                {-1e7, 2.0, 0, 0, 0, 2.2},
                                {NAN, 0.5, 0, 0, 0, 0}};
    for (size_t i = 0; i < 4; ++i) {
        ck_assert_int_eq(srp_elements_to_state(FIXTURE_MU, &bad[i], &r, &v, &error),
                         SRP_BAD_ARGUMENT);
        ck_assert(r.x == 1.0 && v.z == 3.0);
    }
}
END_TEST

/* ---- Closed forms ------------------------------------------------------------------------------
 */

START_TEST(two_bodies_follow_kepler) {
    const double shapes[][2] = {{42164e3, 0.001}, {26600e3, 0.73}, {-30000e3, 1.4}};
    srp_force_list *list = fixture_list(sky, false);
    srp_propagator_params params = srp_propagator_params_default();
    for (size_t k = 0; k < 3; ++k) {
        srp_propagator *p = make(list, &params);
        srp_vec3 r, v;
        srp_error error;
        state_of(shapes[k][0], shapes[k][1], &r, &v);
        start(p, r, v);
        go(p, 2.0 * DAY);
        assert_ok(srp_elements_kepler(FIXTURE_MU, 2.0 * DAY, &r, &v, &error), error);
        const double off = srp_vec3_norm(srp_vec3_sub(srp_propagator_position(p), r));
        printf("two bodies, e = %g: %.2g mm after 2 days, %llu steps\n", shapes[k][1], 1e3 * off,
               (unsigned long long)srp_propagator_get_counts(p).steps);
        assert_close(off, 0.0, 0.0, 5e-3);
        srp_propagator_destroy(p);
    }
    srp_force_list_destroy(list);
}
END_TEST

static int spring(const void *user, const srp_force_state *state, srp_force_sum *sum) {
    const double *k = user;
    sum->a = srp_vec3_add_scaled(sum->a, -k[0],
                                 srp_vec3_make(state->r.x, 4.0 * state->r.y, 9.0 * state->r.z));
    for (int i = 0; sum->partials && i < 3; ++i) {
        sum->da_dr[i][i] -= k[0] * (i + 1) * (i + 1);
    }
    return 0;
}

/* Frequencies w, 2 w, 3 w along x, y, z. */
static double spring_k[1] = {1e-6};

static srp_force_list *spring_list(void) {
    srp_force_list *list = NULL;
    srp_error error;
    const srp_force force = {"spring", SRP_FORCE_PARTIALS, spring, NULL, spring_k};
    assert_ok(srp_force_list_create(sky, SRP_EARTH, &list, &error), error);
    fixture_add(list, &force);
    return list;
}

static srp_vec3 on_spring(double t) {
    const double w = 1e-3;
    return srp_vec3_make(3e6 * cos(w * t), -2e6 * cos(2.0 * w * t) + 5e5 * sin(2.0 * w * t),
                         1e6 * sin(3.0 * w * t));
}

static void start_spring(srp_propagator *p) {
    start(p, on_spring(0.0), srp_vec3_make(0.0, 5e5 * 2e-3, 1e6 * 3e-3));
}

START_TEST(a_spring_swings) {
    srp_force_list *list = spring_list();
    size_t count;
    const srp_integrator *const *all = srp_integrator_list(&count);
    for (size_t i = 0; i < count; ++i) {
        srp_propagator_params params = srp_propagator_params_default();
        params.integrator = all[i];
        params.partials = true;
        srp_propagator *p = make(list, &params);
        start_spring(p);
        go(p, 20000.0);
        assert_vec3_close(srp_propagator_position(p), on_spring(20000.0), 0.0, 2e-3);
        /* cos and sin again, in the matrix. */
        const double *m = srp_propagator_matrix(p);
        for (int k = 0; k < 3; ++k) {
            const double w = 1e-3 * (k + 1);
            assert_close(m[7 * k], cos(w * 20000.0), 0.0, 1e-7);
            assert_close(m[7 * k + 3], sin(w * 20000.0) / w, 0.0, 1e-4);
        }
        srp_propagator_destroy(p);
    }
    srp_force_list_destroy(list);
}
END_TEST

START_TEST(orders_are_as_promised) {
    srp_force_list *list = spring_list();
    size_t count;
    const srp_integrator *const *all = srp_integrator_list(&count);
    for (size_t i = 0; i < count; ++i) {
        const double longest = all[i]->order == 8 ? 400.0 : 200.0;
        double error[3];
        for (int k = 0; k < 3; ++k) {
            srp_propagator_params params = srp_propagator_params_default();
            params.integrator = all[i];
            params.fixed_step = longest / (1 << k);
            srp_propagator *p = make(list, &params);
            start_spring(p);
            go(p, 8000.0);
            error[k] = srp_vec3_norm(srp_vec3_sub(srp_propagator_position(p), on_spring(8000.0)));
            ck_assert_uint_eq(srp_propagator_get_counts(p).steps,
                              (uint64_t)(8000.0 / params.fixed_step));
            srp_propagator_destroy(p);
        }
        const double seen = log2(error[1] / error[2]);
        printf("%-6s errors %.2g %.2g %.2g m: order %.2f, %d promised\n", all[i]->name, error[0],
               error[1], error[2], seen, all[i]->order);
        ck_assert_msg(seen > all[i]->order - 0.3 && seen < all[i]->order + 1.0, "%s: %g",
                      all[i]->name, seen);
    }
    srp_force_list_destroy(list);
}
END_TEST

START_TEST(energy_stays) {
    srp_force_list *list = fixture_list(sky, false);
    srp_propagator_params params = srp_propagator_params_default();
    srp_propagator *p = make(list, &params);
    srp_vec3 r, v;
    state_of(26600e3, 0.73, &r, &v);
    start(p, r, v);
    const double before = 0.5 * srp_vec3_dot(v, v) - FIXTURE_MU / srp_vec3_norm(r);
    double worst = 0.0;
    for (int day = 1; day <= 10; ++day) {
        go(p, day * DAY);
        r = srp_propagator_position(p);
        v = srp_propagator_velocity(p);
        const double now = 0.5 * srp_vec3_dot(v, v) - FIXTURE_MU / srp_vec3_norm(r);
        worst = fmax(worst, fabs(now / before - 1.0));
    }
    printf("energy of e = 0.73: %.2g relative over 10 days at 1e-12\n", worst);
    assert_close(worst, 0.0, 0.0, 1e-11);
    srp_propagator_destroy(p);
    srp_force_list_destroy(list);
}
END_TEST

static srp_force_list *full_list(void) {
    srp_force_list *list = fixture_list(sky, true);
    srp_force force;
    srp_attitude attitude;
    srp_error error;
    const srp_attitude_pointing yaw = {SRP_TARGET_NADIR, {0, 0, 1}, SRP_TARGET_SUN, {1, 0, 0}};
    assert_ok(srp_attitude_pointing_create(&yaw, &attitude, &error), error);
    const srp_radiation_params params = fixture_radiation(&attitude);
    assert_ok(srp_force_radiation(&params, &force, &error), error);
    fixture_add(list, &force);
    return list;
}

/* GEO at the equinox, with Sun, Moon, light and shadows. */
START_TEST(there_and_back) {
    srp_force_list *list = full_list();
    srp_propagator_params params = srp_propagator_params_default();
    params.tolerance = 1e-14;
    params.shadow_edges = true;
    params.shadow = fixture_radiation(NULL).shadow;
    srp_propagator *p = make(list, &params);
    const srp_vec3 r = {36607358.26, -20921723.7, 1234.5}, v = {1525.6345, 2669.4515, 12.3456};
    start(p, r, v);
    go(p, 10.0 * DAY);
    const srp_propagator_counts there = srp_propagator_get_counts(p);
    ck_assert_uint_gt(there.cut, 30); /* 10 eclipses */
    go(p, 0.0);
    const double off = srp_vec3_norm(srp_vec3_sub(srp_propagator_position(p), r));
    printf("10 days there and back in GEO, with %llu shadow edges: %.3f mm\n",
           (unsigned long long)there.cut, 1e3 * off);
    assert_close(off, 0.0, 0.0, 1e-3);
    /* What was pushed forth is pulled back. */
    assert_close(srp_propagator_impulse(p), 0.0, 0.0, 1e-9);
    srp_propagator_destroy(p);
    srp_force_list_destroy(list);
}
END_TEST

/* ---- Partials ----------------------------------------------------------------------------------
 */

static void end_of(srp_propagator *p, const double y[6], double end, double out[6]) {
    start(p, srp_vec3_make(y[0], y[1], y[2]), srp_vec3_make(y[3], y[4], y[5]));
    go(p, end);
    const srp_vec3 r = srp_propagator_position(p), v = srp_propagator_velocity(p);
    const double all[6] = {r.x, r.y, r.z, v.x, v.y, v.z};
    memcpy(out, all, sizeof all);
}

/* Half a day through an eclipse, all forces; metres and m/s scaled to the orbit's own size. */
START_TEST(the_matrix_is_that_of_differences) {
    srp_force_list *list = full_list();
    srp_propagator_params params = srp_propagator_params_default();
    params.tolerance = 1e-13;
    params.shadow_edges = true;
    params.shadow = fixture_radiation(NULL).shadow;
    srp_propagator *plain = make(list, &params);
    params.partials = true;
    srp_propagator *p = make(list, &params);
    const double y[6] = {36607358.26, -20921723.7, 1234.5, 1525.6345, 2669.4515, 12.3456};
    const double scale[6] = {4.2e7, 4.2e7, 4.2e7, 3.07e3, 3.07e3, 3.07e3};
    const double end = 60000.0;
    double out[6], off = 0.0, size = 0.0;
    end_of(p, y, end, out);
    ck_assert_uint_eq(srp_propagator_get_counts(p).cut, 4);
    const double *m = srp_propagator_matrix(p);
    for (int j = 0; j < 6; ++j) {
        /* Richardson's: what is cut off is of the fourth order. */
        double column[6] = {0};
        for (int k = 1; k <= 2; ++k) {
            const double h = k * 3e-6;
            double up[6], down[6], moved[6];
            memcpy(moved, y, sizeof moved);
            moved[j] = y[j] + h * scale[j];
            end_of(plain, moved, end, up);
            moved[j] = y[j] - h * scale[j];
            end_of(plain, moved, end, down);
            for (int i = 0; i < 6; ++i) {
                column[i] += (k == 1 ? 4.0 : -1.0) / 3.0 * (up[i] - down[i]) / (2.0 * h * scale[i]);
            }
        }
        for (int i = 0; i < 6; ++i) {
            off = fmax(off, fabs(column[i] - m[6 * i + j] * scale[j] / scale[i]));
            size = fmax(size, fabs(column[i]));
        }
    }
    printf("state transition: %.2g of its largest entry (%.3g) from differences\n", off / size,
           size);
    assert_close(off / size, 0.0, 0.0, 1e-6);
    srp_propagator_destroy(p);
    srp_propagator_destroy(plain);
    srp_force_list_destroy(list);
}
END_TEST

/* Phi(b <- a) of a Hamiltonian flow keeps areas: det = 1. */
START_TEST(the_matrix_has_determinant_one) {
    srp_force_list *list = fixture_list(sky, true);
    srp_propagator_params params = srp_propagator_params_default();
    params.partials = true;
    srp_propagator *p = make(list, &params);
    srp_vec3 r, v;
    state_of(42164e3, 0.2, &r, &v);
    start(p, r, v);
    go(p, 3.0 * DAY);
    double m[6][6], det = 1.0;
    memcpy(m, srp_propagator_matrix(p), sizeof m);
    for (int i = 0; i < 6; ++i) { /* metres and m/s of like size */
        for (int j = 0; j < 6; ++j) {
            m[i][j] *= (i < 3 ? 1e-4 : 1.0) * (j < 3 ? 1e4 : 1.0);
        }
    }
    for (int k = 0; k < 6; ++k) {
        int best = k;
        for (int i = k + 1; i < 6; ++i) {
            best = fabs(m[i][k]) > fabs(m[best][k]) ? i : best;
        }
        det *= best == k ? 1.0 : -1.0;
        for (int j = 0; j < 6; ++j) {
            const double swap = m[k][j];
            m[k][j] = m[best][j];
            m[best][j] = swap;
        }
        det *= m[k][k];
        for (int i = k + 1; i < 6; ++i) {
            const double factor = m[i][k] / m[k][k];
            for (int j = k; j < 6; ++j) {
                m[i][j] -= factor * m[k][j];
            }
        }
    }
    assert_close(det, 1.0, 1e-7, 0.0);
    srp_propagator_destroy(p);
    srp_force_list_destroy(list);
}
END_TEST

/* ---- Failures ----------------------------------------------------------------------------------
 */

static int moody(const void *user, const srp_force_state *state, srp_force_sum *sum) {
    (void)sum;
    const double *limits = user;
    if (state->t > limits[1]) {
        return -1;
    }
    return state->t > limits[0] ? 1 : 0;
}

START_TEST(forces_can_stop_and_ask_for_less) {
    /* Refused past 5000 s: the step shrinks until it cannot. Stopped past 5000 s: at once. */
    for (int kind = 0; kind < 2; ++kind) {
        double limits[2] = {kind == 0 ? 5000.0 : INFINITY, kind == 1 ? 5000.0 : INFINITY};
        srp_force_list *list = fixture_list(sky, false);
        const srp_force force = {"moody", 0, moody, NULL, limits};
        fixture_add(list, &force);
        srp_propagator_params params = srp_propagator_params_default();
        srp_propagator *p = make(list, &params);
        srp_vec3 r, v;
        srp_error error;
        state_of(42164e3, 0.1, &r, &v);
        start(p, r, v);
        go(p, 4000.0);
        ck_assert_int_eq(srp_propagator_advance(p, 6000.0, NULL, &error), SRP_BAD_DATA);
        const double t = srp_propagator_time(p);
        ck_assert(t >= 4000.0 && t <= 5000.0 && (kind == 1 || t > 4999.0));
        ck_assert(srp_vec3_is_finite(srp_propagator_position(p)));
        params.partials = true;
        srp_propagator *none = NULL;
        ck_assert_int_eq(srp_propagator_create(list, &params, &none, &error), SRP_UNSUPPORTED);
        ck_assert(none == NULL);
        srp_propagator_destroy(p);
        srp_force_list_destroy(list);
    }
}
END_TEST

static bool stop_at_noon(void *user, double t) {
    (void)user;
    return t < 0.5 * DAY;
}

START_TEST(it_can_be_cancelled_and_goes_on) {
    srp_force_list *list = fixture_list(sky, false);
    srp_propagator_params params = srp_propagator_params_default();
    srp_propagator *p = make(list, &params);
    const srp_propagator_watch watch = {NULL, stop_at_noon, NULL};
    srp_vec3 r, v;
    srp_error error;
    state_of(42164e3, 0.1, &r, &v);
    start(p, r, v);
    ck_assert_int_eq(srp_propagator_advance(p, DAY, &watch, &error), SRP_CANCELLED);
    ck_assert(srp_propagator_time(p) >= 0.5 * DAY && srp_propagator_time(p) < DAY);
    go(p, DAY);
    assert_ok(srp_elements_kepler(FIXTURE_MU, DAY, &r, &v, &error), error);
    assert_vec3_close(srp_propagator_position(p), r, 0.0, 2e-3);
    srp_propagator_destroy(p);
    srp_force_list_destroy(list);
}
END_TEST

START_TEST(bad_arguments_are_refused) {
    srp_force_list *list = fixture_list(sky, false);
    srp_error error;
    srp_propagator *p = NULL;
    for (int i = 0; i < 6; ++i) {
        srp_propagator_params params = srp_propagator_params_default();
        *(i == 0   ? &params.tolerance
          : i == 1 ? &params.fixed_step
          : i == 2 ? &params.first_step
          : i == 3 ? &params.max_step
                   : &params.tolerance) = i == 4 ? NAN : -1.0;
        if (i == 5) {
            params.tolerance = 1e-12;
            params.integrator = NULL;
        }
        ck_assert_int_eq(srp_propagator_create(list, &params, &p, &error), SRP_BAD_ARGUMENT);
    }
    ck_assert(p == NULL);
    const srp_propagator_params params = srp_propagator_params_default();
    p = make(list, &params);
    ck_assert_int_eq(srp_propagator_advance(p, 1.0, NULL, &error), SRP_BAD_ARGUMENT);
    ck_assert_int_eq(
        srp_propagator_start(p, 0.0, srp_vec3_make(0, 0, 0), srp_vec3_make(1, 0, 0), &error),
        SRP_BAD_ARGUMENT);
    ck_assert_int_eq(
        srp_propagator_start(p, 0.0, srp_vec3_make(NAN, 0, 0), srp_vec3_make(1, 0, 0), &error),
        SRP_BAD_ARGUMENT);
    ck_assert(srp_propagator_matrix(p) == NULL);
    ck_assert(srp_integrator_find("euler") == NULL);
    ck_assert(srp_integrator_find("rkf45") == &srp_integrator_rkf45);
    srp_propagator_destroy(p);
    srp_propagator_destroy(NULL);
    srp_force_list_destroy(list);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("orbit_propagator");
    TCase *all = tcase_create("propagator");
    tcase_add_checked_fixture(all, set_up, tear_down);
    tcase_add_test(all, elements_and_states_are_inverse);
    tcase_add_test(all, two_bodies_follow_kepler);
    tcase_add_test(all, a_spring_swings);
    tcase_add_test(all, orders_are_as_promised);
    tcase_add_test(all, energy_stays);
    tcase_add_test(all, there_and_back);
    tcase_add_test(all, the_matrix_is_that_of_differences);
    tcase_add_test(all, the_matrix_has_determinant_one);
    tcase_add_test(all, forces_can_stop_and_ask_for_less);
    tcase_add_test(all, it_can_be_cancelled_and_goes_on);
    tcase_add_test(all, bad_arguments_are_refused);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
