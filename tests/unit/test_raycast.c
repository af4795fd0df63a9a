/* SPDX-License-Identifier: Apache-2.0 */
#include "lattice.h"
#include "prepared.h"
#include "raster_canvas.h"
#include "scene_internal.h"
#include "shapes.h"
#include "srp_check.h"
#include "view.h"

#include <srp/const.h>
#include <srp/method.h>
#include <srp/table.h>

#include <string.h>

static const srp_optics SHINY = {0.5, 0.1, false};

static srp_method_params window_params(double half, uint32_t columns, uint32_t rows) {
    srp_method_params params = srp_method_params_default();
    params.lattice.kind = SRP_LATTICE_WINDOW;
    params.lattice.columns = columns;
    params.lattice.rows = rows;
    params.lattice.window[0] = params.lattice.window[2] = -half;
    params.lattice.window[1] = params.lattice.window[3] = half;
    return params;
}

/* A mesh of `count` triangles anywhere in [-1, 1]^3: open, cutting each other, of three materials.
 */
static srp_mesh *soup(size_t count, uint64_t *seed) {
    srp_vec3 corners[3 * 64];
    srp_triangle triangles[64];
    uint32_t materials[64];
    const char *const names[3] = {"one", "two", "three"};
    srp_error error;
    srp_mesh *mesh = NULL;
    ck_assert_uint_le(count, 64);
    for (size_t k = 0; k < 3 * count; ++k) {
        corners[k] = srp_vec3_make(2.0 * random_unit(seed) - 1.0, 2.0 * random_unit(seed) - 1.0,
                                   2.0 * random_unit(seed) - 1.0);
    }
    for (size_t k = 0; k < count; ++k) {
        triangles[k] =
            (srp_triangle){{(uint32_t)(3 * k), (uint32_t)(3 * k + 1), (uint32_t)(3 * k + 2)}};
        materials[k] = (uint32_t)(k % 3);
    }
    assert_ok(
        srp_mesh_create(corners, 3 * count, triangles, count, materials, names, 3, &mesh, &error),
        error);
    return mesh;
}

/* The facet that the ray through p along -s hits first, scene->facet_count for none; its height. */
static size_t first_hit(const srp_scene *scene, srp_vec3 p, srp_vec3 s, double *height) {
    size_t hit = scene->facet_count;
    *height = -INFINITY;
    for (size_t k = 0; k < scene->facet_count; ++k) {
        const uint32_t *v = scene->facets[k].v;
        /* Cramer's rule for a + x (b - a) + y (c - a) = p + h s. */
        srp_vec3 a = scene->vertices[v[0]];
        srp_vec3 e = srp_vec3_sub(scene->vertices[v[1]], a);
        srp_vec3 g = srp_vec3_sub(scene->vertices[v[2]], a);
        srp_vec3 d = srp_vec3_sub(p, a);
        srp_vec3 n = srp_vec3_cross(e, g);
        double det = srp_vec3_dot(n, s);
        double x = srp_vec3_dot(srp_vec3_cross(d, g), s) / det;
        double y = srp_vec3_dot(srp_vec3_cross(e, d), s) / det;
        double h = -srp_vec3_dot(n, d) / det;
        if (x >= 0.0 && y >= 0.0 && x + y <= 1.0 && h > *height) {
            *height = h;
            hit = k;
        }
    }
    return hit;
}

