/* SPDX-License-Identifier: Apache-2.0 */
#include "exchange.h"

#include "chart.h"
#include "comparison_view.h"
#include "fit.h"
#include "messages.h"
#include "numbers.h"
#include "orbit.h"
#include "outputs.h"
#include "table_input.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- in ---- */

void viewer_exchange_open(viewer *v, const char *path) {
    viewer_setup *setup = v->session->setup;
    /* A name that means the same wherever the program is started next. */
    char *full = g_canonicalize_filename(path, NULL);
    bool other = setup->model == NULL || strcmp(setup->model, full) != 0;
    if (other) {
        viewer_setup_clear_materials(setup);
    }
    if (viewer_setup_set_model(setup, full)) {
        viewer_complain(v, "");
        viewer_tell(v, CHANGED_SETUP);
        viewer_request_engine(v, !other);
    }
    g_free(full);
}

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
        viewer_complain(v, "There is no spacecraft yet: open one.");
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

void viewer_exchange_open_table(viewer *v, const char *path) {
    viewer_words problem = {""};
    srp_table *table = NULL;
    viewer_words_listen(&problem);
    int status = cli_table_open_checked(path, &table);
    viewer_words_listen(NULL);
    if (status != CLI_DONE) {
        viewer_complain(v, problem.text);
        return;
    }
    char summary[256], name[400];
    cli_table_summary(table, summary, sizeof summary);
    char *base = g_path_get_basename(path);
    snprintf(name, sizeof name, "%zu: %.100s (%s)", v->session->table_count + 1, base, summary);
    g_free(base);
    viewer_table entry = {table, viewer_text_copy(name), NULL, viewer_text_copy(path), 0};
    if (viewer_session_add_table(v->session, entry)) {
        v->table_shown = (int)v->session->table_count - 1;
    }
    viewer_complain(v, "");
    viewer_tell(v, CHANGED_TABLES);
}

/* ---- out ---- */

/* With the words of the program's own writers. */
static int write_table(const viewer_table *entry, const char *path, viewer_words *problem) {
    const char *items[] = {path};
    cli_list paths = {items, 1};
    size_t written;
    const srp_table_info *info = srp_table_get_info(entry->table);
    cli_table_content content = {info->mass == info->mass, false};
    viewer_words_listen(problem);
    int status = cli_outputs_check(&paths, content, NULL, 0);
    if (status == CLI_DONE) {
        status = cli_outputs_write(&paths, entry->table, &written);
    }
    viewer_words_listen(NULL);
    return status;
}

static void save_table(viewer *v, const char *path) {
    viewer_words problem = {""};
    if (v->table_shown < 0) {
        viewer_complain(v, "There is no table yet: compute or open one.");
        return;
    }
    viewer_table *entry = v->session->tables[v->table_shown];
    if (write_table(entry, path, &problem) != CLI_DONE) {
        viewer_complain(v, problem.text);
        return;
    }
    char *copy = viewer_text_copy(path);
    if (copy != NULL) {
        free(entry->path);
        entry->path = copy;
    }
    char *said = g_strdup_printf("Saved %s.", path);
    viewer_say(v, said);
    g_free(said);
}

static void save_plates(viewer *v, const char *path) {
    viewer_words problem = {""};
    bool good = viewer_fit_save(v, path, &problem);
    char *said = g_strdup_printf("Saved %s.", path);
    good ? viewer_say(v, said) : viewer_complain(v, problem.text);
    g_free(said);
}

static void save_rows(viewer *v, const char *path) {
#ifdef SRP_CLI_HAS_ORBIT
    viewer_words problem = {""};
    bool good = viewer_orbit_save(v, path, &problem);
    char *said = g_strdup_printf("Saved %s.", path);
    good ? viewer_say(v, said) : viewer_complain(v, problem.text);
    g_free(said);
#else
    (void)path;
    viewer_complain(v, "This build has no missions.");
#endif
}

