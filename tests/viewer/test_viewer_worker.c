/* SPDX-License-Identifier: Apache-2.0 */
/* The viewer's thread: newest wins, cancelling, an end at any time. */
#include "srp_check.h"
#include "worker.h"

#include <stdlib.h>

typedef struct counts {
    atomic_int ran, cancelled;
    int delivered, delivered_cancelled, released, last;
} counts;

typedef struct probe {
    viewer_job job;
    counts *to;
    int number;
    bool waits;    /* until it is cancelled, or `go` */
    bool stubborn; /* until `go` alone */
    atomic_bool *go;
} probe;

static void run(viewer_job *base) {
    probe *job = (probe *)base;
    atomic_fetch_add(&job->to->ran, 1);
    while (job->waits && (job->stubborn || !atomic_load(&job->job.cancel)) &&
           (job->go == NULL || !atomic_load(job->go))) {
        g_usleep(200);
    }
    atomic_fetch_add(&job->to->cancelled, atomic_load(&job->job.cancel) ? 1 : 0);
}

static void deliver(viewer_job *base) {
    probe *job = (probe *)base;
    ++job->to->delivered;
    job->to->delivered_cancelled += atomic_load(&job->job.cancel);
    job->to->last = job->number;
}

static void release(viewer_job *base) {
    ++((probe *)base)->to->released;
    free(base);
}

static viewer_job *make(counts *to, int number, bool waits, atomic_bool *go) {
    probe *job = calloc(1, sizeof *job);
    ck_assert_ptr_nonnull(job);
    job->job.run = run;
    job->job.deliver = deliver;
    job->job.release = release;
    job->to = to;
    job->number = number;
    job->waits = waits;
    job->go = go;
    return &job->job;
}

static viewer_job *make_stubborn(counts *to, atomic_bool *go) {
    viewer_job *job = make(to, 0, true, go);
    ((probe *)job)->stubborn = true;
    return job;
}

static void wait_until_idle(viewer_worker *worker, GMainContext *context) {
    for (bool busy = true; busy;) {
        g_main_context_iteration(context, FALSE);
        g_usleep(100);
        busy = false;
        for (unsigned slot = 0; slot < VIEWER_SLOTS; ++slot) {
            busy = busy || viewer_worker_is_busy(worker, slot);
        }
    }
}

static void wait_until_runs(counts *c, int jobs) {
    while (atomic_load(&c->ran) < jobs) {
        g_usleep(100);
    }
}

START_TEST(newest_request_wins) {
    GMainContext *context = g_main_context_new();
    viewer_worker *worker = viewer_worker_create("test", context);
    counts c = {0};
    atomic_bool go = false;
    viewer_worker_submit(worker, 1, make(&c, 0, true, &go));
    wait_until_runs(&c, 1);
    for (int k = 1; k <= 50; ++k) {
        viewer_worker_submit(worker, 1, make(&c, k, false, NULL));
    }
    ck_assert(viewer_worker_is_busy(worker, 1));
    ck_assert(!viewer_worker_is_busy(worker, 0));
    ck_assert_int_eq(c.released, 49);
    atomic_store(&go, true);
    wait_until_idle(worker, context);
    ck_assert_int_eq(atomic_load(&c.ran), 2);
    ck_assert_int_eq(c.delivered, 2);
    ck_assert_int_eq(c.last, 50);
    ck_assert_int_eq(c.released, 51);
    ck_assert_int_eq(atomic_load(&c.cancelled), 0);
    viewer_worker_destroy(worker);
    g_main_context_unref(context);
}
END_TEST

START_TEST(cancelled_job_ends_and_is_delivered) {
    GMainContext *context = g_main_context_new();
    viewer_worker *worker = viewer_worker_create("test", context);
    counts c = {0};
    viewer_worker_submit(worker, 2, make(&c, 7, true, NULL));
    wait_until_runs(&c, 1);
    viewer_worker_submit(worker, 2, make(&c, 8, false, NULL));
    viewer_worker_cancel(worker, 0); /* another slot: nothing happens */
    ck_assert_int_eq(atomic_load(&c.cancelled), 0);
    viewer_worker_cancel(worker, 2);
    wait_until_idle(worker, context);
    ck_assert_int_eq(atomic_load(&c.cancelled), 1);
    ck_assert_int_eq(c.delivered, 1);
    ck_assert_int_eq(c.last, 7);
    ck_assert_int_eq(c.released, 2);
    viewer_worker_destroy(worker);
    g_main_context_unref(context);
}
END_TEST

