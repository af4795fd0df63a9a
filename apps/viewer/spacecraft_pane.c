/* SPDX-License-Identifier: Apache-2.0 */
/* The spacecraft: file, what is odd about it, materials, mass, reference point. */
#include "messages.h"
#include "numbers.h"
#include "ui.h"
#include "viewer.h"

#include <math.h>
#include <string.h>

typedef struct pane {
    viewer *v;
    GtkWidget *name, *facts, *report, *report_words, *materials, *material_rows;
    GtkWidget *mass, *reference, *unit, *plates, *mtl;
    viewer_engine *shown; /* the engine whose materials are listed */
} pane;

/* ---- report ---- */

static void show_report(pane *p, const viewer_shape *shape) {
    GString *words = g_string_new("");
    size_t count = shape != NULL ? shape->info.finding_count : 0;
    for (size_t i = 0; i < count; ++i) {
        char text[VIEWER_WORDS_SIZE];
        viewer_words_for_window(shape->info.findings[i].text, text, sizeof text);
        g_string_append_printf(words, "%s• %s", i > 0 ? "\n" : "", text);
    }
    if (count == 0) {
        g_string_append(words, shape != NULL ? "Nothing odd about this mesh: closed, or open as a "
                                               "membrane is, no double faces, no holes."
                                             : "");
    }
    gtk_label_set_text(GTK_LABEL(p->report_words), words->str);
    char *label =
        count == 0 ? g_strdup("Mesh is fine")
                   : g_strdup_printf("%zu %s on the mesh", count, cli_form(count, "note", "notes"));
    gtk_menu_button_set_label(GTK_MENU_BUTTON(p->report), label);
    gtk_widget_set_visible(p->report, shape != NULL);
    g_free(label);
    g_string_free(words, TRUE);
}

static void show_facts(pane *p, const viewer_shape *shape) {
    if (shape == NULL) {
        gtk_label_set_text(GTK_LABEL(p->facts), "Open an OBJ file, or drop one on the window.");
        return;
    }
    const srp_mesh_report *r = &shape->info.report;
    srp_vec3 size = srp_vec3_sub(r->box_max, r->box_min);
    char *text = g_strdup_printf(
        "%zu %s · %zu %s · %zu %s · %.3g × %.3g × %.3g m · %.4g m² of surface", r->triangles,
        cli_form(r->triangles, "triangle", "triangles"), r->components,
        cli_form(r->components, "part", "parts"), shape->info.material_count,
        cli_form(shape->info.material_count, "material", "materials"), size.x, size.y, size.z,
        r->area);
    gtk_label_set_text(GTK_LABEL(p->facts), text);
    g_free(text);
}

/* ---- materials ---- */

typedef struct row {
    pane *p;
    char *name;
    GtkWidget *rho_s, *rho_d, *one_sided;
    bool quiet;
} row;

static void free_row(gpointer user) {
    row *r = user;
    g_free(r->name);
    g_free(r);
}

static void on_optics(GtkWidget *widget, gpointer user) {
    row *r = user;
    (void)widget;
    if (r->quiet) {
        return;
    }
    char s[CLI_NUMBER_SIZE], d[CLI_NUMBER_SIZE];
    cli_write_number(ui_number_value(r->rho_s), s);
    cli_write_number(ui_number_value(r->rho_d), d);
    bool one_sided = gtk_check_button_get_active(GTK_CHECK_BUTTON(r->one_sided));
    char *text = g_strdup_printf("%s=%s,%s%s", r->name, s, d, one_sided ? ",one-sided" : "");
    viewer_act_text(r->p->v, "material", text);
    g_free(text);
}

static GtkWidget *share(row *r, const char *kind, const char *symbol, double value) {
    char *name = g_strdup_printf("%s-%s", kind, r->name);
    char *words = g_strdup_printf("%s of %s", symbol, r->name);
    GtkWidget *number =
        ui_number(r->p->v, name, words, (ui_range){0.0, 1.0, 0.01, false}, on_optics, r);
    gtk_editable_set_width_chars(GTK_EDITABLE(number), 10);
    ui_number_show(number, value);
    g_free(words);
    g_free(name);
    return number;
}

