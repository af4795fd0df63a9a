/* SPDX-License-Identifier: Apache-2.0 */
/* What figures are made of, without drawing: axes, and numbers at the contours of maps. */
#include "figure_scale.h"
#include "map_labels.h"
#include "srp_check.h"

#include <srp/const.h>

#include <math.h>
#include <string.h>

/* ---- scales ---- */

enum { NODES = 9 };

/* Three components and their length on a grid of 3 x 3 nodes. */
static cli_picture picture_of(double value[CLI_FIGURE_ROWS][NODES]) {
    cli_picture picture = {.columns = 1, .rows = CLI_FIGURE_ROWS, .grid = {{3, 3}}};
    for (size_t r = 0; r < CLI_FIGURE_ROWS; ++r) {
        picture.is_signed[r] = r < 3;
        picture.field[0][r].value = value[r];
    }
    return picture;
}

static void check_flat(cli_scale scale, double value, double low, double high, const char *words) {
    char text[CLI_FLAT_SIZE];
    ck_assert(scale.is_flat);
    ck_assert(fabs(scale.value - value) <= 1e-12 * fabs(value));
    ck_assert_msg(fabs(scale.low - low) < 1e-9 && fabs(scale.high - high) < 1e-9,
                  "from %g to %g, expected from %g to %g", scale.low, scale.high, low, high);
    ck_assert_str_eq(cli_figure_flat_words(scale, text), words);
}

START_TEST(a_flat_field_has_a_sensible_axis) {
    double value[CLI_FIGURE_ROWS][NODES] = {{0}};
    char text[CLI_FLAT_SIZE];
    cli_picture picture = picture_of(value);
    check_flat(cli_figure_scale(&picture, 0), 0.0, -1.0, 1.0, "0 everywhere");
    check_flat(cli_figure_scale(&picture, 3), 0.0, 0.0, 1.0,
               "0 everywhere"); /* no length below 0 */
    for (size_t k = 0; k < NODES; ++k) {
        value[0][k] = 3.7 * ((double)k - 4.0);
        value[1][k] = k % 2 == 0 ? 3e-15 : -2e-15; /* rounding beside the first */
        value[2][k] = -2.6;
        value[3][k] = 12.3 * (1.0 + 1e-15 * (double)k);
    }
    cli_scale scale = cli_figure_scale(&picture, 0);
    ck_assert(!scale.is_flat && scale.low == value[0][0] && scale.high == value[0][8]);
    ck_assert_str_eq(cli_figure_flat_words(scale, text), "");
    check_flat(cli_figure_scale(&picture, 1), 0.0, -14.8, 14.8, "0 everywhere");
    check_flat(cli_figure_scale(&picture, 2), -2.6, -3.25, 0.0, "-2.6 everywhere");
    check_flat(cli_figure_scale(&picture, 3), 12.3, 0.0, 15.375, "12.3 everywhere");
}
END_TEST

/* ---- labels ---- */

typedef double field(const void *data, double az_deg, double el_deg);

static double waves(const void *data, double az, double el) {
    (void)data;
    return 37.3 * cos(az * SRP_RAD_PER_DEG + 0.4) * cos(1.3 * el * SRP_RAD_PER_DEG) + 0.11 * el;
}

/* Rises at the frame alone, where there is no room inside. */
static double rim(const void *data, double az, double el) {
    (void)data;
    return fmax(fabs(az) - 170.0, 0.0) + fmax(fabs(el) - 84.0, 0.0);
}

/* A plateau of 0, as from where a plate is not lit. */
static double plateau(const void *data, double az, double el) {
    (void)data;
    return fmax(cos(az * SRP_RAD_PER_DEG) * cos(el * SRP_RAD_PER_DEG), 0.0) * 3.1;
}

static double far_out(const cli_map_label *l, double sign_x, double sign_y, bool mollweide) {
    double x = (l->x + sign_x * l->half) / 180.0, y = (l->y + sign_y * CLI_MAP_LABEL_HALF) / 90.0;
    return mollweide ? hypot(x, y) : fmax(fabs(x), fabs(y));
}

