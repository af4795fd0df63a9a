/* SPDX-License-Identifier: Apache-2.0 */
#include "worker.h"

#include <pthread.h>

struct viewer_worker {
    GThread *thread;
    GMainContext *context;
    pthread_mutex_t lock; /* not GLib's, which ThreadSanitizer does not know */
    pthread_cond_t bell;
    viewer_job *waiting[VIEWER_SLOTS];
    viewer_job *running;
    GQueue done; /* jobs to deliver, oldest first */
    GSource *delivery;
    bool ending;
    unsigned open[VIEWER_SLOTS]; /* jobs not yet released; the main thread's */
};

static viewer_job *next_job(viewer_worker *worker) {
    for (unsigned slot = 0; slot < VIEWER_SLOTS; ++slot) {
        viewer_job *job = worker->waiting[slot];
        if (job != NULL) {
            worker->waiting[slot] = NULL;
            return job;
        }
    }
    return NULL;
}

static gboolean deliver(gpointer user) {
    viewer_worker *worker = user;
    for (;;) {
        pthread_mutex_lock(&worker->lock);
        viewer_job *job = g_queue_pop_head(&worker->done);
        if (job == NULL) {
            worker->delivery = NULL;
        }
        pthread_mutex_unlock(&worker->lock);
        if (job == NULL) {
            return G_SOURCE_REMOVE;
        }
        --worker->open[job->slot];
        if (job->deliver != NULL) {
            job->deliver(job);
        }
        job->release(job);
    }
}

/* With the lock held. */
static void hand_over(viewer_worker *worker, viewer_job *job) {
    g_queue_push_tail(&worker->done, job);
    if (worker->delivery == NULL && !worker->ending) {
        GSource *source = g_idle_source_new();
        g_source_set_priority(source, G_PRIORITY_DEFAULT);
        g_source_set_callback(source, deliver, worker, NULL);
        g_source_attach(source, worker->context);
        worker->delivery = source; /* the context holds it; gone when deliver() ends it */
        g_source_unref(source);
    }
}

static gpointer work(gpointer user) {
    viewer_worker *worker = user;
    pthread_mutex_lock(&worker->lock);
    while (!worker->ending) {
        viewer_job *job = next_job(worker);
        if (job == NULL) {
            pthread_cond_wait(&worker->bell, &worker->lock);
            continue;
        }
        worker->running = job;
        pthread_mutex_unlock(&worker->lock);
        job->run(job);
        pthread_mutex_lock(&worker->lock);
        worker->running = NULL;
        hand_over(worker, job);
    }
    pthread_mutex_unlock(&worker->lock);
    return NULL;
}

viewer_worker *viewer_worker_create(const char *name, GMainContext *context) {
    viewer_worker *worker = g_new0(viewer_worker, 1);
    worker->context = context;
    pthread_mutex_init(&worker->lock, NULL);
    pthread_cond_init(&worker->bell, NULL);
    g_queue_init(&worker->done);
    worker->thread = g_thread_new(name, work, worker);
    return worker;
}

void viewer_worker_destroy(viewer_worker *worker) {
    if (worker == NULL) {
        return;
    }
    pthread_mutex_lock(&worker->lock);
    worker->ending = true;
    if (worker->running != NULL) {
        atomic_store(&worker->running->cancel, true);
    }
    if (worker->delivery != NULL) {
        g_source_destroy(worker->delivery);
        worker->delivery = NULL;
    }
    pthread_cond_signal(&worker->bell);
    pthread_mutex_unlock(&worker->lock);
    g_thread_join(worker->thread);
    for (viewer_job *job; (job = next_job(worker)) != NULL;) {
        job->release(job);
    }
    for (viewer_job *job; (job = g_queue_pop_head(&worker->done)) != NULL;) {
        job->release(job);
    }
    pthread_cond_destroy(&worker->bell);
    pthread_mutex_destroy(&worker->lock);
    g_free(worker);
}

void viewer_worker_submit(viewer_worker *worker, unsigned slot, viewer_job *job) {
    job->slot = slot;
    atomic_init(&job->cancel, false);
    pthread_mutex_lock(&worker->lock);
    viewer_job *old = worker->waiting[slot];
    worker->waiting[slot] = job;
    pthread_cond_signal(&worker->bell);
    pthread_mutex_unlock(&worker->lock);
    if (old != NULL) {
        old->release(old);
    } else {
        ++worker->open[slot];
    }
}

void viewer_worker_cancel(viewer_worker *worker, unsigned slot) {
    pthread_mutex_lock(&worker->lock);
    viewer_job *old = worker->waiting[slot];
    worker->waiting[slot] = NULL;
    if (worker->running != NULL && worker->running->slot == slot) {
        atomic_store(&worker->running->cancel, true);
    }
    pthread_mutex_unlock(&worker->lock);
    if (old != NULL) {
        --worker->open[slot];
        old->release(old);
    }
}

bool viewer_worker_is_busy(const viewer_worker *worker, unsigned slot) {
    return worker->open[slot] > 0;
}
