/* SPDX-License-Identifier: Apache-2.0 */
/* Mission files: every field wrong in turn, with its line; files that come out. */
#include "oem_rules.h"
#include "srp_check.h"

#include <srp/orbit/mission.h>

#include <gsl/gsl_errno.h>
#include <stdio.h>
#include <string.h>

/* A mission that is good; line numbers are counted from 1. */
static const char *const GOOD[] = {
    /*  1 */ "title: A test",
    /*  2 */ "epoch: 2024-03-20T00:00:00 UTC",
    /*  3 */ "duration: 6 h",
    /*  4 */ "central_body: earth",
    /*  5 */ "hyperbolic: false",
    /*  6 */ "partials: true",
    /*  7 */ "state:",
    /*  8 */ "  position: 36607.35826 -20921.7237 0 km",
    /*  9 */ "  velocity: 1.5256345 2.6694515 0.0123456 km/s",
    /* 10 */ "spacecraft:",
    /* 11 */ "  name: TESTSAT",
    /* 12 */ "  id: 2024-001A",
    /* 13 */ "  mass: 850 kg",
    /* 14 */ "  attitude:",
    /* 15 */ "    mode: nadir",
    /* 16 */ "    align_body: 0 0 1",
    /* 17 */ "    constrain: orbit_normal",
    /* 18 */ "    constrain_body: 0 1 0",
    /* 19 */ "forces:",
    /* 20 */ "  point_masses: [sun, moon]",
    /* 21 */ "  radiation:",
    /* 22 */ "    model: plates",
    /* 23 */ "    file: box-wing.plates",
    /* 24 */ "    scale: 1.05",
    /* 25 */ "    flux: 1361 W/m2",
    /* 26 */ "    au: 1 au",
    /* 27 */ "    sun_radius: 695700 km",
    /* 28 */ "    shadow: [earth, moon]",
    /* 29 */ "constants:",
    /* 30 */ "  mu:",
    /* 31 */ "    sun: 132712440017.99 km3/s2",
    /* 32 */ "  radius:",
    /* 33 */ "    earth: 6378.1363 km",
    /* 34 */ "integrator:",
    /* 35 */ "  method: rkf45",
    /* 36 */ "  tolerance: 1e-10",
    /* 37 */ "  first_step: 1 min",
    /* 38 */ "  max_step: 1 h",
    /* 39 */ "output:",
    /* 40 */ "  step: 25 min",
    /* 41 */
    ("  columns: [epoch, elapsed, position, velocity, elements, sun, area, srp, seen, impulse, "
     "attitude, nodes, matrix, a1_mjd, tdb_mjd]"),
};
enum { LINES = sizeof GOOD / sizeof GOOD[0] };

/* The mission with one line changed; 0 changes none. An empty line takes it away. */
static void compose(char *text, int line, const char *instead) {
    text[0] = '\0';
    for (int i = 0; i < LINES; ++i) {
        strcat(text, i + 1 == line ? instead : GOOD[i]);
        strcat(text, "\n");
    }
}

static srp_status parse_with(const char *text, const srp_mission_context *context,
                             srp_mission **out, srp_error *error) {
    return srp_mission_parse(text, strlen(text), SRP_MODELS_DIR "/test.yaml", context, out, error);
}

static srp_status parse(const char *text, srp_mission **out, srp_error *error) {
    return parse_with(text, NULL, out, error);
}

typedef struct mistake {
    int line;            /* that is changed */
    const char *instead; /* "": taken away */
    int told;            /* line that the complaint names */
    srp_status status;
    const char *words;
} mistake;

