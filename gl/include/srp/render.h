/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Pictures of a spacecraft in sunlight, drawn by OpenGL 3.3 core: materials in colours, shadows,
 * values on facets in the colours of a map, body axes, arrows.
 *
 * Shadows are not sampled. The lit part of each facet is the polygon that the exact method finds
 * (docs/theory.md, "First hit without sampling"), drawn over the dark facet: edges of shadows are
 * as sharp as those of the body, at any size.
 *
 * A renderer draws with whatever context is current into whatever framebuffer is bound, so that a
 * window's drawing area and a picture off screen look alike:
 *
 *     srp_renderer *renderer;
 *     status = srp_renderer_create(find, user, &renderer, &error);      context current
 *     status = srp_renderer_set_scene(renderer, scene, &error);         scene stays
 *     srp_render_view view = srp_render_view_default();
 *     view.width = 800, view.height = 600;
 *     view.camera = srp_render_camera_fit(scene, az, el, 800.0 / 600.0);
 *     view.sun = s_body;
 *     status = srp_renderer_draw(renderer, &view, &error);              for every picture
 *     srp_renderer_destroy(renderer);                                   context current
 *
 * State of OpenGL: nothing is expected but what a new context has for pixel unpacking and feedback;
 * everything that drawing needs is set. Left behind: the framebuffers that were bound; the viewport
 * of the view; no program, no vertex array, no texture in unit 0; no depth test, culling, blending,
 * scissor, polygon offset; whole colour and depth masks.
 *
 * One thread at a time. A renderer belongs to the context that it was created in: one that shares
 * objects with it is not enough.
 */
#ifndef SRP_RENDER_H
#define SRP_RENDER_H

#include <srp/scene.h>
#include <srp/status.h>
#include <srp/vec3.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

SRP_BEGIN_DECLS

/* sRGB, each share in [0, 1]; written to the framebuffer as it is. */
typedef struct srp_render_colour {
    float r, g, b;
} srp_render_colour;

/* ---- camera ---- */

/* Looks at `target` from the direction (az, el) of the body axes; the body's z axis points up. */
typedef struct srp_render_camera {
    double az, el;   /* [rad] of the eye as seen from the target; el in [-pi/2, pi/2] */
    double roll;     /* [rad] turns the picture clockwise */
    srp_vec3 target; /* [m] body frame: in the middle of the picture */
    double
        half_height; /* [m] > 0: from the middle of the picture to its upper edge, at the target */
    double field;    /* [rad] angle of the picture from below to above, in (0, 2.8]; 0: parallel
                        light, as the Sun sees it */
} srp_render_camera;

/* A parallel camera that shows the whole scene, from (az, el) [rad], in a picture that is `aspect`
 * times as wide as high (> 0), with a margin of 12 %. Any thread. */
SRP_API srp_render_camera srp_render_camera_fit(const srp_scene *scene, double az, double el,
                                                double aspect);

/* How far a mesh reaches from the body origin along a unit vector: the largest p . direction of its
 * vertices [m]. Arrows that end further out are seen. Any thread. */
SRP_API double srp_render_reach(const srp_scene *scene, srp_vec3 direction);

/* Axes of the picture in the body frame: unit vectors to its right, up, and to the eye. Moving the
 * target along the first two pans. Any thread. */
SRP_API void srp_render_camera_axes(const srp_render_camera *camera, srp_vec3 *right, srp_vec3 *up,
                                    srp_vec3 *eye);

/* Where the point p [m] (body frame) is drawn in a picture of width x height pixels: x to the right
 * and y downwards from the upper left corner [px]. False: behind the eye. Any thread. */
SRP_API bool srp_render_project(const srp_render_camera *camera, int width, int height, srp_vec3 p,
                                double *x, double *y);

/* ---- what is drawn ---- */

/* What colours the facets. */
typedef enum srp_render_colouring {
    SRP_RENDER_MATERIAL = 0,  /* each material has a colour */
    SRP_RENDER_INCIDENCE = 1, /* cosine of the angle between normal and Sun [-], 0 to 1 */
    SRP_RENDER_FORCE = 2,     /* length of the force of direct light on the facet, per lit area and
                                 pressure [-], 0 to 2 */
    SRP_RENDER_VALUES = 3     /* view.values */
} srp_render_colouring;

/* An arrow in the body frame. Parts behind the spacecraft shine through. */
typedef struct srp_render_arrow {
    srp_vec3 from, to; /* [m] body frame; nothing is drawn when they are the same */
    double width;      /* [px] of the shaft; 0: 1/160 of the picture's height */
    srp_render_colour colour;
    bool headless; /* a line */
} srp_render_arrow;

typedef struct srp_render_view {
    int x, y, width,
        height;  /* [px] viewport in the bound framebuffer, from its lower left corner */
    int samples; /* > 1: drawn into a framebuffer of the renderer's own with about so many samples
                    per pixel and copied; 0 or 1: straight into the bound one, which then needs a
                    depth buffer */
    srp_render_camera camera;
    srp_vec3 sun; /* unit vector to the Sun, body frame; unit to 1e-9 */
    bool shadows; /* false: all facets are bright */
    bool edges;   /* lines along edges, rims, and borders between materials */
    srp_render_colouring colouring;
    /* SRP_RENDER_MATERIAL: (material count of the scene); NULL: srp_render_material_colour(). */
    const srp_render_colour *material_colours;
    /* SRP_RENDER_VALUES: (facet count of the scene, order of srp_scene_face()); NAN is drawn grey.
     */
    const double *values;
    /* Which values have the first and the last colour of the map. Of SRP_RENDER_INCIDENCE and
     * SRP_RENDER_FORCE too; low < high. */
    double value_low, value_high;
    /* (map_count), from low to high, mixed between; needed by all but SRP_RENDER_MATERIAL. */
    const srp_render_colour *map;
    size_t map_count;
    srp_render_colour background;
    double axes;     /* [m] length of the body axes, x red, y green, z blue; 0: none */
    double sun_line; /* [m] length of the yellow line from the target to the Sun; 0: none */
    const srp_render_arrow *arrows;
    size_t arrow_count;
    /* For a picture that follows a hand: a scene of more than SRP_RENDER_COARSE_FACETS is drawn
     * simplified, without edges; with `shadows`, what turns away from the Sun is dark, but nothing
     * casts a shadow. Smaller scenes are drawn as ever. */
    bool coarse;
} srp_render_view;

