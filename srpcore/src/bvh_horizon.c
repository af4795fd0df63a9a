/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What a facet cannot see: the largest part of the tree about it of which nothing rises above its
 * plane. Most of a spacecraft is made of convex bodies and flat panels, and a ray that leaves a
 * facet starts inside all the boxes about it; this spares it those that hold nothing but its own
 * surface. All that is left out lies below where such rays start (bvh.h), so that no answer
 * changes.
 */
#include "bvh_internal.h"

#include <stdlib.h>

enum {
    WIDTH = SRP_BVH_WIDTH,
    /* Boxes that are looked at for one side of a facet, at most: then what is known stands. */
    PATIENCE = 200
};

typedef struct exact_box {
    double low[3], high[3];
} exact_box;

/* Of nodes first, blocks behind them. */
typedef struct horizon {
    const srp_bvh *bvh;
    exact_box *box;
    uint32_t *parent; /* node */
} horizon;

/* A facet's plane: heights above it count on one side of it. */
typedef struct outlook {
    double normal[3];
    double level;
    int patience;
} outlook;

static size_t place_of(const srp_bvh *bvh, uint32_t child) {
    size_t index = child & ~SRP_BVH_BLOCK;
    return (child & SRP_BVH_BLOCK) != 0 ? bvh->node_count + index : index;
}

static void measure_block(const srp_bvh *bvh, uint32_t block, exact_box *box) {
    for (size_t lane = 0; lane < WIDTH; ++lane) {
        if (bvh->blocks[block].facet[lane] == SRP_NO_NEIGHBOUR) {
            continue;
        }
        const srp_bvh_triangle *triangle = &bvh->triangles[(size_t)block * WIDTH + lane];
        for (int k = 0; k < 3; ++k) {
            for (int a = 0; a < 3; ++a) {
                box->low[a] = fmin(box->low[a], triangle->v[k][a]);
                box->high[a] = fmax(box->high[a], triangle->v[k][a]);
            }
        }
    }
}

/* Children have higher numbers than their parents. */
static void measure(const horizon *h) {
    const srp_bvh *bvh = h->bvh;
    size_t places = bvh->node_count + bvh->block_count;
    for (size_t i = 0; i < places; ++i) {
        h->box[i] = (exact_box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    }
    for (size_t b = 0; b < bvh->block_count; ++b) {
        measure_block(bvh, (uint32_t)b, &h->box[bvh->node_count + b]);
    }
    for (size_t n = bvh->node_count; n-- > 0;) {
        for (int k = 0; k < WIDTH && bvh->nodes[n].child[k] != 0; ++k) {
            size_t place = place_of(bvh, bvh->nodes[n].child[k]);
            h->parent[place] = (uint32_t)n;
            for (int a = 0; a < 3; ++a) {
                h->box[n].low[a] = fmin(h->box[n].low[a], h->box[place].low[a]);
                h->box[n].high[a] = fmax(h->box[n].high[a], h->box[place].high[a]);
            }
        }
    }
}

static bool box_is_below(const exact_box *box, const outlook *from) {
    double height = 0.0;
    for (int a = 0; a < 3; ++a) {
        double n = from->normal[a];
        height += n * (n > 0.0 ? box->high[a] : box->low[a]);
    }
    return height <= from->level;
}

static bool block_is_below(const srp_bvh *bvh, uint32_t block, const outlook *from) {
    for (size_t lane = 0; lane < WIDTH; ++lane) {
        const srp_bvh_triangle *triangle = &bvh->triangles[(size_t)block * WIDTH + lane];
        for (int k = 0; k < 3 && bvh->blocks[block].facet[lane] != SRP_NO_NEIGHBOUR; ++k) {
            const double *v = triangle->v[k], *n = from->normal;
            if (n[0] * v[0] + n[1] * v[1] + n[2] * v[2] > from->level) {
                return false;
            }
        }
    }
    return true;
}

static bool is_below(const horizon *h, uint32_t child, outlook *from) {
    if (box_is_below(&h->box[place_of(h->bvh, child)], from)) {
        return true;
    }
    if (--from->patience < 0) {
        return false;
    }
    if ((child & SRP_BVH_BLOCK) != 0) {
        return block_is_below(h->bvh, child & ~SRP_BVH_BLOCK, from);
    }
    const srp_bvh_node *node = &h->bvh->nodes[child];
    for (int k = 0; k < WIDTH && node->child[k] != 0; ++k) {
        if (!is_below(h, node->child[k], from)) {
            return false;
        }
    }
    return true;
}

/* The largest part about a block that is below the plane. */
static uint32_t look(const horizon *h, uint32_t block, outlook *from) {
    uint32_t below = SRP_BVH_BLOCK | block;
    if (!is_below(h, below, from)) {
        return SRP_BVH_NOTHING;
    }
    while (below != 0) {
        uint32_t parent = h->parent[place_of(h->bvh, below)];
        const srp_bvh_node *node = &h->bvh->nodes[parent];
        for (int k = 0; k < WIDTH && node->child[k] != 0; ++k) {
            if (node->child[k] != below && !is_below(h, node->child[k], from)) {
                return below;
            }
        }
        below = parent;
    }
    return below;
}

static void look_about(const horizon *h, uint32_t block, size_t lane) {
    const srp_bvh *bvh = h->bvh;
    uint32_t number = bvh->blocks[block].facet[lane];
    const srp_facet *facet = &bvh->scene->facets[number];
    srp_bvh_leaving *leaving = &bvh->leaving[number];
    *leaving = srp_bvh_leaving_of(bvh->scene, &bvh->scale, number);
    srp_vec3 n = facet->normal, on = bvh->scene->vertices[facet->v[0]];
    for (int side = 0; side < 2; ++side) {
        double up = side == 0 ? 1.0 : -1.0;
        outlook from = {.normal = {up * n.x, up * n.y, up * n.z}, .patience = PATIENCE};
        /* Rays start off the plane: half of that, the rest is for rounding. */
        from.level = up * srp_vec3_dot(n, on) + 0.5 * bvh->scale.lift;
        leaving->unseen[side] = look(h, block, &from);
    }
}

bool srp_bvh_find_horizons(srp_bvh *bvh, int threads) {
    size_t places = bvh->node_count + bvh->block_count;
    const horizon h = {bvh, malloc(places * sizeof *h.box), malloc(places * sizeof *h.parent)};
    bool done = h.box != NULL && h.parent != NULL;
    if (done) {
        (void)threads; /* without OpenMP */
        measure(&h);
#pragma omp parallel for schedule(dynamic, 256) num_threads(threads)
        for (size_t block = 0; block < bvh->block_count; ++block) {
            for (size_t lane = 0; lane < WIDTH; ++lane) {
                if (bvh->blocks[block].facet[lane] != SRP_NO_NEIGHBOUR) {
                    look_about(&h, (uint32_t)block, lane);
                }
            }
        }
    }
    free(h.box);
    free(h.parent);
    return done;
}
