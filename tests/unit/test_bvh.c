/* SPDX-License-Identifier: Apache-2.0 */
#include "bvh.h"
#include "bvh_internal.h"
#include "model_files.h"
#include "shapes.h"
#include "srp_check.h"

#include <string.h>

/* Sanitized runs are many times slower. */
#ifdef SRP_NO_TARGET_CLONES
enum { SLOWER = 20 };
#else
enum { SLOWER = 1 };
#endif

enum { BATCH = 4096 };

static const srp_optics OPTICS = {0.31, 0.17, false};
static const srp_vec3 ZERO = {0.0, 0.0, 0.0};

/* ---- scenes ---- */

static srp_bvh *build_on(const srp_scene *scene, int threads) {
    srp_bvh *bvh = NULL;
    srp_error error;
    assert_ok(srp_bvh_create(scene, threads, &bvh, &error), error);
    return bvh;
}

static srp_vec3 random_point(uint64_t *state, double half) {
    double x = random_unit(state), y = random_unit(state), z = random_unit(state);
    return srp_vec3_scale(half, srp_vec3_make(2.0 * x - 1.0, 2.0 * y - 1.0, 2.0 * z - 1.0));
}

/* Triangles anywhere, of any size, cutting each other. */
static srp_scene *soup(uint64_t seed, size_t count, double size) {
    uint64_t state = seed;
    srp_vec3 *vertices = malloc(3 * count * sizeof *vertices);
    srp_triangle *triangles = malloc(count * sizeof *triangles);
    ck_assert(vertices != NULL && triangles != NULL);
    for (size_t k = 0; k < count; ++k) {
        srp_vec3 at = random_point(&state, size);
        double half = size * pow(10.0, -3.0 * random_unit(&state));
        for (size_t e = 0; e < 3; ++e) {
            vertices[3 * k + e] = srp_vec3_add(at, random_point(&state, half));
            triangles[k].v[e] = (uint32_t)(3 * k + e);
        }
    }
    srp_scene *scene = shape_scene(shape_mesh(vertices, 3 * count, triangles, count, "m"), OPTICS);
    free(vertices);
    free(triangles);
    return scene;
}

static srp_scene *turned_model(const char *name, uint64_t seed) {
    uint64_t state = seed;
    model_file model = model_read(name);
    turn t = turn_random(&state);
    srp_scene *scene = model_scene_turned(&model, &t);
    model_free(&model);
    return scene;
}

/* ---- rays ---- */

static srp_vec3 corner(const srp_scene *scene, uint32_t facet, int k) {
    return scene->vertices[scene->facets[facet].v[k % 3]];
}

static uint32_t random_facet(const srp_scene *scene, uint64_t *state) {
    return (uint32_t)(random_bits(state) % scene->facet_count);
}

typedef enum place_kind { INTERIOR, EDGE, VERTEX } place_kind;

/* Somewhere on a facet, as well as doubles can tell. */
static srp_vec3 place_on(const srp_scene *scene, uint32_t facet, place_kind kind, uint64_t *state) {
    int k = (int)(random_bits(state) % 3);
    srp_vec3 a = corner(scene, facet, k), b = corner(scene, facet, k + 1);
    if (kind == VERTEX) {
        return a;
    }
    srp_vec3 on = srp_vec3_add_scaled(a, random_unit(state), srp_vec3_sub(b, a));
    double inwards = kind == EDGE ? 0.0 : random_unit(state);
    return srp_vec3_add_scaled(on, inwards, srp_vec3_sub(corner(scene, facet, k + 2), on));
}

/* Leaves a facet on the side `up` (1 front, -1 back), now and then nearly along it. */
static srp_ray leave(const srp_scene *scene, uint32_t facet, double up, place_kind kind,
                     uint64_t *state) {
    srp_vec3 n = srp_vec3_scale(up, scene->facets[facet].normal), d = random_direction(state);
    double along = srp_vec3_dot(n, d);
    double climb = random_bits(state) % 4 == 0 ? pow(10.0, -7.0 * random_unit(state)) : fabs(along);
    d = srp_vec3_add_scaled(d, climb - along, n);
    return (srp_ray){place_on(scene, facet, kind, state), d, facet};
}

