/* SPDX-License-Identifier: Apache-2.0 */
/* The parallel loop over directions, and the pool of scratch memory behind it. */
#include "error.h"
#include "method_internal.h"
#include "scene_internal.h"

#include <stdlib.h>
#include <string.h>

static void scratch_free(srp_scratch *scratch, const srp_direction_kernel *kernel) {
    if (scratch != NULL) {
        free(scratch->basis);
        kernel->scratch_destroy(scratch);
    }
}

static srp_scratch *pool_take(srp_scratch_pool *pool, const srp_prepared *prepared,
                              const srp_direction_kernel *kernel) {
    for (size_t i = 0; i < SRP_SCRATCH_SLOTS; ++i) {
        srp_scratch *scratch = atomic_exchange(&pool->slot[i], NULL);
        if (scratch != NULL) {
            return scratch;
        }
    }
    srp_scratch *scratch = kernel->scratch_create(prepared);
    if (scratch == NULL) {
        return NULL;
    }
    scratch->basis = calloc(prepared->scene->material_count + 1, sizeof *scratch->basis);
    if (scratch->basis == NULL) {
        scratch_free(scratch, kernel);
        return NULL;
    }
    return scratch;
}

static void pool_give(srp_scratch_pool *pool, srp_scratch *scratch,
                      const srp_direction_kernel *kernel) {
    for (size_t i = 0; i < SRP_SCRATCH_SLOTS; ++i) {
        srp_scratch *empty = NULL;
        if (atomic_compare_exchange_strong(&pool->slot[i], &empty, scratch)) {
            return;
        }
    }
    scratch_free(scratch, kernel);
}

void srp_scratch_pool_clear(srp_scratch_pool *pool, const srp_direction_kernel *kernel) {
    for (size_t i = 0; i < SRP_SCRATCH_SLOTS; ++i) {
        scratch_free(atomic_exchange(&pool->slot[i], NULL), kernel);
    }
}

/* The last sum is that of absorbing backs: optics 0, 0. */
void srp_basis_add_force(const srp_scene *scene, const srp_basis *basis, srp_vec3 s, srp_vec3 *f,
                         srp_vec3 *t) {
    const srp_optics black = {0.0, 0.0, false};
    for (size_t m = 0; m <= scene->material_count; ++m) {
        srp_basis_apply(&basis[m], m < scene->material_count ? scene->optics[m] : black, s, f, t);
    }
}

double srp_basis_lit_area(const srp_scene *scene, const srp_basis *basis) {
    double area = 0.0;
    for (size_t m = 0; m <= scene->material_count; ++m) {
        area += basis[m].a;
    }
    return area;
}

void srp_basis_finish(const srp_scene *scene, const srp_basis *basis, srp_vec3 s,
                      srp_response *out) {
    srp_basis_add_force(scene, basis, s, &out->f, &out->t);
    out->lit_area = srp_basis_lit_area(scene, basis);
    out->back_area = basis[scene->material_count].a;
}

static srp_status respond_one(const srp_prepared *prepared, const srp_direction_kernel *kernel,
                              srp_scratch *scratch, srp_vec3 s, srp_response *response,
                              srp_basis *basis) {
    size_t row = prepared->scene->material_count + 1;
    memset(scratch->basis, 0, row * sizeof *scratch->basis);
    memset(response, 0, sizeof *response);
    srp_status status = kernel->respond(prepared, scratch, s, response);
    if (status == SRP_OK) {
        srp_basis_finish(prepared->scene, scratch->basis, s, response);
        if (basis != NULL) {
            memcpy(basis, scratch->basis, row * sizeof *basis);
        }
    }
    return status;
}

srp_status srp_respond_each(const srp_prepared *prepared, const srp_direction_kernel *kernel,
                            srp_scratch_pool *pool, size_t count, const srp_vec3 *s_body,
                            srp_response *responses, srp_basis *basis, srp_error *error) {
    size_t row = prepared->scene->material_count + 1;
    int threads = prepared->params.threads;
    if ((size_t)threads > count) {
        threads = count > 0 ? (int)count : 1;
    }
    atomic_int failed = 0;
#pragma omp parallel num_threads(threads)
    {
        srp_scratch *scratch = pool_take(pool, prepared, kernel);
        if (scratch == NULL) {
            atomic_store(&failed, 1);
        }
#pragma omp for schedule(dynamic, 1)
        for (size_t i = 0; i < count; ++i) {
            if (atomic_load_explicit(&failed, memory_order_relaxed) == 0 &&
                respond_one(prepared, kernel, scratch, s_body[i], &responses[i],
                            basis != NULL ? basis + i * row : NULL) != SRP_OK) {
                atomic_store(&failed, 1);
            }
        }
        if (scratch != NULL) {
            pool_give(pool, scratch, kernel);
        }
    }
    if (atomic_load(&failed)) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for the %s method",
                        prepared->method->name);
    }
    return SRP_OK;
}

srp_status srp_respond_in_turn(const srp_prepared *prepared, const srp_direction_kernel *kernel,
                               srp_scratch_pool *pool, size_t count, const srp_vec3 *s_body,
                               srp_response *responses, srp_basis *basis, srp_error *error) {
    size_t row = prepared->scene->material_count + 1;
    for (size_t i = 0; i < count; ++i) {
        srp_status status = srp_respond_each(prepared, kernel, pool, 1, &s_body[i], &responses[i],
                                             basis != NULL ? basis + i * row : NULL, error);
        if (status != SRP_OK) {
            return status;
        }
    }
    return SRP_OK;
}