static void add_row(pane *p, const viewer_engine *engine, size_t index, int at) {
    const info_material *material = &engine->shape->info.materials[index];
    srp_optics optics = {0.0, 0.0, false};
    bool known = viewer_engine_optics(engine, index, &optics);
    row *r = g_new0(row, 1);
    GtkGrid *grid = GTK_GRID(p->material_rows);
    r->p = p;
    r->quiet = true;
    r->name = g_strdup(material->name);
    GtkWidget *name = ui_label(material->name[0] != '\0' ? material->name : "(no name)", NULL);
    gtk_label_set_ellipsize(GTK_LABEL(name), PANGO_ELLIPSIZE_END);
    gtk_label_set_max_width_chars(GTK_LABEL(name), 28);
    char *area = g_strdup_printf("%.4g m²", material->area);
    GtkWidget *size = ui_label(area, "dim");
    gtk_label_set_xalign(GTK_LABEL(size), 1.0f);
    g_free(area);
    r->rho_s = share(r, "rho-s", "ρ specular", optics.rho_s);
    r->rho_d = share(r, "rho-d", "ρ diffuse", optics.rho_d);
    r->one_sided = gtk_check_button_new();
    char *words = g_strconcat(r->name, " is one-sided", NULL);
    ui_name(r->one_sided, words);
    g_free(words);
    gtk_widget_set_halign(r->one_sided, GTK_ALIGN_CENTER);
    gtk_check_button_set_active(GTK_CHECK_BUTTON(r->one_sided), optics.one_sided);
    g_signal_connect(r->one_sided, "toggled", G_CALLBACK(on_optics), r);
    g_object_set_data_full(G_OBJECT(r->rho_s), "row", r, free_row);
    gtk_grid_attach(grid, name, 0, at, 1, 1);
    gtk_grid_attach(grid, size, 1, at, 1, 1);
    gtk_grid_attach(grid, r->rho_s, 2, at, 1, 1);
    gtk_grid_attach(grid, r->rho_d, 3, at, 1, 1);
    gtk_grid_attach(grid, r->one_sided, 4, at, 1, 1);
    if (!known) {
        gtk_grid_attach(grid, ui_label("not known", "problem-text"), 5, at, 1, 1);
    }
    r->quiet = false;
}

/* What was said last, which the engine may not have heard of yet. */
static bool optics_of(const row *r, const viewer_engine *engine, size_t index, srp_optics *out) {
    return viewer_setup_find_material(r->p->v->session->setup, r->name, out) ||
           viewer_engine_optics(engine, index, out);
}

static void refresh_row(row *r, const viewer_engine *engine, size_t index) {
    srp_optics optics;
    if (!optics_of(r, engine, index, &optics)) {
        return;
    }
    r->quiet = true;
    ui_number_show(r->rho_s, optics.rho_s);
    ui_number_show(r->rho_d, optics.rho_d);
    gtk_check_button_set_active(GTK_CHECK_BUTTON(r->one_sided), optics.one_sided);
    r->quiet = false;
}

static void refresh_rows(pane *p, const viewer_engine *engine) {
    const cli_info *info = &engine->shape->info;
    for (GtkWidget *child = gtk_widget_get_first_child(p->material_rows); child != NULL;
         child = gtk_widget_get_next_sibling(child)) {
        row *r = g_object_get_data(G_OBJECT(child), "row");
        for (size_t i = 0; r != NULL && i < info->material_count; ++i) {
            if (strcmp(r->name, info->materials[i].name) == 0) {
                refresh_row(r, engine, i);
            }
        }
    }
}

