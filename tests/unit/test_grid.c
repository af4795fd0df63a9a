/* SPDX-License-Identifier: Apache-2.0 */
#include "srp_check.h"

#include <srp/const.h>
#include <srp/table.h>

#include <string.h>

START_TEST(steps_that_divide_are_taken) {
    const struct {
        double az_step, el_step;
        uint32_t az_count, el_count;
    } cases[] = {{5, 5, 73, 37},
                 {20, 20, 19, 10},
                 {0.5, 22.5, 721, 9},
                 {10, 5, 37, 37},
                 {360, 180, 2, 2},
                 {0.1, 0.01, 3601, 18001},
                 {0.01, 180, 36001, 2},
                 {360.0 / 7, 180.0 / 7, 8, 8},
                 {51.4285714286, 12, 8, 16}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        srp_grid grid;
        srp_error error;
        assert_ok(srp_grid_from_steps(cases[k].az_step, cases[k].el_step, &grid, &error), error);
        ck_assert_uint_eq(grid.az_count, cases[k].az_count);
        ck_assert_uint_eq(grid.el_count, cases[k].el_count);
        ck_assert_uint_eq(srp_grid_node_count(grid), (size_t)grid.az_count * grid.el_count);
    }
}
END_TEST

START_TEST(other_steps_are_refused) {
    const struct {
        double az_step, el_step;
        const char *expected;
    } cases[] = {{7, 5, "azimuth step of 7 degrees does not divide 360 (7.2 would)"},
                 {5, 7, "elevation step of 7 degrees does not divide 180"},
                 {0.7, 5, "does not divide 360"},
                 {0, 5, "azimuth step of 0"},
                 {-5, 5, "azimuth step of -5"},
                 {5, NAN, "elevation step of nan"},
                 {INFINITY, 5, "azimuth step of inf"},
                 {0.009, 5, "expected 0.01 to 360"},
                 {5, 360, "expected 0.01 to 180"},
                 {51.4286, 5, "does not divide 360"}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        srp_grid grid = {77, 88};
        srp_error error;
        ck_assert_int_eq(srp_grid_from_steps(cases[k].az_step, cases[k].el_step, &grid, &error),
                         SRP_BAD_ARGUMENT);
        ck_assert_msg(strstr(error.message, cases[k].expected) != NULL, "'%s' lacks '%s'",
                      error.message, cases[k].expected);
        ck_assert(grid.az_count == 77 && grid.el_count == 88);
    }
}
END_TEST

START_TEST(ends_and_quarters_are_exact) {
    srp_grid grid = {73, 37};
    ck_assert(srp_grid_azimuth_deg(grid, 0) == -180.0);
    ck_assert(srp_grid_azimuth_deg(grid, 36) == 0.0);
    ck_assert(srp_grid_azimuth_deg(grid, 72) == 180.0);
    ck_assert(srp_grid_elevation_deg(grid, 0) == -90.0);
    ck_assert(srp_grid_elevation_deg(grid, 36) == 90.0);
    const struct {
        double az, el;
        srp_vec3 s;
    } cases[] = {{0, 0, {1, 0, 0}},     {90, 0, {0, 1, 0}},    {180, 0, {-1, 0, 0}},
                 {-180, 0, {-1, 0, 0}}, {-90, 0, {0, -1, 0}},  {270, 0, {0, -1, 0}},
                 {360, 0, {1, 0, 0}},   {-720, 0, {1, 0, 0}},  {12.5, 90, {0, 0, 1}},
                 {33, -90, {0, 0, -1}}, {-450, 0, {0, -1, 0}}, {1e9, 90, {0, 0, 1}}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        srp_vec3 s = srp_direction_from_deg(cases[k].az, cases[k].el);
        /* To the bit: negative zeros are not allowed. */
        ck_assert_mem_eq(&s, &cases[k].s, sizeof s);
    }
}
END_TEST

/* What a plain evaluation gives. */
static srp_vec3 plain(double az_deg, double el_deg) {
    double az = az_deg * SRP_RAD_PER_DEG, el = el_deg * SRP_RAD_PER_DEG;
    return srp_vec3_make(cos(el) * cos(az), cos(el) * sin(az), sin(el));
}

START_TEST(directions_follow_the_definition) {
    const srp_grid grids[] = {{73, 37}, {8, 8}, {721, 9}, {2, 2}, {38, 4}};
    for (size_t g = 0; g < sizeof grids / sizeof grids[0]; ++g) {
        for (uint32_t i = 0; i < grids[g].az_count; ++i) {
            for (uint32_t j = 0; j < grids[g].el_count; ++j) {
                double az = srp_grid_azimuth_deg(grids[g], i);
                double el = srp_grid_elevation_deg(grids[g], j);
                srp_vec3 s = srp_grid_direction(grids[g], i, j);
                assert_vec3_close(s, plain(az, el), 0.0, 5e-16);
                assert_vec3_close(srp_direction_from_deg(az, el), s, 0.0, 5e-16);
                assert_vec3_close(srp_direction_from_deg(az + 720.0, el), s, 0.0, 5e-15);
                assert_close(srp_vec3_norm(s), 1.0, 0.0, 3e-16);
            }
        }
    }
}
END_TEST

