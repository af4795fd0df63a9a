/* SPDX-License-Identifier: Apache-2.0 */
/* What the fuzz targets share. A target reads its input twice: whatever is accepted must keep the
 * promises of its header, and be the same both times. */
#ifndef SRP_FUZZ_H
#define SRP_FUZZ_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Ends the run as a crash does, so that the input is kept. */
#define REQUIRE(condition)                                                                         \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition);                \
            abort();                                                                               \
        }                                                                                          \
    } while (0)

#endif
