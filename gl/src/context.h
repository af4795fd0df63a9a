/* SPDX-License-Identifier: Apache-2.0 */
/* A context of OpenGL off screen, with its functions. One thread has it at a time. Internal. */
#ifndef SRP_GL_SRC_CONTEXT_H
#define SRP_GL_SRC_CONTEXT_H

#include "functions.h"
#include "provider.h"

#include <srp/status.h>

#include <stdbool.h>
#include <stddef.h>

/* What `--device` names. */
typedef struct srp_gl_device {
    const char *name; /* "gl:osmesa", "gl:egl", "gl:egl:0", ... */
    const srp_gl_provider *provider;
    int index; /* or SRP_GL_ANY_DEVICE */
} srp_gl_device;

typedef struct srp_gl_context {
    const srp_gl_device *device;
    srp_gl_binding *binding;
    srp_gl_functions gl;
    bool computes;      /* OpenGL 4.3 or later: compute shaders */
    GLint side_max;     /* of a target */
    GLint texels_max;   /* of a buffer texture */
    char renderer[128]; /* as the driver names itself */
    char version[64];
} srp_gl_context;

/*
 * A context of OpenGL 4.3, or of 3.3 where that is all there is. Current on no thread afterwards.
 * SRP_NO_DEVICE (no library, no device, a version below 3.3, functions missing, or it draws
 * nothing: every context has to draw two triangles first), SRP_NO_MEMORY.
 */
SRP_CHECK srp_status srp_gl_context_create(const srp_gl_device *device, srp_gl_context **out,
                                           srp_error *error);
/* Not current. May be NULL. */
void srp_gl_context_destroy(srp_gl_context *context);

/*
 * Fills *out for the context that is current, which stays its maker's: it is never entered, left or
 * destroyed. `find` as in srp/render.h. SRP_NO_DEVICE (a version below 3.3, functions missing).
 */
SRP_CHECK srp_status srp_gl_context_adopt(srp_gl_function (*find)(void *user, const char *name),
                                          void *user, srp_gl_context *out, srp_error *error);

/* Makes it current on this thread, and none again. SRP_NO_DEVICE. */
SRP_CHECK srp_status srp_gl_context_enter(srp_gl_context *context, srp_error *error);
void srp_gl_context_leave(srp_gl_context *context);

/* SRP_OK unless OpenGL has met an error since the last time; `what` was being done.
 * SRP_NO_MEMORY, SRP_NO_DEVICE. */
SRP_CHECK srp_status srp_gl_context_check(const srp_gl_context *context, const char *what,
                                          srp_error *error);

/* The device of this name; NULL: there is none. */
const srp_gl_device *srp_gl_device_find(const char *name);

#endif
