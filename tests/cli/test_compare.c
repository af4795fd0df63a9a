/* SPDX-License-Identifier: Apache-2.0 */
/* Samples and differences of tables, against numbers that were worked out by hand. */
#include "command.h"
#include "difference.h"
#include "restate.h"
#include "samples.h"
#include "srp_check.h"
#include "table_input.h"

#include <string.h>

/* Of the command line's own, which these tests do not read with. */
int cli_table_read(const char *path, srp_table **out) {
    (void)path;
    (void)out;
    return CLI_MACHINE_FAILED;
}

/* Six directions: the poles, and four azimuths on the equator. A row for each node of 90 degrees.
 */
static const char HEAD[] = "Analysis Type : Area\n"
                           "Motion : 1\nName : Azimuth\nMethod : Step\nMinimum : -180\n"
                           "Maximum : 180\nStep : 90\n"
                           "Motion : 2\nName : Elevation\nMethod : Step\nMinimum : -90\n"
                           "Maximum : 90\nStep : 90\n: END\nRecord count : 15\n"
                           "Azimuth Elevation Force(X) Force(Y) Force(Z)\n"
                           "degrees degrees m^2 m^2 m^2\n";

static srp_table *parse(const char *rows) {
    char text[4096];
    srp_table *table = NULL;
    srp_error error;
    snprintf(text, sizeof text, "%s%s", HEAD, rows);
    assert_ok(srp_table_parse_spo(text, strlen(text), "test.spo", &table, &error), error);
    return table;
}

static const char ROWS_A[] = "-180 -90 0 0 7.25\n-180 0 3.5 0.25 0\n-180 90 0 0 -6.75\n"
                             "-90 -90 0 0 7.25\n-90 0 0 2.5 0\n-90 90 0 0 -6.75\n"
                             "0 -90 0 0 7.25\n0 0 -3.0 0 4.0\n0 90 0 0 -6.75\n"
                             "90 -90 0 0 7.25\n90 0 0 -1.5 0\n90 90 0 0 -6.75\n"
                             "180 -90 0 0 7.25\n180 0 3.5 0.25 0\n180 90 0 0 -6.75\n";
/* At azimuth 0 by (0.3, -0.4, 0.5), at the lower pole by -0.25 along z. */
static const char ROWS_B[] = "-180 -90 0 0 7.0\n-180 0 3.5 0.25 0\n-180 90 0 0 -6.75\n"
                             "-90 -90 0 0 7.0\n-90 0 0 2.5 0\n-90 90 0 0 -6.75\n"
                             "0 -90 0 0 7.0\n0 0 -2.7 -0.4 4.5\n0 90 0 0 -6.75\n"
                             "90 -90 0 0 7.0\n90 0 0 -1.5 0\n90 90 0 0 -6.75\n"
                             "180 -90 0 0 7.0\n180 0 3.5 0.25 0\n180 90 0 0 -6.75\n";

static const double POLE = 0.14644660940672624;    /* (1 - sin 45) / 2 */
static const double EQUATOR = 0.17677669529663687; /* sin 45 / 4 */

static cli_samples sample(const srp_table *table) {
    cli_samples samples;
    ck_assert(cli_samples_take(table, srp_table_grid(table), false, &samples));
    return samples;
}

START_TEST(each_direction_counts_once) {
    srp_table *table = parse(ROWS_A);
    cli_samples a = sample(table);
    ck_assert_uint_eq(a.count, 6);
    double sum = 0.0;
    for (size_t k = 0; k < a.count; ++k) {
        bool pole = fabs(a.at[k].el_deg) == 90.0;
        assert_close(a.at[k].weight, pole ? POLE : EQUATOR, 1e-15, 0.0);
        ck_assert(isnan(a.lit_area[k])); /* a .spo does not know it */
        sum += a.at[k].weight;
    }
    assert_close(sum, 1.0, 1e-15, 0.0);
    /* 7.25, 6.75 at the poles; hypot(3.5, 0.25), 2.5, 5, 1.5 on the equator. */
    double want = POLE * 14.0 + EQUATOR * (3.5089172119045497 + 9.0);
    assert_close(cli_samples_mean_length(&a), want, 1e-15, 0.0);
    cli_samples_free(&a);
    srp_table_destroy(table);
}
END_TEST

