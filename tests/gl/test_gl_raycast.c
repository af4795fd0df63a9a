/* SPDX-License-Identifier: Apache-2.0 */
/* First hits drawn by OpenGL, against the processor's. */
#include "gl_fixture.h"
#include "model_files.h"
#include "prepared.h"
#include "raster_canvas.h"
#include "raycast.h"
#include "raycast_answer.h"
#include "scene_internal.h"
#include "shapes.h"
#include "srp_check.h"

#include <srp/gl.h>
#include <srp/table.h>

#include <string.h>

/* Vertices are moved to 1/512 of a cell, and by less in float. */
static const double SNAP = 1.0 / 256.0;

static srp_method_params params_of(uint32_t samples) {
    srp_method_params params = srp_method_params_default();
    params.threads = 1;
    params.lattice.samples = samples;
    return params;
}

/* ---- sample by sample ---- */

/* What each sample of one direction sees: 1 + number of a facet of the scene, or 0. */
typedef struct picture {
    uint32_t *facet;
    int32_t columns, rows;
} picture;

static void watch_rows(void *user, const srp_raster_frame *frame, int32_t column, int32_t row,
                       int32_t width, const uint32_t *ids) {
    picture *into = user;
    into->columns = frame->lattice.columns;
    into->rows = frame->lattice.rows;
    for (int32_t i = 0; i < width; ++i) {
        ck_assert_uint_le(ids[i], frame->facet_count);
        into->facet[(size_t)row * (size_t)into->columns + (size_t)(column + i)] =
            ids[i] == 0 ? 0 : frame->facet[ids[i] - 1] + 1;
    }
}

typedef struct visit_user {
    const srp_raster_frame *frame;
    picture *into;
} visit_user;

static void visit_run(void *user, uint32_t n, int32_t begin, int32_t end, int32_t j) {
    const visit_user *at = user;
    for (int32_t i = begin; i < end; ++i) {
        at->into->facet[(size_t)j * (size_t)at->into->columns + (size_t)i] =
            at->frame->facet[n] + 1;
    }
}

/* The processor's picture. */
typedef struct oracle {
    srp_raster_mesh mesh;
    srp_raster_frame frame;
    srp_raster_canvas canvas;
    picture picture;
} oracle;

static void oracle_create(oracle *o, const srp_scene *scene, size_t samples) {
    memset(o, 0, sizeof *o);
    ck_assert(srp_raster_mesh_create(&o->mesh, scene));
    ck_assert(srp_raster_frame_create(&o->frame, &o->mesh));
    o->picture.facet = calloc(samples, sizeof *o->picture.facet);
    ck_assert_ptr_nonnull(o->picture.facet);
}

static void oracle_clear(oracle *o) {
    srp_raster_canvas_clear(&o->canvas);
    srp_raster_frame_clear(&o->frame);
    srp_raster_mesh_clear(&o->mesh);
    free(o->picture.facet);
}

static void oracle_draw(oracle *o, const srp_prepared *prepared, srp_vec3 s) {
    srp_raycast_set_up_frame(prepared, &o->frame, s, 0);
    const srp_lattice *lattice = &o->frame.lattice;
    o->picture.columns = lattice->columns;
    o->picture.rows = lattice->rows;
    memset(o->picture.facet, 0,
           (size_t)lattice->columns * (size_t)lattice->rows * sizeof *o->picture.facet);
    ck_assert(srp_raster_canvas_begin(&o->canvas, &o->frame));
    visit_user user = {&o->frame, &o->picture};
    srp_raster_canvas_visit(&o->canvas, &o->frame, 0, lattice->rows, visit_run, &user);
}

/* Squared distance of (x, y) from the segment a-b, in cells. */
static double distance2(double x, double y, double ax, double ay, double bx, double by) {
    double ex = bx - ax, ey = by - ay, px = x - ax, py = y - ay;
    double length2 = ex * ex + ey * ey;
    double t = length2 > 0.0 ? fmax(0.0, fmin(1.0, (px * ex + py * ey) / length2)) : 0.0;
    return (px - t * ex) * (px - t * ex) + (py - t * ey) * (py - t * ey);
}

