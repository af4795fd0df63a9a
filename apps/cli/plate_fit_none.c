/* SPDX-License-Identifier: Apache-2.0 */
/* In place of plate_fit.c and plate_search.c where GSL is missing. */
#include "plate_fit.h"

bool cli_plate_fit_exists(void) {
    return false;
}

cli_fit_status cli_plate_fit_solve(const cli_samples *samples, const srp_vec3 *normals,
                                   size_t count, const cli_fit_watch *watch, cli_plate_fit *out) {
    (void)samples;
    (void)normals;
    (void)count;
    (void)watch;
    (void)out;
    return CLI_FIT_AMBIGUOUS;
}

cli_fit_status cli_plate_normals_search(const cli_samples *search, const cli_samples *all,
                                        size_t count, const cli_fit_watch *watch,
                                        srp_vec3 *normals) {
    (void)search;
    (void)all;
    (void)count;
    (void)watch;
    (void)normals;
    return CLI_FIT_AMBIGUOUS;
}