START_TEST(nodes_of_one_direction_are_averaged) {
    char rows[sizeof ROWS_A];
    memcpy(rows, ROWS_A, sizeof rows);
    memcpy(strstr(rows, "180 0 3.5 0.25 0\n180 90"), "180 0 4.5 0.75 0", 16);
    srp_table *table = parse(ROWS_A), *other = parse(rows);
    cli_samples a = sample(table), b = sample(other);
    double far = 0.0;
    for (size_t k = 0; k < a.count; ++k) {
        far += srp_vec3_norm(srp_vec3_sub(a.value[k], b.value[k]));
        if (a.at[k].az_deg == -180.0) {
            assert_vec3_close(b.value[k], srp_vec3_make(4.0, 0.5, 0.0), 1e-15, 0.0);
        }
    }
    assert_close(far, hypot(0.5, 0.25), 1e-15, 0.0);
    cli_samples_free(&a);
    cli_samples_free(&b);
    srp_table_destroy(table);
    srp_table_destroy(other);
}
END_TEST

static void check_row(cli_difference_row row, double mse, double mean, double largest, double az,
                      double el) {
    assert_close(row.mse, mse, 1e-13, 0.0);
    assert_close(row.rms, sqrt(mse), 1e-13, 0.0);
    assert_close(row.mean, mean, 1e-13, 0.0);
    assert_close(row.largest, largest, 1e-13, 0.0);
    ck_assert(row.az_deg == az && row.el_deg == el);
}

START_TEST(differences_are_those_worked_out_by_hand) {
    srp_table *first = parse(ROWS_A), *second = parse(ROWS_B);
    cli_samples a = sample(first), b = sample(second);
    cli_difference d = cli_difference_measure(&a, b.value, NULL);
    const double size = 5.263078946776307; /* of (-2.7, -0.4, 4.5): sqrt(7.29 + 0.16 + 20.25) */
    check_row(d.row[CLI_DIFFERENCE_X], EQUATOR * 0.09, EQUATOR * 0.3, 0.3, 0.0, 0.0);
    check_row(d.row[CLI_DIFFERENCE_Y], EQUATOR * 0.16, EQUATOR * -0.4, -0.4, 0.0, 0.0);
    check_row(d.row[CLI_DIFFERENCE_Z], EQUATOR * 0.25 + POLE * 0.0625, EQUATOR * 0.5 - POLE * 0.25,
              0.5, 0.0, 0.0);
    check_row(d.row[CLI_DIFFERENCE_LENGTH], EQUATOR * (size - 5.0) * (size - 5.0) + POLE * 0.0625,
              EQUATOR * (size - 5.0) - POLE * 0.25, size - 5.0, 0.0, 0.0);
    check_row(d.row[CLI_DIFFERENCE_VECTOR], EQUATOR * 0.5 + POLE * 0.0625,
              EQUATOR * sqrt(0.5) + POLE * 0.25, sqrt(0.5), 0.0, 0.0);
    assert_close(d.mean_b - d.mean_a, EQUATOR * (size - 5.0) - POLE * 0.25, 1e-12, 0.0);

    /* Without the equator's azimuth 0 the pole is what is left. */
    bool skip[6];
    for (size_t k = 0; k < 6; ++k) {
        skip[k] = a.at[k].az_deg == 0.0 && a.at[k].el_deg == 0.0;
    }
    d = cli_difference_measure(&a, b.value, skip);
    check_row(d.row[CLI_DIFFERENCE_Z], POLE * 0.0625 / (1.0 - EQUATOR),
              POLE * -0.25 / (1.0 - EQUATOR), -0.25, 0.0, -90.0);
    cli_samples_free(&a);
    cli_samples_free(&b);
    srp_table_destroy(first);
    srp_table_destroy(second);
}
END_TEST

START_TEST(a_table_does_not_differ_from_itself) {
    srp_table *table = parse(ROWS_B);
    cli_samples a = sample(table);
    cli_difference d = cli_difference_measure(&a, a.value, NULL);
    for (int c = 0; c < CLI_DIFFERENCE_COUNT; ++c) {
        ck_assert(d.row[c].mse == 0.0 && d.row[c].mean == 0.0 && d.row[c].largest == 0.0);
    }
    cli_samples_free(&a);
    srp_table_destroy(table);
}
END_TEST

