/* SPDX-License-Identifier: Apache-2.0 */
#include "restate.h"

#include "messages.h"
#include "outputs.h"

#include <math.h>
#include <stdio.h>

static const cli_option OPTIONS[RESTATE_OPTION_COUNT] = {
    [RESTATE_MASS] = {.name = "mass",
                      .value = "KG",
                      .help = "Mass of the spacecraft, for formats that hold accelerations. "
                              "Default: what the input states.",
                      .set = cli_set_number,
                      .offset = offsetof(cli_restate_options, mass),
                      .range = &CLI_POSITIVE},
    [RESTATE_FLUX] = {.name = "flux",
                      .value = "W/M2",
                      .help = "Solar flux at 1 au that the output states. Default: that of the "
                              "input.",
                      .set = cli_set_number,
                      .offset = offsetof(cli_restate_options, flux),
                      .range = &CLI_POSITIVE},
    [RESTATE_TITLE] = {.name = "title",
                       .value = "TEXT",
                       .help = "Title in the output. Default: that of the input.",
                       .set = cli_set_title,
                       .offset = offsetof(cli_restate_options, title)},
};

const cli_group cli_group_restate = {"Statement", OPTIONS, RESTATE_OPTION_COUNT};

cli_restate_options cli_restate_options_default(void) {
    return (cli_restate_options){.mass = NAN, .flux = SRP_SOLAR_FLUX};
}

int cli_table_read(const char *path, srp_table **out) {
    const srp_table_format *format = cli_format_of(path);
    if (format == NULL) {
        return CLI_BAD_USAGE;
    }
    srp_table *table = NULL;
    srp_error error;
    if (srp_table_read(format, path, &table, &error) != SRP_OK) {
        return cli_input_error(&error);
    }
    if (!srp_table_is_complete(table)) {
        cli_say_of_file("%s: only %zu of %zu nodes are there, expected a complete table", path,
                        srp_table_filled_count(table), srp_grid_node_count(srp_table_grid(table)));
        srp_table_destroy(table);
        return CLI_BAD_INPUT;
    }
    *out = table;
    return CLI_DONE;
}

int cli_restate(const cli_restate_options *options, const char *command_line, srp_table *table) {
    const srp_table_info *info = srp_table_get_info(table);
    srp_sunlight light = info->light;
    if (cli_is_given(options->given, RESTATE_FLUX)) {
        light.flux = options->flux;
    }
    double mass = cli_is_given(options->given, RESTATE_MASS) ? options->mass : info->mass;
    const char *title = options->title != NULL ? options->title : info->title;
    const char *line = command_line != NULL ? command_line : info->command_line;
    srp_error error;
    srp_status status = srp_table_describe(table, title, line, light, mass, &error);
    return status == SRP_OK ? CLI_DONE : cli_input_error(&error);
}

int cli_restate_write(const cli_list *paths, const srp_table *table, const char *input) {
    cli_table_content content = {!isnan(srp_table_get_info(table)->mass), false};
    int status = cli_outputs_check(paths, content, &input, 1);
    size_t written;
    if (status == CLI_DONE) {
        status = cli_outputs_write(paths, table, &written);
    }
    if (status == CLI_DONE) {
        cli_outputs_report(paths, table);
    }
    return status;
}
