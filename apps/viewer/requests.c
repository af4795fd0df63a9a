/* SPDX-License-Identifier: Apache-2.0 */
#include "requests.h"

#include "exchange.h"
#include "loading.h"
#include "numbers.h"
#include "recent.h"
#include "viewer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void viewer_requests_begin(viewer *v) {
    v->requests.live = viewer_worker_create("live", g_main_context_default());
    v->requests.batch = viewer_worker_create("batch", g_main_context_default());
    v->requests.tables = viewer_worker_create("tables", g_main_context_default());
    v->requests.shadows = viewer_worker_create("shadows", g_main_context_default());
    g_queue_init(&v->requests.to_open);
}

static const double END_SECONDS = 1.0; /* to wait for what runs */

bool viewer_requests_end(viewer *v) {
    viewer_worker *const workers[] = {v->requests.live, v->requests.batch, v->requests.tables,
                                      v->requests.shadows};
    const double until = viewer_seconds() + END_SECONDS;
    for (size_t k = 0; k < G_N_ELEMENTS(workers); ++k) {
        viewer_worker_end(workers[k]);
    }
    for (size_t k = 0; k < G_N_ELEMENTS(workers); ++k) {
        if (!viewer_worker_wait(workers[k], fmax(until - viewer_seconds(), 0.0))) {
            return false;
        }
    }
    for (size_t k = 0; k < G_N_ELEMENTS(workers); ++k) {
        viewer_worker_destroy(workers[k]);
    }
    g_queue_clear_full(&v->requests.to_open, free);
    v->requests.live = v->requests.batch = v->requests.tables = v->requests.shadows = NULL;
    return true;
}

bool viewer_requests_busy(const viewer *v) {
    bool busy = false;
    for (unsigned slot = 0; slot < VIEWER_SLOTS; ++slot) {
        busy = busy || viewer_worker_is_busy(v->requests.live, slot) ||
               viewer_worker_is_busy(v->requests.batch, slot) ||
               viewer_worker_is_busy(v->requests.tables, slot);
    }
    return busy;
}

void viewer_cancel(viewer *v, viewer_worker *worker, unsigned slot, const char *said) {
    bool busy = viewer_worker_is_busy(worker, slot);
    viewer_worker_cancel(worker, slot);
    if (busy && !viewer_worker_is_busy(worker, slot)) {
        viewer_say_too(v, said);
    }
    viewer_tell(v, CHANGED_BUSY);
}

const char *viewer_held_up(const viewer *v, unsigned slot, bool cancelling) {
    static const char *const words[] = {[SLOT_TABLE] = "Waiting for the table …",
                                        [SLOT_ORBIT] = "Waiting for the mission …",
                                        [SLOT_FIT] = "Waiting for the fit …",
                                        [SLOT_PROBE] = "Waiting for the measurement …"};
    int running = viewer_worker_running(v->requests.batch);
    bool waits =
        running >= 0 && running != (int)slot && viewer_worker_is_busy(v->requests.batch, slot);
    return cancelling ? "Cancelling …" : waits ? words[running] : NULL;
}

/* ---- engine ---- */

typedef struct engine_job {
    viewer_job job;
    viewer *v;
    viewer_setup *setup;
    viewer_shape *known;
    viewer_words said; /* of `known` */
    bool reload;
    viewer_engine *made;
} engine_job;

static void engine_run(viewer_job *base) {
    engine_job *job = (engine_job *)base;
    job->made = viewer_engine_make(job->setup, job->known, job->reload);
    if (job->made != NULL && job->said.text[0] != '\0') {
        if (job->made->problem.text[0] != '\0') {
            viewer_words_add(&job->said, job->made->problem.text);
        }
        job->made->problem = job->said;
    }
}

static void request_probe(viewer *v);

