/* SPDX-License-Identifier: Apache-2.0 */
/* Axes, the Sun's line and arrows: round bars with tips, of a width in pixels. */
#include "error.h"
#include "render_internal.h"

#include <srp/const.h>

/* Flat sides of a bar; of the Sun's ball, and its rings. */
enum {
    SIDES = 16,
    BALL_RINGS = 8,
    ARROW_CORNERS = SIDES * (9 + 6), /* shaft and head */
    BALL_CORNERS = SIDES * BALL_RINGS * 6
};

/* Sizes in units of the radius of the shaft. */
static const double HEAD_RADIUS = 3.6, HEAD_LENGTH = 10.0, BALL_RADIUS = 5.0;
static const double HEAD_SHARE = 0.45; /* of the arrow, at most */
static const double WIDTH_SHARE = 1.0 / 160.0;

static const srp_render_colour AXIS_COLOUR[3] = {
    {0.84F, 0.15F, 0.16F}, {0.13F, 0.60F, 0.17F}, {0.15F, 0.32F, 0.85F}};
static const srp_render_colour SUN_COLOUR = {0.98F, 0.80F, 0.10F};

srp_render_colour srp_render_axis_colour(int axis) {
    return AXIS_COLOUR[axis >= 0 && axis < 3 ? axis : 0];
}

/* Lighter on a dark background. */
static srp_render_colour axis_colour_on(srp_render_colour background, int axis) {
    const float lift = background.r + background.g + background.b < 1.0F ? 0.4F : 0.0F;
    srp_render_colour c = AXIS_COLOUR[axis];
    return (srp_render_colour){c.r + lift * (1.0F - c.r), c.g + lift * (1.0F - c.g),
                               c.b + lift * (1.0F - c.b)};
}

/* Where marks are built: unit space. */
typedef struct drawer {
    srp_render_corners *to;
    srp_vec3 centre;
    double radius, pixel; /* [m]; one pixel at the target, in unit space */
} drawer;

static srp_vec3 into_unit(const drawer *draw, srp_vec3 p) {
    return srp_vec3_scale(1.0 / draw->radius, srp_vec3_sub(p, draw->centre));
}

/* Two unit vectors that are perpendicular to `along` and to each other; right-handed with it. */
static void complete(srp_vec3 along, srp_vec3 *u, srp_vec3 *v) {
    srp_vec3 other = fabs(along.z) < 0.8 ? srp_vec3_make(0, 0, 1) : srp_vec3_make(1, 0, 0);
    srp_vec3 across = srp_vec3_cross(other, along);
    *u = srp_vec3_scale(1.0 / srp_vec3_norm(across), across);
    *v = srp_vec3_cross(along, *u);
}

static srp_vec3 on_circle(srp_vec3 u, srp_vec3 v, int k) {
    double angle = 2.0 * SRP_PI * k / SIDES;
    return srp_vec3_add_scaled(srp_vec3_scale(cos(angle), u), sin(angle), v);
}

static void add_triangle(const drawer *draw, srp_vec3 a, srp_vec3 b, srp_vec3 c, srp_vec3 normal,
                         uint32_t paint) {
    srp_render_corners_add(draw->to, a, normal, paint);
    srp_render_corners_add(draw->to, b, normal, paint);
    srp_render_corners_add(draw->to, c, normal, paint);
}

/* The side of a bar or cone from radius r0 about `a` to r1 about `b`, and its end at `a`. */
static void add_cone(const drawer *draw, srp_vec3 a, double r0, srp_vec3 b, double r1,
                     srp_vec3 along, uint32_t paint) {
    srp_vec3 u, v;
    complete(along, &u, &v);
    double length = srp_vec3_norm(srp_vec3_sub(b, a));
    for (int k = 0; k < SIDES; ++k) {
        srp_vec3 p = on_circle(u, v, k), q = on_circle(u, v, k + 1);
        srp_vec3 a0 = srp_vec3_add_scaled(a, r0, p), a1 = srp_vec3_add_scaled(a, r0, q);
        srp_vec3 b0 = srp_vec3_add_scaled(b, r1, p), b1 = srp_vec3_add_scaled(b, r1, q);
        srp_vec3 out = srp_vec3_scale(0.5, srp_vec3_add(p, q));
        srp_vec3 n = srp_vec3_add_scaled(srp_vec3_scale(length, out), r0 - r1, along);
        n = srp_vec3_scale(1.0 / srp_vec3_norm(n), n);
        add_triangle(draw, a0, a1, b1, n, paint);
        if (r1 > 0.0) {
            add_triangle(draw, a0, b1, b0, n, paint);
        }
        add_triangle(draw, a, a1, a0, srp_vec3_scale(-1.0, along), paint);
    }
}

