/* SPDX-License-Identifier: Apache-2.0 */
/* Interpolants: what they reproduce, how fast they converge, how smooth they are, what they refuse.
 */
#include "interp_fixture.h"
#include "interp_locate.h"
#include "srp_check.h"
#include "table_internal.h"

#include <srp/const.h>

#include <math.h>
#include <string.h>

static const srp_interp_scheme *scheme_of(int index) {
    size_t count;
    const srp_interp_scheme *const *list = srp_interp_list(&count);
    ck_assert_uint_eq(count, 3);
    return list[index];
}

/* Grids: fine and coarse, even and odd in both angles, uneven. */
static const uint32_t GRIDS[][2] = {{72, 36}, {36, 18}, {7, 5}, {45, 15}, {4, 2}, {5, 3}, {20, 36}};
enum { GRID_COUNT = sizeof GRIDS / sizeof GRIDS[0] };

/* Directions that are special to a grid of azimuth and elevation, and their close neighbours. */
static size_t special_directions(srp_vec3 s[64]) {
    const double near[] = {0.0, 1e-300, 1e-160, 1e-17, 1e-12, 1e-8, 1e-5};
    size_t count = 0;
    for (size_t k = 0; k < sizeof near / sizeof near[0]; ++k) {
        double e = near[k];
        s[count++] = srp_vec3_make(e, 0.0, 1.0);
        s[count++] = srp_vec3_make(-e, e, 1.0);
        s[count++] = srp_vec3_make(0.0, -e, -1.0);
        s[count++] = srp_vec3_make(-e, -e, -1.0);
        s[count++] = srp_vec3_make(-1.0, e, 0.0);
        s[count++] = srp_vec3_make(-1.0, -e, e);
        s[count++] = srp_vec3_make(-0.6, -e, 0.8);
        s[count++] = srp_vec3_make(e, 1.0, -e);
    }
    s[count++] = srp_vec3_make(-1.0, -0.0, -0.0);
    s[count++] = srp_vec3_make(-0.0, -0.0, -1.0);
    s[count++] = srp_vec3_make(1.0, 0.0, 0.0);
    for (size_t k = 0; k < count; ++k) {
        s[k] = srp_vec3_scale(1.0 / srp_vec3_norm(s[k]), s[k]);
    }
    return count;
}

/* ---- Place in the grid ---------------------------------------------------------------------- */

START_TEST(a_direction_is_located_to_rounding) {
    srp_interp interp;
    srp_interp_set_grid(&interp, 360, 180);
    uint64_t state = 5;
    double worst = 0.0;
    for (int k = 0; k < 200000; ++k) {
        srp_vec3 s = random_direction(&state);
        srp_interp_place place;
        ck_assert(srp_interp_locate(&interp, &s, &place));
        double az = (place.i + place.p) / interp.columns_per_rad - SRP_PI;
        double el = (place.j + place.q) / interp.rows_per_rad - 0.5 * SRP_PI;
        double h = hypot(s.x, s.y);
        worst = fmax(worst, fabs(az - atan2(s.y, s.x)));
        worst = fmax(worst, fabs(el - atan2(s.z, h)));
        ck_assert(place.i < 360 && place.j < 180 && place.p >= 0.0 && place.p <= 1.0);
        int pole = srp_interp_pole_at(&interp, &place);
        ck_assert_int_eq(pole, place.j == 0 ? -1 : place.j == 179 ? 1 : 0);
        if (pole != 0) {
            assert_close(srp_interp_theta(&place), atan2(h, fabs(s.z)), 5e-15, 0.0);
        }
    }
    printf("angles are right to %.1e rad\n", worst);
    ck_assert(worst < 2e-15);
}
END_TEST

/* ---- Reproduction --------------------------------------------------------------------------- */

static field_value constant_field(srp_vec3 s) {
    (void)s;
    return (field_value){{3.7123, -1.91, 0.377}, {-0.0317, 11.3, 2.71}};
}

