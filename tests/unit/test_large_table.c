/* SPDX-License-Identifier: Apache-2.0 */
/* The table of a large model: what it costs in memory, asserted, and in time, printed. */
#define _DEFAULT_SOURCE /* getrusage */

#include "srp_check.h"

#include <srp/method.h>
#include <srp/table.h>

#include <sys/resource.h>
#include <time.h>

/* Largest memory the process has held so far [MB]. */
static double peak_memory(void) {
    struct rusage usage;
    ck_assert_int_eq(getrusage(RUSAGE_SELF, &usage), 0);
    return (double)usage.ru_maxrss * 1024.0 / 1e6;
}

static double seconds_now(void) {
    struct timespec now;
    ck_assert_int_eq(timespec_get(&now, TIME_UTC), TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

START_TEST(five_degrees_of_gnss_stay_below_200_mb) {
    const char *path = SRP_MODELS_DIR "/gnss.obj";
    srp_scene *scene = NULL;
    srp_prepared *prepared = NULL;
    srp_table *table = NULL;
    srp_error error;
    srp_grid grid;
    assert_ok(srp_scene_read_obj(&path, 1, NULL, NULL, NULL, &scene, &error), error);
    ck_assert_uint_ge(srp_scene_facet_count(scene), 20000);
    srp_method_params params = srp_method_params_default();
    assert_ok(srp_method_prepare(&srp_method_exact, scene, &params, &prepared, &error), error);
    assert_ok(srp_grid_from_steps(5.0, 5.0, &grid, &error), error);
    ck_assert_uint_eq(srp_grid_node_count(grid), 2701);
    assert_ok(srp_table_create(prepared, grid, false, &table, &error), error);
    double begin = seconds_now();
    assert_ok(srp_table_fill(table, prepared, NULL, &error), error);
    double per_node = (seconds_now() - begin) / 2701.0;
    assert_ok(srp_table_write(table, &srp_table_format_netcdf, "large_table.nc", &error), error);
    double peak = peak_memory();
    printf("gnss, %zu facets, 2701 nodes, %d threads: %.2f ms per node, peak %.1f MB\n",
           srp_scene_facet_count(scene), params.threads, 1e3 * per_node, peak);
    ck_assert_msg(peak < 200.0, "peak memory %.1f MB, expected less than 200", peak);
    srp_table_destroy(table);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
    ck_assert_int_eq(remove("large_table.nc"), 0);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("large_table");
    TCase *tcase = tcase_create("large_table");
    tcase_set_timeout(tcase, 1200);
    tcase_add_test(tcase, five_degrees_of_gnss_stay_below_200_mb);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
