/* SPDX-License-Identifier: Apache-2.0 */
/* Reflected light traced by OpenGL, against the processor's. */
#include "gl_fixture.h"
#include "model_files.h"
#include "prepared.h"
#include "raytrace_world.h"
#include "seed.h"
#include "shapes.h"
#include "srp_check.h"

#include <srp/gl.h>
#include <srp/table.h>

#include <string.h>

static srp_method_params params_of(uint32_t samples, uint32_t diffuse, uint32_t reflections) {
    srp_method_params params = srp_method_params_default();
    params.threads = 2;
    params.lattice.samples = samples;
    params.diffuse = diffuse;
    params.reflections = reflections;
    params.reference = srp_vec3_make(0.31, -0.27, 0.64);
    params.mirrored_beams = 0; /* mirrored light is sampled as well: that is what is compared */
    return params;
}

enum { DIRECTIONS = 8 };

static void some_directions(srp_vec3 s[DIRECTIONS], uint64_t seed) {
    for (int k = 0; k < DIRECTIONS; ++k) {
        s[k] = random_direction(&seed);
    }
}

/* Distance of two results over their combined standard error. */
static double sigmas(srp_vec3 a, double a_error, srp_vec3 b, double b_error) {
    double off = srp_vec3_norm(srp_vec3_sub(a, b)), sigma = hypot(a_error, b_error);
    return off == 0.0 ? 0.0 : off / sigma;
}

static void compare_scene(const char *name, const srp_scene *scene,
                          const srp_method_params *params) {
    srp_vec3 s[DIRECTIONS];
    srp_response cpu[DIRECTIONS], gl[DIRECTIONS];
    some_directions(s, 11);
    srp_prepared *want = prepare_with(&srp_method_raytrace, scene, params);
    srp_prepared *got = prepare_with(gl_method("raytrace"), scene, params);
    respond_each(want, DIRECTIONS, s, cpu);
    respond_each(got, DIRECTIONS, s, gl);
    double mean = 0.0, worst = 0.0, worst_t = 0.0;
    for (int k = 0; k < DIRECTIONS; ++k) {
        mean +=
            srp_vec3_norm(srp_vec3_sub(cpu[k].f, gl[k].f)) / srp_vec3_norm(cpu[k].f) / DIRECTIONS;
        worst = fmax(worst, sigmas(cpu[k].f, cpu[k].f_error, gl[k].f, gl[k].f_error));
        worst_t = fmax(worst_t, sigmas(cpu[k].t, cpu[k].t_error, gl[k].t, gl[k].t_error));
        /* The same paths: but for those that pass an edge on the other side, the same light. */
        assert_close(gl[k].unresolved, cpu[k].unresolved, 0.02, 1e-5);
        assert_close((double)gl[k].samples, (double)cpu[k].samples, 1e-3, 4.0);
        ck_assert_uint_eq(gl[k].flags, cpu[k].flags);
        assert_close(gl[k].lit_area, cpu[k].lit_area, 0.0, 0.0);
    }
    printf(
        "  %-12s K %u R %u: |f_gl - f_cpu| / |f| %.1e in the mean; at most %.3f standard errors, "
        "of t %.3f\n",
        name, params->diffuse, params->reflections, mean, worst, worst_t);
    ck_assert_double_lt(worst, 3.0);
    ck_assert_double_lt(worst_t, 3.0);
    srp_prepared_release(want);
    srp_prepared_release(got);
}

static void compare_model(const char *name, uint32_t samples, uint32_t diffuse,
                          uint32_t reflections) {
    model_file model = model_read(name);
    srp_scene *scene = model_scene(&model);
    srp_method_params params = params_of(samples, diffuse, reflections);
    compare_scene(name, scene, &params);
    srp_scene_destroy(scene);
    model_free(&model);
}

START_TEST(single_scattering_is_the_processors) {
    compare_model("box-wing", 256, 0, 2);
    compare_model("dish", 128, 0, 2);
    compare_model("sun-shield", 128, 0, 2);
    compare_model("l-corner", 128, 0, 5);
}
END_TEST

