/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How fast first hits are found, Embree beside us in the same run, on the same rays:
 *
 *   raycast  samples per second, two threads each
 *   exact    time of a direction on one thread, over Embree's for 512 x 512 rays on two
 *
 * Everything counts on both sides: projection or rays, hits, counts per triangle, force. Times are
 * the least of several runs, taken in turns; only their ratios mean something on another machine.
 *
 * Usage: first_hit [box-wing] [icosphere] [satellite]
 */
#include "bench.h"

#include <srp/method.h>

#ifdef SRP_EMBREE_VERSION
#include "embree_cast.h"
#endif

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 512, THREADS = 2, ROUNDS = 9 };

typedef struct bench_subject {
    const char *name;
    const char *model;     /* file under models/, NULL: generated */
    double half;           /* of the window [m]; 0: the scene's radius */
    double demanded_ratio; /* of samples per second, ours over Embree's; 0: none */
    double demanded_exact; /* most time of exact over Embree's */
} bench_subject;

static const bench_subject SUBJECTS[] = {
    {"box-wing", "box-wing.obj", 0.0, 0.0, 0.05},
    {"icosphere", "icosphere-1280.obj", 1.75, 4.0, 0.6},
    {"satellite", NULL, 0.0, 1.8, 45.0},
};

/* rho_s and rho_d of AAS 20-481's Table 1. */
static const srp_optics OPTICS = {0.5, 0.0, false};

/* What one subject took [s], and what came out. */
typedef struct timing {
    double raycast, exact, embree;
    const char *embree_mode;
    double raycast_off, exact_off; /* largest difference of f, relative: to Embree, to exact */
} timing;

static srp_mesh *make_mesh(const bench_subject *subject) {
    return subject->model != NULL ? bench_model(subject->model) : bench_satellite();
}

static double largest_difference(const srp_response *a, const srp_response *b) {
    double worst = 0.0;
    for (int k = 0; k < BENCH_PAPER_DIRECTIONS; ++k) {
        double off = srp_vec3_norm(srp_vec3_sub(a[k].f, b[k].f));
        worst = fmax(worst, off / srp_vec3_norm(b[k].f));
    }
    return worst;
}

#ifdef SRP_EMBREE_VERSION
typedef struct embree_casts {
    embree_cast *cast[2]; /* plain, robust */
} embree_casts;

static embree_casts embree_casts_create(const srp_mesh *mesh) {
    embree_casts casts = {{embree_cast_create(mesh, false), embree_cast_create(mesh, true)}};
    return casts;
}

static void embree_casts_destroy(embree_casts *casts) {
    embree_cast_destroy(casts->cast[0]);
    embree_cast_destroy(casts->cast[1]);
}

/* One round through the modes; keeps the best. */
static void time_embree(const embree_casts *casts, const srp_vec3 *s, double half, timing *best,
                        srp_response *responses) {
    static const char *const NAMES[4] = {"plain, 16 x 1", "plain, 4 x 4", "robust, 16 x 1",
                                         "robust, 4 x 4"};
    srp_vec3 f[BENCH_PAPER_DIRECTIONS];
    for (int mode = 0; mode < 4; ++mode) {
        double start = bench_now();
        embree_cast_run(casts->cast[mode / 2], BENCH_PAPER_DIRECTIONS, s, half, SIDE, THREADS,
                        mode & 1, f);
        double took = bench_now() - start;
        if (took < best->embree) {
            best->embree = took;
            best->embree_mode = NAMES[mode];
        }
    }
    for (int k = 0; k < BENCH_PAPER_DIRECTIONS; ++k) {
        responses[k].f = f[k];
    }
}
#else
typedef struct embree_casts {
    int none;
} embree_casts;

static embree_casts embree_casts_create(const srp_mesh *mesh) {
    (void)mesh;
    return (embree_casts){0};
}

static void embree_casts_destroy(embree_casts *casts) {
    (void)casts;
}

static void time_embree(const embree_casts *casts, const srp_vec3 *s, double half, timing *best,
                        srp_response *responses) {
    (void)casts, (void)s, (void)half, (void)best, (void)responses;
}
#endif

static timing measure(const srp_mesh *mesh, const srp_scene *scene, double half) {
    timing best = {INFINITY, INFINITY, INFINITY, "", 0.0, 0.0};
    srp_vec3 s[BENCH_PAPER_DIRECTIONS];
    srp_response ours[BENCH_PAPER_DIRECTIONS], truth[BENCH_PAPER_DIRECTIONS];
    srp_response theirs[BENCH_PAPER_DIRECTIONS];
    bench_paper_directions(s);
    srp_method_params params = srp_method_params_default();
    bench_set_window(&params, half, SIDE);
    params.threads = THREADS;
    srp_prepared *raycast = bench_prepare(&srp_method_raycast, scene, &params);
    params.threads = 1;
    srp_prepared *exact = bench_prepare(&srp_method_exact, scene, &params);
    embree_casts casts = embree_casts_create(mesh);
    for (int round = 0; round < ROUNDS; ++round) {
        best.raycast = fmin(best.raycast, bench_time(raycast, BENCH_PAPER_DIRECTIONS, s, 1, ours));
        time_embree(&casts, s, half, &best, theirs);
        if (round < 3) { /* the slowest, and the least noisy */
            best.exact = fmin(best.exact, bench_time(exact, BENCH_PAPER_DIRECTIONS, s, 1, truth));
        }
    }
    best.exact_off = largest_difference(ours, truth);
    best.raycast_off = isfinite(best.embree) ? largest_difference(theirs, ours) : NAN;
    embree_casts_destroy(&casts);
    srp_prepared_release(raycast);
    srp_prepared_release(exact);
    return best;
}

