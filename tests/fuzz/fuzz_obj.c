/* SPDX-License-Identifier: Apache-2.0 */
/* OBJ text to mesh, on to its report, a scene, and the light on it. */
#include "fuzz.h"

#include <srp/method.h>
#include <srp/scene.h>

#include <math.h>

static void check_mesh(const srp_mesh *mesh) {
    size_t vertices = srp_mesh_vertex_count(mesh), triangles = srp_mesh_triangle_count(mesh);
    REQUIRE(triangles > 0);
    for (size_t i = 0; i < vertices; ++i) {
        REQUIRE(srp_vec3_is_finite(srp_mesh_vertices(mesh)[i]));
    }
    for (size_t i = 0; i < triangles; ++i) {
        for (int k = 0; k < 3; ++k) {
            REQUIRE(srp_mesh_triangles(mesh)[i].v[k] < vertices);
        }
        REQUIRE(srp_mesh_triangle_materials(mesh)[i] < srp_mesh_material_count(mesh));
    }
    for (size_t i = 0; i < srp_mesh_material_count(mesh); ++i) {
        REQUIRE(srp_mesh_material_name(mesh, i) != NULL);
    }
    for (size_t i = 0; i < srp_mesh_library_count(mesh); ++i) {
        REQUIRE(srp_mesh_library(mesh, i)[0] != '\0');
    }
}

static void check_same(const srp_mesh *a, const srp_mesh *b) {
    size_t vertices = srp_mesh_vertex_count(a), triangles = srp_mesh_triangle_count(a);
    REQUIRE(vertices == srp_mesh_vertex_count(b) && triangles == srp_mesh_triangle_count(b));
    REQUIRE(memcmp(srp_mesh_vertices(a), srp_mesh_vertices(b), vertices * sizeof(srp_vec3)) == 0);
    REQUIRE(memcmp(srp_mesh_triangles(a), srp_mesh_triangles(b),
                   triangles * sizeof(srp_triangle)) == 0);
    REQUIRE(memcmp(srp_mesh_triangle_materials(a), srp_mesh_triangle_materials(b),
                   triangles * sizeof(uint32_t)) == 0);
    REQUIRE(srp_mesh_material_count(a) == srp_mesh_material_count(b));
    for (size_t i = 0; i < srp_mesh_material_count(a); ++i) {
        REQUIRE(strcmp(srp_mesh_material_name(a, i), srp_mesh_material_name(b, i)) == 0);
    }
}

static void check_report(const srp_mesh *mesh) {
    srp_mesh_report report;
    srp_error error;
    REQUIRE(srp_mesh_inspect(mesh, &report, &error) == SRP_OK);
    REQUIRE(report.triangles == srp_mesh_triangle_count(mesh));
    REQUIRE(report.degenerate < report.triangles);
    REQUIRE(report.closed_components <= report.components);
    REQUIRE(report.inward_components <= report.closed_components);
    REQUIRE(report.box_min.x <= report.box_max.x);
}

/* Whatever mesh a scene accepts, light on it is finite, and no more than the model can stop. */
static void check_light(const srp_scene *scene) {
    static const srp_vec3 SUNS[2] = {{1.0, 0.0, 0.0}, {0.48, -0.6, 0.64}};
    srp_method_params params = srp_method_params_default();
    srp_prepared *prepared;
    srp_response responses[2];
    srp_error error;
    params.threads = 1;
    REQUIRE(srp_method_prepare(&srp_method_exact, scene, &params, &prepared, &error) == SRP_OK);
    REQUIRE(srp_prepared_respond(prepared, 2, SUNS, responses, NULL, &error) == SRP_OK);
    double radius = srp_scene_radius(scene);
    for (int k = 0; k < 2; ++k) {
        double most = 4.0 * radius * radius; /* of a square that holds the silhouette */
        REQUIRE(responses[k].lit_area >= -1e-9 * most && responses[k].lit_area <= 1.001 * most);
        REQUIRE(srp_vec3_norm(responses[k].f) <= 2.002 * most);
        REQUIRE(srp_vec3_norm(responses[k].t) <= 2.002 * most * radius);
    }
    srp_prepared_release(prepared);
}

static void check_scene(const srp_mesh *mesh) {
    srp_materials *materials;
    srp_scene *scene;
    srp_error error;
    REQUIRE(srp_materials_create(&materials, &error) == SRP_OK);
    for (size_t i = 0; i < srp_mesh_material_count(mesh); ++i) {
        REQUIRE(srp_materials_set(materials, srp_mesh_material_name(mesh, i),
                                  (srp_optics){0.5, 0.25, false}, false, &error) == SRP_OK);
    }
    srp_status status = srp_scene_from_mesh(mesh, materials, &scene, &error);
    if (status == SRP_OK) {
        REQUIRE(srp_scene_facet_count(scene) > 0);
        check_light(scene);
        srp_scene_destroy(scene);
    } else {
        /* Too large, or too far from the origin for the size of its faces. */
        REQUIRE(status == SRP_BAD_DATA && error.message[0] != '\0');
    }
    srp_materials_destroy(materials);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const char *text = (const char *)data;
    srp_mesh *mesh, *again;
    srp_error error;
    srp_status status = srp_mesh_parse_obj(text, size, "fuzz", NULL, NULL, &mesh, &error);
    if (status != SRP_OK) {
        REQUIRE(status == SRP_BAD_FORMAT || status == SRP_BAD_DATA);
        REQUIRE(error.message[0] != '\0');
        return 0;
    }
    check_mesh(mesh);
    REQUIRE(srp_mesh_parse_obj(text, size, "fuzz", NULL, NULL, &again, &error) == SRP_OK);
    check_same(mesh, again);
    srp_mesh_destroy(again);
    check_report(mesh);
    check_scene(mesh);
    srp_mesh_destroy(mesh);
    return 0;
}
