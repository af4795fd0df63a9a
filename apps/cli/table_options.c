/* SPDX-License-Identifier: Apache-2.0 */
#include "table_options.h"

#include "messages.h"

#include <srp/interp.h>
#include <srp/sunlight.h>

#include <math.h>

enum { CHECK_DEFAULT = 1000, CHECK_MAX = 1000000 };
static const cli_range CHECK_RANGE = {1, CHECK_MAX, "a whole number from 1 to 1000000"};

static const cli_option OPTIONS[TABLE_OPTION_COUNT] = {
    [TABLE_OUTPUT] = {.name = "output",
                      .letter = 'o',
                      .value = "FILE",
                      .complete = CLI_COMPLETE_FILE,
                      .help = "File to write; its ending chooses the format. May be given several "
                              "times.",
                      .set = cli_set_list,
                      .offset = offsetof(cli_table_options, outputs)},
    [TABLE_STEP] = {.name = "step",
                    .value = "DEG",
                    .help = "Step of azimuth and elevation; divides 180. Default: 5.",
                    .set = cli_set_number,
                    .offset = offsetof(cli_table_options, step),
                    .range = &CLI_POSITIVE},
    [TABLE_AZ_STEP] = {.name = "az-step",
                       .value = "DEG",
                       .help = "Step of azimuth alone; divides 360.",
                       .set = cli_set_number,
                       .offset = offsetof(cli_table_options, az_step),
                       .range = &CLI_POSITIVE},
    [TABLE_EL_STEP] = {.name = "el-step",
                       .value = "DEG",
                       .help = "Step of elevation alone; divides 180.",
                       .set = cli_set_number,
                       .offset = offsetof(cli_table_options, el_step),
                       .range = &CLI_POSITIVE},
    [TABLE_MASS] = {.name = "mass",
                    .value = "KG",
                    .help = "Mass of the spacecraft, for formats that hold accelerations.",
                    .set = cli_set_number,
                    .offset = offsetof(cli_table_options, mass),
                    .range = &CLI_POSITIVE},
    [TABLE_FLUX] = {.name = "flux",
                    .value = "W/M2",
                    .help = "Solar flux at 1 au that the outputs state. Default: 1367.",
                    .set = cli_set_number,
                    .offset = offsetof(cli_table_options, flux),
                    .range = &CLI_POSITIVE},
    [TABLE_BASIS] = {.name = "basis",
                     .help = "Keep the sums of each material, from which the force follows for any "
                             "optics.",
                     .set = cli_set_flag,
                     .offset = offsetof(cli_table_options, basis)},
    [TABLE_TITLE] = {.name = "title",
                     .value = "TEXT",
                     .help = "Title in the outputs. Default: the names of the model's files.",
                     .set = cli_set_title,
                     .offset = offsetof(cli_table_options, title)},
    [TABLE_RESTART] = {.name = "restart",
                       .help = "Discard what an interrupted run left, and compute from the "
                               "beginning.",
                       .set = cli_set_flag,
                       .offset = offsetof(cli_table_options, restart)},
    [TABLE_CACHE] = {.name = "cache",
                     .help = "Take nodes that are remembered, and remember those that are computed "
                             "('srp cache').",
                     .set = cli_set_flag,
                     .offset = offsetof(cli_table_options, cache)},
    [TABLE_CHECK] = {.name = "check",
                     .value = "N",
                     .help = "Compute N directions between the nodes, and keep in the .nc how far "
                             "interpolants are off there.",
                     .set = cli_set_count,
                     .offset = offsetof(cli_table_options, check),
                     .range = &CHECK_RANGE},
    [TABLE_MAX_ERROR] = {.name = "max-error",
                         .value = "REL",
                         .help = "Choose the step: the largest of 30, 20, 15, 10, 7.5, 6, 5, 4, 3, "
                                 "2.5, 2, 1.5 and 1 degrees with which interpolation is nowhere in "
                                 "--check (default: 1000) directions off by more than REL times "
                                 "the largest |f|.",
                         .set = cli_set_number,
                         .offset = offsetof(cli_table_options, max_error),
                         .range = &CLI_POSITIVE},
    [TABLE_INTERPOLATION] = {.name = "interpolation",
                             .value = "NAME",
                             .complete = CLI_COMPLETE_WORDS,
                             .words = "bilinear bicubic spline",
                             .help = "What --max-error is about: bilinear, bicubic or spline. "
                                     "Default: bilinear, as GMAT's.",
                             .set = cli_set_text,
                             .offset = offsetof(cli_table_options, interpolation)},
};

const cli_group cli_group_table = {"Table", OPTIONS, TABLE_OPTION_COUNT};

cli_table_options cli_table_options_default(void) {
    cli_table_options options = {.step = 5.0,
                                 .mass = NAN,
                                 .flux = SRP_SOLAR_FLUX,
                                 .check = CHECK_DEFAULT,
                                 .max_error = NAN,
                                 .interpolation = "bilinear"};
    return options;
}

static int check_interpolation(const cli_table_options *options) {
    if (srp_interp_find(options->interpolation) == NULL) {
        return cli_usage_error("--interpolation %s: expected bilinear, bicubic or spline",
                               options->interpolation);
    }
    if (cli_is_given(options->given, TABLE_INTERPOLATION) &&
        !cli_is_given(options->given, TABLE_MAX_ERROR)) {
        return cli_usage_error("--interpolation says what --max-error is about, which is missing");
    }
    return CLI_DONE;
}

int cli_table_choose_grid(const cli_table_options *options, srp_grid *grid) {
    bool az = cli_is_given(options->given, TABLE_AZ_STEP);
    bool el = cli_is_given(options->given, TABLE_EL_STEP);
    if (cli_is_given(options->given, TABLE_STEP) && (az || el)) {
        return cli_usage_error("--step and --%s exclude each other", az ? "az-step" : "el-step");
    }
    if (cli_is_given(options->given, TABLE_MAX_ERROR) &&
        (az || el || cli_is_given(options->given, TABLE_STEP))) {
        return cli_usage_error("--max-error chooses the step: it excludes --%s", az   ? "az-step"
                                                                                 : el ? "el-step"
                                                                                      : "step");
    }
    int checked = check_interpolation(options);
    if (checked != CLI_DONE) {
        return checked;
    }
    srp_error error;
    srp_status status = srp_grid_from_steps(az ? options->az_step : options->step,
                                            el ? options->el_step : options->step, grid, &error);
    return status == SRP_OK ? CLI_DONE : cli_usage_error("%s", error.message);
}
