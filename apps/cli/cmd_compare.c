/* SPDX-License-Identifier: Apache-2.0 */
/* srp compare: how far two tables are apart. */
#include "commands.h"
#include "comparison.h"
#include "figure.h"
#include "json.h"
#include "messages.h"
#include "table_input.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    COMPARE_MOMENT,
    COMPARE_MASS,
    COMPARE_FLUX,
    COMPARE_FAIL_ABOVE,
    COMPARE_INTERPOLATION,
    COMPARE_JSON,
    COMPARE_OPTION_COUNT
};

typedef struct compare_options {
    cli_given given;
    bool moment, json;
    double mass, flux, fail_above;
    const char *interpolation;
} compare_options;

static const cli_option OPTIONS[COMPARE_OPTION_COUNT] = {
    [COMPARE_MOMENT] = {.name = "moment",
                        .help = "Compare moments instead of forces.",
                        .set = cli_set_flag,
                        .offset = offsetof(compare_options, moment)},
    [COMPARE_MASS] = {.name = "mass",
                      .value = "KG",
                      .help = "Mass of the spacecraft; prints accelerations too. Default: what A "
                              "states.",
                      .set = cli_set_number,
                      .offset = offsetof(compare_options, mass),
                      .range = &CLI_POSITIVE},
    [COMPARE_FLUX] = {.name = "flux",
                      .value = "W/M2",
                      .help = "Solar flux at 1 au, for accelerations. Default: what A states.",
                      .set = cli_set_number,
                      .offset = offsetof(compare_options, flux),
                      .range = &CLI_POSITIVE},
    [COMPARE_FAIL_ABOVE] = {.name = "fail-above",
                            .value = "REL",
                            .help =
                                "End with status 1 when the largest difference, as a vector, is "
                                "more than REL times the mean length of A.",
                            .set = cli_set_number,
                            .offset = offsetof(compare_options, fail_above),
                            .range = &CLI_NOT_NEGATIVE},
    [COMPARE_INTERPOLATION] = {.name = "interpolation",
                               .value = "NAME",
                               .complete = CLI_COMPLETE_WORDS,
                               .words = "bilinear bicubic spline",
                               .help = "How the table of the coarser grid is interpolated to the "
                                       "nodes of the finer: bilinear, bicubic or spline. Default: "
                                       "bicubic.",
                               .set = cli_set_text,
                               .offset = offsetof(compare_options, interpolation)},
    [COMPARE_JSON] = {.name = "json",
                      .help = "Print JSON.",
                      .set = cli_set_flag,
                      .offset = offsetof(compare_options, json)},
};

static const cli_group COMPARISON = {"Comparison", OPTIONS, COMPARE_OPTION_COUNT};
static const cli_group *const GROUPS[] = {&COMPARISON, &cli_group_figure};

typedef struct comparison {
    const compare_options *options;
    const char *path[2];
    srp_table *table[2];
    cli_comparison found;
    double mass; /* [kg], NAN when not known */
    srp_sunlight light;
} comparison;

/* ---- output ---- */

static void write_json(const comparison *c) {
    cli_json json;
    cli_json_begin(&json, stdout);
    cli_json_text(&json, "a", c->path[0]);
    cli_json_text(&json, "b", c->path[1]);
    cli_json_text(&json, "quantity", c->options->moment ? "moment_m3" : "force_m2");
    cli_json_count(&json, "directions", c->found.directions);
    cli_json_number(&json, "mean_length_a", c->found.difference.mean_a);
    cli_json_number(&json, "mean_length_b", c->found.difference.mean_b);
    cli_json_open_object(&json, "b_minus_a");
    for (int k = 0; k < CLI_DIFFERENCE_COUNT; ++k) {
        const cli_difference_row *row = &c->found.difference.row[k];
        cli_json_open_object(&json, CLI_DIFFERENCE_NAME[k]);
        cli_json_number(&json, "mse", row->mse);
        cli_json_number(&json, "rms", row->rms);
        cli_json_number(&json, "mean", row->mean);
        cli_json_number(&json, "largest", row->largest);
        cli_json_number(&json, "azimuth_deg", row->az_deg);
        cli_json_number(&json, "elevation_deg", row->el_deg);
        cli_json_close_object(&json);
    }
    cli_json_close_object(&json);
    if (!c->options->moment && !isnan(c->mass)) {
        cli_json_number(&json, "mass_kg", c->mass);
        cli_json_number(&json, "m_s2_per_m2", cli_acceleration_of_area(c->mass, c->light));
    }
    cli_json_end(&json);
}

/* ---- the figure ---- */

