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
