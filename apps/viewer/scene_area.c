/* SPDX-License-Identifier: Apache-2.0 */
#include "scene_area.h"

#include "scene_light.h"
#include "scene_look.h"
#include "turning.h"
#include "ui.h"

#include <srp/table.h>

#include <gmodule.h>
#include <math.h>
#include <stdio.h>

typedef struct area {
    viewer *v;
    GtkWidget *gl, *marks, *trouble, *legend;
    GModule *library;
    srp_renderer *renderer;
    viewer_engine *drawn; /* whose mesh the renderer has */
    viewer_look look;
    /* A large spacecraft is drawn simplified until nothing has moved for a moment. */
    scene_light *light;
    bool moving, coarse; /* something moved just now; the picture that is shown is simplified */
    guint settle;        /* the moment's end; 0: none */
    guint early;         /* light that is found before the force is there; 0: none */
    guint frame;         /* a frame is about to be drawn that may show the force; 0: none */
    viewer_engine *lit;  /* whose light the renderer has, from there; NULL: none */
    srp_vec3 lit_sun;
} area;

enum { SETTLE_MS = 250 };
/* From so many facets on, the light is found while the force is computed, and both are drawn at
 * once, unless the force takes longer than this [s]. */
enum { EARLY_FACETS = 5000 };
static const double EARLY_SECONDS = 0.2;
/* What a frame waits for a force at most [s]. */
static const double FRAME_SECONDS = 0.05;

/* ---- OpenGL ---- */

/* The dispatcher of functions that both GLX and EGL contexts understand. */
static srp_render_function find_function(void *user, const char *name) {
    area *a = user;
    static const char *const finders[] = {"eglGetProcAddress", "glXGetProcAddressARB"};
    for (size_t i = 0; a->library != NULL && i < G_N_ELEMENTS(finders); ++i) {
        union {
            gpointer pointer;
            srp_render_function (*finder)(const char *);
        } symbol = {NULL};
        if (g_module_symbol(a->library, finders[i], &symbol.pointer) && symbol.pointer != NULL) {
            return symbol.finder(name);
        }
    }
    return NULL;
}

static void show_trouble(area *a, const char *text) {
    gtk_label_set_text(GTK_LABEL(a->trouble), text);
    gtk_widget_set_visible(a->trouble, text[0] != '\0');
}

static void show_no_picture(area *a, const char *reason) {
    char *text = g_strdup_printf(
        "No picture: it takes OpenGL 3.3.\n%s\n\nNumbers, tables and orbits go on without it.\n"
        "A newer graphics driver gives the picture, and so may LIBGL_ALWAYS_SOFTWARE=1 before "
        "srp-viewer, where Mesa is installed; srp picture draws into a file.",
        reason);
    show_trouble(a, text);
    g_free(text);
}

static void on_realize(GtkGLArea *gl, gpointer user) {
    area *a = user;
    srp_error error;
    gtk_gl_area_make_current(gl);
    GError *problem = gtk_gl_area_get_error(gl);
    if (problem != NULL) {
        show_no_picture(a, problem->message);
        return;
    }
    static const char *const libraries[] = {"libEGL.so.1", "libGL.so.1"};
    for (size_t i = 0; a->library == NULL && i < G_N_ELEMENTS(libraries); ++i) {
        a->library = g_module_open(libraries[i], G_MODULE_BIND_LAZY);
    }
    if (srp_renderer_create(find_function, a, &a->renderer, &error) != SRP_OK) {
        show_no_picture(a, error.message);
        a->renderer = NULL;
    }
}

/* GTK would write its own words over ours. */
static void on_map(GtkWidget *widget, gpointer user) {
    area *a = user;
    gtk_widget_set_visible(widget, a->renderer != NULL);
}

static void on_unrealize(GtkGLArea *gl, gpointer user) {
    area *a = user;
    gtk_gl_area_make_current(gl);
    if (gtk_gl_area_get_error(gl) == NULL) {
        srp_renderer_destroy(a->renderer);
    }
    a->renderer = NULL;
    g_clear_handle_id(&a->early, g_source_remove);
    g_clear_pointer(&a->drawn, viewer_engine_release);
    g_clear_pointer(&a->lit, viewer_engine_release);
}

