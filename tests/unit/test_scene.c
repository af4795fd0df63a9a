/* SPDX-License-Identifier: Apache-2.0 */
#include "scene_internal.h"
#include "shapes.h"
#include "srp_check.h"

#include <srp/method.h>
#include <srp/table.h>

#include <string.h>

static const srp_optics GREY = {0.31, 0.27, false};

START_TEST(box_becomes_facets) {
    srp_vec3 low = {0.5, -1.25, 2}, high = {1.75, 1, 4.5};
    srp_scene *scene = shape_scene(shape_box(low, high, "foil"), GREY);
    ck_assert_uint_eq(srp_scene_facet_count(scene), 12);
    ck_assert_int_eq(srp_scene_shape(scene), SRP_SHAPE_MESH);
    ck_assert(scene->all_closed);
    srp_vec3 sum = {0, 0, 0};
    for (size_t i = 0; i < 12; ++i) {
        const srp_facet *facet = &scene->facets[i];
        sum = srp_vec3_add_scaled(sum, facet->area, facet->normal);
        assert_close(srp_vec3_norm(facet->normal), 1.0, 1e-15, 0.0);
        srp_vec3 out = srp_vec3_sub(scene->vertices[facet->v[0]], scene->centre);
        ck_assert(srp_vec3_dot(out, facet->normal) > 0.0);
    }
    assert_vec3_close(sum, srp_vec3_make(0, 0, 0), 0.0, 1e-14);
    assert_close(srp_scene_radius(scene), sqrt(1.75 * 1.75 + 1.25 * 1.25 + 4.5 * 4.5), 1e-15, 0);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(faces_are_told) {
    srp_vec3 low = {0.5, -1.25, 2}, high = {1.75, 1, 4.5}, sum = {0, 0, 0};
    srp_scene *scene = shape_scene(shape_box(low, high, "foil"), GREY);
    double area = 0.0;
    for (size_t i = 0; i < srp_scene_facet_count(scene); ++i) {
        srp_face face = srp_scene_face(scene, i);
        ck_assert(!face.two_sided && face.material == 0);
        area += face.area;
        sum = srp_vec3_add_scaled(sum, face.area, face.normal);
    }
    assert_close(area, 2.0 * (1.25 * 2.25 + 1.25 * 2.5 + 2.25 * 2.5), 1e-14, 0.0);
    assert_vec3_close(sum, srp_vec3_make(0, 0, 0), 0.0, 1e-14);
    srp_scene_destroy(scene);

    const srp_vec3 corner[3] = {{0, 0, 0}, {2.5, 0, 0}, {0, 1.5, 0}};
    const srp_triangle one = {{0, 1, 2}};
    scene = shape_scene(shape_mesh(corner, 3, &one, 1, "foil"), GREY);
    srp_face face = srp_scene_face(scene, 0);
    ck_assert(face.two_sided && face.area == 1.875 && face.normal.z == 1.0);
    srp_scene_destroy(scene);

    const srp_plate plates[2] = {{{1, 0, 0}, 2.25, {0.31, 0.27, false}},
                                 {{0, 0, -1}, 3.5, {0.31, 0.27, false}}};
    srp_error error;
    assert_ok(srp_scene_from_plates(plates, 2, &scene, &error), error);
    face = srp_scene_face(scene, 1);
    ck_assert(!face.two_sided && face.area == 3.5 && face.normal.z == -1.0 && face.material == 1);
    srp_scene_destroy(scene);
}
END_TEST

static srp_mesh *turned_box(srp_vec3 low, srp_vec3 high) {
    srp_mesh *box = shape_box(low, high, "foil");
    srp_triangle turned[12];
    for (int i = 0; i < 12; ++i) {
        srp_triangle t = srp_mesh_triangles(box)[i];
        turned[i] = (srp_triangle){{t.v[0], t.v[2], t.v[1]}};
    }
    srp_mesh *mesh = shape_mesh(srp_mesh_vertices(box), 8, turned, 12, "foil");
    srp_mesh_destroy(box);
    return mesh;
}

START_TEST(inside_out_boxes_are_turned) {
    srp_vec3 low = {0.5, -1.25, 2}, high = {1.75, 1, 4.5};
    srp_scene *scene = shape_scene(turned_box(low, high), GREY);
    for (size_t i = 0; i < 12; ++i) {
        const srp_facet *facet = &scene->facets[i];
        srp_vec3 out = srp_vec3_sub(scene->vertices[facet->v[0]], scene->centre);
        ck_assert(srp_vec3_dot(out, facet->normal) > 0.0);
        /* Neighbours share the edge that they stand at. */
        for (int k = 0; k < 3; ++k) {
            const srp_facet *across = &scene->facets[facet->neighbour[k]];
            int shared = 0;
            for (int m = 0; m < 3; ++m) {
                shared += across->v[m] == facet->v[k] || across->v[m] == facet->v[(k + 1) % 3];
            }
            ck_assert_int_eq(shared, 2);
        }
    }
    srp_scene_destroy(scene);
}
END_TEST

/* A prism over a figure of eight: its signed volume says outward, one lobe is inside out. */
START_TEST(figure_of_eight_is_not_culled) {
    const srp_vec3 vertices[8] = {{0, 0, 0}, {3, 2, 0}, {3, 0, 0}, {0, 1, 0},
                                  {0, 0, 1}, {3, 2, 1}, {3, 0, 1}, {0, 1, 1}};
    const srp_triangle triangles[12] = {{{0, 1, 5}}, {{0, 5, 4}}, {{1, 2, 6}}, {{1, 6, 5}},
                                        {{2, 3, 7}}, {{2, 7, 6}}, {{3, 0, 4}}, {{3, 4, 7}},
                                        {{0, 2, 1}}, {{0, 3, 2}}, {{4, 5, 6}}, {{4, 6, 7}}};
    srp_scene *scene = shape_scene(shape_mesh(vertices, 8, triangles, 12, "foil"), GREY);
    ck_assert(!scene->all_closed);
    srp_scene_destroy(scene);
}
END_TEST

/* A cavity inside a box is a second closed component; nothing is wrong with it. */
START_TEST(cavities_stay_closed) {
    srp_mesh *mesh = shape_box(srp_vec3_make(0, 0, 0), srp_vec3_make(3, 3, 3), "foil");
    shape_join(mesh, turned_box(srp_vec3_make(1, 1, 1), srp_vec3_make(2, 2, 2)));
    srp_scene *scene = shape_scene(mesh, GREY);
    ck_assert(scene->all_closed);
    srp_scene_destroy(scene);
}
END_TEST

/* Of coincident faces with one outside only the first is ever seen; the other side of a sheet is.
 */
START_TEST(repeated_faces_are_kept_once) {
    srp_vec3 low = {0.5, -1.25, 2}, high = {1.75, 1, 4.5};
    srp_mesh *mesh = shape_box(low, high, "foil");
    shape_join(mesh, shape_box(low, high, "cells"));
    srp_scene *scene = shape_scene(mesh, GREY);
    ck_assert_uint_eq(srp_scene_facet_count(scene), 12);
    ck_assert_uint_eq(srp_scene_material_count(scene), 2);
    ck_assert(scene->all_closed);
    for (size_t i = 0; i < 12; ++i) {
        ck_assert_uint_eq(scene->facets[i].material, 0);
        for (int k = 0; k < 3; ++k) {
            ck_assert_uint_lt(scene->facets[i].neighbour[k], 12);
        }
    }
    srp_scene_destroy(scene);

    const srp_vec3 v[] = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}};
    const srp_triangle sheet[] = {{{0, 1, 2}}, {{1, 0, 2}}, {{1, 2, 0}}, {{2, 1, 0}}};
    scene = shape_scene(shape_mesh(v, 3, sheet, 4, "foil"), GREY);
    ck_assert_uint_eq(srp_scene_facet_count(scene), 2);
    ck_assert(scene->facets[0].normal.z == 1.0 && scene->facets[1].normal.z == -1.0);
    srp_scene_destroy(scene);
}
END_TEST