static void engine_deliver(viewer_job *base) {
    engine_job *job = (engine_job *)base;
    viewer *v = job->v;
    if (job->made == NULL) {
        viewer_complain(v, "no memory for the spacecraft");
        return;
    }
    viewer_session_set_engine(v->session, job->made);
    const viewer_engine *engine = job->made;
    job->made = NULL;
    v->requests.probe = (viewer_probe){.state = PROBE_NONE};
    /* What was said of the engine before counts no more; of one that a newer one follows, nothing
     * is said. */
    bool newest = !viewer_worker_is_busy(v->requests.live, SLOT_ENGINE);
    viewer_complain_of_model(v, newest ? engine->problem.text : "");
    viewer_tell(v, CHANGED_ENGINE | CHANGED_FORCE | CHANGED_ARROWS | CHANGED_PROBE | CHANGED_BUSY);
    if (engine->shape != NULL) {
        viewer_recent_note(v, engine->shape->path);
    }
    if (engine->prepared != NULL) {
        viewer_request_force(v);
        request_probe(v);
    } else {
        viewer_worker_cancel(v->requests.batch, SLOT_PROBE);
    }
    if (newest) {
        viewer_exchange_miss_mtl(v);
        void (*what)(viewer *) = v->requests.after_engine;
        if (what != NULL && !viewer_loading_is_running(v)) {
            v->requests.after_engine = NULL;
            what(v);
        }
    }
}

bool viewer_comes_after_engine(viewer *v, void (*what)(viewer *v)) {
    bool busy =
        viewer_worker_is_busy(v->requests.live, SLOT_ENGINE) || viewer_loading_is_running(v);
    v->requests.after_engine = busy ? what : NULL;
    return busy;
}

void viewer_cancel_after_engine(viewer *v, void (*what)(viewer *v), const char *said) {
    if (v->requests.after_engine == what) {
        v->requests.after_engine = NULL;
        viewer_say_too(v, said);
    }
}

static void engine_release(viewer_job *base) {
    engine_job *job = (engine_job *)base;
    viewer_engine_release(job->made);
    viewer_shape_release(job->known);
    viewer_setup_destroy(job->setup);
    free(job);
}

static void request_engine(viewer *v, viewer_shape *known, const viewer_words *said, bool reload) {
    engine_job *job = g_new0(engine_job, 1);
    job->job =
        (viewer_job){.run = engine_run, .deliver = engine_deliver, .release = engine_release};
    job->v = v;
    job->setup = viewer_setup_copy(v->session->setup);
    job->reload = reload;
    job->known = viewer_shape_reference(known);
    job->said = *said;
    if (job->setup == NULL) {
        engine_release(&job->job);
        viewer_complain(v, "no memory for the spacecraft");
        return;
    }
    v->session->asked_at = viewer_seconds(); /* with the engine */
    viewer_worker_cancel(v->requests.live, SLOT_FORCE);
    viewer_worker_submit(v->requests.live, SLOT_ENGINE, &job->job);
    viewer_tell(v, CHANGED_BUSY);
}

void viewer_request_engine(viewer *v, bool reload) {
    const viewer_engine *engine = v->session->engine;
    const viewer_words nothing = {""};
    request_engine(v, engine != NULL ? engine->shape : NULL, &nothing, reload);
}

void viewer_request_engine_of(viewer *v, viewer_shape *shape, const viewer_words *said) {
    request_engine(v, shape, said, false);
}

/* ---- force ---- */

typedef struct force_job {
    viewer_job job;
    viewer *v;
    viewer_engine *engine;
    double az_deg, el_deg, asked_at;
    bool good;
    viewer_force force;
    viewer_words problem;
} force_job;

static void force_run(viewer_job *base) {
    force_job *job = (force_job *)base;
    job->good =
        viewer_engine_respond(job->engine, job->az_deg, job->el_deg, &job->force, &job->problem);
}

