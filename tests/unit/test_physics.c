/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What first-hit light must do, from closed forms: spheres, cylinders, cubes, corners, the
 * quantities of AAS 20-481's Tables 1 and 2, moments, and linearity in the optics.
 */
#include "model_files.h"
#include "prepared.h"
#include "shapes.h"
#include "srp_check.h"

#include <srp/const.h>
#include <srp/plates.h>
#include <srp/sunlight.h>
#include <srp/table.h>

static const srp_optics PAINT = {0.31, 0.23, false};

/* log2 of the ratio of errors of one mesh and of one with half its edge length. */
static double observed_order(double coarse, double fine) {
    return log2(coarse / fine);
}

/* ---- Spheres ---- */

static const char *const SPHERES[] = {"icosphere-80", "icosphere-320", "icosphere-1280"};

/* Largest relative error of f, and largest |t| over r |f|, of a sphere of radius 1 over random
 * directions: f = -pi (1 + 4 rho_d / 9) s, t = 0. */
static void sphere_errors(const char *name, double *f_error, double *t_error) {
    enum { DIRECTIONS = 60 };
    model_file model = model_read(name);
    srp_scene *scene = model_scene_painted(&model, PAINT);
    srp_prepared *exact = prepare_on(&srp_method_exact, scene);
    const double truth = SRP_PI * (1.0 + 4.0 * PAINT.rho_d / 9.0);
    uint64_t random = 11;
    *f_error = *t_error = 0.0;
    for (int i = 0; i < DIRECTIONS; ++i) {
        srp_vec3 s = random_direction(&random);
        srp_response got = respond_to(exact, s);
        srp_vec3 off = srp_vec3_add_scaled(got.f, truth, s);
        *f_error = fmax(*f_error, srp_vec3_norm(off) / truth);
        *t_error = fmax(*t_error, srp_vec3_norm(got.t) / srp_vec3_norm(got.f));
    }
    srp_prepared_release(exact);
    srp_scene_destroy(scene);
    model_free(&model);
}

START_TEST(spheres_converge_at_second_order) {
    double f_error[3], t_error[3];
    for (int i = 0; i < 3; ++i) {
        sphere_errors(SPHERES[i], &f_error[i], &t_error[i]);
    }
    for (int i = 0; i < 2; ++i) {
        double f_order = observed_order(f_error[i], f_error[i + 1]);
        double t_order = observed_order(t_error[i], t_error[i + 1]);
        printf("sphere: force %.3e -> %.3e, order %.3f; moment %.3e -> %.3e, order %.3f\n",
               f_error[i], f_error[i + 1], f_order, t_error[i], t_error[i + 1], t_order);
        assert_close(f_order, 2.0, 0.0, 0.1);
        ck_assert_msg(t_order > 1.9, "the moment about the centre falls at order %g", t_order);
    }
    ck_assert(f_error[2] < 0.012);
    ck_assert(t_error[2] < 1e-3);
}
END_TEST

/* Seen along one of its mirror axes, the icosphere has no moment to give, whatever its facets. */
START_TEST(sphere_has_no_moment_along_its_axes) {
    const srp_vec3 axes[] = {{1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, 1.0}};
    for (int k = 0; k < 3; ++k) {
        model_file model = model_read(SPHERES[k]);
        srp_scene *scene = model_scene_painted(&model, PAINT);
        srp_prepared *exact = prepare_on(&srp_method_exact, scene);
        for (size_t i = 0; i < sizeof axes / sizeof axes[0]; ++i) {
            srp_response got = respond_to(exact, axes[i]);
            assert_vec3_close(got.t, srp_vec3_make(0.0, 0.0, 0.0), 0.0, 1e-14);
            double along = srp_vec3_dot(got.f, axes[i]);
            assert_vec3_close(got.f, srp_vec3_scale(along, axes[i]), 1e-14, 0.0);
        }
        srp_prepared_release(exact);
        srp_scene_destroy(scene);
        model_free(&model);
    }
}
END_TEST

