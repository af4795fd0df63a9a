/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What a table says about each direction once: the seam and the poles of a grid have several nodes
 * for one direction, and a sum over nodes counts them too often.
 */
#ifndef SRP_CLI_SAMPLES_H
#define SRP_CLI_SAMPLES_H

#include <srp/interp.h>
#include <srp/table.h>

#include <stdbool.h>
#include <stddef.h>

typedef struct cli_direction {
    srp_vec3 s;            /* unit, spacecraft -> Sun, body frame */
    double az_deg, el_deg; /* of the first of its nodes; 0 azimuth at the poles */
    double weight;         /* share of the sphere; all add up to 1 */
} cli_direction;

typedef struct cli_samples {
    srp_grid grid;
    size_t count;
    cli_direction *at; /* (count) */
    srp_vec3 *value;   /* (count) f [m^2] or t [m^3]; the mean where nodes disagree */
    double *lit_area;  /* (count) [m^2]; NAN where the table does not know it */
} cli_samples;

/* Are all nodes of `coarse` nodes of `fine`? */
bool cli_grid_contains(srp_grid fine, srp_grid coarse);
/* The one with more nodes. */
srp_grid cli_grid_finer(srp_grid a, srp_grid b);

/* Samples of a complete `table` at the nodes of `grid`, each of which is one of the table's.
 * `moment` chooses t instead of f. False without memory; then *out is unchanged. */
bool cli_samples_take(const srp_table *table, srp_grid grid, bool moment, cli_samples *out);
/* The same between the nodes. lit_area is not known. */
bool cli_samples_interpolate(const srp_interp *interp, srp_grid grid, bool moment,
                             cli_samples *out);
void cli_samples_free(cli_samples *samples);

/* Mean length of the values, weighted. */
double cli_samples_mean_length(const cli_samples *samples);

#endif
