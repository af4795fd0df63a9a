/* SPDX-License-Identifier: Apache-2.0 */
#include "srp_check.h"
#include "table_fixture.h"
#include "table_internal.h"

#include <string.h>

/* 3 azimuths x 2 elevations of 2 kg. */
static const char GOOD[] = "# made by hand\n"              /* 1 */
                           "# title: a test\n"             /* 2 */
                           "# mass [kg]: 2\n"              /* 3 */
                           "# solar flux [W/m^2]: 1367\n"  /* 4 */
                           "# azimuth step [deg]: 180\n"   /* 5 */
                           "# elevation step [deg]: 180\n" /* 6 */
                           "-180 -90 1e-6 0 0 1e-6\n"      /* 7 */
                           "-180  90 2e-6 0 0 2e-6\n"      /* 8 */
                           "   0 -90 3e-6 0 0 3e-6\n"      /* 9 */
                           "   0  90 4e-6 0 0 4e-6\n"      /* 10 */
                           " 180 -90 5e-6 0 0 5e-6\n"      /* 11 */
                           " 180  90 0 -6e-6 0 6e-6\n";    /* 12 */

static const char PATH[] = "scratch_text.txt";

static void write_changed(const char *find, const char *replace) {
    const char *at = strstr(GOOD, find);
    ck_assert_msg(at != NULL, "'%s' is not in the file", find);
    char text[2 * sizeof GOOD];
    int size =
        snprintf(text, sizeof text, "%.*s%s%s", (int)(at - GOOD), GOOD, replace, at + strlen(find));
    write_bytes(PATH, text, (size_t)size);
}

START_TEST(areas_are_found_again) {
    srp_table *table;
    srp_error error;
    write_bytes(PATH, GOOD, sizeof GOOD - 1);
    assert_ok(srp_table_read(&srp_table_format_txt, PATH, &table, &error), error);
    double per_area = 1367.0 / 299792458.0 / 2.0;
    assert_close(srp_table_node(table, 1, 0)->f.x, 3e-6 / per_area, 1e-15, 0.0);
    assert_close(srp_table_node(table, 2, 1)->f.y, -6e-6 / per_area, 1e-15, 0.0);
    const srp_table_info *info = srp_table_get_info(table);
    ck_assert_str_eq(info->title, "a test");
    ck_assert(info->mass == 2.0 && info->light.flux == 1367.0);
    ck_assert(!info->has_moment && !info->has_error && !info->has_basis);
    srp_table_destroy(table);
    remove(PATH);
}
END_TEST

START_TEST(there_and_back_keeps_the_force) {
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_grid grid = grid_of(22.5, 20);
    srp_table *table = noise_table(&fixture, grid, true), *back;
    srp_error error;
    assert_ok(srp_table_write(table, &srp_table_format_txt, PATH, &error), error);
    assert_ok(srp_table_read(&srp_table_format_txt, PATH, &back, &error), error);
    const srp_table_info *info = srp_table_get_info(back);
    ck_assert(info->mass == 123.5 && info->light.flux == 1361.0 && info->light.au == 1.496e11);
    for (uint32_t i = 0; i < grid.az_count; ++i) {
        for (uint32_t j = 0; j < grid.el_count; ++j) {
            assert_vec3_close(srp_table_node(back, i, j)->f, srp_table_node(table, i, j)->f, 5e-16,
                              0.0);
        }
    }
    srp_table_destroy(back);
    srp_table_destroy(table);
    fixture_destroy(fixture);
    remove(PATH);
}
END_TEST

/* The numbers themselves: a = P0/c f/m, and its norm. */
START_TEST(rows_are_accelerations) {
    table_fixture fixture = fixture_create(&srp_method_cannonball, NULL);
    srp_table *table = noise_table(&fixture, grid_of(90, 90), false);
    srp_error error;
    size_t size;
    assert_ok(srp_table_write(table, &srp_table_format_txt, PATH, &error), error);
    char *text = read_bytes(PATH, &size);
    char *at = strstr(text, "\n    0.00    0.00");
    ck_assert_ptr_nonnull(at);
    double value[6];
    for (int k = 0; k < 6; ++k) {
        value[k] = strtod(at, &at);
    }
    /* Cr 1.5, 2 m^2 (table_fixture.c), 123.5 kg, 1361 W/m^2. */
    double expected = 1361.0 / 299792458.0 * 1.5 * 2.0 / 123.5;
    assert_close(value[2], -expected, 1e-15, 0.0);
    ck_assert(value[3] == 0.0 && value[4] == 0.0);
    assert_close(value[5], expected, 1e-15, 0.0);
    free(text);
    srp_table_destroy(table);
    fixture_destroy(fixture);
    remove(PATH);
}
END_TEST

