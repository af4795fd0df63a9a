/* SPDX-License-Identifier: Apache-2.0 */
#include "samples.h"

#include <srp/const.h>

#include <math.h>
#include <stdlib.h>

bool cli_grid_contains(srp_grid fine, srp_grid coarse) {
    return (fine.az_count - 1) % (coarse.az_count - 1) == 0 &&
           (fine.el_count - 1) % (coarse.el_count - 1) == 0;
}

srp_grid cli_grid_finer(srp_grid a, srp_grid b) {
    return srp_grid_node_count(b) > srp_grid_node_count(a) ? b : a;
}

/* Adds a node of `grid` to sample k; returns its solid angle. */
static void add_node(const srp_table *table, srp_grid grid, uint32_t i, uint32_t j, bool moment,
                     cli_samples *to, size_t k, uint32_t *nodes) {
    srp_grid own = srp_table_grid(table);
    uint32_t az_stride = (own.az_count - 1) / (grid.az_count - 1);
    uint32_t el_stride = (own.el_count - 1) / (grid.el_count - 1);
    const srp_response *node = srp_table_node(table, i * az_stride, j * el_stride);
    to->value[k] = srp_vec3_add(to->value[k], moment ? node->t : node->f);
    to->lit_area[k] += node->lit_area;
    to->at[k].weight += srp_grid_solid_angle(grid, i, j) / (4.0 * SRP_PI);
    ++*nodes;
}

/* A direction of the grid, from its first node, without its weight. */
static cli_direction direction_of(srp_grid grid, uint32_t i, uint32_t j) {
    bool pole = j == 0 || j == grid.el_count - 1;
    return (cli_direction){.s = srp_grid_direction(grid, i, j),
                           .az_deg = pole ? 0.0 : srp_grid_azimuth_deg(grid, i),
                           .el_deg = srp_grid_elevation_deg(grid, j)};
}

/* A direction, from all nodes that it has: the row of a pole, both ends of the seam. */
static void take_direction(const srp_table *table, bool moment, uint32_t i, uint32_t j,
                           cli_samples *to) {
    srp_grid grid = to->grid;
    bool pole = j == 0 || j == grid.el_count - 1;
    size_t k = to->count++;
    uint32_t nodes = 0;
    to->at[k] = direction_of(grid, i, j);
    if (pole) {
        for (uint32_t m = 0; m < grid.az_count; ++m) {
            add_node(table, grid, m, j, moment, to, k, &nodes);
        }
    } else {
        add_node(table, grid, i, j, moment, to, k, &nodes);
        if (i == 0) {
            add_node(table, grid, grid.az_count - 1, j, moment, to, k, &nodes);
        }
    }
    to->value[k] = srp_vec3_scale(1.0 / nodes, to->value[k]);
    to->lit_area[k] = srp_table_get_info(table)->has_error ? to->lit_area[k] / nodes : (double)NAN;
}

static void interpolate_direction(const srp_interp *interp, bool moment, uint32_t i, uint32_t j,
                                  cli_samples *to) {
    srp_grid grid = to->grid;
    bool pole = j == 0 || j == grid.el_count - 1;
    size_t k = to->count++;
    srp_vec3 f, t;
    to->at[k] = direction_of(grid, i, j);
    to->lit_area[k] = (double)NAN;
    /* Every node of the seam and of the poles has its part of the cell. */
    double cells = pole ? (double)grid.az_count - 1.0 : i == 0 ? 2.0 : 1.0;
    uint32_t inner = pole && grid.az_count > 2 ? 1 : i;
    to->at[k].weight = cells * srp_grid_solid_angle(grid, inner, j) / (4.0 * SRP_PI);
    if (pole && grid.az_count == 2) {
        to->at[k].weight *= 2.0; /* two halves of one cell */
    }
    if (srp_interp_eval(interp, to->at[k].s, &f, &t, NULL, NULL) == SRP_OK) {
        to->value[k] = moment ? t : f;
    }
}

static bool samples_make(cli_samples *made, srp_grid grid) {
    size_t room = srp_grid_node_count(grid);
    *made = (cli_samples){grid, 0, calloc(room, sizeof *made->at),
                          calloc(room, sizeof *made->value), calloc(room, sizeof *made->lit_area)};
    if (made->at == NULL || made->value == NULL || made->lit_area == NULL) {
        cli_samples_free(made);
        return false;
    }
    return true;
}

/* Exactly one of `table` and `interp` is there. */
static bool take(const srp_table *table, const srp_interp *interp, srp_grid grid, bool moment,
                 cli_samples *out) {
    cli_samples made;
    if (!samples_make(&made, grid)) {
        return false;
    }
    for (uint32_t i = 0; i + 1 < grid.az_count; ++i) {
        for (uint32_t j = 0; j < grid.el_count; ++j) {
            bool pole = j == 0 || j == grid.el_count - 1;
            if (pole && i > 0) {
                continue;
            }
            if (table != NULL) {
                take_direction(table, moment, i, j, &made);
            } else {
                interpolate_direction(interp, moment, i, j, &made);
            }
        }
    }
    *out = made;
    return true;
}

bool cli_samples_take(const srp_table *table, srp_grid grid, bool moment, cli_samples *out) {
    return take(table, NULL, grid, moment, out);
}

bool cli_samples_interpolate(const srp_interp *interp, srp_grid grid, bool moment,
                             cli_samples *out) {
    return take(NULL, interp, grid, moment, out);
}

void cli_samples_free(cli_samples *samples) {
    free(samples->at);
    free(samples->value);
    free(samples->lit_area);
    samples->at = NULL;
    samples->value = NULL;
    samples->lit_area = NULL;
    samples->count = 0;
}

double cli_samples_mean_length(const cli_samples *samples) {
    double sum = 0.0;
    for (size_t k = 0; k < samples->count; ++k) {
        sum += samples->at[k].weight * srp_vec3_norm(samples->value[k]);
    }
    return sum;
}
