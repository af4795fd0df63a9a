/* SPDX-License-Identifier: Apache-2.0 */
/* What all methods share, and the two that need no visibility. */
#include "prepared.h"
#include "shapes.h"
#include "srp_check.h"

#include <srp/method.h>
#include <srp/sunlight.h>

#include <string.h>

static srp_prepared *prepare(const srp_method *method, const srp_scene *scene) {
    srp_method_params params = srp_method_params_default();
    return prepare_with(method, scene, &params);
}

START_TEST(cannonball_pushes_away_from_the_sun) {
    srp_scene *scene = NULL;
    srp_error error;
    assert_ok(srp_scene_from_sphere(1.37, 12.25, &scene, &error), error);
    srp_prepared *prepared = prepare(&srp_method_cannonball, scene);
    uint64_t seed = 1;
    for (int i = 0; i < 100; ++i) {
        srp_vec3 s = random_direction(&seed);
        srp_response response;
        assert_ok(srp_prepared_respond(prepared, 1, &s, &response, NULL, &error), error);
        assert_vec3_close(response.f, srp_vec3_scale(-1.37 * 12.25, s), 1e-15, 0.0);
        assert_close(response.lit_area, 12.25, 0.0, 0.0);
    }
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}
END_TEST

/* The facet formula of PHYSICS written out once more, for one plate. */
static srp_vec3 facet_force(srp_vec3 n, double area, srp_optics optics, srp_vec3 s) {
    double c = srp_vec3_dot(n, s);
    if (c <= 0.0) {
        return srp_vec3_make(0, 0, 0);
    }
    double along_s = (1.0 - optics.rho_s) * area * c;
    double along_n = 2.0 * (optics.rho_s * c + optics.rho_d / 3.0) * area * c;
    return srp_vec3_make(-along_s * s.x - along_n * n.x, -along_s * s.y - along_n * n.y,
                         -along_s * s.z - along_n * n.z);
}

START_TEST(nplate_is_the_sum_of_facets) {
    const srp_plate plates[3] = {{{0.6, 0.8, 0}, 2.5, {0.31, 0.27, false}},
                                 {{0, 0, -1}, 0.75, {0.05, 0.6, false}},
                                 {{-0.48, 0.6, 0.64}, 7.125, {0.9, 0.02, false}}};
    srp_scene *scene = NULL;
    srp_error error;
    assert_ok(srp_scene_from_plates(plates, 3, &scene, &error), error);
    srp_prepared *prepared = prepare(&srp_method_nplate, scene);
    uint64_t seed = 2;
    for (int i = 0; i < 200; ++i) {
        srp_vec3 s = random_direction(&seed), want = {0, 0, 0};
        double lit = 0.0;
        for (int k = 0; k < 3; ++k) {
            want = srp_vec3_add(want,
                                facet_force(plates[k].normal, plates[k].area, plates[k].optics, s));
            lit += plates[k].area * fmax(0.0, srp_vec3_dot(plates[k].normal, s));
        }
        srp_response response;
        srp_basis basis[4];
        assert_ok(srp_prepared_respond(prepared, 1, &s, &response, basis, &error), error);
        assert_vec3_close(response.f, want, 1e-14, 1e-15);
        assert_close(response.lit_area, lit, 1e-14, 1e-15);
        srp_vec3 f = {0, 0, 0}, t = {0, 0, 0};
        for (int k = 0; k < 3; ++k) {
            srp_basis_apply(&basis[k], plates[k].optics, s, &f, &t);
        }
        assert_vec3_close(f, response.f, 0.0, 0.0);
        assert_close(basis[3].a, 0.0, 0.0, 0.0);
    }
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}
END_TEST

enum { MANY = 500 };

