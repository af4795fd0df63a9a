/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Light after its first hit: sampled paths, traced in waves. Internal.
 *
 * A path begins where a sample of a lattice hits a facet first, with the flux of the sample's cell.
 * What it does from there is the estimator of docs/theory.md, "Reflected light":
 *   - as long as it has met mirrors only, the reflected light splits: one specular ray with the
 *     share rho_s, and rays for the share rho_d, `diffuse` many from the first hit, one from
 * others;
 *   - once it has been scattered, one ray goes on with the share rho_s + rho_d, specular with the
 *     probability rho_s / (rho_s + rho_d): one path stays one path;
 *   - after `reflections` bounces it is cut, and its reflected flux counted as unresolved;
 *   - without diffuse rays (single scattering) the share rho_d is left out of it all.
 * The expectation is that of AAS 20-481, Eq. 8, cut after as many bounces.
 *
 * Directions come from low-discrepancy points over the lattice and the rays of a sample together,
 * diffuse ones by importance (guide.h).
 * The lattice is dealt out to SRP_BOUNCE_GROUPS interleaved lattices of four times the pitch whose
 * points are shifted at random one against another: how their sums scatter tells the error.
 */
#ifndef SRP_SRC_BOUNCE_H
#define SRP_SRC_BOUNCE_H

#include "bvh.h"
#include "guide.h"
#include "scene_internal.h"
#include "sight.h"

#include <srp/vec3.h>

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Column and row modulo SRP_BOUNCE_STEP choose the group of a sample. */
enum { SRP_BOUNCE_STEP = 4, SRP_BOUNCE_GROUPS = SRP_BOUNCE_STEP * SRP_BOUNCE_STEP };

/* What light met before the hit that is counted. Purely specular light follows from the geometry of
 * the mirrors alone; it is summed apart so that a solver of mirrored beams can take its place. */
typedef enum srp_bounce_kind {
    SRP_BOUNCE_SPECULAR, /* mirrors only */
    SRP_BOUNCE_DIFFUSE,  /* scattered at least once */
    SRP_BOUNCE_KINDS
} srp_bounce_kind;

typedef struct srp_bounce_sum {
    srp_vec3 f; /* [m^2] */
    srp_vec3 t; /* [m^3] */
} srp_bounce_sum;

typedef struct srp_bounce_sums {
    srp_bounce_sum group[SRP_BOUNCE_GROUPS][SRP_BOUNCE_KINDS];
    double unresolved[SRP_BOUNCE_KINDS]; /* flux of paths that were cut [m^2] */
    uint64_t rays;                       /* traced */
} srp_bounce_sums;

/* Steps of a path, told to tests. */
typedef enum srp_bounce_step {
    SRP_BOUNCE_STARTS,  /* a first hit that reflects */
    SRP_BOUNCE_HITS,    /* a later hit; `push` is what it adds to f */
    SRP_BOUNCE_ESCAPES, /* light that hits nothing more */
    SRP_BOUNCE_IS_CUT   /* light that is not followed after the last bounce */
} srp_bounce_step;

typedef struct srp_bounce_event {
    srp_bounce_step step;
    uint32_t facet;     /* that it hits, or comes from */
    bool back;          /* the side of it */
    double flux;        /* carried; of what is not traced only the specular share is told [m^2] */
    srp_vec3 direction; /* unit, in which it travels */
    srp_vec3 push;      /* [m^2] */
} srp_bounce_event;

/* What paths meet; read-only, shared by all threads. */
typedef struct srp_bounce_world {
    const srp_scene *scene;
    srp_bvh *bvh;
    uint8_t *sight;   /* per facet: sight.h */
    srp_guide *guide; /* of diffuse directions, may be NULL */
    srp_vec3 reference;
    uint32_t reflections, diffuse;
    /* NULL but in tests. */
    void (*watch)(void *user, const srp_bounce_event *event);
    void *user;
} srp_bounce_world;

/* What light meets on this side of a facet. */
static inline srp_optics srp_bounce_optics(const srp_scene *scene, uint32_t facet, bool back) {
    srp_optics optics = scene->optics[scene->facets[facet].material];
    return back && optics.one_sided ? (srp_optics){0.0, 0.0, true} : optics;
}

/* Whether light that leaves this side of a facet is known to hit nothing. */
static inline bool srp_bounce_is_blind(const srp_bounce_world *world, uint32_t facet, bool back) {
    return (world->sight[facet] & (back ? SRP_SIGHT_BACK : SRP_SIGHT_FRONT)) == 0;
}

