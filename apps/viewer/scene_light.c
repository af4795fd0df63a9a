/* SPDX-License-Identifier: Apache-2.0 */
#include "scene_light.h"

/* Whose light. */
typedef struct subject {
    viewer_engine *engine; /* NULL: nobody's */
    srp_vec3 sun;
} subject;

struct scene_light {
    viewer_worker *worker;
    void (*ready)(void *user);
    void *user;
    subject asked, done;
    srp_render_light *found; /* NULL: it could not be found */
};

typedef struct light_job {
    viewer_job job;
    scene_light *owner;
    subject of;
    srp_render_light *found;
} light_job;

static bool is_of(const subject *s, const viewer_engine *engine, srp_vec3 sun) {
    return s->engine == engine && s->sun.x == sun.x && s->sun.y == sun.y && s->sun.z == sun.z;
}

static void set_subject(subject *s, viewer_engine *engine, srp_vec3 sun) {
    viewer_engine *old = s->engine;
    *s = (subject){engine != NULL ? viewer_engine_reference(engine) : NULL, sun};
    viewer_engine_release(old);
}

static bool go_on(void *user) {
    light_job *job = user;
    return !atomic_load(&job->job.cancel);
}

static void run(viewer_job *base) {
    light_job *job = (light_job *)base;
    srp_error error;
    if (srp_render_light_find(job->of.engine->mesh, job->of.sun, go_on, job, &job->found, &error) !=
        SRP_OK) {
        job->found = NULL;
    }
}

static void deliver(viewer_job *base) {
    light_job *job = (light_job *)base;
    scene_light *light = job->owner;
    if (!is_of(&light->asked, job->of.engine, job->of.sun)) {
        return; /* of a Sun that was */
    }
    srp_render_light_destroy(light->found);
    light->found = job->found;
    job->found = NULL;
    set_subject(&light->done, job->of.engine, job->of.sun);
    light->ready(light->user);
}

static void release(viewer_job *base) {
    light_job *job = (light_job *)base;
    srp_render_light_destroy(job->found);
    viewer_engine_release(job->of.engine);
    g_free(job);
}

scene_light *scene_light_create(viewer_worker *worker, void (*ready)(void *user), void *user) {
    scene_light *light = g_new0(scene_light, 1);
    light->worker = worker;
    light->ready = ready;
    light->user = user;
    return light;
}

void scene_light_destroy(scene_light *light) {
    viewer_worker_end(light->worker); /* from now on it delivers nothing */
    srp_render_light_destroy(light->found);
    viewer_engine_release(light->asked.engine);
    viewer_engine_release(light->done.engine);
    g_free(light);
}

void scene_light_ask(scene_light *light, viewer_engine *engine, srp_vec3 sun) {
    if (is_of(&light->asked, engine, sun)) {
        return;
    }
    light_job *job = g_new0(light_job, 1);
    job->job = (viewer_job){.run = run, .deliver = deliver, .release = release};
    job->owner = light;
    set_subject(&job->of, engine, sun);
    set_subject(&light->asked, engine, sun);
    set_subject(&light->done, NULL, sun);
    viewer_worker_cancel(light->worker, 0);
    viewer_worker_submit(light->worker, 0, &job->job);
}

scene_light_state scene_light_look(const scene_light *light, const viewer_engine *engine,
                                   srp_vec3 sun, const srp_render_light **found) {
    *found = light->found;
    if (!is_of(&light->done, engine, sun)) {
        return LIGHT_UNKNOWN;
    }
    return light->found != NULL ? LIGHT_FOUND : LIGHT_FAILED;
}
