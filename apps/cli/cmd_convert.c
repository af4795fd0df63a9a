/* SPDX-License-Identifier: Apache-2.0 */
/* srp convert: a table from one format to another. */
#include "commands.h"
#include "messages.h"
#include "outputs.h"
#include "table_input.h"

#include <srp/table.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CONVERT_FLIP, CONVERT_MASS, CONVERT_FLUX, CONVERT_TITLE, CONVERT_OPTION_COUNT };

typedef struct convert_options {
    cli_given given;
    bool flip;
    double mass, flux;
    const char *title;
} convert_options;

static const cli_option OPTIONS[CONVERT_OPTION_COUNT] = {
    [CONVERT_FLIP] = {.name = "flip",
                      .help = "Turn every force and moment round: for tables whose signs follow "
                              "the opposite convention.",
                      .set = cli_set_flag,
                      .offset = offsetof(convert_options, flip)},
    [CONVERT_MASS] = {.name = "mass",
                      .value = "KG",
                      .help = "Mass of the spacecraft, for formats that hold accelerations. "
                              "Default: what the input states.",
                      .set = cli_set_number,
                      .offset = offsetof(convert_options, mass),
                      .range = &CLI_POSITIVE},
    [CONVERT_FLUX] = {.name = "flux",
                      .value = "W/M2",
                      .help = "Solar flux at 1 AU that the output states. Default: that of the "
                              "input.",
                      .set = cli_set_number,
                      .offset = offsetof(convert_options, flux),
                      .range = &CLI_POSITIVE},
    [CONVERT_TITLE] = {.name = "title",
                       .value = "TEXT",
                       .help = "Title in the output. Default: that of the input.",
                       .set = cli_set_text,
                       .offset = offsetof(convert_options, title)},
};

static const cli_group CONVERT = {"Conversion", OPTIONS, CONVERT_OPTION_COUNT};
static const cli_group *const GROUPS[] = {&CONVERT};

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

static int describe(const convert_options *options, srp_table *table) {
    const srp_table_info *info = srp_table_get_info(table);
    srp_sunlight light = info->light;
    if (cli_is_given(options->given, CONVERT_FLUX)) {
        light.flux = options->flux;
    }
    double mass = cli_is_given(options->given, CONVERT_MASS) ? options->mass : info->mass;
    const char *title = options->title != NULL ? options->title : info->title;
    srp_error error;
    srp_status status = srp_table_describe(table, title, info->command_line, light, mass, &error);
    return status == SRP_OK ? CLI_DONE : cli_input_error(&error);
}

static int convert_table(const convert_options *options, srp_table *table, const char *from,
                         const char *to) {
    int status = check_signs(options, table, from);
    if (status == CLI_DONE) {
        status = describe(options, table);
    }
    cli_list paths = {&to, 1};
    cli_table_content content = {!isnan(srp_table_get_info(table)->mass), false};
    if (status == CLI_DONE) {
        status = cli_outputs_check(&paths, content, NULL, 0);
    }
    size_t written;
    if (status == CLI_DONE) {
        status = cli_outputs_write(&paths, table, &written);
    }
    if (status == CLI_DONE) {
        cli_outputs_report(&paths, table);
    }
    return status;
}

static int convert(const convert_options *options, const cli_operands *operands) {
    if (operands->count != 2) {
        return cli_usage_error("expected two files, IN and OUT, found %zu", operands->count);
    }
    const char *from = operands->items[0], *to = operands->items[1];
    if (cli_format_of(from) == NULL || cli_format_of(to) == NULL) {
        return CLI_BAD_USAGE;
    }
    srp_table *table = NULL;
    int status = cli_table_open(from, &table);
    if (status == CLI_DONE) {
        status = convert_table(options, table, from, to);
    }
    srp_table_destroy(table);
    return status;
}

static int run(const cli_command *command, int argc, char **argv) {
    convert_options options = {.mass = NAN, .flux = SRP_SOLAR_FLUX};
    void *const targets[] = {&options};
    cli_operands operands;
    int status;
    if (cli_command_parse(command, argc, argv, targets, &operands, &status)) {
        status = convert(&options, &operands);
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
        "sign convention and is refused; --flip turns it round.",
    .examples = "srp convert box-wing.nc box-wing.spo\n"
                "srp convert box-wing.spo box-wing.txt --mass 850\n"
                "srp convert --flip wrong-sign.spo right-sign.spo",
    .groups = GROUPS,
    .group_count = sizeof GROUPS / sizeof GROUPS[0],
    .run = run,
};
