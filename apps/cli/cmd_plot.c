/* SPDX-License-Identifier: Apache-2.0 */
/* srp plot: a table, or two, as a figure. */
#include "commands.h"
#include "figure.h"
#include "messages.h"
#include "table_input.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { PLOT_MOMENT, PLOT_ERROR, PLOT_TITLE, PLOT_OPTION_COUNT };

typedef struct plot_options {
    cli_given given;
    bool moment, error;
    const char *title;
} plot_options;

static const cli_option OPTIONS[PLOT_OPTION_COUNT] = {
    [PLOT_MOMENT] = {.name = "moment",
                     .help = "Plot moments instead of forces.",
                     .set = cli_set_flag,
                     .offset = offsetof(plot_options, moment)},
    [PLOT_ERROR] = {.name = "error",
                    .help = "Plot the standard error of the force (with --moment: of the moment), "
                            "and its share of the length.",
                    .set = cli_set_flag,
                    .offset = offsetof(plot_options, error)},
    [PLOT_TITLE] = {.name = "title",
                    .value = "TEXT",
                    .help = "Title of the figure. Default: what the table says of itself.",
                    .set = cli_set_title,
                    .offset = offsetof(plot_options, title)},
};

static const cli_group PLOT = {"Plot", OPTIONS, PLOT_OPTION_COUNT};
static const cli_group *const GROUPS[] = {&PLOT, &cli_group_figure};

typedef struct plot_job {
    const plot_options *options;
    const cli_figure_options *figure;
    const char *const *path;
    size_t tables;
    srp_table *table[CLI_FIGURE_COLUMNS];
    char summary[CLI_FIGURE_COLUMNS][256];
    double *value[CLI_FIGURE_COLUMNS]; /* (rows, nodes) */
} plot_job;

static const char *const FORCE[] = {"f#dx#u [m²]", "f#dy#u [m²]", "f#dz#u [m²]", "|f| [m²]"};
static const char *const MOMENT[] = {"t#dx#u [m³]", "t#dy#u [m³]", "t#dz#u [m³]", "|t| [m³]"};
static const char *const FORCE_ERROR[] = {"standard error of f [m²]", "standard error / |f| [%]"};
static const char *const MOMENT_ERROR[] = {"standard error of t [m³]", "standard error / |t| [%]"};

static size_t rows_of(const plot_options *options) {
    return options->error ? 2 : CLI_FIGURE_ROWS;
}

static int check_content(const plot_job *job, size_t k) {
    const srp_table_info *info = srp_table_get_info(job->table[k]);
    if (job->options->moment && !info->has_moment) {
        fprintf(stderr, "%s: holds no moments, expected them for --moment\n", job->path[k]);
        return CLI_BAD_INPUT;
    }
    if (job->options->error && !info->has_error) {
        fprintf(stderr, "%s: holds no standard errors, expected them for --error\n", job->path[k]);
        return CLI_BAD_INPUT;
    }
    return CLI_DONE;
}

/* The values of one node, row by row. */
static void node_values(const plot_options *options, const srp_response *node, double *value,
                        size_t stride) {
    srp_vec3 v = options->moment ? node->t : node->f;
    if (options->error) {
        double error = options->moment ? node->t_error : node->f_error, size = srp_vec3_norm(v);
        value[0] = error;
        value[stride] = size > 0.0 ? 100.0 * error / size : 0.0;
        return;
    }
    value[0] = v.x;
    value[stride] = v.y;
    value[2 * stride] = v.z;
    value[3 * stride] = srp_vec3_norm(v);
}

