/* SPDX-License-Identifier: Apache-2.0 */
/* Sunlight: flux at a distance, and eclipses beside brute force and beside GMAT. */
#include "srp_check.h"

#include <srp/interp.h>
#include <srp/sunlight.h>
#include <srp/table.h>

#include <math.h>
#include <string.h>

static const srp_vec3 SUN = {-1.21e11, 0.83e11, 0.31e11};
static const double EARTH = 6378136.3;

/* A direction at an angle from the Sun's, towards a position angle. */
static srp_vec3 beside_sun(srp_vec3 sun, double angle, double position_angle) {
    srp_vec3 n = srp_vec3_scale(1.0 / srp_vec3_norm(sun), sun);
    srp_vec3 u = srp_vec3_cross(n, srp_vec3_make(0.31, 0.57, -0.76));
    u = srp_vec3_scale(1.0 / srp_vec3_norm(u), u);
    srp_vec3 v = srp_vec3_cross(n, u);
    srp_vec3 side = srp_vec3_add(srp_vec3_scale(cos(position_angle), u),
                                 srp_vec3_scale(sin(position_angle), v));
    return srp_vec3_add(srp_vec3_scale(cos(angle), n), srp_vec3_scale(sin(angle), side));
}

/* A body of this apparent radius there. */
static srp_body body_at(srp_vec3 sun, double distance, double apparent, double angle,
                        double position_angle) {
    srp_body body = {srp_vec3_scale(distance, beside_sun(sun, angle, position_angle)),
                     distance * sin(apparent)};
    return body;
}

static double apparent_sun(void) {
    return asin(SRP_SUN_RADIUS / srp_vec3_norm(SUN));
}

START_TEST(flux_falls_with_the_square_of_the_distance) {
    srp_sunlight light = srp_sunlight_default();
    assert_close(srp_sunlight_flux(light, SRP_AU), 1367.0, 1e-15, 0.0);
    assert_close(srp_sunlight_flux(light, 3.7 * SRP_AU), 1367.0 / (3.7 * 3.7), 1e-15, 0.0);
    assert_close(srp_sunlight_flux(light, 2.1e11) / SRP_SPEED_OF_LIGHT,
                 srp_sunlight_pressure(light, 2.1e11), 1e-15, 0.0);
}
END_TEST

/* ---- Closed forms --------------------------------------------------------------------------- */

START_TEST(phases_are_told_apart) {
    double a = apparent_sun();
    srp_body none[1];
    assert_close(srp_sunlight_fraction(SUN, SRP_SUN_RADIUS, 0, NULL), 1.0, 0.0, 0.0);
    /* Beside the Sun, before it whole, within it, behind it. */
    none[0] = body_at(SUN, 4.2e7, 0.15, 0.15 + 1.001 * a, 0.7);
    assert_close(srp_sunlight_fraction(SUN, SRP_SUN_RADIUS, 1, none), 1.0, 0.0, 0.0);
    none[0] = body_at(SUN, 4.2e7, 0.15, 0.15 - 1.001 * a, 2.7);
    assert_close(srp_sunlight_fraction(SUN, SRP_SUN_RADIUS, 1, none), 0.0, 0.0, 0.0);
    none[0] = body_at(SUN, 4e8, 0.37 * a, 0.51 * a, 1.9);
    assert_close(srp_sunlight_fraction(SUN, SRP_SUN_RADIUS, 1, none), 1.0 - 0.37 * 0.37, 1e-12,
                 0.0);
    none[0] = body_at(SUN, 3e11, 0.1, 0.0, 0.0);
    assert_close(srp_sunlight_fraction(SUN, SRP_SUN_RADIUS, 1, none), 1.0, 0.0, 0.0);
    /* The side of the body that faces the Sun: nothing before it. */
    none[0] = body_at(SUN, 7e6, asin(EARTH / 7e6), 3.0, 0.1);
    assert_close(srp_sunlight_fraction(SUN, SRP_SUN_RADIUS, 1, none), 1.0, 0.0, 0.0);
}
END_TEST

