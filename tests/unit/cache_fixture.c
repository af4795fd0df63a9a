/* SPDX-License-Identifier: Apache-2.0 */
#include "cache_fixture.h"

#include "srp_check.h"

#include <string.h>
#include <unistd.h>

const srp_grid CACHE_GRID = {13, 7};
cache_state cache_test;

static void keep_message(void *user, const srp_error *what) {
    (void)user;
    ++cache_test.messages;
    snprintf(cache_test.last_file, sizeof cache_test.last_file, "%s", what->file);
    snprintf(cache_test.last_message, sizeof cache_test.last_message, "%s", what->message);
}

srp_cache *open_cache(const srp_cache_params *params) {
    const srp_log log = {keep_message, NULL};
    srp_cache *cache = NULL;
    srp_error error;
    assert_ok(srp_cache_open(params, &log, &cache, &error), error);
    return cache;
}

srp_cache_params cache_params(void) {
    srp_cache_params params = srp_cache_params_default();
    params.flush_share = INFINITY; /* whatever it takes */
    params.directory = cache_test.directory;
    return params;
}

void cache_begin(void) {
    snprintf(cache_test.directory, sizeof cache_test.directory, "test_cache.%ld/a/b",
             (long)getpid());
    cache_test.messages = 0;
}

void cache_end(void) {
    char command[128];
    cache_test.directory[strcspn(cache_test.directory, "/")] = '\0';
    snprintf(command, sizeof command, "rm -rf '%s'", cache_test.directory);
    ck_assert_int_eq(system(command), 0);
}

void only_table(char path[160]) {
    const srp_cache_params params = cache_params();
    srp_cache *cache = open_cache(&params);
    srp_cache_entry *entries = NULL;
    size_t count = 0, tables = 0;
    srp_error error;
    assert_ok(srp_cache_list(cache, &entries, &count, &error), error);
    for (size_t k = 0; k < count; ++k) {
        if (!entries[k].is_damaged) {
            snprintf(path, 160, "%s/%s", cache_test.directory, entries[k].name);
            ++tables;
        }
    }
    ck_assert_uint_eq(tables, 1);
    srp_cache_entries_free(entries);
    srp_cache_close(cache);
}

size_t visit(const counting_fixture *fixture, uint32_t begin, uint32_t end) {
    const srp_cache_params params = cache_params();
    srp_cache *cache = open_cache(&params);
    srp_demand *demand = make_demand(fixture, cache);
    need_columns(demand, begin, end);
    size_t computed = srp_demand_count(demand).computed;
    if (end == CACHE_GRID.az_count) {
        assert_is_full(fixture, demand);
    }
    srp_demand_destroy(demand);
    srp_cache_close(cache);
    return computed;
}
