/* SPDX-License-Identifier: Apache-2.0 */
/* A data race on purpose; with the argument "ordered", the same sum without one. */
#include <stdio.h>

int main(int argc, char **argv) {
    (void)argv;
    enum { COUNT = 1000 };
    long sum = 0;
    if (argc > 1) {
#pragma omp parallel for num_threads(4) reduction(+ : sum)
        for (long i = 0; i < COUNT; ++i) {
            sum += i;
        }
    } else {
#pragma omp parallel for num_threads(4)
        for (long i = 0; i < COUNT; ++i) {
            sum += i;
        }
    }
    printf("%ld\n", sum);
    return 0;
}
