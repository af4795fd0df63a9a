/* SPDX-License-Identifier: Apache-2.0 */
#include "opening.h"

#include "table_input.h"

#include <stdio.h>
#include <stdlib.h>

typedef struct opening_job {
    viewer_job job;
    viewer *v;
    char *path;
    srp_table *table;
    char summary[320];
    viewer_words problem;
} opening_job;

static void opening_run(viewer_job *base) {
    opening_job *job = (opening_job *)base;
    viewer_words_listen(&job->problem);
    if (cli_table_open_checked(job->path, &job->table) == CLI_DONE) {
        viewer_table_summary(job->table, NULL, job->summary, sizeof job->summary);
    }
    viewer_words_listen(NULL);
}

static void add_table(opening_job *job) {
    viewer *v = job->v;
    char name[450];
    char *base = g_path_get_basename(job->path);
    size_t number = v->session->table_count + 1;
    snprintf(name, sizeof name, "%zu: %.100s (%s)", number, base, job->summary);
    viewer_table entry = {job->table, viewer_text_copy(name), NULL, job->path, 0};
    job->table = NULL;
    job->path = NULL;
    if (viewer_session_add_table(v->session, entry)) {
        v->table_shown = (int)v->session->table_count - 1;
    }
    if (v->requests.not_opened.text[0] == '\0') {
        viewer_complain_about(v, ABOUT_OPENING, "");
    }
    viewer_complain_about(v, ABOUT_TABLE, "");
    char *said = g_strdup_printf("Table %zu: %s opened.", number, base);
    viewer_say(v, said);
    g_free(said);
    g_free(base);
    int tab = gtk_notebook_get_current_page(v->tabs);
    if (tab == TAB_COMPARE && v->compared[0] >= 0) {
        v->compared[1] = v->table_shown;
    }
    if (tab != TAB_GRAPHICS && tab != TAB_COMPARE) {
        gtk_notebook_set_current_page(v->tabs, TAB_GRAPHICS); /* where it is seen */
    }
}

static void read_next(viewer *v);

static void opening_deliver(viewer_job *base) {
    opening_job *job = (opening_job *)base;
    viewer *v = job->v;
    read_next(v);
    if (atomic_load(&job->job.cancel)) {
        viewer_tell(v, CHANGED_BUSY);
        return;
    }
    if (job->table != NULL) {
        add_table(job);
    } else {
        /* Of each of those that were asked for together. */
        viewer_words_add(&v->requests.not_opened, job->problem.text);
        viewer_complain_about(v, ABOUT_OPENING, v->requests.not_opened.text);
    }
    viewer_tell(v, CHANGED_TABLES | CHANGED_BUSY);
}

static void opening_release(viewer_job *base) {
    opening_job *job = (opening_job *)base;
    srp_table_destroy(job->table);
    free(job->path);
    free(job);
}

static void read_next(viewer *v) {
    char *path = g_queue_pop_head(&v->requests.to_open);
    if (path == NULL) {
        return;
    }
    opening_job *job = g_new0(opening_job, 1);
    job->job =
        (viewer_job){.run = opening_run, .deliver = opening_deliver, .release = opening_release};
    job->v = v;
    job->path = path;
    viewer_worker_submit(v->requests.tables, SLOT_OPENING, &job->job);
}

void viewer_opening_add(viewer *v, const char *path) {
    char *copy = viewer_text_copy(path);
    if (copy == NULL) {
        viewer_complain(v, "no memory for the table");
        return;
    }
    g_queue_push_tail(&v->requests.to_open, copy);
    if (!viewer_opening_is_running(v)) {
        v->requests.not_opened = (viewer_words){""};
        read_next(v);
    }
    viewer_tell(v, CHANGED_BUSY);
}

void viewer_opening_cancel(viewer *v) {
    g_queue_clear_full(&v->requests.to_open, free);
    viewer_worker_cancel(v->requests.tables, SLOT_OPENING);
    viewer_tell(v, CHANGED_BUSY);
}

bool viewer_opening_is_running(const viewer *v) {
    return viewer_worker_is_busy(v->requests.tables, SLOT_OPENING);
}
