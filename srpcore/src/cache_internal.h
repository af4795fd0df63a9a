/* SPDX-License-Identifier: Apache-2.0 */
/* Internal. */
#ifndef SRP_SRC_CACHE_INTERNAL_H
#define SRP_SRC_CACHE_INTERNAL_H

#include <srp/cache.h>

#include <stdbool.h>
#include <stddef.h>

/* A table of `prepared` to be brought together with what the cache holds of it. */
typedef struct srp_cache_job {
    const srp_prepared *prepared;
    srp_grid grid;
    bool with_basis;
    bool wait; /* for the lock, as long as the cache's parameters say; else a cache in use is left
                  alone, which is no failure */
    bool looks_anyway; /* takes nodes where there is no lock to be had, before it fails */
    /* Called at most once, with what the cache holds: gives nodes to `kept`, takes nodes from it,
     * and returns how many `kept` has gained. It is written if any, under the lock. */
    size_t (*join)(void *user, srp_table *kept);
    void *user;
} srp_cache_job;

srp_status srp_cache_run(srp_cache *cache, const srp_cache_job *job, srp_error *error);

/* Says that the cache is not used any more, and why. */
void srp_cache_warn(const srp_cache *cache, const srp_error *why);

const srp_cache_params *srp_cache_get_params(const srp_cache *cache);

#endif
