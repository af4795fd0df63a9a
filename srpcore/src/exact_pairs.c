/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Overlapping boxes by dividing the plane.
 *
 * A region with more than a handful of boxes is cut in two through the mean of their centres,
 * across the axis along which the centres spread more; a box that the cut meets goes to both
 * sides. Hence cells follow the boxes: a spacecraft has panels of metres beside bolts of
 * millimetres, and a uniform grid would put all bolts into one cell.
 *
 * A pair may meet in several cells. It is reported in the one that holds the lower left corner of
 * its overlap; regions are half open, so that there is exactly one.
 */
#include "exact_pairs.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum { LEAF_COUNT = 16, BLOCK = 64, DEPTH_MAX = 48 };

typedef struct region {
    float x0, y0, x1, y1; /* [x0, x1) x [y0, y1) */
} region;

typedef struct search {
    srp_box_stack *stack;
    srp_box_visit visit;
    void *user;
} search;

srp_status srp_box_stack_reserve(srp_box_stack *stack, size_t capacity) {
    if (capacity <= stack->capacity) {
        return SRP_OK;
    }
    capacity += capacity / 2;
    srp_box2 *larger = realloc(stack->item, capacity * sizeof *larger);
    if (larger == NULL) {
        return SRP_NO_MEMORY;
    }
    stack->item = larger;
    stack->capacity = capacity;
    return SRP_OK;
}

/* Some boxes side by side, so that a compiler can test several at once. */
typedef struct block {
    float x0[BLOCK], y0[BLOCK], x1[BLOCK], y1[BLOCK];
    uint32_t id[BLOCK];
} block;

static void load_block(block *to, const srp_box2 *box, size_t count) {
    for (size_t j = 0; j < count; ++j) {
        to->x0[j] = box[j].x0;
        to->y0[j] = box[j].y0;
        to->x1[j] = box[j].x1;
        to->y1[j] = box[j].y1;
        to->id[j] = box[j].id;
    }
}

/* Those of the block's boxes in [first, count) that overlap `a` with the corner in the region. */
static size_t find_in_block(const block *in, size_t first, size_t count, const srp_box2 *a,
                            const region *where, uint32_t *others) {
    int32_t hit[BLOCK];
    for (size_t j = first; j < count; ++j) {
        float x = a->x0 > in->x0[j] ? a->x0 : in->x0[j];
        float y = a->y0 > in->y0[j] ? a->y0 : in->y0[j];
        float right = a->x1 < in->x1[j] ? a->x1 : in->x1[j];
        float top = a->y1 < in->y1[j] ? a->y1 : in->y1[j];
        hit[j] = (x <= right) & (y <= top) & (x >= where->x0) & (x < where->x1) & (y >= where->y0) &
                 (y < where->y1);
    }
    size_t found = 0;
    for (size_t j = first; j < count; ++j) {
        others[found] = in->id[j];
        found += (size_t)hit[j];
    }
    return found;
}

static srp_status visit_all(const search *look, size_t first, size_t count, const region *where) {
    block in;
    uint32_t others[BLOCK];
    for (size_t base = 0; base < count; base += BLOCK) {
        size_t size = count - base < BLOCK ? count - base : BLOCK;
        load_block(&in, look->stack->item + first + base, size);
        for (size_t i = 0; i < base + size; ++i) {
            srp_box2 a = look->stack->item[first + i];
            size_t from = i < base ? 0 : i + 1 - base;
            size_t found = find_in_block(&in, from, size, &a, where, others);
            srp_status status = found > 0 ? look->visit(look->user, a.id, others, found) : SRP_OK;
            if (status != SRP_OK) {
                return status;
            }
        }
    }
    return SRP_OK;
}

typedef struct division {
    bool along_x;
    float at;
} division;

static float clamp(float value, float low, float high) {
    return value < low ? low : value > high ? high : value;
}

/* Centres are those of the parts of the boxes in the region, so that the cut is in it too: the
 * halves of a region must not reach beyond it. */
static division divide_at(const srp_box2 *box, size_t count, const region *where) {
    float x = 0.0f, y = 0.0f, xx = 0.0f, yy = 0.0f;
    for (size_t i = 0; i < count; ++i) {
        float x0 = box[i].x0 > where->x0 ? box[i].x0 : where->x0;
        float x1 = box[i].x1 < where->x1 ? box[i].x1 : where->x1;
        float y0 = box[i].y0 > where->y0 ? box[i].y0 : where->y0;
        float y1 = box[i].y1 < where->y1 ? box[i].y1 : where->y1;
        x += x0 + x1;
        y += y0 + y1;
        xx += (x0 + x1) * (x0 + x1);
        yy += (y0 + y1) * (y0 + y1);
    }
    float n = (float)count;
    division cut;
    cut.along_x = n * xx - x * x >= n * yy - y * y;
    cut.at = cut.along_x ? clamp(0.5f * x / n, where->x0, where->x1)
                         : clamp(0.5f * y / n, where->y0, where->y1);
    return cut;
}

/* Puts the boxes of one side behind the list; their number. */
static size_t select_side(srp_box2 *box, size_t count, division cut, bool upper) {
    size_t kept = 0;
    for (size_t i = 0; i < count; ++i) {
        box[count + kept] = box[i];
        bool in = cut.along_x ? (upper ? box[i].x1 >= cut.at : box[i].x0 < cut.at)
                              : (upper ? box[i].y1 >= cut.at : box[i].y0 < cut.at);
        kept += in ? 1 : 0;
    }
    return kept;
}

static size_t count_upper(const srp_box2 *box, size_t count, division cut) {
    size_t kept = 0;
    for (size_t i = 0; i < count; ++i) {
        kept += (cut.along_x ? box[i].x1 : box[i].y1) >= cut.at ? 1 : 0;
    }
    return kept;
}

static srp_status search_region(const search *look, size_t first, size_t count, region where,
                                int depth) {
    if (count <= LEAF_COUNT || depth == DEPTH_MAX) {
        return visit_all(look, first, count, &where);
    }
    srp_status status = srp_box_stack_reserve(look->stack, first + 2 * count + 1);
    if (status != SRP_OK) {
        return status;
    }
    srp_box2 *box = look->stack->item + first;
    division cut = divide_at(box, count, &where);
    size_t lower = select_side(box, count, cut, false);
    size_t upper = count_upper(box, count, cut);
    /* When most boxes go to both sides, cutting makes work instead of saving it. */
    if (lower + upper > count + count / 2) {
        return visit_all(look, first, count, &where);
    }
    region low = where, high = where;
    if (cut.along_x) {
        low.x1 = high.x0 = cut.at;
    } else {
        low.y1 = high.y0 = cut.at;
    }
    status = search_region(look, first + count, lower, low, depth + 1);
    if (status == SRP_OK) {
        upper = select_side(look->stack->item + first, count, cut, true);
        status = search_region(look, first + count, upper, high, depth + 1);
    }
    return status;
}

srp_status srp_box_pairs(srp_box_stack *stack, size_t count, srp_box_visit visit, void *user) {
    search look = {stack, visit, user};
    region everywhere = {-INFINITY, -INFINITY, INFINITY, INFINITY};
    return search_region(&look, 0, count, everywhere, 0);
}
