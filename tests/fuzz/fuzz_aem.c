/* SPDX-License-Identifier: Apache-2.0 */
/* An attitude from a CCSDS AEM, asked in its span and beside it: a rotation, or a refusal. */
#include "fuzz.h"

#include <srp/orbit/attitude.h>

#include <math.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const srp_epoch epoch = {2460389.5, 0.0};
    srp_attitude attitude;
    srp_error error;
    srp_status status =
        srp_attitude_aem_parse((const char *)data, size, "fuzz", epoch, &attitude, &error);
    if (status != SRP_OK) {
        REQUIRE(status == SRP_BAD_FORMAT || status == SRP_BAD_DATA || status == SRP_UNSUPPORTED);
        REQUIRE(error.message[0] != '\0');
        return 0;
    }
    for (int i = -1; i < 8; ++i) {
        const srp_force_state state = {30.0 * i, {1e7, 0, 0}, {0, 1e3, 0}, NULL};
        double m[3][3];
        if (attitude.eval(attitude.user, &state, m) == 0) {
            const double row = m[0][0] * m[0][0] + m[0][1] * m[0][1] + m[0][2] * m[0][2];
            REQUIRE(fabs(row - 1.0) < 1e-9);
        }
    }
    srp_attitude_release(&attitude);
    return 0;
}
