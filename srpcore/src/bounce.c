/* SPDX-License-Identifier: Apache-2.0 */
/* Formulas: docs/theory.md. AAS 20-481, Eq. 8 and Algorithm 2 with the departures named there. */
#include "bounce.h"

#include "seed.h"
#include "sight.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rays of a wave over all its bounces, unless one sample alone has more. */
enum { WAVE_RAYS = 8192 };

struct srp_bounce_path {
    double flux;  /* carried [m^2] */
    int32_t i, j; /* the sample it comes from */
    uint32_t ray; /* number among those of the sample's first hit */
    srp_bounce_kind kind;
};

/* Light that reaches a facet. */
typedef struct arrival {
    const srp_bounce_path *path;
    uint32_t bounces; /* behind it */
    uint32_t facet;
    bool back;
    srp_vec3 point, direction;
    srp_vec3 normal; /* turned to it */
    srp_optics optics;
} arrival;

/* ---- points ---- */

/*
 * Kronecker points: coordinate = shift + i a + j b + ray c modulo 1, in units of 2^-64. With the
 * place (i, j) itself those of the first bounce make a lattice of four dimensions; a and b were
 * searched so that its shortest vector is long (0.954 of the fourth root of the volume per point
 * at least) for 4 to 512 points along a side. c: the plastic number's, which spread any number of
 * rays over the square (Roberts' R2 sequence). Later bounces matter less and take odd numbers as
 * they come.
 */
static const uint64_t FIRST[2][3] = {
    {0xb478b050479a1001u, 0xb2eefcc074483801u, 0xc13fa9a902a63001u},
    {0xb2f8e8cd07f9f001u, 0x494eb4d3238ac001u, 0x91e10da5c79e7801u},
};

static uint64_t dimension_of(uint32_t bounces, srp_bounce_coordinate which) {
    return (uint64_t)bounces * SRP_BOUNCE_COORDINATES + (uint64_t)which;
}

uint64_t srp_bounce_point_base(uint64_t seed, int group, uint32_t bounces,
                               srp_bounce_coordinate which) {
    return srp_seed_mix(srp_seed_mix(seed, (uint64_t)group), dimension_of(bounces, which));
}

uint64_t srp_bounce_point_step(int k, uint32_t bounces, srp_bounce_coordinate which) {
    return bounces == 0 && which != SRP_BOUNCE_CHOICE
               ? FIRST[which][k]
               : srp_seed_mix((uint64_t)k, dimension_of(bounces, which)) | 1u;
}

/* In [0, 1). */
static double coordinate_of(const srp_bounce_wave *wave, const srp_bounce_path *path,
                            uint32_t bounces, srp_bounce_coordinate which) {
    int group = srp_bounce_group_of(path->i, path->j);
    uint64_t at = srp_bounce_point_base(wave->seed, group, bounces, which);
    const uint64_t index[3] = {(uint64_t)(path->i / SRP_BOUNCE_STEP),
                               (uint64_t)(path->j / SRP_BOUNCE_STEP), path->ray};
    for (int k = 0; k < 3; ++k) {
        at += index[k] * srp_bounce_point_step(k, bounces, which);
    }
    return srp_seed_unit(at);
}

/* ---- what a facet does to light ---- */

static arrival arrive(const srp_scene *scene, const srp_bounce_path *path, uint32_t bounces,
                      uint32_t facet, bool back) {
    arrival at;
    memset(&at, 0, sizeof at);
    at.path = path;
    at.bounces = bounces;
    at.facet = facet;
    at.back = back;
    at.normal = srp_vec3_scale(back ? -1.0 : 1.0, scene->facets[facet].normal);
    at.optics = srp_bounce_optics(scene, facet, back);
    return at;
}

static void tell(const srp_bounce_wave *wave, srp_bounce_step step, const arrival *at, double flux,
                 srp_vec3 direction, srp_vec3 push) {
    if (wave->world->watch != NULL) {
        srp_bounce_event event = {step, at->facet, at->back, flux, direction, push};
        wave->world->watch(wave->world->user, &event);
    }
}

