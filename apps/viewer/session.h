/* SPDX-License-Identifier: Apache-2.0 */
/*
 * All that a session knows, apart from how it is shown: setup and engine, attitude, the newest
 * force, recorded arrows, tables. No toolkit, and one thread: the window's.
 */
#ifndef SRP_VIEWER_SESSION_H
#define SRP_VIEWER_SESSION_H

#include "engine.h"

#include <srp/table.h>

#include <stdbool.h>
#include <stddef.h>

/* ---- attitude ---- */

/*
 * The Sun stands on the X axis of the room. The spacecraft is turned about its X axis, then about
 * the room's Y, then about its Z: v_room = Rz(z) Ry(y) Rx(x) v_body. Degrees, right-handed.
 */
typedef struct viewer_attitude {
    double turn_deg[3];
} viewer_attitude;

/* Azimuth and elevation of the Sun in body axes [deg], rounded to 1e-9 degrees, so that they can be
 * written down and mean the same again. */
void viewer_attitude_sun(const viewer_attitude *attitude, double *az_deg, double *el_deg);
/* The attitude without a turn about X under which the Sun stands there. */
viewer_attitude viewer_attitude_for_sun(double az_deg, double el_deg);
/* A vector of the room in body axes, and back. */
srp_vec3 viewer_attitude_to_body(const viewer_attitude *attitude, srp_vec3 room);
srp_vec3 viewer_attitude_to_room(const viewer_attitude *attitude, srp_vec3 body);

/* ---- arrows ---- */

/* One attitude that was recorded. */
typedef struct viewer_arrow {
    double az_deg, el_deg;
    srp_vec3 direction; /* of f, unit, body frame; 0 where f is 0 */
    double magnitude;   /* |f| [m^2] */
} viewer_arrow;

/* ---- tables ---- */

/* Its numbers never change; whoever reads them on another thread holds a reference. */
typedef struct viewer_table {
    srp_table *table;
    char *name;    /* what lists show, but for what viewer_session_table_label() adds */
    char *command; /* that computes it; NULL: it came from a file */
    char *path;    /* where it is on disk; NULL: nowhere yet */
    atomic_int references;
} viewer_table;

viewer_table *viewer_table_reference(viewer_table *table); /* may be NULL, as the next */
void viewer_table_release(viewer_table *table);

/* ---- the session ---- */

/* How long the new arrow took [s]. */
typedef struct viewer_latency {
    double shown;    /* from slider to picture */
    double computed; /* of that */
} viewer_latency;

typedef struct viewer_session {
    viewer_setup *setup;   /* what the user has said */
    viewer_engine *engine; /* the newest that is made of it; NULL: none yet */
    viewer_attitude attitude;
    bool force_known;
    viewer_force force;
    bool recording;
    double asked_at;      /* when the force of now was asked for */
    double recorded_from; /* what was asked for before that is not recorded */
    viewer_arrow *arrows;
    size_t arrow_count, arrow_room;
    viewer_table **tables;
    size_t table_count;
    viewer_latency latency[64]; /* a ring of the last ones, of this engine */
    size_t latency_count;
} viewer_session;

/* NULL without memory. */
viewer_session *viewer_session_create(void);
void viewer_session_destroy(viewer_session *session);

/* Takes the reference over. Arrows of another shape or method are forgotten: they are of no use
 * beside new ones. */
void viewer_session_set_engine(viewer_session *session, viewer_engine *engine);
/* The newest force; recorded as an arrow while `recording`, once per direction. False: no memory
 * for the arrow. */
bool viewer_session_set_force(viewer_session *session, const viewer_force *force);
/* Begins with the force of now, also where that is still being computed; or ends. False as above.
 */
bool viewer_session_record(viewer_session *session, bool recording);
void viewer_session_clear_arrows(viewer_session *session);
/* Least and largest magnitude of the arrows; false: there are none. */
bool viewer_session_arrow_range(const viewer_session *session, double *least, double *largest);
/* From blue (0) to red (1). */
void viewer_arrow_colour(double share, float rgb[3]);

/* Of the newest force, which is shown now. */
void viewer_session_add_latency(viewer_session *session, double shown);
/* Of both, each by itself; NAN: none yet. */
viewer_latency viewer_session_median_latency(const viewer_session *session);

/* Takes table, name, command and path over; false, and they are freed, without memory. */
bool viewer_session_add_table(viewer_session *session, viewer_table table);
/* Forgets all tables. */
void viewer_session_clear_tables(viewer_session *session);

/* Whether a table is of the shape that is shown, but of other optics than its materials have now.
 */
bool viewer_session_table_is_old(const viewer_session *session, size_t index);
/* What lists show of it; freed by free(), NULL without memory. */
char *viewer_session_table_label(const viewer_session *session, size_t index);
/* What a table is of: "box-wing.obj, raycast grid 64, 10° × 10°", with the parameters that are not
 * the defaults. `setup` knows what a table does not keep; NULL: it was read from disk. */
void viewer_table_summary(const srp_table *table, const viewer_setup *setup, char *buffer,
                          size_t size);
/* The table under the optics that the materials have now, by srp_table_reoptic(). */
srp_status viewer_table_reoptic(const viewer_table *table, const viewer_engine *engine,
                                srp_table **out, srp_error *error);

#endif