/* A cannonball off the reference point, and something added. */
static field_value linear_field(srp_vec3 s) {
    srp_vec3 f = srp_vec3_make(0.31 - 7.13 * s.x + 0.21 * s.y, -7.31 * s.y - 1.1 * s.z,
                               0.057 + 0.3 * s.x - 6.71 * s.z);
    return (field_value){f, srp_vec3_cross(srp_vec3_make(0.11, -0.73, 1.31), f)};
}

/* Worst error over random and special directions. */
static double worst_error(const srp_interp *interp, field_function *field) {
    srp_vec3 special[64];
    size_t count = special_directions(special);
    uint64_t state = 77;
    double worst = 0.0;
    for (size_t k = 0; k < count + 3000; ++k) {
        srp_vec3 s = k < count ? special[k] : random_direction(&state);
        double off = field_distance(ask(interp, s), field(s));
        ck_assert_msg(isfinite(off), "not finite at (%g, %g, %g)", s.x, s.y, s.z);
        worst = fmax(worst, off);
    }
    return worst;
}

START_TEST(a_constant_comes_out_everywhere) {
    for (int g = 0; g < GRID_COUNT; ++g) {
        srp_interp *interp = field_interp(scheme_of(_i), GRIDS[g][0], GRIDS[g][1], constant_field);
        double worst = worst_error(interp, constant_field);
        ck_assert_msg(worst < 1e-14 * 12.0, "%u x %u: %g", GRIDS[g][0], GRIDS[g][1], worst);
        srp_interp_jacobian slopes = ask_slopes(interp, srp_vec3_make(0.48, -0.6, 0.64));
        ck_assert(jacobian_size(&slopes) < 1e-12);
        srp_interp_destroy(interp);
    }
}
END_TEST

START_TEST(a_linear_field_comes_out_everywhere) {
    const srp_interp_scheme *scheme = scheme_of(_i);
    if (!(scheme->capabilities & SRP_INTERP_LINEAR)) {
        return;
    }
    srp_vec3 special[64];
    size_t count = special_directions(special);
    for (int g = 0; g < GRID_COUNT; ++g) {
        srp_interp *interp = field_interp(scheme, GRIDS[g][0], GRIDS[g][1], linear_field);
        double worst = worst_error(interp, linear_field);
        ck_assert_msg(worst < 1e-12, "%u x %u: %g", GRIDS[g][0], GRIDS[g][1], worst);
        /* df = M (1 - s s^T), M by columns. */
        field_value zero = linear_field(srp_vec3_make(0, 0, 0));
        srp_vec3 m[3] = {
            srp_vec3_sub(linear_field(srp_vec3_make(1, 0, 0)).f, zero.f),
            srp_vec3_sub(linear_field(srp_vec3_make(0, 1, 0)).f, zero.f),
            srp_vec3_sub(linear_field(srp_vec3_make(0, 0, 1)).f, zero.f),
        };
        for (size_t k = 0; k < count; ++k) {
            srp_vec3 s = special[k];
            srp_interp_jacobian slopes = ask_slopes(interp, s);
            srp_vec3 along = srp_vec3_sub(linear_field(s).f, zero.f);
            const double sc[3] = {s.x, s.y, s.z};
            for (int c = 0; c < 3; ++c) {
                srp_vec3 want = srp_vec3_add_scaled(m[c], -sc[c], along);
                srp_vec3 got = srp_vec3_make(slopes.df[0][c], slopes.df[1][c], slopes.df[2][c]);
                assert_vec3_close(got, want, 0.0, 1e-11);
            }
        }
        srp_interp_destroy(interp);
    }
}
END_TEST

START_TEST(nodes_come_out) {
    for (int g = 0; g < GRID_COUNT; ++g) {
        srp_table *table = field_table(GRIDS[g][0], GRIDS[g][1], true, NULL);
        srp_interp *interp = make_interp(scheme_of(_i), table);
        srp_grid grid = srp_table_grid(table);
        for (uint32_t i = 0; i < grid.az_count; ++i) {
            for (uint32_t j = 0; j < grid.el_count; ++j) {
                const srp_response *node = srp_table_node(table, i, j);
                field_value want = {node->f, node->t};
                field_value got = ask(interp, srp_grid_direction(grid, i, j));
                double off = field_distance(got, want);
                ck_assert_msg(off < 3e-13, "%u x %u, node %u, %u: off by %g", GRIDS[g][0],
                              GRIDS[g][1], i, j, off);
            }
        }
        srp_interp_destroy(interp);
        srp_table_destroy(table);
    }
}
END_TEST

