/* SPDX-License-Identifier: Apache-2.0 */
/* Acceleration and its partials beside closed forms and differences; GMAT's look-up. */
#include "interp_fixture.h"
#include "srp_check.h"

#include <srp/acceleration.h>
#include <srp/spad.h>

#include <math.h>
#include <stdlib.h>

static const double EARTH = 6378136.3;

/* A rotation about a skew axis, to rounding. */
static void set_matrix(double matrix[3][3], double angle) {
    const srp_vec3 n = {0.36, -0.48, 0.8};
    const double c = cos(angle), s = sin(angle), k = 1.0 - c;
    const double rows[3][3] = {
        {c + n.x * n.x * k, n.x * n.y * k - n.z * s, n.x * n.z * k + n.y * s},
        {n.y * n.x * k + n.z * s, c + n.y * n.y * k, n.y * n.z * k - n.x * s},
        {n.z * n.x * k - n.y * s, n.z * n.y * k + n.x * s, c + n.z * n.z * k}};
    for (int i = 0; i < 9; ++i) {
        matrix[i / 3][i % 3] = rows[i / 3][i % 3];
    }
}

/* Where the Sun and the Earth are, as seen from the place `r` around the Earth. */
typedef struct place {
    srp_vec3 sun;
    srp_body earth;
} place;

static const srp_vec3 SUN = {-1.21e11, 0.83e11, 0.31e11};

static place place_at(srp_vec3 r) {
    place at = {srp_vec3_sub(SUN, r), {srp_vec3_scale(-1.0, r), EARTH}};
    return at;
}

static srp_acceleration_state state_at(const place *at) {
    srp_acceleration_state state = {at->sun, 1, &at->earth, {{0}}, 731.4};
    set_matrix(state.matrix, 0.83);
    return state;
}

static srp_acceleration_params params_of(double scale) {
    srp_acceleration_params params = srp_acceleration_params_default();
    params.scale = scale;
    return params;
}

/* In full sunlight, and where this share of the Sun's diameter is behind the Earth. */
static srp_vec3 sunny(void) {
    return srp_vec3_make(3.1e7, -2.3e7, 1.7e7);
}
static srp_vec3 penumbral(double share) {
    const double distance = 4.2164e7, d = srp_vec3_norm(SUN);
    const srp_vec3 n = srp_vec3_scale(1.0 / d, SUN);
    srp_vec3 u = srp_vec3_cross(n, srp_vec3_make(0.31, 0.57, -0.76));
    u = srp_vec3_scale(1.0 / srp_vec3_norm(u), u);
    const double angle =
        asin(EARTH / distance) + (1.0 - 2.0 * share) * asin(SRP_SUN_RADIUS / (d + distance));
    return srp_vec3_add(srp_vec3_scale(-distance * cos(angle), n),
                        srp_vec3_scale(distance * sin(angle), u));
}

/* A cannonball: look-ups of a + M s are exact. */
static field_value ball(srp_vec3 s) {
    field_value value = {srp_vec3_scale(-23.7, s), {0, 0, 0}};
    return value;
}

START_TEST(a_ball_is_pushed_by_the_closed_form) {
    srp_interp *interp = field_interp(&srp_interp_bicubic, 36, 18, ball);
    const srp_acceleration_params params = params_of(1.07);
    const place at = place_at(sunny());
    const srp_acceleration_state state = state_at(&at);
    srp_vec3 a;
    double da[3][3];
    srp_error error;
    assert_ok(
        srp_acceleration_eval(&params, srp_area_source_interp(interp), &state, &a, da, &error),
        error);
    /* a = -k sun / |sun|^3, its gradient k (1 - 3 s s^T) / |sun|^3. */
    const double d = srp_vec3_norm(at.sun);
    const double k = 1.07 * 23.7 / 731.4 * 1367.0 / 299792458.0 * SRP_AU * SRP_AU;
    assert_vec3_close(a, srp_vec3_scale(-k / (d * d * d), at.sun), 1e-13, 0.0);
    const double s[3] = {at.sun.x / d, at.sun.y / d, at.sun.z / d};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            assert_close(da[i][j], k / (d * d * d) * ((i == j) - 3.0 * s[i] * s[j]), 1e-10,
                         1e-13 * k / (d * d * d));
        }
    }
    srp_interp_destroy(interp);
}
END_TEST

