/* SPDX-License-Identifier: Apache-2.0 */
#include "raster_canvas.h"

#include "clones.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Samples that are drawn at once, and samples of a band of rows: 16 bytes each, so that a band
 * stays in the second-level cache. */
enum { LANES = 4, BAND_CELLS = 16384 };

#define END_OF_LIST UINT32_MAX

/* ---- memory ---- */

void srp_raster_canvas_clear(srp_raster_canvas *canvas) {
    free(canvas->depth);
    free(canvas->mark);
    free(canvas->span);
    free(canvas->run_end);
    free(canvas->first);
    free(canvas->next);
    free(canvas->alive);
    free(canvas->other);
    free(canvas->tally);
    free(canvas->push);
    srp_variation_clear(&canvas->variation);
    memset(canvas, 0, sizeof *canvas);
}

/* Samples that a row takes in memory: room for all lanes behind the last one, and for a sentinel.
 */
static size_t stride_of(const srp_lattice *lattice) {
    return (size_t)lattice->columns + LANES + 1;
}

static int32_t band_rows(const srp_lattice *lattice) {
    size_t rows = BAND_CELLS / stride_of(lattice);
    return rows < 1 ? 1 : (int32_t)rows;
}

static bool reserve_cells(srp_raster_canvas *canvas, size_t cells) {
    if (cells <= canvas->cell_capacity) {
        return true;
    }
    free(canvas->depth);
    free(canvas->mark);
    canvas->cell_capacity = 0;
    canvas->depth = malloc(cells * sizeof *canvas->depth);
    canvas->mark = calloc(cells, sizeof *canvas->mark);
    if (canvas->depth == NULL || canvas->mark == NULL) {
        return false;
    }
    for (size_t i = 0; i < cells; ++i) {
        canvas->depth[i] = -INFINITY;
    }
    canvas->cell_capacity = cells;
    return true;
}

static bool reserve_rows(srp_raster_canvas *canvas, size_t rows, size_t columns) {
    if (rows > canvas->row_capacity) {
        free(canvas->span);
        canvas->row_capacity = 0;
        canvas->span = malloc(rows * sizeof *canvas->span);
        if (canvas->span == NULL) {
            return false;
        }
        canvas->row_capacity = rows;
    }
    if (columns > canvas->column_capacity) {
        free(canvas->run_end);
        canvas->column_capacity = 0;
        canvas->run_end = malloc(columns * sizeof *canvas->run_end);
        if (canvas->run_end == NULL) {
            return false;
        }
        canvas->column_capacity = columns;
    }
    return true;
}

static bool reserve_bands(srp_raster_canvas *canvas, size_t bands) {
    if (bands > canvas->band_capacity) {
        free(canvas->first);
        canvas->band_capacity = 0;
        canvas->first = malloc(bands * sizeof *canvas->first);
        if (canvas->first == NULL) {
            return false;
        }
        canvas->band_capacity = bands;
    }
    return true;
}

static bool reserve_facets(srp_raster_canvas *canvas, size_t count) {
    if (count <= canvas->facet_capacity) {
        return true;
    }
    free(canvas->tally);
    free(canvas->push);
    free(canvas->next);
    free(canvas->alive);
    free(canvas->other);
    canvas->facet_capacity = 0;
    canvas->tally = malloc(count * sizeof *canvas->tally);
    canvas->push = malloc(count * sizeof *canvas->push);
    canvas->next = malloc(count * sizeof *canvas->next);
    canvas->alive = malloc(count * sizeof *canvas->alive);
    canvas->other = malloc(count * sizeof *canvas->other);
    if (canvas->tally == NULL || canvas->push == NULL || canvas->next == NULL ||
        canvas->alive == NULL || canvas->other == NULL) {
        return false;
    }
    canvas->facet_capacity = count;
    return true;
}

bool srp_raster_canvas_begin(srp_raster_canvas *canvas, const srp_raster_frame *frame) {
    const srp_lattice *lattice = &frame->lattice;
    size_t rows = (size_t)band_rows(lattice);
    size_t bands = (size_t)lattice->rows / rows + 1;
    if (!reserve_cells(canvas, rows * stride_of(lattice)) ||
        !reserve_rows(canvas, rows, (size_t)lattice->columns) || !reserve_bands(canvas, bands) ||
        !reserve_facets(canvas, frame->facet_count) ||
        !srp_variation_begin(&canvas->variation, frame->kind, lattice)) {
        return false;
    }
    if (frame->facet_count > 0) { /* memset of no bytes still asks for a pointer */
        memset(canvas->tally, 0, frame->facet_count * sizeof *canvas->tally);
    }
    return true;
}

