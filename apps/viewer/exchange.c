/* SPDX-License-Identifier: Apache-2.0 */
#include "exchange.h"

#include "messages.h"
#include "numbers.h"
#include "saving.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- in ---- */

/* What `library` has for the materials of the engine's shape goes into the setup. How many. */
static size_t take_optics(viewer *v, const srp_materials *library, viewer_words *problem) {
    const cli_info *info = &v->session->engine->shape->info;
    size_t count = 0;
    for (size_t i = 0; i < info->material_count; ++i) {
        srp_optics optics;
        const char *name = info->materials[i].name;
        count += srp_materials_find(library, name, &optics) &&
                 viewer_setup_set_material(v->session->setup, name, optics, problem);
    }
    return count;
}

void viewer_exchange_open_mtl(viewer *v, const char *path) {
    const viewer_engine *engine = v->session->engine;
    srp_materials *library = NULL;
    srp_error error;
    viewer_words problem = {""};
    if (engine == NULL || engine->shape == NULL) {
        viewer_complain(v, VIEWER_NO_SPACECRAFT);
        return;
    }
    viewer_words_listen(&problem);
    const srp_log log = cli_log();
    bool good = srp_materials_create(&library, &error) == SRP_OK &&
                srp_materials_read_mtl(library, path, &log, &error) == SRP_OK;
    viewer_words_listen(NULL);
    if (!good) {
        viewer_words_add_error(&problem, &error);
    } else if (take_optics(v, library, &problem) == 0) {
        char *said = g_strdup_printf("%s: has optics for none of the materials of %s", path,
                                     engine->shape->path);
        viewer_words_add(&problem, said);
        g_free(said);
        good = false;
    }
    srp_materials_destroy(library);
    viewer_complain(v, problem.text);
    if (good) {
        viewer_tell(v, CHANGED_SETUP);
        viewer_request_engine(v, false);
    }
}

/* ---- dialogs ---- */

typedef struct question {
    viewer *v;
    void (*answered)(viewer *v, const char *action, const char *path);
    const char *action;
} question;

static void on_response(GtkNativeDialog *dialog, int response, gpointer user) {
    question *asked = user;
    if (response == GTK_RESPONSE_ACCEPT && asked->v->window != NULL) {
        GFile *file = gtk_file_chooser_get_file(GTK_FILE_CHOOSER(dialog));
        char *path = file != NULL ? g_file_get_path(file) : NULL;
        if (path != NULL) {
            asked->answered(asked->v, asked->action, path);
        }
        g_free(path);
        g_clear_object(&file);
    }
    g_free(asked);
    g_object_unref(dialog);
}

static void add_filter(GtkFileChooser *dialog, const char *kind, const char *const *patterns) {
    GtkFileFilter *filter = gtk_file_filter_new();
    gtk_file_filter_set_name(filter, kind);
    for (size_t i = 0; patterns[i] != NULL; ++i) {
        gtk_file_filter_add_pattern(filter, patterns[i]);
    }
    gtk_file_chooser_add_filter(dialog, filter);
    g_object_unref(filter);
}

/* Begins where the spacecraft is, or where the program was started. */
static void choose_folder(const viewer *v, GtkFileChooser *dialog) {
    const char *model = v->session->setup->model;
    char *folder = model != NULL ? g_path_get_dirname(model) : g_get_current_dir();
    GFile *file = g_file_new_for_path(folder);
    (void)gtk_file_chooser_set_current_folder(dialog, file, NULL);
    g_object_unref(file);
    g_free(folder);
}

/* Asks for a file whose ending is one of `patterns`. `name` is proposed; NULL: none. */
static void ask_and(const question *what, const char *title, GtkFileChooserAction how,
                    const char *kind, const char *const *patterns, const char *name) {
    static const char *const all[] = {"*", NULL};
    GtkFileChooserNative *dialog =
        gtk_file_chooser_native_new(title, what->v->window, how, NULL, NULL);
    add_filter(GTK_FILE_CHOOSER(dialog), kind, patterns);
    add_filter(GTK_FILE_CHOOSER(dialog), "All files", all);
    choose_folder(what->v, GTK_FILE_CHOOSER(dialog));
    if (name != NULL) {
        gtk_file_chooser_set_current_name(GTK_FILE_CHOOSER(dialog), name);
    }
    question *asked = g_new0(question, 1);
    *asked = *what;
    gtk_native_dialog_set_modal(GTK_NATIVE_DIALOG(dialog), TRUE);
    g_signal_connect(dialog, "response", G_CALLBACK(on_response), asked);
    gtk_native_dialog_show(GTK_NATIVE_DIALOG(dialog));
}