static void tell_loss(const srp_bounce_wave *wave, srp_bounce_step step, const arrival *at) {
    const srp_vec3 none = {0.0, 0.0, 0.0};
    tell(wave, step, at, at->path->flux * at->optics.rho_s,
         srp_vec3_mirrored(at->direction, at->normal), none);
}

static void add_ray(srp_bounce_wave *wave, const arrival *at, srp_vec3 direction, double share,
                    srp_bounce_kind kind, uint32_t ray) {
    size_t n = wave->next_count++;
    wave->next_rays[n] = (srp_ray){at->point, direction, at->facet};
    wave->next_paths[n] = *at->path;
    wave->next_paths[n].flux *= share;
    wave->next_paths[n].kind = kind;
    wave->next_paths[n].ray = ray;
}

static void add_scattered(srp_bounce_wave *wave, const arrival *at, double share, uint32_t ray) {
    srp_bounce_path path = *at->path;
    path.ray = ray;
    double across = coordinate_of(wave, &path, at->bounces, SRP_BOUNCE_ACROSS);
    double around = coordinate_of(wave, &path, at->bounces, SRP_BOUNCE_AROUND);
    double weight = srp_guide_point(wave->world->guide, at->facet, at->back, &across, &around);
    add_ray(wave, at, srp_guide_direction(at->normal, across, around), share * weight,
            SRP_BOUNCE_DIFFUSE, ray);
}

/* All that light does that has met mirrors only. */
static void split(srp_bounce_wave *wave, const arrival *at) {
    if (at->optics.rho_s > 0.0) {
        add_ray(wave, at, srp_vec3_mirrored(at->direction, at->normal), at->optics.rho_s,
                SRP_BOUNCE_SPECULAR, at->path->ray);
    }
    uint32_t diffuse = wave->world->diffuse;
    if (diffuse == 0 || at->optics.rho_d == 0.0) {
        return;
    }
    if (at->bounces > 0) {
        add_scattered(wave, at, at->optics.rho_d, at->path->ray);
        return;
    }
    for (uint32_t k = 0; k < diffuse; ++k) {
        add_scattered(wave, at, at->optics.rho_d / diffuse, k);
    }
}

/* One of the things that it does, with the flux of all. */
static void choose(srp_bounce_wave *wave, const arrival *at) {
    double share = at->optics.rho_s + at->optics.rho_d;
    if (coordinate_of(wave, at->path, at->bounces, SRP_BOUNCE_CHOICE) * share < at->optics.rho_s) {
        add_ray(wave, at, srp_vec3_mirrored(at->direction, at->normal), share, SRP_BOUNCE_DIFFUSE,
                at->path->ray);
    } else {
        add_scattered(wave, at, share, at->path->ray);
    }
}

static void reflect(srp_bounce_wave *wave, const arrival *at) {
    const srp_bounce_world *world = wave->world;
    double share = srp_bounce_share(world, at->optics);
    if (share == 0.0) {
        return;
    }
    if (srp_bounce_is_blind(world, at->facet, at->back)) {
        tell_loss(wave, SRP_BOUNCE_ESCAPES, at);
    } else if (at->bounces == world->reflections) {
        wave->sums->unresolved[at->path->kind] += at->path->flux * share;
        tell_loss(wave, SRP_BOUNCE_IS_CUT, at);
    } else if (at->path->kind == SRP_BOUNCE_SPECULAR) {
        split(wave, at);
    } else {
        choose(wave, at);
    }
}

/* ---- waves ---- */

void srp_bounce_wave_clear(srp_bounce_wave *wave) {
    free(wave->rays);
    free(wave->next_rays);
    free(wave->paths);
    free(wave->next_paths);
    free(wave->hits);
    memset(wave, 0, sizeof *wave);
}

static bool reserve(srp_bounce_wave *wave, size_t capacity) {
    if (capacity <= wave->capacity) {
        return true;
    }
    srp_bounce_wave_clear(wave);
    wave->rays = malloc(capacity * sizeof *wave->rays);
    wave->next_rays = malloc(capacity * sizeof *wave->next_rays);
    wave->paths = malloc(capacity * sizeof *wave->paths);
    wave->next_paths = malloc(capacity * sizeof *wave->next_paths);
    wave->hits = malloc(capacity * sizeof *wave->hits);
    if (wave->rays == NULL || wave->next_rays == NULL || wave->paths == NULL ||
        wave->next_paths == NULL || wave->hits == NULL) {
        srp_bounce_wave_clear(wave);
        return false;
    }
    wave->capacity = capacity;
    return true;
}

