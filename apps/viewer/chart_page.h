/* SPDX-License-Identifier: Apache-2.0 */
/* One surface on a cairo context, by PLplot, and where its nodes are on it. */
#ifndef SRP_VIEWER_CHART_PAGE_H
#define SRP_VIEWER_CHART_PAGE_H

#include "figure.h"

#include <cairo.h>
#include <stdbool.h>
#include <stdint.h>

typedef struct viewer_page {
    const cli_picture *picture;
    size_t row;
    double view[2]; /* azimuth and elevation of the eye [deg] */
    int width, height;
    uint32_t steps_max;
    double ink[3], paper[3];
} viewer_page;

/* False, with nothing drawn, where PLplot fails or this build is without it. One thread. */
bool viewer_page_draw(const viewer_page *page, cairo_t *cr);

/* What a title says of a flat field, "26 everywhere"; empty for others. Returns `text`. */
enum { VIEWER_FLAT_SIZE = 64 };
const char *viewer_page_flat_words(const viewer_page *page, char text[VIEWER_FLAT_SIZE]);

/* The node that is drawn nearest to (x, y) [px]; of those that lie on one another the one in front.
 * False: none is within 14 px. */
bool viewer_page_find(const viewer_page *page, double x, double y, uint32_t *i, uint32_t *j);
/* Where a node is drawn [px]. */
void viewer_page_place(const viewer_page *page, uint32_t i, uint32_t j, double *x, double *y);

#endif
