/* SPDX-License-Identifier: Apache-2.0 */
#include "ui.h"

#include "numbers.h"
#include "wrap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

GtkWidget *ui_box(GtkOrientation orientation, int spacing) {
    return gtk_box_new(orientation, spacing);
}

static void add_classes(GtkWidget *widget, const char *classes) {
    char **each = classes != NULL ? g_strsplit(classes, " ", -1) : NULL;
    for (size_t i = 0; each != NULL && each[i] != NULL; ++i) {
        gtk_widget_add_css_class(widget, each[i]);
    }
    g_strfreev(each);
}

/* GTK calls an empty label "GtkLabel". */
static void on_label_text(GtkLabel *label, GParamSpec *spec, gpointer user) {
    (void)spec, (void)user;
    gtk_accessible_update_state(GTK_ACCESSIBLE(label), GTK_ACCESSIBLE_STATE_HIDDEN,
                                gtk_label_get_text(label)[0] == '\0', -1);
}

GtkWidget *ui_label(const char *text, const char *classes) {
    GtkWidget *label = gtk_label_new(NULL);
    g_signal_connect(label, "notify::label", G_CALLBACK(on_label_text), NULL);
    gtk_label_set_text(GTK_LABEL(label), text);
    on_label_text(GTK_LABEL(label), NULL, NULL);
    gtk_label_set_xalign(GTK_LABEL(label), 0.0f);
    add_classes(label, classes);
    return label;
}

GtkWidget *ui_paragraph(const char *name, const char *classes, int width) {
    GtkWidget *label = ui_label("", classes);
    gtk_label_set_wrap(GTK_LABEL(label), TRUE);
    gtk_label_set_width_chars(GTK_LABEL(label), width);
    gtk_widget_set_hexpand(label, TRUE);
    gtk_widget_set_name(label, name);
    return label;
}

static void on_value_text(GtkWidget *label, GParamSpec *spec, gpointer user) {
    (void)spec, (void)user;
    const char *words = g_object_get_data(G_OBJECT(label), "words");
    char *name = g_strdup_printf("%s: %s", words, gtk_label_get_text(GTK_LABEL(label)));
    ui_name(label, name);
    g_free(name);
}

GtkWidget *ui_value(const char *name, const char *words) {
    GtkWidget *label = ui_label("", "value");
    g_object_set_data_full(G_OBJECT(label), "words", g_strdup(words), g_free);
    g_signal_connect(label, "notify::label", G_CALLBACK(on_value_text), NULL);
    gtk_label_set_xalign(GTK_LABEL(label), 1.0f);
    gtk_label_set_selectable(GTK_LABEL(label), TRUE);
    gtk_widget_set_can_focus(label, FALSE);
    gtk_widget_set_name(label, name);
    return label;
}

static void name_unless_named(GtkWidget *widget, const char *words) {
    GtkAccessible *accessible = GTK_ACCESSIBLE(widget);
    if (gtk_test_accessible_has_property(accessible, GTK_ACCESSIBLE_PROPERTY_LABEL)) {
        gtk_accessible_reset_relation(accessible, GTK_ACCESSIBLE_RELATION_LABELLED_BY);
    } else {
        ui_name(widget, words);
    }
}

GtkWidget *ui_mnemonic(const char *text, GtkWidget *target) {
    GtkWidget *label = gtk_label_new_with_mnemonic(text);
    gtk_label_set_xalign(GTK_LABEL(label), 0.0f);
    gtk_label_set_mnemonic_widget(GTK_LABEL(label), target);
    name_unless_named(target, gtk_label_get_text(GTK_LABEL(label)));
    return label;
}

/* ---- buttons ---- */

/* GTK names a button by its text with the underscore, and by the label in it. */
static void on_button_text(GtkWidget *button, GParamSpec *spec, gpointer user) {
    (void)spec, (void)user;
    gtk_accessible_reset_property(GTK_ACCESSIBLE(button), GTK_ACCESSIBLE_PROPERTY_LABEL);
}

