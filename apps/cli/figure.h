/* SPDX-License-Identifier: Apache-2.0 */
/* Figures of fields over azimuth and elevation: surfaces in 3D, or maps. Drawn by PLplot; a build
 * without it refuses every figure. */
#ifndef SRP_CLI_FIGURE_H
#define SRP_CLI_FIGURE_H

#include "command.h"

#include <srp/table.h>

enum { FIGURE_OUTPUT, FIGURE_MAP, FIGURE_VIEW, FIGURE_WIDTH, FIGURE_OPTION_COUNT };

typedef struct cli_figure_options {
    cli_given given;
    const char *output; /* NULL = none */
    bool map;
    double view[2]; /* azimuth and elevation of the eye [deg] */
    uint32_t width; /* [px] */
} cli_figure_options;

extern const cli_group cli_group_figure;

cli_figure_options cli_figure_options_default(void);

enum { CLI_FIGURE_ROWS = 4, CLI_FIGURE_COLUMNS = 2 };

/* Values at the nodes of a grid, node (i, j) at i * el_count + j. */
typedef struct cli_field {
    const double *value;
} cli_field;

/* A figure: one column for each table, one row for each quantity. The panels of a row share their
 * scale, so that columns can be compared by eye. */
typedef struct cli_picture {
    const char *title;
    size_t columns, rows;
    srp_grid grid[CLI_FIGURE_COLUMNS];
    const char *heading[CLI_FIGURE_COLUMNS]; /* above each column; NULL with one */
    const char *name[CLI_FIGURE_ROWS];       /* with unit: "f_x [m²]" */
    bool is_signed[CLI_FIGURE_ROWS];         /* colours are the same on both sides of 0 */
    cli_field field[CLI_FIGURE_COLUMNS][CLI_FIGURE_ROWS];
} cli_picture;

/* Before the work: can this build draw, does the ending name a format, can the file be written, and
 * is it none of `inputs`? Nothing to check without an output. An exit status, said if not CLI_DONE.
 */
int cli_figure_check(const cli_figure_options *options, const char *const *inputs,
                     size_t input_count);

/* Draws the picture; the file appears whole or not at all. An exit status, said if not CLI_DONE. */
int cli_figure_write(const cli_figure_options *options, const cli_picture *picture);

#endif
