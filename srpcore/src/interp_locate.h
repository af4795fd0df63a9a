/* SPDX-License-Identifier: Apache-2.0 */
/*
 * From a direction to its place in the grid. Internal; compiled into the look-up of each scheme.
 *
 * Angles are arc sines of the smaller of sine and cosine, hence of angles within 45 degrees: a
 * reference angle whose sine is a multiple of 1/128, and the series of arcsin for the small rest.
 * Nothing is branched on that a random direction would make the processor guess wrong. What is
 * lost is a few roundings of the angle; near the poles, of the distance from them.
 */
#ifndef SRP_SRC_INTERP_LOCATE_H
#define SRP_SRC_INTERP_LOCATE_H

#include "clones.h"
#include "interp_internal.h"

#include <srp/const.h>

#include <math.h>

/* Sine k / 128, cosine and angle. */
enum { SRP_INTERP_REFERENCES = 92 };
extern const double srp_interp_reference[SRP_INTERP_REFERENCES][4];

/* Angle [rad] of a point of the unit circle, 0 <= low <= high; low is its sine. */
SRP_CLONE_PART double srp_interp_octant_angle(double low, double high) {
    const double *reference = srp_interp_reference[(int)(low * 128.0 + 0.5)];
    double x = reference[1] * low - reference[0] * high; /* |x| < 0.0056 */
    double xx = x * x;
    return reference[2] + (x + x * xx * (1.0 / 6.0 + xx * (3.0 / 40.0)));
}

SRP_CLONE_PART void srp_interp_locate_azimuth(const srp_interp *interp, srp_interp_place *place) {
    double c = fabs(place->cos_az), s = fabs(place->sin_az);
    int k = 4 * (s > c) + 2 * (place->cos_az < 0.0) + (place->sin_az < 0.0);
    double angle = srp_interp_octant_angle(s < c ? s : c, c < s ? s : c);
    double u = interp->az_base[k] + interp->az_scale[k] * angle;
    int last = (int)interp->columns - 1, i = (int)u;
    i = i > last ? last : i;
    place->i = (uint32_t)i;
    place->p = u - i;
}

SRP_CLONE_PART void srp_interp_locate_elevation(const srp_interp *interp, srp_interp_place *place) {
    double c = place->cos_el, s = fabs(place->s.z);
    int k = 2 * (s > c) + (place->s.z < 0.0);
    double angle = srp_interp_octant_angle(s < c ? s : c, c < s ? s : c);
    double v = interp->el_base[k] + interp->el_scale[k] * angle;
    int last = (int)interp->rows - 1, j = (int)v;
    j = j > last ? last : j;
    place->j = (uint32_t)j;
    place->q = v - j;
    place->el_angle = angle;
}

/* False unless `s` is a unit vector (to 1e-9, as srp_prepared_respond() takes it). Roots and
 * quotients wait for as little as can be: that is what a look-up spends its time on. */
SRP_CLONE_PART bool srp_interp_locate(const srp_interp *interp, const srp_vec3 *s,
                                      srp_interp_place *place) {
    /* Closer to a pole than the root of this, squares of coordinates lose digits; nothing changes
     * there. */
    const double at_pole = 1e-300;
    const double x = s->x, y = s->y, z = s->z, square = x * x + y * y;
    const double excess = square + z * z - 1.0;
    if (!(fabs(excess) <= 2e-9)) {
        return false;
    }
    const double unit = 1.0 - 0.5 * excess;
    const bool at = !(square > at_pole);
    const double h = sqrt(square), inverse = h * (1.0 / (at ? 1.0 : square));
    place->cos_az = at ? 1.0 : x * inverse;
    place->sin_az = at ? 0.0 : y * inverse;
    place->cos_el = at ? 0.0 : h * unit;
    place->s = srp_vec3_make(x * unit, y * unit, z * unit);
    srp_interp_locate_azimuth(interp, place);
    srp_interp_locate_elevation(interp, place);
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
    return fabs(place->s.z) > place->cos_el ? place->el_angle : 0.5 * SRP_PI - place->el_angle;
}

/* Rows of a Jacobian from derivatives along azimuth and elevation, and the linear part's own. */
SRP_CLONE_PART void srp_interp_assemble(const srp_interp *interp, const srp_interp_place *place,
                                        const double *by_az, const double *by_el, size_t first,
                                        double rows[3][3]) {
    const double(*linear)[SRP_INTERP_WIDTH_FT] = interp->linear;
    const srp_vec3 s = place->s;
    const srp_vec3 el = srp_vec3_make(-s.z * place->cos_az, -s.z * place->sin_az, place->cos_el);
    for (size_t r = 0; r < 3; ++r) {
        size_t k = first + r;
        double mx = linear[1][k], my = linear[2][k], mz = linear[3][k];
        double along = mx * s.x + my * s.y + mz * s.z;
        rows[r][0] = by_el[k] * el.x - by_az[k] * place->sin_az + (mx - along * s.x);
        rows[r][1] = by_el[k] * el.y + by_az[k] * place->cos_az + (my - along * s.y);
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
