/* SPDX-License-Identifier: Apache-2.0 */
#include "saving.h"

#include "chart.h"
#include "comparison_view.h"
#include "fit.h"
#include "numbers.h"
#include "orbit.h"
#include "outputs.h"
#include "restate.h"
#include "screenshot.h"
#include "ui.h"
#include "utf8.h"

#include <math.h>
#include <stdlib.h>

/* ---- spacecraft ---- */

static bool save_picture(viewer *v, const char *path, viewer_words *problem) {
    return viewer_picture_save(ui_find(v, "scene-picture"), path, problem);
}

/* ---- graphics ---- */

static bool set_mass(srp_table *table, double mass, viewer_words *problem) {
    cli_restate_options statement = cli_restate_options_default();
    statement.given = (cli_given)1 << RESTATE_MASS;
    statement.mass = mass;
    viewer_words_listen(problem);
    int status = cli_restate(&statement, NULL, table);
    viewer_words_listen(NULL);
    return status == CLI_DONE;
}

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

/* With the mass of now, where the file needs one and the table has none; it keeps none. */
static bool write_massive(viewer_table *entry, const char *path, double mass,
                          viewer_words *problem) {
    bool needs = (srp_table_format_of(path)->capabilities & SRP_FORMAT_MASS) != 0 &&
                 isnan(srp_table_get_info(entry->table)->mass) && !isnan(mass);
    if (needs && atomic_load(&entry->references) > 1) { /* another thread reads it */
        viewer_words_add(problem, "The table is being used: save it again when that is done.");
        return false;
    }
    if (needs && !set_mass(entry->table, mass, problem)) {
        return false;
    }
    bool good = write_table(entry, path, problem) == CLI_DONE;
    return (!needs || set_mass(entry->table, NAN, problem)) && good;
}

static bool save_table_or_figure(viewer *v, const char *path, viewer_words *problem) {
    if (v->table_shown < 0) {
        viewer_words_add(problem, VIEWER_NO_TABLE);
        return false;
    }
    if (srp_table_format_of(path) == NULL) {
        return viewer_chart_save(v, path, problem);
    }
    viewer_table *entry = v->session->tables[v->table_shown];
    if (!write_massive(entry, path, v->session->setup->mass, problem)) {
        return false;
    }
    char *copy = viewer_text_copy(path);
    if (copy != NULL) {
        free(entry->path);
        entry->path = copy;
    }
    return true;
}

/* ---- comparison ---- */

static bool save_comparison(viewer *v, const char *path, viewer_words *problem) {
    if (cli_ends_with(path, ".plates")) {
        return viewer_fit_save(v, path, problem);
    }
    return cli_ends_with(path, ".txt") ? viewer_comparison_save_text(v, path, problem)
                                       : viewer_comparison_save_figure(v, path, problem);
}

/* ---- all tabs ---- */

/* ", for the mass of 850 kg that ..." of a table in a format that states accelerations; "": it has
 * no mass. */
static char *said_of_mass(const viewer *v, const char *path) {
    const srp_table_format *format = srp_table_format_of(path);
    if (gtk_notebook_get_current_page(v->tabs) != TAB_GRAPHICS || format == NULL ||
        (format->capabilities & SRP_FORMAT_MASS) == 0) {
        return g_strdup("");
    }
    const viewer_table *entry = v->session->tables[v->table_shown];
    double own = srp_table_get_info(entry->table)->mass;
    char kg[CLI_NUMBER_SIZE];
    return isnan(own) ? g_strdup_printf(", for the mass of %s kg that is typed now",
                                        cli_write_number(v->session->setup->mass, kg))
                      : g_strdup_printf(", for the mass of %s kg that the table was computed with",
                                        cli_write_number(own, kg));
}

static const viewer_saving SAVINGS[TAB_COUNT] = {
    [TAB_SPACECRAFT] = {"Save the Picture",
                        "spacecraft.png",
                        "the picture of the spacecraft (.png)",
                        {"*.png"},
                        save_picture},
    [TAB_GRAPHICS] = {"Save Table or Figure",
                      "table.nc",
                      "the table (.nc, .spo, .txt) or its figure (.png, .svg, .pdf)",
                      {"*.nc", "*.spo", "*.txt", "*.png", "*.svg", "*.pdf"},
                      save_table_or_figure},
    [TAB_COMPARE] = {"Save Comparison, Figure or Plates",
                     "comparison.txt",
                     "the comparison (.txt), its figure (.png, .svg, .pdf) or fitted plates "
                     "(.plates)",
                     {"*.txt", "*.png", "*.svg", "*.pdf", "*.plates"},
                     save_comparison},
#ifdef SRP_CLI_HAS_ORBIT
    [TAB_ORBIT] = {"Save the Rows",
                   "orbit.csv",
                   "the rows of the orbit (.csv)",
                   {"*.csv"},
                   viewer_orbit_save},
#endif
};

static const char *tab_words(const viewer *v, int tab) {
    return gtk_notebook_get_tab_label_text(v->tabs, gtk_notebook_get_nth_page(v->tabs, tab));
}

bool viewer_saving_takes(const viewer_saving *saving, const char *path) {
    bool can = false;
    for (size_t i = 0; saving->patterns[i] != NULL; ++i) {
        can = can || cli_ends_with(path, saving->patterns[i] + 1);
    }
    return can;
}

/* What this tab saves, and which one saves that file. */
static void refuse(viewer *v, const char *path) {
    GString *text = g_string_new(path);
    g_string_append_printf(text, ": %s saves %s.",
                           tab_words(v, gtk_notebook_get_current_page(v->tabs)),
                           viewer_saving_now(v)->what);
    for (int i = 0; i < gtk_notebook_get_n_pages(v->tabs); ++i) {
        if (viewer_saving_takes(&SAVINGS[i], path)) {
            g_string_append_printf(text, " %s saves %s.", tab_words(v, i), SAVINGS[i].what);
        }
    }
    viewer_complain_about(v, ABOUT_SAVING, text->str);
    g_string_free(text, TRUE);
}

const viewer_saving *viewer_saving_now(const viewer *v) {
    return &SAVINGS[gtk_notebook_get_current_page(v->tabs)];
}

void viewer_save(viewer *v, const char *path) {
    const viewer_saving *saving = viewer_saving_now(v);
    viewer_words problem = {""};
    if (!viewer_saving_takes(saving, path)) {
        refuse(v, path);
        return;
    }
    if (!saving->save(v, path, &problem)) {
        viewer_complain_about(v, ABOUT_SAVING, problem.text);
        return;
    }
    char *mass = said_of_mass(v, path);
    char *said = g_strdup_printf("Saved %s%s.", path, mass);
    viewer_complain_about(v, ABOUT_SAVING, "");
    viewer_say(v, said);
    g_free(said);
    g_free(mass);
}
