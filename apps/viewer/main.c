/* SPDX-License-Identifier: Apache-2.0 */
/* srp-viewer: spacecraft in sunlight, to be looked at. */
#include "actions.h"
#include "script.h"
#include "state.h"
#include "viewer.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef SRP_CLI_HAS_ORBIT
#include <gsl/gsl_errno.h>
#endif

/* Exit statuses, as of srp. */
enum { BAD_USAGE = 2, MACHINE_FAILED = 3 };

typedef struct start {
    viewer v;
    char **operands;
    char *model, *tab, *screenshot, *size, *actions;
    int width, height; /* of `size` */
    gboolean list, fresh, remember;
} start;

static GOptionEntry entries(const char *name, GOptionArg kind, gpointer target, const char *help,
                            const char *value) {
    GOptionEntry entry = {name, 0, 0, kind, target, help, value};
    return entry;
}

/* ---- scripts from options ---- */

static char *read_script(const char *path, GError **error) {
    char *text = NULL;
    return g_file_get_contents(path, &text, NULL, error) ? text : NULL;
}

/* The file of --actions, and then what --screenshot stands for. */
static char *script_of(const start *s, GError **error) {
    GString *text = g_string_new("");
    if (s->actions != NULL) {
        char *steps = read_script(s->actions, error);
        if (steps == NULL) {
            g_string_free(text, TRUE);
            return NULL;
        }
        g_string_append(text, steps);
        g_free(steps);
    }
    if (s->screenshot != NULL) {
        g_string_append_printf(text, "\nwait\nscreenshot %s\n", s->screenshot);
    }
    return g_string_free(text, FALSE);
}

/* ---- life of the program ---- */

static void begin(viewer *v) {
    v->session = viewer_session_create();
    if (v->session == NULL) {
        g_error("no memory");
    }
    v->listeners = g_ptr_array_new_with_free_func(g_free);
    v->camera = (viewer_camera){-50.0, 24.0, 1.0};
    v->shadows = true;
    v->table_shown = v->compared[0] = v->compared[1] = -1;
    v->charts_together = true;
    v->plates_to_fit = 8;
    v->az_step_deg = v->el_step_deg = 10.0;
    v->asked_at = NAN;
    for (int k = 0; k < VIEWER_CHARTS; ++k) {
        v->chart_view[k][0] = 210.0;
        v->chart_view[k][1] = 35.0;
    }
    v->session->attitude = (viewer_attitude){{0.0, 20.0, -30.0}};
    viewer_requests_begin(v);
}

/* False when something still computes, and cannot be told to stop. */
static bool end(viewer *v) {
    if (!viewer_requests_end(v)) {
        return false;
    }
    viewer_session_destroy(v->session);
    g_ptr_array_unref(v->listeners);
    return true;
}

/* In the midst of what computes, whose files (the cache) take their places whole or not at all.
 * Other streams than these two may be in its hands. */
static void end_at_once(int status) {
    fflush(stdout);
    fflush(stderr);
    _Exit(status);
}

static void on_activate(GtkApplication *application, gpointer user) {
    start *s = user;
    viewer *v = &s->v;
    (void)application;
    if (v->window != NULL) {
        gtk_window_present(v->window);
        return;
    }
    v->scripted = s->actions != NULL || s->screenshot != NULL;
    v->remembers = (!v->scripted || s->remember) && !s->fresh;
    viewer_build_window(v);
    if (v->remembers) {
        viewer_state_load(v);
    }
    if (s->size != NULL) {
        gtk_window_set_default_size(v->window, s->width, s->height);
    }
    viewer_tell(v, CHANGED_ALL);
    gtk_window_present(v->window);
    if (s->tab != NULL) {
        viewer_act_text(v, "tab", s->tab);
    }
    if (v->scripted) {
        GError *error = NULL;
        char *text = script_of(s, &error);
        if (text == NULL) {
            g_printerr("srp-viewer: %s\n", error->message);
            g_error_free(error);
            v->exit_status = BAD_USAGE;
            gtk_window_close(v->window);
            return;
        }
        viewer_script_run(v, s->actions, text);
    }
    if (s->model != NULL) {
        viewer_act_text(v, "open", s->model);
    }
}

static void print_actions(void) {
    size_t count;
    const viewer_action *actions = viewer_action_list(&count);
    for (size_t i = 0; i < count; ++i) {
        const char *type = actions[i].type;
        const char *kind = type == NULL                ? ""
                           : g_strcmp0(type, "s") == 0 ? " TEXT"
                           : g_strcmp0(type, "i") == 0 ? " N"
                                                       : " NUMBER";
        g_print("%s%s\n    %s%s%s%s\n", actions[i].name, kind, actions[i].help,
                actions[i].keys != NULL ? " (" : "", actions[i].keys != NULL ? actions[i].keys : "",
                actions[i].keys != NULL ? ")" : "");
    }
}

static bool is_tab(const char *tab) {
    bool known = tab == NULL;
    for (int i = 0; i < TAB_COUNT && !known; ++i) {
        known = strcmp(tab, VIEWER_TAB_NAME[i]) == 0;
    }
    if (known) {
        return true;
    }
    g_printerr("srp-viewer: --tab %s: expected spacecraft, graphics, compare or orbit\n", tab);
    return false;
}

