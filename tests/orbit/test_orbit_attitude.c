/* SPDX-License-Identifier: Apache-2.0 */
/* Attitudes: where body axes point. */
#include "mat3.h"
#include "srp_check.h"

#include <srp/const.h>
#include <srp/orbit/attitude.h>

#include <stdio.h>
#include <string.h>

static srp_vec3 bodies[SRP_CELESTIAL_COUNT];

static srp_force_state state_at(double t) {
    bodies[SRP_SUN] = srp_vec3_make(1.21e11, -0.83e11, 0.31e11);
    srp_force_state state = {t, {3.1e7, -2.2e7, 1.7e7}, {1.3e3, 2.6e3, 0.4e3}, bodies};
    return state;
}

#define M(m) ((const double(*)[3])(m))

static void check_rotation(double m[3][3]) {
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            double dot = 0.0;
            for (int k = 0; k < 3; ++k) {
                dot += m[i][k] * m[j][k];
            }
            assert_close(dot, i == j, 0.0, 1e-14);
        }
    }
    const srp_vec3 x = {m[0][0], m[0][1], m[0][2]}, y = {m[1][0], m[1][1], m[1][2]};
    const srp_vec3 z = {m[2][0], m[2][1], m[2][2]};
    assert_vec3_close(srp_vec3_cross(x, y), z, 1e-14, 0.0);
}

START_TEST(inertial_is_the_quaternion) {
    const double q[4] = {0.2, 0.4, -0.6, 1.3}; /* of any length */
    srp_attitude a;
    srp_error error;
    double m[3][3], later[3][3];
    assert_ok(srp_attitude_inertial(q, &a, &error), error);
    srp_force_state state = state_at(0.0);
    ck_assert_int_eq(a.eval(a.user, &state, m), 0);
    check_rotation(m);
    /* The vector part is the axis, which stays; half the angle has tangent |v| / w. */
    const srp_vec3 axis = srp_unit(srp_vec3_make(0.2, 0.4, -0.6));
    assert_vec3_close(srp_mat3_apply(M(m), axis), axis, 1e-14, 0.0);
    const double angle = 2.0 * atan2(sqrt(0.56), 1.3);
    assert_close(m[0][0] + m[1][1] + m[2][2], 1.0 + 2.0 * cos(angle), 1e-14, 0.0);
    /* Axes turn by +angle, so that vectors seem to turn by -angle. */
    const srp_vec3 side = srp_unit(srp_vec3_cross(axis, srp_axis(0)));
    const srp_vec3 seen = srp_mat3_apply(M(m), side);
    assert_close(srp_vec3_dot(axis, srp_vec3_cross(side, seen)), -sin(angle), 1e-14, 0.0);
    state.t = 1e5;
    ck_assert_int_eq(a.eval(a.user, &state, later), 0);
    ck_assert(memcmp(m, later, sizeof m) == 0);
    srp_attitude_release(&a);
    srp_attitude_release(&a); /* nothing left to do */
}
END_TEST

START_TEST(spinner_turns_about_its_axis) {
    const double q[4] = {0.1, -0.2, 0.3, 0.9};
    const srp_vec3 axis = {1.0, 2.0, -0.5};
    const double rate = 0.0123;
    srp_attitude a;
    srp_error error;
    assert_ok(srp_attitude_spinner(q, axis, rate, &a, &error), error);
    double m0[3][3], m1[3][3];
    srp_force_state state = state_at(0.0);
    ck_assert_int_eq(a.eval(a.user, &state, m0), 0);
    state.t = 97.3;
    ck_assert_int_eq(a.eval(a.user, &state, m1), 0);
    check_rotation(m1);
    /* A star on the axis stands still; another turns backwards about it. */
    const srp_vec3 n = srp_unit(axis), side = srp_unit(srp_vec3_cross(n, srp_axis(2)));
    const srp_vec3 pole = srp_mat3_apply_transposed(M(m0), n);
    const srp_vec3 star = srp_mat3_apply_transposed(M(m0), side);
    assert_vec3_close(srp_mat3_apply(M(m1), pole), n, 1e-14, 0.0);
    const srp_vec3 seen = srp_mat3_apply(M(m1), star);
    assert_close(srp_vec3_dot(side, seen), cos(rate * 97.3), 0, 1e-13);
    assert_close(srp_vec3_dot(n, srp_vec3_cross(side, seen)), -sin(rate * 97.3), 0, 1e-13);
    srp_attitude_release(&a);
}
END_TEST