/* ---- Cylinder ---- */

static const double CYLINDER_R = 0.83, CYLINDER_H = 2.7;

/* Closed prism of `sides` sides inscribed in the cylinder, a corner on the x axis. */
static srp_scene *cylinder(uint32_t sides) {
    size_t vertex_count = 2 * (size_t)sides + 2, triangle_count = 4 * (size_t)sides, n = 0;
    srp_vec3 *v = malloc(vertex_count * sizeof *v);
    srp_triangle *t = malloc(triangle_count * sizeof *t);
    ck_assert(v != NULL && t != NULL);
    uint32_t bottom = 2 * sides, top = bottom + 1;
    v[bottom] = srp_vec3_make(0.0, 0.0, -CYLINDER_H / 2.0);
    v[top] = srp_vec3_make(0.0, 0.0, CYLINDER_H / 2.0);
    for (uint32_t k = 0; k < sides; ++k) {
        double angle = 2.0 * SRP_PI * k / sides;
        uint32_t next = (k + 1) % sides;
        v[k] = srp_vec3_make(CYLINDER_R * cos(angle), CYLINDER_R * sin(angle), -CYLINDER_H / 2.0);
        v[sides + k] = srp_vec3_make(v[k].x, v[k].y, CYLINDER_H / 2.0);
        t[n++] = (srp_triangle){{k, next, sides + next}};
        t[n++] = (srp_triangle){{k, sides + next, sides + k}};
        t[n++] = (srp_triangle){{bottom, next, k}};
        t[n++] = (srp_triangle){{top, sides + k, sides + next}};
    }
    srp_mesh *mesh = shape_mesh(v, vertex_count, t, triangle_count, "paint");
    free(v);
    free(t);
    return shape_scene(mesh, PAINT);
}

START_TEST(cylinder_converges_at_second_order) {
    enum { LEVELS = 5 };
    const srp_vec3 s = {1.0, 0.0, 0.0};
    const double truth =
        2.0 * CYLINDER_R * CYLINDER_H * (1.0 + PAINT.rho_s / 3.0 + SRP_PI * PAINT.rho_d / 6.0);
    double before = 0.0;
    for (int level = 0; level < LEVELS; ++level) {
        srp_scene *scene = cylinder(32u << level);
        srp_prepared *exact = prepare_on(&srp_method_exact, scene);
        srp_response got = respond_to(exact, s);
        double error = srp_vec3_norm(srp_vec3_add_scaled(got.f, truth, s)) / truth;
        assert_vec3_close(got.t, srp_vec3_make(0.0, 0.0, 0.0), 0.0, 1e-14);
        if (level > 0) {
            double order = observed_order(before, error);
            printf("cylinder: %u sides, force %.3e, order %.3f\n", 32u << level, error, order);
            assert_close(order, 2.0, 0.0, 0.01);
        }
        before = error;
        srp_prepared_release(exact);
        srp_scene_destroy(scene);
    }
}
END_TEST

/* ---- Flat faces ---- */

static srp_scene *plates_scene(const char *name) {
    char path[1024];
    srp_error error;
    srp_plate *plates = NULL;
    size_t count = 0;
    srp_scene *scene = NULL;
    (void)snprintf(path, sizeof path, "%s/%s.plates", SRP_MODELS_DIR, name);
    assert_ok(srp_plates_read(path, &plates, &count, &error), error);
    assert_ok(srp_scene_from_plates(plates, count, &scene, &error), error);
    srp_plates_free(plates);
    return scene;
}

