/* SPDX-License-Identifier: Apache-2.0 */
/* Compare graphics: how far table B is from table A. */
#include "chart.h"
#include "comparison.h"
#include "comparison_view.h"
#include "facing.h"
#include "fit.h"
#include "methods.h"
#include "text_file.h"
#include "ui.h"
#include "viewer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 6, PROGRESS_MS = 200 };

typedef struct pane {
    viewer *v;
    GtkWidget *box, *choice[2], *number[CLI_DIFFERENCE_COUNT][COLUMNS], *facts, *plates;
    GtkWidget *fit, *cancel, *progress;
    guint timer; /* while plates are fitted */
    viewer_charts *charts;
    viewer_table *shown[2]; /* or about to be; NULL: none */
    bool known;             /* they have been compared: */
    cli_comparison found;   /* released */
    char *name[2];          /* theirs in it */
    bool quiet;
} pane;

static const char *const FIELD_NAME[CHARTS] = {"Δf#dx#u [m²]", "Δf#dy#u [m²]", "Δf#dz#u [m²]",
                                               "|Δf| [m²]"};

/* While there are not two tables. */
static const char *nothing_yet(const viewer *v) {
    return v->session->table_count == 1
               ? "Compute or open a second table: then the two are compared here."
               : "Two tables of this session, or from disk, are compared here: compute or open "
                 "them.";
}

/* ---- numbers ---- */

/* As `srp compare` prints them. */
static void show_row(pane *p, int which, const cli_difference_row *row) {
    char text[COLUMNS][40];
    snprintf(text[0], sizeof text[0], "%.6e", row->mse);
    snprintf(text[1], sizeof text[1], "%.6e", row->rms);
    snprintf(text[2], sizeof text[2], "%.6e", row->mean);
    snprintf(text[3], sizeof text[3], "%.6e", row->largest);
    snprintf(text[4], sizeof text[4], "%g", row->az_deg);
    snprintf(text[5], sizeof text[5], "%g", row->el_deg);
    for (int k = 0; k < COLUMNS; ++k) {
        gtk_label_set_text(GTK_LABEL(p->number[which][k]), text[k]);
    }
}

/* ---- the comparison, beside the window ---- */

typedef struct comparison_job {
    viewer_job job;
    viewer *v;
    pane *p; /* there as long as the window */
    viewer_table *table[2];
    char *name[2]; /* for messages and for what is saved */
    bool good;
    cli_comparison found;
    double *value; /* (CHARTS, nodes) */
    viewer_words problem;
} comparison_job;

static void comparison_run(viewer_job *base) {
    comparison_job *job = (comparison_job *)base;
    cli_comparison *c = &job->found;
    *c = (cli_comparison){.table = {job->table[0]->table, job->table[1]->table},
                          .name = {job->name[0], job->name[1]},
                          .scheme = srp_interp_find("bicubic")};
    viewer_words_listen(&job->problem);
    job->good = cli_comparison_make(c) == CLI_DONE;
    viewer_words_listen(NULL);
    if (job->good) {
        job->value = calloc(CHARTS * srp_grid_node_count(c->grid), sizeof *job->value);
    }
    if (job->value != NULL && !atomic_load(&job->job.cancel)) {
        cli_comparison_fields(c, job->value);
    }
    cli_comparison_release(c);
}

/* Meshes that differ; plates are compared with meshes to see what they miss. */
static bool are_of_two_shapes(const srp_table_info *a, const srp_table_info *b) {
    const srp_table_info *const both[2] = {a, b};
    for (int k = 0; k < 2; ++k) {
        const srp_method *method = cli_method_find(both[k]->method, "cpu");
        if (method == NULL || (method->shapes & SRP_SHAPE_MESH) == 0 ||
            both[k]->shape_hash[0] == '\0') {
            return false;
        }
    }
    return strcmp(a->shape_hash, b->shape_hash) != 0;
}

static void note_shapes(const cli_comparison *c, char *text, size_t size) {
    const srp_table_info *a = srp_table_get_info(c->table[0]), *b = srp_table_get_info(c->table[1]);
    if (are_of_two_shapes(a, b)) {
        snprintf(text, size, "\nA and B are of different shapes: %.100s and %.100s.", a->title,
                 b->title);
    }
}

