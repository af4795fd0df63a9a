/* SPDX-License-Identifier: Apache-2.0 */
/* The cache on disk: kept, merged, damaged, full, killed. */
#define _DEFAULT_SOURCE /* usleep, MAP_ANONYMOUS */

#include "cache_internal.h"
#include "demand_fixture.h"
#include "platform.h"
#include "srp_check.h"
#include "table_internal.h"

#include <signal.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static const srp_grid GRID = {13, 7};
enum { UNIQUE = 12 * 5 + 2 };

/* ---- A cache of its own for each test ------------------------------------------------------- */

static char directory[64], last_file[600], last_message[800];
static int message_count;

static void keep_message(void *user, const srp_error *what) {
    (void)user;
    ++message_count;
    snprintf(last_file, sizeof last_file, "%s", what->file);
    snprintf(last_message, sizeof last_message, "%s", what->message);
}

static srp_cache *open_cache(const srp_cache_params *params) {
    const srp_log log = {keep_message, NULL};
    srp_cache *cache = NULL;
    srp_error error;
    assert_ok(srp_cache_open(params, &log, &cache, &error), error);
    return cache;
}

static srp_cache_params cache_params(void) {
    srp_cache_params params = srp_cache_params_default();
    params.directory = directory;
    return params;
}

static void set_up(void) {
    snprintf(directory, sizeof directory, "test_cache.%ld/a/b", (long)getpid());
    message_count = 0;
}

static void tear_down(void) {
    char command[128];
    directory[strcspn(directory, "/")] = '\0';
    snprintf(command, sizeof command, "rm -rf '%s'", directory);
    ck_assert_int_eq(system(command), 0);
}

/* Name of the only table of the cache. */
static void only_table(char path[160]) {
    const srp_cache_params params = cache_params();
    srp_cache *cache = open_cache(&params);
    srp_cache_entry *entries = NULL;
    size_t count = 0, tables = 0;
    srp_error error;
    assert_ok(srp_cache_list(cache, &entries, &count, &error), error);
    for (size_t k = 0; k < count; ++k) {
        if (!entries[k].is_damaged) {
            snprintf(path, 160, "%s/%s", directory, entries[k].name);
            ++tables;
        }
    }
    ck_assert_uint_eq(tables, 1);
    srp_cache_entries_free(entries);
    srp_cache_close(cache);
}

/* Opens a table on demand, asks for columns, and closes it; how many directions were computed. */
static size_t visit(const counting_fixture *fixture, uint32_t begin, uint32_t end) {
    const srp_cache_params params = cache_params();
    srp_cache *cache = open_cache(&params);
    srp_demand *demand = make_demand(fixture, cache);
    need_columns(demand, begin, end);
    size_t computed = srp_demand_count(demand).computed;
    if (end == GRID.az_count) {
        assert_is_full(fixture, demand);
    }
    srp_demand_destroy(demand);
    srp_cache_close(cache);
    return computed;
}

/* ---- Remembering ---------------------------------------------------------------------------- */

START_TEST(nodes_are_remembered) {
    counting_fixture fixture = counting_begin(&counting_method, GRID);
    ck_assert_uint_eq(visit(&fixture, 0, 3), 3 * 5 + 2);
    ck_assert_uint_eq(visit(&fixture, 0, 3), 0);
    ck_assert_uint_eq(visit(&fixture, 2, 5), 2 * 5);
    ck_assert_uint_eq(visit(&fixture, 0, 13), UNIQUE - 5 * 5 - 2);
    ck_assert_uint_eq(visit(&fixture, 0, 13), 0);
    ck_assert_int_eq(message_count, 0);
    char path[160];
    srp_table *table = NULL;
    srp_error error;
    only_table(path);
    assert_ok(srp_table_read(&srp_table_format_netcdf, path, &table, &error), error);
    ck_assert(srp_table_is_complete(table));
    srp_table_destroy(table);
    counting_end(&fixture);
}
END_TEST