/* The functions that each scheme is made of, one per node: of the distance in steps. Written here
 * once more, by their definitions. */
static double hat(double x) {
    return fmax(0.0, 1.0 - fabs(x));
}

static double keys(double x) {
    double a = -0.5;
    x = fabs(x);
    return x < 1.0   ? (a + 2.0) * x * x * x - (a + 3.0) * x * x + 1.0
           : x < 2.0 ? a * (x * x * x - 5.0 * x * x + 8.0 * x - 4.0)
                     : 0.0;
}

static double cubic_b(double x) {
    /* Cox and de Boor: third-degree from truncated powers. */
    double sum = 0.0;
    const double binomial[5] = {1.0, -4.0, 6.0, -4.0, 1.0};
    for (int k = 0; k < 5; ++k) {
        double y = x + 2.0 - k;
        sum += y > 0.0 ? binomial[k] * y * y * y / 6.0 : 0.0;
    }
    return fabs(x) < 2.0 ? sum : 0.0;
}

enum { SPAN_AZ = 36, SPAN_EL = 36 };
static double (*span_kernel)(double x);
static double span_weights[SPAN_AZ][SPAN_EL + 1][6];
static bool span_linear;

/* Sum of such functions around nodes away from poles and axes; across the seam. */
static field_value span_field(srp_vec3 s) {
    double u = (atan2(s.y, s.x) / (2.0 * SRP_PI) + 0.5) * SPAN_AZ;
    double v = (atan2(s.z, hypot(s.x, s.y)) / SRP_PI + 0.5) * SPAN_EL;
    double out[6] = {0.0};
    for (int i = 0; i < SPAN_AZ; ++i) {
        double x = remainder(u - i, SPAN_AZ);
        double in_az = fabs(x) < 2.0 ? span_kernel(x) : 0.0;
        for (int j = 0; in_az != 0.0 && j <= SPAN_EL; ++j) {
            double weight = in_az * span_kernel(v - j);
            for (int k = 0; k < 6; ++k) {
                out[k] += weight * span_weights[i][j][k];
            }
        }
    }
    field_value value = {{out[0], out[1], out[2]}, {out[3], out[4], out[5]}};
    if (span_linear) {
        field_value linear = linear_field(s);
        value.f = srp_vec3_add(value.f, linear.f);
        value.t = srp_vec3_add(value.t, linear.t);
    }
    return value;
}

START_TEST(a_field_of_the_span_comes_out) {
    static double (*const KERNELS[3])(double) = {hat, keys, cubic_b};
    uint64_t state = 19;
    span_kernel = KERNELS[_i];
    span_linear = _i > 0;
    memset(span_weights, 0, sizeof span_weights);
    for (int i = 0; i < SPAN_AZ; ++i) {
        for (int j = 4; j <= SPAN_EL - 4; ++j) {
            for (int k = 0; k < 6 && abs(j - SPAN_EL / 2) > 3; ++k) {
                span_weights[i][j][k] = 2.0 * random_unit(&state) - 1.0;
            }
        }
    }
    srp_interp *interp = field_interp(scheme_of(_i), SPAN_AZ, SPAN_EL, span_field);
    double worst = worst_error(interp, span_field);
    printf("%s: reproduces its span to %.1e\n", scheme_of(_i)->name, worst);
    ck_assert(worst < 1e-12);
    srp_interp_destroy(interp);
}
END_TEST

/* ---- Order ---------------------------------------------------------------------------------- */

enum { INSIDE, SEAM, CAPS, REGION_COUNT };

static int region_of(srp_vec3 s) {
    double az = atan2(s.y, s.x), el = asin(s.z);
    return fabs(el) > 1.2 ? CAPS : fabs(az) > 2.8 ? SEAM : fabs(az) < 2.6 ? INSIDE : -1;
}

