/* SPDX-License-Identifier: Apache-2.0 */
#include "wrap.h"

enum { LINE_SPACING = 4 };

typedef struct ViewerWrap {
    GtkLayoutManager parent;
    int spacing;
    bool titled;
} ViewerWrap;

typedef struct ViewerWrapClass {
    GtkLayoutManagerClass parent;
} ViewerWrapClass;

static GType viewer_wrap_get_type(void);
G_DEFINE_TYPE(ViewerWrap, viewer_wrap, GTK_TYPE_LAYOUT_MANAGER)

static GtkWidget *shown_from(GtkWidget *child) {
    while (child != NULL && !gtk_widget_should_layout(child)) {
        child = gtk_widget_get_next_sibling(child);
    }
    return child;
}

static GtkWidget *shown_after(GtkWidget *child) {
    return shown_from(gtk_widget_get_next_sibling(child));
}

/* ---- a line ---- */

typedef struct line {
    GtkWidget *first;
    int count, expanding, least; /* `least`: its width, spaces too */
    GtkRequestedSize *width;     /* (count) */
} line;

static GtkRequestedSize width_of(GtkWidget *child) {
    GtkRequestedSize size = {.data = child};
    gtk_widget_measure(child, GTK_ORIENTATION_HORIZONTAL, -1, &size.minimum_size,
                       &size.natural_size, NULL, NULL);
    return size;
}

/* Those from `first` on that fit `room` by their least widths; one at least. */
static line take_line(GtkWidget *first, int spacing, int room) {
    line l = {.first = first, .least = -spacing};
    for (GtkWidget *child = first; child != NULL; child = shown_after(child)) {
        int least = width_of(child).minimum_size;
        if (l.count > 0 && l.least + spacing + least > room) {
            break;
        }
        l.least += spacing + least;
        l.expanding += gtk_widget_compute_expand(child, GTK_ORIENTATION_HORIZONTAL);
        ++l.count;
    }
    return l;
}

/* Each child's width is its `minimum_size` then. */
static void share_room(line *l, int room) {
    l->width = g_new(GtkRequestedSize, (gsize)l->count);
    GtkWidget *child = l->first;
    for (int i = 0; i < l->count; ++i) {
        l->width[i] = width_of(child);
        child = shown_after(child);
    }
    int left =
        gtk_distribute_natural_allocation(MAX(0, room - l->least), (guint)l->count, l->width);
    for (int i = 0, expanding = l->expanding; i < l->count && expanding > 0; ++i) {
        if (gtk_widget_compute_expand(l->width[i].data, GTK_ORIENTATION_HORIZONTAL)) {
            int share = left / expanding--;
            l->width[i].minimum_size += share;
            left -= share;
        }
    }
}

static int height_of(const line *l) {
    int height = 0;
    for (int i = 0; i < l->count; ++i) {
        int least;
        gtk_widget_measure(l->width[i].data, GTK_ORIENTATION_VERTICAL, l->width[i].minimum_size,
                           &least, NULL, NULL, NULL);
        height = MAX(height, least);
    }
    return height;
}

/* ---- all lines ---- */

/* Of further lines. */
static int indent_of(const ViewerWrap *wrap, GtkWidget *widget) {
    GtkWidget *title = shown_from(gtk_widget_get_first_child(widget));
    return wrap->titled && title != NULL ? width_of(title).natural_size + wrap->spacing : 0;
}

/* Lays out lines `width` wide, or tells only how high they are together. */
static int go_through(const ViewerWrap *wrap, GtkWidget *widget, int width, bool place) {
    bool mirrored = gtk_widget_get_direction(widget) == GTK_TEXT_DIR_RTL;
    GtkWidget *child = shown_from(gtk_widget_get_first_child(widget));
    int y = 0, indent = 0;
    while (child != NULL) {
        line l = take_line(child, wrap->spacing, width - indent);
        share_room(&l, width - indent);
        int height = height_of(&l), x = indent;
        for (int i = 0; i < l.count; ++i) {
            int wide = l.width[i].minimum_size;
            GtkAllocation place_of = {mirrored ? width - x - wide : x, y, wide, height};
            if (place) {
                gtk_widget_size_allocate(l.width[i].data, &place_of, -1);
            }
            x += wide + wrap->spacing;
            child = shown_after(l.width[i].data);
        }
        indent = indent_of(wrap, widget);
        y += height + LINE_SPACING;
        g_free(l.width);
    }
    return MAX(0, y - LINE_SPACING);
}

static GtkSizeRequestMode request_mode(GtkLayoutManager *manager, GtkWidget *widget) {
    (void)manager, (void)widget;
    return GTK_SIZE_REQUEST_HEIGHT_FOR_WIDTH;
}

static void measure_widths(const ViewerWrap *wrap, GtkWidget *widget, int *least, int *natural) {
    GtkWidget *child = shown_from(gtk_widget_get_first_child(widget));
    int indent = indent_of(wrap, widget);
    *least = 0;
    *natural = child != NULL ? -wrap->spacing : 0;
    for (; child != NULL; child = shown_after(child)) {
        GtkRequestedSize size = width_of(child);
        *least = MAX(*least, indent + size.minimum_size);
        *natural += wrap->spacing + size.natural_size;
    }
}

static void measure(GtkLayoutManager *manager, GtkWidget *widget, GtkOrientation orientation,
                    int for_size, int *least, int *natural, int *least_baseline,
                    int *natural_baseline) {
    const ViewerWrap *wrap = (const ViewerWrap *)manager;
    *least_baseline = *natural_baseline = -1;
    if (orientation == GTK_ORIENTATION_HORIZONTAL) {
        measure_widths(wrap, widget, least, natural);
    } else {
        *least = *natural = go_through(wrap, widget, for_size < 0 ? G_MAXINT16 : for_size, false);
    }
}

static void allocate(GtkLayoutManager *manager, GtkWidget *widget, int width, int height,
                     int baseline) {
    (void)height, (void)baseline;
    go_through((const ViewerWrap *)manager, widget, width, true);
}

static void viewer_wrap_init(ViewerWrap *wrap) {
    (void)wrap;
}

static void viewer_wrap_class_init(ViewerWrapClass *class) {
    class->parent.get_request_mode = request_mode;
    class->parent.measure = measure;
    class->parent.allocate = allocate;
}

GtkLayoutManager *viewer_wrap_new(int spacing, bool titled) {
    ViewerWrap *wrap = g_object_new(viewer_wrap_get_type(), NULL);
    wrap->spacing = spacing;
    wrap->titled = titled;
    return GTK_LAYOUT_MANAGER(wrap);
}
