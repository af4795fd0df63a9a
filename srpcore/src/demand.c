/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Tables that fill themselves. Each direction of the grid is empty, in work by one thread, or
 * ready. Changes happen under the monitor, and the response is in place before the state says
 * "ready", so that whoever reads that needs no lock. A response is never changed after that.
 *
 * A thread first computes what it has claimed and waits for the others' afterwards: nobody waits
 * for a thread that waits.
 */
#include "cache_internal.h"
#include "error.h"
#include "platform.h"
#include "table_internal.h"

#include <srp/demand.h>

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum { NODE_EMPTY, NODE_BUSY, NODE_READY };

enum { BATCH_MAX = 4096 };

struct srp_demand {
    const srp_prepared *prepared;
    srp_cache *cache; /* may be NULL */
    srp_platform_monitor *monitor;
    _Atomic unsigned char *state; /* by node; that of the first of its direction counts */
    /* All below: under the monitor, but for the responses of nodes that are ready. */
    srp_table *table;
    srp_demand_counts counts;
    size_t unsaved;    /* nodes that the cache may lack */
    double saved;      /* when it was last written [s] */
    double cost;       /* how long that took [s] */
    bool is_saving;    /* by some thread */
    bool cache_failed; /* and that was said */
};

/* ---- Making and ending ---------------------------------------------------------------------- */

static unsigned char state_of(const srp_demand *demand, size_t index) {
    return atomic_load_explicit(&demand->state[index], memory_order_acquire);
}

static void set_state(srp_demand *demand, size_t index, unsigned char state) {
    atomic_store_explicit(&demand->state[index], state, memory_order_release);
}

/* Gives `kept` what we have, and takes what we lack. */
static size_t join(void *user, srp_table *kept) {
    srp_demand *demand = user;
    srp_table *ours = demand->table;
    srp_platform_monitor_enter(demand->monitor);
    size_t gained = srp_table_take(kept, ours);
    for (uint32_t i = 0; i < ours->grid.az_count; ++i) {
        for (uint32_t j = 0; j < ours->grid.el_count; ++j) {
            size_t index = srp_table_index(ours, i, j);
            if (srp_table_first_index(ours, i, j) == index && kept->filled[index] &&
                state_of(demand, index) == NODE_EMPTY) {
                srp_table_put_node(ours, index, &kept->nodes[index], NULL);
                srp_table_share_node(ours, index);
                set_state(demand, index, NODE_READY);
                ++demand->counts.ready;
            }
        }
    }
    demand->unsaved = 0;
    srp_platform_monitor_leave(demand->monitor);
    return gained;
}

/* Exchanges nodes with the cache; a cache that is in use is passed by unless we `wait`. */
static srp_status exchange(srp_demand *demand, bool wait, srp_error *error) {
    /* Whoever knows nothing yet takes what can be read of a cache that cannot be written. */
    const bool looks = srp_demand_count(demand).ready == 0;
    srp_cache_job job = {demand->prepared, demand->table->grid, false, wait, looks, join, demand};
    double began = srp_platform_seconds();
    srp_status status = srp_cache_run(demand->cache, &job, error);
    srp_platform_monitor_enter(demand->monitor);
    demand->saved = srp_platform_seconds();
    demand->cost = demand->saved - began;
    if (status == SRP_OK) {
        demand->cache_failed = false;
    } else {
        demand->unsaved += demand->counts.computed > 0; /* so that it can be tried again */
    }
    srp_platform_monitor_leave(demand->monitor);
    return status;
}

/* The same where nobody can be told but the log: of one failure after the other, the first. */
static void exchange_or_warn(srp_demand *demand, bool wait) {
    srp_error error;
    if (exchange(demand, wait, &error) == SRP_OK) {
        return;
    }
    srp_platform_monitor_enter(demand->monitor);
    bool first = !demand->cache_failed;
    demand->cache_failed = true;
    srp_platform_monitor_leave(demand->monitor);
    if (first) {
        srp_cache_warn(demand->cache, &error);
    }
}

