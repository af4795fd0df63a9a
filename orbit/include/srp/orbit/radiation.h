/* SPDX-License-Identifier: Apache-2.0 */
/* Solar radiation pressure as a force: an area model, an attitude, and what stands before the Sun.
 */
#ifndef SRP_ORBIT_RADIATION_H
#define SRP_ORBIT_RADIATION_H

#include <srp/export.h>
#include <srp/orbit/area_model.h>
#include <srp/orbit/attitude.h>
#include <srp/orbit/force.h>
#include <srp/status.h>
#include <srp/sunlight.h>

SRP_BEGIN_DECLS

/* Bodies that may stand before the Sun. */
typedef struct srp_shadow {
    double sun_radius; /* [m] */
    size_t count;      /* at most SRP_CELESTIAL_COUNT */
    srp_celestial body[SRP_CELESTIAL_COUNT];
    double radius[SRP_CELESTIAL_COUNT]; /* [m] */
} srp_shadow;

/* Share of the Sun that is seen from r. */
SRP_API double srp_shadow_fraction(const srp_shadow *shadow, srp_vec3 r, const srp_vec3 *bodies);

typedef struct srp_radiation_params {
    srp_area_model model;  /* taken over */
    srp_attitude attitude; /* taken over; unused by round models */
    srp_sunlight light;
    srp_shadow shadow;
    double mass;  /* [kg] > 0 */
    double scale; /* factor on the force [-] */
} srp_radiation_params;

/* SRP_BAD_ARGUMENT (mass, scale), SRP_NO_MEMORY: then model and attitude are still the caller's. */
SRP_API SRP_CHECK srp_status srp_force_radiation(const srp_radiation_params *params, srp_force *out,
                                                 srp_error *error);

/* What a force made by srp_force_radiation() sees and does. */
typedef struct srp_radiation_probe {
    srp_vec3 s_body;     /* unit vector to the Sun, body axes; inertial axes for round models */
    srp_vec3 f;          /* area vector [m^2], the same axes, without the scale factor */
    srp_vec3 a;          /* acceleration [m/s^2], inertial */
    double seen;         /* share of the Sun */
    double matrix[3][3]; /* inertial to body */
} srp_radiation_probe;

/* As eval returns. */
SRP_API int srp_force_radiation_probe(const srp_force *force, const srp_force_state *state,
                                      srp_radiation_probe *out);

SRP_END_DECLS

#endif
