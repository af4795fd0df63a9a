/* SPDX-License-Identifier: Apache-2.0 */
/* The cache on disk: kept, merged, damaged, full. */
#define _DEFAULT_SOURCE /* usleep */

#include "cache_fixture.h"
#include "platform.h"
#include "srp_check.h"
#include "table_internal.h"

#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- Remembering ---------------------------------------------------------------------------- */

START_TEST(nodes_are_remembered) {
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
    ck_assert_uint_eq(visit(&fixture, 0, 3), 3 * 5 + 2);
    ck_assert_uint_eq(visit(&fixture, 0, 3), 0);
    ck_assert_uint_eq(visit(&fixture, 2, 5), 2 * 5);
    ck_assert_uint_eq(visit(&fixture, 0, 13), UNIQUE - 5 * 5 - 2);
    ck_assert_uint_eq(visit(&fixture, 0, 13), 0);
    ck_assert_int_eq(cache_test.messages, 0);
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
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
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

/* What has no time for the cache leaves it alone until it is destroyed. */
START_TEST(it_is_not_written_where_that_takes_too_long) {
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
    for (int k = 0; k < 2; ++k) {
        srp_cache_params params = cache_params();
        params.flush_nodes = 1;
        params.flush_share = k == 0 ? 0.0 : INFINITY;
        srp_cache *cache = open_cache(&params);
        uint32_t column = (uint32_t)(2 * k);
        srp_demand *a = make_demand(&fixture, cache);
        size_t before = srp_demand_count(a).ready;
        need_columns(a, column, column + 2);
        srp_demand *b = make_demand(&fixture, cache);
        size_t after = srp_demand_count(b).ready;
        ck_assert(k == 0 ? after == before : after > before);
        srp_demand_destroy(a);
        srp_demand_destroy(b);
        b = make_demand(&fixture, cache);
        ck_assert_uint_gt(srp_demand_count(b).ready, before);
        srp_demand_destroy(b);
        srp_cache_close(cache);
    }
    counting_end(&fixture);
}
END_TEST

START_TEST(it_is_written_when_enough_is_new) {
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
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
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
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
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
    srp_table *full = full_table(&fixture), *empty = NULL, *foreign = NULL;
    const srp_cache_params params = cache_params();
    srp_cache *cache = open_cache(&params);
    size_t found = 77;
    srp_error error;
    assert_ok(srp_cache_exchange(cache, fixture.prepared, full, &found, &error), error);
    ck_assert_uint_eq(found, 0);
    assert_ok(srp_table_create(fixture.prepared, CACHE_GRID, false, &empty, &error), error);
    assert_ok(srp_cache_exchange(cache, fixture.prepared, empty, &found, &error), error);
    ck_assert_uint_eq(found, UNIQUE);
    char wanted[33], got[33];
    srp_table_checksum(full, wanted);
    srp_table_checksum(empty, got);
    ck_assert_str_eq(got, wanted);
    assert_ok(srp_table_create_blank(CACHE_GRID, 0, false, &foreign, &error), error);
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
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
    char path[160], aside[180];
    struct stat about;
    visit(&fixture, 0, 4);
    only_table(path);
    snprintf(aside, sizeof aside, "%s.damaged", path);
    change_file(path, _i);
    ck_assert_uint_eq(visit(&fixture, 0, 4), 4 * 5 + 2);
    ck_assert_int_eq(cache_test.messages, 1);
    ck_assert_str_eq(cache_test.last_file, path);
    ck_assert_msg(strstr(cache_test.last_message, "is set aside as '") != NULL, "%s",
                  cache_test.last_message);
    ck_assert_ptr_nonnull(strstr(cache_test.last_message, strrchr(aside, '/') + 1));
    ck_assert_int_eq(stat(aside, &about), 0);
    ck_assert_uint_eq(visit(&fixture, 0, 4), 0);
    ck_assert_int_eq(cache_test.messages, 1);
    counting_end(&fixture);
}
END_TEST

START_TEST(a_table_of_another_name_is_set_aside) {
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
    char path[160], kept[200];
    visit(&fixture, 0, 4);
    only_table(path);
    snprintf(kept, sizeof kept, "%s.nc", cache_test.directory);
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
    ck_assert_int_eq(cache_test.messages, 1);
    ck_assert_msg(strstr(cache_test.last_message, "the table's grid has 13 x 7 nodes") != NULL,
                  "%s", cache_test.last_message);
    srp_demand_destroy(demand);
    srp_cache_close(cache);
    counting_end(&fixture);
}
END_TEST

static void assert_told_once_of_writing(void) {
    ck_assert_int_eq(cache_test.messages, 1);
    ck_assert_ptr_nonnull(strstr(cache_test.last_message, "is not kept until that is mended"));
}

START_TEST(a_directory_that_cannot_be_used_costs_one_message) {
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
    /* A file where a directory should be stops root as well. */
    char top[64];
    snprintf(top, sizeof top, "%.*s", (int)strcspn(cache_test.directory, "/"),
             cache_test.directory);
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
    assert_told_once_of_writing();
    ck_assert_ptr_nonnull(strstr(cache_test.last_message, "Not a directory"));
    srp_cache_close(cache);
    counting_end(&fixture);
}
END_TEST

START_TEST(a_full_disk_costs_one_message) {
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
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
    for (uint32_t k = 0; k < CACHE_GRID.az_count * CACHE_GRID.el_count; ++k) {
        const srp_demand_node node = {k / CACHE_GRID.el_count, k % CACHE_GRID.el_count};
        srp_error error;
        srp_status status = srp_demand_need(demand, 1, &node, &error);
        worst = status != SRP_OK ? status : worst;
    }
    ck_assert_int_eq(setrlimit(RLIMIT_FSIZE, &any), 0);
    ck_assert_int_eq(worst, SRP_OK);
    assert_is_full(&fixture, demand);
    srp_demand_destroy(demand);
    ck_assert_int_eq(cache_test.messages, 1);
    ck_assert_msg(strstr(cache_test.last_message, "cannot write: ") != NULL, "%s",
                  cache_test.last_message);
    srp_cache_close(cache);
    /* What was there is there. */
    ck_assert_uint_eq(visit(&fixture, 0, 2), 0);
    counting_end(&fixture);
}
END_TEST

/* As another program would; for srp_platform_unlock_file(). */
static int lock_cache(void) {
    char path[160];
    int lock = -1;
    srp_error error;
    snprintf(path, sizeof path, "%s/lock", cache_test.directory);
    assert_ok(srp_platform_lock_file(path, 0.0, &lock, &error), error);
    ck_assert_int_ge(lock, 0);
    return lock;
}

START_TEST(a_cache_in_use_is_passed_by) {
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
    visit(&fixture, 0, 2);
    srp_cache_params params = cache_params();
    params.wait_seconds = 0.05;
    params.flush_nodes = 1;
    srp_cache *cache = open_cache(&params);
    srp_demand *demand = make_demand(&fixture, cache);
    srp_error error;
    int lock = lock_cache();
    need_columns(demand, 2, 6);
    ck_assert_int_eq(cache_test.messages, 0);
    ck_assert_int_eq(srp_demand_flush(demand, &error), SRP_IO);
    ck_assert_ptr_nonnull(strstr(error.message, "has locked the cache for more than 0.05 s"));
    srp_platform_unlock_file(lock);
    srp_demand_destroy(demand);
    ck_assert_uint_eq(visit(&fixture, 0, 6), 0);
    ck_assert_int_eq(cache_test.messages, 0);
    srp_cache_close(cache);
    counting_end(&fixture);
}
END_TEST

/* A cache that could not be used for a while is used again. */
START_TEST(a_cache_that_is_free_again_is_used) {
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
    visit(&fixture, 0, 2);
    srp_cache_params params = cache_params();
    params.wait_seconds = 0.05;
    srp_cache *cache = open_cache(&params);
    int lock = lock_cache();
    srp_demand *demand = make_demand(&fixture, cache);
    ck_assert_int_eq(cache_test.messages, 1);
    ck_assert_ptr_nonnull(strstr(cache_test.last_message, "has locked the cache"));
    srp_platform_unlock_file(lock);
    need_columns(demand, 0, 6);
    srp_demand_destroy(demand);
    ck_assert_uint_eq(visit(&fixture, 0, 6), 0);
    ck_assert_int_eq(cache_test.messages, 1);
    srp_cache_close(cache);
    counting_end(&fixture);
}
END_TEST

/* A directory in the place of its lock stops root as well: nobody can write the cache. */
static void forbid_writing(void) {
    char path[160];
    snprintf(path, sizeof path, "%s/lock", cache_test.directory);
    ck_assert_int_eq(unlink(path), 0);
    ck_assert_int_eq(mkdir(path, 0700), 0);
}

START_TEST(a_cache_that_cannot_be_written_is_read) {
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
    visit(&fixture, 0, 3);
    forbid_writing();
    srp_cache_params params = cache_params();
    params.flush_nodes = 1;
    srp_cache *cache = open_cache(&params);
    srp_demand *demand = make_demand(&fixture, cache);
    ck_assert_uint_eq(srp_demand_count(demand).ready, 3 * 5 + 2);
    need_columns(demand, 0, 13);
    ck_assert_uint_eq(srp_demand_count(demand).computed, UNIQUE - 3 * 5 - 2);
    assert_is_full(&fixture, demand);
    srp_demand_destroy(demand);
    assert_told_once_of_writing();
    srp_cache_close(cache);
    counting_end(&fixture);
}
END_TEST

/* Nothing is missing, so that nothing is to be told. */
START_TEST(a_full_table_that_cannot_be_written_is_as_good) {
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
    visit(&fixture, 0, 13);
    forbid_writing();
    ck_assert_uint_eq(visit(&fixture, 0, 13), 0);
    ck_assert_int_eq(cache_test.messages, 0);
    counting_end(&fixture);
}
END_TEST

/* Damage there stays for those who may write, and shows in no number. */
START_TEST(a_damaged_file_that_cannot_be_written_is_passed_by) {
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
    visit(&fixture, 0, 13);
    forbid_writing();
    char path[160];
    only_table(path);
    FILE *file = fopen(path, "r+");
    ck_assert_int_eq(fseek(file, 400, SEEK_SET), 0);
    ck_assert_int_eq(fputc('x', file), 'x');
    ck_assert_int_eq(fclose(file), 0);
    ck_assert_uint_eq(visit(&fixture, 0, 13), UNIQUE);
    ck_assert_int_eq(cache_test.messages, 1);
    ck_assert_int_eq(access(path, F_OK), 0);
    counting_end(&fixture);
}
END_TEST

START_TEST(a_directory_without_permission_is_read) {
    if (geteuid() == 0) {
        printf("skipped: root may write any directory\n");
        return;
    }
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
    visit(&fixture, 0, 3);
    char path[160];
    snprintf(path, sizeof path, "%s/lock", cache_test.directory);
    ck_assert_int_eq(unlink(path), 0);
    ck_assert_int_eq(chmod(cache_test.directory, 0500), 0);
    ck_assert_uint_eq(visit(&fixture, 0, 13), UNIQUE - 3 * 5 - 2);
    ck_assert_int_eq(cache_test.messages, 1);
    ck_assert_int_eq(chmod(cache_test.directory, 0700), 0);
    counting_end(&fixture);
}
END_TEST

/* What a table holds is kept, what the cache holds is not taken. */
START_TEST(a_table_that_is_being_filled_can_be_kept) {
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
    visit(&fixture, 0, 3);
    const srp_cache_params params = cache_params();
    srp_cache *cache = open_cache(&params);
    srp_demand *demand = make_demand(&fixture, NULL);
    srp_table *part = NULL;
    srp_error error;
    need_columns(demand, 2, 6);
    assert_ok(srp_demand_copy(demand, &part, &error), error);
    size_t filled = srp_table_filled_count(part);
    assert_ok(srp_cache_keep(cache, fixture.prepared, part, &error), error);
    ck_assert_uint_eq(srp_table_filled_count(part), filled);
    ck_assert_uint_eq(visit(&fixture, 0, 6), 0);
    forbid_writing();
    ck_assert_int_eq(srp_cache_keep(cache, fixture.prepared, part, &error), SRP_IO);
    ck_assert_int_eq(cache_test.messages, 0);
    srp_table_destroy(part);
    srp_demand_destroy(demand);
    srp_cache_close(cache);
    counting_end(&fixture);
}
END_TEST

/* ---- Its size, and what is in it ------------------------------------------------------------ */

/* Whatever the limit, the table in use stays. */
START_TEST(a_table_above_the_limit_is_kept) {
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
    srp_cache_params params = cache_params();
    params.size_max = 1;
    srp_cache *cache = open_cache(&params);
    srp_demand *demand = make_demand(&fixture, cache);
    need_columns(demand, 0, 2);
    srp_demand_destroy(demand);
    ck_assert_uint_eq(visit(&fixture, 0, 2), 0);
    srp_cache_close(cache);
    counting_end(&fixture);
}
END_TEST

/* One table per seed; a stays below the limit by losing what was not used for longest. */
START_TEST(it_stays_below_its_limit) {
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
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
    counting_fixture fixture = counting_begin(&counting_method, CACHE_GRID);
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
    snprintf(foreign, sizeof foreign, "%s/notes.nc", cache_test.directory);
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
    params.flush_share = -1.0;
    ck_assert_int_eq(srp_cache_open(&params, NULL, &cache, &error), SRP_BAD_ARGUMENT);
    params.flush_share = 0.0;
    params.wait_seconds = NAN;
    ck_assert_int_eq(srp_cache_open(&params, NULL, &cache, &error), SRP_BAD_ARGUMENT);
    srp_cache_close(NULL);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("cache");
    TCase *tcase = tcase_create("cache");
    tcase_add_checked_fixture(tcase, cache_begin, cache_end);
    tcase_add_test(tcase, nodes_are_remembered);
    tcase_add_test(tcase, two_tables_of_one_cache_lose_nothing);
    tcase_add_test(tcase, it_is_written_when_enough_is_new);
    tcase_add_test(tcase, it_is_not_written_where_that_takes_too_long);
    tcase_add_test(tcase, other_tables_have_other_files);
    tcase_add_test(tcase, whole_tables_can_be_exchanged);
    tcase_add_loop_test(tcase, a_damaged_file_is_set_aside_and_computed_again, 0, 4);
    tcase_add_test(tcase, a_table_of_another_name_is_set_aside);
    tcase_add_test(tcase, a_directory_that_cannot_be_used_costs_one_message);
    tcase_add_test(tcase, a_full_disk_costs_one_message);
    tcase_add_test(tcase, a_cache_in_use_is_passed_by);
    tcase_add_test(tcase, a_cache_that_is_free_again_is_used);
    tcase_add_test(tcase, a_cache_that_cannot_be_written_is_read);
    tcase_add_test(tcase, a_full_table_that_cannot_be_written_is_as_good);
    tcase_add_test(tcase, a_damaged_file_that_cannot_be_written_is_passed_by);
    tcase_add_test(tcase, a_directory_without_permission_is_read);
    tcase_add_test(tcase, a_table_that_is_being_filled_can_be_kept);
    tcase_add_test(tcase, a_table_above_the_limit_is_kept);
    tcase_add_test(tcase, it_stays_below_its_limit);
    tcase_add_test(tcase, clearing_removes_tables_and_nothing_else);
    tcase_add_test(tcase, the_directory_is_that_of_the_user);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
