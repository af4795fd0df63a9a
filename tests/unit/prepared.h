/* SPDX-License-Identifier: Apache-2.0 */
/* Methods on scenes, and their answers, where neither may fail. */
#ifndef SRP_TEST_PREPARED_H
#define SRP_TEST_PREPARED_H

#include "srp_check.h"

#include <srp/method.h>

static inline srp_prepared *prepare_with(const srp_method *method, const srp_scene *scene,
                                         const srp_method_params *params) {
    srp_error error;
    srp_prepared *prepared = NULL;
    assert_ok(srp_method_prepare(method, scene, params, &prepared, &error), error);
    return prepared;
}

/* On one thread, moments about the origin. */
static inline srp_prepared *prepare_on(const srp_method *method, const srp_scene *scene) {
    srp_method_params params = srp_method_params_default();
    params.threads = 1;
    return prepare_with(method, scene, &params);
}

static inline void respond_each(const srp_prepared *prepared, size_t count, const srp_vec3 *s,
                                srp_response *responses) {
    srp_error error;
    assert_ok(srp_prepared_respond(prepared, count, s, responses, NULL, &error), error);
}

static inline srp_response respond_to(const srp_prepared *prepared, srp_vec3 s) {
    srp_response response;
    respond_each(prepared, 1, &s, &response);
    return response;
}

#endif
