/* SPDX-License-Identifier: Apache-2.0 */
/* Pictures: every pixel that the Sun sees is lit and their area is the lit area, shadows end where
 * geometry says, colours are those of the map, the camera, refusals. */
#include "context.h"
#include "gl_fixture.h"
#include "model_files.h"
#include "prepared.h"
#include "shapes.h"
#include "srp_check.h"

#include <srp/const.h>
#include <srp/render.h>
#include <srp/table.h>

#include <stdlib.h>
#include <string.h>

enum { SIDE = 320 };

static const srp_optics OPTICS = {0.37, 0.21, false};
static const srp_render_colour MAP[2] = {{0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}};

/* A square picture from (az, el) in degrees with the Sun at `sun`, without edges and soft pixels,
 * whose lit parts are red: facets have the value 1 and the map ends in red. */
static srp_render_view red_view(const srp_scene *scene, double az, double el, srp_vec3 sun,
                                double *ones) {
    srp_render_view view = srp_render_view_default();
    for (size_t i = 0; i < srp_scene_facet_count(scene); ++i) {
        ones[i] = 1.0;
    }
    view.width = view.height = SIDE;
    view.samples = 1;
    view.edges = false;
    view.camera = srp_render_camera_fit(scene, az * SRP_RAD_PER_DEG, el * SRP_RAD_PER_DEG, 1.0);
    view.sun = sun;
    view.colouring = SRP_RENDER_VALUES;
    view.values = ones;
    view.map = MAP;
    view.map_count = 2;
    view.background = (srp_render_colour){0.0F, 0.0F, 1.0F};
    return view;
}

typedef struct counts {
    size_t lit, dark, background;
} counts;

static void draw(const srp_scene *scene, const srp_render_view *view, uint8_t *pixels) {
    srp_error error;
    assert_ok(srp_render_offscreen(gl_device_name, scene, view, 1, &pixels, &error), error);
}

static counts count(const uint8_t *pixels, size_t size) {
    counts all = {0, 0, 0};
    for (size_t k = 0; k < size; ++k) {
        const uint8_t *p = pixels + 4 * k;
        ck_assert_uint_eq(p[3], 255);
        if (p[2] == 255 && p[0] == 0) {
            all.background++;
        } else if (p[0] == 255 && p[1] == 0) {
            all.lit++;
        } else {
            ck_assert_msg(p[0] == p[1] && p[1] == p[2], "pixel %zu: %u %u %u", k, p[0], p[1], p[2]);
            all.dark++;
        }
    }
    return all;
}

static counts draw_and_count(const srp_scene *scene, const srp_render_view *view) {
    uint8_t *pixels = malloc(4 * SIDE * SIDE);
    draw(scene, view, pixels);
    counts all = count(pixels, SIDE * SIDE);
    free(pixels);
    return all;
}

/* ---- light ---- */

/* What the Sun sees is lit, all of it: no acne, no gaps. Its area is that of the exact method to
 * within half a pixel along the outline. */
