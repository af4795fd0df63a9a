/* SPDX-License-Identifier: Apache-2.0 */
/*
 * From area vector to acceleration: what one spacecraft feels at one instant, and how that changes
 * with its place. With M the rotation from inertial to body axes, s = sun / |sun|,
 *
 *     a = nu P(|sun|) scale / m  M^T f(M s)
 *
 * Whoever has an interpolant calls srp_acceleration_eval(), with srp_area_source_interp(). Whoever
 * wants to do something between the steps asks srp_acceleration_light() for the direction, and
 * hands what was found to srp_acceleration_add_partials().
 *
 * Nothing here allocates or keeps anything: any number of threads at once.
 */
#ifndef SRP_ACCELERATION_H
#define SRP_ACCELERATION_H

#include <srp/export.h>
#include <srp/interp.h>
#include <srp/spad.h>
#include <srp/status.h>
#include <srp/sunlight.h>
#include <srp/vec3.h>

#include <stddef.h>

SRP_BEGIN_DECLS

/* Bodies that may stand before the Sun at once. */
enum { SRP_ACCELERATION_BODIES_MAX = 16 };

/* What answers the question which area vector belongs to a direction. */
typedef struct srp_area_source {
    /* f [m^2] for the unit vector s_body to the Sun; df (NULL: not wanted) its derivatives,
     * tangential as srp_interp_jacobian's. Out parameters stay as they are on failure. */
    srp_status (*eval)(const void *user, srp_vec3 s_body, srp_vec3 *f, double (*df)[3],
                       srp_error *error);
    const void *user;
} srp_area_source;

/* Views: the source lives as long as what it is made of. */
SRP_API srp_area_source srp_area_source_interp(const srp_interp *interp);
SRP_API srp_area_source srp_area_source_spad(const srp_spad *spad);

/* What stays as it is along an orbit. */
typedef struct srp_acceleration_params {
    srp_sunlight light;
    double sun_radius; /* [m] >= 0 */
    double scale;      /* factor on the acceleration [-] */
} srp_acceleration_params;

/* srp_sunlight_default(), SRP_SUN_RADIUS, 1. */
static inline srp_acceleration_params srp_acceleration_params_default(void) {
    srp_acceleration_params params;
    params.light = srp_sunlight_default();
    params.sun_radius = SRP_SUN_RADIUS;
    params.scale = 1.0;
    return params;
}

/* One spacecraft at one instant. Vectors in inertial axes, from the spacecraft. */
typedef struct srp_acceleration_state {
    srp_vec3 sun;           /* to the Sun's centre [m] */
    size_t count;           /* of bodies, at most SRP_ACCELERATION_BODIES_MAX */
    const srp_body *bodies; /* (count) that may stand before the Sun; NULL when count is 0 */
    double matrix[3][3];    /* rotation, inertial to body axes: v_body = M v */
    double mass;            /* [kg] > 0 */
} srp_acceleration_state;

/* The light of a state. */
typedef struct srp_acceleration_lighting {
    srp_vec3 s;      /* unit vector to the Sun, inertial axes */
    srp_vec3 s_body; /* the same, body axes */
    double distance; /* [m] */
    double seen;     /* share of the Sun, 0 to 1 */
    double factor;   /* P scale / m [m/s^2 per m^2], without the share that is seen */
} srp_acceleration_lighting;

/* SRP_BAD_ARGUMENT: a mass that is not above 0, a Sun without direction, too many bodies, a matrix
 * that is no rotation (to 1e-6), a radius below 0 or anything that is not finite. */
SRP_API SRP_CHECK srp_status srp_acceleration_light(const srp_acceleration_params *params,
                                                    const srp_acceleration_state *state,
                                                    srp_acceleration_lighting *out,
                                                    srp_error *error);

/*
 * Adds to da_dr [1/s^2] (3,3; row: component of a, column: component of r, inertial axes) how the
 * acceleration changes with the place of the spacecraft, its attitude held.
 *   lighting  of `params` and `state`
 *   f         area vector [m^2] for lighting->s_body, body axes
 *   df        its derivatives by s_body, tangential, as srp_interp_jacobian's
 * By the distance, P ~ d^-2, and the direction, ds = -(1 - s s^T) dr / d, exactly; by the share of
 * the Sun in a penumbra, central differences over 10 m.
 */
SRP_API void srp_acceleration_add_partials(const srp_acceleration_params *params,
                                           const srp_acceleration_state *state,
                                           const srp_acceleration_lighting *lighting, srp_vec3 f,
                                           const double df[3][3], double da_dr[3][3]);

/*
 * Acceleration *a [m/s^2] in inertial axes, and da_dr (NULL: not wanted), which is set. Without any
 * Sun both are 0, and `source` is not asked.
 * What srp_acceleration_light() and the source return; then nothing is changed.
 */
SRP_API SRP_CHECK srp_status srp_acceleration_eval(const srp_acceleration_params *params,
                                                   srp_area_source source,
                                                   const srp_acceleration_state *state, srp_vec3 *a,
                                                   double da_dr[3][3], srp_error *error);

SRP_END_DECLS

#endif