/* The rows stay as long as they are of the same materials, since the user may be typing in one. */
static void show_materials(pane *p, viewer_engine *engine) {
    bool same = p->shown != NULL && engine != NULL && p->shown->shape == engine->shape &&
                p->shown->optics_known && engine->optics_known &&
                engine->setup->material_count >= p->shown->setup->material_count;
    viewer_engine_release(p->shown);
    p->shown = viewer_engine_reference(engine);
    gtk_widget_set_visible(p->mtl,
                           engine != NULL && engine->shape != NULL && !engine->optics_known);
    gtk_widget_set_sensitive(p->materials, engine != NULL && engine->shape != NULL);
    if (same) {
        refresh_rows(p, engine);
        return;
    }
    static const char *const heads[] = {"Material", "Area", "ρ specular", "ρ diffuse", "One-sided"};
    ui_clear(p->material_rows);
    for (int i = 0; i < 5; ++i) {
        gtk_grid_attach(GTK_GRID(p->material_rows), ui_label(heads[i], "heading"), i, 0, 1, 1);
    }
    size_t count = engine != NULL && engine->shape != NULL ? engine->shape->info.material_count : 0;
    for (size_t i = 0; i < count; ++i) {
        add_row(p, engine, i, (int)i + 1);
    }
}

/* ---- the rest ---- */

enum { NAME_CHARS = 16 }; /* a longer name gives way to the rest */

static const char *const UNITS[] = {"m", "cm", "mm", "in", "ft", NULL};

static void on_unit(GtkDropDown *unit, GParamSpec *spec, gpointer user) {
    pane *p = user;
    (void)spec;
    guint at = gtk_drop_down_get_selected(unit);
    const char *now = p->v->session->setup->model_option[MODEL_UNIT];
    if (at < 5 && strcmp(UNITS[at], now != NULL ? now : "m") != 0) {
        viewer_act_text(p->v, "unit", UNITS[at]);
    }
}

static void show_setup(pane *p) {
    const viewer_setup *setup = p->v->session->setup;
    char number[CLI_NUMBER_SIZE];
    char *base = setup->model != NULL ? g_path_get_basename(setup->model) : g_strdup("None yet");
    char *valid = g_utf8_make_valid(base, -1);
    gtk_label_set_text(GTK_LABEL(p->name), valid);
    bool is_long = g_utf8_strlen(valid, -1) > NAME_CHARS;
    gtk_label_set_ellipsize(GTK_LABEL(p->name),
                            is_long ? PANGO_ELLIPSIZE_MIDDLE : PANGO_ELLIPSIZE_NONE);
    gtk_label_set_width_chars(GTK_LABEL(p->name), is_long ? NAME_CHARS : -1);
    gtk_widget_set_tooltip_text(p->name, setup->model);
    g_free(valid);
    g_free(base);
    ui_entry_show(p->mass, isnan(setup->mass) ? "" : cli_write_number(setup->mass, number));
    ui_entry_show(p->reference, setup->method_option[METHOD_REFERENCE]);
    for (guint i = 0; UNITS[i] != NULL; ++i) {
        const char *now = setup->model_option[MODEL_UNIT];
        if (strcmp(UNITS[i], now != NULL ? now : "m") == 0) {
            gtk_drop_down_set_selected(GTK_DROP_DOWN(p->unit), i);
        }
    }
    const char *plates = setup->model_option[MODEL_PLATES];
    ui_button_show_file(p->plates, plates, "C_hoose Plates…");
    const srp_method *method = viewer_setup_method(setup);
    gtk_widget_set_visible(p->plates, method != NULL && (method->shapes & SRP_SHAPE_PLATES) != 0);
}

static void on_changed(void *user, unsigned what) {
    pane *p = user;
    if ((what & CHANGED_SETUP) != 0) {
        show_setup(p);
        if (p->shown != NULL && p->shown->shape != NULL) {
            refresh_rows(p, p->shown);
        }
    }
    if ((what & CHANGED_ENGINE) != 0) {
        viewer_engine *engine = p->v->session->engine;
        const viewer_shape *shape = engine != NULL ? engine->shape : NULL;
        show_facts(p, shape);
        show_report(p, shape);
        show_materials(p, engine);
    }
}

static void free_pane(gpointer user) {
    pane *p = user;
    viewer_engine_release(p->shown);
    g_free(p);
}