START_TEST(two_tables_of_one_cache_lose_nothing) {
    counting_fixture fixture = counting_begin(&counting_method, GRID);
    const srp_cache_params params = cache_params();
    srp_cache *cache = open_cache(&params);
    srp_demand *a = make_demand(&fixture, cache), *b = make_demand(&fixture, cache);
    srp_error error;
    need_columns(a, 0, 5);
    need_columns(b, 4, 9);
    assert_ok(srp_demand_flush(a, &error), error);
    assert_ok(srp_demand_flush(b, &error), error);
    /* b has learnt what a knows; a will. */
    ck_assert_uint_eq(srp_demand_count(b).ready, 9 * 5 + 2);
    ck_assert_uint_eq(srp_demand_count(a).ready, 5 * 5 + 2);
    assert_ok(srp_demand_flush(a, &error), error);
    ck_assert_uint_eq(srp_demand_count(a).ready, 9 * 5 + 2);
    need_columns(b, 9, 11);
    srp_demand_destroy(b);
    need_columns(a, 11, 13);
    srp_demand_destroy(a);
    srp_cache_close(cache);
    ck_assert_uint_eq(visit(&fixture, 0, 13), 0);
    counting_end(&fixture);
}
END_TEST

START_TEST(it_is_written_when_enough_is_new) {
    counting_fixture fixture = counting_begin(&counting_method, GRID);
    srp_cache_params params = cache_params();
    params.flush_nodes = 10;
    params.flush_seconds = 1e6;
    srp_cache *cache = open_cache(&params);
    srp_demand *a = make_demand(&fixture, cache);
    need_columns(a, 0, 1);
    srp_demand *b = make_demand(&fixture, cache);
    ck_assert_uint_eq(srp_demand_count(b).ready, 0);
    need_columns(a, 1, 2);
    srp_demand *c = make_demand(&fixture, cache);
    ck_assert_uint_eq(srp_demand_count(c).ready, 2 * 5 + 2);
    srp_cache_params quick = cache_params();
    quick.flush_seconds = 0.0;
    srp_cache *other = open_cache(&quick);
    srp_demand *d = make_demand(&fixture, other);
    need_columns(d, 7, 8);
    srp_demand *e = make_demand(&fixture, cache);
    ck_assert_uint_eq(srp_demand_count(e).ready, 3 * 5 + 2);
    srp_demand *all[] = {a, b, c, d, e};
    for (size_t k = 0; k < 5; ++k) {
        srp_demand_destroy(all[k]);
    }
    srp_cache_close(cache);
    srp_cache_close(other);
    counting_end(&fixture);
}
END_TEST

/* What decides the numbers decides the file. */
START_TEST(other_tables_have_other_files) {
    counting_fixture fixture = counting_begin(&counting_method, GRID);
    const srp_cache_params params = cache_params();
    srp_cache *cache = open_cache(&params);
    const srp_method *methods[] = {&counting_method, &counting_method, &counting_method,
                                   &counting_method, &counting_method, &forceless_method};
    srp_cache_entry *entries = NULL;
    size_t count = 0;
    srp_error error;
    for (size_t k = 0; k < 6; ++k) {
        srp_method_params how = srp_method_params_default();
        how.seed = k == 1;
        how.lattice.samples = k == 2 ? 300 : 512;
        how.reference.y = k == 3 ? 1e-9 : 0.0;
        counting_fixture other = fixture;
        other.grid.el_count = k == 4 ? 13 : 7;
        assert_ok(srp_method_prepare(methods[k], fixture.scene, &how, &other.prepared, &error),
                  error);
        srp_demand *demand = make_demand(&other, cache);
        ck_assert_uint_eq(srp_demand_count(demand).ready, 0);
        const srp_demand_node pole = {0, 0};
        assert_ok(srp_demand_need(demand, 1, &pole, &error), error);
        srp_demand_destroy(demand);
        srp_prepared_release(other.prepared);
    }
    assert_ok(srp_cache_list(cache, &entries, &count, &error), error);
    ck_assert_uint_eq(count, 6);
    srp_cache_entries_free(entries);
    /* The number of threads does not. */
    srp_method_params how = srp_method_params_default();
    how.threads = 7;
    counting_fixture other = fixture;
    assert_ok(srp_method_prepare(&counting_method, fixture.scene, &how, &other.prepared, &error),
              error);
    srp_demand *demand = make_demand(&other, cache);
    ck_assert_uint_eq(srp_demand_count(demand).ready, 1);
    srp_demand_destroy(demand);
    srp_prepared_release(other.prepared);
    srp_cache_close(cache);
    counting_end(&fixture);
}
END_TEST

