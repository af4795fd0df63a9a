/* SPDX-License-Identifier: Apache-2.0 */
/* Gravity fields in spherical harmonics, from files of the International Centre for Global Earth
 * Models (ICGEM, .gfc). */
#ifndef SRP_ORBIT_GRAVITY_H
#define SRP_ORBIT_GRAVITY_H

#include <srp/export.h>
#include <srp/status.h>
#include <srp/vec3.h>

#include <stddef.h>

SRP_BEGIN_DECLS

typedef struct srp_gravity srp_gravity;

enum { SRP_GRAVITY_DEGREE_MAX = 120 };

/*
 * Reads a static field up to `degree` and `order` (order <= degree <= SRP_GRAVITY_DEGREE_MAX).
 * Coefficients may be fully normalised or not. Terms that change with time are left out with a
 * warning. SRP_NOT_FOUND, SRP_IO, SRP_BAD_FORMAT, SRP_BAD_DATA (the file ends before `degree`, a mu
 * or radius that is not above 0), SRP_BAD_ARGUMENT (degree, order), SRP_NO_MEMORY.
 */
SRP_API SRP_CHECK srp_status srp_gravity_read(const char *path, unsigned degree, unsigned order,
                                              const srp_log *log, srp_gravity **out,
                                              srp_error *error);
/* The same from memory; `name` stands for the file in messages. */
SRP_API SRP_CHECK srp_status srp_gravity_parse(const char *text, size_t size, const char *name,
                                               unsigned degree, unsigned order, const srp_log *log,
                                               srp_gravity **out, srp_error *error);
SRP_API void srp_gravity_destroy(srp_gravity *gravity);

SRP_API double srp_gravity_mu(const srp_gravity *gravity);     /* [m^3/s^2] */
SRP_API double srp_gravity_radius(const srp_gravity *gravity); /* [m] */

/*
 * Acceleration [m/s^2] at r [m], |r| > 0, both in the body's own axes; all terms, the central one
 * included. Regular at the poles. Recursion: L. E. Cunningham, Celestial Mechanics 2 (1970) 207, in
 * the form of O. Montenbruck and E. Gill, "Satellite Orbits", 3.2.4, normalised. Allocates nothing.
 */
SRP_API srp_vec3 srp_gravity_eval(const srp_gravity *gravity, srp_vec3 r);

SRP_END_DECLS

#endif