static const mistake MISTAKES[] = {
    {1, "titel: x", 1, SRP_BAD_FORMAT, "titel"},
    {1, "title: [a, b]", 1, SRP_BAD_FORMAT, "title: expected one value"},
    {13, "  mass:", 13, SRP_BAD_FORMAT, "spacecraft.mass: expected a value, found none"},
    {8, "  position: [1 km, 2 km, 3 km]", 8, SRP_BAD_FORMAT, "state.position: expected one value"},
    {1, "title: {a", 0, SRP_BAD_FORMAT, "not YAML"},
    {1, "title: \"x", 0, SRP_BAD_FORMAT, "not YAML"},
    {1, "epoch: 2024-03-20T00:00:00 UTC", 2, SRP_BAD_FORMAT, "twice"},
    {2, "", 1, SRP_BAD_FORMAT, "epoch"},
    {2, "epoch: 2024-02-30T00:00:00 UTC", 2, SRP_BAD_DATA, "no such date"},
    {2, "epoch: 2024-03-20T00:00:00", 2, SRP_BAD_FORMAT, "expected a date"},
    {2, "epoch: 2024-03-20T00:00:00 GPS", 2, SRP_BAD_FORMAT, "time scale"},
    {3, "", 1, SRP_BAD_FORMAT, "duration"},
    {3, "duration: 6", 3, SRP_BAD_FORMAT, "expected a unit"},
    {3, "duration: 6 km", 3, SRP_BAD_FORMAT, "'km'"},
    {3, "duration: -6 h", 3, SRP_BAD_DATA, "above 0"},
    {3, "duration: 1e9 d", 3, SRP_BAD_DATA, "100 years"},
    {3, "duration: six h", 3, SRP_BAD_FORMAT, "expected 1 number"},
    {3, "duration: nan h", 3, SRP_BAD_FORMAT, "expected 1 number"},
    {3, "duration: 0x10 h", 3, SRP_BAD_FORMAT, "expected 1 number"},
    {4, "central_body: vulcan", 4, SRP_BAD_DATA, "vulcan"},
    {5, "hyperbolic: perhaps", 5, SRP_BAD_FORMAT, "true or false"},
    {6, "partials: 3", 6, SRP_BAD_FORMAT, "true or false"},
    {6, "partials: false", 41, SRP_BAD_DATA, "partials: true"},
    {7, "stat:", 7, SRP_BAD_FORMAT, "stat"},
    {8, "", 0, SRP_BAD_FORMAT, "position"},
    {8, "  position: 36607.35826 -20921.7237 km", 8, SRP_BAD_FORMAT, "3 numbers"},
    {8, "  position: 36607.35826 -20921.7237 0 0 km", 8, SRP_BAD_FORMAT, "expected a unit"},
    {8, "  position: 36607.35826 -20921.7237 0", 8, SRP_BAD_FORMAT, "expected a unit"},
    {8, "  position: 36607.35826 -20921.7237 0 km/s", 8, SRP_BAD_FORMAT, "expected a unit"},
    {8, "  position: 6000 0 0 km", 8, SRP_BAD_DATA, "inside"},
    {8, "  position: 0 0 0 km", 8, SRP_BAD_DATA, "inside"},
    {8, "  posiiton: 36607 0 0 km", 8, SRP_BAD_FORMAT, "posiiton"},
    {9, "  velocity: 5.5 4.6694515 0.0123456 km/s", 8, SRP_BAD_DATA, "hyperbolic: true"},
    {9, "  velocity: 1.5 2.6 0.01 m", 9, SRP_BAD_FORMAT, "m/s, km/s"},
    {11, "  name: ", 11, SRP_BAD_FORMAT, "spacecraft.name: expected a value, found none"},
    {1, "title: \"two\\nlines\"", 1, SRP_BAD_DATA, "printable"},
    {11, "  name: \"S\\tX\"", 11, SRP_BAD_DATA, "printable"},
    {12, "  id: \u00e9", 12, SRP_BAD_DATA, "printable"},
    {12, "  ident: 5", 12, SRP_BAD_FORMAT, "ident"},
    {13, "", 0, SRP_BAD_FORMAT, "mass"},
    {13, "  mass: 850 m", 13, SRP_BAD_FORMAT, "kg"},
    {13, "  mass: 0 kg", 13, SRP_BAD_DATA, "above 0"},
    {13, "  mass: -3 kg", 13, SRP_BAD_DATA, "above 0"},
    {15, "    mode: sideways", 15, SRP_BAD_DATA, "yaw_steering"},
    {15, "    mode: spinner", 0, SRP_BAD_FORMAT, "rate"},
    {15, "    mode: aem", 0, SRP_BAD_FORMAT, "file"},
    {16, "    align_body: 0 0", 16, SRP_BAD_FORMAT, "3 numbers"},
    {16, "    align_body: 0 0 1 m", 16, SRP_BAD_FORMAT, "expected nothing"},
    {16, "    align_body: 0 0 0", 0, SRP_BAD_DATA, "in one line"},
    {16, "    align: up", 16, SRP_BAD_DATA, "orbit_normal"},
    {16, "    quaternion: 1 2 3", 0, SRP_OK, ""}, /* not asked for by this mode */
    {17, "    constrain: nadir", 0, SRP_BAD_DATA, "differ"},
    {18, "    constrain_body: 0 0 2", 0, SRP_BAD_DATA, "in one line"},
    {20, "  point_masses: [sun, earth]", 20, SRP_BAD_DATA, "earth"},
    {20, "  point_masses: [sun, sun]", 20, SRP_BAD_DATA, "sun"},
    {20, "  point_masses: [pluto]", 20, SRP_BAD_DATA, "pluto"},
    {20, "  point_masses: sun", 20, SRP_BAD_FORMAT, "forces.point_masses: expected a list"},
    {20, "  point_masses: ~", 20, SRP_BAD_FORMAT, "forces.point_masses: expected a list"},
    {20, "  drag: 1", 20, SRP_BAD_FORMAT, "drag"},
    {22, "", 0, SRP_BAD_FORMAT, "model"},
    {22, "    model: sail", 22, SRP_BAD_DATA, "cannonball, plates"},
    {22, "    model: cannonball", 0, SRP_BAD_FORMAT, "cr"},
    {22, "    model: on_demand", 23, SRP_BAD_FORMAT, "box-wing.plates"},
    {22, "    model: table", 23, SRP_BAD_DATA, "no name of a table"},
    {22, "    model: direct", 0, SRP_BAD_FORMAT, ""},
    {23, "    file: no-such.plates", 23, SRP_NOT_FOUND, "no-such.plates"},
    {23, "    file: box-wing.mtl", 0, SRP_BAD_FORMAT, ""},
    {23, "", 0, SRP_BAD_FORMAT, "file"},
    {24, "    scale: 1.05 kg", 24, SRP_BAD_FORMAT, "expected nothing"},
    {24, "    scale: -1", 24, SRP_BAD_DATA, "light does not pull"},
    {24, "    scale: inf", 24, SRP_BAD_FORMAT, "1 number"},
    {25, "    flux: 1361 W", 25, SRP_BAD_FORMAT, "W/m2"},
    {25, "    flux: 0 W/m2", 25, SRP_BAD_DATA, "above 0"},
    {26, "    au: 1 parsec", 26, SRP_BAD_FORMAT, "au"},
    {27, "    sun_radius: -1 km", 27, SRP_BAD_DATA, "above 0"},
    {28, "    shadow: [sun]", 28, SRP_BAD_DATA, "sun"},
    {28, "    shadow: [earth, earth]", 28, SRP_BAD_DATA, "twice"},
    {28, "    shadow: [vulcan]", 28, SRP_BAD_DATA, "vulcan"},
    {31, "    sun: 132712440017.99 km3", 31, SRP_BAD_FORMAT, "m3/s2"},
    {31, "    sol: 132712440017.99 km3/s2", 31, SRP_BAD_FORMAT, "sol"},
    {33, "    earth: 0 km", 33, SRP_BAD_DATA, "above 0"},
    {35, "  method: euler", 35, SRP_BAD_DATA, "rk8pd"},
    {36, "  tolerance: 1", 36, SRP_BAD_DATA, "1e-16"},
    {36, "  tolerance: 1e-30", 36, SRP_BAD_DATA, "1e-16"},
    {36, "  fixed_step: 0 s", 36, SRP_BAD_DATA, "above 0"},
    {37, "  first_step: 1 kg", 37, SRP_BAD_FORMAT, "s, min, h, d"},
    {38, "  max_step: -1 s", 38, SRP_BAD_DATA, "above 0"},
    {38, "  max_step: 1e-6 s", 38, SRP_BAD_DATA, "steps, expected at most"},
    {36, "  fixed_step: 1e-6 s", 36, SRP_BAD_DATA, "steps, expected at most"},
    {40, "  oem: a.csv\n  report: a.csv", 41, SRP_BAD_DATA, "output.oem"},
    {40, "  step: 0 s", 40, SRP_BAD_DATA, "above 0"},
    {40, "  step: 1e-9 s", 40, SRP_BAD_DATA, "rows"},
    {41, "  columns: []", 41, SRP_BAD_DATA, "one column or more"},
    {41, "  columns: 5", 41, SRP_BAD_FORMAT, "output.columns: expected a list"},
    {41, "  columns: [[a]]", 41, SRP_BAD_FORMAT, "output.columns: expected one value"},
    {41, "  columns: [epoch, colour]", 41, SRP_BAD_DATA, "colour"},
    {41, "  columns: [epoch, epoch]", 41, SRP_BAD_DATA, "each once"},
};

