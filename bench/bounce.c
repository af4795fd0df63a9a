/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How fast the hits of bounced light are found, Embree beside us in the same run, on the same rays:
 * sunlight from several directions on a lattice; at each hit one mirrored ray and four diffuse
 * ones; at each of their hits the same again. Only the search is timed.
 *
 * A ray that leaves a facet is not searched for in the part of the tree that lies below the facet's
 * plane: where all is convex, as on the sphere, nothing is left to search. The dish is the
 * opposite.
 *
 *   bounce [lattice side] [repeats]
 */
#include "bench.h"
#include "bvh.h"
#include "view.h"

#ifdef SRP_EMBREE_VERSION
#include "embree_bounce.h"
#endif

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DIRECTIONS = 6, KINDS = 5, THREADS = 2, CHUNK = 5120 };

typedef struct subject {
    const char *name;
    const char *model; /* under models/; NULL: generated */
    double demanded;   /* of rays per second over Embree's single rays; 0: nothing */
} subject;

static const subject SUBJECTS[] = {
    {"icosphere", "icosphere-1280.obj", 1.2},
    {"satellite", NULL, 0.95},
    {"dish", "dish.obj", 0.0},
};

typedef struct ray_list {
    size_t count, capacity;
    srp_ray *rays;
} ray_list;

static void append(ray_list *list, srp_ray ray) {
    if (list->count == list->capacity) {
        list->capacity = 2 * list->capacity + 4096;
        list->rays = realloc(list->rays, list->capacity * sizeof *list->rays);
        if (list->rays == NULL) {
            (void)fprintf(stderr, "bench: no memory\n");
            exit(3);
        }
    }
    list->rays[list->count++] = ray;
}

/* ---- rays ---- */

