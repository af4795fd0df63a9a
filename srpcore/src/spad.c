/* SPDX-License-Identifier: Apache-2.0 */
/* GMAT's own interpolation of SPAD tables (its class SPADFileReader, R2020a). */
#include "error.h"

#include <srp/const.h>
#include <srp/spad.h>

#include <math.h>
#include <stdlib.h>

struct srp_spad {
    long columns, rows; /* steps of azimuth and elevation */
    int points;         /* along each side of the stencil: 2 or 4 */
    srp_vec3 *nodes;    /* (columns + 1, rows + 1) */
};

void srp_spad_destroy(srp_spad *spad) {
    if (spad != NULL) {
        free(spad->nodes);
        free(spad);
    }
}

/* Lagrange's weights of nodes 0 .. count-1 at x, and their slopes. */
static void lagrange(int count, double x, double *weight, double *slope) {
    for (int i = 0; i < count; ++i) {
        weight[i] = 1.0;
        slope[i] = 0.0;
        for (int j = 0; j < count; ++j) {
            if (j != i) {
                const double k = 1.0 / (i - j);
                slope[i] = slope[i] * (x - j) * k + weight[i] * k;
                weight[i] *= (x - j) * k;
            }
        }
    }
}

/* Of column -1 .. columns + 1 and row -1 .. rows + 1. */
static const srp_vec3 *node_at(const srp_spad *s, long column, long row) {
    column += column < 0 ? s->columns : column > s->columns ? -s->columns : 0;
    if (row < 0 || row > s->rows) {
        row = row < 0 ? -row : 2 * s->rows - row;
        column += column > s->columns / 2 ? -s->columns / 2 : s->columns / 2;
    }
    return s->nodes + column * (s->rows + 1) + row;
}

srp_status srp_spad_eval(const srp_spad *table, srp_vec3 s, srp_vec3 *f, double df[3][3],
                         srp_error *error) {
    if (!srp_vec3_is_finite(s)) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "a direction to the Sun that is not finite");
    }
    const double cosine = hypot(s.x, s.y);
    const double az = atan2(s.y, s.x), el = atan2(s.z, cosine);
    const double per_az = (double)table->columns / (2.0 * SRP_PI),
                 per_el = (double)table->rows / SRP_PI;
    const double u = (az + SRP_PI) * per_az, v = (el + 0.5 * SRP_PI) * per_el;
    const int n = table->points, before = n / 2 - 1;
    const long column = (long)fmin(floor(u), (double)table->columns - 1.0) - before;
    long row = (long)fmin(floor(v), (double)table->rows - 1.0) - before;
    if (table->columns % 2 != 0) {
        row = row < 0 ? 0 : row + n > table->rows + 1 ? table->rows + 1 - n : row;
    }
    double wu[4], du[4], wv[4], dv[4];
    lagrange(n, u - (double)column, wu, du);
    lagrange(n, v - (double)row, wv, dv);
    srp_vec3 value = {0, 0, 0}, by_az = {0, 0, 0}, by_el = {0, 0, 0};
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const srp_vec3 node = *node_at(table, column + i, row + j);
            value = srp_vec3_add_scaled(value, wu[i] * wv[j], node);
            by_az = srp_vec3_add_scaled(by_az, du[i] * wv[j] * per_az, node);
            by_el = srp_vec3_add_scaled(by_el, wu[i] * dv[j] * per_el, node);
        }
    }
    if (!srp_vec3_is_finite(value)) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "a node of the table is not finite");
    }
    *f = value;
    if (df != NULL) {
        /* At a pole, where azimuth means nothing, its part is left out. */
        const double k = cosine > 1e-12 ? 1.0 / cosine : 0.0;
        const double ca = cos(az), sa = sin(az);
        const double along[3] = {-sa * k, ca * k, 0.0};
        const double up[3] = {-s.z * ca, -s.z * sa, cosine};
        for (int j = 0; j < 3; ++j) {
            df[0][j] = by_az.x * along[j] + by_el.x * up[j];
            df[1][j] = by_az.y * along[j] + by_el.y * up[j];
            df[2][j] = by_az.z * along[j] + by_el.z * up[j];
        }
    }
    return SRP_OK;
}

srp_status srp_spad_create(const srp_table *table, bool cubic, srp_spad **out, srp_error *error) {
    const srp_grid grid = srp_table_grid(table);
    if (!srp_table_is_complete(table) || (cubic && (grid.az_count < 5 || grid.el_count < 4))) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "GMAT's interpolation needs a complete table%s",
                        cubic ? " of 4 x 4 nodes or more" : "");
    }
    srp_spad *s = calloc(1, sizeof *s);
    if (s != NULL) {
        s->columns = (long)grid.az_count - 1;
        s->rows = (long)grid.el_count - 1;
        s->points = cubic ? 4 : 2;
        s->nodes = malloc(srp_grid_node_count(grid) * sizeof *s->nodes);
    }
    if (s == NULL || s->nodes == NULL) {
        srp_spad_destroy(s);
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a look-up table");
    }
    for (uint32_t i = 0; i < grid.az_count; ++i) {
        for (uint32_t j = 0; j < grid.el_count; ++j) {
            s->nodes[(size_t)i * grid.el_count + j] = srp_table_node(table, i, j)->f;
        }
    }
    *out = s;
    return SRP_OK;
}
