/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The search for facets that a ray may hit.
 *
 * In unit space and float, with room for rounding (U = 2^-24), so that every facet which the
 * decision in double (bvh_facet.c) would accept comes to it. The ray starts within 3/2 of the unit
 * box's half side, or is moved along itself to there.
 *
 * Boxes: a bound's distance is b * (1/d) - o * (1/d). In units of length, a bound is off by 2 U,
 * 1/d by 2 U of the 2.5 between start and bound, the start by 1.5 U, the products by 2.5 U, the
 * difference by 2.5 U, the nearest hit so far by 4 U: less than 32 U = 2^-19 of padding in all.
 *
 * Edges: a coordinate less the ray's is off by at most 6 U, sheared by less than 20 U: D = 32 U.
 * Where the ray passes a facet of size m, the vertices lie within 2 m + D of it, and an edge
 * function is off by less than 4 D (2 m + D) + 2 D^2 plus its own rounding: 16 D (m + D).
 */
#include "bvh_internal.h"
#include "clones.h"

#include <float.h>
#include <string.h>

enum {
    WIDTH = SRP_BVH_WIDTH,
    STACK = (WIDTH - 1) * 100 + WIDTH, /* for the deepest tree there is */
    SHORT_STACK = 24,                  /* for nearly all rays */
    AHEAD = 8,                         /* rays started before one whose facet is asked for */
    LANES = 64                         /* rays on their way at a time */
};

typedef struct float_ray {
    float inverse[3], origin_inverse[3]; /* 1 / d, o / d; d of length 1 along its longest axis */
    float shear_x, shear_y;
    float sheared_x, sheared_y; /* the start, sheared */
    float z, up, down;          /* start along kz; 1 and 0 when the ray goes up it, else 0 and 1 */
    uint32_t near[3];           /* bound of a box that it meets first, of each axis */
    uint32_t unseen;            /* child that it need not visit */
    float nearest;              /* hit so far; FLT_MAX: none */
    double advance;             /* of the start along kz, unit space */
} float_ray;

float srp_bvh_slack(float size) {
    const float d = 0x1p-19F;
    return 16.0F * d * (size + d);
}

/* ---- rays ---- */

/* Where a ray from afar comes near the box, in distance along its longest axis; INFINITY: it does
 * not. */
static double approach(const double o[3], const double d[3]) {
    const double reach = 1.25;
    double from = 0.0, to = INFINITY;
    for (int a = 0; a < 3; ++a) {
        double t0 = (-reach - o[a]) / d[a], t1 = (reach - o[a]) / d[a];
        from = fmax(from, fmin(t0, t1));
        to = fmin(to, fmax(t0, t1));
    }
    return from <= to ? from : INFINITY;
}

/* False: the ray hits nothing. */
SRP_CLONE_PART bool aim(const srp_bvh *bvh, srp_vec3 along, const srp_bvh_path *path,
                        float_ray *ray) {
    const double centre[3] = {bvh->centre.x, bvh->centre.y, bvh->centre.z};
    const double direction[3] = {along.x, along.y, along.z};
    const double per_length = fabs(path->per_z);
    double o[3], d[3];
    double farthest = 0.0;
    for (int a = 0; a < 3; ++a) {
        o[a] = (path->origin[a] - centre[a]) * bvh->unit;
        d[a] = direction[a] * per_length;
        farthest = fabs(o[a]) > farthest ? fabs(o[a]) : farthest;
    }
    ray->unseen = path->unseen;
    if (ray->unseen == 0) {
        return false;
    }
    ray->advance = 0.0;
    ray->nearest = FLT_MAX;
    if (farthest > 1.5) {
        ray->advance = approach(o, d);
        if (!(ray->advance < INFINITY)) {
            return false;
        }
        for (int a = 0; a < 3; ++a) {
            o[a] += ray->advance * d[a];
        }
    }
    for (int a = 0; a < 3; ++a) {
        /* Off by less than U for as long as the ray is in the box. */
        double tiny = d[a] < 0.0 ? -0x1p-40 : 0x1p-40;
        d[a] = fabs(d[a]) < 0x1p-40 ? tiny : d[a];
        ray->inverse[a] = 1.0F / (float)d[a];
        ray->origin_inverse[a] = (float)o[a] * ray->inverse[a];
        ray->near[a] = 2 * (uint32_t)a + (d[a] < 0.0);
    }
    ray->shear_x = (float)path->shear_x;
    ray->shear_y = (float)path->shear_y;
    ray->sheared_x = (float)(o[path->kx] - path->shear_x * o[path->kz]);
    ray->sheared_y = (float)(o[path->ky] - path->shear_y * o[path->kz]);
    ray->z = (float)o[path->kz];
    ray->up = 0.5F + 0.5F * (float)path->sign;
    ray->down = 1.0F - ray->up;
    return true;
}

