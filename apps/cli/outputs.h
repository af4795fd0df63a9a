/* SPDX-License-Identifier: Apache-2.0 */
/* Files that tables are written to: chosen and checked before the work, written after it. */
#ifndef SRP_CLI_OUTPUTS_H
#define SRP_CLI_OUTPUTS_H

#include "command.h"

#include <srp/table.h>

/* The format that the ending of `path` stands for; NULL after a usage error that lists the endings.
 */
const srp_table_format *cli_format_of(const char *path);

/* Behind the name of the first output: what an interrupted run leaves, a table in NetCDF. */
#define CLI_PARTIAL_ENDING ".partial"

/* The format that a table to be read has by its ending; NULL: it is none. */
const srp_table_format *cli_input_format_of(const char *path);

/* What the table that will be written holds. */
typedef struct cli_table_content {
    bool mass;  /* the mass of the spacecraft is known */
    bool basis; /* sums per material were asked for */
} cli_table_content;

/* Checks that all of `paths` can be written, have a format that can hold `content`, and name
 * neither one file twice nor one of `inputs` (`input_count`, NULL entries are skipped). An exit
 * status, said if not CLI_DONE. Nothing is written. */
int cli_outputs_check(const cli_list *paths, cli_table_content content, const char *const *inputs,
                      size_t input_count);

/* Writes `table` to all of them, going on after a failure; each file appears whole or not at all.
 * *written counts the good ones. The first failure's exit status. */
int cli_outputs_write(const cli_list *paths, const srp_table *table, size_t *written);

/* Prints the names of the files and what is in them to stdout. */
void cli_outputs_report(const cli_list *paths, const srp_table *table);

#endif