START_TEST(whole_tables_can_be_exchanged) {
    counting_fixture fixture = counting_begin(&counting_method, GRID);
    srp_table *full = full_table(&fixture), *empty = NULL, *foreign = NULL;
    const srp_cache_params params = cache_params();
    srp_cache *cache = open_cache(&params);
    size_t found = 77;
    srp_error error;
    assert_ok(srp_cache_exchange(cache, fixture.prepared, full, &found, &error), error);
    ck_assert_uint_eq(found, 0);
    assert_ok(srp_table_create(fixture.prepared, GRID, false, &empty, &error), error);
    assert_ok(srp_cache_exchange(cache, fixture.prepared, empty, &found, &error), error);
    ck_assert_uint_eq(found, UNIQUE);
    char wanted[33], got[33];
    srp_table_checksum(full, wanted);
    srp_table_checksum(empty, got);
    ck_assert_str_eq(got, wanted);
    assert_ok(srp_table_create_blank(GRID, 0, false, &foreign, &error), error);
    ck_assert_int_eq(srp_cache_exchange(cache, fixture.prepared, foreign, &found, &error),
                     SRP_MISMATCH);
    ck_assert_uint_eq(found, UNIQUE);
    srp_table_destroy(full);
    srp_table_destroy(empty);
    srp_table_destroy(foreign);
    srp_cache_close(cache);
    counting_end(&fixture);
}
END_TEST

/* ---- What goes wrong ------------------------------------------------------------------------ */

static void change_file(const char *path, int how) {
    FILE *file = fopen(path, "r+b");
    ck_assert_ptr_nonnull(file);
    ck_assert_int_eq(fseek(file, 0, SEEK_END), 0);
    long size = ftell(file);
    switch (how) {
    case 0: /* cut short */
        ck_assert_int_eq(truncate(path, size / 2), 0);
        break;
    case 1: /* empty */
        ck_assert_int_eq(truncate(path, 0), 0);
        break;
    case 2: /* a bit turned */
        ck_assert_int_eq(fseek(file, size / 3, SEEK_SET), 0);
        int byte = fgetc(file);
        ck_assert_int_eq(fseek(file, size / 3, SEEK_SET), 0);
        ck_assert_int_ne(fputc(byte ^ 16, file), EOF);
        break;
    default: /* something else altogether */
        ck_assert_int_eq(fseek(file, 0, SEEK_SET), 0);
        ck_assert_int_gt(fputs("not a table", file), 0);
        break;
    }
    ck_assert_int_eq(fclose(file), 0);
}

START_TEST(a_damaged_file_is_set_aside_and_computed_again) {
    counting_fixture fixture = counting_begin(&counting_method, GRID);
    char path[160], aside[180];
    struct stat about;
    visit(&fixture, 0, 4);
    only_table(path);
    snprintf(aside, sizeof aside, "%s.damaged", path);
    change_file(path, _i);
    ck_assert_uint_eq(visit(&fixture, 0, 4), 4 * 5 + 2);
    ck_assert_int_eq(message_count, 1);
    ck_assert_str_eq(last_file, path);
    ck_assert_msg(strstr(last_message, "is set aside as '") != NULL, "%s", last_message);
    ck_assert_ptr_nonnull(strstr(last_message, strrchr(aside, '/') + 1));
    ck_assert_int_eq(stat(aside, &about), 0);
    ck_assert_uint_eq(visit(&fixture, 0, 4), 0);
    ck_assert_int_eq(message_count, 1);
    counting_end(&fixture);
}
END_TEST