enum { SRP_RENDER_COARSE_FACETS = 60000 };

/* 0 x 0 pixels, 4 samples, Sun along x, shadows, edges, colours of materials, values 0 to 1, white
 * background, neither axes nor Sun line nor arrows. */
SRP_API srp_render_view srp_render_view_default(void);

/* Colours that materials have unless told otherwise; those of 0 to 9 are told apart by all eyes
 * as well as ten colours can be, after that they repeat. Any thread. */
SRP_API srp_render_colour srp_render_material_colour(size_t index);

/* Colours of the body axes: of x, y, z for 0, 1, 2. Any thread. */
SRP_API srp_render_colour srp_render_axis_colour(int axis);

/* Values of facets as SRP_RENDER_INCIDENCE and SRP_RENDER_FORCE colour them, for a scale beside the
 * picture: values (facet count), of the side that faces the Sun, shadows left out of account; a
 * facet that turns its back has 0. `sun` as in the view. Any thread. */
SRP_API void srp_render_values(const srp_scene *scene, srp_vec3 sun, srp_render_colouring colouring,
                               double *values);

/* ---- the renderer ---- */

typedef struct srp_renderer srp_renderer;
typedef void (*srp_render_function)(void);
/* The function of OpenGL of this name; NULL: there is none. As eglGetProcAddress() is one. */
typedef srp_render_function (*srp_render_find)(void *user, const char *name);

/* The context is current, OpenGL 3.3 core or later. SRP_NO_DEVICE (too old, a function missing, the
 * driver does not compile our shaders), SRP_NO_MEMORY. */
SRP_API SRP_CHECK srp_status srp_renderer_create(srp_render_find find, void *user,
                                                 srp_renderer **out, srp_error *error);
/* The context is current. May be NULL. */
SRP_API void srp_renderer_destroy(srp_renderer *renderer);

/* Draws this scene from now on; it must stay until another is set or the renderer is destroyed.
 * NULL: nothing. On failure the renderer keeps what it had.
 * SRP_UNSUPPORTED (not a mesh), SRP_NO_MEMORY, SRP_NO_DEVICE. */
SRP_API SRP_CHECK srp_status srp_renderer_set_scene(srp_renderer *renderer, const srp_scene *scene,
                                                    srp_error *error);

/*
 * Where the light falls, found beforehand and on any thread: about a second for a million facets.
 * The scene must stay. Set, it serves all views with shadows whose Sun is exactly `sun`.
 *   go_on  asked now and then from the thread of the call; false ends it: SRP_CANCELLED. NULL: to
 *          the end.
 * SRP_UNSUPPORTED (not a mesh), SRP_BAD_ARGUMENT (not a unit vector), SRP_NO_MEMORY.
 */
typedef struct srp_render_light srp_render_light;
SRP_API SRP_CHECK srp_status srp_render_light_find(const srp_scene *scene, srp_vec3 sun,
                                                   bool (*go_on)(void *user), void *user,
                                                   srp_render_light **out, srp_error *error);
/* May be NULL. */
SRP_API void srp_render_light_destroy(srp_render_light *light);
/* Copies it. The context is current. SRP_BAD_ARGUMENT (of another scene), SRP_NO_MEMORY,
 * SRP_NO_DEVICE. */
SRP_API SRP_CHECK srp_status srp_renderer_set_light(srp_renderer *renderer,
                                                    const srp_render_light *light,
                                                    srp_error *error);

/* Finds where the light falls, a unit vector `sun`, for the views that come: what the first of them
 * would do. The context is current. Nothing to do without a scene. SRP_NO_MEMORY. */
SRP_API SRP_CHECK srp_status srp_renderer_find_light(srp_renderer *renderer, srp_vec3 sun,
                                                     srp_error *error);

/* Draws a picture. Where the light falls is found anew only when the Sun has moved since the last
 * time: a millisecond or so for a thousand facets, so that a Sun can be dragged.
 * SRP_BAD_ARGUMENT (a field out of its range; the message names it), SRP_NO_MEMORY, SRP_NO_DEVICE.
 */
SRP_API SRP_CHECK srp_status srp_renderer_draw(srp_renderer *renderer, const srp_render_view *view,
                                               srp_error *error);

/* ---- off screen ---- */

/*
 * Draws pictures of a scene without a window: makes a context on `device` ("gl:osmesa", "gl:egl",
 * "gl:egl:N" as in srp/gl.h), draws, and destroys it; none is current on the thread afterwards.
 *   views    (count); x and y are ignored
 *   pixels   (count), each (views[k].height, views[k].width, 4): rows from above, red, green, blue,
 *            and 255
 * Statuses of the functions above; SRP_NOT_FOUND (no device is called so), SRP_BAD_ARGUMENT (wider
 * or higher than the driver can draw). Any thread.
 */
SRP_API SRP_CHECK srp_status srp_render_offscreen(const char *device, const srp_scene *scene,
                                                  const srp_render_view *views, size_t count,
                                                  uint8_t *const *pixels, srp_error *error);

SRP_END_DECLS

#endif
