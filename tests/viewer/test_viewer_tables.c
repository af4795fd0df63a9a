/* SPDX-License-Identifier: Apache-2.0 */
/* Tables of a session: shared between threads, and of old or new optics. */
#include "session.h"
#include "srp_check.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

static const char BOX_WING[] = SRP_MODELS_DIR "/box-wing.obj";

static viewer_setup *box_wing(void) {
    viewer_setup *setup = viewer_setup_create();
    ck_assert_ptr_nonnull(setup);
    ck_assert(viewer_setup_set_model(setup, BOX_WING));
    return setup;
}

static srp_table *compute(const viewer_engine *engine, bool basis) {
    srp_table *table = NULL;
    srp_error error;
    ck_assert_ptr_nonnull(engine->prepared);
    ck_assert_int_eq(srp_table_create(engine->prepared, (srp_grid){13, 7}, basis, &table, &error),
                     SRP_OK);
    ck_assert_int_eq(srp_table_fill(table, engine->prepared, NULL, &error), SRP_OK);
    return table;
}

static void add(viewer_session *session, srp_table *table, const char *name) {
    viewer_table entry = {table, viewer_text_copy(name), NULL, NULL, 0};
    ck_assert(viewer_session_add_table(session, entry));
}

static void set_optics(viewer_session *session, viewer_setup *setup, const char *text) {
    viewer_words problem = {""};
    ck_assert_msg(viewer_setup_set_material_text(setup, text, &problem), "%s", problem.text);
    viewer_shape *known = session->engine != NULL ? session->engine->shape : NULL;
    viewer_session_set_engine(session, viewer_engine_make(setup, known, false));
}

static void expect_label(const viewer_session *session, size_t index, const char *want) {
    char *label = viewer_session_table_label(session, index);
    ck_assert_str_eq(label, want);
    free(label);
}

START_TEST(optics_that_change_leave_old_tables) {
    viewer_session *session = viewer_session_create();
    viewer_setup *setup = box_wing();
    viewer_session_set_engine(session, viewer_engine_make(setup, NULL, false));
    add(session, compute(session->engine, true), "1: box-wing");
    expect_label(session, 0, "1: box-wing");
    set_optics(session, setup, "cells=0.3125,0.171875");
    ck_assert(viewer_session_table_is_old(session, 0));
    expect_label(session, 0, "1 (of other optics): box-wing");
    /* What is made of it by its sums is of the new ones, and what tracing gives. */
    srp_table *made = NULL, *traced = compute(session->engine, true);
    srp_error error;
    ck_assert_int_eq(viewer_table_reoptic(session->tables[0], session->engine, &made, &error),
                     SRP_OK);
    for (uint32_t i = 0; i < 13; ++i) {
        for (uint32_t j = 0; j < 7; ++j) {
            srp_vec3 a = srp_table_node(made, i, j)->f, b = srp_table_node(traced, i, j)->f;
            ck_assert(srp_vec3_norm(srp_vec3_sub(a, b)) <= 1e-13 * srp_vec3_norm(b));
        }
    }
    add(session, made, "2");
    add(session, traced, "3");
    ck_assert(!viewer_session_table_is_old(session, 1) && !viewer_session_table_is_old(session, 2));
    /* A table of another spacecraft is none of old optics. */
    ck_assert(viewer_setup_set_model(setup, SRP_MODELS_DIR "/cube.obj"));
    viewer_session_set_engine(session, viewer_engine_make(setup, NULL, false));
    ck_assert_ptr_nonnull(session->engine->mesh);
    ck_assert(!viewer_session_table_is_old(session, 0));
    viewer_setup_destroy(setup);
    viewer_session_destroy(session);
}
END_TEST

START_TEST(table_without_sums_keeps_its_optics) {
    viewer_session *session = viewer_session_create();
    viewer_setup *setup = box_wing();
    viewer_session_set_engine(session, viewer_engine_make(setup, NULL, false));
    add(session, compute(session->engine, false), "1");
    set_optics(session, setup, "cells=0.3125,0.171875");
    srp_table *made = NULL;
    srp_error error;
    ck_assert_int_eq(viewer_table_reoptic(session->tables[0], session->engine, &made, &error),
                     SRP_UNSUPPORTED);
    ck_assert_ptr_null(made);
    viewer_setup_destroy(setup);
    viewer_session_destroy(session);
}
END_TEST

/* ---- threads ---- */

typedef struct reader {
    viewer_table *table;
    viewer_engine *engine;
    double sum;
} reader;

static void *read_it(void *user) {
    reader *r = user;
    srp_grid grid = srp_table_grid(r->table->table);
    for (int round = 0; round < 200; ++round) {
        for (uint32_t i = 0; i < grid.az_count; ++i) {
            r->sum += srp_table_node(r->table->table, i, (uint32_t)round % 7)->f.x;
        }
        char *command = viewer_setup_command(r->engine->setup, "table", NULL, 0);
        r->sum += strstr(command, "--mass") != NULL;
        free(command);
    }
    return NULL;
}

/* While a thread reads a table and an engine, the window changes the mass and forgets all tables.
 */
START_TEST(another_thread_may_read) {
    viewer_session *session = viewer_session_create();
    viewer_words problem = {""};
    pthread_t thread;
    reader r = {.sum = 0.0};
    ck_assert(viewer_setup_set_model(session->setup, BOX_WING));
    ck_assert(viewer_setup_set_mass(session->setup, "12.5", &problem));
    viewer_session_set_engine(session, viewer_engine_make(session->setup, NULL, false));
    add(session, compute(session->engine, true), "1");
    r.table = viewer_table_reference(session->tables[0]);
    r.engine = viewer_engine_reference(session->engine);
    ck_assert_int_eq(pthread_create(&thread, NULL, read_it, &r), 0);
    for (int i = 0; i < 100; ++i) {
        ck_assert(viewer_setup_set_mass(session->setup, i % 2 == 0 ? "731.25" : "", &problem));
    }
    viewer_session_clear_tables(session);
    ck_assert_uint_eq(session->table_count, 0);
    viewer_session_destroy(session);
    ck_assert_int_eq(pthread_join(thread, NULL), 0);
    double had = r.sum;
    read_it(&r);
    assert_close(r.sum, 2.0 * had, 1e-9, 1e-9);
    viewer_table_release(r.table);
    viewer_engine_release(r.engine);
    viewer_table_release(NULL);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("viewer tables");
    TCase *cases = tcase_create("tables");
    tcase_set_timeout(cases, 120);
    tcase_add_test(cases, optics_that_change_leave_old_tables);
    tcase_add_test(cases, table_without_sums_keeps_its_optics);
    tcase_add_test(cases, another_thread_may_read);
    suite_add_tcase(suite, cases);
    return run_suite(suite);
}
