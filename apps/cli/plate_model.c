/* SPDX-License-Identifier: Apache-2.0 */
/* What of a fit needs no algebra, and is there in a build without GSL, too. */
#include "plate_fit.h"

#include <math.h>
#include <stdlib.h>

enum { U = CLI_FIT_UNKNOWNS };

srp_vec3 cli_plates_force(const srp_plate *plates, size_t count, srp_vec3 s) {
    srp_vec3 f = {0.0, 0.0, 0.0};
    for (size_t k = 0; k < count; ++k) {
        double c = srp_vec3_dot(plates[k].normal, s);
        if (c > 0.0) {
            double rho_s = plates[k].optics.rho_s, rho_d = plates[k].optics.rho_d;
            double ac = plates[k].area * c;
            f = srp_vec3_add_scaled(f, -ac * (1.0 - rho_s), s);
            f = srp_vec3_add_scaled(f, -2.0 * ac * (rho_s * c + rho_d / 3.0), plates[k].normal);
        }
    }
    return f;
}

void cli_plate_fit_free(cli_plate_fit *fit) {
    free(fit->plates);
    free(fit->covariance);
    free(fit->model);
    *fit = (cli_plate_fit){0, NULL, NULL, 0.0, false, NULL};
}

double cli_plate_fit_sigma(const cli_plate_fit *fit, size_t plate, int unknown) {
    size_t at = U * plate + (size_t)unknown;
    return sqrt(fmax(fit->covariance[at * U * fit->count + at], 0.0));
}
