/* SPDX-License-Identifier: Apache-2.0 */
/* How the triangles of a mesh hang together. Internal. */
#ifndef SRP_SRC_TOPOLOGY_H
#define SRP_SRC_TOPOLOGY_H

#include <srp/mesh.h>

#include <stdbool.h>
#include <stdint.h>

#define SRP_NO_TRIANGLE UINT32_MAX

/* Has the triangle no area? Twice its area is held against the square of its longest edge. */
bool srp_triangle_is_degenerate(srp_vec3 a, srp_vec3 b, srp_vec3 c);

/*
 * Triangles joined by edges that exactly two of them share, in opposite senses. Triangles that
 * repeat another one take no part, and of those without area only the ones that close a crack: all
 * three of their edges are shared so, where an edge on one side meets two on the other.
 */
typedef struct srp_component {
    uint32_t first;     /* lowest triangle of it */
    uint32_t triangles; /* how many */
    bool closed;        /* no rim: every edge is passed as often one way as the other */
    bool inward;        /* closed, and wound inside out: its volume is surely negative */
    double volume;      /* signed [m^3], of closed components; 0 otherwise */
    double noise;       /* what rounding may add to it [m^3] */
} srp_component;

typedef struct srp_topology {
    size_t triangle_count, vertex_count, component_count;
    uint32_t *weld;       /* (vertex_count) lowest vertex at the same place, -0 = +0 */
    srp_triangle *welded; /* (triangle_count) the triangles in terms of welded vertices */
    uint32_t *component;  /* (triangle_count) SRP_NO_TRIANGLE for those that take no part */
    srp_component *components;
    /* (triangle_count) triangle across edge v[k] -> v[(k+1)%3] when exactly two triangles share it
     * in opposite senses, else SRP_NO_TRIANGLE */
    uint32_t (*neighbour)[3];
    bool *degenerate; /* (triangle_count) no area, relative to its longest edge */
    bool *repeats;    /* (triangle_count) at the places of a lower one, with the same winding */
    /* As in srp_mesh_report. */
    size_t boundary_edges, nonmanifold_edges, inconsistent_edges, duplicate, opposite;
} srp_topology;

/* SRP_NO_MEMORY. */
srp_status srp_topology_create(const srp_mesh *mesh, srp_topology *out, srp_error *error);
/* Frees what the topology holds; fine on a zeroed one. */
void srp_topology_clear(srp_topology *topology);

#endif