START_TEST(the_sun_sees_no_shadow) {
    const char *name = MODEL_NAMES[_i];
    model_file model = model_read(name);
    srp_scene *scene = model_scene(&model);
    srp_prepared *prepared = prepare_on(&srp_method_exact, scene);
    double *ones = malloc(srp_scene_facet_count(scene) * sizeof *ones);
    uint64_t state = 20261124;
    for (int k = 0; k < 3; ++k) {
        double az = 360.0 * random_unit(&state) - 180.0, el = 160.0 * random_unit(&state) - 80.0;
        srp_vec3 sun = srp_direction_from_deg(az, el);
        srp_render_view view = red_view(scene, az, el, sun, ones);
        counts all = draw_and_count(scene, &view);
        double pixel = 2.0 * view.camera.half_height / SIDE;
        double area = (double)(all.lit + all.dark) * pixel * pixel;
        double want = respond_to(prepared, sun).lit_area;
        /* OpenGL places corners to 1/256 of a pixel: on an outline, a dark facet that turns away
         * may show. Of twenty directions for each model, the worst had five such pixels. */
        ck_assert_msg(all.dark <= 8, "%s from %.1f, %.1f: %zu of %zu pixels are dark", name, az, el,
                      all.dark, all.lit);
        assert_close(area, want, 0.015, 4.0 * pixel * pixel);
    }
    free(ones);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

/* A plate that floats over a larger one: its shadow is where the light's way through its corners
 * meets the ground, seen from straight above. */
START_TEST(shadows_end_where_they_should) {
    const double height = 0.731, x0 = -0.2173, x1 = 0.3319, y0 = -0.1127, y1 = 0.4241;
    const double slant_x = 0.613, slant_y = -0.377; /* of the light, per height */
    srp_mesh *mesh = shape_box(srp_vec3_make(-2, -2, -0.1), srp_vec3_make(2, 2, 0), "ground");
    shape_join(mesh, shape_box(srp_vec3_make(x0, y0, height), srp_vec3_make(x1, y1, height + 1e-4),
                               "roof"));
    srp_scene *scene = shape_scene(mesh, OPTICS);
    srp_vec3 sun = srp_vec3_make(slant_x, slant_y, 1.0);
    sun = srp_vec3_scale(1.0 / srp_vec3_norm(sun), sun);
    double ones[24];
    srp_render_view view = red_view(scene, 0.0, 90.0, sun, ones);
    uint8_t *pixels = malloc(4 * SIDE * SIDE);
    draw(scene, &view, pixels);
    int checked = 0;
    for (double x = -1.5; x < 1.5; x += 0.0173) {
        for (double y = -1.5; y < 1.5; y += 0.0171) {
            double px, py, margin = 2.0 * view.camera.half_height / SIDE;
            ck_assert(
                srp_render_project(&view.camera, SIDE, SIDE, srp_vec3_make(x, y, 0), &px, &py));
            double u = x + height * slant_x, v = y + height * slant_y; /* where the ray passes */
            double in = fmin(fmin(u - x0, x1 - u), fmin(v - y0, y1 - v));
            double under = fmin(fmin(x - x0, x1 - x), fmin(y - y0, y1 - y));
            if (fabs(in) < margin || under > -margin) {
                continue;
            }
            const uint8_t *p = pixels + 4 * ((size_t)py * SIDE + (size_t)px);
            bool lit = p[0] == 255 && p[1] == 0;
            ck_assert_msg(lit == (in < 0.0), "at %g, %g: lit %d", x, y, lit);
            checked += in > 0.0;
        }
    }
    ck_assert_int_gt(checked, 500);
    /* The bottom of the ground sees nothing of the Sun, and without shadows all is bright. */
    view.camera.el = -view.camera.el;
    counts below = draw_and_count(scene, &view);
    ck_assert_uint_eq(below.lit, 0);
    ck_assert_uint_gt(below.dark, SIDE * SIDE / 2);
    view.shadows = false;
    counts bright = draw_and_count(scene, &view);
    ck_assert_uint_eq(bright.dark, 0);
    ck_assert_uint_eq(bright.lit, below.dark);
    free(pixels);
    srp_scene_destroy(scene);
}
END_TEST

/* An open sheet is lit on one side, whichever that is, and dark on the other. */
START_TEST(sheets_have_two_sides) {
    const srp_vec3 v[] = {{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}};
    const srp_triangle t[] = {{{0, 1, 2}}, {{0, 2, 3}}};
    srp_scene *scene = shape_scene(shape_mesh(v, 4, t, 2, "sheet"), OPTICS);
    double ones[2];
    for (int side = -1; side <= 1; side += 2) {
        srp_vec3 sun = srp_vec3_make(side * 0.8, 0.36, 0.48);
        srp_render_view view = red_view(scene, 10.0, 20.0, sun, ones);
        counts all = draw_and_count(scene, &view);
        ck_assert_uint_eq(side > 0 ? all.dark : all.lit, 0);
        ck_assert_uint_gt(side > 0 ? all.lit : all.dark, SIDE * SIDE / 4);
    }
    srp_scene_destroy(scene);
}
END_TEST

/* ---- colours ---- */

/* The colour in the middle of the face of a box that looks along x. */
static void middle_colour(const srp_scene *scene, const srp_render_view *view, uint8_t rgb[3]) {
    uint8_t *pixels = malloc(4 * SIDE * SIDE);
    draw(scene, view, pixels);
    memcpy(rgb, pixels + 4 * ((SIDE / 2) * SIDE + SIDE / 2), 3);
    free(pixels);
}

START_TEST(colours_are_those_of_the_map) {
    static const srp_render_colour map[3] = {
        {0.0F, 0.0F, 1.0F}, {0.0F, 1.0F, 0.0F}, {1.0F, 0.0F, 0.0F}};
    srp_scene *scene =
        shape_scene(shape_box(srp_vec3_make(-1, -1, -1), srp_vec3_make(1, 1, 1), "a"), OPTICS);
    double values[12], shown[12];
    const double c = 0.8;
    srp_render_view view = red_view(scene, 0, 0, srp_vec3_make(c, 0.36, 0.48), values);
    uint8_t rgb[3];
    view.map = map;
    view.map_count = 3;
    view.value_low = -1.0;
    view.value_high = 3.0;
    for (int k = 0; k < 12; ++k) {
        values[k] = 2.0; /* three quarters of the way: half green, half red */
    }
    middle_colour(scene, &view, rgb);
    ck_assert_int_le(abs(rgb[0] - 128) + abs(rgb[1] - 128) + rgb[2], 2);
    for (int k = 0; k < 12; ++k) {
        values[k] = NAN;
    }
    middle_colour(scene, &view, rgb);
    ck_assert(rgb[0] == rgb[1] && rgb[1] == rgb[2] && rgb[0] > 140 && rgb[0] < 180);
    /* The cosine of a face along x, on a scale of 0 to 1 in two steps. */
    view.colouring = SRP_RENDER_INCIDENCE;
    view.value_low = 0.0;
    view.value_high = 1.0;
    middle_colour(scene, &view, rgb);
    double t = 2.0 * c - 1.0;
    ck_assert_int_le(abs(rgb[0] - (int)lround(255 * t)) + abs(rgb[1] - (int)lround(255 * (1 - t))),
                     2);
    /* The force on it, by hand: AAS 20-481, Eq. 2. */
    srp_vec3 n = {1, 0, 0}, f = srp_vec3_scale(1.0 - OPTICS.rho_s, view.sun);
    f = srp_vec3_add_scaled(f, 2.0 * (OPTICS.rho_s * c + OPTICS.rho_d / 3.0), n);
    srp_render_values(scene, view.sun, SRP_RENDER_FORCE, shown);
    srp_render_values(scene, view.sun, SRP_RENDER_INCIDENCE, values);
    double most = 0.0;
    for (size_t k = 0; k < 12; ++k) {
        srp_face face = srp_scene_face(scene, k);
        double cosine = srp_vec3_dot(face.normal, view.sun);
        assert_close(values[k], fmax(cosine, 0.0), 1e-15, 0.0);
        most = fmax(most, face.normal.x > 0.9 ? shown[k] : 0.0);
    }
    assert_close(most, c * srp_vec3_norm(f), 1e-14, 0.0);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(materials_have_their_colours) {
    const srp_render_colour blue[1] = {{0.0F, 0.2F, 1.0F}};
    srp_scene *scene =
        shape_scene(shape_box(srp_vec3_make(-1, -1, -1), srp_vec3_make(1, 1, 1), "a"), OPTICS);
    double ones[12];
    srp_render_view view = red_view(scene, 0, 0, srp_vec3_make(1, 0, 0), ones);
    uint8_t rgb[3];
    view.colouring = SRP_RENDER_MATERIAL;
    middle_colour(scene, &view, rgb);
    srp_render_colour usual = srp_render_material_colour(0);
    ck_assert_int_le(abs(rgb[0] - (int)lroundf(255 * usual.r)), 1);
    ck_assert_int_le(abs(rgb[1] - (int)lroundf(255 * usual.g)), 1);
    view.material_colours = blue;
    middle_colour(scene, &view, rgb);
    ck_assert_int_le(abs(rgb[2] - 255) + rgb[0] + abs(rgb[1] - 51), 2);
    /* In the shadow it is darker than half. */
    view.sun = srp_vec3_make(-1, 0, 0);
    middle_colour(scene, &view, rgb);
    ck_assert_int_lt(rgb[2], 128);
    srp_scene_destroy(scene);
}
END_TEST

/* ---- camera and marks ---- */

START_TEST(points_are_drawn_where_they_are_projected) {
    srp_scene *scene =
        shape_scene(shape_box(srp_vec3_make(-1, -1, -1), srp_vec3_make(1, 1, 1), "a"), OPTICS);
    double ones[12];
    srp_render_view view = red_view(scene, 37.0, -21.0, srp_vec3_make(0.6, 0, 0.8), ones);
    uint8_t *pixels = malloc(4 * SIDE * SIDE);
    for (int perspective = 0; perspective <= 1; ++perspective) {
        srp_vec3 right, up, eye;
        double x, y;
        view.camera.field = perspective * 0.7;
        view.camera.roll = 0.3;
        view.camera.half_height = 4.3;
        srp_render_camera_axes(&view.camera, &right, &up, &eye);
        assert_close(srp_vec3_dot(srp_vec3_cross(right, up), eye), 1.0, 1e-14, 0.0);
        /* A short thick line away from the box: its pixel is green. */
        srp_vec3 p = srp_vec3_add_scaled(srp_vec3_scale(2.17, right), 1.93, up);
        srp_render_arrow arrow = {.from = p,
                                  .to = srp_vec3_add_scaled(p, 0.2, right),
                                  .width = 9.0,
                                  .colour = {0.0F, 1.0F, 0.0F},
                                  .headless = true};
        view.arrows = &arrow;
        view.arrow_count = 1;
        draw(scene, &view, pixels);
        srp_vec3 middle = srp_vec3_add_scaled(p, 0.1, right);
        ck_assert(srp_render_project(&view.camera, SIDE, SIDE, middle, &x, &y));
        const uint8_t *at = pixels + 4 * ((size_t)y * SIDE + (size_t)x);
        ck_assert_msg(at[1] > 140 && at[0] == 0, "%d %d %d at %g, %g", at[0], at[1], at[2], x, y);
    }
    /* By hand: at the target's distance, a point to the right by half_height is half a picture off;
     * nearer to the eye by half of the distance, twice as much. */
    srp_render_camera camera = {.half_height = 2.0, .field = 2.0 * atan(0.5)};
    double x, y;
    ck_assert(srp_render_project(&camera, 400, 200, srp_vec3_make(0, 2, 0), &x, &y));
    assert_close(x, 300.0, 1e-13, 0.0);
    assert_close(y, 100.0, 1e-13, 0.0);
    ck_assert(srp_render_project(&camera, 400, 200, srp_vec3_make(2, 0, 1), &x, &y));
    assert_close(y, 0.0, 0.0, 1e-11);
    ck_assert(!srp_render_project(&camera, 400, 200, srp_vec3_make(4.001, 0, 1), &x, &y));
    assert_close(srp_render_reach(scene, srp_vec3_make(0.6, 0.0, 0.8)), 1.4, 1e-15, 0.0);
    free(pixels);
    srp_scene_destroy(scene);
}
END_TEST

/* The whole scene is within the picture that is made to fit, and fills it. */
START_TEST(cameras_fit) {
    model_file model = model_read("gnss");
    srp_scene *scene = model_scene(&model);
    double *ones = malloc(srp_scene_facet_count(scene) * sizeof *ones);
    srp_render_view view = red_view(scene, 23.0, 41.0, srp_vec3_make(1, 0, 0), ones);
    uint8_t *pixels = malloc(4 * SIDE * SIDE);
    draw(scene, &view, pixels);
    size_t low = SIDE, high = 0;
    for (size_t k = 0; k < SIDE * SIDE; ++k) {
        if (pixels[4 * k + 2] != 255) {
            low = k % SIDE < low ? k % SIDE : low;
            high = k % SIDE > high ? k % SIDE : high;
        }
    }
    ck_assert_uint_gt(low, SIDE / 20);
    ck_assert_uint_lt(low, SIDE / 7);
    ck_assert_uint_le(SIDE - 1 - high, low + 2);
    ck_assert_uint_ge(SIDE + 1 - high, low);
    free(pixels);
    free(ones);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

/* ---- someone else's context ---- */

static srp_render_function find_in(void *user, const char *name) {
    const srp_gl_context *context = user;
    return context->device->provider->find(context->binding, name);
}

static srp_render_function find_nothing(void *user, const char *name) {
    return strcmp(name, "glBlitFramebuffer") == 0 ? NULL : find_in(user, name);
}

typedef struct guest {
    srp_gl_context *context;
    srp_renderer *renderer;
    GLuint framebuffer, buffers[2];
} guest;

static guest open_guest(void) {
    srp_error error;
    guest g = {0};
    assert_ok(srp_gl_context_create(srp_gl_device_find(gl_device_name), &g.context, &error), error);
    assert_ok(srp_gl_context_enter(g.context, &error), error);
    assert_ok(srp_renderer_create(find_in, g.context, &g.renderer, &error), error);
    const srp_gl_functions *gl = &g.context->gl;
    static const GLenum FORMAT[2] = {GL_RGBA8, GL_DEPTH_COMPONENT24};
    static const GLenum PLACE[2] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
    gl->GenFramebuffers(1, &g.framebuffer);
    gl->GenRenderbuffers(2, g.buffers);
    gl->BindFramebuffer(GL_FRAMEBUFFER, g.framebuffer);
    for (int k = 0; k < 2; ++k) {
        gl->BindRenderbuffer(GL_RENDERBUFFER, g.buffers[k]);
        gl->RenderbufferStorage(GL_RENDERBUFFER, FORMAT[k], SIDE, SIDE);
        gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, PLACE[k], GL_RENDERBUFFER, g.buffers[k]);
    }
    return g;
}

static void close_guest(guest *g) {
    const srp_gl_functions *gl = &g->context->gl;
    srp_renderer_destroy(g->renderer);
    gl->DeleteFramebuffers(1, &g->framebuffer);
    gl->DeleteRenderbuffers(2, g->buffers);
    srp_gl_context_leave(g->context);
    srp_gl_context_destroy(g->context);
}

static void draw_as_guest(guest *g, const srp_render_view *view, uint8_t *pixels) {
    srp_error error;
    assert_ok(srp_renderer_draw(g->renderer, view, &error), error);
    g->context->gl.ReadPixels(0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
}

/* Framebuffers that were bound stay bound, whatever state it meets changes nothing, and the same
 * view is the same picture. */
START_TEST(a_renderer_is_a_good_guest) {
    srp_error error;
    srp_renderer *none = NULL;
    guest g = open_guest();
    srp_renderer *renderer = g.renderer;
    const srp_gl_functions *gl = &g.context->gl;
    ck_assert_int_eq(srp_renderer_create(find_nothing, g.context, &none, &error), SRP_NO_DEVICE);
    ck_assert(strstr(error.message, "glBlitFramebuffer") != NULL);
    ck_assert_ptr_null(none);
    srp_scene *scene =
        shape_scene(shape_box(srp_vec3_make(-1, -1, -1), srp_vec3_make(1, 1, 1), "a"), OPTICS);
    double ones[12];
    srp_render_view view = red_view(scene, 31.0, 17.0, srp_vec3_make(0.6, 0.48, 0.64), ones);
    uint8_t *first = malloc(4 * SIDE * SIDE), *second = malloc(4 * SIDE * SIDE);
    /* Nothing to draw is a picture, too. */
    assert_ok(srp_renderer_draw(renderer, &view, &error), error);
    assert_ok(srp_renderer_set_scene(renderer, scene, &error), error);
    assert_ok(srp_renderer_draw(renderer, &view, &error), error);
    gl->ReadPixels(0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, first);
    counts all = count(first, SIDE * SIDE);
    ck_assert_uint_gt(all.lit, SIDE * SIDE / 4);
    gl->Enable(GL_BLEND);
    gl->BlendFunc(GL_ZERO, GL_ONE);
    gl->FrontFace(GL_CW);
    gl->DepthFunc(GL_NEVER);
    gl->DepthMask(GL_FALSE);
    gl->ColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
    gl->DepthRange(0.7, 0.8);
    gl->Enable(GL_RASTERIZER_DISCARD);
    gl->Scissor(0, 0, 1, 1);
    gl->PolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    assert_ok(srp_renderer_draw(renderer, &view, &error), error);
    gl->ReadPixels(0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, second);
    ck_assert_mem_eq(first, second, 4 * SIDE * SIDE);
    view.samples = 4; /* means over the same bodies: only outlines differ */
    assert_ok(srp_renderer_draw(renderer, &view, &error), error);
    GLint bound = -1;
    gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    ck_assert_int_eq(bound, (int)g.framebuffer);
    gl->GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &bound);
    ck_assert_int_eq(bound, (int)g.framebuffer);
    gl->ReadPixels(0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, second);
    size_t other = 0;
    for (size_t k = 0; k < 4 * SIDE * SIDE; ++k) {
        other += first[k] != second[k];
    }
    ck_assert_uint_gt(other, 0);
    ck_assert_uint_lt(other, 4 * 8 * SIDE);
    ck_assert_uint_eq(gl->GetError(), GL_NO_ERROR);
    close_guest(&g);
    srp_renderer_destroy(NULL);
    srp_scene_destroy(scene);
    free(first);
    free(second);
}
END_TEST

/* ---- large scenes ---- */

/* Egg of 2 columns (rows - 1) triangles. */
static srp_scene *make_egg(uint32_t rows, uint32_t columns) {
    size_t vertices = (size_t)(rows - 1) * columns + 2, n = 2, t = 0;
    size_t count = 2 * (size_t)columns * (rows - 1);
    srp_vec3 *at = malloc(vertices * sizeof *at);
    srp_triangle *of = malloc(count * sizeof *of);
    at[0] = srp_vec3_make(0.0, 0.0, 1.3);
    at[1] = srp_vec3_make(0.0, 0.0, -1.3);
    for (uint32_t i = 1; i < rows; ++i) {
        for (uint32_t k = 0; k < columns; ++k) {
            double polar = SRP_PI * i / rows, az = 2.0 * SRP_PI * k / columns;
            at[n++] = srp_vec3_make(sin(polar) * cos(az), sin(polar) * sin(az), 1.3 * cos(polar));
        }
    }
    for (uint32_t k = 0; k < columns; ++k) {
        uint32_t next = (k + 1) % columns, last = 2 + (rows - 2) * columns;
        of[t++] = (srp_triangle){{0, 2 + k, 2 + next}};
        of[t++] = (srp_triangle){{1, last + next, last + k}};
        for (uint32_t i = 0; i + 2 < rows; ++i) {
            uint32_t a = 2 + i * columns + k, b = 2 + i * columns + next;
            of[t++] = (srp_triangle){{a, a + columns, b + columns}};
            of[t++] = (srp_triangle){{a, b + columns, b}};
        }
    }
    srp_mesh *mesh = shape_mesh(at, vertices, of, count, "shell");
    free(at);
    free(of);
    return shape_scene(mesh, OPTICS);
}

static bool stop(void *user) {
    (void)user;
    return false;
}
/* Light that was found elsewhere gives the same picture as the renderer's own. */
START_TEST(light_may_be_found_elsewhere) {
    srp_error error;
    srp_vec3 sun = srp_vec3_make(0.6, 0.48, 0.64), other = srp_vec3_make(0.48, 0.6, 0.64);
    srp_scene *scene = make_egg(40, 60), *egg = make_egg(8, 9);
    double *ones = malloc(srp_scene_facet_count(scene) * sizeof *ones);
    srp_render_view view = red_view(scene, 80.0, 10.0, sun, ones);
    uint8_t *own = malloc(4 * SIDE * SIDE), *given = malloc(4 * SIDE * SIDE);
    srp_render_light *light = NULL, *before = NULL;
    guest g = open_guest();
    assert_ok(srp_renderer_set_scene(g.renderer, scene, &error), error);
    draw_as_guest(&g, &view, own);
    view.sun = other;
    draw_as_guest(&g, &view, given);
    ck_assert_int_ne(memcmp(own, given, 4 * SIDE * SIDE), 0);
    view.sun = sun;
    assert_ok(srp_render_light_find(scene, sun, NULL, NULL, &light, &error), error);
    assert_ok(srp_renderer_set_light(g.renderer, light, &error), error);
    draw_as_guest(&g, &view, given);
    ck_assert_mem_eq(own, given, 4 * SIDE * SIDE);
    srp_render_light_destroy(light);
    srp_render_light_destroy(NULL);
    light = before;
    ck_assert_int_eq(srp_render_light_find(scene, sun, stop, NULL, &light, &error), SRP_CANCELLED);
    ck_assert_int_eq(
        srp_render_light_find(scene, srp_vec3_make(1, 1, 0), NULL, NULL, &light, &error),
        SRP_BAD_ARGUMENT);
    ck_assert_ptr_eq(light, before);
    assert_ok(srp_render_light_find(egg, sun, NULL, NULL, &light, &error), error);
    ck_assert_int_eq(srp_renderer_set_light(g.renderer, light, &error), SRP_BAD_ARGUMENT);
    srp_render_light_destroy(light);
    close_guest(&g);
    srp_scene_destroy(scene);
    srp_scene_destroy(egg);
    free(ones);
    free(own);
    free(given);
}
END_TEST

/* A simplified picture is another one, yet alike: what is convex casts no shadow on itself. */
START_TEST(large_scenes_are_simplified_while_they_move) {
    srp_error error;
    const uint32_t rows[2] = {300, 60}; /* 89700 facets, and too few */
    for (int k = 0; k < 2; ++k) {
        srp_scene *scene = make_egg(rows[k], 150);
        double *ones = malloc(srp_scene_facet_count(scene) * sizeof *ones);
        srp_render_view view = red_view(scene, 80.0, 10.0, srp_vec3_make(0.6, 0.48, 0.64), ones);
        uint8_t *whole = malloc(4 * SIDE * SIDE), *coarse = malloc(4 * SIDE * SIDE);
        guest g = open_guest();
        assert_ok(srp_renderer_set_scene(g.renderer, scene, &error), error);
        view.coarse = true;
        draw_as_guest(&g, &view, coarse);
        view.coarse = false;
        draw_as_guest(&g, &view, whole);
        close_guest(&g);
        counts a = count(whole, SIDE * SIDE), b = count(coarse, SIDE * SIDE);
        ck_assert_int_eq(memcmp(whole, coarse, 4 * SIDE * SIDE) == 0, k == 1);
        assert_close((double)b.background, (double)a.background, 0.02, 0.0);
        assert_close((double)b.lit, (double)a.lit, 0.03, 0.0);
        assert_close((double)b.dark, (double)a.dark, 0.05, 0.0);
        srp_scene_destroy(scene);
        free(ones);
        free(whole);
        free(coarse);
    }
}
END_TEST

START_TEST(what_cannot_be_drawn_is_refused) {
    srp_error error;
    srp_scene *sphere = NULL;
    srp_scene *scene =
        shape_scene(shape_box(srp_vec3_make(-1, -1, -1), srp_vec3_make(1, 1, 1), "a"), OPTICS);
    double ones[12];
    uint8_t byte[4], *pixels = byte;
    srp_render_arrow arrow = {.to = {NAN, 0, 0}};
    const srp_render_view good = red_view(scene, 0, 0, srp_vec3_make(1, 0, 0), ones);
    srp_render_view bad[13];
    for (int k = 0; k < 13; ++k) {
        bad[k] = good;
    }
    bad[0].width = 0;
    bad[1].height = 1000000;
    bad[2].sun.x = 1.0 + 1e-8;
    bad[3].sun.x = NAN;
    bad[4].camera.half_height = 0.0;
    bad[5].camera.el = 1.6;
    bad[6].camera.field = 3.0;
    bad[7].map = NULL;
    bad[8].values = NULL;
    bad[9].value_high = bad[9].value_low;
    bad[10].colouring = (srp_render_colouring)7;
    bad[11].axes = -1.0;
    bad[12].arrows = &arrow;
    bad[12].arrow_count = 1;
    for (int k = 0; k < 13; ++k) {
        ck_assert_msg(srp_render_offscreen(gl_device_name, scene, &bad[k], 1, &pixels, &error) ==
                          SRP_BAD_ARGUMENT,
                      "view %d", k);
    }
    ck_assert_int_eq(srp_render_offscreen("gl:none", scene, &good, 1, &pixels, &error),
                     SRP_NOT_FOUND);
    assert_ok(srp_scene_from_sphere(1.3, 2.0, &sphere, &error), error);
    ck_assert_int_eq(srp_render_offscreen(gl_device_name, sphere, &good, 1, &pixels, &error),
                     SRP_UNSUPPORTED);
    srp_scene_destroy(sphere);
    srp_scene_destroy(scene);
}
END_TEST

static Suite *make_suite(bool is_long) {
    (void)is_long;
    Suite *suite = suite_create("gl_render");
    TCase *tcase = tcase_create("gl_render");
    tcase_set_timeout(tcase, 300);
    tcase_add_loop_test(tcase, the_sun_sees_no_shadow, 0, (int)MODEL_COUNT);
    tcase_add_test(tcase, shadows_end_where_they_should);
    tcase_add_test(tcase, sheets_have_two_sides);
    tcase_add_test(tcase, colours_are_those_of_the_map);
    tcase_add_test(tcase, materials_have_their_colours);
    tcase_add_test(tcase, points_are_drawn_where_they_are_projected);
    tcase_add_test(tcase, cameras_fit);
    tcase_add_test(tcase, a_renderer_is_a_good_guest);
    tcase_add_test(tcase, light_may_be_found_elsewhere);
    tcase_add_test(tcase, large_scenes_are_simplified_while_they_move);
    tcase_add_test(tcase, what_cannot_be_drawn_is_refused);
    suite_add_tcase(suite, tcase);
    return suite;
}

int main(int argc, char **argv) {
    return gl_run(argc, argv, make_suite);
}
