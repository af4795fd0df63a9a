/* SPDX-License-Identifier: Apache-2.0 */
/* Polynomials of the sky beside ERFA's series, and the axes of the Earth. */
#include "srp_check.h"

#include <srp/orbit/ephemeris.h>

#include <erfa.h>
#include <erfam.h>

static srp_epoch epoch_of(const char *text) {
    srp_epoch epoch;
    srp_error error;
    assert_ok(srp_epoch_parse(text, &epoch, NULL, &error), error);
    return epoch;
}

static srp_ephemeris *make(double days, bool orientation) {
    srp_ephemeris_params params = srp_ephemeris_params_default(epoch_of("2024-02-11T03:00:00 UTC"));
    srp_ephemeris *out = NULL;
    srp_error error;
    params.end = days * 86400.0;
    params.bodies = (1u << SRP_CELESTIAL_COUNT) - 1;
    params.orientation = orientation;
    params.ut1_minus_utc = -0.0123;
    params.pole_x = 4e-7;
    params.pole_y = 1.7e-6;
    assert_ok(srp_ephemeris_create(&params, &out, &error), error);
    return out;
}

static srp_vec3 au(double pv[2][3], double sign) {
    return srp_vec3_make(sign * pv[0][0] * ERFA_DAU, sign * pv[0][1] * ERFA_DAU,
                         sign * pv[0][2] * ERFA_DAU);
}

START_TEST(polynomials_follow_the_series) {
    srp_ephemeris *sky = make(37.3, false);
    double worst[SRP_CELESTIAL_COUNT] = {0};
    uint64_t random = 3;
    for (int i = 0; i < 400; ++i) {
        const double t = 37.3 * 86400.0 * random_unit(&random);
        double jd, fraction, pv[2][3], other[2][3];
        srp_epoch_julian(srp_epoch_add(srp_ephemeris_epoch(sky), t), SRP_TIME_TDB, &jd, &fraction);
        eraEpv00(jd, fraction, pv, other);
        const srp_vec3 sun = au(pv, -1.0);
        for (int body = 0; body < SRP_CELESTIAL_COUNT; ++body) {
            srp_vec3 want = sun;
            if (body == SRP_EARTH) {
                want = srp_vec3_make(0, 0, 0);
            } else if (body == SRP_MOON) {
                eraMoon98(jd, fraction, pv);
                want = au(pv, 1.0);
            } else if (body != SRP_SUN) {
                eraPlan94(jd, fraction, body, pv);
                want = srp_vec3_add(sun, au(pv, 1.0));
            }
            const srp_vec3 got = srp_ephemeris_position(sky, (srp_celestial)body, t);
            worst[body] = fmax(worst[body], srp_vec3_norm(srp_vec3_sub(got, want)));
        }
    }
    for (int body = 0; body < SRP_CELESTIAL_COUNT; ++body) {
        printf("%-8s %.2g m from the series\n", srp_celestial_get((srp_celestial)body)->name,
               worst[body]);
    }
    assert_close(worst[SRP_MOON], 0.0, 0.0, 1e-3);
    assert_close(worst[SRP_SUN], 0.0, 0.0, 0.1);
    for (int body = SRP_MERCURY; body <= SRP_NEPTUNE; ++body) {
        /* A date in double resolves 1e-9 of a second, in which Mercury moves by 50 um; and 1e12 m
         * in double 1e-4 m. */
        assert_close(worst[body], 0.0, 0.0, 0.2);
    }
    srp_ephemeris_destroy(sky);
}
END_TEST

START_TEST(outside_the_span_the_series_are_summed) {
    srp_ephemeris *brief = make(1.0, true), *longer = make(12.0, true);
    for (double t = 86400.0; t < 1e6; t += 123456.7) {
        assert_vec3_close(srp_ephemeris_position(brief, SRP_MOON, t),
                          srp_ephemeris_position(longer, SRP_MOON, t), 0.0, 1e-3);
        double a[3][3], b[3][3];
        srp_ephemeris_earth_axes(brief, t, a);
        srp_ephemeris_earth_axes(longer, t, b);
        for (int i = 0; i < 9; ++i) {
            assert_close(a[i / 3][i % 3], b[i / 3][i % 3], 0.0, 1e-14);
        }
    }
    srp_ephemeris_destroy(brief);
    srp_ephemeris_destroy(longer);
}
END_TEST