srp_status srp_demand_create(const srp_prepared *prepared, srp_grid grid, srp_cache *cache,
                             srp_demand **out, srp_error *error) {
    srp_table *table;
    srp_status status = srp_table_create(prepared, grid, false, &table, error);
    if (status != SRP_OK) {
        return status;
    }
    srp_demand *demand = calloc(1, sizeof *demand);
    if (demand != NULL) {
        demand->monitor = srp_platform_monitor_create();
        demand->state = calloc(srp_grid_node_count(grid), sizeof *demand->state);
    }
    if (demand == NULL || demand->monitor == NULL || demand->state == NULL) {
        if (demand != NULL) {
            srp_platform_monitor_destroy(demand->monitor);
            free(demand->state);
            free(demand);
        }
        srp_table_destroy(table);
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a table of %zu nodes on demand",
                        srp_grid_node_count(grid));
    }
    demand->prepared = prepared;
    demand->table = table;
    demand->counts.total = srp_table_unique_count(grid);
    demand->saved = srp_platform_seconds();
    demand->cache = cache;
    if (cache != NULL) {
        exchange_or_warn(demand, true);
    }
    *out = demand;
    return SRP_OK;
}

void srp_demand_destroy(srp_demand *demand) {
    if (demand == NULL) {
        return;
    }
    if (demand->cache != NULL && demand->unsaved > 0) {
        exchange_or_warn(demand, true);
    }
    srp_platform_monitor_destroy(demand->monitor);
    srp_table_destroy(demand->table);
    free(demand->state);
    free(demand);
}

/* ---- Asking for nodes ----------------------------------------------------------------------- */

typedef struct batch {
    size_t capacity, count;
    size_t *index;
    srp_vec3 *directions;
    srp_response *responses;
} batch;

static void batch_end(batch *work) {
    free(work->index);
    free(work->directions);
    free(work->responses);
}

static srp_status batch_begin(batch *work, size_t wanted, srp_error *error) {
    work->count = 0;
    work->capacity = wanted < BATCH_MAX ? wanted : BATCH_MAX;
    work->index = malloc(work->capacity * sizeof *work->index);
    work->directions = malloc(work->capacity * sizeof *work->directions);
    work->responses = malloc(work->capacity * sizeof *work->responses);
    if (work->index == NULL || work->directions == NULL || work->responses == NULL) {
        batch_end(work);
        return srp_fail(error, SRP_NO_MEMORY, "no memory to compute %zu nodes", work->capacity);
    }
    return SRP_OK;
}

static size_t first_index(const srp_demand *demand, srp_demand_node node) {
    return srp_table_first_index(demand->table, node.i, node.j);
}

static bool all_ready(const srp_demand *demand, size_t count, const srp_demand_node *nodes) {
    for (size_t k = 0; k < count; ++k) {
        if (state_of(demand, first_index(demand, nodes[k])) != NODE_READY) {
            return false;
        }
    }
    return true;
}

/* Takes empty nodes into work, as many as there is room for. Under the monitor. */
static void claim(srp_demand *demand, size_t count, const srp_demand_node *nodes, batch *work) {
    work->count = 0;
    for (size_t k = 0; k < count && work->count < work->capacity; ++k) {
        size_t index = first_index(demand, nodes[k]);
        if (state_of(demand, index) == NODE_EMPTY) {
            set_state(demand, index, NODE_BUSY);
            work->index[work->count] = index;
            work->directions[work->count] =
                srp_grid_direction(demand->table->grid, nodes[k].i, nodes[k].j);
            ++work->count;
        }
    }
}

/* Answers what is in work, and says so to those who wait. */
static srp_status compute(srp_demand *demand, batch *work, srp_error *error) {
    srp_status status = srp_prepared_respond(demand->prepared, work->count, work->directions,
                                             work->responses, NULL, error);
    srp_platform_monitor_enter(demand->monitor);
    for (size_t k = 0; k < work->count; ++k) {
        size_t index = work->index[k];
        if (status == SRP_OK) {
            srp_table_put_node(demand->table, index, &work->responses[k], NULL);
            srp_table_share_node(demand->table, index);
        }
        set_state(demand, index, status == SRP_OK ? NODE_READY : NODE_EMPTY);
    }
    if (status == SRP_OK) {
        demand->counts.ready += work->count;
        demand->counts.computed += work->count;
        ++demand->counts.batches;
        demand->unsaved += work->count;
    }
    srp_platform_monitor_ring(demand->monitor);
    srp_platform_monitor_leave(demand->monitor);
    return status;
}