static srp_ray random_ray(const srp_scene *scene, uint64_t *state) {
    switch (random_bits(state) % 4) {
    case 0: { /* from outside, towards somewhere in the box */
        srp_vec3 o =
            srp_vec3_add_scaled(scene->centre, 3.0 * scene->radius, random_direction(state));
        srp_vec3 to = srp_vec3_add(scene->centre, random_point(state, scene->radius));
        return (srp_ray){o, srp_vec3_sub(to, o), SRP_NO_NEIGHBOUR};
    }
    case 1: { /* along an axis, at a corner */
        srp_vec3 o = corner(scene, random_facet(scene, state), 0);
        srp_vec3 d = ZERO;
        double length = 1e3 * random_unit(state) + 1.0;
        *(random_bits(state) % 2 ? &d.x : &d.z) = random_bits(state) % 2 ? length : -length;
        return (srp_ray){srp_vec3_add_scaled(o, -random_unit(state), d), d, SRP_NO_NEIGHBOUR};
    }
    default: {
        double up = random_bits(state) % 2 ? 1.0 : -1.0;
        place_kind kind = (place_kind)(random_bits(state) % 3);
        return leave(scene, random_facet(scene, state), up, kind, state);
    }
    }
}

/* ---- oracles ---- */

/* Every facet is asked. */
static srp_hit ask_all(const srp_bvh *bvh, const srp_ray *ray) {
    srp_bvh_path path = srp_bvh_path_of(bvh, ray);
    srp_bvh_best best = {INFINITY, SRP_NO_NEIGHBOUR, false};
    for (uint32_t k = 0; k < bvh->scene->facet_count; ++k) {
        if (k != ray->from) {
            srp_bvh_triangle triangle = srp_bvh_triangle_of(bvh->scene, k);
            srp_bvh_test(&path, &triangle, k, &best);
        }
    }
    srp_hit hit = {0.0, SRP_NO_NEIGHBOUR, false};
    (void)srp_bvh_finish(bvh, ray, &path, &best, &hit);
    return hit;
}

static bool same_hit(const srp_hit *a, const srp_hit *b) {
    return a->facet == b->facet &&
           (a->facet == SRP_NO_NEIGHBOUR || (a->t == b->t && a->back == b->back));
}

/* The hierarchy leaves nothing out: to the last bit what asking every facet gives. */
static void compare_with_all(const srp_scene *scene, size_t count, uint64_t seed) {
    uint64_t state = seed;
    srp_bvh *bvh = build_on(scene, 2);
    srp_ray *rays = malloc(count * sizeof *rays);
    srp_hit *hits = malloc(count * sizeof *hits);
    ck_assert(rays != NULL && hits != NULL);
    size_t found = 0;
    for (size_t k = 0; k < count; ++k) {
        rays[k] = random_ray(scene, &state);
    }
    srp_bvh_hit_many(bvh, count, rays, hits);
    for (size_t k = 0; k < count; ++k) {
        srp_hit want = ask_all(bvh, &rays[k]), one = {0.0, SRP_NO_NEIGHBOUR, false};
        bool any = srp_bvh_hit(bvh, rays[k].origin, rays[k].direction, rays[k].from, &one);
        ck_assert(any == (one.facet != SRP_NO_NEIGHBOUR));
        ck_assert_msg(same_hit(&one, &want), "ray %zu: facet %u at %.17g, all say %u at %.17g", k,
                      one.facet, one.t, want.facet, want.t);
        ck_assert(same_hit(&hits[k], &want));
        found += any;
    }
    ck_assert_uint_gt(found, 0);
    free(rays);
    free(hits);
    srp_bvh_destroy(bvh);
}

/* Moeller & Trumbore, "Fast, minimum storage ray/triangle intersection" (1997), in long double:
 * another test, by another way. `margin`: of the barycentric coordinates to the edges. */
