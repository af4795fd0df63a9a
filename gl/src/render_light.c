/* SPDX-License-Identifier: Apache-2.0 */
/* Lit parts of facets as corners, found on any thread. */
#include "error.h"
#include "render_internal.h"

#include <stdlib.h>

struct srp_render_light {
    const srp_scene *scene;
    srp_vec3 sun;
    srp_render_corners corners;
};

/* Pieces of one facet overlap by this share of the scene's radius: without it, rounding would leave
 * gaps between those that do not share their corners. A hundredth of a pixel of most pictures. */
static const double OVERLAP = 4e-5;

/* What collects the lit parts. */
typedef struct lit_sink {
    const srp_scene *scene;
    const srp_beam *beam;
    srp_render_corners *to;
    bool (*go_on)(void *user); /* NULL: to the end */
    void *user;
} lit_sink;

/* The point of the facet that is seen at (x, y) in the image, in unit space. */
static srp_vec3 lift(const lit_sink *sink, const srp_lit *lit, srp_point2 p) {
    const srp_view *view = &sink->beam->view;
    srp_vec3 on = sink->scene->vertices[sink->scene->facets[lit->facet].v[0]];
    srp_vec3 corner = srp_view_project(view, srp_vec3_sub(on, sink->beam->centre));
    double x = p.x - corner.x, y = p.y - corner.y;
    double across = x * srp_vec3_dot(lit->normal, view->u) + y * srp_vec3_dot(lit->normal, view->v);
    srp_vec3 offset = srp_view_lift(view, srp_vec3_make(x, y, -across / lit->cosine));
    return srp_render_into_unit(sink->scene, srp_vec3_add(on, offset));
}

/* The unit vector in the plane of `n` that points out of a polygon across its side a -> b; 0: the
 * side is none. */
static srp_vec3 outward(srp_vec3 a, srp_vec3 b, srp_vec3 n) {
    srp_vec3 across = srp_vec3_cross(srp_vec3_sub(b, a), n);
    double length = srp_vec3_norm(across);
    return length > 0.0 ? srp_vec3_scale(1.0 / length, across) : srp_vec3_make(0.0, 0.0, 0.0);
}

/* Moves each corner of a polygon out, by OVERLAP on both of its sides, but not far at sharp ones.
 */
static void widen(srp_vec3 n, uint32_t count, const srp_vec3 *p, srp_vec3 *out) {
    for (uint32_t k = 0; k < count; ++k) {
        srp_vec3 before = outward(p[(k + count - 1) % count], p[k], n);
        srp_vec3 after = outward(p[k], p[(k + 1) % count], n);
        double shared = fmax(1.0 + srp_vec3_dot(before, after), 0.1);
        out[k] = srp_vec3_add_scaled(p[k], OVERLAP / shared, srp_vec3_add(before, after));
    }
}

static srp_status add_lit(void *user, const srp_lit *lit) {
    const lit_sink *sink = user;
    if (sink->go_on != NULL && !sink->go_on(sink->user)) {
        return SRP_CANCELLED;
    }
    for (size_t i = 0; i < lit->part_count; ++i) {
        const srp_polygon *part = &lit->part[i];
        srp_vec3 p[SRP_POLYGON_ROOM], wide[SRP_POLYGON_ROOM];
        if (part->count < 3) {
            continue;
        }
        if (!srp_render_corners_reserve(sink->to, 3 * (size_t)(part->count - 2))) {
            return SRP_NO_MEMORY;
        }
        for (uint32_t k = 0; k < part->count; ++k) {
            p[k] = lift(sink, lit, part->p[k]);
        }
        widen(lit->normal, part->count, p, wide);
        for (uint32_t k = 2; k < part->count; ++k) {
            srp_render_corners_add(sink->to, wide[0], lit->normal, lit->facet);
            srp_render_corners_add(sink->to, wide[k - 1], lit->normal, lit->facet);
            srp_render_corners_add(sink->to, wide[k], lit->normal, lit->facet);
        }
    }
    return SRP_OK;
}