START_TEST(a_table_of_another_name_is_set_aside) {
    counting_fixture fixture = counting_begin(&counting_method, GRID);
    char path[160], kept[200];
    visit(&fixture, 0, 4);
    only_table(path);
    snprintf(kept, sizeof kept, "%s.nc", directory);
    ck_assert_int_eq(rename(path, kept), 0);
    fixture.grid.el_count = 13;
    const srp_cache_params params = cache_params();
    srp_cache *cache = open_cache(&params);
    srp_demand_destroy(make_demand(&fixture, cache));
    srp_demand *demand = make_demand(&fixture, cache);
    const srp_demand_node pole = {0, 0};
    srp_error error;
    assert_ok(srp_demand_need(demand, 1, &pole, &error), error);
    srp_demand_destroy(demand);
    only_table(path);
    ck_assert_int_eq(rename(kept, path), 0);
    demand = make_demand(&fixture, cache);
    ck_assert_uint_eq(srp_demand_count(demand).ready, 0);
    ck_assert_int_eq(message_count, 1);
    ck_assert_msg(strstr(last_message, "the table's grid has 13 x 7 nodes") != NULL, "%s",
                  last_message);
    srp_demand_destroy(demand);
    srp_cache_close(cache);
    counting_end(&fixture);
}
END_TEST

START_TEST(a_directory_that_cannot_be_used_costs_one_message) {
    counting_fixture fixture = counting_begin(&counting_method, GRID);
    /* A file where a directory should be stops root as well. */
    char top[64];
    snprintf(top, sizeof top, "%.*s", (int)strcspn(directory, "/"), directory);
    ck_assert_int_eq(mkdir(top, 0700), 0);
    char file[80];
    snprintf(file, sizeof file, "%s/a", top);
    FILE *plain = fopen(file, "w");
    ck_assert_int_eq(fclose(plain), 0);
    srp_cache_params params = cache_params();
    params.flush_nodes = 1;
    srp_cache *cache = open_cache(&params);
    srp_demand *demand = make_demand(&fixture, cache);
    need_columns(demand, 0, 13);
    assert_is_full(&fixture, demand);
    srp_error error;
    ck_assert_int_eq(srp_demand_flush(demand, &error), SRP_IO);
    srp_demand_destroy(demand);
    ck_assert_int_eq(message_count, 1);
    ck_assert_ptr_nonnull(strstr(last_message, "is not kept from here on"));
    ck_assert_ptr_nonnull(strstr(last_message, "Not a directory"));
    srp_cache_close(cache);
    counting_end(&fixture);
}
END_TEST

START_TEST(a_full_disk_costs_one_message) {
    counting_fixture fixture = counting_begin(&counting_method, GRID);
    visit(&fixture, 0, 2);
    srp_cache_params params = cache_params();
    params.flush_nodes = 1;
    srp_cache *cache = open_cache(&params);
    srp_demand *demand = make_demand(&fixture, cache);
    /* As a full disk does, this ends write() with an error. */
    const struct rlimit little = {1000, RLIM_INFINITY}, any = {RLIM_INFINITY, RLIM_INFINITY};
    signal(SIGXFSZ, SIG_IGN);
    ck_assert_int_eq(setrlimit(RLIMIT_FSIZE, &little), 0);
    /* libcheck keeps notes in a file, too: not a word to it before the limit is gone. */
    srp_status worst = SRP_OK;
    for (uint32_t k = 0; k < GRID.az_count * GRID.el_count; ++k) {
        const srp_demand_node node = {k / GRID.el_count, k % GRID.el_count};
        srp_error error;
        srp_status status = srp_demand_need(demand, 1, &node, &error);
        worst = status != SRP_OK ? status : worst;
    }
    ck_assert_int_eq(setrlimit(RLIMIT_FSIZE, &any), 0);
    ck_assert_int_eq(worst, SRP_OK);
    assert_is_full(&fixture, demand);
    srp_demand_destroy(demand);
    ck_assert_int_eq(message_count, 1);
    ck_assert_msg(strstr(last_message, "cannot write: ") != NULL, "%s", last_message);
    srp_cache_close(cache);
    /* What was there is there. */
    ck_assert_uint_eq(visit(&fixture, 0, 2), 0);
    counting_end(&fixture);
}
END_TEST

