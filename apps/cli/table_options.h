/* SPDX-License-Identifier: Apache-2.0 */
/* What `srp table` is asked for, its model and its method aside. */
#ifndef SRP_CLI_TABLE_OPTIONS_H
#define SRP_CLI_TABLE_OPTIONS_H

#include "command.h"

#include <srp/table.h>

enum {
    TABLE_OUTPUT,
    TABLE_STEP,
    TABLE_AZ_STEP,
    TABLE_EL_STEP,
    TABLE_MASS,
    TABLE_FLUX,
    TABLE_BASIS,
    TABLE_TITLE,
    TABLE_RESTART,
    TABLE_CACHE,
    TABLE_CHECK,
    TABLE_MAX_ERROR,
    TABLE_INTERPOLATION,
    TABLE_OPTION_COUNT
};

typedef struct cli_table_options {
    cli_given given;
    cli_list outputs;
    double step, az_step, el_step, mass, flux;
    const char *title; /* NULL = names of the model */
    bool basis, restart, cache;
    uint32_t check;
    double max_error;          /* NAN = the step is given */
    const char *interpolation; /* what max_error is about */
} cli_table_options;

extern const cli_group cli_group_table;

cli_table_options cli_table_options_default(void);

/* The grid that the options ask for, of one step for us to choose with --max-error; checks that
 * they agree. An exit status, said if not CLI_DONE. */
int cli_table_choose_grid(const cli_table_options *options, srp_grid *grid);

#endif
