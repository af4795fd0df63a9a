/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What the parts of the hierarchy share. Internal to bvh*.c.
 *
 * Two spaces. Decisions are made in body axes, metres, double precision. The search for candidates
 * works in float, in the unit space of the scene: its box, about its centre, scaled by a power of
 * two to within [-1, 1]. What is searched in float errs on the side of more candidates only; each
 * bound on its rounding errors is derived where it is used, in units of U = 2^-24.
 */
#ifndef SRP_SRC_BVH_INTERNAL_H
#define SRP_SRC_BVH_INTERNAL_H

#include "bvh.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SRP_BVH_WIDTH = 8 };

/* Child of a node: a node, or a block of facets. */
#define SRP_BVH_BLOCK 0x80000000u
/* Neither. */
#define SRP_BVH_NOTHING UINT32_MAX

/* Boxes in unit space, padded. An unused child has the number 0, which is the root's. */
typedef struct srp_bvh_node {
    float bound[6][SRP_BVH_WIDTH]; /* lower and upper of x, y, z */
    uint32_t child[SRP_BVH_WIDTH];
} srp_bvh_node;

/* Up to eight facets in unit space. */
typedef struct srp_bvh_block {
    float v[3][3][SRP_BVH_WIDTH]; /* [axis][vertex] */
    float slack[SRP_BVH_WIDTH];   /* of the edge functions; -INFINITY: unused */
    uint32_t facet[SRP_BVH_WIDTH];
} srp_bvh_block;

/* A facet as the decision needs it, side by side with the others of its block. */
typedef struct srp_bvh_triangle {
    double v[3][3]; /* [vertex][axis] [m] */
} srp_bvh_triangle;

/* What rays that leave a facet need to know of it. */
typedef struct srp_bvh_leaving {
    srp_vec3 normal;
    srp_vec3 inner; /* the centre of the circle within [m] */
    double pull;    /* share of the way to there that starts are moved */
    /* Child that they need not visit, in front and behind; or SRP_BVH_NOTHING. */
    uint32_t unseen[2];
} srp_bvh_leaving;

/* A ray on its way, laid out for the tests of facets: Woop, Benthin & Wald, "Watertight
 * Ray/Triangle Intersection", JCGT 2(1), 2013. `z` counts metres along the axis on which the
 * direction is longest. */
typedef struct srp_bvh_path {
    double origin[3];
    int kx, ky, kz;          /* a cyclic order of axes, kz that of the longest component */
    double shear_x, shear_y; /* direction[kx] per_z, the same of ky */
    double sign;             /* of direction[kz] */
    double per_z;            /* 1 / direction[kz] */
    uint32_t from;
    uint32_t unseen; /* child that it need not visit */
} srp_bvh_path;

typedef struct srp_bvh_best {
    double z;       /* of the nearest hit so far [m]; INFINITY: none */
    uint32_t facet; /* SRP_NO_NEIGHBOUR: none */
    bool back;
} srp_bvh_best;

/* How far starts are moved, relative to the mesh: see bvh.h. */
typedef struct srp_bvh_scale {
    double clearance; /* from the edges [m] */
    double lift;      /* off the plane [m] */
} srp_bvh_scale;

struct srp_bvh {
    const srp_scene *scene;
    srp_bvh_scale scale;
    srp_vec3 centre; /* of unit space [m] */
    double unit;     /* metres to unit space: a power of two */
    size_t node_count, block_count;
    srp_bvh_node *nodes; /* the first is the root */
    srp_bvh_block *blocks;
    srp_bvh_triangle *triangles; /* (8 block_count) */
    srp_bvh_leaving *leaving;    /* (facet_count of the scene) */
};

srp_bvh_scale srp_bvh_scale_of(const srp_scene *scene);

/* Where a ray that leaves a facet is started (bvh.h), less its origin. */
static inline srp_vec3 srp_bvh_start_of(const srp_bvh *bvh, const srp_ray *ray) {
    const srp_bvh_leaving *leaving = &bvh->leaving[ray->from];
    double climb = srp_vec3_dot(leaving->normal, ray->direction);
    double lift = copysign(bvh->scale.lift, climb + 0.0); /* -0 is in front */
    srp_vec3 inwards = srp_vec3_sub(leaving->inner, ray->origin);
    return srp_vec3_add_scaled(srp_vec3_scale(leaving->pull, inwards), lift, leaving->normal);
}

/* The ray laid out; its float part is bvh_trace.c's. No branch for the axes: which is longest is
 * anybody's guess. */