START_TEST(the_finer_grid_is_found) {
    const srp_grid fine = {73, 37}, coarse = {19, 10}, mixed = {145, 10};
    ck_assert(cli_grid_contains(fine, coarse) && !cli_grid_contains(coarse, fine));
    ck_assert(cli_grid_contains(fine, fine));
    ck_assert(!cli_grid_contains(fine, mixed)); /* finer in one angle, coarser in the other */
    ck_assert_uint_eq(cli_grid_finer(fine, coarse).az_count, 73);
    ck_assert_uint_eq(cli_grid_finer(coarse, fine).az_count, 73);
    ck_assert_uint_eq(cli_grid_finer(mixed, fine).az_count, 73);
}
END_TEST

/* A cannonball's force is reproduced by interpolation: coarse and fine are one. */
START_TEST(coarser_tables_are_interpolated) {
    static const double area = 7.25;
    srp_scene *scene;
    srp_prepared *prepared;
    srp_table *table;
    srp_error error;
    srp_interp *interp;
    srp_grid coarse = {13, 7}, fine = {49, 37};
    srp_method_params params = srp_method_params_default();
    params.threads = 1;
    assert_ok(srp_scene_from_sphere(1.0, area, &scene, &error), error);
    assert_ok(srp_method_prepare(&srp_method_cannonball, scene, &params, &prepared, &error), error);
    assert_ok(srp_table_create(prepared, coarse, false, &table, &error), error);
    assert_ok(srp_table_fill(table, prepared, NULL, &error), error);
    assert_ok(srp_interp_create(&srp_interp_bicubic, table, &interp, &error), error);
    cli_samples samples;
    ck_assert(cli_samples_interpolate(interp, fine, false, &samples));
    ck_assert_uint_eq(samples.count, 48 * 35 + 2);
    double sum = 0.0;
    for (size_t k = 0; k < samples.count; ++k) {
        assert_vec3_close(samples.value[k], srp_vec3_scale(-area, samples.at[k].s), 1e-13, 0.0);
        sum += samples.at[k].weight;
    }
    assert_close(sum, 1.0, 1e-13, 0.0);
    cli_samples_free(&samples);
    srp_interp_destroy(interp);
    srp_table_destroy(table);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(tables_that_are_no_physics_are_refused) {
    srp_table *table;
    static const char good[] = "-180 -90 0 0 7\n-180 0 3 0 0\n-180 90 0 0 -7\n"
                               "-90 -90 0 0 7\n-90 0 0 2 0\n-90 90 0 0 -7\n"
                               "0 -90 0 0 7\n0 0 -3 0 0\n0 90 0 0 -7\n"
                               "90 -90 0 0 7\n90 0 0 -2 0\n90 90 0 0 -7\n"
                               "180 -90 0 0 7\n180 0 3 0 0\n180 90 0 0 -7\n";
    table = parse(good);
    ck_assert_int_eq(cli_table_check(table, "test.spo"), CLI_DONE);
    ((srp_response *)srp_table_node(table, 2, 1))->f.y = NAN;
    ck_assert_int_eq(cli_table_check(table, "test.spo"), CLI_BAD_INPUT);
    ((srp_response *)srp_table_node(table, 2, 1))->f.y = 0.0;
    ((srp_response *)srp_table_node(table, 3, 1))->t.x = INFINITY;
    ck_assert_int_eq(cli_table_check(table, "test.spo"), CLI_BAD_INPUT);
    srp_table_destroy(table);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("compare");
    TCase *tc = tcase_create("compare");
    tcase_add_test(tc, each_direction_counts_once);
    tcase_add_test(tc, nodes_of_one_direction_are_averaged);
    tcase_add_test(tc, differences_are_those_worked_out_by_hand);
    tcase_add_test(tc, a_table_does_not_differ_from_itself);
    tcase_add_test(tc, tables_that_are_no_physics_are_refused);
    tcase_add_test(tc, the_finer_grid_is_found);
    tcase_add_test(tc, coarser_tables_are_interpolated);
    suite_add_tcase(suite, tc);
    return run_suite(suite);
}
