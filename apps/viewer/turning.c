/* SPDX-License-Identifier: Apache-2.0 */
#include "turning.h"

static const double DEG_PER_PIXEL = 0.4, DEG_PER_KEY = 5.0;

typedef struct turned {
    const viewer_turning *turning;
    GtkWidget *widget;
    gpointer user;
    double az_deg, el_deg; /* as the drag began */
} turned;

static void on_drag_begin(GtkGestureDrag *drag, double x, double y, gpointer user) {
    turned *t = user;
    (void)drag, (void)x, (void)y;
    gtk_widget_grab_focus(t->widget);
    t->turning->look(t->widget, t->user, &t->az_deg, &t->el_deg);
}

static void on_drag(GtkGestureDrag *drag, double dx, double dy, gpointer user) {
    turned *t = user;
    (void)drag;
    t->turning->turn(t->widget, t->user, t->az_deg + t->turning->sense * DEG_PER_PIXEL * dx,
                     t->el_deg + DEG_PER_PIXEL * dy);
}

static gboolean on_key(GtkEventControllerKey *keys, guint key, guint code, GdkModifierType held,
                       gpointer user) {
    turned *t = user;
    (void)keys, (void)code;
    double right = (key == GDK_KEY_Right) - (key == GDK_KEY_Left);
    double up = (key == GDK_KEY_Up) - (key == GDK_KEY_Down);
    if ((held & gtk_accelerator_get_default_mod_mask()) != 0 || (right == 0.0 && up == 0.0)) {
        return FALSE;
    }
    double az, el;
    t->turning->look(t->widget, t->user, &az, &el);
    t->turning->turn(t->widget, t->user, az + t->turning->sense * DEG_PER_KEY * right,
                     el + DEG_PER_KEY * up);
    return TRUE;
}

void viewer_turning_add(GtkWidget *widget, const viewer_turning *turning, gpointer user) {
    turned *t = g_new0(turned, 1);
    *t = (turned){.turning = turning, .widget = widget, .user = user};
    g_object_set_data_full(G_OBJECT(widget), "turning", t, g_free);
    gtk_widget_set_focusable(widget, TRUE);
    gtk_widget_add_css_class(widget, "turns");
    GtkGesture *drag = gtk_gesture_drag_new();
    g_signal_connect(drag, "drag-begin", G_CALLBACK(on_drag_begin), t);
    g_signal_connect(drag, "drag-update", G_CALLBACK(on_drag), t);
    gtk_widget_add_controller(widget, GTK_EVENT_CONTROLLER(drag));
    GtkEventController *keys = gtk_event_controller_key_new();
    g_signal_connect(keys, "key-pressed", G_CALLBACK(on_key), t);
    gtk_widget_add_controller(widget, keys);
}
