/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Where the rays of a sampling method lie: a lattice of parallel rays in the plane that faces the
 * Sun. Internal.
 *
 * Sample (i, j), 0 <= i < columns, 0 <= j < rows, is the ray through
 *     (u0 + i du) u + (v0 + j dv) v,    u x v = s,
 * and stands for a cell of du dv around it.
 */
#ifndef SRP_SRC_LATTICE_H
#define SRP_SRC_LATTICE_H

#include "view.h"

#include <srp/method.h>
#include <srp/vec3.h>

#include <stdint.h>

typedef struct srp_lattice {
    srp_view view; /* u along a row of samples, v along a column, s to the Sun */
    double u0, v0; /* of sample (0, 0) [m] */
    double du, dv; /* pitches [m] */
    int32_t columns, rows;
} srp_lattice;

/* Extent of what is seen, along the axes of a lattice [m]. */
typedef struct srp_extent {
    double u_min, u_max, v_min, v_max;
} srp_extent;

/* The axes of the lattice that `params` asks for with the Sun at `s`: known before its extent. */
srp_view srp_lattice_axes(const srp_lattice_params *params, srp_vec3 s);

/*
 * The lattice itself: `extent` is that of the silhouette along `axes` (not used by a fixed window).
 *   refine  how many times the cells' sides are halved, 0 = as `params` say
 *   seed    with the bits of s it decides the shift of a turned lattice against its box
 */
srp_lattice srp_lattice_fit(const srp_lattice_params *params, const srp_view *axes,
                            srp_extent extent, unsigned refine, uint64_t seed);

/* Most cells along a side that any direction needs for a mesh that fits into a ball of `diameter`
 * [m], not limited to what is allowed. */
double srp_lattice_side(const srp_lattice_params *params, double diameter);

#endif
