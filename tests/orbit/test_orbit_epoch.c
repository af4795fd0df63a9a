/* SPDX-License-Identifier: Apache-2.0 */
/* Instants: scales, leap seconds, dates that do not exist. */
#include "srp_check.h"

#include <srp/orbit/epoch.h>

#include <string.h>

static srp_epoch parse(const char *text) {
    srp_epoch epoch;
    srp_error error;
    assert_ok(srp_epoch_parse(text, &epoch, NULL, &error), error);
    return epoch;
}

START_TEST(scales_differ_as_they_should) {
    const srp_epoch tai = parse("2024-03-20T12:34:56.789012 TAI");
    /* 37 leap seconds since 2017. */
    assert_close(srp_epoch_difference(parse("2024-03-20T12:34:56.789012 UTC"), tai), 37.0, 0, 1e-9);
    assert_close(srp_epoch_difference(tai, parse("2024-03-20T12:34:56.789012 TT")), 32.184, 0,
                 1e-9);
    assert_close(srp_epoch_difference(tai, parse("2024-03-20T12:34:56.789012 A1")), 0.0343817, 0,
                 1e-9);
    const double tdb = srp_epoch_difference(tai, parse("2024-03-20T12:34:56.789012 TDB"));
    ck_assert_msg(fabs(tdb - 32.184) < 1.7e-3 && tdb != 32.184, "%.9f", tdb);
}
END_TEST

/* GMAT's report of 20 March 2024, 00:00 UTC. */
START_TEST(gmat_counts_days_alike) {
    const srp_epoch epoch = parse("2024-03-20 00:00:00.000 UTC");
    assert_close(srp_epoch_gmat_mjd(epoch, SRP_TIME_A1), 30389.500428638676, 0, 4e-12);
    assert_close(srp_epoch_gmat_mjd(epoch, SRP_TIME_TDB), 30389.500800759328, 0, 4e-12);
}
END_TEST

START_TEST(a_leap_second_is_a_second) {
    const srp_epoch before = parse("2016-12-31T23:59:59.5 UTC");
    const srp_epoch within = parse("2016-12-31T23:59:60.25 UTC");
    const srp_epoch after = parse("2017-01-01T00:00:00 UTC");
    assert_close(srp_epoch_difference(within, before), 0.75, 0, 1e-9);
    assert_close(srp_epoch_difference(after, within), 0.75, 0, 1e-9);
    char text[SRP_EPOCH_TEXT_SIZE];
    ck_assert_str_eq(srp_epoch_format(within, SRP_TIME_UTC, 2, text), "2016-12-31T23:59:60.25");
}
END_TEST

START_TEST(what_is_written_reads_back) {
    const srp_epoch start = parse("1999-12-28T22:11:00.123456789 TDB");
    uint64_t random = 7;
    for (int scale = 0; scale < SRP_TIME_SCALE_COUNT; ++scale) {
        for (int i = 0; i < 300; ++i) {
            char text[SRP_EPOCH_TEXT_SIZE];
            const srp_epoch epoch = srp_epoch_add(start, 6e8 * random_unit(&random));
            srp_epoch_format(epoch, (srp_time_scale)scale, 9, text);
            srp_epoch back;
            srp_error error;
            assert_ok(srp_epoch_parse_in(text, (srp_time_scale)scale, &back, NULL, &error), error);
            assert_close(srp_epoch_difference(back, epoch), 0.0, 0.0, 2e-9);
        }
    }
    /* Rounded to a minute that is the next one. */
    char text[SRP_EPOCH_TEXT_SIZE];
    srp_epoch_format(parse("2024-02-28T23:59:59.9996 TAI"), SRP_TIME_TAI, 3, text);
    ck_assert_str_eq(text, "2024-02-29T00:00:00.000");
}
END_TEST

static void refused(const char *text, srp_status status, const char *words) {
    srp_error error;
    srp_epoch epoch = {1.5, 2.5};
    ck_assert_msg(srp_epoch_parse(text, &epoch, NULL, &error) == status, "%s", text);
    ck_assert_msg(strstr(error.message, words) != NULL, "%s: %s", text, error.message);
    ck_assert(epoch.jd == 1.5 && epoch.s == 2.5);
}

START_TEST(nonsense_is_refused) {
    refused("", SRP_BAD_FORMAT, "expected a date");
    refused("yesterday UTC", SRP_BAD_FORMAT, "expected a date");
    refused("2024-03-20T00:00:00", SRP_BAD_FORMAT, "expected a date");
    refused("2024-3-20 UTC", SRP_BAD_FORMAT, "expected a date");
    refused("2024-03-20T00:00:00 GPS", SRP_BAD_FORMAT, "no time scale");
    refused("2024-03-20T00:00:00 UTC now", SRP_BAD_FORMAT, "no time scale");
    refused("2023-02-29 UTC", SRP_BAD_DATA, "no such date");
    refused("2024-13-01 TAI", SRP_BAD_DATA, "no such date");
    refused("2024-06-31T00:00 UTC", SRP_BAD_DATA, "no such date");
    refused("2024-03-20T24:00:01 UTC", SRP_BAD_DATA, "no such date");
    refused("2024-03-20T23:60:00 TT", SRP_BAD_DATA, "no such date");
    /* No leap second was put in there. */
    refused("2024-03-20T23:59:60 UTC", SRP_BAD_DATA, "no such date");
    refused("2016-12-31T23:59:61.5 UTC", SRP_BAD_DATA, "no such date");
}
END_TEST

START_TEST(dates_beyond_the_leap_seconds_are_marked) {
    srp_epoch epoch;
    srp_error error;
    bool beyond;
    assert_ok(srp_epoch_parse("2024-01-01 UTC", &epoch, &beyond, &error), error);
    ck_assert(!beyond);
    assert_ok(srp_epoch_parse("2060-01-01 UTC", &epoch, &beyond, &error), error);
    ck_assert(beyond);
    assert_ok(srp_epoch_parse("2060-01-01 TAI", &epoch, &beyond, &error), error);
    ck_assert(!beyond);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("orbit_epoch");
    TCase *all = tcase_create("epoch");
    tcase_add_test(all, scales_differ_as_they_should);
    tcase_add_test(all, gmat_counts_days_alike);
    tcase_add_test(all, a_leap_second_is_a_second);
    tcase_add_test(all, what_is_written_reads_back);
    tcase_add_test(all, nonsense_is_refused);
    tcase_add_test(all, dates_beyond_the_leap_seconds_are_marked);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