/* What was computed is not wanted any more before it is delivered. */
START_TEST(what_has_ended_is_cancelled_too) {
    GMainContext *context = g_main_context_new();
    viewer_worker *worker = viewer_worker_create("test", context);
    counts c = {0};
    atomic_bool go = false;
    viewer_worker_submit(worker, 1, make(&c, 1, false, NULL));
    wait_until_runs(&c, 1);
    viewer_worker_submit(worker, 2, make(&c, 2, true, &go));
    wait_until_runs(&c, 2); /* the first one has ended */
    ck_assert_int_eq(viewer_worker_running(worker), 2);
    viewer_worker_cancel(worker, 1);
    atomic_store(&go, true);
    wait_until_idle(worker, context);
    ck_assert_int_eq(viewer_worker_running(worker), -1);
    ck_assert_int_eq(c.delivered, 2);
    ck_assert_int_eq(c.delivered_cancelled, 1);
    viewer_worker_destroy(worker);
    g_main_context_unref(context);
}
END_TEST

/* What was cancelled and has not ended yet is told from what works. */
START_TEST(cancelling_is_seen) {
    GMainContext *context = g_main_context_new();
    viewer_worker *worker = viewer_worker_create("test", context);
    counts c = {0};
    atomic_bool go = false;
    viewer_worker_cancel(worker, 1);
    ck_assert(!viewer_worker_is_cancelling(worker, 1)); /* nothing is there */
    viewer_worker_submit(worker, 1, make_stubborn(&c, &go));
    viewer_worker_submit(worker, 2, make(&c, 1, false, NULL));
    wait_until_runs(&c, 1);
    ck_assert(!viewer_worker_is_cancelling(worker, 1));
    viewer_worker_cancel(worker, 2);
    ck_assert(!viewer_worker_is_cancelling(worker, 2)); /* it only waited */
    viewer_worker_cancel(worker, 1);
    ck_assert(viewer_worker_is_busy(worker, 1) && viewer_worker_is_cancelling(worker, 1));
    viewer_worker_submit(worker, 1, make(&c, 2, false, NULL));
    ck_assert(!viewer_worker_is_cancelling(worker, 1)); /* something else is wanted now */
    viewer_worker_cancel(worker, 1);
    ck_assert(viewer_worker_is_cancelling(worker, 1));
    atomic_store(&go, true);
    wait_until_idle(worker, context);
    ck_assert(!viewer_worker_is_cancelling(worker, 1));
    ck_assert_int_eq(c.released, 3);
    viewer_worker_destroy(worker);
    g_main_context_unref(context);
}
END_TEST

/* What cannot be interrupted does not hold up whoever asks for an end. */
START_TEST(an_end_need_not_be_waited_for) {
    GMainContext *context = g_main_context_new();
    viewer_worker *worker = viewer_worker_create("test", context);
    counts c = {0};
    atomic_bool go = false;
    viewer_worker_submit(worker, 1, make_stubborn(&c, &go));
    viewer_worker_submit(worker, 2, make(&c, 1, false, NULL));
    wait_until_runs(&c, 1);
    viewer_worker_end(worker);
    gint64 began = g_get_monotonic_time();
    ck_assert(!viewer_worker_wait(worker, 0.0));
    ck_assert(!viewer_worker_wait(worker, 0.3));
    double seconds = 1e-6 * (double)(g_get_monotonic_time() - began);
    ck_assert_msg(seconds > 0.29 && seconds < 10.0, "waits for %g s", seconds);
    atomic_store(&go, true);
    ck_assert(viewer_worker_wait(worker, 60.0));
    ck_assert(viewer_worker_wait(worker, 0.0));
    g_main_context_iteration(context, FALSE);
    viewer_worker_destroy(worker);
    ck_assert_int_eq(atomic_load(&c.ran), 1);
    ck_assert_int_eq(c.delivered, 0);
    ck_assert_int_eq(c.released, 2);
    g_main_context_unref(context);
}
END_TEST

/* What is waited for is delivered without the main loop, each job once; no longer than asked for.
 */