/* Hundreds of thousands of copies of one face: each used to be clipped by all others. */
START_TEST(many_copies_of_one_face_are_one) {
    enum { COPIES = 300000 };
    const srp_vec3 v[] = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}};
    srp_triangle *t = malloc(COPIES * sizeof *t);
    ck_assert_ptr_nonnull(t);
    for (size_t i = 0; i < COPIES; ++i) {
        t[i] =
            (srp_triangle){{(uint32_t)(i % 3), (uint32_t)((i + 1) % 3), (uint32_t)((i + 2) % 3)}};
    }
    srp_scene *scene = shape_scene(shape_mesh(v, 3, t, COPIES, "foil"), GREY);
    ck_assert_uint_eq(srp_scene_facet_count(scene), 1);
    srp_scene_destroy(scene);
    free(t);
}
END_TEST

START_TEST(missing_optics_are_named) {
    srp_error error;
    srp_scene *scene = NULL;
    srp_mesh *mesh = shape_box(srp_vec3_make(0, 0, 0), srp_vec3_make(1, 1, 1), "gold foil");
    ck_assert_int_eq(srp_scene_from_mesh(mesh, NULL, &scene, &error), SRP_NOT_FOUND);
    ck_assert_ptr_nonnull(strstr(error.message, "'gold foil'"));
    ck_assert_ptr_null(strstr(error.message, "--"));
    ck_assert_int_eq(error.remedy, SRP_REMEDY_OPTICS);
    ck_assert_ptr_null(scene);
    srp_mesh_destroy(mesh);
}
END_TEST

