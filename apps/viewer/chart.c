/* SPDX-License-Identifier: Apache-2.0 */
#include "chart.h"

#include "chart_page.h"
#include "turning.h"
#include "ui.h"

#include <stdio.h>
#include <stdlib.h>

struct viewer_charts {
    viewer *v;
    GtkWidget *widget, *area[CHARTS], *pointer, *empty;
    cli_picture picture;
    char *title;
    double *value;
    bool marked; /* a node is under the pointer */
    int marked_chart;
    uint32_t marked_i, marked_j;
};

static const char HOW_TO[] = "Drag, or use arrow keys, to turn; point for values";

/* Facets along an angle: more are not seen, and take their time. */
enum { STEPS_MAX = 72 };

static viewer_page page_of(const viewer_charts *c, int k) {
    gboolean dark = FALSE;
    g_object_get(gtk_settings_get_default(), "gtk-application-prefer-dark-theme", &dark, NULL);
    double paper = dark ? 0.14 : 1.0, ink = dark ? 0.9 : 0.1;
    return (viewer_page){.picture = &c->picture,
                         .row = (size_t)k,
                         .view = {c->v->chart_view[k][0], c->v->chart_view[k][1]},
                         .width = gtk_widget_get_width(c->area[k]),
                         .height = gtk_widget_get_height(c->area[k]),
                         .steps_max = STEPS_MAX,
                         .ink = {ink, ink, ink},
                         .paper = {paper, paper, paper}};
}

static int index_of(const viewer_charts *c, GtkWidget *area) {
    int k = 0;
    while (k < CHARTS - 1 && c->area[k] != area) {
        ++k;
    }
    return k;
}

/* "f#dx#u [m²]" without PLplot's escapes: "f_x [m²]". */
static char *plain(const char *name) {
    GString *text = g_string_new("");
    for (; *name != '\0'; ++name) {
        if (*name == '#' && name[1] != '\0') {
            ++name;
            g_string_append(text, *name == 'd' ? "_" : "");
        } else {
            g_string_append_c(text, *name);
        }
    }
    return g_string_free(text, FALSE);
}

static void put_title(const viewer_charts *c, int k, const viewer_page *page, cairo_t *cr) {
    char words[VIEWER_FLAT_SIZE], *name = plain(c->picture.name[k]);
    bool is_flat = viewer_page_flat_words(page, words)[0] != '\0';
    char *title = g_strconcat(name, is_flat ? ": " : "", words, NULL);
    cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_BOLD);
    cairo_set_font_size(cr, fmin(13.0, page->width / 18.0));
    cairo_set_source_rgb(cr, page->ink[0], page->ink[1], page->ink[2]);
    cairo_move_to(cr, 12.0, 20.0);
    cairo_show_text(cr, title);
    g_free(title);
    g_free(name);
}

static void draw(GtkDrawingArea *area, cairo_t *cr, int width, int height, gpointer user) {
    viewer_charts *c = user;
    int k = index_of(c, GTK_WIDGET(area));
    viewer_page page = page_of(c, k);
    cairo_set_source_rgb(cr, page.paper[0], page.paper[1], page.paper[2]);
    cairo_paint(cr);
    if (c->value == NULL || width < 80 || height < 80) {
        return;
    }
    cairo_save(cr);
    if (!viewer_page_draw(&page, cr)) {
        cairo_move_to(cr, 20.0, 30.0);
        cairo_set_source_rgb(cr, page.ink[0], page.ink[1], page.ink[2]);
        cairo_show_text(cr, "Surfaces are drawn by PLplot, which is not there.");
    }
    cairo_restore(cr);
    put_title(c, k, &page, cr);
    if (c->marked && (c->v->charts_together || k == c->marked_chart)) {
        double x, y;
        viewer_page_place(&page, c->marked_i, c->marked_j, &x, &y);
        cairo_set_source_rgb(cr, 0.85, 0.1, 0.1);
        cairo_set_line_width(cr, 2.0);
        cairo_new_path(cr); /* else a line from the end of the title leads to it */
        cairo_arc(cr, x, y, 5.0, 0.0, 2.0 * G_PI);
        cairo_stroke(cr);
    }
}

