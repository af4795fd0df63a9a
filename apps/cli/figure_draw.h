/* SPDX-License-Identifier: Apache-2.0 */
/* Panels of a figure on an open page of PLplot. */
#ifndef SRP_CLI_FIGURE_DRAW_H
#define SRP_CLI_FIGURE_DRAW_H

#include "figure.h"
#include "figure_scale.h"
#include "palette.h"

#include <plplot/plplot.h>

/* Colours of PLplot's map 0. */
enum { INK_PAPER = 0, INK_BLACK = 1, INK_GREY = 2 };

/* A part of the page, in shares of its width and height. */
typedef struct cli_panel {
    double left, right, bottom, top;
} cli_panel;

/* How surfaces are drawn. */
typedef struct cli_look {
    double view[2]; /* azimuth and elevation of the eye [deg] */
    uint32_t
        steps_max;  /* facets along an angle; of finer tables every second node, or third, ... */
    bool is_titled; /* the caller says which fields are flat */
} cli_look;

/* The plane that the box of a surface is drawn on, seen like this (figure_surface.c). */
void cli_figure_window(const double view[2], double *left, double *right, double *bottom,
                       double *top);
/* Loads the colours that stand for `low` to `high` on this scale into map 1. */
void cli_figure_colours(cli_scale scale, double low, double high);
/* Lines of this width, in pixels of a page that is as wide as by default. */
void cli_figure_pen(double width);
/* `text` with PLplot's own escapes masked; freed by the caller. NULL without memory. */
char *cli_figure_text(const char *text);

/* Each draws one field; false without memory. `rows`: of colours on a map, twice as many columns.
 */
bool cli_figure_surface(const cli_panel *panel, const cli_picture *picture, size_t column,
                        size_t row, cli_scale scale, const cli_look *look);
bool cli_figure_map(const cli_panel *panel, const cli_picture *picture, size_t column, size_t row,
                    cli_scale scale, int rows, int levels, bool mollweide);
/* The colours of a scale, as a bar with numbers at its right. */
void cli_figure_bar(const cli_panel *panel, cli_scale scale);

#endif
