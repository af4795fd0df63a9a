/* SPDX-License-Identifier: Apache-2.0 */
/* What the tests of the cache share: a directory of its own for each test, tables in it. */
#ifndef CACHE_FIXTURE_H
#define CACHE_FIXTURE_H

#include "cache_internal.h"
#include "demand_fixture.h"

enum { UNIQUE = 12 * 5 + 2 }; /* directions of CACHE_GRID */
extern const srp_grid CACHE_GRID;

/* Of the test: the cache's directory, what the caches of open_cache() said last, and how often. */
typedef struct cache_state {
    char directory[64], last_file[600], last_message[800];
    int messages;
} cache_state;
extern cache_state cache_test;

/* Before and after each test. */
void cache_begin(void);
void cache_end(void);

srp_cache_params cache_params(void);
srp_cache *open_cache(const srp_cache_params *params);

/* Name of the only table of the cache. */
void only_table(char path[160]);

/* Opens a table on demand, asks for columns, and closes it; how many directions were computed. */
size_t visit(const counting_fixture *fixture, uint32_t begin, uint32_t end);

#endif
