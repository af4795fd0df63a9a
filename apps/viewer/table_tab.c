/* SPDX-License-Identifier: Apache-2.0 */
/* Visualize graphics: a table of all directions is computed, looked at and saved. */
#include "chart.h"
#include "progress.h"
#include "ui.h"
#include "viewer.h"

#include <stdio.h>
#include <stdlib.h>

enum { PROGRESS_MS = 200 };

typedef struct pane {
    viewer *v;
    GtkWidget *az_step, *el_step, *start, *cancel, *progress, *table, *reoptic, *together, *facts;
    viewer_charts *charts;
    const srp_table *shown;
    guint timer;
    bool quiet;
} pane;

static const char *const FIELD_NAME[CHARTS] = {"f#dx#u [m²]", "f#dy#u [m²]", "f#dz#u [m²]",
                                               "|f| [m²]"};

/* ---- progress ---- */

static void show_progress(pane *p) {
    const char *held_up = viewer_held_up(p->v, SLOT_TABLE, viewer_table_is_cancelling(p->v));
    size_t done = atomic_load(&p->v->requests.table.done);
    size_t total = atomic_load(&p->v->requests.table.total);
    double seconds = viewer_seconds() - atomic_load(&p->v->requests.table.began);
    char text[128] = "preparing …";
    if (total > 0) {
        double share = (double)done / (double)total;
        snprintf(text, sizeof text, "%zu of %zu directions", done, total);
        if (done > 0 && done < total && seconds > 0.5) {
            snprintf(text, sizeof text, "%zu of %zu directions, %.0f s left", done, total,
                     seconds * (1.0 - share) / share);
        }
        gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(p->progress), share);
    } else {
        gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(p->progress), 0.0);
    }
    gtk_progress_bar_set_text(GTK_PROGRESS_BAR(p->progress), held_up != NULL ? held_up : text);
}

static gboolean on_tick(gpointer user) {
    pane *p = user;
    if (p->v->window == NULL || !viewer_worker_is_busy(p->v->requests.batch, SLOT_TABLE)) {
        p->timer = 0;
        return G_SOURCE_REMOVE;
    }
    show_progress(p);
    return G_SOURCE_CONTINUE;
}

static void show_busy(pane *p) {
    bool busy = viewer_worker_is_busy(p->v->requests.batch, SLOT_TABLE);
    gtk_widget_set_sensitive(p->cancel, busy && !viewer_table_is_cancelling(p->v));
    gtk_widget_set_opacity(p->progress, busy ? 1.0 : 0.0);
    if (busy) {
        show_progress(p);
    }
    if (busy && p->timer == 0) {
        p->timer = g_timeout_add(PROGRESS_MS, on_tick, p);
    }
}

/* ---- the table ---- */

static double *fields_of(const srp_table *table) {
    srp_grid grid = srp_table_grid(table);
    size_t nodes = srp_grid_node_count(grid), k = 0;
    double *value = calloc(CHARTS * nodes, sizeof *value);
    for (uint32_t i = 0; value != NULL && i < grid.az_count; ++i) {
        for (uint32_t j = 0; j < grid.el_count; ++j, ++k) {
            srp_vec3 f = srp_table_node(table, i, j)->f;
            value[k] = f.x;
            value[nodes + k] = f.y;
            value[2 * nodes + k] = f.z;
            value[3 * nodes + k] = srp_vec3_norm(f);
        }
    }
    return value;
}

static void show_table(pane *p) {
    int at = p->v->table_shown;
    const viewer_table *entry = at >= 0 ? p->v->session->tables[at] : NULL;
    const srp_table *table = entry != NULL ? entry->table : NULL;
    gtk_widget_set_tooltip_text(p->table, entry != NULL ? entry->command : NULL);
    if (table == p->shown) {
        return;
    }
    p->shown = table;
    viewer_charts_show(p->charts, entry != NULL ? entry->name : "",
                       table != NULL ? srp_table_grid(table) : (srp_grid){0, 0},
                       table != NULL ? fields_of(table) : NULL, FIELD_NAME);
}

static void show_list(pane *p) {
    int at = p->v->table_shown;
    p->quiet = true;
    ui_choice_set_tables(p->v, GTK_DROP_DOWN(p->table), at);
    p->quiet = false;
    bool old = at >= 0 && viewer_session_table_is_old(p->v->session, (size_t)at);
    gtk_widget_set_visible(p->reoptic, old);
}

static void on_choice(GtkDropDown *choice, GParamSpec *spec, gpointer user) {
    pane *p = user;
    (void)spec;
    guint at = gtk_drop_down_get_selected(choice);
    if (!p->quiet && at != GTK_INVALID_LIST_POSITION && (int)at != p->v->table_shown) {
        viewer_act(p->v, "show-table", g_variant_new_int32((gint32)at + 1));
    }
}