/* Largest difference between the partials and central differences over `step`, over the largest. */
static double partials_off(srp_area_source source, srp_vec3 r, double step) {
    const srp_acceleration_params params = params_of(1.0);
    srp_error error;
    srp_vec3 a;
    double da[3][3], off = 0.0, size = 0.0;
    place at = place_at(r);
    srp_acceleration_state state = state_at(&at);
    assert_ok(srp_acceleration_eval(&params, source, &state, &a, da, &error), error);
    for (int j = 0; j < 3; ++j) {
        srp_vec3 up, down;
        const srp_vec3 h = {j == 0 ? step : 0.0, j == 1 ? step : 0.0, j == 2 ? step : 0.0};
        at = place_at(srp_vec3_add(r, h));
        state = state_at(&at);
        assert_ok(srp_acceleration_eval(&params, source, &state, &up, NULL, &error), error);
        at = place_at(srp_vec3_sub(r, h));
        state = state_at(&at);
        assert_ok(srp_acceleration_eval(&params, source, &state, &down, NULL, &error), error);
        const double slope[3] = {(up.x - down.x) / (2.0 * step), (up.y - down.y) / (2.0 * step),
                                 (up.z - down.z) / (2.0 * step)};
        for (int i = 0; i < 3; ++i) {
            off = fmax(off, fabs(slope[i] - da[i][j]));
            size = fmax(size, fabs(da[i][j]));
        }
    }
    return off / size;
}

START_TEST(partials_are_those_of_differences) {
    srp_interp *interp = field_interp(&srp_interp_spline, 72, 36, smooth_field);
    const srp_area_source source = srp_area_source_interp(interp);
    ck_assert_double_le(partials_off(source, sunny(), 1e6), 1e-7);
    /* Near the end of its penumbra, too; its slope is 1e5 times the rest. */
    for (int i = 1; i < 10; ++i) {
        ck_assert_double_le(partials_off(source, penumbral(0.1 * i), 100.0), 1e-5);
    }
    srp_interp_destroy(interp);
}
END_TEST

static srp_status no_answer(const void *user, srp_vec3 s, srp_vec3 *f, double (*df)[3],
                            srp_error *error) {
    (void)s, (void)f, (void)df;
    error->message[0] = '\0';
    ++*(int *)(uintptr_t)user;
    return SRP_NO_MEMORY;
}

START_TEST(in_the_dark_nobody_is_asked) {
    int asked = 0;
    const srp_area_source source = {no_answer, &asked};
    const srp_acceleration_params params = params_of(1.0);
    const place dark = place_at(penumbral(1.01)), bright = place_at(sunny());
    srp_acceleration_state state = state_at(&dark);
    srp_vec3 a = {1, 2, 3};
    double da[3][3] = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
    srp_error error;
    assert_ok(srp_acceleration_eval(&params, source, &state, &a, da, &error), error);
    ck_assert_int_eq(asked, 0);
    assert_vec3_close(a, srp_vec3_make(0, 0, 0), 0.0, 0.0);
    ck_assert_double_eq(da[2][1], 0.0);
    /* What the source says comes through, and nothing else is touched. */
    state = state_at(&bright);
    a = srp_vec3_make(1, 2, 3);
    ck_assert_int_eq(srp_acceleration_eval(&params, source, &state, &a, da, &error), SRP_NO_MEMORY);
    ck_assert_int_eq(asked, 1);
    assert_vec3_close(a, srp_vec3_make(1, 2, 3), 0.0, 0.0);
}
END_TEST

