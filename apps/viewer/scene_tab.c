/* SPDX-License-Identifier: Apache-2.0 */
/* Visualize spacecraft: the picture, the attitude below it, the numbers beside it. */
#include "messages.h"
#include "numbers.h"
#include "scene_area.h"
#include "ui.h"
#include "viewer.h"

#include <math.h>
#include <stdio.h>

enum { F_AREA, F_MOMENT, F_FORCE, F_TORQUE, F_ACCELERATION, VECTORS };
static const char *const VECTOR_NAME[VECTORS] = {"f", "t", "force", "torque", "acceleration"};

typedef struct pane {
    viewer *v;
    GtkWidget *turn[3], *sun, *record, *arrows, *vector[VECTORS][4], *error[2];
    GtkWidget *lit, *extra, *latency, *pressure, *colouring;
    bool quiet;
} pane;

/* ---- attitude ---- */

static void on_turn(GtkRange *range, gpointer user) {
    static const char *const actions[3] = {"turn-x", "turn-y", "turn-z"};
    pane *p = user;
    for (int axis = 0; axis < 3 && !p->quiet; ++axis) {
        if (GTK_WIDGET(range) == p->turn[axis]) {
            viewer_act(p->v, actions[axis], g_variant_new_double(gtk_range_get_value(range)));
        }
    }
}

static char *degrees(GtkScale *scale, double value, gpointer user) {
    (void)scale, (void)user;
    return g_strdup_printf("%.1f°", value);
}

static GtkWidget *make_turns(pane *p) {
    static const char *const words[3] = {"Rotation _X", "Rotation _Y", "Rotation _Z"};
    static const char *const names[3] = {"turn-x", "turn-y", "turn-z"};
    GtkWidget *grid = gtk_grid_new();
    gtk_grid_set_column_spacing(GTK_GRID(grid), 8);
    for (int axis = 0; axis < 3; ++axis) {
        GtkWidget *scale = gtk_scale_new_with_range(GTK_ORIENTATION_HORIZONTAL, -180.0, 180.0, 1.0);
        gtk_widget_set_name(scale, names[axis]);
        gtk_widget_set_hexpand(scale, TRUE);
        gtk_scale_set_draw_value(GTK_SCALE(scale), TRUE);
        gtk_scale_set_value_pos(GTK_SCALE(scale), GTK_POS_RIGHT);
        gtk_scale_set_format_value_func(GTK_SCALE(scale), degrees, NULL, NULL);
        g_signal_connect(scale, "value-changed", G_CALLBACK(on_turn), p);
        p->turn[axis] = scale;
        gtk_grid_attach(GTK_GRID(grid), ui_mnemonic(words[axis], scale), 0, axis, 1, 1);
        gtk_grid_attach(GTK_GRID(grid), scale, 1, axis, 1, 1);
    }
    gtk_widget_add_css_class(grid, "below");
    return grid;
}

static void show_sun(pane *p) {
    double az, el;
    char text[2 * CLI_NUMBER_SIZE], az_text[CLI_NUMBER_SIZE], el_text[CLI_NUMBER_SIZE];
    viewer_attitude_sun(&p->v->session->attitude, &az, &el);
    snprintf(text, sizeof text, "%s,%s", cli_write_number(az, az_text),
             cli_write_number(el, el_text));
    ui_entry_show(p->sun, text);
    p->quiet = true;
    for (int axis = 0; axis < 3; ++axis) {
        gtk_range_set_value(GTK_RANGE(p->turn[axis]), p->v->session->attitude.turn_deg[axis]);
    }
    p->quiet = false;
}

/* ---- numbers ---- */

/* As `srp force` prints them. */
static void show_number(GtkWidget *label, double value) {
    char text[40];
    snprintf(text, sizeof text, "% .9e", value);
    gtk_label_set_text(GTK_LABEL(label), text);
}