START_TEST(mistakes_are_told_with_their_line) {
    static char text[8000];
    const mistake *m = &MISTAKES[_i];
    srp_mission *mission = NULL;
    srp_error error = {.status = SRP_OK};
    compose(text, m->line, m->instead);
    const srp_status status = parse(text, &mission, &error);
    ck_assert_msg(status == m->status, "line %d, '%s': %s: %s", m->line, m->instead,
                  srp_status_string(status), error.message);
    if (m->status != SRP_OK) {
        ck_assert(mission == NULL);
        ck_assert_msg(strstr(error.message, m->words) != NULL, "'%s': %s", m->instead,
                      error.message);
        ck_assert_msg(error.file[0] != '\0' && error.line > 0, "'%s': no place: %s", m->instead,
                      error.message);
        ck_assert_msg(m->told == 0 || (int)error.line == m->told, "'%s': line %zu, expected %d: %s",
                      m->instead, error.line, m->told, error.message);
    }
    srp_mission_destroy(mission);
}
END_TEST

START_TEST(other_mistakes_are_told) {
    srp_mission *mission = NULL;
    srp_error error;
    ck_assert_int_eq(srp_mission_read("no-such.yaml", NULL, &mission, &error), SRP_NOT_FOUND);
    const char *const texts[] = {"",
                                 "just words\n",
                                 "- a\n- b\n",
                                 "{}\n",
                                 "a: &x 1\nb: *x\n",
                                 "\xff\xfe\x00",
                                 "? [a]\n: b\n",
                                 "epoch: 2024-03-20 UTC\n"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        const srp_status status = parse(texts[i], &mission, &error);
        ck_assert_msg(status == SRP_BAD_FORMAT, "'%s': %s", texts[i], srp_status_string(status));
    }
    ck_assert(mission == NULL);
    /* Both a state and elements. */
    static char text[8000];
    compose(text, 0, NULL);
    strcat(text,
           "elements: {semi_major_axis: 42164 km, eccentricity: 0, inclination: 0 deg, raan: 0 "
           "deg, arg_periapsis: 0 deg, true_anomaly: 0 deg}\n");
    ck_assert_int_eq(parse(text, &mission, &error), SRP_BAD_FORMAT);
    ck_assert_uint_eq(error.line, LINES + 1);
}
END_TEST

