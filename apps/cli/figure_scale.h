/* SPDX-License-Identifier: Apache-2.0 */
/* What the axes and colours of a figure span, and where their marks are. */
#ifndef SRP_CLI_FIGURE_SCALE_H
#define SRP_CLI_FIGURE_SCALE_H

#include "figure.h"

/* What the axis and the colours of a row span: its least and largest value over all columns, or
 * from 0 on where it has one value to rounding. */
typedef struct cli_scale {
    double low, high;
    bool is_signed;
    bool is_flat; /* one value everywhere ... */
    double value; /* ... this one */
} cli_scale;

/* Space between marks on an axis that gives about `count` of them: 1, 2 or 5 times a power of 10.
 */
double cli_figure_step(double range, int count);
/* What a row's values span over all columns. */
cli_scale cli_figure_scale(const cli_picture *picture, size_t row);
/* The ends of an axis for it, which begins and ends at marks; returns the space between them. */
double cli_figure_axis(cli_scale scale, double *low, double *high);
enum { CLI_FLAT_SIZE = 64 };
/* What is written beside a flat field, "26 everywhere"; empty beside others. Returns `text`. */
const char *cli_figure_flat_words(cli_scale scale, char text[CLI_FLAT_SIZE]);

#endif