void srp_raster_canvas_merge(srp_raster_canvas *into, const srp_raster_canvas *from,
                             const srp_raster_frame *frame) {
    for (size_t n = 0; n < frame->facet_count; ++n) {
        into->tally[n].n += from->tally[n].n;
        into->tally[n].i += from->tally[n].i;
        into->tally[n].j += from->tally[n].j;
    }
    srp_variation_merge(&into->variation, &from->variation);
}

/* ---- drawing ---- */

typedef struct raster_band {
    double *depth;
    uint64_t *mark;
    int32_t (*span)[2];
    size_t stride;
    int32_t row_begin, row_end;
    double columns; /* of the lattice */
    double tie;
} raster_band;

/* LANES samples from `depth` and `marks` on, of which the first `left` are asked: keeps those where
 * height + k slope is nearest. One loop of fixed length without branches, that compilers turn into
 * a few vector instructions with masked or blended stores. */
static inline void draw_lanes(double *restrict depth, uint64_t *restrict marks, double left,
                              double height, double slope, double tie, uint64_t mark) {
    static const double LANE[LANES] = {0.0, 1.0, 2.0, 3.0};
#pragma GCC unroll 1
    for (int k = 0; k < LANES; ++k) {
        double here = height + slope * LANE[k];
        double kept = depth[k];
        uint64_t kept_mark = marks[k];
        here = LANE[k] < left ? here : -INFINITY;
        depth[k] = here > kept ? here + tie : kept;
        marks[k] = here > kept ? mark : kept_mark;
    }
}

/* Where an edge crosses row j: x + (j - y) slope. */
typedef struct raster_edge {
    double x, y, slope;
} raster_edge;

static inline raster_edge edge_between(const srp_raster_frame *frame, uint32_t low, uint32_t high) {
    raster_edge edge;
    edge.x = frame->x[low];
    edge.y = frame->y[low];
    edge.slope = (frame->x[high] - edge.x) / (frame->y[high] - edge.y);
    return edge;
}

static inline double crossing(const raster_edge *edge, double row) {
    return edge->x + (row - edge->y) * edge->slope;
}

/* A facet ready to be drawn row by row. */
typedef struct raster_facet {
    raster_edge tall;      /* the edge over all its rows */
    raster_edge low, high; /* those below and from row_middle on */
    int32_t row_middle;
    bool tall_is_left;
    srp_raster_plane plane;
} raster_facet;

/* Puts a and b in order of y; true when they were not. Without branches: the order is random. */
static inline bool order(const double *y, uint32_t *a, uint32_t *b) {
    bool swap = y[*b] < y[*a];
    uint32_t low = swap ? *b : *a, high = swap ? *a : *b;
    *a = low;
    *b = high;
    return swap;
}

static inline raster_facet set_up_facet(const srp_raster_frame *frame, uint32_t k) {
    uint32_t a = frame->mesh->v[k][0], b = frame->mesh->v[k][1], c = frame->mesh->v[k][2];
    bool clockwise = order(frame->y, &a, &b);
    clockwise ^= order(frame->y, &b, &c);
    clockwise ^= order(frame->y, &a, &b);
    clockwise ^= frame->cosine[k] < 0.0;
    raster_facet facet;
    facet.tall = edge_between(frame, a, c);
    facet.low = edge_between(frame, a, b);
    facet.high = edge_between(frame, b, c);
    facet.row_middle = frame->ceiling[b][1];
    /* Counter-clockwise round a-b-c the tall edge is passed downwards: it is the left one. */
    facet.tall_is_left = !clockwise;
    facet.plane = srp_raster_frame_plane(frame, k, a);
    return facet;
}

