/* SPDX-License-Identifier: Apache-2.0 */
#include "shapes.h"
#include "srp_check.h"
#include "topology.h"

#include <string.h>

static const srp_vec3 CORNERS[3] = {{0.1, 0.2, 0.3}, {1.4, 0.2, 0.3}, {0.1, 2.5, 0.3}};
static const srp_triangle ONE = {{0, 1, 2}};

START_TEST(create_refuses_what_is_wrong) {
    const uint32_t zero = 0, one = 1;
    const char *name = "foil";
    const char *twice[2] = {"foil", "foil"};
    srp_triangle far = {{0, 1, 3}};
    srp_vec3 bad[3];
    srp_error error;
    srp_mesh *mesh = NULL;
    ck_assert_int_eq(srp_mesh_create(CORNERS, 3, &ONE, 0, &zero, &name, 1, &mesh, &error),
                     SRP_BAD_ARGUMENT);
    ck_assert_int_eq(srp_mesh_create(CORNERS, 3, &far, 1, &zero, &name, 1, &mesh, &error),
                     SRP_BAD_ARGUMENT);
    ck_assert_str_eq(error.message, "triangle 0 names vertex 3, expected less than 3");
    ck_assert_int_eq(srp_mesh_create(CORNERS, 3, &ONE, 1, &one, &name, 1, &mesh, &error),
                     SRP_BAD_ARGUMENT);
    ck_assert_int_eq(srp_mesh_create(CORNERS, 3, &ONE, 1, &zero, twice, 2, &mesh, &error),
                     SRP_BAD_ARGUMENT);
    memcpy(bad, CORNERS, sizeof bad);
    bad[1].y = NAN;
    ck_assert_int_eq(srp_mesh_create(bad, 3, &ONE, 1, &zero, &name, 1, &mesh, &error),
                     SRP_BAD_ARGUMENT);
    bad[1].y = INFINITY;
    ck_assert_int_eq(srp_mesh_create(bad, 3, &ONE, 1, &zero, &name, 1, &mesh, &error),
                     SRP_BAD_ARGUMENT);
    ck_assert_str_eq(error.message, "vertex 1 is not finite");
    bad[1].y = -1e31;
    ck_assert_int_eq(srp_mesh_create(bad, 3, &ONE, 1, &zero, &name, 1, &mesh, &error),
                     SRP_BAD_ARGUMENT);
    ck_assert_str_eq(error.message,
                     "vertex 1 has a coordinate of 1e+31 m, expected at most 1e+30 m");
    ck_assert_ptr_null(mesh);
}
END_TEST

START_TEST(append_shares_materials_of_one_name) {
    srp_vec3 a = {0, 0, 0}, b = {1, 2, 3}, c = {4, 5, 6};
    srp_mesh *mesh = shape_box(a, b, "foil");
    shape_join(mesh, shape_box(b, c, "panel"));
    shape_join(mesh, shape_box(b, c, "foil"));
    ck_assert_uint_eq(srp_mesh_triangle_count(mesh), 36);
    ck_assert_uint_eq(srp_mesh_vertex_count(mesh), 24);
    ck_assert_uint_eq(srp_mesh_material_count(mesh), 2);
    ck_assert_uint_eq(srp_mesh_triangle_materials(mesh)[12], 1);
    ck_assert_uint_eq(srp_mesh_triangle_materials(mesh)[35], 0);
    ck_assert_uint_eq(srp_mesh_triangles(mesh)[12].v[1], 12);
    ck_assert_str_eq(srp_mesh_material_name(mesh, 1), "panel");
    ck_assert_ptr_null(srp_mesh_material_name(mesh, 2));
    srp_mesh_destroy(mesh);
    srp_mesh_destroy(NULL);
}
END_TEST

static srp_topology topology_of(srp_mesh *mesh) {
    srp_topology topology;
    srp_error error;
    assert_ok(srp_topology_create(mesh, &topology, &error), error);
    srp_mesh_destroy(mesh);
    return topology;
}

START_TEST(box_is_closed) {
    srp_vec3 low = {10.1, 20.2, 30.3}, high = {11.4, 22.7, 34.4};
    srp_topology topology = topology_of(shape_box(low, high, "foil"));
    ck_assert_uint_eq(topology.component_count, 1);
    ck_assert(topology.components[0].closed && !topology.components[0].inward);
    ck_assert_uint_eq(topology.components[0].triangles, 12);
    assert_close(topology.components[0].volume, 1.3 * 2.5 * 4.1, 1e-13, 0.0);
    ck_assert_uint_eq(topology.boundary_edges + topology.nonmanifold_edges, 0);
    for (size_t i = 0; i < 12; ++i) {
        for (int k = 0; k < 3; ++k) {
            uint32_t across = topology.neighbour[i][k];
            ck_assert(across != SRP_NO_TRIANGLE);
            bool back = topology.neighbour[across][0] == i || topology.neighbour[across][1] == i ||
                        topology.neighbour[across][2] == i;
            ck_assert(back);
        }
    }
    srp_topology_clear(&topology);
}
END_TEST

