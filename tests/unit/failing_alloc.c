/* SPDX-License-Identifier: Apache-2.0 */
#include "failing_alloc.h"

#include "srp_check.h"

#include <stdatomic.h>
#include <stdio.h>

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void __real_free(void *old);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
void __wrap_free(void *old);

static atomic_long until_failure; /* allocations that still succeed; below 0: failure is past */
static atomic_long held;
static atomic_bool armed;

static bool fails(void) {
    return atomic_load(&armed) && atomic_fetch_sub(&until_failure, 1) == 0;
}

static void *taken(void *block) {
    if (block != NULL) {
        atomic_fetch_add(&held, 1);
    }
    return block;
}

void *__wrap_malloc(size_t size) {
    return fails() ? NULL : taken(__real_malloc(size));
}

void *__wrap_calloc(size_t count, size_t size) {
    return fails() ? NULL : taken(__real_calloc(count, size));
}

void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    return fails() ? NULL : taken(__real_aligned_alloc(alignment, size));
}

void *__wrap_realloc(void *old, size_t size) {
    if (fails()) {
        return NULL;
    }
    void *block = __real_realloc(old, size);
    return old == NULL ? taken(block) : block;
}

void __wrap_free(void *old) {
    if (old != NULL) {
        atomic_fetch_sub(&held, 1);
    }
    __real_free(old);
}

void failing_alloc_arm(long n) {
    atomic_store(&until_failure, n);
    atomic_store(&armed, true);
}

bool failing_alloc_disarm(void) {
    atomic_store(&armed, false);
    return atomic_load(&until_failure) < 0;
}

long failing_alloc_held(void) {
    return atomic_load(&held);
}

long failing_alloc_exhaust(const char *name, failing_alloc_run run, void *user) {
    srp_status status = SRP_NO_MEMORY;
    long n = 0;
    for (; status != SRP_OK; ++n) {
        srp_error error = {.status = SRP_OK};
        long before = failing_alloc_held();
        failing_alloc_arm(n);
        status = run(user, &error);
        bool failed = failing_alloc_disarm();
        long leaked = failing_alloc_held() - before; /* at once: assertions themselves allocate */
        ck_assert_msg(status == (failed ? SRP_NO_MEMORY : SRP_OK),
                      "%s: allocation %ld fails and the status is %d (%s)", name, n, status,
                      error.message);
        ck_assert_msg(!failed || (error.status == status && error.message[0] != '\0'),
                      "%s: allocation %ld fails without a word", name, n);
        ck_assert_msg(leaked == 0, "%s: allocation %ld fails, %ld blocks leak", name, n, leaked);
        ck_assert_msg(n < 10000, "%s: no end of allocations", name);
    }
    printf("  %s: %ld allocations\n", name, n - 1);
    ck_assert_msg(n > 1, "%s allocates nothing: the test is blind", name);
    return n - 1;
}
