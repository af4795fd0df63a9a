/* SPDX-License-Identifier: Apache-2.0 */
/* What the tests of interpolants share: tables of given fields. */
#ifndef SRP_INTERP_FIXTURE_H
#define SRP_INTERP_FIXTURE_H

#include <srp/interp.h>

#include <stdint.h>

/* A field on the sphere: f and t of a direction. */
typedef struct field_value {
    srp_vec3 f, t;
} field_value;
typedef field_value field_function(srp_vec3 s);

/* Smooth, of no symmetry, all derivatives of like size everywhere. */
field_value smooth_field(srp_vec3 s);

/* A complete table of a field; NULL: random numbers of [-1, 1] at each node, one at each pole. */
srp_table *field_table(uint32_t az_steps, uint32_t el_steps, bool moment, field_function *field);

/* Sets f and t of a node. */
void set_node(srp_table *table, uint32_t i, uint32_t j, field_value value);

srp_interp *make_interp(const srp_interp_scheme *scheme, const srp_table *table);
/* The interpolant of a field at once. */
srp_interp *field_interp(const srp_interp_scheme *scheme, uint32_t az_steps, uint32_t el_steps,
                         field_function *field);

field_value ask(const srp_interp *interp, srp_vec3 s);
srp_interp_jacobian ask_slopes(const srp_interp *interp, srp_vec3 s);

/* |difference| of f and t together. */
double field_distance(field_value a, field_value b);
/* Largest difference of elements, and largest element. */
double jacobian_distance(const srp_interp_jacobian *a, const srp_interp_jacobian *b);
double jacobian_size(const srp_interp_jacobian *a);

/* A direction at an angle [rad] from `s`, towards `towards`. */
srp_vec3 turned_towards(srp_vec3 s, srp_vec3 towards, double angle);

#endif
