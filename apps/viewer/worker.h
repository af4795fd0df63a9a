/* SPDX-License-Identifier: Apache-2.0 */
/*
 * One thread that computes, so that the window need not wait. Jobs go into numbered slots: a job
 * that still waits in a slot is dropped for a newer one, so that a slider can ask as often as it
 * likes. What is done comes back to the thread of the main context.
 *
 * All functions are called from that thread, but for viewer_job's run().
 */
#ifndef SRP_VIEWER_WORKER_H
#define SRP_VIEWER_WORKER_H

#include <glib.h>
#include <stdatomic.h>
#include <stdbool.h>

typedef struct viewer_job viewer_job;
/* First member of every job; made by calloc() and filled by whoever asks. */
struct viewer_job {
    void (*run)(viewer_job *job);     /* on the worker's thread; looks at `cancel` now and then */
    void (*deliver)(viewer_job *job); /* on the main thread, unless dropped before; may be NULL */
    void (*release)(viewer_job *job); /* on the main thread, always: frees the job */
    atomic_bool cancel;               /* somebody wants it to end early */
    /* The worker's. */
    unsigned slot;
};

enum { VIEWER_SLOTS = 6 };

typedef struct viewer_worker viewer_worker;

viewer_worker *viewer_worker_create(const char *name, GMainContext *context);
/* Cancels what runs, and begins nothing more; nothing is delivered any more. Does not wait. */
void viewer_worker_end(viewer_worker *worker);
/* After that: does the thread end within so many seconds? */
bool viewer_worker_wait(viewer_worker *worker, double seconds);
/* Both, however long it takes; then drops everything. NULL is fine. */
void viewer_worker_destroy(viewer_worker *worker);

/* Takes the job over. Slots with lower numbers come first. */
void viewer_worker_submit(viewer_worker *worker, unsigned slot, viewer_job *job);
/* Drops the job that waits in the slot, and asks the one that runs to end; that one is delivered,
 * as is one that has ended already: its `cancel` tells it. */
void viewer_worker_cancel(viewer_worker *worker, unsigned slot);
/* Waits until the jobs of this slot are done, but so many seconds at most, and delivers all that
 * are done. Not for deliver() to call. */
void viewer_worker_settle(viewer_worker *worker, unsigned slot, double seconds);
/* Does a job of this slot wait, run, or wait to be delivered? */
bool viewer_worker_is_busy(const viewer_worker *worker, unsigned slot);
/* Is what is busy there but a job that was cancelled and has not ended yet? */
bool viewer_worker_is_cancelling(const viewer_worker *worker, unsigned slot);
/* The slot of the job that runs; -1: none does. */
int viewer_worker_running(viewer_worker *worker);

#endif