GtkWidget *ui_button(const char *text, const char *action, const char *tip) {
    GtkWidget *button = gtk_button_new();
    char *full = g_strconcat("win.", action, NULL);
    g_signal_connect(button, "notify::label", G_CALLBACK(on_button_text), NULL);
    gtk_button_set_use_underline(GTK_BUTTON(button), TRUE);
    gtk_button_set_label(GTK_BUTTON(button), text);
    gtk_actionable_set_action_name(GTK_ACTIONABLE(button), full);
    gtk_widget_set_name(button, action);
    gtk_widget_set_valign(button, GTK_ALIGN_CENTER);
    gtk_widget_set_tooltip_text(button, tip);
    g_free(full);
    return button;
}

void ui_button_show_file(GtkWidget *button, const char *path, const char *words) {
    char *base = path != NULL ? g_path_get_basename(path) : g_strdup(words);
    char *valid = g_utf8_make_valid(base, -1);
    gtk_button_set_use_underline(GTK_BUTTON(button), path == NULL);
    gtk_button_set_label(GTK_BUTTON(button), valid);
    g_free(valid);
    g_free(base);
}

static void name_without_key(GtkWidget *widget, const char *text) {
    char **parts = g_strsplit(text, "_", -1), *plain = g_strjoinv("", parts);
    ui_name(widget, plain);
    g_free(plain);
    g_strfreev(parts);
}

GtkWidget *ui_check(const char *text) {
    GtkWidget *check = gtk_check_button_new_with_mnemonic(text);
    name_without_key(check, text);
    return check;
}

/* GTK names the button within, and not what is around it. */
static void on_menu_button_text(GtkMenuButton *button, GParamSpec *spec, gpointer user) {
    (void)spec, (void)user;
    name_without_key(GTK_WIDGET(button), gtk_menu_button_get_label(button));
}

GtkWidget *ui_menu_button(const char *text) {
    GtkWidget *button = gtk_menu_button_new();
    g_signal_connect(button, "notify::label", G_CALLBACK(on_menu_button_text), NULL);
    gtk_menu_button_set_use_underline(GTK_MENU_BUTTON(button), TRUE);
    gtk_menu_button_set_label(GTK_MENU_BUTTON(button), text);
    return button;
}

void ui_name(GtkWidget *widget, const char *words) {
    GtkAccessible *accessible = GTK_ACCESSIBLE(widget);
    /* Not by a label as well. */
    gtk_accessible_reset_relation(accessible, GTK_ACCESSIBLE_RELATION_LABELLED_BY);
    gtk_accessible_update_property(accessible, GTK_ACCESSIBLE_PROPERTY_LABEL, words, -1);
    if (GTK_IS_DROP_DOWN(widget)) { /* the button in it, too */
        ui_name(gtk_widget_get_first_child(widget), words);
    }
}

GtkWidget *ui_progress(const char *name, const char *called) {
    GtkWidget *bar = gtk_progress_bar_new();
    gtk_widget_set_name(bar, name);
    ui_name(bar, called);
    gtk_progress_bar_set_show_text(GTK_PROGRESS_BAR(bar), TRUE);
    gtk_widget_set_valign(bar, GTK_ALIGN_CENTER);
    gtk_widget_set_size_request(bar, 150, -1);
    return bar;
}

GtkWidget *ui_strip(int spacing) {
    GtkWidget *strip = ui_box(GTK_ORIENTATION_HORIZONTAL, spacing);
    gtk_widget_set_layout_manager(strip, viewer_wrap_new(spacing, false));
    return strip;
}

GtkWidget *ui_titled_strip(GtkWidget *title) {
    const int spacing = 10;
    GtkWidget *strip = ui_box(GTK_ORIENTATION_HORIZONTAL, spacing);
    gtk_widget_set_layout_manager(strip, viewer_wrap_new(spacing, true));
    gtk_widget_add_css_class(title, "title-word");
    gtk_box_append(GTK_BOX(strip), title);
    return strip;
}