/* Distance of sample (i, j) from the nearest edge, up to SNAP, else 1. */
static double edge_distance(const srp_raster_frame *frame, double i, double j) {
    const double *x = frame->x, *y = frame->y;
    double best2 = 1.0;
    for (size_t k = 0; k < frame->mesh->facet_count; ++k) {
        const uint32_t *v = frame->mesh->v[k];
        if (fmin(x[v[0]], fmin(x[v[1]], x[v[2]])) > i + SNAP ||
            fmax(x[v[0]], fmax(x[v[1]], x[v[2]])) < i - SNAP ||
            fmin(y[v[0]], fmin(y[v[1]], y[v[2]])) > j + SNAP ||
            fmax(y[v[0]], fmax(y[v[1]], y[v[2]])) < j - SNAP) {
            continue;
        }
        for (int e = 0; e < 3; ++e) {
            uint32_t a = v[e], b = v[(e + 1) % 3];
            best2 = fmin(best2, distance2(i, j, x[a], y[a], x[b], y[b]));
        }
    }
    return sqrt(best2);
}

/* Height of facet k over sample (i, j), and how much it changes within SNAP: by moved vertices, and
 * as much again because faces turned away recede. */
static double height_at(const srp_raster_frame *frame, uint32_t k, double i, double j,
                        double *change) {
    srp_raster_plane plane = srp_raster_frame_plane(frame, k, frame->mesh->v[k][0]);
    *change = 2.0 * SNAP * (fabs(plane.along_i) + fabs(plane.along_j));
    return plane.at + i * plane.along_i + j * plane.along_j;
}

/* Whether two facets (1 + number, 0 none) are so near to each other over a sample that moved
 * vertices may have exchanged them: where two surfaces meet at a small angle. */
static bool heights_cross(const srp_raster_frame *frame, uint32_t a, uint32_t b, double i,
                          double j) {
    if (a == 0 || b == 0) {
        return false;
    }
    double change_a, change_b;
    double height_a = height_at(frame, a - 1, i, j, &change_a);
    double height_b = height_at(frame, b - 1, i, j, &change_b);
    return fabs(height_a - height_b) <= change_a + change_b;
}

typedef struct tally {
    size_t hit, differ;
    size_t crossing; /* samples that differ where surfaces meet, further than SNAP from an edge */
    size_t far;      /* samples that differ for no reason */
    double farthest; /* from an edge, of those that differ otherwise */
    double worst;    /* share that differs in one direction */
} tally;

static void compare(const oracle *o, const picture *got, tally *sum) {
    size_t hit = 0, differ = 0;
    ck_assert_int_eq(got->columns, o->picture.columns);
    ck_assert_int_eq(got->rows, o->picture.rows);
    for (int32_t j = 0; j < got->rows; ++j) {
        for (int32_t i = 0; i < got->columns; ++i) {
            size_t at = (size_t)j * (size_t)got->columns + (size_t)i;
            hit += o->picture.facet[at] != 0;
            if (o->picture.facet[at] != got->facet[at]) {
                double distance = edge_distance(&o->frame, i, j);
                ++differ;
                if (distance <= SNAP) {
                    sum->farthest = fmax(sum->farthest, distance);
                } else if (heights_cross(&o->frame, o->picture.facet[at], got->facet[at], i, j)) {
                    ++sum->crossing;
                } else {
                    ++sum->far;
                }
            }
        }
    }
    sum->hit += hit;
    sum->differ += differ;
    sum->worst = hit > 0 ? fmax(sum->worst, (double)differ / (double)hit) : sum->worst;
}

