/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What is left of a convex polygon when convex shapes are taken away.
 *
 * The polygon is kept as a list of disjoint convex pieces. To take one occluder away from a piece,
 * walk along the occluder's lines: what lies outside the line is a convex piece that stays, what
 * lies inside goes on to the next line; what is inside all of them is hidden. When nothing is
 * inside all of them, the piece did not meet the occluder and is kept as it was, uncut.
 *
 * One after the other, k small occluders in front of one large face cost k times the number of
 * pieces, which grows with k: a solar panel behind an antenna of 10,000 triangles would take
 * seconds. So a long list is divided: cut the polygon in two across the crowd of its occluders,
 * give each half those that reach it, and begin again.
 */
#include "exact_polygon.h"

#include <stdlib.h>

/* List length from which dividing pays, and how deep it may go. */
enum { DIVIDE_ABOVE = 16, DIVIDE_DEPTH_MAX = 40 };

static void push(srp_polygon *polygon, srp_point2 p) {
    /* A convex polygon crosses a line twice; the guard is for what rounding might make of one. */
    if (polygon->count < SRP_POLYGON_ROOM) {
        polygon->p[polygon->count++] = p;
    }
}

static void copy_polygon(srp_polygon *to, const srp_polygon *from) {
    to->count = from->count;
    for (uint32_t k = 0; k < from->count; ++k) {
        to->p[k] = from->p[k];
    }
}

typedef enum side { SIDE_INSIDE, SIDE_OUTSIDE, SIDE_BOTH } side;

static side side_of(const srp_polygon *polygon, const srp_line2 *line, double *value) {
    bool inside = false, outside = false;
    for (uint32_t k = 0; k < polygon->count; ++k) {
        value[k] = srp_line2_value(line, polygon->p[k]);
        inside |= value[k] > line->slack;
        outside |= value[k] < -line->slack;
    }
    return !inside ? SIDE_OUTSIDE : outside ? SIDE_BOTH : SIDE_INSIDE;
}

