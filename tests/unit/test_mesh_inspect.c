/* SPDX-License-Identifier: Apache-2.0 */
#include "shapes.h"
#include "srp_check.h"

#include <srp/mesh.h>

#include <string.h>

static srp_mesh_report inspect(const srp_mesh *mesh) {
    srp_mesh_report report;
    srp_error error;
    assert_ok(srp_mesh_inspect(mesh, &report, &error), error);
    return report;
}

static void take_areas(const srp_mesh *mesh, double *area) {
    srp_error error;
    assert_ok(srp_mesh_material_areas(mesh, area, &error), error);
}

static srp_mesh *box(void) {
    return shape_box(srp_vec3_make(-1.25, 0.5, 2), srp_vec3_make(0.75, 3, 2.5), "foil");
}

/* `mesh` with triangles [begin, end) left out, and [turn, turn_end) turned over; destroys it. */
static srp_mesh *edited(srp_mesh *mesh, size_t begin, size_t end, size_t turn, size_t turn_end) {
    srp_triangle kept[64];
    size_t count = 0;
    for (size_t i = 0; i < srp_mesh_triangle_count(mesh); ++i) {
        srp_triangle t = srp_mesh_triangles(mesh)[i];
        if (i >= turn && i < turn_end) {
            t = (srp_triangle){{t.v[1], t.v[0], t.v[2]}};
        }
        if (i < begin || i >= end) {
            kept[count++] = t;
        }
    }
    srp_mesh *result =
        shape_mesh(srp_mesh_vertices(mesh), srp_mesh_vertex_count(mesh), kept, count, "foil");
    srp_mesh_destroy(mesh);
    return result;
}

START_TEST(sound_box) {
    srp_mesh *mesh = box();
    srp_mesh_report r = inspect(mesh);
    ck_assert_uint_eq(r.vertices, 8);
    ck_assert_uint_eq(r.triangles, 12);
    ck_assert_uint_eq(r.faces_triangle, 12);
    ck_assert_uint_eq(r.components, 1);
    ck_assert_uint_eq(r.closed_components, 1);
    ck_assert_uint_eq(r.boundary_edges + r.nonmanifold_edges + r.inconsistent_edges, 0);
    ck_assert_uint_eq(r.inward_components + r.degenerate + r.duplicate + r.opposite, 0);
    assert_close(r.area, 2 * (2 * 2.5 + 2 * 0.5 + 2.5 * 0.5), 1e-15, 0.0);
    assert_close(r.volume, 2 * 2.5 * 0.5, 1e-15, 0.0);
    assert_vec3_close(r.area_vector_sum, srp_vec3_make(0, 0, 0), 0.0, 1e-15);
    assert_vec3_close(r.box_min, srp_vec3_make(-1.25, 0.5, 2), 0.0, 0.0);
    assert_vec3_close(r.box_max, srp_vec3_make(0.75, 3, 2.5), 0.0, 0.0);
    double area;
    take_areas(mesh, &area);
    assert_close(area, r.area, 1e-15, 0.0);
    srp_mesh_destroy(mesh);
}
END_TEST

START_TEST(hole_is_counted_by_its_rim) {
    srp_mesh *mesh = edited(box(), 4, 5, 0, 0);
    srp_mesh_report r = inspect(mesh);
    ck_assert_uint_eq(r.triangles, 11);
    ck_assert_uint_eq(r.components, 1);
    ck_assert_uint_eq(r.closed_components, 0);
    ck_assert_uint_eq(r.boundary_edges, 3);
    ck_assert(r.volume == 0.0);
    ck_assert(srp_vec3_norm(r.area_vector_sum) > 0.1);
    srp_mesh_destroy(mesh);
}
END_TEST

START_TEST(turned_triangle_disagrees_with_its_neighbours) {
    srp_mesh *mesh = edited(box(), 0, 0, 4, 5);
    srp_mesh_report r = inspect(mesh);
    ck_assert_uint_eq(r.inconsistent_edges, 3);
    ck_assert_uint_eq(r.boundary_edges, 0);
    ck_assert_uint_eq(r.closed_components, 0);
    srp_mesh_destroy(mesh);
}
END_TEST

START_TEST(inside_out_box_is_inward) {
    srp_mesh *mesh = edited(box(), 0, 0, 0, 12);
    srp_mesh_report r = inspect(mesh);
    ck_assert_uint_eq(r.inward_components, 1);
    ck_assert_uint_eq(r.closed_components, 1);
    assert_close(r.volume, 2.5, 1e-15, 0.0);
    srp_mesh_destroy(mesh);
}
END_TEST