static tally compare_model(const char *name, uint32_t samples, int step) {
    srp_vec3 s[PAPER_DIRECTIONS];
    gl_paper_directions(s);
    model_file model = model_read(name);
    srp_scene *scene = model_scene(&model);
    srp_method_params params = params_of(samples);
    srp_prepared *prepared = prepare_with(gl_method("raycast"), scene, &params);
    picture got = {calloc((size_t)samples * samples, sizeof *got.facet), 0, 0};
    ck_assert_ptr_nonnull(got.facet);
    srp_gl_raycast_watch(prepared, watch_rows, &got);
    oracle o;
    oracle_create(&o, scene, (size_t)samples * samples);
    tally sum = {0, 0, 0, 0, 0.0, 0.0};
    for (int k = 0; k < PAPER_DIRECTIONS; k += step) {
        srp_response response;
        respond_each(prepared, 1, &s[k], &response);
        oracle_draw(&o, prepared, s[k]);
        compare(&o, &got, &sum);
    }
    printf(
        "  %-14s %u: %zu of %zu samples differ (%.4f %%, at most %.4f %%), at most %.2f/256 of a "
        "cell from an edge; %zu of them where surfaces meet\n",
        name, samples, sum.differ, sum.hit, 100.0 * (double)sum.differ / (double)sum.hit,
        100.0 * sum.worst, 256.0 * sum.farthest, sum.crossing);
    oracle_clear(&o);
    free(got.facet);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
    model_free(&model);
    return sum;
}

static void compare_models(uint32_t samples, int step) {
    for (size_t m = 0; m < MODEL_COUNT; ++m) {
        tally sum = compare_model(MODEL_NAMES[m], samples, step);
        ck_assert_uint_eq(sum.far, 0);
        /* 0.2 % of 512 samples a side; the share of samples near an edge goes with the cell's side.
         */
        ck_assert_double_le((double)sum.differ, 0.002 * 512.0 / samples * (double)sum.hit);
    }
}

START_TEST(samples_that_differ_lie_at_edges) {
    compare_models(128, 7);
}
END_TEST

START_TEST(samples_that_differ_lie_at_edges_long) {
    compare_models(512, 1);
}
END_TEST

/* ---- forces ---- */

/* Mean and largest |f_gl - f_cpu| / |f_cpu|. */
static double force_difference(const srp_scene *scene, const srp_method_params *params,
                               size_t count, const srp_vec3 *s, double *largest) {
    srp_response cpu[PAPER_DIRECTIONS], gl[PAPER_DIRECTIONS];
    srp_prepared *want = prepare_with(&srp_method_raycast, scene, params);
    srp_prepared *got = prepare_with(gl_method("raycast"), scene, params);
    respond_each(want, count, s, cpu);
    respond_each(got, count, s, gl);
    srp_prepared_release(want);
    srp_prepared_release(got);
    double sum = 0.0, most = 0.0;
    for (size_t k = 0; k < count; ++k) {
        double off = srp_vec3_norm(srp_vec3_sub(gl[k].f, cpu[k].f));
        double size = srp_vec3_norm(cpu[k].f);
        off = size > 0.0 ? off / size : off;
        sum += off;
        most = fmax(most, off);
        ck_assert_uint_eq(gl[k].samples, cpu[k].samples);
        ck_assert_uint_eq(gl[k].flags, cpu[k].flags);
        /* The moment and the estimates differ by as much as one sample in some hundred at an edge.
         */
        double lever = srp_scene_radius(scene);
        ck_assert_double_le(srp_vec3_norm(srp_vec3_sub(gl[k].t, cpu[k].t)),
                            0.01 * lever * (size + cpu[k].lit_area));
        assert_close(gl[k].f_error, cpu[k].f_error, 1.5, 1e-12);
        assert_close(gl[k].lit_area, cpu[k].lit_area, 0.01, 0.0);
    }
    *largest = most;
    return sum / (double)count;
}

static double compare_forces(const char *name, uint32_t samples) {
    srp_vec3 s[PAPER_DIRECTIONS];
    gl_paper_directions(s);
    model_file model = model_read(name);
    srp_scene *scene = model_scene(&model);
    srp_method_params params = params_of(samples);
    double largest, mean = force_difference(scene, &params, PAPER_DIRECTIONS, s, &largest);
    printf("  %-14s %4u: |f_gl - f_cpu| / |f| %.2e in the mean, %.2e at most\n", name, samples,
           mean, largest);
    srp_scene_destroy(scene);
    model_free(&model);
    return mean;
}

START_TEST(forces_agree_ever_better) {
    static const char *const NAMES[] = {"cube", "icosphere-320", "dish"};
    for (size_t m = 0; m < 3; ++m) {
        double coarse = compare_forces(NAMES[m], 128), fine = compare_forces(NAMES[m], 512);
        ck_assert_double_le(fine, 1e-5);
        ck_assert_double_lt(fine, 0.5 * coarse);
    }
}
END_TEST

