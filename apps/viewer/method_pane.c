/* SPDX-License-Identifier: Apache-2.0 */
/* The method: which, where, with what; and how exact and fast it is on this machine and model. */
#include "methods.h"
#include "ui.h"
#include "viewer.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { BOXES = 5, DEVICES_MAX = 16 };

typedef struct pane {
    viewer *v;
    GtkWidget *method, *device, *summary, *parameters, *more, *more_rows;
    GtkWidget *accuracy, *speed, *accuracy_words, *speed_words;
    const srp_method *shown; /* the method whose parameters are there */
    bool quiet;
} pane;

/* Shown at once; what else a method uses is behind "More". */
static const int FIRST[] = {METHOD_GRID,    METHOD_TOLERANCE, METHOD_REFLECTIONS,
                            METHOD_DIFFUSE, METHOD_CR,        METHOD_AREA};
static const int FURTHER[] = {METHOD_PIXEL, METHOD_WINDOW,   METHOD_COLUMNS, METHOD_ROWS,
                              METHOD_SEED,  METHOD_MAX_GRID, METHOD_BEAMS};

/* What stands in an empty entry. */
static const char *default_of(int option, char *buffer, size_t size) {
    srp_method_params params = srp_method_params_default();
    switch (option) {
    case METHOD_GRID:
        snprintf(buffer, size, "%u", params.lattice.samples);
        return buffer;
    case METHOD_MAX_GRID:
        snprintf(buffer, size, "%u", params.max_samples);
        return buffer;
    case METHOD_REFLECTIONS:
        snprintf(buffer, size, "%u", params.reflections);
        return buffer;
    case METHOD_BEAMS:
        snprintf(buffer, size, "%u", params.mirrored_beams);
        return buffer;
    case METHOD_SEED:
    case METHOD_DIFFUSE:
        return "0";
    case METHOD_TOLERANCE:
        return "none";
    default:
        return "";
    }
}

/* ---- method and device ---- */

static void show_methods(pane *p, const srp_method *chosen) {
    const char *names[16] = {NULL};
    guint count = 0, selected = 0;
    const srp_method *method;
    for (size_t i = 0; (method = cli_method_named_at(i)) != NULL && count < 15; ++i) {
        if (chosen != NULL && strcmp(method->name, chosen->name) == 0) {
            selected = count;
        }
        names[count++] = method->name;
    }
    ui_choice_set(GTK_DROP_DOWN(p->method), names, selected);
}

static void show_devices(pane *p, const srp_method *chosen) {
    const char *names[DEVICES_MAX + 1] = {NULL};
    guint count = 0, selected = 0;
    const srp_method *method;
    for (size_t i = 0; (method = cli_method_at(i)) != NULL && count < DEVICES_MAX; ++i) {
        bool numbered = g_ascii_isdigit(method->device[strlen(method->device) - 1]);
        if (chosen == NULL || strcmp(method->name, chosen->name) != 0 ||
            (numbered && method != chosen)) {
            continue;
        }
        selected = method == chosen ? count : selected;
        names[count++] = method->device;
    }
    ui_choice_set(GTK_DROP_DOWN(p->device), names, selected);
    gtk_widget_set_sensitive(p->device, count > 1);
}

static const char *selected_text(GtkDropDown *choice) {
    GObject *item = gtk_drop_down_get_selected_item(choice);
    return item != NULL ? gtk_string_object_get_string(GTK_STRING_OBJECT(item)) : "";
}

static void on_method(GtkDropDown *choice, GParamSpec *spec, gpointer user) {
    pane *p = user;
    (void)spec;
    if (!p->quiet) {
        viewer_act_text(p->v, "method", selected_text(choice));
    }
}

static void on_device(GtkDropDown *choice, GParamSpec *spec, gpointer user) {
    pane *p = user;
    (void)spec;
    if (!p->quiet) {
        viewer_act_text(p->v, "device", selected_text(choice));
    }
}

/* ---- parameters ---- */

static GtkWidget *parameter(pane *p, int option) {
    const cli_option *o = &cli_group_method.options[option];
    GtkWidget *entry =
        ui_entry(p->v, o->name, option == METHOD_WINDOW ? 14 : 7, "parameter", o->name);
    gtk_editable_set_width_chars(GTK_EDITABLE(entry), 5); /* at least */
    char buffer[32], label[48], help[VIEWER_WORDS_SIZE];
    viewer_words_method_field(option, label, sizeof label);
    if (option == METHOD_AREA) {
        g_strlcat(label, " [m²]", sizeof label);
    }
    viewer_words_for_window(o->help, help, sizeof help);
    char *tip = g_strdup_printf("%s: %s (srp: --%s)", label, o->value, o->name);
    gtk_entry_set_placeholder_text(GTK_ENTRY(entry), default_of(option, buffer, sizeof buffer));
    ui_entry_show(entry, p->v->session->setup->method_option[option]);
    GtkWidget *box = ui_box(GTK_ORIENTATION_HORIZONTAL, 3);
    GtkWidget *words = ui_mnemonic(label, entry);
    gtk_box_append(GTK_BOX(box), words);
    gtk_box_append(GTK_BOX(box), entry);
    gtk_box_append(GTK_BOX(box), ui_explanation(tip, help));
    g_object_set_data(G_OBJECT(box), "entry", entry);
    g_free(tip);
    return box;
}

