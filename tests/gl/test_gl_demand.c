/* SPDX-License-Identifier: Apache-2.0 */
/* Tables that fill themselves by OpenGL: the bits of the table that it fills at once. */
#include "gl_fixture.h"
#include "model_files.h"
#include "prepared.h"
#include "srp_check.h"

#include <srp/demand.h>
#include <srp/interp.h>

#include <string.h>

static const srp_grid GRID = {25, 13};

static srp_prepared *prepare(const char *method, const srp_scene *scene) {
    srp_method_params params = srp_method_params_default();
    params.threads = 2;
    params.lattice.samples = 64;
    params.reflections = 1;
    params.diffuse = 1;
    params.reference = srp_vec3_make(0.31, -0.27, 0.64);
    return prepare_with(gl_method(method), scene, &params);
}

static void compare_nodes(const srp_table *table, const srp_demand *demand) {
    size_t compared = 0;
    for (uint32_t i = 0; i < GRID.az_count; ++i) {
        for (uint32_t j = 0; j < GRID.el_count; ++j) {
            const srp_response *want = srp_table_node(table, i, j);
            const srp_response *got = srp_demand_get(demand, (srp_demand_node){i, j});
            if (got != NULL) {
                ck_assert_mem_eq(&got->f, &want->f, sizeof got->f);
                ck_assert_mem_eq(&got->t, &want->t, sizeof got->t);
                ck_assert(got->f_error == want->f_error && got->lit_area == want->lit_area);
                ++compared;
            }
        }
    }
    printf("%zu of %zu nodes are those of the full table\n", compared, srp_grid_node_count(GRID));
    ck_assert_uint_ge(compared, 50);
    ck_assert_uint_lt(compared, srp_grid_node_count(GRID)); /* not all were asked for */
}

/* Along a circle, as an orbit does. */
static void compare_look_ups(const srp_interp_scheme *scheme, const srp_table *table,
                             srp_demand *demand) {
    srp_interp *full = NULL, *ours = NULL;
    srp_error error;
    assert_ok(srp_interp_create(scheme, table, &full, &error), error);
    assert_ok(srp_interp_create_on_demand(scheme, demand, &ours, &error), error);
    for (int k = 0; k < 200; ++k) {
        srp_vec3 s = srp_direction_from_deg(1.7 * k - 180.0, 31.3), want[2], got[2];
        assert_ok(srp_interp_eval(full, s, &want[0], &want[1], NULL, &error), error);
        assert_ok(srp_interp_eval(ours, s, &got[0], &got[1], NULL, &error), error);
        ck_assert_mem_eq(got, want, sizeof want);
    }
    srp_interp_destroy(full);
    srp_interp_destroy(ours);
}

START_TEST(gives_the_bits_of_the_full_table) {
    static const char *const METHODS[] = {"raycast", "raytrace"};
    model_file model = model_read("box-wing");
    srp_scene *scene = model_scene(&model);
    srp_table *table = NULL;
    srp_demand *demand = NULL;
    srp_error error;
    srp_prepared *prepared = prepare(METHODS[_i], scene);
    assert_ok(srp_table_create(prepared, GRID, false, &table, &error), error);
    assert_ok(srp_table_fill(table, prepared, NULL, &error), error);
    assert_ok(srp_demand_create(prepared, GRID, NULL, &demand, &error), error);
    compare_look_ups(&srp_interp_bilinear, table, demand);
    compare_look_ups(&srp_interp_bicubic, table, demand);
    compare_nodes(table, demand);
    srp_demand_counts counts = srp_demand_count(demand);
    ck_assert_uint_eq(counts.computed, counts.ready); /* each once */
    srp_demand_destroy(demand);
    srp_table_destroy(table);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

static Suite *make_suite(bool is_long) {
    (void)is_long;
    Suite *suite = suite_create("gl_demand");
    TCase *tcase = tcase_create("gl_demand");
    tcase_add_loop_test(tcase, gives_the_bits_of_the_full_table, 0, 2);
    suite_add_tcase(suite, tcase);
    return suite;
}

int main(int argc, char **argv) {
    return gl_run(argc, argv, make_suite);
}
