/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The samples of a lattice, and what each of them hits first: facets of a frame are drawn with a
 * depth buffer, in double precision, and counted. Memory is that of a few rows. Internal.
 */
#ifndef SRP_SRC_RASTER_CANVAS_H
#define SRP_SRC_RASTER_CANVAS_H

#include "raster_frame.h"
#include "variation.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What was counted for a facet: samples, and sums of their columns and rows. */
typedef struct srp_raster_tally {
    int64_t n, i, j;
} srp_raster_tally;

typedef struct srp_raster_canvas {
    /* Of one band of rows. Clean between calls: depths -INFINITY, marks 0. */
    double *depth;
    uint64_t *mark;     /* 0 = nothing hit, else 1 + index into frame.facet */
    int32_t (*span)[2]; /* columns drawn on, per row */
    int32_t *run_end;   /* ends of runs of equal marks in one row */
    size_t cell_capacity, row_capacity, column_capacity;

    /* Facets by the band that they begin in: chains, and the list of those in this band. */
    uint32_t *first; /* per band */
    uint32_t *next, *alive, *other;
    size_t band_capacity, facet_capacity;

    srp_raster_tally *tally; /* one per facet of the frame */
    srp_push *push;          /* of light on it, once it has been drawn */
    srp_variation variation;
} srp_raster_canvas;

/* Empties the tallies and makes room for a frame; false when there is no memory. A zeroed struct is
 * a fresh canvas. */
bool srp_raster_canvas_begin(srp_raster_canvas *canvas, const srp_raster_frame *frame);
void srp_raster_canvas_clear(srp_raster_canvas *canvas);

/* Adds what the samples of rows [row_begin, row_end) hit to the tallies. Allocates nothing. */
void srp_raster_canvas_count(srp_raster_canvas *canvas, const srp_raster_frame *frame,
                             int32_t row_begin, int32_t row_end);

/* What is told of samples [begin, end) of row j, all on one facet; `n` is an index into
 * frame->facet. */
typedef void (*srp_raster_visit)(void *user, uint32_t n, int32_t begin, int32_t end, int32_t j);

/* Instead of counting what the samples of rows [row_begin, row_end) hit, tells `visit`: rows from
 * the first to the last, in each the runs of samples on one facet from left to right. */
void srp_raster_canvas_visit(srp_raster_canvas *canvas, const srp_raster_frame *frame,
                             int32_t row_begin, int32_t row_end, srp_raster_visit visit,
                             void *user);

/* Adds the tallies of `from`, a canvas of the same frame. */
void srp_raster_canvas_merge(srp_raster_canvas *into, const srp_raster_canvas *from,
                             const srp_raster_frame *frame);

#endif