static void show_facts(pane *p) {
    const cli_comparison *c = &p->found;
    char facts[600], note[300] = "";
    note_shapes(c, note, sizeof note);
    snprintf(facts, sizeof facts,
             "%zu directions, %g° × %g°, each by its solid angle; mean |f| of A %.6g m², of B "
             "%.6g m²%s",
             c->directions, 360.0 / (c->grid.az_count - 1), 180.0 / (c->grid.el_count - 1),
             c->difference.mean_a, c->difference.mean_b, note);
    gtk_label_set_text(GTK_LABEL(p->facts), facts);
}

static void forget(pane *p) {
    p->known = false;
    for (int k = 0; k < 2; ++k) {
        g_clear_pointer(&p->name[k], g_free);
    }
}

/* Takes over what was found, for those who save it. */
static void keep(pane *p, comparison_job *job) {
    forget(p);
    p->known = true;
    p->found = job->found;
    for (int k = 0; k < 2; ++k) {
        p->name[k] = g_steal_pointer(&job->name[k]);
    }
}

static void comparison_deliver(viewer_job *base) {
    comparison_job *job = (comparison_job *)base;
    pane *p = job->p;
    viewer *v = job->v;
    if (v->window == NULL || job->table[0] != p->shown[0] || job->table[1] != p->shown[1]) {
        return; /* others have been chosen */
    }
    if (!job->good) {
        gtk_label_set_text(GTK_LABEL(p->facts), "These two cannot be compared.");
        viewer_complain_about(v, ABOUT_TABLE, job->problem.text);
        return;
    }
    keep(p, job);
    for (int k = 0; k < CLI_DIFFERENCE_COUNT; ++k) {
        show_row(p, k, &p->found.difference.row[k]);
    }
    show_facts(p);
    if (job->value != NULL) {
        char *title = g_strdup_printf("%s minus %s", job->table[1]->name, job->table[0]->name);
        viewer_charts_show(p->charts, title, p->found.grid, job->value, FIELD_NAME);
        job->value = NULL;
        g_free(title);
    }
}

static void comparison_release(viewer_job *base) {
    comparison_job *job = (comparison_job *)base;
    for (int k = 0; k < 2; ++k) {
        viewer_table_release(job->table[k]);
        g_free(job->name[k]);
    }
    free(job->value);
    free(job);
}

static void request_comparison(pane *p) {
    comparison_job *job = g_new0(comparison_job, 1);
    job->job = (viewer_job){
        .run = comparison_run, .deliver = comparison_deliver, .release = comparison_release};
    job->v = p->v;
    job->p = p;
    for (int k = 0; k < 2; ++k) {
        job->table[k] = viewer_table_reference(p->shown[k]);
        job->name[k] = p->shown[k]->path != NULL
                           ? g_strdup(p->shown[k]->path)
                           : g_strdup_printf("Table %d", p->v->compared[k] + 1);
    }
    viewer_worker_cancel(p->v->requests.tables, SLOT_COMPARISON);
    viewer_worker_submit(p->v->requests.tables, SLOT_COMPARISON, &job->job);
    viewer_tell(p->v, CHANGED_BUSY);
}

static void set_shown(pane *p, viewer_table *a, viewer_table *b) {
    viewer_table *const now[2] = {a, b};
    for (int k = 0; k < 2; ++k) {
        viewer_table *old = p->shown[k];
        p->shown[k] = viewer_table_reference(now[k]);
        viewer_table_release(old);
    }
}

/* Numbers of no tables, while there are none or others are compared. */
static void show_nothing(pane *p, const char *facts) {
    forget(p);
    for (int k = 0; k < CLI_DIFFERENCE_COUNT; ++k) {
        for (int c = 0; c < COLUMNS; ++c) {
            gtk_label_set_text(GTK_LABEL(p->number[k][c]), "—");
        }
    }
    gtk_label_set_text(GTK_LABEL(p->facts), facts);
    viewer_charts_show(p->charts, "", (srp_grid){0, 0}, NULL, FIELD_NAME);
}

/* ---- choices ---- */