START_TEST(a_cache_in_use_is_passed_by) {
    counting_fixture fixture = counting_begin(&counting_method, GRID);
    visit(&fixture, 0, 2);
    srp_cache_params params = cache_params();
    params.wait_seconds = 0.05;
    params.flush_nodes = 1;
    srp_cache *cache = open_cache(&params);
    srp_demand *demand = make_demand(&fixture, cache);
    char path[160];
    int lock = -1;
    srp_error error;
    snprintf(path, sizeof path, "%s/lock", directory);
    assert_ok(srp_platform_lock_file(path, 0.0, &lock, &error), error);
    ck_assert_int_ge(lock, 0);
    need_columns(demand, 2, 6);
    ck_assert_int_eq(message_count, 0);
    ck_assert_int_eq(srp_demand_flush(demand, &error), SRP_IO);
    ck_assert_ptr_nonnull(strstr(error.message, "has locked the cache for more than 0.05 s"));
    srp_platform_unlock_file(lock);
    srp_demand_destroy(demand);
    ck_assert_uint_eq(visit(&fixture, 0, 6), 0);
    ck_assert_int_eq(message_count, 0);
    srp_cache_close(cache);
    counting_end(&fixture);
}
END_TEST

/* ---- Its size, and what is in it ------------------------------------------------------------ */

/* One table per seed; a stays below the limit by losing what was not used for longest. */
START_TEST(it_stays_below_its_limit) {
    counting_fixture fixture = counting_begin(&counting_method, GRID);
    srp_cache_params params = cache_params();
    srp_cache *cache = open_cache(&params);
    srp_cache_entry *entries = NULL;
    size_t count = 0;
    srp_error error;
    for (uint64_t seed = 0; seed < 5; ++seed) {
        srp_method_params how = srp_method_params_default();
        counting_fixture other = fixture;
        how.seed = seed;
        assert_ok(
            srp_method_prepare(&counting_method, fixture.scene, &how, &other.prepared, &error),
            error);
        srp_demand *demand = make_demand(&other, cache);
        need_columns(demand, 0, 2);
        srp_demand_destroy(demand);
        srp_prepared_release(other.prepared);
        usleep(20000);
        if (seed == 2) { /* the first is used again, and room is left for three and a half */
            ck_assert_uint_eq(visit(&fixture, 0, 2), 0);
            usleep(20000);
            assert_ok(srp_cache_list(cache, &entries, &count, &error), error);
            ck_assert_uint_eq(count, 3);
            params.size_max = entries[0].size * 7 / 2;
            srp_cache_entries_free(entries);
            srp_cache_close(cache);
            cache = open_cache(&params);
        }
    }
    assert_ok(srp_cache_list(cache, &entries, &count, &error), error);
    ck_assert_uint_eq(count, 3);
    ck_assert(entries[0].used >= entries[1].used && entries[1].used >= entries[2].used);
    ck_assert(entries[0].size > 1000 && !entries[0].is_damaged);
    srp_cache_entries_free(entries);
    /* Seeds 0, 3 and 4 are left: first 1 went, then 2. */
    ck_assert_uint_eq(visit(&fixture, 0, 2), 0);
    srp_cache_close(cache);
    counting_end(&fixture);
}
END_TEST

