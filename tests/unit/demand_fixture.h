/* SPDX-License-Identifier: Apache-2.0 */
/* A method for tests of tables on demand: counts how often it answers each node. */
#ifndef DEMAND_FIXTURE_H
#define DEMAND_FIXTURE_H

#include <srp/demand.h>

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

/* Takes plates; smooth f and t of no symmetry, which depend on the direction alone. Safe in any
 * number of threads. */
extern const srp_method counting_method;
/* The same without moments. */
extern const srp_method forceless_method;

/* What the method does; zeroed by counting_begin(). */
typedef struct counting_state {
    srp_grid grid;        /* that answers are counted on */
    atomic_int *answered; /* by node, the first of its direction */
    atomic_long calls;
    long fail_every;    /* > 0: every n-th call fails with `failure` */
    srp_status failure; /* SRP_OK: answers NaN instead */
    long delay_us;      /* that a call takes at least */
} counting_state;
extern counting_state counting;

typedef struct counting_fixture {
    srp_scene *scene;
    srp_prepared *prepared;
    srp_grid grid;
} counting_fixture;

counting_fixture counting_begin(const srp_method *method, srp_grid grid);
void counting_end(counting_fixture *fixture);

/* Index of a node in counting.answered. */
size_t counting_index(srp_demand_node node);
/* Nodes that were answered, and the most that one was. */
size_t counting_nodes(void);
int counting_most(void);

srp_demand *make_demand(const counting_fixture *fixture, srp_cache *cache);
/* The full table. */
srp_table *full_table(const counting_fixture *fixture);
/* Asks for all nodes of columns [begin, end). */
void need_columns(srp_demand *demand, uint32_t begin, uint32_t end);
/* All nodes of a complete table, and what it says of itself, are those of the full one. */
void assert_is_full(const counting_fixture *fixture, const srp_demand *demand);

#endif
