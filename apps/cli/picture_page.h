/* SPDX-License-Identifier: Apache-2.0 */
/* The page of a picture: words, scale and legend about two panels that OpenGL has drawn. */
#ifndef SRP_CLI_PICTURE_PAGE_H
#define SRP_CLI_PICTURE_PAGE_H

#include "palette.h"
#include "picture.h"

#include <srp/render.h>

#include <cairo.h>

enum { CLI_PANELS = 2, CLI_MARKS_MAX = 5 };

/* A word beside the tip of an arrow. */
typedef struct cli_mark {
    const char *word;
    srp_vec3 from, to; /* of the arrow [m] */
    srp_render_colour colour;
} cli_mark;

/* A part of the page [px], and what is in it. */
typedef struct cli_panel_view {
    int x, y, width, height;
    char caption[128], brief[96]; /* the second where there is no room for the first */
    srp_render_camera camera;
    cli_mark marks[CLI_MARKS_MAX];
    size_t mark_count;
} cli_panel_view;

typedef struct cli_page {
    const cli_portrait *portrait;
    double unit; /* [px] of the page for one of a page 1600 wide: sizes of words and lines */
    cli_panel_view panel[CLI_PANELS];
    cli_palette palette; /* with values on the facets */
    double value_high;   /* that the last colour stands for; the first stands for 0 */
} cli_page;

/* Places the panels. */
void cli_page_lay_out(cli_page *page);
/* Room for words at the tips of arrows, at either side of a panel, above and below [px]. */
void cli_page_margins(const cli_page *page, double *across, double *along);
/* Words, frames, legend: all but what is in the panels, and what goes over them. */
void cli_page_draw(const cli_page *page, cairo_t *to);

#endif
