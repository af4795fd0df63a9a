/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Memory that ends on demand. The linker sends malloc, calloc, realloc, aligned_alloc and free of
 * our own objects through failing_alloc.c (--wrap; srp_fail_allocations() in tests/CMakeLists.txt);
 * those of libraries are not touched. All functions may be called while threads allocate.
 */
#ifndef SRP_TEST_FAILING_ALLOC_H
#define SRP_TEST_FAILING_ALLOC_H

#include <srp/status.h>

#include <stdbool.h>

/* From now on allocation `n` fails (0: the next), those before and after it do not. */
void failing_alloc_arm(long n);
/* Whether it came to that. */
bool failing_alloc_disarm(void);
/* Blocks taken and not given back. */
long failing_alloc_held(void);

typedef srp_status (*failing_alloc_run)(void *user, srp_error *error);

/* Lets each allocation of `run` fail in turn, until it needs no more: it has to answer
 * SRP_NO_MEMORY with words, and to give back all that it took. The number of its allocations, which
 * is more than 0. `name`: for messages. */
long failing_alloc_exhaust(const char *name, failing_alloc_run run, void *user);

#endif