/* Cuts along a line that has corners on both sides; `value` from side_of(). */
static void cut(const srp_polygon *polygon, double slack, const double *value, srp_polygon *in,
                srp_polygon *out) {
    in->count = out->count = 0;
    for (uint32_t k = 0; k < polygon->count; ++k) {
        uint32_t next = k + 1 == polygon->count ? 0 : k + 1;
        srp_point2 p = polygon->p[k], q = polygon->p[next];
        if (value[k] >= -slack) {
            push(in, p);
        }
        if (value[k] <= slack) {
            push(out, p);
        }
        if ((value[k] > slack && value[next] < -slack) ||
            (value[k] < -slack && value[next] > slack)) {
            double t = value[k] / (value[k] - value[next]);
            srp_point2 x = {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
            push(in, x);
            push(out, x);
        }
    }
}

srp_box2 srp_polygon_box(const srp_polygon *polygon) {
    double x0 = polygon->p[0].x, y0 = polygon->p[0].y, x1 = x0, y1 = y0;
    for (uint32_t k = 1; k < polygon->count; ++k) {
        double x = polygon->p[k].x, y = polygon->p[k].y;
        x0 = x < x0 ? x : x0;
        x1 = x > x1 ? x : x1;
        y0 = y < y0 ? y : y0;
        y1 = y > y1 ? y : y1;
    }
    return (srp_box2){(float)x0, (float)y0, (float)x1, (float)y1, 0};
}

static void set_piece(srp_piece *piece, const srp_polygon *polygon) {
    srp_box2 box = srp_polygon_box(polygon);
    piece->x0 = box.x0;
    piece->y0 = box.y0;
    piece->x1 = box.x1;
    piece->y1 = box.y1;
    copy_polygon(&piece->polygon, polygon);
}

static void move_piece(srp_piece *to, const srp_piece *from) {
    to->x0 = from->x0;
    to->y0 = from->y0;
    to->x1 = from->x1;
    to->y1 = from->y1;
    copy_polygon(&to->polygon, &from->polygon);
}

static srp_status push_piece(srp_visible_scratch *scratch, const srp_polygon *polygon) {
    if (scratch->piece_count == scratch->piece_capacity) {
        size_t capacity = scratch->piece_capacity < 32 ? 32 : scratch->piece_capacity * 2;
        srp_piece *larger = realloc(scratch->piece, capacity * sizeof *larger);
        if (larger == NULL) {
            return SRP_NO_MEMORY;
        }
        scratch->piece = larger;
        scratch->piece_capacity = capacity;
    }
    set_piece(&scratch->piece[scratch->piece_count++], polygon);
    return SRP_OK;
}

/* Pushes a polygon, one of many corners as two. */
static srp_status push_small_pieces(srp_visible_scratch *scratch, const srp_polygon *polygon) {
    if (polygon->count <= SRP_POLYGON_KEPT) {
        return polygon->count < 3 ? SRP_OK : push_piece(scratch, polygon);
    }
    uint32_t half = polygon->count / 2;
    srp_polygon first, second;
    first.count = second.count = 0;
    for (uint32_t k = 0; k <= half; ++k) {
        push(&first, polygon->p[k]);
    }
    for (uint32_t k = half; k < polygon->count; ++k) {
        push(&second, polygon->p[k]);
    }
    push(&second, polygon->p[0]);
    srp_status status = push_small_pieces(scratch, &first);
    return status == SRP_OK ? push_small_pieces(scratch, &second) : status;
}

/* Takes `occluder` away from piece `index`. Its remains are put on the stack's top and in its
 * place; sets *hidden when nothing remains. */
static srp_status take_from_piece(srp_visible_scratch *scratch, size_t index,
                                  const srp_occluder *occluder, bool *hidden) {
    srp_polygon outside[SRP_OCCLUDER_LINES], buffer[2];
    double value[SRP_POLYGON_ROOM];
    uint32_t outside_count = 0;
    const srp_polygon *inside = &scratch->piece[index].polygon;
    *hidden = false;
    for (uint32_t k = 0; k < occluder->line_count; ++k) {
        const srp_line2 *line = &occluder->line[k];
        side where = side_of(inside, line, value);
        if (where == SIDE_OUTSIDE) {
            return SRP_OK;
        }
        if (where == SIDE_BOTH) {
            srp_polygon *in = inside == &buffer[0] ? &buffer[1] : &buffer[0];
            cut(inside, line->slack, value, in, &outside[outside_count++]);
            inside = in;
        }
    }
    *hidden = outside_count == 0;
    for (uint32_t k = 0; k < outside_count; ++k) {
        if (k == 0 && outside[0].count <= SRP_POLYGON_KEPT) {
            set_piece(&scratch->piece[index], &outside[0]);
            continue;
        }
        if (k == 0) {
            scratch->piece[index].polygon.count = 0;
        }
        srp_status status = push_small_pieces(scratch, &outside[k]);
        if (status != SRP_OK) {
            return status;
        }
    }
    return SRP_OK;
}

/* Takes `occluder` away from all pieces. Backwards, so that what is moved into a gap or put on top
 * has had its turn. */
static srp_status take_away(srp_visible_scratch *scratch, const srp_occluder *occluder,
                            const srp_box2 *box) {
    for (size_t i = scratch->piece_count; i-- > 0;) {
        const srp_piece *piece = &scratch->piece[i];
        if (piece->x0 > box->x1 || piece->x1 < box->x0 || piece->y0 > box->y1 ||
            piece->y1 < box->y0) {
            continue;
        }
        bool hidden;
        srp_status status = take_from_piece(scratch, i, occluder, &hidden);
        if (status != SRP_OK) {
            return status;
        }
        if (hidden) {
            move_piece(&scratch->piece[i], &scratch->piece[--scratch->piece_count]);
        }
    }
    return SRP_OK;
}

/* Adds area and moments, taken about the first corner first: pieces are small and far out. */
static void measure(const srp_polygon *polygon, srp_moments *sum) {
    double area = 0.0, x = 0.0, y = 0.0;
    for (uint32_t k = 1; k + 1 < polygon->count; ++k) {
        double ax = polygon->p[k].x - polygon->p[0].x, ay = polygon->p[k].y - polygon->p[0].y;
        double bx = polygon->p[k + 1].x - polygon->p[0].x;
        double by = polygon->p[k + 1].y - polygon->p[0].y;
        double half = 0.5 * (ax * by - ay * bx);
        area += half;
        x += half * (ax + bx) / 3.0;
        y += half * (ay + by) / 3.0;
    }
    sum->area += area;
    sum->x += x + area * polygon->p[0].x;
    sum->y += y + area * polygon->p[0].y;
}

bool srp_polygon_keep(srp_polygon *polygon, const srp_occluder *inside) {
    double value[SRP_POLYGON_ROOM];
    srp_polygon in, out;
    for (uint32_t k = 0; k < inside->line_count; ++k) {
        side where = side_of(polygon, &inside->line[k], value);
        if (where == SIDE_OUTSIDE) {
            return false;
        }
        if (where == SIDE_BOTH) {
            cut(polygon, inside->line[k].slack, value, &in, &out);
            copy_polygon(polygon, &in);
        }
    }
    return true;
}

/* Puts the pieces that are left away for the caller. */
static srp_status keep_pieces(srp_visible_scratch *scratch) {
    size_t count = scratch->kept_count + scratch->piece_count;
    if (count > scratch->kept_capacity) {
        size_t capacity = 2 * count + 32;
        srp_polygon *larger = realloc(scratch->kept, capacity * sizeof *larger);
        if (larger == NULL) {
            return SRP_NO_MEMORY;
        }
        scratch->kept = larger;
        scratch->kept_capacity = capacity;
    }
    for (size_t i = 0; i < scratch->piece_count; ++i) {
        copy_polygon(&scratch->kept[scratch->kept_count++], &scratch->piece[i].polygon);
    }
    return SRP_OK;
}

static srp_status visible_in_turn(srp_visible_scratch *scratch, const srp_polygon *polygon,
                                  const srp_occluder *occluders, size_t first, size_t count,
                                  srp_moments *out) {
    scratch->piece_count = 0;
    srp_status status = push_small_pieces(scratch, polygon);
    const srp_box2 *list = count > 0 ? scratch->lists.item + first : NULL;
    for (size_t k = 0; k < count && status == SRP_OK && scratch->piece_count > 0; ++k) {
        status = take_away(scratch, &occluders[list[k].id], &list[k]);
    }
    for (size_t i = 0; i < scratch->piece_count && status == SRP_OK; ++i) {
        measure(&scratch->piece[i].polygon, out);
    }
    return status == SRP_OK && scratch->keep ? keep_pieces(scratch) : status;
}

/* A line across the longer side of the polygon's box, through the middle of the occluders there. */
static srp_line2 dividing_line(const srp_polygon *polygon, const srp_box2 *list, size_t count) {
    srp_box2 box = srp_polygon_box(polygon);
    bool along_x = box.x1 - box.x0 >= box.y1 - box.y0;
    float low = along_x ? box.x0 : box.y0, high = along_x ? box.x1 : box.y1, sum = 0.0f;
    for (size_t k = 0; k < count; ++k) {
        float a = along_x ? list[k].x0 : list[k].y0, b = along_x ? list[k].x1 : list[k].y1;
        sum += (a > low ? a : low) + (b < high ? b : high);
    }
    double at = 0.5 * (double)sum / (double)count;
    /* No slack: a sliver here costs nothing but itself. */
    return (srp_line2){along_x ? 1.0 : 0.0, along_x ? 0.0 : 1.0, -at, 0.0};
}

/* Where a polygon lies against all lines of an occluder: outside one of them, inside all, or
 * neither. */
static side side_of_occluder(const srp_polygon *polygon, const srp_occluder *occluder) {
    double value[SRP_POLYGON_ROOM];
    side result = SIDE_INSIDE;
    for (uint32_t k = 0; k < occluder->line_count; ++k) {
        side where = side_of(polygon, &occluder->line[k], value);
        if (where == SIDE_OUTSIDE) {
            return SIDE_OUTSIDE;
        }
        result = where == SIDE_BOTH ? SIDE_BOTH : result;
    }
    return result;
}

/* Puts those of `list` that may meet `half` behind it; their number, or 0 with *hidden set when
 * one of them covers all of it. Boxes alone would keep the long slender triangles of tubes and
 * dishes, all of them everywhere. */
static size_t select_for(srp_box2 *list, size_t count, const srp_polygon *half,
                         const srp_occluder *occluders, bool *hidden) {
    srp_box2 box = srp_polygon_box(half);
    size_t kept = 0;
    *hidden = false;
    for (size_t k = 0; k < count; ++k) {
        const srp_box2 *item = &list[k];
        if (item->x0 > box.x1 || item->x1 < box.x0 || item->y0 > box.y1 || item->y1 < box.y0) {
            continue;
        }
        side where = side_of_occluder(half, &occluders[item->id]);
        if (where == SIDE_INSIDE) {
            *hidden = true;
            return 0;
        }
        if (where == SIDE_BOTH) {
            list[count + kept++] = *item;
        }
    }
    return kept;
}

static srp_status visible_divided(srp_visible_scratch *scratch, const srp_polygon *polygon,
                                  const srp_occluder *occluders, size_t first, size_t count,
                                  int depth, srp_moments *out) {
    srp_polygon half[2];
    double value[SRP_POLYGON_ROOM];
    bool whole = count <= DIVIDE_ABOVE || depth >= DIVIDE_DEPTH_MAX ||
                 polygon->count >= SRP_POLYGON_ROOM - 1;
    if (!whole) {
        srp_line2 line = dividing_line(polygon, scratch->lists.item + first, count);
        whole = side_of(polygon, &line, value) != SIDE_BOTH;
        if (!whole) {
            cut(polygon, line.slack, value, &half[0], &half[1]);
        }
    }
    if (whole) {
        return visible_in_turn(scratch, polygon, occluders, first, count, out);
    }
    srp_status status = srp_box_stack_reserve(&scratch->lists, first + 2 * count + 1);
    for (int k = 0; k < 2 && status == SRP_OK; ++k) {
        bool hidden;
        size_t kept = select_for(scratch->lists.item + first, count, &half[k], occluders, &hidden);
        /* A half that nearly all of them reach gains little from more cuts. */
        int step = kept > count - count / 8 ? 8 : 1;
        if (!hidden) {
            status = visible_divided(scratch, &half[k], occluders, first + count, kept,
                                     depth + step, out);
        }
    }
    return status;
}

srp_status srp_polygon_visible(srp_visible_scratch *scratch, const srp_polygon *polygon,
                               const srp_occluder *occluders, size_t count, srp_moments *out) {
    return visible_divided(scratch, polygon, occluders, 0, count, 0, out);
}

void srp_visible_scratch_free(srp_visible_scratch *scratch) {
    free(scratch->lists.item);
    free(scratch->piece);
    free(scratch->kept);
}
