/* SPDX-License-Identifier: Apache-2.0 */
/* The methods in OpenGL meet the end of memory at each of their allocations in turn; see
 * tests/unit/test_alloc_failure.c. What the driver allocates is not touched. */
#include "gl_fixture.h"
#include "shapes.h"
#include "srp_check.h"

#include <srp/render.h>

#include <stdatomic.h>

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void __real_free(void *old);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
void __wrap_free(void *old);

static atomic_long until_failure; /* allocations that still succeed; below 0: failure is past */
static atomic_long held;          /* blocks taken and not given back */
static atomic_bool armed;

static bool fails(void) {
    return atomic_load(&armed) && atomic_fetch_sub(&until_failure, 1) == 0;
}

static void *taken(void *block) {
    if (block != NULL) {
        atomic_fetch_add(&held, 1);
    }
    return block;
}

void *__wrap_malloc(size_t size) {
    return fails() ? NULL : taken(__real_malloc(size));
}

void *__wrap_calloc(size_t count, size_t size) {
    return fails() ? NULL : taken(__real_calloc(count, size));
}

void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    return fails() ? NULL : taken(__real_aligned_alloc(alignment, size));
}

void *__wrap_realloc(void *old, size_t size) {
    if (fails()) {
        return NULL;
    }
    void *block = __real_realloc(old, size);
    return old == NULL ? taken(block) : block;
}

void __wrap_free(void *old) {
    if (old != NULL) {
        atomic_fetch_sub(&held, 1);
    }
    __real_free(old);
}

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

/* Of a method, or of pictures when `name` is NULL. */
static void exhaust(const char *name) {
    const srp_vec3 v[] = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
    const srp_triangle t[] = {{{0, 1, 2}}, {{0, 3, 1}}};
    srp_mesh *mesh = shape_box(srp_vec3_make(-1, -1.5, -2), srp_vec3_make(1.25, 1, 3), "gold");
    shape_join(mesh, shape_mesh(v, 4, t, 2, "cells"));
    srp_scene *scene = shape_scene(mesh, (srp_optics){0.5, 0.25, false});
    long count = 0;
    srp_status status = SRP_NO_MEMORY;
    for (; status == SRP_NO_MEMORY; ++count) {
        srp_error error = {.status = SRP_OK};
        long before = atomic_load(&held);
        atomic_store(&until_failure, count);
        atomic_store(&armed, true);
        status =
            name != NULL ? try_method(gl_method(name), scene, &error) : try_picture(scene, &error);
        atomic_store(&armed, false);
        long kept = atomic_load(&held) - before; /* libcheck takes memory, too */
        ck_assert_msg(status == SRP_OK || status == SRP_NO_MEMORY, "%s, allocation %ld: %s",
                      name != NULL ? name : "pictures", count, error.message);
        ck_assert_int_eq(error.status, status);
        ck_assert_msg(kept == 0, "%s, allocation %ld: %ld blocks kept",
                      name != NULL ? name : "pictures", count, kept);
    }
    ck_assert_int_gt(count, 10);
    printf("  %s: %ld allocations\n", name != NULL ? name : "pictures", count - 1);
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
