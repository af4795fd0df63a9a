/* SPDX-License-Identifier: Apache-2.0 */
#include "state.h"

#include "recent.h"
#include "system.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static const char WINDOW[] = "window", METHOD[] = "method", TABLE[] = "table";

/* GLib takes a relative $XDG_CONFIG_HOME, too, which the specification has ignored. */
static char *file_name(void) {
    const char *home = g_getenv("XDG_CONFIG_HOME");
    if (home != NULL && g_path_is_absolute(home)) {
        return g_build_filename(home, "srpcore", "viewer.ini", NULL);
    }
    return g_build_filename(g_get_home_dir(), ".config", "srpcore", "viewer.ini", NULL);
}

/* ---- reading ---- */

static void load_window(viewer *v, GKeyFile *file) {
    int width = g_key_file_get_integer(file, WINDOW, "width", NULL);
    int height = g_key_file_get_integer(file, WINDOW, "height", NULL);
    if (width >= 600 && height >= 400 && width <= 20000 && height <= 20000) {
        gtk_window_set_default_size(v->window, width, height);
    }
    if (g_key_file_get_boolean(file, WINDOW, "dark", NULL)) {
        viewer_act(v, "dark", NULL);
    }
    int tab = g_key_file_get_integer(file, WINDOW, "tab", NULL);
    if (tab > 0 && tab < TAB_COUNT) {
        gtk_notebook_set_current_page(v->tabs, tab);
    }
}

/* Each option as it was typed, but for what is a spacecraft's; one that this version does not take
 * is left out. */
static void load_method(viewer *v, GKeyFile *file) {
    viewer_words ignored = {""};
    for (int i = 0; i < METHOD_OPTION_COUNT; ++i) {
        char *text = g_key_file_get_string(file, METHOD, cli_group_method.options[i].name, NULL);
        if (text != NULL && !viewer_setup_is_of_spacecraft(i)) {
            viewer_setup_set_method_option(v->session->setup, i, text, &ignored);
        }
        g_free(text);
    }
}

static double number(GKeyFile *file, const char *key, double otherwise) {
    double value = g_key_file_get_double(file, TABLE, key, NULL);
    return value >= VIEWER_STEP_MIN_DEG && value <= VIEWER_STEP_MAX_DEG ? value : otherwise;
}

void viewer_state_load(viewer *v) {
    GKeyFile *file = g_key_file_new();
    char *name = file_name();
    if (g_key_file_load_from_file(file, name, G_KEY_FILE_NONE, NULL)) {
        load_window(v, file);
        load_method(v, file);
        v->az_step_deg = number(file, "az-step", v->az_step_deg);
        v->el_step_deg = number(file, "el-step", v->el_step_deg);
        viewer_recent_load(v, file);
        viewer_tell(v, CHANGED_SETUP);
    }
    g_free(name);
    g_key_file_unref(file);
}

/* ---- writing ---- */

static void write_file(GKeyFile *file, const char *name) {
    GError *error = NULL;
    bool special;
    char *directory = g_path_get_dirname(name);
    char *target = cli_system_write_target(name, &special); /* a link stays one */
    if (g_mkdir_with_parents(directory, 0700) != 0) {
        g_printerr("srp-viewer: nothing is remembered: %s: %s\n", directory, g_strerror(errno));
    } else if (!g_key_file_save_to_file(file, target != NULL ? target : name, &error)) {
        g_printerr("srp-viewer: nothing is remembered: %s\n", error->message);
        g_error_free(error);
    }
    free(target);
    g_free(directory);
}

void viewer_state_save(viewer *v) {
    GKeyFile *file = g_key_file_new();
    char *name = file_name();
    int width, height;
    gboolean dark;
    (void)g_key_file_load_from_file(file, name, G_KEY_FILE_NONE, NULL);
    (void)g_key_file_remove_group(file, METHOD, NULL);
    gtk_window_get_default_size(v->window, &width, &height);
    g_object_get(gtk_widget_get_settings(GTK_WIDGET(v->window)),
                 "gtk-application-prefer-dark-theme", &dark, NULL);
    g_key_file_set_integer(file, WINDOW, "width", width);
    g_key_file_set_integer(file, WINDOW, "height", height);
    g_key_file_set_boolean(file, WINDOW, "dark", dark);
    g_key_file_set_integer(file, WINDOW, "tab", gtk_notebook_get_current_page(v->tabs));
    const viewer_setup *setup = v->session->setup;
    for (int i = 0; i < METHOD_OPTION_COUNT; ++i) {
        if (setup->method_option[i] != NULL && !viewer_setup_is_of_spacecraft(i)) {
            g_key_file_set_string(file, METHOD, cli_group_method.options[i].name,
                                  setup->method_option[i]);
        }
    }
    g_key_file_set_double(file, TABLE, "az-step", v->az_step_deg);
    g_key_file_set_double(file, TABLE, "el-step", v->el_step_deg);
    viewer_recent_save(v, file);
    write_file(file, name);
    g_free(name);
    g_key_file_unref(file);
}