START_TEST(any_body_can_be_the_centre) {
    srp_ephemeris *sky = make(2.0, false);
    for (int central = 0; central < SRP_CELESTIAL_COUNT; ++central) {
        srp_vec3 all[SRP_CELESTIAL_COUNT];
        srp_ephemeris_positions(sky, (srp_celestial)central, 54321.0, all);
        assert_close(srp_vec3_norm(all[central]), 0.0, 0.0, 0.0);
        for (int body = 0; body < SRP_CELESTIAL_COUNT; ++body) {
            const srp_vec3 want =
                srp_vec3_sub(srp_ephemeris_position(sky, (srp_celestial)body, 54321.0),
                             srp_ephemeris_position(sky, (srp_celestial)central, 54321.0));
            assert_vec3_close(all[body], want, 1e-15, 0.0);
        }
    }
    srp_ephemeris_destroy(sky);
}
END_TEST

/* The whole chain of ERFA at once. */
START_TEST(axes_are_those_of_erfa) {
    srp_ephemeris *sky = make(5.0, true);
    for (double t = 0.0; t < 4.3e5; t += 31234.5) {
        const srp_epoch now = srp_epoch_add(srp_ephemeris_epoch(sky), t);
        double tt[2], utc[2], want[3][3], got[3][3];
        srp_epoch_julian(now, SRP_TIME_TT, &tt[0], &tt[1]);
        srp_epoch_julian(now, SRP_TIME_UTC, &utc[0], &utc[1]);
        eraC2t06a(tt[0], tt[1], utc[0], utc[1] - 0.0123 / 86400.0, 4e-7, 1.7e-6, want);
        srp_ephemeris_earth_axes(sky, t, got);
        for (int i = 0; i < 9; ++i) {
            assert_close(got[i / 3][i % 3], want[i / 3][i % 3], 0.0, 1e-13);
        }
    }
    srp_ephemeris_destroy(sky);
}
END_TEST

START_TEST(what_is_not_there_is_nan) {
    srp_ephemeris_params params = srp_ephemeris_params_default(epoch_of("2024-02-11 UTC"));
    srp_ephemeris *sky = NULL;
    srp_error error;
    assert_ok(srp_ephemeris_create(&params, &sky, &error), error);
    ck_assert(isnan(srp_ephemeris_position(sky, SRP_MOON, 0.0).x));
    ck_assert(isnan(srp_ephemeris_position(sky, (srp_celestial)99, 0.0).x));
    double axes[3][3];
    srp_ephemeris_earth_axes(sky, 0.0, axes);
    ck_assert(isnan(axes[1][1]));
    srp_ephemeris_destroy(sky);
    srp_ephemeris *const untouched = NULL;
    sky = untouched;
    params.end = params.begin;
    ck_assert_int_eq(srp_ephemeris_create(&params, &sky, &error), SRP_BAD_ARGUMENT);
    params.end = NAN;
    ck_assert_int_eq(srp_ephemeris_create(&params, &sky, &error), SRP_BAD_ARGUMENT);
    ck_assert(sky == untouched);
    srp_ephemeris_destroy(NULL);
}
END_TEST

START_TEST(names_are_found) {
    srp_celestial body = SRP_SUN;
    ck_assert(srp_celestial_find("moon", &body) && body == SRP_MOON);
    ck_assert(!srp_celestial_find("Moon", &body) && body == SRP_MOON);
    ck_assert(srp_celestial_get((srp_celestial)-1) == NULL);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("orbit_ephemeris");
    TCase *all = tcase_create("ephemeris");
    tcase_add_test(all, polynomials_follow_the_series);
    tcase_add_test(all, outside_the_span_the_series_are_summed);
    tcase_add_test(all, any_body_can_be_the_centre);
    tcase_add_test(all, axes_are_those_of_erfa);
    tcase_add_test(all, what_is_not_there_is_nan);
    tcase_add_test(all, names_are_found);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