/* The share of what reaches a facet that is followed from it. */
static inline double srp_bounce_share(const srp_bounce_world *world, srp_optics optics) {
    return optics.rho_s + (world->diffuse > 0 ? optics.rho_d : 0.0);
}

/* Whether light that hits this side of a facet first has a bounce to follow. */
static inline bool srp_bounce_starts(const srp_bounce_world *world, uint32_t facet, bool back) {
    return !srp_bounce_is_blind(world, facet, back) &&
           srp_bounce_share(world, srp_bounce_optics(world->scene, facet, back)) > 0.0;
}

/* Push of a bundle that travels along `direction` on the facet that it hits, `normal` turned to it
 * (docs/theory.md, "Reflected light"). */
static inline srp_vec3 srp_bounce_push(srp_optics optics, srp_vec3 normal, srp_vec3 direction,
                                       double flux) {
    double facing = fabs(srp_vec3_dot(normal, direction));
    double inwards = 2.0 * (optics.rho_s * facing + optics.rho_d / 3.0);
    srp_vec3 push = srp_vec3_scale(1.0 - optics.rho_s, direction);
    return srp_vec3_scale(flux, srp_vec3_add_scaled(push, -inwards, normal));
}

/* Coordinates of a point that a path takes at a bounce: of a scattered direction, and of the choice
 * between mirrored and scattered. */
typedef enum srp_bounce_coordinate {
    SRP_BOUNCE_ACROSS,
    SRP_BOUNCE_AROUND,
    SRP_BOUNCE_CHOICE,
    SRP_BOUNCE_COORDINATES
} srp_bounce_coordinate;

/* Such a coordinate is base + (i / SRP_BOUNCE_STEP) step[0] + (j / SRP_BOUNCE_STEP) step[1] +
 * ray step[2] in units of 2^-64, modulo 1; for devices that compute it by themselves. `bounces`:
 * behind the path. */
uint64_t srp_bounce_point_base(uint64_t seed, int group, uint32_t bounces,
                               srp_bounce_coordinate which);
uint64_t srp_bounce_point_step(int k, uint32_t bounces, srp_bounce_coordinate which);

/* Of a sample. */
static inline int srp_bounce_group_of(int32_t i, int32_t j) {
    return (j % SRP_BOUNCE_STEP) * SRP_BOUNCE_STEP + i % SRP_BOUNCE_STEP;
}

typedef struct srp_bounce_path srp_bounce_path;

/* Rays on their way, those of one bounce together. One per thread; a zeroed struct is a fresh one.
 */
typedef struct srp_bounce_wave {
    const srp_bounce_world *world;
    srp_bounce_sums *sums;
    uint64_t seed;
    size_t start_limit; /* rays of the first bounce that fill it */
    size_t capacity, count, next_count;
    srp_ray *rays, *next_rays;
    srp_bounce_path *paths, *next_paths;
    srp_hit *hits;
} srp_bounce_wave;

/* Makes it ready to add to `sums`; `seed` decides all that is random. False when there is no
 * memory. */
bool srp_bounce_wave_begin(srp_bounce_wave *wave, const srp_bounce_world *world, uint64_t seed,
                           srp_bounce_sums *sums);
void srp_bounce_wave_clear(srp_bounce_wave *wave);

/* The first hit of one sample. */
typedef struct srp_bounce_start {
    int32_t i, j; /* of the lattice */
    double flux;  /* of its cell [m^2] */
    srp_vec3 point, direction;
    uint32_t facet;
    bool back;
} srp_bounce_start;

/* Adds the paths of a first hit; traces when the wave is full. */
void srp_bounce_wave_start(srp_bounce_wave *wave, const srp_bounce_start *start);
/* Traces what is left. */
void srp_bounce_wave_finish(srp_bounce_wave *wave);

/* Adds `from`. */
void srp_bounce_sums_add(srp_bounce_sums *into, const srp_bounce_sums *from);
/* What light of one kind adds to f and t. */
srp_bounce_sum srp_bounce_sums_total(const srp_bounce_sums *sums, srp_bounce_kind kind);
/* Of the groups, the share in which no light of this kind has landed. */
double srp_bounce_sums_dark(const srp_bounce_sums *sums, srp_bounce_kind kind);
/* Adds the variances of f and t of that, summed over axes. `turned`: the lattice was shifted at
 * random against the model. */
void srp_bounce_sums_variance(const srp_bounce_sums *sums, srp_bounce_kind kind, bool turned,
                              double *f_variance, double *t_variance);

#endif
