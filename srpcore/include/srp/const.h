/* SPDX-License-Identifier: Apache-2.0 */
/* Constants, each once, with unit and source. */
#ifndef SRP_CONST_H
#define SRP_CONST_H

/* Ratio of a circle's circumference to its diameter [-]; C11 itself has no M_PI. */
#define SRP_PI 3.14159265358979323846

/* Speed of light in vacuum [m/s], exact by definition of the metre (BIPM, SI Brochure, 9th ed.). */
#define SRP_SPEED_OF_LIGHT 299792458.0

/* Astronomical unit [m], exact (IAU 2012 Resolution B2). */
#define SRP_AU 149597870700.0

/* Default solar flux at 1 au [W/m^2]: the value of AAS 20-481 and of GMAT (FM.SRP.Flux). */
#define SRP_SOLAR_FLUX 1367.0

/* Radius of the Sun [m], nominal (IAU 2015 Resolution B3). */
#define SRP_SUN_RADIUS 6.957e8

/* Degrees to radians [rad/deg]. Degrees are met only at the edges: command line and files. */
#define SRP_RAD_PER_DEG (SRP_PI / 180.0)

#endif
