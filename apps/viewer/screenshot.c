/* SPDX-License-Identifier: Apache-2.0 */
#include "screenshot.h"

/* Writes what `snapshot`, which is used up, has of an area from the origin on; `scale` pixels of
 * the screen to one. */
static bool write_png(GtkWidget *window, GtkSnapshot *snapshot, int width, int height, int scale,
                      const char *path) {
    GskRenderNode *node = gtk_snapshot_free_to_node(snapshot);
    GskRenderer *renderer = gtk_native_get_renderer(GTK_NATIVE(window));
    bool good = false;
    if (node != NULL && renderer != NULL) {
        graphene_rect_t area =
            GRAPHENE_RECT_INIT(0.0f, 0.0f, (float)(scale * width), (float)(scale * height));
        GdkTexture *texture = gsk_renderer_render_texture(renderer, node, &area);
        good = gdk_texture_save_to_png(texture, path);
        g_object_unref(texture);
    }
    if (node != NULL) {
        gsk_render_node_unref(node);
    }
    return good;
}

static GtkSnapshot *scaled_snapshot(int scale) {
    GtkSnapshot *snapshot = gtk_snapshot_new();
    gtk_snapshot_scale(snapshot, (float)scale, (float)scale);
    return snapshot;
}

static char *not_written(const char *path) {
    return g_strdup_printf("%s: the picture could not be written", path);
}

/* What has just changed takes its place now: GTK draws nothing that has none. */
static void arrange(GtkWidget *window) {
    int least;
    gtk_widget_measure(window, GTK_ORIENTATION_HORIZONTAL, -1, &least, NULL, NULL, NULL);
    gtk_widget_allocate(window, gtk_widget_get_allocated_width(window),
                        gtk_widget_get_allocated_height(window), -1, NULL);
}

bool viewer_picture_save(GtkWidget *widget, const char *path, viewer_words *problem) {
    GtkWidget *window = GTK_WIDGET(gtk_widget_get_root(widget));
    GtkWidget *parent = gtk_widget_get_parent(widget);
    int scale = gtk_widget_get_scale_factor(widget);
    graphene_rect_t at;
    GtkSnapshot *snapshot = scaled_snapshot(scale);
    arrange(window);
    if (gtk_widget_compute_bounds(widget, parent, &at)) {
        gtk_snapshot_translate(snapshot, &GRAPHENE_POINT_INIT(-at.origin.x, -at.origin.y));
        gtk_widget_snapshot_child(parent, widget, snapshot);
    }
    bool good = write_png(window, snapshot, gtk_widget_get_width(widget),
                          gtk_widget_get_height(widget), scale, path);
    if (!good) {
        char *words = not_written(path);
        viewer_words_add(problem, words);
        g_free(words);
    }
    return good;
}

void viewer_screenshot(viewer *v, const char *path) {
    GtkWidget *window = GTK_WIDGET(v->window);
    GdkPaintable *paintable = gtk_widget_paintable_new(window);
    int width = gdk_paintable_get_intrinsic_width(paintable);
    int height = gdk_paintable_get_intrinsic_height(paintable);
    int scale = gtk_widget_get_scale_factor(window);
    GtkSnapshot *snapshot = scaled_snapshot(scale);
    gdk_paintable_snapshot(paintable, snapshot, width, height);
    bool good = write_png(window, snapshot, width, height, scale, path);
    g_object_unref(paintable);
    if (!good) {
        char *words = not_written(path);
        viewer_complain(v, words);
        g_free(words);
    }
}