/* Gives the renderer the mesh of the newest engine. */
static bool bring_scene(area *a) {
    viewer_engine *engine = a->v->session->engine;
    const srp_scene *scene = engine != NULL ? engine->mesh : NULL;
    srp_error error;
    if (engine == a->drawn) {
        return scene != NULL;
    }
    if (srp_renderer_set_scene(a->renderer, scene, &error) != SRP_OK) {
        show_trouble(a, error.message);
        return false;
    }
    viewer_engine_release(a->drawn);
    a->drawn = viewer_engine_reference(engine);
    g_clear_pointer(&a->lit, viewer_engine_release);
    return scene != NULL;
}

static bool is_large(const area *a) {
    const viewer_engine *engine = a->v->session->engine;
    return engine != NULL && engine->mesh != NULL &&
           srp_scene_facet_count(engine->mesh) > SRP_RENDER_COARSE_FACETS;
}

/* Gives the renderer the light of a large spacecraft; false: not found yet. */
static bool bring_light(area *a, srp_render_view *view) {
    const srp_render_light *found;
    srp_error error;
    srp_vec3 sun = view->sun;
    scene_light_ask(a->light, a->drawn, sun);
    scene_light_state state = scene_light_look(a->light, a->drawn, sun, &found);
    bool known = a->lit == a->drawn && a->lit_sun.x == sun.x && a->lit_sun.y == sun.y &&
                 a->lit_sun.z == sun.z;
    if (state == LIGHT_FOUND && !known) {
        known = srp_renderer_set_light(a->renderer, found, &error) == SRP_OK;
        g_clear_pointer(&a->lit, viewer_engine_release);
        a->lit = known ? viewer_engine_reference(a->drawn) : NULL;
        a->lit_sun = sun;
    }
    if (state != LIGHT_UNKNOWN && !known) {
        view->shadows = false;
        show_trouble(a, "There is no memory for shadows.");
    }
    return state != LIGHT_UNKNOWN;
}

static bool is_dark(void) {
    gboolean dark = FALSE;
    g_object_get(gtk_settings_get_default(), "gtk-application-prefer-dark-theme", &dark, NULL);
    return dark;
}

static srp_render_colour background(void) {
    return is_dark() ? (srp_render_colour){0.13f, 0.13f, 0.15f}
                     : (srp_render_colour){0.97f, 0.97f, 0.98f};
}

static void draw_scene(area *a) {
    viewer *v = a->v;
    srp_error error;
    int scale = gtk_widget_get_scale_factor(a->gl);
    int width = scale * gtk_widget_get_width(a->gl), height = scale * gtk_widget_get_height(a->gl);
    if (width <= 0 || height <= 0) {
        return;
    }
    viewer_look_make(v->session, v->camera.az_deg, v->camera.el_deg, v->camera.zoom, width, height,
                     &a->look);
    srp_render_view *view = &a->look.view;
    view->shadows = v->shadows;
    view->colouring = v->colouring;
    view->value_low = 0.0;
    view->value_high = v->colouring == SRP_RENDER_FORCE ? 2.0 : 1.0;
    view->background = background();
    a->coarse = is_large(a) && (a->moving || (view->shadows && !bring_light(a, view)));
    view->coarse = a->coarse;
    if (srp_renderer_draw(a->renderer, view, &error) != SRP_OK) {
        show_trouble(a, error.message);
    }
}

/* Nothing but the ground, where there is no spacecraft. */
static void draw_nothing(area *a) {
    srp_render_view view = srp_render_view_default();
    srp_error error;
    int scale = gtk_widget_get_scale_factor(a->gl);
    view.width = scale * gtk_widget_get_width(a->gl);
    view.height = scale * gtk_widget_get_height(a->gl);
    view.background = background();
    if (srp_renderer_draw(a->renderer, &view, &error) != SRP_OK) {
        show_trouble(a, error.message);
    }
}

