/* SPDX-License-Identifier: Apache-2.0 */
#include "command.h"
#include "orbit.h"
#include "text_file.h"
#include "track.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char NO_MISSION[] = "There is no mission yet: open one.";

/* Of a window. */
typedef struct keeper {
    viewer_orbit orbit;
    atomic_int permille;
    unsigned choice; /* counts choices: what runs may be of an old one */
    bool run_waits;  /* for missions that are being read */
} keeper;

static void free_rows(viewer_orbit *orbit) {
    free(orbit->t);
    for (int k = 0; k < 4; ++k) {
        free(orbit->value[k]);
        orbit->value[k] = NULL;
    }
    orbit->t = NULL;
    orbit->count = 0;
}

static void free_result(viewer_orbit *orbit) {
    free_rows(orbit);
    for (int k = 0; k < 2; ++k) {
        free(orbit->name[k]);
        orbit->name[k] = NULL;
    }
}

static void free_keeper(gpointer user) {
    keeper *k = user;
    free_result(&k->orbit);
    free(k->orbit.path[0]);
    free(k->orbit.path[1]);
    g_free(k);
}

static keeper *keeper_of(viewer *v) {
    keeper *k = g_object_get_data(G_OBJECT(v->application), "orbit");
    if (k == NULL) {
        k = g_new0(keeper, 1);
        g_object_set_data_full(G_OBJECT(v->application), "orbit", k, free_keeper);
    }
    return k;
}

const viewer_orbit *viewer_orbit_get(viewer *v) {
    return &keeper_of(v)->orbit;
}

double viewer_orbit_progress(viewer *v) {
    return 1e-3 * atomic_load(&keeper_of(v)->permille);
}

static bool is_reading(const viewer *v) {
    return viewer_worker_is_busy(v->requests.tables, SLOT_MISSION) ||
           viewer_worker_is_busy(v->requests.tables, SLOT_VERSUS);
}

bool viewer_orbit_is_running(const viewer *v) {
    return viewer_worker_is_busy(v->requests.batch, SLOT_ORBIT) || is_reading(v);
}

bool viewer_orbit_is_cancelling(const viewer *v) {
    return viewer_worker_is_cancelling(v->requests.batch, SLOT_ORBIT) ||
           viewer_worker_is_cancelling(v->requests.tables, SLOT_MISSION) ||
           viewer_worker_is_cancelling(v->requests.tables, SLOT_VERSUS);
}

/* ---- the choice ---- */

typedef struct read_job {
    viewer_job job;
    viewer *v;
    int which;
    char *path, *name;
    viewer_words problem; /* or, of a mission that can be run, its warnings */
    bool good;
} read_job;

static char *name_of(const char *path, const char *model) {
    char *base = g_path_get_basename(path), *valid = g_utf8_make_valid(base, -1);
    char *name = g_strdup_printf("%s (%s)", valid, model), *copy = viewer_text_copy(name);
    g_free(name);
    g_free(valid);
    g_free(base);
    return copy;
}

static void read_run(viewer_job *base) {
    read_job *job = (read_job *)base;
    srp_mission *mission = NULL;
    srp_error error;
    viewer_words_listen(&job->problem);
    job->good = cli_mission_read(job->path, &mission, &error) == SRP_OK;
    if (job->good) {
        job->name = name_of(job->path, srp_mission_get_info(mission)->model);
    } else {
        viewer_words_add_error(&job->problem, &error);
    }
    srp_mission_destroy(mission);
    viewer_words_listen(NULL);
}

/* Takes over both texts; NULL: none. */
static void choose(viewer *v, int which, char *path, char *name) {
    keeper *k = keeper_of(v);
    viewer_worker_cancel(v->requests.batch, SLOT_ORBIT);
    free_rows(&k->orbit);
    free(k->orbit.path[which]);
    free(k->orbit.name[which]);
    k->orbit.path[which] = path;
    k->orbit.name[which] = name;
    ++k->choice;
    viewer_complain_about(v, ABOUT_MISSION, ""); /* of the last choice */
    viewer_forget_news(v);
}

static void run_when_read(viewer *v) {
    keeper *k = keeper_of(v);
    if (k->run_waits && !is_reading(v)) {
        k->run_waits = false;
        viewer_orbit_run(v);
    }
}

static void read_deliver(viewer_job *base) {
    read_job *job = (read_job *)base;
    viewer *v = job->v;
    if (atomic_load(&job->job.cancel)) {
        /* Another one was asked for, or none. */
    } else if (!job->good) {
        keeper_of(v)->run_waits = false;
        viewer_complain_about(v, ABOUT_MISSION, job->problem.text);
    } else {
        choose(v, job->which, job->path, job->name);
        job->path = job->name = NULL;
        if (job->problem.text[0] != '\0') {
            viewer_say(v, job->problem.text);
        }
    }
    viewer_tell(v, CHANGED_ORBIT | CHANGED_BUSY);
    run_when_read(v);
}