/* The sums per material, ray by ray. */
static void cast_slowly(const srp_scene *scene, const srp_lattice_params *lattice, srp_vec3 s,
                        srp_basis *basis) {
    srp_view view = srp_view_of(s);
    double du = (lattice->window[1] - lattice->window[0]) / lattice->columns;
    double dv = (lattice->window[3] - lattice->window[2]) / lattice->rows;
    memset(basis, 0, (scene->material_count + 1) * sizeof *basis);
    for (uint32_t j = 0; j < lattice->rows; ++j) {
        for (uint32_t i = 0; i < lattice->columns; ++i) {
            srp_vec3 at = srp_vec3_make(lattice->window[0] + (i + 0.5) * du,
                                        lattice->window[2] + (j + 0.5) * dv, 0.0);
            srp_vec3 p = srp_view_lift(&view, at);
            double height;
            size_t k = first_hit(scene, p, s, &height);
            if (k < scene->facet_count) {
                const srp_facet *facet = &scene->facets[k];
                double c = srp_vec3_dot(facet->normal, s);
                bool absorbs = c < 0.0 && scene->optics[facet->material].one_sided;
                size_t row = absorbs ? scene->material_count : facet->material;
                /* srp_basis_add, which is linear in the centroid, ray by ray. */
                srp_vec3 n = srp_vec3_scale(c < 0.0 ? -1.0 : 1.0, facet->normal);
                srp_vec3 r = srp_vec3_add_scaled(p, height, s);
                srp_vec3 moment = srp_vec3_cross(r, n);
                basis[row].a += du * dv;
                basis[row].b = srp_vec3_add_scaled(basis[row].b, du * dv * fabs(c), n);
                basis[row].c = srp_vec3_add_scaled(basis[row].c, du * dv, n);
                basis[row].ra = srp_vec3_add_scaled(basis[row].ra, du * dv, r);
                basis[row].rb = srp_vec3_add_scaled(basis[row].rb, du * dv * fabs(c), moment);
                basis[row].rc = srp_vec3_add_scaled(basis[row].rc, du * dv, moment);
            }
        }
    }
}

static void compare_basis(const srp_basis *got, const srp_basis *want, size_t count) {
    for (size_t m = 0; m < count; ++m) {
        assert_close(got[m].a, want[m].a, 1e-12, 1e-14);
        assert_vec3_close(got[m].b, want[m].b, 1e-12, 1e-13);
        assert_vec3_close(got[m].c, want[m].c, 1e-12, 1e-13);
        assert_vec3_close(got[m].ra, want[m].ra, 1e-12, 1e-12);
        assert_vec3_close(got[m].rb, want[m].rb, 1e-12, 1e-12);
        assert_vec3_close(got[m].rc, want[m].rc, 1e-12, 1e-12);
    }
}

static void compare_with_slow_cast(const srp_scene *scene, const srp_method_params *params,
                                   size_t directions, uint64_t *seed) {
    srp_basis got[4], want[4];
    ck_assert_uint_le(scene->material_count + 1, 4);
    srp_prepared *prepared = prepare_with(&srp_method_raycast, scene, params);
    for (size_t n = 0; n < directions; ++n) {
        srp_vec3 s = random_direction(seed);
        srp_response response;
        srp_error error;
        assert_ok(srp_prepared_respond(prepared, 1, &s, &response, got, &error), error);
        cast_slowly(scene, &params->lattice, s, want);
        compare_basis(got, want, scene->material_count + 1);
        ck_assert_uint_eq(response.samples,
                          (uint64_t)params->lattice.columns * params->lattice.rows);
    }
    srp_prepared_release(prepared);
}

START_TEST(window_answers_ray_by_ray) {
    uint64_t seed = 1;
    srp_method_params params = window_params(1.9, 67, 43);
    for (int round = 0; round < 4; ++round) {
        srp_optics optics = SHINY;
        optics.one_sided = round & 1;
        srp_scene *scene = shape_scene(soup(round < 2 ? 40 : 5, &seed), optics);
        compare_with_slow_cast(scene, &params, 8, &seed);
        srp_scene_destroy(scene);
    }
    srp_scene *box = shape_scene(
        shape_box(srp_vec3_make(-1.0, -0.3, -0.2), srp_vec3_make(0.9, 0.8, 1.1), "box"), SHINY);
    compare_with_slow_cast(box, &params, 8, &seed);
    srp_scene_destroy(box);
}
END_TEST

