/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A real spacecraft: bus and high-gain antenna of the Lunar Reconnaissance Orbiter, open surfaces,
 * mixed polygons, no MTL. Exact and raycast must tell the same story: they differ by no more than
 * the raycast's own estimate. `test_lro long` does so on a table of 5 degrees, without it on 30.
 */
#include "srp_check.h"

#include <srp/method.h>
#include <srp/scene.h>
#include <srp/table.h>

#include <string.h>

static double step_deg = 30.0;

static const char BUS[] = SRP_SHARED_DATA_DIR "/lro/bus.obj";
static const char ANTENNA[] = SRP_SHARED_DATA_DIR "/lro/HGA.obj";

static bool data_is_there(void) {
    FILE *file = fopen(BUS, "rb");
    if (file == NULL) {
        printf("skipped: %s is not there\n", BUS);
        return false;
    }
    (void)fclose(file);
    return true;
}

static srp_materials *paint(void) {
    static const struct {
        const char *name;
        srp_optics optics;
    } given[] = {
        {"foil_gold", {0.52, 0.13, false}},        {"foil_silver", {0.61, 0.21, false}},
        {"foil_silver_dish", {0.33, 0.42, false}}, {"shiny_panel", {0.17, 0.04, false}},
        {"tex_01", {0.08, 0.27, false}},           {"tex_02", {0.22, 0.31, false}},
        {"tex_03", {0.05, 0.07, false}},
    };
    srp_error error;
    srp_materials *materials = NULL;
    assert_ok(srp_materials_create(&materials, &error), error);
    for (size_t i = 0; i < sizeof given / sizeof given[0]; ++i) {
        assert_ok(srp_materials_set(materials, given[i].name, given[i].optics, true, &error),
                  error);
    }
    return materials;
}

static srp_mesh_report inspect(const char *path) {
    srp_error error;
    srp_mesh *mesh = NULL;
    srp_mesh_report report;
    srp_mesh_read_params params = srp_mesh_read_params_default();
    assert_ok(srp_mesh_read_obj(path, &params, NULL, &mesh, &error), error);
    assert_ok(srp_mesh_inspect(mesh, &report, &error), error);
    srp_mesh_destroy(mesh);
    return report;
}

START_TEST(inspection_tells_what_is_known_of_it) {
    if (!data_is_there()) {
        return;
    }
    srp_mesh_report bus = inspect(BUS), antenna = inspect(ANTENNA);
    ck_assert_uint_eq(bus.triangles, 5362);
    ck_assert_uint_eq(antenna.triangles, 576);
    ck_assert(bus.faces_triangle > 0 && bus.faces_quad > 0);
    /* Not a closed surface: it has rims, and its signed areas do not add up to 0. */
    ck_assert(bus.boundary_edges > 0 && bus.closed_components < bus.components);
    ck_assert(srp_vec3_norm(bus.area_vector_sum) > 1e-3 * bus.area);
}
END_TEST

/* Without the MTL that it names, the message says which material lacks its optics. */
START_TEST(missing_optics_are_named) {
    if (!data_is_there()) {
        return;
    }
    const char *const paths[] = {BUS};
    srp_error error;
    srp_scene *scene = NULL;
    srp_mesh_read_params params = srp_mesh_read_params_default();
    srp_status status = srp_scene_read_obj(paths, 1, &params, NULL, NULL, &scene, &error);
    ck_assert_int_eq(status, SRP_NOT_FOUND);
    ck_assert_msg(strstr(error.message, "foil_") != NULL || strstr(error.message, "tex_") != NULL ||
                      strstr(error.message, "shiny_panel") != NULL,
                  "%s", error.message);
    ck_assert_ptr_null(scene);
}
END_TEST

static srp_table *table_by(const srp_method *method, const srp_scene *scene) {
    srp_error error;
    srp_method_params params = srp_method_params_default();
    srp_prepared *prepared = NULL;
    srp_grid grid;
    srp_table *table = NULL;
    params.lattice.samples = 1024;
    assert_ok(srp_method_prepare(method, scene, &params, &prepared, &error), error);
    assert_ok(srp_grid_from_steps(step_deg, step_deg, &grid, &error), error);
    assert_ok(srp_table_create(prepared, grid, false, &table, &error), error);
    assert_ok(srp_table_fill(table, prepared, NULL, &error), error);
    srp_prepared_release(prepared);
    return table;
}

START_TEST(exact_and_raycast_agree) {
    if (!data_is_there()) {
        return;
    }
    const char *const paths[] = {BUS, ANTENNA};
    srp_error error;
    srp_scene *scene = NULL;
    srp_materials *materials = paint();
    srp_mesh_read_params params = srp_mesh_read_params_default();
    assert_ok(srp_scene_read_obj(paths, 2, &params, materials, NULL, &scene, &error), error);
    srp_table *exact = table_by(&srp_method_exact, scene);
    srp_table *raycast = table_by(&srp_method_raycast, scene);

    srp_grid grid = srp_table_grid(exact);
    size_t nodes = srp_grid_node_count(grid), within = 0;
    double largest = 0.0, sum = 0.0;
    for (uint32_t i = 0; i < grid.az_count; ++i) {
        for (uint32_t j = 0; j < grid.el_count; ++j) {
            const srp_response *want = srp_table_node(exact, i, j);
            const srp_response *got = srp_table_node(raycast, i, j);
            double off = srp_vec3_norm(srp_vec3_sub(got->f, want->f));
            double relative = off / srp_vec3_norm(want->f);
            ck_assert(want->f_error == 0.0 && got->f_error > 0.0);
            within += off <= 3.0 * got->f_error;
            largest = fmax(largest, relative);
            sum += relative;
        }
    }
    printf("LRO, %g degrees: %.2f %% of %zu nodes within 3 estimated errors; relative difference "
           "mean %.2e, largest %.2e\n",
           step_deg, 100.0 * (double)within / (double)nodes, nodes, sum / (double)nodes, largest);
    ck_assert((double)within >= 0.97 * (double)nodes);
    ck_assert(sum / (double)nodes < 1e-3);
    srp_table_destroy(exact);
    srp_table_destroy(raycast);
    srp_scene_destroy(scene);
    srp_materials_destroy(materials);
}
END_TEST

int main(int argc, char **argv) {
    if (argc > 1 && strcmp(argv[1], "long") == 0) {
        step_deg = 5.0;
    }
    Suite *suite = suite_create("lro");
    TCase *tcase = tcase_create("lro");
    tcase_set_timeout(tcase, 900.0);
    tcase_add_test(tcase, inspection_tells_what_is_known_of_it);
    tcase_add_test(tcase, missing_optics_are_named);
    tcase_add_test(tcase, exact_and_raycast_agree);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