/* Root mean square and largest errors by region. */
static void errors_by_region(const srp_interp *interp, double rms[3], double most[3]) {
    uint64_t state = 311;
    size_t count[REGION_COUNT] = {0};
    memset(rms, 0, 3 * sizeof rms[0]);
    memset(most, 0, 3 * sizeof most[0]);
    for (int k = 0; k < 60000; ++k) {
        srp_vec3 s = random_direction(&state);
        int region = region_of(s);
        if (region >= 0) {
            double off = field_distance(ask(interp, s), smooth_field(s));
            rms[region] += off * off;
            most[region] = fmax(most[region], off);
            ++count[region];
        }
    }
    for (int r = 0; r < REGION_COUNT; ++r) {
        rms[r] = sqrt(rms[r] / (double)count[r]);
    }
}

START_TEST(the_error_falls_with_the_order_everywhere) {
    static const uint32_t AZ_STEPS[2][2] = {{72, 144}, {75, 149}};
    static const double ORDERS[3] = {1.9, 2.8, 3.8};
    const srp_interp_scheme *scheme = scheme_of(_i);
    for (int odd = 0; odd < 2; ++odd) {
        double rms[2][REGION_COUNT], most[2][REGION_COUNT];
        for (int k = 0; k < 2; ++k) {
            uint32_t steps = AZ_STEPS[odd][k];
            srp_interp *interp = field_interp(scheme, steps, steps / 2, smooth_field);
            errors_by_region(interp, rms[k], most[k]);
            srp_interp_destroy(interp);
        }
        double halving = log((double)(AZ_STEPS[odd][1] / 2) / (AZ_STEPS[odd][0] / 2));
        for (int r = 0; r < REGION_COUNT; ++r) {
            double order = log(rms[0][r] / rms[1][r]) / halving;
            double order_most = log(most[0][r] / most[1][r]) / halving;
            printf("%s, %u columns, %s: order %.2f (largest %.2f), error %.1e (largest %.1e)\n",
                   scheme->name, AZ_STEPS[odd][1],
                   r == INSIDE ? "inside"
                   : r == SEAM ? "seam"
                               : "caps",
                   order, order_most, rms[1][r], most[1][r]);
            ck_assert(order > ORDERS[_i] && order_most > ORDERS[_i] - 0.1);
            ck_assert(rms[1][r] < 2.0 * rms[1][INSIDE]);
            ck_assert(most[1][r] < 2.0 * most[1][INSIDE]);
        }
    }
}
END_TEST

/* ---- Derivatives ---------------------------------------------------------------------------- */

/* Two directions across s. */
static void sides_of(srp_vec3 s, srp_vec3 side[2]) {
    srp_vec3 other = fabs(s.z) < 0.7 ? srp_vec3_make(0, 0, 1) : srp_vec3_make(1, 0, 0);
    side[0] = srp_vec3_cross(s, other);
    side[0] = srp_vec3_scale(1.0 / srp_vec3_norm(side[0]), side[0]);
    side[1] = srp_vec3_cross(s, side[0]);
}

static field_value along(const srp_interp_jacobian *slopes, srp_vec3 u) {
    double d[6];
    for (int r = 0; r < 3; ++r) {
        d[r] = slopes->df[r][0] * u.x + slopes->df[r][1] * u.y + slopes->df[r][2] * u.z;
        d[3 + r] = slopes->dt[r][0] * u.x + slopes->dt[r][1] * u.y + slopes->dt[r][2] * u.z;
    }
    return (field_value){{d[0], d[1], d[2]}, {d[3], d[4], d[5]}};
}

/* Largest difference between the derivatives at s and differences over +-step. */
static double slope_error(const srp_interp *interp, srp_vec3 s, double step) {
    srp_interp_jacobian slopes = ask_slopes(interp, s);
    srp_vec3 side[2];
    double worst = 0.0;
    const field_value zero = {{0, 0, 0}, {0, 0, 0}};
    sides_of(s, side);
    for (int k = 0; k < 2; ++k) {
        field_value high = ask(interp, turned_towards(s, side[k], step));
        field_value low = ask(interp, turned_towards(s, side[k], -step));
        field_value difference = {srp_vec3_scale(0.5 / step, srp_vec3_sub(high.f, low.f)),
                                  srp_vec3_scale(0.5 / step, srp_vec3_sub(high.t, low.t))};
        worst = fmax(worst, field_distance(along(&slopes, side[k]), difference));
    }
    /* And nothing along s. */
    ck_assert(field_distance(along(&slopes, s), zero) < 1e-13 * (1.0 + jacobian_size(&slopes)));
    return worst;
}

