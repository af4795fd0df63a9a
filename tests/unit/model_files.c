/* SPDX-License-Identifier: Apache-2.0 */
#include "model_files.h"

#include "srp_check.h"

#include <srp/const.h>

const char *const MODEL_NAMES[] = {"cube",       "icosphere-80", "icosphere-320", "icosphere-1280",
                                   "l-corner",   "dihedral",     "box-wing",      "dish",
                                   "sun-shield", "gnss"};
const size_t MODEL_COUNT = sizeof MODEL_NAMES / sizeof MODEL_NAMES[0];

model_file model_read(const char *name) {
    char path[1024];
    srp_error error;
    model_file model = {NULL, NULL};
    (void)snprintf(path, sizeof path, "%s/%s.obj", SRP_MODELS_DIR, name);
    srp_mesh_read_params params = srp_mesh_read_params_default();
    assert_ok(srp_mesh_read_obj(path, &params, NULL, &model.mesh, &error), error);
    assert_ok(srp_materials_create(&model.materials, &error), error);
    ck_assert_uint_eq(srp_mesh_library_count(model.mesh), 1);
    assert_ok(
        srp_materials_read_mtl(model.materials, srp_mesh_library(model.mesh, 0), NULL, &error),
        error);
    return model;
}

void model_free(model_file *model) {
    srp_mesh_destroy(model->mesh);
    srp_materials_destroy(model->materials);
}

/* Uniform over all rotations: Shoemake, "Uniform random rotations", Graphics Gems III (1992). */
turn turn_random(uint64_t *state) {
    double u = random_unit(state), a = 2.0 * SRP_PI * random_unit(state),
           b = 2.0 * SRP_PI * random_unit(state);
    double w = sqrt(1.0 - u) * sin(a), x = sqrt(1.0 - u) * cos(a);
    double y = sqrt(u) * sin(b), z = sqrt(u) * cos(b);
    turn t;
    t.row[0] =
        srp_vec3_make(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y));
    t.row[1] =
        srp_vec3_make(2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x));
    t.row[2] =
        srp_vec3_make(2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y));
    return t;
}

turn turn_mirrored(turn rotation) {
    for (size_t i = 0; i < 3; ++i) {
        rotation.row[i].x = -rotation.row[i].x;
    }
    return rotation;
}

srp_vec3 turn_apply(const turn *t, srp_vec3 v) {
    return srp_vec3_make(srp_vec3_dot(t->row[0], v), srp_vec3_dot(t->row[1], v),
                         srp_vec3_dot(t->row[2], v));
}

static srp_scene *freeze(const srp_mesh *mesh, const srp_materials *materials) {
    srp_error error;
    srp_scene *scene = NULL;
    assert_ok(srp_scene_from_mesh(mesh, materials, &scene, &error), error);
    return scene;
}

srp_scene *model_scene(const model_file *model) {
    return freeze(model->mesh, model->materials);
}

srp_scene *model_scene_painted(const model_file *model, srp_optics optics) {
    srp_error error;
    srp_materials *materials = NULL;
    assert_ok(srp_materials_create(&materials, &error), error);
    for (size_t i = 0; i < srp_mesh_material_count(model->mesh); ++i) {
        assert_ok(srp_materials_set(materials, srp_mesh_material_name(model->mesh, i), optics,
                                    false, &error),
                  error);
    }
    srp_scene *scene = freeze(model->mesh, materials);
    srp_materials_destroy(materials);
    return scene;
}

srp_scene *model_scene_turned(const model_file *model, const turn *t) {
    const srp_mesh *mesh = model->mesh;
    size_t vertex_count = srp_mesh_vertex_count(mesh);
    size_t triangle_count = srp_mesh_triangle_count(mesh);
    size_t material_count = srp_mesh_material_count(mesh);
    srp_vec3 *vertices = malloc(vertex_count * sizeof *vertices);
    srp_triangle *triangles = malloc(triangle_count * sizeof *triangles);
    const char **names = malloc(material_count * sizeof *names);
    ck_assert(vertices != NULL && triangles != NULL && names != NULL);

    double handedness = srp_vec3_dot(t->row[0], srp_vec3_cross(t->row[1], t->row[2]));
    for (size_t i = 0; i < vertex_count; ++i) {
        vertices[i] = turn_apply(t, srp_mesh_vertices(mesh)[i]);
    }
    for (size_t i = 0; i < triangle_count; ++i) {
        srp_triangle triangle = srp_mesh_triangles(mesh)[i];
        if (handedness < 0.0) {
            uint32_t swapped = triangle.v[1];
            triangle.v[1] = triangle.v[2];
            triangle.v[2] = swapped;
        }
        triangles[i] = triangle;
    }
    for (size_t i = 0; i < material_count; ++i) {
        names[i] = srp_mesh_material_name(mesh, i);
    }
    srp_error error;
    srp_mesh *turned = NULL;
    assert_ok(srp_mesh_create(vertices, vertex_count, triangles, triangle_count,
                              srp_mesh_triangle_materials(mesh), names, material_count, &turned,
                              &error),
              error);
    free(vertices);
    free(triangles);
    free(names);
    srp_scene *scene = freeze(turned, model->materials);
    srp_mesh_destroy(turned);
    return scene;
}