START_TEST(attitude_files_must_cover_the_mission) {
    static const struct {
        const char *epoch;
        srp_status status;
        const char *words;
    } all[] = {{"2024-03-20T00:00:00 TAI", SRP_OK, ""},
               {"2024-03-19T23:59:59 TAI", SRP_BAD_DATA, "the begin of the mission"},
               {"2024-03-20T00:01:00 TAI", SRP_BAD_DATA,
                "no attitude for 2024-03-20T00:02:40.000 TAI, the end"}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i) {
        char text[1000];
        srp_mission *mission = NULL;
        srp_error error;
        snprintf(text, sizeof text,
                 "epoch: %s\nduration: 100 s\nspacecraft:\n  mass: 9 kg\n  attitude:\n    mode: "
                 "aem\n    file: two.aem\nstate: {position: 7000 0 0 km, velocity: 0 7.5 0 km/s}\n"
                 "forces: {radiation: {model: plates, file: %s/box-wing.plates}}\n",
                 all[i].epoch, SRP_MODELS_DIR);
        const srp_status status = srp_mission_parse(
            text, strlen(text), SRP_CORPUS_DIR "/aem/t.yaml", NULL, &mission, &error);
        ck_assert_msg(status == all[i].status, "%s: %s", all[i].epoch, error.message);
        if (status != SRP_OK) {
            ck_assert_uint_eq(error.line, 7);
            ck_assert_msg(strstr(error.message, all[i].words) != NULL, "%s", error.message);
        }
        srp_mission_destroy(mission);
    }
}
END_TEST