/* Whether a circle of `angle` about s leaves its cell. */
static bool is_near_edge(const srp_interp *interp, srp_vec3 s, double angle) {
    srp_interp_place place;
    ck_assert(srp_interp_locate(interp, &s, &place));
    double column = angle * interp->columns_per_rad / fmax(place.cos_el, 1e-9);
    double row = angle * interp->rows_per_rad;
    return place.p < column || place.p > 1.0 - column || place.q < row || place.q > 1.0 - row;
}

START_TEST(derivatives_are_those_of_the_values) {
    const double step = 1e-6;
    srp_interp *interp = field_interp(scheme_of(_i), 72, 36, smooth_field);
    srp_vec3 special[64];
    size_t count = special_directions(special), looked_at = 0;
    uint64_t state = 4711;
    double worst = 0.0;
    for (size_t k = 0; k < count + 10000; ++k) {
        srp_vec3 s = k < count ? special[k] : random_direction(&state);
        bool edge = is_near_edge(interp, s, step);
        /* On an edge bilinear has a slope on each side, bicubic a jump of the second derivative. */
        if (_i == 0 && edge) {
            continue;
        }
        double error = slope_error(interp, s, _i == 1 && edge ? 1e-7 : step);
        srp_interp_jacobian slopes = ask_slopes(interp, s);
        double relative = error / jacobian_size(&slopes);
        ck_assert_msg(relative < 1e-7, "%s at (%.17g, %.17g, %.17g): off by %g",
                      scheme_of(_i)->name, s.x, s.y, s.z, relative);
        worst = fmax(worst, relative);
        ++looked_at;
    }
    printf("%s: derivatives agree with differences to %.1e in %zu directions\n",
           scheme_of(_i)->name, worst, looked_at);
    ck_assert(looked_at > 9900);
    srp_interp_destroy(interp);
}
END_TEST

/* Largest difference between the slopes at the poles and those of the field. */
static double pole_slope_error(const srp_interp_scheme *scheme, uint32_t columns) {
    const double step = 1e-5;
    srp_interp *interp = field_interp(scheme, columns, columns / 2, smooth_field);
    double worst = 0.0;
    for (int k = 0; k < 4; ++k) {
        srp_vec3 s = srp_vec3_make(0.0, 0.0, k < 2 ? 1.0 : -1.0);
        srp_vec3 u = srp_vec3_make(k % 2 == 0, k % 2 == 1, 0.0);
        srp_interp_jacobian slopes = ask_slopes(interp, s);
        field_value high = smooth_field(turned_towards(s, u, step));
        field_value low = smooth_field(turned_towards(s, u, -step));
        field_value want = {srp_vec3_scale(0.5 / step, srp_vec3_sub(high.f, low.f)),
                            srp_vec3_scale(0.5 / step, srp_vec3_sub(high.t, low.t))};
        worst = fmax(worst, field_distance(along(&slopes, u), want));
    }
    srp_interp_destroy(interp);
    return worst;
}

/* bilinear's too, which is that of a fit. */
START_TEST(the_slope_at_a_pole_is_that_of_the_field) {
    static const double RATIOS[3] = {3.8, 3.8, 7.5};
    double coarse = pole_slope_error(scheme_of(_i), 72),
           fine = pole_slope_error(scheme_of(_i), 144);
    printf("%s: slope at the poles off by %.1e and %.1e with half the step\n", scheme_of(_i)->name,
           coarse, fine);
    (void)fflush(stdout);
    ck_assert(coarse < 5e-2 && coarse > RATIOS[_i] * fine);
}
END_TEST

/* ---- Continuity ----------------------------------------------------------------------------- */

