/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Which facet each ray of a lattice hits first, by drawing instead of searching: rays are parallel,
 * so facets are projected along them, drawn into the lattice, and each sample keeps the one that is
 * nearest to the Sun. Here: what is drawn. How: raster_canvas.h. Internal.
 *
 * In three steps, so that threads can share the work on one direction:
 *   mesh    the scene laid out for the rasteriser; made once, read-only
 *   frame   all facets that may be seen, in lattice coordinates; made per direction, then read-only
 *   canvas  samples of a few rows and what was counted in them; one per thread
 *
 * A sample belongs to exactly one of the facets that tile a surface: where an edge crosses a row is
 * computed from its two vertices alone, in the same order for both facets that share it, and a
 * sample on an edge belongs to the facet on its right.
 */
#ifndef SRP_SRC_RASTER_FRAME_H
#define SRP_SRC_RASTER_FRAME_H

#include "lattice.h"
#include "scene_internal.h"
#include "variation.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* One side of a material: light of cross-section A that falls on it at the cosine c, n turned to
 * the Sun, pushes by -A [along s + (specular c + diffuse) n] (docs/theory.md, "The force on one
 * facet"). */
typedef struct srp_raster_surface {
    double along, specular, diffuse;
    size_t row; /* of the sums per material: the last for backs that absorb */
} srp_raster_surface;

typedef struct srp_raster_mesh {
    size_t vertex_count, facet_count;
    double *x, *y, *z;    /* (vertex_count) */
    double *nx, *ny, *nz; /* (facet_count) outward */
    uint32_t (*v)[3];     /* (facet_count) */
    uint32_t *material;   /* (facet_count) */
    bool *open;           /* (facet_count) the back can be seen too */
    bool all_closed;
    srp_raster_surface (*surface)[2]; /* (material count) front, back */
} srp_raster_mesh;

bool srp_raster_mesh_create(srp_raster_mesh *mesh, const srp_scene *scene);
void srp_raster_mesh_clear(srp_raster_mesh *mesh);

typedef struct srp_raster_frame {
    const srp_raster_mesh *mesh;
    srp_lattice_kind kind;
    srp_lattice lattice;
    srp_extent extent;     /* of the mesh along the axes of the lattice */
    double *x, *y, *depth; /* (vertex_count) lattice coordinates; [m] */
    int32_t (*ceiling)[2]; /* (vertex_count) first sample at or behind x, first row at or above y */
    double *cosine;        /* (mesh.facet_count) n.s */
    double tie;            /* heights that differ by less are one [m] */

    /* Facets that a sample may hit, in the order that breaks ties of depth. */
    size_t facet_count;
    uint32_t *facet;    /* into the scene's */
    int32_t (*rows)[2]; /* [begin, end) */
} srp_raster_frame;

bool srp_raster_frame_create(srp_raster_frame *frame, const srp_raster_mesh *mesh);
void srp_raster_frame_clear(srp_raster_frame *frame);
/* Projects the mesh; returns what is seen of it, along `axes`. */
srp_extent srp_raster_frame_project(srp_raster_frame *frame, const srp_view *axes);
/* Goes over to the coordinates of a lattice along the same axes, and lists the facets. Once per
 * projection. */
void srp_raster_frame_bind(srp_raster_frame *frame, srp_lattice_kind kind,
                           const srp_lattice *lattice);

/* Whether a fixed window leaves out part of the silhouette, and whether it may leave out part of a
 * facet: no sample of the lattice stands for the place of one of its vertices. */
bool srp_raster_frame_is_cut(const srp_raster_frame *frame);
bool srp_raster_frame_cuts(const srp_raster_frame *frame, const srp_facet *facet);

/* The first integer not below t, held within [0, most]. */
static inline int32_t srp_ceil_within(double t, double most) {
    t = t > 0.0 ? t : 0.0;
    t = t < most ? t : most;
    int32_t whole = (int32_t)t;
    return whole + (whole < t);
}

/* Height towards the Sun over the lattice: at + i along_i + j along_j [m]. */
typedef struct srp_raster_plane {
    double at, along_i, along_j;
} srp_raster_plane;

/* A facet (of the scene) as light meets it. */
typedef struct srp_raster_side {
    const srp_raster_surface *surface;
    srp_vec3 normal; /* turned to the Sun */
    double cosine;   /* > 0 */
} srp_raster_side;

static inline srp_raster_side srp_raster_frame_side(const srp_raster_frame *frame, uint32_t facet) {
    const srp_raster_mesh *mesh = frame->mesh;
    bool back = frame->cosine[facet] < 0.0;
    double sign = back ? -1.0 : 1.0;
    srp_raster_side side;
    side.surface = &mesh->surface[mesh->material[facet]][back];
    side.normal =
        srp_vec3_make(sign * mesh->nx[facet], sign * mesh->ny[facet], sign * mesh->nz[facet]);
    side.cosine = sign * frame->cosine[facet];
    return side;
}

/* Force per unit of lit cross-section. */
static inline srp_vec3 srp_raster_side_push(const srp_raster_side *side, srp_vec3 s) {
    double inwards = side->surface->specular * side->cosine + side->surface->diffuse;
    return srp_vec3_add_scaled(srp_vec3_scale(-side->surface->along, s), -inwards, side->normal);
}

/* The plane of a facet (of the scene), through its vertex v. */
static inline srp_raster_plane srp_raster_frame_plane(const srp_raster_frame *frame, uint32_t facet,
                                                      uint32_t v) {
    const srp_raster_mesh *mesh = frame->mesh;
    const srp_lattice *lattice = &frame->lattice;
    srp_vec3 n = srp_vec3_make(mesh->nx[facet], mesh->ny[facet], mesh->nz[facet]);
    double per_metre = -1.0 / frame->cosine[facet];
    srp_raster_plane plane;
    plane.along_i = srp_vec3_dot(n, lattice->view.u) * per_metre * lattice->du;
    plane.along_j = srp_vec3_dot(n, lattice->view.v) * per_metre * lattice->dv;
    plane.at = frame->depth[v] - plane.along_i * frame->x[v] - plane.along_j * frame->y[v];
    return plane;
}

#endif
