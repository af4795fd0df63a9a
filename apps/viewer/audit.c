/* SPDX-License-Identifier: Apache-2.0 */
#include "audit.h"

#include "numbers.h"

#include <string.h>

/* The keys of one window or popover, each with the text that has it. */
typedef struct audit {
    GHashTable *keys;
    int controls, complaints;
} audit;

static bool is_control(GtkWidget *widget) {
    return GTK_IS_BUTTON(widget) || GTK_IS_MENU_BUTTON(widget) || GTK_IS_ENTRY(widget) ||
           GTK_IS_SPIN_BUTTON(widget) || GTK_IS_DROP_DOWN(widget) || GTK_IS_RANGE(widget) ||
           GTK_IS_CHECK_BUTTON(widget) || GTK_IS_GL_AREA(widget) || GTK_IS_PROGRESS_BAR(widget) ||
           gtk_widget_has_css_class(widget, "turns");
}

/* Made by GTK inside another control, a popover menu, or the frame of the window. */
static bool is_inner(GtkWidget *widget) {
    return GTK_IS_POPOVER_MENU(widget) || GTK_IS_WINDOW_CONTROLS(widget) ||
           GTK_IS_SCROLLBAR(widget);
}

static const char *words_of(GtkWidget *widget) {
    if (GTK_IS_MENU_BUTTON(widget)) {
        return gtk_menu_button_get_label(GTK_MENU_BUTTON(widget));
    }
    if (GTK_IS_CHECK_BUTTON(widget)) {
        return gtk_check_button_get_label(GTK_CHECK_BUTTON(widget));
    }
    return GTK_IS_BUTTON(widget) ? gtk_button_get_label(GTK_BUTTON(widget)) : NULL;
}

/* A sign like "×" is no name. */
static bool has_letters(const char *text) {
    for (; text != NULL && *text != '\0'; text = g_utf8_next_char(text)) {
        if (g_unichar_isalpha(g_utf8_get_char(text))) {
            return true;
        }
    }
    return false;
}

static void complain(audit *a, GtkWidget *widget, const char *what, const char *more) {
    const char *words = words_of(widget);
    g_print("%s: %s %s '%s'%s%s\n", what, G_OBJECT_TYPE_NAME(widget), gtk_widget_get_name(widget),
            words != NULL ? words : "", more[0] != '\0' ? ": " : "", more);
    ++a->complaints;
}

/* The name that the widget has itself, "(null)": none. GTK tells it only to those who guess wrong.
 */
static char *own_name(GtkWidget *widget) {
    return gtk_test_accessible_check_property(GTK_ACCESSIBLE(widget), GTK_ACCESSIBLE_PROPERTY_LABEL,
                                              "\001");
}

/* As screen readers hear it: from the widget itself, or from a label, not from both. */
static void look_at_name(audit *a, GtkWidget *widget) {
    GtkAccessible *accessible = GTK_ACCESSIBLE(widget);
    const char *words = words_of(widget);
    bool own = gtk_test_accessible_has_property(accessible, GTK_ACCESSIBLE_PROPERTY_LABEL);
    bool label = gtk_test_accessible_has_relation(accessible, GTK_ACCESSIBLE_RELATION_LABELLED_BY);
    char *name = own ? own_name(widget) : NULL;
    if (!own && !(label && (words == NULL || has_letters(words)))) {
        complain(a, widget, "no name", "");
    } else if (own && (!has_letters(name) || strcmp(name, "Tab") == 0)) { /* GTK's for all tabs */
        complain(a, widget, "no name", name);
    } else if (own && label) {
        complain(a, widget, "two names", name);
    } else if (own && words != NULL && strchr(words, '_') != NULL && strcmp(words, name) == 0) {
        complain(a, widget, "the mark of a key in the name", name);
    }
    g_free(name);
}

/* Itself or a part of it. */
static bool takes_focus(GtkWidget *widget) {
    bool takes = gtk_widget_get_focusable(widget) && gtk_widget_get_can_focus(widget);
    for (GtkWidget *child = gtk_widget_get_first_child(widget); child != NULL && !takes;
         child = gtk_widget_get_next_sibling(child)) {
        takes = takes_focus(child);
    }
    return takes;
}

/* What screen readers come by besides controls. */
static bool is_named(GtkWidget *widget) {
    return GTK_IS_DRAWING_AREA(widget) || strcmp(gtk_widget_get_css_name(widget), "tab") == 0;
}

/* A number says what it is. */
static void look_at_number(audit *a, GtkWidget *widget) {
    char *text = g_strstrip(g_strdup(gtk_label_get_text(GTK_LABEL(widget))));
    char *name = own_name(widget);
    double value;
    if (cli_read_number(text, &value) && strcmp(g_strstrip(name), text) == 0) {
        complain(a, widget, "a number of nothing", text);
    }
    g_free(name);
    g_free(text);
}

