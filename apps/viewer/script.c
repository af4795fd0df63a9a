/* SPDX-License-Identifier: Apache-2.0 */
#include "script.h"

#include "actions.h"
#include "audit.h"
#include "numbers.h"
#include "screenshot.h"
#include "ui.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct script {
    viewer *v;
    char *name; /* NULL: made of options */
    char **lines;
    size_t at;
    double resume_at; /* [s] */
    bool waits;       /* until nothing is computed any more */
    gint64 shown_at;  /* the frame that shows what there is to see */
    const char *shot; /* picture to take then; NULL: none */
    char *unexpected; /* complaint that nothing has expected yet, NULL: none */
    size_t unexpected_at;
    char *expected;      /* the last one that was */
    unsigned complaints; /* heard of */
    double ticked_at;    /* NAN: not since the last `stall` */
    double stall;        /* the longest time between two ticks since then [s] */
} script;

enum { TICK_MS = 4, FRAMES_TO_SHOW = 3 };

static void script_free(gpointer user) {
    script *s = user;
    g_strfreev(s->lines);
    g_free(s->name);
    g_free(s->unexpected);
    g_free(s->expected);
    g_free(s);
}

static gboolean fail_at(script *s, size_t line, const char *what) {
    if (s->name != NULL && line > 0) { /* 0: the model, before all steps */
        g_printerr("%s:%zu: %s\n", s->name, line, what);
    } else {
        g_printerr("srp-viewer: %s\n", what);
    }
    s->v->exit_status = 1;
    return FALSE;
}

static gboolean fail(script *s, const char *what) {
    return fail_at(s, s->at, what);
}

/* ---- complaints ---- */

/* A complaint that nothing expected is a failure of the script, which goes on. */
static void judge_complaint(script *s) {
    if (s->unexpected != NULL) {
        fail_at(s, s->unexpected_at, s->unexpected);
        g_clear_pointer(&s->unexpected, g_free);
    }
}

static void note_complaint(script *s) {
    judge_complaint(s);
    s->unexpected = g_strdup(s->v->problem);
    s->unexpected_at = s->at;
}

static void accept_complaint(script *s) {
    g_clear_pointer(&s->unexpected, g_free);
    g_free(s->expected);
    s->expected = g_strdup(s->v->problem);
}

static void on_changed(void *user, unsigned what) {
    script *s = user;
    const viewer *v = s->v;
    if ((what & CHANGED_MESSAGE) != 0 && v->complaints != s->complaints) {
        s->complaints = v->complaints;
        if (v->topic != ABOUT_MODEL) {
            note_complaint(s);
        }
    }
}

/* What is wrong with the model counts where it stands after a wait of the script: while that is
 * still saying what the model is, it may well lack something. */
static void note_complaint_of_model(script *s) {
    const char *text = s->v->problem;
    if (text[0] != '\0' && s->v->topic == ABOUT_MODEL && s->at > 0 &&
        g_strcmp0(text, s->expected) != 0 && g_strcmp0(text, s->unexpected) != 0) {
        note_complaint(s);
    }
}

/* ---- texts of widgets ---- */

static char *text_of(GtkWidget *widget) {
    if (GTK_IS_GL_AREA(widget)) { /* GTK writes into it why there is no picture */
        GError *problem =
            gtk_widget_get_mapped(widget) ? gtk_gl_area_get_error(GTK_GL_AREA(widget)) : NULL;
        return g_strdup(problem != NULL ? problem->message : "");
    }
    if (GTK_IS_LABEL(widget)) {
        return g_strdup(gtk_label_get_text(GTK_LABEL(widget)));
    }
    if (GTK_IS_EDITABLE(widget)) {
        return g_strdup(gtk_editable_get_text(GTK_EDITABLE(widget)));
    }
    if (GTK_IS_BUTTON(widget)) { /* as it is shown */
        GtkWidget *words = gtk_button_get_child(GTK_BUTTON(widget));
        return g_strdup(GTK_IS_LABEL(words) ? gtk_label_get_text(GTK_LABEL(words)) : "");
    }
    if (GTK_IS_MENU_BUTTON(widget)) {
        return g_strdup(gtk_menu_button_get_label(GTK_MENU_BUTTON(widget)));
    }
    if (GTK_IS_RANGE(widget)) {
        return g_strdup_printf("%g", gtk_range_get_value(GTK_RANGE(widget)));
    }
    if (GTK_IS_PROGRESS_BAR(widget)) {
        return g_strdup(gtk_progress_bar_get_text(GTK_PROGRESS_BAR(widget)));
    }
    if (GTK_IS_DROP_DOWN(widget)) {
        GObject *item = gtk_drop_down_get_selected_item(GTK_DROP_DOWN(widget));
        return g_strdup(item != NULL ? gtk_string_object_get_string(GTK_STRING_OBJECT(item)) : "");
    }
    return g_strdup("");
}

