/* SPDX-License-Identifier: Apache-2.0 */
/* The renderer: what it holds in a context, and how a picture is drawn. */
#include "error.h"
#include "program.h"
#include "render_internal.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* ---- corners and batches ---- */

bool srp_render_corners_reserve(srp_render_corners *corners, size_t more) {
    if (corners->capacity - corners->count >= more) {
        return true;
    }
    size_t capacity = corners->count + more;
    capacity += capacity / 2;
    srp_render_corner *larger = realloc(corners->at, capacity * sizeof *larger);
    if (larger == NULL) {
        return false;
    }
    corners->at = larger;
    corners->capacity = capacity;
    return true;
}

void srp_render_corners_add(srp_render_corners *corners, srp_vec3 position, srp_vec3 normal,
                            uint32_t paint) {
    corners->at[corners->count++] =
        (srp_render_corner){{(float)position.x, (float)position.y, (float)position.z},
                            {(float)normal.x, (float)normal.y, (float)normal.z},
                            paint};
}

static void create_batch(const srp_gl_functions *gl, srp_render_batch *batch) {
    const GLsizei stride = sizeof(srp_render_corner);
    gl->GenVertexArrays(1, &batch->array);
    gl->BindVertexArray(batch->array);
    gl->GenBuffers(1, &batch->buffer);
    gl->BindBuffer(GL_ARRAY_BUFFER, batch->buffer);
    gl->EnableVertexAttribArray(0);
    gl->VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, stride,
                            (const void *)offsetof(srp_render_corner, position));
    gl->EnableVertexAttribArray(1);
    gl->VertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, stride,
                            (const void *)offsetof(srp_render_corner, normal));
    gl->EnableVertexAttribArray(2);
    gl->VertexAttribIPointer(2, 1, GL_UNSIGNED_INT, stride,
                             (const void *)offsetof(srp_render_corner, paint));
}

void srp_render_batch_fill(srp_renderer *renderer, int index, const srp_render_corners *from,
                           GLenum usage) {
    const srp_gl_functions *gl = &renderer->context.gl;
    srp_render_batch *batch = &renderer->batch[index];
    gl->BindBuffer(GL_ARRAY_BUFFER, batch->buffer);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(from->count * sizeof *from->at), from->at, usage);
    batch->count = from->count;
}

static void draw_part(const srp_renderer *renderer, int index, size_t first, size_t end) {
    const srp_gl_functions *gl = &renderer->context.gl;
    const srp_render_batch *batch = &renderer->batch[index];
    if (end > first) {
        gl->BindVertexArray(batch->array);
        gl->DrawArrays(index == SRP_RENDER_EDGES ? GL_LINES : GL_TRIANGLES, (GLint)first,
                       (GLsizei)(end - first));
    }
}

static void draw_batch(const srp_renderer *renderer, int index) {
    draw_part(renderer, index, 0, renderer->batch[index].count);
}

/* ---- life ---- */

static srp_status create_program(srp_renderer *renderer, srp_error *error) {
    static const srp_gl_stage STAGES[] = {{GL_VERTEX_SHADER, &srp_gl_render_vert},
                                          {GL_FRAGMENT_SHADER, &srp_gl_render_frag}};
    const srp_gl_functions *gl = &renderer->context.gl;
    srp_status status = srp_gl_program_create(&renderer->context, "#version 330 core\n", STAGES, 2,
                                              &renderer->program, error);
    if (status == SRP_OK) {
        renderer->rows = gl->GetUniformLocation(renderer->program, "rows");
        renderer->nearer = gl->GetUniformLocation(renderer->program, "nearer");
        renderer->eye = gl->GetUniformLocation(renderer->program, "eye");
        renderer->sun = gl->GetUniformLocation(renderer->program, "sun");
        renderer->lit = gl->GetUniformLocation(renderer->program, "lit");
        renderer->data = gl->GetUniformLocation(renderer->program, "data");
        renderer->opacity = gl->GetUniformLocation(renderer->program, "opacity");
    }
    return status;
}

static void create_objects(srp_renderer *renderer) {
    const srp_gl_functions *gl = &renderer->context.gl;
    for (int k = 0; k < SRP_RENDER_BATCHES; ++k) {
        create_batch(gl, &renderer->batch[k]);
    }
    gl->BindVertexArray(0);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->GenTextures(1, &renderer->colours);
    gl->BindTexture(GL_TEXTURE_2D, renderer->colours);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->BindTexture(GL_TEXTURE_2D, 0);
}

