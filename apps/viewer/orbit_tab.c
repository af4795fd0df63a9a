/* SPDX-License-Identifier: Apache-2.0 */
/* Orbit: missions are run, and what their models of sunlight make of the orbit is drawn over time.
 */
#include "orbit.h"
#include "ui.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PROGRESS_MS = 200 };

typedef struct pane {
    viewer *v;
    GtkWidget *file[2], *drop, *cancel, *progress, *facts, *last, *plot;
    guint timer;
} pane;

static const double CURVE[4][3] = {
    {0.00, 0.45, 0.70}, {0.84, 0.37, 0.00}, {0.00, 0.62, 0.45}, {0.50, 0.50, 0.50}};
static const char *const DIFFERENCE[4] = {"radial", "along-track", "cross-track", "distance"};
static const char *const POSITION[4] = {"x", "y", "z", "distance from the centre"};

/* ---- the plot ---- */

typedef struct frame {
    cairo_t *cr;
    double left, top, width, height; /* [px] */
    double t_end, low, high;         /* [unit of time], [unit of length] */
    GdkRGBA ink;
} frame;

/* Space between marks: 1, 2 or 5 times a power of 10. */
static double step_of(double range, double count) {
    double rough = range / count, power = pow(10.0, floor(log10(rough))), lead = rough / power;
    return power * (lead < 1.5 ? 1.0 : lead < 3.5 ? 2.0 : lead < 7.5 ? 5.0 : 10.0);
}

static void put_text(const frame *f, double x, double y, double align, const char *text) {
    cairo_text_extents_t size;
    cairo_text_extents(f->cr, text, &size);
    cairo_move_to(f->cr, x - align * size.x_advance, y);
    cairo_show_text(f->cr, text);
}

static double y_of(const frame *f, double value) {
    return f->top + f->height * (f->high - value) / (f->high - f->low);
}

static void draw_grid(const frame *f, const char *time_unit, const char *length_unit) {
    char text[64];
    double dy = step_of(f->high - f->low, 6.0), dx = step_of(f->t_end, 8.0);
    cairo_set_line_width(f->cr, 1.0);
    for (double y = dy * ceil(f->low / dy); y <= f->high + 1e-9 * dy; y += dy) {
        double at = floor(y_of(f, y)) + 0.5;
        cairo_set_source_rgba(f->cr, f->ink.red, f->ink.green, f->ink.blue, 0.15);
        cairo_move_to(f->cr, f->left, at);
        cairo_line_to(f->cr, f->left + f->width, at);
        cairo_stroke(f->cr);
        gdk_cairo_set_source_rgba(f->cr, &f->ink);
        snprintf(text, sizeof text, "%g", fabs(y) < 1e-9 * dy ? 0.0 : y);
        put_text(f, f->left - 6.0, at + 4.0, 1.0, text);
    }
    for (double x = 0.0; x <= f->t_end * (1.0 + 1e-9); x += dx) {
        double at = floor(f->left + f->width * x / f->t_end) + 0.5;
        cairo_set_source_rgba(f->cr, f->ink.red, f->ink.green, f->ink.blue, 0.15);
        cairo_move_to(f->cr, at, f->top);
        cairo_line_to(f->cr, at, f->top + f->height);
        cairo_stroke(f->cr);
        gdk_cairo_set_source_rgba(f->cr, &f->ink);
        snprintf(text, sizeof text, "%g", x);
        put_text(f, at, f->top + f->height + 16.0, 0.5, text);
    }
    snprintf(text, sizeof text, "time [%s]", time_unit);
    put_text(f, f->left + 0.5 * f->width, f->top + f->height + 34.0, 0.5, text);
    snprintf(text, sizeof text, "[%s]", length_unit);
    put_text(f, f->left - 6.0, f->top - 10.0, 1.0, text);
}

/* Lighter on a dark ground. */
static void choose_colour(const frame *f, const double colour[3]) {
    double white = f->ink.red + f->ink.green + f->ink.blue > 1.5 ? 0.4 : 0.0;
    cairo_set_source_rgb(f->cr, colour[0] + white * (1.0 - colour[0]),
                         colour[1] + white * (1.0 - colour[1]),
                         colour[2] + white * (1.0 - colour[2]));
}

static void draw_curves(const frame *f, const viewer_orbit *orbit, double time, double length) {
    const char *const *names = orbit->is_difference ? DIFFERENCE : POSITION;
    double x = f->left + 12.0;
    for (int k = 0; k < 4; ++k) {
        choose_colour(f, CURVE[k]);
        cairo_set_line_width(f->cr, 1.6);
        cairo_new_path(f->cr);
        for (size_t i = 0; i < orbit->count; ++i) {
            cairo_line_to(f->cr, f->left + f->width * orbit->t[i] / time / f->t_end,
                          y_of(f, orbit->value[k][i] / length));
        }
        cairo_stroke(f->cr);
        cairo_text_extents_t size;
        cairo_text_extents(f->cr, names[k], &size);
        cairo_new_path(f->cr);
        cairo_rectangle(f->cr, x, f->top - 19.0, 14.0, 4.0);
        cairo_fill(f->cr);
        put_text(f, x + 20.0, f->top - 12.0, 0.0, names[k]);
        x += size.x_advance + 44.0;
    }
}

