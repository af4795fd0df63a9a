/* SPDX-License-Identifier: Apache-2.0 */
/* What is known of a table's numbers and of the error between its nodes. */
#include "interp_fixture.h"
#include "srp_check.h"
#include "table_internal.h"

#include <math.h>
#include <string.h>

enum { COUNT = 500 };

static void respond(const srp_vec3 *s, srp_response *out, size_t count) {
    memset(out, 0, count * sizeof *out);
    for (size_t k = 0; k < count; ++k) {
        field_value value = smooth_field(s[k]);
        out[k].f = value.f;
        out[k].t = value.t;
    }
}

START_TEST(directions_are_even_and_seeded) {
    static srp_vec3 s[4000], other[100];
    srp_interp_directions(4000, 7, s);
    /* Moments of the uniform sphere. */
    double x = 0.0, xx = 0.0, xy = 0.0, zz = 0.0;
    for (int k = 0; k < 4000; ++k) {
        assert_close(srp_vec3_norm(s[k]), 1.0, 1e-15, 0.0);
        x += s[k].x / 4000;
        xx += s[k].x * s[k].x / 4000;
        xy += s[k].x * s[k].y / 4000;
        zz += s[k].z * s[k].z / 4000;
    }
    ck_assert(fabs(x) < 1e-3 && fabs(xy) < 1e-3);
    ck_assert(fabs(xx - 1.0 / 3.0) < 1e-3 && fabs(zz - 1.0 / 3.0) < 1e-3);
    srp_interp_directions(100, 7, other);
    ck_assert(memcmp(s, other, sizeof other) == 0);
    srp_interp_directions(100, 8, other);
    ck_assert(srp_vec3_norm(srp_vec3_sub(s[0], other[0])) > 1e-3);
}
END_TEST

START_TEST(errors_are_those_of_the_interpolants) {
    static srp_vec3 s[COUNT];
    static srp_response truth[COUNT];
    srp_table *table = field_table(36, 18, true, smooth_field);
    srp_table_check check;
    srp_error error;
    srp_interp_directions(COUNT, 3, s);
    respond(s, truth, COUNT);
    assert_ok(srp_interp_check(table, COUNT, s, truth, 3, &check, &error), error);
    ck_assert_uint_eq(check.count, COUNT);
    ck_assert_uint_eq(check.seed, 3);
    size_t schemes;
    const srp_interp_scheme *const *list = srp_interp_list(&schemes);
    ck_assert_uint_eq(schemes, SRP_TABLE_SCHEMES);
    for (size_t k = 0; k < schemes; ++k) {
        srp_interp *interp = make_interp(list[k], table);
        srp_table_error want = {0.0, 0.0, 0.0, 0.0};
        for (int n = 0; n < COUNT; ++n) {
            field_value got = ask(interp, s[n]);
            double f = srp_vec3_norm(srp_vec3_sub(got.f, truth[n].f));
            double t = srp_vec3_norm(srp_vec3_sub(got.t, truth[n].t));
            want.f_mean += f;
            want.t_mean += t;
            want.f_max = fmax(want.f_max, f);
            want.t_max = fmax(want.t_max, t);
        }
        assert_close(check.errors[k].f_mean, want.f_mean / COUNT, 1e-12, 0.0);
        assert_close(check.errors[k].t_mean, want.t_mean / COUNT, 1e-12, 0.0);
        assert_close(check.errors[k].f_max, want.f_max, 0.0, 0.0);
        assert_close(check.errors[k].t_max, want.t_max, 0.0, 0.0);
        srp_interp_destroy(interp);
    }
    /* Higher order, less error. */
    ck_assert(check.errors[0].f_max > 3.0 * check.errors[1].f_max);
    ck_assert(check.errors[1].f_max > 3.0 * check.errors[2].f_max);
    srp_table_destroy(table);
}
END_TEST

