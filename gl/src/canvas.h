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
    GLint along[3], first; /* places of uniforms */
    GLint side, layers;
    size_t index_capacity;
} srp_gl_canvas;

/* A picture. */
typedef struct srp_gl_view {
    /* Vertices p to coordinates within [-1, 1], x, y, and depth with -1 nearest: xyz . p + w. */
    float along[3][4];
    GLint width, height; /* in pixels */
    /* Triangles are drawn as if they were this much further away: what their depth changes by
     * within so many pixels. */
    float recede;
} srp_gl_view;

/* Copies `count` vertices; there is no layer yet. SRP_NO_MEMORY, SRP_NO_DEVICE. */
SRP_CHECK srp_status srp_gl_canvas_create(const srp_gl_context *context, const float *vertices,
                                          size_t count, srp_gl_canvas *out, srp_error *error);
/* A zeroed canvas is an empty one. */
void srp_gl_canvas_clear(srp_gl_canvas *canvas);

/* Has `layers` layers of side x side pixels from here on (side at most context->side_max); what
 * they hold is lost. SRP_NO_MEMORY, SRP_NO_DEVICE. */
SRP_CHECK srp_status srp_gl_canvas_resize(srp_gl_canvas *canvas, GLint side, GLint layers,
                                          srp_error *error);

/* Corners of the triangles of all pictures until the next call. */
void srp_gl_canvas_send(srp_gl_canvas *canvas, const uint32_t *indices, size_t count);
/* Goes to a layer and wipes its pixels [0, width) x [0, height). */
void srp_gl_canvas_begin(const srp_gl_canvas *canvas, GLint layer, GLint width, GLint height);
/* Draws triangles [begin, begin + count) there; the number of the first is `first`. */
void srp_gl_canvas_draw(const srp_gl_canvas *canvas, const srp_gl_view *view, size_t begin,
                        size_t count, uint32_t first);
/* Numbers of a layer in rows of `width`; 0: nothing drawn. Look for errors afterwards. */
void srp_gl_canvas_read(const srp_gl_canvas *canvas, GLint layer, GLint width, GLint height,
                        uint32_t *ids);

#endif