START_TEST(multiple_scattering_is_the_processors) {
    compare_model("box-wing", 128, 4, 2);
    compare_model("dish", 64, 4, 2);
    compare_model("sun-shield", 64, 4, 2);
    compare_model("l-corner", 64, 3, 6);
    compare_model("dihedral", 64, 1, 1);
}
END_TEST

/* Box and one-sided sheet: backs, and surfaces that cut each other. */
START_TEST(backs_and_windows_are_the_processors) {
    const srp_vec3 corners[4] = {
        {-0.9, -2.1, -1.7}, {2.6, -1.9, -1.4}, {2.4, 1.8, 1.6}, {-1.1, 2.2, 1.3}};
    const srp_triangle halves[2] = {{{0, 1, 2}}, {{0, 2, 3}}};
    for (int one_sided = 0; one_sided < 2; ++one_sided) {
        srp_mesh *mesh =
            shape_box(srp_vec3_make(-1.0, -0.3, -0.2), srp_vec3_make(0.9, 0.8, 1.1), "box");
        shape_join(mesh, shape_mesh(corners, 4, halves, 2, "sheet"));
        srp_scene *scene = shape_scene(mesh, (srp_optics){0.41, 0.33, one_sided != 0});
        srp_method_params params = params_of(200, 2, 3);
        compare_scene("box and sheet", scene, &params);
        params.lattice.kind = SRP_LATTICE_WINDOW;
        params.lattice.columns = 150;
        params.lattice.rows = 90;
        const double window[4] = {-1.2, 0.7, -2.3, 1.9}; /* cuts the model */
        memcpy(params.lattice.window, window, sizeof window);
        compare_scene("its window", scene, &params);
        srp_scene_destroy(scene);
    }
}
END_TEST

/* No bounce at all: all that reflects is unresolved; and so many that none is left. */
START_TEST(the_number_of_reflections_is_kept) {
    compare_model("l-corner", 100, 0, 0);
    compare_model("l-corner", 100, 2, 0);
    compare_model("dihedral", 40, 2, 30);
}
END_TEST