static void save_if_due(srp_demand *demand) {
    if (demand->cache == NULL) {
        return;
    }
    const srp_cache_params *params = srp_cache_get_params(demand->cache);
    srp_platform_monitor_enter(demand->monitor);
    /* After a failure not with every batch: the cache may be gone for long. */
    bool many = demand->unsaved >= params->flush_nodes && !demand->cache_failed;
    double since = srp_platform_seconds() - demand->saved;
    bool due = !demand->is_saving && demand->unsaved > 0 &&
               (many || since >= params->flush_seconds) &&
               demand->cost <= params->flush_share * since;
    demand->is_saving = demand->is_saving || due;
    srp_platform_monitor_leave(demand->monitor);
    if (due) {
        exchange_or_warn(demand, false);
        srp_platform_monitor_enter(demand->monitor);
        demand->is_saving = false;
        srp_platform_monitor_leave(demand->monitor);
    }
}

static srp_status check_nodes(const srp_demand *demand, size_t count, const srp_demand_node *nodes,
                              srp_error *error) {
    const srp_grid grid = demand->table->grid;
    for (size_t k = 0; k < count; ++k) {
        if (nodes[k].i >= grid.az_count || nodes[k].j >= grid.el_count) {
            return srp_fail(error, SRP_BAD_ARGUMENT, "node (%u, %u) of a grid of %u x %u nodes",
                            nodes[k].i, nodes[k].j, grid.az_count, grid.el_count);
        }
    }
    return SRP_OK;
}

srp_status srp_demand_need(srp_demand *demand, size_t count, const srp_demand_node *nodes,
                           srp_error *error) {
    srp_status status = check_nodes(demand, count, nodes, error);
    if (status != SRP_OK || all_ready(demand, count, nodes)) {
        return status;
    }
    batch work;
    status = batch_begin(&work, count, error);
    if (status != SRP_OK) {
        return status;
    }
    for (bool more = true; status == SRP_OK && more;) {
        srp_platform_monitor_enter(demand->monitor);
        claim(demand, count, nodes, &work);
        more = work.count > 0 || !all_ready(demand, count, nodes);
        if (more && work.count == 0) {
            srp_platform_monitor_wait(demand->monitor);
        }
        srp_platform_monitor_leave(demand->monitor);
        if (work.count > 0) {
            status = compute(demand, &work, error);
        }
    }
    batch_end(&work);
    save_if_due(demand);
    return status;
}

/* ---- Asking --------------------------------------------------------------------------------- */

const srp_response *srp_demand_get(const srp_demand *demand, srp_demand_node node) {
    const srp_grid grid = demand->table->grid;
    if (node.i >= grid.az_count || node.j >= grid.el_count) {
        return NULL;
    }
    size_t index = first_index(demand, node);
    return state_of(demand, index) == NODE_READY ? &demand->table->nodes[index] : NULL;
}

srp_grid srp_demand_grid(const srp_demand *demand) {
    return demand->table->grid;
}

srp_demand_counts srp_demand_count(const srp_demand *demand) {
    srp_platform_monitor_enter(demand->monitor);
    srp_demand_counts counts = demand->counts;
    srp_platform_monitor_leave(demand->monitor);
    return counts;
}

srp_status srp_demand_copy(const srp_demand *demand, srp_table **out, srp_error *error) {
    srp_table *table;
    srp_status status =
        srp_table_create(demand->prepared, demand->table->grid, false, &table, error);
    if (status != SRP_OK) {
        return status;
    }
    srp_platform_monitor_enter(demand->monitor);
    (void)srp_table_take(table, demand->table);
    srp_platform_monitor_leave(demand->monitor);
    *out = table;
    return SRP_OK;
}

srp_status srp_demand_flush(srp_demand *demand, srp_error *error) {
    return demand->cache != NULL ? exchange(demand, true, error) : SRP_OK;
}
