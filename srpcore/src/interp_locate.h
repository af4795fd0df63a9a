/* SPDX-License-Identifier: Apache-2.0 */
/*
 * From a direction to its place in the grid. Internal; compiled into the look-up of each scheme.
 *
 * A look-up mostly waits for one number after the other, and so azimuth and elevation do not wait
 * for each other, and each for one root or one quotient alone. Azimuth is the arc tangent of the
 * smaller over the larger of |x| and |y|, by polynomials, one for each 1/64. Elevation is that of a
 * nearby angle whose sine and cosine are known, found by the square of the smaller of |z| and the
 * distance from the axis while the root of the other is taken, and the arc sine of the little rest.
 * Nothing is branched on that a random direction would make the processor guess wrong. What is lost
 * is a few roundings of the angle; near the poles, of the distance from them.
 */
#ifndef SRP_SRC_INTERP_LOCATE_H
#define SRP_SRC_INTERP_LOCATE_H

#include "clones.h"
#include "interp_internal.h"

#include <math.h>
#include <string.h>

/* Around k / 64: coefficients of powers 0 to 6 of the arc tangent, a polynomial through Chebyshev's
 * points up to 1/128 away, right to 5e-17; the first one is odd. */
enum { SRP_INTERP_ARCS = 65 };
extern const double srp_interp_arc[SRP_INTERP_ARCS][8];

/* Arc tangent [rad] of x in [0, 1]. */
SRP_CLONE_PART double srp_interp_atan(double x) {
    /* Numbers of this size are multiples of 1/64: the sum is rounded to one, its last bits count.
     */
    const double multiples = 0x1.8p46, shifted = x + multiples;
    uint64_t bits;
    memcpy(&bits, &shifted, sizeof bits);
    const double *a = srp_interp_arc[bits & 127];
    const double d = x - (shifted - multiples), dd = d * d;
    return (a[0] + a[1] * d) + dd * ((a[2] + a[3] * d) + dd * ((a[4] + a[5] * d) + dd * a[6]));
}

/* Sine, cosine and angle [rad] up to 45 degrees; row k is for squares of sines that, with 2^-12
 * added, begin with the same 5 bits: 32 rows from one power of 2 to the next. */
enum { SRP_INTERP_SINES = 353 };
extern const double srp_interp_sine[SRP_INTERP_SINES][4];

SRP_CLONE_PART const double *srp_interp_sine_near(double square) {
    const double least = 0x1p-12, shifted = square + least;
    uint64_t bits, least_bits;
    memcpy(&bits, &shifted, sizeof bits);
    memcpy(&least_bits, &least, sizeof least_bits);
    return srp_interp_sine[(bits >> 47) - (least_bits >> 47)];
}

/* `u` steps from the first node: cell, of `count`, and place in it. */
SRP_CLONE_PART uint32_t srp_interp_cell(double u, uint32_t count, double *rest) {
    const int last = (int)count - 1, whole = (int)u, cell = whole > last ? last : whole;
    *rest = u - cell;
    return (uint32_t)cell;
}

/* Azimuth in columns. */
SRP_CLONE_PART double srp_interp_columns(const srp_interp *interp, double x, double y) {
    const double c = fabs(x), s = fabs(y), low = s < c ? s : c, high = c < s ? s : c;
    const int k = 4 * (s > c) + 2 * (x < 0.0) + (y < 0.0);
    return interp->az_base[k] + interp->az_scale[k] * srp_interp_atan(low / high);
}

/* Elevation in rows: `h` is the root of `square`, `unit` makes both and z those of a unit vector.
 */
SRP_CLONE_PART double srp_interp_rows(const srp_interp *interp, double z, double h, double square,
                                      double unit) {
    const double zz = z * z, s = fabs(z);
    const double *near = srp_interp_sine_near(zz < square ? zz : square);
    const int k = 2 * (zz > square) + (z < 0.0);
    const double low = zz > square ? h : s, high = zz > square ? s : h;
    const double d = near[1] * low - near[0] * high, dd = d * d;
    return (interp->el_base[k] + interp->el_scale[k] * near[2]) +
           interp->el_scale[k] * unit * (d + d * dd * (1.0 / 6.0 + dd * (3.0 / 40.0)));
}

/* False unless `s` is a unit vector (to 1e-9, as srp_prepared_respond() takes it). Roots and
 * quotients wait for as little as can be: that is what a look-up spends its time on. */
SRP_CLONE_PART bool srp_interp_locate(const srp_interp *interp, const srp_vec3 *s,
                                      srp_interp_place *place) {
    const double at_pole = 1e-300, square = s->x * s->x + s->y * s->y;
    const double excess = square + s->z * s->z - 1.0;
    if (!(fabs(excess) <= 2e-9)) {
        return false;
    }
    const double unit = 1.0 - 0.5 * excess;
    const bool at = !(square > at_pole);
    const double x = at ? 1.0 : s->x, y = at ? 0.0 : s->y, h = at ? 0.0 : sqrt(square);
    place->i = srp_interp_cell(srp_interp_columns(interp, x, y), interp->columns, &place->p);
    place->j =
        srp_interp_cell(srp_interp_rows(interp, s->z, h, square, unit), interp->rows, &place->q);
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
    return 2.0 * srp_interp_atan(place->cos_el / (1.0 + fabs(place->s.z)));
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