START_TEST(equal_disks_share_a_lens) {
    /* Radius 1, centres c apart: 2 acos(c/2) - c/2 sqrt(4 - c^2). */
    double a = apparent_sun();
    for (double c = 0.1; c < 2.0; c += 0.31) {
        srp_body body = body_at(SUN, 4e8, a, c * a, 1.0 + c);
        double want = 1.0 - (2.0 * acos(0.5 * c) - 0.5 * c * sqrt(4.0 - c * c)) / SRP_PI;
        assert_close(srp_sunlight_fraction(SUN, SRP_SUN_RADIUS, 1, &body), want, 0.0, 1e-11);
    }
}
END_TEST

START_TEST(a_vast_body_cuts_like_a_straight_edge) {
    /* On the ground the horizon halves the Sun, but for its curve: a / (3 pi b), b = pi / 2. */
    double a = apparent_sun();
    srp_body body = body_at(SUN, EARTH, 0.5 * SRP_PI, 0.5 * SRP_PI, 2.0);
    double half = srp_sunlight_fraction(SUN, SRP_SUN_RADIUS, 1, &body);
    assert_close(half, 0.5 + a / (3.0 * SRP_PI * 0.5 * SRP_PI), 0.0, 5e-6);
    /* Just below the surface as on it; there apparent radii change with the root of the height. */
    srp_body below = body;
    below.position = srp_vec3_scale(1.0 - 1e-12, body.position);
    assert_close(srp_sunlight_fraction(SUN, SRP_SUN_RADIUS, 1, &below), half, 0.0, 5e-6);
}
END_TEST

START_TEST(it_is_defined_everywhere) {
    const double NAUGHT[] = {0.0, 1e-300, 1e-9, 1.0, 1e6, 7e8, 1e11};
    for (size_t i = 0; i < 7; ++i) {
        for (size_t j = 0; j < 7; ++j) {
            for (size_t k = 0; k < 7; ++k) {
                for (int angle = 0; angle <= 8; ++angle) {
                    srp_vec3 sun = srp_vec3_make(0.0, NAUGHT[i], 0.0);
                    double at = angle * SRP_PI / 8.0;
                    srp_body bodies[3];
                    for (int b = 0; b < 3; ++b) {
                        bodies[b].position = srp_vec3_make(NAUGHT[j] * sin(at + 1e-9 * b),
                                                           NAUGHT[j] * cos(at + 1e-9 * b), 0.0);
                        bodies[b].radius = NAUGHT[k];
                    }
                    for (size_t count = 0; count <= 3; ++count) {
                        double share = srp_sunlight_fraction(sun, 6.9e8, count, bodies);
                        ck_assert_msg(share >= 0.0 && share <= 1.0, "%g %g %g %d %zu: %g",
                                      NAUGHT[i], NAUGHT[j], NAUGHT[k], angle, count, share);
                        share = srp_sunlight_fraction(sun, 0.0, count, bodies);
                        ck_assert(share == 0.0 || share == 1.0);
                    }
                }
            }
        }
    }
    srp_body centre = {{0, 0, 0}, 1.0};
    ck_assert(srp_sunlight_fraction(SUN, SRP_SUN_RADIUS, 1, &centre) == 0.0);
}
END_TEST

START_TEST(nonsense_is_nan) {
    srp_body body = {{1e7, 0, 0}, EARTH};
    srp_vec3 bad = {NAN, 0, 1};
    ck_assert(isnan(srp_sunlight_fraction(bad, SRP_SUN_RADIUS, 1, &body)));
    ck_assert(isnan(srp_sunlight_fraction(SUN, -1.0, 1, &body)));
    ck_assert(isnan(srp_sunlight_fraction(SUN, NAN, 0, NULL)));
    body.radius = -1.0;
    ck_assert(isnan(srp_sunlight_fraction(SUN, SRP_SUN_RADIUS, 1, &body)));
    body.radius = 1.0;
    body.position.y = INFINITY;
    ck_assert(isnan(srp_sunlight_fraction(SUN, SRP_SUN_RADIUS, 1, &body)));
}
END_TEST

/* ---- Smoothness ----------------------------------------------------------------------------- */

