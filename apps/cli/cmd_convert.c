/* SPDX-License-Identifier: Apache-2.0 */
/* srp convert: a table from one format to another. */
#include "commands.h"
#include "messages.h"
#include "outputs.h"
#include "restate.h"

#include <srp/table.h>

#include <stdio.h>

enum { CONVERT_FLIP, CONVERT_OPTION_COUNT };

typedef struct convert_options {
    cli_given given;
    bool flip;
} convert_options;

static const cli_option OPTIONS[CONVERT_OPTION_COUNT] = {
    [CONVERT_FLIP] = {.name = "flip",
                      .help = "Turn every force and moment round: for tables whose signs follow "
                              "the opposite convention.",
                      .set = cli_set_flag,
                      .offset = offsetof(convert_options, flip)},
};

static const cli_group CONVERT = {"Conversion", OPTIONS, CONVERT_OPTION_COUNT};
static const cli_group *const GROUPS[] = {&CONVERT, &cli_group_restate};

/* Light can only push: a table that pulls has its signs the wrong way round. */
static int check_signs(const convert_options *options, srp_table *table, const char *path) {
    double pull = srp_table_pull_share(table);
    if (!options->flip && pull > SRP_TABLE_PULL_LIMIT) {
        fprintf(stderr,
                "%s: light pulls from %.0f %% of the directions: the signs follow the opposite "
                "convention; --flip turns them round\n",
                path, 100.0 * pull);
        return CLI_BAD_INPUT;
    }
    if (options->flip && pull <= SRP_TABLE_PULL_LIMIT) {
        fprintf(stderr,
                "%s: light pushes from %.0f %% of the directions, as it should: --flip would make "
                "it pull\n",
                path, 100.0 * (1.0 - pull));
        return CLI_BAD_INPUT;
    }
    if (options->flip) {
        srp_table_flip(table);
    }
    return CLI_DONE;
}

static int convert(const convert_options *options, const cli_restate_options *statement,
                   const cli_operands *operands) {
    if (operands->count != 2) {
        return cli_usage_error("expected two files, IN and OUT, found %zu", operands->count);
    }
    const char *from = operands->items[0], *to = operands->items[1];
    if (cli_format_of(from) == NULL || cli_format_of(to) == NULL) {
        return CLI_BAD_USAGE;
    }
    srp_table *table = NULL;
    int status = cli_table_read(from, &table);
    if (status == CLI_DONE) {
        srp_log log = cli_log();
        srp_table_inspect(table, from, &log, NULL);
        status = check_signs(options, table, from);
    }
    if (status == CLI_DONE) {
        status = cli_restate(statement, NULL, table);
    }
    if (status == CLI_DONE) {
        cli_list paths = {&to, 1};
        status = cli_restate_write(&paths, table, NULL);
    }
    srp_table_destroy(table);
    return status;
}

static int run(const cli_command *command, int argc, char **argv) {
    convert_options options = {.flip = false};
    cli_restate_options statement = cli_restate_options_default();
    void *const targets[] = {&options, &statement};
    cli_operands operands;
    int status;
    if (cli_command_parse(command, argc, argv, targets, &operands, &status)) {
        status = convert(&options, &statement, &operands);
    }
    return status;
}

const cli_command cli_command_convert = {
    .name = "convert",
    .operands = "IN OUT",
    .operand_files = "nc spo txt",
    .summary = "table from one file format to another",
    .description =
        "Reads a table and writes it in another format; the endings of the files choose the "
        "formats.\n\n"
        "Light can only push. A table that pulls over most of the sphere follows the opposite "
        "sign convention and is refused; --flip turns it round. Rounded numbers, and nodes of a "
        "pole that disagree, are warned about.",
    .examples = "srp convert box-wing.nc box-wing.spo\n"
                "srp convert box-wing.spo box-wing.txt --mass 850\n"
                "srp convert --flip wrong-sign.spo right-sign.spo",
    .groups = GROUPS,
    .group_count = sizeof GROUPS / sizeof GROUPS[0],
    .run = run,
};
