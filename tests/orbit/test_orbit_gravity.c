/* SPDX-License-Identifier: Apache-2.0 */
/* Spherical harmonics beside the gradient of their potential, and files of ICGEM. */
#include "srp_check.h"

#include <srp/orbit/elements.h>
#include <srp/orbit/gravity.h>
#include <srp/orbit/propagator.h>

#include <stdio.h>
#include <string.h>

static const double MU = 3.986004415e14, RADIUS = 6378136.3, J2 = 1.0826267e-3;

enum { TEXT_SIZE = 60000, DEGREE = 12 };

typedef struct field {
    double c[DEGREE + 1][DEGREE + 1], s[DEGREE + 1][DEGREE + 1]; /* not normalised */
} field;

/* Coefficients as large as those of the Earth, made up. */
static field make_field(void) {
    field f = {0};
    uint64_t random = 11;
    f.c[0][0] = 1.0;
    for (int n = 2; n <= DEGREE; ++n) {
        for (int m = 0; m <= n; ++m) {
            double norm = (m == 0 ? 1.0 : 2.0) * (2 * n + 1);
            for (int k = n - m + 1; k <= n + m; ++k) {
                norm /= k;
            }
            f.c[n][m] = 1e-3 / (n * n) * (random_unit(&random) - 0.5) * sqrt(norm);
            f.s[n][m] = m == 0 ? 0.0 : 1e-3 / (n * n) * (random_unit(&random) - 0.5) * sqrt(norm);
        }
    }
    return f;
}

static size_t write_field(const field *f, bool normalised, char *text) {
    size_t used = (size_t)sprintf(
        text,
        "made up\nproduct_type gravity_field\nmodelname TEST\nearth_gravity_constant %.17g\n"
        "radius %.17g\nmax_degree %d\nnorm %s\nend_of_head =====\n",
        MU, RADIUS, DEGREE, normalised ? "fully_normalized" : "unnormalized");
    for (int n = 0; n <= DEGREE; ++n) {
        for (int m = 0; m <= n; ++m) {
            double k = 1.0;
            if (normalised) {
                double norm = (m == 0 ? 1.0 : 2.0) * (2 * n + 1);
                for (int i = n - m + 1; i <= n + m; ++i) {
                    norm /= i;
                }
                k = 1.0 / sqrt(norm);
            }
            used += (size_t)sprintf(text + used, "gfc %d %d %.17e %.17e 1e-12 1e-12\n", n, m,
                                    k * f->c[n][m], k * f->s[n][m]);
        }
    }
    return used;
}

static srp_gravity *parse(const char *text, unsigned degree, unsigned order) {
    srp_gravity *out = NULL;
    srp_error error;
    assert_ok(srp_gravity_parse(text, strlen(text), "t.gfc", degree, order, NULL, &out, &error),
              error);
    return out;
}

/* The potential by Legendre functions of the latitude: nothing in common with the recursion. */
static double potential(const field *f, int degree, int order, srp_vec3 r) {
    const double rn = srp_vec3_norm(r), x = r.z / rn, c = hypot(r.x, r.y) / rn;
    const double lon = atan2(r.y, r.x);
    double sum = 0.0, p[DEGREE + 1][DEGREE + 1] = {{0}};
    for (int m = 0; m <= degree; ++m) {
        p[m][m] = m == 0 ? 1.0 : (2 * m - 1) * c * p[m - 1][m - 1];
        for (int n = m + 1; n <= degree; ++n) {
            p[n][m] =
                ((2 * n - 1) * x * p[n - 1][m] - (n + m - 1) * (n > m + 1 ? p[n - 2][m] : 0.0)) /
                (n - m);
        }
    }
    for (int n = 0; n <= degree; ++n) {
        for (int m = 0; m <= (n < order ? n : order); ++m) {
            sum += pow(RADIUS / rn, n) * p[n][m] *
                   (f->c[n][m] * cos(m * lon) + f->s[n][m] * sin(m * lon));
        }
    }
    return MU / rn * sum;
}

/* Central differences of 4th order. */
static srp_vec3 gradient(const field *f, int degree, int order, srp_vec3 r) {
    const double h = 2000.0;
    double g[3];
    for (int k = 0; k < 3; ++k) {
        const srp_vec3 e = srp_vec3_make(k == 0, k == 1, k == 2);
        const double one = potential(f, degree, order, srp_vec3_add_scaled(r, h, e)) -
                           potential(f, degree, order, srp_vec3_add_scaled(r, -h, e));
        const double two = potential(f, degree, order, srp_vec3_add_scaled(r, 2 * h, e)) -
                           potential(f, degree, order, srp_vec3_add_scaled(r, -2 * h, e));
        g[k] = (8.0 * one - two) / (12.0 * h);
    }
    return srp_vec3_make(g[0], g[1], g[2]);
}