static void redraw(viewer_charts *c) {
    for (int k = 0; k < CHARTS; ++k) {
        gtk_widget_queue_draw(c->area[k]);
    }
}

/* ---- pointer ---- */

static void show_pointer(viewer_charts *c, int k) {
    char *text = NULL;
    if (c->marked) {
        srp_grid grid = c->picture.grid[0];
        size_t nodes = srp_grid_node_count(grid);
        double value =
            c->value[(size_t)k * nodes + (size_t)c->marked_i * grid.el_count + c->marked_j];
        char *name = plain(c->picture.name[k]);
        text = g_strdup_printf("azimuth %g°, elevation %g°:  %s = % .9e",
                               srp_grid_azimuth_deg(grid, c->marked_i),
                               srp_grid_elevation_deg(grid, c->marked_j), name, value);
        g_free(name);
    }
    gtk_label_set_text(GTK_LABEL(c->pointer), text != NULL ? text : HOW_TO);
    g_free(text);
}

static void on_motion(GtkEventControllerMotion *motion, double x, double y, gpointer user) {
    viewer_charts *c = user;
    int k = index_of(c, gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(motion)));
    if (c->value == NULL) {
        return;
    }
    viewer_page page = page_of(c, k);
    uint32_t i = c->marked_i, j = c->marked_j;
    bool found = viewer_page_find(&page, x, y, &i, &j);
    if (found != c->marked || i != c->marked_i || j != c->marked_j || k != c->marked_chart) {
        c->marked = found;
        c->marked_chart = k;
        c->marked_i = i;
        c->marked_j = j;
        show_pointer(c, k);
        redraw(c);
    }
}

/* ---- turning ---- */

static void look_from(GtkWidget *area, gpointer user, double *az_deg, double *el_deg) {
    const viewer_charts *c = user;
    const double *view = c->v->chart_view[index_of(c, area)];
    *az_deg = view[0];
    *el_deg = view[1];
}

static void turn(GtkWidget *area, gpointer user, double az_deg, double el_deg) {
    const viewer_charts *c = user;
    viewer_set_chart_view(c->v, index_of(c, area), az_deg, el_deg);
}

static const viewer_turning SURFACE = {look_from, turn, 1.0};

/* ---- life ---- */

static void on_changed(void *user, unsigned what) {
    if ((what & CHANGED_VIEW) != 0) {
        redraw(user);
    }
}

static void free_charts(gpointer user) {
    viewer_charts *c = user;
    free(c->value);
    g_free(c->title);
    g_free(c);
}

static GtkWidget *make_area(viewer_charts *c, const char *name, int k) {
    GtkWidget *area =
        g_object_new(GTK_TYPE_DRAWING_AREA, "accessible-role", GTK_ACCESSIBLE_ROLE_IMG, NULL);
    char *full = g_strdup_printf("%s-%d", name, k);
    gtk_widget_set_name(area, full);
    gtk_widget_set_hexpand(area, TRUE);
    gtk_widget_set_vexpand(area, TRUE);
    gtk_widget_set_size_request(area, 160, 96);
    gtk_drawing_area_set_draw_func(GTK_DRAWING_AREA(area), draw, c, NULL);
    GtkEventController *motion = gtk_event_controller_motion_new();
    g_signal_connect(motion, "motion", G_CALLBACK(on_motion), c);
    gtk_widget_add_controller(area, motion);
    viewer_turning_add(area, &SURFACE, c);
    ui_name(area, "Surface, not there yet");
    g_free(full);
    return area;
}

