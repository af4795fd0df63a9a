/* SPDX-License-Identifier: Apache-2.0 */
#include "audit.h"

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

static bool has_name(GtkWidget *widget) {
    GtkAccessible *accessible = GTK_ACCESSIBLE(widget);
    const char *words = words_of(widget);
    if (gtk_test_accessible_has_property(accessible, GTK_ACCESSIBLE_PROPERTY_LABEL)) {
        return true;
    }
    return words != NULL
               ? has_letters(words)
               : gtk_test_accessible_has_relation(accessible, GTK_ACCESSIBLE_RELATION_LABELLED_BY);
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

static void complain(audit *a, GtkWidget *widget, const char *what, const char *more) {
    const char *words = words_of(widget);
    g_print("%s: %s %s '%s'%s%s\n", what, G_OBJECT_TYPE_NAME(widget), gtk_widget_get_name(widget),
            words != NULL ? words : "", more[0] != '\0' ? ": " : "", more);
    ++a->complaints;
}

static void look_at_control(audit *a, GtkWidget *widget) {
    ++a->controls;
    if (!has_name(widget)) {
        complain(a, widget, "no name", "");
    }
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
    if (is_control(widget)) {
        look_at_control(a, widget);
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
