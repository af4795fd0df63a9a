/* SPDX-License-Identifier: Apache-2.0 */
/* The window: header, spacecraft, method, tabs, and below them a line for what there is to say. */
#include "actions.h"
#include "dropping.h"
#include "loading.h"
#include "opening.h"
#include "recent.h"
#include "state.h"
#include "style.h"
#include "ui.h"
#include "viewer.h"

typedef struct frame {
    viewer *v;
    GtkWidget *message, *bar, *buttons, *more, *whole, *busy;
} frame;

/* ---- header ---- */

static GMenuModel *main_menu(void) {
    static const struct {
        const char *label, *action;
    } items[] = {{"_Reload", "win.reload"},
                 {"_Save…", "win.choose-save"},
                 {"Open _Table…", "win.choose-table"},
                 {"_Forget All Tables", "win.clear-tables"},
                 {"_Copy as Command", "win.copy-command"},
                 {"_Dark Style", "win.dark"},
                 {"_About", "win.about"},
                 {"_Quit", "win.close"}};
    GMenu *menu = g_menu_new();
    for (size_t i = 0; i < G_N_ELEMENTS(items); ++i) {
        g_menu_append(menu, items[i].label, items[i].action);
    }
    return G_MENU_MODEL(menu);
}

static GtkWidget *menu_button(const char *label, GMenuModel *menu, const char *tip) {
    GtkWidget *button = ui_menu_button(label);
    gtk_menu_button_set_menu_model(GTK_MENU_BUTTON(button), menu);
    gtk_widget_set_tooltip_text(button, tip);
    return button;
}

static GtkWidget *make_header(frame *f) {
    GtkWidget *header = gtk_header_bar_new();
    GMenuModel *menu = main_menu();
    f->busy = ui_label("", "dim");
    gtk_widget_set_name(f->busy, "busy");
    gtk_header_bar_pack_start(GTK_HEADER_BAR(header),
                              ui_button("_Open…", "choose-model", "Open an OBJ file (Ctrl+O)"));
    gtk_header_bar_pack_start(
        GTK_HEADER_BAR(header),
        menu_button("_Recent", viewer_recent_menu(f->v), "Files that were open before"));
    GtkWidget *button = menu_button("Menu", menu, "Save, copy, style (F10)");
    gtk_menu_button_set_primary(GTK_MENU_BUTTON(button), TRUE);
    gtk_header_bar_pack_end(GTK_HEADER_BAR(header), button);
    gtk_header_bar_pack_end(GTK_HEADER_BAR(header), f->busy);
    g_object_unref(menu);
    return header;
}

/* ---- message ---- */

enum { MESSAGE_LINES = 2 };

/* So many lines that there is still room for the rest; all of them are behind "More". */
static void show_message(frame *f) {
    const char *end = f->v->message;
    for (int lines = 0; *end != '\0' && (*end != '\n' || ++lines < MESSAGE_LINES); ++end) {
    }
    char *head = g_strndup(f->v->message, (gsize)(end - f->v->message));
    char *text = g_strconcat(head, *end != '\0' ? " …" : "", NULL);
    gtk_label_set_text(GTK_LABEL(f->message), text);
    gtk_label_set_text(GTK_LABEL(f->whole), f->v->message);
    gtk_widget_set_visible(f->more, *end != '\0');
    bool any = f->v->message[0] != '\0';
    gtk_widget_set_visible(f->buttons, any);
    any ? gtk_widget_add_css_class(f->bar, "told") : gtk_widget_remove_css_class(f->bar, "told");
    g_free(text);
    g_free(head);
}

static void on_dismiss(GtkButton *button, gpointer user) {
    (void)button;
    viewer_dismiss(((frame *)user)->v);
}

static GtkWidget *message_label(const char *name) {
    GtkWidget *label = ui_paragraph(name, NULL, -1);
    gtk_label_set_wrap_mode(GTK_LABEL(label), PANGO_WRAP_WORD_CHAR);
    gtk_label_set_selectable(GTK_LABEL(label), TRUE);
    gtk_widget_set_can_focus(label, FALSE);
    return label;
}

/* Its line is there also while it is empty, so that nothing moves under the pointer. */
static GtkWidget *make_message(frame *f) {
    GtkWidget *box = ui_box(GTK_ORIENTATION_HORIZONTAL, 8);
    GtkWidget *dismiss = gtk_button_new_with_label("×");
    f->message = message_label("message");
    f->whole = message_label("whole-message");
    gtk_label_set_max_width_chars(GTK_LABEL(f->whole), 90);
    f->more = gtk_menu_button_new();
    gtk_menu_button_set_label(GTK_MENU_BUTTON(f->more), "More");
    gtk_menu_button_set_popover(GTK_MENU_BUTTON(f->more), ui_popover(f->whole, 420));
    gtk_widget_set_name(f->more, "more-message");
    ui_name(f->more, "The whole message");
    gtk_button_set_has_frame(GTK_BUTTON(dismiss), FALSE);
    gtk_widget_set_tooltip_text(dismiss, "Dismiss");
    ui_name(dismiss, "Dismiss");
    gtk_widget_set_valign(dismiss, GTK_ALIGN_START);
    g_signal_connect(dismiss, "clicked", G_CALLBACK(on_dismiss), f);
    gtk_box_append(GTK_BOX(box), f->message);
    /* A column has no baseline; with that of the button GTK miscounts the height of several lines.
     */
    GtkWidget *column = ui_box(GTK_ORIENTATION_VERTICAL, 0);
    GtkWidget *buttons = ui_box(GTK_ORIENTATION_HORIZONTAL, 8);
    gtk_box_append(GTK_BOX(buttons), f->more);
    gtk_box_append(GTK_BOX(buttons), dismiss);
    gtk_box_append(GTK_BOX(column), buttons);
    gtk_box_append(GTK_BOX(box), column);
    gtk_widget_add_css_class(box, "banner");
    gtk_widget_set_visible(buttons, FALSE);
    f->buttons = buttons;
    f->bar = box;
    return box;
}