START_TEST(coarse_grids_and_wrong_directions) {
    srp_vec3 s[2] = {{0.6, 0.0, 0.8}, {0.0, 0.6, 0.9}};
    srp_response truth[2];
    srp_table_check check = {.count = 77};
    srp_error error;
    respond(s, truth, 2);
    srp_table *table = field_table(3, 2, false, smooth_field);
    ck_assert_int_eq(srp_interp_check(table, 2, s, truth, 0, &check, &error), SRP_BAD_ARGUMENT);
    ck_assert_int_eq(srp_interp_check(table, 0, s, truth, 0, &check, &error), SRP_BAD_ARGUMENT);
    ck_assert_uint_eq(check.count, 77);
    assert_ok(srp_interp_check(table, 1, s, truth, 0, &check, &error), error);
    ck_assert(isnan(check.errors[1].f_max) && isnan(check.errors[2].f_mean));
    ck_assert(check.errors[0].f_max > 0.0 && check.errors[0].t_max == 0.0);
    srp_table_destroy(table);
}
END_TEST

START_TEST(a_check_comes_back_from_the_file) {
    static const char path[] = "interp_check.nc";
    srp_table *table = field_table(12, 6, true, smooth_field), *back = NULL;
    srp_table_check check = {.count = 321, .seed = UINT64_MAX - 5};
    srp_error error;
    for (int k = 0; k < SRP_TABLE_SCHEMES; ++k) {
        check.errors[k] = (srp_table_error){0.123 + k, 1.77 * k, NAN, 7e-5};
    }
    srp_table_set_check(table, &check);
    assert_ok(srp_table_write(table, &srp_table_format_netcdf, path, &error), error);
    assert_ok(srp_table_read(&srp_table_format_netcdf, path, &back, &error), error);
    const srp_table_check *got = &srp_table_get_info(back)->check;
    ck_assert_uint_eq(got->count, 321);
    ck_assert_uint_eq(got->seed, UINT64_MAX - 5);
    for (int k = 0; k < SRP_TABLE_SCHEMES; ++k) {
        ck_assert(got->errors[k].f_mean == check.errors[k].f_mean);
        ck_assert(got->errors[k].f_max == check.errors[k].f_max);
        ck_assert(isnan(got->errors[k].t_mean));
        ck_assert(got->errors[k].t_max == check.errors[k].t_max);
    }
    /* It is part of what the checksum covers. */
    char one[33], two[33];
    srp_table_checksum(table, one);
    check.errors[1].f_max *= 1.0 + 1e-15;
    srp_table_set_check(table, &check);
    srp_table_checksum(table, two);
    ck_assert_str_ne(one, two);
    srp_table_destroy(back);
    srp_table_destroy(table);
    remove(path);
}
END_TEST

/* ---- Odd numbers ---------------------------------------------------------------------------- */

static char said[4096];

static void keep(void *user, const srp_error *what) {
    (void)user;
    ck_assert_str_eq(what->file, "some.spo");
    strncat(said, what->message, sizeof said - strlen(said) - 1);
    strncat(said, "\n", sizeof said - strlen(said) - 1);
}

static srp_table_report inspect(const srp_table *table) {
    const srp_log log = {keep, NULL};
    srp_table_report report;
    said[0] = '\0';
    srp_table_inspect(table, "some.spo", &log, &report);
    return report;
}

static field_value rounded_field(srp_vec3 s) {
    field_value value = smooth_field(s);
    value.f.x = round(100.0 * value.f.x) / 100.0;
    value.f.y = round(100.0 * value.f.y) / 100.0;
    value.f.z = round(100.0 * value.f.z) / 100.0;
    return value;
}