static gboolean on_render(GtkGLArea *gl, GdkGLContext *context, gpointer user) {
    area *a = user;
    (void)gl, (void)context;
    a->coarse = false;
    if (a->renderer != NULL) {
        bring_scene(a) ? draw_scene(a) : draw_nothing(a);
    }
    if (!isnan(a->v->asked_at) && a->v->session->force_known) {
        viewer_session_add_latency(a->v->session, viewer_seconds() - a->v->asked_at);
        a->v->asked_at = NAN;
    }
    a->v->picture_is_old = a->coarse; /* the whole one is on its way */
    if (!is_large(a)) {
        g_clear_handle_id(&a->settle, g_source_remove); /* the newest is shown */
    }
    gtk_widget_queue_draw(a->marks);
    return TRUE;
}

/* ---- words and legend over the picture ---- */

static void put_word(area *a, cairo_t *cr, srp_vec3 at, const char *word, const double rgb[3]) {
    double x, y;
    int scale = gtk_widget_get_scale_factor(a->gl);
    if (!srp_render_project(&a->look.view.camera, a->look.view.width, a->look.view.height, at, &x,
                            &y)) {
        return;
    }
    cairo_set_source_rgb(cr, rgb[0], rgb[1], rgb[2]);
    cairo_move_to(cr, x / scale - 4.0, y / scale + 4.0);
    cairo_show_text(cr, word);
}

static void draw_axes_words(area *a, cairo_t *cr) {
    static const double red[3] = {0.8, 0.1, 0.1}, green[3] = {0.1, 0.55, 0.15},
                        blue[3] = {0.15, 0.3, 0.85}, gold[3] = {0.75, 0.55, 0.0};
    static const double light[4][3] = {
        {1.0, 0.45, 0.45}, {0.45, 0.85, 0.5}, {0.5, 0.65, 1.0}, {1.0, 0.85, 0.2}};
    bool dark = is_dark();
    double axes = 1.07 * a->look.view.axes;
    cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_BOLD);
    cairo_set_font_size(cr, 13.0);
    put_word(a, cr, srp_vec3_make(axes, 0.0, 0.0), "X", dark ? light[0] : red);
    put_word(a, cr, srp_vec3_make(0.0, axes, 0.0), "Y", dark ? light[1] : green);
    put_word(a, cr, srp_vec3_make(0.0, 0.0, axes), "Z", dark ? light[2] : blue);
    srp_vec3 sun = srp_vec3_add_scaled(a->look.view.camera.target, 1.08 * a->look.view.sun_line,
                                       a->look.view.sun);
    put_word(a, cr, sun, "Sun", dark ? light[3] : gold);
}

enum { BAR_STRIPS = 90 };

/* A bar of colours with numbers below its ends. */
static void draw_bar(GtkWidget *widget, cairo_t *cr, double y, const char *title, const char *low,
                     const char *high, const srp_render_colour colours[BAR_STRIPS]) {
    GdkRGBA ink;
    gtk_style_context_get_color(gtk_widget_get_style_context(widget), &ink);
    const double x = 14.0, width = 180.0;
    cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr, 11.5);
    gdk_cairo_set_source_rgba(cr, &ink);
    cairo_move_to(cr, x, y - 5.0);
    cairo_show_text(cr, title);
    for (int k = 0; k < BAR_STRIPS; ++k) {
        const srp_render_colour *c = &colours[k];
        cairo_set_source_rgb(cr, (double)c->r, (double)c->g, (double)c->b);
        cairo_rectangle(cr, x + 2.0 * k, y, 2.5, 10.0);
        cairo_fill(cr);
    }
    cairo_text_extents_t size;
    gdk_cairo_set_source_rgba(cr, &ink);
    cairo_move_to(cr, x, y + 23.0);
    cairo_show_text(cr, low);
    cairo_text_extents(cr, high, &size);
    cairo_move_to(cr, x + width - size.x_advance, y + 23.0);
    cairo_show_text(cr, high);
}

/* Of the facets, as they were drawn. */
static void map_colours(const viewer_look *look, srp_render_colour colours[BAR_STRIPS]) {
    for (int k = 0; k < BAR_STRIPS; ++k) {
        colours[k] = look->map[(int)((k + 0.5) / BAR_STRIPS * (LOOK_MAP_SIZE - 1))];
    }
}