START_TEST(cube_is_the_sum_of_its_plates) {
    model_file model = model_read("cube");
    srp_scene *mesh_scene = model_scene(&model);
    srp_scene *plate_scene = plates_scene("cube");
    srp_prepared *exact = prepare_on(&srp_method_exact, mesh_scene);
    srp_prepared *plates = prepare_on(&srp_method_nplate, plate_scene);
    uint64_t random = 5;
    double largest = 0.0;
    for (int i = 0; i < 1000; ++i) {
        srp_vec3 s = random_direction(&random);
        srp_response got = respond_to(exact, s), want = respond_to(plates, s);
        double off = srp_vec3_norm(srp_vec3_sub(got.f, want.f)) / srp_vec3_norm(want.f);
        largest = fmax(largest, off);
        assert_vec3_close(got.f, want.f, 1e-14, 0.0);
        assert_close(got.lit_area, want.lit_area, 1e-14, 0.0);
        ck_assert(got.f_error == 0.0);
    }
    printf("cube: exact - 6 plates, largest of 1000: %.2e relative\n", largest);
    srp_prepared_release(exact);
    srp_prepared_release(plates);
    srp_scene_destroy(mesh_scene);
    srp_scene_destroy(plate_scene);
    model_free(&model);
}
END_TEST

static srp_response respond_of_model(const char *name, srp_vec3 s) {
    model_file model = model_read(name);
    srp_scene *scene = model_scene(&model);
    srp_prepared *exact = prepare_on(&srp_method_exact, scene);
    srp_response got = respond_to(exact, s);
    srp_prepared_release(exact);
    srp_scene_destroy(scene);
    model_free(&model);
    return got;
}

START_TEST(dihedral_along_its_bisector) {
    const srp_vec3 s = {sqrt(0.5), sqrt(0.5), 0.0};
    srp_response got = respond_of_model("dihedral", s);
    assert_vec3_close(got.f, srp_vec3_scale(-sqrt(2.0), s), 1e-14, 0.0);
    assert_close(got.lit_area, sqrt(2.0), 1e-14, 0.0);
    /* Each plate gives -n at its centroid: (0, .5, .5) x (-1, 0, 0) + (.5, 0, .5) x (0, -1, 0). */
    assert_vec3_close(got.t, srp_vec3_make(0.5, -0.5, 0.0), 1e-14, 0.0);
}
END_TEST

START_TEST(l_corner_direct_part) {
    const srp_vec3 s = {sqrt(0.5), sqrt(0.5), 0.0};
    const double want = -(1.0 + sqrt(2.0) / 3.0); /* -1.471405 */
    srp_response got = respond_of_model("l-corner", s);
    assert_vec3_close(got.f, srp_vec3_make(want, want, 0.0), 1e-14, 0.0);
    assert_close(want, -1.471405, 0.0, 5e-7);
}
END_TEST

/* From behind, the fronts are hidden: the backs carry the same paint (both sides do), and the light
 * pushes the other way. */
START_TEST(l_corner_from_behind) {
    const srp_vec3 s = {-sqrt(0.5), -sqrt(0.5), 0.0};
    const double want = 1.0 + sqrt(2.0) / 3.0;
    srp_response got = respond_of_model("l-corner", s);
    assert_vec3_close(got.f, srp_vec3_make(want, want, 0.0), 1e-14, 0.0);
    ck_assert(got.back_area == 0.0);
}
END_TEST

/* ---- AAS 20-481 ---- */

/* The 162 directions of the paper; both upper ends are left out. */
enum { PAPER_DIRECTIONS = 162 };

static void paper_directions(srp_vec3 *s) {
    for (int i = 0; i < 18; ++i) {
        for (int j = 0; j < 9; ++j) {
            s[9 * i + j] = srp_direction_from_deg(-180.0 + 20.0 * i, -90.0 + 20.0 * j);
        }
    }
}

