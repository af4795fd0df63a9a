/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Vertices are taken in blocks of neighbours in the list, each with its box, and a block is looked
 * into only when its box reaches above the plane. Meshes list near vertices together, so that for
 * faces on the hull, which must exclude every vertex, nearly all blocks fall at once; for all other
 * faces the first block that rises ends the search.
 */
#include "sight.h"

#include "error.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>

enum { BLOCK = 64 };

/* Rounding noise of a height above a well-shaped facet, in units of DBL_EPSILON times the size of
 * the mesh (as in exact.c). */
#define PLANE_ULPS 32.0

typedef struct block {
    srp_vec3 low, high;
    size_t begin, end;
} block;

static void bound_block(const srp_scene *scene, size_t begin, block *out) {
    out->begin = begin;
    out->end = begin + BLOCK < scene->vertex_count ? begin + BLOCK : scene->vertex_count;
    out->low = out->high = scene->vertices[begin];
    for (size_t i = begin + 1; i < out->end; ++i) {
        srp_vec3 p = scene->vertices[i];
        out->low =
            srp_vec3_make(fmin(out->low.x, p.x), fmin(out->low.y, p.y), fmin(out->low.z, p.z));
        out->high =
            srp_vec3_make(fmax(out->high.x, p.x), fmax(out->high.y, p.y), fmax(out->high.z, p.z));
    }
}

/* No vertex of the block is further along `normal` from `a`. */
static double highest_corner(const block *b, srp_vec3 a, srp_vec3 normal) {
    srp_vec3 corner =
        srp_vec3_make(normal.x > 0.0 ? b->high.x : b->low.x, normal.y > 0.0 ? b->high.y : b->low.y,
                      normal.z > 0.0 ? b->high.z : b->low.z);
    return srp_vec3_dot(normal, srp_vec3_sub(corner, a));
}

static bool something_above(const srp_scene *scene, const block *blocks, size_t count, srp_vec3 a,
                            srp_vec3 normal, double noise) {
    for (size_t k = 0; k < count; ++k) {
        if (highest_corner(&blocks[k], a, normal) <= noise) {
            continue;
        }
        for (size_t i = blocks[k].begin; i < blocks[k].end; ++i) {
            if (srp_vec3_dot(normal, srp_vec3_sub(scene->vertices[i], a)) > noise) {
                return true;
            }
        }
    }
    return false;
}

static uint8_t sides_that_see(const srp_scene *scene, const block *blocks, size_t count,
                              const srp_facet *facet, double size) {
    srp_vec3 a = scene->vertices[facet->v[0]];
    srp_vec3 ab = srp_vec3_sub(scene->vertices[facet->v[1]], a);
    srp_vec3 ac = srp_vec3_sub(scene->vertices[facet->v[2]], a);
    srp_vec3 bc = srp_vec3_sub(ac, ab);
    double longest = fmax(srp_vec3_dot(ab, ab), fmax(srp_vec3_dot(ac, ac), srp_vec3_dot(bc, bc)));
    /* A plane through points known to e tilts by e / width: over its own length, e length/width. */
    double noise = PLANE_ULPS * DBL_EPSILON * size * (1.0 + longest / (2.0 * facet->area));
    srp_vec3 inwards = srp_vec3_scale(-1.0, facet->normal);
    uint8_t sides = 0;
    if (something_above(scene, blocks, count, a, facet->normal, noise)) {
        sides |= SRP_SIGHT_FRONT;
    }
    if (something_above(scene, blocks, count, a, inwards, noise)) {
        sides |= SRP_SIGHT_BACK;
    }
    return sides;
}

srp_status srp_sight_create(const srp_scene *scene, int threads, uint8_t **out, srp_error *error) {
    size_t count = (scene->vertex_count + BLOCK - 1) / BLOCK;
    block *blocks = malloc((count + 1) * sizeof *blocks);
    uint8_t *sides = malloc(scene->facet_count + 1);
    if (blocks == NULL || sides == NULL) {
        free(blocks);
        free(sides);
        return srp_fail(error, SRP_NO_MEMORY, "no memory for what %zu facets see",
                        scene->facet_count);
    }
    for (size_t k = 0; k < count; ++k) {
        bound_block(scene, k * BLOCK, &blocks[k]);
    }
    double size = srp_vec3_norm(scene->centre) + scene->radius;
#pragma omp parallel for num_threads(threads) schedule(dynamic, 256)
    for (size_t k = 0; k < scene->facet_count; ++k) {
        sides[k] = sides_that_see(scene, blocks, count, &scene->facets[k], size);
    }
    free(blocks);
    *out = sides;
    return SRP_OK;
}
