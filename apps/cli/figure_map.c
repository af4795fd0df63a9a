/* SPDX-License-Identifier: Apache-2.0 */
/* A field as a flat map with contours. */
#include "figure_draw.h"
#include "map_labels.h"

#include <srp/const.h>

#include <math.h>

enum { LINES = 8 };

typedef struct map {
    PLINT nx, ny;
    PLFLT **z;
    PLcGrid2 at;
} map;

static void map_free(map *m) {
    plFree2dGrid(m->z, m->nx, m->ny);
    plFree2dGrid(m->at.xg, m->nx, m->ny);
    plFree2dGrid(m->at.yg, m->nx, m->ny);
}

static void map_make(map *m, srp_grid grid, const double *value, cli_scale scale, bool mollweide) {
    double dust = 1e-12 * (scale.high - scale.low); /* would draw contours of 0 over the dark */
    m->nx = (PLINT)grid.az_count;
    m->ny = (PLINT)grid.el_count;
    m->at.nx = m->nx;
    m->at.ny = m->ny;
    plAlloc2dGrid(&m->z, m->nx, m->ny);
    plAlloc2dGrid(&m->at.xg, m->nx, m->ny);
    plAlloc2dGrid(&m->at.yg, m->nx, m->ny);
    for (PLINT i = 0; i < m->nx; ++i) {
        for (PLINT j = 0; j < m->ny; ++j) {
            double z = value[(size_t)i * grid.el_count + (size_t)j];
            m->z[i][j] = fabs(z) > dust ? z : 0.0;
            cli_map_place(srp_grid_azimuth_deg(grid, (uint32_t)i),
                          srp_grid_elevation_deg(grid, (uint32_t)j), mollweide, &m->at.xg[i][j],
                          &m->at.yg[i][j]);
        }
    }
}

/* A parallel (of elevation) or a meridian of the map, as a line. */
static void draw_line(double from, double to, double fixed, bool meridian, bool mollweide) {
    enum { POINTS = 91 };
    PLFLT x[POINTS], y[POINTS];
    for (int k = 0; k < POINTS; ++k) {
        double moving = from + (to - from) * k / (POINTS - 1);
        cli_map_place(meridian ? fixed : moving, meridian ? moving : fixed, mollweide, &x[k],
                      &y[k]);
    }
    plline(POINTS, x, y);
}

/* A number with a thin rim of paper, so that nothing but its strokes is hidden. */
static void put_halo(double x, double y, const char *text) {
    enum { AROUND = 12 };
    const double reach = 0.9; /* in degrees of the map */
    plcol0(INK_PAPER);
    for (int k = 0; k < AROUND; ++k) {
        double turn = 2.0 * SRP_PI * k / AROUND;
        plptex(x + 2.0 * reach * cos(turn), y + reach * sin(turn), 1.0, 0.0, 0.5, text);
    }
    plcol0(INK_BLACK);
    plptex(x, y, 1.0, 0.0, 0.5, text);
}

/* Azimuths on the equator and elevations beside the rim. */
static void label_ellipse(void) {
    char text[8];
    plschr(0.0, 0.85);
    for (int az = -90; az <= 90; az += 90) {
        snprintf(text, sizeof text, "%d", az);
        put_halo(az, 0.0, text);
    }
    for (int el = -45; el <= 45; el += 90) {
        double x, y;
        cli_map_place(-180.0, el, true, &x, &y);
        snprintf(text, sizeof text, "%d", el);
        plptex(x - 5.0, y, 1.0, 0.0, 1.0, text);
    }
    plschr(0.0, 1.0);
}