static void on_choice(GtkDropDown *choice, GParamSpec *spec, gpointer user) {
    pane *p = user;
    (void)spec;
    int which = GTK_WIDGET(choice) == p->choice[1];
    guint at = gtk_drop_down_get_selected(choice);
    if (!p->quiet && at != GTK_INVALID_LIST_POSITION && (int)at != p->v->compared[which]) {
        viewer_act(p->v, which == 0 ? "compare-a" : "compare-b",
                   g_variant_new_int32((gint32)at + 1));
    }
}

static void show_lists(pane *p) {
    p->quiet = true;
    for (int k = 0; k < 2; ++k) {
        ui_choice_set_tables(p->v, GTK_DROP_DOWN(p->choice[k]), p->v->compared[k]);
    }
    p->quiet = false;
}

/* The newest two, until the user chooses. */
static void choose_by_default(pane *p) {
    int count = (int)p->v->session->table_count;
    for (int k = 0; k < 2; ++k) {
        if (p->v->compared[k] < 0 && count > k) {
            p->v->compared[k] = k;
        }
    }
}

/* What is chosen is compared when somebody looks. */
static void refresh(pane *p) {
    viewer_table *now[2] = {NULL, NULL};
    for (int k = 0; k < 2; ++k) {
        if (p->v->compared[k] >= 0) {
            now[k] = p->v->session->tables[p->v->compared[k]];
        }
    }
    if (now[0] == NULL || now[1] == NULL) {
        viewer_worker_cancel(p->v->requests.tables, SLOT_COMPARISON);
        set_shown(p, NULL, NULL);
        show_nothing(p, nothing_yet(p->v));
    } else if (gtk_widget_get_mapped(p->box) && (now[0] != p->shown[0] || now[1] != p->shown[1])) {
        set_shown(p, now[0], now[1]);
        show_nothing(p, "Comparing …");
        request_comparison(p);
    }
}

static void on_map(GtkWidget *box, gpointer user) {
    (void)box;
    refresh(user);
}

/* ---- progress of the fit ---- */

static void show_progress(pane *p) {
    const char *held_up = viewer_held_up(p->v, SLOT_FIT, viewer_fit_is_cancelling(p->v));
    char text[64];
    snprintf(text, sizeof text, "Fitting … %.0f s", floor(viewer_fit_seconds(p->v)));
    gtk_progress_bar_set_text(GTK_PROGRESS_BAR(p->progress), held_up != NULL ? held_up : text);
}

static gboolean on_tick(gpointer user) {
    pane *p = user;
    if (p->v->window == NULL || !viewer_fit_is_running(p->v)) {
        p->timer = 0;
        return G_SOURCE_REMOVE;
    }
    show_progress(p);
    gtk_progress_bar_pulse(GTK_PROGRESS_BAR(p->progress)); /* nobody knows how long it takes */
    return G_SOURCE_CONTINUE;
}

static void show_busy(pane *p) {
    bool busy = viewer_fit_is_running(p->v);
    gtk_widget_set_sensitive(p->fit, p->v->compared[0] >= 0 && !busy);
    gtk_widget_set_sensitive(p->cancel, busy && !viewer_fit_is_cancelling(p->v));
    gtk_widget_set_opacity(p->progress, busy ? 1.0 : 0.0);
    if (busy) {
        show_progress(p);
    }
    if (busy && p->timer == 0) {
        p->timer = g_timeout_add(PROGRESS_MS, on_tick, p);
    }
}

static void on_changed(void *user, unsigned what) {
    pane *p = user;
    if ((what & (CHANGED_BUSY | CHANGED_TABLES)) != 0) {
        choose_by_default(p);
        show_busy(p);
    }
    if ((what & (CHANGED_TABLES | CHANGED_ENGINE)) != 0) {
        show_lists(p);
    }
    if ((what & CHANGED_TABLES) != 0) {
        refresh(p);
    }
    if ((what & CHANGED_SETUP) != 0) {
        ui_number_show(p->plates, p->v->plates_to_fit);
    }
}

static void free_pane(gpointer user) {
    pane *p = user;
    if (p->timer != 0) {
        g_source_remove(p->timer);
    }
    set_shown(p, NULL, NULL);
    forget(p);
    g_free(p);
}

/* ---- together ---- */

