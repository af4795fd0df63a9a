/* SPDX-License-Identifier: Apache-2.0 */
#include "context.h"

#include "canvas.h"
#include "error.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef srp_gl_function (*finder)(void *user, const char *name);

static srp_gl_function find_by_provider(void *user, const char *name) {
    const srp_gl_context *context = user;
    return context->device->provider->find(context->binding, name);
}

/* False and *missing: the name of the first function that is not there. */
static bool load(srp_gl_context *context, finder find, void *user, const char **missing) {
    *missing = NULL;
#define LOAD(type, name)                                                                           \
    context->gl.name = (type)find(user, "gl" #name);                                               \
    *missing = context->gl.name == NULL && *missing == NULL ? "gl" #name : *missing;
    SRP_GL_FUNCTIONS_33(LOAD)
    if (context->computes) {
        SRP_GL_FUNCTIONS_43(LOAD)
    }
#undef LOAD
    return *missing == NULL;
}

static void copy_string(const srp_gl_context *context, GLenum which, char *out, size_t size) {
    const GLubyte *text = context->gl.GetString(which);
    (void)snprintf(out, size, "%s", text != NULL ? (const char *)text : "unknown");
}

/* Loads the functions and asks what the driver offers; the context is current. */
static srp_status learn(srp_gl_context *context, finder find, void *user, srp_error *error) {
    const char *missing;
    if (!load(context, find, user, &missing)) {
        return srp_fail(error, SRP_NO_DEVICE, "the OpenGL of %s lacks %s", context->device->name,
                        missing);
    }
    copy_string(context, GL_RENDERER, context->renderer, sizeof context->renderer);
    copy_string(context, GL_VERSION, context->version, sizeof context->version);
    GLint texture, renderbuffer;
    context->gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
    context->gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &renderbuffer);
    context->side_max = texture < renderbuffer ? texture : renderbuffer;
    context->gl.GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &context->texels_max);
    return srp_gl_context_check(context, "asking for its limits", error);
}

/* Two triangles over one another: drivers are known that draw nothing into targets of whole numbers
 * and report no error (softpipe of Mesa 22.3). */
static srp_status draw_two_triangles(srp_gl_context *context, srp_error *error) {
    enum { SIDE = 8, HALF = SIDE / 2 };
    /* The first covers most of the left half, the second the lower edge, in front of it. */
    static const float CORNERS[6][3] = {{-1.0F, -3.0F, 0.0F}, {0.0F, -3.0F, 0.0F},
                                        {0.0F, 5.0F, 0.0F},   {-1.0F, -1.0F, -0.5F},
                                        {3.0F, -1.0F, -0.5F}, {-1.0F, 0.0F, -0.5F}};
    static const uint32_t INDICES[6] = {0, 1, 2, 3, 4, 5};
    srp_gl_canvas canvas;
    srp_status status = srp_gl_canvas_create(context, &canvas, error);
    if (status != SRP_OK) {
        return status;
    }
    srp_gl_view view = {.scale = {1.0F, 1.0F}, .width = SIDE, .height = SIDE};
    uint32_t ids[SIDE * SIDE] = {0};
    status = srp_gl_canvas_resize(&canvas, SIDE, 1, error);
    if (status == SRP_OK) {
        srp_gl_canvas_send(&canvas, CORNERS[0], 6, INDICES, 6);
        srp_gl_canvas_begin(&canvas, 0, SIDE, SIDE);
        srp_gl_canvas_draw(&canvas, &view, 0, 2, 1);
        srp_gl_canvas_read(&canvas, 0, SIDE, SIDE, ids);
        status = srp_gl_context_check(context, "drawing two triangles", error);
    }
    srp_gl_canvas_clear(&canvas);
    if (status != SRP_OK) {
        return status;
    }
    /* Samples well inside: of the first alone, of the second alone, of both, of none. */
    uint32_t first = ids[HALF * SIDE + 3], second = ids[6], both = ids[1];
    uint32_t none = ids[(SIDE - 1) * SIDE + SIDE - 1];
    if (first != 1 || second != 2 || both != 2 || none != 0) {
        return srp_fail(
            error, SRP_NO_DEVICE,
            "%s (%s) draws two triangles as %u %u %u %u, expected 1 2 2 0: it cannot be "
            "used",
            context->device->name, context->renderer, first, second, both, none);
    }
    return SRP_OK;
}

