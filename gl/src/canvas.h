/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A target of triangle numbers: triangles are drawn with a depth buffer, and each sample keeps the
 * number of the nearest. What crosses from the GPU are whole numbers. All calls with the context
 * current. Internal.
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
    GLint side;
    GLint width, height; /* in use, from the corner */
    size_t index_capacity;
} srp_gl_canvas;

/* A picture within the target. */
typedef struct srp_gl_view {
    /* Vertices p to coordinates within [-1, 1], x, y, and depth with -1 nearest: xyz . p + w. */
    float along[3][4];
    GLint left, bottom, width, height; /* where, in samples */
} srp_gl_view;

/* A target of side x side samples (at most context->side_max), and `count` vertices, copied.
 * SRP_NO_MEMORY, SRP_NO_DEVICE. */
SRP_CHECK srp_status srp_gl_canvas_create(const srp_gl_context *context, GLint side,
                                          const float *vertices, size_t count, srp_gl_canvas *out,
                                          srp_error *error);
/* A zeroed canvas is an empty one. */
void srp_gl_canvas_clear(srp_gl_canvas *canvas);

/* Wipes the samples [0, width) x [0, height). */
void srp_gl_canvas_begin(srp_gl_canvas *canvas, GLint width, GLint height);
/* Corners of the triangles of all draws until the next call. */
void srp_gl_canvas_send(srp_gl_canvas *canvas, const uint32_t *indices, size_t count);
/* Draws triangles [begin, begin + count) of those; the number of the first is `first`. */
void srp_gl_canvas_draw(const srp_gl_canvas *canvas, const srp_gl_view *view, size_t begin,
                        size_t count, uint32_t first);
/* Numbers in rows of `width`; 0: nothing drawn. SRP_NO_MEMORY, SRP_NO_DEVICE. */
SRP_CHECK srp_status srp_gl_canvas_read(const srp_gl_canvas *canvas, uint32_t *ids,
                                        srp_error *error);

#endif