static void rebuild_parameters(pane *p, const srp_method *method) {
    GtkWidget *title = gtk_widget_get_first_child(p->parameters);
    for (GtkWidget *child; (child = gtk_widget_get_next_sibling(title)) != NULL;) {
        gtk_box_remove(GTK_BOX(p->parameters), child);
    }
    ui_clear(p->more_rows);
    int shown = 0, further = 0;
    for (size_t i = 0; method != NULL && i < G_N_ELEMENTS(FIRST); ++i) {
        if (cli_method_uses(method, FIRST[i])) {
            gtk_box_append(GTK_BOX(p->parameters), parameter(p, FIRST[i]));
            ++shown;
        }
    }
    for (size_t i = 0; method != NULL && i < G_N_ELEMENTS(FURTHER); ++i) {
        if (cli_method_uses(method, FURTHER[i])) {
            GtkWidget *line = parameter(p, FURTHER[i]);
            gtk_widget_set_hexpand(gtk_widget_get_first_child(line), TRUE);
            gtk_box_append(GTK_BOX(p->more_rows), line);
            ++further;
        }
    }
    if (further > 0) {
        gtk_box_append(GTK_BOX(p->parameters), p->more);
    }
    gtk_widget_set_visible(p->parameters, shown + further > 0);
}

static void refresh_parameters(pane *p, GtkWidget *box) {
    for (GtkWidget *line = gtk_widget_get_first_child(box); line != NULL;
         line = gtk_widget_get_next_sibling(line)) {
        GtkWidget *entry = g_object_get_data(G_OBJECT(line), "entry");
        for (int i = 0; entry != NULL && i < METHOD_OPTION_COUNT; ++i) {
            if (strcmp(gtk_widget_get_name(entry), cli_group_method.options[i].name) == 0) {
                ui_entry_show(entry, p->v->session->setup->method_option[i]);
            }
        }
    }
}

static void show_setup(pane *p) {
    const srp_method *method = viewer_setup_method(p->v->session->setup);
    p->quiet = true;
    show_methods(p, method);
    show_devices(p, method);
    p->quiet = false;
    gtk_label_set_text(GTK_LABEL(p->summary), method != NULL ? method->summary : "");
    if (method != p->shown) {
        p->shown = method;
        rebuild_parameters(p, method);
    } else {
        refresh_parameters(p, p->parameters);
        refresh_parameters(p, p->more_rows);
    }
}

/* ---- accuracy and speed ---- */

/* Filled boxes for a share of 10: one for each factor of ten, none below the first. */
static int boxes_of(double value, double first) {
    double steps = floor(log10(value / first) + 1e-9) + 1.0;
    return isnan(steps) ? 0 : (int)fmax(1.0, fmin(BOXES, steps));
}

static void show_boxes(GtkWidget *label, int filled) {
    GString *text = g_string_new("");
    for (int i = 0; i < BOXES; ++i) {
        g_string_append(text, i < filled ? "■" : "□");
    }
    gtk_label_set_text(GTK_LABEL(label), text->str);
    g_string_free(text, TRUE);
}

/* Three digits, "0.451", "12.0", "1230"; not as a power of ten. */
static void write_speed(double value, char *text, size_t size) {
    double decimals = 2.0 - floor(log10(value)), unit = pow(10.0, -decimals);
    snprintf(text, size, "%.*f directions/s", (int)fmax(0.0, fmin(9.0, decimals)),
             unit * round(value / unit));
}

static void show_probe(pane *p) {
    const viewer_probe *probe = &p->v->requests.probe;
    const char *otherwise = probe->state == PROBE_RUNS ? "measuring …" : "not known";
    char accuracy[96], speed[96];
    int exact = 0, fast = 0;
    snprintf(accuracy, sizeof accuracy, "%s", otherwise);
    snprintf(speed, sizeof speed, "%s", otherwise);
    if (probe->state == PROBE_KNOWN) {
        snprintf(accuracy, sizeof accuracy, "not known");
        fast = boxes_of(1.0 / probe->seconds, 1.0);
        write_speed(1.0 / probe->seconds, speed, sizeof speed);
        if (probe->error == 0.0) {
            exact = BOXES;
            snprintf(accuracy, sizeof accuracy, "no sampling error");
        } else if (!isnan(probe->error)) {
            exact = boxes_of(1.0 / probe->error, 10.0);
            snprintf(accuracy, sizeof accuracy, "%.2g of |f| %s", probe->error,
                     probe->against_exact ? "from exact" : "standard error");
        }
    }
    show_boxes(p->accuracy, exact);
    show_boxes(p->speed, fast);
    gtk_label_set_text(GTK_LABEL(p->accuracy_words), accuracy);
    gtk_label_set_text(GTK_LABEL(p->speed_words), speed);
}

