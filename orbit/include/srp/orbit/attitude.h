/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Attitudes: how the body is turned. A matrix turns inertial vectors into body axes, as GMAT's
 * Spacecraft::GetAttitude does: v_body = matrix v_inertial.
 */
#ifndef SRP_ORBIT_ATTITUDE_H
#define SRP_ORBIT_ATTITUDE_H

#include <srp/export.h>
#include <srp/orbit/force.h>
#include <srp/status.h>
#include <srp/vec3.h>

SRP_BEGIN_DECLS

/* Bits. */
enum { SRP_ATTITUDE_OF_STATE = 1 /* depends on position or velocity */ };

typedef struct srp_attitude srp_attitude;
struct srp_attitude {
    const char *name;
    unsigned flags;
    /* 0: done; > 0: not here; < 0: stop (e.g. beyond the end of a file). Re-entrant. */
    int (*eval)(const void *user, const srp_force_state *state, double matrix[3][3]);
    void (*destroy)(void *user); /* NULL: nothing to do */
    void *user;
};

SRP_API void srp_attitude_release(srp_attitude *attitude);

/* A quaternion as GMAT writes it: q[0..2] the vector part, q[3] the scalar. */
SRP_API void srp_attitude_matrix_of_quaternion(const double q[4], double matrix[3][3]);

/* All constructors: SRP_NO_MEMORY, and SRP_BAD_ARGUMENT as said. */

/* Fixed. SRP_BAD_ARGUMENT: q is 0 or not finite (it need not be of length 1). */
SRP_API SRP_CHECK srp_status srp_attitude_inertial(const double q[4], srp_attitude *out,
                                                   srp_error *error);
/* Turns about a body axis at `rate` [rad/s], right-handed, from the attitude q at t = 0. */
SRP_API SRP_CHECK srp_status srp_attitude_spinner(const double q[4], srp_vec3 axis_body,
                                                  double rate, srp_attitude *out, srp_error *error);

/* What a body axis may point at. */
typedef enum srp_target {
    SRP_TARGET_NADIR,        /* the central body's centre */
    SRP_TARGET_SUN,          /* */
    SRP_TARGET_VELOCITY,     /* */
    SRP_TARGET_ORBIT_NORMAL, /* r x v */
    SRP_TARGET_NORTH,        /* +Z of the inertial axes */
    SRP_TARGET_COUNT
} srp_target;
SRP_API const char *srp_target_name(srp_target target);
SRP_API bool srp_target_find(const char *name, srp_target *out);

typedef struct srp_attitude_pointing {
    srp_target align;        /* `align_body` points there exactly */
    srp_vec3 align_body;     /* body axes; of any length */
    srp_target constrain;    /* and `constrain_body` as nearly as that allows */
    srp_vec3 constrain_body; /* not along align_body */
} srp_attitude_pointing;

/*
 * Two directions decide: nadir pointing, Sun pointing and yaw steering are all this. +Z to nadir
 * and +Y to the orbit normal is GMAT's NadirPointing with OrbitNormal; +Z to nadir and +X to the
 * Sun is the yaw steering of navigation satellites. While both targets lie in one line, the orbit
 * normal (or, if that is of no help, +Z or +X of the inertial axes) takes the place of the second.
 * SRP_BAD_ARGUMENT: body axes that are 0, not finite, or in one line.
 */
SRP_API SRP_CHECK srp_status srp_attitude_pointing_create(const srp_attitude_pointing *pointing,
                                                          srp_attitude *out, srp_error *error);

/*
 * From a CCSDS Attitude Ephemeris Message (CCSDS 504.0-B, KVN): quaternions, turned evenly from one
 * to the next. Frames: one is inertial (EME2000, ICRF, GCRF, J2000), the other the spacecraft's.
 * eval returns -1 outside the span of the file. `epoch` is t = 0.
 * SRP_NOT_FOUND, SRP_IO, SRP_BAD_FORMAT, SRP_BAD_DATA (times that do not grow, a quaternion of
 * length 0), SRP_UNSUPPORTED (another attitude type or frame), SRP_NO_MEMORY.
 */
SRP_API SRP_CHECK srp_status srp_attitude_aem_read(const char *path, srp_epoch epoch,
                                                   srp_attitude *out, srp_error *error);
SRP_API SRP_CHECK srp_status srp_attitude_aem_parse(const char *text, size_t size, const char *name,
                                                    srp_epoch epoch, srp_attitude *out,
                                                    srp_error *error);

SRP_END_DECLS

#endif
