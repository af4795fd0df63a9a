/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L /* getcwd */
/* Missions whose table fills itself: the orbit of the full table, the cache, every entry. */
#include "error.h"
#include "method_internal.h"
#include "srp_check.h"

#include <srp/orbit/mission.h>
#include <srp/scene.h>
#include <srp/table.h>

#include <gsl/gsl_errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char here[2048];

/* A mission with these entries of `forces.radiation`, from line 8 on. */
static srp_status parse(const char *entries, const srp_mission_context *context, srp_mission **out,
                        srp_error *error) {
    char text[4000];
    snprintf(text, sizeof text,
             "epoch: 2024-03-20T00:00:00 UTC\nduration: 12 h\n"
             "state: {position: 36607.35826 -20921.7237 0 km, velocity: 1.5256345 2.6694515 "
             "0.0123456 km/s}\nspacecraft: {mass: 850 kg, attitude: {mode: nadir}}\n"
             "output: {step: 3 h, columns: [elapsed, nodes]}\nforces:\n  radiation:\n%s",
             entries);
    return srp_mission_parse(text, strlen(text), SRP_MODELS_DIR "/test.yaml", context, out, error);
}

static srp_mission *good(const char *entries, const srp_mission_context *context) {
    srp_mission *mission = NULL;
    srp_error error;
    assert_ok(parse(entries, context, &mission, &error), error);
    return mission;
}

static srp_mission_summary fly(const srp_mission *mission) {
    srp_mission_summary summary;
    srp_error error;
    assert_ok(srp_mission_run(mission, NULL, &summary, &error), error);
    return summary;
}

static void assert_same_end(const srp_mission_summary *a, const srp_mission_summary *b) {
    ck_assert_int_eq(memcmp(&a->r, &b->r, sizeof a->r), 0);
    ck_assert_int_eq(memcmp(&a->v, &b->v, sizeof a->v), 0);
    ck_assert(a->counts.calls == b->counts.calls);
}

/* ---- The numbers ------------------------------------------------------------------------------
 */

static void write_table(const char *path, double step_deg) {
    const char *obj = SRP_MODELS_DIR "/box-wing.obj";
    const srp_method_params params = srp_method_params_default();
    srp_scene *scene = NULL;
    srp_prepared *prepared = NULL;
    srp_table *table = NULL;
    srp_grid grid;
    srp_error error;
    assert_ok(srp_scene_read_obj(&obj, 1, NULL, NULL, NULL, &scene, &error), error);
    assert_ok(srp_method_prepare(&srp_method_exact, scene, &params, &prepared, &error), error);
    assert_ok(srp_grid_from_steps(step_deg, step_deg, &grid, &error), error);
    assert_ok(srp_table_create(prepared, grid, false, &table, &error), error);
    assert_ok(srp_table_fill(table, prepared, NULL, &error), error);
    assert_ok(srp_table_write(table, &srp_table_format_netcdf, path, &error), error);
    srp_table_destroy(table);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}

START_TEST(the_orbit_is_that_of_the_full_table) {
    static const char *const SCHEMES[] = {"bilinear", "bicubic"};
    char entries[3000], path[2200];
    snprintf(path, sizeof path, "%s/on-demand-full.nc", here);
    write_table(path, 7.5);
    for (int i = 0; i < 2; ++i) {
        snprintf(entries, sizeof entries, "    model: table\n    file: %s\n    interpolation: %s\n",
                 path, SCHEMES[i]);
        srp_mission *table = good(entries, NULL);
        snprintf(entries, sizeof entries,
                 "    model: on_demand\n    file: box-wing.obj\n    step: 7.5 deg\n    "
                 "interpolation: %s\n",
                 SCHEMES[i]);
        srp_mission *demand = good(entries, NULL);
        const srp_mission_summary want = fly(table), got = fly(demand);
        assert_same_end(&want, &got);
        ck_assert_uint_eq(want.nodes_total, 0);
        ck_assert_uint_eq(got.nodes_total, 48 * 23 + 2);
        ck_assert(got.nodes_computed > 20 && got.nodes_computed < got.nodes_total);
        ck_assert_uint_eq(got.nodes_cached, 0);
        ck_assert_str_eq(srp_mission_get_info(demand)->model, SCHEMES[i]);
        srp_mission_destroy(table);
        srp_mission_destroy(demand);
    }
}
END_TEST

typedef struct node_rows {
    size_t count, last;
} node_rows;