static void act(viewer *v, const char *action, const char *path) {
    viewer_act_text(v, action, path);
}

/* Asks for a file to be opened, and hands it to an action. */
static void ask(viewer *v, const char *title, const char *action, const char *kind,
                const char *const *patterns) {
    const question what = {v, act, action};
    ask_and(&what, title, GTK_FILE_CHOOSER_ACTION_OPEN, kind, patterns, NULL);
}

static const char *const TABLES[] = {"*.nc", "*.spo", "*.txt", NULL};

void viewer_exchange_ask_open(viewer *v) {
    static const char *const patterns[] = {"*.obj", "*.OBJ", NULL};
    ask(v, "Open a Spacecraft", "open", "Wavefront OBJ", patterns);
}

void viewer_exchange_ask_plates(viewer *v) {
    static const char *const patterns[] = {"*.plates", "*.txt", NULL};
    ask(v, "Open Plates", "plates", "Plates", patterns);
}

void viewer_exchange_ask_mtl(viewer *v) {
    static const char *const patterns[] = {"*.mtl", "*.MTL", NULL};
    ask(v, "Find the MTL File", "mtl", "Wavefront MTL", patterns);
}

void viewer_exchange_miss_mtl(viewer *v) {
    static const char KEY[] = "mtl-asked-for"; /* the spacecraft */
    const viewer_engine *engine = v->session->engine;
    GObject *place = G_OBJECT(v->application);
    if (v->scripted || v->window == NULL || viewer_engine_missing_mtl(engine) == NULL ||
        g_strcmp0(g_object_get_data(place, KEY), engine->shape->path) == 0) {
        return;
    }
    g_object_set_data_full(place, KEY, g_strdup(engine->shape->path), g_free);
    viewer_exchange_ask_mtl(v);
}

void viewer_exchange_ask_table(viewer *v) {
    ask(v, "Open a Table", "open-table", "Tables", TABLES);
}

static void ask_save_as(viewer *v, const char *name);

/* A name that this tab cannot save is asked for once more, with an ending that it can. */
static void save(viewer *v, const char *action, const char *chosen) {
    const viewer_saving *saving = viewer_saving_now(v);
    char *path = viewer_text_end_once(chosen);
    if (path == NULL || g_file_test(path, G_FILE_TEST_EXISTS)) { /* which nobody was asked about */
        free(path);
        path = viewer_text_copy(chosen);
    }
    if (path == NULL) {
        return;
    }
    viewer_act_text(v, action, path);
    if (!viewer_saving_takes(saving, path)) {
        char *base = g_path_get_basename(path);
        char *name = g_strconcat(base, strrchr(saving->name, '.'), NULL);
        ask_save_as(v, name);
        g_free(name);
        g_free(base);
    }
    free(path);
}

static void ask_save_as(viewer *v, const char *name) {
    const viewer_saving *saving = viewer_saving_now(v);
    const question what = {v, save, "save"};
    ask_and(&what, saving->title, GTK_FILE_CHOOSER_ACTION_SAVE, "What this tab saves",
            saving->patterns, name);
}

void viewer_exchange_ask_save(viewer *v) {
    ask_save_as(v, viewer_saving_now(v)->name);
}

void viewer_exchange_ask_mission(viewer *v, int which) {
    static const char *const patterns[] = {"*.yaml", "*.yml", NULL};
    ask(v, "Open a Mission", which == 0 ? "mission" : "versus", "Missions", patterns);
}

char *viewer_exchange_force_command(const viewer *v) {
    double az, el;
    char az_text[CLI_NUMBER_SIZE], el_text[CLI_NUMBER_SIZE], az_name[] = "--az", el_name[] = "--el";
    viewer_attitude_sun(&v->session->attitude, &az, &el);
    cli_write_number(az, az_text);
    cli_write_number(el, el_text);
    char *const extra[] = {az_name, az_text, el_name, el_text};
    return viewer_setup_command(v->session->setup, "force", extra, 4);
}