static void check_labels(field *value, const double *level, int count, double step, bool mollweide,
                         int least) {
    const cli_map_field f = {value, NULL, mollweide};
    cli_map_labels labels;
    cli_map_label_contours(&f, level, count, step, &labels);
    ck_assert_msg(labels.count >= least, "%d labels, expected %d", labels.count, least);
    for (int k = 0; k < labels.count; ++k) {
        const cli_map_label *l = &labels.at[k];
        char text[32];
        snprintf(text, sizeof text, "%g", l->level);
        ck_assert_str_eq(l->text, text);
        for (int corner = 0; corner < 4; ++corner) {
            double out = far_out(l, corner % 2 == 0 ? -1 : 1, corner < 2 ? -1 : 1, mollweide);
            ck_assert_msg(out < 1.0, "'%s' at %g, %g is cut by the frame", l->text, l->x, l->y);
        }
        for (int m = 0; m < k; ++m) {
            const cli_map_label *other = &labels.at[m];
            ck_assert_msg(fabs(l->x - other->x) > l->half + other->half ||
                              fabs(l->y - other->y) > 2.0 * CLI_MAP_LABEL_HALF,
                          "'%s' and '%s' lie on each other", l->text, other->text);
        }
        if (!mollweide) { /* where x and y are the angles: on the contour */
            ck_assert_msg(fabs(value(NULL, l->x, l->y) - l->level) < 0.03 * step,
                          "'%s' stands at %g", l->text, value(NULL, l->x, l->y));
        }
    }
}

START_TEST(labels_are_whole_and_apart) {
    const double level[] = {-40, -30, -20, -10, 0, 10, 20, 30, 40};
    check_labels(waves, level, 9, 10.0, false, 12);
    check_labels(waves, level, 9, 10.0, true, 12);
    const double few[] = {0.5, 1.0, 1.5, 2.0, 2.5};
    check_labels(plateau, few, 5, 0.5, false, 8);
    check_labels(plateau, few, 5, 0.5, true, 8);
}
END_TEST

START_TEST(no_label_where_there_is_no_room_or_no_line) {
    cli_map_labels labels;
    const double level[] = {1, 2, 3, 4}, zero[] = {0.0};
    for (int mollweide = 0; mollweide < 2; ++mollweide) {
        const cli_map_field f = {rim, NULL, mollweide != 0}, flat = {plateau, NULL, mollweide != 0};
        cli_map_label_contours(&f, level, 4, 1.0, &labels);
        ck_assert_int_eq(labels.count, 0);
        cli_map_label_contours(&flat, zero, 1, 0.5, &labels);
        ck_assert_int_eq(labels.count, 0);
    }
}
END_TEST

START_TEST(the_ellipse_is_mollweides) {
    double x, y;
    cli_map_place(-180.0, 0.0, true, &x, &y);
    assert_close(x, -180.0, 1e-12, 0.0);
    assert_close(y, 0.0, 0.0, 1e-12);
    cli_map_place(77.0, 90.0, true, &x, &y);
    assert_close(x, 0.0, 0.0, 1e-7);
    assert_close(y, 90.0, 1e-12, 0.0);
    /* Equal areas: as much of the ellipse lies below a parallel as of the sphere. */
    for (double el = -80.0; el <= 80.0; el += 17.3) {
        cli_map_place(180.0, el, true, &x, &y);
        double theta = asin(y / 90.0), below = 0.5 + (theta + 0.5 * sin(2.0 * theta)) / SRP_PI;
        assert_close(below, 0.5 + 0.5 * sin(el * SRP_RAD_PER_DEG), 1e-12, 0.0);
        assert_close(x, 180.0 * cos(theta), 1e-12, 0.0);
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("figure_parts");
    TCase *tc = tcase_create("figure_parts");
    tcase_add_test(tc, a_flat_field_has_a_sensible_axis);
    tcase_add_test(tc, labels_are_whole_and_apart);
    tcase_add_test(tc, no_label_where_there_is_no_room_or_no_line);
    tcase_add_test(tc, the_ellipse_is_mollweides);
    suite_add_tcase(suite, tc);
    return run_suite(suite);
}