/* Points on the edges of cells, poles and corners among them. */
static srp_vec3 edge_point(srp_grid grid, int k, uint64_t *state) {
    uint32_t i = (uint32_t)(random_unit(state) * grid.az_count);
    uint32_t j = (uint32_t)(random_unit(state) * grid.el_count);
    double az = srp_grid_azimuth_deg(grid, i), el = srp_grid_elevation_deg(grid, j);
    if (k % 3 == 0) {
        az = 360.0 * random_unit(state) - 180.0;
    } else if (k % 3 == 1) {
        el = 180.0 * random_unit(state) - 90.0;
    }
    if (k % 50 == 0) {
        return srp_vec3_make(0, 0, k % 100 == 0 ? 1 : -1);
    }
    if (k % 7 == 0) { /* within the cells around a pole, on their seams */
        el = (k % 14 == 0 ? 90.0 : -90.0) * (1.0 - 1e-3 * random_unit(state));
    }
    return srp_direction_from_deg(az, el);
}

/* Second derivative along u, one-sided. */
static double second(const srp_interp *interp, srp_vec3 s, srp_vec3 u, double step, double out[6]) {
    srp_vec3 at = turned_towards(s, u, step);
    srp_vec3 u_at = turned_towards(u, s, -step);
    srp_interp_jacobian here = ask_slopes(interp, s), there = ask_slopes(interp, at);
    field_value a = along(&here, u), b = along(&there, u_at);
    const double d[6] = {b.f.x - a.f.x, b.f.y - a.f.y, b.f.z - a.f.z,
                         b.t.x - a.t.x, b.t.y - a.t.y, b.t.z - a.t.z};
    double size = 0.0;
    for (int k = 0; k < 6; ++k) {
        out[k] = d[k] / step;
        size = fmax(size, fabs(out[k]));
    }
    return size;
}

START_TEST(pieces_meet_smoothly) {
    /* Rough nodes: nothing is smooth but the scheme. */
    for (int g = 0; g < GRID_COUNT; ++g) {
        const srp_interp_scheme *scheme = scheme_of(_i);
        srp_interp *interp = field_interp(scheme, GRIDS[g][0], GRIDS[g][1], NULL);
        srp_grid grid = {GRIDS[g][0] + 1, GRIDS[g][1] + 1};
        uint64_t state = 99;
        double jump0 = 0.0, jump1 = 0.0, jump2 = 0.0;
        double rows = interp->rows_per_rad, columns = 1.0 + interp->columns_per_rad;
        for (int k = 0; k < 1500; ++k) {
            srp_vec3 s = edge_point(grid, k, &state);
            srp_vec3 u = srp_vec3_cross(s, random_direction(&state));
            u = srp_vec3_scale(1.0 / srp_vec3_norm(u), u);
            const double close = 1e-9;
            srp_vec3 a = turned_towards(s, u, close), b = turned_towards(s, u, -close);
            jump0 = fmax(jump0, field_distance(ask(interp, a), ask(interp, b)));
            srp_interp_jacobian ja = ask_slopes(interp, a), jb = ask_slopes(interp, b);
            jump1 = fmax(jump1, jacobian_distance(&ja, &jb) / (rows * columns));
            double forth[6], back[6];
            second(interp, s, u, 1e-7, forth);
            second(interp, s, u, -1e-7, back);
            for (int c = 0; c < 6; ++c) {
                jump2 = fmax(jump2, fabs(forth[c] - back[c]) / (rows * rows * columns * columns));
            }
        }
        printf("%s, %u x %u: jumps of value, first and second derivative %.1e, %.1e, %.1e\n",
               scheme->name, GRIDS[g][0], GRIDS[g][1], jump0, jump1, jump2);
        (void)fflush(stdout);
        /* What the steps of 1e-9 and 1e-7 leave of the next derivative. */
        ck_assert(jump0 < 1e-5);
        ck_assert(scheme->continuity < 1 || jump1 < 1e-5);
        ck_assert(scheme->continuity < 2 || jump2 < 1e-3);
        srp_interp_destroy(interp);
    }
}
END_TEST

/* ---- Tables that are not quite right -------------------------------------------------------- */

