/* SPDX-License-Identifier: Apache-2.0 */
/* GMAT's own look-up (srp/spad.h) as an area model. */
#include <srp/orbit/area_model.h>
#include <srp/spad.h>

#include <stddef.h>

static int spad_eval(const void *user, srp_vec3 s, srp_vec3 *f, double (*df)[3]) {
    return srp_spad_eval(user, s, f, df, NULL) == SRP_OK ? 0 : -1;
}

static void spad_destroy(void *user) {
    srp_spad_destroy(user);
}

srp_status srp_area_model_spad(const srp_table *table, bool cubic, srp_area_model *out,
                               srp_error *error) {
    srp_spad *spad = NULL;
    const srp_status status = srp_spad_create(table, cubic, &spad, error);
    if (status == SRP_OK) {
        *out = (srp_area_model){cubic ? "gmat_bicubic" : "gmat_bilinear", 0, spad_eval,
                                spad_destroy, spad};
    }
    return status;
}