static void draw_frame(const char *name, cli_scale scale, bool mollweide) {
    plcol0(INK_GREY);
    cli_figure_pen(0.5);
    for (int az = -90; az <= 90; az += 90) {
        draw_line(-90.0, 90.0, az, true, mollweide);
    }
    for (int el = -45; el <= 45; el += 45) {
        draw_line(-180.0, 180.0, el, false, mollweide);
    }
    plcol0(INK_BLACK);
    cli_figure_pen(1.0);
    if (mollweide) {
        draw_line(-90.0, 90.0, -180.0, true, true);
        draw_line(-90.0, 90.0, 180.0, true, true);
        label_ellipse();
    } else {
        plbox("bcnst", 90.0, 3, "bcnstv", 45.0, 3);
        plmtex("b", 3.0, 0.5, 0.5, "az [deg]");
        plmtex("l", 3.6, 0.5, 0.5, "el [deg]");
    }
    char words[CLI_FLAT_SIZE], title[256];
    cli_figure_flat_words(scale, words);
    snprintf(title, sizeof title, "%s%s%s", name, scale.is_flat ? ": " : "", words);
    plmtex("t", 1.5, 0.5, 0.5, title);
}

/* The value between nodes, by lines along both angles. */
static double value_at(const map *m, double az_deg, double el_deg) {
    double i = (az_deg + 180.0) / 360.0 * (m->nx - 1), j = (el_deg + 90.0) / 180.0 * (m->ny - 1);
    PLINT i0 = (PLINT)fmin(floor(i), m->nx - 2), j0 = (PLINT)fmin(floor(j), m->ny - 2);
    double t = i - i0, u = j - j0;
    return (1.0 - u) * ((1.0 - t) * m->z[i0][j0] + t * m->z[i0 + 1][j0]) +
           u * ((1.0 - t) * m->z[i0][j0 + 1] + t * m->z[i0 + 1][j0 + 1]);
}

/* Does the field go up and down along parallels, by a good part of a step of contours, more often
 * than the shape of a spacecraft makes it? */
static bool is_restless(const map *m, double step) {
    const double of_shapes = 6.0;
    double bends = 0.0;
    for (PLINT j = 1; j + 1 < m->ny; ++j) {
        for (PLINT i = 1; i + 1 < m->nx; ++i) {
            double before = m->z[i][j] - m->z[i - 1][j], after = m->z[i + 1][j] - m->z[i][j];
            bends += before * after < 0.0 && fmin(fabs(before), fabs(after)) > 0.02 * step;
        }
    }
    return bends > fmax(of_shapes, 0.1 * (double)(m->nx - 2)) * (double)(m->ny - 2);
}

static double value_of(const void *field, double az_deg, double el_deg) {
    return value_at(field, az_deg, el_deg);
}

static void label_contours(const map *m, const double *level, int count, double step,
                           bool mollweide) {
    cli_map_labels labels;
    const cli_map_field field = {value_of, m, mollweide};
    cli_map_label_contours(&field, level, count, step, &labels);
    plschr(0.0, CLI_MAP_LABEL_SIZE);
    for (int k = 0; k < labels.count; ++k) {
        put_halo(labels.at[k].x, labels.at[k].y, labels.at[k].text);
    }
    plschr(0.0, 1.0);
}

static void draw_contours(const map *m, cli_scale scale, bool mollweide) {
    double level[4 * LINES], step = cli_figure_step(scale.high - scale.low, LINES);
    int count = 0;
    /* By whole numbers of steps: sums of them would miss 0 by rounding, and be labelled so. */
    double bit =
        1e-9 * (scale.high - scale.low); /* nothing lies beyond the least and the largest */
    for (double k = ceil((scale.low + bit) / step);
         k * step < scale.high - bit && count < 4 * LINES; ++k) {
        level[count++] = k == 0.0 ? 0.0 : k * step;
    }
    /* A contour that is as restless as noise is a tangle with labels: without. */
    bool tangle = is_restless(m, step);
    plcol0(INK_BLACK);
    pl_setcontlabelparam(0.008, 0.6, 0.1, 0);
    cli_figure_pen(tangle ? 0.2 : 0.6);
    plcont((PLFLT_MATRIX)m->z, m->nx, m->ny, 1, m->nx, 1, m->ny, level, count, pltr2,
           (PLPointer)&m->at);
    cli_figure_pen(1.0);
    if (!tangle) {
        label_contours(m, level, count, step, mollweide);
    }
}