static void read_release(viewer_job *base) {
    read_job *job = (read_job *)base;
    free(job->path);
    free(job->name);
    free(job);
}

void viewer_orbit_open(viewer *v, int which, const char *path) {
    const unsigned slot = which == 0 ? SLOT_MISSION : SLOT_VERSUS;
    viewer_worker_cancel(v->requests.tables, slot);
    if (path[0] != '\0') {
        read_job *job = g_new0(read_job, 1);
        job->job = (viewer_job){.run = read_run, .deliver = read_deliver, .release = read_release};
        job->v = v;
        job->which = which;
        job->path = viewer_text_copy(path);
        atomic_store(&keeper_of(v)->permille, 0);
        viewer_worker_submit(v->requests.tables, slot, &job->job);
    } else if (keeper_of(v)->orbit.path[which] != NULL) {
        choose(v, which, NULL, NULL);
    }
    viewer_tell(v, CHANGED_ORBIT | CHANGED_BUSY);
    run_when_read(v);
}

/* ---- the run ---- */

typedef struct orbit_job {
    viewer_job job;
    viewer *v;
    atomic_int *permille;
    unsigned choice;  /* the keeper's, when this was asked for */
    int part, parts;  /* which mission runs, of how many */
    cli_track *track; /* of that mission */
    char *path[2];
    viewer_orbit made;
    viewer_words problem; /* or, of a run that went well, its warnings */
    bool good, cancelled;
} orbit_job;

static srp_status on_row(void *user, const srp_mission *mission, const srp_mission_row *row,
                         srp_error *error) {
    orbit_job *job = user;
    (void)mission;
    return cli_track_add(job->track, row, error);
}

static bool on_progress(void *user, double done) {
    orbit_job *job = user;
    atomic_store(job->permille, (int)(1e3 * (job->part + done) / job->parts));
    return !atomic_load(&job->job.cancel);
}

static bool run_one(orbit_job *job, const srp_mission *mission, cli_track *track,
                    srp_mission_summary *summary) {
    const srp_mission_watch watch = {.row = on_row, .progress = on_progress, .user = job};
    srp_error error;
    job->track = track;
    srp_status status = srp_mission_run(mission, &watch, summary, &error);
    job->cancelled = status == SRP_CANCELLED;
    if (status != SRP_OK && !job->cancelled) {
        viewer_words_add_error(&job->problem, &error);
    }
    job->made.name[job->part] = name_of(job->path[job->part], srp_mission_get_info(mission)->model);
    ++job->part;
    return status == SRP_OK;
}

/* Turns tracks into what is shown. */
static bool make_values(orbit_job *job, cli_track track[2]) {
    viewer_orbit *made = &job->made;
    made->is_difference = made->is_identical = job->parts == 2;
    made->count = track[0].count;
    made->t = calloc(made->count + 1, sizeof *made->t);
    bool good = made->t != NULL;
    for (int k = 0; k < 4 && good; ++k) {
        made->value[k] = calloc(made->count + 1, sizeof *made->value[k]);
        good = made->value[k] != NULL;
    }
    for (size_t i = 0; good && i < made->count; ++i) {
        srp_vec3 d =
            made->is_difference ? cli_track_difference(&track[0], &track[1], i) : track[0].r[i];
        made->t[i] = track[0].t[i];
        made->value[0][i] = d.x;
        made->value[1][i] = d.y;
        made->value[2][i] = d.z;
        made->value[3][i] =
            made->is_difference ? cli_track_distance(&track[0], &track[1], i) : srp_vec3_norm(d);
        made->is_identical = made->is_identical && made->value[3][i] == 0.0;
    }
    return good;
}

static void sum_up(viewer_orbit *made, const srp_mission_summary *s) {
    snprintf(made->summary, sizeof made->summary,
             "%llu steps, %llu calls of the forces; impulse of sunlight %.6g m/s; %zu penumbras "
             "(%.1f s), %zu umbras (%.1f s)",
             (unsigned long long)s->counts.steps, (unsigned long long)s->counts.calls, s->impulse,
             s->penumbras, s->in_penumbra, s->umbras, s->in_umbra);
}

static const char CANCELLED[] = "The mission was cancelled.";