/* ---- candidates ---- */

static const uint32_t BIT[WIDTH] = {1, 2, 4, 8, 16, 32, 64, 128};

SRP_CLONE_PART float least(float a, float b) {
    return a < b ? a : b;
}

SRP_CLONE_PART float most(float a, float b) {
    return a > b ? a : b;
}

/* Children whose boxes the ray meets before its nearest hit, as bits, and their keys. */
SRP_CLONE_PART uint32_t find_children(const srp_bvh_node *node, const float_ray *ray,
                                      uint64_t *restrict keys) {
    const float ix = ray->inverse[0], ox = ray->origin_inverse[0];
    const float iy = ray->inverse[1], oy = ray->origin_inverse[1];
    const float iz = ray->inverse[2], oz = ray->origin_inverse[2];
    const float *x0 = node->bound[ray->near[0]], *x1 = node->bound[ray->near[0] ^ 1];
    const float *y0 = node->bound[ray->near[1]], *y1 = node->bound[ray->near[1] ^ 1];
    const float *z0 = node->bound[ray->near[2]], *z1 = node->bound[ray->near[2] ^ 1];
    const float nearest = ray->nearest;
    const uint32_t unseen = ray->unseen;
    float meets[WIDTH];
    uint32_t bits = 0;
    for (int k = 0; k < WIDTH; ++k) {
        float in = most(most(x0[k] * ix - ox, y0[k] * iy - oy), most(z0[k] * iz - oz, 0.0F));
        float out = least(least(x1[k] * ix - ox, y1[k] * iy - oy), least(z1[k] * iz - oz, nearest));
        meets[k] = in;
        bits |= ((in <= out) & (node->child[k] != unseen)) ? BIT[k] : 0;
    }
    uint32_t order[WIDTH];
    memcpy(order, meets, sizeof order);
    for (int k = 0; k < WIDTH; ++k) {
        keys[k] = (uint64_t)order[k] << 32 | node->child[k];
    }
    return bits;
}

/* Facets of a block that the ray may hit before `best`, as bits. */
SRP_CLONE_PART uint32_t find_facets(const srp_bvh_block *block, const srp_bvh_path *path,
                                    const float_ray *ray) {
    const float(*x)[WIDTH] = block->v[path->kx], (*y)[WIDTH] = block->v[path->ky];
    const float(*z)[WIDTH] = block->v[path->kz];
    const float sx = ray->shear_x, sy = ray->shear_y, ox = ray->sheared_x, oy = ray->sheared_y;
    /* What the start and the nearest hit are off by. */
    const float slack = 0x1p-20F;
    const float low = ray->z - slack - ray->nearest * ray->down;
    const float high = ray->z + slack + ray->nearest * ray->up;
    uint32_t bits = 0;
    for (int k = 0; k < WIDTH; ++k) {
        float ax = x[0][k] - sx * z[0][k] - ox, ay = y[0][k] - sy * z[0][k] - oy;
        float bx = x[1][k] - sx * z[1][k] - ox, by = y[1][k] - sy * z[1][k] - oy;
        float cx = x[2][k] - sx * z[2][k] - ox, cy = y[2][k] - sy * z[2][k] - oy;
        float u = bx * cy - by * cx, v = cx * ay - cy * ax, w = ax * by - ay * bx;
        /* Not short-circuited: no branches. */
        int positive = least(u, least(v, w)) >= -block->slack[k];
        int negative = most(u, most(v, w)) <= block->slack[k];
        int ahead = most(z[0][k], most(z[1][k], z[2][k])) >= low;
        int nearer = least(z[0][k], least(z[1][k], z[2][k])) <= high;
        int other = block->facet[k] != path->from;
        bits |= ((positive | negative) & ahead & nearer & other) != 0 ? BIT[k] : 0;
    }
    return bits;
}

