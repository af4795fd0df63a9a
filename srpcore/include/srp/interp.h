/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Interpolants: area vector, moment vector and their derivatives for any direction of the Sun, from
 * the nodes of a table. Schemes are constant tables of functions, chosen by pointer:
 *
 *     srp_interp *interp;
 *     status = srp_interp_create(&srp_interp_spline, table, &interp, &error);
 *     status = srp_interp_eval(interp, s_body, &f, &t, &jacobian, &error);
 *     srp_interp_destroy(interp);
 *
 * What is interpolated is a function on the sphere: azimuth is periodic, elevation goes on across
 * the poles ((az, 90 + d) = (az + 180, 90 - d)), and the Sun exactly on a pole or on the seam is an
 * ordinary case. docs/theory.md, "Interpolation", says how, and what to expect of each scheme.
 */
#ifndef SRP_INTERP_H
#define SRP_INTERP_H

#include <srp/export.h>
#include <srp/status.h>
#include <srp/table.h>
#include <srp/vec3.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

SRP_BEGIN_DECLS

typedef struct srp_interp srp_interp;
typedef struct srp_interp_scheme srp_interp_scheme;

/* Derivatives with respect to the unit vector s: row r, column c is d f_r / d s_c. They are those
 * of f(s / |s|), hence tangential: df s = 0. */
typedef struct srp_interp_jacobian {
    double df[3][3]; /* [m^2] */
    double dt[3][3]; /* [m^3] */
} srp_interp_jacobian;

/* Where a look-up leaves what it finds. */
typedef struct srp_interp_target {
    srp_vec3 *f, *t;               /* t may be NULL */
    srp_interp_jacobian *jacobian; /* may be NULL */
} srp_interp_target;

/* What a scheme is like; bits. */
enum {
    SRP_INTERP_LOCAL = 1, /* a value needs a few nodes near its direction, and no others */
    SRP_INTERP_LINEAR = 2 /* fields a + M s, a cannonball's among them, come out exactly */
};

struct srp_interp_scheme {
    const char *name;    /* as users write it */
    const char *summary; /* one line for help texts */
    int continuity;      /* derivatives that are continuous on the sphere: 0, 1 or 2 */
    int order;           /* power of the step that the error falls with, on smooth fields */
    unsigned capabilities;
    unsigned steps_min; /* fewest steps of azimuth that it takes; half as many of elevation */
    unsigned reach;     /* SRP_INTERP_LOCAL: nodes beyond those of the cell, to each side */
    /* From the nodes, copied into `interp`, to what eval needs. */
    srp_status (*prepare)(srp_interp *interp, srp_error *error);
    /* The look-up; false unless s is a unit vector. */
    bool (*eval)(const srp_interp *interp, const srp_vec3 *s, const srp_interp_target *to);
    /* SRP_INTERP_LOCAL, may be NULL: sets the node of column i beyond a pole after that before it
     * has been set. */
    void (*extend)(srp_interp *interp, uint32_t i, int north);
};

/* Linear in azimuth and elevation, as GMAT's reader does: continuous, order 2. */
SRP_API extern const srp_interp_scheme srp_interp_bilinear;
/* Cubic in 4 x 4 nodes, one continuous derivative, order 3. */
SRP_API extern const srp_interp_scheme srp_interp_bicubic;
/* Cubic B-spline through all nodes, two continuous derivatives, order 4. */
SRP_API extern const srp_interp_scheme srp_interp_spline;

/* All schemes, in the order above; *count of them. Constant. */
SRP_API const srp_interp_scheme *const *srp_interp_list(size_t *count);
/* The scheme of this name, NULL when there is none. */
SRP_API const srp_interp_scheme *srp_interp_find(const char *name);

/*
 * An interpolant of a complete table. Nodes are copied: the table may be changed or destroyed
 * afterwards. Any grid is taken, also one with an odd number of azimuth steps, which has no node
 * opposite another; bicubic and spline want steps of 90 degrees or less. Where the nodes of a pole
 * or the two ends of azimuth disagree, as in rounded files, their mean counts.
 * SRP_BAD_ARGUMENT (table not complete; steps too large for the scheme), SRP_BAD_DATA (a node is
 * not finite), SRP_NO_MEMORY. Ownership: *out is the caller's.
 */
SRP_API SRP_CHECK srp_status srp_interp_create(const srp_interp_scheme *scheme,
                                               const srp_table *table, srp_interp **out,
                                               srp_error *error);
SRP_API void srp_interp_destroy(srp_interp *interp);

SRP_API const srp_interp_scheme *srp_interp_get_scheme(const srp_interp *interp);
/* Whether the table knows moments; without them t and its derivatives are 0. */
SRP_API bool srp_interp_has_moment(const srp_interp *interp);

/*
 * Value, and derivatives if asked for, at one direction.
 *   s_body    unit vector spacecraft -> Sun, body frame; unit to 1e-9 (and then normalised)
 *   f         area vector [m^2], body frame
 *   t         moment vector [m^3] about the table's reference point, body frame; may be NULL
 *   jacobian  may be NULL
 * SRP_BAD_ARGUMENT: s is not a unit vector, or NaN; nothing else can happen, unless the interpolant
 * fills its table as it goes (srp_interp_create_on_demand(), srp/demand.h). Allocates nothing; any
 * number of threads at once. With `bilinear`, on the edge of a cell the derivatives are those
 * of one side, and at a pole those of the plane that fits the nearest nodes best.
 */
SRP_API SRP_CHECK srp_status srp_interp_eval(const srp_interp *interp, srp_vec3 s_body, srp_vec3 *f,
                                             srp_vec3 *t, srp_interp_jacobian *jacobian,
                                             srp_error *error);

/* ---- How wrong is it? ----------------------------------------------------------------------- */

/* `count` directions spread evenly over the sphere, of no grid, turned by `seed`: a Kronecker
 * sequence in the square (M. Roberts' R2), mapped by equal areas. The first n of a longer list are
 * the list of n. */
SRP_API void srp_interp_directions(size_t count, uint64_t seed, srp_vec3 *s_body);

/*
 * Errors of all schemes on a complete table in `count` >= 1 directions whose responses are known.
 * `seed` is noted in *out. SRP_BAD_ARGUMENT (incomplete table, a direction, no direction),
 * SRP_BAD_DATA, SRP_NO_MEMORY. srp_table_set_check() keeps it with the table.
 */
SRP_API SRP_CHECK srp_status srp_interp_check(const srp_table *table, size_t count,
                                              const srp_vec3 *s_body, const srp_response *responses,
                                              uint64_t seed, srp_table_check *out,
                                              srp_error *error);

SRP_END_DECLS

#endif