srp_status srp_renderer_create(srp_render_find find, void *user, srp_renderer **out,
                               srp_error *error) {
    srp_renderer *renderer = calloc(1, sizeof *renderer);
    if (renderer == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a renderer");
    }
    srp_status status = srp_gl_context_adopt(find, user, &renderer->context, error);
    if (status != SRP_OK) {
        free(renderer);
        return status;
    }
    status = create_program(renderer, error);
    if (status == SRP_OK) {
        create_objects(renderer);
        status = srp_gl_context_check(&renderer->context, "making a renderer", error);
    }
    if (status != SRP_OK) {
        srp_renderer_destroy(renderer);
        return status;
    }
    *out = renderer;
    return SRP_OK;
}

void srp_renderer_destroy(srp_renderer *renderer) {
    if (renderer == NULL) {
        return;
    }
    const srp_gl_functions *gl = &renderer->context.gl;
    for (int k = 0; k < SRP_RENDER_BATCHES; ++k) {
        gl->DeleteVertexArrays(1, &renderer->batch[k].array);
        gl->DeleteBuffers(1, &renderer->batch[k].buffer);
    }
    gl->DeleteTextures(1, &renderer->colours);
    gl->DeleteProgram(renderer->program);
    srp_render_target_clear(&renderer->context, &renderer->smooth);
    srp_visible_destroy(renderer->visible);
    free(renderer->paint);
    free(renderer->scratch.at);
    free(renderer);
}

/* ---- the scene ---- */

static srp_status check_scene(const srp_renderer *renderer, const srp_scene *scene,
                              srp_error *error) {
    size_t facets_max = (size_t)renderer->context.side_max * SRP_RENDER_ROW;
    if (scene->shape != SRP_SHAPE_MESH) {
        return srp_fail(error, SRP_UNSUPPORTED, "only meshes can be drawn");
    }
    if (scene->facet_count > facets_max) {
        return srp_fail(error, SRP_UNSUPPORTED, "%zu facets: %s draws up to %zu",
                        scene->facet_count, renderer->context.renderer, facets_max);
    }
    return SRP_OK;
}

srp_status srp_renderer_set_scene(srp_renderer *renderer, const srp_scene *scene,
                                  srp_error *error) {
    if (scene == NULL) {
        renderer->scene = NULL;
        return SRP_OK;
    }
    srp_status status = check_scene(renderer, scene, error);
    if (status != SRP_OK) {
        return status;
    }
    size_t rows = (scene->facet_count + SRP_RENDER_ROW - 1) / SRP_RENDER_ROW;
    uint8_t *paint = calloc(rows * SRP_RENDER_ROW, 4);
    renderer->scratch.count = 0;
    if (paint == NULL || !srp_render_corners_reserve(&renderer->scratch, 3 * scene->facet_count)) {
        free(paint);
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a picture of %zu facets",
                        scene->facet_count);
    }
    srp_visible_destroy(renderer->visible);
    free(renderer->paint);
    renderer->visible = NULL; /* made when it is needed, as are the edges */
    renderer->paint = paint;
    renderer->paint_known = false;
    renderer->scene = scene;
    renderer->lit_known = false;
    renderer->edges_known = false;
    srp_render_send_body(renderer, scene);
    srp_render_send_coarse(renderer, scene);
    status = srp_gl_context_check(&renderer->context, "the facets of the model", error);
    renderer->scene = status == SRP_OK ? scene : NULL;
    return status;
}

/* ---- a picture ---- */

/* Everything that drawing depends on. */
static void set_state(const srp_renderer *renderer, const srp_render_view *view, int x, int y) {
    static const GLenum OFF[] = {GL_BLEND,
                                 GL_STENCIL_TEST,
                                 GL_COLOR_LOGIC_OP,
                                 GL_RASTERIZER_DISCARD,
                                 GL_FRAMEBUFFER_SRGB,
                                 GL_PRIMITIVE_RESTART,
                                 GL_SAMPLE_ALPHA_TO_COVERAGE,
                                 GL_SAMPLE_COVERAGE,
                                 GL_DEPTH_CLAMP,
                                 GL_POLYGON_OFFSET_FILL};
    const srp_gl_functions *gl = &renderer->context.gl;
    for (size_t k = 0; k < sizeof OFF / sizeof OFF[0]; ++k) {
        gl->Disable(OFF[k]);
    }
    gl->Enable(GL_MULTISAMPLE);
    gl->Enable(GL_SCISSOR_TEST);
    gl->Enable(GL_DEPTH_TEST);
    gl->Enable(GL_CULL_FACE);
    gl->Viewport(x, y, view->width, view->height);
    gl->Scissor(x, y, view->width, view->height);
    gl->DepthFunc(GL_LEQUAL);
    gl->DepthMask(GL_TRUE);
    gl->DepthRange(0.0, 1.0);
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->FrontFace(GL_CCW);
    gl->PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    gl->BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl->BlendEquation(GL_FUNC_ADD);
    gl->BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, renderer->colours);
    gl->UseProgram(renderer->program);
}

