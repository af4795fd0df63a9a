/* SPDX-License-Identifier: Apache-2.0 */
/* Surfaces in a build without PLplot: none. */
#include "chart_page.h"

bool viewer_page_draw(const viewer_page *page, cairo_t *cr) {
    (void)page, (void)cr;
    return false;
}

const char *viewer_page_flat_words(const viewer_page *page, char text[VIEWER_FLAT_SIZE]) {
    (void)page;
    text[0] = '\0';
    return text;
}

bool viewer_page_find(const viewer_page *page, double x, double y, uint32_t *i, uint32_t *j) {
    (void)page, (void)x, (void)y, (void)i, (void)j;
    return false;
}

void viewer_page_place(const viewer_page *page, uint32_t i, uint32_t j, double *x, double *y) {
    (void)page, (void)i, (void)j;
    *x = *y = 0.0;
}