/* Table 1: mean |a - a_truth| for mass 1 [m/s^2], truth the cannonball with Cr = 1. */
START_TEST(paper_table_1_spheres) {
    static const double want[3] = {1.031e-6, 2.698e-7, 6.867e-8};
    const double pressure = SRP_SOLAR_FLUX / SRP_SPEED_OF_LIGHT;
    srp_vec3 s[PAPER_DIRECTIONS];
    paper_directions(s);
    for (int k = 0; k < 3; ++k) {
        model_file model = model_read(SPHERES[k]);
        srp_scene *scene = model_scene(&model);
        srp_prepared *exact = prepare_on(&srp_method_exact, scene);
        double sum = 0.0;
        for (int i = 0; i < PAPER_DIRECTIONS; ++i) {
            srp_response got = respond_to(exact, s[i]);
            sum += pressure * srp_vec3_norm(srp_vec3_add_scaled(got.f, SRP_PI, s[i]));
        }
        double mean = sum / PAPER_DIRECTIONS;
        printf("%s: mean error %.6e m/s^2, expected %.3e\n", SPHERES[k], mean, want[k]);
        assert_close(mean, want[k], 1e-3, 0.0);
        srp_prepared_release(exact);
        srp_scene_destroy(scene);
        model_free(&model);
    }
}
END_TEST

/* Table 2: the same for the cube against its six plates; the paper's best is 2.9e-9. */
START_TEST(paper_table_2_cube) {
    const double pressure = SRP_SOLAR_FLUX / SRP_SPEED_OF_LIGHT;
    srp_vec3 s[PAPER_DIRECTIONS];
    paper_directions(s);
    model_file model = model_read("cube");
    srp_scene *mesh_scene = model_scene(&model);
    srp_scene *plate_scene = plates_scene("cube");
    srp_prepared *exact = prepare_on(&srp_method_exact, mesh_scene);
    srp_prepared *plates = prepare_on(&srp_method_nplate, plate_scene);
    double sum = 0.0;
    for (int i = 0; i < PAPER_DIRECTIONS; ++i) {
        srp_response got = respond_to(exact, s[i]), want = respond_to(plates, s[i]);
        sum += pressure * srp_vec3_norm(srp_vec3_sub(got.f, want.f));
    }
    printf("cube: mean error %.3e m/s^2\n", sum / PAPER_DIRECTIONS);
    ck_assert(sum / PAPER_DIRECTIONS < 1e-18);
    srp_prepared_release(exact);
    srp_prepared_release(plates);
    srp_scene_destroy(mesh_scene);
    srp_scene_destroy(plate_scene);
    model_free(&model);
}
END_TEST

/* ---- Moments under a partial shadow ---- */

static const srp_optics LOWER = {0.27, 0.41, false}, UPPER = {0.13, 0.36, false};

/* A quadrilateral of corners in the plane z = 0, moved by `shift` and turned. */
static srp_mesh *flat_plate(const double corner[4][2], srp_vec3 shift, const turn *t,
                            const char *material) {
    const srp_triangle triangles[] = {{{0, 1, 2}}, {{0, 2, 3}}};
    srp_vec3 vertices[4];
    for (int k = 0; k < 4; ++k) {
        srp_vec3 flat = srp_vec3_make(corner[k][0], corner[k][1], 0.0);
        vertices[k] = turn_apply(t, srp_vec3_add(flat, shift));
    }
    return shape_mesh(vertices, 4, triangles, 2, material);
}

static srp_scene *two_plates(srp_mesh *lower, srp_mesh *upper) {
    srp_materials *materials;
    srp_scene *scene;
    srp_error error;
    shape_join(lower, upper);
    assert_ok(srp_materials_create(&materials, &error), error);
    assert_ok(srp_materials_set(materials, "lower", LOWER, false, &error), error);
    assert_ok(srp_materials_set(materials, "upper", UPPER, false, &error), error);
    assert_ok(srp_scene_from_mesh(lower, materials, &scene, &error), error);
    srp_materials_destroy(materials);
    srp_mesh_destroy(lower);
    return scene;
}

/* Adds what the lit area `area` about `centroid` of a plate with normal `n` gives (theory.md, "The
 * force on one facet"), the moment about `reference`. */
