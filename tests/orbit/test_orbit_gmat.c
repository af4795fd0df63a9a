/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Orbits beside GMAT R2020a: five cases of 2 days in GEO, a row each 1800 s. GMAT stops within some
 * microseconds of the time that it is asked for, in which it moves by millimetres: our rows are
 * moved along the velocity to the time that its report gives.
 */
#include "srp_check.h"

#include <srp/orbit/mission.h>

#include <stdio.h>
#include <string.h>

enum { ROWS = 97, COLUMNS = 36 };

typedef struct gmat_row {
    double elapsed;
    srp_vec3 r, v; /* [m], [m/s] */
    double matrix[3][3];
    srp_vec3 from_sun, from_moon; /* [m] */
    srp_vec3 srp;                 /* [m/s^2] */
    double a1_mjd, tdb_mjd;
} gmat_row;

static srp_vec3 vector(const double *x, double factor) {
    return srp_vec3_make(factor * x[0], factor * x[1], factor * x[2]);
}

static bool read_row(FILE *in, gmat_row *out) {
    char line[4096], word[4][32];
    int used;
    double x[COLUMNS];
    if (fgets(line, sizeof line, in) == NULL ||
        sscanf(line, "%31s %31s %31s %31s%n", word[0], word[1], word[2], word[3], &used) != 4) {
        return false;
    }
    char *at = line + used;
    for (int i = 0; i < COLUMNS; ++i) {
        x[i] = strtod(at, &at);
    }
    out->a1_mjd = x[0];
    out->tdb_mjd = x[1];
    out->elapsed = x[2];
    out->r = vector(x + 3, 1e3);
    out->v = vector(x + 6, 1e3);
    memcpy(out->matrix, x + 14, sizeof out->matrix);
    out->from_sun = vector(x + 23, 1e3);
    out->from_moon = vector(x + 26, 1e3);
    out->srp = srp_vec3_sub(vector(x + 29, 1e3), vector(x + 32, 1e3));
    return true;
}

static bool read_reference(const char *name, gmat_row rows[ROWS]) {
    char path[600];
    snprintf(path, sizeof path, "%s/gmat-reference/%s.txt", SRP_SHARED_DATA_DIR, name);
    FILE *in = fopen(path, "r");
    if (in == NULL) {
        printf("skipped: %s is not there\n", path);
        return false;
    }
    int count = 0;
    while (count < ROWS && read_row(in, &rows[count])) {
        ++count;
    }
    fclose(in);
    ck_assert_int_eq(count, ROWS);
    return true;
}

/* The mission's text, said to lie beside GMAT's SPAD file. */
static srp_mission *read_mission(const char *name) {
    char path[600], text[4096];
    srp_error error;
    srp_mission *mission = NULL;
    snprintf(path, sizeof path, "%s/%s.yaml", SRP_MISSIONS_DIR, name);
    FILE *in = fopen(path, "r");
    ck_assert_msg(in != NULL, "%s", path);
    const size_t size = fread(text, 1, sizeof text, in);
    fclose(in);
    snprintf(path, sizeof path, "%s/spad/%s.yaml", SRP_SHARED_DATA_DIR, name);
    assert_ok(srp_mission_parse(text, size, path, NULL, &mission, &error), error);
    return mission;
}

typedef struct comparison {
    const gmat_row *rows;
    size_t count;
    double position, velocity, srp, attitude, sun, moon, time; /* worst [SI] */
} comparison;

static void worst(double *so_far, double value) {
    *so_far = fmax(*so_far, value);
}

/* What the models say at GMAT's own state. */
static void compare_models(comparison *c, const srp_mission *mission, const gmat_row *want) {
    const srp_force_list *forces = srp_mission_forces(mission);
    const srp_ephemeris *sky = srp_force_list_ephemeris(forces);
    const srp_epoch now = srp_epoch_add(srp_mission_get_info(mission)->epoch, want->elapsed);
    srp_vec3 bodies[SRP_CELESTIAL_COUNT];
    srp_ephemeris_positions(sky, SRP_EARTH, want->elapsed, bodies);
    worst(&c->sun,
          srp_vec3_norm(srp_vec3_sub(srp_vec3_sub(want->r, bodies[SRP_SUN]), want->from_sun)));
    worst(&c->moon,
          srp_vec3_norm(srp_vec3_sub(srp_vec3_sub(want->r, bodies[SRP_MOON]), want->from_moon)));
    worst(&c->time, 86400.0 * fabs(srp_epoch_gmat_mjd(now, SRP_TIME_TDB) - want->tdb_mjd));
    worst(&c->time, 86400.0 * fabs(srp_epoch_gmat_mjd(now, SRP_TIME_A1) - want->a1_mjd));
    const srp_force *last = srp_force_list_get(forces, srp_force_list_count(forces) - 1);
    if ((last->flags & SRP_FORCE_RADIATION) == 0) {
        return;
    }
    const srp_force_state state = {want->elapsed, want->r, want->v, bodies};
    srp_radiation_probe probe;
    ck_assert_int_eq(srp_force_radiation_probe(last, &state, &probe), 0);
    worst(&c->srp, srp_vec3_norm(srp_vec3_sub(probe.a, want->srp)));
    if (strcmp(srp_mission_get_info(mission)->model, "cannonball") != 0) {
        for (int i = 0; i < 9; ++i) {
            worst(&c->attitude, fabs(probe.matrix[i / 3][i % 3] - want->matrix[i / 3][i % 3]));
        }
    }
}