static void make(srp_target align, srp_vec3 body, srp_target constrain, srp_vec3 second,
                 srp_attitude *out) {
    const srp_attitude_pointing pointing = {align, body, constrain, second};
    srp_error error;
    assert_ok(srp_attitude_pointing_create(&pointing, out, &error), error);
}

START_TEST(pointing_points) {
    srp_attitude a;
    double m[3][3];
    const srp_force_state state = state_at(0.0);
    const srp_vec3 nadir = srp_unit(srp_vec3_scale(-1.0, state.r));
    const srp_vec3 sun = srp_unit(srp_vec3_sub(bodies[SRP_SUN], state.r));
    const srp_vec3 normal = srp_unit(srp_vec3_cross(state.r, state.v));
    /* As GMAT's NadirPointing. */
    make(SRP_TARGET_NADIR, srp_axis(2), SRP_TARGET_ORBIT_NORMAL, srp_axis(1), &a);
    ck_assert_int_eq(a.eval(a.user, &state, m), 0);
    check_rotation(m);
    assert_vec3_close(srp_mat3_apply(M(m), nadir), srp_axis(2), 1e-14, 0.0);
    assert_vec3_close(srp_mat3_apply(M(m), normal), srp_axis(1), 1e-14, 0.0);
    srp_attitude_release(&a);
    /* Yaw steering: +Z down, the Sun in the half plane of +X. */
    make(SRP_TARGET_NADIR, srp_axis(2), SRP_TARGET_SUN, srp_axis(0), &a);
    ck_assert_int_eq(a.eval(a.user, &state, m), 0);
    assert_vec3_close(srp_mat3_apply(M(m), nadir), srp_axis(2), 1e-14, 0.0);
    srp_vec3 s = srp_mat3_apply(M(m), sun);
    assert_close(s.y, 0.0, 0.0, 1e-14);
    ck_assert(s.x > 0.0);
    srp_attitude_release(&a);
    /* Any axes. */
    make(SRP_TARGET_SUN, srp_vec3_make(3, -1, 2), SRP_TARGET_VELOCITY, srp_vec3_make(0, 1, 1), &a);
    ck_assert_int_eq(a.eval(a.user, &state, m), 0);
    check_rotation(m);
    assert_vec3_close(srp_mat3_apply(M(m), sun), srp_unit(srp_vec3_make(3, -1, 2)), 1e-14, 0.0);
    srp_attitude_release(&a);
}
END_TEST

START_TEST(targets_in_line_are_defined) {
    srp_attitude a;
    double m[3][3];
    srp_force_state state = state_at(0.0);
    make(SRP_TARGET_NADIR, srp_axis(2), SRP_TARGET_SUN, srp_axis(0), &a);
    /* Noon and midnight, exactly. */
    for (int sign = -1; sign <= 1; sign += 2) {
        state.r = srp_vec3_scale(sign * 1e-4, bodies[SRP_SUN]);
        ck_assert_int_eq(a.eval(a.user, &state, m), 0);
        check_rotation(m);
    }
    state.v = state.r; /* straight up */
    ck_assert_int_eq(a.eval(a.user, &state, m), 0);
    check_rotation(m);
    srp_attitude_release(&a);
}
END_TEST