static void print_demand(double value, const char *sense, double limit, bool held) {
    printf("%10.3f", value);
    if (limit > 0.0) {
        printf("   demanded: %s %g %s", sense, limit, held ? "(held)" : "(MISSED)");
    }
    printf("\n");
}

static void report(const bench_subject *subject, const timing *t) {
    const double rays = (double)SIDE * SIDE * BENCH_PAPER_DIRECTIONS;
    const double ms = 1e3 / BENCH_PAPER_DIRECTIONS;
    printf("  raycast, %d threads   %9.1f million samples/s   %8.4f ms per direction\n", THREADS,
           rays / t->raycast * 1e-6, t->raycast * ms);
    printf("  exact, 1 thread                                  %8.4f ms per direction\n",
           t->exact * ms);
    printf("  largest relative difference of f, raycast to exact  %.1e\n", t->exact_off);
    if (!isfinite(t->embree)) {
        return;
    }
    printf("  Embree, %d threads    %9.1f million samples/s   %8.4f ms per direction (%s)\n",
           THREADS, rays / t->embree * 1e-6, t->embree * ms, t->embree_mode);
    printf("  largest relative difference of f, Embree to raycast %.1e\n", t->raycast_off);
    double ratio = t->embree / t->raycast, share = t->exact / t->embree;
    printf("  raycast over Embree, samples/s      ");
    print_demand(ratio, "at least", subject->demanded_ratio, ratio >= subject->demanded_ratio);
    printf("  exact over Embree, time a direction ");
    print_demand(share, "at most", subject->demanded_exact, share <= subject->demanded_exact);
}

static void run(const bench_subject *subject) {
    srp_mesh *mesh = make_mesh(subject);
    srp_scene *scene = bench_scene(make_mesh(subject), OPTICS);
    double half = subject->half > 0.0 ? subject->half : srp_scene_radius(scene);
    printf("%s: %zu triangles, %d x %d samples over +-%.3f m, %d directions\n", subject->name,
           srp_mesh_triangle_count(mesh), SIDE, SIDE, half, BENCH_PAPER_DIRECTIONS);
    (void)fflush(stdout);
    timing best = measure(mesh, scene, half);
    report(subject, &best);
    srp_scene_destroy(scene);
    srp_mesh_destroy(mesh);
}

/*
 * What memory allows: a depth buffer written and read once per sample, in the largest cache that
 * two threads do not share and from memory.
 */
static void print_machine_limit(void) {
    static const size_t COUNTS[2] = {(size_t)1 << 14, (size_t)1 << 24};
    static const char *const NAMES[2] = {"256 KiB, as one band of rows", "256 MiB, from memory"};
    for (int k = 0; k < 2; ++k) {
        size_t count = COUNTS[k];
        double *buffer = bench_allocate(2 * count, sizeof *buffer);
        double best = INFINITY;
        int passes = (int)(((size_t)1 << 26) / count);
        for (int round = 0; round < ROUNDS; ++round) {
            double start = bench_now();
            for (int pass = 0; pass < passes; ++pass) {
                for (size_t i = 0; i < 2 * count; ++i) {
                    buffer[i] += 1.0;
                }
            }
            best = fmin(best, (bench_now() - start) / passes / (double)count);
        }
        printf("reading and writing 16 bytes per sample, 1 thread, %s: %.0f million samples/s\n",
               NAMES[k], 1e-6 / best);
        free(buffer);
    }
}

/* Arguments name the subjects to run; without any, all. */
static bool is_asked(const char *name, int argc, char **argv) {
    bool asked = argc < 2;
    for (int k = 1; k < argc; ++k) {
        asked = asked || strcmp(argv[k], name) == 0;
    }
    return asked;
}

int main(int argc, char **argv) {
#ifdef SRP_EMBREE_VERSION
    printf("Embree %s\n", embree_cast_version());
#else
    printf("without Embree: built where it was not found\n");
#endif
    print_machine_limit();
    for (size_t k = 0; k < sizeof SUBJECTS / sizeof SUBJECTS[0]; ++k) {
        if (is_asked(SUBJECTS[k].name, argc, argv)) {
            run(&SUBJECTS[k]);
        }
    }
    return EXIT_SUCCESS;
}