static bool other_test(const srp_scene *scene, uint32_t facet, const srp_ray *ray, double *t,
                       double *margin) {
    long double e[2][3], d[3], s[3], p[3], q[3];
    const srp_vec3 v[3] = {corner(scene, facet, 0), corner(scene, facet, 1),
                           corner(scene, facet, 2)};
    for (int k = 0; k < 2; ++k) {
        e[k][0] = (long double)v[k + 1].x - v[0].x;
        e[k][1] = (long double)v[k + 1].y - v[0].y;
        e[k][2] = (long double)v[k + 1].z - v[0].z;
    }
    d[0] = ray->direction.x, d[1] = ray->direction.y, d[2] = ray->direction.z;
    s[0] = (long double)ray->origin.x - v[0].x;
    s[1] = (long double)ray->origin.y - v[0].y;
    s[2] = (long double)ray->origin.z - v[0].z;
    for (int a = 0; a < 3; ++a) {
        int b = (a + 1) % 3, c = (a + 2) % 3;
        p[a] = d[b] * e[1][c] - d[c] * e[1][b];
        q[a] = s[b] * e[0][c] - s[c] * e[0][b];
    }
    long double volume = e[0][0] * p[0] + e[0][1] * p[1] + e[0][2] * p[2];
    long double u = (s[0] * p[0] + s[1] * p[1] + s[2] * p[2]) / volume;
    long double w = (d[0] * q[0] + d[1] * q[1] + d[2] * q[2]) / volume;
    *t = (double)((e[1][0] * q[0] + e[1][1] * q[1] + e[1][2] * q[2]) / volume);
    *margin = (double)fminl(fminl(u, w), 1.0L - u - w);
    return *margin > 0.0 && *t > 0.0;
}