static void show_vector(pane *p, int which, bool known, srp_vec3 value) {
    double parts[4] = {value.x, value.y, value.z, srp_vec3_norm(value)};
    for (int k = 0; k < 4; ++k) {
        if (known) {
            show_number(p->vector[which][k], parts[k]);
        } else {
            gtk_label_set_text(GTK_LABEL(p->vector[which][k]), "—");
        }
    }
}

static void show_extra(pane *p, const srp_response *r, unsigned capabilities) {
    GString *text = g_string_new("");
    if ((capabilities & SRP_METHOD_BOUNCE) != 0) {
        g_string_append_printf(text, "reflected |f| %.3e m², unresolved %.1e",
                               srp_vec3_norm(r->f_bounce), r->unresolved);
    }
    if (r->samples > 0) {
        g_string_append_printf(text, "%s%llu samples", text->len > 0 ? ", " : "",
                               (unsigned long long)r->samples);
    }
    if ((r->flags & SRP_RESPONSE_TOLERANCE_MISSED) != 0) {
        g_string_append(text, "; the tolerance was not reached");
    }
    if ((r->flags & SRP_RESPONSE_CUT) != 0) {
        g_string_append(text, "; part of the model lies outside the window");
    }
    gtk_label_set_text(GTK_LABEL(p->extra), text->str);
    g_string_free(text, TRUE);
}

static void show_force(pane *p) {
    const viewer_session *s = p->v->session;
    const srp_response *r = &s->force.response;
    unsigned capabilities =
        s->engine != NULL && s->engine->method != NULL ? s->engine->method->capabilities : 0;
    bool known = s->force_known, moment = known && (capabilities & SRP_METHOD_MOMENT) != 0;
    double pressure =
        srp_sunlight_pressure(s->setup->light, s->setup->distance_au * s->setup->light.au);
    show_vector(p, F_AREA, known, r->f);
    show_vector(p, F_MOMENT, moment, r->t);
    show_vector(p, F_FORCE, known, srp_vec3_scale(pressure, r->f));
    show_vector(p, F_TORQUE, moment, srp_vec3_scale(pressure, r->t));
    bool mass = !isnan(s->setup->mass);
    show_vector(p, F_ACCELERATION, known && mass,
                srp_vec3_scale(mass ? pressure / s->setup->mass : 0.0, r->f));
    if (!known) {
        gtk_label_set_text(GTK_LABEL(p->error[0]), "—");
        gtk_label_set_text(GTK_LABEL(p->error[1]), "—");
        gtk_label_set_text(GTK_LABEL(p->lit), "—");
        gtk_label_set_text(GTK_LABEL(p->extra), "");
        return;
    }
    show_number(p->error[0], r->f_error);
    moment ? show_number(p->error[1], r->t_error) : gtk_label_set_text(GTK_LABEL(p->error[1]), "—");
    show_number(p->lit, r->lit_area);
    show_extra(p, r, capabilities);
}

static void show_arrows(pane *p) {
    const viewer_session *s = p->v->session;
    char text[64];
    snprintf(text, sizeof text, "%zu %s", s->arrow_count,
             cli_form(s->arrow_count, "arrow", "arrows"));
    gtk_label_set_text(GTK_LABEL(p->arrows), text);
    gtk_button_set_label(GTK_BUTTON(p->record), s->recording ? "_Stop" : "_Start");
    s->recording ? gtk_widget_add_css_class(p->record, "recording")
                 : gtk_widget_remove_css_class(p->record, "recording");
}

static void show_latency(pane *p) {
    viewer_latency median = viewer_session_median_latency(p->v->session);
    char text[96] = "";
    if (!isnan(median.shown)) {
        snprintf(text, sizeof text, "shown %.1f ms after the slider, computed in %.3g ms (medians)",
                 1e3 * median.shown, 1e3 * median.computed);
    }
    gtk_label_set_text(GTK_LABEL(p->latency), text);
}