static void draw(GtkDrawingArea *area, cairo_t *cr, int width, int height, gpointer user) {
    pane *p = user;
    const viewer_orbit *orbit = viewer_orbit_get(p->v);
    frame f = {.cr = cr, .left = 84.0, .top = 44.0, .low = INFINITY, .high = -INFINITY};
    if (orbit->count < 2 || width < 200 || height < 160) {
        return;
    }
    for (int k = 0; k < 4; ++k) {
        for (size_t i = 0; i < orbit->count; ++i) {
            f.low = fmin(f.low, orbit->value[k][i]);
            f.high = fmax(f.high, orbit->value[k][i]);
        }
    }
    double end = orbit->t[orbit->count - 1], size = fmax(fabs(f.low), fabs(f.high));
    double time = end > 2.0 * 86400.0 ? 86400.0 : end > 7200.0 ? 3600.0 : 1.0;
    double length = size > 5e3 ? 1e3 : 1.0;
    double room = orbit->is_identical ? 1.0 : fmax(0.04 * (f.high - f.low), 1e-12 * size);
    f.low = (f.low - room) / length;
    f.high = (f.high + room) / length;
    f.t_end = end / time;
    f.width = width - f.left - 24.0;
    f.height = height - f.top - 48.0;
    gtk_style_context_get_color(gtk_widget_get_style_context(GTK_WIDGET(area)), &f.ink);
    cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr, 12.0);
    draw_grid(&f,
              time == 86400.0  ? "days"
              : time == 3600.0 ? "h"
                               : "s",
              length == 1e3 ? "km" : "m");
    draw_curves(&f, orbit, time, length);
    if (orbit->is_identical) {
        gdk_cairo_set_source_rgba(cr, &f.ink);
        put_text(&f, f.left + 0.5 * f.width, y_of(&f, 0.0) - 8.0, 0.5,
                 "0 m everywhere: the orbits are identical");
    }
}

/* ---- what changes ---- */

static void show_progress(pane *p) {
    double done = viewer_orbit_progress(p->v);
    const char *held_up = viewer_held_up(p->v, SLOT_ORBIT, viewer_orbit_is_cancelling(p->v));
    char text[32];
    snprintf(text, sizeof text, "%.0f %%", floor(100.0 * done));
    gtk_progress_bar_set_text(GTK_PROGRESS_BAR(p->progress), held_up != NULL ? held_up : text);
    gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(p->progress), done);
}

static gboolean on_tick(gpointer user) {
    pane *p = user;
    if (p->v->window == NULL || !viewer_orbit_is_running(p->v)) {
        p->timer = 0;
        return G_SOURCE_REMOVE;
    }
    show_progress(p);
    return G_SOURCE_CONTINUE;
}

static void show_files(pane *p, const viewer_orbit *orbit) {
    static const char *const words[2] = {"Mi_ssion…", "Compare _with…"};
    for (int k = 0; k < 2; ++k) {
        char *base =
            orbit->path[k] != NULL ? g_path_get_basename(orbit->path[k]) : g_strdup(words[k]);
        gtk_button_set_use_underline(GTK_BUTTON(p->file[k]), orbit->path[k] == NULL);
        gtk_button_set_label(GTK_BUTTON(p->file[k]), base);
        g_free(base);
    }
    gtk_widget_set_sensitive(p->drop, orbit->path[1] != NULL);
}

static void show_result(pane *p, const viewer_orbit *orbit) {
    char *text = NULL, last[200] = "";
    if (orbit->path[0] != NULL) {
        bool two = orbit->path[1] != NULL;
        bool known = orbit->count > 0;
        text = g_strdup_printf(
            "%s%s%s: %s%s%s", orbit->name[0], two ? " → " : "", two ? orbit->name[1] : "",
            known && orbit->is_identical ? "the orbits are identical; " : "",
            known && two ? "the first has " : "", known ? orbit->summary : "no result yet");
    }
    if (orbit->count > 0) {
        size_t end = orbit->count - 1;
        const char *const *names = orbit->is_difference ? DIFFERENCE : POSITION;
        snprintf(last, sizeof last, "at the end%s: %s %.9g, %s %.9g, %s %.9g, %s %.9g m",
                 orbit->is_difference ? "" : ", from the central body, axes MJ2000Eq", names[0],
                 orbit->value[0][end], names[1], orbit->value[1][end], names[2],
                 orbit->value[2][end], names[3], orbit->value[3][end]);
    }
    gtk_label_set_text(GTK_LABEL(p->facts),
                       text != NULL ? text
                                    : "A mission file describes an orbit (user guide: Propagate an "
                                      "orbit). A second one, of "
                                      "another model of sunlight, is compared with it.");
    g_free(text);
    gtk_label_set_text(GTK_LABEL(p->last), last);
    gtk_widget_queue_draw(p->plot);
}

