/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Who makes contexts: OSMesa or EGL, each behind the same few functions. Both are opened at run
 * time. Internal; what the rest uses is context.h.
 */
#ifndef SRP_GL_SRC_PROVIDER_H
#define SRP_GL_SRC_PROVIDER_H

#include <srp/status.h>

#include <stdbool.h>

typedef void (*srp_gl_function)(void);

/* A context off screen, without a surface that anything is drawn on. Its state is the provider's.
 */
typedef struct srp_gl_binding srp_gl_binding;

enum { SRP_GL_ANY_DEVICE = -1 };

typedef struct srp_gl_provider {
    const char *name; /* as users know it */
    /* A core context of this version, current nowhere. `index`: which of the provider's devices, or
     * SRP_GL_ANY_DEVICE. SRP_NO_DEVICE (the message says what is missing, and how to get it),
     * SRP_NO_MEMORY. */
    srp_status (*create)(int index, int major, int minor, srp_gl_binding **out, srp_error *error);
    /* Makes it current on this thread; only one thread may have it. */
    bool (*enter)(srp_gl_binding *binding);
    /* Makes none current on this thread. */
    void (*leave)(srp_gl_binding *binding);
    /* It is current nowhere. */
    void (*destroy)(srp_gl_binding *binding);
    srp_gl_function (*find)(const srp_gl_binding *binding, const char *name);
} srp_gl_provider;

extern const srp_gl_provider srp_gl_osmesa, srp_gl_egl;

#endif