START_TEST(bad_arguments_are_refused) {
    const double zero[4] = {0, 0, 0, 0}, q[4] = {0, 0, 0, 1}, bad[4] = {NAN, 0, 0, 1};
    srp_attitude a = {"untouched", 0, NULL, NULL, NULL};
    srp_error error;
    ck_assert_int_eq(srp_attitude_inertial(zero, &a, &error), SRP_BAD_ARGUMENT);
    ck_assert_int_eq(srp_attitude_inertial(bad, &a, &error), SRP_BAD_ARGUMENT);
    ck_assert_int_eq(srp_attitude_spinner(q, srp_vec3_make(0, 0, 0), 1.0, &a, &error),
                     SRP_BAD_ARGUMENT);
    ck_assert_int_eq(srp_attitude_spinner(q, srp_axis(0), NAN, &a, &error), SRP_BAD_ARGUMENT);
    srp_attitude_pointing p = {SRP_TARGET_NADIR, {0, 0, 1}, SRP_TARGET_SUN, {0, 0, -2}};
    ck_assert_int_eq(srp_attitude_pointing_create(&p, &a, &error), SRP_BAD_ARGUMENT);
    p.constrain_body = srp_vec3_make(0, 0, 0);
    ck_assert_int_eq(srp_attitude_pointing_create(&p, &a, &error), SRP_BAD_ARGUMENT);
    p.constrain_body = srp_axis(0);
    p.constrain = SRP_TARGET_NADIR;
    ck_assert_int_eq(srp_attitude_pointing_create(&p, &a, &error), SRP_BAD_ARGUMENT);
    ck_assert_str_eq(a.name, "untouched");
    srp_target target = SRP_TARGET_SUN;
    ck_assert(srp_target_find("orbit_normal", &target) && target == SRP_TARGET_ORBIT_NORMAL);
    ck_assert(!srp_target_find("Sun", &target));
    ck_assert(srp_target_name((srp_target)77) == NULL);
}
END_TEST

/* ---- Attitude ephemeris messages --------------------------------------------------------------
 */

#define AEM_HEAD                                                                                   \
    "CCSDS_AEM_VERS = 1.0\nCREATION_DATE = 2024-03-20T00:00:00\nORIGINATOR = US\n\n"               \
    "META_START\nOBJECT_NAME = SAT\nOBJECT_ID = 2024-001A\nREF_FRAME_A = %s\nREF_FRAME_B = %s\n"   \
    "ATTITUDE_DIR = %s\nTIME_SYSTEM = %s\nSTART_TIME = 2024-03-20T00:00:00\n"                      \
    "STOP_TIME = 2024-03-20T00:02:00\nATTITUDE_TYPE = QUATERNION\nQUATERNION_TYPE = %s\n"          \
    "META_STOP\nDATA_START\n"

static srp_epoch epoch_of(const char *text) {
    srp_epoch epoch;
    srp_error error;
    assert_ok(srp_epoch_parse(text, &epoch, NULL, &error), error);
    return epoch;
}

/* A turn about Z by `angle`, as a row. */
static int aem_row(char *out, const char *date, double angle, bool first) {
    const double s = sin(0.5 * angle), c = cos(0.5 * angle);
    return first ? sprintf(out, "%s %.15f 0 0 %.15f\n", date, c, s)
                 : sprintf(out, "%s 0 0 %.15f %.15f\n", date, s, c);
}

static void check_aem(const char *a, const char *b, const char *dir, bool first, double sense) {
    char text[2000];
    int used = sprintf(text, AEM_HEAD, a, b, dir, "UTC", first ? "FIRST" : "LAST");
    used += aem_row(text + used, "2024-03-20T00:00:00", 0.3, first);
    used += aem_row(text + used, "2024-03-20T00:01:00", 0.7, first);
    used +=
        aem_row(text + used, "2024-03-20T00:02:00", 3.7, first); /* q and -q are the same turn */
    used += sprintf(text + used, "DATA_STOP\n");
    srp_attitude at;
    srp_error error;
    assert_ok(srp_attitude_aem_parse(text, (size_t)used, "t.aem",
                                     epoch_of("2024-03-20T00:00:00 UTC"), &at, &error),
              error);
    const struct {
        double t, angle;
    } want[] = {{0, 0.3}, {15.0, 0.4}, {60.0, 0.7}, {80.0, 1.7}, {120.0, 3.7}};
    for (size_t i = 0; i < 5; ++i) {
        double m[3][3];
        srp_force_state state = state_at(want[i].t);
        ck_assert_int_eq(at.eval(at.user, &state, m), 0);
        assert_close(m[0][0], cos(want[i].angle), 0.0, 1e-12);
        assert_close(m[0][1], sense * sin(want[i].angle), 0.0, 1e-12);
        assert_close(m[2][2], 1.0, 0.0, 1e-12);
    }
    double m[3][3];
    srp_force_state state = state_at(121.0);
    ck_assert_int_lt(at.eval(at.user, &state, m), 0);
    state.t = -1.0;
    ck_assert_int_lt(at.eval(at.user, &state, m), 0);
    srp_attitude_release(&at);
}