static void leave_state(const srp_renderer *renderer) {
    static const GLenum OFF[] = {GL_SCISSOR_TEST, GL_DEPTH_TEST, GL_CULL_FACE, GL_BLEND,
                                 GL_POLYGON_OFFSET_FILL};
    const srp_gl_functions *gl = &renderer->context.gl;
    for (size_t k = 0; k < sizeof OFF / sizeof OFF[0]; ++k) {
        gl->Disable(OFF[k]);
    }
    gl->DepthMask(GL_TRUE);
    gl->BindTexture(GL_TEXTURE_2D, 0);
    gl->BindVertexArray(0);
    gl->BindBuffer(GL_ARRAY_BUFFER, 0);
    gl->UseProgram(0);
}

static void set_uniforms(const srp_renderer *renderer, const srp_render_view *view,
                         float rows[4][4]) {
    const srp_gl_functions *gl = &renderer->context.gl;
    srp_vec3 right, up, eye;
    srp_render_camera_axes(&view->camera, &right, &up, &eye);
    const float to_eye[4] = {(float)eye.x, (float)eye.y, (float)eye.z, 0.0F};
    const float to_sun[4] = {(float)view->sun.x, (float)view->sun.y, (float)view->sun.z, 0.0F};
    gl->Uniform4fv(renderer->rows, 4, rows[0]);
    gl->Uniform4fv(renderer->eye, 1, to_eye);
    gl->Uniform4fv(renderer->sun, 1, to_sun);
    gl->Uniform1f(renderer->nearer, 0.0F);
    gl->Uniform1f(renderer->lit, 0.0F);
    gl->Uniform1f(renderer->data, view->colouring == SRP_RENDER_MATERIAL ? 0.0F : 1.0F);
    gl->Uniform1f(renderer->opacity, 1.0F);
}

static bool is_coarse(const srp_renderer *renderer, const srp_render_view *view) {
    return view->coarse && renderer->batch[SRP_RENDER_COARSE].count > 0;
}

static void draw_coarse(const srp_renderer *renderer, const srp_render_view *view) {
    const srp_gl_functions *gl = &renderer->context.gl;
    gl->Uniform1f(renderer->lit, view->shadows ? 2.0F : 1.0F);
    gl->CullFace(GL_BACK);
    draw_part(renderer, SRP_RENDER_COARSE, 0, renderer->closed_coarse);
    gl->Disable(GL_CULL_FACE);
    draw_part(renderer, SRP_RENDER_COARSE, renderer->closed_coarse,
              renderer->batch[SRP_RENDER_COARSE].count);
    gl->Enable(GL_CULL_FACE);
}

/* The dark body, then its lit parts over it: they win where the two lie in one plane, beyond the
 * rounding of depths, steep planes included. */
static void draw_body(const srp_renderer *renderer, const srp_render_view *view) {
    const srp_gl_functions *gl = &renderer->context.gl;
    gl->Uniform1f(renderer->lit, view->shadows ? 0.0F : 1.0F);
    gl->Enable(GL_POLYGON_OFFSET_FILL);
    gl->PolygonOffset(0.05F,
                      8.0F); /* the backs of open parts, which fronts in one place win over */
    gl->CullFace(GL_FRONT);
    draw_part(renderer, SRP_RENDER_BODY, renderer->closed_corners,
              renderer->batch[SRP_RENDER_BODY].count);
    gl->Disable(GL_POLYGON_OFFSET_FILL);
    gl->CullFace(GL_BACK);
    draw_batch(renderer, SRP_RENDER_BODY);
    if (view->shadows) {
        gl->Enable(GL_POLYGON_OFFSET_FILL);
        gl->PolygonOffset(-0.05F, -16.0F);
        gl->Uniform1f(renderer->lit, 1.0F);
        draw_batch(renderer, SRP_RENDER_LIT);
        gl->Disable(GL_POLYGON_OFFSET_FILL);
    }
    if (view->edges) {
        gl->Uniform1f(renderer->nearer, 4e-4F);
        draw_batch(renderer, SRP_RENDER_EDGES);
        gl->Uniform1f(renderer->nearer, 0.0F);
    }
}