START_TEST(window_smaller_than_the_model_is_cut_at_its_edge) {
    uint64_t seed = 2;
    srp_method_params params = window_params(0.4, 31, 57);
    params.lattice.window[1] = 0.7;
    srp_scene *scene = shape_scene(soup(30, &seed), SHINY);
    compare_with_slow_cast(scene, &params, 8, &seed);
    srp_scene_destroy(scene);
}
END_TEST

/* A fan of random triangles that tile the square [-1, 1]^2 of the plane z = 0. */
static srp_mesh *tiled_square(uint64_t *seed, double tilt) {
    srp_mesh *mesh = NULL;
    enum { SIDE = 7 };
    srp_vec3 vertices[(SIDE + 1) * (SIDE + 1)];
    srp_triangle triangles[2 * SIDE * SIDE];
    for (int j = 0; j <= SIDE; ++j) {
        for (int i = 0; i <= SIDE; ++i) {
            double x = i, y = j;
            x += i > 0 && i < SIDE ? 0.4 * (random_unit(seed) - 0.5) : 0.0;
            y += j > 0 && j < SIDE ? 0.4 * (random_unit(seed) - 0.5) : 0.0;
            x = 2.0 * x / SIDE - 1.0;
            y = 2.0 * y / SIDE - 1.0;
            vertices[j * (SIDE + 1) + i] = srp_vec3_make(x, y, tilt * x);
        }
    }
    for (int j = 0, k = 0; j < SIDE; ++j) {
        for (int i = 0; i < SIDE; ++i) {
            uint32_t a = (uint32_t)(j * (SIDE + 1) + i), b = a + 1, c = a + SIDE + 1, d = c + 1;
            bool flip = random_unit(seed) < 0.5;
            triangles[k++] = flip ? (srp_triangle){{a, b, c}} : (srp_triangle){{a, b, d}};
            triangles[k++] = flip ? (srp_triangle){{b, d, c}} : (srp_triangle){{a, d, c}};
        }
    }
    mesh = shape_mesh(vertices, (SIDE + 1) * (SIDE + 1), triangles, 2 * SIDE * SIDE, "sheet");
    return mesh;
}

/* Samples hit by the facets one by one, without a depth test. */
static int64_t count_alone(const srp_scene *scene, const srp_method_params *params, srp_vec3 s) {
    int64_t total = 0;
    for (size_t k = 0; k < scene->facet_count; ++k) {
        srp_scene one = *scene;
        one.facets = &scene->facets[k];
        one.facet_count = 1;
        srp_raster_mesh mesh;
        srp_raster_frame frame;
        srp_raster_canvas canvas = {0};
        srp_view axes = srp_lattice_axes(&params->lattice, s);
        ck_assert(srp_raster_mesh_create(&mesh, &one));
        ck_assert(srp_raster_frame_create(&frame, &mesh));
        srp_extent extent = srp_raster_frame_project(&frame, &axes);
        srp_lattice lattice = srp_lattice_fit(&params->lattice, &axes, extent, 0, params->seed);
        srp_raster_frame_bind(&frame, params->lattice.kind, &lattice);
        ck_assert(srp_raster_canvas_begin(&canvas, &frame));
        srp_raster_canvas_count(&canvas, &frame, 0, lattice.rows);
        total += frame.facet_count > 0 ? canvas.tally[0].n : 0;
        srp_raster_canvas_clear(&canvas);
        srp_raster_frame_clear(&frame);
        srp_raster_mesh_clear(&mesh);
    }
    return total;
}