static srp_status see_row(void *user, const srp_mission *mission, const srp_mission_row *row,
                          srp_error *error) {
    node_rows *rows = user;
    (void)mission;
    (void)error;
    ck_assert_uint_ge(row->nodes, rows->last);
    rows->last = row->nodes;
    ++rows->count;
    return SRP_OK;
}

START_TEST(rows_count_nodes) {
    srp_mission *mission = good("    model: on_demand\n    file: box-wing.obj\n", NULL);
    node_rows rows = {0, 0};
    const srp_mission_watch watch = {see_row, NULL, NULL, &rows};
    srp_mission_summary summary;
    srp_error error;
    assert_ok(srp_mission_run(mission, &watch, &summary, &error), error);
    ck_assert_uint_eq(rows.count, 5);
    ck_assert_uint_eq(summary.nodes_total, 72 * 35 + 2); /* steps of 5 degrees */
    ck_assert_uint_eq(rows.last, summary.nodes_computed);
    srp_mission_destroy(mission);
}
END_TEST

/* ---- The cache --------------------------------------------------------------------------------
 */

static void empty_cache(const srp_cache_params *params) {
    srp_cache *cache = NULL;
    srp_error error;
    assert_ok(srp_cache_open(params, NULL, &cache, &error), error);
    assert_ok(srp_cache_clear(cache, NULL, &error), error);
    srp_cache_close(cache);
}

START_TEST(a_second_run_computes_nothing) {
    char directory[2200];
    srp_cache_params cache = srp_cache_params_default();
    snprintf(directory, sizeof directory, "%s/on-demand-cache", here);
    cache.directory = directory;
    empty_cache(&cache);
    const srp_mission_context context = {NULL, NULL, NULL, &cache};
    const char *entries = "    model: on_demand\n    file: box-wing.obj\n    az_step: 10 deg\n    "
                          "el_step: 5 deg\n    method: raytrace\n    grid: 64\n    diffuse: 2\n";
    char without[600];
    snprintf(without, sizeof without, "%s    cache: false\n", entries);

    srp_mission *first = good(without, &context);
    const srp_mission_summary alone = fly(first);
    srp_mission_destroy(first);
    first = good(entries, &context);
    const srp_mission_summary one = fly(first);
    ck_assert(alone.nodes_computed > 0 && one.nodes_computed == alone.nodes_computed);
    ck_assert_uint_eq(one.nodes_cached, 0);
    assert_same_end(&alone, &one);

    /* While the first is still there: a run writes at its end. */
    srp_mission *second = good(entries, &context);
    const srp_mission_summary two = fly(second);
    ck_assert_uint_eq(two.nodes_computed, 0);
    ck_assert_uint_eq(two.nodes_cached, one.nodes_computed);
    assert_same_end(&alone, &two);
    srp_mission_destroy(first);
    srp_mission_destroy(second);
}
END_TEST

static void count_log(void *user, const srp_error *what) {
    (void)what;
    ++*(int *)user;
}

START_TEST(a_cache_that_cannot_be_used_stops_nobody) {
    srp_cache_params cache = srp_cache_params_default();
    int warnings = 0;
    const srp_log log = {count_log, &warnings};
    cache.directory = "/dev/null/nowhere";
    const srp_mission_context context = {&log, NULL, NULL, &cache};
    srp_mission *mission =
        good("    model: on_demand\n    file: box-wing.obj\n    step: 30 deg\n", &context);
    const srp_mission_summary sum = fly(mission);
    ck_assert(sum.nodes_computed > 0);
    srp_mission_destroy(mission);
    ck_assert_int_eq(warnings, 1);
}
END_TEST

/* ---- Methods of others ------------------------------------------------------------------------
 */

static struct {
    srp_method_params params;
    double mesh_radius;
    srp_optics optics;
    long answers, fail_from; /* answers after which it fails; < 0: never */
} fake;

static srp_status fake_prepare(const srp_scene *scene, const srp_method_params *params,
                               srp_prepared **out, srp_error *error);

static srp_status fake_respond(const srp_prepared *prepared, size_t count, const srp_vec3 *s_body,
                               srp_response *responses, srp_basis *basis, srp_error *error) {
    (void)prepared;
    (void)basis;
    fake.answers += (long)count;
    if (fake.fail_from >= 0 && fake.answers > fake.fail_from) {
        return srp_fail(error, SRP_NO_DEVICE, "the device has gone");
    }
    memset(responses, 0, count * sizeof *responses);
    for (size_t i = 0; i < count; ++i) {
        responses[i].f = srp_vec3_scale(-31.7, s_body[i]);
    }
    return SRP_OK;
}

