/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Tables that fill themselves: a node is computed when it is first needed, by any method, and kept.
 * An orbit visits few of the nodes of a fine grid; nobody has to wait for the others.
 *
 *     srp_demand *demand;
 *     srp_interp *interp;
 *     status = srp_demand_create(prepared, grid, NULL, &demand, &error);
 *     status = srp_interp_create_on_demand(&srp_interp_bicubic, demand, &interp, &error);
 *     status = srp_interp_eval(interp, s_body, &f, &t, &jacobian, &error);
 *     srp_interp_destroy(interp);
 *     srp_demand_destroy(demand);
 *
 * The numbers are those of the full table, to the bit, whatever is asked for, in which order and by
 * how many threads. With a cache (srp/cache.h) nodes outlive the program.
 */
#ifndef SRP_DEMAND_H
#define SRP_DEMAND_H

#include <srp/cache.h>
#include <srp/interp.h>
#include <srp/method.h>
#include <srp/status.h>
#include <srp/table.h>

#include <stddef.h>
#include <stdint.h>

SRP_BEGIN_DECLS

typedef struct srp_demand srp_demand;

/* A node of the grid. */
typedef struct srp_demand_node {
    uint32_t i, j; /* azimuth, elevation; below az_count and el_count of the grid */
} srp_demand_node;

/* Directions, of which the seam and the poles have one for several nodes. */
typedef struct srp_demand_counts {
    size_t total;    /* of the grid */
    size_t ready;    /* known: computed here, or found in the cache */
    size_t computed; /* here */
    size_t batches;  /* calls of the method that answered */
} srp_demand_counts;

/*
 * An empty table for `prepared`, which must outlive it, or what `cache` holds of it.
 *   cache  NULL: nothing is kept. Else it must outlive the table, too. What goes wrong with it is
 *          said through its log and stops nobody
 * SRP_BAD_ARGUMENT (grid), SRP_NO_MEMORY. Ownership: *out is the caller's.
 */
SRP_API SRP_CHECK srp_status srp_demand_create(const srp_prepared *prepared, srp_grid grid,
                                               srp_cache *cache, srp_demand **out,
                                               srp_error *error);
/* Writes what is new to the cache, if there is one. After all interpolants of it. */
SRP_API void srp_demand_destroy(srp_demand *demand);

/*
 * Sees to it that `count` nodes are known. Those that nobody knows are computed in one batch of the
 * method (in batches of at most 4096); those that another thread has in work are waited for. When
 * all are known, nothing is allocated and nobody is waited for. SRP_BAD_ARGUMENT (a node outside
 * the grid), SRP_NO_MEMORY, or what the method says: the nodes of that batch stay empty, and may be
 * asked for again. Any number of threads at once.
 */
SRP_API SRP_CHECK srp_status srp_demand_need(srp_demand *demand, size_t count,
                                             const srp_demand_node *nodes, srp_error *error);

/* The response of a node, NULL while it is not known and for what is no node of the grid; owned by
 * the table. Any thread; never waits. */
SRP_API const srp_response *srp_demand_get(const srp_demand *demand, srp_demand_node node);

SRP_API srp_grid srp_demand_grid(const srp_demand *demand);
SRP_API srp_demand_counts srp_demand_count(const srp_demand *demand);

/* A table of what is known now, the caller's own: to be written to a file, completed by
 * srp_table_fill(), or given to any interpolant if it is complete. SRP_NO_MEMORY. Any thread. */
SRP_API SRP_CHECK srp_status srp_demand_copy(const srp_demand *demand, srp_table **out,
                                             srp_error *error);

/* Writes what is new to the cache now, and takes from it what others have put there. SRP_OK when
 * there is no cache. SRP_IO, SRP_NO_MEMORY. Any thread. */
SRP_API SRP_CHECK srp_status srp_demand_flush(srp_demand *demand, srp_error *error);

/*
 * An interpolant of a table that fills itself, which must outlive it. `bilinear` and `bicubic`:
 * SRP_UNSUPPORTED for a scheme that needs all nodes at once (`spline`). The nodes that every
 * look-up needs (poles, those next to them that the slope there is fitted to, for bicubic the six
 * nearest to the axes) are asked for here, as one batch. Values and derivatives are, to the bit,
 * those of srp_interp_create() on the full table.
 * Besides what srp_demand_need() returns: SRP_BAD_ARGUMENT (steps too large for the scheme),
 * SRP_BAD_DATA (a node is not finite). srp_interp_eval() then returns these as well, when a look-up
 * needs nodes that cannot be had; asked again, it tries again.
 */
SRP_API SRP_CHECK srp_status srp_interp_create_on_demand(const srp_interp_scheme *scheme,
                                                         srp_demand *demand, srp_interp **out,
                                                         srp_error *error);

SRP_END_DECLS

#endif
