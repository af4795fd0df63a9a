/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The raytrace method against the recursion that it stands for: AAS 20-481, Eq. 8 and Algorithm 2,
 * with the departures of docs/theory.md, word for word. At every hit one specular ray and K diffuse
 * ones are cast, every ray is tried against every facet, everything is drawn at random. Slow, and
 * without any of our parts but the scene.
 */
#include "model_files.h"
#include "prepared.h"
#include "scene_internal.h"
#include "srp_check.h"

#include <srp/const.h>

#include <string.h>

typedef struct triangle {
    srp_vec3 a, ab, ac, normal;
    srp_optics optics;
} triangle;

typedef struct recursion {
    triangle *triangles;
    size_t count;
    uint32_t reflections, diffuse;
    double near;
    uint64_t random;
    uint64_t tests; /* of a ray against a facet */
    srp_vec3 f, t;  /* of the sample in work, without its first hit */
} recursion;

static recursion recursion_of(const srp_scene *scene) {
    recursion r;
    memset(&r, 0, sizeof r);
    r.count = scene->facet_count;
    r.triangles = calloc(r.count, sizeof *r.triangles);
    ck_assert_ptr_nonnull(r.triangles);
    r.near = 1e-10 * scene->radius;
    for (size_t k = 0; k < r.count; ++k) {
        const srp_facet *facet = &scene->facets[k];
        triangle *own = &r.triangles[k];
        own->a = scene->vertices[facet->v[0]];
        own->ab = srp_vec3_sub(scene->vertices[facet->v[1]], own->a);
        own->ac = srp_vec3_sub(scene->vertices[facet->v[2]], own->a);
        own->normal = facet->normal;
        own->optics = scene->optics[facet->material];
    }
    return r;
}

/* Nearest facet but `from`: Moeller and Trumbore (1997). */
static size_t nearest(recursion *r, srp_vec3 origin, srp_vec3 d, size_t from, double *distance) {
    size_t found = SIZE_MAX;
    double best = INFINITY;
    r->tests += r->count;
    for (size_t k = 0; k < r->count; ++k) {
        const triangle *tri = &r->triangles[k];
        srp_vec3 p = srp_vec3_cross(d, tri->ac);
        double det = srp_vec3_dot(tri->ab, p), inverse = 1.0 / det;
        srp_vec3 away = srp_vec3_sub(origin, tri->a);
        double u = srp_vec3_dot(away, p) * inverse;
        if (!(u >= 0.0 && u <= 1.0)) {
            continue;
        }
        srp_vec3 q = srp_vec3_cross(away, tri->ab);
        double v = srp_vec3_dot(d, q) * inverse, t = srp_vec3_dot(tri->ac, q) * inverse;
        if (v >= 0.0 && u + v <= 1.0 && t > r->near && t < best && k != from) {
            best = t;
            found = k;
        }
    }
    *distance = best;
    return found;
}

/* Cosine-weighted: a point of the unit sphere on top of the normal. */
static srp_vec3 lambertian(recursion *r, srp_vec3 normal) {
    srp_vec3 d = srp_vec3_add(normal, random_direction(&r->random));
    return srp_vec3_scale(1.0 / srp_vec3_norm(d), d);
}

/* One ray with its flux; `depth` hits lie behind it. */
static void follow(recursion *r, srp_vec3 origin, srp_vec3 d, size_t from, double flux,
                   uint32_t depth) {
    double distance;
    size_t hit = nearest(r, origin, d, from, &distance);
    if (hit == SIZE_MAX) {
        return;
    }
    const triangle *tri = &r->triangles[hit];
    bool back = srp_vec3_dot(tri->normal, d) > 0.0;
    srp_vec3 n = srp_vec3_scale(back ? -1.0 : 1.0, tri->normal);
    srp_optics optics = tri->optics;
    if (back && optics.one_sided) {
        optics.rho_s = optics.rho_d = 0.0;
    }
    srp_vec3 p = srp_vec3_add_scaled(origin, distance, d);
    double c = -srp_vec3_dot(n, d);
    if (depth > 0) {
        srp_vec3 push = srp_vec3_scale(flux * (1.0 - optics.rho_s), d);
        push = srp_vec3_add_scaled(push, -2.0 * flux * (optics.rho_s * c + optics.rho_d / 3.0), n);
        r->f = srp_vec3_add(r->f, push);
        r->t = srp_vec3_add(r->t, srp_vec3_cross(p, push));
    }
    if (depth == r->reflections) {
        return;
    }
    if (optics.rho_s > 0.0) {
        follow(r, p, srp_vec3_add_scaled(d, 2.0 * c, n), hit, flux * optics.rho_s, depth + 1);
    }
    for (uint32_t k = 0; k < r->diffuse && optics.rho_d > 0.0; ++k) {
        follow(r, p, lambertian(r, n), hit, flux * optics.rho_d / r->diffuse, depth + 1);
    }
}

typedef struct estimate {
    srp_vec3 f, t;
    double f_error, t_error;
    size_t samples;
} estimate;

/* Samples of a disc that holds the scene, until `budget` tests are spent, and enough for an error.
 */