static void force_deliver(viewer_job *base) {
    force_job *job = (force_job *)base;
    viewer *v = job->v;
    if (job->engine != v->session->engine) {
        return; /* of a method that was */
    }
    if (!job->good) {
        viewer_complain_of_model(v, job->problem.text);
        return;
    }
    job->force.asked_at = job->asked_at;
    if (!viewer_session_set_force(v->session, &job->force)) {
        viewer_complain(v, "no memory for the arrow");
    }
    v->asked_at = job->asked_at;
    viewer_tell(v, CHANGED_FORCE | (v->session->recording ? CHANGED_ARROWS : 0));
}

static void force_release(viewer_job *base) {
    force_job *job = (force_job *)base;
    viewer_engine_release(job->engine);
    free(job);
}

bool viewer_force_is_quick(const viewer *v, double seconds) {
    const viewer_session *s = v->session;
    return s->force_known && s->force.seconds < seconds &&
           viewer_worker_is_busy(v->requests.live, SLOT_FORCE);
}

void viewer_settle_force(viewer *v, double seconds) {
    if (v->requests.live != NULL && viewer_force_is_quick(v, seconds)) {
        viewer_worker_settle(v->requests.live, SLOT_FORCE, seconds);
    }
}

void viewer_request_force(viewer *v) {
    viewer_engine *engine = v->session->engine;
    v->session->asked_at = viewer_seconds();
    if (engine == NULL || engine->prepared == NULL ||
        viewer_worker_is_busy(v->requests.live, SLOT_ENGINE)) {
        return; /* asked for when the engine is there */
    }
    force_job *job = g_new0(force_job, 1);
    job->job = (viewer_job){.run = force_run, .deliver = force_deliver, .release = force_release};
    job->v = v;
    job->engine = viewer_engine_reference(engine);
    job->asked_at = v->session->asked_at;
    viewer_attitude_sun(&v->session->attitude, &job->az_deg, &job->el_deg);
    viewer_worker_submit(v->requests.live, SLOT_FORCE, &job->job);
}

/* ---- probe ---- */

enum { PROBE_DIRECTIONS = 12 };
static const double PROBE_SECONDS = 0.6;

typedef struct probe_job {
    viewer_job job;
    viewer *v;
    viewer_engine *engine;
    viewer_probe found;
} probe_job;

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The method exact on the same mesh, where it tells how far off the probed method is: not for
 * itself, and not for light that is followed further than it does. */
static srp_prepared *truth_of(const viewer_engine *engine) {
    const srp_method *method = engine->method;
    srp_prepared *truth = NULL;
    srp_error error;
    if (engine->mesh == NULL || !engine->optics_known || method == &srp_method_exact ||
        (method->capabilities & SRP_METHOD_BOUNCE) != 0 ||
        srp_method_prepare(&srp_method_exact, engine->mesh, &engine->params, &truth, &error) !=
            SRP_OK) {
        return NULL;
    }
    return truth;
}

static double error_of(const viewer_force *force, const srp_prepared *truth) {
    const srp_response *r = &force->response;
    srp_response exact;
    if (truth == NULL) {
        return r->f_error / srp_vec3_norm(r->f);
    }
    if (srp_prepared_respond(truth, 1, &force->s, &exact, NULL, NULL) != SRP_OK) {
        return NAN;
    }
    return srp_vec3_norm(srp_vec3_sub(r->f, exact.f)) / srp_vec3_norm(exact.f);
}

static void probe_run(viewer_job *base) {
    probe_job *job = (probe_job *)base;
    double seconds[PROBE_DIRECTIONS], began = viewer_seconds(), worst = NAN;
    size_t n = 0;
    viewer_words problem = {""};
    srp_prepared *truth = truth_of(job->engine);
    while (n < PROBE_DIRECTIONS && !atomic_load(&job->job.cancel) &&
           (n == 0 || viewer_seconds() - began < PROBE_SECONDS)) {
        /* Off the axes, where every spacecraft shows several of its sides. */
        double az = -163.7 + 137.508 * (double)n;
        double el = 61.3 - 10.9 * (double)n;
        viewer_force force;
        if (!viewer_engine_respond(job->engine, fmod(az, 360.0), el, &force, &problem)) {
            break;
        }
        seconds[n++] = force.seconds;
        worst = fmax(worst, error_of(&force, truth));
    }
    srp_prepared_release(truth);
    if (n > 0) {
        qsort(seconds, n, sizeof *seconds, by_size);
        bool from_plates = truth == NULL && (job->engine->method->shapes & SRP_SHAPE_MESH) == 0;
        job->found =
            (viewer_probe){PROBE_KNOWN, seconds[n / 2], from_plates ? NAN : worst, truth != NULL};
    }
}