GtkWidget *ui_pair(GtkWidget *word, GtkWidget *control) {
    GtkWidget *pair = ui_box(GTK_ORIENTATION_HORIZONTAL, 6);
    gtk_box_append(GTK_BOX(pair), word);
    gtk_box_append(GTK_BOX(pair), control);
    return pair;
}

GtkWidget *ui_side(GtkWidget *column) {
    GtkWidget *side = gtk_scrolled_window_new();
    gtk_widget_add_css_class(column, "side");
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(side), column);
    gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(side), GTK_POLICY_NEVER,
                                   GTK_POLICY_AUTOMATIC);
    gtk_widget_set_hexpand(side, FALSE);
    return side;
}

GtkWidget *ui_popover(GtkWidget *child, int height) {
    GtkWidget *popover = gtk_popover_new(), *scrolled = gtk_scrolled_window_new();
    gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scrolled), GTK_POLICY_NEVER,
                                   GTK_POLICY_AUTOMATIC);
    gtk_scrolled_window_set_propagate_natural_height(GTK_SCROLLED_WINDOW(scrolled), TRUE);
    gtk_scrolled_window_set_propagate_natural_width(GTK_SCROLLED_WINDOW(scrolled), TRUE);
    gtk_scrolled_window_set_max_content_height(GTK_SCROLLED_WINDOW(scrolled), height);
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scrolled), child);
    gtk_popover_set_child(GTK_POPOVER(popover), scrolled);
    return popover;
}

GtkWidget *ui_explanation(const char *heading, const char *text) {
    GtkWidget *button = gtk_menu_button_new();
    GtkWidget *popover = gtk_popover_new(), *box = ui_box(GTK_ORIENTATION_VERTICAL, 6);
    GtkWidget *words = ui_label(text, NULL);
    gtk_label_set_wrap(GTK_LABEL(words), TRUE);
    gtk_label_set_max_width_chars(GTK_LABEL(words), 44);
    gtk_box_append(GTK_BOX(box), ui_label(heading, "heading"));
    gtk_box_append(GTK_BOX(box), words);
    gtk_popover_set_child(GTK_POPOVER(popover), box);
    gtk_menu_button_set_child(GTK_MENU_BUTTON(button), gtk_label_new("i"));
    gtk_menu_button_set_popover(GTK_MENU_BUTTON(button), popover);
    gtk_menu_button_set_has_frame(GTK_MENU_BUTTON(button), FALSE);
    gtk_widget_add_css_class(button, "explain");
    gtk_widget_set_valign(button, GTK_ALIGN_CENTER);
    gtk_widget_set_tooltip_text(button, text);
    char *name = g_strdup_printf("About: %s", heading);
    ui_name(button, name);
    g_free(name);
    return button;
}

/* ---- entries ---- */

typedef struct entry_target {
    viewer *v;
    char *action, *key;
    char *shown; /* what the session has; NULL: it is being changed */
} entry_target;

static void free_target(gpointer user) {
    entry_target *target = user;
    g_free(target->action);
    g_free(target->key);
    g_free(target->shown);
    g_free(target);
}

static void send_text(GtkWidget *entry) {
    entry_target *target = g_object_get_data(G_OBJECT(entry), "target");
    const char *text = gtk_editable_get_text(GTK_EDITABLE(entry));
    if (target->shown == NULL || strcmp(text, target->shown) == 0 || target->v->window == NULL) {
        return;
    }
    char *words =
        target->key != NULL ? g_strdup_printf("%s=%s", target->key, text) : g_strdup(text);
    char *before = g_steal_pointer(&target->shown);
    g_object_ref(entry);
    viewer_act_text(target->v, target->action, words);
    if (target->shown == NULL) { /* refused, or nobody says what it has become */
        ui_entry_show(entry, before);
    }
    g_object_unref(entry);
    g_free(before);
    g_free(words);
}

static void on_activate(GtkEntry *entry, gpointer user) {
    (void)user;
    send_text(GTK_WIDGET(entry));
}