START_TEST(acceleration_is_the_gradient) {
    static char text[TEXT_SIZE];
    const field f = make_field();
    write_field(&f, true, text);
    const int sizes[][2] = {{0, 0}, {2, 0}, {2, 2}, {5, 3}, {12, 0}, {12, 12}};
    uint64_t random = 5;
    for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; ++k) {
        srp_gravity *g = parse(text, (unsigned)sizes[k][0], (unsigned)sizes[k][1]);
        for (int i = 0; i < 40; ++i) {
            const srp_vec3 r =
                srp_vec3_scale(6.6e6 + 3e7 * random_unit(&random), random_direction(&random));
            const srp_vec3 want = gradient(&f, sizes[k][0], sizes[k][1], r);
            assert_vec3_close(srp_gravity_eval(g, r), want, 1e-10, 0.0);
        }
        srp_gravity_destroy(g);
    }
}
END_TEST

START_TEST(poles_are_regular) {
    static char text[TEXT_SIZE];
    const field f = make_field();
    write_field(&f, true, text);
    srp_gravity *g = parse(text, 12, 12);
    for (int sign = -1; sign <= 1; sign += 2) {
        const srp_vec3 at = srp_gravity_eval(g, srp_vec3_make(0, 0, sign * 7e6));
        const srp_vec3 near = srp_gravity_eval(g, srp_vec3_make(1e-3, -2e-3, sign * 7e6));
        ck_assert(srp_vec3_is_finite(at));
        assert_vec3_close(near, at, 1e-9, 0.0);
    }
    srp_gravity_destroy(g);
}
END_TEST

START_TEST(both_norms_say_the_same) {
    static char one[TEXT_SIZE], other[TEXT_SIZE];
    const field f = make_field();
    write_field(&f, true, one);
    write_field(&f, false, other);
    srp_gravity *a = parse(one, 9, 7), *b = parse(other, 9, 7);
    const srp_vec3 r = srp_vec3_make(3.1e6, -5.2e6, 4.3e6);
    assert_vec3_close(srp_gravity_eval(a, r), srp_gravity_eval(b, r), 1e-14, 0.0);
    srp_gravity_destroy(a);
    srp_gravity_destroy(b);
}
END_TEST

/* The node and the perigee of an orbit about an oblate body turn as the first-order theory says, to
 * terms of second order. */
START_TEST(j2_turns_node_and_perigee) {
    char text[600];
    sprintf(text,
            "earth_gravity_constant %.17g\nradius %.17gD+00\nmax_degree 2\nend_of_head\n"
            "gfc 0 0 1.0 0.0\ngfc 2 0 %.17e 0.0\n",
            MU, RADIUS, -J2 / sqrt(5.0));
    srp_gravity *g = parse(text, 2, 0);
    srp_epoch epoch;
    srp_error error;
    srp_force force;
    srp_ephemeris *sky = NULL;
    srp_force_list *list = NULL;
    srp_propagator *p = NULL;
    /* At J2000 the pole of date is that of the axes, but for nutation. */
    assert_ok(srp_epoch_parse("2000-01-01T12:00:00 TT", &epoch, NULL, &error), error);
    srp_ephemeris_params sp = srp_ephemeris_params_default(epoch);
    sp.end = 3.0 * 86400.0;
    sp.orientation = true;
    assert_ok(srp_ephemeris_create(&sp, &sky, &error), error);
    assert_ok(srp_force_list_create(sky, SRP_EARTH, &list, &error), error);
    assert_ok(srp_force_gravity(g, sky, &force, &error), error);
    assert_ok(srp_force_list_add(list, &force, &error), error);
    srp_propagator_params pp = srp_propagator_params_default();
    assert_ok(srp_propagator_create(list, &pp, &p, &error), error);
    const srp_elements start = {9.1e6, 0.13, 0.82, 1.1, 0.7, 0.0};
    srp_vec3 r, v;
    assert_ok(srp_elements_to_state(MU, &start, &r, &v, &error), error);
    assert_ok(srp_propagator_start(p, 0.0, r, v, &error), error);
    const double n = sqrt(MU / pow(start.a, 3)), q = RADIUS / (start.a * (1 - 0.13 * 0.13));
    const double rate = 1.5 * n * J2 * q * q;
    /* Means over revolutions: the middle of each, so that short periods cancel. */
    double t[2] = {0}, node[2] = {0}, peri[2] = {0};
    const int samples = 240;
    for (int half = 0; half < 2; ++half) {
        for (int i = 0; i < samples; ++i) {
            const double when = half * 24.0 * 2 * SRP_PI / n + 2 * SRP_PI / n * i / samples;
            assert_ok(srp_propagator_advance(p, when, NULL, &error), error);
            const srp_elements el =
                srp_elements_from_state(MU, srp_propagator_position(p), srp_propagator_velocity(p));
            t[half] += when / samples;
            node[half] += el.raan / samples;
            peri[half] += (el.argp > 6.0 ? el.argp - 2 * SRP_PI : el.argp) / samples;
        }
    }
    const double node_rate = (node[1] - node[0]) / (t[1] - t[0]);
    const double peri_rate = (peri[1] - peri[0]) / (t[1] - t[0]);
    printf("J2: node %.6e, first order %.6e; perigee %.6e, first order %.6e rad/s\n", node_rate,
           -rate * cos(start.i), peri_rate, rate * (2.0 - 2.5 * pow(sin(start.i), 2)));
    assert_close(node_rate, -rate * cos(start.i), 5e-3, 0.0);
    assert_close(peri_rate, rate * (2.0 - 2.5 * pow(sin(start.i), 2)), 1e-2, 0.0);
    srp_propagator_destroy(p);
    srp_force_list_destroy(list);
    srp_ephemeris_destroy(sky);
    srp_gravity_destroy(g);
}
END_TEST