START_TEST(nearest_hits_are_those_of_another_test) {
    srp_scene *scene = soup(77, 400, 1.7);
    srp_bvh *bvh = build_on(scene, 1);
    uint64_t state = 5;
    size_t compared = 0;
    for (int n = 0; n < 4000; ++n) {
        srp_vec3 o = random_point(&state, 3.0);
        srp_ray ray = {o, srp_vec3_scale(0.37, random_direction(&state)), SRP_NO_NEIGHBOUR};
        double nearest = INFINITY, closest_edge = 1.0;
        uint32_t facet = SRP_NO_NEIGHBOUR;
        for (uint32_t k = 0; k < scene->facet_count; ++k) {
            double t, margin;
            bool hit = other_test(scene, k, &ray, &t, &margin);
            closest_edge = fmin(closest_edge, fabs(margin));
            if (hit && t < nearest) {
                nearest = t;
                facet = k;
            }
        }
        if (closest_edge < 1e-9) {
            continue; /* on an edge, either may be right */
        }
        srp_hit hit = {0.0, SRP_NO_NEIGHBOUR, false};
        (void)srp_bvh_hit(bvh, ray.origin, ray.direction, ray.from, &hit);
        ck_assert_uint_eq(hit.facet, facet);
        if (facet != SRP_NO_NEIGHBOUR) {
            assert_close(hit.t, nearest, 1e-10, 0.0);
            ck_assert(hit.back == (srp_vec3_dot(scene->facets[facet].normal, ray.direction) > 0.0));
            ++compared;
        }
    }
    ck_assert_uint_gt(compared, 500);
    srp_bvh_destroy(bvh);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(a_ray_finds_both_sides_of_a_box) {
    srp_scene *scene = shape_scene(
        shape_box(srp_vec3_make(-1.1, -0.7, -0.3), srp_vec3_make(0.9, 1.3, 2.3), "m"), OPTICS);
    srp_bvh *bvh = build_on(scene, 1);
    srp_hit hit;
    srp_vec3 start = srp_vec3_make(0.123, 0.456, 5.3), down = srp_vec3_make(0.0, 0.0, -2.0);
    ck_assert(srp_bvh_hit(bvh, start, down, SRP_NO_NEIGHBOUR, &hit));
    assert_close(hit.t, 1.5, 1e-15, 0.0);
    ck_assert(!hit.back);
    ck_assert(srp_bvh_hit(bvh, srp_vec3_add_scaled(start, hit.t, down), down, hit.facet, &hit));
    assert_close(hit.t, 1.3, 1e-15, 0.0);
    ck_assert(hit.back);
    /* Behind, beside, away. */
    srp_hit kept = hit;
    ck_assert(!srp_bvh_hit(bvh, start, srp_vec3_scale(-1.0, down), SRP_NO_NEIGHBOUR, &hit));
    start.x = 0.900001;
    ck_assert(!srp_bvh_hit(bvh, start, down, SRP_NO_NEIGHBOUR, &hit));
    ck_assert(same_hit(&kept, &hit));
    srp_bvh_destroy(bvh);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(nothing_is_left_out_of_soups) {
    for (uint64_t seed = 1; seed <= 12; ++seed) {
        srp_scene *scene = soup(seed, 1 + 61 * (seed - 1), pow(10.0, (double)seed - 6.0));
        compare_with_all(scene, 3000 / SLOWER, seed);
        srp_scene_destroy(scene);
    }
}
END_TEST

START_TEST(nothing_is_left_out_of_models) {
    for (size_t k = 0; k < MODEL_COUNT; ++k) {
        model_file model = model_read(MODEL_NAMES[k]);
        srp_scene *scene = model_scene(&model);
        compare_with_all(scene, (3000000 / (scene->facet_count + 300) + 50) / SLOWER, 90 + k);
        srp_scene_destroy(scene);
        model_free(&model);
    }
}
END_TEST

/* ---- tightness ---- */

/* Rays from inside a closed body, and from its inner side, at edges and vertices: each hits. */
static void shoot_at_seams(const srp_scene *scene, srp_vec3 inside, size_t count, uint64_t seed) {
    srp_bvh *bvh = build_on(scene, 2);
    srp_ray *rays = malloc(BATCH * sizeof *rays);
    srp_hit *hits = malloc(BATCH * sizeof *hits);
    ck_assert(rays != NULL && hits != NULL);
    uint64_t state = seed;
    size_t leaks = 0;
    for (size_t done = 0; done < count; done += BATCH) {
        for (size_t k = 0; k < BATCH; ++k) {
            place_kind kind = k % 3 == 0 ? VERTEX : EDGE;
            srp_vec3 to = place_on(scene, random_facet(scene, &state), kind, &state);
            srp_vec3 o = srp_vec3_add(inside, random_point(&state, 0.3));
            rays[k] = (srp_ray){o, srp_vec3_sub(to, o), SRP_NO_NEIGHBOUR};
            if (k % 4 == 3) {
                rays[k] = leave(scene, random_facet(scene, &state), -1.0, kind, &state);
            }
        }
        srp_bvh_hit_many(bvh, BATCH, rays, hits);
        for (size_t k = 0; k < BATCH; ++k) {
            leaks += hits[k].facet == SRP_NO_NEIGHBOUR || !hits[k].back ||
                     (k % 4 != 3 && fabs(hits[k].t - 1.0) > 1e-9);
        }
    }
    ck_assert_msg(leaks == 0, "%zu of %zu rays leak", leaks, count);
    free(rays);
    free(hits);
    srp_bvh_destroy(bvh);
}

START_TEST(no_ray_slips_through_a_seam) {
    const size_t million = 1000000 / SLOWER;
    for (int k = 0; k < 2; ++k) {
        srp_scene *scene = turned_model(k == 0 ? "icosphere-1280" : "icosphere-80", 11);
        shoot_at_seams(scene, ZERO, (k == 0 ? 6 : 2) * million, 21);
        srp_scene_destroy(scene);
        scene = turned_model("cube", 12 + (uint64_t)k);
        shoot_at_seams(scene, ZERO, million, 22);
        srp_scene_destroy(scene);
    }
    /* Unturned: edges along the axes, vertices at round numbers. */
    model_file model = model_read("cube");
    srp_scene *scene = model_scene(&model);
    shoot_at_seams(scene, ZERO, million, 23);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

/* Light inside a closed body stays there, hit after hit. */
START_TEST(no_ray_leaves_a_closed_body) {
    static const char *const NAMES[] = {"cube", "icosphere-80", "icosphere-1280"};
    uint64_t state = 9;
    srp_ray rays[BATCH];
    srp_hit hits[BATCH];
    for (int m = 0; m < 3; ++m) {
        srp_scene *scene = turned_model(NAMES[m], 50 + (uint64_t)m);
        srp_bvh *bvh = build_on(scene, 1);
        for (size_t k = 0; k < BATCH; ++k) {
            rays[k] = (srp_ray){ZERO, random_direction(&state), SRP_NO_NEIGHBOUR};
        }
        for (int bounce = 0; bounce < 100 / SLOWER; ++bounce) {
            srp_bvh_hit_many(bvh, BATCH, rays, hits);
            for (size_t k = 0; k < BATCH; ++k) {
                ck_assert(hits[k].facet != SRP_NO_NEIGHBOUR && hits[k].back);
                srp_vec3 at = srp_vec3_add_scaled(rays[k].origin, hits[k].t, rays[k].direction);
                rays[k] = leave(scene, hits[k].facet, -1.0, INTERIOR, &state);
                rays[k].origin = at;
            }
        }
        srp_bvh_destroy(bvh);
        srp_scene_destroy(scene);
    }
}
END_TEST

/* A convex body does not see itself, from wherever on a facet and however flat a ray leaves. */
START_TEST(a_convex_body_does_not_see_itself) {
    static const char *const NAMES[] = {"cube", "icosphere-80", "icosphere-1280"};
    uint64_t state = 3;
    for (int k = 0; k < 6; ++k) {
        srp_scene *scene = turned_model(NAMES[k % 3], 100 + (uint64_t)k);
        srp_bvh *bvh = build_on(scene, 1);
        for (int n = 0; n < 100000 / SLOWER; ++n) {
            srp_ray ray =
                leave(scene, random_facet(scene, &state), 1.0, (place_kind)(n % 3), &state);
            srp_hit hit;
            ck_assert(!srp_bvh_hit(bvh, ray.origin, ray.direction, ray.from, &hit));
            /* Not because it is not asked. */
            if (n < 200) {
                ck_assert_uint_eq(ask_all(bvh, &ray).facet, SRP_NO_NEIGHBOUR);
            }
        }
        srp_bvh_destroy(bvh);
        srp_scene_destroy(scene);
    }
}
END_TEST

/* From the edge of a concave pair, started a rounding error behind the other plate: still hit by a
 * ray that goes to it, at no distance; not by one that goes away. */
START_TEST(a_start_behind_a_concave_neighbour_is_mended) {
    const double tilt = 0.7;
    srp_vec3 up = srp_vec3_make(0.0, cos(tilt), sin(tilt));
    srp_vec3 vertices[6] = {{0.0, 0.0, 0.0},  {1.3, 0.0, 0.0},    {0.0, -1.1, 0.0},
                            {1.3, -1.1, 0.0}, {up.x, up.y, up.z}, {1.3 + up.x, up.y, up.z}};
    static const srp_triangle triangles[4] = {{{2, 3, 1}}, {{2, 1, 0}}, {{0, 1, 5}}, {{0, 5, 4}}};
    srp_scene *scene = shape_scene(shape_mesh(vertices, 6, triangles, 4, "m"), OPTICS);
    srp_bvh *bvh = build_on(scene, 1);
    for (int step = -3; step <= 3; ++step) {
        /* Behind the wall for step > 0. */
        srp_vec3 o = srp_vec3_make(0.61, 1e-16 * step, 0.0);
        srp_hit hit;
        srp_vec3 into = srp_vec3_make(0.1, 1.0, 0.2), away = srp_vec3_make(0.1, -1.0, 0.2);
        ck_assert(srp_bvh_hit(bvh, o, into, 1, &hit));
        ck_assert(hit.facet >= 2 && !hit.back && hit.t >= 0.0 && hit.t < 1e-12);
        ck_assert(!srp_bvh_hit(bvh, o, away, 1, &hit));
    }
    srp_bvh_destroy(bvh);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(the_other_side_of_a_shell_is_not_hit) {
    srp_vec3 vertices[4] = {{0.1, 0.2, 0.3}, {1.7, 0.1, 0.4}, {1.5, 1.9, 0.8}, {0.2, 1.4, 0.6}};
    static const srp_triangle triangles[4] = {{{0, 1, 2}}, {{0, 2, 3}}, {{0, 2, 1}}, {{0, 3, 2}}};
    srp_scene *scene = shape_scene(shape_mesh(vertices, 4, triangles, 4, "m"), OPTICS);
    srp_bvh *bvh = build_on(scene, 1);
    uint64_t state = 8;
    for (int n = 0; n < 3000; ++n) {
        srp_ray ray = leave(scene, (uint32_t)n % 4, 1.0, INTERIOR, &state);
        srp_hit hit = {0.0, SRP_NO_NEIGHBOUR, false};
        bool any = srp_bvh_hit(bvh, ray.origin, ray.direction, ray.from, &hit);
        /* The pair is bent: the neighbour may be seen, the opposite never at the start. */
        ck_assert(!any || hit.t > 1e-12 || hit.facet % 2 != ray.from % 2);
    }
    srp_bvh_destroy(bvh);
    srp_scene_destroy(scene);
}
END_TEST

/* ---- odd input ---- */

START_TEST(odd_meshes_are_searched_like_others) {
    enum { COUNT = 1000 };
    srp_vec3 vertices[3 * COUNT];
    srp_triangle triangles[COUNT];
    for (int kind = 0; kind < 4; ++kind) {
        uint64_t state = 40 + (uint64_t)kind;
        for (size_t k = 0; k < COUNT; ++k) {
            double i = (double)(k % 32), j = (double)(k / 32);
            srp_vec3 at = srp_vec3_make(0.31 * i, 0.17 * j, 0.0); /* flat */
            double side = 0.2, sliver = 1.0;
            if (kind == 0) { /* all at one place */
                at = srp_vec3_make(0.7, 0.2, 0.4);
            } else if (kind == 1) { /* a million times longer than wide */
                at = random_point(&state, 1.0);
                sliver = 1e-6;
            } else if (kind == 2) { /* sizes over twelve orders */
                side = pow(10.0, -12.0 * random_unit(&state));
                at = random_point(&state, 3.0 * side);
            }
            for (size_t e = 0; e < 3; ++e) {
                triangles[k].v[e] = (uint32_t)(3 * k + e);
                vertices[3 * k + e] = at;
            }
            vertices[3 * k + 1].x += side;
            vertices[3 * k + 1].y += 0.3 * side;
            vertices[3 * k + 2].x += 0.4 * side;
            vertices[3 * k + 2].y += side * (kind == 1 ? 0.12 + sliver : 1.0);
        }
        srp_scene *scene =
            shape_scene(shape_mesh(vertices, 3 * COUNT, triangles, COUNT, "m"), OPTICS);
        compare_with_all(scene, 1500 / SLOWER, 60 + (uint64_t)kind);
        srp_scene_destroy(scene);
    }
}
END_TEST

START_TEST(far_starts_find_what_near_ones_do) {
    srp_scene *scene = turned_model("icosphere-80", 31);
    srp_bvh *bvh = build_on(scene, 1);
    uint64_t state = 6;
    for (int n = 0; n < 2000; ++n) {
        srp_vec3 d = random_direction(&state), to = random_point(&state, 0.9);
        double away = pow(2.0, 1.0 + (double)(n % 30));
        srp_hit near = {0.0, SRP_NO_NEIGHBOUR, false}, far = near;
        srp_vec3 o = srp_vec3_add_scaled(to, -away, d);
        /* As far as the far start can tell where it is. */
        srp_vec3 closer = srp_vec3_add_scaled(o, away - 2.0, d);
        (void)srp_bvh_hit(bvh, closer, d, SRP_NO_NEIGHBOUR, &near);
        (void)srp_bvh_hit(bvh, o, d, SRP_NO_NEIGHBOUR, &far);
        ck_assert((near.facet == SRP_NO_NEIGHBOUR) == (far.facet == SRP_NO_NEIGHBOUR));
        if (far.facet != SRP_NO_NEIGHBOUR && far.facet == near.facet) {
            assert_close(far.t, near.t + away - 2.0, 1e-14, 1e-13);
        }
    }
    srp_bvh_destroy(bvh);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(the_tree_is_the_same_for_any_number_of_threads) {
    srp_scene *scene = turned_model("gnss", 3);
    srp_bvh *one = build_on(scene, 1);
    static const int THREADS[] = {2, 3, 5};
    for (int k = 0; k < 3; ++k) {
        srp_bvh *other = build_on(scene, THREADS[k]);
        ck_assert_uint_eq(one->node_count, other->node_count);
        ck_assert_uint_eq(one->block_count, other->block_count);
        ck_assert_mem_eq(one->nodes, other->nodes, one->node_count * sizeof *one->nodes);
        ck_assert_mem_eq(one->blocks, other->blocks, one->block_count * sizeof *one->blocks);
        ck_assert_mem_eq(one->leaving, other->leaving, scene->facet_count * sizeof *one->leaving);
        srp_bvh_destroy(other);
    }
    /* Compact: blocks nearly full. */
    ck_assert_uint_le(one->block_count * 6, scene->facet_count);
    srp_bvh_destroy(one);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(no_rays_is_a_batch) {
    srp_scene *scene = turned_model("cube", 3);
    srp_bvh *bvh = build_on(scene, 1);
    srp_bvh_hit_many(bvh, 0, NULL, NULL);
    srp_bvh_destroy(bvh);
    srp_bvh_destroy(NULL);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(what_has_no_facets_is_refused) {
    srp_error error;
    srp_bvh *bvh = NULL;
    srp_scene *scene = NULL;
    assert_ok(srp_scene_from_sphere(1.2, 3.4, &scene, &error), error);
    ck_assert_int_eq(srp_bvh_create(scene, 1, &bvh, &error), SRP_BAD_ARGUMENT);
    ck_assert_ptr_nonnull(strstr(error.message, "facet"));
    srp_scene_destroy(scene);
    scene = turned_model("cube", 1);
    ck_assert_int_eq(srp_bvh_create(scene, 0, &bvh, &error), SRP_BAD_ARGUMENT);
    ck_assert_ptr_nonnull(strstr(error.message, "threads"));
    ck_assert_ptr_null(bvh);
    srp_scene_destroy(scene);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("bvh");
    TCase *cases = tcase_create("bvh");
    tcase_set_timeout(cases, 120);
    tcase_add_test(cases, a_ray_finds_both_sides_of_a_box);
    tcase_add_test(cases, nearest_hits_are_those_of_another_test);
    tcase_add_test(cases, nothing_is_left_out_of_soups);
    tcase_add_test(cases, nothing_is_left_out_of_models);
    tcase_add_test(cases, no_ray_slips_through_a_seam);
    tcase_add_test(cases, no_ray_leaves_a_closed_body);
    tcase_add_test(cases, a_convex_body_does_not_see_itself);
    tcase_add_test(cases, a_start_behind_a_concave_neighbour_is_mended);
    tcase_add_test(cases, the_other_side_of_a_shell_is_not_hit);
    tcase_add_test(cases, odd_meshes_are_searched_like_others);
    tcase_add_test(cases, far_starts_find_what_near_ones_do);
    tcase_add_test(cases, the_tree_is_the_same_for_any_number_of_threads);
    tcase_add_test(cases, no_rays_is_a_batch);
    tcase_add_test(cases, what_has_no_facets_is_refused);
    suite_add_tcase(suite, cases);
    return run_suite(suite);
}