/* Mirrored light that is solved exactly is so on every device: nothing is traced. */
START_TEST(mirrored_beams_are_exact) {
    model_file model = model_read("box-wing");
    srp_scene *scene = model_scene(&model);
    srp_method_params params = params_of(64, 0, 2);
    params.mirrored_beams = 8192;
    srp_vec3 s[DIRECTIONS];
    srp_response cpu[DIRECTIONS], gl[DIRECTIONS];
    some_directions(s, 14);
    srp_prepared *want = prepare_with(&srp_method_raytrace, scene, &params);
    srp_prepared *got = prepare_with(gl_method("raytrace"), scene, &params);
    respond_each(want, DIRECTIONS, s, cpu);
    respond_each(got, DIRECTIONS, s, gl);
    ck_assert_mem_eq(cpu, gl, sizeof cpu);
    srp_prepared_release(want);
    srp_prepared_release(got);
    params.diffuse = 3;
    compare_scene("box-wing, exact mirrors", scene, &params);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

START_TEST(convex_bodies_are_exact) {
    model_file model = model_read("cube");
    srp_scene *scene = model_scene(&model);
    srp_method_params params = params_of(64, 4, 2);
    srp_vec3 s[DIRECTIONS];
    srp_response exact[DIRECTIONS], gl[DIRECTIONS];
    some_directions(s, 12);
    srp_prepared *want = prepare_with(&srp_method_exact, scene, &params);
    srp_prepared *got = prepare_with(gl_method("raytrace"), scene, &params);
    respond_each(want, DIRECTIONS, s, exact);
    respond_each(got, DIRECTIONS, s, gl);
    for (int k = 0; k < DIRECTIONS; ++k) {
        ck_assert_mem_eq(&gl[k].f, &exact[k].f, sizeof gl[k].f);
        ck_assert_double_eq(gl[k].f_error, 0.0);
    }
    srp_prepared_release(want);
    srp_prepared_release(got);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

START_TEST(runs_are_alike_to_the_bit) {
    model_file model = model_read("dish");
    srp_scene *scene = model_scene(&model);
    srp_method_params params = params_of(64, 3, 3);
    srp_vec3 s[DIRECTIONS];
    srp_response first[DIRECTIONS], second[DIRECTIONS];
    some_directions(s, 13);
    srp_prepared *prepared = prepare_with(gl_method("raytrace"), scene, &params);
    respond_each(prepared, DIRECTIONS, s, first);
    srp_prepared_release(prepared);
    params.threads = 1;
    prepared = prepare_with(gl_method("raytrace"), scene, &params);
    for (int k = 0; k < DIRECTIONS; ++k) {
        respond_each(prepared, 1, &s[k], &second[k]);
    }
    ck_assert_mem_eq(first, second, sizeof first);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

START_TEST(seeds_and_tolerance_count) {
    model_file model = model_read("l-corner");
    srp_scene *scene = model_scene(&model);
    srp_method_params params = params_of(16, 2, 2);
    srp_vec3 s = srp_direction_from_deg(51.0, 23.0);
    srp_response a, b;
    srp_prepared *prepared = prepare_with(gl_method("raytrace"), scene, &params);
    respond_each(prepared, 1, &s, &a);
    srp_prepared_release(prepared);
    params.seed = 77;
    params.tolerance = 1e-3;
    prepared = prepare_with(gl_method("raytrace"), scene, &params);
    respond_each(prepared, 1, &s, &b);
    srp_prepared_release(prepared);
    ck_assert_double_gt(a.f_error, 1e-3 * srp_vec3_norm(a.f));
    ck_assert_double_le(b.f_error, 1e-3 * srp_vec3_norm(b.f));
    ck_assert_double_lt(sigmas(a.f, a.f_error, b.f, b.f_error), 5.0);
    ck_assert_mem_ne(&a.f, &b.f, sizeof a.f);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

/* Points for the shader: what the processor would draw at random, word by word. */
START_TEST(points_are_the_processors) {
    enum { REFLECTIONS = 3 };
    srp_gl_texel points[REFLECTIONS * SRP_BOUNCE_COORDINATES * SRP_GL_POINT_TEXELS];
    srp_gl_write_points(0x123456789abcdefu, REFLECTIONS, points);
    for (uint32_t b = 0; b < REFLECTIONS; ++b) {
        for (int which = 0; which < SRP_BOUNCE_COORDINATES; ++which) {
            const uint32_t *word =
                points[(b * SRP_BOUNCE_COORDINATES + (uint32_t)which) * SRP_GL_POINT_TEXELS].word;
            uint64_t step = (uint64_t)word[5] << 32 | word[4];
            uint64_t base = (uint64_t)word[8 + 2 * 11 + 1] << 32 | word[8 + 2 * 11];
            ck_assert_uint_eq(step, srp_bounce_point_step(2, b, (srp_bounce_coordinate)which));
            ck_assert_uint_eq(base, srp_bounce_point_base(0x123456789abcdefu, 11, b,
                                                          (srp_bounce_coordinate)which));
        }
    }
}
END_TEST

static Suite *make_suite(bool is_long) {
    (void)is_long;
    Suite *suite = suite_create("gl_raytrace");
    TCase *tcase = tcase_create("gl_raytrace");
    tcase_add_test(tcase, single_scattering_is_the_processors);
    tcase_add_test(tcase, multiple_scattering_is_the_processors);
    tcase_add_test(tcase, backs_and_windows_are_the_processors);
    tcase_add_test(tcase, the_number_of_reflections_is_kept);
    tcase_add_test(tcase, mirrored_beams_are_exact);
    tcase_add_test(tcase, convex_bodies_are_exact);
    tcase_add_test(tcase, runs_are_alike_to_the_bit);
    tcase_add_test(tcase, seeds_and_tolerance_count);
    tcase_add_test(tcase, points_are_the_processors);
    suite_add_tcase(suite, tcase);
    return suite;
}

int main(int argc, char **argv) {
    return gl_run(argc, argv, make_suite);
}