/* From full light through penumbra to umbra (or antumbra) and back: no jump of value or slope. */
static void check_pass(double apparent, double distance) {
    double a = apparent_sun();
    double from = -(apparent + 1.3 * a), step = (apparent + 1.3 * a) / 20000.0;
    double before = 1.0, slope_before = 0.0, jump = 0.0, bend = 0.0;
    for (int k = 0; k <= 40000; ++k) {
        srp_body body = body_at(SUN, distance, apparent, from + k * step, 0.9);
        double now = srp_sunlight_fraction(SUN, SRP_SUN_RADIUS, 1, &body);
        double slope = k == 0 ? 0.0 : (now - before) / step;
        jump = fmax(jump, fabs(now - before));
        bend = fmax(bend, fabs(slope - slope_before) * a);
        before = now;
        slope_before = slope;
    }
    /* The slope is like the root of the distance from where disks touch. */
    ck_assert(jump < 3.0 * step / a && bend < 4.0 * sqrt(step / fmin(a, apparent)));
}

START_TEST(light_fades_smoothly) {
    double a = apparent_sun();
    check_pass(0.151, 4.2e7);
    check_pass(1.3 * a, 3.8e8);
    check_pass(0.6 * a, 9.8e8);
}
END_TEST

/* ---- Brute force ---------------------------------------------------------------------------- */

typedef struct flat_disk {
    double x, y, radius;
} flat_disk;

/* Length of the chord of the unit disk at height y that no disk covers. */
static double free_chord(double y, const flat_disk *disks, size_t count) {
    double half = sqrt(fmax(0.0, 1.0 - y * y));
    double from[8], to[8], covered = 0.0, reach = -half;
    size_t used = 0;
    for (size_t k = 0; k < count; ++k) {
        double off = y - disks[k].y, square = disks[k].radius * disks[k].radius - off * off;
        if (square > 0.0) {
            from[used] = fmax(-half, disks[k].x - sqrt(square));
            to[used++] = fmin(half, disks[k].x + sqrt(square));
        }
    }
    for (size_t round = 0; round < used; ++round) { /* leftmost first */
        size_t first = round;
        for (size_t k = round; k < used; ++k) {
            first = from[k] < from[first] ? k : first;
        }
        double swap = from[first];
        from[first] = from[round];
        from[round] = swap;
        swap = to[first];
        to[first] = to[round];
        to[round] = swap;
        double begin = fmax(reach, from[round]);
        covered += fmax(0.0, to[round] - begin);
        reach = fmax(reach, to[round]);
    }
    return 2.0 * half - covered;
}

/* Share of the unit disk that is free, by the midpoint rule. */
static double free_share(const flat_disk *disks, size_t count) {
    enum { STRIPS = 40000 };
    double sum = 0.0;
    for (int k = 0; k < STRIPS; ++k) {
        double t = SRP_PI * ((k + 0.5) / STRIPS - 0.5);
        sum += cos(t) * free_chord(sin(t), disks, count);
    }
    return sum / STRIPS;
}

START_TEST(disks_overlap_as_brute_force_says) {
    uint64_t state = 8;
    double a = apparent_sun(), worst = 0.0;
    int partial = 0;
    for (int k = 0; k < 300; ++k) {
        srp_body bodies[5];
        flat_disk disks[5];
        size_t count = 1 + (size_t)(random_unit(&state) * 5.0);
        for (size_t b = 0; b < count; ++b) {
            double apparent = a * exp(4.0 * random_unit(&state) - 2.5);
            double reach = (a + apparent) * (0.75 + 0.35 * random_unit(&state));
            double at = b > 0 && random_unit(&state) < 0.3 ? 1.0 : 6.3 * random_unit(&state);
            bodies[b] = body_at(SUN, 3.7e8 * (1.0 + (double)b), apparent, reach, at);
            disks[b] = (flat_disk){reach / a * cos(at), reach / a * sin(at), apparent / a};
        }
        double got = srp_sunlight_fraction(SUN, SRP_SUN_RADIUS, count, bodies);
        double off = fabs(got - free_share(disks, count));
        ck_assert_msg(off < 2e-6, "%d, %zu bodies: %.9f, off by %g", k, count, got, off);
        worst = fmax(worst, off);
        partial += got > 0.0 && got < 1.0;
    }
    printf("shares agree with brute force to %.1e in %d partial eclipses\n", worst, partial);
    ck_assert_int_gt(partial, 200);
}
END_TEST