static void make_popovers(pane *p) {
    p->report = ui_menu_button("Mesh");
    p->report_words = ui_label("", NULL);
    gtk_widget_set_name(p->report, "report");
    gtk_widget_set_name(p->report_words, "report-words");
    gtk_label_set_wrap(GTK_LABEL(p->report_words), TRUE);
    gtk_label_set_max_width_chars(GTK_LABEL(p->report_words), 70);
    gtk_menu_button_set_popover(GTK_MENU_BUTTON(p->report), ui_popover(p->report_words, 420));
    p->materials = ui_menu_button("_Materials");
    p->material_rows = gtk_grid_new();
    gtk_grid_set_column_spacing(GTK_GRID(p->material_rows), 10);
    gtk_grid_set_row_spacing(GTK_GRID(p->material_rows), 4);
    GtkWidget *box = ui_box(GTK_ORIENTATION_VERTICAL, 8);
    GtkWidget *reset = ui_button("As in the _Files", "material", "Forget what was said here");
    gtk_actionable_set_action_target(GTK_ACTIONABLE(reset), "s", "");
    gtk_widget_set_halign(reset, GTK_ALIGN_END);
    gtk_box_append(GTK_BOX(box), p->material_rows);
    gtk_box_append(GTK_BOX(box), reset);
    gtk_menu_button_set_popover(GTK_MENU_BUTTON(p->materials), ui_popover(box, 420));
    gtk_widget_set_name(p->materials, "materials");
}

static GtkWidget *make_fields(pane *p) {
    GtkWidget *strip = ui_titled_strip(ui_label("", NULL));
    GtkBox *line = GTK_BOX(strip);
    p->mass = ui_entry(p->v, "mass", 8, "mass", NULL);
    p->reference = ui_entry(p->v, "reference", 10, "parameter", "reference");
    gtk_entry_set_placeholder_text(GTK_ENTRY(p->mass), "kg");
    gtk_entry_set_placeholder_text(GTK_ENTRY(p->reference), "0,0,0");
    p->unit = gtk_drop_down_new_from_strings(UNITS);
    gtk_widget_set_name(p->unit, "unit");
    gtk_widget_set_valign(p->unit, GTK_ALIGN_CENTER);
    g_signal_connect(p->unit, "notify::selected", G_CALLBACK(on_unit), p);
    p->plates = ui_button("C_hoose Plates…", "choose-plates", "Plates file of the method nplate");
    GtkWidget *reference = ui_pair(ui_mnemonic("Mome_nts about [m]", p->reference), p->reference);
    gtk_box_append(
        GTK_BOX(reference),
        ui_explanation("Reference point", cli_group_method.options[METHOD_REFERENCE].help));
    gtk_box_append(line, ui_pair(ui_mnemonic("Mass [_kg]", p->mass), p->mass));
    gtk_box_append(line, reference);
    gtk_box_append(line, ui_pair(ui_mnemonic("Un_it", p->unit), p->unit));
    gtk_box_append(line, p->plates);
    return strip;
}

GtkWidget *viewer_spacecraft_pane(viewer *v) {
    pane *p = g_new0(pane, 1);
    p->v = v;
    GtkWidget *box = ui_box(GTK_ORIENTATION_VERTICAL, 4);
    GtkWidget *first = ui_titled_strip(ui_label("Spacecraft", NULL));
    p->name = ui_label("", "big");
    p->facts = ui_paragraph("model-facts", "dim", 32);
    gtk_widget_set_name(p->name, "model-name");
    make_popovers(p);
    p->mtl =
        ui_button("Find MT_L…", "choose-mtl", "Take the optics of the materials from an MTL file");
    gtk_widget_set_name(p->mtl, "mtl");
    gtk_box_append(GTK_BOX(first), p->name);
    gtk_box_append(GTK_BOX(first), p->facts);
    gtk_box_append(GTK_BOX(first), p->report);
    gtk_box_append(GTK_BOX(first), p->mtl);
    gtk_box_append(GTK_BOX(first), p->materials);
    gtk_box_append(GTK_BOX(box), first);
    gtk_box_append(GTK_BOX(box), make_fields(p));
    gtk_widget_add_css_class(box, "pane");
    g_object_set_data_full(G_OBJECT(box), "pane", p, free_pane);
    viewer_listen(v, on_changed, p);
    return box;
}