static GtkWidget *small_heading(const char *text, float xalign) {
    GtkWidget *head = ui_label(text, "heading small");
    gtk_label_set_xalign(GTK_LABEL(head), xalign);
    return head;
}

/* Rows `first` to `first` + `count` - 1 of the comparison as columns side by side. */
static GtkWidget *make_block(pane *p, int first, int count) {
    static const char *const heads[CLI_DIFFERENCE_COUNT] = {"x", "y", "z", "|B| − |A|", "|B − A|"};
    static const char *const rows[COLUMNS] = {"MSE [m⁴]",     "RMS [m²]", "Mean [m²]",
                                              "Largest [m²]", "az [°]",   "el [°]"};
    static const char *const words[COLUMNS] = {"mse", "rms", "mean", "largest", "az", "el"};
    static const char *const of[3] = {"B − A, x", "B − A, y", "B − A, z"};
    GtkWidget *grid = gtk_grid_new();
    gtk_grid_set_column_spacing(GTK_GRID(grid), 8);
    gtk_grid_attach(GTK_GRID(grid), small_heading("B − A", 0.0f), 0, 0, 1, 1);
    for (int c = 0; c < COLUMNS; ++c) {
        gtk_grid_attach(GTK_GRID(grid), ui_label(rows[c], "dim small"), 0, 1 + c, 1, 1);
    }
    for (int k = 0; k < count; ++k) {
        int r = first + k;
        gtk_grid_attach(GTK_GRID(grid), small_heading(heads[r], 1.0f), 1 + k, 0, 1, 1);
        for (int c = 0; c < COLUMNS; ++c) {
            char name[48], spoken[64];
            snprintf(name, sizeof name, "%s-%s", CLI_DIFFERENCE_NAME[r], words[c]);
            snprintf(spoken, sizeof spoken, "%s of %s", rows[c], r < 3 ? of[r] : heads[r]);
            p->number[r][c] = ui_value(name, spoken);
            gtk_widget_set_size_request(p->number[r][c], 96, -1);
            gtk_label_set_text(GTK_LABEL(p->number[r][c]), "—");
            gtk_grid_attach(GTK_GRID(grid), p->number[r][c], 1 + k, 1 + c, 1, 1);
        }
    }
    return grid;
}

static GtkWidget *make_side(pane *p) {
    GtkWidget *side = ui_box(GTK_ORIENTATION_VERTICAL, 8);
    p->facts = ui_paragraph("comparison-facts", "dim small", 20);
    gtk_label_set_text(GTK_LABEL(p->facts), nothing_yet(p->v));
    gtk_box_append(GTK_BOX(side), make_block(p, 0, 3));
    gtk_box_append(GTK_BOX(side), make_block(p, 3, 2));
    gtk_box_append(GTK_BOX(side), p->facts);
    return ui_side(side);
}

static void on_fit(GtkButton *button, gpointer user) {
    pane *p = user;
    (void)button;
    viewer_act(p->v, "fit", g_variant_new_take_string(g_strdup_printf("%d", p->v->plates_to_fit)));
}

static void on_plates(GtkWidget *plates, void *user) {
    viewer *v = ((pane *)user)->v;
    v->plates_to_fit = (int)ui_number_value(plates);
    viewer_complain(v, "");
    ui_number_show(plates, v->plates_to_fit);
}

/* How many, and the button that fits them. */
static GtkWidget *make_fit(pane *p) {
    const ui_range counts = {1.0, CLI_NORMALS_MAX, 1.0, true};
    p->plates = ui_number(p->v, "plates-count", "Plates to fit", counts, on_plates, p);
    ui_number_show(p->plates, p->v->plates_to_fit);
    gtk_editable_set_width_chars(GTK_EDITABLE(p->plates), 2);
    gtk_widget_set_tooltip_text(p->plates, "How many plates");
    p->fit = gtk_button_new_with_mnemonic("_Fit Plates to A");
    gtk_widget_set_name(p->fit, "fit");
    ui_name(p->fit, "Fit Plates to A");
    gtk_widget_set_valign(p->fit, GTK_ALIGN_CENTER);
    gtk_widget_set_tooltip_text(p->fit,
                                "Find the N-plate model that comes nearest to A; it becomes B, "
                                "and the differences are its residuals");
    g_signal_connect(p->fit, "clicked", G_CALLBACK(on_fit), p);
    GtkWidget *box = ui_pair(ui_mnemonic("Plate_s", p->plates), p->plates);
    gtk_box_append(GTK_BOX(box), p->fit);
    return box;
}

