/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Workers of a prepared method: each has a context with all that lies in it, and serves one call at
 * a time. They are kept between calls, since contexts take long to make. Internal.
 */
#ifndef SRP_GL_SRC_POOL_H
#define SRP_GL_SRC_POOL_H

#include "context.h"

#include <srp/method.h>

#include <stdatomic.h>

/* First member of every worker. */
typedef struct srp_gl_worker {
    srp_gl_context *context;
} srp_gl_worker;

typedef struct srp_gl_worker_kind {
    /* Fills in what a method keeps in its worker, zeroed but for its context, which is current.
     * After a failure `clear` is called. */
    size_t size;
    srp_status (*fill)(const srp_prepared *prepared, srp_gl_worker *worker, srp_error *error);
    /* The context is current. */
    void (*clear)(srp_gl_worker *worker);
} srp_gl_worker_kind;

enum { SRP_GL_POOL_SLOTS = 64 };

typedef struct srp_gl_pool {
    const srp_gl_device *device;
    const srp_gl_worker_kind *kind;
    const srp_prepared *prepared; /* that it belongs to */
    _Atomic(srp_gl_worker *) slot[SRP_GL_POOL_SLOTS];
} srp_gl_pool;

/* A worker with its context current on this thread: an idle one or a new one. SRP_NO_DEVICE,
 * SRP_NO_MEMORY. */
SRP_CHECK srp_status srp_gl_pool_take(srp_gl_pool *pool, srp_gl_worker **out, srp_error *error);
/* Its context is then current nowhere. */
void srp_gl_pool_give(srp_gl_pool *pool, srp_gl_worker *worker);
/* Makes the first worker: a machine without OpenGL is told before anything is computed. */
SRP_CHECK srp_status srp_gl_pool_warm_up(srp_gl_pool *pool, srp_error *error);
/* Nobody uses it any more. */
void srp_gl_pool_clear(srp_gl_pool *pool);

#endif
