/* SPDX-License-Identifier: Apache-2.0 */
/* Linear in azimuth and elevation, cell by cell. */
#include "interp_locate.h"

static srp_status prepare(srp_interp *interp, srp_error *error) {
    (void)error;
    srp_interp_fit_slopes(interp);
    srp_interp_repeat_columns(interp);
    return SRP_OK;
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
    const double el = interp->rows_per_rad;
    /* Along azimuth the lower row counts by `low`, the upper one by `high`. With a pole at one of
     * them, which is the same for both columns, the other's share is its distance in rows, over
     * the same cosine: finite, however close the pole is. */
    const double az = interp->columns_per_rad / (place->cos_el > 0.0 ? place->cos_el : 1.0);
    const double rows = sign != 0 ? srp_interp_theta(place) * el : 0.0;
    const double low = az * (sign > 0 ? rows : sign < 0 ? 0.0 : 1.0 - q);
    const double high = az * (sign < 0 ? rows : sign > 0 ? 0.0 : q);
    for (size_t k = 0; k < width; ++k) {
        by_el[k] = el * ((1.0 - p) * (a[width + k] - a[k]) + p * (b[width + k] - b[k]));
        by_az[k] = low * (b[k] - a[k]) + high * (b[width + k] - a[width + k]);
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

/* The nodes at (i, j) and (i + 1, j). */
SRP_CLONE_PART void corners(const srp_interp *interp, const srp_interp_place *place,
                            const double **a, const double **b) {
    srp_interp_stencil at = srp_interp_stencil_of(interp, place->i, place->j, interp->width);
    *a = at.first + at.column + interp->width;
    *b = *a + at.column;
}

static void eval_slopes(const srp_interp *interp, const srp_vec3 *s,
                        srp_interp_jacobian *jacobian) {
    srp_interp_place place;
    const double *a, *b;
    if (srp_interp_locate(interp, s, &place)) {
        corners(interp, &place, &a, &b);
        slopes(interp, &place, a, b, jacobian);
    }
}

SRP_TARGET_CLONES
static bool eval(const srp_interp *interp, const srp_vec3 *s, const srp_interp_target *to) {
    srp_interp_place place;
    double value[SRP_INTERP_WIDTH_FT];
    const double *a, *b;
    if (!srp_interp_locate(interp, s, &place)) {
        return false;
    }
    corners(interp, &place, &a, &b);
    if (interp->width == SRP_INTERP_WIDTH_F) {
        values(&place, a, b, SRP_INTERP_WIDTH_F, value);
    } else {
        values(&place, a, b, SRP_INTERP_WIDTH_FT, value);
    }
    srp_interp_give_value(interp, value, to);
    if (to->jacobian != NULL) {
        eval_slopes(interp, s, to->jacobian);
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
