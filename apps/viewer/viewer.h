/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The program: one window over one session. Actions (actions.h) change the session, jobs
 * (requests.h) compute, and panes show what has changed. Panes never call one another: they listen.
 */
#ifndef SRP_VIEWER_VIEWER_H
#define SRP_VIEWER_VIEWER_H

#include "requests.h"
#include "session.h"
#include "worker.h"

#include <srp/render.h>

#include <gtk/gtk.h>

/* What has changed; bits. */
enum {
    CHANGED_SETUP = 1 << 0,  /* what the user has said */
    CHANGED_ENGINE = 1 << 1, /* spacecraft, optics, method are ready, or cannot be */
    CHANGED_SUN = 1 << 2,
    CHANGED_FORCE = 1 << 3,
    CHANGED_ARROWS = 1 << 4,
    CHANGED_TABLES = 1 << 5,
    CHANGED_VIEW = 1 << 6, /* how things are shown: camera, colours */
    CHANGED_BUSY = 1 << 7, /* something began to be computed, or ended */
    CHANGED_PROBE = 1 << 8,
    CHANGED_COMPARISON = 1 << 9,
    CHANGED_ORBIT = 1 << 10,
    CHANGED_MESSAGE = 1 << 11,
    CHANGED_ALL = (1 << 12) - 1
};

/* The eye, in axes of the room: the Sun is on +X, +Z is up. */
typedef struct viewer_camera {
    double az_deg, el_deg;
    double zoom; /* 1: the whole spacecraft */
} viewer_camera;

enum { TAB_SPACECRAFT, TAB_GRAPHICS, TAB_COMPARE, TAB_ORBIT, TAB_COUNT };
extern const char *const VIEWER_TAB_NAME[TAB_COUNT]; /* as actions know them */

enum { VIEWER_CHARTS = 4 }; /* x, y, z and length of what is drawn over all directions */

/* What a complaint is about: only a success of the same kind takes it back. */
typedef enum viewer_topic {
    ABOUT_STEP, /* something that was refused */
    ABOUT_MODEL,
    ABOUT_LOADING, /* a spacecraft from disk */
    ABOUT_OPENING, /* tables */
    ABOUT_TABLE,   /* computed, fitted, or missing */
    ABOUT_SAVING,
    ABOUT_MISSION
} viewer_topic;

typedef struct viewer viewer;
typedef void (*viewer_listener)(void *pane, unsigned what);

/* Steps of tables; finer ones take long, coarser ones are no table. */
#define VIEWER_STEP_MIN_DEG 0.5
#define VIEWER_STEP_MAX_DEG 90.0

struct viewer {
    GtkApplication *application;
    GtkWindow *window; /* NULL until it is there, and after it is gone */
    GtkNotebook *tabs;
    viewer_session *session;
    viewer_requests requests;
    /* How things are shown. */
    viewer_camera camera;
    srp_render_colouring colouring; /* not SRP_RENDER_VALUES */
    bool shadows;
    int table_shown; /* index of the table on the graphics tab, -1: none */
    int compared[2]; /* -1: none */
    double chart_view[VIEWER_CHARTS]
                     [2]; /* azimuth and elevation of the eye of each surface [deg] */
    bool charts_together;
    int plates_to_fit;
    double az_step_deg, el_step_deg;
    /* What there is to say. */
    char problem[VIEWER_WORDS_SIZE], news[VIEWER_WORDS_SIZE]; /* "": none */
    char message[2 * VIEWER_WORDS_SIZE];                      /* both, as they are shown */
    viewer_topic topic;                                       /* of the problem */
    unsigned complaints;                                      /* how many there have been */
    bool picture_is_old; /* the 3D area has not drawn the newest state yet */
    double asked_at;     /* when the newest force was asked for, NAN: shown already */
    GPtrArray *listeners;
    int exit_status;
    bool scripted;  /* the window closes when the script is at its end */
    bool remembers; /* what is remembered is read at the start and written at the end */
};

void viewer_listen(viewer *v, viewer_listener changed, void *pane);
/* Something changed: every pane hears of it, now. */
void viewer_tell(viewer *v, unsigned what);

/* A line for the user, until the next one or the next step; "" says nothing. What went wrong stands
 * above it. */
void viewer_say(viewer *v, const char *text);
/* The same below what was said of the same step, once. */
void viewer_say_too(viewer *v, const char *text);
/* The user takes another step: what was said stands no more, but for what went wrong. */
void viewer_forget_news(viewer *v);
/* The user has read it all. */
void viewer_dismiss(viewer *v);

/* What went wrong, until the next complaint; "" takes back one about the same topic, and no other.
 * Options of the command line are named as the window names them. */
void viewer_complain_about(viewer *v, viewer_topic topic, const char *text);
/* The same about a step. */
void viewer_complain(viewer *v, const char *text);
/* The same for what is wrong with spacecraft or method: stands until the next engine. */
void viewer_complain_of_model(viewer *v, const char *text);

/* Moves the eye; elevation and zoom are kept within their ranges. */
void viewer_set_camera(viewer *v, double az_deg, double el_deg, double zoom);

/* Turns a surface, or all of them while they turn together; the elevation is kept from 0 to 90. */
void viewer_set_chart_view(viewer *v, int chart, double az_deg, double el_deg);

/* A size that a window can have: MIN to MAX pixels each way. */
enum { WINDOW_SIZE_MIN = 100, WINDOW_SIZE_MAX = 20000 };
bool viewer_is_window_size(int width, int height);

/* Activates an action, "turn-x", as a widget does; `parameter` may be NULL. */
void viewer_act(viewer *v, const char *action, GVariant *parameter);
void viewer_act_text(viewer *v, const char *action, const char *text);

/* The window with all panes. */
void viewer_build_window(viewer *v);

/* Each makes a pane, which lives as long as its widget. */
GtkWidget *viewer_spacecraft_pane(viewer *v);
GtkWidget *viewer_method_pane(viewer *v);
GtkWidget *viewer_scene_tab(viewer *v);
GtkWidget *viewer_table_tab(viewer *v);
GtkWidget *viewer_compare_tab(viewer *v);
GtkWidget *viewer_orbit_tab(viewer *v); /* in builds with missions */

#endif