START_TEST(clearing_removes_tables_and_nothing_else) {
    counting_fixture fixture = counting_begin(&counting_method, GRID);
    srp_cache_params params = cache_params();
    srp_cache *cache = open_cache(&params);
    char path[160], foreign[160], draft[180];
    size_t removed = 77, count = 77;
    srp_cache_entry *entries = NULL;
    srp_error error;
    assert_ok(srp_cache_list(cache, &entries, &count, &error), error);
    ck_assert_uint_eq(count, 0);
    visit(&fixture, 0, 2);
    only_table(path);
    change_file(path, 0);
    visit(&fixture, 0, 2);
    snprintf(foreign, sizeof foreign, "%s/notes.nc", directory);
    snprintf(draft, sizeof draft, "%s.4711.tmp", path);
    ck_assert_int_eq(fclose(fopen(foreign, "w")), 0);
    ck_assert_int_eq(fclose(fopen(draft, "w")), 0);
    assert_ok(srp_cache_clear(cache, &removed, &error), error);
    ck_assert_uint_eq(removed, 2);
    ck_assert_int_eq(access(foreign, F_OK), 0);
    ck_assert_int_ne(access(draft, F_OK), 0);
    ck_assert_int_ne(access(path, F_OK), 0);
    assert_ok(srp_cache_clear(cache, &removed, &error), error);
    ck_assert_uint_eq(removed, 0);
    srp_cache_close(cache);
    counting_end(&fixture);
}
END_TEST

START_TEST(the_directory_is_that_of_the_user) {
    srp_cache_params params = srp_cache_params_default();
    srp_cache *cache = NULL;
    srp_error error;
    setenv("XDG_CACHE_HOME", "/tmp/elsewhere", 1);
    setenv("HOME", "/home/someone", 1);
    cache = open_cache(&params);
    ck_assert_str_eq(srp_cache_directory(cache), "/tmp/elsewhere/srpcore");
    srp_cache_close(cache);
    setenv("XDG_CACHE_HOME", "relative", 1);
    cache = open_cache(&params);
    ck_assert_str_eq(srp_cache_directory(cache), "/home/someone/.cache/srpcore");
    srp_cache_close(cache);
    unsetenv("XDG_CACHE_HOME");
    unsetenv("HOME");
    ck_assert_int_eq(srp_cache_open(&params, NULL, &cache, &error), SRP_NOT_FOUND);
    ck_assert_ptr_nonnull(strstr(error.message, "neither XDG_CACHE_HOME nor HOME"));
    params.directory = "";
    ck_assert_int_eq(srp_cache_open(&params, NULL, &cache, &error), SRP_BAD_ARGUMENT);
    params.directory = "x";
    params.flush_nodes = 0;
    ck_assert_int_eq(srp_cache_open(&params, NULL, &cache, &error), SRP_BAD_ARGUMENT);
    params.flush_nodes = 1;
    params.wait_seconds = NAN;
    ck_assert_int_eq(srp_cache_open(&params, NULL, &cache, &error), SRP_BAD_ARGUMENT);
    srp_cache_close(NULL);
}
END_TEST

/* ---- Threads ---- */

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
    ck_assert_int_eq(message_count, 0);
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
    srp_table *before = committed(&fixture);
    int *times = calloc(srp_grid_node_count(grid), sizeof *times);
    uint64_t state = (uint64_t)getpid();
    int drafts = 0;
    srp_error error;
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
    ck_assert_int_eq(message_count, 0);
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
    Suite *suite = suite_create("cache");
    TCase *tcase = tcase_create("cache");
    tcase_add_checked_fixture(tcase, set_up, tear_down);
    tcase_add_test(tcase, nodes_are_remembered);
    tcase_add_test(tcase, two_tables_of_one_cache_lose_nothing);
    tcase_add_test(tcase, it_is_written_when_enough_is_new);
    tcase_add_test(tcase, other_tables_have_other_files);
    tcase_add_test(tcase, whole_tables_can_be_exchanged);
    tcase_add_loop_test(tcase, a_damaged_file_is_set_aside_and_computed_again, 0, 4);
    tcase_add_test(tcase, a_table_of_another_name_is_set_aside);
    tcase_add_test(tcase, a_directory_that_cannot_be_used_costs_one_message);
    tcase_add_test(tcase, a_full_disk_costs_one_message);
    tcase_add_test(tcase, a_cache_in_use_is_passed_by);
    tcase_add_test(tcase, it_stays_below_its_limit);
    tcase_add_test(tcase, clearing_removes_tables_and_nothing_else);
    tcase_add_test(tcase, the_directory_is_that_of_the_user);
    tcase_add_test(tcase, threads_share_a_cache);
    tcase_add_test(tcase, whoever_is_killed_leaves_a_cache_that_others_complete);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