/* ---- search ---- */

/*
 * What is still to be visited: keys of which the upper half is where the ray meets the box (floats
 * that are not negative sort as integers do) and the lower half the child. The nearest lies on top,
 * under all the key 0, which stands for the end.
 */
#define CHILD_OF(key) ((uint32_t)(key))

SRP_CLONE_PART float meets_of(uint64_t key) {
    uint32_t bits = (uint32_t)(key >> 32);
    float meets;
    memcpy(&meets, &bits, sizeof meets);
    return meets;
}

SRP_CLONE_PART uint32_t lowest_bit(uint32_t bits) {
#if defined(__GNUC__)
    return (uint32_t)__builtin_ctz(bits);
#else
    uint32_t k = 0;
    while ((bits >> k & 1) == 0) {
        ++k;
    }
    return k;
#endif
}

/* Pushes the children of a node that the ray meets. Nearly always they are two at most, which takes
 * no branch: processors cannot guess how many a ray meets. */
SRP_CLONE_PART uint64_t *visit_node(const srp_bvh_node *node, const float_ray *ray, uint64_t *top) {
    uint64_t keys[WIDTH + 1];
    uint32_t bits = find_children(node, ray, keys);
    keys[WIDTH] = 0;
    uint32_t others = bits & (bits - 1);
    /* A child that is none has the key 0 and comes last. */
    uint64_t a = keys[lowest_bit(bits | 1U << WIDTH)], b = keys[lowest_bit(others | 1U << WIDTH)];
    top[0] = a > b ? a : b;
    top[1] = a > b ? b : a;
    uint64_t *bottom = top;
    top += (bits != 0) + (others != 0);
    for (bits = others & (others - 1); bits != 0; bits &= bits - 1) {
        uint64_t key = keys[lowest_bit(bits)];
        uint64_t *place = top++;
        for (; place > bottom && place[-1] < key; --place) {
            *place = place[-1];
        }
        *place = key;
    }
    return top;
}

/* Decides about candidates of a block. */
SRP_CLONE_PART void test_facets(const srp_bvh *bvh, uint32_t block, uint32_t bits,
                                const srp_bvh_path *path, float_ray *ray, srp_bvh_best *best) {
    const srp_bvh_block *facets = &bvh->blocks[block];
    for (; bits != 0; bits &= bits - 1) {
        uint32_t k = lowest_bit(bits);
        srp_bvh_test(path, &bvh->triangles[(size_t)block * WIDTH + k], facets->facet[k], best);
        /* Not below 0, which is where the key 0 lies; and finite without a hit. */
        float nearest = (float)(best->z * bvh->unit - ray->advance);
        ray->nearest = most(least(nearest, FLT_MAX), 0.0F);
    }
}

/* Takes the next key that is not beyond the nearest hit. */
SRP_CLONE_PART uint64_t pop(uint64_t **top, float nearest) {
    uint64_t key;
    do {
        key = *--*top;
    } while (meets_of(key) > nearest);
    return key;
}

/* Visits what is on the stack, until it is empty. */
SRP_CLONE_PART void search(const srp_bvh *bvh, const srp_bvh_path *path, float_ray *ray,
                           srp_bvh_best *best, uint64_t *top, uint64_t key) {
    for (;;) {
        if ((CHILD_OF(key) & SRP_BVH_BLOCK) == 0) {
            top = visit_node(&bvh->nodes[CHILD_OF(key)], ray, top);
        } else {
            uint32_t block = CHILD_OF(key) & ~SRP_BVH_BLOCK;
            uint32_t bits = find_facets(&bvh->blocks[block], path, ray);
            test_facets(bvh, block, bits, path, ray, best);
        }
        key = pop(&top, ray->nearest);
        if (key == 0) {
            return;
        }
    }
}

SRP_CLONE_PART void search_one(const srp_bvh *bvh, const srp_bvh_path *path, float_ray *ray,
                               srp_bvh_best *best) {
    uint64_t stack[STACK];
    stack[0] = 0;
    search(bvh, path, ray, best, stack + 1, 0);
}

