/* SPDX-License-Identifier: Apache-2.0 */
#include "fit.h"

#include "facing.h"
#include "messages.h"
#include "plate_output.h"
#include "table_fit.h"
#include "text_file.h"

#include <stdio.h>
#include <stdlib.h>

/* Of a window: the plates of the last fit. */
typedef struct keeper {
    srp_plate *plates;
    size_t count;
    char *about;
    _Atomic double began; /* the one that runs; before that, when it was asked for */
} keeper;

typedef struct fit_job {
    viewer_job job;
    viewer *v;
    viewer_table *from;
    unsigned plates;
    _Atomic double *began; /* the keeper's */
    cli_plate_fit fit;
    srp_table *table; /* what the plates give */
    viewer_words problem;
    double seconds;
} fit_job;

static const char CANCELLED[] = "The fit was cancelled.";

static void free_keeper(gpointer user) {
    keeper *k = user;
    free(k->plates);
    free(k->about);
    g_free(k);
}

static keeper *keeper_of(viewer *v) {
    keeper *k = g_object_get_data(G_OBJECT(v->application), "fit");
    if (k == NULL) {
        k = g_new0(keeper, 1);
        g_object_set_data_full(G_OBJECT(v->application), "fit", k, free_keeper);
    }
    return k;
}

static bool goes_on(void *user) {
    fit_job *job = user;
    return !atomic_load(&job->job.cancel);
}

static bool report(void *user, const srp_table *table, size_t done, size_t total) {
    (void)table, (void)done, (void)total;
    return goes_on(user);
}

/* Plates without area are no plates; those that are left come first. */
static size_t wanted_plates(cli_plate_fit *fit) {
    size_t count = 0;
    for (size_t k = 0; k < fit->count; ++k) {
        if (fit->plates[k].area > 0.0) {
            fit->plates[count++] = fit->plates[k];
        }
    }
    return count;
}

static srp_status fill_table(fit_job *job, size_t count, srp_error *error) {
    const srp_table_progress progress = {report, job};
    const srp_table_info *info = srp_table_get_info(job->from->table);
    srp_method_params params = srp_method_params_default();
    srp_scene *scene = NULL;
    srp_prepared *prepared = NULL;
    srp_status status = srp_scene_from_plates(job->fit.plates, count, &scene, error);
    if (status == SRP_OK) {
        status = srp_method_prepare(&srp_method_nplate, scene, &params, &prepared, error);
    }
    if (status == SRP_OK) {
        status =
            srp_table_create(prepared, srp_table_grid(job->from->table), false, &job->table, error);
    }
    if (status == SRP_OK) {
        status =
            srp_table_describe(job->table, "fitted plates", "", info->light, info->mass, error);
    }
    if (status == SRP_OK) {
        status = srp_table_fill(job->table, prepared, &progress, error);
    }
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
    return status;
}

static void fit_run(viewer_job *base) {
    fit_job *job = (fit_job *)base;
    cli_samples samples;
    srp_vec3 normals[CLI_NORMALS_MAX];
    srp_error error;
    const cli_fit_watch watch = {goes_on, job};
    double began = viewer_seconds();
    atomic_store(job->began, began);
    if (!cli_samples_take(job->from->table, srp_table_grid(job->from->table), false, &samples)) {
        viewer_words_add(&job->problem, "no memory for the fit");
        return;
    }
    viewer_words_listen(&job->problem);
    int status =
        cli_table_search(job->from->table, job->from->name, &samples, job->plates, &watch, normals);
    if (status == CLI_DONE) {
        status = cli_table_fit(job->from->name, &samples, job->plates, normals, &watch, &job->fit);
    }
    viewer_words_listen(NULL);
    cli_samples_free(&samples);
    if (status != CLI_DONE) {
        return;
    }
    job->fit.count = wanted_plates(&job->fit);
    if (fill_table(job, job->fit.count, &error) != SRP_OK) {
        viewer_words_add_error(&job->problem, &error);
        srp_table_destroy(job->table);
        job->table = NULL;
    }
    job->seconds = viewer_seconds() - began;
}

