/* SPDX-License-Identifier: Apache-2.0 */
#include "dropping.h"

#include "utf8.h"

#include <srp/table.h>

/* What is no table (srp_table_format_of()). */
static const struct {
    const char *ending, *action;
    bool alone;            /* the window has room for one of them */
    bool comes_with_model; /* one that is dropped with it finds this by itself */
    int tab;               /* where it is seen; -1: everywhere */
} KINDS[] = {
    {".obj", "open", true, false, -1},           {".mtl", "mtl", false, true, -1},
    {".plates", "plates", true, false, -1},      {".yaml", "mission", true, false, TAB_ORBIT},
    {".yml", "mission", true, false, TAB_ORBIT},
};

/* -1: none of them. */
static int kind_of(const char *path) {
    for (int k = 0; k < (int)G_N_ELEMENTS(KINDS); ++k) {
        if (cli_ends_with(path, KINDS[k].ending)) {
            return k;
        }
    }
    return -1;
}

static bool is_action(viewer *v, const char *name) {
    return g_action_map_lookup_action(G_ACTION_MAP(v->window), name) != NULL;
}

/* What is dropped at once. */
typedef struct dropped {
    viewer *v;
    bool has_model;
    bool taken[G_N_ELEMENTS(KINDS)];
} dropped;

/* NULL: taken; or why not. */
static const char *take(dropped *d, const char *path) {
    if (srp_table_format_of(path) != NULL) {
        viewer_act_text(d->v, "open-table", path);
        return NULL;
    }
    int kind = kind_of(path);
    if (kind < 0 || !is_action(d->v, KINDS[kind].action)) {
        return "expected a spacecraft (.obj), optics (.mtl), plates (.plates), a table (.nc, .spo, "
               ".txt) or a mission (.yaml)";
    }
    if (d->taken[kind]) {
        return "another file of its kind was dropped with it, and there is room for one";
    }
    d->taken[kind] = KINDS[kind].alone;
    if (!KINDS[kind].comes_with_model || !d->has_model) {
        viewer_act_text(d->v, KINDS[kind].action, path);
    }
    if (KINDS[kind].tab >= 0) {
        viewer_act_text(d->v, "tab", VIEWER_TAB_NAME[KINDS[kind].tab]);
    }
    return NULL;
}

void viewer_drop(viewer *v, const char *const *paths, size_t count) {
    dropped d = {.v = v};
    viewer_words problem = {""};
    for (size_t i = 0; i < count; ++i) {
        d.has_model = d.has_model || cli_ends_with(paths[i], ".obj");
    }
    for (size_t i = 0; i < count; ++i) {
        const char *why = take(&d, paths[i]);
        if (why != NULL) {
            char *line = g_strdup_printf("%s: %s", paths[i], why);
            viewer_words_add(&problem, line);
            g_free(line);
        }
    }
    if (problem.text[0] != '\0') {
        viewer_complain(v, problem.text);
    }
}

static gboolean on_drop(GtkDropTarget *target, const GValue *value, double x, double y,
                        gpointer user) {
    (void)target, (void)x, (void)y;
    GPtrArray *paths = g_ptr_array_new_with_free_func(g_free);
    for (GSList *at = g_value_get_boxed(value); at != NULL; at = at->next) {
        /* What is not of this machine has no path: its address has no ending that is known. */
        char *path = g_file_get_path(at->data);
        g_ptr_array_add(paths, path != NULL ? path : g_file_get_uri(at->data));
    }
    viewer_drop(user, (const char *const *)paths->pdata, paths->len);
    g_ptr_array_unref(paths);
    return TRUE;
}

void viewer_drop_begin(viewer *v) {
    GtkDropTarget *drop = gtk_drop_target_new(GDK_TYPE_FILE_LIST, GDK_ACTION_COPY);
    g_signal_connect(drop, "drop", G_CALLBACK(on_drop), v);
    gtk_widget_add_controller(GTK_WIDGET(v->window), GTK_EVENT_CONTROLLER(drop));
    gtk_widget_add_css_class(GTK_WIDGET(v->window), "srp-viewer");
}