static inline void draw_row(const raster_band *band, const raster_facet *facet, int32_t j,
                            uint64_t mark) {
    double y = (double)j;
    double tall = crossing(&facet->tall, y);
    double other = crossing(j < facet->row_middle ? &facet->low : &facet->high, y);
    double left = facet->tall_is_left ? tall : other;
    double right = facet->tall_is_left ? other : tall;
    int32_t i0 = srp_ceil_within(left, band->columns);
    int32_t i1 = srp_ceil_within(right, band->columns);
    if (i0 >= i1) {
        return;
    }
    size_t row = (size_t)(j - band->row_begin);
    int32_t *span = band->span[row];
    span[0] = i0 < span[0] ? i0 : span[0];
    span[1] = i1 > span[1] ? i1 : span[1];
    double *depth = band->depth + row * band->stride;
    uint64_t *marks = band->mark + row * band->stride;
    double height = facet->plane.at + y * facet->plane.along_j;
    for (int32_t i = i0; i < i1; i += LANES) {
        draw_lanes(depth + i, marks + i, (double)(i1 - i),
                   height + (double)i * facet->plane.along_i, facet->plane.along_i, band->tie,
                   mark);
    }
}

SRP_TARGET_CLONES
static void draw_facets(const raster_band *band, const srp_raster_frame *frame,
                        const uint32_t *list, size_t count, srp_push *push) {
    const srp_vec3 s = frame->lattice.view.s;
    for (size_t k = 0; k < count; ++k) {
        uint32_t n = list[k];
        raster_facet facet = set_up_facet(frame, frame->facet[n]);
        srp_raster_side side = srp_raster_frame_side(frame, frame->facet[n]);
        push[n] = srp_push_make(srp_raster_side_push(&side, s));
        const int32_t *rows = frame->rows[n];
        int32_t begin = rows[0] > band->row_begin ? rows[0] : band->row_begin;
        int32_t end = rows[1] < band->row_end ? rows[1] : band->row_end;
        for (int32_t j = begin; j < end; ++j) {
            draw_row(band, &facet, j, (uint64_t)n + 1);
        }
    }
}

/* ---- counting ---- */

/* Lists where runs of equal marks end in columns [begin, end); returns how many. Without branches
 * on what is there: runs are short, and guessing their ends wrong costs more than looking. */
static inline size_t find_runs(const uint64_t *restrict marks, int32_t begin, int32_t end,
                               int32_t *restrict run_end) {
    size_t count = 0;
    for (int32_t i = begin; i < end; ++i) {
        run_end[count] = i + 1;
        count += marks[i] != marks[i + 1];
    }
    return count;
}

/* Wipes columns [begin, end) of a row. */
static inline void wipe_row(double *restrict depth, uint64_t *restrict marks, int32_t begin,
                            int32_t end) {
    memset(marks + begin, 0, (size_t)(end - begin + 1) * sizeof *marks);
    for (int32_t i = begin; i < end; ++i) {
        depth[i] = -INFINITY;
    }
}

/* Tallies one row, and wipes it. */
static inline void count_row(srp_raster_canvas *canvas, double *restrict depth,
                             uint64_t *restrict marks, const int32_t *span, int32_t j) {
    const int32_t begin = span[0], end = span[1];
    marks[end] = UINT64_MAX;
    size_t runs = find_runs(marks, begin, end, canvas->run_end);
    int32_t i = begin;
    for (size_t n = 0; n < runs; ++n) {
        int32_t run_end = canvas->run_end[n];
        uint64_t mark = marks[i];
        if (mark != 0) {
            srp_raster_tally *tally = &canvas->tally[mark - 1];
            int64_t length = run_end - i;
            tally->n += length;
            tally->i += length * (i + run_end - 1) / 2;
            tally->j += length * j;
            srp_variation_add(&canvas->variation, i, run_end, j, &canvas->push[mark - 1]);
        }
        i = run_end;
    }
    wipe_row(depth, marks, begin, end);
}

SRP_TARGET_CLONES
static void count_rows(srp_raster_canvas *canvas, const raster_band *band) {
    for (int32_t j = band->row_begin; j < band->row_end; ++j) {
        size_t row = (size_t)(j - band->row_begin);
        if (band->span[row][0] < band->span[row][1]) {
            count_row(canvas, band->depth + row * band->stride, band->mark + row * band->stride,
                      band->span[row], j);
        }
    }
}

