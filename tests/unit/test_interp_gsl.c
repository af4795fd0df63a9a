/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Interpolants beside GSL's, on the same nodes. GSL knows neither seam nor poles: it gets a plane
 * that goes on far enough beyond them, so that its natural ends are forgotten. Its bicubic is the
 * tensor product of cubic splines, like ours.
 */
#include "interp_fixture.h"
#include "interp_internal.h"
#include "srp_check.h"

#include <srp/const.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_interp2d.h>
#include <math.h>

/* Columns and rows beyond the ends: (2 - sqrt 3)^MARGIN of an end's mistake is left. */
enum { COLUMNS = 72, ROWS = 36, MARGIN = 30, WIDE = COLUMNS + 2 * MARGIN + 1 };
enum { HIGH = ROWS + 2 * MARGIN + 1 };

typedef struct oracle {
    gsl_interp2d *interp[6];
    double x[WIDE], y[HIGH], z[6][WIDE * HIGH];
} oracle;

static oracle beside;

static double component(field_value value, int k) {
    const double all[6] = {value.f.x, value.f.y, value.f.z, value.t.x, value.t.y, value.t.z};
    return all[k];
}

/* What our scheme takes off before it begins. */
static double linear_part(const srp_interp *interp, srp_vec3 s, int k) {
    return interp->linear[0][k] + s.x * interp->linear[1][k] + s.y * interp->linear[2][k] +
           s.z * interp->linear[3][k];
}

static void make_oracle(const gsl_interp2d_type *type, const srp_interp *interp) {
    for (int j = 0; j < HIGH; ++j) {
        beside.y[j] = (j - MARGIN) * 180.0 / ROWS - 90.0;
    }
    for (int i = 0; i < WIDE; ++i) {
        beside.x[i] = (i - MARGIN) * 360.0 / COLUMNS - 180.0;
        for (int j = 0; j < HIGH; ++j) {
            /* Elevations beyond 90 degrees are those of the other side. */
            srp_vec3 s = srp_direction_from_deg(beside.x[i], beside.y[j]);
            for (int k = 0; k < 6; ++k) {
                beside.z[k][j * WIDE + i] =
                    component(smooth_field(s), k) - linear_part(interp, s, k);
            }
        }
    }
    for (int k = 0; k < 6; ++k) {
        beside.interp[k] = gsl_interp2d_alloc(type, WIDE, HIGH);
        ck_assert_ptr_nonnull(beside.interp[k]);
        ck_assert_int_eq(
            gsl_interp2d_init(beside.interp[k], beside.x, beside.y, beside.z[k], WIDE, HIGH), 0);
    }
}

static void check_direction(const srp_interp *interp, srp_vec3 s, double worst[2]) {
    double az = atan2(s.y, s.x) / SRP_RAD_PER_DEG;
    double h = hypot(s.x, s.y), el = atan2(s.z, h) / SRP_RAD_PER_DEG;
    srp_vec3 east = srp_vec3_make(-s.y / h, s.x / h, 0.0);
    srp_vec3 north = srp_vec3_cross(s, east);
    field_value value = ask(interp, s);
    srp_interp_jacobian slopes = ask_slopes(interp, s);
    for (int k = 0; k < 6; ++k) {
        const gsl_interp2d *o = beside.interp[k];
        double z, by_az, by_el;
        ck_assert_int_eq(
            gsl_interp2d_eval_e(o, beside.x, beside.y, beside.z[k], az, el, NULL, NULL, &z), 0);
        gsl_interp2d_eval_deriv_x_e(o, beside.x, beside.y, beside.z[k], az, el, NULL, NULL, &by_az);
        gsl_interp2d_eval_deriv_y_e(o, beside.x, beside.y, beside.z[k], az, el, NULL, NULL, &by_el);
        z += linear_part(interp, s, k);
        by_az = by_az / SRP_RAD_PER_DEG / h + (linear_part(interp, east, k) - interp->linear[0][k]);
        by_el = by_el / SRP_RAD_PER_DEG + (linear_part(interp, north, k) - interp->linear[0][k]);
        const double *row = k < 3 ? slopes.df[k] : slopes.dt[k - 3];
        double ours_az = row[0] * east.x + row[1] * east.y;
        double ours_el = row[0] * north.x + row[1] * north.y + row[2] * north.z;
        worst[0] = fmax(worst[0], fabs(component(value, k) - z));
        worst[1] = fmax(worst[1], fmax(fabs(ours_az - by_az), fabs(ours_el - by_el)));
    }
}

/* Everywhere but in the cells around the poles, which have ways of their own. */
static void compare(const srp_interp_scheme *scheme, const gsl_interp2d_type *type) {
    gsl_set_error_handler_off();
    srp_interp *interp = field_interp(scheme, COLUMNS, ROWS, smooth_field);
    make_oracle(type, interp);
    uint64_t state = 1234;
    double worst[2] = {0.0, 0.0};
    for (int k = 0; k < 20000; ++k) {
        srp_vec3 s = random_direction(&state);
        if (k < 1000) { /* along the seam */
            s = srp_direction_from_deg(180.0 + 4.0 * random_unit(&state) - 2.0,
                                       168.0 * random_unit(&state) - 84.0);
        }
        if (fabs(asin(s.z)) < 84.99 * SRP_RAD_PER_DEG) {
            check_direction(interp, s, worst);
        }
    }
    printf("%s beside GSL's %s: values differ by %.1e, derivatives by %.1e\n", scheme->name,
           type->name, worst[0], worst[1]);
    ck_assert(worst[0] < 1e-13 && worst[1] < 2e-11);
    for (int k = 0; k < 6; ++k) {
        gsl_interp2d_free(beside.interp[k]);
    }
    srp_interp_destroy(interp);
}

START_TEST(bilinear_is_that_of_gsl) {
    compare(&srp_interp_bilinear, gsl_interp2d_bilinear);
}
END_TEST

START_TEST(the_spline_is_that_of_gsl) {
    compare(&srp_interp_spline, gsl_interp2d_bicubic);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("interp_gsl");
    TCase *tcase = tcase_create("interp_gsl");
    tcase_set_timeout(tcase, 120);
    tcase_add_test(tcase, bilinear_is_that_of_gsl);
    tcase_add_test(tcase, the_spline_is_that_of_gsl);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
