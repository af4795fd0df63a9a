/* SPDX-License-Identifier: Apache-2.0 */
/* The scene as the compute shader bounce.comp.glsl reads it. Internal. */
#ifndef SRP_GL_SRC_RAYTRACE_WORLD_H
#define SRP_GL_SRC_RAYTRACE_WORLD_H

#include "bounce.h"

#include <srp/status.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Four words as a texture or a storage buffer holds them; floats by their bits. */
typedef struct srp_gl_texel {
    uint32_t word[4];
} srp_gl_texel;

enum {
    SRP_GL_NODE_TEXELS = 14,
    SRP_GL_BLOCK_TEXELS = 22,
    SRP_GL_FACET_TEXELS = 3,
    SRP_GL_GUIDE_TEXELS = 21,
    SRP_GL_POINT_TEXELS = 10, /* per coordinate of a bounce */
    SRP_GL_SAMPLE_TEXELS = 2
};

/* The hierarchy, the facets and the guides of a world; read-only, shared by all contexts. */
typedef struct srp_gl_world {
    const srp_bounce_world *world;
    size_t node_count, block_count, guide_count; /* guides: at least 1 */
    const srp_gl_texel *nodes, *blocks;          /* those of the processor */
    srp_gl_texel *facets, *guides;
    unsigned stack; /* numbers that the deepest search puts aside */
    double unit;    /* metres to unit space */
    srp_vec3 centre;
} srp_gl_world;

/* SRP_NO_MEMORY. `world` has a hierarchy and outlives the result. */
SRP_CHECK srp_status srp_gl_world_create(const srp_bounce_world *world, srp_gl_world *out,
                                         srp_error *error);
/* A zeroed one is empty. */
void srp_gl_world_clear(srp_gl_world *world);

/* How far starts of rays are moved off their facet's plane, in unit space: float knows places to
 * 2^-24, and what is added up on the way there is some times that. */
#define SRP_GL_LIFT 0x1p-20

/* The points of all bounces of a direction: (reflections x SRP_BOUNCE_COORDINATES) x
 * SRP_GL_POINT_TEXELS. */
void srp_gl_write_points(uint64_t seed, uint32_t reflections, srp_gl_texel *points);

#endif