static void probe_deliver(viewer_job *base) {
    probe_job *job = (probe_job *)base;
    if (job->engine == job->v->session->engine) {
        job->v->requests.probe = job->found;
        viewer_tell(job->v, CHANGED_PROBE);
    }
}

static void probe_release(viewer_job *base) {
    probe_job *job = (probe_job *)base;
    viewer_engine_release(job->engine);
    free(job);
}

static void request_probe(viewer *v) {
    probe_job *job = g_new0(probe_job, 1);
    job->job = (viewer_job){.run = probe_run, .deliver = probe_deliver, .release = probe_release};
    job->v = v;
    job->engine = viewer_engine_reference(v->session->engine);
    viewer_worker_cancel(v->requests.batch, SLOT_PROBE);
    viewer_worker_submit(v->requests.batch, SLOT_PROBE, &job->job);
    v->requests.probe.state = PROBE_RUNS;
    viewer_tell(v, CHANGED_PROBE);
}

/* ---- tables ---- */

typedef struct table_job {
    viewer_job job;
    viewer *v;
    viewer_engine *engine;
    srp_grid grid;
    double mass;
    char *title, *command;
    srp_table *table;
    double seconds;
    srp_status status;
    srp_error error;
} table_job;

static const char TABLE_CANCELLED[] = "The table was cancelled.";

static bool report(void *user, const srp_table *table, size_t done, size_t total) {
    table_job *job = user;
    (void)table;
    atomic_store(&job->v->requests.table.done, done);
    atomic_store(&job->v->requests.table.total, total);
    return !atomic_load(&job->job.cancel);
}

static void table_run(viewer_job *base) {
    table_job *job = (table_job *)base;
    const viewer_engine *engine = job->engine;
    const srp_table_progress progress = {report, job};
    bool basis = (engine->method->capabilities & SRP_METHOD_BASIS) != 0;
    double began = viewer_seconds();
    atomic_store(&job->v->requests.table.began, began);
    job->status = srp_table_create(engine->prepared, job->grid, basis, &job->table, &job->error);
    if (job->status == SRP_OK) {
        job->status = srp_table_describe(job->table, job->title, job->command, engine->setup->light,
                                         job->mass, &job->error);
    }
    if (job->status == SRP_OK) {
        job->status = srp_table_fill(job->table, engine->prepared, &progress, &job->error);
    }
    job->seconds = viewer_seconds() - began;
}

static void table_deliver(viewer_job *base) {
    table_job *job = (table_job *)base;
    viewer *v = job->v;
    if (job->status == SRP_CANCELLED && viewer_worker_is_busy(v->requests.batch, SLOT_TABLE)) {
        /* A newer one is computed. */
    } else if (job->status == SRP_CANCELLED) {
        viewer_say_too(v, TABLE_CANCELLED);
    } else if (job->status != SRP_OK) {
        viewer_complain_about(v, ABOUT_TABLE, job->error.message);
    } else {
        char summary[320], name[350];
        viewer_table_summary(job->table, job->engine->setup, summary, sizeof summary);
        snprintf(name, sizeof name, "%zu: %s", v->session->table_count + 1, summary);
        viewer_table table = {job->table, viewer_text_copy(name), job->command, NULL, 0};
        job->table = NULL;
        job->command = NULL;
        if (viewer_session_add_table(v->session, table)) {
            v->table_shown = (int)v->session->table_count - 1;
        }
        char said[400];
        snprintf(said, sizeof said, "Table %s: computed in %.2f s.", name, job->seconds);
        viewer_complain_about(v, ABOUT_TABLE, "");
        viewer_say(v, said);
    }
    viewer_tell(v, CHANGED_TABLES | CHANGED_BUSY);
}

