/* SPDX-License-Identifier: Apache-2.0 */
#include "canvas.h"

#include "error.h"
#include "program.h"

#include <string.h>

/* And by so many of the smallest steps of depth, which are what a plane without slope is known to.
 */
static const float RECEDE_UNITS = 16.0F;

static srp_status create_program(srp_gl_canvas *canvas, srp_error *error) {
    static const srp_gl_stage STAGES[] = {{GL_VERTEX_SHADER, &srp_gl_ids_vert},
                                          {GL_FRAGMENT_SHADER, &srp_gl_ids_frag}};
    const srp_gl_functions *gl = &canvas->context->gl;
    srp_status status = srp_gl_program_create(canvas->context, "#version 330 core\n", STAGES, 2,
                                              &canvas->program, error);
    if (status == SRP_OK) {
        canvas->middle = gl->GetUniformLocation(canvas->program, "middle");
        canvas->scale = gl->GetUniformLocation(canvas->program, "scale");
        canvas->first = gl->GetUniformLocation(canvas->program, "first");
    }
    return status;
}

static void create_buffers(srp_gl_canvas *canvas) {
    const srp_gl_functions *gl = &canvas->context->gl;
    gl->GenVertexArrays(1, &canvas->array);
    gl->BindVertexArray(canvas->array);
    gl->GenBuffers(1, &canvas->vertices);
    gl->BindBuffer(GL_ARRAY_BUFFER, canvas->vertices);
    gl->EnableVertexAttribArray(0);
    gl->VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, NULL);
    gl->GenBuffers(1, &canvas->indices);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, canvas->indices);
}

srp_status srp_gl_canvas_create(const srp_gl_context *context, srp_gl_canvas *out,
                                srp_error *error) {
    srp_gl_canvas canvas;
    memset(&canvas, 0, sizeof canvas);
    canvas.context = context;
    srp_status status = create_program(&canvas, error);
    if (status == SRP_OK) {
        create_buffers(&canvas);
        context->gl.GenFramebuffers(1, &canvas.framebuffer);
        status = srp_gl_context_check(context, "buffers of triangles", error);
    }
    if (status != SRP_OK) {
        srp_gl_canvas_clear(&canvas);
        return status;
    }
    *out = canvas;
    return SRP_OK;
}

static void drop_layers(srp_gl_canvas *canvas) {
    const srp_gl_functions *gl = &canvas->context->gl;
    gl->DeleteTextures(1, &canvas->colour);
    gl->DeleteRenderbuffers(1, &canvas->depth);
    canvas->colour = canvas->depth = 0;
    canvas->side = canvas->layers = 0;
}

void srp_gl_canvas_clear(srp_gl_canvas *canvas) {
    if (canvas->context != NULL) {
        const srp_gl_functions *gl = &canvas->context->gl;
        const GLuint buffers[2] = {canvas->vertices, canvas->indices};
        gl->DeleteProgram(canvas->program);
        gl->DeleteVertexArrays(1, &canvas->array);
        gl->DeleteBuffers(2, buffers);
        gl->DeleteFramebuffers(1, &canvas->framebuffer);
        drop_layers(canvas);
        memset(canvas, 0, sizeof *canvas);
    }
}

srp_status srp_gl_canvas_resize(srp_gl_canvas *canvas, GLint side, GLint layers, srp_error *error) {
    const srp_gl_functions *gl = &canvas->context->gl;
    drop_layers(canvas);
    gl->GenTextures(1, &canvas->colour);
    gl->BindTexture(GL_TEXTURE_2D_ARRAY, canvas->colour);
    gl->TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
    gl->TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->TexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_R32UI, side, side, layers, 0, GL_RED_INTEGER,
                   GL_UNSIGNED_INT, NULL);
    gl->GenRenderbuffers(1, &canvas->depth);
    gl->BindRenderbuffer(GL_RENDERBUFFER, canvas->depth);
    gl->RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, side, side);
    gl->BindFramebuffer(GL_FRAMEBUFFER, canvas->framebuffer);
    gl->FramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, canvas->colour, 0, 0);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                canvas->depth);
    srp_status status = srp_gl_context_check(canvas->context, "pictures of triangles", error);
    if (status == SRP_OK && gl->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        status = srp_fail(error, SRP_NO_DEVICE, "%s (%s) does not draw whole numbers",
                          canvas->context->device->name, canvas->context->renderer);
    }
    if (status == SRP_OK) {
        canvas->side = side;
        canvas->layers = layers;
    }
    return status;
}

