/* SPDX-License-Identifier: Apache-2.0 */
/* Tables that fill themselves, and interpolants of them. */
#include "demand_fixture.h"
#include "srp_check.h"
#include "table_internal.h"

#include <string.h>

static const srp_interp_scheme *const LOCAL[] = {&srp_interp_bilinear, &srp_interp_bicubic};
/* Steps of azimuth and elevation: usual, odd, of no common divisor, and the coarsest. */
static const srp_grid GRIDS[] = {{25, 13}, {14, 8}, {38, 5}, {5, 3}, {9, 37}, {2, 2}, {3, 2}};
enum { GRID_COUNT = sizeof GRIDS / sizeof GRIDS[0] };

typedef struct answer {
    srp_vec3 f, t;
    srp_interp_jacobian slopes;
} answer;

static answer ask(const srp_interp *interp, srp_vec3 s) {
    answer a;
    srp_vec3 f, t;
    srp_error error;
    memset(&a, 0, sizeof a);
    assert_ok(srp_interp_eval(interp, s, &a.f, &a.t, &a.slopes, &error), error);
    assert_ok(srp_interp_eval(interp, s, &f, &t, NULL, &error), error);
    ck_assert(memcmp(&f, &a.f, sizeof f) == 0 && memcmp(&t, &a.t, sizeof t) == 0);
    return a;
}

static srp_interp *on_demand(const srp_interp_scheme *scheme, srp_demand *demand) {
    srp_interp *interp = NULL;
    srp_error error;
    assert_ok(srp_interp_create_on_demand(scheme, demand, &interp, &error), error);
    return interp;
}

/* Random, nodes, poles, seam. */
static srp_vec3 some_direction(srp_grid grid, uint64_t *state) {
    uint32_t i = (uint32_t)(random_bits(state) % grid.az_count);
    uint32_t j = (uint32_t)(random_bits(state) % grid.el_count);
    switch (random_bits(state) % 8) {
    case 0:
        return srp_grid_direction(grid, i, j);
    case 1:
        return srp_grid_direction(grid, i, random_bits(state) % 2 ? 0 : grid.el_count - 1);
    case 2:
        return srp_direction_from_deg(180.0, 180.0 * random_unit(state) - 90.0);
    case 3: /* close to a pole */
        return srp_direction_from_deg(360.0 * random_unit(state), 90.0 - 1e-3 * random_unit(state));
    default:
        return random_direction(state);
    }
}

static bool takes(const srp_interp_scheme *scheme, srp_grid grid) {
    return grid.az_count - 1 >= scheme->steps_min && 2 * (grid.el_count - 1) >= scheme->steps_min;
}

static void compare_with_full(const srp_method *method, const srp_interp_scheme *scheme,
                              srp_grid grid) {
    counting_fixture fixture = counting_begin(method, grid);
    srp_table *table = full_table(&fixture);
    srp_demand *demand = make_demand(&fixture, NULL);
    srp_interp *full = NULL, *ours = on_demand(scheme, demand);
    srp_error error;
    uint64_t state = 20241124;
    assert_ok(srp_interp_create(scheme, table, &full, &error), error);
    for (int k = 0; k < 2000; ++k) {
        srp_vec3 s = some_direction(grid, &state);
        answer want = ask(full, s), got = ask(ours, s);
        ck_assert_msg(memcmp(&want, &got, sizeof want) == 0,
                      "%s, %u x %u: other bits at (%.17g, %.17g, %.17g)", scheme->name,
                      grid.az_count, grid.el_count, s.x, s.y, s.z);
    }
    ck_assert_int_eq(counting_most(), 1);
    ck_assert_uint_eq(counting_nodes(), srp_demand_count(demand).computed);
    srp_interp_destroy(full);
    srp_interp_destroy(ours);
    srp_demand_destroy(demand);
    srp_table_destroy(table);
    counting_end(&fixture);
}

START_TEST(gives_the_bits_of_the_full_table) {
    const srp_interp_scheme *scheme = LOCAL[_i % 2];
    const srp_grid grid = GRIDS[_i / 2];
    if (takes(scheme, grid)) {
        compare_with_full(&counting_method, scheme, grid);
        compare_with_full(&forceless_method, scheme, grid);
    }
}
END_TEST