static void on_leave(GtkEventControllerFocus *focus, gpointer user) {
    (void)user;
    send_text(gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(focus)));
}

GtkWidget *ui_entry(viewer *v, const char *name, int width, const char *action, const char *key) {
    GtkWidget *entry = gtk_entry_new();
    entry_target *target = g_new0(entry_target, 1);
    target->v = v;
    target->action = g_strdup(action);
    target->key = g_strdup(key);
    target->shown = g_strdup("");
    g_object_set_data_full(G_OBJECT(entry), "target", target, free_target);
    gtk_widget_set_name(entry, name);
    gtk_editable_set_width_chars(GTK_EDITABLE(entry), width);
    gtk_editable_set_max_width_chars(GTK_EDITABLE(entry), width);
    gtk_widget_set_valign(entry, GTK_ALIGN_CENTER);
    g_signal_connect(entry, "activate", G_CALLBACK(on_activate), NULL);
    GtkEventController *focus = gtk_event_controller_focus_new();
    g_signal_connect(focus, "leave", G_CALLBACK(on_leave), NULL);
    gtk_widget_add_controller(entry, focus);
    return entry;
}

void ui_entry_show(GtkWidget *entry, const char *text) {
    entry_target *target = g_object_get_data(G_OBJECT(entry), "target");
    text = text != NULL ? text : "";
    if (g_strcmp0(text, target->shown) != 0) {
        g_free(target->shown);
        target->shown = g_strdup(text);
        if (strcmp(text, gtk_editable_get_text(GTK_EDITABLE(entry))) != 0) {
            gtk_editable_set_text(GTK_EDITABLE(entry), text);
        }
    }
}

/* ---- numbers ---- */

typedef struct number {
    viewer *v;
    char *words;
    ui_range range;
    ui_number_changed changed;
    void *user;
    double value; /* what the session has */
    bool known;   /* false: it is being changed */
    bool quiet;
} number;

static void free_number(gpointer user) {
    number *n = user;
    g_free(n->words);
    g_free(n);
}

static number *number_of(gpointer spin) {
    return g_object_get_data(G_OBJECT(spin), "number");
}

enum { DIGITS_SIZE = G_ASCII_DTOSTR_BUF_SIZE };

/* As many digits as tell what it is, but for what arithmetic leaves at the end. */
static const char *digits_of(double value, char buffer[DIGITS_SIZE]) {
    return g_ascii_formatd(buffer, DIGITS_SIZE, "%.10g", value);
}

static gboolean on_number_output(GtkSpinButton *spin, gpointer user) {
    char text[DIGITS_SIZE];
    (void)user;
    digits_of(gtk_spin_button_get_value(spin), text);
    if (strcmp(text, gtk_editable_get_text(GTK_EDITABLE(spin))) != 0) {
        gtk_editable_set_text(GTK_EDITABLE(spin), text);
    }
    return TRUE;
}

static void complain_of_number(const number *n, const char *text) {
    char least[DIGITS_SIZE], most[DIGITS_SIZE];
    char *line = g_strdup_printf("%s %s: expected a %s from %s to %s%s", n->words, text,
                                 n->range.whole ? "whole number" : "number",
                                 digits_of(n->range.least, least), digits_of(n->range.most, most),
                                 strchr(text, ',') != NULL ? ", with a decimal point" : "");
    viewer_complain(n->v, line);
    g_free(line);
}

static int on_number_input(GtkSpinButton *spin, double *value, gpointer user) {
    const number *n = user;
    const char *text = gtk_editable_get_text(GTK_EDITABLE(spin));
    char shown[DIGITS_SIZE];
    double now = gtk_spin_button_get_value(spin);
    *value = now;
    if (strcmp(text, digits_of(now, shown)) == 0) {
        return TRUE; /* with the digits that are not shown */
    }
    if (!cli_read_number(text, value) || *value < n->range.least || *value > n->range.most ||
        (n->range.whole && *value != floor(*value))) {
        complain_of_number(n, text);
        *value = now;
        return GTK_INPUT_ERROR;
    }
    return TRUE;
}

