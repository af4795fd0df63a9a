/* SPDX-License-Identifier: Apache-2.0 */
#include "pool.h"

#include "error.h"

#include <stdlib.h>

/* The context is current, if there is one. */
static void destroy_worker(const srp_gl_pool *pool, srp_gl_worker *worker) {
    if (worker->context != NULL) {
        pool->kind->clear(worker);
        srp_gl_context_leave(worker->context);
        srp_gl_context_destroy(worker->context);
    }
    free(worker);
}

static srp_status create_worker(srp_gl_pool *pool, srp_gl_worker **out, srp_error *error) {
    srp_gl_context *context = NULL;
    srp_status status = srp_gl_context_create(pool->device, &context, error);
    if (status != SRP_OK) {
        return status;
    }
    status = srp_gl_context_enter(context, error);
    if (status != SRP_OK) {
        srp_gl_context_destroy(context);
        return status;
    }
    srp_gl_worker *worker = calloc(1, pool->kind->size);
    if (worker == NULL) {
        srp_gl_context_leave(context);
        srp_gl_context_destroy(context);
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a worker of OpenGL");
    }
    worker->context = context;
    status = pool->kind->fill(pool->prepared, worker, error);
    if (status != SRP_OK) {
        destroy_worker(pool, worker);
        return status;
    }
    *out = worker;
    return SRP_OK;
}

srp_status srp_gl_pool_take(srp_gl_pool *pool, srp_gl_worker **out, srp_error *error) {
    for (size_t i = 0; i < SRP_GL_POOL_SLOTS; ++i) {
        srp_gl_worker *worker = atomic_exchange(&pool->slot[i], NULL);
        if (worker != NULL) {
            srp_status status = srp_gl_context_enter(worker->context, error);
            if (status != SRP_OK) {
                atomic_store(&pool->slot[i], worker);
                return status;
            }
            *out = worker;
            return SRP_OK;
        }
    }
    return create_worker(pool, out, error);
}

void srp_gl_pool_give(srp_gl_pool *pool, srp_gl_worker *worker) {
    srp_gl_context_leave(worker->context);
    for (size_t i = 0; i < SRP_GL_POOL_SLOTS; ++i) {
        srp_gl_worker *empty = NULL;
        if (atomic_compare_exchange_strong(&pool->slot[i], &empty, worker)) {
            return;
        }
    }
    if (srp_gl_context_enter(worker->context, NULL) == SRP_OK) {
        destroy_worker(pool, worker);
    }
}

srp_status srp_gl_pool_warm_up(srp_gl_pool *pool, srp_error *error) {
    srp_gl_worker *worker = NULL;
    srp_status status = srp_gl_pool_take(pool, &worker, error);
    if (status == SRP_OK) {
        srp_gl_pool_give(pool, worker);
    }
    return status;
}

void srp_gl_pool_clear(srp_gl_pool *pool) {
    for (size_t i = 0; i < SRP_GL_POOL_SLOTS; ++i) {
        srp_gl_worker *worker = atomic_exchange(&pool->slot[i], NULL);
        if (worker != NULL && srp_gl_context_enter(worker->context, NULL) == SRP_OK) {
            destroy_worker(pool, worker);
        }
    }
}