static void arrow_colours(srp_render_colour colours[BAR_STRIPS]) {
    for (int k = 0; k < BAR_STRIPS; ++k) {
        float rgb[3];
        viewer_arrow_colour((k + 0.5) / BAR_STRIPS, rgb);
        colours[k] = (srp_render_colour){rgb[0], rgb[1], rgb[2]};
    }
}

static void draw_material_names(area *a, GtkWidget *widget, cairo_t *cr, int height) {
    const srp_scene *scene = a->drawn->mesh;
    GdkRGBA ink;
    gtk_style_context_get_color(gtk_widget_get_style_context(widget), &ink);
    size_t count = srp_scene_material_count(scene), most = (size_t)MAX(0, (height - 90) / 18);
    cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr, 11.5);
    for (size_t i = 0; i < count && i < most; ++i) {
        srp_render_colour colour = srp_render_material_colour(i);
        double y = 14.0 + 18.0 * (double)i;
        cairo_set_source_rgb(cr, (double)colour.r, (double)colour.g, (double)colour.b);
        cairo_rectangle(cr, 14.0, y, 12.0, 12.0);
        cairo_fill(cr);
        gdk_cairo_set_source_rgba(cr, &ink);
        cairo_move_to(cr, 32.0, y + 10.5);
        const char *name = srp_scene_material_name(scene, i);
        cairo_show_text(cr, i + 1 == most && i + 1 < count ? "…"
                            : name[0] != '\0'              ? name
                                                           : "(no name)");
    }
}

static void draw_coarse_note(GtkWidget *widget, cairo_t *cr, int width, int height) {
    const char *note = "Simplified while it moves; shadows follow";
    GdkRGBA ink;
    cairo_text_extents_t size;
    gtk_style_context_get_color(gtk_widget_get_style_context(widget), &ink);
    cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr, 11.5);
    gdk_cairo_set_source_rgba(cr, &ink);
    cairo_text_extents(cr, note, &size);
    cairo_move_to(cr, width - size.x_advance - 14.0, height - 14.0);
    cairo_show_text(cr, note);
}

static void draw_marks(GtkDrawingArea *widget, cairo_t *cr, int width, int height, gpointer user) {
    area *a = user;
    srp_render_colour colours[BAR_STRIPS];
    double least, largest;
    if (a->drawn == NULL || a->drawn->mesh == NULL) {
        return;
    }
    draw_axes_words(a, cr);
    if (a->coarse) {
        draw_coarse_note(GTK_WIDGET(widget), cr, width, height);
    }
    if (a->v->colouring == SRP_RENDER_MATERIAL) {
        draw_material_names(a, GTK_WIDGET(widget), cr, height);
    } else {
        map_colours(&a->look, colours);
        draw_bar(GTK_WIDGET(widget), cr, 24.0,
                 a->v->colouring == SRP_RENDER_FORCE ? "force per lit area and pressure"
                                                     : "cosine of the incidence",
                 "0", a->v->colouring == SRP_RENDER_FORCE ? "2" : "1", colours);
    }
    if (viewer_session_arrow_range(a->v->session, &least, &largest)) {
        char low[32], high[32];
        snprintf(low, sizeof low, "%.4g", least);
        snprintf(high, sizeof high, "%.4g m²", largest);
        arrow_colours(colours);
        draw_bar(GTK_WIDGET(widget), cr, height - 36.0, "|f| of the arrows", low, high, colours);
    }
}

/* ---- turning and scrolling ---- */

static void look_from(GtkWidget *widget, gpointer user, double *az_deg, double *el_deg) {
    const area *a = user;
    (void)widget;
    *az_deg = a->v->camera.az_deg;
    *el_deg = a->v->camera.el_deg;
}

static void turn_camera(GtkWidget *widget, gpointer user, double az_deg, double el_deg) {
    const area *a = user;
    (void)widget;
    viewer_set_camera(a->v, fmod(az_deg, 360.0), el_deg, a->v->camera.zoom);
}