static void orbit_run(viewer_job *base) {
    orbit_job *job = (orbit_job *)base;
    srp_mission *mission[2] = {NULL, NULL};
    cli_track track[2] = {{.count = 0}, {.count = 0}};
    srp_mission_summary summary, other;
    srp_error error;
    double began = viewer_seconds();
    bool good = true;
    viewer_words_listen(&job->problem);
    for (int k = 0; k < job->parts && good; ++k) {
        good = cli_mission_read(job->path[k], &mission[k], &error) == SRP_OK;
        if (!good) {
            viewer_words_add_error(&job->problem, &error);
        }
    }
    good = good && (job->parts == 1 || cli_missions_check_pair(mission[0], mission[1]) == CLI_DONE);
    viewer_words_listen(NULL);
    good = good && run_one(job, mission[0], &track[0], &summary);
    good = good && (job->parts == 1 || run_one(job, mission[1], &track[1], &other));
    if (good && !make_values(job, track)) {
        viewer_words_add(&job->problem, "no memory for the rows");
        good = false;
    }
    if (good) {
        sum_up(&job->made, &summary);
        job->made.seconds = viewer_seconds() - began;
    }
    job->good = good;
    for (int k = 0; k < 2; ++k) {
        cli_track_free(&track[k]);
        srp_mission_destroy(mission[k]);
    }
}

static void orbit_deliver(viewer_job *base) {
    orbit_job *job = (orbit_job *)base;
    viewer *v = job->v;
    viewer_orbit *orbit = &keeper_of(v)->orbit;
    if (viewer_worker_is_busy(v->requests.batch, SLOT_ORBIT)) {
        /* A newer one runs. */
    } else if (job->cancelled || job->choice != keeper_of(v)->choice) {
        viewer_say_too(v, CANCELLED);
    } else if (!job->good) {
        free_rows(orbit);
        viewer_complain_about(v, ABOUT_MISSION, job->problem.text);
    } else {
        viewer_complain_about(v, ABOUT_MISSION, "");
        free_result(orbit);
        job->made.path[0] = orbit->path[0];
        job->made.path[1] = orbit->path[1];
        *orbit = job->made;
        job->made = (viewer_orbit){.count = 0};
        const char *warnings = job->problem.text;
        char *said = g_strdup_printf("The mission ran in %.2f s.%s%s", orbit->seconds,
                                     warnings[0] != '\0' ? "\n" : "", warnings);
        viewer_say(v, said);
        g_free(said);
    }
    viewer_tell(v, CHANGED_ORBIT | CHANGED_BUSY);
}

static void orbit_release(viewer_job *base) {
    orbit_job *job = (orbit_job *)base;
    free_result(&job->made);
    free(job->path[0]);
    free(job->path[1]);
    free(job);
}

void viewer_orbit_run(viewer *v) {
    keeper *k = keeper_of(v);
    if (is_reading(v)) {
        k->run_waits = true;
        return;
    }
    if (k->orbit.path[0] == NULL) {
        viewer_complain_about(v, ABOUT_MISSION, NO_MISSION);
        return;
    }
    orbit_job *job = g_new0(orbit_job, 1);
    job->job = (viewer_job){.run = orbit_run, .deliver = orbit_deliver, .release = orbit_release};
    job->v = v;
    job->permille = &k->permille;
    job->choice = k->choice;
    job->parts = k->orbit.path[1] != NULL ? 2 : 1;
    job->path[0] = viewer_text_copy(k->orbit.path[0]);
    job->path[1] = viewer_text_copy(k->orbit.path[1]);
    atomic_store(&k->permille, 0);
    viewer_worker_cancel(v->requests.batch, SLOT_ORBIT);
    viewer_worker_submit(v->requests.batch, SLOT_ORBIT, &job->job);
    viewer_tell(v, CHANGED_ORBIT | CHANGED_BUSY);
}

void viewer_orbit_cancel(viewer *v) {
    if (is_reading(v)) {
        viewer_say_too(v, "The mission that was being read is not taken.");
    }
    keeper_of(v)->run_waits = false;
    viewer_worker_cancel(v->requests.tables, SLOT_MISSION);
    viewer_worker_cancel(v->requests.tables, SLOT_VERSUS);
    viewer_cancel(v, v->requests.batch, SLOT_ORBIT, CANCELLED);
    viewer_tell(v, CHANGED_ORBIT | CHANGED_BUSY);
}

/* ---- out ---- */

static void write_rows(FILE *out, const viewer_orbit *orbit) {
    cli_rows_begin(out, orbit->is_difference);
    for (size_t i = 0; i < orbit->count; ++i) {
        cli_rows_put(out, orbit->t[i],
                     srp_vec3_make(orbit->value[0][i], orbit->value[1][i], orbit->value[2][i]),
                     orbit->value[3][i]);
    }
}

bool viewer_orbit_save(viewer *v, const char *path, viewer_words *problem) {
    const viewer_orbit *orbit = &keeper_of(v)->orbit;
    cli_text_file file;
    if (orbit->count == 0) {
        viewer_words_add(problem, orbit->path[0] == NULL
                                      ? NO_MISSION
                                      : "The mission has no result yet: run it.");
        return false;
    }
    viewer_words_listen(problem);
    int status = cli_text_file_begin(&file, path);
    if (status == CLI_DONE) {
        write_rows(file.out, orbit);
        status = cli_text_file_end(&file);
    }
    viewer_words_listen(NULL);
    return status == CLI_DONE;
}