static void add_head(GtkGrid *grid, const char *text, int column, int row) {
    GtkWidget *head = ui_label(text, "heading small");
    gtk_label_set_xalign(GTK_LABEL(head), 1.0f);
    gtk_widget_set_margin_top(head, row > 0 ? 10 : 2);
    gtk_grid_attach(grid, head, column, row, 1, 1);
}

/* Columns of components, with a heading each, from row `at` on; below the first its error. */
static void add_vectors(pane *p, GtkGrid *grid, int at, const char *const *heads, const int *which,
                        int count, GtkWidget *error) {
    static const char *const rows[] = {"x", "y", "z", "length", "±"};
    for (int k = 0; k < 5; ++k) {
        gtk_grid_attach(grid, ui_label(rows[k], "dim"), 0, at + 1 + k, 1, 1);
    }
    for (int c = 0; c < count; ++c) {
        add_head(grid, heads[c], 1 + c, at);
        for (int k = 0; k < 4; ++k) {
            char name[40], words[64];
            snprintf(name, sizeof name, "%s-%c", VECTOR_NAME[which[c]], "xyzn"[k]);
            snprintf(words, sizeof words, "%s, %s", heads[c], k < 3 ? rows[k] : "length");
            p->vector[which[c]][k] = ui_value(name, words);
            gtk_label_set_width_chars(GTK_LABEL(p->vector[which[c]][k]), 16);
            gtk_widget_set_hexpand(p->vector[which[c]][k], TRUE);
            gtk_grid_attach(grid, p->vector[which[c]][k], 1 + c, at + 1 + k, 1, 1);
        }
    }
    gtk_grid_attach(grid, error, 1, at + 5, 1, 1);
}

/* What pushes above what turns: three columns, so that a low window shows all of them. */
static GtkWidget *make_numbers(pane *p) {
    static const char *const pushes[] = {"Force f [m²]", "F [N]", "a [m/s²]"};
    static const char *const turns[] = {"Moment t [m³]", "T [N m]"};
    static const int push[] = {F_AREA, F_FORCE, F_ACCELERATION}, turn[] = {F_MOMENT, F_TORQUE};
    const int below = 6;
    GtkWidget *widget = gtk_grid_new();
    GtkGrid *grid = GTK_GRID(widget);
    gtk_grid_set_column_spacing(grid, 10);
    p->error[0] = ui_value("f-error", "Error of f [m²]");
    p->error[1] = ui_value("t-error", "Error of t [m³]");
    p->lit = ui_value("lit-area", "Lit area [m²]");
    add_vectors(p, grid, 0, pushes, push, 3, p->error[0]);
    add_vectors(p, grid, below, turns, turn, 2, p->error[1]);
    add_head(grid, "Lit area [m²]", 3, below);
    gtk_grid_attach(grid, p->lit, 3, below + 1, 1, 1);
    return widget;
}

/* ---- side ---- */

static void on_colouring(GtkDropDown *choice, GParamSpec *spec, gpointer user) {
    static const char *const names[] = {"material", "incidence", "force"};
    pane *p = user;
    (void)spec;
    guint at = gtk_drop_down_get_selected(choice);
    if (!p->quiet && at < 3) {
        viewer_act_text(p->v, "colouring", names[at]);
    }
}

