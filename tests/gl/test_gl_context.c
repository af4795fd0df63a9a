/* SPDX-License-Identifier: Apache-2.0 */
/* Contexts: made, used on several threads, refused, and told about. */
#define _POSIX_C_SOURCE 200112L /* setenv */

#include "context.h"
#include "gl_fixture.h"
#include "program.h"
#include "shapes.h"
#include "srp_check.h"

#include <srp/gl.h>

#include <stdlib.h>
#include <string.h>

/* Gives the environment back as it was. */
typedef struct setting {
    const char *name;
    char before[64];
    bool was_set;
} setting;

static setting set(const char *name, const char *value) {
    setting old = {name, "", getenv(name) != NULL};
    if (old.was_set) {
        (void)snprintf(old.before, sizeof old.before, "%s", getenv(name));
    }
    setenv(name, value, 1);
    return old;
}

static void reset(const setting *old) {
    if (old->was_set) {
        setenv(old->name, old->before, 1);
    } else {
        unsetenv(old->name);
    }
}

static srp_error refused(const char *device) {
    srp_gl_description description;
    srp_error error;
    memset(&description, 0x5a, sizeof description);
    srp_gl_description before = description;
    ck_assert_int_eq(srp_gl_device_describe(device, &description, &error), SRP_NO_DEVICE);
    ck_assert_mem_eq(&description, &before, sizeof before);
    return error;
}

static bool says(const srp_error *error, const char *text) {
    if (strstr(error->message, text) == NULL) {
        printf("'%s' lacks '%s'\n", error->message, text);
        return false;
    }
    return true;
}

START_TEST(devices_are_described) {
    srp_gl_description description;
    srp_error error;
    assert_ok(srp_gl_device_describe(gl_device_name, &description, &error), error);
    ck_assert_str_ne(description.renderer, "");
    ck_assert_str_ne(description.version, "");
    ck_assert_int_eq(srp_gl_device_describe("gl:nonesuch", &description, &error), SRP_NOT_FOUND);
    ck_assert_int_eq(srp_gl_device_describe("gl:nonesuch", &description, NULL), SRP_NOT_FOUND);
}
END_TEST

START_TEST(both_methods_are_on_every_device) {
    size_t count;
    const srp_method *const *methods = srp_gl_method_list(&count);
    ck_assert_uint_eq(count, 36); /* OSMesa, EGL, 16 of EGL's devices */
    for (size_t k = 0; k < count; ++k) {
        const char *name = k % 2 == 0 ? "raycast" : "raytrace";
        ck_assert_str_eq(methods[k]->name, name);
        ck_assert_ptr_eq(gl_method_on(methods[k]->device, name), methods[k]);
        ck_assert_uint_ne(methods[k]->capabilities & SRP_METHOD_LATTICE, 0);
    }
}
END_TEST

START_TEST(unknown_drivers_are_refused) {
    if (strcmp(gl_device_name, "gl:osmesa") != 0) {
        return; /* EGL on a GPU does not ask for it */
    }
    static const char *const NAMES[] = {"swr", "zink", "llvmpip", "llvmpipe "};
    for (size_t k = 0; k < sizeof NAMES / sizeof NAMES[0]; ++k) {
        setting old = set("GALLIUM_DRIVER", NAMES[k]);
        srp_error error = refused("gl:osmesa");
        ck_assert(says(&error, "GALLIUM_DRIVER is"));
        ck_assert(says(&error, NAMES[k]));
        reset(&old);
    }
}
END_TEST

START_TEST(settings_that_crash_drivers_are_refused) {
    const bool osmesa = strcmp(gl_device_name, "gl:osmesa") == 0;
    const char *name = osmesa ? "MESA_GLSL_VERSION_OVERRIDE" : "GALLIUM_DRIVER";
    setting old = set(name, osmesa ? "120" : "virpipe");
    srp_error error = refused(gl_device_name);
    ck_assert(says(&error, name));
    reset(&old);
}
END_TEST

