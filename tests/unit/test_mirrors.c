/* SPDX-License-Identifier: Apache-2.0 */
/* Mirrored beams, followed exactly: closed forms, bookkeeping, and agreement with sampled ones. */
#include "bounce.h"
#include "method_internal.h"
#include "model_files.h"
#include "prepared.h"
#include "raytrace.h"
#include "shapes.h"
#include "srp_check.h"

#include <string.h>

static const srp_optics MIRROR = {1.0, 0.0, false};

static srp_method_params params_of(uint32_t reflections, uint32_t beams) {
    srp_method_params params = srp_method_params_default();
    params.threads = 1;
    params.reflections = reflections;
    params.mirrored_beams = beams;
    return params;
}

/* Exactly: nothing is sampled, and nothing is said to have been. */
static srp_response solve(const srp_scene *scene, uint32_t reflections, srp_vec3 reference,
                          srp_vec3 s) {
    srp_method_params params = params_of(reflections, UINT32_MAX);
    params.reference = reference;
    srp_prepared *prepared = prepare_with(&srp_method_raytrace, scene, &params);
    srp_response response = respond_to(prepared, s);
    srp_prepared_release(prepared);
    ck_assert(response.samples == 0 && response.flags == 0);
    ck_assert(response.f_error == 0.0 && response.t_error == 0.0);
    return response;
}

static srp_vec3 unit(double x, double y, double z) {
    srp_vec3 v = srp_vec3_make(x, y, z);
    return srp_vec3_scale(1.0 / srp_vec3_norm(v), v);
}

static const srp_vec3 ORIGIN = {0.0, 0.0, 0.0};

/* ---- closed forms ---- */

