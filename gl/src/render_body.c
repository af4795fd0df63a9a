/* SPDX-License-Identifier: Apache-2.0 */
/* The scene as corners: facets and edges. */
#include "error.h"
#include "render_internal.h"

srp_vec3 srp_render_into_unit(const srp_scene *scene, srp_vec3 p) {
    return srp_vec3_scale(1.0 / scene->radius, srp_vec3_sub(p, scene->centre));
}

/* ---- facets ---- */

static void add_facets(srp_render_corners *to, const srp_scene *scene, bool closed) {
    for (size_t i = 0; i < scene->facet_count; ++i) {
        const srp_facet *facet = &scene->facets[i];
        for (int k = 0; k < 3 && facet->closed == closed; ++k) {
            srp_render_corners_add(to, srp_render_into_unit(scene, scene->vertices[facet->v[k]]),
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
    srp_render_batch_fill(renderer, SRP_RENDER_BODY, to, GL_STATIC_DRAW);
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

srp_status srp_render_send_edges(srp_renderer *renderer, const srp_scene *scene, srp_error *error) {
    static const srp_vec3 PLAIN = {0.0, 0.0, 0.0};
    srp_render_corners *to = &renderer->scratch;
    uint32_t paint = srp_render_paint(INK);
    to->count = 0;
    if (!srp_render_corners_reserve(to, 6 * scene->facet_count)) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for the edges of %zu facets",
                        scene->facet_count);
    }
    for (size_t i = 0; i < scene->facet_count; ++i) {
        const srp_facet *facet = &scene->facets[i];
        for (int k = 0; k < 3; ++k) {
            if (is_edge(scene, i, k)) {
                srp_vec3 a = scene->vertices[facet->v[k]];
                srp_vec3 b = scene->vertices[facet->v[(k + 1) % 3]];
                srp_render_corners_add(to, srp_render_into_unit(scene, a), PLAIN, paint);
                srp_render_corners_add(to, srp_render_into_unit(scene, b), PLAIN, paint);
            }
        }
    }
    srp_render_batch_fill(renderer, SRP_RENDER_EDGES, to, GL_STATIC_DRAW);
    renderer->edges_known = true;
    return SRP_OK;
}