static const viewer_turning CAMERA = {look_from, turn_camera, -1.0};

static gboolean on_scroll(GtkEventControllerScroll *scroll, double dx, double dy, gpointer user) {
    area *a = user;
    (void)scroll, (void)dx;
    const viewer_camera *camera = &a->v->camera;
    viewer_set_camera(a->v, camera->az_deg, camera->el_deg, camera->zoom * pow(1.12, -dy));
    return TRUE;
}

/* ---- together ---- */

static gboolean on_settled(gpointer user) {
    area *a = user;
    a->settle = 0;
    a->moving = false;
    gtk_gl_area_queue_render(GTK_GL_AREA(a->gl));
    return G_SOURCE_REMOVE;
}

static void on_light(void *user) {
    area *a = user;
    gtk_gl_area_queue_render(GTK_GL_AREA(a->gl));
}

/* What the picture with the new force will need. */
static gboolean find_light_early(gpointer user) {
    area *a = user;
    const viewer_session *s = a->v->session;
    srp_error error;
    double az, el;
    a->early = 0;
    viewer_attitude_sun(&s->attitude, &az, &el);
    gtk_gl_area_make_current(GTK_GL_AREA(a->gl));
    if (a->drawn == s->engine &&
        srp_renderer_find_light(a->renderer, srp_direction_from_deg(az, el), &error) != SRP_OK) {
        show_trouble(a, error.message);
    }
    return G_SOURCE_REMOVE;
}

/* Only the Sun has moved, and the force will soon be there. */
static bool waits_for_force(area *a, unsigned what) {
    const viewer_session *s = a->v->session;
    return what == CHANGED_SUN && a->v->shadows && !is_large(a) && s->engine == a->drawn &&
           a->drawn != NULL && a->drawn->mesh != NULL &&
           srp_scene_facet_count(a->drawn->mesh) > EARLY_FACETS &&
           viewer_force_is_quick(a->v, EARLY_SECONDS);
}

/* What the pointer does comes with a frame, and its force would be in the next one only, behind
 * the drawing of this one, which takes longest of all. */
static gboolean on_frame(GtkWidget *widget, GdkFrameClock *clock, gpointer user) {
    area *a = user;
    (void)widget, (void)clock;
    a->frame = 0;
    if (a->early != 0) {
        g_source_remove(a->early);
        find_light_early(a);
    }
    viewer_settle_force(a->v, FRAME_SECONDS);
    return G_SOURCE_REMOVE;
}

static void draw_soon(area *a, unsigned what) {
    a->v->picture_is_old = true;
    if (a->frame == 0 && what == CHANGED_SUN && viewer_force_is_quick(a->v, FRAME_SECONDS)) {
        a->frame = gtk_widget_add_tick_callback(a->gl, on_frame, a, NULL);
    }
    if (!waits_for_force(a, what)) {
        gtk_gl_area_queue_render(GTK_GL_AREA(a->gl));
        return;
    }
    if (a->early == 0) {
        a->early = g_idle_add_full(G_PRIORITY_HIGH_IDLE, find_light_early, a, NULL);
    }
    if (a->settle == 0) { /* should the force fail */
        a->settle = g_timeout_add(SETTLE_MS, on_settled, a);
    }
}

static void notice_move(area *a) {
    g_clear_handle_id(&a->settle, g_source_remove);
    a->moving = is_large(a);
    if (a->moving) {
        a->settle = g_timeout_add(SETTLE_MS, on_settled, a);
    }
}

static void on_changed(void *user, unsigned what) {
    area *a = user;
    if ((what & (CHANGED_ENGINE | CHANGED_SUN | CHANGED_FORCE | CHANGED_ARROWS | CHANGED_VIEW)) ==
        0) {
        return;
    }
    if ((what & (CHANGED_ENGINE | CHANGED_SUN | CHANGED_VIEW)) != 0) {
        notice_move(a);
    }
    if (gtk_widget_get_mapped(a->gl) && a->renderer != NULL) {
        draw_soon(a, what);
    } else {
        a->v->asked_at = NAN;
    }
}