SRP_TARGET_CLONES
bool srp_bvh_hit(const srp_bvh *bvh, srp_vec3 origin, srp_vec3 direction, uint32_t from,
                 srp_hit *out) {
    const srp_ray given = {origin, direction, from};
    srp_bvh_path path = srp_bvh_path_of(bvh, &given);
    srp_bvh_best best = {INFINITY, SRP_NO_NEIGHBOUR, false};
    float_ray ray;
    if (aim(bvh, direction, &path, &ray)) {
        search_one(bvh, &path, &ray, &best);
    }
    return srp_bvh_finish(bvh, &given, &path, &best, out);
}

/* ---- many rays ---- */

/*
 * A search is a chain of visits, each waiting for the one before, and which kind comes next is a
 * coin toss. So several rays are under way at a time, and all that wait for a node are served in a
 * row, then all that wait for a block: visits in a row do not depend on each other, and the
 * processor overlaps them.
 */
typedef struct lane {
    float_ray ray;
    uint32_t depth; /* keys on the stack */
    uint32_t found; /* candidates in the block to be visited, as bits */
    uint64_t key;   /* to be visited next */
    srp_bvh_path path;
    srp_bvh_best best;
    size_t index; /* of the ray */
    uint64_t stack[SHORT_STACK];
} lane;

typedef struct stream {
    const srp_bvh *bvh;
    size_t count, next; /* rays, and those that have started */
    const srp_ray *rays;
    srp_hit *hits;
    /* Lanes by what they wait for: a node, a block, facets, a ray. */
    uint32_t nodes, blocks, tests, idle;
    uint16_t node_list[LANES + 1], block_list[LANES + 1], test_list[LANES + 1],
        idle_list[LANES + 1];
    lane lanes[LANES];
} stream;

/* Has memory brought near that is needed soon. */
SRP_CLONE_PART void fetch(const void *memory, size_t size) {
#if defined(__GNUC__)
    for (size_t byte = 0; byte < size; byte += 64) {
        __builtin_prefetch((const char *)memory + byte);
    }
    __builtin_prefetch((const char *)memory + size - 1);
#else
    (void)memory, (void)size;
#endif
}

/* Puts a lane on the list of what it waits for. */
SRP_CLONE_PART void enlist(stream *s, uint16_t id) {
    uint64_t key = s->lanes[id].key;
    bool block = (CHILD_OF(key) & SRP_BVH_BLOCK) != 0, idle = key == 0;
    s->node_list[s->nodes] = id;
    s->block_list[s->blocks] = id;
    s->idle_list[s->idle] = id;
    s->nodes += !block & !idle;
    s->blocks += block;
    s->idle += idle;
}

/* Tells what the ray of an idle lane has hit, if it had one. */
SRP_CLONE_PART void finish_lane(stream *s, lane *own) {
    if (own->index < s->count) {
        srp_hit *hit = &s->hits[own->index];
        hit->facet = SRP_NO_NEIGHBOUR;
        (void)srp_bvh_finish(s->bvh, &s->rays[own->index], &own->path, &own->best, hit);
        own->index = SIZE_MAX;
    }
}

/* Gives idle lanes the next rays, and visits the root, where all begin. */
SRP_CLONE_PART void start_lanes(stream *s) {
    uint32_t idle = s->idle;
    while (idle > 0 && s->next < s->count) {
        uint16_t id = s->idle_list[--idle];
        lane *own = &s->lanes[id];
        finish_lane(s, own);
        const srp_ray *ray = &s->rays[s->next];
        size_t left = s->count - s->next;
        fetch(ray + (left > 3 * AHEAD ? 3 * AHEAD : 0), sizeof *ray);
        const srp_ray *ahead = ray + (left > AHEAD ? AHEAD : 0);
        if (ahead->from != SRP_NO_NEIGHBOUR) {
            fetch(&s->bvh->leaving[ahead->from], sizeof *s->bvh->leaving);
        }
        own->index = s->next++;
        own->path = srp_bvh_path_of(s->bvh, ray);
        own->best = (srp_bvh_best){INFINITY, SRP_NO_NEIGHBOUR, false};
        own->stack[0] = 0;
        uint64_t *top = own->stack + 1;
        if (aim(s->bvh, ray->direction, &own->path, &own->ray)) {
            top = visit_node(&s->bvh->nodes[0], &own->ray, top);
        }
        own->key = *--top;
        own->depth = (uint32_t)(top - own->stack);
        if (own->key == 0) {
            s->idle_list[idle++] = id;
        } else {
            s->idle = idle; /* enlist() writes behind the idle ones */
            enlist(s, id);
        }
    }
    s->idle = idle;
}

