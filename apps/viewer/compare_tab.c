/* SPDX-License-Identifier: Apache-2.0 */
/* Compare graphics: how far table B is from table A. */
#include "chart.h"
#include "comparison.h"
#include "comparison_view.h"
#include "facing.h"
#include "fit.h"
#include "ui.h"
#include "viewer.h"

#include <stdio.h>
#include <stdlib.h>

enum { COLUMNS = 6 };

typedef struct pane {
    viewer *v;
    GtkWidget *choice[2], *number[CLI_DIFFERENCE_COUNT][COLUMNS], *facts, *plates, *fit;
    viewer_charts *charts;
    const srp_table *shown[2];
    bool quiet;
} pane;

static const char *const FIELD_NAME[CHARTS] = {"Δf#dx#u [m²]", "Δf#dy#u [m²]", "Δf#dz#u [m²]",
                                               "|Δf| [m²]"};

static const char NOTHING_YET[] = "Two tables of this session, or from disk, are compared here.";

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

static void show_comparison(pane *p) {
    const viewer_session *s = p->v->session;
    const viewer_table *a = &s->tables[p->v->compared[0]], *b = &s->tables[p->v->compared[1]];
    cli_comparison c = {.table = {a->table, b->table},
                        .name = {a->name, b->name},
                        .scheme = srp_interp_find("bicubic")};
    viewer_words problem = {""};
    viewer_words_listen(&problem);
    int status = cli_comparison_make(&c);
    viewer_words_listen(NULL);
    if (status != CLI_DONE) {
        viewer_complain(p->v, problem.text);
        cli_comparison_release(&c);
        return;
    }
    for (int k = 0; k < CLI_DIFFERENCE_COUNT; ++k) {
        show_row(p, k, &c.difference.row[k]);
    }
    char text[200];
    snprintf(
        text, sizeof text,
        "%zu directions, %g° × %g°, each by its solid angle; mean |f| of A %.6g m², of B %.6g m²",
        c.directions, 360.0 / (c.grid.az_count - 1), 180.0 / (c.grid.el_count - 1),
        c.difference.mean_a, c.difference.mean_b);
    gtk_label_set_text(GTK_LABEL(p->facts), text);
    size_t nodes = srp_grid_node_count(c.grid);
    double *value = calloc(CHARTS * nodes, sizeof *value);
    if (value != NULL) {
        cli_comparison_fields(&c, value);
        char *title = g_strdup_printf("%s minus %s", b->name, a->name);
        viewer_charts_show(p->charts, title, c.grid, value, FIELD_NAME);
        g_free(title);
    }
    cli_comparison_release(&c);
}

