/* SPDX-License-Identifier: Apache-2.0 */
#include "bvh_internal.h"
#include "error.h"

#include <stdlib.h>

/* Unit space: the longest half side of the box comes to lie in (1/2, 1]. */
static void choose_unit(srp_bvh *bvh) {
    const srp_scene *scene = bvh->scene;
    srp_vec3 half = srp_vec3_scale(0.5, srp_vec3_sub(scene->box_max, scene->box_min));
    int exponent;
    (void)frexp(fmax(half.x, fmax(half.y, half.z)), &exponent);
    bvh->unit = ldexp(1.0, -exponent);
    bvh->centre = srp_vec3_add(scene->box_min, half);
}

static srp_bvh_item item_of(const srp_bvh *bvh, uint32_t facet) {
    srp_bvh_item item = {.facet = facet};
    srp_bvh_triangle triangle = srp_bvh_triangle_of(bvh->scene, facet);
    const double centre[3] = {bvh->centre.x, bvh->centre.y, bvh->centre.z};
    srp_bvh_box_clear(&item.box);
    for (int k = 0; k < 3; ++k) {
        srp_bvh_box vertex;
        for (int a = 0; a < 3; ++a) {
            vertex.low[a] = vertex.high[a] = (float)((triangle.v[k][a] - centre[a]) * bvh->unit);
        }
        srp_bvh_box_join(&item.box, &vertex);
    }
    return item;
}

/* Sorts the facets and builds the tree over them. False: no memory. */
static bool build(srp_bvh *bvh, int threads) {
    size_t count = bvh->scene->facet_count;
    srp_bvh_item *items = malloc(count * sizeof *items);
    srp_bvh_twig *twigs = calloc(2 * count - 1, sizeof *twigs);
    bool done = false;
    if (items != NULL && twigs != NULL) {
        for (size_t k = 0; k < count; ++k) {
            items[k] = item_of(bvh, (uint32_t)k);
        }
        srp_bvh_split(items, count, threads, twigs);
        done = srp_bvh_collapse(bvh, items, twigs) && srp_bvh_find_horizons(bvh, threads);
    }
    free(items);
    free(twigs);
    return done;
}

srp_status srp_bvh_create(const srp_scene *scene, int threads, srp_bvh **out, srp_error *error) {
    if (scene->facet_count == 0) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "rays need a scene with facets, this has none");
    }
    if (threads < 1) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "%d threads, expected 1 or more", threads);
    }
    /* A child is a number below 2^31, a place in the binary tree one below 2^32. */
    if (scene->facet_count > INT32_MAX) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "%zu facets, expected at most %d",
                        scene->facet_count, INT32_MAX);
    }
    srp_bvh *bvh = calloc(1, sizeof *bvh);
    if (bvh != NULL) {
        bvh->scene = scene;
        bvh->scale = srp_bvh_scale_of(scene);
        choose_unit(bvh);
        if (build(bvh, threads)) {
            *out = bvh;
            return SRP_OK;
        }
    }
    srp_bvh_destroy(bvh);
    return srp_fail(error, SRP_NO_MEMORY, "no memory to order %zu facets for rays",
                    scene->facet_count);
}

void srp_bvh_destroy(srp_bvh *bvh) {
    if (bvh != NULL) {
        free(bvh->nodes);
        free(bvh->blocks);
        free(bvh->triangles);
        free(bvh->leaving);
        free(bvh);
    }
}
