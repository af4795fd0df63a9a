/* SPDX-License-Identifier: Apache-2.0 */
/* Runs a fuzz target over the files named on the command line: the kept corpus is part of every
 * test run, whatever the compiler. */
#include "fuzz.h"

static void run(const char *path) {
    FILE *file = fopen(path, "rb");
    REQUIRE(file != NULL);
    size_t capacity = 1 << 16, size = 0, got;
    uint8_t *bytes = malloc(capacity);
    REQUIRE(bytes != NULL);
    while ((got = fread(bytes + size, 1, capacity - size, file)) > 0) {
        size += got;
        if (size == capacity) {
            bytes = realloc(bytes, capacity *= 2);
            REQUIRE(bytes != NULL);
        }
    }
    fclose(file);
    /* An exact copy, so that a sanitizer sees a read past the end. */
    uint8_t *exact = malloc(size > 0 ? size : 1);
    REQUIRE(exact != NULL);
    memcpy(exact, bytes, size);
    free(bytes);
    LLVMFuzzerTestOneInput(exact, size);
    free(exact);
}

int main(int count, char **paths) {
    if (count < 2) {
        fprintf(stderr, "no input files\n");
        return EXIT_FAILURE;
    }
    for (int i = 1; i < count; ++i) {
        run(paths[i]);
    }
    printf("%d inputs\n", count - 1);
    return EXIT_SUCCESS;
}