viewer_charts *viewer_charts_create(viewer *v, const char *name, GtkWidget *beside) {
    viewer_charts *c = g_new0(viewer_charts, 1);
    GtkWidget *grid = gtk_grid_new();
    gtk_grid_set_column_homogeneous(GTK_GRID(grid), TRUE);
    gtk_grid_set_row_homogeneous(GTK_GRID(grid), TRUE);
    char *full = g_strconcat(name, "-pointer", NULL);
    c->v = v;
    c->widget = ui_box(GTK_ORIENTATION_VERTICAL, 0);
    for (int k = 0; k < CHARTS; ++k) {
        c->area[k] = make_area(c, name, k);
        gtk_grid_attach(GTK_GRID(grid), c->area[k], k % 2, k / 2, 1, 1);
    }
    c->pointer = ui_label("", "value");
    gtk_widget_set_name(c->pointer, full);
    gtk_widget_set_hexpand(c->pointer, TRUE);
    GtkWidget *line = ui_box(GTK_ORIENTATION_HORIZONTAL, 12);
    gtk_widget_add_css_class(line, "below");
    gtk_box_append(GTK_BOX(line), c->pointer);
    if (beside != NULL) {
        gtk_box_append(GTK_BOX(line), beside);
    }
    c->empty = ui_label("Nothing to show yet: compute a table, or open one.", "dim");
    gtk_widget_set_halign(c->empty, GTK_ALIGN_CENTER);
    gtk_widget_set_valign(c->empty, GTK_ALIGN_CENTER);
    GtkWidget *overlay = gtk_overlay_new();
    gtk_overlay_set_child(GTK_OVERLAY(overlay), grid);
    gtk_overlay_add_overlay(GTK_OVERLAY(overlay), c->empty);
    gtk_box_append(GTK_BOX(c->widget), overlay);
    gtk_box_append(GTK_BOX(c->widget), line);
    g_object_set_data_full(G_OBJECT(c->widget), "charts", c, free_charts);
    viewer_listen(v, on_changed, c);
    g_free(full);
    return c;
}

GtkWidget *viewer_charts_widget(viewer_charts *charts) {
    return charts->widget;
}

static void name_area(GtkWidget *area, const char *field) {
    char *name = plain(field), *words = g_strdup_printf("Surface of %s; arrow keys turn it", name);
    ui_name(area, words);
    g_free(words);
    g_free(name);
}

void viewer_charts_show(viewer_charts *c, const char *title, srp_grid grid, double *value,
                        const char *const *names) {
    free(c->value);
    g_free(c->title);
    c->value = value;
    c->title = g_strdup(title);
    c->marked = false;
    gtk_widget_set_visible(c->empty, value == NULL);
    c->picture = (cli_picture){
        .title = c->title, .columns = 1, .rows = CHARTS, .grid = {grid}, .is_signed = {1, 1, 1, 0}};
    size_t nodes = srp_grid_node_count(grid);
    for (size_t k = 0; k < CHARTS && value != NULL; ++k) {
        c->picture.name[k] = names[k];
        c->picture.field[0][k].value = &value[k * nodes];
        name_area(c->area[k], names[k]);
    }
    gtk_label_set_text(GTK_LABEL(c->pointer), value != NULL ? HOW_TO : "");
    redraw(c);
}

bool viewer_charts_save(viewer_charts *c, const char *path, viewer_words *problem) {
    cli_figure_options options = cli_figure_options_default();
    if (c->value == NULL) {
        viewer_words_add(problem, "There is nothing to draw yet.");
        return false;
    }
    options.output = path;
    options.view[0] = c->v->chart_view[0][0];
    options.view[1] = c->v->chart_view[0][1];
    viewer_words_listen(problem);
    int status = cli_figure_check(&options, NULL, 0);
    if (status == CLI_DONE) {
        status = cli_figure_write(&options, &c->picture);
    }
    viewer_words_listen(NULL);
    return status == CLI_DONE;
}
