/* SPDX-License-Identifier: Apache-2.0 */
/* The inside of interpolants, shared by the schemes. Internal. */
#ifndef SRP_SRC_INTERP_INTERNAL_H
#define SRP_SRC_INTERP_INTERNAL_H

#include <srp/interp.h>

#include <stddef.h>
#include <stdint.h>

/* Doubles per node: f and one of padding, or f, t and two of padding; a node of the wider kind is
 * one line of the cache. */
enum { SRP_INTERP_WIDTH_F = 4, SRP_INTERP_WIDTH_FT = 8, SRP_INTERP_T = 3 };

/* What is known of the field around a pole, per component: value + d (slope . (cos az, sin az)) +
 * d^2/2 (curve . (1, cos 2 az, sin 2 az)), d the distance from the pole in rows. */
typedef struct srp_interp_pole {
    double value[SRP_INTERP_WIDTH_FT];
    double slope[2][SRP_INTERP_WIDTH_FT];
    double curve[3][SRP_INTERP_WIDTH_FT]; /* 0 for schemes that have no use for it */
} srp_interp_pole;

struct srp_interp {
    const srp_interp_scheme *scheme;
    bool has_moment;
    size_t width;
    uint32_t columns, rows; /* steps of azimuth and elevation */
    double columns_per_rad, rows_per_rad;
    /* (columns + 3, rows + 3, width): column i of the grid is at i + 1 and row j at j + 1, with one
     * more of each before the first and behind the last. Columns repeat; the rows beyond the poles
     * are the scheme's. Nodes, or what the scheme has made of them. */
    double *nodes;
    /* linear[0] + s_x linear[1] + s_y linear[2] + s_z linear[3] has been taken off the nodes. */
    double linear[4][SRP_INTERP_WIDTH_FT];
    srp_interp_pole poles[2]; /* south, north */
};

/* Where a direction lies. */
typedef struct srp_interp_place {
    srp_vec3 s; /* normalised */
    double cos_az, sin_az, cos_el;
    uint32_t i, j; /* cell: between columns i and i + 1, rows j and j + 1 */
    double p, q;   /* place in the cell, 0 to 1, along azimuth and elevation */
    int pole;      /* in the cells around a pole -1 (south) or 1 (north), else 0 */
    double theta;  /* [rad] distance from that pole, without loss near it */
} srp_interp_place;

/* False unless `s` is a unit vector. */
bool srp_interp_locate(const srp_interp *interp, srp_vec3 s, srp_interp_place *place);

static inline size_t srp_interp_column_size(const srp_interp *interp) {
    return ((size_t)interp->rows + 3) * interp->width;
}

/* Node of column -1 to columns + 1 and row -1 to rows + 1. */
static inline double *srp_interp_node(const srp_interp *interp, long i, long j) {
    return interp->nodes + (size_t)(i + 1) * srp_interp_column_size(interp) +
           (size_t)(j + 1) * interp->width;
}

/*
 * The nodes that a look-up in cell (i, j) sees: column[k] points to rows j - 1 to j + 2, one after
 * the other, of column i - 1 + k. All local schemes get at nodes here and nowhere else, so that
 * this is the place where a table that is being filled can be asked for them.
 */
static inline void srp_interp_stencil(const srp_interp *interp, uint32_t i, uint32_t j,
                                      const double *column[4]) {
    size_t size = srp_interp_column_size(interp);
    const double *first = srp_interp_node(interp, (long)i - 1, (long)j - 1);
    for (size_t k = 0; k < 4; ++k) {
        column[k] = first + k * size;
    }
}

/* The pole of a place whose `pole` is not 0. */
static inline const srp_interp_pole *srp_interp_pole_of(const srp_interp *interp,
                                                        const srp_interp_place *place) {
    return &interp->poles[place->pole > 0];
}

/* theta / sin theta, 1 at the pole. */
static inline double srp_interp_arc_ratio(const srp_interp_place *place) {
    return place->cos_el > 0.0 ? place->theta / place->cos_el : 1.0;
}

/* Sets slope of both poles from a few nodes, evenly spread over the rows next to them. */
void srp_interp_fit_slopes(srp_interp *interp);

/* Cosine and sine of the azimuth of column i. */
void srp_interp_column_direction(const srp_interp *interp, uint32_t i, double *cosine,
                                 double *sine);

/* Fills the columns before the first and behind the last. */
void srp_interp_repeat_columns(srp_interp *interp);

#endif
