/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L /* the clock that only goes forward */
#include "worker.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <time.h>

struct viewer_worker {
    GThread *thread;
    GMainContext *context;
    pthread_mutex_t lock; /* not GLib's, which ThreadSanitizer does not know */
    pthread_cond_t bell;  /* there is work, or none any more */
    pthread_cond_t told;  /* a job is done, or the thread has left */
    viewer_job *waiting[VIEWER_SLOTS];
    viewer_job *running;
    GQueue done; /* jobs to deliver, oldest first */
    GSource *delivery;
    bool ending, left;
    /* The main thread's. */
    unsigned open[VIEWER_SLOTS]; /* jobs not yet released */
    bool cancelling[VIEWER_SLOTS];
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
        if (--worker->open[job->slot] == 0) {
            worker->cancelling[job->slot] = false;
        }
        if (job->deliver != NULL) {
            job->deliver(job);
        }
        job->release(job);
    }
}

/* With the lock held. */
static void hand_over(viewer_worker *worker, viewer_job *job) {
    g_queue_push_tail(&worker->done, job);
    pthread_cond_signal(&worker->told);
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
    worker->left = true;
    pthread_cond_signal(&worker->told);
    pthread_mutex_unlock(&worker->lock);
    return NULL;
}

viewer_worker *viewer_worker_create(const char *name, GMainContext *context) {
    viewer_worker *worker = g_new0(viewer_worker, 1);
    worker->context = context;
    pthread_mutex_init(&worker->lock, NULL);
    pthread_cond_init(&worker->bell, NULL);
    pthread_condattr_t clock;
    pthread_condattr_init(&clock);
    pthread_condattr_setclock(&clock, CLOCK_MONOTONIC);
    pthread_cond_init(&worker->told, &clock);
    pthread_condattr_destroy(&clock);
    g_queue_init(&worker->done);
    worker->thread = g_thread_new(name, work, worker);
    return worker;
}

void viewer_worker_end(viewer_worker *worker) {
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
}

/* On the clock of `told`. */
static struct timespec seconds_from_now(double seconds) {
    struct timespec until;
    clock_gettime(CLOCK_MONOTONIC, &until);
    double whole = floor(seconds), nanoseconds = (double)until.tv_nsec + 1e9 * (seconds - whole);
    bool more = nanoseconds >= 1e9;
    until.tv_sec += (time_t)whole + more;
    until.tv_nsec = (long)(nanoseconds - (more ? 1e9 : 0.0));
    return until;
}

bool viewer_worker_wait(viewer_worker *worker, double seconds) {
    const struct timespec until = seconds_from_now(seconds);
    int status = 0;
    pthread_mutex_lock(&worker->lock);
    while (!worker->left && status != ETIMEDOUT) {
        status = pthread_cond_timedwait(&worker->told, &worker->lock, &until);
    }
    bool left = worker->left;
    pthread_mutex_unlock(&worker->lock);
    return left;
}

void viewer_worker_settle(viewer_worker *worker, unsigned slot, double seconds) {
    const struct timespec until = seconds_from_now(seconds);
    int status = 0;
    pthread_mutex_lock(&worker->lock);
    while (status != ETIMEDOUT && (worker->waiting[slot] != NULL ||
                                   (worker->running != NULL && worker->running->slot == slot))) {
        status = pthread_cond_timedwait(&worker->told, &worker->lock, &until);
    }
    GSource *delivery = worker->delivery;
    pthread_mutex_unlock(&worker->lock);
    if (delivery != NULL) {
        g_source_ref(delivery);
        deliver(worker);
        g_source_destroy(delivery);
        g_source_unref(delivery);
    }
}

void viewer_worker_destroy(viewer_worker *worker) {
    if (worker == NULL) {
        return;
    }
    viewer_worker_end(worker);
    g_thread_join(worker->thread);
    for (viewer_job *job; (job = next_job(worker)) != NULL;) {
        job->release(job);
    }
    for (viewer_job *job; (job = g_queue_pop_head(&worker->done)) != NULL;) {
        job->release(job);
    }
    pthread_cond_destroy(&worker->bell);
    pthread_cond_destroy(&worker->told);
    pthread_mutex_destroy(&worker->lock);
    g_free(worker);
}

void viewer_worker_submit(viewer_worker *worker, unsigned slot, viewer_job *job) {
    job->slot = slot;
    worker->cancelling[slot] = false;
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
    for (GList *each = worker->done.head; each != NULL; each = each->next) {
        viewer_job *job = each->data;
        if (job->slot == slot) {
            atomic_store(&job->cancel, true);
        }
    }
    pthread_mutex_unlock(&worker->lock);
    if (old != NULL) {
        --worker->open[slot];
        old->release(old);
    }
    worker->cancelling[slot] = worker->open[slot] > 0;
}

bool viewer_worker_is_busy(const viewer_worker *worker, unsigned slot) {
    return worker->open[slot] > 0;
}

bool viewer_worker_is_cancelling(const viewer_worker *worker, unsigned slot) {
    return worker->cancelling[slot];
}

int viewer_worker_running(viewer_worker *worker) {
    pthread_mutex_lock(&worker->lock);
    int slot = worker->running != NULL ? (int)worker->running->slot : -1;
    pthread_mutex_unlock(&worker->lock);
    return slot;
}
