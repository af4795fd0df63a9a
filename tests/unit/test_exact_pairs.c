/* SPDX-License-Identifier: Apache-2.0 */
#include "exact_pairs.h"
#include "srp_check.h"

#include <string.h>

enum { MANY = 1500 };

typedef struct tally {
    uint32_t count;
    uint8_t *seen; /* (count, count), lower id first */
    int calls_left;
} tally;

static srp_status note(void *user, uint32_t box, const uint32_t *others, size_t count) {
    tally *t = user;
    for (size_t i = 0; i < count; ++i) {
        uint32_t low = box < others[i] ? box : others[i], high = box < others[i] ? others[i] : box;
        ++t->seen[low * t->count + high];
    }
    return t->calls_left-- == 0 ? SRP_NO_MEMORY : SRP_OK;
}

static bool overlap(const srp_box2 *a, const srp_box2 *b) {
    return a->x0 <= b->x1 && b->x0 <= a->x1 && a->y0 <= b->y1 && b->y0 <= a->y1;
}

/* Every overlapping pair is told once, no other pair is. */
static void check_boxes(const srp_box2 *boxes, uint32_t count) {
    srp_box_stack stack = {NULL, 0};
    tally t = {count, calloc((size_t)count * count + 1, 1), -1};
    ck_assert_ptr_nonnull(t.seen);
    ck_assert_int_eq(srp_box_stack_reserve(&stack, count), SRP_OK);
    if (count > 0) {
        memcpy(stack.item, boxes, count * sizeof *boxes);
    }
    ck_assert_int_eq(srp_box_pairs(&stack, count, note, &t), SRP_OK);
    if (count > 0) {
        ck_assert_int_eq(memcmp(stack.item, boxes, count * sizeof *boxes), 0);
    }
    size_t wrong = 0;
    for (uint32_t i = 0; i < count; ++i) {
        wrong += t.seen[i * count + i];
        for (uint32_t j = i + 1; j < count; ++j) {
            wrong += t.seen[i * count + j] != (overlap(&boxes[i], &boxes[j]) ? 1 : 0);
        }
    }
    ck_assert_uint_eq(wrong, 0);
    free(t.seen);
    free(stack.item);
}

/* Boxes of all sizes: panels of metres beside bolts of millimetres. */
static uint32_t scatter(srp_box2 *boxes, uint32_t count, double spread, bool latticed,
                        uint64_t *seed) {
    for (uint32_t i = 0; i < count; ++i) {
        double size = pow(10.0, -spread * random_unit(seed));
        double x = random_unit(seed), y = random_unit(seed);
        double w = size * random_unit(seed), h = size * random_unit(seed);
        if (latticed) {
            x = floor(10 * x);
            y = floor(10 * y);
            w = floor(4 * w);
            h = floor(4 * h);
        }
        boxes[i] = (srp_box2){(float)x, (float)y, (float)(x + w), (float)(y + h), i};
    }
    return count;
}

START_TEST(each_pair_is_told_once) {
    static srp_box2 boxes[MANY];
    uint64_t seed = 1;
    for (int i = 0; i < 20; ++i) {
        uint32_t count = (uint32_t)(1 + random_unit(&seed) * (MANY - 1));
        check_boxes(boxes, scatter(boxes, count, 0.5 * i, false, &seed));
        check_boxes(boxes, scatter(boxes, count / 3 + 1, 0.0, true, &seed));
    }
}
END_TEST

START_TEST(odd_lists) {
    static srp_box2 boxes[200];
    check_boxes(boxes, 0);
    for (uint32_t i = 0; i < 200; ++i) {
        boxes[i] = (srp_box2){0.25f, 0.5f, 0.25f, 0.5f, i}; /* points, all at one place */
    }
    check_boxes(boxes, 1);
    check_boxes(boxes, 200);
    for (uint32_t i = 0; i < 200; ++i) {
        boxes[i].x1 = boxes[i].x0 = (float)i; /* a row of points */
    }
    check_boxes(boxes, 200);
}
END_TEST

START_TEST(a_failing_visitor_ends_the_search) {
    static srp_box2 boxes[100];
    uint64_t seed = 2;
    srp_box_stack stack = {NULL, 0};
    tally t = {100, calloc(100 * 100, 1), 3};
    ck_assert_ptr_nonnull(t.seen);
    scatter(boxes, 100, 0.5, false, &seed);
    ck_assert_int_eq(srp_box_stack_reserve(&stack, 100), SRP_OK);
    memcpy(stack.item, boxes, sizeof boxes);
    ck_assert_int_eq(srp_box_pairs(&stack, 100, note, &t), SRP_NO_MEMORY);
    ck_assert_int_eq(t.calls_left, -1);
    free(t.seen);
    free(stack.item);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("exact pairs");
    TCase *tcase = tcase_create("pairs");
    tcase_set_timeout(tcase, 60);
    tcase_add_test(tcase, each_pair_is_told_once);
    tcase_add_test(tcase, odd_lists);
    tcase_add_test(tcase, a_failing_visitor_ends_the_search);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
