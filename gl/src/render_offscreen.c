/* SPDX-License-Identifier: Apache-2.0 */
/* Pictures in memory, without a window. */
#include "error.h"
#include "render_internal.h"

#include <stdlib.h>
#include <string.h>

static srp_render_function find_in(void *user, const char *name) {
    const srp_gl_context *context = user;
    return context->device->provider->find(context->binding, name);
}

/* OpenGL has its rows from below, and what is copied has the opacity of whatever was there. */
static void turn_over(uint8_t *pixels, size_t width, size_t height) {
    for (size_t j = 0; j < (height + 1) / 2; ++j) {
        uint8_t *above = pixels + 4 * width * j, *below = pixels + 4 * width * (height - 1 - j);
        for (size_t i = 0; i < 4 * width; ++i) {
            uint8_t kept = above[i];
            above[i] = i % 4 == 3 ? 255 : below[i];
            below[i] = i % 4 == 3 ? 255 : kept;
        }
    }
}

static srp_status draw_view(const srp_gl_context *context, srp_renderer *renderer,
                            srp_render_target *target, const srp_render_view *view, uint8_t *pixels,
                            srp_error *error) {
    const srp_gl_functions *gl = &context->gl;
    srp_render_view moved = *view;
    moved.x = moved.y = 0;
    srp_status status = srp_render_check(renderer, view, error);
    if (status == SRP_OK) {
        status = srp_render_target_resize(context, target, view->width, view->height, 1, error);
    }
    if (status == SRP_OK) {
        status = srp_renderer_draw(renderer, &moved, error);
    }
    if (status == SRP_OK) {
        gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
        gl->ReadBuffer(GL_COLOR_ATTACHMENT0);
        gl->ReadPixels(0, 0, view->width, view->height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
        status = srp_gl_context_check(context, "reading a picture", error);
        turn_over(pixels, (size_t)view->width, (size_t)view->height);
    }
    return status;
}

static srp_status draw_views(srp_gl_context *context, const srp_scene *scene,
                             const srp_render_view *views, size_t count, uint8_t *const *pixels,
                             srp_error *error) {
    srp_renderer *renderer = NULL;
    srp_render_target target;
    memset(&target, 0, sizeof target);
    srp_status status = srp_renderer_create(find_in, context, &renderer, error);
    if (status == SRP_OK) {
        status = srp_renderer_set_scene(renderer, scene, error);
    }
    for (size_t k = 0; k < count && status == SRP_OK; ++k) {
        status = draw_view(context, renderer, &target, &views[k], pixels[k], error);
    }
    srp_render_target_clear(context, &target);
    srp_renderer_destroy(renderer);
    return status;
}

srp_status srp_render_offscreen(const char *device, const srp_scene *scene,
                                const srp_render_view *views, size_t count, uint8_t *const *pixels,
                                srp_error *error) {
    const srp_gl_device *found = srp_gl_device_find(device);
    if (found == NULL) {
        return srp_fail(error, SRP_NOT_FOUND, "no device '%.60s'", device);
    }
    srp_gl_context *context = NULL;
    srp_status status = srp_gl_context_create(found, &context, error);
    if (status != SRP_OK) {
        return status;
    }
    status = srp_gl_context_enter(context, error);
    if (status == SRP_OK) {
        status = draw_views(context, scene, views, count, pixels, error);
        srp_gl_context_leave(context);
    }
    srp_gl_context_destroy(context);
    return status;
}
