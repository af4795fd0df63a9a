/* SPDX-License-Identifier: Apache-2.0 */
/* A gravity field from a .gfc file, and a value of it. */
#include "fuzz.h"

#include <srp/orbit/gravity.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    srp_gravity *field = NULL;
    srp_error error;
    srp_status status =
        srp_gravity_parse((const char *)data, size, "fuzz", 4, 3, NULL, &field, &error);
    if (status != SRP_OK) {
        REQUIRE(status == SRP_BAD_FORMAT || status == SRP_BAD_DATA);
        REQUIRE(error.message[0] != '\0' && field == NULL);
        return 0;
    }
    REQUIRE(srp_gravity_mu(field) > 0.0 && srp_gravity_radius(field) > 0.0);
    (void)srp_gravity_eval(field, srp_vec3_make(1e7, -2e7, 3e6));
    srp_gravity_destroy(field);
    return 0;
}