START_TEST(settled_jobs_are_delivered_at_once) {
    GMainContext *context = g_main_context_new();
    viewer_worker *worker = viewer_worker_create("test", context);
    counts c = {0};
    atomic_bool go = false;
    viewer_worker_settle(worker, 1, 60.0); /* nothing is there */
    viewer_worker_submit(worker, 1, make(&c, 1, false, NULL));
    viewer_worker_settle(worker, 1, 60.0);
    ck_assert_int_eq(c.delivered, 1);
    ck_assert(!viewer_worker_is_busy(worker, 1));
    viewer_worker_submit(worker, 2, make_stubborn(&c, &go));
    wait_until_runs(&c, 2);
    gint64 began = g_get_monotonic_time();
    viewer_worker_settle(worker, 2, 0.2);
    double seconds = 1e-6 * (double)(g_get_monotonic_time() - began);
    ck_assert_msg(seconds > 0.19 && seconds < 10.0, "waits for %g s", seconds);
    ck_assert_int_eq(c.delivered, 1);
    ck_assert(viewer_worker_is_busy(worker, 2));
    viewer_worker_submit(worker, 3, make(&c, 3, false, NULL));
    atomic_store(&go, true);
    viewer_worker_settle(worker, 3, 60.0);
    ck_assert_int_eq(c.delivered, 3);
    ck_assert_int_eq(c.last, 3);
    ck_assert(!g_main_context_iteration(context, FALSE)); /* nothing is left to deliver */
    viewer_worker_submit(worker, 1, make(&c, 4, false, NULL));
    wait_until_idle(worker, context);
    ck_assert_int_eq(c.delivered, 4);
    ck_assert_int_eq(c.released, 4);
    viewer_worker_destroy(worker);
    g_main_context_unref(context);
}
END_TEST

START_TEST(low_slots_come_first) {
    GMainContext *context = g_main_context_new();
    viewer_worker *worker = viewer_worker_create("test", context);
    counts c = {0};
    atomic_bool go = false;
    viewer_worker_submit(worker, 3, make(&c, 0, true, &go));
    wait_until_runs(&c, 1);
    viewer_worker_submit(worker, 2, make(&c, 2, false, NULL));
    viewer_worker_submit(worker, 1, make(&c, 1, false, NULL));
    atomic_store(&go, true);
    wait_until_idle(worker, context);
    ck_assert_int_eq(c.delivered, 3);
    ck_assert_int_eq(c.last, 2);
    viewer_worker_destroy(worker);
    g_main_context_unref(context);
}
END_TEST

/* Closing while something runs, waits, and waits to be delivered: all is freed, nothing delivered.
 */
START_TEST(end_at_any_time) {
    for (int round = 0; round < 40; ++round) {
        GMainContext *context = g_main_context_new();
        viewer_worker *worker = viewer_worker_create("test", context);
        counts c = {0};
        viewer_worker_submit(worker, 0, make(&c, 0, false, NULL));
        if (round % 3 == 0) {
            wait_until_runs(&c, 1);
        }
        viewer_worker_submit(worker, 1, make(&c, 1, true, NULL));
        viewer_worker_submit(worker, 2, make(&c, 2, true, NULL));
        g_usleep((gulong)(37 * round));
        viewer_worker_destroy(worker);
        ck_assert_int_eq(c.released, 3);
        ck_assert_int_eq(c.delivered, 0);
        g_main_context_iteration(context, FALSE);
        ck_assert_int_eq(c.delivered, 0);
        g_main_context_unref(context);
    }
    viewer_worker_destroy(NULL);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("viewer worker");
    TCase *cases = tcase_create("worker");
    tcase_set_timeout(cases, 120);
    tcase_add_test(cases, newest_request_wins);
    tcase_add_test(cases, cancelled_job_ends_and_is_delivered);
    tcase_add_test(cases, what_has_ended_is_cancelled_too);
    tcase_add_test(cases, cancelling_is_seen);
    tcase_add_test(cases, an_end_need_not_be_waited_for);
    tcase_add_test(cases, settled_jobs_are_delivered_at_once);
    tcase_add_test(cases, low_slots_come_first);
    tcase_add_test(cases, end_at_any_time);
    suite_add_tcase(suite, cases);
    return run_suite(suite);
}
