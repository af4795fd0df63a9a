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

/* Where the nodes of an interpolant on demand come from (interp_demand.c). */
typedef struct srp_interp_supply srp_interp_supply;

struct srp_interp {
    const srp_interp_scheme *scheme;
    bool has_moment;
    size_t width;
    uint32_t columns, rows; /* steps of azimuth and elevation */
    double columns_per_rad, rows_per_rad;
    /* Azimuth in columns from -180 degrees is az_base + az_scale times an arc tangent, by 2 (x <
     * 0), 1 (y < 0); elevation in rows from -90 likewise. */
    double az_base[8], az_scale[8], el_base[4], el_scale[4];
    /* (columns + 3, rows + 3, width): column i of the grid is at i + 1 and row j at j + 1, with one
     * more of each before the first and behind the last. Columns repeat; the rows beyond the poles
     * are the scheme's. Nodes, or what the scheme has made of them. */
    double *nodes;
    /* linear[0] + s_x linear[1] + s_y linear[2] + s_z linear[3] has been taken off the nodes. */
    double linear[4][SRP_INTERP_WIDTH_FT];
    srp_interp_pole poles[2];  /* south, north */
    srp_interp_supply *supply; /* NULL: all nodes are there */
};

/* Where a direction lies. */
typedef struct srp_interp_place {
    srp_vec3 s; /* normalised */
    double cos_el;
    uint32_t i, j; /* cell: between columns i and i + 1, rows j and j + 1 */
    double p, q;   /* place in the cell, 0 to 1, along azimuth and elevation */
} srp_interp_place;

static inline size_t srp_interp_column_size(const srp_interp *interp) {
    return ((size_t)interp->rows + 3) * interp->width;
}

/* Node of column -1 to columns + 1 and row -1 to rows + 1. */
static inline double *srp_interp_node(const srp_interp *interp, long i, long j) {
    return interp->nodes + (size_t)(i + 1) * srp_interp_column_size(interp) +
           (size_t)(j + 1) * interp->width;
}

/* The nodes that a look-up sees: rows j - 1 to j + 2, one after the other, of columns i - 1 to
 * i + 2, each `column` doubles behind the last. */
typedef struct srp_interp_stencil {
    const double *first;
    size_t column;
} srp_interp_stencil;

/* Those of cell (i, j) (`width` is that of the interpolant), of which a local scheme looks at the
 * inner ones as far as its `reach` says. Besides these, the local schemes need the poles, bicubic
 * the six nodes of the linear part, and cells with a pole those that srp_interp_fit_slopes() looks
 * at: interp_demand.c asks for them. */
static inline srp_interp_stencil srp_interp_stencil_of(const srp_interp *interp, uint32_t i,
                                                       uint32_t j, size_t width) {
    size_t column = ((size_t)interp->rows + 3) * width;
    srp_interp_stencil stencil = {interp->nodes + i * column + j * width, column};
    return stencil;
}

/* Sets columns, rows and what follows from them. */
void srp_interp_set_grid(srp_interp *interp, uint32_t columns, uint32_t rows);

/* Sets slope of both poles from a few nodes, evenly spread over the rows next to them. */
void srp_interp_fit_slopes(srp_interp *interp);

/* Cosine and sine of the azimuth of column i. */
void srp_interp_column_direction(const srp_interp *interp, uint32_t i, double *cosine,
                                 double *sine);

/* Fills the columns before the first and behind the last. */
void srp_interp_repeat_columns(srp_interp *interp);

/* Column of the grid that column -1, columns or columns + 1 repeats. */
static inline long srp_interp_repeated(const srp_interp *interp, long column) {
    const long n = (long)interp->columns;
    return column < 0 ? n - 1 : column == n || n == 1 ? 0 : 1;
}

/* SRP_BAD_ARGUMENT where the steps are too large for the scheme. */
srp_status srp_interp_check_steps(const srp_interp_scheme *scheme, srp_grid grid, srp_error *error);
/* Makes an interpolant of the nodes that `table` holds; the others are to be given by
 * srp_interp_put_node(). SRP_BAD_ARGUMENT (steps), SRP_BAD_DATA, SRP_NO_MEMORY. */
srp_status srp_interp_create_partial(const srp_interp_scheme *scheme, const srp_table *table,
                                     srp_interp **out, srp_error *error);
/* Puts a node into its place, and into those that repeat it or follow from it. Not for poles, and
 * once for each node. SRP_BAD_DATA (not finite). */
srp_status srp_interp_put_node(srp_interp *interp, srp_grid grid, uint32_t i, uint32_t j,
                               const srp_response *response, srp_error *error);

/* The six nodes nearest to the axes, which the linear part is fitted to. */
void srp_interp_axis_nodes(const srp_interp *interp, uint32_t at[6][2]);
/* How many nodes of the rows next to the poles slopes are fitted to: every (columns / count)-th; 0
 * where there are too few. */
uint32_t srp_interp_slope_nodes(const srp_interp *interp);

/* Sees to it that what a look-up at `s` needs is there; SRP_OK also where s is no direction. */
srp_status srp_interp_supply_at(const srp_interp *interp, const srp_vec3 *s, srp_error *error);
void srp_interp_supply_destroy(srp_interp_supply *supply);

#endif