START_TEST(bad_states_are_refused) {
    const place at = place_at(sunny());
    const srp_acceleration_params params = params_of(1.0);
    const srp_acceleration_state good = state_at(&at);
    srp_acceleration_state bad[8];
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
        bad[i] = good;
    }
    bad[0].mass = 0.0;
    bad[1].mass = NAN;
    bad[2].sun = srp_vec3_make(0, 0, 0);
    bad[3].sun.y = INFINITY;
    bad[4].matrix[1][0] += 1e-3;
    bad[5].matrix[2][2] = NAN;
    bad[6].count = SRP_ACCELERATION_BODIES_MAX + 1;
    const srp_body shrunk = {at.earth.position, -1.0};
    bad[7].bodies = &shrunk;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
        srp_acceleration_lighting light = {.distance = -4.5};
        srp_error error;
        ck_assert_msg(srp_acceleration_light(&params, &bad[i], &light, &error) == SRP_BAD_ARGUMENT,
                      "state %zu passes", i);
        ck_assert(error.message[0] != '\0');
        ck_assert_double_eq(light.distance, -4.5);
    }
    srp_error error;
    srp_acceleration_lighting light;
    const srp_acceleration_params dim = params_of(NAN);
    ck_assert_int_eq(srp_acceleration_light(&dim, &good, &light, &error), SRP_BAD_ARGUMENT);
    assert_ok(srp_acceleration_light(&params, &good, &light, &error), error);
    assert_close(srp_vec3_norm(light.s_body), 1.0, 1e-15, 0.0);
}
END_TEST

/* ---- GMAT's look-up -------------------------------------------------------------------------- */

START_TEST(gmat_look_up_meets_nodes_and_differences) {
    srp_table *table = field_table(36, 18, false, smooth_field);
    const srp_grid grid = srp_table_grid(table);
    uint64_t random = 5;
    for (int cubic = 0; cubic < 2; ++cubic) {
        srp_spad *spad = NULL;
        srp_error error;
        srp_vec3 f, up, down;
        double df[3][3];
        assert_ok(srp_spad_create(table, cubic != 0, &spad, &error), error);
        assert_ok(srp_spad_eval(spad, srp_grid_direction(grid, 7, 4), &f, NULL, &error), error);
        assert_vec3_close(f, srp_table_node(table, 7, 4)->f, 1e-13, 0.0);
        for (int k = 0; k < 50; ++k) {
            const srp_vec3 s = random_direction(&random);
            const srp_vec3 to = random_direction(&random);
            srp_vec3 along = srp_vec3_cross(s, to);
            along = srp_vec3_scale(1.0 / srp_vec3_norm(along), along);
            assert_ok(srp_spad_eval(spad, s, &f, df, &error), error);
            assert_ok(srp_spad_eval(spad, turned_towards(s, along, 1e-7), &up, NULL, &error),
                      error);
            assert_ok(srp_spad_eval(spad, turned_towards(s, along, -1e-7), &down, NULL, &error),
                      error);
            const srp_vec3 slope = srp_vec3_scale(0.5e7, srp_vec3_sub(up, down));
            const srp_vec3 got = {df[0][0] * along.x + df[0][1] * along.y + df[0][2] * along.z,
                                  df[1][0] * along.x + df[1][1] * along.y + df[1][2] * along.z,
                                  df[2][0] * along.x + df[2][1] * along.y + df[2][2] * along.z};
            assert_vec3_close(got, slope, 1e-5, 1e-5);
        }
        ck_assert_int_eq(srp_spad_eval(spad, srp_vec3_make(NAN, 0, 1), &f, NULL, &error),
                         SRP_BAD_ARGUMENT);
        srp_spad_destroy(spad);
    }
    srp_table_destroy(table);
}
END_TEST

START_TEST(gmat_look_up_wants_enough_nodes) {
    srp_table *small = field_table(4, 2, false, smooth_field);
    srp_spad *spad = NULL;
    srp_error error;
    ck_assert_int_eq(srp_spad_create(small, true, &spad, &error), SRP_BAD_ARGUMENT);
    ck_assert_ptr_null(spad);
    assert_ok(srp_spad_create(small, false, &spad, &error), error);
    srp_spad_destroy(spad);
    srp_spad_destroy(NULL);
    srp_table_destroy(small);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("acceleration");
    TCase *tcase = tcase_create("acceleration");
    tcase_add_test(tcase, a_ball_is_pushed_by_the_closed_form);
    tcase_add_test(tcase, partials_are_those_of_differences);
    tcase_add_test(tcase, in_the_dark_nobody_is_asked);
    tcase_add_test(tcase, bad_states_are_refused);
    tcase_add_test(tcase, gmat_look_up_meets_nodes_and_differences);
    tcase_add_test(tcase, gmat_look_up_wants_enough_nodes);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