START_TEST(nothing_but_needles_is_refused) {
    const srp_vec3 vertices[3] = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
    const srp_triangle triangle = {{0, 1, 2}};
    srp_mesh *mesh = shape_mesh(vertices, 3, &triangle, 1, "foil");
    srp_materials *materials = NULL;
    srp_scene *scene = NULL;
    srp_error error;
    assert_ok(srp_materials_create(&materials, &error), error);
    assert_ok(srp_materials_set(materials, "foil", GREY, false, &error), error);
    ck_assert_int_eq(srp_scene_from_mesh(mesh, materials, &scene, &error), SRP_BAD_DATA);
    srp_materials_destroy(materials);
    srp_mesh_destroy(mesh);
}
END_TEST

/* Rounding eats a box of 2 m at 1e14 m: no method may call that an answer. */
START_TEST(boxes_beyond_resolution_are_refused) {
    const double far[2] = {1e14, 1e12};
    srp_materials *materials = NULL;
    srp_error error;
    assert_ok(srp_materials_create(&materials, &error), error);
    assert_ok(srp_materials_set(materials, "foil", GREY, false, &error), error);
    for (int i = 0; i < 2; ++i) {
        srp_mesh *mesh =
            shape_box(srp_vec3_make(far[i], -1, -1), srp_vec3_make(far[i] + 2, 1, 1), "foil");
        srp_scene *scene = NULL;
        ck_assert_int_eq(srp_scene_from_mesh(mesh, materials, &scene, &error), SRP_BAD_DATA);
        ck_assert_ptr_nonnull(strstr(error.message, "the mesh reaches"));
        srp_mesh_destroy(mesh);
    }
    srp_materials_destroy(materials);
    srp_vec3 low = {1e8, -1, -1}, high = {1e8 + 2, 1, 1};
    srp_scene_destroy(shape_scene(shape_box(low, high, "foil"), GREY));
}
END_TEST

/* Up to the limit all is finite, and scales as it should: f with the square, t with the cube. */
START_TEST(scenes_at_the_limit_of_reach_are_exact) {
    const double edge = 0.9e30;
    srp_vec3 s = srp_direction_from_deg(31.7, -21.3), low = {-0.1, 0.2, -0.3}, high = {0.4, 0.9, 1};
    srp_response small, large;
    for (int i = 0; i < 2; ++i) {
        double scale = i == 0 ? 1.0 : edge;
        srp_scene *scene = shape_scene(
            shape_box(srp_vec3_scale(scale, low), srp_vec3_scale(scale, high), "foil"), GREY);
        srp_method_params params = srp_method_params_default();
        srp_prepared *prepared = NULL;
        srp_error error;
        assert_ok(srp_method_prepare(&srp_method_exact, scene, &params, &prepared, &error), error);
        assert_ok(srp_prepared_respond(prepared, 1, &s, i == 0 ? &small : &large, NULL, &error),
                  error);
        srp_prepared_release(prepared);
        srp_scene_destroy(scene);
    }
    assert_vec3_close(srp_vec3_scale(1.0 / edge / edge, large.f), small.f, 1e-13, 0.0);
    assert_vec3_close(srp_vec3_scale(1.0 / edge / edge / edge, large.t), small.t, 1e-13, 1e-15);
}
END_TEST