static void on_number_changed(GtkSpinButton *spin, gpointer user) {
    number *n = user;
    char was[DIGITS_SIZE], is[DIGITS_SIZE];
    double before = n->value;
    digits_of(gtk_spin_button_get_value(spin), is);
    if (n->quiet || strcmp(digits_of(before, was), is) == 0 || n->v->window == NULL) {
        return;
    }
    g_object_ref(spin);
    n->value = g_ascii_strtod(is, NULL);
    n->known = false;
    n->changed(GTK_WIDGET(spin), n->user);
    if (!n->known) { /* refused */
        ui_number_show(GTK_WIDGET(spin), before);
    }
    g_object_unref(spin);
}

GtkWidget *ui_number(viewer *v, const char *name, const char *words, ui_range range,
                     ui_number_changed changed, void *user) {
    GtkWidget *widget = gtk_spin_button_new_with_range(range.least, range.most, range.step);
    GtkSpinButton *spin = GTK_SPIN_BUTTON(widget);
    number *n = g_new0(number, 1);
    *n = (number){v, g_strdup(words), range, changed, user, range.least, true, false};
    g_object_set_data_full(G_OBJECT(spin), "number", n, free_number);
    gtk_widget_set_name(widget, name);
    gtk_widget_set_valign(widget, GTK_ALIGN_CENTER);
    ui_name(widget, words);
    gtk_spin_button_set_numeric(spin, FALSE); /* it would leave out what it does not know */
    gtk_spin_button_set_update_policy(spin, GTK_UPDATE_IF_VALID);
    g_signal_connect(spin, "input", G_CALLBACK(on_number_input), n);
    g_signal_connect(spin, "output", G_CALLBACK(on_number_output), n);
    g_signal_connect(spin, "value-changed", G_CALLBACK(on_number_changed), n);
    gtk_spin_button_update(spin);
    return widget;
}

double ui_number_value(GtkWidget *widget) {
    return number_of(widget)->value;
}

/* What the user is typing stays while the number is still the same. */
void ui_number_show(GtkWidget *widget, double value) {
    number *n = number_of(widget);
    if (n->known && value == n->value) {
        return;
    }
    n->known = true;
    n->value = value;
    n->quiet = true;
    gtk_adjustment_set_value(gtk_spin_button_get_adjustment(GTK_SPIN_BUTTON(widget)), value);
    on_number_output(GTK_SPIN_BUTTON(widget), NULL);
    n->quiet = false;
}

/* ---- what is typed ---- */

void ui_take_typed(viewer *v) {
    GtkWidget *focus = v->window != NULL ? gtk_window_get_focus(v->window) : NULL;
    GtkWidget *entry = focus != NULL ? gtk_widget_get_ancestor(focus, GTK_TYPE_ENTRY) : NULL;
    GtkWidget *spin = focus != NULL ? gtk_widget_get_ancestor(focus, GTK_TYPE_SPIN_BUTTON) : NULL;
    if (entry != NULL && g_object_get_data(G_OBJECT(entry), "target") != NULL) {
        send_text(entry);
    }
    if (spin != NULL && number_of(spin) != NULL && number_of(spin)->known) {
        gtk_spin_button_update(GTK_SPIN_BUTTON(spin));
    }
}

/* ---- the rest ---- */

static void on_setup(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer user) {
    (void)factory, (void)user;
    GtkWidget *label = ui_label("", NULL);
    gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_END);
    gtk_label_set_width_chars(GTK_LABEL(label), 8);
    gtk_list_item_set_child(item, label);
}

static void on_bind(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer user) {
    (void)factory, (void)user;
    const char *text =
        gtk_string_object_get_string(GTK_STRING_OBJECT(gtk_list_item_get_item(item)));
    gtk_label_set_text(GTK_LABEL(gtk_list_item_get_child(item)), text);
    gtk_widget_set_tooltip_text(gtk_list_item_get_child(item), text);
}