static void on_unmap(GtkWidget *widget, gpointer user) {
    area *a = user;
    (void)widget;
    a->v->picture_is_old = false;
}

/* What GTK draws around the focus makes it forget the picture. */
static void on_state(GtkWidget *widget, GtkStateFlags before, gpointer user) {
    const GtkStateFlags focus = GTK_STATE_FLAG_FOCUSED | GTK_STATE_FLAG_FOCUS_VISIBLE;
    (void)user;
    if (((gtk_widget_get_state_flags(widget) ^ before) & focus) != 0) {
        gtk_gl_area_queue_render(GTK_GL_AREA(widget));
    }
}

static void free_area(gpointer user) {
    area *a = user;
    g_clear_handle_id(&a->settle, g_source_remove);
    g_clear_handle_id(&a->early, g_source_remove);
    scene_light_destroy(a->light);
    viewer_engine_release(a->drawn);
    viewer_engine_release(a->lit);
    if (a->library != NULL) {
        g_module_close(a->library);
    }
    g_free(a);
}

GtkWidget *viewer_scene_area(viewer *v) {
    area *a = g_new0(area, 1);
    a->v = v;
    a->light = scene_light_create(v->requests.shadows, on_light, a);
    a->gl = gtk_gl_area_new();
    gtk_gl_area_set_required_version(GTK_GL_AREA(a->gl), 3, 3);
    gtk_gl_area_set_auto_render(GTK_GL_AREA(a->gl), FALSE);
    gtk_widget_set_name(a->gl, "scene");
    ui_name(a->gl, "Picture of the spacecraft; arrow keys turn the camera");
    g_signal_connect(a->gl, "realize", G_CALLBACK(on_realize), a);
    g_signal_connect(a->gl, "unrealize", G_CALLBACK(on_unrealize), a);
    g_signal_connect_after(a->gl, "map", G_CALLBACK(on_map), a);
    g_signal_connect(a->gl, "render", G_CALLBACK(on_render), a);
    g_signal_connect(a->gl, "state-flags-changed", G_CALLBACK(on_state), a);
    g_signal_connect(a->gl, "unmap", G_CALLBACK(on_unmap), a);
    viewer_turning_add(a->gl, &CAMERA, a);
    GtkEventController *scroll =
        gtk_event_controller_scroll_new(GTK_EVENT_CONTROLLER_SCROLL_VERTICAL);
    g_signal_connect(scroll, "scroll", G_CALLBACK(on_scroll), a);
    gtk_widget_add_controller(a->gl, scroll);
    a->marks = gtk_drawing_area_new();
    ui_name(a->marks, "Axes, arrows and scale of the picture");
    gtk_widget_set_can_target(a->marks, FALSE);
    gtk_drawing_area_set_draw_func(GTK_DRAWING_AREA(a->marks), draw_marks, a, NULL);
    a->trouble = ui_label("", "dim");
    gtk_widget_set_name(a->trouble, "trouble");
    gtk_label_set_wrap(GTK_LABEL(a->trouble), TRUE);
    gtk_label_set_width_chars(GTK_LABEL(a->trouble), 44);
    gtk_label_set_max_width_chars(GTK_LABEL(a->trouble), 44);
    gtk_label_set_justify(GTK_LABEL(a->trouble), GTK_JUSTIFY_CENTER);
    gtk_widget_set_halign(a->trouble, GTK_ALIGN_CENTER);
    gtk_widget_set_visible(a->trouble, FALSE);
    GtkWidget *overlay = gtk_overlay_new();
    gtk_widget_set_name(overlay, "scene-picture");
    gtk_widget_set_size_request(overlay, 320, 170);
    gtk_overlay_set_child(GTK_OVERLAY(overlay), a->gl);
    gtk_overlay_add_overlay(GTK_OVERLAY(overlay), a->marks);
    gtk_overlay_add_overlay(GTK_OVERLAY(overlay), a->trouble);
    g_object_set_data_full(G_OBJECT(overlay), "area", a, free_area);
    viewer_listen(v, on_changed, a);
    return overlay;
}
