/* SPDX-License-Identifier: Apache-2.0 */
/* Osculating Keplerian elements and state vectors. */
#ifndef SRP_ORBIT_ELEMENTS_H
#define SRP_ORBIT_ELEMENTS_H

#include <srp/export.h>
#include <srp/status.h>
#include <srp/vec3.h>

SRP_BEGIN_DECLS

typedef struct srp_elements {
    double a;    /* semi-major axis [m]; below 0: hyperbola */
    double e;    /* eccentricity [-] >= 0 */
    double i;    /* inclination [rad], 0 to pi */
    double raan; /* right ascension of the ascending node [rad]; 0 where there is none */
    double argp; /* argument of periapsis [rad]; from the node, or from +X without one; 0 on a
                    circle */
    double nu;   /* true anomaly [rad]; from the node (or +X) on a circle */
} srp_elements;

/* Angles come in [0, 2 pi). Of a straight line through the centre, i, raan and argp mean nothing.
 */
SRP_API srp_elements srp_elements_from_state(double mu, srp_vec3 r, srp_vec3 v);
/* SRP_BAD_ARGUMENT: a (1 - e^2) is not above 0, nu beyond the asymptote, or something not finite.
 */
SRP_API SRP_CHECK srp_status srp_elements_to_state(double mu, const srp_elements *elements,
                                                   srp_vec3 *r, srp_vec3 *v, srp_error *error);
/* The state `dt` [s] later on the same conic, by universal variables; any energy. SRP_BAD_ARGUMENT:
 * no solution found. */
SRP_API SRP_CHECK srp_status srp_elements_kepler(double mu, double dt, srp_vec3 *r, srp_vec3 *v,
                                                 srp_error *error);

SRP_END_DECLS

#endif