static srp_status find_lit(srp_visible *visible, const srp_scene *scene, srp_vec3 sun,
                           lit_sink *sink, srp_error *error) {
    srp_beam beam = srp_beam_of_sun(scene, sun);
    sink->scene = scene;
    sink->beam = &beam;
    srp_status status = srp_visible_find(visible, &beam, true, add_lit, sink);
    if (status == SRP_CANCELLED) {
        return srp_fail(error, status, "the search of sunlit parts was cancelled");
    }
    return status == SRP_OK
               ? SRP_OK
               : srp_fail(error, status, "no memory for the sunlit parts of %zu facets",
                          scene->facet_count);
}

/* ---- on the thread of the renderer ---- */

static void light_is_known(srp_renderer *renderer, srp_vec3 sun) {
    renderer->lit_from = sun;
    renderer->lit_known = true;
}

static bool is_known(const srp_renderer *renderer, srp_vec3 sun) {
    return renderer->lit_known && sun.x == renderer->lit_from.x && sun.y == renderer->lit_from.y &&
           sun.z == renderer->lit_from.z;
}

srp_status srp_renderer_find_light(srp_renderer *renderer, srp_vec3 sun, srp_error *error) {
    lit_sink sink = {.to = &renderer->scratch};
    if (renderer->scene == NULL || is_known(renderer, sun)) {
        return SRP_OK;
    }
    if (renderer->visible == NULL) {
        renderer->visible = srp_visible_create(renderer->scene);
    }
    if (renderer->visible == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for shadows");
    }
    renderer->lit_known = false;
    renderer->scratch.count = 0;
    srp_status status = find_lit(renderer->visible, renderer->scene, sun, &sink, error);
    if (status == SRP_OK) {
        srp_render_batch_fill(renderer, SRP_RENDER_LIT, &renderer->scratch, GL_DYNAMIC_DRAW);
        light_is_known(renderer, sun);
    }
    return status;
}

/* ---- on any thread ---- */

srp_status srp_render_light_find(const srp_scene *scene, srp_vec3 sun, bool (*go_on)(void *user),
                                 void *user, srp_render_light **out, srp_error *error) {
    if (scene->shape != SRP_SHAPE_MESH) {
        return srp_fail(error, SRP_UNSUPPORTED, "only meshes can be drawn");
    }
    if (!(fabs(srp_vec3_norm(sun) - 1.0) <= 1e-9)) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "the direction of the Sun is no unit vector");
    }
    srp_render_light *light = calloc(1, sizeof *light);
    srp_visible *visible = light != NULL ? srp_visible_create(scene) : NULL;
    srp_status status =
        visible != NULL ? SRP_OK : srp_fail(error, SRP_NO_MEMORY, "no memory for shadows");
    if (status == SRP_OK) {
        lit_sink sink = {.to = &light->corners, .go_on = go_on, .user = user};
        status = find_lit(visible, scene, sun, &sink, error);
    }
    srp_visible_destroy(visible);
    if (status != SRP_OK) {
        srp_render_light_destroy(light);
        return status;
    }
    light->scene = scene;
    light->sun = sun;
    *out = light;
    return SRP_OK;
}

void srp_render_light_destroy(srp_render_light *light) {
    if (light != NULL) {
        free(light->corners.at);
        free(light);
    }
}

srp_status srp_renderer_set_light(srp_renderer *renderer, const srp_render_light *light,
                                  srp_error *error) {
    if (light->scene != renderer->scene) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "the light falls on another scene");
    }
    renderer->lit_known = false;
    srp_render_batch_fill(renderer, SRP_RENDER_LIT, &light->corners, GL_DYNAMIC_DRAW);
    srp_status status = srp_gl_context_check(&renderer->context, "the sunlit parts", error);
    if (status == SRP_OK) {
        light_is_known(renderer, light->sun);
    }
    return status;
}