bool srp_bounce_wave_begin(srp_bounce_wave *wave, const srp_bounce_world *world, uint64_t seed,
                           srp_bounce_sums *sums) {
    /* A hit adds at most this many rays; from then on a specular one adds one more per bounce. */
    size_t fan = 1 + (size_t)world->diffuse;
    size_t bounces = world->diffuse > 0 && world->reflections > 1 ? world->reflections : 1;
    size_t limit = WAVE_RAYS / bounces > fan ? WAVE_RAYS / bounces : fan;
    if (!reserve(wave, limit * bounces)) {
        return false;
    }
    wave->world = world;
    wave->sums = sums;
    wave->seed = seed;
    wave->start_limit = limit;
    wave->count = wave->next_count = 0;
    return true;
}

static void swap_waves(srp_bounce_wave *wave) {
    srp_ray *rays = wave->rays;
    srp_bounce_path *paths = wave->paths;
    wave->rays = wave->next_rays;
    wave->paths = wave->next_paths;
    wave->next_rays = rays;
    wave->next_paths = paths;
    wave->count = wave->next_count;
    wave->next_count = 0;
}

/* What the end of ray n does. */
static void land(srp_bounce_wave *wave, size_t n, uint32_t bounces) {
    const srp_ray *ray = &wave->rays[n];
    const srp_hit *hit = &wave->hits[n];
    const srp_bounce_path *path = &wave->paths[n];
    if (hit->facet == SRP_NO_NEIGHBOUR) {
        arrival from = arrive(wave->world->scene, path, bounces, ray->from, false);
        tell(wave, SRP_BOUNCE_ESCAPES, &from, path->flux, ray->direction,
             srp_vec3_make(0.0, 0.0, 0.0));
        return;
    }
    arrival at = arrive(wave->world->scene, path, bounces, hit->facet, hit->back);
    at.direction = ray->direction;
    at.point = srp_vec3_add_scaled(ray->origin, hit->t, ray->direction);
    srp_vec3 push = srp_bounce_push(at.optics, at.normal, at.direction, path->flux);
    srp_bounce_sum *sum = &wave->sums->group[srp_bounce_group_of(path->i, path->j)][path->kind];
    srp_vec3 lever = srp_vec3_sub(at.point, wave->world->reference);
    sum->f = srp_vec3_add(sum->f, push);
    sum->t = srp_vec3_add(sum->t, srp_vec3_cross(lever, push));
    tell(wave, SRP_BOUNCE_HITS, &at, path->flux, ray->direction, push);
    reflect(wave, &at);
}

void srp_bounce_wave_finish(srp_bounce_wave *wave) {
    swap_waves(wave);
    for (uint32_t bounces = 1; wave->count > 0; ++bounces) {
        srp_bvh_hit_many(wave->world->bvh, wave->count, wave->rays, wave->hits);
        wave->sums->rays += wave->count;
        for (size_t n = 0; n < wave->count; ++n) {
            land(wave, n, bounces);
        }
        swap_waves(wave);
    }
}

void srp_bounce_wave_start(srp_bounce_wave *wave, const srp_bounce_start *start) {
    if (wave->next_count + 1 + wave->world->diffuse > wave->start_limit) {
        srp_bounce_wave_finish(wave);
    }
    srp_bounce_path path = {start->flux, start->i, start->j, 0, SRP_BOUNCE_SPECULAR};
    arrival at = arrive(wave->world->scene, &path, 0, start->facet, start->back);
    at.point = start->point;
    at.direction = start->direction;
    tell(wave, SRP_BOUNCE_STARTS, &at, path.flux, at.direction, srp_vec3_make(0.0, 0.0, 0.0));
    reflect(wave, &at);
}

/* ---- sums ---- */

static void add_sum(srp_bounce_sum *into, const srp_bounce_sum *from) {
    into->f = srp_vec3_add(into->f, from->f);
    into->t = srp_vec3_add(into->t, from->t);
}