START_TEST(forces_agree_ever_better_long) {
    for (size_t m = 0; m < MODEL_COUNT; ++m) {
        double coarse = compare_forces(MODEL_NAMES[m], 256);
        double fine = compare_forces(MODEL_NAMES[m], 512);
        double finest = compare_forces(MODEL_NAMES[m], 2048);
        ck_assert_double_le(fine, 5e-5);
        ck_assert_double_lt(finest, 0.5 * coarse);
    }
}
END_TEST

/* AAS 20-481, Table 2: the paper's error on the GPU rises from 512 on. */
START_TEST(cube_error_falls_up_to_4096) {
    srp_vec3 s[PAPER_DIRECTIONS];
    gl_paper_directions(s);
    model_file model = model_read("cube");
    srp_scene *scene = model_scene_painted(&model, (srp_optics){0.5, 0.1, false});
    srp_response exact[PAPER_DIRECTIONS], gl[PAPER_DIRECTIONS];
    srp_method_params params = params_of(512);
    srp_prepared *truth = prepare_with(&srp_method_exact, scene, &params);
    respond_each(truth, PAPER_DIRECTIONS, s, exact);
    srp_prepared_release(truth);
    double before = INFINITY;
    for (uint32_t side = 256; side <= 4096; side *= 4) {
        params = params_of(side);
        srp_prepared *prepared = prepare_with(gl_method("raycast"), scene, &params);
        double error = 0.0;
        /* Every ninth direction: of those alike, one. */
        for (int k = 0; k < PAPER_DIRECTIONS; k += 9) {
            respond_each(prepared, 1, &s[k], &gl[k]);
            error += srp_vec3_norm(srp_vec3_sub(gl[k].f, exact[k].f)) / 18.0;
        }
        srp_prepared_release(prepared);
        printf("  cube %4u: mean error %.2e m^2\n", side, error);
        ck_assert_double_lt(error, 0.25 * before);
        before = error;
    }
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

/* ---- what all methods keep ---- */

static srp_scene *box_and_sheet(void) {
    const srp_vec3 corners[4] = {
        {-0.9, -2.1, -1.7}, {2.6, -1.9, -1.4}, {2.4, 1.8, 1.6}, {-1.1, 2.2, 1.3}};
    const srp_triangle halves[2] = {{{0, 1, 2}}, {{0, 2, 3}}};
    srp_mesh *mesh =
        shape_box(srp_vec3_make(-1.0, -0.3, -0.2), srp_vec3_make(0.9, 0.8, 1.1), "box");
    shape_join(mesh, shape_mesh(corners, 4, halves, 2, "sheet"));
    return shape_scene(mesh, (srp_optics){0.31, 0.23, true});
}

START_TEST(windows_and_pieces_of_large_lattices_agree) {
    uint64_t seed = 5;
    srp_vec3 s[6];
    for (int k = 0; k < 6; ++k) {
        s[k] = random_direction(&seed);
    }
    srp_scene *scene = box_and_sheet();
    double largest;
    srp_method_params params = params_of(2500); /* wider than one layer */
    ck_assert_double_lt(force_difference(scene, &params, 6, s, &largest), 1e-5);
    params.lattice.kind = SRP_LATTICE_WINDOW;
    params.lattice.columns = 700;
    params.lattice.rows = 450;
    const double window[4] = {-1.2, 0.7, -2.3, 1.9}; /* cuts the model */
    memcpy(params.lattice.window, window, sizeof window);
    params.reference = srp_vec3_make(0.4, -0.7, 0.2);
    ck_assert_double_lt(force_difference(scene, &params, 6, s, &largest), 2e-4);
    ck_assert_double_lt(largest, 1e-3);
    srp_scene_destroy(scene);
}
END_TEST

/* A box of 2 m x 2 m and a length along (az, el), about the origin. */
static srp_scene *long_box(double az, double el, double length) {
    srp_mesh *box = shape_box(srp_vec3_make(-0.5 * length, -1.0, -1.0),
                              srp_vec3_make(0.5 * length, 1.0, 1.0), "box");
    const srp_vec3 along = {cos(el) * cos(az), cos(el) * sin(az), sin(el)};
    const srp_vec3 right = {-sin(az), cos(az), 0.0};
    const srp_vec3 up = {-sin(el) * cos(az), -sin(el) * sin(az), cos(el)};
    srp_vec3 corners[8];
    for (int i = 0; i < 8; ++i) {
        srp_vec3 p = srp_mesh_vertices(box)[i];
        corners[i] = srp_vec3_add_scaled(
            srp_vec3_add_scaled(srp_vec3_scale(p.x, along), p.y, right), p.z, up);
    }
    srp_mesh *turned = shape_mesh(corners, 8, srp_mesh_triangles(box), 12, "box");
    srp_mesh_destroy(box);
    return shape_scene(turned, (srp_optics){0.31, 0.23, false});
}

/* Light along the sides of a box grazes them to within rounding. GPUs see them from samples nearby,
 * and what float leaves of a long model is coarse beside a cell. */
START_TEST(long_boxes_are_seen_end_on) {
    const double az = SRP_PI / 6.0, el = SRP_PI / 18.0;
    srp_vec3 s = srp_direction_from_deg(30.0, 10.0);
    static const double LENGTHS[] = {20.0, 60.0, 2e3, 2e6};
    static const uint32_t SIDES[] = {244, 512, 622};
    for (size_t k = 0; k < 4; ++k) {
        srp_scene *scene = long_box(az, el, LENGTHS[k]);
        for (size_t m = 0; m < 3; ++m) {
            srp_method_params params = params_of(SIDES[m]);
            srp_response cpu, gl;
            srp_prepared *want = prepare_with(&srp_method_raycast, scene, &params);
            srp_prepared *got = prepare_with(gl_method("raycast"), scene, &params);
            respond_each(want, 1, &s, &cpu);
            respond_each(got, 1, &s, &gl);
            ck_assert_double_le(srp_vec3_norm(srp_vec3_sub(gl.f, cpu.f)), cpu.f_error);
            ck_assert_double_le(srp_vec3_norm(srp_vec3_sub(gl.t, cpu.t)), cpu.t_error);
            srp_prepared_release(want);
            srp_prepared_release(got);
        }
        srp_scene_destroy(scene);
    }
}
END_TEST

/* Should a GPU see a grazed facet from a sample beside it, then the force acts within the facet,
 * wherever its plane is over that sample. */
START_TEST(grazed_facets_act_within_their_corners) {
    srp_vec3 s = srp_direction_from_deg(30.0, 10.0);
    srp_scene *scene = long_box(SRP_PI / 6.0, SRP_PI / 18.0, 20.0);
    srp_method_params params = params_of(64);
    srp_prepared *prepared = prepare_with(&srp_method_raycast, scene, &params);
    double *lever2 = srp_raycast_measure_levers(scene, params.reference);
    ck_assert_ptr_nonnull(lever2);
    oracle o;
    oracle_create(&o, scene, 64 * 64);
    oracle_draw(&o, prepared, s);
    size_t grazed = 0;
    for (uint32_t k = 0; k < o.mesh.facet_count; ++k) {
        if (fabs(o.frame.cosine[k]) < 1e-9 && o.frame.cosine[k] != 0.0) {
            o.frame.facet[grazed++] = k;
        }
    }
    ck_assert_uint_ge(grazed, 1);
    o.frame.facet_count = 1;
    const srp_raster_tally one = {1, 13, 57};
    srp_variation variation;
    memset(&variation, 0, sizeof variation);
    ck_assert(srp_variation_begin(&variation, o.frame.kind, &o.frame.lattice));
    srp_basis basis[4];
    srp_response response;
    memset(&response, 0, sizeof response);
    srp_raycast_count count = {&o.frame, &one, &variation};
    ck_assert(srp_raycast_answer(prepared, lever2, &count, basis, &response));
    srp_basis_finish(scene, basis, s, &response);
    ck_assert_double_gt(srp_vec3_norm(response.f), 0.0);
    ck_assert_double_le(srp_vec3_norm(response.t), 12.0 * srp_vec3_norm(response.f));
    srp_variation_clear(&variation);
    oracle_clear(&o);
    free(lever2);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}
END_TEST

/* A sheet with its front up on a larger one with its front down, in one plane. From above the back
 * of the larger one is hidden where the smaller one lies. */
START_TEST(of_coincident_faces_the_one_turned_to_the_sun_is_seen) {
    const srp_vec3 small[4] = {
        {-0.93, -1.12, 0.17}, {1.31, -0.81, 0.17}, {1.14, 0.92, 0.17}, {-1.23, 1.21, 0.17}};
    const srp_vec3 large[4] = {
        {-2.13, -2.42, 0.17}, {2.21, -2.03, 0.17}, {2.37, 1.98, 0.17}, {-2.28, 2.06, 0.17}};
    const srp_triangle up[2] = {{{0, 1, 2}}, {{0, 2, 3}}}, down[2] = {{{0, 2, 1}}, {{0, 3, 2}}};
    const srp_vec3 diagonal[2] = {srp_vec3_sub(small[2], small[0]),
                                  srp_vec3_sub(small[3], small[1])};
    double area = 0.5 * srp_vec3_norm(srp_vec3_cross(diagonal[0], diagonal[1]));
    srp_mesh *mesh = shape_mesh(small, 4, up, 2, "small");
    shape_join(mesh, shape_mesh(large, 4, down, 2, "large"));
    srp_scene *scene = shape_scene(mesh, (srp_optics){0.2, 0.3, true});
    srp_method_params params = params_of(300);
    srp_prepared *prepared = prepare_with(gl_method("raycast"), scene, &params);
    uint64_t seed = 6;
    for (int k = 0; k < 20; ++k) {
        srp_vec3 s = random_direction(&seed);
        srp_response response;
        s.z = fabs(s.z);
        respond_each(prepared, 1, &s, &response);
        assert_close(response.lit_area - response.back_area, area * s.z, 0.01, 0.0);
    }
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(answers_depend_on_the_direction_alone) {
    uint64_t seed = 7;
    enum { COUNT = 70 };
    srp_vec3 s[COUNT];
    for (int k = 0; k < COUNT; ++k) {
        s[k] = random_direction(&seed);
    }
    model_file model = model_read("box-wing");
    srp_scene *scene = model_scene(&model);
    size_t row = srp_scene_material_count(scene) + 1;
    srp_method_params params = params_of(96);
    srp_prepared *one = prepare_with(gl_method("raycast"), scene, &params);
    params.threads = 3;
    srp_prepared *many = prepare_with(gl_method("raycast"), scene, &params);
    srp_response all[COUNT], single;
    srp_basis *basis = calloc(COUNT * row, sizeof *basis), *alone = calloc(row, sizeof *alone);
    srp_error error;
    assert_ok(srp_prepared_respond(many, COUNT, s, all, basis, &error), error);
    for (int k = 0; k < COUNT; ++k) {
        assert_ok(srp_prepared_respond(one, 1, &s[k], &single, alone, &error), error);
        ck_assert_mem_eq(&single, &all[k], sizeof single);
        ck_assert_mem_eq(alone, basis + (size_t)k * row, row * sizeof *alone);
    }
    free(basis);
    free(alone);
    srp_prepared_release(one);
    srp_prepared_release(many);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

START_TEST(tolerance_refines) {
    model_file model = model_read("dish");
    srp_scene *scene = model_scene(&model);
    srp_method_params params = params_of(32);
    params.tolerance = 2e-3;
    srp_prepared *prepared = prepare_with(gl_method("raycast"), scene, &params);
    uint64_t seed = 8;
    srp_vec3 s[5];
    srp_response responses[5];
    for (int k = 0; k < 5; ++k) {
        s[k] = random_direction(&seed);
    }
    respond_each(prepared, 5, s, responses);
    for (int k = 0; k < 5; ++k) {
        ck_assert_double_le(responses[k].f_error, 2e-3 * srp_vec3_norm(responses[k].f));
        ck_assert_uint_gt(responses[k].samples, 2 * 32 * 32);
    }
    srp_prepared_release(prepared);
    params.max_samples = 64;
    params.tolerance = 1e-7;
    prepared = prepare_with(gl_method("raycast"), scene, &params);
    respond_each(prepared, 5, s, responses);
    for (int k = 0; k < 5; ++k) {
        ck_assert_uint_ne(responses[k].flags & SRP_RESPONSE_TOLERANCE_MISSED, 0);
    }
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

/* OSMesa and EGL in one process, on this machine one renderer: the same bits. */
START_TEST(providers_agree) {
    const char *other = strcmp(gl_device_name, "gl:osmesa") == 0 ? "gl:egl" : "gl:osmesa";
    srp_gl_description here, there;
    srp_error error;
    assert_ok(srp_gl_device_describe(gl_device_name, &here, &error), error);
    if (!gl_device_is_there(other)) {
        return;
    }
    assert_ok(srp_gl_device_describe(other, &there, &error), error);
    if (strcmp(here.renderer, there.renderer) != 0) {
        printf("skipped: %s and %s are two renderers\n", gl_device_name, other);
        return;
    }
    srp_vec3 s[PAPER_DIRECTIONS];
    srp_response a[PAPER_DIRECTIONS], b[PAPER_DIRECTIONS];
    gl_paper_directions(s);
    model_file model = model_read("box-wing");
    srp_scene *scene = model_scene(&model);
    srp_method_params params = params_of(200);
    srp_prepared *first = prepare_with(gl_method("raycast"), scene, &params);
    srp_prepared *second = prepare_with(gl_method_on(other, "raycast"), scene, &params);
    respond_each(first, PAPER_DIRECTIONS, s, a);
    respond_each(second, PAPER_DIRECTIONS, s, b);
    ck_assert_mem_eq(a, b, sizeof a);
    srp_prepared_release(first);
    srp_prepared_release(second);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

START_TEST(a_table_is_filled) {
    model_file model = model_read("cube");
    srp_scene *scene = model_scene(&model);
    srp_method_params params = params_of(64);
    srp_prepared *prepared = prepare_with(gl_method("raycast"), scene, &params);
    srp_grid grid;
    srp_table *table = NULL;
    srp_error error;
    assert_ok(srp_grid_from_steps(45.0, 45.0, &grid, &error), error);
    assert_ok(srp_table_create(prepared, grid, true, &table, &error), error);
    assert_ok(srp_table_fill(table, prepared, NULL, &error), error);
    ck_assert_str_eq(srp_table_get_info(table)->device, gl_device_name);
    ck_assert_uint_eq(srp_table_filled_count(table), srp_grid_node_count(grid));
    srp_table_destroy(table);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

START_TEST(too_many_cells_are_refused) {
    srp_scene *scene = box_and_sheet();
    srp_method_params params = params_of(64);
    params.lattice.pixel = 1e-6;
    srp_prepared *prepared = NULL;
    srp_error error;
    ck_assert_int_eq(srp_method_prepare(gl_method("raycast"), scene, &params, &prepared, &error),
                     SRP_BAD_ARGUMENT);
    ck_assert_ptr_null(prepared);
    srp_scene_destroy(scene);
}
END_TEST

static Suite *make_suite(bool is_long) {
    Suite *suite = suite_create("gl_raycast");
    TCase *tcase = tcase_create("gl_raycast");
    if (is_long) {
        tcase_add_test(tcase, samples_that_differ_lie_at_edges_long);
        tcase_add_test(tcase, forces_agree_ever_better_long);
    } else {
        tcase_add_test(tcase, samples_that_differ_lie_at_edges);
        tcase_add_test(tcase, forces_agree_ever_better);
        tcase_add_test(tcase, cube_error_falls_up_to_4096);
        tcase_add_test(tcase, windows_and_pieces_of_large_lattices_agree);
        tcase_add_test(tcase, long_boxes_are_seen_end_on);
        tcase_add_test(tcase, grazed_facets_act_within_their_corners);
        tcase_add_test(tcase, of_coincident_faces_the_one_turned_to_the_sun_is_seen);
        tcase_add_test(tcase, answers_depend_on_the_direction_alone);
        tcase_add_test(tcase, tolerance_refines);
        tcase_add_test(tcase, providers_agree);
        tcase_add_test(tcase, a_table_is_filled);
        tcase_add_test(tcase, too_many_cells_are_refused);
    }
    suite_add_tcase(suite, tcase);
    return suite;
}

int main(int argc, char **argv) {
    return gl_run(argc, argv, make_suite);
}