/* Ends the search of a lane whose stack is too short for it. */
static void search_deep(const srp_bvh *bvh, lane *own) {
    uint64_t stack[STACK];
    memcpy(stack, own->stack, own->depth * sizeof *stack);
    search(bvh, &own->path, &own->ray, &own->best, stack + own->depth, own->key);
    own->key = 0;
    own->depth = 0;
}

/* Takes the next key from the lane's stack, which has its top there. */
SRP_CLONE_PART void advance(stream *s, uint16_t id, uint64_t *top) {
    lane *own = &s->lanes[id];
    own->key = pop(&top, own->ray.nearest);
    own->depth = (uint32_t)(top - own->stack);
    enlist(s, id);
}

SRP_CLONE_PART void visit_nodes(stream *s) {
    uint32_t count = s->nodes;
    s->nodes = 0;
    for (uint32_t i = 0; i < count; ++i) {
        uint16_t id = s->node_list[i];
        lane *own = &s->lanes[id];
        const srp_bvh_node *node = &s->bvh->nodes[CHILD_OF(own->key)];
        if (own->depth + WIDTH > SHORT_STACK) {
            search_deep(s->bvh, own);
        } else {
            advance(s, id, visit_node(node, &own->ray, own->stack + own->depth));
            continue;
        }
        enlist(s, id);
    }
}

/* Blocks lie in memory as they may: all are asked for before the first is waited for. */
SRP_CLONE_PART void visit_blocks(stream *s) {
    const srp_bvh *bvh = s->bvh;
    uint32_t count = s->blocks;
    for (uint32_t i = 0; i < count; ++i) {
        uint64_t key = s->lanes[s->block_list[i]].key;
        fetch(&bvh->blocks[CHILD_OF(key) & ~SRP_BVH_BLOCK], sizeof *bvh->blocks);
    }
    s->blocks = 0;
    for (uint32_t i = 0; i < count; ++i) {
        uint16_t id = s->block_list[i];
        lane *own = &s->lanes[id];
        uint32_t block = CHILD_OF(own->key) & ~SRP_BVH_BLOCK;
        own->found = find_facets(&bvh->blocks[block], &own->path, &own->ray);
        if (own->found == 0) {
            advance(s, id, own->stack + own->depth);
        } else {
            fetch(&bvh->triangles[(size_t)block * WIDTH + lowest_bit(own->found)],
                  sizeof *bvh->triangles);
            s->test_list[s->tests++] = id;
        }
    }
}

/* Candidates found the round before. */
SRP_CLONE_PART void visit_facets(stream *s) {
    uint32_t count = s->tests;
    s->tests = 0;
    for (uint32_t i = 0; i < count; ++i) {
        uint16_t id = s->test_list[i];
        lane *own = &s->lanes[id];
        test_facets(s->bvh, CHILD_OF(own->key) & ~SRP_BVH_BLOCK, own->found, &own->path, &own->ray,
                    &own->best);
        if (own->best.facet != SRP_NO_NEIGHBOUR) {
            fetch(&s->bvh->leaving[own->best.facet], sizeof *s->bvh->leaving);
        }
        advance(s, id, own->stack + own->depth);
    }
}

SRP_TARGET_CLONES
static void run_stream(stream *s) {
    for (;;) {
        if (s->next < s->count && s->idle > 0) {
            start_lanes(s);
        }
        if (s->nodes + s->blocks + s->tests == 0) {
            break;
        }
        visit_nodes(s);
        visit_facets(s);
        visit_blocks(s);
    }
    for (size_t id = 0; id < LANES; ++id) {
        finish_lane(s, &s->lanes[id]);
    }
}

void srp_bvh_hit_many(const srp_bvh *bvh, size_t count, const srp_ray *rays, srp_hit *hits) {
    stream s; /* large: only what is read is set */
    s.bvh = bvh;
    s.count = count;
    s.next = 0;
    s.rays = rays;
    s.hits = hits;
    s.nodes = s.blocks = s.tests = 0;
    for (uint16_t id = 0; id < LANES; ++id) {
        s.idle_list[id] = id;
        s.lanes[id].index = SIZE_MAX;
    }
    s.idle = LANES;
    run_stream(&s);
}