START_TEST(odd_numbers_are_reported) {
    srp_table *table = field_table(12, 6, true, smooth_field);
    srp_table_report report = inspect(table);
    ck_assert_str_eq(said, "");
    ck_assert(report.pole_spread[0] == 0.0 && report.pole_spread[1] == 0.0);
    ck_assert(report.seam_spread == 0.0 && report.quantum == 0.0 && report.f_max > 1.0);
    field_value value = smooth_field(srp_vec3_make(0, 0, 1));
    value.f.x += 0.12;
    set_node(table, 5, 6, value);
    value = smooth_field(srp_grid_direction(srp_table_grid(table), 12, 2));
    value.f.y += 0.25;
    set_node(table, 12, 2, value);
    report = inspect(table);
    assert_close(report.pole_spread[1], 0.11, 1e-12, 0.0);
    assert_close(report.seam_spread, 0.25, 1e-12, 0.0);
    ck_assert(report.pole_spread[0] == 0.0);
    ck_assert_ptr_nonnull(strstr(said, "nodes at elevation 90 are one direction, but f differs by "
                                       "up to 0.11 m^2 from its mean"));
    ck_assert_ptr_nonnull(strstr(said, "differs by up to 0.25 m^2 between them"));
    ck_assert_ptr_null(strstr(said, "rounded"));
    srp_table_destroy(table);
    table = field_table(12, 6, true, rounded_field);
    report = inspect(table);
    assert_close(report.quantum, 0.01, 1e-15, 0.0);
    ck_assert_ptr_nonnull(strstr(said, "forces are rounded to 0.01 m^2"));
    srp_table_destroy(table);
    table = field_table(2, 2, true, rounded_field); /* few numbers are round by chance */
    report = inspect(table);
    ck_assert(report.quantum == 0.0);
    srp_table_destroy(table);
}
END_TEST

START_TEST(a_real_table_is_reported_and_finite) {
    srp_table *table = NULL;
    srp_error error;
    if (srp_table_read(&srp_table_format_spo, SRP_SHARED_DATA_DIR "/spad/One-Wing-Sat.spo", &table,
                       &error) != SRP_OK) {
        ck_assert_int_eq(error.status, SRP_NOT_FOUND);
        printf("skipped: no One-Wing-Sat.spo in " SRP_SHARED_DATA_DIR "\n");
        return;
    }
    srp_table_report report = inspect(table);
    printf("One-Wing-Sat.spo: %s", said);
    assert_close(report.quantum, 0.01, 1e-12, 0.0);
    ck_assert(report.pole_spread[0] > 1.0 && report.pole_spread[1] > 1.0);
    size_t schemes;
    const srp_interp_scheme *const *list = srp_interp_list(&schemes);
    for (size_t k = 0; k < schemes; ++k) {
        srp_interp *interp = make_interp(list[k], table);
        uint64_t state = 1;
        double most = 0.0;
        for (int n = 0; n < 60000; ++n) {
            srp_vec3 s = random_direction(&state);
            if (n < 20000) { /* poles and seam */
                double near = pow(10.0, -18.0 * random_unit(&state));
                s = n % 2 ? srp_vec3_make(near * s.x, near * s.y, n % 4 == 1 ? 1 : -1)
                          : srp_vec3_make(-1.0, near * s.y, s.z);
                s = srp_vec3_scale(1.0 / srp_vec3_norm(s), s);
            }
            srp_interp_jacobian slopes = ask_slopes(interp, s);
            most = fmax(most, jacobian_size(&slopes)); /* asserts that all are finite */
        }
        printf("%s: finite everywhere, derivatives up to %.0f m^2\n", list[k]->name, most);
        ck_assert(most < 1e5);
        srp_interp_destroy(interp);
    }
    srp_table_destroy(table);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("interp_check");
    TCase *tcase = tcase_create("interp_check");
    tcase_set_timeout(tcase, 120);
    tcase_add_test(tcase, directions_are_even_and_seeded);
    tcase_add_test(tcase, errors_are_those_of_the_interpolants);
    tcase_add_test(tcase, coarse_grids_and_wrong_directions);
    tcase_add_test(tcase, a_check_comes_back_from_the_file);
    tcase_add_test(tcase, odd_numbers_are_reported);
    tcase_add_test(tcase, a_real_table_is_reported_and_finite);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
