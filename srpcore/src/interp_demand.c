/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Interpolants of tables that fill themselves. Each look-up first sees whether its cell is ready:
 * one byte per cell, set when all nodes that the cell needs are in place. Until then nodes are
 * asked for, and put in place under a lock, each once; what is in place is never written again, so
 * that look-ups in cells that are ready need no lock.
 */
#include "error.h"
#include "interp_locate.h"
#include "platform.h"

#include <srp/demand.h>

#include <stdatomic.h>
#include <stdlib.h>

struct srp_interp_supply {
    srp_demand *demand;
    srp_interp *interp;                /* whose supply this is */
    _Atomic unsigned char *cell_ready; /* (columns, rows) */
    srp_platform_monitor *monitor;
    unsigned char *placed; /* (columns, rows + 1), under the monitor */
};

/* Of a cell with the nodes around it. */
enum { CELL_SIDE_MAX = 4, CELL_NODES_MAX = CELL_SIDE_MAX * CELL_SIDE_MAX };

static size_t place_index(const srp_interp *interp, srp_demand_node node) {
    return (size_t)node.i * (interp->rows + 1) + node.j;
}

/* The nodes that cell (i, j) needs; those beyond a pole follow from others. Returns how many. */
static size_t nodes_of_cell(const srp_interp *interp, uint32_t i, uint32_t j,
                            srp_demand_node nodes[CELL_NODES_MAX]) {
    const long reach = (long)interp->scheme->reach, n = (long)interp->columns;
    size_t count = 0;
    for (long a = -reach; a <= 1 + reach; ++a) {
        for (long b = -reach; b <= 1 + reach; ++b) {
            long row = (long)j + b;
            if (row >= 0 && row <= (long)interp->rows) {
                srp_demand_node node = {(uint32_t)(((long)i + a + n) % n), (uint32_t)row};
                nodes[count++] = node;
            }
        }
    }
    return count;
}

/* Copies nodes that are known to their places. */
static srp_status place_nodes(srp_interp_supply *supply, size_t count, const srp_demand_node *nodes,
                              srp_error *error) {
    srp_status status = SRP_OK;
    for (size_t k = 0; k < count && status == SRP_OK; ++k) {
        unsigned char *placed = &supply->placed[place_index(supply->interp, nodes[k])];
        if (!*placed) {
            status =
                srp_interp_put_node(supply->interp, srp_demand_grid(supply->demand), nodes[k].i,
                                    nodes[k].j, srp_demand_get(supply->demand, nodes[k]), error);
            *placed = status == SRP_OK;
        }
    }
    return status;
}

static srp_status supply_cell(srp_interp_supply *supply, uint32_t i, uint32_t j, size_t cell,
                              srp_error *error) {
    srp_demand_node nodes[CELL_NODES_MAX];
    size_t count = nodes_of_cell(supply->interp, i, j, nodes);
    srp_status status = srp_demand_need(supply->demand, count, nodes, error);
    if (status != SRP_OK) {
        return status;
    }
    srp_platform_monitor_enter(supply->monitor);
    status = place_nodes(supply, count, nodes, error);
    srp_platform_monitor_leave(supply->monitor);
    if (status == SRP_OK) {
        atomic_store_explicit(&supply->cell_ready[cell], 1, memory_order_release);
    }
    return status;
}

srp_status srp_interp_supply_at(const srp_interp *interp, const srp_vec3 *s, srp_error *error) {
    srp_interp_supply *supply = interp->supply;
    srp_interp_place place;
    if (!srp_interp_locate(interp, s, &place)) {
        return SRP_OK;
    }
    size_t cell = (size_t)place.i * interp->rows + place.j;
    if (atomic_load_explicit(&supply->cell_ready[cell], memory_order_acquire)) {
        return SRP_OK;
    }
    return supply_cell(supply, place.i, place.j, cell, error);
}

/* ---- Making and ending ---------------------------------------------------------------------- */

void srp_interp_supply_destroy(srp_interp_supply *supply) {
    if (supply != NULL) {
        srp_platform_monitor_destroy(supply->monitor);
        free(supply->cell_ready);
        free(supply->placed);
        free(supply);
    }
}