START_TEST(doubles_and_thin_shells) {
    /* Two sides of a sheet, at vertices of their own; one side twice. */
    const srp_vec3 v[] = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 0}, {2, 0, 0}, {-0.0, 3, 0}};
    const srp_triangle shell[] = {{{0, 1, 2}}, {{5, 4, 3}}};
    srp_mesh *mesh = shape_mesh(v, 6, shell, 2, "foil");
    srp_mesh_report r = inspect(mesh);
    ck_assert_uint_eq(r.opposite, 2);
    ck_assert_uint_eq(r.duplicate, 0);
    assert_close(r.area, 6.0, 1e-15, 0.0); /* two sides */
    srp_mesh_destroy(mesh);

    const srp_triangle thrice[] = {{{0, 1, 2}}, {{4, 5, 3}}, {{2, 0, 1}}};
    mesh = shape_mesh(v, 6, thrice, 3, "foil");
    r = inspect(mesh);
    ck_assert_uint_eq(r.duplicate, 2);
    ck_assert_uint_eq(r.opposite, 0);
    ck_assert_uint_eq(r.boundary_edges, 3); /* those of one triangle */
    ck_assert_uint_eq(r.nonmanifold_edges, 0);
    assert_close(r.area, 3.0, 1e-15, 0.0);
    srp_mesh_destroy(mesh);

    const srp_triangle both[] = {{{0, 1, 2}}, {{4, 5, 3}}, {{0, 2, 1}}};
    mesh = shape_mesh(v, 6, both, 3, "foil");
    r = inspect(mesh);
    ck_assert_uint_eq(r.duplicate, 1);
    ck_assert_uint_eq(r.opposite, 3);
    assert_close(r.area, 6.0, 1e-15, 0.0);
    srp_mesh_destroy(mesh);
}
END_TEST

/* One rule for the whole and its shares, whatever lies on whatever. */
START_TEST(areas_of_materials_add_up_to_the_whole) {
    /* The same box twice. */
    srp_mesh *mesh = box();
    shape_join(mesh, shape_box(srp_vec3_make(-1.25, 0.5, 2), srp_vec3_make(0.75, 3, 2.5), "cells"));
    srp_mesh_report r = inspect(mesh);
    double area[2];
    take_areas(mesh, area);
    ck_assert_uint_eq(r.triangles, 24);
    assert_close(r.area, 2 * (2 * 2.5 + 2 * 0.5 + 2.5 * 0.5), 1e-15, 0.0);
    ck_assert(area[0] == r.area && area[1] == 0.0);
    ck_assert_uint_eq(r.closed_components, 1);
    ck_assert_uint_eq(r.boundary_edges + r.nonmanifold_edges + r.inconsistent_edges, 0);
    srp_mesh_destroy(mesh);

    /* A sheet of two materials, back to back, a third on one of them. */
    const srp_vec3 v[] = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}};
    const srp_triangle up = {{0, 1, 2}}, down = {{1, 0, 2}};
    mesh = shape_mesh(v, 3, &up, 1, "cells");
    shape_join(mesh, shape_mesh(v, 3, &down, 1, "back"));
    shape_join(mesh, shape_mesh(v, 3, &up, 1, "paint"));
    r = inspect(mesh);
    double share[3];
    take_areas(mesh, share);
    assert_close(r.area, 6.0, 1e-15, 0.0);
    assert_close(share[0], 3.0, 1e-15, 0.0);
    assert_close(share[1], 3.0, 1e-15, 0.0);
    ck_assert(share[2] == 0.0);
    srp_mesh_destroy(mesh);
}
END_TEST

START_TEST(degenerate_triangles_are_counted_apart) {
    const srp_vec3 v[] = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {1, 0, 0}};
    const srp_triangle triangles[] = {
        {{0, 1, 2}}, {{0, 1, 3}}, {{0, 3, 1}}, {{1, 1, 2}}, {{2, 2, 2}}};
    srp_mesh *mesh = shape_mesh(v, 4, triangles, 5, "foil");
    srp_mesh_report r = inspect(mesh);
    ck_assert_uint_eq(r.degenerate, 4);
    ck_assert_uint_eq(r.duplicate + r.opposite, 0);
    assert_close(r.area, 3.0, 1e-15, 0.0);
    ck_assert_uint_eq(r.components, 1);
    ck_assert_uint_eq(r.boundary_edges, 3);
    ck_assert_uint_eq(r.nonmanifold_edges + r.inconsistent_edges, 0);
    srp_mesh_destroy(mesh);
}
END_TEST

/* `f 1 1 2` beside a sound box: neither a component of its own nor a fault of its edges. */
START_TEST(degenerate_triangles_are_no_part_of_the_topology) {
    srp_mesh *whole = box();
    srp_triangle t[16];
    memcpy(t, srp_mesh_triangles(whole), 12 * sizeof *t);
    const srp_triangle more[] = {{{0, 0, 1}}, {{1, 0, 1}}, {{7, 7, 7}}, {{0, 6, 0}}};
    memcpy(t + 12, more, sizeof more);
    srp_mesh *mesh = shape_mesh(srp_mesh_vertices(whole), 8, t, 16, "foil");
    srp_mesh_report r = inspect(mesh), w = inspect(whole);
    ck_assert_uint_eq(r.degenerate, 4);
    ck_assert_uint_eq(r.components, 1);
    ck_assert_uint_eq(r.closed_components, 1);
    ck_assert_uint_eq(r.boundary_edges + r.nonmanifold_edges + r.inconsistent_edges, 0);
    ck_assert(r.area == w.area && r.volume == w.volume);
    srp_mesh_destroy(mesh);
    srp_mesh_destroy(whole);
}
END_TEST

