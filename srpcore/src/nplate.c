/* SPDX-License-Identifier: Apache-2.0 */
/* N-plate: the sum of the facet formula over one-sided plates, without shadows (AAS 20-481, Eq. 5,
 * with s to the Sun). Plates have no place, hence there is no moment. */
#include "error.h"
#include "method_internal.h"
#include "scene_internal.h"

#include <stdlib.h>

typedef struct nplate {
    srp_prepared head;
    srp_scratch_pool pool;
} nplate;

static srp_scratch *scratch_create(const srp_prepared *prepared) {
    (void)prepared;
    return calloc(1, sizeof(srp_scratch));
}

static void scratch_destroy(srp_scratch *scratch) {
    free(scratch);
}

static srp_status respond_direction(const srp_prepared *prepared, srp_scratch *scratch, srp_vec3 s,
                                    srp_response *out) {
    (void)out;
    const srp_scene *scene = prepared->scene;
    const srp_vec3 no_lever = {0.0, 0.0, 0.0};
    for (size_t k = 0; k < scene->plate_count; ++k) {
        const srp_plate *plate = &scene->plates[k];
        double cosine = srp_vec3_dot(plate->normal, s);
        if (cosine > 0.0) {
            srp_basis_add(&scratch->basis[k], plate->area * cosine, cosine, plate->normal,
                          no_lever);
        }
    }
    return SRP_OK;
}

static const srp_direction_kernel KERNEL = {scratch_create, scratch_destroy, respond_direction};

static srp_status prepare(const srp_scene *scene, const srp_method_params *params,
                          srp_prepared **out, srp_error *error) {
    nplate *state = calloc(1, sizeof *state);
    if (state == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for the N-plate method");
    }
    state->head.method = &srp_method_nplate;
    state->head.scene = scene;
    state->head.params = *params;
    *out = &state->head;
    return SRP_OK;
}

static srp_status respond(const srp_prepared *prepared, size_t count, const srp_vec3 *s_body,
                          srp_response *responses, srp_basis *basis, srp_error *error) {
    nplate *state = (nplate *)prepared;
    return srp_respond_each(prepared, &KERNEL, &state->pool, count, s_body, responses, basis,
                            error);
}

static void release(srp_prepared *prepared) {
    srp_scratch_pool_clear(&((nplate *)prepared)->pool, &KERNEL);
    free(prepared);
}

const srp_method srp_method_nplate = {
    .name = "nplate",
    .device = "cpu",
    .summary = "one-sided flat plates that do not shade each other",
    .shapes = SRP_SHAPE_PLATES,
    .capabilities = SRP_METHOD_EXACT | SRP_METHOD_BASIS,
    .prepare = prepare,
    .respond = respond,
    .release = release,
};
