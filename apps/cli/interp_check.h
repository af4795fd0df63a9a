/* SPDX-License-Identifier: Apache-2.0 */
/* How wrong a table is between its nodes: responses in directions of no grid, computed once, and
 * tables compared with them. */
#ifndef SRP_CLI_INTERP_CHECK_H
#define SRP_CLI_INTERP_CHECK_H

#include <srp/interp.h>
#include <srp/method.h>
#include <srp/table.h>

#include <stddef.h>
#include <stdint.h>

typedef struct cli_interp_check {
    size_t count; /* 0: nothing is checked */
    uint64_t seed;
    srp_vec3 *s;
    srp_response *truth;
} cli_interp_check;

/* Computes `count` responses, with the progress bar; ends the program by its signal when one comes.
 * An exit status, said if not CLI_DONE; cli_interp_check_end() in any case. */
int cli_interp_check_begin(cli_interp_check *check, const srp_prepared *prepared, uint32_t count,
                           uint64_t seed);
void cli_interp_check_end(cli_interp_check *check);

/* Compares, and keeps the errors in the table. An exit status. */
int cli_interp_check_table(const cli_interp_check *check, srp_table *table);

/* Largest |f| of the nodes [m^2]. */
double cli_interp_largest(const srp_table *table);

/* Prints what a table knows of its errors to stdout; nothing when it knows nothing. */
void cli_interp_check_report(const srp_table *table);

#endif
