/* SPDX-License-Identifier: Apache-2.0 */
#include "figure_scale.h"

#include <math.h>
#include <stdio.h>

double cli_figure_step(double range, int count) {
    double rough = range / count, power = pow(10.0, floor(log10(rough)));
    double lead = rough / power;
    return power * (lead < 1.5 ? 1.0 : lead < 3.5 ? 2.0 : lead < 7.5 ? 5.0 : 10.0);
}

double cli_figure_axis(cli_scale scale, double *low, double *high) {
    double step = cli_figure_step(scale.high - scale.low, 4);
    *low = step * floor(scale.low / step + 1e-9);
    *high = step * ceil(scale.high / step - 1e-9);
    return step;
}

/* Least and largest value of a row. */
static void find_range(const cli_picture *picture, size_t row, double *low, double *high) {
    *low = INFINITY;
    *high = -INFINITY;
    for (size_t c = 0; c < picture->columns; ++c) {
        size_t nodes = srp_grid_node_count(picture->grid[c]);
        for (size_t k = 0; k < nodes; ++k) {
            *low = fmin(*low, picture->field[c][row].value[k]);
            *high = fmax(*high, picture->field[c][row].value[k]);
        }
    }
}

/* The largest length of a component: beside it another may be nothing but rounding. */
static double component_reach(const cli_picture *picture) {
    double reach = 0.0, low, high;
    for (size_t r = 0; r < picture->rows; ++r) {
        if (picture->is_signed[r]) {
            find_range(picture, r, &low, &high);
            reach = fmax(reach, fmax(fabs(low), fabs(high)));
        }
    }
    return reach;
}

cli_scale cli_figure_scale(const cli_picture *picture, size_t row) {
    cli_scale scale = {.is_signed = picture->is_signed[row]};
    find_range(picture, row, &scale.low, &scale.high);
    double whole = scale.is_signed ? component_reach(picture) : 0.0;
    double size = fmax(fabs(scale.low), fabs(scale.high));
    scale.is_flat = !(scale.high - scale.low > fmax(1e-9 * size, 1e-13 * whole));
    if (!scale.is_flat) {
        return scale;
    }
    if (size > 1e-13 * whole) {
        scale.value = 0.5 * (scale.low + scale.high);
        scale.low = fmin(1.25 * scale.value, 0.0);
        scale.high = fmax(1.25 * scale.value, 0.0);
    } else { /* 0: on the scale of the other components */
        scale.high = whole > 0.0 ? whole : 1.0;
        scale.low = scale.is_signed ? -scale.high : 0.0;
    }
    return scale;
}

const char *cli_figure_flat_words(cli_scale scale, char text[CLI_FLAT_SIZE]) {
    text[0] = '\0';
    if (scale.is_flat) {
        snprintf(text, CLI_FLAT_SIZE, "%.6g everywhere", scale.value);
    }
    return text;
}