static GtkWidget *meter(const char *word, GtkWidget **boxes, GtkWidget **words, const char *name,
                        const char *tip) {
    GtkWidget *box = ui_box(GTK_ORIENTATION_HORIZONTAL, 6);
    char *full = g_strconcat(name, "-words", NULL);
    *boxes = ui_label("□□□□□", NULL);
    *words = ui_label("", "dim small");
    gtk_widget_set_name(*boxes, name);
    gtk_widget_set_name(*words, full);
    gtk_box_append(GTK_BOX(box), ui_label(word, NULL));
    gtk_box_append(GTK_BOX(box), *boxes);
    gtk_box_append(GTK_BOX(box), *words);
    gtk_widget_set_tooltip_text(box, tip);
    g_free(full);
    return box;
}

/* ---- together ---- */

static void free_pane(gpointer user) {
    pane *p = user;
    g_object_unref(p->more);
    g_free(p);
}

static void on_changed(void *user, unsigned what) {
    pane *p = user;
    if ((what & CHANGED_SETUP) != 0) {
        show_setup(p);
    }
    if ((what & CHANGED_PROBE) != 0) {
        show_probe(p);
    }
}

static void make_more(pane *p) {
    GtkWidget *popover = gtk_popover_new();
    p->more_rows = ui_box(GTK_ORIENTATION_VERTICAL, 6);
    p->more = g_object_ref_sink(ui_menu_button("More")); /* it comes and goes */
    gtk_popover_set_child(GTK_POPOVER(popover), p->more_rows);
    gtk_menu_button_set_popover(GTK_MENU_BUTTON(p->more), popover);
    gtk_widget_set_valign(p->more, GTK_ALIGN_CENTER);
}

/* What each method does. */
static GtkWidget *explanation(void) {
    GString *text = g_string_new("");
    const srp_method *method;
    for (size_t i = 0; (method = cli_method_named_at(i)) != NULL; ++i) {
        g_string_append_printf(text, "%s%s: %s.", i > 0 ? "\n" : "", method->name, method->summary);
    }
    GtkWidget *button = ui_explanation("Methods", text->str);
    g_string_free(text, TRUE);
    return button;
}

static GtkWidget *make_choices(pane *p) {
    GtkWidget *box = ui_box(GTK_ORIENTATION_HORIZONTAL, 10);
    gtk_box_append(GTK_BOX(box), p->method);
    gtk_box_append(GTK_BOX(box), explanation());
    gtk_box_append(GTK_BOX(box), ui_mnemonic("on", p->device));
    gtk_box_append(GTK_BOX(box), p->device);
    return box;
}

static GtkWidget *make_first(pane *p) {
    GtkWidget *strip = ui_titled_strip(ui_mnemonic("Metho_d", p->method));
    gtk_box_append(GTK_BOX(strip), make_choices(p));
    gtk_box_append(GTK_BOX(strip), p->summary);
    gtk_box_append(
        GTK_BOX(strip),
        meter("Accuracy", &p->accuracy, &p->accuracy_words, "accuracy",
              "Measured now, on this model, in up to 12 directions: the largest distance "
              "from the method exact, or the method's own standard error, as a share of "
              "|f|. A box for each factor of ten: 10 %, 1 %, ..."));
    gtk_box_append(GTK_BOX(strip),
                   meter("Speed", &p->speed, &p->speed_words, "speed",
                         "Measured now, on this machine and this model, in up to 12 directions. A "
                         "box for each factor of ten: 1, 10, 100, ... directions per second."));
    return strip;
}

GtkWidget *viewer_method_pane(viewer *v) {
    pane *p = g_new0(pane, 1);
    p->v = v;
    p->quiet = true;
    p->method = ui_choice("method", G_CALLBACK(on_method), p);
    p->device = ui_choice("device", G_CALLBACK(on_device), p);
    ui_name(p->device, "Device");
    p->summary = ui_paragraph("method-summary", "dim small", 40);
    p->parameters = ui_titled_strip(ui_label("", NULL));
    make_more(p);
    GtkWidget *box = ui_box(GTK_ORIENTATION_VERTICAL, 4);
    gtk_box_append(GTK_BOX(box), make_first(p));
    gtk_box_append(GTK_BOX(box), p->parameters);
    gtk_widget_add_css_class(box, "pane");
    g_object_set_data_full(G_OBJECT(box), "pane", p, free_pane);
    viewer_listen(v, on_changed, p);
    return box;
}