/* Tells of all runs, and wipes the rows. */
static void visit_rows(srp_raster_canvas *canvas, const raster_band *band, srp_raster_visit visit,
                       void *user) {
    for (int32_t j = band->row_begin; j < band->row_end; ++j) {
        size_t row = (size_t)(j - band->row_begin);
        const int32_t begin = band->span[row][0], end = band->span[row][1];
        if (begin >= end) {
            continue;
        }
        uint64_t *marks = band->mark + row * band->stride;
        marks[end] = UINT64_MAX;
        size_t runs = find_runs(marks, begin, end, canvas->run_end);
        int32_t i = begin;
        for (size_t n = 0; n < runs; ++n) {
            if (marks[i] != 0) {
                visit(user, (uint32_t)(marks[i] - 1), i, canvas->run_end[n], j);
            }
            i = canvas->run_end[n];
        }
        wipe_row(band->depth + row * band->stride, marks, begin, end);
    }
}

/* ---- bands ---- */

/* Chains the facets of rows [row_begin, row_end) by the first band that they touch, each chain in
 * ascending order. */
static void chain_facets(srp_raster_canvas *canvas, const srp_raster_frame *frame,
                         int32_t row_begin, int32_t row_end, int32_t rows, size_t bands) {
    for (size_t b = 0; b < bands; ++b) {
        canvas->first[b] = END_OF_LIST;
    }
    for (size_t n = frame->facet_count; n-- > 0;) {
        const int32_t *own = frame->rows[n];
        if (own[0] < row_end && own[1] > row_begin) {
            int32_t row = own[0] > row_begin ? own[0] - row_begin : 0;
            uint32_t *first = &canvas->first[row / rows];
            canvas->next[n] = *first;
            *first = (uint32_t)n;
        }
    }
}

/* Merges facets that begin in this band into those that go on from the one before, both ascending,
 * without those that ended before `row`. Leaves the list in canvas->alive; returns its length. */
static size_t merge_facets(srp_raster_canvas *canvas, const srp_raster_frame *frame,
                           size_t alive_count, uint32_t chain, int32_t row) {
    size_t count = 0;
    for (size_t a = 0; a < alive_count || chain != END_OF_LIST;) {
        if (a < alive_count && (chain == END_OF_LIST || canvas->alive[a] < chain)) {
            uint32_t n = canvas->alive[a++];
            canvas->other[count] = n;
            count += frame->rows[n][1] > row;
        } else {
            canvas->other[count++] = chain;
            chain = canvas->next[chain];
        }
    }
    uint32_t *swap = canvas->alive;
    canvas->alive = canvas->other;
    canvas->other = swap;
    return count;
}

/* Draws rows band by band; then `visit` is told what they show, or, if it is NULL, they are
 * counted.
 */
static void draw_bands(srp_raster_canvas *canvas, const srp_raster_frame *frame, int32_t row_begin,
                       int32_t row_end, srp_raster_visit visit, void *user) {
    int32_t rows = band_rows(&frame->lattice);
    size_t bands = (size_t)((row_end - row_begin + rows - 1) / rows);
    raster_band band = {.depth = canvas->depth,
                        .mark = canvas->mark,
                        .span = canvas->span,
                        .stride = stride_of(&frame->lattice),
                        .columns = frame->lattice.columns,
                        .tie = frame->tie};
    chain_facets(canvas, frame, row_begin, row_end, rows, bands);
    size_t alive_count = 0;
    for (size_t b = 0; b < bands; ++b) {
        band.row_begin = row_begin + (int32_t)b * rows;
        band.row_end = band.row_begin + rows < row_end ? band.row_begin + rows : row_end;
        for (int32_t row = 0; row < rows; ++row) {
            band.span[row][0] = INT32_MAX;
            band.span[row][1] = 0;
        }
        alive_count = merge_facets(canvas, frame, alive_count, canvas->first[b], band.row_begin);
        draw_facets(&band, frame, canvas->alive, alive_count, canvas->push);
        if (visit != NULL) {
            visit_rows(canvas, &band, visit, user);
        } else {
            count_rows(canvas, &band);
        }
    }
}

void srp_raster_canvas_count(srp_raster_canvas *canvas, const srp_raster_frame *frame,
                             int32_t row_begin, int32_t row_end) {
    draw_bands(canvas, frame, row_begin, row_end, NULL, NULL);
}

void srp_raster_canvas_visit(srp_raster_canvas *canvas, const srp_raster_frame *frame,
                             int32_t row_begin, int32_t row_end, srp_raster_visit visit,
                             void *user) {
    draw_bands(canvas, frame, row_begin, row_end, visit, user);
}