static void on_changed(void *user, unsigned what) {
    pane *p = user;
    if ((what & (CHANGED_ORBIT | CHANGED_BUSY)) != 0) {
        bool busy = viewer_orbit_is_running(p->v);
        gtk_widget_set_sensitive(p->cancel, busy && !viewer_orbit_is_cancelling(p->v));
        show_progress(p);
        gtk_widget_set_opacity(p->progress, busy ? 1.0 : 0.0);
        if (busy && p->timer == 0) {
            p->timer = g_timeout_add(PROGRESS_MS, on_tick, p);
        }
    }
    if ((what & CHANGED_ORBIT) != 0) {
        show_files(p, viewer_orbit_get(p->v));
        show_result(p, viewer_orbit_get(p->v));
    }
    if ((what & CHANGED_VIEW) != 0) {
        gtk_widget_queue_draw(p->plot);
    }
}

static void free_pane(gpointer user) {
    pane *p = user;
    if (p->timer != 0) {
        g_source_remove(p->timer);
    }
    g_free(p);
}

/* ---- together ---- */

static GtkWidget *make_strip(pane *p) {
    GtkWidget *box = ui_strip(8);
    p->file[0] = ui_button("Mi_ssion…", "choose-mission", "Open a mission file");
    p->file[1] = ui_button("Compare _with…", "choose-versus", "Open the mission to compare with");
    p->drop = ui_button("×", "versus", "Compare with none");
    gtk_actionable_set_action_target(GTK_ACTIONABLE(p->drop), "s", "");
    ui_name(p->drop, "Compare with none");
    p->cancel = ui_button("C_ancel", "cancel", "Stop (Ctrl+.)");
    gtk_widget_set_name(p->cancel, "cancel-orbit");
    p->progress = ui_progress("orbit-progress", "Progress of the missions");
    gtk_widget_set_hexpand(p->progress, TRUE);
    gtk_box_append(GTK_BOX(box), p->file[0]);
    gtk_box_append(GTK_BOX(box), p->file[1]);
    gtk_box_append(GTK_BOX(box), p->drop);
    gtk_box_append(GTK_BOX(box), ui_button("R_un", "propagate", "Run the missions"));
    gtk_box_append(GTK_BOX(box), p->cancel);
    gtk_box_append(GTK_BOX(box), p->progress);
    gtk_box_append(GTK_BOX(box), ui_button("Sav_e…", "choose-save", "Save the rows (.csv)"));
    gtk_widget_add_css_class(box, "pane");
    return box;
}

GtkWidget *viewer_orbit_tab(viewer *v) {
    pane *p = g_new0(pane, 1);
    p->v = v;
    GtkWidget *box = ui_box(GTK_ORIENTATION_VERTICAL, 0);
    p->facts = ui_label("", "dim small");
    p->last = ui_label("", "value");
    gtk_widget_set_name(p->facts, "orbit-facts");
    gtk_widget_set_name(p->last, "orbit-end");
    gtk_label_set_wrap(GTK_LABEL(p->facts), TRUE);
    gtk_label_set_wrap(GTK_LABEL(p->last), TRUE);
    gtk_label_set_selectable(GTK_LABEL(p->last), TRUE);
    gtk_widget_set_can_focus(p->last, FALSE);
    gtk_widget_set_margin_start(p->facts, 12);
    gtk_widget_set_margin_start(p->last, 12);
    gtk_widget_set_margin_top(p->facts, 6);
    p->plot = gtk_drawing_area_new();
    ui_name(p->plot, "Plot of the orbit over time");
    gtk_widget_set_name(p->plot, "orbit");
    gtk_widget_set_hexpand(p->plot, TRUE);
    gtk_widget_set_vexpand(p->plot, TRUE);
    gtk_drawing_area_set_draw_func(GTK_DRAWING_AREA(p->plot), draw, p, NULL);
    gtk_box_append(GTK_BOX(box), make_strip(p));
    gtk_box_append(GTK_BOX(box), p->facts);
    gtk_box_append(GTK_BOX(box), p->last);
    gtk_box_append(GTK_BOX(box), p->plot);
    g_object_set_data_full(G_OBJECT(box), "pane", p, free_pane);
    viewer_listen(v, on_changed, p);
    return box;
}
