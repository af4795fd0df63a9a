/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Rays needed for reflected light that is known to 1e-4 of itself: the raytrace method against
 * plain Monte Carlo, which draws a place in the silhouette's box, casts the ray, and at every hit
 * goes on in one direction, mirrored or cosine-weighted at random, with the flux that is left. Both
 * follow two bounces and count every ray, of ours the samples of the lattice too.
 *
 * Errors are those seen over repeated runs, not estimated ones. Monte Carlo's fall with the root of
 * the rays; ours are followed over growing lattices and their slope goes on to 1e-4.
 */
#include "bench.h"
#include "bvh.h"
#include "scene_internal.h"
#include "view.h"

#include <srp/const.h>
#include <srp/table.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { REFLECTIONS = 2, DIFFUSE = 4, RUNS = 32, SIDES = 4, FIRST_SIDE = 48 };
static const double GOAL = 1e-4, DEMANDED_RATIO = 10.0;
static const uint64_t MONTE_CARLO_PATHS = 4000000;

static uint64_t random_state = 1;

static double random_unit(void) {
    uint64_t z = (random_state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/* A point of the sphere on top of the normal: cosine-weighted. */
static srp_vec3 scattered(srp_vec3 normal) {
    double z = 2.0 * random_unit() - 1.0, angle = 2.0 * SRP_PI * random_unit();
    double h = sqrt(1.0 - z * z);
    srp_vec3 d = srp_vec3_add(normal, srp_vec3_make(h * cos(angle), h * sin(angle), z));
    return srp_vec3_scale(1.0 / srp_vec3_norm(d), d);
}

/* Bounce part of f of one path; counts its rays. */
static srp_vec3 walk(const srp_scene *scene, const srp_bvh *bvh, srp_vec3 p, srp_vec3 d,
                     double flux, uint64_t *rays) {
    srp_vec3 f = {0.0, 0.0, 0.0};
    uint32_t from = SRP_NO_NEIGHBOUR;
    for (int bounces = 0; bounces <= REFLECTIONS; ++bounces) {
        srp_hit hit;
        ++*rays;
        if (!srp_bvh_hit(bvh, p, d, from, &hit)) {
            break;
        }
        const srp_facet *facet = &scene->facets[hit.facet];
        srp_optics optics = scene->optics[facet->material];
        srp_vec3 n = srp_vec3_scale(hit.back ? -1.0 : 1.0, facet->normal);
        double c = -srp_vec3_dot(n, d), share = optics.rho_s + optics.rho_d;
        if (bounces > 0) {
            f = srp_vec3_add_scaled(f, flux * (1.0 - optics.rho_s), d);
            f = srp_vec3_add_scaled(f, -2.0 * flux * (optics.rho_s * c + optics.rho_d / 3.0), n);
        }
        if (share == 0.0 || (hit.back && optics.one_sided)) {
            break;
        }
        p = srp_vec3_add_scaled(p, hit.t, d);
        d = random_unit() * share < optics.rho_s ? srp_vec3_add_scaled(d, 2.0 * c, n)
                                                 : scattered(n);
        from = hit.facet;
        flux *= share;
    }
    return f;
}

/* Rays times the variance of the mean over them, for |f| = 1. */
static double monte_carlo(const srp_scene *scene, srp_vec3 s, srp_vec3 want) {
    srp_bvh *bvh = NULL;
    srp_error error;
    bench_require(srp_bvh_create(scene, 1, &bvh, &error), &error);
    srp_view view = srp_view_of(s);
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t k = 0; k < scene->vertex_count; ++k) {
        srp_vec3 q = srp_view_project(&view, scene->vertices[k]);
        low[0] = fmin(low[0], q.x);
        high[0] = fmax(high[0], q.x);
        low[1] = fmin(low[1], q.y);
        high[1] = fmax(high[1], q.y);
    }
    double area = (high[0] - low[0]) * (high[1] - low[1]), squares = 0.0;
    double height = srp_vec3_dot(scene->centre, s) + 2.0 * scene->radius;
    uint64_t rays = 0;
    for (uint64_t k = 0; k < MONTE_CARLO_PATHS; ++k) {
        srp_vec3 q = srp_vec3_make(low[0] + (high[0] - low[0]) * random_unit(),
                                   low[1] + (high[1] - low[1]) * random_unit(), height);
        srp_vec3 off = srp_vec3_sub(
            walk(scene, bvh, srp_view_lift(&view, q), srp_vec3_scale(-1.0, s), area, &rays), want);
        squares += srp_vec3_dot(off, off);
    }
    srp_bvh_destroy(bvh);
    double paths = (double)MONTE_CARLO_PATHS;
    return squares / paths * ((double)rays / paths) / srp_vec3_dot(want, want);
}

typedef struct scatter {
    srp_vec3 mean;
    double rays, error; /* of one run; relative */
} scatter;

static scatter run_ours(const srp_scene *scene, srp_vec3 s, uint32_t side) {
    scatter out = {{0.0, 0.0, 0.0}, 0.0, 0.0};
    srp_vec3 f[RUNS];
    for (int k = 0; k < RUNS; ++k) {
        srp_method_params params = srp_method_params_default();
        srp_response response;
        srp_error error;
        params.reflections = REFLECTIONS;
        params.diffuse = DIFFUSE;
        params.lattice.samples = side;
        params.seed = (uint64_t)k;
        srp_prepared *prepared = bench_prepare(&srp_method_raytrace, scene, &params);
        bench_require(srp_prepared_respond(prepared, 1, &s, &response, NULL, &error), &error);
        srp_prepared_release(prepared);
        f[k] = response.f_bounce;
        out.mean = srp_vec3_add_scaled(out.mean, 1.0 / RUNS, f[k]);
        out.rays += (double)response.samples / RUNS;
    }
    for (int k = 0; k < RUNS; ++k) {
        srp_vec3 off = srp_vec3_sub(f[k], out.mean);
        out.error += srp_vec3_dot(off, off) / (RUNS - 1);
    }
    out.error = sqrt(out.error) / srp_vec3_norm(out.mean);
    return out;
}

/* Slope of log(error) over log(rays), least squares. */
static double slope_of(const scatter *at) {
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (int k = 0; k < SIDES; ++k) {
        double lx = log(at[k].rays), ly = log(at[k].error);
        x += lx / SIDES;
        y += ly / SIDES;
        xx += lx * lx / SIDES;
        xy += lx * ly / SIDES;
    }
    return (xy - x * y) / (xx - x * x);
}

static bool measure(const char *name) {
    char path[1024];
    const char *paths[1] = {path};
    srp_error error;
    srp_scene *scene = NULL;
    srp_mesh_read_params params = srp_mesh_read_params_default();
    (void)snprintf(path, sizeof path, "%s/%s.obj", SRP_MODELS_DIR, name);
    bench_require(srp_scene_read_obj(paths, 1, &params, NULL, NULL, &scene, &error), &error);
    const srp_vec3 s = srp_direction_from_deg(52.0, 27.0);
    scatter at[SIDES];
    printf("%s\n", name);
    for (int k = 0; k < SIDES; ++k) {
        at[k] = run_ours(scene, s, (uint32_t)FIRST_SIDE << k);
        printf("  %8.3g rays, error %.2e of |f| = %.6f\n", at[k].rays, at[k].error,
               srp_vec3_norm(at[k].mean));
    }
    const scatter *last = &at[SIDES - 1];
    double slope = slope_of(at), plain = monte_carlo(scene, s, last->mean);
    double ours = last->rays * pow(GOAL / last->error, 1.0 / slope);
    double theirs = plain / (GOAL * GOAL);
    double here = plain / (last->error * last->error) / last->rays;
    printf("  slope %.2f; for %.0e: %.3g rays, plain Monte Carlo %.3g, ratio %.1f (%.1f at the "
           "error of the last row), %.0f demanded\n",
           slope, GOAL, ours, theirs, theirs / ours, here, DEMANDED_RATIO);
    srp_scene_destroy(scene);
    return theirs / ours >= DEMANDED_RATIO;
}

int main(void) {
    static const char *const names[] = {"l-corner", "box-wing", "dish", "sun-shield"};
    bool fine = true;
    for (size_t k = 0; k < sizeof names / sizeof names[0]; ++k) {
        fine = measure(names[k]) && fine;
    }
    return fine ? EXIT_SUCCESS : EXIT_FAILURE;
}
