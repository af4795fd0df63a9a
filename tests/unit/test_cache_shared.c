/* SPDX-License-Identifier: Apache-2.0 */
/* One cache under many threads, and under processes that are killed. */
#define _DEFAULT_SOURCE /* usleep, MAP_ANONYMOUS */

#include "cache_fixture.h"
#include "platform.h"
#include "srp_check.h"
#include "table_internal.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- Threads --------------------------------------------------------------------------------- */

/* Two tables of one cache under many threads, written all the time. */
START_TEST(threads_share_a_cache) {
    counting_fixture fixture = counting_begin(&counting_method, (srp_grid){25, 13});
    srp_cache_params params = cache_params();
    params.flush_nodes = 4;
    params.wait_seconds = 60.0;
    srp_cache *cache = open_cache(&params);
    srp_demand *tables[2] = {make_demand(&fixture, cache), make_demand(&fixture, cache)};
    atomic_int failures = 0;
#pragma omp parallel for num_threads(8)
    for (int thread = 0; thread < 8; ++thread) {
        uint64_t state = (uint64_t)thread;
        for (int k = 0; k < 100; ++k) {
            const srp_demand_node nodes[] = {
                {(uint32_t)(random_bits(&state) % 25), (uint32_t)(random_bits(&state) % 13)},
                {(uint32_t)(random_bits(&state) % 25), (uint32_t)(random_bits(&state) % 13)}};
            srp_error error;
            failures += srp_demand_need(tables[k % 2], 2, nodes, &error) != SRP_OK;
            failures += srp_demand_get(tables[k % 2], nodes[1]) == NULL;
            failures += k % 50 == 25 && srp_demand_flush(tables[k % 2], &error) != SRP_OK;
        }
    }
    ck_assert_int_eq(failures, 0);
    ck_assert_int_eq(cache_test.messages, 0);
    ck_assert_int_le(counting_most(), 2);
    for (int k = 0; k < 2; ++k) {
        need_columns(tables[k], 0, 25);
        assert_is_full(&fixture, tables[k]);
        srp_demand_destroy(tables[k]);
    }
    srp_demand *again = make_demand(&fixture, cache);
    ck_assert_uint_eq(srp_demand_count(again).ready, srp_demand_count(again).total);
    srp_demand_destroy(again);
    srp_cache_close(cache);
    counting_end(&fixture);
}
END_TEST

/* ---- Killed --------------------------------------------------------------------------------- */

enum { KILLS = 20 };

/* Fills the table in a random order, writing it after every node, until it is killed. */
static void fill_and_die(const counting_fixture *fixture, uint64_t seed) {
    srp_cache_params params = cache_params();
    params.flush_nodes = 1;
    srp_cache *cache = open_cache(&params);
    srp_demand *demand = make_demand(fixture, cache);
    for (;;) {
        srp_demand_node node = {(uint32_t)(random_bits(&seed) % fixture->grid.az_count),
                                (uint32_t)(random_bits(&seed) % fixture->grid.el_count)};
        srp_error error;
        if (srp_demand_need(demand, 1, &node, &error) != SRP_OK) {
            _exit(1);
        }
    }
}

/* What the file holds; an empty table while there is none. It is readable at all times. */
static srp_table *committed(const counting_fixture *fixture) {
    srp_cache_params params = cache_params();
    params.wait_seconds = 60.0;
    srp_cache *cache = open_cache(&params);
    srp_table *table = NULL;
    srp_error error;
    assert_ok(srp_table_create(fixture->prepared, fixture->grid, false, &table, &error), error);
    assert_ok(srp_cache_exchange(cache, fixture->prepared, table, NULL, &error), error);
    srp_cache_close(cache);
    return table;
}

/* Whether a process was killed while it wrote; others remove drafts at once when they can. */
static bool left_a_draft(pid_t process) {
    char path[160], draft[200];
    only_table(path);
    snprintf(draft, sizeof draft, "%s.%ld.tmp", path, (long)process);
    return access(draft, F_OK) == 0;
}

/* Nodes that are committed are in the next generation's file as well, and were not computed again:
 * `times` is how often each was answered before this generation. */