START_TEST(a_lookup_computes_its_nodes_and_no_others_in_one_batch) {
    counting_fixture fixture = counting_begin(&counting_method, (srp_grid){73, 37});
    for (int k = 0; k < 2; ++k) {
        srp_demand *demand = make_demand(&fixture, NULL);
        srp_interp *interp = on_demand(LOCAL[k], demand);
        srp_demand_counts before = srp_demand_count(demand);
        /* Two poles, 8 or 9 nodes beside each, for bicubic four on the equator. */
        ck_assert_uint_eq(before.batches, 1);
        ck_assert_uint_eq(before.computed, 2 + 2 * 8 + (k == 0 ? 0 : 4));
        ck_assert_uint_eq(before.total, 72 * 35 + 2);
        (void)ask(interp, srp_direction_from_deg(32.1, 21.3));
        srp_demand_counts after = srp_demand_count(demand);
        ck_assert_uint_eq(after.batches, before.batches + 1);
        ck_assert_uint_eq(after.computed, before.computed + (k == 0 ? 4 : 16));
        /* The next cell shares half of them, or three quarters. */
        (void)ask(interp, srp_direction_from_deg(37.1, 21.3));
        ck_assert_uint_eq(srp_demand_count(demand).computed, after.computed + (k == 0 ? 2 : 4));
        ck_assert_uint_eq(srp_demand_count(demand).ready, srp_demand_count(demand).computed);
        srp_interp_destroy(interp);
        srp_demand_destroy(demand);
    }
    counting_end(&fixture);
}
END_TEST

START_TEST(two_interpolants_share_nodes) {
    counting_fixture fixture = counting_begin(&counting_method, GRIDS[0]);
    srp_demand *demand = make_demand(&fixture, NULL);
    srp_interp *cubic = on_demand(&srp_interp_bicubic, demand);
    srp_vec3 s = srp_direction_from_deg(-71.3, 11.7);
    (void)ask(cubic, s);
    size_t computed = srp_demand_count(demand).computed;
    srp_interp *linear = on_demand(&srp_interp_bilinear, demand);
    (void)ask(linear, s);
    ck_assert_uint_eq(srp_demand_count(demand).computed, computed);
    srp_interp_destroy(cubic);
    srp_interp_destroy(linear);
    srp_demand_destroy(demand);
    counting_end(&fixture);
}
END_TEST

START_TEST(nodes_can_be_asked_for) {
    counting_fixture fixture = counting_begin(&counting_method, (srp_grid){181, 91});
    srp_demand *demand = make_demand(&fixture, NULL);
    srp_error error;
    /* All at once: more than a batch. */
    size_t count = srp_grid_node_count(fixture.grid);
    srp_demand_node *nodes = calloc(count, sizeof *nodes);
    for (size_t k = 0; k < count; ++k) {
        nodes[k] = (srp_demand_node){(uint32_t)(k / 91), (uint32_t)(k % 91)};
    }
    ck_assert_ptr_null(srp_demand_get(demand, nodes[57]));
    assert_ok(srp_demand_need(demand, count, nodes, &error), error);
    ck_assert_uint_eq(srp_demand_count(demand).computed, 180 * 89 + 2);
    ck_assert_uint_eq(srp_demand_count(demand).batches, (180 * 89 + 2 + 4095) / 4096);
    ck_assert_int_eq(counting_most(), 1);
    ck_assert_ptr_nonnull(srp_demand_get(demand, nodes[57]));
    /* The seam and the poles are one direction for several nodes. */
    ck_assert_ptr_eq(srp_demand_get(demand, (srp_demand_node){180, 40}),
                     srp_demand_get(demand, (srp_demand_node){0, 40}));
    ck_assert_ptr_eq(srp_demand_get(demand, (srp_demand_node){77, 90}),
                     srp_demand_get(demand, (srp_demand_node){3, 90}));
    assert_is_full(&fixture, demand);
    assert_ok(srp_demand_need(demand, 0, NULL, &error), error);
    free(nodes);
    srp_demand_destroy(demand);
    counting_end(&fixture);
}
END_TEST