START_TEST(a_body_twice_counts_once) {
    double a = apparent_sun();
    srp_body bodies[20];
    for (int k = 0; k < 20; ++k) {
        bodies[k] = body_at(SUN, 3.7e8, 0.7 * a, 0.9 * a, 0.4);
    }
    double once = srp_sunlight_fraction(SUN, SRP_SUN_RADIUS, 1, bodies);
    assert_close(srp_sunlight_fraction(SUN, SRP_SUN_RADIUS, 20, bodies), once, 1e-15, 0.0);
    /* Two that do not overlap: their shares add up. */
    bodies[1] = body_at(SUN, 5.1e8, 0.7 * a, 0.9 * a, 0.4 + SRP_PI);
    assert_close(srp_sunlight_fraction(SUN, SRP_SUN_RADIUS, 2, bodies), 2.0 * once - 1.0, 1e-12,
                 0.0);
    /* Thirty small ones, none before another: more than are kept apart. */
    srp_body many[30];
    for (int k = 0; k < 30; ++k) {
        many[k] = body_at(SUN, 4e8, 0.02 * a, 0.8 * a, 0.2 * k);
    }
    assert_close(srp_sunlight_fraction(SUN, SRP_SUN_RADIUS, 30, many), 1.0 - 30.0 * 0.0004, 1e-9,
                 0.0);
}
END_TEST

/* ---- GMAT ----------------------------------------------------------------------------------- */

enum { COLUMNS = 35 };
/* Columns of a report behind the four words of its date. */
enum { AT_POSITION = 3, AT_DCM = 14, AT_FROM_SUN = 23, AT_WITH_SRP = 29, AT_WITHOUT = 32 };

static const double KM = 1e3;
static const double GMAT_SUN_RADIUS = 695990e3;

static srp_vec3 vec3_of(const double *row, int at) {
    return srp_vec3_make(row[at], row[at + 1], row[at + 2]);
}

static bool read_row(FILE *file, double row[COLUMNS]) {
    char word[32];
    for (int k = 0; k < 4; ++k) {
        if (fscanf(file, "%31s", word) != 1) {
            return false;
        }
    }
    for (int k = 0; k < COLUMNS; ++k) {
        ck_assert_int_eq(fscanf(file, "%lf", &row[k]), 1);
    }
    return true;
}

/* GMAT's acceleration by light [m/s^2], inertial. */
static srp_vec3 observed(const double *row) {
    return srp_vec3_scale(KM, srp_vec3_sub(vec3_of(row, AT_WITH_SRP), vec3_of(row, AT_WITHOUT)));
}

/* P in full light, where a row's spacecraft is [N/m^2]. */
static double full_pressure(const double *row) {
    const srp_sunlight gmat = {1367.0, 149597870.691e3};
    return srp_sunlight_pressure(gmat, KM * srp_vec3_norm(vec3_of(row, AT_FROM_SUN)));
}

static double lit_share(const double *row) {
    const srp_body earth = {srp_vec3_scale(-KM, vec3_of(row, AT_POSITION)), EARTH};
    return srp_sunlight_fraction(srp_vec3_scale(-KM, vec3_of(row, AT_FROM_SUN)), GMAT_SUN_RADIUS, 1,
                                 &earth);
}

static srp_vec3 to_body(const double *row, srp_vec3 v) {
    return srp_vec3_make(srp_vec3_dot(vec3_of(row, AT_DCM), v),
                         srp_vec3_dot(vec3_of(row, AT_DCM + 3), v),
                         srp_vec3_dot(vec3_of(row, AT_DCM + 6), v));
}

/* Acceleration by a sphere of Cr 1.8 and 20 m^2, or by the table, of 850 kg in full light. */
static srp_vec3 expected(const double *row, const srp_interp *table) {
    srp_vec3 away = vec3_of(row, AT_FROM_SUN);
    away = srp_vec3_scale(1.0 / srp_vec3_norm(away), away);
    srp_vec3 f = srp_vec3_scale(1.8 * 20.0, away);
    if (table != NULL) {
        srp_vec3 f_body, r0 = vec3_of(row, AT_DCM), r1 = vec3_of(row, AT_DCM + 3);
        srp_error error;
        srp_vec3 s = to_body(row, srp_vec3_scale(-1.0, away));
        s = srp_vec3_scale(1.0 / srp_vec3_norm(s), s);
        assert_ok(srp_interp_eval(table, s, &f_body, NULL, NULL, &error), error);
        f = srp_vec3_scale(f_body.x, r0);
        f = srp_vec3_add_scaled(f, f_body.y, r1);
        f = srp_vec3_add_scaled(f, f_body.z, vec3_of(row, AT_DCM + 6));
    }
    return srp_vec3_scale(full_pressure(row) / 850.0, f);
}

