/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Where the Sun, the Moon and the planets are, and how the Earth is turned, from ERFA: eraEpv00 for
 * Earth and Sun, eraMoon98 for the Moon, eraPlan94 for the planets, eraXys06a and eraEra00 for the
 * Earth's orientation. Axes are those of the ICRS, taken as MJ2000Eq.
 *
 * These series take microseconds to milliseconds a call. An ephemeris is made once for a span of
 * time and holds Chebyshev polynomials; docs/theory.md says how far they are from the series.
 */
#ifndef SRP_ORBIT_EPHEMERIS_H
#define SRP_ORBIT_EPHEMERIS_H

#include <srp/export.h>
#include <srp/orbit/epoch.h>
#include <srp/status.h>
#include <srp/vec3.h>

#include <stdbool.h>
#include <stddef.h>

SRP_BEGIN_DECLS

typedef enum srp_celestial {
    SRP_SUN,
    SRP_MERCURY,
    SRP_VENUS,
    SRP_EARTH,
    SRP_MARS,
    SRP_JUPITER,
    SRP_SATURN,
    SRP_URANUS,
    SRP_NEPTUNE,
    SRP_MOON,
    SRP_CELESTIAL_COUNT
} srp_celestial;

/* What a body is like unless the caller knows better. */
typedef struct srp_celestial_info {
    const char *name; /* lower case */
    double mu;        /* gravitational parameter [m^3/s^2] */
    double radius;    /* equatorial [m] */
} srp_celestial_info;

/* Constant; NULL out of range. mu of Sun and planets are DE405's (E. M. Standish, JPL IOM
 * 312.F-98-048; with their moons from Mars on), Earth 398600.4415 km^3/s^2 as JGM-2 and GMAT have
 * it, Moon and all radii GMAT R2020a's. */
SRP_API const srp_celestial_info *srp_celestial_get(srp_celestial body);
/* False when there is none of this name; then *out is unchanged. */
SRP_API bool srp_celestial_find(const char *name, srp_celestial *out);

typedef struct srp_ephemeris srp_ephemeris;

/* A set of bodies: bit 1 << body. The Sun and the Earth are always there. */
typedef unsigned srp_celestial_set;

typedef struct srp_ephemeris_params {
    srp_epoch epoch;          /* t = 0 */
    double begin, end;        /* span [s] since the epoch, begin < end */
    srp_celestial_set bodies; /* what will be asked for */
    bool orientation;         /* the Earth's, too */
    double ut1_minus_utc;     /* [s] */
    double pole_x, pole_y;    /* of the terrestrial pole [rad] */
} srp_ephemeris_params;

/* The Sun and nothing else, without orientation, UT1 = UTC, pole 0; the span is a day. */
SRP_API srp_ephemeris_params srp_ephemeris_params_default(srp_epoch epoch);

/* SRP_BAD_ARGUMENT (span), SRP_NO_MEMORY. *out is the caller's, read-only, for any threads. */
SRP_API SRP_CHECK srp_status srp_ephemeris_create(const srp_ephemeris_params *params,
                                                  srp_ephemeris **out, srp_error *error);
SRP_API void srp_ephemeris_destroy(srp_ephemeris *ephemeris);
SRP_API srp_epoch srp_ephemeris_epoch(const srp_ephemeris *ephemeris);

/* Position [m] of a body from the Earth's centre, t [s] after the epoch. Outside the span the
 * series are summed: right, but slow. NaN for a body that is not in the set. */
SRP_API srp_vec3 srp_ephemeris_position(const srp_ephemeris *ephemeris, srp_celestial body,
                                        double t);
/* Positions of the whole set from the centre of `central`: out[body], for the others NaN. */
SRP_API void srp_ephemeris_positions(const srp_ephemeris *ephemeris, srp_celestial central,
                                     double t, srp_vec3 out[SRP_CELESTIAL_COUNT]);
/* Turns inertial vectors into the Earth's axes (ITRS): r_itrs = matrix r_icrs. NaN without
 * orientation. */
SRP_API void srp_ephemeris_earth_axes(const srp_ephemeris *ephemeris, double t,
                                      double matrix[3][3]);

SRP_END_DECLS

#endif
