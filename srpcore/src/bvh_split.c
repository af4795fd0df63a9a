/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Facets sorted into a binary tree by the surface area heuristic. What is tested at a leaf is a
 * block of eight, full or not, so that ranges cost as many blocks as they fill: splits fall where
 * full blocks are left. Large ranges are binned, small ones are tried at every place.
 */
#include "bvh_internal.h"

#include <stdlib.h>
#include <string.h>

enum {
    BINS = 32,
    SWEEP = 64,       /* ranges up to it are tried everywhere */
    TASK = 4096,      /* ranges down to it are given to other threads */
    DEPTH_OF_SAH = 64 /* below, ranges are halved: bounds the depth by 64 + 32 */
};

typedef struct split_place {
    float cost;
    int axis;        /* -1: none */
    uint32_t before; /* sweep: items on the left; bins: bins on the left */
} split_place;

/* Twice the middle. */
static inline float middle_of(const srp_bvh_item *item, int axis) {
    return item->box.low[axis] + item->box.high[axis];
}

static inline float cost_of(const srp_bvh_box *box, uint32_t count) {
    return srp_bvh_box_area(box) * (float)((count + SRP_BVH_WIDTH - 1) / SRP_BVH_WIDTH);
}

/* ---- large ranges ---- */

typedef struct bin_map {
    float low, scale;
} bin_map;

static inline uint32_t bin_of(const bin_map *map, float middle) {
    float place = (middle - map->low) * map->scale;
    uint32_t bin = place > 0.0F ? (uint32_t)place : 0;
    return bin < BINS ? bin : BINS - 1;
}

static void measure_middles(const srp_bvh_item *items, uint32_t count, bin_map map[3]) {
    for (int a = 0; a < 3; ++a) {
        float low = INFINITY, high = -INFINITY;
        for (uint32_t i = 0; i < count; ++i) {
            float middle = middle_of(&items[i], a);
            low = middle < low ? middle : low;
            high = middle > high ? middle : high;
        }
        map[a].low = low;
        map[a].scale = high > low ? (float)BINS / (high - low) : 0.0F;
    }
}

static void try_bins(const srp_bvh_box box[BINS], const uint32_t number[BINS], int axis,
                     split_place *best) {
    float right_cost[BINS];
    srp_bvh_box grown;
    uint32_t count = 0;
    srp_bvh_box_clear(&grown);
    for (int b = BINS - 1; b > 0; --b) {
        srp_bvh_box_join(&grown, &box[b]);
        count += number[b];
        right_cost[b] = count > 0 ? cost_of(&grown, count) : INFINITY;
    }
    srp_bvh_box_clear(&grown);
    count = 0;
    for (int b = 1; b < BINS; ++b) {
        srp_bvh_box_join(&grown, &box[b - 1]);
        count += number[b - 1];
        float cost = count > 0 ? cost_of(&grown, count) + right_cost[b] : INFINITY;
        if (cost < best->cost) {
            *best = (split_place){cost, axis, (uint32_t)b};
        }
    }
}

static split_place find_bin_split(const srp_bvh_item *items, uint32_t count, const bin_map map[3]) {
    split_place best = {INFINITY, -1, 0};
    for (int a = 0; a < 3; ++a) {
        if (map[a].scale == 0.0F) {
            continue;
        }
        srp_bvh_box box[BINS];
        uint32_t number[BINS] = {0};
        for (int b = 0; b < BINS; ++b) {
            srp_bvh_box_clear(&box[b]);
        }
        for (uint32_t i = 0; i < count; ++i) {
            uint32_t b = bin_of(&map[a], middle_of(&items[i], a));
            srp_bvh_box_join(&box[b], &items[i].box);
            ++number[b];
        }
        try_bins(box, number, a, &best);
    }
    return best;
}

/* Items of the bins before the place first; returns how many. */
static uint32_t partition(srp_bvh_item *items, uint32_t count, const bin_map *map,
                          split_place place) {
    uint32_t left = 0;
    for (uint32_t i = 0; i < count; ++i) {
        if (bin_of(map, middle_of(&items[i], place.axis)) < place.before) {
            srp_bvh_item swap = items[left];
            items[left++] = items[i];
            items[i] = swap;
        }
    }
    return left;
}

static uint32_t split_large(srp_bvh_item *items, uint32_t count) {
    bin_map map[3];
    measure_middles(items, count, map);
    split_place place = find_bin_split(items, count, map);
    return place.axis < 0 ? count / 2 : partition(items, count, &map[place.axis], place);
}

/* ---- small ranges ---- */

/* By the middle, equal ones by the facet: whatever the order was, one comes out. */
static void sort_items(srp_bvh_item *items, uint32_t count, int axis) {
    for (uint32_t i = 1; i < count; ++i) {
        srp_bvh_item item = items[i];
        float middle = middle_of(&item, axis);
        uint32_t j = i;
        for (; j > 0; --j) {
            float other = middle_of(&items[j - 1], axis);
            if (other < middle || (other == middle && items[j - 1].facet < item.facet)) {
                break;
            }
            items[j] = items[j - 1];
        }
        items[j] = item;
    }
}

static void try_places(const srp_bvh_item *items, uint32_t count, int axis, split_place *best) {
    float right_cost[SWEEP];
    srp_bvh_box grown;
    srp_bvh_box_clear(&grown);
    for (uint32_t i = count - 1; i > 0; --i) {
        srp_bvh_box_join(&grown, &items[i].box);
        right_cost[i] = cost_of(&grown, count - i);
    }
    srp_bvh_box_clear(&grown);
    for (uint32_t i = 1; i < count; ++i) {
        srp_bvh_box_join(&grown, &items[i - 1].box);
        float cost = cost_of(&grown, i) + right_cost[i];
        if (cost < best->cost) {
            *best = (split_place){cost, axis, i};
        }
    }
}

static uint32_t split_small(srp_bvh_item *items, uint32_t count) {
    split_place best = {INFINITY, -1, 0};
    int sorted = -1;
    for (int a = 0; a < 3; ++a) {
        sort_items(items, count, a);
        sorted = a;
        try_places(items, count, a, &best);
    }
    if (best.axis < 0) {
        return count / 2;
    }
    if (best.axis != sorted) {
        sort_items(items, count, best.axis);
    }
    return best.before;
}

/* ---- tree ---- */

static void split_range(srp_bvh_item *items, uint32_t first, uint32_t count, srp_bvh_twig *twigs,
                        uint32_t at, int depth) {
    srp_bvh_twig *twig = &twigs[at];
    *twig = (srp_bvh_twig){.first = first, .count = count};
    srp_bvh_box_clear(&twig->box);
    for (uint32_t i = 0; i < count; ++i) {
        srp_bvh_box_join(&twig->box, &items[first + i].box);
    }
    if (count <= SRP_BVH_WIDTH) {
        return;
    }
    uint32_t left = depth >= DEPTH_OF_SAH ? count / 2
                    : count <= SWEEP      ? split_small(items + first, count)
                                          : split_large(items + first, count);
    uint32_t right = at + 2 * left;
    twig->right = right;
#pragma omp task default(none) firstprivate(items, first, left, twigs, at, depth) if (left >= TASK)
    split_range(items, first, left, twigs, at + 1, depth + 1);
    split_range(items, first + left, count - left, twigs, right, depth + 1);
}

void srp_bvh_split(srp_bvh_item *items, size_t count, int threads, srp_bvh_twig *twigs) {
    (void)threads; /* without OpenMP */
#pragma omp parallel num_threads(threads)
#pragma omp single
    split_range(items, 0, (uint32_t)count, twigs, 0, 0);
}
