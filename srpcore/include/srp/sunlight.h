/* SPDX-License-Identifier: Apache-2.0 */
/* The light itself: radiation pressure at a distance from the Sun. */
#ifndef SRP_SUNLIGHT_H
#define SRP_SUNLIGHT_H

#include <srp/const.h>
#include <srp/export.h>

SRP_BEGIN_DECLS

typedef struct srp_sunlight {
    double flux; /* solar flux at 1 AU, P0 [W/m^2] > 0 */
    double au;   /* astronomical unit [m] > 0 */
} srp_sunlight;

/* SRP_SOLAR_FLUX at SRP_AU. */
static inline srp_sunlight srp_sunlight_default(void) {
    srp_sunlight light;
    light.flux = SRP_SOLAR_FLUX;
    light.au = SRP_AU;
    return light;
}

/* Radiation pressure P(r) = (P0/c) (AU/r)^2 [N/m^2] at the distance r [m] > 0 from the Sun. */
static inline double srp_sunlight_pressure(srp_sunlight light, double r) {
    double ratio = light.au / r;
    return light.flux / SRP_SPEED_OF_LIGHT * ratio * ratio;
}

SRP_END_DECLS

#endif
