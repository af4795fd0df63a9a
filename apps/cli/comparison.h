/* SPDX-License-Identifier: Apache-2.0 */
/* Two tables on one grid, the finer of theirs: how far B is from A, in numbers and at every node.
 */
#ifndef SRP_CLI_COMPARISON_H
#define SRP_CLI_COMPARISON_H

#include "difference.h"

#include <srp/interp.h>
#include <srp/table.h>

#include <stdio.h>

typedef struct cli_comparison {
    /* What is compared; set by the caller, who keeps it. */
    const srp_table *table[2];
    const char *name[2];             /* for messages */
    bool moment;                     /* moments instead of forces */
    const srp_interp_scheme *scheme; /* for the table that lacks nodes of the finer grid */
    /* What is found. */
    srp_interp *interp[2];   /* NULL where the table has all nodes of the grid */
    bool is_interpolated[2]; /* it was not NULL: known after the release, too */
    srp_grid grid;
    size_t directions;
    cli_difference difference;
} cli_comparison;

/* Finds all that is found; of moments only about one reference point. An exit status, said if not
 * CLI_DONE. cli_comparison_release() in any case. */
int cli_comparison_make(cli_comparison *c);
void cli_comparison_release(cli_comparison *c);

enum { CLI_COMPARISON_FIELDS = 4 };
/* x, y, z of B - A and its length at the nodes of the grid (CLI_COMPARISON_FIELDS, nodes). */
void cli_comparison_fields(const cli_comparison *c, double *value);

/* What `srp compare` prints, before or after the release. `mass` [kg] NAN: no accelerations. */
void cli_comparison_print(FILE *out, const cli_comparison *c, double mass, srp_sunlight light);
/* The acceleration by 1 m^2, 1 au from the Sun [m/s^2 per m^2]. */
double cli_acceleration_of_area(double mass, srp_sunlight light);

#endif