static inline srp_bvh_path srp_bvh_path_of(const srp_bvh *bvh, const srp_ray *ray) {
    srp_vec3 origin = ray->origin, direction = ray->direction;
    uint32_t unseen = SRP_BVH_NOTHING;
    if (ray->from != SRP_NO_NEIGHBOUR) {
        const srp_bvh_leaving *leaving = &bvh->leaving[ray->from];
        unseen = leaving->unseen[srp_vec3_dot(leaving->normal, direction) < 0.0];
        origin = srp_vec3_add(origin, srp_bvh_start_of(bvh, ray));
    }
    srp_bvh_path path = {
        .origin = {origin.x, origin.y, origin.z}, .from = ray->from, .unseen = unseen};
    const double d[5] = {direction.x, direction.y, direction.z, direction.x, direction.y};
    double x = fabs(direction.x), y = fabs(direction.y), z = fabs(direction.z);
    int y_over_x = y > x, z_over_x = z > x, z_over_y = z > y;
    int z_longest = z_over_x & z_over_y, y_longest = y_over_x & !z_over_y;
    path.kz = y_longest + 2 * z_longest;
    path.kx = path.kz + 1 - 3 * z_longest;
    path.ky = path.kz + 2 - 3 * (y_longest | z_longest);
    double longest = d[path.kz];
    path.per_z = 1.0 / longest;
    path.shear_x = d[path.kz + 1] * path.per_z;
    path.shear_y = d[path.kz + 2] * path.per_z;
    path.sign = copysign(1.0, longest);
    return path;
}

/* The one function that decides whether a ray hits a facet, other than the one that it leaves;
 * betters *best. */
void srp_bvh_test(const srp_bvh_path *path, const srp_bvh_triangle *triangle, uint32_t facet,
                  srp_bvh_best *best);

/* Takes a facet out of the scene. */
srp_bvh_triangle srp_bvh_triangle_of(const srp_scene *scene, uint32_t facet);

/* The same for rays that leave it; what they cannot see is left open. */
srp_bvh_leaving srp_bvh_leaving_of(const srp_scene *scene, const srp_bvh_scale *scale,
                                   uint32_t facet);

/* What is told of the best hit. False: none. */
bool srp_bvh_finish(const srp_bvh *bvh, const srp_ray *ray, const srp_bvh_path *path,
                    const srp_bvh_best *best, srp_hit *out);

/* ---- building ---- */

/* Boxes are padded by this much of unit space: see bvh_trace.c. */
#define SRP_BVH_PAD 0x1p-19F

typedef struct srp_bvh_box {
    float low[3], high[3];
} srp_bvh_box;

/* A facet while facets are sorted into a tree. */
typedef struct srp_bvh_item {
    srp_bvh_box box; /* unit space, as rounded */
    uint32_t facet;
} srp_bvh_item;

/* Of the binary tree, that is then collapsed: a range of items. The subtree of n items has 2 n - 1
 * places from its root on, some of them unused: where a node lies depends on no thread. */
typedef struct srp_bvh_twig {
    srp_bvh_box box;
    uint32_t first, count;
    uint32_t right; /* the left one follows the node itself; 0: a leaf */
} srp_bvh_twig;

/* Binned surface area heuristic: Wald, "On fast Construction of SAH-based Bounding Volume
 * Hierarchies", 2007. `items` are sorted; twigs (2 count - 1). */
void srp_bvh_split(srp_bvh_item *items, size_t count, int threads, srp_bvh_twig *twigs);

/* Makes nodes and blocks of the tree. False: no memory. */
bool srp_bvh_collapse(srp_bvh *bvh, const srp_bvh_item *items, const srp_bvh_twig *twigs);

/* Room for rounding of the edge functions of a facet of this size, unit space: see bvh_trace.c. */
float srp_bvh_slack(float size);

/* Fills `leaving`. False: no memory. */
bool srp_bvh_find_horizons(srp_bvh *bvh, int threads);

static inline void srp_bvh_box_clear(srp_bvh_box *box) {
    for (int a = 0; a < 3; ++a) {
        box->low[a] = INFINITY;
        box->high[a] = -INFINITY;
    }
}

static inline void srp_bvh_box_join(srp_bvh_box *box, const srp_bvh_box *other) {
    for (int a = 0; a < 3; ++a) {
        box->low[a] = other->low[a] < box->low[a] ? other->low[a] : box->low[a];
        box->high[a] = other->high[a] > box->high[a] ? other->high[a] : box->high[a];
    }
}

/* Half of the surface; 0 for an empty box. */
static inline float srp_bvh_box_area(const srp_bvh_box *box) {
    float x = box->high[0] - box->low[0], y = box->high[1] - box->low[1];
    float z = box->high[2] - box->low[2];
    return x < 0.0F ? 0.0F : x * y + y * z + z * x;
}

#endif
