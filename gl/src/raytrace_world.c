/* SPDX-License-Identifier: Apache-2.0 */
#include "raytrace_world.h"

#include "bvh_internal.h"
#include "error.h"
#include "sight.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(sizeof(srp_bvh_node) == SRP_GL_NODE_TEXELS * sizeof(srp_gl_texel),
               "nodes are read by the shader as they are");
_Static_assert(sizeof(srp_bvh_block) == SRP_GL_BLOCK_TEXELS * sizeof(srp_gl_texel),
               "blocks are read by the shader as they are");

enum { ONE_SIDED = 4 }; /* beside SRP_SIGHT_... */

/* Distance from the edges that starts of rays are moved to, in unit space, with the same right as
 * SRP_GL_LIFT. */
static const double CLEARANCE = 0x1p-19;

static uint32_t bits_of(double value) {
    float rounded = (float)value;
    uint32_t bits;
    memcpy(&bits, &rounded, sizeof bits);
    return bits;
}

static void write_facet(const srp_bounce_world *world, uint32_t k, srp_gl_texel *out) {
    const srp_scene *scene = world->scene;
    const srp_bvh *bvh = world->bvh;
    const srp_facet *facet = &scene->facets[k];
    const srp_bvh_leaving *leaving = &bvh->leaving[k];
    const srp_optics *optics = &scene->optics[facet->material];
    srp_vec3 inner = srp_vec3_scale(bvh->unit, srp_vec3_sub(leaving->inner, bvh->centre));
    /* Where the processor's share is at its limit, ours is. */
    double pull = leaving->pull * CLEARANCE / (bvh->scale.clearance * bvh->unit);
    const double first[4] = {facet->normal.x, facet->normal.y, facet->normal.z, fmin(pull, 0.25)};
    const double second[4] = {inner.x, inner.y, inner.z, optics->rho_s};
    for (int a = 0; a < 4; ++a) {
        out[0].word[a] = bits_of(first[a]);
        out[1].word[a] = bits_of(second[a]);
    }
    for (int back = 0; back < 2; ++back) {
        out[2].word[back] =
            world->guide != NULL ? srp_guide_index(world->guide, k, back != 0) : SRP_GUIDE_NONE;
    }
    out[2].word[2] = world->sight[k] | (optics->one_sided ? ONE_SIDED : 0U);
    out[2].word[3] = bits_of(optics->rho_d);
}

/* What the search of a child may put aside at most. Children have higher numbers than parents, so
 * that going backwards all of them are known; `need` has one number per node. */
static unsigned deepest_search(const srp_bvh *bvh, unsigned *need) {
    for (size_t n = bvh->node_count; n-- > 0;) {
        unsigned children = 0, most = 0;
        for (int k = 0; k < SRP_BVH_WIDTH && bvh->nodes[n].child[k] != 0; ++k) {
            uint32_t child = bvh->nodes[n].child[k];
            unsigned below = (child & SRP_BVH_BLOCK) != 0 ? 0 : need[child];
            most = below > most ? below : most;
            ++children;
        }
        need[n] = most + (children > 0 ? children - 1 : 0);
    }
    return need[0];
}

static srp_status fill(srp_gl_world *out, srp_error *error) {
    const srp_bounce_world *world = out->world;
    const srp_bvh *bvh = world->bvh;
    size_t maps = world->guide != NULL ? srp_guide_count(world->guide) : 0;
    unsigned *need = malloc(bvh->node_count * sizeof *need);
    out->guide_count = maps > 0 ? maps : 1;
    out->facets = malloc(world->scene->facet_count * SRP_GL_FACET_TEXELS * sizeof *out->facets);
    out->guides = calloc(out->guide_count * SRP_GL_GUIDE_TEXELS, sizeof *out->guides);
    if (need == NULL || out->facets == NULL || out->guides == NULL) {
        free(need);
        return srp_fail(error, SRP_NO_MEMORY, "no memory to lay %zu facets out for OpenGL",
                        world->scene->facet_count);
    }
    out->stack = deepest_search(bvh, need);
    free(need);
    for (size_t k = 0; k < world->scene->facet_count; ++k) {
        write_facet(world, (uint32_t)k, &out->facets[k * SRP_GL_FACET_TEXELS]);
    }
    for (size_t k = 0; k < maps; ++k) {
        memcpy(&out->guides[k * SRP_GL_GUIDE_TEXELS], srp_guide_map(world->guide, k),
               SRP_GUIDE_FLOATS * sizeof(float));
    }
    return SRP_OK;
}

srp_status srp_gl_world_create(const srp_bounce_world *world, srp_gl_world *out, srp_error *error) {
    srp_gl_world made;
    memset(&made, 0, sizeof made);
    made.world = world;
    made.node_count = world->bvh->node_count;
    made.block_count = world->bvh->block_count;
    made.nodes = (const srp_gl_texel *)(const void *)world->bvh->nodes;
    made.blocks = (const srp_gl_texel *)(const void *)world->bvh->blocks;
    made.unit = world->bvh->unit;
    made.centre = world->bvh->centre;
    srp_status status = fill(&made, error);
    if (status != SRP_OK) {
        srp_gl_world_clear(&made);
        return status;
    }
    *out = made;
    return SRP_OK;
}

void srp_gl_world_clear(srp_gl_world *world) {
    free(world->facets);
    free(world->guides);
    memset(world, 0, sizeof *world);
}

static void write_word64(uint32_t *out, uint64_t word) {
    out[0] = (uint32_t)word;
    out[1] = (uint32_t)(word >> 32);
}

void srp_gl_write_points(uint64_t seed, uint32_t reflections, srp_gl_texel *points) {
    memset(points, 0,
           (size_t)reflections * SRP_BOUNCE_COORDINATES * SRP_GL_POINT_TEXELS * sizeof *points);
    for (uint32_t bounces = 0; bounces < reflections; ++bounces) {
        for (int which = 0; which < SRP_BOUNCE_COORDINATES; ++which) {
            uint32_t *out = points->word;
            for (int k = 0; k < 3; ++k) {
                write_word64(out + 2 * k,
                             srp_bounce_point_step(k, bounces, (srp_bounce_coordinate)which));
            }
            for (int group = 0; group < SRP_BOUNCE_GROUPS; ++group) {
                write_word64(
                    out + 8 + 2 * group,
                    srp_bounce_point_base(seed, group, bounces, (srp_bounce_coordinate)which));
            }
            points += SRP_GL_POINT_TEXELS;
        }
    }
}