static void show_nothing(pane *p) {
    p->shown[0] = p->shown[1] = NULL;
    for (int k = 0; k < CLI_DIFFERENCE_COUNT; ++k) {
        for (int c = 0; c < COLUMNS; ++c) {
            gtk_label_set_text(GTK_LABEL(p->number[k][c]), "—");
        }
    }
    gtk_label_set_text(GTK_LABEL(p->facts), NOTHING_YET);
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
    const viewer_session *s = p->v->session;
    const char **names = g_new0(const char *, s->table_count + 1);
    for (size_t i = 0; i < s->table_count; ++i) {
        names[i] = s->tables[i].name;
    }
    p->quiet = true;
    for (int k = 0; k < 2; ++k) {
        int at = p->v->compared[k];
        ui_choice_set(GTK_DROP_DOWN(p->choice[k]), names,
                      at >= 0 ? (guint)at : GTK_INVALID_LIST_POSITION);
        gtk_widget_set_sensitive(p->choice[k], s->table_count > 0);
    }
    p->quiet = false;
    g_free(names);
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

static void on_changed(void *user, unsigned what) {
    pane *p = user;
    if ((what & CHANGED_BUSY) != 0) {
        gtk_widget_set_sensitive(p->fit, p->v->compared[0] >= 0 && !viewer_fit_is_running(p->v));
    }
    if ((what & CHANGED_TABLES) == 0) {
        return;
    }
    choose_by_default(p);
    gtk_widget_set_sensitive(p->fit, p->v->compared[0] >= 0 && !viewer_fit_is_running(p->v));
    show_lists(p);
    const srp_table *now[2] = {NULL, NULL};
    for (int k = 0; k < 2; ++k) {
        if (p->v->compared[k] >= 0) {
            now[k] = p->v->session->tables[p->v->compared[k]].table;
        }
    }
    if (now[0] == NULL || now[1] == NULL) {
        show_nothing(p);
    } else if (now[0] != p->shown[0] || now[1] != p->shown[1]) {
        p->shown[0] = now[0];
        p->shown[1] = now[1];
        show_comparison(p);
    }
}

/* ---- together ---- */

static GtkWidget *make_numbers(pane *p) {
    static const char *const heads[COLUMNS] = {"MSE [m⁴]",     "RMS [m²]", "Mean [m²]",
                                               "Largest [m²]", "az [°]",   "el [°]"};
    static const char *const rows[CLI_DIFFERENCE_COUNT] = {"x", "y", "z", "|B| − |A|", "|B − A|"};
    GtkWidget *grid = gtk_grid_new();
    gtk_grid_set_column_spacing(GTK_GRID(grid), 18);
    gtk_grid_attach(GTK_GRID(grid), ui_label("B − A", "heading small"), 0, 0, 1, 1);
    for (int c = 0; c < COLUMNS; ++c) {
        GtkWidget *head = ui_label(heads[c], "heading small");
        gtk_label_set_xalign(GTK_LABEL(head), 1.0f);
        gtk_grid_attach(GTK_GRID(grid), head, 1 + c, 0, 1, 1);
    }
    for (int r = 0; r < CLI_DIFFERENCE_COUNT; ++r) {
        gtk_grid_attach(GTK_GRID(grid), ui_label(rows[r], "dim"), 0, 1 + r, 1, 1);
        for (int c = 0; c < COLUMNS; ++c) {
            static const char *const words[COLUMNS] = {"mse", "rms", "mean", "largest", "az", "el"};
            char name[48];
            snprintf(name, sizeof name, "%s-%s", CLI_DIFFERENCE_NAME[r], words[c]);
            p->number[r][c] = ui_value(name);
            gtk_widget_set_size_request(p->number[r][c], 96, -1);
            gtk_label_set_text(GTK_LABEL(p->number[r][c]), "—");
            gtk_grid_attach(GTK_GRID(grid), p->number[r][c], 1 + c, 1 + r, 1, 1);
        }
    }
    gtk_widget_add_css_class(grid, "strip");
    return grid;
}

static void on_fit(GtkButton *button, gpointer user) {
    pane *p = user;
    (void)button;
    int plates = gtk_spin_button_get_value_as_int(GTK_SPIN_BUTTON(p->plates));
    viewer_act(p->v, "fit", g_variant_new_int32((gint32)plates));
}

static GtkWidget *make_strip(pane *p) {
    static const char *const words[2] = {"_A", "_B"};
    GtkWidget *box = ui_box(GTK_ORIENTATION_HORIZONTAL, 8);
    for (int k = 0; k < 2; ++k) {
        p->choice[k] = ui_choice(k == 0 ? "compare-a" : "compare-b", G_CALLBACK(on_choice), p);
        gtk_widget_set_hexpand(p->choice[k], TRUE);
        gtk_box_append(GTK_BOX(box), ui_mnemonic(words[k], p->choice[k]));
        gtk_box_append(GTK_BOX(box), p->choice[k]);
    }
    gtk_box_append(GTK_BOX(box), ui_button("O_pen…", "choose-table", "Open a table from disk"));
    gtk_box_append(GTK_BOX(box),
                   ui_button("Sav_e…", "choose-save",
                             "Save the figure (.png, .svg, .pdf) or fitted plates (.plates)"));
    p->plates = gtk_spin_button_new_with_range(1.0, CLI_NORMALS_MAX, 1.0);
    gtk_spin_button_set_value(GTK_SPIN_BUTTON(p->plates), 8.0);
    gtk_editable_set_width_chars(GTK_EDITABLE(p->plates), 2);
    ui_name(p->plates, "Number of plates");
    gtk_widget_set_name(p->plates, "plates-count");
    gtk_widget_set_tooltip_text(p->plates, "How many plates");
    gtk_widget_set_valign(p->plates, GTK_ALIGN_CENTER);
    p->fit = gtk_button_new_with_mnemonic("_Fit Plates to A");
    gtk_widget_set_name(p->fit, "fit");
    gtk_widget_set_valign(p->fit, GTK_ALIGN_CENTER);
    gtk_widget_set_tooltip_text(p->fit,
                                "Find the N-plate model that comes nearest to A; it becomes B, "
                                "and the differences are its residuals");
    g_signal_connect(p->fit, "clicked", G_CALLBACK(on_fit), p);
    gtk_box_append(GTK_BOX(box), p->plates);
    gtk_box_append(GTK_BOX(box), p->fit);
    gtk_widget_add_css_class(box, "strip");
    gtk_widget_add_css_class(box, "pane");
    return box;
}

GtkWidget *viewer_compare_tab(viewer *v) {
    pane *p = g_new0(pane, 1);
    p->v = v;
    GtkWidget *box = ui_box(GTK_ORIENTATION_VERTICAL, 0);
    p->charts = viewer_charts_create(v, "difference", 4);
    p->facts = ui_label(NOTHING_YET, "dim small");
    gtk_widget_set_name(p->facts, "comparison-facts");
    gtk_widget_set_margin_start(p->facts, 12);
    gtk_widget_set_margin_top(p->facts, 4);
    g_object_set_data(G_OBJECT(v->window), "comparison-charts", p->charts);
    gtk_box_append(GTK_BOX(box), ui_strip(make_strip(p)));
    gtk_box_append(GTK_BOX(box), p->facts);
    gtk_box_append(GTK_BOX(box), make_numbers(p));
    gtk_box_append(GTK_BOX(box), viewer_charts_widget(p->charts));
    g_object_set_data_full(G_OBJECT(box), "pane", p, g_free);
    viewer_listen(v, on_changed, p);
    return box;
}

bool viewer_comparison_save(viewer *v, const char *path, viewer_words *problem) {
    return viewer_charts_save(g_object_get_data(G_OBJECT(v->window), "comparison-charts"), path,
                              problem);
}
