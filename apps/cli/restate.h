/* SPDX-License-Identifier: Apache-2.0 */
/* Tables that come from a file and go to others: what `convert` and `reoptic` share. */
#ifndef SRP_CLI_RESTATE_H
#define SRP_CLI_RESTATE_H

#include "command.h"

#include <srp/table.h>

/* What the output may state differently than the input. */
enum { RESTATE_MASS, RESTATE_FLUX, RESTATE_TITLE, RESTATE_OPTION_COUNT };

typedef struct cli_restate_options {
    cli_given given;
    double mass, flux;
    const char *title; /* NULL = that of the input */
} cli_restate_options;

extern const cli_group cli_group_restate;

cli_restate_options cli_restate_options_default(void);

/* Reads a complete table. An exit status, said if not CLI_DONE; then *out is unchanged. */
int cli_table_read(const char *path, srp_table **out);

/* Sets what the options say; `command_line` NULL keeps that of the table. An exit status, said if
 * not CLI_DONE. */
int cli_restate(const cli_restate_options *options, const char *command_line, srp_table *table);

/* Checks that `table` can go to all of `paths`, none of which may be the file `input` (NULL: any),
 * writes it and reports. An exit status, said if not CLI_DONE. */
int cli_restate_write(const cli_list *paths, const srp_table *table, const char *input);

#endif
