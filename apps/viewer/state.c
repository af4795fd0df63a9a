/* SPDX-License-Identifier: Apache-2.0 */
#include "state.h"

#include <math.h>
#include <string.h>

enum { RECENT_MAX = 8 };

/* Of the whole program: the menu outlives windows. */
static const char WINDOW[] = "window", METHOD[] = "method", LIGHT[] = "spacecraft",
                  TABLE[] = "table", RECENT[] = "recent";

static char *file_name(void) {
    return g_build_filename(g_get_user_config_dir(), "srpcore", "viewer.ini", NULL);
}

static GMenu *recent_menu(viewer *v) {
    GMenu *menu = g_object_get_data(G_OBJECT(v->application), "recent");
    if (menu == NULL) {
        menu = g_menu_new();
        g_object_set_data_full(G_OBJECT(v->application), "recent", menu, g_object_unref);
    }
    return menu;
}

GMenuModel *viewer_state_recent_menu(viewer *v) {
    return G_MENU_MODEL(recent_menu(v));
}

static char *recent_path(GMenu *menu, int at) {
    char *path = NULL;
    g_menu_model_get_item_attribute(G_MENU_MODEL(menu), at, G_MENU_ATTRIBUTE_TARGET, "s", &path);
    return path;
}

static void put(GMenu *menu, int at, const char *path) {
    char *base = g_path_get_basename(path), *label = g_utf8_make_valid(base, -1);
    char **parts = g_strsplit(label, "_", -1);
    char *plain = g_strjoinv("__", parts); /* no mnemonics */
    GMenuItem *item = g_menu_item_new(plain, NULL);
    g_menu_item_set_action_and_target(item, "win.open", "s", path);
    g_menu_insert_item(menu, at, item);
    g_object_unref(item);
    g_free(plain);
    g_strfreev(parts);
    g_free(label);
    g_free(base);
}

