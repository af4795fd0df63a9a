/* SPDX-License-Identifier: Apache-2.0 */
/* Reflected light against closed forms, its bookkeeping, and what it must not depend on. That many
 * bounces agree with the paper's recursion is test_recursion.c, that the errors are honest
 * test_bounce_error.c. */
#include "bounce.h"
#include "method_internal.h"
#include "model_files.h"
#include "prepared.h"
#include "raytrace.h"
#include "shapes.h"
#include "srp_check.h"
#include "table_internal.h"

#include <srp/const.h>

#include <string.h>

static srp_method_params params_of(uint32_t reflections, uint32_t diffuse) {
    srp_method_params params = srp_method_params_default();
    params.threads = 1;
    params.reflections = reflections;
    params.diffuse = diffuse;
    params.mirrored_beams = 0; /* all is sampled; what is not: test_mirrors.c */
    return params;
}

static srp_response trace(const srp_scene *scene, const srp_method_params *params, srp_vec3 s) {
    srp_prepared *prepared = prepare_with(&srp_method_raytrace, scene, params);
    srp_response response = respond_to(prepared, s);
    srp_prepared_release(prepared);
    return response;
}

static srp_scene *scene_of(const char *name) {
    model_file model = model_read(name);
    srp_scene *scene = model_scene(&model);
    model_free(&model);
    return scene;
}

#define assert_within(got, want, errors, error)                                                    \
    do {                                                                                           \
        double within_ = (error);                                                                  \
        ck_assert_msg(within_ > 0.0 && within_ < 0.02, "standard error %g", within_);              \
        assert_vec3_close(got, want, 0.0, (errors)*within_);                                       \
    } while (0)

/* ---- closed forms ---- */

