/* SPDX-License-Identifier: Apache-2.0 */
/* What is computed beside the window: engines and forces at once, tables and what else takes long
 * on a second thread, and what is made of tables, or read, on a third. */
#ifndef SRP_VIEWER_REQUESTS_H
#define SRP_VIEWER_REQUESTS_H

#include "engine.h"
#include "words.h"
#include "worker.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct viewer viewer;

/* What a quick look at the method found, on this machine and this model. */
typedef enum viewer_probe_state {
    PROBE_NONE, /* there is nothing to measure, or it could not be measured */
    PROBE_RUNS,
    PROBE_KNOWN
} viewer_probe_state;

typedef struct viewer_probe {
    viewer_probe_state state; /* the rest is of PROBE_KNOWN */
    double seconds;           /* for one direction, median */
    double error;             /* relative, of |f|: the largest that was seen; NAN: not known */
    bool against_exact; /* the error is the distance from the method exact, not the method's own */
} viewer_probe;

/* How far a table is, written by the thread that computes it. */
typedef struct viewer_progress {
    atomic_size_t done, total;
    _Atomic double began; /* to be computed; before that, when it was asked for */
} viewer_progress;

enum { SLOT_ENGINE, SLOT_FORCE };                      /* of `live` */
enum { SLOT_TABLE, SLOT_ORBIT, SLOT_FIT, SLOT_PROBE }; /* of `batch` */
/* Of `tables`; SLOT_MISSION: the first mission, and SLOT_VERSUS: the second. */
enum { SLOT_MODEL, SLOT_COMPARISON, SLOT_REOPTIC, SLOT_OPENING, SLOT_MISSION, SLOT_VERSUS };

typedef struct viewer_requests {
    viewer_worker *live, *batch;
    viewer_worker *tables;  /* what is done with tables, and models and missions that are read:
                               takes seconds at most */
    viewer_worker *shadows; /* the picture's */
    viewer_progress table;
    viewer_probe probe;
    GQueue to_open;                  /* paths of tables, each freed by free() */
    viewer_words not_opened;         /* of those that were asked for together: what went wrong */
    void (*after_engine)(viewer *v); /* what was asked for while it was made, NULL: nothing */
} viewer_requests;

void viewer_requests_begin(viewer *v);
/* Cancels all, and waits for it to end, but not for long. False: something cannot be interrupted
 * and goes on; what it may still use is left as it is. */
bool viewer_requests_end(viewer *v);
/* Is anything computed, or about to be shown? */
bool viewer_requests_busy(const viewer *v);
/* The user does not want what this slot computes. `said` of what has not begun; what has says it as
 * it is delivered. */
void viewer_cancel(viewer *v, viewer_worker *worker, unsigned slot, const char *said);
/* What keeps a job of `batch` from going on: "Waiting for the fit …", "Cancelling …"; NULL: nothing
 * does. */
const char *viewer_held_up(const viewer *v, unsigned slot, bool cancelling);

/* The setup has changed: a new engine, then the force. `reload` reads files again. */
void viewer_request_engine(viewer *v, bool reload);
/* The same for a new spacecraft whose file has been read; `said` of it. */
void viewer_request_engine_of(viewer *v, viewer_shape *shape, const viewer_words *said);
/* The Sun has moved. */
void viewer_request_force(viewer *v);
/* Is a force on its way that takes less than so many seconds, as the last one did? */
bool viewer_force_is_quick(const viewer *v, double seconds);
/* Waits for it, no longer than that, and has it shown. */
void viewer_settle_force(viewer *v, double seconds);
/* Does an engine of what the user has said last have to be made first? Then `what` is called when
 * it is there, unless something else is asked for meanwhile, or it is cancelled. */
bool viewer_comes_after_engine(viewer *v, void (*what)(viewer *v));
/* It is not wanted any more; `said` where it would have been called. */
void viewer_cancel_after_engine(viewer *v, void (*what)(viewer *v), const char *said);
/* Whether there is something to compute with; says why not. */
bool viewer_check_engine(viewer *v);
/* A table of the engine, with the steps of the viewer. */
void viewer_request_table(viewer *v);
void viewer_cancel_table(viewer *v);
bool viewer_table_is_cancelling(const viewer *v);

#endif