START_TEST(devices_that_are_not_there_are_refused) {
    if (strcmp(gl_device_name, "gl:egl") != 0) {
        return;
    }
    srp_error error = refused("gl:egl:15");
    ck_assert(says(&error, "there is no number 15"));
    /* Also when no ray would be traced there. */
    srp_scene *scene =
        shape_scene(shape_box(srp_vec3_make(-1.0, -1.0, -1.0), srp_vec3_make(1.0, 1.0, 1.0), "box"),
                    (srp_optics){0.3, 0.2, false});
    srp_prepared *prepared = NULL;
    srp_method_params params = srp_method_params_default();
    ck_assert_int_eq(srp_method_prepare(gl_method_on("gl:egl:15", "raytrace"), scene, &params,
                                        &prepared, &error),
                     SRP_NO_DEVICE);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(methods_say_what_is_missing_when_they_are_prepared) {
    setting old = set("GALLIUM_DRIVER", "swr");
    srp_scene *scene =
        shape_scene(shape_box(srp_vec3_make(-1.0, -1.0, -1.0), srp_vec3_make(1.0, 1.0, 1.0), "box"),
                    (srp_optics){0.3, 0.2, false});
    srp_prepared *prepared = NULL;
    srp_method_params params = srp_method_params_default();
    srp_error error;
    ck_assert_int_eq(
        srp_method_prepare(gl_method_on("gl:osmesa", "raycast"), scene, &params, &prepared, &error),
        SRP_NO_DEVICE);
    ck_assert_ptr_null(prepared);
    srp_scene_destroy(scene);
    reset(&old);
}
END_TEST

static const srp_gl_device *test_device(void) {
    static const srp_gl_device OSMESA = {"gl:osmesa", &srp_gl_osmesa, SRP_GL_ANY_DEVICE};
    static const srp_gl_device EGL = {"gl:egl", &srp_gl_egl, SRP_GL_ANY_DEVICE};
    return strcmp(gl_device_name, "gl:egl") == 0 ? &EGL : &OSMESA;
}

START_TEST(contexts_come_and_go) {
    enum { AT_A_TIME = 5, ROUNDS = 8 };
    for (int round = 0; round < ROUNDS; ++round) {
        srp_gl_context *contexts[AT_A_TIME] = {NULL};
        srp_error error;
        for (int k = 0; k < AT_A_TIME; ++k) {
            assert_ok(srp_gl_context_create(test_device(), &contexts[k], &error), error);
        }
        for (int k = 0; k < AT_A_TIME; ++k) {
            assert_ok(srp_gl_context_enter(contexts[k], &error), error);
            assert_ok(srp_gl_context_check(contexts[k], "nothing", &error), error);
            srp_gl_context_leave(contexts[k]);
        }
        for (int k = AT_A_TIME; k-- > 0;) {
            srp_gl_context_destroy(contexts[k]);
        }
    }
    srp_gl_context_destroy(NULL);
}
END_TEST

START_TEST(shaders_that_do_not_compile_name_the_line) {
    static const srp_gl_source WRONG = {
        "gl/src/shaders/wrong.vert.glsl",
        "// one\n\nvoid main() {\n    gl_Position = nonesuch;\n}\n"};
    static const srp_gl_stage STAGE = {GL_VERTEX_SHADER, &WRONG};
    srp_gl_context *context = NULL;
    srp_error error;
    assert_ok(srp_gl_context_create(test_device(), &context, &error), error);
    assert_ok(srp_gl_context_enter(context, &error), error);
    GLuint program = 4711;
    ck_assert_int_eq(srp_gl_program_create(context, "#version 330 core\n#define A 1\n", &STAGE, 1,
                                           &program, &error),
                     SRP_NO_DEVICE);
    ck_assert_uint_eq(program, 4711);
    ck_assert_str_eq(error.file, "gl/src/shaders/wrong.vert.glsl");
    ck_assert_uint_eq(error.line, 4);
    ck_assert(says(&error, "nonesuch"));
    srp_gl_context_leave(context);
    srp_gl_context_destroy(context);
}
END_TEST

/* One prepared method asked from several threads, each with a context of its own, and another on
 * the other provider at the same time. */
START_TEST(threads_have_contexts_of_their_own) {
    enum { THREADS = 4, COUNT = 6 };
    srp_mesh *mesh =
        shape_box(srp_vec3_make(-1.0, -0.3, -0.2), srp_vec3_make(0.9, 0.8, 1.1), "box");
    srp_scene *scene = shape_scene(mesh, (srp_optics){0.31, 0.23, false});
    const char *other = strcmp(gl_device_name, "gl:osmesa") == 0 ? "gl:egl" : "gl:osmesa";
    bool both = gl_device_is_there(other);
    srp_method_params params = srp_method_params_default();
    params.threads = 1;
    params.lattice.samples = 200;
    srp_prepared *prepared[2] = {NULL, NULL};
    srp_error error;
    assert_ok(srp_method_prepare(gl_method("raycast"), scene, &params, &prepared[0], &error),
              error);
    assert_ok(srp_method_prepare(both ? gl_method_on(other, "raycast") : gl_method("raycast"),
                                 scene, &params, &prepared[1], &error),
              error);
    uint64_t seed = 3;
    srp_vec3 s[COUNT];
    for (int k = 0; k < COUNT; ++k) {
        s[k] = random_direction(&seed);
    }
    srp_response want[2][COUNT], got[THREADS][COUNT];
    srp_status status[THREADS];
    for (int p = 0; p < 2; ++p) {
        assert_ok(srp_prepared_respond(prepared[p], COUNT, s, want[p], NULL, &error), error);
    }
#pragma omp parallel for num_threads(THREADS) schedule(static, 1)
    for (int k = 0; k < THREADS; ++k) {
        status[k] = srp_prepared_respond(prepared[k % 2], COUNT, s, got[k], NULL, NULL);
    }
    for (int k = 0; k < THREADS; ++k) {
        ck_assert_int_eq(status[k], SRP_OK);
        ck_assert_mem_eq(got[k], want[k % 2], sizeof got[k]);
    }
    srp_prepared_release(prepared[0]);
    srp_prepared_release(prepared[1]);
    srp_scene_destroy(scene);
}
END_TEST

static Suite *make_suite(bool is_long) {
    (void)is_long;
    Suite *suite = suite_create("gl_context");
    TCase *tcase = tcase_create("gl_context");
    tcase_add_test(tcase, devices_are_described);
    tcase_add_test(tcase, both_methods_are_on_every_device);
    tcase_add_test(tcase, unknown_drivers_are_refused);
    tcase_add_test(tcase, settings_that_crash_drivers_are_refused);
    tcase_add_test(tcase, devices_that_are_not_there_are_refused);
    tcase_add_test(tcase, methods_say_what_is_missing_when_they_are_prepared);
    tcase_add_test(tcase, contexts_come_and_go);
    tcase_add_test(tcase, shaders_that_do_not_compile_name_the_line);
    tcase_add_test(tcase, threads_have_contexts_of_their_own);
    suite_add_tcase(suite, tcase);
    return suite;
}

/* Drivers choose their renderer once in a process: for another one this runs again, with the
 * environment set. Exit status of a program that was told DEVICE refused TEXT. */
static int expect_refusal(const char *device, const char *text) {
    srp_gl_description description;
    srp_error error = {.status = SRP_OK, .message = ""};
    srp_status status = srp_gl_device_describe(device, &description, &error);
    if (status == SRP_OK && strstr(description.renderer, "llvmpipe") == NULL) {
        printf("skipped: %s is %s here\n", device, description.renderer);
        return EXIT_SUCCESS;
    }
    printf("%s: %s\n", device, status == SRP_OK ? description.renderer : error.message);
    if (strstr(error.message, "no OSMesa on this machine") != NULL ||
        strstr(error.message, "no EGL on this machine") != NULL) {
        printf("skipped: %s\n", error.message);
        return EXIT_SUCCESS;
    }
    return status == SRP_NO_DEVICE && says(&error, text) ? EXIT_SUCCESS : EXIT_FAILURE;
}

int main(int argc, char **argv) {
    if (argc == 4 && strcmp(argv[2], "refused") == 0) {
        return expect_refusal(argv[1], argv[3]);
    }
    return gl_run(argc, argv, make_suite);
}
