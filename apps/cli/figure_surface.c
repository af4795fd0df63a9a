/* SPDX-License-Identifier: Apache-2.0 */
/* A field as a surface over azimuth and elevation. */
#include "figure_draw.h"

#include <srp/const.h>

#include <math.h>

/* Every how many-th node is drawn, so that the last one is, and that no more than `most` steps are.
 */
static uint32_t stride_of(uint32_t count, uint32_t most) {
    uint32_t steps = count - 1, stride = 1;
    while (steps % stride != 0 || steps / stride > most) {
        ++stride;
    }
    return steps / stride >= 8 ? stride : 1; /* a prime number of steps: all of them */
}

typedef struct surface {
    PLINT nx, ny;
    double *x, *y, low, high;
    PLFLT **z;
} surface;

static void surface_free(surface *s) {
    free(s->x);
    free(s->y);
    if (s->z != NULL) {
        plFree2dGrid(s->z, s->nx, s->ny);
    }
}

static bool surface_make(surface *s, srp_grid grid, const double *value, uint32_t steps_max) {
    uint32_t di = stride_of(grid.az_count, steps_max), dj = stride_of(grid.el_count, steps_max);
    *s = (surface){.nx = (PLINT)((grid.az_count - 1) / di + 1),
                   .ny = (PLINT)((grid.el_count - 1) / dj + 1),
                   .low = INFINITY,
                   .high = -INFINITY};
    s->x = calloc((size_t)s->nx, sizeof *s->x);
    s->y = calloc((size_t)s->ny, sizeof *s->y);
    plAlloc2dGrid(&s->z, s->nx, s->ny);
    if (s->x == NULL || s->y == NULL) {
        surface_free(s);
        return false;
    }
    for (PLINT i = 0; i < s->nx; ++i) {
        for (PLINT j = 0; j < s->ny; ++j) {
            uint32_t at_i = (uint32_t)i * di, at_j = (uint32_t)j * dj;
            double z = value[(size_t)at_i * grid.el_count + at_j];
            s->x[i] = srp_grid_azimuth_deg(grid, at_i);
            s->y[j] = srp_grid_elevation_deg(grid, at_j);
            s->z[i][j] = z;
            s->low = fmin(s->low, z);
            s->high = fmax(s->high, z);
        }
    }
    return true;
}

/* Height of the box whose base is 1 by 1. */
static const double BOX_HEIGHT = 1.0;

/* Elevation of the eye [deg], too little to be seen. */
static const double LOWEST_VIEW = 0.001;

/* A window that holds the box of the plot, seen like this, and its labels. */
void cli_figure_window(const double view[2], double *left, double *right, double *bottom,
                       double *top) {
    double az = view[0] * SRP_RAD_PER_DEG, alt = view[1] * SRP_RAD_PER_DEG;
    double half = 0.5 * (fabs(cos(az)) + fabs(sin(az))), base = half * sin(alt);
    *left = -half - 0.26;
    *right = half + 0.24;
    *bottom = -base - 0.20;
    *top = base + BOX_HEIGHT * cos(alt) + 0.03;
}

bool cli_figure_surface(const cli_panel *panel, const cli_picture *picture, size_t column,
                        size_t row, cli_scale scale, const cli_look *look) {
    /* PLplot draws nothing for an eye at azimuth and elevation 0. */
    const double view[2] = {look->view[0], fmax(look->view[1], LOWEST_VIEW)};
    surface s;
    if (!surface_make(&s, picture->grid[column], picture->field[column][row].value,
                      look->steps_max)) {
        return false;
    }
    if (!(s.high > s.low)) { /* colours need a range */
        s.z[0][0] += 1e-6 * (scale.high - scale.low);
        s.high = s.low + 1e-6 * (scale.high - scale.low);
    }
    /* Axes begin and end at marks; PLplot spreads the colours over the whole of them. */
    double low, high, step = cli_figure_axis(scale, &low, &high);
    cli_figure_colours(scale, low, high);
    plcol0(INK_BLACK);
    plvpor(panel->left, panel->right, panel->bottom, panel->top);
    double left, right, bottom, top;
    cli_figure_window(view, &left, &right, &bottom, &top);
    plwind(left, right, bottom, top);
    plw3d(1.0, 1.0, BOX_HEIGHT, -180.0, 180.0, -90.0, 90.0, low, high, view[1], view[0]);
    plszax(5, 0);
    plbox3("bnstu", "az [deg]", 90.0, 3, "bnstu", "el [deg]", 45.0, 3, "bcdmnstuv",
           picture->name[row], step, 0);
    plsurf3d(s.x, s.y, (PLFLT_MATRIX)s.z, s.nx, s.ny, MAG_COLOR, NULL, 0);
    if (!look->is_titled) {
        char words[CLI_FLAT_SIZE];
        plcol0(INK_BLACK);
        plptex(left + 0.06, top - 0.06, 1.0, 0.0, 0.0, cli_figure_flat_words(scale, words));
    }
    surface_free(&s);
    return true;
}