START_TEST(dihedral_sends_light_back) {
    model_file model = model_read("dihedral");
    srp_scene *scene = model_scene(&model);
    const srp_vec3 s = {sqrt(0.5), sqrt(0.5), 0.0}, reference = {0.3, -0.2, 0.7};
    for (uint32_t reflections = 0; reflections <= 3; ++reflections) {
        srp_response got = solve(scene, reflections, reference, s);
        double hits = reflections == 0 ? 1.0 : 2.0;
        srp_vec3 want = srp_vec3_scale(-hits * sqrt(2.0), s);
        printf("dihedral, %u bounces: |f| %.15f, off by %.1e\n", reflections, srp_vec3_norm(got.f),
               srp_vec3_norm(srp_vec3_sub(got.f, want)));
        assert_vec3_close(got.f, want, 1e-12, 0.0);
        /* Both plates are lit evenly, once or twice. */
        srp_vec3 lever = srp_vec3_sub(srp_vec3_make(0.5, 0.5, 0.5), reference);
        assert_vec3_close(got.t, srp_vec3_cross(lever, want), 1e-12, 0.0);
        /* What leaves the second mirror meets nothing more, but only who looks knows. */
        assert_close(got.unresolved, reflections <= 1 ? 1.0 : 0.0, 0.0, 1e-12);
    }
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

typedef struct returned {
    srp_vec3 s;
    double flux, lost, least;
} returned;

static void sum_returned(void *user, const srp_bounce_event *event) {
    returned *sum = user;
    if (event->step == SRP_BOUNCE_ESCAPES || event->step == SRP_BOUNCE_IS_CUT) {
        bool back = srp_vec3_norm(srp_vec3_sub(event->direction, sum->s)) < 1e-12;
        *(back ? &sum->flux : &sum->lost) += event->flux;
        sum->least = fmin(sum->least, event->flux);
    }
}

START_TEST(corner_cube_sends_light_back) {
    srp_scene *scene = shape_corner_cube();
    const srp_vec3 along = unit(1.0, 1.0, 1.0), askew = unit(0.8, 0.7, 0.45);
    srp_response got = solve(scene, 2, ORIGIN, along);
    printf("corner cube: |f| %.15f of %.15f\n", srp_vec3_norm(got.f),
           2.0 * shape_corner_cube_returns(along));
    assert_vec3_close(got.f, srp_vec3_scale(-2.0 * shape_corner_cube_returns(along), along), 1e-12,
                      0.0);

    /* Askew, light that misses a mirror escapes elsewhere; what comes back pushes twice. */
    returned sum = {.s = askew, .least = 0.0};
    srp_method_params params = params_of(3, UINT32_MAX);
    srp_prepared *prepared = prepare_with(&srp_method_raytrace, scene, &params);
    srp_raytrace_watch(prepared, sum_returned, &sum);
    got = respond_to(prepared, askew);
    printf("corner cube, askew: %.15f of %.6f returned, %.15f expected\n", sum.flux, got.lit_area,
           shape_corner_cube_returns(askew));
    assert_close(sum.flux, shape_corner_cube_returns(askew), 1e-12, 0.0);
    assert_close(sum.flux + sum.lost, got.lit_area, 1e-12, 0.0);
    ck_assert(sum.least > -1e-12);
    assert_close(got.unresolved, 0.0, 0.0, 1e-12);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}
END_TEST

/* Axis-aligned rectangle in a plane of constant z, two triangles, its outside up or down. */
static srp_mesh *rectangle(const double *x, const double *y, double z, bool up,
                           const char *material) {
    const srp_vec3 v[4] = {{x[0], y[0], z}, {x[1], y[0], z}, {x[1], y[1], z}, {x[0], y[1], z}};
    const srp_triangle t[2] = {{{0, up ? 1 : 2, up ? 2 : 1}}, {{0, up ? 2 : 3, up ? 3 : 2}}};
    return shape_mesh(v, 4, t, 2, material);
}

/* Interval a moved by `by`, within b. */
static void common(const double *a, double by, const double *b, double *out) {
    out[0] = fmax(a[0] + by, b[0]);
    out[1] = fmax(fmin(a[1] + by, b[1]), out[0]);
}

/*
 * A plate at the height h over a mirror, facing down. Going down from the plate to the mirror light
 * moves by d = -h (s_x, s_y) / s_z, and by d again on its way back up. The plate shades the mirror
 * in its own outline moved by d, and of the mirror's outline moved by d what meets the plate, less
 * its own outline moved by 2 d, is the light that it gets from below.
 */
START_TEST(plate_over_a_mirror) {
    static const srp_optics PLATE = {0.31, 0.23, false};
    const double mx[2] = {-1.13, 1.07}, my[2] = {-0.82, 0.94};
    const double px[2] = {0.21, 1.64}, py[2] = {-0.31, 1.29}, h = 0.57;
    const srp_vec3 s = unit(-0.31, 0.23, 0.87), reference = {0.4, 1.3, -0.7};
    srp_mesh *mesh = rectangle(mx, my, 0.0, true, "mirror");
    shape_join(mesh, rectangle(px, py, h, false, "plate"));
    srp_materials *materials;
    srp_scene *scene;
    srp_error error;
    assert_ok(srp_materials_create(&materials, &error), error);
    assert_ok(srp_materials_set(materials, "mirror", MIRROR, false, &error), error);
    assert_ok(srp_materials_set(materials, "plate", PLATE, false, &error), error);
    assert_ok(srp_scene_from_mesh(mesh, materials, &scene, &error), error);
    srp_response got = solve(scene, 1, reference, s);

    double dx = -h * s.x / s.z, dy = -h * s.y / s.z;
    double lit_x[2], lit_y[2], dark_x[2], dark_y[2];
    common(mx, dx, px, lit_x);
    common(my, dy, py, lit_y);
    common(px, 2.0 * dx, lit_x, dark_x);
    common(py, 2.0 * dy, lit_y, dark_y);
    double whole = (lit_x[1] - lit_x[0]) * (lit_y[1] - lit_y[0]);
    double dark = (dark_x[1] - dark_x[0]) * (dark_y[1] - dark_y[0]);
    ck_assert(dark > 0.1 && whole > 1.5 * dark);
    double area = whole - dark;
    srp_vec3 centre = {
        0.5 * (whole * (lit_x[0] + lit_x[1]) - dark * (dark_x[0] + dark_x[1])) / area,
        0.5 * (whole * (lit_y[0] + lit_y[1]) - dark * (dark_y[0] + dark_y[1])) / area, h};
    /* PHYSICS: F = -A c [(1 - rho_s) s + 2 (rho_s c + rho_d / 3) n], the Sun mirrored below. */
    srp_vec3 below = {s.x, s.y, -s.z}, down = {0.0, 0.0, -1.0};
    srp_vec3 push = srp_vec3_scale(1.0 - PLATE.rho_s, below);
    push = srp_vec3_add_scaled(push, 2.0 * (PLATE.rho_s * s.z + PLATE.rho_d / 3.0), down);
    push = srp_vec3_scale(-area * s.z, push);
    assert_vec3_close(got.f_bounce, push, 1e-12, 0.0);
    assert_vec3_close(got.t_bounce, srp_vec3_cross(srp_vec3_sub(centre, reference), push), 1e-12,
                      0.0);
    srp_scene_destroy(scene);
    srp_materials_destroy(materials);
    srp_mesh_destroy(mesh);
}
END_TEST

/*
 * A wall that stands in a slit of the mirror, 0.2 above it and 1 below. Light comes from the left,
 * 60 degrees above the mirror; what the left half mirrors meets the wall where it is less than 0.2
 * / tan 60 away. What the right half mirrors has the lower part of the wall behind it only.
 */
START_TEST(nothing_behind_a_mirror_is_hit) {
    const double left[2] = {-0.5, 0.5}, y[2] = {-3.0, 3.0};
    srp_mesh *mesh = rectangle(left, y, 0.0, true, "mirror");
    const srp_vec3 v[4] = {{0.0, -3.0, -1.0}, {0.0, 3.0, -1.0}, {0.0, 3.0, 0.2}, {0.0, -3.0, 0.2}};
    const srp_triangle t[2] = {{{0, 1, 2}}, {{0, 2, 3}}};
    shape_join(mesh, shape_mesh(v, 4, t, 2, "mirror"));
    srp_scene *scene = shape_scene(mesh, MIRROR);
    const srp_vec3 s = {-0.5, 0.0, sqrt(0.75)};
    srp_response got = solve(scene, 1, ORIGIN, s);
    /* Bounce: mirror to wall, and wall to mirror on the same strip. */
    double strip = 6.0 * 0.2 * 0.5; /* cross-section */
    srp_vec3 on_wall = srp_vec3_scale(strip * 2.0 * 0.5, srp_vec3_make(1.0, 0.0, 0.0));
    srp_vec3 on_mirror = srp_vec3_scale(strip * 2.0 * sqrt(0.75), srp_vec3_make(0.0, 0.0, -1.0));
    assert_vec3_close(got.f_bounce, srp_vec3_add(on_wall, on_mirror), 1e-12, 0.0);
    srp_scene_destroy(scene);
}
END_TEST

/* Two mirrors of 1 mm, 20 degrees apart, where the body's origin is and 1.3 km from it. */
START_TEST(small_mirrors_far_away_lose_no_beam) {
    const double size = 1e-3, c = cos(0.349065850398866), n = sin(0.349065850398866);
    const srp_vec3 s = unit(0.93, 0.1, 0.34);
    srp_response at[2];
    for (int k = 0; k < 2; ++k) {
        srp_vec3 o = k == 0 ? ORIGIN : srp_vec3_make(1000.0, -700.0, 300.0);
        const srp_vec3 v[6] = {{0, 0, 0},
                               {0, size, 0},
                               {size, 0, 0},
                               {size, size, 0},
                               {c * size, 0, n * size},
                               {c * size, size, n * size}};
        srp_vec3 moved[6];
        for (int i = 0; i < 6; ++i) {
            moved[i] = srp_vec3_add(v[i], o);
        }
        const srp_triangle t[4] = {{{0, 2, 3}}, {{0, 3, 1}}, {{0, 1, 5}}, {{0, 5, 4}}};
        srp_scene *scene = shape_scene(shape_mesh(moved, 6, t, 4, "mirror"), MIRROR);
        at[k] = solve(scene, 6, o, s);
        srp_scene_destroy(scene);
    }
    printf("mirrors of 1 mm: bounce %.6e m^2, off by %.1e 1.3 km away\n",
           srp_vec3_norm(at[0].f_bounce),
           srp_vec3_norm(srp_vec3_sub(at[0].f_bounce, at[1].f_bounce)));
    ck_assert(srp_vec3_norm(at[0].f_bounce) > 1e-7);
    assert_vec3_close(at[1].f_bounce, at[0].f_bounce, 1e-8, 0.0);
    assert_close(at[1].unresolved, at[0].unresolved, 0.0, 1e-8);
}
END_TEST

/* ---- bookkeeping ---- */

typedef struct account {
    const srp_scene *scene;
    srp_vec3 in, out, push;
    double least;
    int steps[4];
} account;

/* Of the push of what starts here, direct light has the rest: flux (d - rho_s d'). */
static void keep_account(void *user, const srp_bounce_event *event) {
    account *books = user;
    const srp_facet *facet = &books->scene->facets[event->facet];
    srp_vec3 momentum = srp_vec3_scale(event->flux, event->direction);
    srp_optics optics = srp_bounce_optics(books->scene, event->facet, event->back);
    srp_vec3 mirrored = srp_vec3_mirrored(event->direction, facet->normal);
    books->least = fmin(books->least, event->flux);
    ++books->steps[event->step];
    switch (event->step) {
    case SRP_BOUNCE_STARTS:
        books->in = srp_vec3_add(books->in, momentum);
        momentum = srp_vec3_add_scaled(momentum, -optics.rho_s * event->flux, mirrored);
        books->push = srp_vec3_add(books->push, momentum);
        break;
    case SRP_BOUNCE_HITS:
        books->push = srp_vec3_add(books->push, event->push);
        break;
    case SRP_BOUNCE_ESCAPES:
    case SRP_BOUNCE_IS_CUT:
        books->out = srp_vec3_add(books->out, momentum);
        break;
    }
}

/* Random triangles, large beside their distances: they cut through each other. */
static srp_scene *random_scene(uint64_t *random, uint32_t count, srp_optics optics) {
    srp_vec3 v[3 * 32];
    srp_triangle t[32];
    ck_assert_uint_le(count, 32);
    for (uint32_t k = 0; k < 3 * count; ++k) {
        v[k] = srp_vec3_scale(0.3 + random_unit(random), random_direction(random));
        t[k / 3].v[k % 3] = k;
    }
    return shape_scene(shape_mesh(v, 3 * count, t, count, "mirror"), optics);
}

static void check_books(const srp_scene *scene, uint32_t reflections, srp_vec3 s, int *hits) {
    srp_method_params params = params_of(reflections, UINT32_MAX);
    account books = {.scene = scene};
    srp_prepared *prepared = prepare_with(&srp_method_raytrace, scene, &params);
    srp_raytrace_watch(prepared, keep_account, &books);
    srp_response got = respond_to(prepared, s);
    double scale = scene->radius * scene->radius;
    ck_assert(got.samples == 0);
    assert_vec3_close(srp_vec3_sub(books.in, books.out), books.push, 0.0, 1e-12 * scale);
    /* No beam lights more than its own cross-section. */
    ck_assert_msg(books.least > -1e-12 * scale, "flux of %g", books.least);
    *hits += books.steps[SRP_BOUNCE_HITS];
    srp_prepared_release(prepared);
}

START_TEST(momentum_is_kept) {
    static const char *const names[] = {"dihedral", "dish", "sun-shield", "box-wing"};
    model_file model = model_read(names[_i]);
    srp_scene *scene = model_scene_painted(&model, (srp_optics){0.7, 0.0, _i == 2});
    uint64_t random = 11;
    int hits = 0;
    for (uint32_t k = 0; k < 3; ++k) {
        check_books(scene, 1 + k, k == 0 ? unit(0.48, 0.6, 0.64) : random_direction(&random),
                    &hits);
    }
    ck_assert(hits > 0);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

START_TEST(momentum_is_kept_among_random_mirrors) {
    uint64_t random = 23;
    int hits = 0;
    for (uint32_t k = 0; k < 200; ++k) {
        srp_scene *scene = random_scene(&random, 2 + k % 15, (srp_optics){0.9, 0.0, k % 3 == 0});
        check_books(scene, 1 + k % 4, random_direction(&random), &hits);
        srp_scene_destroy(scene);
    }
    printf("random mirrors: %d lit parts behind mirrors\n", hits);
    ck_assert_int_gt(hits, 2000);
}
END_TEST

/* ---- what else must hold ---- */

/* Turned together with the Sun, a scene is pushed the same; mirrored, like its mirror image. */
START_TEST(beams_turn_with_the_scene) {
    static const char *const names[] = {"dihedral", "box-wing", "dish", "sun-shield"};
    model_file model = model_read(names[_i]);
    srp_scene *scene = model_scene(&model);
    uint64_t random = 3;
    double worst = 0.0;
    for (int k = 0; k < 6; ++k) {
        turn t = turn_random(&random);
        t = k % 2 == 0 ? t : turn_mirrored(t);
        srp_scene *turned = model_scene_turned(&model, &t);
        srp_vec3 s = random_direction(&random);
        srp_response want = solve(scene, 3, ORIGIN, s);
        srp_response got = solve(turned, 3, ORIGIN, turn_apply(&t, s));
        srp_vec3 f = turn_apply(&t, want.f);
        worst = fmax(worst, srp_vec3_norm(srp_vec3_sub(got.f, f)) / srp_vec3_norm(f));
        srp_scene_destroy(turned);
    }
    printf("%s turned with the Sun: off by %.1e of the force\n", names[_i], worst);
    ck_assert(worst < 1e-12);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

static bool agree(srp_vec3 sampled, srp_vec3 exact, double error, double scale) {
    return srp_vec3_norm(srp_vec3_sub(sampled, exact)) <= 3.0 * error + 1e-9 * scale;
}

/* Rays through a hierarchy of boxes share no code with beams. */
START_TEST(samples_converge_to_beams) {
    uint64_t random = 5;
    int cases = 0, within = 0, bounced = 0;
    for (uint32_t k = 0; k < 60; ++k) {
        srp_scene *scene = random_scene(&random, 3 + k % 20, (srp_optics){0.8, 0.1, k % 4 == 0});
        srp_vec3 s = random_direction(&random);
        srp_method_params params = params_of(1 + k % 3, 0);
        srp_prepared *prepared = prepare_with(&srp_method_raytrace, scene, &params);
        srp_response got = respond_to(prepared, s);
        srp_response want = solve(scene, 1 + k % 3, ORIGIN, s);
        double scale = scene->radius * scene->radius;
        ++cases;
        bounced += srp_vec3_norm(want.f_bounce) > 1e-3 * scale;
        within += agree(got.f, want.f, got.f_error, scale) &&
                  agree(got.t, want.t, got.t_error, scale * scene->radius);
        assert_close(got.unresolved, want.unresolved, 0.0, 1e-2);
        assert_vec3_close(got.f, want.f, 0.0, 1e-3 * scale);
        srp_prepared_release(prepared);
        srp_scene_destroy(scene);
    }
    printf("random mirrors: %d of %d sampled within 3 errors of exact, %d with bounces\n", within,
           cases, bounced);
    ck_assert_int_ge(within, cases * 95 / 100);
    ck_assert_int_ge(bounced, cases / 2);
}
END_TEST

START_TEST(models_agree_with_samples) {
    static const char *const names[] = {"box-wing", "dish", "sun-shield", "gnss"};
    model_file model = model_read(names[_i]);
    srp_scene *scene = model_scene(&model);
    uint64_t random = 17;
    int within = 0, cases = _i == 3 ? 3 : 8;
    for (int k = 0; k < cases; ++k) {
        srp_vec3 s = random_direction(&random);
        srp_method_params params = params_of(2, 0);
        srp_prepared *prepared = prepare_with(&srp_method_raytrace, scene, &params);
        srp_response got = respond_to(prepared, s);
        srp_response want = solve(scene, 2, ORIGIN, s);
        ck_assert((got.flags & SRP_RESPONSE_MIRRORS_SAMPLED) != 0 || got.samples == 0);
        within += agree(got.f, want.f, got.f_error, scene->radius * scene->radius);
        srp_prepared_release(prepared);
    }
    printf("%s: %d of %d sampled within 3 errors of exact\n", names[_i], within, cases);
    ck_assert_int_ge(within, cases - 1);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

/* The limit is kept, said, and leaves nothing of what was begun behind. */
START_TEST(too_many_beams_are_sampled) {
    model_file model = model_read("sun-shield");
    srp_scene *scene = model_scene(&model);
    const srp_vec3 s = unit(0.82, 0.49, 0.29);
    srp_response plain, limited;
    srp_method_params params = params_of(2, 0);
    srp_prepared *prepared = prepare_with(&srp_method_raytrace, scene, &params);
    plain = respond_to(prepared, s);
    srp_prepared_release(prepared);
    ck_assert(plain.flags == SRP_RESPONSE_MIRRORS_SAMPLED && plain.samples > 0);
    for (uint32_t limit = 1; limit <= 1000; limit *= 10) {
        params = params_of(2, limit);
        prepared = prepare_with(&srp_method_raytrace, scene, &params);
        limited = respond_to(prepared, s);
        ck_assert_mem_eq(&plain, &limited, sizeof plain);
        srp_prepared_release(prepared);
    }
    /* Diffuse light is sampled beside exact mirrors, and is all that errs. */
    params = params_of(2, UINT32_MAX);
    params.diffuse = 2;
    prepared = prepare_with(&srp_method_raytrace, scene, &params);
    srp_response both = respond_to(prepared, s);
    srp_prepared_release(prepared);
    ck_assert(both.flags == 0 && both.samples > 0 && both.f_error > 0.0);
    params.mirrored_beams = 0;
    prepared = prepare_with(&srp_method_raytrace, scene, &params);
    srp_response sampled = respond_to(prepared, s);
    srp_prepared_release(prepared);
    ck_assert(both.f_error < sampled.f_error && both.samples == sampled.samples);
    assert_vec3_close(both.f, sampled.f, 0.0, 4.0 * sampled.f_error);
    assert_close(both.unresolved, sampled.unresolved, 0.0, 1e-3);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

START_TEST(bits_do_not_depend_on_threads) {
    model_file model = model_read("sun-shield");
    srp_scene *scene = model_scene(&model);
    static const int THREADS[] = {1, 2, 3, 5};
    srp_vec3 s[7];
    srp_response first[7], got[7];
    srp_error error;
    uint64_t random = 29;
    for (int k = 0; k < 7; ++k) {
        s[k] = random_direction(&random);
    }
    for (int n = 0; n < 4; ++n) {
        srp_method_params params = params_of(2, 8192);
        params.threads = THREADS[n];
        srp_prepared *prepared = prepare_with(&srp_method_raytrace, scene, &params);
        srp_response *out = n == 0 ? first : got;
        assert_ok(srp_prepared_respond(prepared, 7, s, out, NULL, &error), error);
        srp_prepared_release(prepared);
        ck_assert_mem_eq(out, first, sizeof first);
    }
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("mirrors");
    TCase *tcase = tcase_create("mirrors");
    tcase_set_timeout(tcase, 300.0);
    tcase_add_test(tcase, dihedral_sends_light_back);
    tcase_add_test(tcase, corner_cube_sends_light_back);
    tcase_add_test(tcase, plate_over_a_mirror);
    tcase_add_test(tcase, nothing_behind_a_mirror_is_hit);
    tcase_add_test(tcase, small_mirrors_far_away_lose_no_beam);
    tcase_add_loop_test(tcase, momentum_is_kept, 0, 4);
    tcase_add_test(tcase, momentum_is_kept_among_random_mirrors);
    tcase_add_loop_test(tcase, beams_turn_with_the_scene, 0, 4);
    tcase_add_test(tcase, samples_converge_to_beams);
    tcase_add_loop_test(tcase, models_agree_with_samples, 0, 4);
    tcase_add_test(tcase, too_many_beams_are_sampled);
    tcase_add_test(tcase, bits_do_not_depend_on_threads);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