static int load(plot_job *job, size_t k) {
    int status = cli_table_open_checked(job->path[k], &job->table[k]);
    if (status == CLI_DONE) {
        status = check_content(job, k);
    }
    if (status != CLI_DONE) {
        return status;
    }
    cli_table_summary(job->table[k], job->summary[k], sizeof job->summary[k]);
    srp_grid grid = srp_table_grid(job->table[k]);
    size_t nodes = srp_grid_node_count(grid);
    job->value[k] = calloc(rows_of(job->options) * nodes, sizeof *job->value[k]);
    if (job->value[k] == NULL) {
        cli_say("no memory for the figure");
        return CLI_MACHINE_FAILED;
    }
    for (uint32_t i = 0; i < grid.az_count; ++i) {
        for (uint32_t j = 0; j < grid.el_count; ++j) {
            node_values(job->options, srp_table_node(job->table[k], i, j),
                        &job->value[k][(size_t)i * grid.el_count + j], nodes);
        }
    }
    return CLI_DONE;
}

static int draw(plot_job *job) {
    const plot_options *options = job->options;
    bool moment = options->moment;
    const char *const *names =
        options->error ? (moment ? MOMENT_ERROR : FORCE_ERROR) : (moment ? MOMENT : FORCE);
    char between[600];
    snprintf(between, sizeof between, "%s and %s", job->path[0], job->path[job->tables - 1]);
    cli_picture picture = {.title = job->tables > 1 ? between : job->summary[0],
                           .columns = job->tables,
                           .rows = rows_of(options)};
    if (options->title != NULL) {
        picture.title = options->title;
    }
    for (size_t r = 0; r < picture.rows; ++r) {
        picture.name[r] = names[r];
        picture.is_signed[r] = !options->error && r < 3;
    }
    for (size_t c = 0; c < picture.columns; ++c) {
        size_t nodes = srp_grid_node_count(srp_table_grid(job->table[c]));
        picture.grid[c] = srp_table_grid(job->table[c]);
        picture.heading[c] = job->summary[c];
        for (size_t r = 0; r < picture.rows; ++r) {
            picture.field[c][r].value = &job->value[c][r * nodes];
        }
    }
    return cli_figure_write(job->figure, &picture);
}

static int plot(plot_job *job) {
    int status = cli_figure_check(job->figure, job->path, job->tables);
    for (size_t k = 0; k < job->tables && status == CLI_DONE; ++k) {
        status = load(job, k);
    }
    if (status == CLI_DONE) {
        status = draw(job);
    }
    if (status == CLI_DONE) {
        printf("%s\n", job->figure->output);
    }
    for (size_t k = 0; k < job->tables; ++k) {
        srp_table_destroy(job->table[k]);
        free(job->value[k]);
    }
    return status;
}

static int run(const cli_command *command, int argc, char **argv) {
    plot_options options = {.moment = false};
    cli_figure_options figure = cli_figure_options_default();
    void *const targets[] = {&options, &figure};
    cli_operands operands;
    int status;
    if (!cli_command_parse(command, argc, argv, targets, &operands, &status)) {
        return status;
    }
    if (operands.count < 1 || operands.count > CLI_FIGURE_COLUMNS) {
        return cli_usage_error("expected one table or two, found %zu", operands.count);
    }
    if (figure.output == NULL) {
        return cli_usage_error("where to? -o FIG.png, .svg or .pdf");
    }
    if (figure.map && cli_is_given(figure.given, FIGURE_VIEW)) {
        return cli_usage_error("--view is for surfaces, --map draws none");
    }
    plot_job job = {
        .options = &options, .figure = &figure, .path = operands.items, .tables = operands.count};
    return plot(&job);
}

const cli_command cli_command_plot = {
    .name = "plot",
    .operands = "TABLE [TABLE] -o FIG",
    .operand_files = "nc spo txt",
    .summary = "figure of a table, or of two side by side",
    .description =
        "Draws the components of the force and its length over azimuth and elevation of the Sun, "
        "as four surfaces in 3D or, with --map, as flat maps with contours. Equal steps of a value "
        "are equal steps of colour to the eye; components have the same colours on both sides of "
        "0. Two tables stand side by side on one scale.",
    .examples = "srp plot box-wing.nc -o box-wing.png\n"
                "srp plot box-wing.nc -o box-wing.pdf --map\n"
                "srp plot exact.nc plates.nc -o both.svg --view 120,20",
    .groups = GROUPS,
    .group_count = sizeof GROUPS / sizeof GROUPS[0],
    .run = run,
};