/* Elements that are no orbit; a field that needs the Earth; a table that pulls. */
START_TEST(more_forms_are_checked) {
    static char text[8000];
    srp_mission *mission = NULL;
    srp_error error;
    const char *const head = "epoch: 2024-03-20 TT\nduration: 1 d\nspacecraft: {mass: 9 kg}\n";
    const struct {
        const char *tail;
        srp_status status;
        size_t line;
    } all[] = {
        {"elements: {semi_major_axis: 42164 km, eccentricity: 1.2, inclination: 0 deg, raan: 0 "
         "deg, "
         "arg_periapsis: 0 deg, true_anomaly: 0 deg}\n",
         SRP_BAD_DATA, 4},
        {"elements: {semi_major_axis: -42164 km, eccentricity: 1.2, inclination: 0 deg, raan: 0 "
         "deg, "
         "arg_periapsis: 0 deg, true_anomaly: 0 deg}\n",
         SRP_BAD_DATA, 4},
        {"elements: {semi_major_axis: 6000 km, eccentricity: 0, inclination: 0 deg, raan: 0 deg, "
         "arg_periapsis: 0 deg, true_anomaly: 0 deg}\n",
         SRP_BAD_DATA, 4},
        {"elements: {semi_major_axis: 42164 km, eccentricity: 0, inclination: 0, raan: 0 deg, "
         "arg_periapsis: 0 deg, true_anomaly: 0 deg}\n",
         SRP_BAD_FORMAT, 4},
        {"state: {position: 7000 0 0 km, velocity: 0 7.5 0 km/s}\nforces: {gravity: {file: x.gfc, "
         "degree: 300}}\n",
         SRP_BAD_DATA, 5},
        {"state: {position: 7000 0 0 km, velocity: 0 7.5 0 km/s}\nforces: {gravity: {file: x.gfc, "
         "degree: 3, order: 4}}\n",
         SRP_BAD_DATA, 5},
        {"state: {position: 7000 0 0 km, velocity: 0 7.5 0 km/s}\nforces: {gravity: {file: x.gfc, "
         "degree: 3}}\n",
         SRP_NOT_FOUND, 5},
        {"central_body: mars\nstate: {position: 7000 0 0 km, velocity: 0 1 0 km/s}\nforces: "
         "{gravity: "
         "{file: x.gfc, degree: 3}}\n",
         SRP_UNSUPPORTED, 6},
        {"", SRP_BAD_FORMAT, 1},
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i) {
        snprintf(text, sizeof text, "%s%s", head, all[i].tail);
        const srp_status status = parse(text, &mission, &error);
        ck_assert_msg(status == all[i].status && error.line == all[i].line, "%s: %s, line %zu: %s",
                      all[i].tail, srp_status_string(status), error.line, error.message);
        ck_assert(mission == NULL);
    }
}
END_TEST

START_TEST(tables_that_pull_are_refused) {
    FILE *in = fopen(SRP_SHARED_DATA_DIR "/spad/SphericalModel.spo", "r");
    char name[700];
    if (in == NULL) {
        /* GMAT's own is not part of the data: turn one round. */
        printf("skipped: no table of the opposite sign in %s\n", SRP_SHARED_DATA_DIR);
        return;
    }
    fclose(in);
    snprintf(name, sizeof name, "%s/spad/m.yaml", SRP_SHARED_DATA_DIR);
    const char *text =
        "epoch: 2024-03-20 TT\nduration: 1 d\nspacecraft: {mass: 9 kg, attitude: {mode: "
        "nadir}}\nstate: {position: 7000 0 0 km, velocity: 0 7.5 0 km/s}\nforces:\n  "
        "radiation:\n    model: table\n    file: SphericalModel.spo\n";
    srp_mission *mission = NULL;
    srp_error error;
    ck_assert_int_eq(srp_mission_parse(text, strlen(text), name, NULL, &mission, &error),
                     SRP_BAD_DATA);
    ck_assert_uint_eq(error.line, 8);
    ck_assert_msg(strstr(error.message, "--flip") != NULL, "%s", error.message);
}
END_TEST

/* ---- Running -----------------------------------------------------------------------------------
 */

typedef struct outputs {
    srp_mission_file *files[3];
    size_t rows;
    double last;
} outputs;

static srp_status on_row(void *user, const srp_mission *mission, const srp_mission_row *row,
                         srp_error *error) {
    outputs *out = user;
    (void)mission;
    ++out->rows;
    out->last = row->t;
    for (int i = 0; i < 3; ++i) {
        srp_status status = srp_mission_file_row(out->files[i], row, error);
        if (status != SRP_OK) {
            return status;
        }
    }
    return SRP_OK;
}