static double fraction(uint64_t *state) {
    uint64_t z = (*state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/* Cosine-weighted about n, azimuth in the quarter `sector`. */
static srp_vec3 diffuse(srp_vec3 n, int sector, uint64_t *state) {
    srp_view frame = srp_view_of(n);
    double r2 = fraction(state), az = 1.5707963267948966 * (sector + fraction(state));
    double r = sqrt(r2);
    return srp_view_lift(&frame, srp_vec3_make(r * cos(az), r * sin(az), sqrt(1.0 - r2)));
}

/* What light that came as `ray` does at a hit. */
static void bounce(const srp_scene *scene, const srp_ray *ray, const srp_hit *hit, uint64_t *state,
                   ray_list *out) {
    srp_vec3 n = scene->facets[hit->facet].normal;
    if (hit->back) {
        n = srp_vec3_scale(-1.0, n);
    }
    srp_ray next = {.from = hit->facet};
    next.origin = srp_vec3_add_scaled(ray->origin, hit->t, ray->direction);
    double along = srp_vec3_dot(n, ray->direction);
    next.direction = srp_vec3_add_scaled(ray->direction, -2.0 * along, n);
    append(out, next);
    for (int k = 0; k + 1 < KINDS; ++k) {
        next.direction = diffuse(n, k, state);
        append(out, next);
    }
}

static void bounce_all(const srp_bvh *bvh, const srp_scene *scene, const ray_list *in,
                       uint64_t *state, ray_list *out) {
    srp_hit *hits = bench_allocate(in->count + 1, sizeof *hits);
    srp_bvh_hit_many(bvh, in->count, in->rays, hits);
    for (size_t k = 0; k < in->count; ++k) {
        if (hits[k].facet != SRP_NO_NEIGHBOUR) {
            bounce(scene, &in->rays[k], &hits[k], state, out);
        }
    }
    free(hits);
}

/* Bounced rays of both depths, those of one hit together. */
static ray_list make_rays(const srp_bvh *bvh, const srp_scene *scene, int side) {
    ray_list all = {0};
    uint64_t state = 20481;
    for (int n = 0; n < DIRECTIONS; ++n) {
        ray_list sun = {0}, first = {0};
        double el = asin((2.0 * n + 1.0) / DIRECTIONS - 1.0), az = 0.3 + 2.4 * n;
        srp_view view = srp_view_of(srp_vec3_make(cos(el) * cos(az), cos(el) * sin(az), sin(el)));
        for (int j = 0; j < side; ++j) {
            for (int i = 0; i < side; ++i) {
                double u = scene->radius * ((2.0 * i + 1.0) / side - 1.0);
                double v = scene->radius * ((2.0 * j + 1.0) / side - 1.0);
                srp_vec3 o = srp_view_lift(&view, srp_vec3_make(u, v, 2.0 * scene->radius));
                append(&sun, (srp_ray){srp_vec3_add(o, scene->centre), srp_vec3_scale(-1.0, view.s),
                                       SRP_NO_NEIGHBOUR});
            }
        }
        bounce_all(bvh, scene, &sun, &state, &first);
        for (size_t k = 0; k < first.count; ++k) {
            append(&all, first.rays[k]);
        }
        bounce_all(bvh, scene, &first, &state, &all);
        free(sun.rays);
        free(first.rays);
    }
    return all;
}

/* The same rays with those of one kind together, chunk by chunk: mirrored ones, then a quarter of
 * the sky after the other. */
static srp_ray *sort_by_kind(const ray_list *list) {
    srp_ray *sorted = bench_allocate(list->count, sizeof *sorted);
    for (size_t first = 0, at = 0; first < list->count; first += CHUNK) {
        size_t end = first + CHUNK < list->count ? first + CHUNK : list->count;
        for (size_t kind = 0; kind < KINDS; ++kind) {
            for (size_t k = first + kind; k < end; k += KINDS) {
                sorted[at++] = list->rays[k];
            }
        }
    }
    return sorted;
}

/* ---- ways to search ---- */

typedef struct trial {
    const srp_bvh *bvh;
    const srp_ray *rays;
    srp_hit *hits;
#ifdef SRP_EMBREE_VERSION
    const embree_bounce *embree;
    const embree_ray *embree_rays;
#endif
    uint32_t *facets;
} trial;

typedef void search(const trial *run, size_t first, size_t count);

static void search_single(const trial *run, size_t first, size_t count) {
    for (size_t k = first; k < first + count; ++k) {
        const srp_ray *ray = &run->rays[k];
        run->hits[k].facet = SRP_NO_NEIGHBOUR;
        (void)srp_bvh_hit(run->bvh, ray->origin, ray->direction, ray->from, &run->hits[k]);
    }
}

static void search_many(const trial *run, size_t first, size_t count) {
    srp_bvh_hit_many(run->bvh, count, run->rays + first, run->hits + first);
}

#ifdef SRP_EMBREE_VERSION
static void search_embree_single(const trial *run, size_t first, size_t count) {
    embree_bounce_single(run->embree, count, run->embree_rays + first, run->facets + first);
}

static void search_embree_wave(const trial *run, size_t first, size_t count) {
    embree_bounce_wave(run->embree, count, run->embree_rays + first, run->facets + first);
}
#endif

static double time_search(search *way, const trial *run, size_t count, int threads) {
    double start = bench_now();
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
    for (size_t first = 0; first < count; first += CHUNK) {
        way(run, first, count - first < CHUNK ? count - first : CHUNK);
    }
    return bench_now() - start;
}

/* ---- table ---- */

typedef struct row {
    const char *name;
    search *way;
    double best[2]; /* one thread, THREADS; the better of both orders [s] */
} row;

enum { OURS_SINGLE, OURS_MANY, EMBREE_SINGLE, EMBREE_WAVE, EMBREE_ROBUST, ROWS };

#ifdef SRP_EMBREE_VERSION
static void compare(const srp_hit *ours, const uint32_t *embree, size_t count) {
    size_t other = 0, any = 0;
    for (size_t k = 0; k < count; ++k) {
        other += ours[k].facet != embree[k];
        any += ours[k].facet != SRP_NO_NEIGHBOUR;
    }
    printf("  rays that hit: %zu; that Embree answers otherwise: %zu\n", any, other);
}
#endif

static void print_rows(const row rows[ROWS], size_t rays, double demanded) {
    double single = rows[EMBREE_SINGLE].best[1], wave = rows[EMBREE_WAVE].best[1];
    bool yardstick = rows[EMBREE_SINGLE].way != NULL;
    printf("  %-28s %10s %10s", "million rays/s", "1 thread", "2 threads");
    printf(yardstick ? " %14s %14s\n" : "\n", "over Embree 1", "over Embree 16");
    for (int r = 0; r < ROWS && rows[r].way != NULL; ++r) {
        printf("  %-28s %10.2f %10.2f", rows[r].name, 1e-6 * (double)rays / rows[r].best[0],
               1e-6 * (double)rays / rows[r].best[1]);
        if (yardstick) {
            printf(" %14.2f %14.2f", single / rows[r].best[1], wave / rows[r].best[1]);
        }
        printf("\n");
    }
    if (yardstick) {
        double best = fmin(rows[OURS_SINGLE].best[1], rows[OURS_MANY].best[1]);
        printf("  over Embree's single rays %.2f", single / best);
        if (demanded > 0.0) {
            printf(", demanded %.2f", demanded);
        }
        printf("; over its wavefront %.2f, aim 1.00\n", wave / best);
    }
}

static void time_rows(row rows[ROWS], trial run[ROWS][2], size_t count, int repeats) {
    for (int repeat = 0; repeat < repeats; ++repeat) {
        for (int r = 0; r < ROWS; ++r) {
            for (int n = 0; rows[r].way != NULL && n < 4; ++n) {
                double took = time_search(rows[r].way, &run[r][n / 2], count, n % 2 ? THREADS : 1);
                rows[r].best[n % 2] = fmin(rows[r].best[n % 2], took);
            }
        }
    }
}

#ifdef SRP_EMBREE_VERSION
static embree_ray *convert(const embree_bounce *embree, const srp_ray *rays, size_t count) {
    embree_ray *converted = bench_allocate(count, sizeof *converted);
    for (size_t k = 0; k < count; ++k) {
        converted[k] = embree_bounce_ray(embree, &rays[k]);
    }
    return converted;
}
#endif

static void measure(const subject *what, const srp_bvh *bvh, const srp_scene *scene,
                    const ray_list *list, int repeats) {
    row rows[ROWS] = {{"ours, one by one", search_single, {INFINITY, INFINITY}},
                      {"ours, in batches", search_many, {INFINITY, INFINITY}}};
    trial run[ROWS][2];
    srp_ray *by_kind = sort_by_kind(list);
    srp_hit *hits = bench_allocate(list->count, sizeof *hits);
    for (int r = 0; r < ROWS; ++r) {
        for (int order = 0; order < 2; ++order) {
            run[r][order] =
                (trial){.bvh = bvh, .rays = order == 0 ? list->rays : by_kind, .hits = hits};
        }
    }
#ifdef SRP_EMBREE_VERSION
    embree_bounce *embree[2] = {embree_bounce_create(scene, false),
                                embree_bounce_create(scene, true)};
    embree_ray *rays[2] = {convert(embree[0], list->rays, list->count),
                           convert(embree[0], by_kind, list->count)};
    uint32_t *facets = bench_allocate(list->count, sizeof *facets);
    for (int r = EMBREE_SINGLE; r < ROWS; ++r) {
        for (int order = 0; order < 2; ++order) {
            run[r][order].embree = embree[r == EMBREE_ROBUST];
            run[r][order].embree_rays = rays[order];
            run[r][order].facets = facets;
        }
    }
    rows[EMBREE_SINGLE] = (row){"Embree, one by one", search_embree_single, {INFINITY, INFINITY}};
    rows[EMBREE_WAVE] = (row){"Embree, 16 at a time", search_embree_wave, {INFINITY, INFINITY}};
    rows[EMBREE_ROBUST] =
        (row){"Embree, one by one, robust", search_embree_single, {INFINITY, INFINITY}};
#else
    (void)scene;
#endif
    time_rows(rows, run, list->count, repeats);
#ifdef SRP_EMBREE_VERSION
    search_embree_single(&run[EMBREE_SINGLE][1], 0, list->count);
    search_many(&run[OURS_MANY][1], 0, list->count);
    compare(hits, facets, list->count);
    embree_bounce_destroy(embree[0]);
    embree_bounce_destroy(embree[1]);
    free(rays[0]);
    free(rays[1]);
    free(facets);
#endif
    print_rows(rows, list->count, what->demanded);
    free(by_kind);
    free(hits);
}

static srp_mesh *make_mesh(const subject *what) {
    if (what->model == NULL) {
        return bench_satellite();
    }
    char path[1024];
    (void)snprintf(path, sizeof path, "%s/%s", SRP_MODELS_DIR, what->model);
    srp_mesh_read_params params = srp_mesh_read_params_default();
    srp_mesh *mesh = NULL;
    srp_error error;
    bench_require(srp_mesh_read_obj(path, &params, NULL, &mesh, &error), &error);
    return mesh;
}

static void run_subject(const subject *what, int side, int repeats) {
    const srp_optics optics = {0.5, 0.3, false};
    srp_scene *scene = bench_scene(make_mesh(what), optics);
    srp_bvh *bvh = NULL;
    srp_error error;
    double start = bench_now();
    bench_require(srp_bvh_create(scene, THREADS, &bvh, &error), &error);
    double built = bench_now() - start;
    ray_list list = make_rays(bvh, scene, side);
    printf("%s: %zu triangles, built in %.1f ms; %zu rays\n", what->name,
           srp_scene_facet_count(scene), 1e3 * built, list.count);
    measure(what, bvh, scene, &list, repeats);
    free(list.rays);
    srp_bvh_destroy(bvh);
    srp_scene_destroy(scene);
}

int main(int argc, char **argv) {
    int side = argc > 1 ? atoi(argv[1]) : 128, repeats = argc > 2 ? atoi(argv[2]) : 7;
    if (side < 1 || repeats < 1) {
        (void)fprintf(stderr, "usage: %s [lattice side] [repeats]\n", argv[0]);
        return 2;
    }
    for (size_t k = 0; k < sizeof SUBJECTS / sizeof SUBJECTS[0]; ++k) {
        run_subject(&SUBJECTS[k], side, repeats);
    }
    return EXIT_SUCCESS;
}