static void fake_release(srp_prepared *prepared) {
    free(prepared);
}

static const srp_method FAKE = {
    .name = "raytrace",
    .device = "fake",
    .summary = "",
    .shapes = SRP_SHAPE_MESH,
    .capabilities = SRP_METHOD_LATTICE | SRP_METHOD_BOUNCE,
    .prepare = fake_prepare,
    .respond = fake_respond,
    .release = fake_release,
};

static srp_status fake_prepare(const srp_scene *scene, const srp_method_params *params,
                               srp_prepared **out, srp_error *error) {
    (void)error;
    srp_prepared *prepared = calloc(1, sizeof *prepared);
    ck_assert_ptr_nonnull(prepared);
    prepared->method = &FAKE;
    prepared->scene = scene;
    prepared->params = *params;
    fake.params = *params;
    fake.mesh_radius = srp_scene_radius(scene);
    for (size_t i = 0; i < srp_scene_material_count(scene); ++i) {
        if (strcmp(srp_scene_material_name(scene, i), "bus") == 0) {
            fake.optics = srp_scene_material_optics(scene, i);
        }
    }
    *out = prepared;
    return SRP_OK;
}

static const srp_method *find_fake(void *user, const char *name, const char *device) {
    ck_assert_ptr_eq(user, &fake);
    return strcmp(name, "raytrace") != 0 ? NULL
           : strcmp(device, "fake") == 0 ? &FAKE
           : strcmp(device, "cpu") == 0  ? &srp_method_raytrace
                                         : NULL;
}

START_TEST(entries_reach_the_method) {
    const srp_mission_context context = {NULL, find_fake, &fake, NULL};
    fake.fail_from = -1;
    srp_mission *mission =
        good("    model: on_demand\n    file: box-wing.obj\n    unit: cm\n    method: raytrace\n"
             "    device: fake\n    grid: 123\n    tolerance: 1e-3\n    max_grid: 777\n    seed: "
             "18446744073709551615\n    reflections: 5\n    diffuse: 7\n    beams: 99\n    "
             "threads: 3\n    materials:\n      - {name: bus, rho_s: 0.123, rho_d: 0.456, "
             "one_sided: true}\n",
             &context);
    ck_assert_uint_eq(fake.params.lattice.samples, 123);
    assert_close(fake.params.tolerance, 1e-3, 0.0, 0.0);
    ck_assert_uint_eq(fake.params.max_samples, 777);
    ck_assert(fake.params.seed == UINT64_MAX);
    ck_assert_uint_eq(fake.params.reflections, 5);
    ck_assert_uint_eq(fake.params.diffuse, 7);
    ck_assert_uint_eq(fake.params.mirrored_beams, 99);
    ck_assert_int_eq(fake.params.threads, 3);
    assert_close(fake.optics.rho_s, 0.123, 0.0, 0.0);
    assert_close(fake.optics.rho_d, 0.456, 0.0, 0.0);
    ck_assert(fake.optics.one_sided);
    ck_assert(fake.mesh_radius > 0.01 && fake.mesh_radius < 0.2); /* metres were centimetres */
    srp_mission_destroy(mission);
    mission = good("    model: direct\n    file: box-wing.obj\n    method: raytrace\n    device: "
                   "fake\n    pixel: 2 m\n",
                   &context);
    assert_close(fake.params.lattice.pixel, 2.0, 0.0, 0.0);
    ck_assert_int_eq(fake.params.threads, 1); /* a call asks for one direction */
    srp_mission_destroy(mission);
}
END_TEST

START_TEST(a_method_that_fails_says_why) {
    const srp_mission_context context = {NULL, find_fake, &fake, NULL};
    const char *entries = "    model: on_demand\n    file: box-wing.obj\n    method: raytrace\n    "
                          "device: fake\n    step: 2 deg\n";
    srp_mission *mission = NULL;
    srp_mission_summary summary;
    srp_error error;
    /* At once, told at the entry; later, as it is. */
    fake.answers = 0;
    fake.fail_from = 0;
    ck_assert_int_eq(parse(entries, &context, &mission, &error), SRP_NO_DEVICE);
    ck_assert(mission == NULL && error.line > 0);
    ck_assert_msg(strstr(error.message, "the device has gone") != NULL, "%s", error.message);
    fake.answers = 0;
    fake.fail_from = 150;
    mission = good(entries, &context);
    ck_assert_int_eq(srp_mission_run(mission, NULL, &summary, &error), SRP_NO_DEVICE);
    ck_assert_msg(strstr(error.message, "the device has gone") != NULL, "%s", error.message);
    srp_mission_destroy(mission);
}
END_TEST