void srp_gl_canvas_begin(const srp_gl_canvas *canvas, GLint layer, GLint width, GLint height) {
    static const GLuint NOTHING[4] = {0, 0, 0, 0};
    static const GLfloat FAR[1] = {1.0F};
    const srp_gl_functions *gl = &canvas->context->gl;
    gl->BindFramebuffer(GL_FRAMEBUFFER, canvas->framebuffer);
    gl->FramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, canvas->colour, 0, layer);
    gl->BindVertexArray(canvas->array);
    gl->UseProgram(canvas->program);
    gl->Enable(GL_DEPTH_TEST);
    gl->Enable(GL_SCISSOR_TEST);
    gl->DepthFunc(GL_LESS);
    gl->Viewport(0, 0, width, height);
    gl->Scissor(0, 0, width, height);
    gl->ClearBufferuiv(GL_COLOR, 0, NOTHING);
    gl->ClearBufferfv(GL_DEPTH, 0, FAR);
}

/* Into the buffer that is bound there. */
static void send_buffer(const srp_gl_functions *gl, GLenum target, const void *data, size_t size,
                        size_t *capacity) {
    if (size > *capacity) {
        gl->BufferData(target, (GLsizeiptr)size, data, GL_STREAM_DRAW);
        *capacity = size;
    } else if (size > 0) {
        gl->BufferSubData(target, 0, (GLsizeiptr)size, data);
    }
}

void srp_gl_canvas_send(srp_gl_canvas *canvas, const float *vertices, size_t vertex_count,
                        const uint32_t *indices, size_t index_count) {
    const srp_gl_functions *gl = &canvas->context->gl;
    gl->BindVertexArray(canvas->array);
    gl->BindBuffer(GL_ARRAY_BUFFER, canvas->vertices);
    send_buffer(gl, GL_ARRAY_BUFFER, vertices, 3 * vertex_count * sizeof *vertices,
                &canvas->vertex_capacity);
    send_buffer(gl, GL_ELEMENT_ARRAY_BUFFER, indices, index_count * sizeof *indices,
                &canvas->index_capacity);
}

void srp_gl_canvas_draw(const srp_gl_canvas *canvas, const srp_gl_view *view, size_t begin,
                        size_t count, uint32_t first) {
    const srp_gl_functions *gl = &canvas->context->gl;
    if (count == 0) {
        return;
    }
    gl->Uniform2f(canvas->middle, view->middle[0], view->middle[1]);
    gl->Uniform2f(canvas->scale, view->scale[0], view->scale[1]);
    gl->Uniform1ui(canvas->first, first);
    if (view->recede > 0.0F) {
        gl->Enable(GL_POLYGON_OFFSET_FILL);
        gl->PolygonOffset(view->recede, RECEDE_UNITS);
    } else {
        gl->Disable(GL_POLYGON_OFFSET_FILL);
    }
    gl->DrawElements(GL_TRIANGLES, (GLsizei)(3 * count), GL_UNSIGNED_INT,
                     (const void *)(uintptr_t)(3 * begin * sizeof(uint32_t)));
}

void srp_gl_canvas_read(const srp_gl_canvas *canvas, GLint layer, GLint width, GLint height,
                        uint32_t *ids) {
    const srp_gl_functions *gl = &canvas->context->gl;
    gl->BindFramebuffer(GL_FRAMEBUFFER, canvas->framebuffer);
    gl->FramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, canvas->colour, 0, layer);
    gl->ReadBuffer(GL_COLOR_ATTACHMENT0);
    gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl->ReadPixels(0, 0, width, height, GL_RED_INTEGER, GL_UNSIGNED_INT, ids);
}
