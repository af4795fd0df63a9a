/* SPDX-License-Identifier: Apache-2.0 */
/* Cannonball: f = -Cr A s (AAS 20-481, Eq. 4, with s to the Sun). No moment: the sphere's centre of
 * pressure is taken to be the reference point. */
#include "error.h"
#include "method_internal.h"
#include "scene_internal.h"

#include <stdlib.h>
#include <string.h>

static srp_status prepare(const srp_scene *scene, const srp_method_params *params,
                          srp_prepared **out, srp_error *error) {
    srp_prepared *prepared = malloc(sizeof *prepared);
    if (prepared == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for the cannonball method");
    }
    prepared->method = &srp_method_cannonball;
    prepared->scene = scene;
    prepared->params = *params;
    *out = prepared;
    return SRP_OK;
}

static srp_status respond(const srp_prepared *prepared, size_t count, const srp_vec3 *s_body,
                          srp_response *responses, srp_basis *basis, srp_error *error) {
    (void)basis;
    (void)error;
    memset(responses, 0, count * sizeof *responses);
    for (size_t i = 0; i < count; ++i) {
        srp_vec3 f = srp_vec3_scale(-prepared->scene->cr * prepared->scene->area, s_body[i]);
        responses[i].f = srp_vec3_make(f.x + 0.0, f.y + 0.0, f.z + 0.0); /* no -0 */
        responses[i].lit_area = prepared->scene->area;
    }
    return SRP_OK;
}

static void release(srp_prepared *prepared) {
    free(prepared);
}

const srp_method srp_method_cannonball = {
    .name = "cannonball",
    .device = "cpu",
    .summary = "a sphere of area A and coefficient Cr: the same force from every side",
    .shapes = SRP_SHAPE_SPHERE,
    .capabilities = SRP_METHOD_EXACT,
    .prepare = prepare,
    .respond = respond,
    .release = release,
};