static bool read_size(start *s) {
    int end = 0;
    if (s->size == NULL || (sscanf(s->size, "%5dx%5d%n", &s->width, &s->height, &end) == 2 &&
                            s->size[end] == '\0' && viewer_is_window_size(s->width, s->height))) {
        return true;
    }
    g_printerr("srp-viewer: --size %s: expected WIDTHxHEIGHT, %d to %d pixels each, as 1280x800\n",
               s->size, WINDOW_SIZE_MIN, WINDOW_SIZE_MAX);
    return false;
}

static int parse(start *s, int *argc, char ***argv) {
    gboolean version = FALSE;
    GOptionEntry options[] = {
        entries("actions", G_OPTION_ARG_FILENAME, &s->actions,
                "Run the steps of this file, then close ('print', 'expect', 'wait', any action)",
                "FILE"),
        entries("model", G_OPTION_ARG_FILENAME, &s->model, "The same as MODEL.obj", "FILE"),
        entries("tab", G_OPTION_ARG_STRING, &s->tab, "Show spacecraft, graphics, compare or orbit",
                "TAB"),
        entries("screenshot", G_OPTION_ARG_FILENAME, &s->screenshot,
                "Save a picture of the window as PNG, then close", "FILE"),
        entries("size", G_OPTION_ARG_STRING, &s->size, "Size of the window in pixels",
                "WIDTHxHEIGHT"),
        entries("fresh", G_OPTION_ARG_NONE, &s->fresh,
                "Take nothing from the last time, and leave it as it is", NULL),
        entries("remember", G_OPTION_ARG_NONE, &s->remember,
                "Remember things with --actions and --screenshot, too", NULL),
        entries("list-actions", G_OPTION_ARG_NONE, &s->list, "Print all actions", NULL),
        entries("version", G_OPTION_ARG_NONE, &version, "Print the version", NULL),
        entries(G_OPTION_REMAINING, G_OPTION_ARG_FILENAME_ARRAY, &s->operands, NULL, "[MODEL.obj]"),
        {NULL, 0, 0, G_OPTION_ARG_NONE, NULL, NULL, NULL}};
    GError *error = NULL;
    GOptionContext *context = g_option_context_new(NULL);
    g_option_context_set_summary(
        context, "Shows a spacecraft in sunlight: its shadows, the force on it, tables of all\n"
                 "directions, and how far two of them are apart.");
    g_option_context_add_main_entries(context, options, NULL);
    gboolean good = g_option_context_parse(context, argc, argv, &error);
    g_option_context_free(context);
    if (!good) {
        g_printerr("srp-viewer: %s\nTry 'srp-viewer --help' for more information.\n",
                   error->message);
        g_error_free(error);
        return BAD_USAGE;
    }
    if (version) {
        g_print("srp-viewer " SRP_VERSION "\n");
        return 0;
    }
    if (s->list) {
        print_actions();
        return 0;
    }
    if (!is_tab(s->tab) || !read_size(s)) {
        return BAD_USAGE;
    }
    guint operands = s->operands != NULL ? g_strv_length(s->operands) : 0;
    if (operands + (s->model != NULL) > 1) {
        g_printerr("srp-viewer: expected one MODEL.obj\n");
        return BAD_USAGE;
    }
    if (operands == 1) {
        s->model = g_strdup(s->operands[0]);
    }
    return -1; /* go on */
}

/* Without the sentence of GTK about it, which names no remedy. */
static bool has_display(void) {
    if (gtk_init_check()) {
        return true;
    }
    g_printerr("srp-viewer: there is no display to open a window on (DISPLAY or WAYLAND_DISPLAY).\n"
               "Without one, 'srp' computes the same, and 'xvfb-run srp-viewer --screenshot' makes "
               "pictures.\n");
    return false;
}

int main(int argc, char **argv) {
    static start s; /* larger than a stack needs to hold */
    setlocale(LC_ALL, "");
    setlocale(LC_NUMERIC, "C"); /* numbers are the same as srp's, and as in files */
    gtk_disable_setlocale();
    int status = parse(&s, &argc, &argv);
    if (status < 0) {
        status = MACHINE_FAILED;
        if (has_display()) {
#ifdef SRP_CLI_HAS_ORBIT
            gsl_set_error_handler_off(); /* it would end the program */
#endif
            begin(&s.v);
            s.v.application =
                gtk_application_new("io.github.srpcore.Viewer", G_APPLICATION_NON_UNIQUE);
            g_signal_connect(s.v.application, "activate", G_CALLBACK(on_activate), &s);
            status = g_application_run(G_APPLICATION(s.v.application), 1, argv);
            status = status != 0 ? MACHINE_FAILED : s.v.exit_status;
            if (!end(&s.v)) {
                end_at_once(status);
            }
            g_object_unref(s.v.application);
        }
    }
    g_free(s.actions);
    g_free(s.tab);
    g_free(s.screenshot);
    g_free(s.size);
    g_strfreev(s.operands);
    g_free(s.model);
    return status;
}
