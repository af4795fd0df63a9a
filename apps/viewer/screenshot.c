/* SPDX-License-Identifier: Apache-2.0 */
#include "screenshot.h"

void viewer_screenshot(viewer *v, const char *path) {
    GdkPaintable *paintable = gtk_widget_paintable_new(GTK_WIDGET(v->window));
    GtkSnapshot *snapshot = gtk_snapshot_new();
    int width = gdk_paintable_get_intrinsic_width(paintable);
    int height = gdk_paintable_get_intrinsic_height(paintable);
    int scale =
        gtk_widget_get_scale_factor(GTK_WIDGET(v->window)); /* pixels of the screen to one */
    gtk_snapshot_scale(snapshot, (float)scale, (float)scale);
    gdk_paintable_snapshot(paintable, snapshot, width, height);
    GskRenderNode *node = gtk_snapshot_free_to_node(snapshot);
    GskRenderer *renderer = gtk_native_get_renderer(GTK_NATIVE(v->window));
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
    g_object_unref(paintable);
    if (!good) {
        char *words = g_strdup_printf("%s: the picture could not be written", path);
        viewer_complain(v, words);
        g_free(words);
    }
}
