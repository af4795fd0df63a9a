/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Forces on a spacecraft, and lists of them. A force is five fields; whoever has another one fills
 * them in:
 *
 *     srp_force drag = {"drag", 0, my_eval, my_destroy, my_data};
 *     status = srp_force_list_add(list, &drag, &error);
 */
#ifndef SRP_ORBIT_FORCE_H
#define SRP_ORBIT_FORCE_H

#include <srp/export.h>
#include <srp/orbit/ephemeris.h>
#include <srp/orbit/gravity.h>
#include <srp/status.h>
#include <srp/vec3.h>

#include <stdbool.h>
#include <stddef.h>

SRP_BEGIN_DECLS

/* What a force is asked about. Axes are inertial (MJ2000Eq), the origin is the central body. */
typedef struct srp_force_state {
    double t;               /* [s] since the epoch of the ephemeris, TAI */
    srp_vec3 r;             /* [m] */
    srp_vec3 v;             /* [m/s] */
    const srp_vec3 *bodies; /* (SRP_CELESTIAL_COUNT) [m] positions; NaN where not in the set */
} srp_force_state;

/* What it adds to. */
typedef struct srp_force_sum {
    srp_vec3 a;         /* acceleration [m/s^2] */
    bool partials;      /* the two below are wanted */
    double da_dr[3][3]; /* row: component of a; column: of r [1/s^2] */
    double da_dv[3][3]; /* [1/s] */
} srp_force_sum;

/* What a force is like; bits. */
enum {
    SRP_FORCE_PARTIALS = 1, /* adds its part to da_dr and da_dv */
    SRP_FORCE_RADIATION = 2 /* radiation pressure: counted in the impulse */
};

typedef struct srp_force srp_force;
struct srp_force {
    const char *name;
    unsigned flags;
    /* Adds to *sum. 0: done; > 0: not here, try a smaller step; < 0: stop. Re-entrant. */
    int (*eval)(const void *user, const srp_force_state *state, srp_force_sum *sum);
    void (*destroy)(void *user); /* NULL: nothing to do */
    void *user;
};

/* Gives `user` back; for forces that were not added to a list. */
SRP_API void srp_force_release(srp_force *force);

/* Attraction of the central body itself, mu [m^3/s^2]. SRP_BAD_ARGUMENT (mu), SRP_NO_MEMORY. */
SRP_API SRP_CHECK srp_status srp_force_central(double mu, srp_force *out, srp_error *error);
/* Attraction of another body, less that which the central body feels. */
SRP_API SRP_CHECK srp_status srp_force_point_mass(srp_celestial body, double mu, srp_force *out,
                                                  srp_error *error);
/* Gravity field of the Earth as the central body, the central term included. `ephemeris` needs the
 * orientation; both must outlive the force. SRP_NO_MEMORY. */
SRP_API SRP_CHECK srp_status srp_force_gravity(const srp_gravity *field,
                                               const srp_ephemeris *ephemeris, srp_force *out,
                                               srp_error *error);

typedef struct srp_force_list srp_force_list;

/* An empty list; `ephemeris` must outlive it. SRP_BAD_ARGUMENT (body), SRP_NO_MEMORY. */
SRP_API SRP_CHECK srp_status srp_force_list_create(const srp_ephemeris *ephemeris,
                                                   srp_celestial central, srp_force_list **out,
                                                   srp_error *error);
SRP_API void srp_force_list_destroy(srp_force_list *list);
/* Takes *force, which the list then owns. SRP_NO_MEMORY: then the caller still owns it. */
SRP_API SRP_CHECK srp_status srp_force_list_add(srp_force_list *list, const srp_force *force,
                                                srp_error *error);
SRP_API size_t srp_force_list_count(const srp_force_list *list);
SRP_API const srp_force *srp_force_list_get(const srp_force_list *list, size_t index);
SRP_API const srp_ephemeris *srp_force_list_ephemeris(const srp_force_list *list);
SRP_API srp_celestial srp_force_list_central(const srp_force_list *list);

/* The sum of all forces at t, r, v: *sum is set, not added to, but for sum->partials, which is
 * read. *radiation (NULL allowed): the part of forces with SRP_FORCE_RADIATION. What eval of a
 * force returned: 0, or the first other value. Allocates nothing; any number of threads at once. */
SRP_API int srp_force_list_eval(const srp_force_list *list, double t, srp_vec3 r, srp_vec3 v,
                                srp_force_sum *sum, srp_vec3 *radiation);

SRP_END_DECLS

#endif
