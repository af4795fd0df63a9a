/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Pictures of triangle numbers: triangles are drawn with a depth buffer, and each pixel keeps the
 * number of the nearest, as seen from its centre. What crosses from the GPU are whole numbers. All
 * calls with the context current. Internal.
 *
 * A canvas has several layers of one size, each for a picture, so that the GPU draws many before
 * the processor waits for it. All pictures begin in the corner of their layer: rounding in the GPU
 * does not depend on what else is drawn.
 */
#ifndef SRP_GL_SRC_CANVAS_H
#define SRP_GL_SRC_CANVAS_H

#include "context.h"

#include <stdint.h>

typedef struct srp_gl_canvas {
    const srp_gl_context *context;
    GLuint framebuffer, colour, depth;
    GLuint program, array, vertices, indices;
    GLint middle, scale, first; /* places of uniforms */
    GLint side, layers;
    size_t vertex_capacity, index_capacity;
} srp_gl_canvas;

/* A picture. */
typedef struct srp_gl_view {
    float middle[2];     /* x and y of vertices that lie in the middle of the picture */
    float scale[2];      /* from there to coordinates within [-1, 1] */
    GLint width, height; /* in pixels */
    /* Triangles are drawn as if they were this much further away: what their depth changes by
     * within so many pixels. */
    float recede;
} srp_gl_view;

/* There is no layer and no triangle yet. SRP_NO_MEMORY, SRP_NO_DEVICE. */
SRP_CHECK srp_status srp_gl_canvas_create(const srp_gl_context *context, srp_gl_canvas *out,
                                          srp_error *error);
/* A zeroed canvas is an empty one. */
void srp_gl_canvas_clear(srp_gl_canvas *canvas);

/* Has `layers` layers of side x side pixels from here on (side at most context->side_max); what
 * they hold is lost. SRP_NO_MEMORY, SRP_NO_DEVICE. */
SRP_CHECK srp_status srp_gl_canvas_resize(srp_gl_canvas *canvas, GLint side, GLint layers,
                                          srp_error *error);

/* The triangles of all pictures until the next call: vertices (vertex_count, 3), of x, y, and depth
 * within [-1, 1], -1 nearest; three indices each. Look for errors afterwards. */
void srp_gl_canvas_send(srp_gl_canvas *canvas, const float *vertices, size_t vertex_count,
                        const uint32_t *indices, size_t index_count);
/* Goes to a layer and wipes its pixels [0, width) x [0, height). */
void srp_gl_canvas_begin(const srp_gl_canvas *canvas, GLint layer, GLint width, GLint height);
/* Draws triangles [begin, begin + count) there; the number of the first is `first`. */
void srp_gl_canvas_draw(const srp_gl_canvas *canvas, const srp_gl_view *view, size_t begin,
                        size_t count, uint32_t first);
/* Numbers of a layer in rows of `width`; 0: nothing drawn. Look for errors afterwards. */
void srp_gl_canvas_read(const srp_gl_canvas *canvas, GLint layer, GLint width, GLint height,
                        uint32_t *ids);

#endif