START_TEST(hashes_tell_shape_from_optics) {
    srp_vec3 low = {0, 0, 0}, high = {1, 2, 3}, other = {1, 2, 3.0000001};
    const srp_optics dull = {0.1, 0.27, false};
    srp_scene *a = shape_scene(shape_box(low, high, "foil"), GREY);
    srp_scene *b = shape_scene(shape_box(low, high, "foil"), dull);
    srp_scene *c = shape_scene(shape_box(low, other, "foil"), GREY);
    ck_assert_uint_eq(strlen(srp_scene_shape_hash(a)), 32);
    ck_assert_str_eq(srp_scene_shape_hash(a), srp_scene_shape_hash(b));
    ck_assert_str_ne(srp_scene_optics_hash(a), srp_scene_optics_hash(b));
    ck_assert_str_ne(srp_scene_shape_hash(a), srp_scene_shape_hash(c));
    ck_assert_str_eq(srp_scene_optics_hash(a), srp_scene_optics_hash(c));
    srp_scene_destroy(a);
    srp_scene_destroy(b);
    srp_scene_destroy(c);
    srp_scene_destroy(NULL);
}
END_TEST

START_TEST(plates_and_spheres_are_checked) {
    srp_error error;
    srp_scene *scene = NULL;
    srp_plate plate = {{0, 3, 4}, 2.5, {0.31, 0.27, false}};
    ck_assert_int_eq(srp_scene_from_plates(&plate, 0, &scene, &error), SRP_BAD_ARGUMENT);
    assert_ok(srp_scene_from_plates(&plate, 1, &scene, &error), error);
    assert_vec3_close(scene->plates[0].normal, srp_vec3_make(0, 0.6, 0.8), 1e-15, 0.0);
    ck_assert_str_eq(srp_scene_material_name(scene, 0), "plate 1");
    srp_scene_destroy(scene);
    scene = NULL;
    srp_plate bad = plate;
    bad.area = -1.0;
    ck_assert_int_eq(srp_scene_from_plates(&bad, 1, &scene, &error), SRP_BAD_DATA);
    bad = plate;
    bad.normal = srp_vec3_make(0, 0, 0);
    ck_assert_int_eq(srp_scene_from_plates(&bad, 1, &scene, &error), SRP_BAD_DATA);
    bad = plate;
    bad.optics.rho_s = 0.8;
    ck_assert_int_eq(srp_scene_from_plates(&bad, 1, &scene, &error), SRP_BAD_DATA);
    ck_assert_int_eq(srp_scene_from_sphere(NAN, 1.0, &scene, &error), SRP_BAD_ARGUMENT);
    ck_assert_int_eq(srp_scene_from_sphere(1.3, 0.0, &scene, &error), SRP_BAD_ARGUMENT);
    ck_assert_int_eq(srp_scene_from_sphere(1.3, 1e61, &scene, &error), SRP_BAD_ARGUMENT);
    ck_assert_int_eq(srp_scene_from_sphere(1e31, 1.0, &scene, &error), SRP_BAD_ARGUMENT);
    bad = plate;
    bad.area = 1e61;
    ck_assert_int_eq(srp_scene_from_plates(&bad, 1, &scene, &error), SRP_BAD_DATA);
    ck_assert_ptr_null(scene);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("scene");
    TCase *tcase = tcase_create("scene");
    tcase_add_test(tcase, box_becomes_facets);
    tcase_add_test(tcase, inside_out_boxes_are_turned);
    tcase_add_test(tcase, figure_of_eight_is_not_culled);
    tcase_add_test(tcase, cavities_stay_closed);
    tcase_add_test(tcase, repeated_faces_are_kept_once);
    tcase_add_test(tcase, many_copies_of_one_face_are_one);
    tcase_add_test(tcase, missing_optics_are_named);
    tcase_add_test(tcase, nothing_but_needles_is_refused);
    tcase_add_test(tcase, boxes_beyond_resolution_are_refused);
    tcase_add_test(tcase, scenes_at_the_limit_of_reach_are_exact);
    tcase_add_test(tcase, hashes_tell_shape_from_optics);
    tcase_add_test(tcase, faces_are_told);
    tcase_add_test(tcase, plates_and_spheres_are_checked);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