static srp_status create_binding(srp_gl_context *context, srp_error *error) {
    const srp_gl_device *device = context->device;
    srp_status status = device->provider->create(device->index, 4, 3, &context->binding, error);
    context->computes = status == SRP_OK;
    if (status == SRP_NO_DEVICE) {
        srp_error second;
        status = device->provider->create(device->index, 3, 3, &context->binding, &second);
        if (status != SRP_OK && error != NULL) {
            *error = second;
        }
    }
    return status;
}

srp_status srp_gl_context_create(const srp_gl_device *device, srp_gl_context **out,
                                 srp_error *error) {
    srp_gl_context *context = calloc(1, sizeof *context);
    if (context == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a context of OpenGL");
    }
    context->device = device;
    srp_status status = create_binding(context, error);
    if (status == SRP_OK) {
        status = srp_gl_context_enter(context, error);
        if (status == SRP_OK) {
            status = learn(context, find_by_provider, context, error);
            if (status == SRP_OK) {
                status = draw_two_triangles(context, error);
            }
            srp_gl_context_leave(context);
        }
    }
    if (status != SRP_OK) {
        srp_gl_context_destroy(context);
        return status;
    }
    *out = context;
    return SRP_OK;
}

srp_status srp_gl_context_adopt(finder find, void *user, srp_gl_context *out, srp_error *error) {
    static const srp_gl_device CURRENT = {"the current context", NULL, SRP_GL_ANY_DEVICE};
    srp_gl_context context;
    memset(&context, 0, sizeof context);
    context.device = &CURRENT;
    srp_status status = learn(&context, find, user, error);
    if (status != SRP_OK) {
        return status;
    }
    GLint major = 0, minor = 0;
    context.gl.GetIntegerv(GL_MAJOR_VERSION, &major);
    context.gl.GetIntegerv(GL_MINOR_VERSION, &minor);
    if (strncmp(context.version, "OpenGL ES", 9) == 0 || major < 3 || (major == 3 && minor < 3)) {
        return srp_fail(error, SRP_NO_DEVICE, "%s is of version '%s', expected OpenGL 3.3 or later",
                        CURRENT.name, context.version);
    }
    *out = context;
    return SRP_OK;
}

void srp_gl_context_destroy(srp_gl_context *context) {
    if (context != NULL) {
        if (context->binding != NULL) {
            context->device->provider->destroy(context->binding);
        }
        free(context);
    }
}

srp_status srp_gl_context_enter(srp_gl_context *context, srp_error *error) {
    if (!context->device->provider->enter(context->binding)) {
        return srp_fail(error, SRP_NO_DEVICE, "%s: the context cannot be made current",
                        context->device->name);
    }
    return SRP_OK;
}

void srp_gl_context_leave(srp_gl_context *context) {
    context->device->provider->leave(context->binding);
}

srp_status srp_gl_context_check(const srp_gl_context *context, const char *what, srp_error *error) {
    GLenum code = context->gl.GetError();
    if (code == GL_NO_ERROR) {
        return SRP_OK;
    }
    if (code == GL_OUT_OF_MEMORY) {
        return srp_fail(error, SRP_NO_MEMORY, "%s (%s) has no memory for %s", context->device->name,
                        context->renderer, what);
    }
    return srp_fail(error, SRP_NO_DEVICE, "%s (%s) reports error 0x%04x while %s",
                    context->device->name, context->renderer, (unsigned)code, what);
}