START_TEST(aem_says_what_it_means) {
    check_aem("EME2000", "SC_BODY_1", "A2B", false, 1.0);
    check_aem("ICRF", "SC_BODY_1", "A2B", true, 1.0);
    check_aem("EME2000", "SC_BODY_1", "B2A", false, -1.0);
    check_aem("SC_BODY_1", "GCRF", "B2A", false, 1.0);
    check_aem("SC_BODY_1", "EME2000", "A2B", true, -1.0);
}
END_TEST

static void aem_refused(const char *text, srp_status status, size_t line) {
    srp_attitude at = {"untouched", 0, NULL, NULL, NULL};
    srp_error error = {.line = 0};
    const srp_status got = srp_attitude_aem_parse(text, strlen(text), "t.aem",
                                                  epoch_of("2024-03-20T00:00:00 UTC"), &at, &error);
    ck_assert_msg(got == status, "%s%s: %s", text, srp_status_string(got), error.message);
    ck_assert_msg(line == 0 || error.line == line, "line %zu: %s", error.line, error.message);
    ck_assert_str_eq(at.name, "untouched");
}

START_TEST(bad_aem_is_refused) {
    char text[2000];
    aem_refused("", SRP_BAD_FORMAT, 0);
    aem_refused("CCSDS_OEM_VERS = 2.0\n", SRP_BAD_FORMAT, 1);
    aem_refused("CCSDS_AEM_VERS = 1.0\nMETA_START\n", SRP_BAD_FORMAT, 0);
    aem_refused("CCSDS_AEM_VERS = 1.0\nMETA_START\nTIME_SYSTEM = GPS\n", SRP_BAD_FORMAT, 3);
    aem_refused("CCSDS_AEM_VERS = 1.0\nMETA_START\nATTITUDE_DIR = UP\n", SRP_BAD_FORMAT, 3);
    aem_refused("CCSDS_AEM_VERS = 1.0\nMETA_START\nATTITUDE_TYPE = SPIN\n", SRP_UNSUPPORTED, 3);
    aem_refused("CCSDS_AEM_VERS = 1.0\nMETA_START\nMETA_STOP\n", SRP_BAD_FORMAT, 3);
    sprintf(text, AEM_HEAD, "RTN", "SC_BODY_1", "A2B", "UTC", "LAST");
    aem_refused(text, SRP_UNSUPPORTED, 0);
    int used = sprintf(text, AEM_HEAD, "EME2000", "SC_BODY_1", "A2B", "UTC", "LAST");
    strcpy(text + used, "2024-03-20T00:00:00 0 0 0 1\n");
    aem_refused(text, SRP_BAD_FORMAT, 0); /* one alone */
    strcpy(text + used, "2024-03-20T00:00:00 0 0 0 1\n2024-03-20T00:00:00 0 0 0 1\n");
    aem_refused(text, SRP_BAD_DATA, 19);
    strcpy(text + used, "2024-03-20T00:00:00 0 0 0 2\n");
    aem_refused(text, SRP_BAD_DATA, 18);
    strcpy(text + used, "2024-03-20T00:00:00 0 0 1\n");
    aem_refused(text, SRP_BAD_FORMAT, 18);
    strcpy(text + used, "2024-03-40T00:00:00 0 0 0 1\n");
    aem_refused(text, SRP_BAD_DATA, 18);
    strcpy(text + used, "2024-03-20T00:00:00 0 0 0 1 5\n");
    aem_refused(text, SRP_BAD_FORMAT, 18);
    srp_attitude at;
    srp_error error;
    ck_assert_int_eq(srp_attitude_aem_read("no-such.aem", epoch_of("2024-03-20 UTC"), &at, &error),
                     SRP_NOT_FOUND);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("orbit_attitude");
    TCase *all = tcase_create("attitude");
    tcase_add_test(all, inertial_is_the_quaternion);
    tcase_add_test(all, spinner_turns_about_its_axis);
    tcase_add_test(all, pointing_points);
    tcase_add_test(all, targets_in_line_are_defined);
    tcase_add_test(all, bad_arguments_are_refused);
    tcase_add_test(all, aem_says_what_it_means);
    tcase_add_test(all, bad_aem_is_refused);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
