/* SPDX-License-Identifier: Apache-2.0 */
/*
 * From a direction to its place in the grid.
 *
 * Angles are arc sines of the smaller of sine and cosine, hence of angles within 45 degrees:
 * the nearest of 33 reference angles, and the series of arcsin for the small rest. Nothing is
 * branched on that a random direction would make the processor guess wrong. Error below 3e-16 rad;
 * near 0, hence near the poles, that relative to the angle.
 */
#include "interp_internal.h"

#include <srp/const.h>

#include <math.h>

/* Of length 1 to 1e-9, as srp_prepared_respond() takes it. */
static const double UNIT_TOLERANCE = 2e-9;
/* Closer to a pole than this, squares of coordinates lose digits; nothing else changes there. */
static const double AT_POLE = 1e-150;

/* Sine and cosine of k pi / 128. */
static const double REFERENCE[33][2] = {
    {0x0.0p+0, 0x1.0000000000000p+0},
    {0x1.92155f7a3667ep-6, 0x1.ffd886084cd0dp-1},
    {0x1.91f65f10dd814p-5, 0x1.ff621e3796d7ep-1},
    {0x1.2d52092ce19f6p-4, 0x1.fe9cdad01883ap-1},
    {0x1.917a6bc29b42cp-4, 0x1.fd88da3d12526p-1},
    {0x1.f564e56a9730ep-4, 0x1.fc26470e19fd3p-1},
    {0x1.2c8106e8e613ap-3, 0x1.fa7557f08a517p-1},
    {0x1.5e214448b3fc6p-3, 0x1.f8764fa714ba9p-1},
    {0x1.8f8b83c69a60bp-3, 0x1.f6297cff75cb0p-1},
    {0x1.c0b826a7e4f63p-3, 0x1.f38f3ac64e589p-1},
    {0x1.f19f97b215f1bp-3, 0x1.f0a7efb9230d7p-1},
    {0x1.111d262b1f677p-2, 0x1.ed740e7684963p-1},
    {0x1.294062ed59f06p-2, 0x1.e9f4156c62ddap-1},
    {0x1.4135c94176601p-2, 0x1.e6288ec48e112p-1},
    {0x1.58f9a75ab1fddp-2, 0x1.e212104f686e5p-1},
    {0x1.7088530fa459fp-2, 0x1.ddb13b6ccc23cp-1},
    {0x1.87de2a6aea963p-2, 0x1.d906bcf328d46p-1},
    {0x1.9ef7943a8ed8ap-2, 0x1.d4134d14dc93ap-1},
    {0x1.b5d1009e15cc0p-2, 0x1.ced7af43cc773p-1},
    {0x1.cc66e9931c45ep-2, 0x1.c954b213411f5p-1},
    {0x1.e2b5d3806f63bp-2, 0x1.c38b2f180bdb1p-1},
    {0x1.f8ba4dbf89abap-2, 0x1.bd7c0ac6f952ap-1},
    {0x1.073879922ffeep-1, 0x1.b728345196e3ep-1},
    {0x1.11eb3541b4b23p-1, 0x1.b090a58150200p-1},
    {0x1.1c73b39ae68c8p-1, 0x1.a9b66290ea1a3p-1},
    {0x1.26d054cdd12dfp-1, 0x1.a29a7a0462782p-1},
    {0x1.30ff7fce17035p-1, 0x1.9b3e047f38741p-1},
    {0x1.3affa292050b9p-1, 0x1.93a22499263fbp-1},
    {0x1.44cf325091dd6p-1, 0x1.8bc806b151741p-1},
    {0x1.4e6cabbe3e5e9p-1, 0x1.83b0e0bff976ep-1},
    {0x1.57d69348ceca0p-1, 0x1.7b5df226aafafp-1},
    {0x1.610b7551d2cdfp-1, 0x1.72d0837efff96p-1},
    {0x1.6a09e667f3bcdp-1, 0x1.6a09e667f3bcdp-1},
};

/* Angle [rad] of a point of the unit circle, 0 <= low <= high; low is its sine. */
static double octant_angle(double low, double high) {
    double square = low * low;
    double rough = low * (1.0 + square * (0.15614 + 0.1306 * square)); /* to 5e-4 */
    int k = (int)(rough * (128.0 / SRP_PI) + 0.5);
    double x = REFERENCE[k][1] * low - REFERENCE[k][0] * high; /* |x| < 0.0130 */
    double xx = x * x;
    double series = 1.0 / 6.0 + xx * (3.0 / 40.0 + xx * (5.0 / 112.0 + xx * (35.0 / 1152.0)));
    return (double)k * (SRP_PI / 128.0) + (x + x * xx * series);
}

/* Azimuth in columns from -180 degrees: BASE quarters of a turn, plus or minus the octant's angle.
 * By: whether |sine| > |cosine|, cosine < 0, sine < 0. */
static const double AZ_BASE[8] = {2, 2, 4, 0, 3, 1, 3, 1};
static const double AZ_SIGN[8] = {1, -1, -1, 1, -1, 1, 1, -1};
/* Elevation in rows from -90 degrees, likewise, in quarters; whether |sine| > cosine, sine < 0. */
static const double EL_BASE[4] = {1, 1, 2, 0};
static const double EL_SIGN[4] = {1, -1, -1, 1};

static void locate_azimuth(const srp_interp *interp, srp_interp_place *place) {
    double c = fabs(place->cos_az), s = fabs(place->sin_az);
    bool swap = s > c;
    int k = 4 * swap + 2 * (place->cos_az < 0.0) + (place->sin_az < 0.0);
    double angle = octant_angle(swap ? c : s, swap ? s : c);
    double u = 0.25 * AZ_BASE[k] * interp->columns + AZ_SIGN[k] * angle * interp->columns_per_rad;
    int last = (int)interp->columns - 1, i = (int)u;
    i = i > last ? last : i;
    place->i = (uint32_t)i;
    place->p = u - i;
}

static void locate_elevation(const srp_interp *interp, srp_interp_place *place) {
    double c = place->cos_el, s = fabs(place->s.z);
    bool swap = s > c;
    int k = 2 * swap + (place->s.z < 0.0);
    double angle = octant_angle(swap ? c : s, swap ? s : c);
    double v = 0.5 * EL_BASE[k] * interp->rows + EL_SIGN[k] * angle * interp->rows_per_rad;
    int last = (int)interp->rows - 1, j = (int)v;
    j = j > last ? last : j;
    place->j = (uint32_t)j;
    place->q = v - j;
    place->theta = swap ? angle : 0.5 * SRP_PI - angle;
    place->pole = j == last && (j > 0 || place->s.z > 0.0) ? 1 : j == 0 ? -1 : 0;
}

bool srp_interp_locate(const srp_interp *interp, srp_vec3 s, srp_interp_place *place) {
    double excess = srp_vec3_dot(s, s) - 1.0;
    if (!(fabs(excess) <= UNIT_TOLERANCE)) {
        return false;
    }
    place->s = srp_vec3_scale(1.0 - 0.5 * excess, s);
    double x = place->s.x, y = place->s.y, h = sqrt(x * x + y * y);
    if (h > AT_POLE) {
        double inverse = 1.0 / h;
        place->cos_az = x * inverse;
        place->sin_az = y * inverse;
        place->cos_el = h;
    } else {
        place->cos_az = 1.0;
        place->sin_az = 0.0;
        place->cos_el = 0.0;
    }
    locate_azimuth(interp, place);
    locate_elevation(interp, place);
    return true;
}