/* Splits "WIDGET TEXT"; the text may be missing. */
static GtkWidget *find_widget(script *s, char *words, char **text) {
    *text = strchr(words, ' ');
    if (*text != NULL) {
        *(*text)++ = '\0';
    }
    GtkWidget *widget = ui_find(s->v, words);
    if (widget == NULL) {
        char *names = ui_names(s->v);
        char *said = g_strdup_printf("there is no widget '%s' among %s", words, names);
        fail(s, said);
        g_free(said);
        g_free(names);
    }
    return widget;
}

static gboolean print_text(script *s, char *words) {
    char *rest, *text;
    GtkWidget *widget = find_widget(s, words, &rest);
    if (widget == NULL) {
        return FALSE;
    }
    text = text_of(widget);
    g_print("%s: %s\n", words, text != NULL ? text : "");
    g_free(text);
    return TRUE;
}

static gboolean expect_text(script *s, char *words) {
    char *wanted, *text;
    GtkWidget *widget = find_widget(s, words, &wanted);
    if (widget == NULL) {
        return FALSE;
    }
    text = text_of(widget);
    gboolean good = text != NULL && strstr(text, wanted != NULL ? wanted : "") != NULL;
    if (!good) {
        char *said = g_strdup_printf("%s says '%s', expected '%s'", words, text != NULL ? text : "",
                                     wanted != NULL ? wanted : "");
        fail(s, said);
        g_free(said);
    } else if (strcmp(words, "message") == 0 && s->v->problem[0] != '\0') {
        accept_complaint(s);
    }
    g_free(text);
    return good;
}

static gboolean print_place(script *s, char *words) {
    char *rest;
    graphene_rect_t bounds;
    GtkWidget *widget = find_widget(s, words, &rest);
    if (widget == NULL) {
        return FALSE;
    }
    if (!gtk_widget_compute_bounds(widget, GTK_WIDGET(s->v->window), &bounds)) {
        return fail(s, "the widget is not in the window");
    }
    g_print("place of %s: %.0f %.0f %.0f %.0f\n", words, (double)bounds.origin.x,
            (double)bounds.origin.y, (double)bounds.size.width, (double)bounds.size.height);
    return TRUE;
}

/* NULL: the script has failed. */
static GtkWidget *write_text(script *s, char *words) {
    char *text;
    GtkWidget *widget = find_widget(s, words, &text);
    if (widget == NULL || !(GTK_IS_ENTRY(widget) || GTK_IS_SPIN_BUTTON(widget))) {
        if (widget != NULL) {
            fail(s, "expected an entry or a number");
        }
        return NULL;
    }
    gtk_editable_set_text(GTK_EDITABLE(widget), text != NULL ? text : "");
    return widget;
}

static gboolean type_text(script *s, char *words) {
    GtkWidget *widget = write_text(s, words);
    return widget != NULL && (gtk_widget_grab_focus(widget) || fail(s, "it takes no focus"));
}

static gboolean enter_text(script *s, char *words) {
    GtkWidget *widget = write_text(s, words);
    if (widget == NULL) {
        return FALSE;
    }
    if (GTK_IS_SPIN_BUTTON(widget)) {
        gtk_spin_button_update(GTK_SPIN_BUTTON(widget));
    } else {
        g_signal_emit_by_name(widget, "activate");
    }
    return TRUE;
}

/* As the Tab key does. */
static gboolean focus_widget(script *s, char *words) {
    char *rest;
    GtkWidget *widget = find_widget(s, words, &rest);
    if (widget == NULL || !gtk_widget_grab_focus(widget)) {
        return widget == NULL ? FALSE : fail(s, "the widget takes no focus");
    }
    gtk_window_set_focus_visible(s->v->window, TRUE);
    return TRUE;
}

/* ---- keys and pointer ---- */