static int draw(const comparison *c, const cli_figure_options *figure) {
    size_t nodes = srp_grid_node_count(c->found.grid);
    double *value = calloc(CLI_COMPARISON_FIELDS * nodes, sizeof *value);
    if (value == NULL) {
        cli_say("no memory for the figure");
        return CLI_MACHINE_FAILED;
    }
    cli_comparison_fields(&c->found, value);
    bool moment = c->options->moment;
    char title[512];
    snprintf(title, sizeof title, "%s minus %s", c->path[1], c->path[0]);
    cli_picture picture = {
        .title = title,
        .columns = 1,
        .rows = CLI_FIGURE_ROWS,
        .grid = {c->found.grid},
        .name = {moment ? "Δt#dx#u [m³]" : "Δf#dx#u [m²]", moment ? "Δt#dy#u [m³]" : "Δf#dy#u [m²]",
                 moment ? "Δt#dz#u [m³]" : "Δf#dz#u [m²]", moment ? "|Δt| [m³]" : "|Δf| [m²]"},
        .is_signed = {true, true, true, false}};
    for (size_t r = 0; r < CLI_FIGURE_ROWS; ++r) {
        picture.field[0][r].value = &value[r * nodes];
    }
    int status = cli_figure_write(figure, &picture);
    free(value);
    return status;
}

/* ---- the command ---- */

static int judge(const comparison *c) {
    double largest = c->found.difference.row[CLI_DIFFERENCE_VECTOR].largest;
    if (cli_is_given(c->options->given, COMPARE_FAIL_ABOVE) &&
        !(largest <= c->options->fail_above * c->found.difference.mean_a)) {
        cli_say("the largest difference is %.6g of the mean length, more than %g",
                largest / c->found.difference.mean_a, c->options->fail_above);
        return CLI_BAD_INPUT;
    }
    return CLI_DONE;
}

static void choose_light(comparison *c) {
    const srp_table_info *info = srp_table_get_info(c->table[0]);
    c->mass = cli_is_given(c->options->given, COMPARE_MASS) ? c->options->mass : info->mass;
    c->light = info->light;
    if (cli_is_given(c->options->given, COMPARE_FLUX)) {
        c->light.flux = c->options->flux;
    }
}

static int compare(comparison *c, const cli_figure_options *figure) {
    int status = cli_figure_check(figure, c->path, 2);
    for (int k = 0; k < 2 && status == CLI_DONE; ++k) {
        status = cli_table_open_checked(c->path[k], &c->table[k]);
    }
    if (status == CLI_DONE) {
        choose_light(c);
        c->found.table[0] = c->table[0];
        c->found.table[1] = c->table[1];
        status = cli_comparison_make(&c->found);
    }
    if (status == CLI_DONE && figure->output != NULL) {
        status = draw(c, figure);
    }
    if (status == CLI_DONE) {
        c->options->json ? write_json(c)
                         : cli_comparison_print(stdout, &c->found, c->mass, c->light);
        status = judge(c);
    }
    cli_comparison_release(&c->found);
    for (int k = 0; k < 2; ++k) {
        srp_table_destroy(c->table[k]);
    }
    return status;
}

static int run(const cli_command *command, int argc, char **argv) {
    compare_options options = {.mass = NAN, .flux = SRP_SOLAR_FLUX, .interpolation = "bicubic"};
    cli_figure_options figure = cli_figure_options_default();
    void *const targets[] = {&options, &figure};
    cli_operands operands;
    int status;
    if (!cli_command_parse(command, argc, argv, targets, &operands, &status)) {
        return status;
    }
    if (operands.count != 2) {
        return cli_usage_error("expected two tables, A and B, found %zu", operands.count);
    }
    if (figure.output == NULL && figure.given != 0) {
        return cli_usage_error("--map, --view and --width are for a figure: -o FIG");
    }
    if (figure.map && cli_is_given(figure.given, FIGURE_VIEW)) {
        return cli_usage_error("--view is for surfaces, --map draws none");
    }
    const srp_interp_scheme *scheme = srp_interp_find(options.interpolation);
    if (scheme == NULL) {
        return cli_usage_error("--interpolation %s: expected bilinear, bicubic or spline",
                               options.interpolation);
    }
    comparison c = {.options = &options,
                    .path = {operands.items[0], operands.items[1]},
                    .found = {.name = {operands.items[0], operands.items[1]},
                              .moment = options.moment,
                              .scheme = scheme}};
    return compare(&c, &figure);
}

const cli_command cli_command_compare = {
    .name = "compare",
    .operands = "A B",
    .operand_files = "nc spo txt",
    .summary = "how far two tables are apart",
    .description =
        "Prints the difference B - A for each component, for the length of the force, and as a "
        "vector: mean square, root mean square, mean, and the largest value with its direction, in "
        "m^2, relative to the mean length of A, and in m/s^2 when the mass is known.\n\n"
        "Tables of different grids are compared at the nodes of the finer, which is the one with "
        "more "
        "nodes; the other is interpolated, and what that misses is part of the difference. Means "
        "are over the sphere: "
        "each direction counts by its solid angle. With -o the difference is drawn.",
    .examples = "srp compare exact.nc plates.nc\n"
                "srp compare exact.nc plates.nc --mass 850 -o difference.png\n"
                "srp compare before.spo after.spo --fail-above 1e-6",
    .groups = GROUPS,
    .group_count = sizeof GROUPS / sizeof GROUPS[0],
    .run = run,
};
