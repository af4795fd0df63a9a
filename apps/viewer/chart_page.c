/* SPDX-License-Identifier: Apache-2.0 */
#include "chart_page.h"

#include "figure_draw.h"
#include "figure_scale.h"

#include <srp/const.h>

#include <math.h>
#include <setjmp.h>

/* PLplot ends the program when it fails, unless it is led out. */
static jmp_buf way_out;

static int leave(const char *message) {
    (void)message;
    longjmp(way_out, 1);
}

static PLINT byte(double share) {
    return (PLINT)lround(255.0 * share);
}

static void open_page(const viewer_page *page, cairo_t *cr) {
    plsdev("extcairo");
    plscolbg(byte(page->paper[0]), byte(page->paper[1]), byte(page->paper[2]));
    plspage(90.0, 90.0, page->width, page->height, 0, 0);
    plscol0(INK_BLACK, byte(page->ink[0]), byte(page->ink[1]), byte(page->ink[2]));
    plscol0(INK_GREY, 120, 120, 120);
    plfontld(1);
    plinit();
    pl_cmd(PLESC_DEVINIT, cr);
    plschr(fmin(3.6, 0.0082 * fmin(page->width, 1.4 * page->height)), 1.0);
    plsmaj(0.0, 0.7);
    plsmin(0.0, 0.7);
}

/* All of the page, but for the title where a low page has no corner free for it; or as much of its
 * height as keeps the words along the axes upright, which then need room at the sides. */
static cli_panel panel_of(const viewer_page *page) {
    const double narrowest = 1.25, title = 26.0, corner = 0.08;
    double share = fmin(1.0, page->width / (narrowest * page->height));
    double side = share < 1.0 ? 0.03 : 0.0;
    double top = 0.5 + 0.5 * share;
    double covered = title / page->height - (1.0 - top) - corner * share;
    return (cli_panel){side, 1.0 - side, 0.5 - 0.5 * share, top - fmax(0.0, covered)};
}

bool viewer_page_draw(const viewer_page *page, cairo_t *cr) {
    cli_panel panel = panel_of(page);
    cli_scale scale = cli_figure_scale(page->picture, page->row);
    cli_look look = {{page->view[0], page->view[1]}, page->steps_max, true};
    volatile bool drawn = false;
    plsexit(leave);
    if (setjmp(way_out) == 0) {
        open_page(page, cr);
        pladv(0);
        drawn = cli_figure_surface(&panel, page->picture, 0, page->row, scale, &look);
        plend1();
    }
    return drawn;
}

const char *viewer_page_flat_words(const viewer_page *page, char text[VIEWER_FLAT_SIZE]) {
    _Static_assert((int)VIEWER_FLAT_SIZE == (int)CLI_FLAT_SIZE, "one is written into the other");
    return cli_figure_flat_words(cli_figure_scale(page->picture, page->row), text);
}

/* ---- where things are ---- */

typedef struct place {
    double x, y, depth; /* [px], [px], larger in front */
} place;

/* What is the same for all nodes of a page. */
typedef struct projection {
    cli_panel panel;
    double low, high;                        /* of the axis */
    double x0, x1, y0, y1;                   /* of the window */
    double sin_az, cos_az, sin_alt, cos_alt; /* of the eye */
} projection;

static projection projection_of(const viewer_page *page) {
    projection p = {.panel = panel_of(page)};
    cli_figure_axis(cli_figure_scale(page->picture, page->row), &p.low, &p.high);
    cli_figure_window(page->view, &p.x0, &p.x1, &p.y0, &p.y1);
    double az = page->view[0] * SRP_RAD_PER_DEG, alt = page->view[1] * SRP_RAD_PER_DEG;
    p.sin_az = sin(az), p.cos_az = cos(az), p.sin_alt = sin(alt), p.cos_alt = cos(alt);
    return p;
}

/* As plw3d() and the window of cli_figure_surface() put it. */
static place place_of(const viewer_page *page, const projection *p, uint32_t i, uint32_t j) {
    srp_grid grid = page->picture->grid[0];
    double x = srp_grid_azimuth_deg(grid, i) / 360.0, y = srp_grid_elevation_deg(grid, j) / 180.0;
    double value = page->picture->field[0][page->row].value[(size_t)i * grid.el_count + j];
    double z = (value - p->low) / (p->high - p->low);
    double across = x * p->cos_az - y * p->sin_az, along = x * p->sin_az + y * p->cos_az;
    double up = along * p->sin_alt + z * p->cos_alt;
    double side = (across - p->x0) / (p->x1 - p->x0);
    return (place){page->width * (p->panel.left + (p->panel.right - p->panel.left) * side),
                   page->height *
                       (1.0 - p->panel.bottom -
                        (p->panel.top - p->panel.bottom) * (up - p->y0) / (p->y1 - p->y0)),
                   z * p->sin_alt - along * p->cos_alt};
}

bool viewer_page_find(const viewer_page *page, double x, double y, uint32_t *i, uint32_t *j) {
    const double reach = 14.0;
    srp_grid grid = page->picture->grid[0];
    const projection p = projection_of(page);
    double best = -INFINITY;
    bool found = false;
    for (uint32_t a = 0; a < grid.az_count; ++a) {
        for (uint32_t b = 0; b < grid.el_count; ++b) {
            place at = place_of(page, &p, a, b);
            double off = hypot(at.x - x, at.y - y);
            /* Nearer on the screen counts, and so does being in front. */
            double merit = at.depth - 0.1 * off;
            if (off <= reach && merit > best) {
                best = merit;
                *i = a;
                *j = b;
                found = true;
            }
        }
    }
    return found;
}

void viewer_page_place(const viewer_page *page, uint32_t i, uint32_t j, double *x, double *y) {
    const projection p = projection_of(page);
    place at = place_of(page, &p, i, j);
    *x = at.x;
    *y = at.y;
}
