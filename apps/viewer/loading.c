/* SPDX-License-Identifier: Apache-2.0 */
#include "loading.h"

#include <string.h>

typedef struct loading_job {
    viewer_job job;
    viewer *v;
    viewer_setup *setup; /* as it was when this was asked for, but for the model */
    viewer_shape *shape;
    viewer_words said; /* warnings, or why there is no shape */
} loading_job;

static void loading_run(viewer_job *base) {
    loading_job *job = (loading_job *)base;
    job->shape = viewer_shape_read(job->setup, &job->said);
}

static void loading_deliver(viewer_job *base) {
    loading_job *job = (loading_job *)base;
    viewer *v = job->v;
    viewer_tell(v, CHANGED_BUSY);
    if (atomic_load(&job->job.cancel) || viewer_loading_is_running(v)) {
        return; /* another one was asked for, or none */
    }
    if (job->shape == NULL) {
        v->requests.after_engine = NULL;
        viewer_complain_about(v, ABOUT_LOADING, job->said.text);
        return;
    }
    viewer_complain_about(v, ABOUT_LOADING, "");
    viewer_setup_clear_materials(v->session->setup);
    if (v->session->setup->model != NULL) {
        viewer_setup_forget_spacecraft(v->session->setup, job->setup);
    }
    if (!viewer_setup_set_model(v->session->setup, job->shape->path)) {
        viewer_complain(v, "no memory for the spacecraft");
        return;
    }
    viewer_tell(v, CHANGED_SETUP);
    viewer_request_engine_of(v, job->shape, &job->said);
}

static void loading_release(viewer_job *base) {
    loading_job *job = (loading_job *)base;
    viewer_shape_release(job->shape);
    viewer_setup_destroy(job->setup);
    g_free(job);
}

void viewer_loading_open(viewer *v, const char *path) {
    const char *model = v->session->setup->model;
    /* A name that means the same wherever the program is started next. */
    char *full = g_canonicalize_filename(path, NULL);
    viewer_worker_cancel(v->requests.tables, SLOT_MODEL);
    if (model != NULL && strcmp(model, full) == 0) {
        viewer_request_engine(v, true);
    } else {
        loading_job *job = g_new0(loading_job, 1);
        job->job = (viewer_job){
            .run = loading_run, .deliver = loading_deliver, .release = loading_release};
        job->v = v;
        job->setup = viewer_setup_copy(v->session->setup);
        if (job->setup != NULL && viewer_setup_set_model(job->setup, full)) {
            viewer_worker_submit(v->requests.tables, SLOT_MODEL, &job->job);
        } else {
            loading_release(&job->job);
            viewer_complain(v, "no memory for the spacecraft");
        }
    }
    viewer_tell(v, CHANGED_BUSY);
    g_free(full);
}

void viewer_loading_cancel(viewer *v) {
    viewer_worker_cancel(v->requests.tables, SLOT_MODEL);
    viewer_tell(v, CHANGED_BUSY);
}

bool viewer_loading_is_running(const viewer *v) {
    return viewer_worker_is_busy(v->requests.tables, SLOT_MODEL);
}