START_TEST(tiles_share_no_sample_and_leave_none_out) {
    uint64_t seed = 3;
    const srp_vec3 above = {0.0, 0.0, 1.0}, below = {0.0, 0.0, -1.0};
    for (int round = 0; round < 20; ++round) {
        srp_scene *scene = shape_scene(tiled_square(&seed, round & 1 ? 0.3 : 0.0), SHINY);
        /* The last rounds put samples exactly on edges and corners. */
        srp_method_params params = window_params(1.0, 100, 100);
        if (round >= 10) {
            params.lattice.columns = params.lattice.rows = 7;
            params.lattice.window[0] = params.lattice.window[2] = -1.0 - 1.0 / 7.0;
            params.lattice.window[1] = params.lattice.window[3] = 1.0 - 1.0 / 7.0;
        }
        int64_t want = (int64_t)params.lattice.columns * params.lattice.rows;
        ck_assert_int_eq(count_alone(scene, &params, above), want);
        ck_assert_int_eq(count_alone(scene, &params, below), want);
        srp_prepared *prepared = prepare_with(&srp_method_raycast, scene, &params);
        srp_response response = respond_to(prepared, above);
        double area = (params.lattice.window[1] - params.lattice.window[0]) *
                      (params.lattice.window[3] - params.lattice.window[2]);
        assert_close(response.lit_area, area, 1e-14, 0.0);
        /* A window as large as the model holds it; the shifted one does not. */
        ck_assert_uint_eq(response.flags, round < 10 ? 0 : SRP_RESPONSE_CUT);
        srp_prepared_release(prepared);
        srp_scene_destroy(scene);
    }
}
END_TEST

START_TEST(bits_depend_on_neither_threads_nor_batches) {
    enum { COUNT = 60 };
    uint64_t seed = 4;
    srp_vec3 s[COUNT];
    srp_response want[COUNT], got[COUNT];
    srp_error error;
    srp_scene *scene = shape_scene(soup(50, &seed), SHINY);
    srp_method_params params = srp_method_params_default();
    params.lattice.samples = 700;
    for (size_t n = 0; n < COUNT; ++n) {
        s[n] = random_direction(&seed);
    }
    params.threads = 1;
    srp_prepared *prepared = prepare_with(&srp_method_raycast, scene, &params);
    assert_ok(srp_prepared_respond(prepared, COUNT, s, want, NULL, &error), error);
    srp_prepared_release(prepared);
    for (int threads = 1; threads <= 8; threads += 3) {
        params.threads = threads;
        prepared = prepare_with(&srp_method_raycast, scene, &params);
        for (size_t batch = 1; batch <= COUNT; batch *= 4) {
            for (size_t n = 0; n < COUNT; n += batch) {
                size_t count = COUNT - n < batch ? COUNT - n : batch;
                assert_ok(srp_prepared_respond(prepared, count, s + n, got + n, NULL, &error),
                          error);
            }
            ck_assert_int_eq(memcmp(got, want, sizeof got), 0);
        }
        srp_prepared_release(prepared);
    }
    srp_scene_destroy(scene);
}
END_TEST

/* Sum of the facet formula over a convex body, all of whose lit faces are seen whole. */
static srp_vec3 convex_force(const srp_scene *scene, srp_vec3 s) {
    srp_vec3 f = {0.0, 0.0, 0.0};
    for (size_t k = 0; k < scene->facet_count; ++k) {
        const srp_facet *facet = &scene->facets[k];
        srp_optics optics = scene->optics[facet->material];
        double c = srp_vec3_dot(facet->normal, s);
        if (c > 0.0) {
            f = srp_vec3_add_scaled(f, -facet->area * c * (1.0 - optics.rho_s), s);
            f = srp_vec3_add_scaled(
                f, -2.0 * facet->area * c * (optics.rho_s * c + optics.rho_d / 3.0), facet->normal);
        }
    }
    return f;
}

static srp_scene *make_brick(void) {
    return shape_scene(
        shape_box(srp_vec3_make(-1.0, -0.3, -0.2), srp_vec3_make(0.9, 0.8, 1.1), "brick"), SHINY);
}