static void add_plate(double area, srp_vec3 centroid, srp_vec3 n, srp_optics optics, srp_vec3 s,
                      srp_vec3 reference, srp_vec3 *f, srp_vec3 *t) {
    double c = srp_vec3_dot(n, s);
    srp_vec3 push = srp_vec3_scale(-area * c * (1.0 - optics.rho_s), s);
    push = srp_vec3_add_scaled(push, -2.0 * area * c * (optics.rho_s * c + optics.rho_d / 3.0), n);
    *f = srp_vec3_add(*f, push);
    *t = srp_vec3_add(*t, srp_vec3_cross(srp_vec3_sub(centroid, reference), push));
}

/* A plate off the reference point, half of it in the shadow of another: the half beyond a line
 * across, and the half beyond a diagonal. */
START_TEST(half_a_plate_in_shadow) {
    const double a = 1.731, b = 2.219, height = 0.8713;
    const double lower[4][2] = {{0.0, 0.0}, {a, 0.0}, {a, b}, {0.0, b}};
    /* Shadows on the lower plate, larger than it; the mean of the corners is the centroid. */
    const double shadow[2][4][2] = {
        {{a / 2, -0.37}, {a + 0.59, -0.37}, {a + 0.59, b + 0.83}, {a / 2, b + 0.83}},
        {{-0.3 * a, -0.3 * b},
         {1.3 * a, 1.3 * b},
         {1.3 * a - 1.1 * b, 1.3 * b + 1.1 * a},
         {-0.3 * a - 1.1 * b, -0.3 * b + 1.1 * a}}};
    const double upper_area[2] = {(a / 2 + 0.59) * (b + 1.2), 1.6 * 1.1 * (a * a + b * b)};
    const srp_vec3 lit[2] = {{a / 4, b / 2, 0.0}, {2.0 * a / 3.0, b / 3.0, 0.0}};
    uint64_t random = 61 + (uint64_t)_i;
    turn t = turn_random(&random);
    srp_vec3 flat_s = srp_vec3_make(0.31, -0.22, 0.0), shift = srp_vec3_make(0.913, -1.377, 2.063);
    flat_s.z = sqrt(1.0 - srp_vec3_dot(flat_s, flat_s));
    srp_vec3 up = srp_vec3_add_scaled(shift, height / flat_s.z, flat_s);
    srp_vec3 s = turn_apply(&t, flat_s), n = turn_apply(&t, srp_vec3_make(0.0, 0.0, 1.0));
    s = srp_vec3_scale(1.0 / srp_vec3_norm(s), s);
    srp_scene *scene =
        two_plates(flat_plate(lower, shift, &t, "lower"), flat_plate(shadow[_i], up, &t, "upper"));

    srp_vec3 middle = {0.0, 0.0, 0.0}, f = {0.0, 0.0, 0.0}, moment = f;
    for (int k = 0; k < 4; ++k) {
        middle.x += 0.25 * shadow[_i][k][0];
        middle.y += 0.25 * shadow[_i][k][1];
    }
    srp_vec3 lower_centroid = turn_apply(&t, srp_vec3_add(lit[_i], shift));
    srp_vec3 upper_centroid = turn_apply(&t, srp_vec3_add(middle, up));
    srp_method_params params = srp_method_params_default();
    params.threads = 1;
    params.reference = srp_vec3_make(-0.417, 0.731, 1.129);
    add_plate(0.5 * a * b, lower_centroid, n, LOWER, s, params.reference, &f, &moment);
    add_plate(upper_area[_i], upper_centroid, n, UPPER, s, params.reference, &f, &moment);

    srp_error error;
    srp_prepared *exact;
    srp_response got;
    srp_basis basis[3];
    assert_ok(srp_method_prepare(&srp_method_exact, scene, &params, &exact, &error), error);
    assert_ok(srp_prepared_respond(exact, 1, &s, &got, basis, &error), error);
    srp_vec3 r = srp_vec3_scale(1.0 / basis[0].a, basis[0].ra);
    srp_vec3 centroid_off = srp_vec3_sub(srp_vec3_add(params.reference, r), lower_centroid);
    printf("half in shadow: f off by %.2e, t by %.2e, lit centroid by %.2e m\n",
           srp_vec3_norm(srp_vec3_sub(got.f, f)) / srp_vec3_norm(f),
           srp_vec3_norm(srp_vec3_sub(got.t, moment)) / srp_vec3_norm(moment),
           srp_vec3_norm(centroid_off));
    assert_vec3_close(got.f, f, 1e-12, 0.0);
    assert_vec3_close(got.t, moment, 1e-12, 0.0);
    ck_assert(srp_vec3_norm(centroid_off) <= 1e-12);
    ck_assert(srp_vec3_norm(moment) > 0.1);
    srp_prepared_release(exact);
    srp_scene_destroy(scene);
}
END_TEST