START_TEST(ends_that_disagree_are_joined) {
    srp_table *table = field_table(12, 6, true, constant_field);
    const srp_vec3 z = {0, 0, 1};
    for (uint32_t i = 0; i < 12; ++i) {
        field_value value = constant_field(z);
        value.f.x += 0.1 * i;
        set_node(table, i, 6, value);
    }
    field_value other = constant_field(z);
    other.f.y += 0.25;
    set_node(table, 12, 2, other);
    srp_interp *interp = make_interp(scheme_of(_i), table);
    assert_close(ask(interp, z).f.x, 3.7123 + 0.55, 1e-15, 0.0);
    assert_close(ask(interp, srp_direction_from_deg(180, -30)).f.y, -1.91 + 0.125, 1e-14, 0.0);
    srp_interp_destroy(interp);
    srp_table_destroy(table);
}
END_TEST

START_TEST(without_moments_there_are_none) {
    srp_table *table = field_table(24, 12, false, smooth_field);
    srp_table *both = field_table(24, 12, true, smooth_field);
    srp_interp *interp = make_interp(scheme_of(_i), table),
               *full = make_interp(scheme_of(_i), both);
    ck_assert(!srp_interp_has_moment(interp) && srp_interp_has_moment(full));
    ck_assert_ptr_eq(srp_interp_get_scheme(interp), scheme_of(_i));
    srp_vec3 s = srp_vec3_make(0.48, -0.6, 0.64);
    field_value a = ask(interp, s), b = ask(full, s);
    ck_assert(srp_vec3_norm(a.t) == 0.0 && srp_vec3_norm(b.t) > 0.0);
    ck_assert(srp_vec3_norm(srp_vec3_sub(a.f, b.f)) == 0.0);
    srp_interp_jacobian slopes = ask_slopes(interp, s), other = ask_slopes(full, s);
    ck_assert(memcmp(slopes.df, other.df, sizeof slopes.df) == 0);
    ck_assert(slopes.dt[1][2] == 0.0 && other.dt[1][2] != 0.0);
    srp_error error;
    ck_assert_int_eq(srp_interp_eval(interp, s, &a.f, NULL, NULL, &error), SRP_OK);
    srp_interp_destroy(interp);
    srp_interp_destroy(full);
    srp_table_destroy(table);
    srp_table_destroy(both);
}
END_TEST

/* ---- Refusals ------------------------------------------------------------------------------- */

START_TEST(wrong_directions_are_refused) {
    srp_interp *interp = field_interp(scheme_of(_i), 24, 12, smooth_field);
    const srp_vec3 wrong[] = {{NAN, 0, 1},        {0, NAN, 1},   {0, 0, NAN},    {INFINITY, 0, 0},
                              {0, 0, -INFINITY},  {0, 0, 0},     {1e-200, 0, 0}, {0.6, 0.8, 1e-3},
                              {1.0 + 2e-9, 0, 0}, {1e200, 0, 0}, {0, 0.99, 0}};
    for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; ++k) {
        srp_vec3 f = {7, 8, 9}, t = {1, 2, 3};
        srp_interp_jacobian slopes = {{{5}}, {{6}}};
        srp_error error;
        ck_assert_int_eq(srp_interp_eval(interp, wrong[k], &f, &t, &slopes, &error),
                         SRP_BAD_ARGUMENT);
        ck_assert(strstr(error.message, "unit vector") != NULL);
        ck_assert(f.x == 7 && t.z == 3 && slopes.df[0][0] == 5 && slopes.dt[0][0] == 6);
        ck_assert_int_eq(srp_interp_eval(interp, wrong[k], &f, NULL, NULL, NULL), SRP_BAD_ARGUMENT);
    }
    /* Unit to rounding is taken, and counts as its direction. */
    srp_vec3 s = srp_direction_from_deg(31.7, -12.3);
    field_value a = ask(interp, s), b = ask(interp, srp_vec3_scale(1.0 + 9e-10, s));
    ck_assert(field_distance(a, b) < 1e-14);
    srp_interp_destroy(interp);
}
END_TEST

