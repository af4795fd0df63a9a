/* SPDX-License-Identifier: Apache-2.0 */
/* Where things are in a picture. */
#include "render_internal.h"
#include "view.h"

#include <srp/const.h>

/* Shares of the picture that are left free about a scene, and of the depth about what is drawn. */
static const double MARGIN = 0.12, DEPTH_MARGIN = 0.02;

void srp_render_camera_axes(const srp_render_camera *camera, srp_vec3 *right, srp_vec3 *up,
                            srp_vec3 *eye) {
    double cos_az = cos(camera->az), sin_az = sin(camera->az);
    double cos_el = cos(camera->el), sin_el = sin(camera->el);
    srp_vec3 u = srp_vec3_make(-sin_az, cos_az, 0.0);
    srp_vec3 v = srp_vec3_make(-sin_el * cos_az, -sin_el * sin_az, cos_el);
    double cos_roll = cos(camera->roll), sin_roll = sin(camera->roll);
    *right = srp_vec3_add_scaled(srp_vec3_scale(cos_roll, u), sin_roll, v);
    *up = srp_vec3_add_scaled(srp_vec3_scale(cos_roll, v), -sin_roll, u);
    *eye = srp_vec3_make(cos_el * cos_az, cos_el * sin_az, sin_el);
}

srp_render_camera srp_render_camera_fit(const srp_scene *scene, double az, double el,
                                        double aspect) {
    srp_render_camera camera = {.az = az, .el = el, .half_height = 1.0};
    srp_view axes;
    srp_render_camera_axes(&camera, &axes.u, &axes.v, &axes.s);
    srp_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < scene->vertex_count; ++i) {
        srp_vec3 p = srp_view_project(&axes, scene->vertices[i]);
        low = srp_vec3_make(fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z));
        high = srp_vec3_make(fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z));
    }
    if (scene->vertex_count > 0) {
        srp_vec3 middle = srp_vec3_scale(0.5, srp_vec3_add(low, high));
        double half = fmax(0.5 * (high.y - low.y), 0.5 * (high.x - low.x) / aspect);
        camera.target = srp_view_lift(&axes, middle);
        camera.half_height = (1.0 + 2.0 * MARGIN) * half;
    }
    return camera;
}

double srp_render_reach(const srp_scene *scene, srp_vec3 direction) {
    double reach = 0.0;
    for (size_t i = 0; i < scene->vertex_count; ++i) {
        double along = srp_vec3_dot(scene->vertices[i], direction);
        reach = i == 0 || along > reach ? along : reach;
    }
    return reach;
}

/* Distance of the eye from the target; only of cameras that are not parallel. */
static double distance_of(const srp_render_camera *camera) {
    return camera->half_height / tan(0.5 * camera->field);
}

bool srp_render_project(const srp_render_camera *camera, int width, int height, srp_vec3 p,
                        double *x, double *y) {
    srp_view axes;
    srp_render_camera_axes(camera, &axes.u, &axes.v, &axes.s);
    srp_vec3 at = srp_view_project(&axes, srp_vec3_sub(p, camera->target));
    double enlarged = 1.0;
    if (camera->field > 0.0) {
        double distance = distance_of(camera);
        if (!(at.z < distance)) {
            return false;
        }
        enlarged = distance / (distance - at.z);
    }
    double pixels = 0.5 * height / camera->half_height * enlarged;
    *x = 0.5 * width + pixels * at.x;
    *y = 0.5 * height - pixels * at.y;
    return true;
}

/* A row that gives `scale` times the share of p - target along `axis`, plus `more`. */
static void set_row(float row[4], double scale, srp_vec3 axis, srp_vec3 offset, double radius,
                    double more) {
    srp_vec3 along = srp_vec3_scale(scale * radius, axis);
    row[0] = (float)along.x;
    row[1] = (float)along.y;
    row[2] = (float)along.z;
    row[3] = (float)(scale * srp_vec3_dot(axis, offset) + more);
}

void srp_render_matrix(const srp_render_view *view, srp_vec3 centre, double radius, double reach,
                       float rows[4][4]) {
    const srp_render_camera *camera = &view->camera;
    srp_view axes;
    srp_render_camera_axes(camera, &axes.u, &axes.v, &axes.s);
    srp_vec3 offset = srp_vec3_sub(centre, camera->target);
    double height = 1.0 / camera->half_height, aspect = (double)view->width / view->height;
    reach *= 1.0 + DEPTH_MARGIN;
    if (camera->field > 0.0) {
        /* w: distance from the eye, in units of that of the target. */
        double distance = distance_of(camera);
        double far = (distance + reach) / distance;
        double near = fmax((distance - reach) / distance, 1e-3 * far);
        double slope = (far + near) / (far - near);
        set_row(rows[2], -slope / distance, axes.s, offset, radius,
                slope - 2.0 * far * near / (far - near));
        set_row(rows[3], -1.0 / distance, axes.s, offset, radius, 1.0);
    } else {
        set_row(rows[2], -1.0 / reach, axes.s, offset, radius, 0.0);
        set_row(rows[3], 0.0, axes.s, offset, radius, 1.0);
    }
    set_row(rows[0], height / aspect, axes.u, offset, radius, 0.0);
    set_row(rows[1], height, axes.v, offset, radius, 0.0);
}