/* A controller of this type; NULL: the widget has none. */
static GtkEventController *find_controller(GtkWidget *widget, GType type) {
    GListModel *all = gtk_widget_observe_controllers(widget);
    GtkEventController *found = NULL;
    for (guint i = 0; found == NULL && i < g_list_model_get_n_items(all); ++i) {
        GtkEventController *each = g_list_model_get_item(all, i);
        found = G_TYPE_CHECK_INSTANCE_TYPE(each, type) ? each : NULL;
        g_object_unref(each); /* the widget holds it */
    }
    g_object_unref(all);
    return found;
}

static gboolean press_key(script *s, char *words) {
    char *name;
    GtkWidget *widget = find_widget(s, words, &name);
    guint key = name != NULL ? gdk_keyval_from_name(name) : GDK_KEY_VoidSymbol;
    if (widget == NULL) {
        return FALSE;
    }
    if (key == GDK_KEY_VoidSymbol) {
        return fail(s, "expected press WIDGET KEY");
    }
    GtkEventController *keys = find_controller(widget, GTK_TYPE_EVENT_CONTROLLER_KEY);
    gboolean taken = FALSE;
    if (keys == NULL || !gtk_widget_grab_focus(widget)) {
        return fail(s, "the widget takes no keys");
    }
    gtk_window_set_focus_visible(s->v->window, TRUE); /* as a key does */
    g_signal_emit_by_name(keys, "key-pressed", key, 0, (GdkModifierType)0, &taken);
    return taken || fail(s, "the widget does not take this key");
}

static gboolean move_pointer(script *s, char *words) {
    char *place;
    double at[2];
    GtkWidget *widget = find_widget(s, words, &place);
    if (widget == NULL) {
        return FALSE;
    }
    if (place == NULL || !cli_read_numbers(place, 2, at)) {
        return fail(s, "expected point WIDGET X,Y");
    }
    GtkEventController *motion = find_controller(widget, GTK_TYPE_EVENT_CONTROLLER_MOTION);
    if (motion == NULL) {
        return fail(s, "the widget does not look at the pointer");
    }
    g_signal_emit_by_name(motion, "motion", at[0], at[1]);
    return TRUE;
}

/* ---- steps ---- */

static gint64 frame_now(const script *s) {
    return gdk_frame_clock_get_frame_counter(gtk_widget_get_frame_clock(GTK_WIDGET(s->v->window)));
}

/* What has changed is shown some frames later. */
static void wait_for_frames(script *s) {
    s->shown_at = frame_now(s) + FRAMES_TO_SHOW;
}

/* Of an action's type; NULL, said: it is none. */
static GVariant *parameter_of(script *s, const viewer_action *action, const char *text) {
    char *end;
    if (strcmp(action->type, "s") == 0) {
        return g_variant_new_string(text);
    }
    bool whole = strcmp(action->type, "i") == 0;
    double number = g_ascii_strtod(text, &end);
    if (end == text || *end != '\0' || (whole && number != CLAMP(rint(number), -1e9, 1e9))) {
        char *said = g_strdup_printf("%s %s: expected a %snumber", action->name, text,
                                     whole ? "whole " : "");
        fail(s, said);
        g_free(said);
        return NULL;
    }
    return whole ? g_variant_new_int32((gint32)number) : g_variant_new_double(number);
}

static gboolean activate(script *s, const char *name, const char *rest) {
    size_t count;
    const viewer_action *actions = viewer_action_list(&count);
    for (size_t i = 0; i < count; ++i) {
        if (strcmp(actions[i].name, name) != 0) {
            continue;
        }
        bool takes = actions[i].type != NULL;
        GVariant *parameter = takes ? parameter_of(s, &actions[i], rest) : NULL;
        if (takes && parameter == NULL) {
            return FALSE;
        }
        viewer_act(s->v, name, parameter);
        return TRUE;
    }
    char *said = g_strdup_printf("unknown step '%s'", name);
    fail(s, said);
    g_free(said);
    return FALSE;
}

static gboolean resize(script *s, char *rest) {
    int width = 0, height = 0;
    char *end;
    width = (int)strtol(rest, &end, 10);
    height = (int)strtol(end, NULL, 10);
    if (!viewer_is_window_size(width, height)) {
        return fail(s, "expected resize WIDTH HEIGHT");
    }
    gtk_window_set_default_size(s->v->window, width, height);
    return TRUE;
}