/* In the list all words are whole. */
static void on_setup_whole(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer user) {
    (void)factory, (void)user;
    gtk_list_item_set_child(item, ui_label("", NULL));
}

static GtkListItemFactory *factory_of(GCallback setup) {
    GtkListItemFactory *factory = gtk_signal_list_item_factory_new();
    g_signal_connect(factory, "setup", setup, NULL);
    g_signal_connect(factory, "bind", G_CALLBACK(on_bind), NULL);
    return factory;
}

GtkWidget *ui_choice(const char *name, GCallback chosen, gpointer user) {
    GtkWidget *widget = gtk_drop_down_new(NULL, NULL);
    GtkListItemFactory *cut = factory_of(G_CALLBACK(on_setup));
    GtkListItemFactory *whole = factory_of(G_CALLBACK(on_setup_whole));
    gtk_drop_down_set_factory(GTK_DROP_DOWN(widget), cut);
    gtk_drop_down_set_list_factory(GTK_DROP_DOWN(widget), whole);
    g_object_unref(cut);
    g_object_unref(whole);
    gtk_widget_set_name(widget, name);
    gtk_widget_set_valign(widget, GTK_ALIGN_CENTER);
    g_signal_connect(widget, "notify::selected", chosen, user);
    return widget;
}

void ui_choice_set(GtkDropDown *choice, const char *const *words, guint selected) {
    GtkStringList *list = gtk_string_list_new(words);
    gtk_drop_down_set_model(choice, G_LIST_MODEL(list));
    gtk_drop_down_set_selected(choice, selected);
    g_object_unref(list);
}

void ui_choice_set_tables(viewer *v, GtkDropDown *choice, int selected) {
    const viewer_session *s = v->session;
    char **labels = g_new0(char *, s->table_count + 1);
    for (size_t i = 0; i < s->table_count; ++i) {
        char *label = viewer_session_table_label(s, i);
        labels[i] = g_strdup(label != NULL ? label : s->tables[i]->name);
        free(label);
    }
    ui_choice_set(choice, (const char *const *)labels,
                  selected >= 0 ? (guint)selected : GTK_INVALID_LIST_POSITION);
    gtk_widget_set_sensitive(GTK_WIDGET(choice), s->table_count > 0);
    g_strfreev(labels);
}

void ui_clear(GtkWidget *parent) {
    for (GtkWidget *child; (child = gtk_widget_get_first_child(parent)) != NULL;) {
        if (GTK_IS_GRID(parent)) {
            gtk_grid_remove(GTK_GRID(parent), child);
        } else {
            gtk_box_remove(GTK_BOX(parent), child);
        }
    }
}

static GtkWidget *find_below(GtkWidget *widget, const char *name) {
    if (strcmp(gtk_widget_get_name(widget), name) == 0) {
        return widget;
    }
    for (GtkWidget *child = gtk_widget_get_first_child(widget); child != NULL;
         child = gtk_widget_get_next_sibling(child)) {
        GtkWidget *found = find_below(child, name);
        if (found != NULL) {
            return found;
        }
    }
    return NULL;
}

GtkWidget *ui_find(viewer *v, const char *name) {
    return v->window != NULL ? find_below(GTK_WIDGET(v->window), name) : NULL;
}

/* GTK calls a widget that has no name by its type. */
static void append_names(GtkWidget *widget, GString *names) {
    const char *name = gtk_widget_get_name(widget);
    if (strcmp(name, G_OBJECT_TYPE_NAME(widget)) != 0) {
        g_string_append_printf(names, "%s%s", names->len > 0 ? " " : "", name);
    }
    for (GtkWidget *child = gtk_widget_get_first_child(widget); child != NULL;
         child = gtk_widget_get_next_sibling(child)) {
        append_names(child, names);
    }
}

char *ui_names(viewer *v) {
    GString *names = g_string_new("");
    if (v->window != NULL) {
        append_names(GTK_WIDGET(v->window), names);
    }
    return g_string_free(names, FALSE);
}
