/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A simplified body, for pictures that follow a hand: corners are drawn together where they lie in
 * one cell of a grid, and facets that lose one by it are left out (J. Rossignac and P. Borrel,
 * Multi-resolution 3D approximations for rendering complex scenes, 1993). Facets keep their normal
 * and their colour.
 */
#include "render_internal.h"

#include <stdlib.h>

/* Cells to a radius of the scene: of the first grid, and of one that is not tried any more. */
enum { CELLS_MOST = 48, CELLS_LEAST = 4 };
/* What draws in some 20 ms without a GPU. */
static const size_t FACETS_MOST = 100000;

static const uint32_t NOBODY = UINT32_MAX;

typedef struct grid {
    int cells;      /* to a radius */
    uint32_t *who;  /* of each cell the first vertex in it */
    uint32_t *cell; /* (vertices) */
} grid;

static size_t side_of(const grid *g) {
    return 2 * (size_t)g->cells + 1; /* the centre of the scene is in the middle of a cell */
}

static uint32_t cell_of(const grid *g, srp_vec3 unit) {
    const double p[3] = {unit.x, unit.y, unit.z};
    size_t side = side_of(g), at = 0;
    for (int k = 0; k < 3; ++k) {
        double place = fmin(fmax((p[k] + 1.0) * g->cells + 0.5, 0.0), (double)(side - 1));
        at = at * side + (size_t)place;
    }
    return (uint32_t)at;
}

static void put_vertices(grid *g, const srp_scene *scene) {
    size_t side = side_of(g);
    for (size_t i = 0; i < side * side * side; ++i) {
        g->who[i] = NOBODY;
    }
    for (size_t i = 0; i < scene->vertex_count; ++i) {
        uint32_t at = cell_of(g, srp_render_into_unit(scene, scene->vertices[i]));
        g->cell[i] = at;
        g->who[at] = g->who[at] == NOBODY ? (uint32_t)i : g->who[at];
    }
}

static bool is_kept(const grid *g, const srp_facet *facet) {
    uint32_t a = g->cell[facet->v[0]], b = g->cell[facet->v[1]], c = g->cell[facet->v[2]];
    return a != b && b != c && c != a;
}

static size_t count_kept(const grid *g, const srp_scene *scene) {
    size_t count = 0;
    for (size_t i = 0; i < scene->facet_count; ++i) {
        count += is_kept(g, &scene->facets[i]);
    }
    return count;
}

static void add_facet(const grid *g, const srp_scene *scene, uint32_t i, srp_render_corners *to) {
    const srp_facet *facet = &scene->facets[i];
    srp_vec3 p[3];
    for (int k = 0; k < 3; ++k) {
        p[k] = srp_render_into_unit(scene, scene->vertices[g->who[g->cell[facet->v[k]]]]);
    }
    srp_vec3 across = srp_vec3_cross(srp_vec3_sub(p[1], p[0]), srp_vec3_sub(p[2], p[0]));
    int second = srp_vec3_dot(across, facet->normal) < 0.0 ? 2 : 1; /* it has turned over */
    srp_render_corners_add(to, p[0], facet->normal, i);
    srp_render_corners_add(to, p[second], facet->normal, i);
    srp_render_corners_add(to, p[3 - second], facet->normal, i);
}

static void add_kept(const grid *g, const srp_scene *scene, bool closed, srp_render_corners *to) {
    for (size_t i = 0; i < scene->facet_count; ++i) {
        const srp_facet *facet = &scene->facets[i];
        if (facet->closed == closed && is_kept(g, facet)) {
            add_facet(g, scene, (uint32_t)i, to);
        }
    }
}

void srp_render_send_coarse(srp_renderer *renderer, const srp_scene *scene) {
    const size_t side = 2 * CELLS_MOST + 1;
    grid g = {.cells = CELLS_MOST};
    renderer->scratch.count = 0;
    if (scene->facet_count > SRP_RENDER_COARSE_FACETS) {
        g.who = malloc(side * side * side * sizeof *g.who);
        g.cell = malloc(scene->vertex_count * sizeof *g.cell);
    }
    if (g.who != NULL && g.cell != NULL) {
        put_vertices(&g, scene);
        while (g.cells > CELLS_LEAST && count_kept(&g, scene) > FACETS_MOST) {
            g.cells /= 2;
            put_vertices(&g, scene);
        }
        add_kept(&g, scene, true, &renderer->scratch);
        renderer->closed_coarse = renderer->scratch.count;
        add_kept(&g, scene, false, &renderer->scratch);
    }
    free(g.who);
    free(g.cell);
    srp_render_batch_fill(renderer, SRP_RENDER_COARSE, &renderer->scratch, GL_STATIC_DRAW);
}