static void look_at_control(audit *a, GtkWidget *widget) {
    ++a->controls;
    look_at_name(a, widget);
    if (!GTK_IS_PROGRESS_BAR(widget) && !takes_focus(widget)) {
        complain(a, widget, "no keyboard", "");
    }
}

/* Of what is shown together: pages of tabs that are not shown have their own keys. */
static void look_at_key(audit *a, GtkWidget *widget) {
    guint key = GTK_IS_LABEL(widget) ? gtk_label_get_mnemonic_keyval(GTK_LABEL(widget))
                                     : GDK_KEY_VoidSymbol;
    if (key == GDK_KEY_VoidSymbol || key == 0) {
        return;
    }
    key = gdk_keyval_to_lower(key); /* as GTK takes it */
    const char *words = gtk_label_get_text(GTK_LABEL(widget));
    const char *other = g_hash_table_lookup(a->keys, GUINT_TO_POINTER(key));
    if (other != NULL) {
        complain(a, widget, "key twice", words);
        g_print("    %s\n", other);
    }
    g_hash_table_insert(a->keys, GUINT_TO_POINTER(key), (gpointer)words);
}

/* Within the window, and within what scrolls. */
static void look_at_place(audit *a, GtkWidget *widget) {
    for (GtkWidget *around = gtk_widget_get_parent(widget); around != NULL;
         around = gtk_widget_get_parent(around)) {
        graphene_rect_t place;
        bool bounds = GTK_IS_WINDOW(around) || GTK_IS_SCROLLED_WINDOW(around);
        if (bounds && gtk_widget_compute_bounds(widget, around, &place) &&
            (place.origin.x < 0.0f || place.origin.y < 0.0f ||
             place.origin.x + place.size.width > (float)gtk_widget_get_width(around) ||
             place.origin.y + place.size.height > (float)gtk_widget_get_height(around))) {
            complain(a, widget, "out of sight",
                     GTK_IS_LABEL(widget) ? gtk_label_get_text(GTK_LABEL(widget)) : "");
            return;
        }
    }
}

static void look_at_words(audit *a, GtkWidget *widget) {
    if (GTK_IS_LABEL(widget) &&
        pango_layout_is_ellipsized(gtk_label_get_layout(GTK_LABEL(widget)))) {
        complain(a, widget, "cut", gtk_label_get_text(GTK_LABEL(widget)));
    }
}

/* `shown`: the keys of what is below work now. */
static void look(audit *a, GtkWidget *widget, bool shown) {
    if (is_inner(widget)) {
        return;
    }
    bool child_shown = shown && gtk_widget_get_child_visible(widget) &&
                       gtk_widget_get_visible(widget) && !GTK_IS_POPOVER(widget);
    if (child_shown) {
        look_at_key(a, widget);
    }
    bool words = GTK_IS_LABEL(widget) && gtk_label_get_text(GTK_LABEL(widget))[0] != '\0';
    if (gtk_widget_get_mapped(widget) && (is_control(widget) || words)) {
        look_at_place(a, widget);
        look_at_words(a, widget);
    }
    if (GTK_IS_LABEL(widget)) {
        look_at_number(a, widget);
    }
    if (is_named(widget)) {
        look_at_name(a, widget);
    }
    if (is_control(widget)) {
        look_at_control(a, widget);
        if (GTK_IS_DROP_DOWN(widget)) {
            look_at_name(a, gtk_widget_get_first_child(widget));
        }
        if (!GTK_IS_MENU_BUTTON(widget) && !GTK_IS_BUTTON(widget)) {
            return; /* its parts are GTK's */
        }
    }
    for (GtkWidget *child = gtk_widget_get_first_child(widget); child != NULL;
         child = gtk_widget_get_next_sibling(child)) {
        bool inner_button = GTK_IS_MENU_BUTTON(widget) && !GTK_IS_POPOVER(child);
        if (inner_button) {
            for (GtkWidget *part = gtk_widget_get_first_child(child); part != NULL;
                 part = gtk_widget_get_next_sibling(part)) {
                look(a, part, child_shown);
            }
        } else {
            look(a, child, child_shown);
        }
    }
}

int viewer_audit(viewer *v) {
    audit a = {.keys = g_hash_table_new(NULL, NULL)};
    int width, height;
    GtkWidget *window = GTK_WIDGET(v->window);
    gtk_widget_measure(window, GTK_ORIENTATION_HORIZONTAL, -1, &width, NULL, NULL, NULL);
    gtk_widget_measure(window, GTK_ORIENTATION_VERTICAL, gtk_widget_get_allocated_width(window),
                       &height, NULL, NULL, NULL);
    g_print("least-width: %d\nleast-height: %d\n", width, height);
    look(&a, window, true);
    g_print("controls: %d\ncomplaints: %d\n", a.controls, a.complaints);
    g_hash_table_unref(a.keys);
    return a.complaints;
}