static void on_event(void *user, const srp_event *event) {
    outputs *out = user;
    srp_error error;
    assert_ok(srp_mission_file_event(out->files[2], event, &error), error);
}

static srp_mission *good_mission(void) {
    static char text[8000];
    srp_mission *mission = NULL;
    srp_error error;
    gsl_set_error_handler_off();
    compose(text, 0, NULL);
    assert_ok(parse(text, &mission, &error), error);
    return mission;
}

static size_t lines_of(const char *path, size_t *commas_min, size_t *commas_max) {
    char line[16000];
    size_t lines = 0;
    FILE *in = fopen(path, "r");
    ck_assert(in != NULL);
    *commas_min = SIZE_MAX;
    *commas_max = 0;
    while (fgets(line, sizeof line, in) != NULL) {
        size_t commas = 0;
        for (const char *at = line; *at != '\0'; ++at) {
            commas += *at == ',';
        }
        *commas_min = commas < *commas_min ? commas : *commas_min;
        *commas_max = commas > *commas_max ? commas : *commas_max;
        ++lines;
    }
    fclose(in);
    return lines;
}

START_TEST(a_mission_runs_and_writes) {
    srp_mission *mission = good_mission();
    outputs out = {{NULL}, 0, 0.0};
    srp_error error;
    srp_mission_summary summary;
    assert_ok(srp_oem_begin("mission.oem", mission, "2026-11-24T00:00:00", &out.files[0], &error),
              error);
    assert_ok(srp_report_begin("mission.csv", mission, &out.files[1], &error), error);
    assert_ok(srp_events_begin("mission-events.csv", mission, &out.files[2], &error), error);
    const srp_mission_watch watch = {on_row, on_event, NULL, &out};
    assert_ok(srp_mission_run(mission, &watch, &summary, &error), error);
    for (int i = 0; i < 3; ++i) {
        assert_ok(srp_mission_file_commit(out.files[i], &error), error);
    }
    /* 6 h by 25 min: 14 whole steps, the start and the end. */
    ck_assert_uint_eq(out.rows, 16);
    assert_close(out.last, 6.0 * 3600.0, 0.0, 0.0);
    ck_assert(summary.impulse > 0.0 && summary.counts.steps > 10);
    char why[300] = "";
    ck_assert_msg(oem_is_valid("mission.oem", why, sizeof why), "%s", why);
    size_t low, high;
    ck_assert_uint_eq(lines_of("mission.csv", &low, &high), 17);
    ck_assert_uint_eq(low, high);
    ck_assert_uint_eq(low + 1, 1 + 1 + 3 + 3 + 6 + 3 + 3 + 3 + 1 + 1 + 9 + 1 + 36 + 1 + 1);
    ck_assert_uint_ge(lines_of("mission-events.csv", &low, &high), 2);
    ck_assert_uint_eq(low, high);
    srp_mission_destroy(mission);
}
END_TEST

static size_t copy_file(const char *path, char *text, size_t size) {
    FILE *in = fopen(path, "r");
    ck_assert(in != NULL);
    const size_t n = fread(text, 1, size - 1, in);
    text[n] = '\0';
    fclose(in);
    return n;
}

