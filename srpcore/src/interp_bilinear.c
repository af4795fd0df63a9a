/* SPDX-License-Identifier: Apache-2.0 */
/* Linear in azimuth and elevation, cell by cell. */
#include "interp_locate.h"

static srp_status prepare(srp_interp *interp, srp_error *error) {
    (void)error;
    srp_interp_fit_slopes(interp);
    srp_interp_repeat_columns(interp);
    return SRP_OK;
}

/* The slope along azimuth per rad of arc in a cell with a pole, whose node is the same for both
 * columns: finite, however close the pole is. */
static double by_az_at_pole(const srp_interp *interp, const srp_interp_place *place, double along) {
    double rows = srp_interp_theta(place) * interp->rows_per_rad;
    return place->cos_el > 0.0 ? along * interp->columns_per_rad * (rows / place->cos_el) : 0.0;
}

/* At the pole itself the cells meet like the faces of a pyramid; the plane that fits them counts.
 * Azimuth is 0 there. */
static void plane_at_pole(const srp_interp *interp, const srp_interp_place *place, double *by_az,
                          double *by_el) {
    const int sign = srp_interp_pole_at(interp, place);
    const srp_interp_pole *pole = &interp->poles[sign > 0];
    for (size_t k = 0; k < interp->width; ++k) {
        by_az[k] = pole->slope[1][k] * interp->rows_per_rad;
        by_el[k] = -sign * pole->slope[0][k] * interp->rows_per_rad;
    }
}

static void slopes(const srp_interp *interp, const srp_interp_place *place, const double *a,
                   const double *b, srp_interp_jacobian *jacobian) {
    double by_az[SRP_INTERP_WIDTH_FT], by_el[SRP_INTERP_WIDTH_FT];
    const size_t width = interp->width;
    const double p = place->p, q = place->q;
    const int sign = srp_interp_pole_at(interp, place);
    for (size_t k = 0; k < width; ++k) {
        by_el[k] =
            ((1.0 - p) * (a[width + k] - a[k]) + p * (b[width + k] - b[k])) * interp->rows_per_rad;
        double low = b[k] - a[k], high = b[width + k] - a[width + k];
        if (sign == 0) {
            by_az[k] = ((1.0 - q) * low + q * high) * interp->columns_per_rad / place->cos_el;
        } else {
            by_az[k] = by_az_at_pole(interp, place, sign > 0 ? low : high);
        }
    }
    if (!(place->cos_el > 0.0)) {
        plane_at_pole(interp, place, by_az, by_el);
    }
    srp_interp_give_slopes(interp, place, by_az, by_el, jacobian);
}

SRP_CLONE_PART void values(const srp_interp_place *place, const double *a, const double *b,
                           size_t width, double *value) {
    const double p = place->p, q = place->q;
    const double w[4] = {(1.0 - p) * (1.0 - q), (1.0 - p) * q, p * (1.0 - q), p * q};
    for (size_t k = 0; k < width; ++k) {
        value[k] = (w[0] * a[k] + w[1] * a[width + k]) + (w[2] * b[k] + w[3] * b[width + k]);
    }
}

SRP_TARGET_CLONES
static bool eval(const srp_interp *interp, const srp_vec3 *s, const srp_interp_target *to) {
    srp_interp_place place;
    double value[SRP_INTERP_WIDTH_FT];
    if (!srp_interp_locate(interp, s, &place)) {
        return false;
    }
    srp_interp_stencil at = srp_interp_stencil_of(interp, place.i, place.j);
    const double *a = at.first + at.column + interp->width, *b = a + at.column;
    if (interp->width == SRP_INTERP_WIDTH_F) {
        values(&place, a, b, SRP_INTERP_WIDTH_F, value);
    } else {
        values(&place, a, b, SRP_INTERP_WIDTH_FT, value);
    }
    srp_interp_give_value(interp, value, to);
    if (to->jacobian != NULL) {
        slopes(interp, &place, a, b, to->jacobian);
    }
    return true;
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