/* ---- Mistakes ---------------------------------------------------------------------------------
 */

typedef struct mistake {
    const char *entries;
    size_t line;
    srp_status status;
    const char *words;
} mistake;

#define OD "    model: on_demand\n    file: box-wing.obj\n"
static const mistake MISTAKES[] = {
    {"    model: on_demand\n", 8, SRP_BAD_FORMAT, "'file' is missing"},
    {"    model: on_demand\n    file: no-such.obj\n", 9, SRP_NOT_FOUND, "no-such.obj"},
    {"    model: on_demand\n    file: .\n", 9, SRP_IO, ""},
    {"    model: on_demand\n    file: missions/leo.yaml\n", 9, SRP_BAD_FORMAT, "leo.yaml"},
    {OD "    step: 7 deg\n", 10, SRP_BAD_DATA, "divide"},
    {OD "    step: 5\n", 10, SRP_BAD_FORMAT, "expected a unit: deg"},
    {OD "    step: 0 deg\n", 10, SRP_BAD_DATA, "above 0"},
    {OD "    step: 180 deg\n", 10, SRP_BAD_DATA, "steps"},
    {OD "    az_step: 10 deg\n    el_step: 11 deg\n", 11, SRP_BAD_DATA, "divide"},
    {OD "    step: 5 deg\n    az_step: 10 deg\n", 10, SRP_BAD_FORMAT, "either"},
    {OD "    interpolation: spline\n", 10, SRP_BAD_DATA, "bilinear or bicubic"},
    {OD "    interpolation: gmat_bicubic\n", 10, SRP_BAD_DATA, "bilinear or bicubic"},
    {OD "    cache: perhaps\n", 10, SRP_BAD_FORMAT, "true or false"},
    {OD "    unit: parsec\n", 10, SRP_BAD_DATA, "mm, cm"},
    {OD "    method: magic\n", 10, SRP_BAD_DATA, "raytrace"},
    {OD "    method: nplate\n", 10, SRP_BAD_DATA, "raytrace"},
    {OD "    device: gl\n", 10, SRP_BAD_DATA, "cpu"},
    {OD "    method: raycast\n    grid: 0\n", 11, SRP_BAD_DATA, "from 1 to 32768"},
    {OD "    method: raycast\n    grid: many\n", 11, SRP_BAD_DATA, "from 1 to 32768"},
    {OD "    method: raycast\n    grid: 40000\n", 11, SRP_BAD_DATA, "from 1 to 32768"},
    {OD "    method: raycast\n    pixel: 1 deg\n", 11, SRP_BAD_FORMAT, "m, km, au"},
    {OD "    method: raycast\n    grid: 9\n    pixel: 1 m\n", 12, SRP_BAD_FORMAT, "one of"},
    {OD "    method: raycast\n    max_grid: 64\n", 11, SRP_BAD_FORMAT, "tolerance"},
    {OD "    method: raycast\n    tolerance: 0\n", 11, SRP_BAD_DATA, "above 0"},
    {OD "    method: raycast\n    seed: -1\n", 11, SRP_BAD_DATA, "2^64"},
    {OD "    method: raycast\n    seed: 18446744073709551616\n", 11, SRP_BAD_DATA, "2^64"},
    {OD "    method: raytrace\n    reflections: 101\n", 11, SRP_BAD_DATA, "from 0 to 100"},
    {OD "    method: raytrace\n    diffuse: 1.5\n", 11, SRP_BAD_DATA, "from 0 to 1024"},
    {OD "    method: raytrace\n    beams: x\n", 11, SRP_BAD_DATA, "whole number"},
    {OD "    threads: 0\n", 10, SRP_BAD_DATA, "from 1 to 1024"},
    {OD "    materials: bus\n", 10, SRP_BAD_FORMAT, ""},
    {OD "    materials: [bus]\n", 10, SRP_BAD_FORMAT, ""},
    {OD "    materials: [{name: bus, rho_s: 0.1}]\n", 10, SRP_BAD_FORMAT, "rho_d"},
    {OD "    materials:\n    - {name: bus, rho_s: 0.7, rho_d: 0.4}\n", 11, SRP_BAD_DATA,
     "rho_s + rho_d"},
    {OD "    materials:\n    - {name: bus, rho_s: x, rho_d: 0.4}\n", 11, SRP_BAD_FORMAT, "rho_s"},
    {OD "    materials:\n    - {name: bus, rho_s: 0, rho_d: 0 m}\n", 11, SRP_BAD_FORMAT, "rho_d"},
    {OD "    materials:\n    - {name: bus, rho_s: 0, rho_d: 0, one_sided: 2}\n", 11, SRP_BAD_FORMAT,
     "true or false"},
    {OD "    materials:\n    - {name: bus, rho_s: 0, rho_d: 0}\n    - {name: bus, rho_s: 0, rho_d: "
        "0}\n",
     12, SRP_BAD_DATA, "twice"},
};