/* The validator must be able to say no. */
START_TEST(the_oem_rules_can_fail) {
    static char text[20000], changed[20000];
    srp_mission *mission = good_mission();
    outputs out = {{NULL}, 0, 0.0};
    srp_error error;
    srp_mission_summary summary;
    for (int i = 0; i < 3; ++i) { /* one kind thrice will do */
        char name[32];
        snprintf(name, sizeof name, "rules-%d.oem", i);
        assert_ok(srp_oem_begin(name, mission, "2026-11-24T00:00:00", &out.files[i], &error),
                  error);
    }
    const srp_mission_watch watch = {on_row, NULL, NULL, &out};
    assert_ok(srp_mission_run(mission, &watch, &summary, &error), error);
    assert_ok(srp_mission_file_commit(out.files[0], &error), error);
    srp_mission_file_abandon(out.files[1]);
    srp_mission_file_abandon(out.files[2]);
    ck_assert(fopen("rules-1.oem", "r") == NULL);
    copy_file("rules-0.oem", text, sizeof text);
    const struct {
        const char *from, *to;
    } breaks[] = {{"CCSDS_OEM_VERS = 2.0", "CCSDS_OEM_VERS = 7"},
                  {"CREATION_DATE = 2026-11-24T00:00:00", "CREATION_DATE = today"},
                  {"ORIGINATOR", "ORIGIN"},
                  {"META_STOP", "META_END"},
                  {"OBJECT_ID = 2024-001A\n", ""},
                  {"CENTER_NAME = EARTH", "CENTER_NAME ="},
                  {"TIME_SYSTEM = UTC", "TIME_SYSTEM = A1"},
                  {"REF_FRAME = EME2000", "REF_FRAME = MINE"},
                  {"STOP_TIME = 2024-03-20T06", "STOP_TIME = 2024-03-20T05"},
                  {"START_TIME = 2024-03-20T00:00", "START_TIME = 2024-03-20T00:10"},
                  {"2024-03-20T00:25:00.000000000", "2024-03-20T00:00:00.000000000"},
                  {"\n2024-03-20T00:25:00.000000000 ", "\n2024-03-20T00:25:00.000000000 1.0 "}};
    for (size_t i = 0; i < sizeof breaks / sizeof breaks[0]; ++i) {
        char *at = strstr(text, breaks[i].from), why[300] = "";
        ck_assert_msg(at != NULL, "%s", breaks[i].from);
        snprintf(changed, sizeof changed, "%.*s%s%s", (int)(at - text), text, breaks[i].to,
                 at + strlen(breaks[i].from));
        FILE *file = fopen("rules-broken.oem", "w");
        fputs(changed, file);
        fclose(file);
        ck_assert_msg(!oem_is_valid("rules-broken.oem", why, sizeof why), "%s", breaks[i].to);
    }
    srp_mission_destroy(mission);
}
END_TEST

/* An empty list is a list: no body stands before the Sun. */
START_TEST(without_shadows_there_are_none) {
    static const struct {
        const char *line;
        size_t umbras;
    } all[] = {
        {"    shadow: []", 0}, {"", 1}, {"    shadow: [earth]", 1}, {"    shadow: [moon]", 0}};
    static char text[8000];
    gsl_set_error_handler_off();
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i) {
        srp_mission *mission = NULL;
        srp_mission_summary summary;
        srp_error error;
        compose(text, 28, all[i].line);
        char *at = strstr(text, "duration: 6 h");
        memcpy(at, "duration: 1 d", 13);
        assert_ok(parse(text, &mission, &error), error);
        assert_ok(srp_mission_run(mission, NULL, &summary, &error), error);
        ck_assert_msg(summary.umbras == all[i].umbras, "'%s': %zu umbras", all[i].line,
                      summary.umbras);
        srp_mission_destroy(mission);
    }
}
END_TEST

START_TEST(falling_to_the_ground_is_told) {
    const char *text =
        "epoch: 2024-03-20 TT\nduration: 1 d\nspacecraft: {mass: 9 kg}\nstate: {position: "
        "7000 0 0 km, velocity: 0 5 0 km/s}\n";
    srp_mission *mission = NULL;
    srp_mission_summary summary = {.impulse = -1.0};
    srp_error error;
    assert_ok(parse(text, &mission, &error), error);
    ck_assert_int_eq(srp_mission_run(mission, NULL, &summary, &error), SRP_BAD_DATA);
    ck_assert_msg(strstr(error.message, "surface") != NULL, "%s", error.message);
    ck_assert_msg(strstr(error.file, "test.yaml") != NULL, "'%s'", error.file);
    ck_assert(summary.impulse == -1.0);
    srp_mission_destroy(mission);
    srp_mission_destroy(NULL);
}
END_TEST

static bool never(void *user, double done) {
    (void)user;
    return done < 0.5;
}

START_TEST(a_run_can_be_cancelled) {
    srp_mission *mission = good_mission();
    const srp_mission_watch watch = {NULL, NULL, never, NULL};
    srp_mission_summary summary;
    srp_error error;
    ck_assert_int_eq(srp_mission_run(mission, &watch, &summary, &error), SRP_CANCELLED);
    srp_mission_destroy(mission);
}
END_TEST

typedef struct warnings {
    int epoch, duration;
    char last[200];
} warnings;

static void count_warning(void *user, const srp_error *what) {
    warnings *w = user;
    w->epoch += what->line == 2;
    w->duration += what->line == 3;
    snprintf(w->last, sizeof w->last, "%.190s", what->message);
}

