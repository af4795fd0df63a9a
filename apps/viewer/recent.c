/* SPDX-License-Identifier: Apache-2.0 */
#include "recent.h"

#include <string.h>

enum { FILES_MAX = 8, LABEL_MAX = 64 };

static const char GROUP[] = "recent", KEY[] = "files";

/* Of the whole program: the menu outlives windows. */
typedef struct recent {
    GMenu *menu;
    GPtrArray *paths;
    guint noted; /* how many of them were opened by this program; they stand first */
} recent;

static void free_recent(gpointer user) {
    recent *r = user;
    g_object_unref(r->menu);
    g_ptr_array_unref(r->paths);
    g_free(r);
}

static recent *get(viewer *v) {
    recent *r = g_object_get_data(G_OBJECT(v->application), GROUP);
    if (r == NULL) {
        r = g_new0(recent, 1);
        r->menu = g_menu_new();
        r->paths = g_ptr_array_new_with_free_func(g_free);
        g_object_set_data_full(G_OBJECT(v->application), GROUP, r, free_recent);
    }
    return r;
}

GMenuModel *viewer_recent_menu(viewer *v) {
    return G_MENU_MODEL(get(v)->menu);
}

/* ---- labels ---- */

/* The last `count` parts of a path. */
static const char *tail(const char *path, int count) {
    const char *at = path + strlen(path);
    while (at > path) {
        if (at[-1] == G_DIR_SEPARATOR && count-- == 1) {
            break;
        }
        --at;
    }
    return at;
}

/* Is another file called the same by its last `count` parts? */
static bool is_ambiguous(const recent *r, const char *path, int count) {
    for (guint i = 0; i < r->paths->len; ++i) {
        const char *other = r->paths->pdata[i];
        if (strcmp(other, path) != 0 && strcmp(tail(other, count), tail(path, count)) == 0) {
            return true;
        }
    }
    return false;
}

/* As much of the path as tells it from the others, its middle left out where that is long; freed by
 * g_free(). */
static char *label_of(const recent *r, const char *path) {
    int count = 1;
    while (is_ambiguous(r, path, count)) {
        ++count;
    }
    const char *name = tail(path, count);
    glong length = g_utf8_strlen(name, -1), half = LABEL_MAX / 2;
    char *begin = g_utf8_substring(name, 0, MIN(length, half));
    char *end = g_utf8_substring(name, MAX(MIN(length, half), length - half), length);
    char *cut = g_strconcat(begin, length > LABEL_MAX ? "…" : "", end, NULL);
    char **parts = g_strsplit(cut, "_", -1);
    char *label = g_strjoinv("__", parts); /* no mnemonics */
    g_strfreev(parts);
    g_free(cut);
    g_free(end);
    g_free(begin);
    return label;
}

static void rebuild_menu(recent *r) {
    g_menu_remove_all(r->menu);
    for (guint i = 0; i < r->paths->len; ++i) {
        char *label = label_of(r, r->paths->pdata[i]);
        GMenuItem *item = g_menu_item_new(label, NULL);
        g_menu_item_set_action_and_target(item, "win.open", "s", (char *)r->paths->pdata[i]);
        g_menu_append_item(r->menu, item);
        g_object_unref(item);
        g_free(label);
    }
}

/* ---- the list ---- */

void viewer_recent_note(viewer *v, const char *path) {
    recent *r = get(v);
    guint at;
    if (!g_utf8_validate(path, -1, NULL)) {
        return; /* a menu cannot name it */
    }
    char *copy = g_strdup(path);
    if (g_ptr_array_find_with_equal_func(r->paths, path, g_str_equal, &at)) {
        g_ptr_array_remove_index(r->paths, at);
        r->noted -= at < r->noted;
    }
    g_ptr_array_insert(r->paths, 0, copy);
    g_ptr_array_set_size(r->paths, (int)MIN(r->paths->len, (guint)FILES_MAX));
    r->noted = MIN(r->noted + 1, r->paths->len);
    rebuild_menu(r);
}

/* Those of `file` that are not there yet, as long as there is room. */
static void append_from(GPtrArray *paths, GKeyFile *file) {
    char **theirs = g_key_file_get_string_list(file, GROUP, KEY, NULL, NULL);
    for (int i = 0; theirs != NULL && theirs[i] != NULL && paths->len < FILES_MAX; ++i) {
        if (!g_ptr_array_find_with_equal_func(paths, theirs[i], g_str_equal, NULL)) {
            g_ptr_array_add(paths, g_strdup(theirs[i]));
        }
    }
    g_strfreev(theirs);
}

void viewer_recent_load(viewer *v, GKeyFile *file) {
    recent *r = get(v);
    append_from(r->paths, file);
    rebuild_menu(r);
}

void viewer_recent_save(viewer *v, GKeyFile *file) {
    const recent *r = get(v);
    GPtrArray *paths = g_ptr_array_new_with_free_func(g_free);
    for (guint i = 0; i < r->noted; ++i) {
        g_ptr_array_add(paths, g_strdup(r->paths->pdata[i]));
    }
    append_from(paths, file);
    if (paths->len > 0) {
        g_key_file_set_string_list(file, GROUP, KEY, (const char *const *)paths->pdata, paths->len);
    }
    g_ptr_array_unref(paths);
}