START_TEST(mistakes_are_told_with_their_line) {
    const mistake *m = &MISTAKES[_i];
    srp_mission *mission = NULL;
    srp_error error = {.status = SRP_OK};
    const srp_status status = parse(m->entries, NULL, &mission, &error);
    ck_assert_msg(status == m->status && mission == NULL, "%s: %s: %s", m->entries,
                  srp_status_string(status), error.message);
    ck_assert_msg(strstr(error.message, m->words) != NULL, "%s: %s", m->entries, error.message);
    ck_assert_msg(error.line == m->line && strstr(error.file, "test.yaml") != NULL,
                  "%s: %s:%zu: %s", m->entries, error.file, error.line, error.message);
}
END_TEST

typedef struct warnings {
    int count;
    char all[2000];
} warnings;

static void collect(void *user, const srp_error *what) {
    warnings *w = user;
    const size_t used = strlen(w->all);
    ++w->count;
    snprintf(w->all + used, sizeof w->all - used, "%zu: %s\n", what->line, what->message);
}

START_TEST(what_means_nothing_is_warned_of) {
    static const struct {
        const char *entries;
        int count;
        const char *words;
    } all[] = {
        /* Of models without nodes, the column of them is one more. */
        {OD "    step: 30 deg\n    grid: 64\n", 1, "11: forces.radiation.grid: method exact"},
        {OD "    step: 30 deg\n    method: raycast\n    grid: 64\n    diffuse: 2\n", 1,
         "13: forces.radiation.diffuse: method raycast"},
        {OD "    step: 30 deg\n    cr: 1.3\n", 1, "11: forces.radiation.cr: model on_demand"},
        {OD "    step: 30 deg\n    materials: [{name: bomm, rho_s: 0, rho_d: 0}]\n", 1,
         "11: forces.radiation.materials: no face has the given material 'bomm'"},
        {"    model: cannonball\n    cr: 1.3\n    area: 3 m2\n    cache: true\n    materials: "
         "[{name: a, rho_s: 0, rho_d: 0}]\n",
         3, "12: forces.radiation.materials: model cannonball"},
        {"    model: direct\n    file: box-wing.obj\n    step: 5 deg\n    interpolation: spline\n",
         3, "10: forces.radiation.step: model direct"},
        {"    model: plates\n    file: box-wing.plates\n    seed: 5\n", 2, "10: "},
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i) {
        warnings w = {0, ""};
        const srp_log log = {collect, &w};
        const srp_mission_context context = {&log, NULL, NULL, NULL};
        srp_mission_destroy(good(all[i].entries, &context));
        ck_assert_msg(w.count == all[i].count && strstr(w.all, all[i].words) != NULL, "%s: %s",
                      all[i].entries, w.all);
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("orbit_on_demand");
    TCase *all = tcase_create("on_demand");
    gsl_set_error_handler_off();
    if (getcwd(here, sizeof here) == NULL) {
        return 1;
    }
    tcase_add_test(all, the_orbit_is_that_of_the_full_table);
    tcase_add_test(all, rows_count_nodes);
    tcase_add_test(all, a_second_run_computes_nothing);
    tcase_add_test(all, a_cache_that_cannot_be_used_stops_nobody);
    tcase_add_test(all, entries_reach_the_method);
    tcase_add_test(all, a_method_that_fails_says_why);
    tcase_add_loop_test(all, mistakes_are_told_with_their_line, 0,
                        sizeof MISTAKES / sizeof MISTAKES[0]);
    tcase_add_test(all, what_means_nothing_is_warned_of);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