START_TEST(refusals_say_why) {
    counting_fixture fixture = counting_begin(&counting_method, GRIDS[0]);
    srp_demand *demand = make_demand(&fixture, NULL), *none = NULL;
    srp_interp *interp = NULL;
    srp_error error;
    ck_assert_int_eq(srp_interp_create_on_demand(&srp_interp_spline, demand, &interp, &error),
                     SRP_UNSUPPORTED);
    ck_assert_ptr_nonnull(strstr(error.message, "spline needs all nodes at once"));
    ck_assert_ptr_null(interp);
    const srp_demand_node outside[] = {{3, 4}, {25, 4}, {3, 13}};
    ck_assert_int_eq(srp_demand_need(demand, 2, outside, &error), SRP_BAD_ARGUMENT);
    ck_assert_ptr_nonnull(strstr(error.message, "node (25, 4)"));
    ck_assert_int_eq(srp_demand_need(demand, 1, outside + 2, &error), SRP_BAD_ARGUMENT);
    ck_assert_ptr_null(srp_demand_get(demand, outside[1]));
    ck_assert_ptr_null(srp_demand_get(demand, (srp_demand_node){2000000, 40000000}));
    ck_assert_uint_eq(srp_demand_count(demand).ready, 0);
    ck_assert_int_eq(srp_demand_create(fixture.prepared, (srp_grid){1, 13}, NULL, &none, &error),
                     SRP_BAD_ARGUMENT);
    srp_demand_destroy(demand);

    fixture.grid = (srp_grid){4, 13};
    demand = make_demand(&fixture, NULL);
    ck_assert_int_eq(srp_interp_create_on_demand(&srp_interp_bicubic, demand, &interp, &error),
                     SRP_BAD_ARGUMENT);
    ck_assert_ptr_nonnull(strstr(error.message, "bicubic takes at most 90 degrees"));
    interp = on_demand(&srp_interp_bilinear, demand);
    const srp_vec3 bad[] = {{NAN, 0, 0}, {0, 0, 0}, {1, 1, 0}, {0, INFINITY, 0}};
    size_t ready = srp_demand_count(demand).ready;
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        srp_vec3 f = {7, 7, 7};
        ck_assert_int_eq(srp_interp_eval(interp, bad[k], &f, NULL, NULL, &error), SRP_BAD_ARGUMENT);
        ck_assert(f.x == 7 && f.y == 7 && f.z == 7);
    }
    ck_assert_uint_eq(srp_demand_count(demand).ready, ready);
    srp_interp_destroy(interp);
    srp_demand_destroy(demand);
    srp_demand_destroy(NULL);
    counting_end(&fixture);
}
END_TEST

START_TEST(what_the_method_says_comes_out_and_the_node_stays_empty) {
    const srp_status failures[] = {SRP_NO_MEMORY, SRP_CANCELLED, SRP_IO};
    counting_fixture fixture = counting_begin(&counting_method, GRIDS[0]);
    srp_demand *demand = make_demand(&fixture, NULL);
    srp_interp *interp = on_demand(&srp_interp_bicubic, demand);
    srp_vec3 s = srp_direction_from_deg(12.3, 4.5);
    size_t ready = srp_demand_count(demand).ready;
    for (size_t k = 0; k < sizeof failures / sizeof failures[0]; ++k) {
        srp_error error = {.status = SRP_OK};
        srp_vec3 f = {7, 7, 7};
        counting.fail_every = 1;
        counting.failure = failures[k];
        ck_assert_int_eq(srp_interp_eval(interp, s, &f, NULL, NULL, &error), failures[k]);
        ck_assert_int_eq(error.status, failures[k]);
        ck_assert(f.x == 7 && f.y == 7 && f.z == 7);
        ck_assert_uint_eq(srp_demand_count(demand).ready, ready);
        /* An interpolant that cannot have what it needs is not made. */
        srp_interp *other = NULL;
        srp_demand *fresh = make_demand(&fixture, NULL);
        ck_assert_int_eq(srp_interp_create_on_demand(&srp_interp_bicubic, fresh, &other, &error),
                         failures[k]);
        ck_assert_ptr_null(other);
        srp_demand_destroy(fresh);
    }
    counting.fail_every = 0;
    (void)ask(interp, s);
    ck_assert_uint_gt(srp_demand_count(demand).ready, ready);
    srp_interp_destroy(interp);
    srp_demand_destroy(demand);
    counting_end(&fixture);
}
END_TEST