/* ---- what changes ---- */

static void show_title(frame *f) {
    const char *path = f->v->session->setup->model;
    char *base = path != NULL ? g_path_get_basename(path) : NULL;
    char *valid = base != NULL ? g_utf8_make_valid(base, -1) : NULL;
    char *title =
        valid != NULL ? g_strdup_printf("%s — srp-viewer", valid) : g_strdup("srp-viewer");
    gtk_window_set_title(f->v->window, title);
    g_free(title);
    g_free(valid);
    g_free(base);
}

static void on_changed(void *pane, unsigned what) {
    frame *f = pane;
    if ((what & CHANGED_SETUP) != 0) {
        show_title(f);
    }
    if ((what & CHANGED_MESSAGE) != 0) {
        show_message(f);
        f->v->problem[0] != '\0' ? gtk_widget_add_css_class(f->bar, "problem")
                                 : gtk_widget_remove_css_class(f->bar, "problem");
    }
    if ((what & (CHANGED_BUSY | CHANGED_ENGINE | CHANGED_TABLES | CHANGED_ORBIT)) != 0) {
        bool busy = viewer_worker_is_busy(f->v->requests.live, SLOT_ENGINE) ||
                    viewer_worker_is_busy(f->v->requests.batch, SLOT_TABLE) ||
                    viewer_worker_is_busy(f->v->requests.batch, SLOT_FIT) ||
                    viewer_worker_is_busy(f->v->requests.batch, SLOT_ORBIT);
        gtk_label_set_text(GTK_LABEL(f->busy),
                           busy ? "Computing …"
                           : viewer_opening_is_running(f->v) || viewer_loading_is_running(f->v)
                               ? "Opening …"
                               : "");
    }
}

static gboolean on_close(GtkWindow *window, gpointer user) {
    frame *f = user;
    (void)window;
    if (f->v->remembers) {
        viewer_state_save(f->v);
    }
    f->v->window = NULL; /* nobody is told anything any more */
    return FALSE;
}

/* ---- together ---- */

static void add_tab(viewer *v, const char *label, GtkWidget *child) {
    GtkWidget *words = gtk_label_new_with_mnemonic(label);
    gtk_notebook_append_page(v->tabs, child, words);
    ui_name(gtk_widget_get_parent(words), gtk_label_get_text(GTK_LABEL(words)));
    g_object_set(gtk_notebook_get_page(v->tabs, child), "tab-expand", FALSE, NULL);
}

static void load_style(void) {
    GtkCssProvider *provider = gtk_css_provider_new();
    gtk_css_provider_load_from_data(provider, viewer_style.text, -1);
    gtk_style_context_add_provider_for_display(gdk_display_get_default(),
                                               GTK_STYLE_PROVIDER(provider),
                                               GTK_STYLE_PROVIDER_PRIORITY_APPLICATION);
    g_object_unref(provider);
}

void viewer_build_window(viewer *v) {
    frame *f = g_new0(frame, 1);
    f->v = v;
    load_style();
    v->window = GTK_WINDOW(gtk_application_window_new(v->application));
    gtk_window_set_default_size(v->window, 1280, 800);
    gtk_window_set_icon_name(v->window, "srp-viewer");
    g_object_set_data_full(G_OBJECT(v->window), "frame", f, g_free);
    viewer_actions_add(v);
    gtk_window_set_titlebar(v->window, make_header(f));
    v->tabs = GTK_NOTEBOOK(gtk_notebook_new());
    gtk_widget_set_vexpand(GTK_WIDGET(v->tabs), TRUE);
    GtkWidget *box = ui_box(GTK_ORIENTATION_VERTICAL, 0);
    gtk_box_append(GTK_BOX(box), viewer_spacecraft_pane(v));
    gtk_box_append(GTK_BOX(box), viewer_method_pane(v));
    gtk_box_append(GTK_BOX(box), GTK_WIDGET(v->tabs));
    gtk_box_append(GTK_BOX(box), make_message(f));
    add_tab(v, "_Visualize Spacecraft", viewer_scene_tab(v));
    add_tab(v, "Visualize _Graphics", viewer_table_tab(v));
    add_tab(v, "_Compare Graphics", viewer_compare_tab(v));
#ifdef SRP_CLI_HAS_ORBIT
    add_tab(v, "Orbi_t", viewer_orbit_tab(v));
#endif
    gtk_window_set_child(v->window, box);
    viewer_listen(v, on_changed, f);
    g_signal_connect(v->window, "close-request", G_CALLBACK(on_close), f);
    viewer_drop_begin(v);
}