/* An hour before the last day that the table of leap seconds reaches: UTC looks a day ahead. */
static void edge_of_leap_seconds(char *text, size_t size) {
    int year = 2023;
    for (bool beyond = false; !beyond; ++year) {
        srp_epoch epoch;
        srp_error error;
        snprintf(text, size, "%d-06-01T00:00:00 UTC", year + 1);
        assert_ok(srp_epoch_parse(text, &epoch, &beyond, &error), error);
    }
    snprintf(text, size, "%d-12-30T23:00:00 UTC", year - 1);
}

START_TEST(dates_that_are_not_sure_are_warned_of) {
    char edge[64];
    edge_of_leap_seconds(edge, sizeof edge);
    const struct {
        const char *epoch, *duration;
        int at_epoch, at_duration;
        const char *words;
    } all[] = {
        {"2024-03-20T00:00:00 UTC", "6 h", 0, 0, ""},
        {"2070-03-20T00:00:00 UTC", "6 h", 1, 1, "table of leap seconds"},
        {"2024-03-20T00:00:00 UTC", "50 d", 0, 0, ""},
        {edge, "6 h", 0, 1, "table of leap seconds"},
        {"2070-03-20T00:00:00 TT", "6 h", 0, 0, ""},
        {"2099-12-31T23:00:00 TAI", "6 h", 0, 1, "1900 to 2100"},
        {"1899-03-20T00:00:00 TAI", "6 h", 1, 1, "1900 to 2100"},
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i) {
        char text[1000];
        srp_mission *mission = NULL;
        srp_error error;
        warnings w = {0, 0, ""};
        const srp_log log = {count_warning, &w};
        const srp_mission_context context = {&log, NULL, NULL, NULL};
        snprintf(text, sizeof text,
                 "title: t\nepoch: %s\nduration: %s\nspacecraft: {mass: 9 kg}\nstate: {position: "
                 "7000 0 0 km, velocity: 0 7.5 0 km/s}\n",
                 all[i].epoch, all[i].duration);
        assert_ok(parse_with(text, &context, &mission, &error), error);
        ck_assert_msg(w.epoch == all[i].at_epoch && w.duration == all[i].at_duration &&
                          strstr(w.last, all[i].words) != NULL,
                      "%s, %s: %d, %d: %s", all[i].epoch, all[i].duration, w.epoch, w.duration,
                      w.last);
        srp_mission_destroy(mission);
    }
}
END_TEST

static void keep_warnings(void *user, const srp_error *what) {
    char *all = user;
    strncat(all, what->message, 900 - strlen(all));
}

START_TEST(what_counts_for_nothing_is_warned_of) {
    static const char *const TEXT =
        "title: t\nepoch: 2024-03-20T00:00:00 UTC\nduration: 6 h\nspacecraft: {mass: 9 kg}\n"
        "state: {position: 7000 0 0 km, velocity: 0 7.5 0 km/s}\n"
        "integrator: {fixed_step: 60 s, tolerance: 1e-10}\noutput: {columns: [epoch, nodes]}\n";
    char words[1000] = "";
    srp_mission *mission = NULL;
    srp_error error;
    const srp_log log = {keep_warnings, words};
    const srp_mission_context context = {&log, NULL, NULL, NULL};
    assert_ok(parse_with(TEXT, &context, &mission, &error), error);
    ck_assert_msg(strstr(words, "integrator.tolerance") != NULL, "%s", words);
    ck_assert_msg(strstr(words, "nodes will be 0") != NULL, "%s", words);
    srp_mission_destroy(mission);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("orbit_mission");
    TCase *all = tcase_create("mission");
    tcase_add_loop_test(all, mistakes_are_told_with_their_line, 0,
                        sizeof MISTAKES / sizeof MISTAKES[0]);
    tcase_add_test(all, other_mistakes_are_told);
    tcase_add_test(all, more_forms_are_checked);
    tcase_add_test(all, attitude_files_must_cover_the_mission);
    tcase_add_test(all, tables_that_pull_are_refused);
    tcase_add_test(all, a_mission_runs_and_writes);
    tcase_add_test(all, the_oem_rules_can_fail);
    tcase_add_test(all, without_shadows_there_are_none);
    tcase_add_test(all, falling_to_the_ground_is_told);
    tcase_add_test(all, a_run_can_be_cancelled);
    tcase_add_test(all, dates_that_are_not_sure_are_warned_of);
    tcase_add_test(all, what_counts_for_nothing_is_warned_of);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