static void table_release(viewer_job *base) {
    table_job *job = (table_job *)base;
    srp_table_destroy(job->table);
    viewer_engine_release(job->engine);
    free(job->title);
    free(job->command);
    free(job);
}

/* What the title of a table is by default: names without directories. */
static char *title_of(const viewer_setup *setup, const srp_method *method) {
    const char *path = (method->shapes & SRP_SHAPE_MESH) != 0 ? setup->model
                       : (method->shapes & SRP_SHAPE_PLATES) != 0
                           ? setup->model_option[MODEL_PLATES]
                           : NULL;
    if (path == NULL) {
        return viewer_text_copy(method->name);
    }
    char *base = g_path_get_basename(path);
    char *title = g_utf8_make_valid(base, -1);
    char *copy = viewer_text_copy(title);
    g_free(base);
    g_free(title);
    return copy;
}

static char *command_of(const viewer *v) {
    char az[CLI_NUMBER_SIZE], el[CLI_NUMBER_SIZE], kg[CLI_NUMBER_SIZE];
    char output[] = "-o", file[] = "table.nc", az_step[] = "--az-step", el_step[] = "--el-step",
         mass[] = "--mass";
    cli_write_number(v->az_step_deg, az);
    cli_write_number(v->el_step_deg, el);
    char *const extra[] = {az_step, az, el_step, el, output, file, mass, kg};
    bool massive = !isnan(v->session->setup->mass);
    cli_write_number(v->session->setup->mass, kg);
    return viewer_setup_command(v->session->engine->setup, "table", extra, massive ? 8 : 6);
}

bool viewer_check_engine(viewer *v) {
    const viewer_engine *engine = v->session->engine;
    if (engine != NULL && engine->prepared != NULL) {
        return true;
    }
    viewer_complain_of_model(v, engine != NULL && engine->problem.text[0] != '\0'
                                    ? engine->problem.text
                                    : VIEWER_NO_SPACECRAFT);
    return false;
}

void viewer_request_table(viewer *v) {
    viewer_engine *engine = v->session->engine;
    srp_grid grid;
    srp_error error;
    if (viewer_comes_after_engine(v, viewer_request_table) || !viewer_check_engine(v)) {
        return;
    }
    if (srp_grid_from_steps(v->az_step_deg, v->el_step_deg, &grid, &error) != SRP_OK) {
        viewer_complain_about(v, ABOUT_TABLE, error.message);
        return;
    }
    table_job *job = g_new0(table_job, 1);
    job->job = (viewer_job){.run = table_run, .deliver = table_deliver, .release = table_release};
    job->v = v;
    job->engine = viewer_engine_reference(engine);
    job->grid = grid;
    job->mass = v->session->setup->mass;
    job->title = title_of(engine->setup, engine->method);
    job->command = command_of(v);
    atomic_store(&v->requests.table.done, 0);
    atomic_store(&v->requests.table.total, 0);
    atomic_store(&v->requests.table.began, viewer_seconds());
    viewer_worker_cancel(v->requests.batch, SLOT_TABLE);
    viewer_worker_submit(v->requests.batch, SLOT_TABLE, &job->job);
    viewer_tell(v, CHANGED_BUSY);
}

void viewer_cancel_table(viewer *v) {
    viewer_cancel_after_engine(v, viewer_request_table, TABLE_CANCELLED);
    viewer_cancel(v, v->requests.batch, SLOT_TABLE, TABLE_CANCELLED);
}

bool viewer_table_is_cancelling(const viewer *v) {
    return viewer_worker_is_cancelling(v->requests.batch, SLOT_TABLE);
}
