/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The binary tree made into one of width 8, optimally: Ylitie, Karras & Laine, "Efficient
 * Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017, section 3. cost[i] of a
 * twig is the least expected cost of its facets when they hang as at most i + 1 children on some
 * node above it (their Eq. 1 to 5). Departures: leaves are blocks of one cost, however full.
 */
#include "bvh_internal.h"
#include "platform.h"

#include <stdlib.h>
#include <string.h>

enum { WIDTH = SRP_BVH_WIDTH, NO_SPLIT = 0 };

/* What a visit costs, in units of a node's; measured. */
static const float NODE_COST = 1.0F, BLOCK_COST = 1.5F;

typedef struct plan {
    float cost[WIDTH - 1];    /* [i]: as at most i + 1 children */
    uint8_t split[WIDTH - 1]; /* [i]: children that the left part gets; NO_SPLIT: as with fewer */
    uint8_t node_split;       /* the same when the twig is a node of its own */
} plan;

/* Least cost of a twig's two parts as `children` together; *left those of the left part. */
static float distribute(const plan *a, const plan *b, int children, uint8_t *left) {
    float best = INFINITY;
    for (int k = 1; k < children; ++k) {
        float cost = a->cost[k - 1] + b->cost[children - k - 1];
        if (cost < best) {
            best = cost;
            *left = (uint8_t)k;
        }
    }
    return best;
}

static void plan_twig(const srp_bvh_twig *twigs, plan *plans, size_t at) {
    const srp_bvh_twig *twig = &twigs[at];
    plan *own = &plans[at];
    float area = srp_bvh_box_area(&twig->box);
    if (twig->right == 0) {
        for (int i = 0; i < WIDTH - 1; ++i) {
            own->cost[i] = BLOCK_COST * area;
            own->split[i] = NO_SPLIT;
        }
        return;
    }
    const plan *a = &plans[at + 1], *b = &plans[twig->right];
    own->cost[0] = NODE_COST * area + distribute(a, b, WIDTH, &own->node_split);
    own->split[0] = NO_SPLIT;
    for (int i = 1; i < WIDTH - 1; ++i) {
        uint8_t left = 0;
        float cost = distribute(a, b, i + 1, &left);
        bool better = cost < own->cost[i - 1];
        own->cost[i] = better ? cost : own->cost[i - 1];
        own->split[i] = better ? left : NO_SPLIT;
    }
}

/* ---- nodes and blocks ---- */

typedef struct collapse {
    srp_bvh *bvh;
    const srp_bvh_item *items;
    const srp_bvh_twig *twigs;
    const plan *plans;
} collapse;

/* The twigs that hang on a node as at most `children` of it; appends to list. */
static void gather(const collapse *c, uint32_t at, int children, uint32_t *list, int *count) {
    const plan *own = &c->plans[at];
    while (children > 1 && own->split[children - 1] == NO_SPLIT) {
        --children;
    }
    if (children == 1) {
        list[(*count)++] = at;
        return;
    }
    int left = own->split[children - 1];
    gather(c, at + 1, left, list, count);
    gather(c, c->twigs[at].right, children - left, list, count);
}

static void fill_block(const collapse *c, const srp_bvh_twig *twig, uint32_t block) {
    const srp_bvh *bvh = c->bvh;
    srp_bvh_block *out = &bvh->blocks[block];
    memset(out, 0, sizeof *out);
    for (uint32_t lane = 0; lane < WIDTH; ++lane) {
        srp_bvh_triangle *triangle = &bvh->triangles[(size_t)block * WIDTH + lane];
        if (lane >= twig->count) {
            memset(triangle, 0, sizeof *triangle);
            out->facet[lane] = SRP_NO_NEIGHBOUR;
            out->slack[lane] = -INFINITY;
            continue;
        }
        const srp_bvh_item *item = &c->items[twig->first + lane];
        *triangle = srp_bvh_triangle_of(bvh->scene, item->facet);
        const double centre[3] = {bvh->centre.x, bvh->centre.y, bvh->centre.z};
        float longest = 0.0F;
        for (int a = 0; a < 3; ++a) {
            for (int k = 0; k < 3; ++k) {
                out->v[a][k][lane] = (float)((triangle->v[k][a] - centre[a]) * bvh->unit);
            }
            longest = fmaxf(longest, item->box.high[a] - item->box.low[a]);
        }
        out->slack[lane] = srp_bvh_slack(longest);
        out->facet[lane] = item->facet;
    }
}

static uint32_t emit(const collapse *c, uint32_t at);

/* Fills the node that was set aside for the twig. */
static void fill_node(const collapse *c, uint32_t at, uint32_t node) {
    const srp_bvh_twig *twig = &c->twigs[at];
    uint32_t list[WIDTH];
    int count = 0;
    if (twig->right == 0) {
        list[count++] = at; /* only the root: a scene of one block */
    } else {
        int left = c->plans[at].node_split;
        gather(c, at + 1, left, list, &count);
        gather(c, twig->right, WIDTH - left, list, &count);
    }
    srp_bvh_node *out = &c->bvh->nodes[node];
    for (int k = 0; k < WIDTH; ++k) {
        /* An unused one is a point at infinity, which lies behind all that is finite. */
        const srp_bvh_box *box = k < count ? &c->twigs[list[k]].box : NULL;
        for (int a = 0; a < 3; ++a) {
            float none = a == 0 ? INFINITY : 0.0F;
            out->bound[2 * a][k] = box == NULL ? none : box->low[a] - SRP_BVH_PAD;
            out->bound[2 * a + 1][k] = box == NULL ? none : box->high[a] + SRP_BVH_PAD;
        }
        out->child[k] = 0;
    }
    for (int k = 0; k < count; ++k) {
        /* Not out->...: the call may not move nodes, but takes new ones. */
        c->bvh->nodes[node].child[k] = emit(c, list[k]);
    }
}

static uint32_t emit(const collapse *c, uint32_t at) {
    if (c->twigs[at].right == 0) {
        uint32_t block = (uint32_t)c->bvh->block_count++;
        fill_block(c, &c->twigs[at], block);
        return SRP_BVH_BLOCK | block;
    }
    uint32_t node = (uint32_t)c->bvh->node_count++;
    fill_node(c, at, node);
    return node;
}

bool srp_bvh_collapse(srp_bvh *bvh, const srp_bvh_item *items, const srp_bvh_twig *twigs) {
    size_t places = 2 * bvh->scene->facet_count - 1, leaves = 0;
    plan *plans = malloc(places * sizeof *plans);
    if (plans == NULL) {
        return false;
    }
    for (size_t at = places; at-- > 0;) {
        if (twigs[at].count > 0) {
            plan_twig(twigs, plans, at);
            leaves += twigs[at].right == 0;
        }
    }
    /* Every node but the root's has at least two children. */
    bvh->nodes = srp_platform_allocate_table(leaves * sizeof *bvh->nodes);
    bvh->blocks = srp_platform_allocate_table(leaves * sizeof *bvh->blocks);
    bvh->triangles = srp_platform_allocate_table(leaves * WIDTH * sizeof *bvh->triangles);
    bvh->leaving = srp_platform_allocate_table(bvh->scene->facet_count * sizeof *bvh->leaving);
    bool done =
        bvh->nodes != NULL && bvh->blocks != NULL && bvh->triangles != NULL && bvh->leaving != NULL;
    if (done) {
        const collapse c = {bvh, items, twigs, plans};
        bvh->node_count = 1;
        fill_node(&c, 0, 0);
    }
    free(plans);
    return done;
}