static GtkWidget *make_controls(pane *p) {
    static const char *const colours[] = {"by material", "by incidence", "by force", NULL};
    GtkWidget *box = ui_box(GTK_ORIENTATION_VERTICAL, 6);
    GtkWidget *first = ui_box(GTK_ORIENTATION_HORIZONTAL, 8);
    GtkWidget *second = ui_box(GTK_ORIENTATION_HORIZONTAL, 8);
    p->sun = ui_entry(p->v, "sun", 18, "sun", NULL);
    gtk_widget_set_hexpand(p->sun, TRUE);
    gtk_box_append(GTK_BOX(first), ui_mnemonic("Sun _az,el [°]", p->sun));
    gtk_box_append(GTK_BOX(first), p->sun);
    gtk_box_append(GTK_BOX(first),
                   ui_explanation("Where the Sun stands",
                                  "Azimuth from +X towards +Y and elevation from the "
                                  "XY plane towards +Z, in body axes. The sliders "
                                  "turn the spacecraft about its X axis, then about "
                                  "the room's Y and Z; the Sun stays on the room's "
                                  "X axis."));
    p->record = ui_button("_Start", "record", "Keep an arrow for each attitude (Ctrl+B)");
    p->arrows = ui_label("", "dim");
    gtk_widget_set_name(p->arrows, "arrows");
    gtk_widget_set_hexpand(p->arrows, TRUE);
    p->colouring = gtk_drop_down_new_from_strings(colours);
    gtk_widget_set_name(p->colouring, "colouring");
    g_signal_connect(p->colouring, "notify::selected", G_CALLBACK(on_colouring), p);
    gtk_box_append(GTK_BOX(second), p->record);
    gtk_box_append(GTK_BOX(second), ui_button("C_lear", "clear-arrows", "Forget all arrows"));
    gtk_box_append(GTK_BOX(second), p->arrows);
    gtk_box_append(GTK_BOX(second), ui_mnemonic("Colo_ur", p->colouring));
    gtk_box_append(GTK_BOX(second), p->colouring);
    gtk_box_append(GTK_BOX(box), first);
    gtk_box_append(GTK_BOX(box), second);
    return box;
}

static GtkWidget *make_side(pane *p) {
    GtkWidget *side = ui_box(GTK_ORIENTATION_VERTICAL, 4);
    p->latency = ui_label("", "dim small");
    p->extra = ui_label("", "dim small");
    gtk_label_set_wrap(GTK_LABEL(p->extra), TRUE);
    gtk_widget_set_name(p->latency, "latency");
    gtk_widget_set_name(p->extra, "extra");
    gtk_box_append(GTK_BOX(side), make_controls(p));
    gtk_box_append(GTK_BOX(side), make_numbers(p));
    gtk_box_append(GTK_BOX(side), p->extra);
    gtk_box_append(GTK_BOX(side), p->latency);
    gtk_widget_set_size_request(side, 380, -1);
    return ui_side(side);
}

/* ---- together ---- */

static void on_changed(void *user, unsigned what) {
    pane *p = user;
    if ((what & CHANGED_SUN) != 0) {
        show_sun(p);
    }
    if ((what & (CHANGED_FORCE | CHANGED_ENGINE)) != 0) {
        show_force(p);
        show_latency(p);
    }
    if ((what & CHANGED_ARROWS) != 0) {
        show_arrows(p);
    }
    if ((what & CHANGED_VIEW) != 0) {
        p->quiet = true;
        gtk_drop_down_set_selected(GTK_DROP_DOWN(p->colouring), (guint)p->v->colouring);
        p->quiet = false;
    }
}

GtkWidget *viewer_scene_tab(viewer *v) {
    pane *p = g_new0(pane, 1);
    p->v = v;
    GtkWidget *left = ui_box(GTK_ORIENTATION_VERTICAL, 0);
    GtkWidget *box = ui_box(GTK_ORIENTATION_HORIZONTAL, 0);
    GtkWidget *area = viewer_scene_area(v);
    gtk_widget_set_vexpand(area, TRUE);
    gtk_widget_set_hexpand(area, TRUE);
    gtk_box_append(GTK_BOX(left), area);
    gtk_box_append(GTK_BOX(left), make_turns(p));
    gtk_box_append(GTK_BOX(box), left);
    gtk_box_append(GTK_BOX(box), make_side(p));
    g_object_set_data_full(G_OBJECT(box), "pane", p, g_free);
    viewer_listen(v, on_changed, p);
    return box;
}
