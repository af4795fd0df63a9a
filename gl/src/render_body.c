/* SPDX-License-Identifier: Apache-2.0 */
/* The scene as corners: facets, their lit parts, edges. */
#include "error.h"
#include "render_internal.h"

static srp_vec3 into_unit(const srp_scene *scene, srp_vec3 p) {
    return srp_vec3_scale(1.0 / scene->radius, srp_vec3_sub(p, scene->centre));
}

/* ---- facets ---- */

static void add_facets(srp_render_corners *to, const srp_scene *scene, bool closed) {
    for (size_t i = 0; i < scene->facet_count; ++i) {
        const srp_facet *facet = &scene->facets[i];
        for (int k = 0; k < 3 && facet->closed == closed; ++k) {
            srp_render_corners_add(to, into_unit(scene, scene->vertices[facet->v[k]]),
                                   facet->normal, (uint32_t)i);
        }
    }
}

void srp_render_send_body(srp_renderer *renderer, const srp_scene *scene) {
    srp_render_corners *to = &renderer->scratch;
    to->count = 0;
    add_facets(to, scene, true);
    renderer->closed_corners = to->count;
    add_facets(to, scene, false);
    srp_render_batch_fill(renderer, SRP_RENDER_BODY, GL_STATIC_DRAW);
}

/* ---- edges ---- */

/* Neighbours that turn by less look like one smooth surface: cosine of 30 degrees. */
static const double SMOOTH = 0.8660254037844386;
static const srp_render_colour INK = {0.10F, 0.10F, 0.10F};

static bool is_edge(const srp_scene *scene, size_t i, int k) {
    const srp_facet *facet = &scene->facets[i];
    uint32_t other = facet->neighbour[k];
    if (other == SRP_NO_NEIGHBOUR) {
        return true;
    }
    const srp_facet *beyond = &scene->facets[other];
    return other > i && (beyond->material != facet->material ||
                         srp_vec3_dot(facet->normal, beyond->normal) < SMOOTH);
}

void srp_render_send_edges(srp_renderer *renderer, const srp_scene *scene) {
    static const srp_vec3 PLAIN = {0.0, 0.0, 0.0};
    srp_render_corners *to = &renderer->scratch;
    uint32_t paint = srp_render_paint(INK);
    to->count = 0;
    for (size_t i = 0; i < scene->facet_count; ++i) {
        const srp_facet *facet = &scene->facets[i];
        for (int k = 0; k < 3; ++k) {
            if (is_edge(scene, i, k)) {
                srp_vec3 a = scene->vertices[facet->v[k]];
                srp_vec3 b = scene->vertices[facet->v[(k + 1) % 3]];
                srp_render_corners_add(to, into_unit(scene, a), PLAIN, paint);
                srp_render_corners_add(to, into_unit(scene, b), PLAIN, paint);
            }
        }
    }
    srp_render_batch_fill(renderer, SRP_RENDER_EDGES, GL_STATIC_DRAW);
}

/* ---- lit parts ---- */

/* Pieces of one facet overlap by this share of the scene's radius: without it, rounding would leave
 * gaps between those that do not share their corners. A hundredth of a pixel of most pictures. */
static const double OVERLAP = 4e-5;

/* What collects the lit parts. */
typedef struct lit_sink {
    const srp_scene *scene;
    const srp_beam *beam;
    srp_render_corners *to;
} lit_sink;

/* The point of the facet that is seen at (x, y) in the image, in unit space. */
static srp_vec3 lift(const lit_sink *sink, const srp_lit *lit, srp_point2 p) {
    const srp_view *view = &sink->beam->view;
    srp_vec3 on = sink->scene->vertices[sink->scene->facets[lit->facet].v[0]];
    srp_vec3 corner = srp_view_project(view, srp_vec3_sub(on, sink->beam->centre));
    double x = p.x - corner.x, y = p.y - corner.y;
    double across = x * srp_vec3_dot(lit->normal, view->u) + y * srp_vec3_dot(lit->normal, view->v);
    srp_vec3 offset = srp_view_lift(view, srp_vec3_make(x, y, -across / lit->cosine));
    return into_unit(sink->scene, srp_vec3_add(on, offset));
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

srp_status srp_render_send_lit(srp_renderer *renderer, srp_vec3 sun, srp_error *error) {
    const srp_scene *scene = renderer->scene;
    srp_beam beam = srp_beam_of_sun(scene, sun);
    lit_sink sink = {scene, &beam, &renderer->scratch};
    renderer->scratch.count = 0;
    srp_status status = srp_visible_find(renderer->visible, &beam, true, add_lit, &sink);
    if (status != SRP_OK) {
        return srp_fail(error, status, "no memory for the sunlit parts of %zu facets",
                        scene->facet_count);
    }
    srp_render_batch_fill(renderer, SRP_RENDER_LIT, GL_DYNAMIC_DRAW);
    return SRP_OK;
}
