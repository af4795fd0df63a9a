/* SPDX-License-Identifier: Apache-2.0 */
/* Exact: first hits of sunlight without sampling. How they are found is in exact_visible.c. */
#include "error.h"
#include "exact_lit.h"
#include "method_internal.h"
#include "scene_internal.h"

#include <stdlib.h>

typedef struct exact {
    srp_prepared head;
    srp_scratch_pool pool;
} exact;

typedef struct exact_scratch {
    srp_scratch base;
    srp_visible *visible;
} exact_scratch;

static void scratch_destroy(srp_scratch *base) {
    srp_visible_destroy(((exact_scratch *)base)->visible);
    free(base);
}

static srp_scratch *scratch_create(const srp_prepared *prepared) {
    exact_scratch *work = calloc(1, sizeof *work);
    if (work == NULL) {
        return NULL;
    }
    work->visible = srp_visible_create(prepared->scene);
    if (work->visible == NULL) {
        scratch_destroy(&work->base);
        return NULL;
    }
    return &work->base;
}

/* Where the light of a direction goes. */
typedef struct sink {
    const srp_prepared *prepared;
    srp_basis *basis;
} sink;

static srp_status add_lit(void *user, const srp_lit *lit) {
    const sink *to = user;
    srp_exact_add_lit(to->prepared->scene, to->prepared->params.reference, lit, to->basis);
    return SRP_OK;
}

static srp_status respond_direction(const srp_prepared *prepared, srp_scratch *base, srp_vec3 s,
                                    srp_response *out) {
    (void)out;
    srp_beam beam = srp_beam_of_sun(prepared->scene, s);
    sink to = {prepared, base->basis};
    return srp_visible_find(((exact_scratch *)base)->visible, &beam, false, add_lit, &to);
}

static const srp_direction_kernel KERNEL = {scratch_create, scratch_destroy, respond_direction};

static srp_status prepare(const srp_scene *scene, const srp_method_params *params,
                          srp_prepared **out, srp_error *error) {
    exact *state = calloc(1, sizeof *state);
    if (state == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for the exact method");
    }
    state->head.method = &srp_method_exact;
    state->head.scene = scene;
    state->head.params = *params;
    *out = &state->head;
    return SRP_OK;
}

static srp_status respond(const srp_prepared *prepared, size_t count, const srp_vec3 *s_body,
                          srp_response *responses, srp_basis *basis, srp_error *error) {
    exact *state = (exact *)prepared;
    return srp_respond_each(prepared, &KERNEL, &state->pool, count, s_body, responses, basis,
                            error);
}

static void release(srp_prepared *prepared) {
    srp_scratch_pool_clear(&((exact *)prepared)->pool, &KERNEL);
    free(prepared);
}

const srp_method srp_method_exact = {
    .name = "exact",
    .device = "cpu",
    .summary = "first hit of the light, visible polygons by clipping; no sampling error",
    .shapes = SRP_SHAPE_MESH,
    .capabilities = SRP_METHOD_EXACT | SRP_METHOD_BASIS | SRP_METHOD_MOMENT,
    .prepare = prepare,
    .respond = respond,
    .release = release,
};
