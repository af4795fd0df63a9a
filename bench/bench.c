/* SPDX-License-Identifier: Apache-2.0 */
#include "bench.h"

#include <srp/table.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

double bench_now(void) {
    struct timespec now;
    (void)timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void bench_require(srp_status status, const srp_error *error) {
    if (status != SRP_OK) {
        char text[2048];
        srp_error_format(error, text, sizeof text);
        (void)fprintf(stderr, "bench: %s\n", text);
        exit(3);
    }
}

void *bench_allocate(size_t count, size_t size) {
    void *memory = calloc(count, size);
    if (memory == NULL) {
        (void)fprintf(stderr, "bench: no memory\n");
        exit(3);
    }
    return memory;
}

/* One face of the cube [-1, 1]^3 as rows x columns squares, across `u` and `v`, u x v outwards.
 * Corners are not shared: scenes weld vertices at one place. */
static void add_face(srp_vec3 outward, srp_vec3 u, srp_vec3 v, uint32_t rows, uint32_t columns,
                     srp_vec3 **at) {
    static const int SQUARE[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    for (uint32_t j = 0; j < rows; ++j) {
        for (uint32_t i = 0; i < columns; ++i) {
            for (int k = 0; k < 6; ++k) {
                /* Whole numbers over whole numbers: the same on both sides of a cube's edge. */
                double x = 2.0 * (i + (uint32_t)SQUARE[k][0]) / columns - 1.0;
                double y = 2.0 * (j + (uint32_t)SQUARE[k][1]) / rows - 1.0;
                *(*at)++ = srp_vec3_add_scaled(srp_vec3_add_scaled(outward, x, u), y, v);
            }
        }
    }
}

/* The cube [-1, 1]^3 meshed with `count` squares along each axis; *triangles of them. */
static srp_vec3 *mesh_cube(const uint32_t count[3], size_t *triangles) {
    const srp_vec3 axis[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    *triangles = (size_t)4 * (count[0] * count[1] + count[1] * count[2] + count[2] * count[0]);
    srp_vec3 *corners = bench_allocate(3 * *triangles, sizeof *corners);
    srp_vec3 *at = corners;
    for (int k = 0; k < 3; ++k) {
        int a = (k + 1) % 3, b = (k + 2) % 3;
        add_face(axis[k], axis[a], axis[b], count[b], count[a], &at);
        add_face(srp_vec3_scale(-1.0, axis[k]), axis[b], axis[a], count[a], count[b], &at);
    }
    return corners;
}

/* Takes the corners over. */
static srp_mesh *mesh_of_corners(srp_vec3 *corners, size_t count) {
    const char *material = "surface";
    srp_triangle *triangles = bench_allocate(count, sizeof *triangles);
    uint32_t *materials = bench_allocate(count, sizeof *materials);
    for (size_t k = 0; k < count; ++k) {
        for (size_t e = 0; e < 3; ++e) {
            triangles[k].v[e] = (uint32_t)(3 * k + e);
        }
    }
    srp_error error;
    srp_mesh *mesh = NULL;
    bench_require(srp_mesh_create(corners, 3 * count, triangles, count, materials, &material, 1,
                                  &mesh, &error),
                  &error);
    free(corners);
    free(triangles);
    free(materials);
    return mesh;
}

srp_mesh *bench_sphere(uint32_t side, double radius, srp_vec3 centre) {
    const uint32_t count[3] = {side, side, side};
    size_t triangles;
    srp_vec3 *corners = mesh_cube(count, &triangles);
    for (size_t i = 0; i < 3 * triangles; ++i) {
        double scale = radius / srp_vec3_norm(corners[i]);
        corners[i] = srp_vec3_add_scaled(centre, scale, corners[i]);
    }
    return mesh_of_corners(corners, triangles);
}

static srp_mesh *make_box(srp_vec3 centre, srp_vec3 half, const uint32_t count[3]) {
    size_t triangles;
    srp_vec3 *corners = mesh_cube(count, &triangles);
    for (size_t i = 0; i < 3 * triangles; ++i) {
        corners[i].x = centre.x + half.x * corners[i].x;
        corners[i].y = centre.y + half.y * corners[i].y;
        corners[i].z = centre.z + half.z * corners[i].z;
    }
    return mesh_of_corners(corners, triangles);
}

static void join(srp_mesh *mesh, srp_mesh *part) {
    srp_error error;
    bench_require(srp_mesh_append(mesh, part, &error), &error);
    srp_mesh_destroy(part);
}

srp_mesh *bench_satellite(void) {
    const uint32_t bus[3] = {32, 32, 32}, panel[3] = {1, 48, 32};
    srp_mesh *mesh = bench_sphere(78, 0.8, srp_vec3_make(0.0, 0.0, 1.9));
    join(mesh, make_box(srp_vec3_make(0.0, 0.0, 0.0), srp_vec3_make(1.0, 1.0, 1.0), bus));
    for (int side = -1; side <= 1; side += 2) {
        join(mesh,
             make_box(srp_vec3_make(0.0, 3.2 * side, 0.0), srp_vec3_make(0.02, 2.0, 1.0), panel));
    }
    return mesh;
}

srp_mesh *bench_model(const char *name) {
    char path[1024];
    (void)snprintf(path, sizeof path, "%s/%s", SRP_MODELS_DIR, name);
    srp_mesh_read_params params = srp_mesh_read_params_default();
    srp_mesh *mesh = NULL;
    srp_error error;
    bench_require(srp_mesh_read_obj(path, &params, NULL, &mesh, &error), &error);
    return mesh;
}

srp_scene *bench_scene(srp_mesh *mesh, srp_optics optics) {
    srp_error error;
    srp_materials *materials = NULL;
    srp_scene *scene = NULL;
    bench_require(srp_materials_create(&materials, &error), &error);
    for (size_t m = 0; m < srp_mesh_material_count(mesh); ++m) {
        bench_require(
            srp_materials_set(materials, srp_mesh_material_name(mesh, m), optics, true, &error),
            &error);
    }
    bench_require(srp_scene_from_mesh(mesh, materials, &scene, &error), &error);
    srp_materials_destroy(materials);
    srp_mesh_destroy(mesh);
    return scene;
}

void bench_paper_directions(srp_vec3 s[BENCH_PAPER_DIRECTIONS]) {
    size_t count = 0;
    for (int j = 0; j < 9; ++j) {
        for (int i = 0; i < 18; ++i) {
            s[count++] = srp_direction_from_deg(20.0 * i - 180.0, 20.0 * j - 90.0);
        }
    }
}

srp_prepared *bench_prepare(const srp_method *method, const srp_scene *scene,
                            const srp_method_params *params) {
    srp_error error;
    srp_prepared *prepared = NULL;
    bench_require(srp_method_prepare(method, scene, params, &prepared, &error), &error);
    return prepared;
}

double bench_time(const srp_prepared *prepared, size_t count, const srp_vec3 *s, int repeats,
                  srp_response *responses) {
    double best = INFINITY;
    srp_error error;
    for (int k = 0; k < repeats; ++k) {
        double start = bench_now();
        bench_require(srp_prepared_respond(prepared, count, s, responses, NULL, &error), &error);
        best = fmin(best, bench_now() - start);
    }
    return best;
}

void bench_set_window(srp_method_params *params, double half, uint32_t side) {
    params->lattice.kind = SRP_LATTICE_WINDOW;
    params->lattice.columns = side;
    params->lattice.rows = side;
    for (int k = 0; k < 4; ++k) {
        params->lattice.window[k] = k & 1 ? half : -half;
    }
}
