/* SPDX-License-Identifier: Apache-2.0 */
/* Convex polygons in the plane: cut by a line, freed from what lies behind others, measured.
 * Internal to the exact method. */
#ifndef SRP_SRC_EXACT_POLYGON_H
#define SRP_SRC_EXACT_POLYGON_H

#include "exact_pairs.h"

#include <srp/status.h>

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct srp_point2 {
    double x, y;
} srp_point2;

/*
 * A directed line: a x + b y + c is positive on its inner (left) side. The scale of (a, b, c) is
 * free; `slack` is in the same scale and says how near to the line a point counts as on it: the
 * rounding noise of coordinates. Without it, the two neighbours at a shared edge would leave a
 * polygon of no width between them in whatever they hide, and those would multiply.
 */
typedef struct srp_line2 {
    double a, b, c;
    double slack;
} srp_line2;

static inline double srp_line2_value(const srp_line2 *line, srp_point2 p) {
    return line->a * p.x + line->b * p.y + line->c;
}

/* Room in a polygon, and the size above which one is kept as two: a cut adds one corner, an
 * occluder makes at most five cuts. */
enum { SRP_POLYGON_ROOM = 16, SRP_POLYGON_KEPT = 8 };

/* Convex, counter-clockwise; empty when count is 0. */
typedef struct srp_polygon {
    uint32_t count;
    srp_point2 p[SRP_POLYGON_ROOM];
} srp_polygon;

/* What one face hides: the common inside of up to five lines. */
enum { SRP_OCCLUDER_LINES = 5 };
typedef struct srp_occluder {
    srp_line2 line[SRP_OCCLUDER_LINES];
    uint32_t line_count;
} srp_occluder;

/* Area and first moments about the origin of the image. */
typedef struct srp_moments {
    double area, x, y;
} srp_moments;

/* A piece of a face, with its box (of the precision of float, whichever way rounded). */
typedef struct srp_piece {
    float x0, y0, x1, y1;
    srp_polygon polygon;
} srp_piece;

/* Memory of srp_polygon_visible(): zero-initialise, reuse, free. `lists` is filled by the caller:
 * the box of every occluder, `id` its index, widened by the rounding of two numbers to float. With
 * `keep`, what is left is added to `kept`. */
typedef struct srp_visible_scratch {
    srp_box_stack lists;
    srp_piece *piece;
    size_t piece_count, piece_capacity;
    bool keep;
    srp_polygon *kept;
    size_t kept_count, kept_capacity;
} srp_visible_scratch;

void srp_visible_scratch_free(srp_visible_scratch *scratch);

/* The box of a polygon with corners, each side rounded to the nearest float. */
srp_box2 srp_polygon_box(const srp_polygon *polygon);

/* Keeps of a polygon of up to SRP_POLYGON_KEPT corners what is inside; false when that is nothing.
 */
bool srp_polygon_keep(srp_polygon *polygon, const srp_occluder *inside);

/*
 * Adds to *out what is left of `polygon` when the insides of `count` occluders are taken away, the
 * boxes of which are the first of scratch->lists. SRP_OK or SRP_NO_MEMORY.
 */
srp_status srp_polygon_visible(srp_visible_scratch *scratch, const srp_polygon *polygon,
                               const srp_occluder *occluders, size_t count, srp_moments *out);

#endif
