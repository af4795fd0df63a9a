/* SPDX-License-Identifier: Apache-2.0 */
#include "shapes.h"

#include "srp_check.h"

srp_mesh *shape_mesh(const srp_vec3 *vertices, size_t vertex_count, const srp_triangle *triangles,
                     size_t triangle_count, const char *material) {
    srp_error error;
    srp_mesh *mesh = NULL;
    uint32_t *first = calloc(triangle_count, sizeof *first);
    ck_assert_ptr_nonnull(first);
    assert_ok(srp_mesh_create(vertices, vertex_count, triangles, triangle_count, first, &material,
                              1, &mesh, &error),
              error);
    free(first);
    return mesh;
}

srp_mesh *shape_box(srp_vec3 low, srp_vec3 high, const char *material) {
    srp_vec3 vertices[8];
    for (int i = 0; i < 8; ++i) {
        vertices[i] =
            srp_vec3_make(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    }
    static const srp_triangle triangles[12] = {{{0, 4, 6}}, {{0, 6, 2}}, {{1, 3, 7}}, {{1, 7, 5}},
                                               {{0, 1, 5}}, {{0, 5, 4}}, {{2, 6, 7}}, {{2, 7, 3}},
                                               {{0, 2, 3}}, {{0, 3, 1}}, {{4, 5, 7}}, {{4, 7, 6}}};
    return shape_mesh(vertices, 8, triangles, 12, material);
}

void shape_join(srp_mesh *mesh, srp_mesh *part) {
    srp_error error;
    assert_ok(srp_mesh_append(mesh, part, &error), error);
    srp_mesh_destroy(part);
}

srp_scene *shape_scene(srp_mesh *mesh, srp_optics optics) {
    srp_error error;
    srp_materials *materials = NULL;
    srp_scene *scene = NULL;
    assert_ok(srp_materials_create(&materials, &error), error);
    for (size_t i = 0; i < srp_mesh_material_count(mesh); ++i) {
        assert_ok(
            srp_materials_set(materials, srp_mesh_material_name(mesh, i), optics, false, &error),
            error);
    }
    assert_ok(srp_scene_from_mesh(mesh, materials, &scene, &error), error);
    srp_materials_destroy(materials);
    srp_mesh_destroy(mesh);
    return scene;
}

srp_scene *shape_corner_cube(void) {
    static const srp_vec3 v[7] = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0},
                                  {0.0, 0.0, 1.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 1.0},
                                  {1.0, 0.0, 1.0}};
    static const srp_triangle t[6] = {{{0, 1, 4}}, {{0, 4, 2}}, {{0, 2, 5}},
                                      {{0, 5, 3}}, {{0, 3, 6}}, {{0, 6, 1}}};
    const srp_optics mirror = {1.0, 0.0, false};
    return shape_scene(shape_mesh(v, 7, t, 6, "mirror"), mirror);
}

/*
 * Light along -s meets the plane x = 0 at the time p = x / s_x, y = 0 at q = y / s_y, z = 0 at
 * r = z / s_z, for mirrors only turn signs round. It falls within the squares each time if
 * |p - q| max(s_x, s_y) <= 1, and so on. For s_x >= s_y >= s_z this leaves of the plane (p - r,
 * q - r) the area 4ab - b^2 with a = 1 / s_x, b = 1 / s_y <= 2a, and of the cross-section s_x s_y
 * s_z times that. Seen along (1, 1, 1) it is sqrt(3): the whole aperture.
 */
double shape_corner_cube_returns(srp_vec3 s) {
    double a = 1.0 / s.x, b = 1.0 / s.y;
    return s.x * s.y * s.z * (4.0 * a * b - b * b);
}