static gboolean wait_for_all(script *s, char *rest) {
    (void)rest;
    s->waits = true;
    wait_for_frames(s);
    return TRUE;
}

static gboolean shoot(script *s, char *rest) {
    s->shot = rest;
    wait_for_frames(s);
    return TRUE;
}

static gboolean pause_for(script *s, char *rest) {
    s->resume_at = viewer_seconds() + g_ascii_strtod(rest, NULL);
    return TRUE;
}

static gboolean print_stall(script *s, char *rest) {
    (void)rest;
    g_print("stall: %.0f ms\n", 1e3 * s->stall);
    s->stall = 0.0;
    s->ticked_at = NAN;
    return TRUE;
}

static gboolean audit_window(script *s, char *rest) {
    (void)rest;
    return viewer_audit(s->v) == 0 || fail(s, "the window is not for everybody");
}

static gboolean print_note(script *s, char *rest) {
    (void)s;
    g_print("%s\n", rest);
    return TRUE;
}

/* What is no action, or not alone. */
static const struct {
    const char *name;
    gboolean (*run)(script *s, char *rest); /* whether to go on */
} STEPS[] = {
    {"wait", wait_for_all},  {"pause", pause_for},    {"resize", resize},
    {"print", print_text},   {"expect", expect_text}, {"place", print_place},
    {"enter", enter_text},   {"focus", focus_widget}, {"press", press_key},
    {"point", move_pointer}, {"screenshot", shoot},   {"stall", print_stall},
    {"audit", audit_window}, {"note", print_note},    {"type", type_text},
};

static gboolean step(script *s, char *line) {
    g_strstrip(line);
    char *rest = line + strcspn(line, " ");
    if (*rest != '\0') {
        *rest++ = '\0';
    }
    if (line[0] == '\0' || line[0] == '#') {
        return TRUE;
    }
    for (size_t i = 0; i < G_N_ELEMENTS(STEPS); ++i) {
        if (strcmp(line, STEPS[i].name) == 0) {
            return STEPS[i].run(s, rest);
        }
    }
    return activate(s, line, rest);
}

/* Is there something to wait for? */
static bool is_unsettled(script *s) {
    if (viewer_seconds() < s->resume_at) {
        return true;
    }
    if (s->waits && (viewer_requests_busy(s->v) || s->v->picture_is_old)) {
        wait_for_frames(s);
        return true;
    }
    if (frame_now(s) < s->shown_at) {
        gtk_widget_queue_draw(GTK_WIDGET(s->v->window));
        return true;
    }
    if (s->waits) {
        s->waits = false;
        note_complaint_of_model(s);
    }
    return false;
}

/* How long the window was deaf. */
static void notice_stall(script *s) {
    double now = viewer_seconds();
    s->stall = fmax(s->stall, now - s->ticked_at); /* of NAN and a number the number */
    s->ticked_at = now;
}

static gboolean tick(gpointer user) {
    script *s = user;
    notice_stall(s);
    if (s->v->window == NULL) {
        return G_SOURCE_REMOVE;
    }
    if (is_unsettled(s)) {
        return G_SOURCE_CONTINUE;
    }
    if (s->shot != NULL) {
        viewer_act_text(s->v, "screenshot", s->shot);
        s->shot = NULL;
    }
    if (s->lines[s->at] != NULL && step(s, s->lines[s->at++])) {
        return G_SOURCE_CONTINUE;
    }
    judge_complaint(s);
    gtk_window_close(s->v->window);
    return G_SOURCE_REMOVE;
}

/* So that a picture shows what was done, not how long ago. */
static void hold_still(viewer *v) {
    g_object_set(gtk_widget_get_settings(GTK_WIDGET(v->window)), "gtk-enable-animations", FALSE,
                 "gtk-cursor-blink", FALSE, NULL);
}

void viewer_script_run(viewer *v, const char *name, char *text) {
    script *s = g_new0(script, 1);
    hold_still(v);
    s->v = v;
    s->name = g_strdup(name);
    s->ticked_at = NAN;
    s->waits = true;
    wait_for_frames(s);
    s->lines = g_strsplit(text, "\n", -1);
    g_free(text);
    viewer_listen(v, on_changed, s); /* until the window is closed, and it outlives that */
    g_timeout_add_full(G_PRIORITY_DEFAULT, TICK_MS, tick, s, script_free);
}