static int level_of(double value, cli_scale scale, int levels) {
    double at = (value - scale.low) / (scale.high - scale.low) * levels;
    return (int)fmin(fmax(at, 0.0), levels - 1.0);
}

/* A parallel on the map: it is straight, and azimuth is laid off in proportion. */
typedef struct parallel {
    double shrink, y;
} parallel;

static parallel parallel_at(double el_deg, bool mollweide) {
    parallel p;
    cli_map_place(1.0, el_deg, mollweide, &p.shrink, &p.y);
    return p;
}

/* The part of a row between two azimuths, in one colour. */
static void fill_run(double az0, double az1, parallel low, parallel high, double colour) {
    const PLFLT x[4] = {az0 * low.shrink, az1 * low.shrink, az1 * high.shrink, az0 * high.shrink};
    const PLFLT y[4] = {low.y, low.y, high.y, high.y};
    plcol1(colour);
    plfill(4, x, y);
}

/* Rows of equal height; along each, what has one colour is one piece: however fine the table is, a
 * figure stays of a size. */
static void shade(const map *m, cli_scale scale, int rows, int levels, bool mollweide) {
    int columns = 2 * rows;
    plpsty(0);
    for (int j = 0; j < rows; ++j) {
        double el0 = -90.0 + 180.0 * j / rows, el1 = -90.0 + 180.0 * (j + 1) / rows;
        parallel low = parallel_at(el0, mollweide), high = parallel_at(el1, mollweide);
        int begin = 0, level = -1;
        for (int i = 0; i <= columns; ++i) {
            double az = -180.0 + 360.0 * (i + 0.5) / columns;
            int next =
                i < columns ? level_of(value_at(m, az, 0.5 * (el0 + el1)), scale, levels) : -1;
            if (next != level && i > 0) {
                fill_run(-180.0 + 360.0 * begin / columns, -180.0 + 360.0 * i / columns, low, high,
                         (level + 0.5) / levels);
                begin = i;
            }
            level = next;
        }
    }
}

bool cli_figure_map(const cli_panel *panel, const cli_picture *picture, size_t column, size_t row,
                    cli_scale scale, int rows, int levels, bool mollweide) {
    map m;
    map_make(&m, picture->grid[column], picture->field[column][row].value, scale, mollweide);
    cli_figure_colours(scale, scale.low, scale.high);
    plvpor(panel->left, panel->right, panel->bottom, panel->top);
    plwind(-180.0, 180.0, -90.0, 90.0);
    shade(&m, scale, rows, levels, mollweide);
    if (!scale.is_flat) {
        draw_contours(&m, scale, mollweide);
    }
    draw_frame(picture->name[row], scale, mollweide);
    map_free(&m);
    return true;
}

void cli_figure_bar(const cli_panel *panel, cli_scale scale) {
    cli_figure_colours(scale, scale.low, scale.high);
    plvpor(panel->left, panel->right, panel->bottom, panel->top);
    plwind(0.0, 1.0, scale.low, scale.high);
    double range = scale.high - scale.low;
    for (int k = 0; k < CLI_PALETTE_SIZE; ++k) {
        double low = scale.low + range * k / CLI_PALETTE_SIZE;
        double high = fmin(low + 1.5 * range / CLI_PALETTE_SIZE, scale.high);
        const PLFLT x[4] = {0.0, 1.0, 1.0, 0.0}, y[4] = {low, low, high, high};
        plcol1((k + 0.5) / CLI_PALETTE_SIZE);
        plfill(4, x, y);
    }
    plcol0(INK_BLACK);
    plbox("bc", 0.0, 0, "bcmstv", cli_figure_step(range, 5), 0);
}