/* An edge on one side, two on the other, and a triangle without area between them, as triangulators
 * of CAD programs leave: the surface is closed. */
START_TEST(triangles_without_area_may_close_cracks) {
    srp_mesh *whole = box();
    const srp_vec3 *v = srp_mesh_vertices(whole);
    srp_vec3 corners[9];
    memcpy(corners, v, 8 * sizeof *v);
    srp_triangle t[14];
    memcpy(t, srp_mesh_triangles(whole), 12 * sizeof *t);
    /* The first triangle is cut in two at the middle of its first edge. */
    uint32_t a = t[0].v[0], b = t[0].v[1], c = t[0].v[2];
    corners[8] = srp_vec3_scale(0.5, srp_vec3_add(v[a], v[b]));
    t[0] = (srp_triangle){{a, 8, c}};
    t[12] = (srp_triangle){{8, b, c}};
    t[13] = (srp_triangle){{a, b, 8}};
    for (size_t count = 13; count <= 14; ++count) {
        srp_mesh *mesh = shape_mesh(corners, 9, t, count, "foil");
        srp_mesh_report r = inspect(mesh);
        ck_assert_uint_eq(r.components, 1);
        ck_assert_uint_eq(r.degenerate, count - 13);
        ck_assert_uint_eq(r.closed_components, count - 13);
        ck_assert_uint_eq(r.boundary_edges, count == 13 ? 3 : 0);
        srp_mesh_destroy(mesh);
    }
    srp_mesh_destroy(whole);
}
END_TEST

START_TEST(components_are_joined_by_edges) {
    srp_mesh *mesh = box();
    shape_join(mesh, shape_box(srp_vec3_make(5, 5, 5), srp_vec3_make(6, 7, 8), "cells"));
    /* Touches the first box in one corner only. */
    shape_join(mesh, shape_box(srp_vec3_make(0.75, 3, 2.5), srp_vec3_make(1, 4, 3), "foil"));
    srp_mesh_report r = inspect(mesh);
    ck_assert_uint_eq(r.components, 3);
    ck_assert_uint_eq(r.closed_components, 3);
    assert_close(r.volume, 2.5 + 6.0 + 0.125, 1e-14, 0.0);
    double area[2];
    take_areas(mesh, area);
    assert_close(area[1], 22.0, 1e-15, 0.0);
    assert_close(area[0] + area[1], r.area, 1e-15, 0.0);
    srp_mesh_destroy(mesh);
}
END_TEST

/* A cube as an exporter without shared vertices writes it: still closed. */
START_TEST(unshared_vertices_are_one_surface) {
    srp_mesh *shared = box();
    srp_vec3 v[36];
    srp_triangle t[12];
    for (uint32_t i = 0; i < 12; ++i) {
        for (uint32_t k = 0; k < 3; ++k) {
            v[3 * i + k] = srp_mesh_vertices(shared)[srp_mesh_triangles(shared)[i].v[k]];
            t[i].v[k] = 3 * i + k;
        }
    }
    srp_mesh *mesh = shape_mesh(v, 36, t, 12, "foil");
    srp_mesh_report r = inspect(mesh), s = inspect(shared);
    ck_assert_uint_eq(r.vertices, 36);
    ck_assert_uint_eq(r.closed_components, 1);
    ck_assert_uint_eq(r.boundary_edges, 0);
    ck_assert(r.volume == s.volume && r.area == s.area);
    srp_mesh_destroy(mesh);
    srp_mesh_destroy(shared);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("mesh_inspect");
    TCase *tcase = tcase_create("mesh_inspect");
    tcase_add_test(tcase, sound_box);
    tcase_add_test(tcase, hole_is_counted_by_its_rim);
    tcase_add_test(tcase, turned_triangle_disagrees_with_its_neighbours);
    tcase_add_test(tcase, inside_out_box_is_inward);
    tcase_add_test(tcase, doubles_and_thin_shells);
    tcase_add_test(tcase, degenerate_triangles_are_counted_apart);
    tcase_add_test(tcase, areas_of_materials_add_up_to_the_whole);
    tcase_add_test(tcase, degenerate_triangles_are_no_part_of_the_topology);
    tcase_add_test(tcase, triangles_without_area_may_close_cracks);
    tcase_add_test(tcase, components_are_joined_by_edges);
    tcase_add_test(tcase, unshared_vertices_are_one_surface);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