START_TEST(error_falls_nearly_with_the_number_of_samples) {
    enum { LEVELS = 5, COUNT = 200 };
    srp_scene *scene = make_brick();
    double truth[LEVELS] = {0}, estimate[LEVELS] = {0};
    srp_method_params params = srp_method_params_default();
    for (int level = 0; level < LEVELS; ++level) {
        uint64_t seed = 5;
        params.lattice.samples = 32U << level;
        srp_prepared *prepared = prepare_with(&srp_method_raycast, scene, &params);
        for (int n = 0; n < COUNT; ++n) {
            srp_vec3 s = random_direction(&seed);
            srp_response response = respond_to(prepared, s);
            truth[level] += srp_vec3_norm(srp_vec3_sub(response.f, convex_force(scene, s))) / COUNT;
            estimate[level] += response.f_error / COUNT;
        }
        printf("brick, N = %4u: mean error %.2e m^2, estimated %.2e", params.lattice.samples,
               truth[level], estimate[level]);
        if (level > 0) {
            printf(", order %.2f", log2(truth[level - 1] / truth[level]));
        }
        printf("\n");
        srp_prepared_release(prepared);
    }
    double order = log2(truth[0] / truth[LEVELS - 1]) / (LEVELS - 1);
    ck_assert_msg(order > 1.5, "order of convergence %g", order);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(lattice_is_fitted_and_shifted) {
    uint64_t seed = 6;
    srp_scene *scene = make_brick();
    srp_raster_mesh mesh;
    srp_raster_frame frame;
    ck_assert(srp_raster_mesh_create(&mesh, scene));
    ck_assert(srp_raster_frame_create(&frame, &mesh));
    srp_lattice_params params = srp_method_params_default().lattice;
    params.samples = 100;
    for (int n = 0; n < 50; ++n) {
        srp_vec3 s = random_direction(&seed);
        srp_view view = srp_view_of(s), axes = srp_lattice_axes(&params, s);
        assert_close(srp_vec3_dot(axes.u, view.u), cos(31.7 * SRP_RAD_PER_DEG), 1e-14, 0.0);
        assert_close(srp_vec3_dot(axes.u, view.v), sin(31.7 * SRP_RAD_PER_DEG), 1e-14, 0.0);
        assert_vec3_close(srp_vec3_cross(axes.u, axes.v), s, 1e-14, 0.0);
        srp_extent e = srp_raster_frame_project(&frame, &axes);
        srp_lattice a = srp_lattice_fit(&params, &axes, e, 0, 0);
        srp_lattice b = srp_lattice_fit(&params, &axes, e, 0, 1);
        ck_assert_int_eq(a.columns > a.rows ? a.columns : a.rows, 100);
        ck_assert_double_eq(a.du, a.dv);
        assert_close(a.du * 100.0, fmax(e.u_max - e.u_min, e.v_max - e.v_min), 1e-14, 0.0);
        /* The first sample lies in the first cell, the last row and column reach the far side. */
        ck_assert(a.u0 >= e.u_min && a.u0 < e.u_min + a.du);
        ck_assert(a.v0 >= e.v_min && a.v0 < e.v_min + a.dv);
        ck_assert(a.u0 + a.columns * a.du >= e.u_max && a.v0 + a.rows * a.dv >= e.v_max);
        ck_assert(a.u0 != b.u0 && a.v0 != b.v0);
    }
    srp_raster_frame_clear(&frame);
    srp_raster_mesh_clear(&mesh);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(pixel_sets_the_cell) {
    uint64_t seed = 7;
    srp_scene *scene = make_brick();
    srp_method_params params = srp_method_params_default();
    params.lattice.pixel = 0.01;
    srp_prepared *prepared = prepare_with(&srp_method_raycast, scene, &params);
    for (int n = 0; n < 20; ++n) {
        srp_vec3 s = random_direction(&seed);
        srp_response response = respond_to(prepared, s);
        double off = srp_vec3_norm(srp_vec3_sub(response.f, convex_force(scene, s)));
        ck_assert(off < 5.0 * response.f_error);
        double cells = response.lit_area / 1e-4;
        assert_close(cells, round(cells), 1e-12, 0.0);
    }
    srp_prepared_release(prepared);
    params.lattice.pixel = 1e-6;
    srp_error error;
    prepared = NULL;
    ck_assert_int_eq(srp_method_prepare(&srp_method_raycast, scene, &params, &prepared, &error),
                     SRP_BAD_ARGUMENT);
    ck_assert_ptr_nonnull(strstr(error.message, "at most 32768"));
    ck_assert_ptr_null(prepared);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(tolerance_chooses_the_samples) {
    uint64_t seed = 8;
    srp_scene *scene = make_brick();
    srp_method_params params = srp_method_params_default();
    params.lattice.samples = 16;
    params.tolerance = 1e-3;
    params.threads = 3;
    srp_prepared *prepared = prepare_with(&srp_method_raycast, scene, &params);
    for (int n = 0; n < 40; ++n) {
        srp_vec3 s = random_direction(&seed);
        srp_response response = respond_to(prepared, s);
        ck_assert_uint_eq(response.flags, 0);
        ck_assert(response.f_error <= 1e-3 * srp_vec3_norm(response.f));
        ck_assert(response.samples > 16 * 16);
    }
    srp_prepared_release(prepared);
    params.tolerance = 1e-9;
    params.max_samples = 100;
    prepared = prepare_with(&srp_method_raycast, scene, &params);
    srp_response response = respond_to(prepared, random_direction(&seed));
    ck_assert_uint_eq(response.flags, SRP_RESPONSE_TOLERANCE_MISSED);
    ck_assert(response.samples > 32 * 32 && response.samples <= 64 * 64);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(window_that_cuts_says_so) {
    srp_scene *scene = make_brick();
    srp_method_params params = window_params(2.0, 200, 200);
    srp_vec3 s = {0.0, 0.0, 1.0};
    srp_prepared *prepared = prepare_with(&srp_method_raycast, scene, &params);
    srp_response whole = respond_to(prepared, s);
    ck_assert_uint_eq(whole.flags, 0);
    srp_prepared_release(prepared);
    /* Leaves out what lies beyond x = -0.5, seen along v. */
    params.lattice.window[3] = 0.5;
    prepared = prepare_with(&srp_method_raycast, scene, &params);
    srp_response cut = respond_to(prepared, s);
    ck_assert_uint_eq(cut.flags, SRP_RESPONSE_CUT);
    ck_assert(srp_vec3_norm(srp_vec3_sub(cut.f, whole.f)) > 0.1);
    ck_assert(srp_vec3_norm(srp_vec3_sub(cut.f, whole.f)) < cut.f_error);
    srp_prepared_release(prepared);
    /* Nothing at all in sight. */
    params.lattice.window[2] = 5.0;
    params.lattice.window[3] = 9.0;
    prepared = prepare_with(&srp_method_raycast, scene, &params);
    cut = respond_to(prepared, s);
    ck_assert_uint_eq(cut.flags, SRP_RESPONSE_CUT);
    ck_assert_double_eq(cut.lit_area, 0.0);
    ck_assert(cut.f_error >= srp_vec3_norm(whole.f));
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(open_sheet_is_lit_from_both_sides) {
    uint64_t seed = 9;
    for (int one_sided = 0; one_sided <= 1; ++one_sided) {
        srp_optics optics = {0.5, 0.1, one_sided};
        srp_scene *scene = shape_scene(tiled_square(&seed, 0.0), optics);
        srp_method_params params = window_params(1.0, 50, 50);
        srp_prepared *prepared = prepare_with(&srp_method_raycast, scene, &params);
        srp_response front = respond_to(prepared, srp_vec3_make(0.0, 0.0, 1.0));
        srp_response back = respond_to(prepared, srp_vec3_make(0.0, 0.0, -1.0));
        double absorbed = 4.0, reflected = 4.0 * (1.0 - 0.5 + 2.0 * (0.5 + 0.1 / 3.0));
        assert_close(front.f.z, -reflected, 1e-12, 0.0);
        assert_close(front.back_area, 0.0, 0.0, 0.0);
        assert_close(back.f.z, one_sided ? absorbed : reflected, 1e-12, 0.0);
        assert_close(back.back_area, one_sided ? 4.0 : 0.0, 1e-12, 0.0);
        srp_prepared_release(prepared);
        srp_scene_destroy(scene);
    }
}
END_TEST

/* Two sheets of other winding at one place: the one whose outside faces the Sun is hit, whichever
 * comes first. */
START_TEST(coincident_faces_show_their_outside) {
    const srp_vec3 corner[4] = {
        {-1.0, -1.0, 0.0}, {1.0, -1.0, 0.0}, {1.0, 1.0, 0.0}, {-1.0, 1.0, 0.0}};
    const srp_triangle up[2] = {{{0, 1, 2}}, {{0, 2, 3}}}, down[2] = {{{0, 3, 1}}, {{1, 3, 2}}};
    for (int order = 0; order < 2; ++order) {
        srp_mesh *mesh = shape_mesh(corner, 4, order ? down : up, 2, order ? "down" : "up");
        shape_join(mesh, shape_mesh(corner, 4, order ? up : down, 2, order ? "up" : "down"));
        srp_scene *scene = shape_scene(mesh, SHINY);
        size_t up_row = order ? 1 : 0;
        ck_assert_str_eq(srp_scene_material_name(scene, up_row), "up");
        srp_method_params params = srp_method_params_default();
        srp_prepared *prepared = prepare_with(&srp_method_raycast, scene, &params);
        uint64_t seed = 10;
        for (int n = 0; n < 50; ++n) {
            srp_vec3 s = random_direction(&seed);
            srp_basis basis[3];
            srp_response response;
            srp_error error;
            assert_ok(srp_prepared_respond(prepared, 1, &s, &response, basis, &error), error);
            ck_assert_double_eq(basis[s.z > 0.0 ? 1 - up_row : up_row].a, 0.0);
            ck_assert(basis[s.z > 0.0 ? up_row : 1 - up_row].a > 0.0);
        }
        srp_prepared_release(prepared);
        srp_scene_destroy(scene);
    }
}
END_TEST

START_TEST(largest_lattice_needs_little_memory) {
    srp_scene *scene = make_brick();
    srp_raster_mesh mesh;
    srp_raster_frame frame;
    srp_raster_canvas canvas = {0};
    ck_assert(srp_raster_mesh_create(&mesh, scene));
    ck_assert(srp_raster_frame_create(&frame, &mesh));
    srp_lattice_params params = srp_method_params_default().lattice;
    params.samples = 32768;
    srp_vec3 s = srp_direction_from_deg(33.0, 21.0);
    srp_view axes = srp_lattice_axes(&params, s);
    srp_extent extent = srp_raster_frame_project(&frame, &axes);
    srp_lattice lattice = srp_lattice_fit(&params, &axes, extent, 0, 0);
    srp_raster_frame_bind(&frame, params.kind, &lattice);
    ck_assert(srp_raster_canvas_begin(&canvas, &frame));
    ck_assert_uint_le(canvas.cell_capacity * 16, 1 << 20);
    /* A few of its rows, in any pieces: the same counts. */
    srp_raster_canvas_count(&canvas, &frame, 10000, 10040);
    srp_raster_canvas pieces = {0};
    ck_assert(srp_raster_canvas_begin(&pieces, &frame));
    srp_raster_canvas_count(&pieces, &frame, 10000, 10013);
    srp_raster_canvas_count(&pieces, &frame, 10013, 10040);
    ck_assert_int_eq(memcmp(canvas.tally, pieces.tally, frame.facet_count * sizeof *canvas.tally),
                     0);
    srp_raster_canvas_clear(&pieces);
    srp_raster_canvas_clear(&canvas);
    srp_raster_frame_clear(&frame);
    srp_raster_mesh_clear(&mesh);
    srp_scene_destroy(scene);
}
END_TEST

/* Few directions on a large lattice share the threads over rows: the same bits. */
START_TEST(sharing_a_direction_changes_no_bit) {
    uint64_t seed = 11;
    srp_scene *scene = shape_scene(soup(50, &seed), SHINY);
    for (int kind = 0; kind < 2; ++kind) {
        srp_method_params params = window_params(1.8, 1100, 1030);
        params.lattice.kind = (srp_lattice_kind)kind;
        params.lattice.samples = 1200;
        srp_vec3 s = random_direction(&seed);
        srp_response want = {0};
        for (int threads = 1; threads <= 5; ++threads) {
            params.threads = threads;
            srp_prepared *prepared = prepare_with(&srp_method_raycast, scene, &params);
            srp_response got = respond_to(prepared, s);
            want = threads == 1 ? got : want;
            ck_assert_int_eq(memcmp(&got, &want, sizeof got), 0);
            srp_prepared_release(prepared);
        }
    }
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(seed_draws_another_shift) {
    srp_scene *scene = make_brick();
    srp_vec3 s = srp_direction_from_deg(10.0, 20.0), mean = {0.0, 0.0, 0.0};
    srp_vec3 want = convex_force(scene, s), last = {0.0, 0.0, 0.0};
    srp_method_params params = srp_method_params_default();
    params.lattice.samples = 32;
    enum { SEEDS = 400 };
    double estimate = 0.0;
    int changes = 0;
    for (uint64_t seed = 0; seed < SEEDS; ++seed) {
        params.seed = seed;
        srp_prepared *prepared = prepare_with(&srp_method_raycast, scene, &params);
        srp_response response = respond_to(prepared, s);
        changes += srp_vec3_norm(srp_vec3_sub(response.t, last)) > 0.0;
        last = response.t;
        mean = srp_vec3_add_scaled(mean, 1.0 / SEEDS, response.f);
        estimate += response.f_error / SEEDS;
        srp_prepared_release(prepared);
    }
    ck_assert_int_ge(changes, SEEDS - 5);
    /* The shift makes the mean right, not only each estimate honest. */
    ck_assert(srp_vec3_norm(srp_vec3_sub(mean, want)) < 4.0 * estimate / sqrt(SEEDS));
    srp_scene_destroy(scene);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("raycast");
    TCase *tcase = tcase_create("raycast");
    tcase_set_timeout(tcase, 120);
    tcase_add_test(tcase, window_answers_ray_by_ray);
    tcase_add_test(tcase, window_smaller_than_the_model_is_cut_at_its_edge);
    tcase_add_test(tcase, tiles_share_no_sample_and_leave_none_out);
    tcase_add_test(tcase, bits_depend_on_neither_threads_nor_batches);
    tcase_add_test(tcase, sharing_a_direction_changes_no_bit);
    tcase_add_test(tcase, error_falls_nearly_with_the_number_of_samples);
    tcase_add_test(tcase, lattice_is_fitted_and_shifted);
    tcase_add_test(tcase, seed_draws_another_shift);
    tcase_add_test(tcase, pixel_sets_the_cell);
    tcase_add_test(tcase, tolerance_chooses_the_samples);
    tcase_add_test(tcase, window_that_cuts_says_so);
    tcase_add_test(tcase, open_sheet_is_lit_from_both_sides);
    tcase_add_test(tcase, coincident_faces_show_their_outside);
    tcase_add_test(tcase, largest_lattice_needs_little_memory);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