START_TEST(threads_and_batches_do_not_matter) {
    const srp_plate plates[2] = {{{0.6, 0.8, 0}, 2.5, {0.31, 0.27, false}},
                                 {{0, 0, -1}, 0.75, {0.05, 0.6, false}}};
    srp_scene *scene = NULL;
    srp_error error;
    static srp_vec3 s[MANY];
    static srp_response one[MANY], many[MANY];
    uint64_t seed = 3;
    for (int i = 0; i < MANY; ++i) {
        s[i] = random_direction(&seed);
    }
    assert_ok(srp_scene_from_plates(plates, 2, &scene, &error), error);
    srp_method_params params = srp_method_params_default();
    srp_prepared *prepared = NULL;
    params.threads = 7;
    assert_ok(srp_method_prepare(&srp_method_nplate, scene, &params, &prepared, &error), error);
    assert_ok(srp_prepared_respond(prepared, MANY, s, many, NULL, &error), error);
    for (int i = 0; i < MANY; ++i) {
        assert_ok(srp_prepared_respond(prepared, 1, &s[i], &one[i], NULL, &error), error);
    }
    ck_assert_mem_eq(one, many, sizeof one);
    assert_ok(srp_prepared_respond(prepared, 0, NULL, NULL, NULL, &error), error);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(directions_must_be_unit) {
    srp_scene *scene = NULL;
    srp_error error;
    srp_response response;
    assert_ok(srp_scene_from_sphere(1.37, 12.25, &scene, &error), error);
    srp_prepared *prepared = prepare(&srp_method_cannonball, scene);
    const srp_vec3 bad[4] = {{0, 0, 0}, {1, 0, 1e-4}, {NAN, 0, 1}, {INFINITY, 0, 0}};
    for (int i = 0; i < 4; ++i) {
        ck_assert_int_eq(srp_prepared_respond(prepared, 1, &bad[i], &response, NULL, &error),
                         SRP_BAD_ARGUMENT);
    }
    srp_basis basis;
    srp_vec3 s = {0, 0, 1};
    ck_assert_int_eq(srp_prepared_respond(prepared, 1, &s, &response, &basis, &error),
                     SRP_UNSUPPORTED);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
    srp_prepared_release(NULL);
}
END_TEST

static void refuse(const srp_method *method, const srp_scene *scene,
                   const srp_method_params *params, srp_status want, const char *words) {
    srp_prepared *prepared = NULL;
    srp_error error;
    ck_assert_int_eq(srp_method_prepare(method, scene, params, &prepared, &error), want);
    ck_assert_msg(strstr(error.message, words) != NULL, "'%s' lacks '%s'", error.message, words);
    ck_assert_ptr_null(prepared);
}

START_TEST(parameters_are_checked) {
    srp_vec3 low = {0, 0, 0}, high = {1, 1, 1};
    const srp_optics grey = {0.3, 0.2, false};
    srp_scene *scene = shape_scene(shape_box(low, high, "foil"), grey);
    srp_method_params good = srp_method_params_default(), bad = good;
    refuse(&srp_method_cannonball, scene, &good, SRP_UNSUPPORTED,
           "cannonball cannot work on a mesh");
    bad.threads = 0;
    refuse(&srp_method_exact, scene, &bad, SRP_BAD_ARGUMENT, "threads");
    bad = good;
    bad.reference.y = NAN;
    refuse(&srp_method_exact, scene, &bad, SRP_BAD_ARGUMENT, "reference");
    bad.reference.y = -1e31;
    refuse(&srp_method_exact, scene, &bad, SRP_BAD_ARGUMENT, "reference point has a coordinate of");
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(pressure_at_one_au_is_the_papers) {
    srp_sunlight light = srp_sunlight_default();
    assert_close(srp_sunlight_pressure(light, SRP_AU), 4.55982e-6, 1e-6, 0.0);
    assert_close(srp_sunlight_pressure(light, 2.0 * SRP_AU), 0.25 * 1367.0 / 299792458.0, 1e-15,
                 0.0);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("method");
    TCase *tcase = tcase_create("method");
    tcase_add_test(tcase, cannonball_pushes_away_from_the_sun);
    tcase_add_test(tcase, nplate_is_the_sum_of_facets);
    tcase_add_test(tcase, threads_and_batches_do_not_matter);
    tcase_add_test(tcase, directions_must_be_unit);
    tcase_add_test(tcase, parameters_are_checked);
    tcase_add_test(tcase, pressure_at_one_au_is_the_papers);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
