/* SPDX-License-Identifier: Apache-2.0 */
#include "reoptic.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct reoptic_job {
    viewer_job job;
    viewer *v;
    viewer_table *from;
    viewer_engine *engine; /* whose optics count */
    char *command;
    srp_table *made;
    srp_status status;
    srp_error error;
} reoptic_job;

static const char CANCELLED[] = "The re-optic was cancelled.";

/* `srp reoptic ...` with the optics of the whole mesh. */
static char *command_of(const viewer_engine *engine) {
    viewer_setup *said = viewer_setup_create();
    viewer_words problem = {""};
    char *command = NULL;
    bool good = said != NULL;
    for (size_t i = 0; good && i < srp_scene_material_count(engine->mesh); ++i) {
        good = viewer_setup_set_material(said, srp_scene_material_name(engine->mesh, i),
                                         srp_scene_material_optics(engine->mesh, i), &problem);
    }
    if (good) {
        char input[] = "table.nc", option[] = "-o", output[] = "other.nc";
        char *const extra[] = {input, option, output};
        command = viewer_setup_command(said, "reoptic", extra, 3);
    }
    viewer_setup_destroy(said);
    return command;
}

static void reoptic_run(viewer_job *base) {
    reoptic_job *job = (reoptic_job *)base;
    const srp_table_info *info = srp_table_get_info(job->from->table);
    job->command = command_of(job->engine);
    job->status = viewer_table_reoptic(job->from, job->engine, &job->made, &job->error);
    if (job->status == SRP_OK) {
        job->status =
            srp_table_describe(job->made, info->title, job->command != NULL ? job->command : "",
                               info->light, info->mass, &job->error);
    }
}

/* In words that know of no command line. */
static void refuse(const reoptic_job *job) {
    const srp_table_info *info = srp_table_get_info(job->from->table);
    const char *why = job->error.message;
    if (job->status == SRP_UNSUPPORTED && !info->has_basis) {
        why = "the table keeps no sums per material";
    } else if (job->status == SRP_UNSUPPORTED && info->has_bounce && info->params.reflections > 0) {
        why = "it holds light that was reflected before, which does not follow the optics simply";
    }
    char *said = g_strdup_printf("Table %s cannot be given other optics: %s. Compute it again.",
                                 job->from->name, why);
    viewer_complain_about(job->v, ABOUT_TABLE, said);
    g_free(said);
}

static void reoptic_deliver(viewer_job *base) {
    reoptic_job *job = (reoptic_job *)base;
    viewer *v = job->v;
    viewer_tell(v, CHANGED_BUSY);
    if (atomic_load(&job->job.cancel)) {
        viewer_say_too(v, CANCELLED);
        return;
    }
    if (job->status != SRP_OK) {
        refuse(job);
        return;
    }
    char summary[320];
    viewer_table_summary(job->made, NULL, summary, sizeof summary);
    char *name = g_strdup_printf("%zu: %s, re-optic of %.*s", v->session->table_count + 1, summary,
                                 (int)strcspn(job->from->name, ":"), job->from->name);
    viewer_table table = {job->made, viewer_text_copy(name), job->command, NULL, 0};
    job->made = NULL;
    job->command = NULL;
    if (viewer_session_add_table(v->session, table)) {
        v->table_shown = (int)v->session->table_count - 1;
    }
    char *said = g_strdup_printf("Table %s: direct light by its sums, nothing traced.", name);
    viewer_complain_about(v, ABOUT_TABLE, "");
    viewer_say(v, said);
    g_free(said);
    g_free(name);
    viewer_tell(v, CHANGED_TABLES);
}

static void reoptic_release(viewer_job *base) {
    reoptic_job *job = (reoptic_job *)base;
    srp_table_destroy(job->made);
    viewer_table_release(job->from);
    viewer_engine_release(job->engine);
    free(job->command);
    free(job);
}

void viewer_reoptic_request(viewer *v) {
    int at = v->table_shown;
    if (viewer_comes_after_engine(v, viewer_reoptic_request)) {
        return;
    }
    if (at < 0) {
        viewer_complain_about(v, ABOUT_TABLE, VIEWER_NO_TABLE);
        return;
    }
    if (!viewer_session_table_is_old(v->session, (size_t)at)) {
        viewer_complain_about(v, ABOUT_TABLE,
                              "This table is not of other optics of the spacecraft shown.");
        return;
    }
    reoptic_job *job = g_new0(reoptic_job, 1);
    job->job =
        (viewer_job){.run = reoptic_run, .deliver = reoptic_deliver, .release = reoptic_release};
    job->v = v;
    job->from = viewer_table_reference(v->session->tables[at]);
    job->engine = viewer_engine_reference(v->session->engine);
    viewer_worker_submit(v->requests.tables, SLOT_REOPTIC, &job->job);
    viewer_tell(v, CHANGED_BUSY);
}

void viewer_reoptic_cancel(viewer *v) {
    viewer_cancel_after_engine(v, viewer_reoptic_request, CANCELLED);
    viewer_cancel(v, v->requests.tables, SLOT_REOPTIC, CANCELLED);
}
