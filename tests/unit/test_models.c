/* SPDX-License-Identifier: Apache-2.0 */
/* The files of models/ are what models/README.md says. That they are what the generator writes is
 * tests/models. */
#include "model_files.h"
#include "srp_check.h"

#include <srp/plates.h>

#include <string.h>

typedef struct expected {
    const char *name;
    size_t triangles, components, closed_components, boundary_edges, materials;
    double volume; /* of the closed parts [m^3]; NAN: not a round number */
} expected;

/* Boundary edges: two plates have 3 each; the rims of five membranes of 18 x 14 cells and of a dish
 * of 20 segments; the reflector of 48 segments. */
static const expected WANT[] = {
    {"cube", 12, 1, 1, 0, 1, 8.0},
    {"icosphere-80", 80, 1, 1, 0, 1, NAN},
    {"icosphere-320", 320, 1, 1, 0, 1, NAN},
    {"icosphere-1280", 1280, 1, 1, 0, 1, NAN},
    {"l-corner", 4, 1, 0, 6, 1, 0.0},
    {"dihedral", 4, 1, 0, 6, 1, 0.0},
    {"box-wing", 60, 5, 5, 0, 4, 8.0 + 2.0 * (2.0 * 8.0 * 0.025 + 0.08 * 0.08 * 0.48)},
    {"dish", 1452, 7, 6, 48, 4, NAN},
    {"sun-shield", 3508, 34, 28, 5 * 2 * (18 + 14) + 20, 7, NAN},
    {"gnss", 27052, 92, 92, 0, 7, NAN},
};

START_TEST(model_is_as_described) {
    const expected *want = &WANT[_i];
    ck_assert_str_eq(want->name, MODEL_NAMES[_i]);
    model_file model = model_read(want->name);
    srp_error error;
    srp_mesh_report report;
    assert_ok(srp_mesh_inspect(model.mesh, &report, &error), error);
    printf("%s: %zu triangles in %zu parts, %zu closed, area %.6g m^2, volume %.6g m^3\n",
           want->name, report.triangles, report.components, report.closed_components, report.area,
           report.volume);
    ck_assert_uint_eq(report.triangles, want->triangles);
    ck_assert_uint_eq(report.faces_triangle, want->triangles);
    ck_assert_uint_eq(report.components, want->components);
    ck_assert_uint_eq(report.closed_components, want->closed_components);
    ck_assert_uint_eq(report.boundary_edges, want->boundary_edges);
    ck_assert_uint_eq(srp_mesh_material_count(model.mesh), want->materials);
    ck_assert_uint_eq(report.nonmanifold_edges, 0);
    ck_assert_uint_eq(report.inconsistent_edges, 0);
    ck_assert_uint_eq(report.inward_components, 0);
    ck_assert_uint_eq(report.degenerate, 0);
    ck_assert_uint_eq(report.duplicate, 0);
    ck_assert_uint_eq(report.opposite, 0);
    if (!isnan(want->volume)) {
        assert_close(report.volume, want->volume, 1e-12, 0.0);
    }
    if (want->boundary_edges == 0) {
        assert_vec3_close(report.area_vector_sum, srp_vec3_make(0.0, 0.0, 0.0), 0.0,
                          1e-12 * report.area);
    }
    model_free(&model);
}
END_TEST

START_TEST(materials_have_optics_and_are_used) {
    model_file model = model_read(MODEL_NAMES[_i]);
    size_t count = srp_mesh_material_count(model.mesh);
    ck_assert_uint_eq(srp_materials_count(model.materials), count);
    double area[32];
    srp_error error;
    ck_assert_uint_le(count, sizeof area / sizeof area[0]);
    assert_ok(srp_mesh_material_areas(model.mesh, area, &error), error);
    for (size_t i = 0; i < count; ++i) {
        srp_optics optics;
        ck_assert(
            srp_materials_find(model.materials, srp_mesh_material_name(model.mesh, i), &optics));
        assert_ok(srp_optics_check(optics, &error), error);
        ck_assert(area[i] > 0.0);
    }
    model_free(&model);
}
END_TEST

START_TEST(spheres_lie_on_the_sphere) {
    static const char *const names[] = {"icosphere-80", "icosphere-320", "icosphere-1280"};
    model_file model = model_read(names[_i]);
    const srp_vec3 *v = srp_mesh_vertices(model.mesh);
    /* Corners of the icosahedron: none has all three coordinates, long side over short is phi. */
    assert_close(fabs(v[0].z / v[0].y), (1.0 + sqrt(5.0)) / 2.0, 1e-15, 0.0);
    ck_assert(v[0].x == 0.0);
    for (size_t i = 0; i < srp_mesh_vertex_count(model.mesh); ++i) {
        assert_close(srp_vec3_norm(v[i]), 1.0, 3e-16, 0.0);
    }
    model_free(&model);
}
END_TEST

static size_t read_plates(const char *name, srp_plate **plates) {
    char path[1024];
    size_t count = 0;
    srp_error error;
    (void)snprintf(path, sizeof path, "%s/%s.plates", SRP_MODELS_DIR, name);
    assert_ok(srp_plates_read(path, plates, &count, &error), error);
    return count;
}

START_TEST(plates_of_cube_and_box_wing) {
    srp_plate *plates = NULL;
    ck_assert_uint_eq(read_plates("cube", &plates), 6);
    double area = 0.0;
    for (size_t i = 0; i < 6; ++i) {
        area += plates[i].area;
        ck_assert(plates[i].optics.rho_s == 0.5 && plates[i].optics.rho_d == 0.1);
    }
    ck_assert(area == 24.0);
    srp_plates_free(plates);

    plates = NULL;
    ck_assert_uint_eq(read_plates("box-wing", &plates), 8);
    srp_optics cells;
    model_file model = model_read("box-wing");
    ck_assert(srp_materials_find(model.materials, "cells", &cells));
    ck_assert(plates[6].area == 32.0 && plates[7].area == 32.0);
    ck_assert(plates[6].optics.rho_s == cells.rho_s && plates[6].optics.rho_d == cells.rho_d);
    model_free(&model);
    srp_plates_free(plates);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("models");
    TCase *tcase = tcase_create("models");
    tcase_set_timeout(tcase, 60.0);
    tcase_add_loop_test(tcase, model_is_as_described, 0, (int)MODEL_COUNT);
    tcase_add_loop_test(tcase, materials_have_optics_and_are_used, 0, (int)MODEL_COUNT);
    tcase_add_loop_test(tcase, spheres_lie_on_the_sphere, 0, 3);
    tcase_add_test(tcase, plates_of_cube_and_box_wing);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
