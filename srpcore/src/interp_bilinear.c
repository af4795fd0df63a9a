/* SPDX-License-Identifier: Apache-2.0 */
/* Linear in azimuth and elevation, cell by cell. */
#include "interp_internal.h"

#include <srp/const.h>

static srp_status prepare(srp_interp *interp, srp_error *error) {
    (void)error;
    srp_interp_fit_slopes(interp);
    srp_interp_repeat_columns(interp);
    return SRP_OK;
}

/* The slope along azimuth per rad of arc in a cell with a pole, whose node is the same for both
 * columns: finite, however close the pole is. */
static double by_az_at_pole(const srp_interp *interp, const srp_interp_place *place, double along) {
    double rows = place->theta * interp->rows_per_rad;
    return place->cos_el > 0.0 ? along * interp->columns_per_rad * (rows / place->cos_el) : 0.0;
}

/* At the pole itself the cells meet like the faces of a pyramid; the plane that fits them counts.
 * Azimuth is 0 there. */
static void plane_at_pole(const srp_interp *interp, const srp_interp_place *place, double *by_az,
                          double *by_el) {
    const srp_interp_pole *pole = srp_interp_pole_of(interp, place);
    for (size_t k = 0; k < interp->width; ++k) {
        by_az[k] = pole->slope[1][k] * interp->rows_per_rad;
        by_el[k] = -place->pole * pole->slope[0][k] * interp->rows_per_rad;
    }
}

static void eval(const srp_interp *interp, const srp_interp_place *place, double *value,
                 double *by_az, double *by_el) {
    const double *column[4];
    srp_interp_stencil(interp, place->i, place->j, column);
    size_t width = interp->width;
    double p = place->p, q = place->q;
    for (size_t k = 0; k < width; ++k) {
        double a0 = column[1][width + k], a1 = column[1][2 * width + k];
        double b0 = column[2][width + k], b1 = column[2][2 * width + k];
        value[k] = (1.0 - p) * ((1.0 - q) * a0 + q * a1) + p * ((1.0 - q) * b0 + q * b1);
        if (by_az == NULL) {
            continue;
        }
        by_el[k] = ((1.0 - p) * (a1 - a0) + p * (b1 - b0)) * interp->rows_per_rad;
        if (place->pole == 0) {
            by_az[k] =
                ((1.0 - q) * (b0 - a0) + q * (b1 - a1)) * interp->columns_per_rad / place->cos_el;
        } else {
            by_az[k] = by_az_at_pole(interp, place, place->pole > 0 ? b0 - a0 : b1 - a1);
        }
    }
    if (by_az != NULL && !(place->cos_el > 0.0)) {
        plane_at_pole(interp, place, by_az, by_el);
    }
}

const srp_interp_scheme srp_interp_bilinear = {
    .name = "bilinear",
    .summary = "linear in azimuth and elevation; continuous",
    .continuity = 0,
    .order = 2,
    .capabilities = SRP_INTERP_LOCAL,
    .steps_min = 1,
    .prepare = prepare,
    .eval = eval,
};
