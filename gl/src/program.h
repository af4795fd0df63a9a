/* SPDX-License-Identifier: Apache-2.0 */
/* Programs from the shaders of shaders/, which are compiled into the library. Internal. */
#ifndef SRP_GL_SRC_PROGRAM_H
#define SRP_GL_SRC_PROGRAM_H

#include "context.h"

/* A file of shaders/, as the build has embedded it. */
typedef struct srp_gl_source {
    const char *file; /* from the top of our sources */
    const char *text; /* without #version */
} srp_gl_source;

extern const srp_gl_source srp_gl_ids_vert, srp_gl_ids_frag, srp_gl_bounce_comp;
extern const srp_gl_source srp_gl_render_vert, srp_gl_render_frag;

typedef struct srp_gl_stage {
    GLenum kind; /* GL_VERTEX_SHADER, ... */
    const srp_gl_source *source;
} srp_gl_stage;

/*
 * Compiles and links. `prelude` goes before each source: #version and definitions.
 * SRP_NO_DEVICE: with what the driver says, our file, and the line where it tells.
 */
SRP_CHECK srp_status srp_gl_program_create(const srp_gl_context *context, const char *prelude,
                                           const srp_gl_stage *stages, size_t count, GLuint *out,
                                           srp_error *error);

#endif