START_TEST(a_node_that_is_not_finite_is_refused) {
    counting_fixture fixture = counting_begin(&counting_method, GRIDS[0]);
    srp_demand *demand = make_demand(&fixture, NULL);
    srp_interp *interp = on_demand(&srp_interp_bicubic, demand);
    srp_error error;
    srp_vec3 f = {7, 7, 7};
    counting.fail_every = 1;
    for (int k = 0; k < 2; ++k) {
        ck_assert_int_eq(
            srp_interp_eval(interp, srp_direction_from_deg(12.3, 4.5), &f, NULL, NULL, &error),
            SRP_BAD_DATA);
        ck_assert_ptr_nonnull(strstr(error.message, "is not finite"));
    }
    srp_interp_destroy(interp);
    srp_demand_destroy(demand);
    counting_end(&fixture);
}
END_TEST

enum { THREADS = 16, LOOKUPS = 400 };

/* All threads ask for all of the sphere, beginning at the same places. */
static size_t hammer(const srp_interp *const interp[2], srp_interp *const full[2], srp_grid grid,
                     bool may_fail) {
    atomic_size_t wrong = 0, failed = 0;
#pragma omp parallel num_threads(THREADS)
    {
        uint64_t state = 4711;
        for (int k = 0; k < LOOKUPS; ++k) {
            const int scheme = k % 2;
            srp_vec3 s = some_direction(grid, &state);
            answer got, want;
            srp_error error;
            memset(&got, 0, sizeof got);
            memset(&want, 0, sizeof want);
            srp_status status =
                srp_interp_eval(interp[scheme], s, &got.f, &got.t, &got.slopes, &error);
            if (status != SRP_OK) {
                ++failed;
                wrong += status != SRP_CANCELLED || !may_fail;
                continue;
            }
            status = srp_interp_eval(full[scheme], s, &want.f, &want.t, &want.slopes, &error);
            wrong += status != SRP_OK || memcmp(&got, &want, sizeof got) != 0;
        }
    }
    ck_assert_uint_eq(wrong, 0);
    return failed;
}

static void hammer_table(long delay_us, long fail_every) {
    counting_fixture fixture = counting_begin(&counting_method, (srp_grid){25, 13});
    srp_table *table = full_table(&fixture);
    srp_demand *demand = make_demand(&fixture, NULL);
    srp_interp *full[2] = {NULL, NULL}, *ours[2];
    srp_error error;
    for (int k = 0; k < 2; ++k) {
        assert_ok(srp_interp_create(LOCAL[k], table, &full[k], &error), error);
        ours[k] = on_demand(LOCAL[k], demand);
    }
    counting.delay_us = delay_us;
    counting.fail_every = fail_every;
    counting.failure = SRP_CANCELLED;
    const srp_interp *asked[2] = {ours[0], ours[1]};
    size_t failed = hammer(asked, full, fixture.grid, fail_every > 0);
    ck_assert((failed > 0) == (fail_every > 0));
    counting.fail_every = 0;
    ck_assert_int_eq(counting_most(), 1);
    ck_assert_uint_eq(counting_nodes(), srp_demand_count(demand).computed);
    need_columns(demand, 0, fixture.grid.az_count);
    ck_assert_int_eq(counting_most(), 1);
    assert_is_full(&fixture, demand);
    printf("%d threads: %zu nodes, %zu batches, each node once, %zu look-ups failed\n", THREADS,
           srp_demand_count(demand).computed, srp_demand_count(demand).batches, failed);
    for (int k = 0; k < 2; ++k) {
        srp_interp_destroy(full[k]);
        srp_interp_destroy(ours[k]);
    }
    srp_demand_destroy(demand);
    srp_table_destroy(table);
    counting_end(&fixture);
}

START_TEST(sixteen_threads_compute_each_node_once) {
    hammer_table(_i * 300, 0);
}
END_TEST

START_TEST(sixteen_threads_go_on_after_failures) {
    hammer_table(100, 3);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("demand");
    TCase *tcase = tcase_create("demand");
    tcase_add_loop_test(tcase, gives_the_bits_of_the_full_table, 0, 2 * GRID_COUNT);
    tcase_add_test(tcase, a_lookup_computes_its_nodes_and_no_others_in_one_batch);
    tcase_add_test(tcase, two_interpolants_share_nodes);
    tcase_add_test(tcase, nodes_can_be_asked_for);
    tcase_add_test(tcase, refusals_say_why);
    tcase_add_test(tcase, what_the_method_says_comes_out_and_the_node_stays_empty);
    tcase_add_test(tcase, a_node_that_is_not_finite_is_refused);
    tcase_add_loop_test(tcase, sixteen_threads_compute_each_node_once, 0, 2);
    tcase_add_test(tcase, sixteen_threads_go_on_after_failures);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
