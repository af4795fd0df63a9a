/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The tables of the methods, one for each device: what a table is called and where it runs is all
 * that differs, and srp_method has no other place to say it.
 */
#include "methods.h"

#include "error.h"
#include "provider.h"

#include <srp/gl.h>

#include <stdio.h>
#include <string.h>

/* X(name in C, name, provider, index) */
#define DEVICES(X)                                                                                 \
    X(osmesa, "gl:osmesa", osmesa, SRP_GL_ANY_DEVICE)                                              \
    X(egl, "gl:egl", egl, SRP_GL_ANY_DEVICE)                                                       \
    X(egl_0, "gl:egl:0", egl, 0)                                                                   \
    X(egl_1, "gl:egl:1", egl, 1)                                                                   \
    X(egl_2, "gl:egl:2", egl, 2)                                                                   \
    X(egl_3, "gl:egl:3", egl, 3)                                                                   \
    X(egl_4, "gl:egl:4", egl, 4)                                                                   \
    X(egl_5, "gl:egl:5", egl, 5)                                                                   \
    X(egl_6, "gl:egl:6", egl, 6)                                                                   \
    X(egl_7, "gl:egl:7", egl, 7)                                                                   \
    X(egl_8, "gl:egl:8", egl, 8)                                                                   \
    X(egl_9, "gl:egl:9", egl, 9)                                                                   \
    X(egl_10, "gl:egl:10", egl, 10)                                                                \
    X(egl_11, "gl:egl:11", egl, 11)                                                                \
    X(egl_12, "gl:egl:12", egl, 12)                                                                \
    X(egl_13, "gl:egl:13", egl, 13)                                                                \
    X(egl_14, "gl:egl:14", egl, 14)                                                                \
    X(egl_15, "gl:egl:15", egl, 15)

/* A method on a device: function(s) of methods.h for what, and what it says of itself. */
#define METHOD(id, text, what, about, can)                                                         \
    static const srp_method what##_##id;                                                           \
    static srp_status prepare_##what##_##id(const srp_scene *scene,                                \
                                            const srp_method_params *params, srp_prepared **out,   \
                                            srp_error *error) {                                    \
        return srp_gl_##what##_prepare(&what##_##id, &device_##id, scene, params, out, error);     \
    }                                                                                              \
    static const srp_method what##_##id = {                                                        \
        .name = #what,                                                                             \
        .device = text,                                                                            \
        .summary = about,                                                                          \
        .shapes = SRP_SHAPE_MESH,                                                                  \
        .capabilities = can,                                                                       \
        .prepare = prepare_##what##_##id,                                                          \
        .respond = srp_gl_##what##_respond,                                                        \
        .release = srp_gl_##what##_release,                                                        \
    };

#define CAN_CAST (SRP_METHOD_BASIS | SRP_METHOD_LATTICE | SRP_METHOD_MOMENT)

#define DEFINE(id, text, provider, index)                                                          \
    static const srp_gl_device device_##id = {text, &srp_gl_##provider, index};                    \
    METHOD(id, text, raycast,                                                                      \
           "first-hit visibility sampled by a lattice of rays, drawn by OpenGL", CAN_CAST)         \
    METHOD(id, text, raytrace,                                                                     \
           "first hit and mirrored light solved exactly, the rest traced by OpenGL",               \
           CAN_CAST | SRP_METHOD_BOUNCE)
DEVICES(DEFINE)

#define LIST(id, text, provider, index) &raycast_##id, &raytrace_##id,
static const srp_method *const METHODS[] = {DEVICES(LIST)};

#define LIST_DEVICE(id, text, provider, index) &device_##id,
static const srp_gl_device *const DEVICE_LIST[] = {DEVICES(LIST_DEVICE)};

const srp_method *const *srp_gl_method_list(size_t *count) {
    *count = sizeof METHODS / sizeof METHODS[0];
    return METHODS;
}

const srp_gl_device *srp_gl_device_find(const char *name) {
    for (size_t k = 0; k < sizeof DEVICE_LIST / sizeof DEVICE_LIST[0]; ++k) {
        if (strcmp(DEVICE_LIST[k]->name, name) == 0) {
            return DEVICE_LIST[k];
        }
    }
    return NULL;
}

srp_status srp_gl_device_describe(const char *device, srp_gl_description *out, srp_error *error) {
    const srp_gl_device *found = srp_gl_device_find(device);
    if (found == NULL) {
        return srp_fail(error, SRP_NOT_FOUND, "no device '%.60s'", device);
    }
    srp_gl_context *context = NULL;
    srp_status status = srp_gl_context_create(found, &context, error);
    if (status == SRP_OK) {
        (void)snprintf(out->renderer, sizeof out->renderer, "%s", context->renderer);
        (void)snprintf(out->version, sizeof out->version, "%s", context->version);
        out->computes = context->computes;
        srp_gl_context_destroy(context);
    }
    return status;
}
