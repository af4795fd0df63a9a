/* SPDX-License-Identifier: Apache-2.0 */
/*
 * From a direction to its place in the grid. Internal; compiled into the look-up of each scheme.
 *
 * Both angles are twice an arc tangent of at most 45 degrees: tan(el / 2) = z / (1 + h) and, in the
 * half of the turn where x > 0, tan(az / 2) = y / (h + x), with h the distance from the axis. One
 * root and two quotients that do not wait for each other; arc tangents from a table of polynomials,
 * one for each 1/64 of the argument. Nothing is branched on that a random direction would make the
 * processor guess wrong. What is lost is a few roundings of the angle.
 */
#ifndef SRP_SRC_INTERP_LOCATE_H
#define SRP_SRC_INTERP_LOCATE_H

#include "clones.h"
#include "interp_internal.h"

#include <math.h>

/* Row SRP_INTERP_ARC_ONE + k: k, and coefficients of powers 0 to 6 of x - k in atan(x / 64), |x -
 * k|
 * <= 1/2: a polynomial through Chebyshev's points, right to 5e-17; the middle one is odd. */
enum { SRP_INTERP_ARC_ONE = 64, SRP_INTERP_ARCS = 129, SRP_INTERP_ARC_SIZE = 8 };
extern const double srp_interp_arc[SRP_INTERP_ARCS][SRP_INTERP_ARC_SIZE];

/* Arc tangent [rad] of x / 64, x in [-64, 64] but for a few roundings. */
SRP_CLONE_PART double srp_interp_atan(double x) {
    const double *a = srp_interp_arc[SRP_INTERP_ARC_ONE + lrint(x)];
    const double d = x - a[0], dd = d * d;
    return ((a[1] + a[2] * d) + dd * (a[3] + a[4] * d)) + dd * dd * ((a[5] + a[6] * d) + dd * a[7]);
}

/* `u` steps from the first node: cell, of `count`, and place in it. */
SRP_CLONE_PART uint32_t srp_interp_cell(double u, uint32_t count, double *rest) {
    const int last = (int)count - 1, whole = (int)u, cell = whole > last ? last : whole;
    *rest = u - cell;
    return (uint32_t)cell;
}

/* False unless `s` is a unit vector (to 1e-9, as srp_prepared_respond() takes it). Roots and
 * quotients wait for as little as can be: that is what a look-up spends its time on. */
SRP_CLONE_PART bool srp_interp_locate(const srp_interp *interp, const srp_vec3 *s,
                                      srp_interp_place *place) {
    const double square = s->x * s->x + s->y * s->y;
    const double excess = square + s->z * s->z - 1.0;
    if (!(fabs(excess) <= 2e-9)) {
        return false;
    }
    const double unit = 1.0 - 0.5 * excess, norm = 1.0 + 0.5 * excess;
    /* Closer to a pole than the root of this, squares of coordinates lose digits; nothing changes
     * there, and azimuth is 0. */
    const double at_pole = 1e-300;
    const bool at = !(square > at_pole);
    const double x = at ? 1.0 : s->x, y = at ? 0.0 : s->y, h = at ? 0.0 : sqrt(square);
    const double az = srp_interp_atan(SRP_INTERP_ARC_ONE * y / (h + fabs(x)));
    const double el = srp_interp_atan(SRP_INTERP_ARC_ONE * s->z / (norm + h));
    const int half = 2 * (x < 0.0) + (y < 0.0);
    place->i = srp_interp_cell(interp->az_base[half] + interp->az_scale[half] * az, interp->columns,
                               &place->p);
    place->j = srp_interp_cell(interp->el_base + interp->el_scale * el, interp->rows, &place->q);
    place->s = srp_vec3_make(s->x * unit, s->y * unit, s->z * unit);
    place->cos_el = h * unit;
    return true;
}

/* In the cells around a pole -1 (south) or 1 (north), else 0. */
SRP_CLONE_PART int srp_interp_pole_at(const srp_interp *interp, const srp_interp_place *place) {
    if (place->j > 0 && place->j < interp->rows - 1) {
        return 0;
    }
    return place->j > 0 || (interp->rows == 1 && place->s.z > 0.0) ? 1 : -1;
}

/* Distance from the nearest pole [rad], without loss near it. */
SRP_CLONE_PART double srp_interp_theta(const srp_interp_place *place) {
    return 2.0 * srp_interp_atan(SRP_INTERP_ARC_ONE * place->cos_el / (1.0 + fabs(place->s.z)));
}

/* Cosine and sine of azimuth. */
SRP_CLONE_PART void srp_interp_turn(const srp_interp_place *place, double *cosine, double *sine) {
    const bool at = !(place->cos_el > 0.0);
    const double inverse = 1.0 / (at ? 1.0 : place->cos_el);
    *cosine = at ? 1.0 : place->s.x * inverse;
    *sine = at ? 0.0 : place->s.y * inverse;
}

/* Rows of a Jacobian from derivatives along azimuth and elevation, and the linear part's own. */
SRP_CLONE_PART void srp_interp_assemble(const srp_interp *interp, const srp_interp_place *place,
                                        const double *by_az, const double *by_el, size_t first,
                                        double rows[3][3]) {
    const double(*linear)[SRP_INTERP_WIDTH_FT] = interp->linear;
    const srp_vec3 s = place->s;
    double cos_az, sin_az;
    srp_interp_turn(place, &cos_az, &sin_az);
    const srp_vec3 el = srp_vec3_make(-s.z * cos_az, -s.z * sin_az, place->cos_el);
    for (size_t r = 0; r < 3; ++r) {
        size_t k = first + r;
        double mx = linear[1][k], my = linear[2][k], mz = linear[3][k];
        double along = mx * s.x + my * s.y + mz * s.z;
        rows[r][0] = by_el[k] * el.x - by_az[k] * sin_az + (mx - along * s.x);
        rows[r][1] = by_el[k] * el.y + by_az[k] * cos_az + (my - along * s.y);
        rows[r][2] = by_el[k] * el.z + (mz - along * s.z);
    }
}

SRP_CLONE_PART void srp_interp_give_value(const srp_interp *interp, const double *value,
                                          const srp_interp_target *to) {
    *to->f = srp_vec3_make(value[0], value[1], value[2]);
    if (to->t != NULL) {
        *to->t = interp->has_moment ? srp_vec3_make(value[3], value[4], value[5])
                                    : srp_vec3_make(0.0, 0.0, 0.0);
    }
}

SRP_CLONE_PART void srp_interp_give_slopes(const srp_interp *interp, const srp_interp_place *place,
                                           const double *by_az, const double *by_el,
                                           srp_interp_jacobian *jacobian) {
    srp_interp_jacobian result;
    srp_interp_assemble(interp, place, by_az, by_el, 0, result.df);
    if (interp->has_moment) {
        srp_interp_assemble(interp, place, by_az, by_el, SRP_INTERP_T, result.dt);
    } else {
        for (int k = 0; k < 9; ++k) {
            result.dt[k / 3][k % 3] = 0.0;
        }
    }
    *jacobian = result;
}

#endif