static void add_arrow(const drawer *draw, const srp_render_arrow *arrow, double width) {
    srp_vec3 from = into_unit(draw, arrow->from), to = into_unit(draw, arrow->to);
    srp_vec3 way = srp_vec3_sub(to, from);
    double length = srp_vec3_norm(way), radius = 0.5 * width * draw->pixel;
    if (!(length > 0.0)) {
        return;
    }
    uint32_t paint = srp_render_paint(arrow->colour);
    srp_vec3 along = srp_vec3_scale(1.0 / length, way);
    double head = arrow->headless ? 0.0 : fmin(HEAD_LENGTH * radius, HEAD_SHARE * length);
    srp_vec3 neck = srp_vec3_add_scaled(to, -head, along);
    add_cone(draw, from, radius, neck, radius, along, paint);
    if (head > 0.0) {
        add_cone(draw, neck, fmin(HEAD_RADIUS * radius, 0.5 * head), to, 0.0, along, paint);
    }
}

static srp_vec3 on_ball(srp_vec3 middle, double radius, int ring, int side) {
    double polar = SRP_PI * ring / BALL_RINGS, angle = 2.0 * SRP_PI * side / SIDES;
    srp_vec3 out = srp_vec3_make(sin(polar) * cos(angle), sin(polar) * sin(angle), cos(polar));
    return srp_vec3_add_scaled(middle, radius, out);
}

static void add_ball(const drawer *draw, srp_vec3 at, double width, srp_render_colour colour) {
    static const srp_vec3 PLAIN = {0.0, 0.0, 0.0};
    double radius = 0.5 * BALL_RADIUS * width * draw->pixel;
    uint32_t paint = srp_render_paint(colour);
    srp_vec3 middle = into_unit(draw, at);
    for (int i = 0; i < BALL_RINGS; ++i) {
        for (int k = 0; k < SIDES; ++k) {
            srp_vec3 a = on_ball(middle, radius, i, k), b = on_ball(middle, radius, i + 1, k);
            srp_vec3 c = on_ball(middle, radius, i + 1, k + 1);
            srp_vec3 d = on_ball(middle, radius, i, k + 1);
            add_triangle(draw, a, b, c, PLAIN, paint);
            add_triangle(draw, a, c, d, PLAIN, paint);
        }
    }
}

static srp_vec3 sun_end(const srp_render_view *view) {
    return srp_vec3_add_scaled(view->camera.target, view->sun_line, view->sun);
}

double srp_render_marks_reach(const srp_render_view *view) {
    double reach = view->axes > 0.0 ? srp_vec3_norm(view->camera.target) + view->axes : 0.0;
    reach = fmax(reach, view->sun_line);
    for (size_t k = 0; k < view->arrow_count; ++k) {
        const srp_render_arrow *arrow = &view->arrows[k];
        reach = fmax(reach, srp_vec3_norm(srp_vec3_sub(arrow->from, view->camera.target)));
        reach = fmax(reach, srp_vec3_norm(srp_vec3_sub(arrow->to, view->camera.target)));
    }
    double pixel = 2.0 * view->camera.half_height / view->height;
    return reach > 0.0 ? reach + 2.0 * HEAD_RADIUS * pixel * WIDTH_SHARE * view->height : 0.0;
}

srp_status srp_render_send_marks(srp_renderer *renderer, const srp_render_view *view,
                                 srp_vec3 centre, double radius, srp_error *error) {
    double usual = fmax(WIDTH_SHARE * view->height, 1.0);
    drawer draw = {.to = &renderer->scratch,
                   .centre = centre,
                   .radius = radius,
                   .pixel = 2.0 * view->camera.half_height / view->height / radius};
    renderer->scratch.count = 0;
    if (!srp_render_corners_reserve(&renderer->scratch,
                                    (view->arrow_count + 4) * ARROW_CORNERS + BALL_CORNERS)) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for %zu arrows", view->arrow_count);
    }
    const srp_vec3 axis[3] = {
        {view->axes, 0.0, 0.0}, {0.0, view->axes, 0.0}, {0.0, 0.0, view->axes}};
    for (int k = 0; k < 3; ++k) {
        srp_render_colour colour = axis_colour_on(view->background, k);
        add_arrow(&draw, &(srp_render_arrow){.to = axis[k], .colour = colour}, 0.7 * usual);
    }
    if (view->sun_line > 0.0) {
        add_arrow(&draw,
                  &(srp_render_arrow){.from = view->camera.target,
                                      .to = sun_end(view),
                                      .colour = SUN_COLOUR,
                                      .headless = true},
                  0.7 * usual);
        add_ball(&draw, sun_end(view), usual, SUN_COLOUR);
    }
    for (size_t k = 0; k < view->arrow_count; ++k) {
        const srp_render_arrow *arrow = &view->arrows[k];
        add_arrow(&draw, arrow, arrow->width > 0.0 ? arrow->width : usual);
    }
    srp_render_batch_fill(renderer, SRP_RENDER_MARKS, &renderer->scratch, GL_STREAM_DRAW);
    return SRP_OK;
}