/* ---- On every model ---- */

/* Directions to ask: fewer where there are many facets. */
static int directions_of(const srp_scene *scene) {
    return srp_scene_facet_count(scene) < 10000 ? 20 : 2;
}

START_TEST(moment_shifts_with_its_reference) {
    model_file model = model_read(MODEL_NAMES[_i]);
    srp_scene *scene = model_scene(&model);
    srp_prepared *origin = prepare_on(&srp_method_exact, scene);
    srp_error error;
    srp_method_params params = srp_method_params_default();
    params.threads = 1;
    params.reference = srp_vec3_make(0.377, -1.213, 0.851);
    srp_prepared *shifted = NULL;
    assert_ok(srp_method_prepare(&srp_method_exact, scene, &params, &shifted, &error), error);
    uint64_t random = 21;
    double worst = 0.0;
    for (int i = 0; i < directions_of(scene); ++i) {
        srp_vec3 s = random_direction(&random);
        srp_response at_origin = respond_to(origin, s), at_shifted = respond_to(shifted, s);
        srp_vec3 lever = srp_vec3_cross(params.reference, at_origin.f);
        double scale = srp_scene_radius(scene) * srp_vec3_norm(at_origin.f);
        assert_vec3_close(at_shifted.f, at_origin.f, 1e-15, 0.0);
        srp_vec3 off = srp_vec3_sub(at_shifted.t, srp_vec3_sub(at_origin.t, lever));
        worst = fmax(worst, srp_vec3_norm(off) / scale);
        assert_vec3_close(at_shifted.t, srp_vec3_sub(at_origin.t, lever), 0.0, 1e-13 * scale);
    }
    printf("%s: moved reference, t off by %.2e\n", MODEL_NAMES[_i], worst);
    srp_prepared_release(origin);
    srp_prepared_release(shifted);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

enum { BASIS_ROOM = 32 };

/* The sums of a scene under one paint give f and t of the scene under another, and add up to its
 * own. */
START_TEST(direct_light_is_linear_in_the_optics) {
    const srp_optics other = {0.47, 0.39, false};
    model_file model = model_read(MODEL_NAMES[_i]);
    srp_scene *scene = model_scene(&model), *repainted = model_scene_painted(&model, other);
    srp_prepared *exact = prepare_on(&srp_method_exact, scene);
    srp_prepared *exact_repainted = prepare_on(&srp_method_exact, repainted);
    size_t count = srp_scene_material_count(scene);
    ck_assert_uint_lt(count + 1, BASIS_ROOM);
    uint64_t random = 31;
    for (int i = 0; i < directions_of(scene); ++i) {
        srp_error error;
        srp_basis basis[BASIS_ROOM];
        srp_response got;
        srp_vec3 s = random_direction(&random);
        assert_ok(srp_prepared_respond(exact, 1, &s, &got, basis, &error), error);
        srp_vec3 f[2] = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}, t[2] = {f[0], f[0]};
        double lit = 0.0;
        for (size_t m = 0; m < count; ++m) {
            srp_basis_apply(&basis[m], srp_scene_material_optics(scene, m), s, &f[0], &t[0]);
            srp_basis_apply(&basis[m], other, s, &f[1], &t[1]);
            lit += basis[m].a;
        }
        srp_response want = respond_to(exact_repainted, s);
        double scale = srp_scene_radius(scene) * srp_vec3_norm(want.f);
        assert_vec3_close(f[0], got.f, 1e-14, 0.0);
        assert_vec3_close(t[0], got.t, 0.0, 1e-14 * scale);
        assert_vec3_close(f[1], want.f, 1e-13, 0.0);
        assert_vec3_close(t[1], want.t, 0.0, 1e-13 * scale);
        assert_close(lit, got.lit_area, 1e-14, 0.0);
    }
    srp_prepared_release(exact);
    srp_prepared_release(exact_repainted);
    srp_scene_destroy(scene);
    srp_scene_destroy(repainted);
    model_free(&model);
}
END_TEST