static void keep_plates(fit_job *job) {
    keeper *k = keeper_of(job->v);
    srp_plate *copy = calloc(job->fit.count + 1, sizeof *copy);
    if (copy == NULL) {
        return;
    }
    for (size_t i = 0; i < job->fit.count; ++i) {
        copy[i] = job->fit.plates[i];
    }
    free(k->plates);
    free(k->about);
    k->plates = copy;
    k->count = job->fit.count;
    char *about =
        g_strdup_printf("plates fitted to %s by srp-viewer " SRP_VERSION, job->from->name);
    k->about = viewer_text_copy(about);
    g_free(about);
}

static void fit_deliver(viewer_job *base) {
    fit_job *job = (fit_job *)base;
    viewer *v = job->v;
    bool cancelled = atomic_load(&job->job.cancel);
    if (cancelled && viewer_fit_is_running(v)) {
        /* A newer one runs. */
    } else if (cancelled) {
        viewer_say_too(v, CANCELLED);
    } else if (job->table == NULL) {
        viewer_complain_about(v, ABOUT_TABLE, job->problem.text);
    } else {
        char name[256];
        snprintf(name, sizeof name, "%zu: %zu %s fitted to %.150s", v->session->table_count + 1,
                 job->fit.count, cli_form(job->fit.count, "plate", "plates"), job->from->name);
        keep_plates(job);
        viewer_table table = {job->table, viewer_text_copy(name), NULL, NULL, 0};
        job->table = NULL;
        if (viewer_session_add_table(v->session, table)) {
            v->compared[1] = (int)v->session->table_count - 1;
        }
        char said[400];
        snprintf(said, sizeof said, "Table %s, in %.2f s. Save… FILE.plates keeps them.", name,
                 job->seconds);
        viewer_complain_about(v, ABOUT_TABLE, "");
        viewer_say(v, said);
    }
    viewer_tell(v, CHANGED_TABLES | CHANGED_BUSY);
}

static void fit_release(viewer_job *base) {
    fit_job *job = (fit_job *)base;
    cli_plate_fit_free(&job->fit);
    srp_table_destroy(job->table);
    viewer_table_release(job->from);
    free(job);
}

void viewer_fit_request(viewer *v, unsigned plates) {
    if (!cli_plate_fit_exists()) {
        viewer_complain(v, "This program was built without GSL and fits nothing.");
        return;
    }
    if (v->compared[0] < 0) {
        viewer_complain_about(v, ABOUT_TABLE, VIEWER_NO_TABLE);
        return;
    }
    fit_job *job = g_new0(fit_job, 1);
    job->job = (viewer_job){.run = fit_run, .deliver = fit_deliver, .release = fit_release};
    job->v = v;
    job->from = viewer_table_reference(v->session->tables[v->compared[0]]);
    job->plates = plates;
    job->began = &keeper_of(v)->began;
    atomic_store(job->began, viewer_seconds());
    viewer_worker_cancel(v->requests.batch, SLOT_FIT);
    viewer_worker_submit(v->requests.batch, SLOT_FIT, &job->job);
    viewer_tell(v, CHANGED_BUSY);
}

void viewer_fit_cancel(viewer *v) {
    viewer_cancel(v, v->requests.batch, SLOT_FIT, CANCELLED);
}

bool viewer_fit_is_running(const viewer *v) {
    return viewer_worker_is_busy(v->requests.batch, SLOT_FIT);
}

bool viewer_fit_is_cancelling(const viewer *v) {
    return viewer_worker_is_cancelling(v->requests.batch, SLOT_FIT);
}

double viewer_fit_seconds(viewer *v) {
    return viewer_seconds() - atomic_load(&keeper_of(v)->began);
}

bool viewer_fit_save(viewer *v, const char *path, viewer_words *problem) {
    const keeper *k = keeper_of(v);
    cli_text_file file;
    if (k->plates == NULL) {
        viewer_words_add(problem, "No plates have been fitted yet.");
        return false;
    }
    viewer_words_listen(problem);
    int status = cli_text_file_begin(&file, path);
    if (status == CLI_DONE) {
        cli_plates_write(file.out, k->plates, k->count, k->about);
        status = cli_text_file_end(&file);
    }
    viewer_words_listen(NULL);
    return status == CLI_DONE;
}
