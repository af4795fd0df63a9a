/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The light itself: flux and radiation pressure at a distance from the Sun, and what is left of the
 * Sun when bodies stand before it. With `sun` the vector from the spacecraft to the Sun,
 *
 *     P = srp_sunlight_fraction(sun, SRP_SUN_RADIUS, count, bodies) *
 *         srp_sunlight_pressure(light, srp_vec3_norm(sun));
 *
 * Nothing here allocates or keeps anything: any number of threads at once.
 */
#ifndef SRP_SUNLIGHT_H
#define SRP_SUNLIGHT_H

#include <srp/const.h>
#include <srp/export.h>
#include <srp/vec3.h>

#include <stddef.h>

SRP_BEGIN_DECLS

typedef struct srp_sunlight {
    double flux; /* solar flux at 1 au, P0 [W/m^2] > 0 */
    double au;   /* astronomical unit [m] > 0 */
} srp_sunlight;

/* SRP_SOLAR_FLUX at SRP_AU. */
static inline srp_sunlight srp_sunlight_default(void) {
    srp_sunlight light;
    light.flux = SRP_SOLAR_FLUX;
    light.au = SRP_AU;
    return light;
}

/* Flux [W/m^2] at the distance r [m] > 0 from the Sun. */
static inline double srp_sunlight_flux(srp_sunlight light, double r) {
    double ratio = light.au / r;
    return light.flux * ratio * ratio;
}

/* Radiation pressure P(r) = (P0/c) (AU/r)^2 [N/m^2] at the distance r [m] > 0 from the Sun. */
static inline double srp_sunlight_pressure(srp_sunlight light, double r) {
    double ratio = light.au / r;
    return light.flux / SRP_SPEED_OF_LIGHT * ratio * ratio;
}

/* A sphere that may stand before the Sun. */
typedef struct srp_body {
    srp_vec3 position; /* of its centre relative to the spacecraft [m], axes as the Sun's */
    double radius;     /* [m] >= 0 */
} srp_body;

/*
 * Share of the Sun's disk that is seen, 0 to 1: dual cone, without limb darkening.
 *   sun         position of the Sun's centre relative to the spacecraft [m]
 *   sun_radius  [m] >= 0, e.g. SRP_SUN_RADIUS; 0: a point, seen or not
 *   bodies      (count); NULL when count is 0
 * Disks of the apparent radii asin(R / r) are laid out flat around the Sun's, as O. Montenbruck and
 * E. Gill, "Satellite Orbits", 3.4.2, do for one; total and annular eclipses included. Several
 * bodies hide what their disks cover together: a part that two of them cover counts once. (Of more
 * than 16 that each cover a part at once, the others count as if they overlapped nothing.)
 *
 * Continuous with its derivative, also where disks begin and cease to touch. Inside a body, its
 * disk is the half of the sky on the side of its centre, as on its surface, so that a landed
 * spacecraft has day and night; at the very centre it is dark. A body whose centre is farther away
 * than the Sun's hides nothing. Inside the Sun, its disk is half the sky; at its centre, nothing
 * stands before it. NaN for a NaN or a radius below 0.
 */
SRP_API double srp_sunlight_fraction(srp_vec3 sun, double sun_radius, size_t count,
                                     const srp_body *bodies);

SRP_END_DECLS

#endif