/* The grid of whole degrees and a single direction agree to the bit: `srp force` and a table node.
 */
START_TEST(a_node_is_its_direction_to_the_bit) {
    srp_grid grid = {73, 37};
    for (uint32_t i = 0; i < grid.az_count; ++i) {
        for (uint32_t j = 0; j < grid.el_count; ++j) {
            srp_vec3 a = srp_grid_direction(grid, i, j);
            srp_vec3 b = srp_direction_from_deg(srp_grid_azimuth_deg(grid, i),
                                                srp_grid_elevation_deg(grid, j));
            ck_assert_mem_eq(&a, &b, sizeof a);
        }
    }
}
END_TEST

static bool same(srp_vec3 a, srp_vec3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

START_TEST(mirror_nodes_have_mirrored_bits) {
    const srp_grid grids[] = {{73, 37}, {361, 181}, {9, 5}, {8, 8}, {41, 7}};
    for (size_t g = 0; g < sizeof grids / sizeof grids[0]; ++g) {
        uint32_t az_steps = grids[g].az_count - 1, el_steps = grids[g].el_count - 1;
        for (uint32_t i = 0; i <= az_steps; ++i) {
            for (uint32_t j = 0; j <= el_steps; ++j) {
                srp_vec3 s = srp_grid_direction(grids[g], i, j);
                srp_vec3 across_y = srp_grid_direction(grids[g], az_steps - i, j);
                srp_vec3 across_z = srp_grid_direction(grids[g], i, el_steps - j);
                ck_assert(same(across_y, srp_vec3_make(s.x, -s.y, s.z)));
                ck_assert(same(across_z, srp_vec3_make(s.x, s.y, -s.z)));
                if (az_steps % 2 == 0) { /* half a turn on */
                    srp_vec3 behind =
                        srp_grid_direction(grids[g], (i + az_steps / 2) % az_steps, j);
                    ck_assert(same(behind, srp_vec3_make(-s.x, -s.y, s.z)));
                }
                if (az_steps % 4 == 0) { /* a quarter of a turn on */
                    srp_vec3 beside =
                        srp_grid_direction(grids[g], (i + az_steps / 4) % az_steps, j);
                    ck_assert(same(beside, srp_vec3_make(-s.y, s.x, s.z)));
                }
            }
        }
    }
}
END_TEST

START_TEST(seam_and_poles_are_one_direction) {
    const srp_grid grids[] = {{73, 37}, {8, 8}, {2, 2}};
    for (size_t g = 0; g < sizeof grids / sizeof grids[0]; ++g) {
        uint32_t last_az = grids[g].az_count - 1, last_el = grids[g].el_count - 1;
        for (uint32_t j = 0; j <= last_el; ++j) {
            srp_vec3 low = srp_grid_direction(grids[g], 0, j);
            srp_vec3 high = srp_grid_direction(grids[g], last_az, j);
            ck_assert_mem_eq(&low, &high, sizeof low);
        }
        srp_vec3 south = {0.0, 0.0, -1.0}, north = {0.0, 0.0, 1.0};
        for (uint32_t i = 0; i <= last_az; ++i) {
            srp_vec3 low = srp_grid_direction(grids[g], i, 0);
            srp_vec3 high = srp_grid_direction(grids[g], i, last_el);
            ck_assert_mem_eq(&low, &south, sizeof low);
            ck_assert_mem_eq(&high, &north, sizeof high);
        }
    }
}
END_TEST

START_TEST(solid_angles_cover_the_sphere) {
    const double steps[][2] = {{5, 5}, {20, 20}, {7.5, 22.5}, {360, 180}, {360.0 / 7, 180.0 / 7}};
    for (size_t k = 0; k < sizeof steps / sizeof steps[0]; ++k) {
        srp_grid grid;
        srp_error error;
        assert_ok(srp_grid_from_steps(steps[k][0], steps[k][1], &grid, &error), error);
        double sum = 0.0, height = 0.0;
        for (uint32_t i = 0; i < grid.az_count; ++i) {
            for (uint32_t j = 0; j < grid.el_count; ++j) {
                double weight = srp_grid_solid_angle(grid, i, j);
                ck_assert(weight > 0.0);
                sum += weight;
                height += weight * srp_grid_direction(grid, i, j).z;
            }
        }
        assert_close(sum, 4.0 * SRP_PI, 1e-13, 0.0);
        assert_close(height, 0.0, 0.0, 1e-13);
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("grid");
    TCase *tcase = tcase_create("grid");
    tcase_add_test(tcase, steps_that_divide_are_taken);
    tcase_add_test(tcase, other_steps_are_refused);
    tcase_add_test(tcase, ends_and_quarters_are_exact);
    tcase_add_test(tcase, directions_follow_the_definition);
    tcase_add_test(tcase, a_node_is_its_direction_to_the_bit);
    tcase_add_test(tcase, mirror_nodes_have_mirrored_bits);
    tcase_add_test(tcase, solid_angles_cover_the_sphere);
    tcase_add_test(tcase, seam_and_poles_are_one_direction);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