static void refused(const char *text, unsigned degree, unsigned order, srp_status status,
                    size_t line) {
    srp_gravity *out = NULL;
    srp_error error = {.line = 0};
    const srp_status got =
        srp_gravity_parse(text, strlen(text), "t.gfc", degree, order, NULL, &out, &error);
    ck_assert_msg(got == status, "%s: %s", text, srp_status_string(got));
    ck_assert_msg(line == 0 || error.line == line, "%s: line %zu, %s", text, error.line,
                  error.message);
    ck_assert(out == NULL);
}

#define HEAD "earth_gravity_constant 4e14\nradius 6.4e6\nend_of_head\n"

START_TEST(bad_files_are_refused) {
    refused("", 0, 0, SRP_BAD_FORMAT, 0);
    refused("radius 6.4e6\nend_of_head\ngfc 0 0 1 0\n", 0, 0, SRP_BAD_FORMAT, 0);
    refused("earth_gravity_constant -1\n", 0, 0, SRP_BAD_DATA, 1);
    refused("earth_gravity_constant 4e14\nradius big\n", 0, 0, SRP_BAD_FORMAT, 2);
    refused("norm strange\n", 0, 0, SRP_BAD_FORMAT, 1);
    refused(HEAD "gfc 0 0 1 0\n", 2, 0, SRP_BAD_DATA, 0);
    refused(HEAD "gfc 1 2 1 0\n", 0, 0, SRP_BAD_FORMAT, 4);
    refused(HEAD "gfc 1 1 x 0\n", 0, 0, SRP_BAD_FORMAT, 4);
    refused(HEAD "gfc 1 1 0\n", 0, 0, SRP_BAD_FORMAT, 4);
    refused(HEAD "gfc 0 0 1 0\n", 1, 2, SRP_BAD_ARGUMENT, 0);
    refused(HEAD "gfc 0 0 1 0\n", 1000, 0, SRP_BAD_ARGUMENT, 0);
    srp_gravity *out = NULL;
    srp_error error;
    ck_assert_int_eq(srp_gravity_read("no-such.gfc", 0, 0, NULL, &out, &error), SRP_NOT_FOUND);
}
END_TEST

static void count_warning(void *user, const srp_error *what) {
    (void)what;
    ++*(int *)user;
}

START_TEST(terms_in_time_are_left_out_loudly) {
    const char *text = HEAD "gfct 0 0 1 0 1 1 20050101\ntrnd 0 0 1e-11 0\nacos 0 0 1e-11 0\n";
    srp_gravity *out = NULL;
    srp_error error;
    int warnings = 0;
    const srp_log log = {count_warning, &warnings};
    assert_ok(srp_gravity_parse(text, strlen(text), "t", 0, 0, &log, &out, &error), error);
    ck_assert_int_eq(warnings, 2);
    assert_vec3_close(srp_gravity_eval(out, srp_vec3_make(0, 8e6, 0)),
                      srp_vec3_make(0, -4e14 / 64e12, 0), 1e-15, 0.0);
    srp_gravity_destroy(out);
    srp_gravity_destroy(NULL);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("orbit_gravity");
    TCase *all = tcase_create("gravity");
    tcase_add_test(all, acceleration_is_the_gradient);
    tcase_add_test(all, poles_are_regular);
    tcase_add_test(all, both_norms_say_the_same);
    tcase_add_test(all, j2_turns_node_and_perigee);
    tcase_add_test(all, bad_files_are_refused);
    tcase_add_test(all, terms_in_time_are_left_out_loudly);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