void viewer_state_note_recent(viewer *v, const char *path) {
    GMenu *menu = recent_menu(v);
    /* How many of the list were opened by this window; they stand first. */
    int noted = GPOINTER_TO_INT(g_object_get_data(G_OBJECT(menu), "noted"));
    if (!g_utf8_validate(path, -1, NULL)) {
        return; /* a menu cannot name it */
    }
    for (int i = g_menu_model_get_n_items(G_MENU_MODEL(menu)) - 1; i >= 0; --i) {
        char *old = recent_path(menu, i);
        if (g_strcmp0(old, path) == 0 || i >= RECENT_MAX - 1) {
            g_menu_remove(menu, i);
            noted -= i < noted;
        }
        g_free(old);
    }
    put(menu, 0, path);
    g_object_set_data(G_OBJECT(menu), "noted", GINT_TO_POINTER(noted + 1));
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

/* Each option as it was typed; one that this version does not take is left out. */
static void load_method(viewer *v, GKeyFile *file) {
    viewer_words ignored = {""};
    for (int i = 0; i < METHOD_OPTION_COUNT; ++i) {
        char *text = g_key_file_get_string(file, METHOD, cli_group_method.options[i].name, NULL);
        if (text != NULL) {
            viewer_setup_set_method_option(v->session->setup, i, text, &ignored);
        }
        g_free(text);
    }
    if (viewer_setup_method(v->session->setup) == NULL) {
        viewer_setup_set_method_option(v->session->setup, METHOD_NAME, "", &ignored);
        viewer_setup_set_method_option(v->session->setup, METHOD_DEVICE, "", &ignored);
    }
    char *mass = g_key_file_get_string(file, LIGHT, "mass", NULL);
    viewer_setup_set_mass(v->session->setup, mass, &ignored);
    g_free(mass);
}

static double number(GKeyFile *file, const char *key, double otherwise) {
    double value = g_key_file_get_double(file, TABLE, key, NULL);
    return value >= 0.01 && value <= 180.0 ? value : otherwise;
}

void viewer_state_load(viewer *v) {
    GKeyFile *file = g_key_file_new();
    char *name = file_name();
    if (g_key_file_load_from_file(file, name, G_KEY_FILE_NONE, NULL)) {
        load_window(v, file);
        load_method(v, file);
        v->az_step_deg = number(file, "az-step", v->az_step_deg);
        v->el_step_deg = number(file, "el-step", v->el_step_deg);
        char **paths = g_key_file_get_string_list(file, RECENT, "files", NULL, NULL);
        GMenu *menu = recent_menu(v);
        for (int i = 0; paths != NULL && paths[i] != NULL && i < RECENT_MAX; ++i) {
            put(menu, i, paths[i]);
        }
        g_strfreev(paths);
        viewer_tell(v, CHANGED_SETUP);
    }
    g_free(name);
    g_key_file_unref(file);
}

/* ---- writing ---- */

/* Ours, newest first, then what another window has written since this one read the file. */
static void save_recent(viewer *v, GKeyFile *file) {
    GMenu *menu = recent_menu(v);
    int noted = GPOINTER_TO_INT(g_object_get_data(G_OBJECT(menu), "noted"));
    char **theirs = g_key_file_get_string_list(file, RECENT, "files", NULL, NULL);
    GPtrArray *paths = g_ptr_array_new_with_free_func(g_free);
    for (int i = 0; i < noted && i < g_menu_model_get_n_items(G_MENU_MODEL(menu)); ++i) {
        g_ptr_array_add(paths, recent_path(menu, i));
    }
    for (int i = 0; theirs != NULL && theirs[i] != NULL; ++i) {
        if (!g_ptr_array_find_with_equal_func(paths, theirs[i], g_str_equal, NULL)) {
            g_ptr_array_add(paths, g_strdup(theirs[i]));
        }
    }
    g_key_file_set_string_list(file, RECENT, "files", (const char *const *)paths->pdata,
                               MIN(paths->len, (guint)RECENT_MAX));
    g_ptr_array_unref(paths);
    g_strfreev(theirs);
}

void viewer_state_save(viewer *v) {
    GKeyFile *file = g_key_file_new();
    char *name = file_name(), *directory = g_path_get_dirname(name);
    int width, height;
    gboolean dark;
    (void)g_key_file_load_from_file(file, name, G_KEY_FILE_NONE, NULL);
    (void)g_key_file_remove_group(file, METHOD, NULL);
    (void)g_key_file_remove_group(file, LIGHT, NULL);
    gtk_window_get_default_size(v->window, &width, &height);
    g_object_get(gtk_widget_get_settings(GTK_WIDGET(v->window)),
                 "gtk-application-prefer-dark-theme", &dark, NULL);
    g_key_file_set_integer(file, WINDOW, "width", width);
    g_key_file_set_integer(file, WINDOW, "height", height);
    g_key_file_set_boolean(file, WINDOW, "dark", dark);
    g_key_file_set_integer(file, WINDOW, "tab", gtk_notebook_get_current_page(v->tabs));
    const viewer_setup *setup = v->session->setup;
    for (int i = 0; i < METHOD_OPTION_COUNT; ++i) {
        if (setup->method_option[i] != NULL) {
            g_key_file_set_string(file, METHOD, cli_group_method.options[i].name,
                                  setup->method_option[i]);
        }
    }
    if (!isnan(setup->mass)) {
        g_key_file_set_double(file, LIGHT, "mass", setup->mass);
    }
    g_key_file_set_double(file, TABLE, "az-step", v->az_step_deg);
    g_key_file_set_double(file, TABLE, "el-step", v->el_step_deg);
    save_recent(v, file);
    if (g_mkdir_with_parents(directory, 0700) == 0) {
        (void)g_key_file_save_to_file(file, name, NULL);
    }
    g_free(directory);
    g_free(name);
    g_key_file_unref(file);
}
