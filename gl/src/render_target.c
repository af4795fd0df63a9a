/* SPDX-License-Identifier: Apache-2.0 */
/* Framebuffers that pictures are drawn into. */
#include "error.h"
#include "render_internal.h"

#include <string.h>

void srp_render_target_clear(const srp_gl_context *context, srp_render_target *target) {
    const GLuint buffers[2] = {target->colour, target->depth};
    context->gl.DeleteFramebuffers(1, &target->framebuffer);
    context->gl.DeleteRenderbuffers(2, buffers);
    memset(target, 0, sizeof *target);
}

static void add_buffer(const srp_gl_functions *gl, GLenum place, GLenum format,
                       const srp_render_target *target, GLuint *out) {
    gl->GenRenderbuffers(1, out);
    gl->BindRenderbuffer(GL_RENDERBUFFER, *out);
    if (target->samples > 1) {
        gl->RenderbufferStorageMultisample(GL_RENDERBUFFER, target->samples, format, target->width,
                                           target->height);
    } else {
        gl->RenderbufferStorage(GL_RENDERBUFFER, format, target->width, target->height);
    }
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, *out);
}

srp_status srp_render_target_resize(const srp_gl_context *context, srp_render_target *target,
                                    int width, int height, int samples, srp_error *error) {
    const srp_gl_functions *gl = &context->gl;
    GLint most = 1;
    gl->GetIntegerv(GL_MAX_SAMPLES, &most);
    samples = samples > most ? most : samples;
    if (target->framebuffer != 0 && target->width == width && target->height == height &&
        target->samples == samples) {
        gl->BindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
        return SRP_OK;
    }
    srp_render_target_clear(context, target);
    target->width = width;
    target->height = height;
    target->samples = samples;
    gl->GenFramebuffers(1, &target->framebuffer);
    gl->BindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    add_buffer(gl, GL_COLOR_ATTACHMENT0, GL_RGBA8, target, &target->colour);
    add_buffer(gl, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F, target, &target->depth);
    srp_status status = srp_gl_context_check(context, "a picture", error);
    if (status == SRP_OK && gl->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        status = srp_fail(error, SRP_NO_DEVICE, "%s (%s) draws no picture of %d x %d pixels",
                          context->device->name, context->renderer, width, height);
    }
    if (status != SRP_OK) {
        srp_render_target_clear(context, target);
    }
    return status;
}