START_TEST(dihedral_of_mirrors_turns_light_back) {
    srp_scene *scene = scene_of("dihedral");
    const srp_vec3 s = {sqrt(0.5), sqrt(0.5), 0.0};
    for (uint32_t reflections = 0; reflections <= 3; ++reflections) {
        srp_method_params params = params_of(reflections, 0);
        srp_response got = trace(scene, &params, s);
        double hits = reflections == 0 ? 1.0 : 2.0;
        printf("dihedral, %u bounces: f %.9f, error %.2g, unresolved %.6f\n", reflections,
               srp_vec3_norm(got.f), got.f_error, got.unresolved);
        srp_vec3 want = srp_vec3_scale(-hits * sqrt(2.0), s);
        if (reflections == 0) {
            assert_vec3_close(got.f, want, 1e-14, 0.0);
            ck_assert(got.f_error == 0.0);
        } else {
            assert_within(got.f, want, 3.0, got.f_error);
        }
        /* The light that leaves the second mirror meets nothing more, but only who looks knows. */
        assert_close(got.unresolved, reflections <= 1 ? 1.0 : 0.0, 0.0, 1e-3);
    }
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(l_corner_lights_itself) {
    srp_scene *scene = scene_of("l-corner");
    const srp_vec3 s = {sqrt(0.5), sqrt(0.5), 0.0};
    srp_method_params params = params_of(1, 4);
    srp_response got = trace(scene, &params, s);
    printf("L-corner: f (%.6f, %.6f, %.6f), error %.2g\n", got.f.x, got.f.y, got.f.z, got.f_error);
    ck_assert(got.f_error > 0.0 && got.f_error < 3e-4);
    /* Independent Monte Carlo, 4e6 samples; direct part sqrt(1/2) (1 + 2/3 sqrt(2)) / ... exact. */
    assert_close(got.f.x, -1.5657, 0.0, 3e-4);
    assert_close(got.f.y, -1.5657, 0.0, 3e-4);
    assert_close(got.f.z, 0.0, 0.0, 3.0 * got.f_error);
    srp_vec3 direct = srp_vec3_sub(got.f, got.f_bounce);
    assert_close(direct.x, -1.471405, 0.0, 1e-6);
    /* What is cut is what left a plate twice: the share 0.2 (their view factor) of the light. */
    assert_close(got.unresolved, 0.2000, 0.0, 3e-4);
    srp_scene_destroy(scene);
}
END_TEST

typedef struct returned {
    srp_vec3 s;
    double flux;
} returned;

static void sum_returned(void *user, const srp_bounce_event *event) {
    returned *sum = user;
    if (event->step == SRP_BOUNCE_ESCAPES &&
        srp_vec3_norm(srp_vec3_sub(event->direction, sum->s)) < 1e-12) {
        sum->flux += event->flux;
    }
}

START_TEST(corner_cube_sends_light_back) {
    srp_scene *scene = shape_corner_cube();
    const srp_vec3 s = {sqrt(1.0 / 3.0), sqrt(1.0 / 3.0), sqrt(1.0 / 3.0)};
    srp_method_params params = params_of(2, 0);
    srp_response got = trace(scene, &params, s);
    printf("corner cube: f %.9f, error %.2g\n", srp_vec3_norm(got.f), got.f_error);
    assert_close(shape_corner_cube_returns(s), sqrt(3.0), 1e-15, 0.0);
    assert_within(got.f, srp_vec3_scale(-2.0 * shape_corner_cube_returns(s), s), 3.0, got.f_error);

    const srp_vec3 askew =
        srp_vec3_scale(1.0 / srp_vec3_norm((srp_vec3){0.8, 0.7, 0.45}), (srp_vec3){0.8, 0.7, 0.45});
    returned sum = {askew, 0.0};
    params.reflections = 3;
    srp_prepared *prepared = prepare_with(&srp_method_raytrace, scene, &params);
    srp_raytrace_watch(prepared, sum_returned, &sum);
    got = respond_to(prepared, askew);
    printf("corner cube, askew: %.6f of %.6f returned, %.6f expected\n", sum.flux, got.lit_area,
           shape_corner_cube_returns(askew));
    assert_close(sum.flux, shape_corner_cube_returns(askew), 2e-4, 0.0);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}
END_TEST

/* A lit diffuse plate and a black one across from it: what a plane gains from a Lambertian one. The
 * moment follows from the places where light lands. */
START_TEST(moment_acts_where_light_lands) {
    srp_scene *scene = scene_of("dihedral");
    const srp_vec3 s = {sqrt(0.5), sqrt(0.5), 0.0};
    srp_method_params params = params_of(1, 0);
    params.reference = srp_vec3_make(0.3, -0.2, 0.7);
    srp_response got = trace(scene, &params, s);
    /* Light that lands at (0, y) comes from (y, 0): both plates are lit evenly, twice. */
    srp_vec3 centre = srp_vec3_make(0.5, 0.5, 0.5);
    srp_vec3 want =
        srp_vec3_cross(srp_vec3_sub(centre, params.reference), srp_vec3_scale(-2.0 * sqrt(2.0), s));
    assert_within(got.t, want, 3.0, got.t_error);
    srp_scene_destroy(scene);
}
END_TEST

/* ---- bookkeeping ---- */

typedef struct account {
    const srp_scene *scene;
    srp_vec3 in, out, push;
    double largest;
} account;

/* Of the push of what starts here, direct light has the rest: flux (d - rho_s d'). */
static void keep_account(void *user, const srp_bounce_event *event) {
    account *books = user;
    const srp_facet *facet = &books->scene->facets[event->facet];
    srp_vec3 momentum = srp_vec3_scale(event->flux, event->direction);
    double rho_s = books->scene->optics[facet->material].rho_s;
    srp_vec3 mirrored = srp_vec3_add_scaled(
        event->direction, -2.0 * srp_vec3_dot(event->direction, facet->normal), facet->normal);
    if (event->back && books->scene->optics[facet->material].one_sided) {
        rho_s = 0.0;
    }
    srp_vec3 want = srp_vec3_add_scaled(momentum, -rho_s * event->flux, mirrored);
    switch (event->step) {
    case SRP_BOUNCE_STARTS:
        books->in = srp_vec3_add(books->in, momentum);
        books->push = srp_vec3_add(books->push, want);
        break;
    case SRP_BOUNCE_HITS:
        books->push = srp_vec3_add(books->push, event->push);
        books->largest =
            fmax(books->largest, srp_vec3_norm(srp_vec3_sub(event->push, want)) / event->flux);
        break;
    case SRP_BOUNCE_ESCAPES:
    case SRP_BOUNCE_IS_CUT:
        books->out = srp_vec3_add(books->out, momentum);
        break;
    }
}

START_TEST(momentum_is_kept) {
    static const char *const names[] = {"dihedral", "dish", "sun-shield"};
    model_file model = model_read(names[_i]);
    const srp_optics optics = {0.7, 0.0, _i == 2};
    srp_scene *scene = model_scene_painted(&model, optics);
    uint64_t random = 11;
    double bounced = 0.0;
    for (uint32_t k = 0; k < 4; ++k) {
        srp_method_params params = params_of(1 + k, 0);
        params.lattice.samples = 96;
        account books = {.scene = scene};
        const srp_vec3 inside = srp_vec3_make(0.48, 0.6, 0.64); /* of the dihedral */
        srp_prepared *prepared = prepare_with(&srp_method_raytrace, scene, &params);
        srp_raytrace_watch(prepared, keep_account, &books);
        srp_response got = respond_to(prepared, k == 0 ? inside : random_direction(&random));
        double scale = srp_vec3_norm(books.in);
        ck_assert(books.largest < 1e-12);
        assert_vec3_close(srp_vec3_sub(books.in, books.out), books.push, 0.0, 1e-12 * scale);
        bounced += srp_vec3_norm(got.f_bounce);
        srp_prepared_release(prepared);
    }
    ck_assert(bounced > 0.0);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

/* Convex bodies see nothing of themselves, and a scene without light to follow needs no rays. */
START_TEST(no_rays_where_nothing_is_seen) {
    static const char *const names[] = {"cube", "icosphere-1280"};
    srp_scene *scene = scene_of(names[_i]);
    srp_method_params params = params_of(2, 4);
    srp_prepared *traced = prepare_with(&srp_method_raytrace, scene, &params);
    srp_prepared *exact = prepare_with(&srp_method_exact, scene, &params);
    uint64_t random = 5;
    for (int k = 0; k < 20; ++k) {
        srp_vec3 s = random_direction(&random);
        srp_response got = respond_to(traced, s), want = respond_to(exact, s);
        ck_assert_mem_eq(&got, &want, sizeof got);
        ck_assert(got.samples == 0 && got.f_error == 0.0 && got.unresolved == 0.0);
    }
    srp_prepared_release(exact);
    srp_prepared_release(traced);
    srp_scene_destroy(scene);
}
END_TEST

/* Without reflections everything but the unresolved flux is the exact method's. */
START_TEST(direct_part_is_exact) {
    srp_scene *scene = scene_of("box-wing");
    srp_method_params params = params_of(0, 4);
    srp_prepared *none = prepare_with(&srp_method_raytrace, scene, &params);
    params.reflections = 2;
    srp_prepared *two = prepare_with(&srp_method_raytrace, scene, &params);
    srp_prepared *exact = prepare_with(&srp_method_exact, scene, &params);
    uint64_t random = 7;
    for (int k = 0; k < 5; ++k) {
        srp_vec3 s = random_direction(&random);
        srp_response want = respond_to(exact, s), got = respond_to(none, s);
        ck_assert_mem_eq(&got.f, &want.f, sizeof got.f);
        ck_assert_mem_eq(&got.t, &want.t, sizeof got.t);
        ck_assert(got.f_error == 0.0 && got.unresolved >= 0.0 && got.unresolved < 1.0);
        srp_basis basis[8], direct[8];
        srp_error error;
        assert_ok(srp_prepared_respond(two, 1, &s, &got, basis, &error), error);
        assert_ok(srp_prepared_respond(exact, 1, &s, &want, direct, &error), error);
        ck_assert_mem_eq(basis, direct, (srp_scene_material_count(scene) + 1) * sizeof *basis);
        assert_vec3_close(srp_vec3_sub(got.f, got.f_bounce), want.f, 1e-14, 0.0);
        assert_vec3_close(srp_vec3_sub(got.t, got.t_bounce), want.t, 1e-14, 1e-14);
        ck_assert(got.lit_area == want.lit_area && got.back_area == want.back_area);
    }
    srp_prepared_release(exact);
    srp_prepared_release(two);
    srp_prepared_release(none);
    srp_scene_destroy(scene);
}
END_TEST

/* Light that has been scattered is not followed with K = 0, and is not called unresolved. */
START_TEST(single_scattering_follows_mirrors_only) {
    srp_scene *scene = scene_of("l-corner");
    srp_method_params params = params_of(2, 0);
    srp_response got = trace(scene, &params, (srp_vec3){sqrt(0.5), sqrt(0.5), 0.0});
    ck_assert(srp_vec3_norm(got.f_bounce) == 0.0 && got.unresolved == 0.0 && got.samples == 0);
    assert_close(got.f.x, -1.471405, 0.0, 1e-6);
    srp_scene_destroy(scene);
}
END_TEST

/* A one-sided back ends the path: two facing mirrors, of which one shows its back. */
START_TEST(one_sided_backs_absorb) {
    model_file model = model_read("dihedral");
    double bounce[2];
    for (int one_sided = 0; one_sided < 2; ++one_sided) {
        srp_scene *scene = model_scene_painted(&model, (srp_optics){1.0, 0.0, one_sided != 0});
        srp_method_params params = params_of(2, 0);
        /* From behind: both show their backs, and nothing is reflected towards another. */
        srp_response got = trace(scene, &params, (srp_vec3){-sqrt(0.5), -sqrt(0.5), 0.0});
        ck_assert(srp_vec3_norm(got.f_bounce) == 0.0);
        assert_close(got.back_area, one_sided ? sqrt(2.0) : 0.0, 1e-14, 0.0);
        /* Grazing past one plate onto the other's inside: from x > 0, y < 0 the sun sees the back
         * of the plate in y = 0 and past it the inside of the plate in x = 0. */
        got = trace(scene, &params, (srp_vec3){0.6, -0.8, 0.0});
        bounce[one_sided] = srp_vec3_norm(got.f_bounce);
        srp_scene_destroy(scene);
    }
    ck_assert(bounce[0] == bounce[1]);
    model_free(&model);
}
END_TEST

/* ---- what it must not depend on, and what it must ---- */

static void respond_all(const srp_scene *scene, const srp_method_params *params, size_t count,
                        const srp_vec3 *s, srp_response *out) {
    srp_error error;
    srp_prepared *prepared = prepare_with(&srp_method_raytrace, scene, params);
    assert_ok(srp_prepared_respond(prepared, count, s, out, NULL, &error), error);
    srp_prepared_release(prepared);
}

START_TEST(bits_depend_on_the_direction_alone) {
    enum { COUNT = 7 };
    srp_scene *scene = scene_of("dish");
    srp_method_params params = params_of(2, 3);
    params.lattice.samples = 64;
    srp_vec3 s[COUNT], turned_round[COUNT];
    srp_response want[COUNT], got[COUNT];
    uint64_t random = 3;
    for (int k = 0; k < COUNT; ++k) {
        s[k] = turned_round[COUNT - 1 - k] = random_direction(&random);
    }
    respond_all(scene, &params, COUNT, s, want);
    for (int threads = 1; threads <= 5; threads += threads < 3 ? 1 : 2) {
        params.threads = threads;
        respond_all(scene, &params, COUNT, s, got);
        ck_assert_mem_eq(got, want, sizeof got);
        respond_all(scene, &params, COUNT, turned_round, got);
        for (int k = 0; k < COUNT; ++k) {
            ck_assert_mem_eq(&got[COUNT - 1 - k], &want[k], sizeof got[k]);
            /* Alone it is shared among the threads. */
            srp_response alone;
            respond_all(scene, &params, 1, &s[k], &alone);
            ck_assert_mem_eq(&alone, &want[k], sizeof alone);
        }
    }
    params.seed = 1;
    respond_all(scene, &params, COUNT, s, got);
    for (int k = 0; k < COUNT; ++k) {
        ck_assert(memcmp(&got[k].f, &want[k].f, sizeof got[k].f) != 0);
    }
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(tables_are_the_same_for_any_threads) {
    srp_scene *scene = scene_of("box-wing");
    srp_method_params params = params_of(2, 4);
    params.lattice.samples = 24;
    char want[33], got[33];
    for (int threads = 1; threads <= 5; threads += threads < 3 ? 1 : 2) {
        srp_error error;
        srp_grid grid;
        srp_table *table = NULL;
        params.threads = threads;
        srp_prepared *prepared = prepare_with(&srp_method_raytrace, scene, &params);
        assert_ok(srp_grid_from_steps(30.0, 30.0, &grid, &error), error);
        assert_ok(srp_table_create(prepared, grid, true, &table, &error), error);
        assert_ok(srp_table_fill(table, prepared, NULL, &error), error);
        ck_assert(srp_table_get_info(table)->has_bounce);
        srp_table_checksum(table, threads == 1 ? want : got);
        ck_assert(threads == 1 || strcmp(got, want) == 0);
        srp_table_destroy(table);
        srp_prepared_release(prepared);
    }
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(what_a_window_cuts_is_in_the_error) {
    srp_scene *scene = scene_of("dihedral");
    srp_method_params params = params_of(1, 0);
    params.lattice.kind = SRP_LATTICE_WINDOW;
    params.lattice.window[0] = -1.0;
    params.lattice.window[1] = 0.0;
    params.lattice.window[2] = 0.0;
    params.lattice.window[3] = 1.0;
    params.lattice.columns = params.lattice.rows = 64;
    const srp_vec3 s = {sqrt(0.5), sqrt(0.5), 0.0};
    srp_response got = trace(scene, &params, s);
    ck_assert(got.flags == (SRP_RESPONSE_CUT | SRP_RESPONSE_MIRRORS_SAMPLED));
    assert_vec3_close(got.f, srp_vec3_scale(-2.0 * sqrt(2.0), s), 0.0, got.f_error);
    params.lattice.window[2] = 2.0; /* past the model */
    params.lattice.window[3] = 3.0;
    got = trace(scene, &params, s);
    ck_assert(got.flags == (SRP_RESPONSE_CUT | SRP_RESPONSE_MIRRORS_SAMPLED));
    assert_vec3_close(got.f, srp_vec3_scale(-2.0 * sqrt(2.0), s), 0.0, got.f_error);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(tolerance_refines) {
    srp_scene *scene = scene_of("dish");
    srp_method_params params = params_of(1, 2);
    params.lattice.samples = 32;
    const srp_vec3 s = srp_vec3_scale(1.0 / sqrt(1.29), srp_vec3_make(0.2, 0.5, 1.0));
    srp_response coarse = trace(scene, &params, s);
    params.tolerance = 0.2 * coarse.f_error / srp_vec3_norm(coarse.f);
    srp_response fine = trace(scene, &params, s);
    ck_assert(fine.f_error <= params.tolerance * srp_vec3_norm(fine.f));
    ck_assert(fine.samples > coarse.samples && fine.flags == SRP_RESPONSE_MIRRORS_SAMPLED);
    params.max_samples = 32;
    fine = trace(scene, &params, s);
    ck_assert(fine.flags == (SRP_RESPONSE_TOLERANCE_MISSED | SRP_RESPONSE_MIRRORS_SAMPLED) &&
              fine.f_error == coarse.f_error);
    srp_scene_destroy(scene);
}
END_TEST

/* Both reach the same expectation; the estimate must say how far they may be apart. */
START_TEST(lattices_and_fans_agree) {
    srp_scene *scene = scene_of("dish");
    const srp_vec3 s = srp_vec3_scale(1.0 / sqrt(1.29), srp_vec3_make(0.2, 0.5, 1.0));
    srp_method_params params = params_of(2, 1);
    params.lattice.samples = 400;
    srp_response want = trace(scene, &params, s);
    for (uint32_t k = 0; k < 3; ++k) {
        params.diffuse = 3 + 5 * k;
        params.lattice.samples = 128;
        params.seed = k;
        srp_response got = trace(scene, &params, s);
        assert_within(got.f, want.f, 4.0, sqrt(pow(got.f_error, 2.0) + pow(want.f_error, 2.0)));
        assert_within(got.t, want.t, 4.0, sqrt(pow(got.t_error, 2.0) + pow(want.t_error, 2.0)));
    }
    params.lattice.kind = SRP_LATTICE_WINDOW;
    params.lattice.window[0] = params.lattice.window[2] = -2.0 * scene->radius;
    params.lattice.window[1] = params.lattice.window[3] = 2.0 * scene->radius;
    params.lattice.columns = params.lattice.rows = 400;
    srp_response got = trace(scene, &params, s);
    assert_within(got.f, want.f, 4.0, sqrt(pow(got.f_error, 2.0) + pow(want.f_error, 2.0)));
    srp_scene_destroy(scene);
}
END_TEST

/* A white corner of 3 cm on a black panel of 20 m: a lattice that misses it must not say that it
 * knows. */
START_TEST(what_samples_may_have_missed_is_in_the_error) {
    const srp_vec3 v[10] = {{-10.0, -10.0, 0.0}, {10.0, -10.0, 0.0}, {10.0, 10.0, 0.0},
                            {-10.0, 10.0, 0.0},  {0.0, 0.0, 0.01},   {0.03, 0.0, 0.01},
                            {0.03, 0.03, 0.01},  {0.0, 0.03, 0.01},  {0.0, 0.0, 0.04},
                            {0.0, 0.03, 0.04}};
    const srp_triangle panel[2] = {{{0, 1, 2}}, {{0, 2, 3}}};
    const srp_triangle corner[4] = {{{4, 5, 6}}, {{4, 6, 7}}, {{4, 7, 9}}, {{4, 9, 8}}};
    srp_mesh *mesh = shape_mesh(v, 10, panel, 2, "black");
    shape_join(mesh, shape_mesh(v, 10, corner, 4, "white"));
    srp_materials *materials;
    srp_scene *scene;
    srp_error error;
    assert_ok(srp_materials_create(&materials, &error), error);
    assert_ok(srp_materials_set(materials, "black", (srp_optics){0.0, 0.0, false}, false, &error),
              error);
    assert_ok(srp_materials_set(materials, "white", (srp_optics){0.0, 1.0, false}, false, &error),
              error);
    assert_ok(srp_scene_from_mesh(mesh, materials, &scene, &error), error);
    srp_vec3 s = {sqrt(0.5), 0.0, sqrt(0.5)};
    srp_method_params params = params_of(1, 4);
    srp_method_params near = params;
    near.lattice.kind = SRP_LATTICE_WINDOW;
    near.lattice.window[0] = near.lattice.window[2] = -0.06;
    near.lattice.window[1] = near.lattice.window[3] = 0.06;
    near.lattice.columns = near.lattice.rows = 256;
    srp_response want = trace(scene, &near, s);
    ck_assert(want.f_error > 0.0 && srp_vec3_norm(want.f_bounce) > 10.0 * want.f_error);
    int missed = 0, within = 0;
    for (uint32_t seed = 0; seed < 40; ++seed) {
        params.lattice.samples = 256;
        params.seed = seed;
        srp_response got = trace(scene, &params, s);
        missed += srp_vec3_norm(got.f_bounce) == 0.0;
        within += srp_vec3_norm(srp_vec3_sub(got.f, want.f)) <= 2.0 * got.f_error;
        ck_assert(got.f_error > 0.0 && got.t_error > 0.0);
    }
    printf("small corner: missed %d of 40 times, %d within 2 errors\n", missed, within);
    ck_assert(missed > 10 && within >= 36);
    /* A tolerance is not met by what was not seen. */
    params.lattice.samples = 1;
    params.tolerance = 1e-6;
    params.max_samples = 64;
    srp_response got = trace(scene, &params, s);
    ck_assert((got.flags & SRP_RESPONSE_TOLERANCE_MISSED) != 0);
    /* From behind nothing white is lit, and nothing is to be sampled. */
    got = trace(scene, &params, srp_vec3_scale(-1.0, s));
    ck_assert(got.f_error == 0.0 && got.samples == 0);
    srp_scene_destroy(scene);
    srp_materials_destroy(materials);
    srp_mesh_destroy(mesh);
}
END_TEST

/* ---- failures ---- */

START_TEST(bad_parameters_are_named) {
    srp_scene *scene = scene_of("dihedral");
    srp_prepared *prepared = NULL;
    srp_error error;
    srp_method_params params = params_of(101, 0);
    ck_assert_int_eq(srp_method_prepare(&srp_method_raytrace, scene, &params, &prepared, &error),
                     SRP_BAD_ARGUMENT);
    ck_assert_ptr_nonnull(strstr(error.message, "101 reflections"));
    params = params_of(2, 1025);
    ck_assert_int_eq(srp_method_prepare(&srp_method_raytrace, scene, &params, &prepared, &error),
                     SRP_BAD_ARGUMENT);
    ck_assert_ptr_nonnull(strstr(error.message, "1025 diffuse"));
    params = params_of(2, 0);
    params.lattice.pixel = 1e-6;
    ck_assert_int_eq(srp_method_prepare(&srp_method_raytrace, scene, &params, &prepared, &error),
                     SRP_BAD_ARGUMENT);
    ck_assert_ptr_null(prepared);
    /* The largest of both work. */
    params = params_of(100, 1024);
    params.lattice.samples = 3;
    srp_response got = trace(scene, &params, srp_vec3_make(0.6, 0.8, 0.0));
    ck_assert(isfinite(got.f.x) && got.samples > 0);
    srp_scene_destroy(scene);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("raytrace");
    TCase *tcase = tcase_create("raytrace");
    tcase_set_timeout(tcase, 120.0);
    tcase_add_test(tcase, dihedral_of_mirrors_turns_light_back);
    tcase_add_test(tcase, l_corner_lights_itself);
    tcase_add_test(tcase, corner_cube_sends_light_back);
    tcase_add_test(tcase, moment_acts_where_light_lands);
    tcase_add_loop_test(tcase, momentum_is_kept, 0, 3);
    tcase_add_loop_test(tcase, no_rays_where_nothing_is_seen, 0, 2);
    tcase_add_test(tcase, direct_part_is_exact);
    tcase_add_test(tcase, single_scattering_follows_mirrors_only);
    tcase_add_test(tcase, one_sided_backs_absorb);
    tcase_add_test(tcase, bits_depend_on_the_direction_alone);
    tcase_add_test(tcase, tables_are_the_same_for_any_threads);
    tcase_add_test(tcase, what_a_window_cuts_is_in_the_error);
    tcase_add_test(tcase, tolerance_refines);
    tcase_add_test(tcase, what_samples_may_have_missed_is_in_the_error);
    tcase_add_test(tcase, lattices_and_fans_agree);
    tcase_add_test(tcase, bad_parameters_are_named);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
