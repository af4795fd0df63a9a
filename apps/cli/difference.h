/* SPDX-License-Identifier: Apache-2.0 */
/* How far two tables, or a table and a model, are apart. */
#ifndef SRP_CLI_DIFFERENCE_H
#define SRP_CLI_DIFFERENCE_H

#include "samples.h"

/* What is looked at: the components of B - A, the difference of the lengths |B| - |A|, and the
 * length |B - A| of the difference. */
enum {
    CLI_DIFFERENCE_X,
    CLI_DIFFERENCE_Y,
    CLI_DIFFERENCE_Z,
    CLI_DIFFERENCE_LENGTH,
    CLI_DIFFERENCE_VECTOR,
    CLI_DIFFERENCE_COUNT
};

/* Means are over the sphere: each direction counts by its solid angle. */
typedef struct cli_difference_row {
    double mse, rms, mean;
    double largest; /* the value, with its sign, that is largest without */
    double az_deg, el_deg;
} cli_difference_row;

typedef struct cli_difference {
    cli_difference_row row[CLI_DIFFERENCE_COUNT];
    double mean_a, mean_b; /* mean lengths */
} cli_difference;

extern const char *const CLI_DIFFERENCE_NAME[CLI_DIFFERENCE_COUNT];

/* `a` and `b` are of one grid. Where `skip` (count; NULL: nowhere) is true a direction is left out;
 * at least one stays. */
cli_difference cli_difference_measure(const cli_samples *a, const srp_vec3 *b, const bool *skip);

#endif