START_TEST(wrong_tables_are_refused) {
    const srp_interp_scheme *scheme = scheme_of(_i);
    srp_interp *interp = NULL;
    srp_error error;
    srp_table *table = field_table(24, 12, true, smooth_field);
    field_value bad = smooth_field(srp_vec3_make(0, 0, 1));
    bad.t.y = NAN;
    set_node(table, 3, 5, bad);
    ck_assert_int_eq(srp_interp_create(scheme, table, &interp, &error), SRP_BAD_DATA);
    ck_assert_str_eq(error.message,
                     "the node at azimuth -135, elevation -15 degrees is not finite");
    srp_table_destroy(table);

    srp_grid grid = {25, 13};
    assert_ok(srp_table_create_blank(grid, 0, false, &table, &error), error);
    ck_assert_int_eq(srp_interp_create(scheme, table, &interp, &error), SRP_BAD_ARGUMENT);
    ck_assert_str_eq(error.message, "the table holds 0 of 325 nodes, expected a complete one");
    srp_table_destroy(table);

    table = field_table(3, 2, true, smooth_field);
    srp_status status = srp_interp_create(scheme, table, &interp, &error);
    if (scheme->order > 2) {
        ck_assert_int_eq(status, SRP_BAD_ARGUMENT);
        ck_assert(strstr(error.message, "at most 90 degrees") != NULL);
        ck_assert_ptr_null(interp);
    } else {
        ck_assert_int_eq(status, SRP_OK);
    }
    srp_interp_destroy(interp);
    srp_table_destroy(table);
    srp_interp_destroy(NULL);
}
END_TEST

/* Bilinear takes any grid there is. */
START_TEST(the_coarsest_grids_are_finite) {
    static const uint32_t COARSE[][2] = {{1, 1}, {2, 1}, {3, 1}, {1, 2}, {2, 3}};
    srp_vec3 special[64];
    size_t count = special_directions(special);
    for (size_t g = 0; g < sizeof COARSE / sizeof COARSE[0]; ++g) {
        srp_interp *interp = field_interp(&srp_interp_bilinear, COARSE[g][0], COARSE[g][1], NULL);
        for (size_t k = 0; k < count; ++k) {
            srp_interp_jacobian slopes = ask_slopes(interp, special[k]);
            ck_assert(isfinite(jacobian_size(&slopes)));
        }
        srp_interp_destroy(interp);
    }
}
END_TEST

START_TEST(schemes_are_found_by_name) {
    size_t count;
    const srp_interp_scheme *const *list = srp_interp_list(&count);
    for (size_t k = 0; k < count; ++k) {
        ck_assert_ptr_eq(srp_interp_find(list[k]->name), list[k]);
        ck_assert_int_eq(list[k]->continuity, (int)k);
        ck_assert_int_eq(list[k]->order, (int)k + 2);
    }
    ck_assert_ptr_null(srp_interp_find("trilinear"));
}
END_TEST

int main(void) {
    Suite *suite = suite_create("interp");
    TCase *tcase = tcase_create("interp");
    tcase_set_timeout(tcase, 120);
    tcase_add_test(tcase, a_direction_is_located_to_rounding);
    tcase_add_loop_test(tcase, a_constant_comes_out_everywhere, 0, 3);
    tcase_add_loop_test(tcase, a_linear_field_comes_out_everywhere, 0, 3);
    tcase_add_loop_test(tcase, nodes_come_out, 0, 3);
    tcase_add_loop_test(tcase, a_field_of_the_span_comes_out, 0, 3);
    tcase_add_loop_test(tcase, the_error_falls_with_the_order_everywhere, 0, 3);
    tcase_add_loop_test(tcase, derivatives_are_those_of_the_values, 0, 3);
    tcase_add_loop_test(tcase, the_slope_at_a_pole_is_that_of_the_field, 0, 3);
    tcase_add_loop_test(tcase, pieces_meet_smoothly, 0, 3);
    tcase_add_loop_test(tcase, ends_that_disagree_are_joined, 0, 3);
    tcase_add_loop_test(tcase, without_moments_there_are_none, 0, 3);
    tcase_add_loop_test(tcase, wrong_directions_are_refused, 0, 3);
    tcase_add_loop_test(tcase, wrong_tables_are_refused, 0, 3);
    tcase_add_test(tcase, the_coarsest_grids_are_finite);
    tcase_add_test(tcase, schemes_are_found_by_name);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