static void compare_generations(const srp_table *before, const srp_table *after, const int *times) {
    for (size_t k = 0; k < srp_grid_node_count(before->grid); ++k) {
        if (before->filled[k]) {
            ck_assert_msg(after->filled[k], "node %zu is lost", k);
            ck_assert_msg(atomic_load(&counting.answered[k]) == times[k],
                          "node %zu was committed and is computed again", k);
        }
    }
}

START_TEST(whoever_is_killed_leaves_a_cache_that_others_complete) {
    const srp_grid grid = {25, 13};
    counting_fixture fixture = counting_begin(&counting_method, grid);
    const size_t size = srp_grid_node_count(grid) * sizeof *counting.answered;
    free(counting.answered);
    /* Counted by all processes together. */
    counting.answered = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    ck_assert_ptr_ne(counting.answered, MAP_FAILED);
    srp_cache_params params = cache_params();
    params.flush_nodes = 1;
    params.wait_seconds = 60.0;
    counting.delay_us = 2000; /* some time without the lock for everybody */
    srp_cache *cache = open_cache(&params);
    srp_demand *survivor = make_demand(&fixture, cache);
    /* A file is there from the beginning, whoever is killed first. */
    const srp_demand_node pole = {0, 0};
    srp_error error;
    assert_ok(srp_demand_need(survivor, 1, &pole, &error), error);
    assert_ok(srp_demand_flush(survivor, &error), error);
    srp_table *before = committed(&fixture);
    int *times = calloc(srp_grid_node_count(grid), sizeof *times);
    uint64_t state = (uint64_t)getpid();
    int drafts = 0;
    for (int kill_number = 0; kill_number < KILLS; ++kill_number) {
        for (size_t k = 0; k < srp_grid_node_count(grid); ++k) {
            times[k] = atomic_load(&counting.answered[k]);
        }
        uint64_t seed = random_bits(&state);
        pid_t child = fork();
        ck_assert_int_ge(child, 0);
        if (child == 0) {
            fill_and_die(&fixture, seed);
        }
        /* The survivor works on the same table meanwhile; it has seen what was committed. */
        assert_ok(srp_demand_flush(survivor, &error), error);
        double end = srp_platform_seconds() + 0.002 + 0.04 * random_unit(&state);
        do {
            srp_demand_node node = {(uint32_t)(random_bits(&state) % grid.az_count),
                                    (uint32_t)(random_bits(&state) % grid.el_count)};
            assert_ok(srp_demand_need(survivor, 1, &node, &error), error);
            usleep(1000);
        } while (srp_platform_seconds() < end && srp_demand_count(survivor).ready < 180);
        usleep((useconds_t)(10000 * random_unit(&state)));
        int status;
        ck_assert_int_eq(kill(child, SIGKILL), 0);
        ck_assert_int_eq(waitpid(child, &status, 0), child);
        ck_assert(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
        drafts += left_a_draft(child);
        srp_table *after = committed(&fixture);
        compare_generations(before, after, times);
        srp_table_destroy(before);
        before = after;
    }
    size_t kept = srp_table_filled_count(before);
    assert_ok(srp_demand_flush(survivor, &error), error);
    need_columns(survivor, 0, grid.az_count);
    assert_is_full(&fixture, survivor);
    srp_demand_destroy(survivor);
    srp_cache_close(cache);
    cache = open_cache(&params);
    srp_demand *last = make_demand(&fixture, cache);
    ck_assert_uint_eq(srp_demand_count(last).ready, srp_demand_count(last).total);
    assert_is_full(&fixture, last);
    ck_assert_int_eq(cache_test.messages, 0);
    printf("%d kills, %d in the middle of writing: %zu of %zu nodes were kept by then, none lost, "
           "none computed again\n",
           KILLS, drafts, kept, srp_grid_node_count(grid));
    srp_demand_destroy(last);
    srp_cache_close(cache);
    srp_table_destroy(before);
    free(times);
    munmap(counting.answered, size);
    counting.answered = NULL;
    counting_end(&fixture);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("cache_shared");
    TCase *tcase = tcase_create("cache_shared");
    tcase_add_checked_fixture(tcase, cache_begin, cache_end);
    tcase_add_test(tcase, threads_share_a_cache);
    tcase_add_test(tcase, whoever_is_killed_leaves_a_cache_that_others_complete);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