/* First what the body hides, shining through, then the rest. */
static void draw_marks(const srp_renderer *renderer) {
    const srp_gl_functions *gl = &renderer->context.gl;
    gl->CullFace(GL_BACK);
    gl->Enable(GL_BLEND);
    gl->DepthMask(GL_FALSE);
    gl->DepthFunc(GL_GREATER);
    gl->Uniform1f(renderer->opacity, 0.35F);
    draw_batch(renderer, SRP_RENDER_MARKS);
    gl->Disable(GL_BLEND);
    gl->DepthMask(GL_TRUE);
    gl->DepthFunc(GL_LEQUAL);
    gl->Uniform1f(renderer->opacity, 1.0F);
    draw_batch(renderer, SRP_RENDER_MARKS);
}

static void draw_all(srp_renderer *renderer, const srp_render_view *view, int x, int y,
                     float rows[4][4]) {
    static const GLfloat FAR[1] = {1.0F};
    const srp_gl_functions *gl = &renderer->context.gl;
    const GLfloat paper[4] = {view->background.r, view->background.g, view->background.b, 1.0F};
    set_state(renderer, view, x, y);
    set_uniforms(renderer, view, rows);
    gl->ClearBufferfv(GL_COLOR, 0, paper);
    gl->ClearBufferfv(GL_DEPTH, 0, FAR);
    if (renderer->scene != NULL) {
        srp_render_send_colours(renderer, view);
        is_coarse(renderer, view) ? draw_coarse(renderer, view) : draw_body(renderer, view);
    }
    draw_marks(renderer);
    leave_state(renderer);
}

/* Draws with several samples for each pixel, and copies their means into `into`. */
static srp_status draw_smooth(srp_renderer *renderer, const srp_render_view *view, GLuint into,
                              float rows[4][4], srp_error *error) {
    const srp_gl_functions *gl = &renderer->context.gl;
    srp_status status = srp_render_target_resize(&renderer->context, &renderer->smooth, view->width,
                                                 view->height, view->samples, error);
    if (status != SRP_OK) {
        return status;
    }
    draw_all(renderer, view, 0, 0, rows);
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, renderer->smooth.framebuffer);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, into);
    gl->BlitFramebuffer(0, 0, view->width, view->height, view->x, view->y, view->x + view->width,
                        view->y + view->height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gl->Viewport(view->x, view->y, view->width, view->height);
    return SRP_OK;
}

/* Sends what the view needs to be in the GPU. */
static srp_status prepare(srp_renderer *renderer, const srp_render_view *view, float rows[4][4],
                          srp_error *error) {
    const srp_scene *scene = renderer->scene;
    srp_vec3 centre = scene != NULL ? scene->centre : view->camera.target;
    double radius = scene != NULL ? scene->radius : view->camera.half_height;
    double reach = radius + srp_vec3_norm(srp_vec3_sub(centre, view->camera.target));
    reach = fmax(reach, srp_render_marks_reach(view));
    srp_render_matrix(view, centre, radius, reach, rows);
    srp_status status = SRP_OK;
    if (view->shadows && !is_coarse(renderer, view)) {
        status = srp_renderer_find_light(renderer, view->sun, error);
    }
    if (status == SRP_OK && scene != NULL && view->edges && !renderer->edges_known) {
        status = srp_render_send_edges(renderer, scene, error);
    }
    if (status != SRP_OK) {
        return status;
    }
    return srp_render_send_marks(renderer, view, centre, radius, error);
}

srp_status srp_renderer_draw(srp_renderer *renderer, const srp_render_view *view,
                             srp_error *error) {
    const srp_gl_functions *gl = &renderer->context.gl;
    float rows[4][4];
    srp_status status = srp_render_check(renderer, view, error);
    if (status == SRP_OK) {
        status = prepare(renderer, view, rows, error);
    }
    if (status != SRP_OK) {
        return status;
    }
    GLint draw_into = 0, read_from = 0;
    gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_into);
    gl->GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_from);
    if (view->samples > 1) {
        status = draw_smooth(renderer, view, (GLuint)draw_into, rows, error);
    } else {
        draw_all(renderer, view, view->x, view->y, rows);
    }
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)draw_into);
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, (GLuint)read_from);
    return status == SRP_OK ? srp_gl_context_check(&renderer->context, "drawing a picture", error)
                            : status;
}
