/* SPDX-License-Identifier: Apache-2.0 */
#include "difference.h"

#include <math.h>

const char *const CLI_DIFFERENCE_NAME[CLI_DIFFERENCE_COUNT] = {"x", "y", "z", "length", "vector"};

static void values_of(srp_vec3 a, srp_vec3 b, double value[CLI_DIFFERENCE_COUNT]) {
    srp_vec3 d = srp_vec3_sub(b, a);
    value[CLI_DIFFERENCE_X] = d.x;
    value[CLI_DIFFERENCE_Y] = d.y;
    value[CLI_DIFFERENCE_Z] = d.z;
    value[CLI_DIFFERENCE_LENGTH] = srp_vec3_norm(b) - srp_vec3_norm(a);
    value[CLI_DIFFERENCE_VECTOR] = srp_vec3_norm(d);
}

static void add(cli_difference_row *row, const cli_direction *at, double value) {
    row->mse += at->weight * value * value;
    row->mean += at->weight * value;
    if (fabs(value) > fabs(row->largest)) {
        row->largest = value;
        row->az_deg = at->az_deg;
        row->el_deg = at->el_deg;
    }
}

cli_difference cli_difference_measure(const cli_samples *a, const srp_vec3 *b, const bool *skip) {
    cli_difference out = {.mean_a = 0.0, .mean_b = 0.0};
    double total = 0.0;
    for (size_t k = 0; k < a->count; ++k) {
        double value[CLI_DIFFERENCE_COUNT];
        if (skip != NULL && skip[k]) {
            continue;
        }
        values_of(a->value[k], b[k], value);
        for (int c = 0; c < CLI_DIFFERENCE_COUNT; ++c) {
            add(&out.row[c], &a->at[k], value[c]);
        }
        out.mean_a += a->at[k].weight * srp_vec3_norm(a->value[k]);
        out.mean_b += a->at[k].weight * srp_vec3_norm(b[k]);
        total += a->at[k].weight;
    }
    for (int c = 0; c < CLI_DIFFERENCE_COUNT; ++c) {
        out.row[c].mse /= total;
        out.row[c].mean /= total;
        out.row[c].rms = sqrt(out.row[c].mse);
    }
    out.mean_a /= total;
    out.mean_b /= total;
    return out;
}
