/* SPDX-License-Identifier: Apache-2.0 */
#include "samples.h"

#include <srp/const.h>

#include <math.h>
#include <stdlib.h>

static bool contains(srp_grid fine, srp_grid coarse) {
    return (fine.az_count - 1) % (coarse.az_count - 1) == 0 &&
           (fine.el_count - 1) % (coarse.el_count - 1) == 0;
}

bool cli_grid_common(srp_grid a, srp_grid b, srp_grid *out) {
    if (contains(a, b)) {
        *out = b;
        return true;
    }
    if (contains(b, a)) {
        *out = a;
        return true;
    }
    return false;
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

/* A direction, from all nodes that it has: columns i_first to i_last, and the far end of the seam.
 */
static void take_direction(const srp_table *table, bool moment, uint32_t i, uint32_t j,
                           cli_samples *to) {
    srp_grid grid = to->grid;
    bool pole = j == 0 || j == grid.el_count - 1;
    size_t k = to->count++;
    uint32_t nodes = 0;
    cli_direction *at = &to->at[k];
    at->s = srp_grid_direction(grid, i, j);
    at->az_deg = pole ? 0.0 : srp_grid_azimuth_deg(grid, i);
    at->el_deg = srp_grid_elevation_deg(grid, j);
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

bool cli_samples_take(const srp_table *table, srp_grid grid, bool moment, cli_samples *out) {
    size_t room = srp_grid_node_count(grid);
    cli_samples made = {grid, 0, calloc(room, sizeof *made.at), calloc(room, sizeof *made.value),
                        calloc(room, sizeof *made.lit_area)};
    if (made.at == NULL || made.value == NULL || made.lit_area == NULL) {
        cli_samples_free(&made);
        return false;
    }
    for (uint32_t i = 0; i + 1 < grid.az_count; ++i) {
        for (uint32_t j = 0; j < grid.el_count; ++j) {
            bool pole = j == 0 || j == grid.el_count - 1;
            if (!pole || i == 0) {
                take_direction(table, moment, i, j, &made);
            }
        }
    }
    *out = made;
    return true;
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