/* ---- controls ---- */

static void on_step(GtkWidget *number, void *user) {
    pane *p = user;
    viewer_act(p->v, number == p->az_step ? "az-step" : "el-step",
               g_variant_new_double(ui_number_value(number)));
}

static void on_together(GtkCheckButton *check, gpointer user) {
    pane *p = user;
    if (!p->quiet && gtk_check_button_get_active(check) != p->v->charts_together) {
        viewer_act(p->v, "turn-together", NULL);
    }
}

static GtkWidget *step_button(pane *p, const char *name, const char *words) {
    const ui_range steps = {VIEWER_STEP_MIN_DEG, VIEWER_STEP_MAX_DEG, 0.5, false};
    GtkWidget *number = ui_number(p->v, name, words, steps, on_step, p);
    gtk_editable_set_width_chars(GTK_EDITABLE(number), 4);
    return number;
}

static GtkWidget *make_strip(pane *p) {
    GtkWidget *box = ui_strip(8);
    GtkBox *strip = GTK_BOX(box);
    p->az_step = step_button(p, "az-step", "Step az");
    p->el_step = step_button(p, "el-step", "Step el");
    p->start = ui_button("_Start", "compute-table", "Compute a table of all directions (Ctrl+T)");
    p->cancel = ui_button("C_ancel", "cancel", "Stop (Ctrl+.)");
    p->progress = ui_progress("progress", "Progress of the table");
    gtk_widget_set_size_request(p->progress, 240, -1); /* room for all that it may say */
    p->table = ui_choice("table", G_CALLBACK(on_choice), p);
    gtk_widget_set_hexpand(p->table, TRUE);
    gtk_widget_set_size_request(p->table, 240, -1);
    p->reoptic = ui_button("Ne_w Optics", "reoptic",
                           "This table is of other optics than Materials has now: make one of "
                           "those from it, without tracing light again");
    gtk_widget_set_name(p->reoptic, "reoptic");
    gtk_box_append(strip, ui_pair(ui_mnemonic("Step a_z [°]", p->az_step), p->az_step));
    gtk_box_append(strip, ui_pair(ui_mnemonic("e_l [°]", p->el_step), p->el_step));
    gtk_box_append(strip, p->start);
    gtk_box_append(strip, p->cancel);
    gtk_box_append(strip, p->progress);
    gtk_box_append(strip, ui_pair(ui_mnemonic("Ta_ble", p->table), p->table));
    gtk_box_append(strip, p->reoptic);
    gtk_box_append(
        strip,
        ui_pair(ui_button("O_pen…", "choose-table", "Open a table from disk"),
                ui_button("Sav_e…", "choose-save",
                          "Save the table (.nc, .spo, .txt) or the figure (.png, .svg, .pdf)")));
    gtk_widget_add_css_class(box, "strip");
    gtk_widget_add_css_class(box, "pane");
    return box;
}

/* ---- together ---- */

static void on_changed(void *user, unsigned what) {
    pane *p = user;
    p->quiet = true;
    if ((what & CHANGED_SETUP) != 0) {
        ui_number_show(p->az_step, p->v->az_step_deg);
        ui_number_show(p->el_step, p->v->el_step_deg);
    }
    if ((what & CHANGED_VIEW) != 0) {
        gtk_check_button_set_active(GTK_CHECK_BUTTON(p->together), p->v->charts_together);
    }
    p->quiet = false;
    if ((what & (CHANGED_TABLES | CHANGED_ENGINE)) != 0) {
        show_list(p);
        show_table(p);
    }
    if ((what & (CHANGED_BUSY | CHANGED_TABLES)) != 0) {
        show_busy(p);
    }
}

static void free_pane(gpointer user) {
    pane *p = user;
    if (p->timer != 0) {
        g_source_remove(p->timer);
    }
    g_free(p);
}

GtkWidget *viewer_table_tab(viewer *v) {
    pane *p = g_new0(pane, 1);
    p->v = v;
    GtkWidget *box = ui_box(GTK_ORIENTATION_VERTICAL, 0);
    p->together = ui_check("Turn toget_her");
    g_signal_connect(p->together, "toggled", G_CALLBACK(on_together), p);
    p->charts = viewer_charts_create(v, "chart", p->together);
    g_object_set_data(G_OBJECT(v->window), "table-charts", p->charts);
    gtk_box_append(GTK_BOX(box), make_strip(p));
    gtk_box_append(GTK_BOX(box), viewer_charts_widget(p->charts));
    g_object_set_data_full(G_OBJECT(box), "pane", p, free_pane);
    viewer_listen(v, on_changed, p);
    return box;
}

bool viewer_chart_save(viewer *v, const char *path, viewer_words *problem) {
    return viewer_charts_save(g_object_get_data(G_OBJECT(v->window), "table-charts"), path,
                              problem);
}