static GtkWidget *make_strip(pane *p) {
    static const char *const words[2] = {"_A", "_B"};
    static const char *const names[2] = {"Table A", "Table B"};
    GtkWidget *box = ui_strip(8);
    for (int k = 0; k < 2; ++k) {
        p->choice[k] = ui_choice(k == 0 ? "compare-a" : "compare-b", G_CALLBACK(on_choice), p);
        ui_name(p->choice[k], names[k]);
        gtk_widget_set_hexpand(p->choice[k], TRUE);
        gtk_widget_set_size_request(p->choice[k], 160, -1);
        gtk_box_append(GTK_BOX(box), ui_pair(ui_mnemonic(words[k], p->choice[k]), p->choice[k]));
    }
    gtk_box_append(GTK_BOX(box), ui_button("O_pen…", "choose-table", "Open a table from disk"));
    gtk_box_append(
        GTK_BOX(box),
        ui_button("Sav_e…", "choose-save",
                  "Save the comparison (.txt), its figure (.png, .svg, .pdf) or fitted plates "
                  "(.plates)"));
    gtk_box_append(GTK_BOX(box), make_fit(p));
    p->cancel = ui_button("Cance_l", "cancel", "Stop (Ctrl+.)");
    gtk_widget_set_name(p->cancel, "cancel-fit");
    gtk_box_append(GTK_BOX(box), p->cancel);
    p->progress = ui_progress("fit-progress", "Progress of the fit");
    gtk_box_append(GTK_BOX(box), p->progress);
    gtk_widget_add_css_class(box, "strip");
    gtk_widget_add_css_class(box, "pane");
    return box;
}

GtkWidget *viewer_compare_tab(viewer *v) {
    pane *p = g_new0(pane, 1);
    p->v = v;
    GtkWidget *box = p->box = ui_box(GTK_ORIENTATION_VERTICAL, 0);
    GtkWidget *below = ui_box(GTK_ORIENTATION_HORIZONTAL, 0);
    p->charts = viewer_charts_create(v, "difference", NULL);
    g_object_set_data(G_OBJECT(v->window), "comparison", p);
    gtk_box_append(GTK_BOX(below), viewer_charts_widget(p->charts));
    gtk_box_append(GTK_BOX(below), make_side(p));
    gtk_box_append(GTK_BOX(box), make_strip(p));
    gtk_box_append(GTK_BOX(box), below);
    g_signal_connect_after(box, "map", G_CALLBACK(on_map), p);
    g_object_set_data_full(G_OBJECT(box), "pane", p, free_pane);
    viewer_listen(v, on_changed, p);
    return box;
}

/* The pane whose comparison can be saved; NULL, said: there is none. */
static pane *pane_to_save(viewer *v, viewer_words *problem) {
    pane *p = g_object_get_data(G_OBJECT(v->window), "comparison");
    if (viewer_worker_is_busy(v->requests.tables, SLOT_COMPARISON)) {
        viewer_words_add(problem, "The tables are still being compared.");
    } else if (!p->known) {
        viewer_words_add(problem, "Nothing has been compared yet.");
    } else {
        return p;
    }
    return NULL;
}

bool viewer_comparison_save_figure(viewer *v, const char *path, viewer_words *problem) {
    pane *p = pane_to_save(v, problem);
    return p != NULL && viewer_charts_save(p->charts, path, problem);
}

bool viewer_comparison_save_text(viewer *v, const char *path, viewer_words *problem) {
    const pane *p = pane_to_save(v, problem);
    if (p == NULL) {
        return false;
    }
    const srp_table_info *info = srp_table_get_info(p->shown[0]->table);
    cli_text_file file;
    viewer_words_listen(problem);
    int status = cli_text_file_begin(&file, path);
    if (status == CLI_DONE) {
        cli_comparison_print(file.out, &p->found, info->mass, info->light);
        status = cli_text_file_end(&file);
    }
    viewer_words_listen(NULL);
    return status == CLI_DONE;
}