START_TEST(titles_stay_on_their_line) {
    table_fixture fixture = fixture_create(&srp_method_cannonball, NULL);
    srp_table *table = noise_table(&fixture, grid_of(90, 90), false), *back;
    srp_error error;
    assert_ok(srp_table_describe(table, "two\nlines: \t1", "", srp_sunlight_default(), 1.0, &error),
              error);
    assert_ok(srp_table_write(table, &srp_table_format_txt, PATH, &error), error);
    assert_ok(srp_table_read(&srp_table_format_txt, PATH, &back, &error), error);
    ck_assert_str_eq(srp_table_get_info(back)->title, "two lines:  1");
    srp_table_destroy(back);
    srp_table_destroy(table);
    fixture_destroy(fixture);
    remove(PATH);
}
END_TEST

START_TEST(malformed_files_are_refused_with_their_place) {
    const struct {
        const char *find, *replace;
        size_t line;
        srp_status status;
        const char *words;
    } cases[] = {
        {"# mass [kg]: 2\n", "", 6, SRP_BAD_FORMAT, "expected a line '# mass [kg]: VALUE'"},
        {"# solar flux [W/m^2]: 1367\n", "", 6, SRP_BAD_FORMAT, "'# solar flux [W/m^2]: VALUE'"},
        {"# azimuth step [deg]: 180\n", "", 6, SRP_BAD_FORMAT, "'# azimuth step [deg]: VALUE'"},
        {"# elevation step", "# step", 7, SRP_BAD_FORMAT, "'# elevation step [deg]: VALUE'"},
        {"[kg]: 2", "[kg]: two", 3, SRP_BAD_FORMAT, "'two', expected a finite number: mass [kg]"},
        {"[kg]: 2", "[kg]: -2", 3, SRP_BAD_DATA, "mass [kg] is -2, expected more than 0"},
        {"[kg]: 2", "[kg]: nan", 3, SRP_BAD_FORMAT, "'nan', expected a finite number: mass [kg]"},
        {": 1367", ": 0", 4, SRP_BAD_DATA, "solar flux [W/m^2] is 0"},
        {": 180\n# e", ": 7\n# e", 7, SRP_BAD_FORMAT, "does not divide 360"},
        {": 180\n# e", ": 0.01\n# e", 7, SRP_BAD_FORMAT, "more than a file of"},
        {"   0 -90 3e-6 0 0 3e-6\n", "", 9, SRP_BAD_FORMAT, "found elevation 90, expected -90"},
        {"3e-6 0 0 3e-6", "3e-6 0 0", 9, SRP_BAD_FORMAT, "expected a finite number: |a|"},
        {"3e-6 0 0 3e-6", "3e-6 0 0 3e-6 1", 9, SRP_BAD_FORMAT, "'1'"},
        {"3e-6 0 0 3e-6", "3e-6 x 0 3e-6", 9, SRP_BAD_FORMAT,
         "'x', expected a finite number: a(Y)"},
        {"3e-6 0 0 3e-6", "3e-6 inf 0 3e-6", 9, SRP_BAD_FORMAT,
         "'inf', expected a finite number: a(Y)"},
        {"3e-6 0 0 3e-6", "3e-6 -1e300 0 1e300", 9, SRP_BAD_DATA,
         "found '-1e300': a(Y) is -4.38614e+305 in metres, expected at most 1e+100"},
        {"[kg]: 2", "[kg]: 2e-300", 3, SRP_BAD_DATA,
         "mass [kg] is 2e-300, expected 1e-30 to 1e+30"},
        {": 1367", ": 1e31", 4, SRP_BAD_DATA, "solar flux [W/m^2] is 1e+31, expected 1e-30 to"},
        {"# made by hand", "# mass [kg]: 2", 3, SRP_BAD_FORMAT,
         "found 'mass [kg]' again, expected it once: it is given in line 1"},
        {"# made by hand", "# azimuth step [deg]: 90", 5, SRP_BAD_FORMAT, "it is given in line 1"},
        {"   0 -90", "# astronomical unit [m]: 1.5e11\n 0 -90", 9, SRP_BAD_FORMAT,
         "found 'astronomical unit [m]', expected it above the first row"},
        {" 180  90 0 -6e-6 0 6e-6\n", "", 12, SRP_BAD_FORMAT, "ends after 5 rows, expected 6"},
        {"6e-6\n", "6e-6\n0 0 1 1 1 1\n", 13, SRP_BAD_FORMAT, "found more than the 6 rows"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        srp_table *table = NULL;
        srp_error error;
        const char *find = strcmp(cases[k].find, "6e-6\n") == 0 ? "0 6e-6\n" : cases[k].find;
        char replace[128];
        snprintf(replace, sizeof replace, "%s%s", find == cases[k].find ? "" : "0 ",
                 cases[k].replace);
        write_changed(find, replace);
        srp_status status = srp_table_read(&srp_table_format_txt, PATH, &table, &error);
        ck_assert_msg(status == cases[k].status, "'%s': status '%s'", cases[k].words,
                      srp_status_string(status));
        ck_assert_msg(strstr(error.message, cases[k].words) != NULL, "'%s' lacks '%s'",
                      error.message, cases[k].words);
        ck_assert_str_eq(error.file, PATH);
        ck_assert_msg(error.line == cases[k].line, "'%s' in line %zu, expected %zu", error.message,
                      error.line, cases[k].line);
        ck_assert_ptr_null(table);
    }
    remove(PATH);
}
END_TEST

/* However few bytes are missing, be they digits of the last number. */
START_TEST(our_files_cut_in_the_last_rows_are_refused) {
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_table *table = noise_table(&fixture, grid_of(90, 90), false);
    srp_error error;
    for (int pass = 0; pass < 2; ++pass) {
        assert_ok(srp_table_write(table, &srp_table_format_txt, PATH, &error), error);
        srp_table_destroy(table);
        assert_ok(srp_table_read(&srp_table_format_txt, PATH, &table, &error), error);
        size_t size, begin;
        char *text = read_bytes(PATH, &size);
        begin = size;
        for (int rows = 0; rows < 4;) {
            rows += text[--begin] == '\n';
        }
        ck_assert_uint_gt(size - begin, 3 * 100);
        for (size_t cut = begin + 1; cut < size; ++cut) {
            srp_table *none = NULL;
            write_bytes(PATH, text, cut);
            ck_assert_msg(srp_table_read(&srp_table_format_txt, PATH, &none, &error) ==
                              SRP_BAD_FORMAT,
                          "%zu bytes are missing", size - cut);
        }
        free(text);
    }
    srp_table_destroy(table);
    fixture_destroy(fixture);
    remove(PATH);
}
END_TEST

START_TEST(what_is_no_table_is_refused) {
    srp_table *table = NULL;
    srp_error error;
    write_bytes(PATH, "", 0);
    ck_assert_int_eq(srp_table_read(&srp_table_format_txt, PATH, &table, &error), SRP_BAD_FORMAT);
    ck_assert_ptr_nonnull(strstr(error.message, "ends before any row"));
    write_bytes(PATH, "\0\1\2\3", 4);
    ck_assert_int_eq(srp_table_read(&srp_table_format_txt, PATH, &table, &error), SRP_BAD_FORMAT);
    ck_assert_ptr_nonnull(strstr(error.message, "binary"));
    ck_assert_int_eq(srp_table_read(&srp_table_format_txt, ".", &table, &error), SRP_IO);
    ck_assert_int_eq(srp_table_read(&srp_table_format_txt, "none.txt", &table, &error),
                     SRP_NOT_FOUND);
    ck_assert_ptr_null(table);
    remove(PATH);
}
END_TEST

START_TEST(a_full_disk_is_named) {
    table_fixture fixture = fixture_create(&srp_method_cannonball, NULL);
    srp_table *table = noise_table(&fixture, grid_of(90, 90), false);
    srp_error error;
    ck_assert_int_eq(srp_table_write(table, &srp_table_format_txt, "/dev/full", &error), SRP_IO);
    ck_assert_ptr_nonnull(strstr(error.message, "No space left on device"));
    srp_table_destroy(table);
    fixture_destroy(fixture);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("table_txt");
    TCase *tcase = tcase_create("txt");
    tcase_add_test(tcase, areas_are_found_again);
    tcase_add_test(tcase, there_and_back_keeps_the_force);
    tcase_add_test(tcase, rows_are_accelerations);
    tcase_add_test(tcase, titles_stay_on_their_line);
    tcase_add_test(tcase, malformed_files_are_refused_with_their_place);
    tcase_add_test(tcase, our_files_cut_in_the_last_rows_are_refused);
    tcase_add_test(tcase, what_is_no_table_is_refused);
    tcase_add_test(tcase, a_full_disk_is_named);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
