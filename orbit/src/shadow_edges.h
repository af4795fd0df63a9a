/* SPDX-License-Identifier: Apache-2.0 */
/* Edges of shadows within a step of the propagator. Internal. */
#ifndef SRP_ORBIT_SRC_SHADOW_EDGES_H
#define SRP_ORBIT_SRC_SHADOW_EDGES_H

#include <srp/orbit/propagator.h>

/* A step as an interpolant: position, velocity and acceleration at both ends, a polynomial of
 * degree 5 between them. */
typedef struct srp_arc {
    double t, h; /* from t to t + h */
    srp_vec3 r[2], v[2], a[2];
} srp_arc;

srp_vec3 srp_arc_position(const srp_arc *arc, double share);
srp_vec3 srp_arc_velocity(const srp_arc *arc, double share);

/* Penumbra, umbra, antumbra of each body. */
enum { SRP_EDGE_KINDS = 3, SRP_EDGE_COUNT = 3 * SRP_CELESTIAL_COUNT };

typedef struct srp_edges {
    const srp_force_list *forces;
    const srp_shadow *shadow;
    bool inside[SRP_EDGE_COUNT]; /* body by body: which shadows we are in */
} srp_edges;

/* How deep r lies in a shadow [rad], below 0 outside: edge 3 body + kind. */
double srp_edges_depth(const srp_edges *edges, int edge, double t, srp_vec3 r);
/* Sets `inside` for a state. */
void srp_edges_begin(srp_edges *edges, double t, srp_vec3 r);

/* The first edge that the arc crosses: its number and where on the arc (0 to 1]; -1: none. */
int srp_edges_first(const srp_edges *edges, const srp_arc *arc, double *share);

#endif
