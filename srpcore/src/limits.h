/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How large numbers may be. Whatever is computed from values within these limits is finite, squares
 * and products of a few of them included, so that nothing behind the readers has to ask again.
 * They are far beyond any spacecraft: what exceeds them is a slip of the pen or of the unit.
 * Internal.
 */
#ifndef SRP_SRC_LIMITS_H
#define SRP_SRC_LIMITS_H

#include <srp/vec3.h>

#include <math.h>

/* Any coordinate of a vertex or of the reference point, in size [m]. Boxes in the image are kept
 * in float, whose range ends at 3e38. */
#define SRP_REACH_MAX 1e30
/* Area of a plate or a sphere [m^2], and the coefficient Cr of the latter [-]. */
#define SRP_AREA_MAX 1e60
#define SRP_CR_MAX 1e30
/* Mass [kg], solar flux [W/m^2], astronomical unit [m]. */
#define SRP_SCALE_MIN 1e-30
#define SRP_SCALE_MAX 1e30
/* Any component of a force [m^2] or a moment [m^3] in a table. Above what the limits before allow
 * to arise, so that every table that can be computed can be written and read. */
#define SRP_RESPONSE_MAX 1e100

/* False for NaN, too. */
#define SRP_WITHIN(value, low, high) ((value) >= (low) && (value) <= (high))

/* The largest of the three, in size. */
static inline double srp_vec3_largest(srp_vec3 v) {
    return fmax(fabs(v.x), fmax(fabs(v.y), fabs(v.z)));
}

#endif
