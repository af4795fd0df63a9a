/* SPDX-License-Identifier: Apache-2.0 */
/* The numbers of a picture in words: below it, and on standard output. */
#include "picture.h"

#include <math.h>
#include <stdio.h>

/* Without what is rounding beside the whole. */
static double tidy(double value, double whole) {
    return fabs(value) > 1e-12 * whole ? value : 0.0;
}

void cli_portrait_words(const cli_portrait *portrait, char text[2][CLI_PORTRAIT_WORDS]) {
    const srp_response *r = &portrait->response;
    double size = srp_vec3_norm(r->f);
    snprintf(text[0], CLI_PORTRAIT_WORDS, "Direct light: f = (%.4g, %.4g, %.4g) m², |f| = %.4g m²",
             tidy(r->f.x, size), tidy(r->f.y, size), tidy(r->f.z, size), size);
    snprintf(text[1], CLI_PORTRAIT_WORDS, "force at 1 au %.4g N; lit area %.4g m²",
             portrait->pressure * size, r->lit_area);
}