/* Vertices repeated for every face, as many exporters write them, are welded. */
START_TEST(loose_faces_are_welded) {
    srp_vec3 low = {-0.0, 0, 0}, high = {1, 2, 3};
    srp_mesh *box = shape_box(low, high, "foil");
    srp_vec3 vertices[36];
    srp_triangle triangles[12];
    for (uint32_t i = 0; i < 36; ++i) {
        vertices[i] = srp_mesh_vertices(box)[srp_mesh_triangles(box)[i / 3].v[i % 3]];
        vertices[i].x = vertices[i].x == 0.0 && i % 2 ? 0.0 : vertices[i].x;
        triangles[i / 3].v[i % 3] = i;
    }
    srp_mesh_destroy(box);
    srp_topology topology = topology_of(shape_mesh(vertices, 36, triangles, 12, "foil"));
    ck_assert_uint_eq(topology.component_count, 1);
    ck_assert(topology.components[0].closed);
    srp_topology_clear(&topology);
}
END_TEST

START_TEST(open_and_crossed_edges_are_counted) {
    /* Three triangles at one edge (0,1), and a fourth that disagrees with its neighbour. */
    const srp_vec3 vertices[6] = {{0, 0, 0},  {1, 0, 0}, {0, 1, 0},
                                  {0, -1, 0}, {0, 0, 1}, {1, 1, 0}};
    const srp_triangle triangles[4] = {{{0, 1, 2}}, {{1, 0, 3}}, {{0, 1, 4}}, {{1, 2, 5}}};
    srp_topology topology = topology_of(shape_mesh(vertices, 6, triangles, 4, "foil"));
    ck_assert_uint_eq(topology.nonmanifold_edges, 1);
    ck_assert_uint_eq(topology.inconsistent_edges, 1);
    ck_assert_uint_eq(topology.boundary_edges, 7);
    ck_assert_uint_eq(topology.component_count, 4);
    ck_assert(!topology.components[0].closed);
    srp_topology_clear(&topology);
}
END_TEST

/* Two boxes that share an edge are two closed bodies, even when one is inside out. */
START_TEST(boxes_that_share_an_edge_stay_apart) {
    srp_vec3 a = {0, 0, 0}, b = {1, 1, 1}, c = {1, 1, 0}, d = {2, 2, 1};
    srp_mesh *mesh = shape_box(a, b, "foil");
    srp_mesh *other = shape_box(c, d, "foil");
    srp_triangle turned[12];
    for (int i = 0; i < 12; ++i) {
        srp_triangle t = srp_mesh_triangles(other)[i];
        turned[i] = (srp_triangle){{t.v[0], t.v[2], t.v[1]}};
    }
    shape_join(mesh, shape_mesh(srp_mesh_vertices(other), 8, turned, 12, "foil"));
    srp_mesh_destroy(other);
    srp_topology topology = topology_of(mesh);
    ck_assert_uint_eq(topology.component_count, 2);
    ck_assert_uint_eq(topology.nonmanifold_edges, 1);
    ck_assert(topology.components[0].closed && !topology.components[0].inward);
    ck_assert(topology.components[1].closed && topology.components[1].inward);
    srp_topology_clear(&topology);
}
END_TEST

START_TEST(needles_are_degenerate) {
    const srp_vec3 vertices[5] = {{0, 0, 0}, {1, 0, 0}, {0.3, 0, 0}, {0.3, 1e-9, 0}, {0, 1e-20, 0}};
    const srp_triangle triangles[4] = {{{0, 1, 2}}, {{0, 1, 1}}, {{0, 1, 3}}, {{0, 1, 4}}};
    srp_topology topology = topology_of(shape_mesh(vertices, 5, triangles, 4, "foil"));
    ck_assert(topology.degenerate[0] && topology.degenerate[1]);
    ck_assert(!topology.degenerate[2] && topology.degenerate[3]);
    srp_topology_clear(&topology);
}
END_TEST

/* A foil of two layers, divided along different diagonals, is closed and holds nothing: rounding
 * must not turn it inside out, which would swap the optics of its sides. */
START_TEST(foil_of_two_sides_is_not_inward) {
    const srp_triangle triangles[4] = {{{0, 1, 2}}, {{0, 2, 3}}, {{0, 3, 1}}, {{1, 3, 2}}};
    uint64_t seed = 5;
    for (int i = 0; i < 200; ++i) {
        srp_vec3 along = random_direction(&seed), other = random_direction(&seed);
        srp_vec3 at = srp_vec3_scale(10.0, random_direction(&seed));
        srp_vec3 corner = srp_vec3_add_scaled(at, 0.3, along);
        srp_vec3 vertices[4] = {at, corner, srp_vec3_add_scaled(corner, 0.7, other),
                                srp_vec3_add_scaled(at, 0.7, other)};
        srp_topology topology = topology_of(shape_mesh(vertices, 4, triangles, 4, "foil"));
        for (size_t c = 0; c < topology.component_count; ++c) {
            ck_assert(!topology.components[c].inward);
        }
        srp_topology_clear(&topology);
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("mesh");
    TCase *tcase = tcase_create("mesh");
    tcase_add_test(tcase, create_refuses_what_is_wrong);
    tcase_add_test(tcase, append_shares_materials_of_one_name);
    tcase_add_test(tcase, box_is_closed);
    tcase_add_test(tcase, loose_faces_are_welded);
    tcase_add_test(tcase, open_and_crossed_edges_are_counted);
    tcase_add_test(tcase, boxes_that_share_an_edge_stay_apart);
    tcase_add_test(tcase, needles_are_degenerate);
    tcase_add_test(tcase, foil_of_two_sides_is_not_inward);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