static estimate run(recursion *r, const srp_scene *scene, srp_vec3 s, uint64_t budget) {
    srp_vec3 side = fabs(s.x) < 0.6 ? srp_vec3_make(1.0, 0.0, 0.0) : srp_vec3_make(0.0, 1.0, 0.0);
    srp_vec3 u = srp_vec3_cross(side, s);
    u = srp_vec3_scale(1.0 / srp_vec3_norm(u), u);
    srp_vec3 v = srp_vec3_cross(s, u), d = srp_vec3_scale(-1.0, s);
    double area = SRP_PI * scene->radius * scene->radius;
    estimate sum;
    memset(&sum, 0, sizeof sum);
    r->tests = 0;
    while (r->tests < budget || sum.samples < 600) {
        double radius = scene->radius * sqrt(random_unit(&r->random));
        double angle = 2.0 * SRP_PI * random_unit(&r->random);
        srp_vec3 p = srp_vec3_add_scaled(scene->centre, 2.0 * scene->radius, s);
        p = srp_vec3_add_scaled(p, radius * cos(angle), u);
        p = srp_vec3_add_scaled(p, radius * sin(angle), v);
        r->f = r->t = srp_vec3_make(0.0, 0.0, 0.0);
        follow(r, p, d, SIZE_MAX, area, 0);
        sum.f = srp_vec3_add(sum.f, r->f);
        sum.t = srp_vec3_add(sum.t, r->t);
        sum.f_error += srp_vec3_dot(r->f, r->f);
        sum.t_error += srp_vec3_dot(r->t, r->t);
        ++sum.samples;
    }
    double n = (double)sum.samples;
    sum.f = srp_vec3_scale(1.0 / n, sum.f);
    sum.t = srp_vec3_scale(1.0 / n, sum.t);
    sum.f_error = sqrt((sum.f_error / n - srp_vec3_dot(sum.f, sum.f)) / (n - 1.0));
    sum.t_error = sqrt((sum.t_error / n - srp_vec3_dot(sum.t, sum.t)) / (n - 1.0));
    return sum;
}

static const char *const NAMES[] = {"box-wing", "dish", "sun-shield"};
/* Towards the Sun; each shows the model from a side where it lights itself. */
static const srp_vec3 SUNS[] = {{0.42, 0.61, 0.35}, {0.22, -0.31, 0.83}, {0.57, 0.13, 0.64}};
static uint64_t budget = 50000000;

/* Square of the distance in combined standard errors. */
static double standing(srp_vec3 got, srp_vec3 want, double got_error, double want_error) {
    srp_vec3 off = srp_vec3_sub(got, want);
    return srp_vec3_dot(off, off) / (got_error * got_error + want_error * want_error);
}

START_TEST(agrees_with_the_recursion) {
    static const uint32_t DIFFUSE[] = {1, 4, 16};
    const char *name = NAMES[_i / 3];
    uint32_t reflections = 1 + (uint32_t)_i % 3;
    srp_vec3 s = srp_vec3_scale(1.0 / srp_vec3_norm(SUNS[_i / 3]), SUNS[_i / 3]);
    model_file model = model_read(name);
    srp_scene *scene = model_scene(&model);
    recursion r = recursion_of(scene);
    r.random = (uint64_t)_i;
    r.reflections = reflections;
    for (size_t k = 0; k < 3; ++k) {
        srp_error error;
        srp_prepared *prepared = NULL;
        srp_method_params params = srp_method_params_default();
        params.threads = 1;
        params.reflections = reflections;
        params.diffuse = r.diffuse = DIFFUSE[k];
        params.lattice.samples = 256;
        assert_ok(srp_method_prepare(&srp_method_raytrace, scene, &params, &prepared, &error),
                  error);
        srp_response got = respond_to(prepared, s);
        srp_prepared_release(prepared);
        estimate want = run(&r, scene, s, budget);
        double f = sqrt(standing(got.f_bounce, want.f, got.f_error, want.f_error));
        double t = sqrt(standing(got.t_bounce, want.t, got.t_error, want.t_error));
        printf("%-10s R %u K %2u: f %.5f +- %.5f, recursion %.5f +- %.5f (%zu samples), apart %.2f "
               "and %.2f errors\n",
               name, reflections, DIFFUSE[k], srp_vec3_norm(got.f_bounce), got.f_error,
               srp_vec3_norm(want.f), want.f_error, want.samples, f, t);
        (void)fflush(stdout);
        ck_assert(want.f_error < 0.3 * srp_vec3_norm(want.f));
        ck_assert(f <= 4.0 && t <= 4.0);
    }
    free(r.triangles);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

/* `long` as an argument: ten times the samples. */
int main(int argc, char **argv) {
    if (argc > 1 && strcmp(argv[1], "long") == 0) {
        budget *= 10;
    }
    Suite *suite = suite_create("recursion");
    TCase *tcase = tcase_create("recursion");
    tcase_set_timeout(tcase, 600.0);
    tcase_add_loop_test(tcase, agrees_with_the_recursion, 0, 9);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
