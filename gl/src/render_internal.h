/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Parts of the renderer (srp/render.h). Coordinates of everything that is drawn are those of the
 * unit space of the scene: (p - centre) / radius. Internal.
 */
#ifndef SRP_GL_SRC_RENDER_INTERNAL_H
#define SRP_GL_SRC_RENDER_INTERNAL_H

#include "context.h"
#include "exact_visible.h"
#include "scene_internal.h"

#include <srp/render.h>

#include <stdint.h>

/* Attributes of a corner, as the shaders have them. */
typedef struct srp_render_corner {
    float position[3];
    float normal[3]; /* unit; 0: drawn without shading */
    uint32_t paint;  /* number of a facet, or SRP_RENDER_PAINT of a colour */
} srp_render_corner;

/* Corners in a buffer of the GPU. */
typedef struct srp_render_batch {
    GLuint array, buffer;
    size_t count;
} srp_render_batch;

/* Corners that are being collected. Zero-initialise, reuse, free `at`. */
typedef struct srp_render_corners {
    srp_render_corner *at;
    size_t count, capacity;
} srp_render_corners;

/* A framebuffer with a colour for each pixel and a depth. */
typedef struct srp_render_target {
    GLuint framebuffer, colour, depth;
    int width, height, samples;
} srp_render_target;

enum {
    SRP_RENDER_BODY,
    SRP_RENDER_COARSE, /* the body of a large scene, simplified; of others empty */
    SRP_RENDER_LIT,
    SRP_RENDER_EDGES,
    SRP_RENDER_MARKS,
    SRP_RENDER_BATCHES
};

struct srp_renderer {
    srp_gl_context context;
    GLuint program;
    GLint rows, nearer, eye, sun, lit, data, opacity; /* places of uniforms */
    srp_render_batch batch[SRP_RENDER_BATCHES];
    size_t closed_corners;      /* of the body: the first, of closed parts, which have no backs */
    size_t closed_coarse;       /* of the simplified body */
    GLuint colours;             /* a texture: one of each facet */
    srp_render_target smooth;   /* with several samples for each pixel */
    srp_render_corners scratch; /* what goes to the GPU next */
    uint8_t *paint;             /* (rows of the texture, SRP_RENDER_ROW, 4) */
    const srp_scene *scene;     /* NULL: nothing to draw */
    srp_visible *visible;       /* NULL: not needed so far */
    srp_vec3 lit_from;          /* the Sun of the lit parts */
    bool lit_known, edges_known;
    bool paint_known; /* the colours are those that materials have by themselves */
};

/* Facets to a row of the texture of colours, as the fragment shader has it. */
enum { SRP_RENDER_ROW = 1024 };

/* A paint that is this colour itself. */
static inline uint32_t srp_render_paint(srp_render_colour colour) {
    const float share[3] = {colour.r, colour.g, colour.b};
    uint32_t paint = 0x80;
    for (int k = 0; k < 3; ++k) {
        float inside = share[k] > 0.0F ? share[k] < 1.0F ? share[k] : 1.0F : 0.0F;
        paint = paint << 8 | (uint32_t)(inside * 255.0F + 0.5F);
    }
    return paint;
}

/* ---- render.c ---- */

/* Room for so many more corners; false without memory. */
bool srp_render_corners_reserve(srp_render_corners *corners, size_t more);
/* Adds one, for which there is room. */
void srp_render_corners_add(srp_render_corners *corners, srp_vec3 position, srp_vec3 normal,
                            uint32_t paint);
/* Sends what has been collected. */
void srp_render_batch_fill(srp_renderer *renderer, int index, const srp_render_corners *from,
                           GLenum usage);

/* ---- render_body.c: the scene ---- */

srp_vec3 srp_render_into_unit(const srp_scene *scene, srp_vec3 p);
/* The facets of a scene; the scratch has room for three corners of each. */
void srp_render_send_body(srp_renderer *renderer, const srp_scene *scene);
/* SRP_NO_MEMORY. */
srp_status srp_render_send_edges(srp_renderer *renderer, const srp_scene *scene, srp_error *error);

/* ---- render_coarse.c ---- */

/* The simplified body of a large scene; of a small one, and without memory, none. The scratch as
 * above. */
void srp_render_send_coarse(srp_renderer *renderer, const srp_scene *scene);

/* ---- render_look.c: colours ---- */

/* SRP_BAD_ARGUMENT: what is wrong with a view. */
srp_status srp_render_check(const srp_renderer *renderer, const srp_render_view *view,
                            srp_error *error);
/* The colours of all facets. */
void srp_render_send_colours(srp_renderer *renderer, const srp_render_view *view);

/* ---- render_camera.c ---- */

/* The rows of the matrix from unit space to the picture; `reach` [m]: how far from the target there
 * is something to draw. */
void srp_render_matrix(const srp_render_view *view, srp_vec3 centre, double radius, double reach,
                       float rows[4][4]);

/* ---- render_marks.c: axes, the Sun's line, arrows ---- */

/* How far from the target the marks of a view reach [m]. */
double srp_render_marks_reach(const srp_render_view *view);
/* SRP_NO_MEMORY. */
srp_status srp_render_send_marks(srp_renderer *renderer, const srp_render_view *view,
                                 srp_vec3 centre, double radius, srp_error *error);

/* ---- render_target.c ---- */

/* Makes it of this size, unless it is. Binds its framebuffer. SRP_NO_MEMORY, SRP_NO_DEVICE. */
srp_status srp_render_target_resize(const srp_gl_context *context, srp_render_target *target,
                                    int width, int height, int samples, srp_error *error);
void srp_render_target_clear(const srp_gl_context *context, srp_render_target *target);

#endif
