/* SPDX-License-Identifier: Apache-2.0 */
/* Which of many boxes in the plane overlap. Internal to the exact method. */
#ifndef SRP_SRC_EXACT_PAIRS_H
#define SRP_SRC_EXACT_PAIRS_H

#include <srp/status.h>

#include <stddef.h>
#include <stdint.h>

/* Closed box [x0, x1] x [y0, y1]; whoever fills it in rounds outwards. */
typedef struct srp_box2 {
    float x0, y0, x1, y1;
    uint32_t id;
} srp_box2;

/* Stack of boxes, in which lists are divided. Zero-initialise, reuse, free `item`. */
typedef struct srp_box_stack {
    srp_box2 *item;
    size_t capacity;
} srp_box_stack;

/* Room for at least `capacity` boxes, kept contents. SRP_OK or SRP_NO_MEMORY. */
srp_status srp_box_stack_reserve(srp_box_stack *stack, size_t capacity);

/*
 * What srp_box_pairs() tells about: `box` overlaps each of the `count` others. Anything but SRP_OK
 * ends the search.
 */
typedef srp_status (*srp_box_visit)(void *user, uint32_t box, const uint32_t *others, size_t count);

/*
 * Tells `visit` of every unordered pair of the first `count` boxes of the stack that overlap
 * (touching counts), once, in the order of one box and some others. The order depends on the boxes
 * alone. Returns the first status that is not SRP_OK; SRP_NO_MEMORY.
 */
srp_status srp_box_pairs(srp_box_stack *stack, size_t count, srp_box_visit visit, void *user);

#endif
