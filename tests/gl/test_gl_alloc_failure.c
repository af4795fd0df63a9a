/* SPDX-License-Identifier: Apache-2.0 */
/* The methods in OpenGL meet the end of memory at each of their allocations in turn; see
 * tests/unit/test_alloc_failure.c. What the driver allocates is not touched. */
#include "failing_alloc.h"
#include "gl_fixture.h"
#include "shapes.h"
#include "srp_check.h"

#include <srp/render.h>

static srp_status try_method(const srp_method *method, const srp_scene *scene, srp_error *error) {
    srp_prepared *prepared = NULL;
    srp_response responses[3];
    const srp_vec3 s[3] = {{1, 0, 0}, {0, 0.6, 0.8}, {-0.6, 0.64, 0.48}};
    srp_method_params params = srp_method_params_default();
    params.threads = 1;
    params.lattice.samples = 32;
    params.diffuse = 2;
    srp_status status = srp_method_prepare(method, scene, &params, &prepared, error);
    if (status != SRP_OK) {
        return prepared == NULL ? status : SRP_MISMATCH;
    }
    status = srp_prepared_respond(prepared, 3, s, responses, NULL, error);
    srp_prepared_release(prepared);
    return status;
}

static srp_status try_picture(const srp_scene *scene, srp_error *error) {
    static uint8_t pixels[32 * 32 * 4];
    uint8_t *out = pixels;
    const srp_render_arrow arrow = {.to = {3, 2, 1}};
    srp_render_view view = srp_render_view_default();
    view.width = view.height = 32;
    view.camera = srp_render_camera_fit(scene, 0.5, 0.25, 1.0);
    view.sun = srp_vec3_make(0.48, 0.6, 0.64);
    view.arrows = &arrow;
    view.arrow_count = 1;
    return srp_render_offscreen(gl_device_name, scene, &view, 1, &out, error);
}

typedef struct attempt {
    const char *method; /* NULL: pictures */
    const srp_scene *scene;
} attempt;

static srp_status run_attempt(void *user, srp_error *error) {
    const attempt *a = user;
    return a->method != NULL ? try_method(gl_method(a->method), a->scene, error)
                             : try_picture(a->scene, error);
}

static void exhaust(const char *method) {
    const srp_vec3 v[] = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
    const srp_triangle t[] = {{{0, 1, 2}}, {{0, 3, 1}}};
    srp_mesh *mesh = shape_box(srp_vec3_make(-1, -1.5, -2), srp_vec3_make(1.25, 1, 3), "gold");
    shape_join(mesh, shape_mesh(v, 4, t, 2, "cells"));
    srp_scene *scene = shape_scene(mesh, (srp_optics){0.5, 0.25, false});
    attempt a = {method, scene};
    long count = failing_alloc_exhaust(method != NULL ? method : "pictures", run_attempt, &a);
    ck_assert_int_gt(count, 10);
    srp_scene_destroy(scene);
}

START_TEST(raycast_gives_back_what_it_took) {
    exhaust("raycast");
}
END_TEST

START_TEST(raytrace_gives_back_what_it_took) {
    exhaust("raytrace");
}
END_TEST

START_TEST(pictures_give_back_what_they_took) {
    exhaust(NULL);
}
END_TEST

static Suite *make_suite(bool is_long) {
    (void)is_long;
    Suite *suite = suite_create("gl_alloc_failure");
    TCase *tcase = tcase_create("gl_alloc_failure");
    tcase_add_test(tcase, raycast_gives_back_what_it_took);
    tcase_add_test(tcase, raytrace_gives_back_what_it_took);
    tcase_add_test(tcase, pictures_give_back_what_they_took);
    suite_add_tcase(suite, tcase);
    return suite;
}

int main(int argc, char **argv) {
    return gl_run(argc, argv, make_suite);
}