/* Black paint: f = -(lit area) s, exactly what the silhouette stops; and no paint doubles more than
 * a mirror that faces the Sun. */
START_TEST(push_is_within_its_bounds) {
    const srp_optics black = {0.0, 0.0, false};
    model_file model = model_read(MODEL_NAMES[_i]);
    srp_scene *scene = model_scene(&model), *blackened = model_scene_painted(&model, black);
    srp_prepared *exact = prepare_on(&srp_method_exact, scene);
    srp_prepared *exact_black = prepare_on(&srp_method_exact, blackened);
    uint64_t random = 41;
    for (int i = 0; i < directions_of(scene); ++i) {
        srp_vec3 s = random_direction(&random);
        srp_response lit = respond_to(exact, s), dark = respond_to(exact_black, s);
        double push = -srp_vec3_dot(lit.f, s);
        assert_vec3_close(dark.f, srp_vec3_scale(-dark.lit_area, s), 1e-14, 0.0);
        assert_close(lit.lit_area, dark.lit_area, 1e-14, 0.0);
        ck_assert(push > 0.0 && push <= 2.0 * lit.lit_area);
        ck_assert(srp_vec3_norm(lit.f) <= 2.0 * lit.lit_area);
    }
    srp_prepared_release(exact);
    srp_prepared_release(exact_black);
    srp_scene_destroy(scene);
    srp_scene_destroy(blackened);
    model_free(&model);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("physics");
    TCase *forms = tcase_create("closed forms");
    tcase_set_timeout(forms, 300.0);
    tcase_add_test(forms, spheres_converge_at_second_order);
    tcase_add_test(forms, sphere_has_no_moment_along_its_axes);
    tcase_add_test(forms, cylinder_converges_at_second_order);
    tcase_add_test(forms, cube_is_the_sum_of_its_plates);
    tcase_add_test(forms, dihedral_along_its_bisector);
    tcase_add_test(forms, l_corner_direct_part);
    tcase_add_test(forms, l_corner_from_behind);
    tcase_add_loop_test(forms, half_a_plate_in_shadow, 0, 2);
    tcase_add_test(forms, paper_table_1_spheres);
    tcase_add_test(forms, paper_table_2_cube);
    suite_add_tcase(suite, forms);
    TCase *models = tcase_create("every model");
    tcase_set_timeout(models, 300.0);
    tcase_add_loop_test(models, moment_shifts_with_its_reference, 0, (int)MODEL_COUNT);
    tcase_add_loop_test(models, direct_light_is_linear_in_the_optics, 0, (int)MODEL_COUNT);
    tcase_add_loop_test(models, push_is_within_its_bounds, 0, (int)MODEL_COUNT);
    suite_add_tcase(suite, models);
    return run_suite(suite);
}