/* Within a degree of a pole the table says as many things as it has azimuths, and GMAT follows it;
 * we take the mean. */
static bool is_in_polar_cell(const double *row) {
    srp_vec3 s = to_body(row, vec3_of(row, AT_FROM_SUN));
    return fabs(s.z) > cos(SRP_RAD_PER_DEG) * srp_vec3_norm(s);
}

/* Largest error of a report's rows, as a share of the acceleration in full light; rows by phase. */
static double compare_report(const char *name, const srp_interp *table, int phases[3]) {
    char path[512];
    snprintf(path, sizeof path, "%s/gmat-reference/%s.txt", SRP_SHARED_DATA_DIR, name);
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        return NAN;
    }
    double row[COLUMNS], worst = 0.0;
    phases[0] = phases[1] = phases[2] = 0;
    while (read_row(file, row)) {
        srp_vec3 full = expected(row, table);
        double share = lit_share(row);
        srp_vec3 off = srp_vec3_sub(observed(row), srp_vec3_scale(share, full));
        double error = srp_vec3_norm(off) / srp_vec3_norm(full);
        if (table != NULL && is_in_polar_cell(row)) {
            printf("%s: left out, less than a step from a pole: off by %.1e\n", name, error);
            continue;
        }
        worst = fmax(worst, error);
        ++phases[share == 0.0 ? 0 : share == 1.0 ? 2 : 1];
    }
    (void)fclose(file);
    printf("%s: off by %.1e of full light; %d rows dark, %d partly lit, %d lit\n", name, worst,
           phases[0], phases[1], phases[2]);
    return worst;
}

START_TEST(eclipses_are_those_of_gmat) {
    int phases[3];
    double worst = compare_report("geo_spherical_eclipse", NULL, phases);
    if (isnan(worst)) {
        printf("skipped: no GMAT reports in " SRP_SHARED_DATA_DIR "\n");
        return;
    }
    ck_assert(worst < 1e-9);
    ck_assert_int_gt(phases[0] + phases[1], 0);
    ck_assert(compare_report("geo_spherical", NULL, phases) < 1e-9);
}
END_TEST

START_TEST(a_table_pushes_as_in_gmat) {
    srp_table *table = NULL;
    srp_error error;
    if (srp_table_read(&srp_table_format_spo, SRP_SHARED_DATA_DIR "/spad/One-Wing-Sat.spo", &table,
                       &error) != SRP_OK) {
        ck_assert_int_eq(error.status, SRP_NOT_FOUND);
        printf("skipped: no One-Wing-Sat.spo in " SRP_SHARED_DATA_DIR "\n");
        return;
    }
    srp_interp *interp = NULL;
    assert_ok(srp_interp_create(&srp_interp_bilinear, table, &interp, &error), error);
    int phases[3];
    ck_assert(compare_report("geo_spad_inertial", interp, phases) < 1e-9);
    ck_assert(compare_report("geo_spad_nadir_eclipse", interp, phases) < 1e-9);
    srp_interp_destroy(interp);
    srp_table_destroy(table);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("sunlight");
    TCase *tcase = tcase_create("sunlight");
    tcase_set_timeout(tcase, 120);
    tcase_add_test(tcase, flux_falls_with_the_square_of_the_distance);
    tcase_add_test(tcase, phases_are_told_apart);
    tcase_add_test(tcase, equal_disks_share_a_lens);
    tcase_add_test(tcase, a_vast_body_cuts_like_a_straight_edge);
    tcase_add_test(tcase, it_is_defined_everywhere);
    tcase_add_test(tcase, nonsense_is_nan);
    tcase_add_test(tcase, light_fades_smoothly);
    tcase_add_test(tcase, disks_overlap_as_brute_force_says);
    tcase_add_test(tcase, a_body_twice_counts_once);
    tcase_add_test(tcase, eclipses_are_those_of_gmat);
    tcase_add_test(tcase, a_table_pushes_as_in_gmat);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
