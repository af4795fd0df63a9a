/* SPDX-License-Identifier: Apache-2.0 */
/* The text of a mission file, held against the schema; the files that it names are not opened. */
#include "fuzz.h"
#include "mission_internal.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    mission_source *source = NULL;
    srp_error error;
    srp_status status = mission_source_open((const char *)data, size, "fuzz", &source, &error);
    if (status != SRP_OK) {
        REQUIRE(status == SRP_BAD_FORMAT);
        REQUIRE(error.message[0] != '\0' && error.line > 0 && source == NULL);
        return 0;
    }
    const mission_file *file = mission_source_file(source);
    REQUIRE(file->epoch != NULL && file->duration != NULL && file->spacecraft->mass != NULL);
    double value[4];
    for (int kind = 0; kind < MISSION_KIND_COUNT; ++kind) {
        status = mission_values(source, "duration", file->duration, (mission_kind)kind, 1, value,
                                &error);
        REQUIRE(status == SRP_OK || (status == SRP_BAD_FORMAT && error.line > 0));
    }
    mission_source_close(source);
    return 0;
}
