/* SPDX-License-Identifier: Apache-2.0 */
/* Which facets a region may meet. */
#include "bvh_internal.h"

enum { WIDTH = SRP_BVH_WIDTH };

/* Half-spaces in unit space. */
typedef struct region {
    const srp_bvh *bvh;
    double normal[SRP_HALF_SPACES_MAX][3], level[SRP_HALF_SPACES_MAX];
    size_t count;
} region;

/* Boxes are padded by far more than this can be off. */
static bool misses(const region *where, const srp_bvh_node *node, int child) {
    for (size_t k = 0; k < where->count; ++k) {
        double lowest = 0.0;
        for (int a = 0; a < 3; ++a) {
            double n = where->normal[k][a];
            lowest += n * (double)node->bound[2 * a + (n > 0.0 ? 0 : 1)][child];
        }
        if (lowest > where->level[k]) {
            return true;
        }
    }
    return false;
}

static size_t take_block(const srp_bvh_block *block, uint32_t *facets, size_t count) {
    for (int lane = 0; lane < WIDTH; ++lane) {
        if (block->facet[lane] != SRP_NO_NEIGHBOUR) {
            facets[count++] = block->facet[lane];
        }
    }
    return count;
}

static size_t gather(const region *where, uint32_t index, uint32_t *facets, size_t count) {
    const srp_bvh_node *node = &where->bvh->nodes[index];
    for (int k = 0; k < WIDTH && node->child[k] != 0; ++k) {
        if (misses(where, node, k)) {
            continue;
        }
        uint32_t child = node->child[k];
        count = (child & SRP_BVH_BLOCK) != 0
                    ? take_block(&where->bvh->blocks[child & ~SRP_BVH_BLOCK], facets, count)
                    : gather(where, child, facets, count);
    }
    return count;
}

size_t srp_bvh_gather(const srp_bvh *bvh, const srp_half_space *spaces, size_t count,
                      uint32_t *facets) {
    region where = {.bvh = bvh, .count = count};
    for (size_t k = 0; k < count; ++k) {
        srp_vec3 n = spaces[k].normal;
        where.normal[k][0] = n.x;
        where.normal[k][1] = n.y;
        where.normal[k][2] = n.z;
        where.level[k] = (spaces[k].level - srp_vec3_dot(n, bvh->centre)) * bvh->unit;
    }
    return gather(&where, 0, facets, 0);
}