void viewer_exchange_save(viewer *v, const char *path) {
    if (srp_table_format_of(path) != NULL) {
        save_table(v, path);
        return;
    }
    viewer_words problem = {""};
    if (g_str_has_suffix(path, ".csv")) {
        save_rows(v, path);
        return;
    }
    if (g_str_has_suffix(path, ".plates")) {
        save_plates(v, path);
        return;
    }
    bool compares = gtk_notebook_get_current_page(v->tabs) == TAB_COMPARE;
    bool good =
        compares ? viewer_comparison_save(v, path, &problem) : viewer_chart_save(v, path, &problem);
    char *said = g_strdup_printf("Saved %s.", path);
    good ? viewer_say(v, said) : viewer_complain(v, problem.text);
    g_free(said);
}

/* ---- dialogs ---- */

typedef struct question {
    viewer *v;
    const char *action;
} question;

static void on_response(GtkNativeDialog *dialog, int response, gpointer user) {
    question *asked = user;
    if (response == GTK_RESPONSE_ACCEPT && asked->v->window != NULL) {
        GFile *file = gtk_file_chooser_get_file(GTK_FILE_CHOOSER(dialog));
        char *path = file != NULL ? g_file_get_path(file) : NULL;
        if (path != NULL) {
            viewer_act_text(asked->v, asked->action, path);
        }
        g_free(path);
        g_clear_object(&file);
    }
    g_free(asked);
    g_object_unref(dialog);
}

/* Asks for a file whose ending is one of `patterns`, and hands it to an action. */
static void ask(viewer *v, const char *title, const char *action, GtkFileChooserAction how,
                const char *kind, const char *const *patterns) {
    GtkFileChooserNative *dialog = gtk_file_chooser_native_new(title, v->window, how, NULL, NULL);
    GtkFileFilter *filter = gtk_file_filter_new();
    gtk_file_filter_set_name(filter, kind);
    for (size_t i = 0; patterns[i] != NULL; ++i) {
        gtk_file_filter_add_pattern(filter, patterns[i]);
    }
    gtk_file_chooser_add_filter(GTK_FILE_CHOOSER(dialog), filter);
    g_object_unref(filter);
    question *asked = g_new0(question, 1);
    *asked = (question){v, action};
    gtk_native_dialog_set_modal(GTK_NATIVE_DIALOG(dialog), TRUE);
    g_signal_connect(dialog, "response", G_CALLBACK(on_response), asked);
    gtk_native_dialog_show(GTK_NATIVE_DIALOG(dialog));
}

static const char *const TABLES[] = {"*.nc", "*.spo", "*.txt", NULL};

void viewer_exchange_ask_open(viewer *v) {
    static const char *const patterns[] = {"*.obj", "*.OBJ", NULL};
    ask(v, "Open a Spacecraft", "open", GTK_FILE_CHOOSER_ACTION_OPEN, "Wavefront OBJ", patterns);
}

void viewer_exchange_ask_plates(viewer *v) {
    static const char *const patterns[] = {"*.plates", "*.txt", NULL};
    ask(v, "Open Plates", "plates", GTK_FILE_CHOOSER_ACTION_OPEN, "Plates", patterns);
}

void viewer_exchange_ask_mtl(viewer *v) {
    static const char *const patterns[] = {"*.mtl", "*.MTL", NULL};
    ask(v, "Find the MTL File", "mtl", GTK_FILE_CHOOSER_ACTION_OPEN, "Wavefront MTL", patterns);
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
    ask(v, "Open a Table", "open-table", GTK_FILE_CHOOSER_ACTION_OPEN, "Tables", TABLES);
}

void viewer_exchange_ask_save(viewer *v) {
    static const char *const patterns[] = {"*.nc",  "*.spo", "*.txt",    "*.png", "*.svg",
                                           "*.pdf", "*.csv", "*.plates", NULL};
    ask(v, "Save Table or Figure", "save", GTK_FILE_CHOOSER_ACTION_SAVE, "Tables and figures",
        patterns);
}

void viewer_exchange_ask_mission(viewer *v, int which) {
    static const char *const patterns[] = {"*.yaml", "*.yml", NULL};
    ask(v, "Open a Mission", which == 0 ? "mission" : "versus", GTK_FILE_CHOOSER_ACTION_OPEN,
        "Missions", patterns);
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
