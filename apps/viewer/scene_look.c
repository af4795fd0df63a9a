/* SPDX-License-Identifier: Apache-2.0 */
#include "scene_look.h"

#include "palette.h"

#include <srp/const.h>
#include <srp/table.h>

#include <math.h>

/* Shares of the spacecraft's radius. */
static const double ARROW_FROM = 0.55, ARROW_TO = 1.0, AXES = 0.62, SUN_LINE = 1.02;
static const double MARGIN = 1.10;

/* The camera that stands there in the room, in body axes. */
static void place_camera(const viewer_session *session, double az_deg, double el_deg,
                         srp_render_camera *camera) {
    double up_el = el_deg + 90.0;
    srp_vec3 eye =
        viewer_attitude_to_body(&session->attitude, srp_direction_from_deg(az_deg, el_deg));
    srp_vec3 up = viewer_attitude_to_body(
        &session->attitude,
        up_el <= 90.0 ? srp_direction_from_deg(az_deg, up_el)
                      : srp_vec3_scale(-1.0, srp_direction_from_deg(az_deg, up_el - 180.0)));
    srp_vec3 right, above, to_eye;
    camera->el = asin(fmax(-1.0, fmin(1.0, eye.z)));
    camera->az = atan2(eye.y, eye.x);
    camera->roll = 0.0;
    srp_render_camera_axes(camera, &right, &above, &to_eye);
    camera->roll = -atan2(srp_vec3_dot(up, right), srp_vec3_dot(up, above));
}

static void add_arrow(viewer_look *look, srp_vec3 direction, double magnitude, double least,
                      double largest, double width) {
    if (look->view.arrow_count == LOOK_ARROWS_MAX || srp_vec3_norm(direction) == 0.0) {
        return;
    }
    float rgb[3];
    viewer_arrow_colour(largest > least ? (magnitude - least) / (largest - least) : 0.5, rgb);
    srp_vec3 centre = look->view.camera.target;
    look->arrows[look->view.arrow_count++] = (srp_render_arrow){
        .from = srp_vec3_add_scaled(centre, ARROW_FROM * look->radius, direction),
        .to = srp_vec3_add_scaled(centre, ARROW_TO * look->radius, direction),
        .width = width,
        .colour = {rgb[0], rgb[1], rgb[2]}};
}

static void add_arrows(const viewer_session *session, viewer_look *look) {
    double least = 0.0, largest = 0.0;
    viewer_session_arrow_range(session, &least, &largest);
    /* The newest ones, where there are more than can be drawn; one is kept for the force of now. */
    size_t first = session->arrow_count < LOOK_ARROWS_MAX - 1
                       ? 0
                       : session->arrow_count - (LOOK_ARROWS_MAX - 1);
    for (size_t i = first; i < session->arrow_count; ++i) {
        const viewer_arrow *arrow = &session->arrows[i];
        add_arrow(look, arrow->direction, arrow->magnitude, least, largest, 0.0);
    }
    if (session->force_known) {
        double size = srp_vec3_norm(session->force.response.f);
        if (size > 0.0) {
            add_arrow(look, srp_vec3_scale(1.0 / size, session->force.response.f), size,
                      fmin(size, session->arrow_count > 0 ? least : size),
                      fmax(size, session->arrow_count > 0 ? largest : size),
                      fmax(3.0, look->view.height / 90.0));
        }
    }
    look->view.arrows = look->arrows;
}

static void fill_map(viewer_look *look) {
    cli_palette palette;
    cli_palette_sequential(&palette);
    for (int k = 0; k < LOOK_MAP_SIZE; ++k) {
        const double *rgb = palette.rgb[k * CLI_PALETTE_SIZE / LOOK_MAP_SIZE];
        look->map[k] = (srp_render_colour){(float)rgb[0], (float)rgb[1], (float)rgb[2]};
    }
    look->view.map = look->map;
    look->view.map_count = LOOK_MAP_SIZE;
}

void viewer_look_make(const viewer_session *session, double az_deg, double el_deg, double zoom,
                      int width, int height, viewer_look *out) {
    const srp_mesh_report *r = &session->engine->shape->info.report;
    double az, el, aspect = (double)width / height;
    out->view = srp_render_view_default();
    out->view.width = width;
    out->view.height = height;
    out->radius = 0.5 * srp_vec3_norm(srp_vec3_sub(r->box_max, r->box_min));
    out->view.camera.target = srp_vec3_scale(0.5, srp_vec3_add(r->box_min, r->box_max));
    out->view.camera.half_height = MARGIN * out->radius / (fmin(aspect, 1.0) * zoom);
    out->view.camera.field = 0.0;
    place_camera(session, az_deg, el_deg, &out->view.camera);
    viewer_attitude_sun(&session->attitude, &az, &el);
    out->view.sun = srp_direction_from_deg(az, el);
    out->view.axes = AXES * out->radius;
    out->view.sun_line = SUN_LINE * out->radius;
    out->view.edges = srp_scene_facet_count(session->engine->mesh) <= 5000;
    fill_map(out);
    add_arrows(session, out);
}