void srp_bounce_sums_add(srp_bounce_sums *into, const srp_bounce_sums *from) {
    for (int g = 0; g < SRP_BOUNCE_GROUPS; ++g) {
        for (int k = 0; k < SRP_BOUNCE_KINDS; ++k) {
            add_sum(&into->group[g][k], &from->group[g][k]);
        }
    }
    for (int k = 0; k < SRP_BOUNCE_KINDS; ++k) {
        into->unresolved[k] += from->unresolved[k];
    }
    into->rays += from->rays;
}

srp_bounce_sum srp_bounce_sums_total(const srp_bounce_sums *sums, srp_bounce_kind kind) {
    srp_bounce_sum total;
    memset(&total, 0, sizeof total);
    for (int g = 0; g < SRP_BOUNCE_GROUPS; ++g) {
        add_sum(&total, &sums->group[g][kind]);
    }
    return total;
}

double srp_bounce_sums_dark(const srp_bounce_sums *sums, srp_bounce_kind kind) {
    int dark = 0;
    for (int g = 0; g < SRP_BOUNCE_GROUPS; ++g) {
        srp_vec3 f = sums->group[g][kind].f;
        dark += f.x == 0.0 && f.y == 0.0 && f.z == 0.0;
    }
    return (double)dark / SRP_BOUNCE_GROUPS;
}

/* Variances of f and t. */
typedef struct variance {
    double f, t;
} variance;

/* Adds the squared distance of `count` times a sum from the total, `weight` times. */
static void add_deviation(variance *into, double weight, double count, const srp_bounce_sum *sum,
                          const srp_bounce_sum *total) {
    srp_vec3 f = srp_vec3_sub(srp_vec3_scale(count, sum->f), total->f);
    srp_vec3 t = srp_vec3_sub(srp_vec3_scale(count, sum->t), total->t);
    into->f += weight * srp_vec3_dot(f, f);
    into->t += weight * srp_vec3_dot(t, t);
}

/* The groups as independent replicates: the variance of the sum of n of them is n / (n - 1) times
 * their summed squared distances from the mean. */
static void add_scatter(const srp_bounce_sums *sums, srp_bounce_kind kind, variance *into) {
    const double n = SRP_BOUNCE_GROUPS;
    srp_bounce_sum total = srp_bounce_sums_total(sums, kind);
    for (int g = 0; g < SRP_BOUNCE_GROUPS; ++g) {
        add_deviation(into, 1.0 / (n * (n - 1.0)), n, &sums->group[g][kind], &total);
    }
}

/* Weights of the scatter of lattices of two and four times the pitch in the variance of this one:
 * those of variation.c, for the same reason. */
static const double WEIGHT_2 = 1.0 / 9.0;
static const double WEIGHT_4 = 1.0 / 81.0;

/* Light that has met mirrors only errs as first hits do: by where edges run through cells. The
 * groups are then lattices of four times the pitch, by fours of twice the pitch. */
static void add_coarseness(const srp_bounce_sums *sums, srp_bounce_kind kind, variance *into) {
    const double n = SRP_BOUNCE_GROUPS;
    srp_bounce_sum total = srp_bounce_sums_total(sums, kind);
    srp_bounce_sum four[4];
    memset(four, 0, sizeof four);
    for (int g = 0; g < SRP_BOUNCE_GROUPS; ++g) {
        int i = g % SRP_BOUNCE_STEP, j = g / SRP_BOUNCE_STEP;
        add_deviation(into, WEIGHT_4 / n, n, &sums->group[g][kind], &total);
        add_sum(&four[(j % 2) * 2 + i % 2], &sums->group[g][kind]);
    }
    for (int q = 0; q < 4; ++q) {
        add_deviation(into, WEIGHT_2 / 4.0, 4.0, &four[q], &total);
    }
}

void srp_bounce_sums_variance(const srp_bounce_sums *sums, srp_bounce_kind kind, bool turned,
                              double *f_variance, double *t_variance) {
    variance sum = {*f_variance, *t_variance};
    if (turned && kind == SRP_BOUNCE_SPECULAR) {
        add_coarseness(sums, kind, &sum);
    } else {
        add_scatter(sums, kind, &sum);
    }
    *f_variance = sum.f;
    *t_variance = sum.t;
}