static srp_interp_supply *create_supply(srp_interp *interp, srp_demand *demand) {
    srp_interp_supply *supply = calloc(1, sizeof *supply);
    if (supply == NULL) {
        return NULL;
    }
    const size_t columns = interp->columns, rows = interp->rows;
    supply->demand = demand;
    supply->interp = interp;
    supply->monitor = srp_platform_monitor_create();
    supply->cell_ready = calloc(columns * rows, sizeof *supply->cell_ready);
    supply->placed = calloc(columns * (rows + 1), sizeof *supply->placed);
    if (supply->monitor == NULL || supply->cell_ready == NULL || supply->placed == NULL) {
        srp_interp_supply_destroy(supply);
        return NULL;
    }
    return supply;
}

/* What every look-up may need; `grid` alone decides it. */
static srp_status need_first_nodes(const srp_interp_scheme *scheme, srp_demand *demand,
                                   srp_error *error) {
    const srp_grid grid = srp_demand_grid(demand);
    /* Only the numbers of steps are asked of this one. */
    const srp_interp shape = {.columns = grid.az_count - 1, .rows = grid.el_count - 1};
    const uint32_t slopes = srp_interp_slope_nodes(&shape);
    srp_demand_node *nodes = malloc((8 + 2 * (size_t)slopes) * sizeof *nodes);
    if (nodes == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for an interpolant on demand");
    }
    size_t count = 0;
    nodes[count++] = (srp_demand_node){0, 0};
    nodes[count++] = (srp_demand_node){0, shape.rows};
    if (scheme->capabilities & SRP_INTERP_LINEAR) {
        uint32_t at[6][2];
        srp_interp_axis_nodes(&shape, at);
        for (int k = 0; k < 6; ++k) {
            nodes[count++] = (srp_demand_node){at[k][0], at[k][1]};
        }
    }
    for (uint32_t k = 0; k < slopes; ++k) {
        const uint32_t i = k * (shape.columns / slopes);
        nodes[count++] = (srp_demand_node){i, 1};
        nodes[count++] = (srp_demand_node){i, shape.rows - 1};
    }
    srp_status status = srp_demand_need(demand, count, nodes, error);
    free(nodes);
    return status;
}

/* An interpolant with all that is known by now. */
static srp_status create_with(const srp_interp_scheme *scheme, srp_demand *demand,
                              const srp_table *known, srp_interp **out, srp_error *error) {
    srp_interp *interp;
    srp_status status = srp_interp_create_partial(scheme, known, &interp, error);
    if (status != SRP_OK) {
        return status;
    }
    interp->supply = create_supply(interp, demand);
    if (interp->supply == NULL) {
        srp_interp_destroy(interp);
        return srp_fail(error, SRP_NO_MEMORY, "no memory for an interpolant on demand");
    }
    for (uint32_t i = 0; i < interp->columns; ++i) {
        for (uint32_t j = 0; j <= interp->rows; ++j) {
            srp_demand_node node = {i, j};
            interp->supply->placed[place_index(interp, node)] = srp_table_node(known, i, j) != NULL;
        }
    }
    *out = interp;
    return SRP_OK;
}

srp_status srp_interp_create_on_demand(const srp_interp_scheme *scheme, srp_demand *demand,
                                       srp_interp **out, srp_error *error) {
    if (!(scheme->capabilities & SRP_INTERP_LOCAL)) {
        return srp_fail(error, SRP_UNSUPPORTED,
                        "%s needs all nodes at once: a table that fills itself takes bilinear and "
                        "bicubic",
                        scheme->name);
    }
    srp_status status = srp_interp_check_steps(scheme, srp_demand_grid(demand), error);
    if (status == SRP_OK) {
        status = need_first_nodes(scheme, demand, error);
    }
    srp_table *known;
    if (status == SRP_OK) {
        status = srp_demand_copy(demand, &known, error);
    }
    if (status != SRP_OK) {
        return status;
    }
    status = create_with(scheme, demand, known, out, error);
    srp_table_destroy(known);
    return status;
}