static srp_status compare_row(void *user, const srp_mission *mission, const srp_mission_row *row,
                              srp_error *error) {
    comparison *c = user;
    (void)error;
    ck_assert(c->count < ROWS);
    const gmat_row *want = &c->rows[c->count++];
    const double late = want->elapsed - row->t;
    ck_assert_msg(fabs(late) < 1e-3, "row at %.9f, GMAT's at %.9f", row->t, want->elapsed);
    const srp_vec3 r = srp_vec3_add_scaled(row->r, late, row->v);
    worst(&c->position, srp_vec3_norm(srp_vec3_sub(r, want->r)));
    worst(&c->velocity, srp_vec3_norm(srp_vec3_sub(row->v, want->v)));
    compare_models(c, mission, want);
    return SRP_OK;
}

static const char *const CASES[] = {"geo_nosrp", "geo_spherical", "geo_spherical_eclipse",
                                    "geo_spad_inertial", "geo_spad_nadir_eclipse"};

START_TEST(orbits_agree_with_gmat) {
    const char *name = CASES[_i];
    static gmat_row rows[ROWS];
    if (!read_reference(name, rows)) {
        return;
    }
    srp_mission *mission = read_mission(name);
    comparison c = {.rows = rows};
    srp_mission_watch watch = {compare_row, NULL, NULL, &c};
    srp_mission_summary summary;
    srp_error error;
    assert_ok(srp_mission_run(mission, &watch, &summary, &error), error);
    ck_assert_uint_eq(c.count, ROWS);
    printf(
        "%-23s position %5.2f mm, velocity %.1e m/s, SRP %.1e km/s^2, attitude %.0e, Sun %.1f m, "
        "Moon %.3f m, time %.0e s; %llu steps\n",
        name, 1e3 * c.position, c.velocity, 1e-3 * c.srp, c.attitude, c.sun, c.moon, c.time,
        (unsigned long long)summary.counts.steps);
    /* Issue 6: 10 mm over 2 days; 1e-17 km/s^2. */
    assert_close(c.position, 0.0, 0.0, 10e-3);
    assert_close(c.srp, 0.0, 0.0, 1e-17 * 1e3);
    assert_close(c.attitude, 0.0, 0.0, 1e-14);
    /* GMAT's AU is 9 m shorter, its date a double of days. */
    assert_close(c.sun, 0.0, 0.0, 15.0);
    assert_close(c.moon, 0.0, 0.0, 0.05);
    assert_close(c.time, 0.0, 0.0, 1e-6);
    srp_mission_destroy(mission);
}
END_TEST

/* ---- Steps ------------------------------------------------------------------------------------
 */

/* Where the mission ends with this tolerance, as "1e-14". */
static srp_vec3 end_at(const char *name, const char *tolerance) {
    static char text[4096];
    char path[600], *at;
    srp_error error;
    srp_mission *mission = NULL;
    srp_mission_summary summary;
    snprintf(path, sizeof path, "%s/%s.yaml", SRP_MISSIONS_DIR, name);
    FILE *in = fopen(path, "r");
    ck_assert_msg(in != NULL, "%s", path);
    const size_t size = fread(text, 1, sizeof text - 1, in);
    fclose(in);
    text[size] = '\0';
    at = strstr(text, "tolerance: 1e-1");
    ck_assert_ptr_nonnull(at);
    memcpy(at + 11, tolerance, 5);
    at = strstr(text, "  max_step: 120 s");
    if (at != NULL) {
        memset(at, ' ', 17);
    }
    snprintf(path, sizeof path, "%s/spad/%s.yaml", SRP_SHARED_DATA_DIR, name);
    assert_ok(srp_mission_parse(text, size, path, NULL, &mission, &error), error);
    assert_ok(srp_mission_run(mission, NULL, &summary, &error), error);
    srp_mission_destroy(mission);
    return summary.r;
}

/* A bilinear table has a kink at the edge of each cell: what missions have unless they say
 * otherwise is good for millimetres, ten times as much is not. */
START_TEST(steps_are_tight_enough_for_kinks) {
    static const char *const NAMES[] = {"geo_spad_nadir_eclipse", "leo_spad_nadir",
                                        "geo_spad_spinner"};
    FILE *table = fopen(SRP_SHARED_DATA_DIR "/spad/One-Wing-Sat.spo", "r");
    if (table == NULL) {
        printf("skipped: no table in %s\n", SRP_SHARED_DATA_DIR);
        return;
    }
    fclose(table);
    for (size_t i = 0; i < sizeof NAMES / sizeof NAMES[0]; ++i) {
        static const char *const TOLERANCES[] = {"1e-12", "1e-13", "1e-14"};
        const srp_vec3 want = end_at(NAMES[i], "1e-15");
        double off = INFINITY;
        printf("%s: far from where it ends at 1e-15:", NAMES[i]);
        for (int k = 0; k < 3; ++k) {
            off = srp_vec3_norm(srp_vec3_sub(end_at(NAMES[i], TOLERANCES[k]), want));
            printf(" %s %.2f mm", TOLERANCES[k], 1e3 * off);
        }
        printf("\n");
        ck_assert(off < 5e-3);
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("orbit_gmat");
    TCase *cases = tcase_create("gmat");
    tcase_set_timeout(cases, 120);
    tcase_add_loop_test(cases, orbits_agree_with_gmat, 0, sizeof CASES / sizeof CASES[0]);
    tcase_add_test(cases, steps_are_tight_enough_for_kinks);
    suite_add_tcase(suite, cases);
    return run_suite(suite);
}
