/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Tables 1 and 2 of AAS 20-481 on this machine, and with a device of OpenGL as argument (gl:osmesa,
 * gl:egl) its columns of the GPU and Tables 3 and 4: mean over 162 directions of |a - a_truth|,
 * mass 1 kg, P0/c = 4.55982e-6 N/m^2.
 *
 *   Table 1  icospheres of radius 1, rho_s = 0.5, rho_d = 0, against the sphere: f = -pi r^2 s
 *            (Cr = 1: what the paper's figures are against, whatever its text says)
 *   Table 2  cube of edge 2, rho_s = 0.5, rho_d = 0.1, against its six plates
 *
 * raycast takes the paper's window, [-1.75, 1.75]^2, and its pixels; turned is raycast with as many
 * samples along the silhouette's box, as it does by itself; exact needs no samples. The paper's
 * times are of another machine (Ryzen 5 3600X, one thread), ours of all processors of this one.
 *
 *   Table 3  cube, 512 x 512: mean |a_gl - a_cpu| of the same method
 *   Table 4  cube, 512 x 512: mean difference between methods on one device
 *
 * Usage: paper_tables [DEVICE [TABLE]], TABLE one of 1 to 4 (3 and 4 come together).
 */
#include "bench.h"

#include <srp/const.h>
#include <srp/method.h>
#include <srp/sunlight.h>
#ifdef SRP_BENCH_HAS_GL
#include <srp/gl.h>
#endif

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE_COUNT = 5 };

typedef struct paper_row {
    uint32_t side;
    double error;     /* raycast on the CPU [m/s^2] */
    const char *time; /* of it */
    double gpu_error; /* the same of the paper's GPU */
    const char *gpu_time;
} paper_row;

typedef struct paper_table {
    const char *title, *model;
    srp_optics optics;
    const char *plates; /* file of the truth; NULL: the sphere of radius 1 */
    paper_row rows[SIDE_COUNT];
} paper_table;

static const paper_table TABLES[] = {
    {"Table 1, icosphere 01 (80 triangles)",
     "icosphere-80.obj",
     {0.5, 0.0, false},
     NULL,
     {{256, 1.041336e-06, "1 min 53 s", 1.041432e-06, "0.6 s"},
      {512, 1.041429e-06, "7 min 28 s", 1.041783e-06, "1.7 s"},
      {1024, 1.042106e-06, "29 min 57 s", 1.042033e-06, "5.4 s"},
      {2048, 1.041116e-06, "1 h 58 min 43 s", 1.047509e-06, "21.8 s"}}},
    {"Table 1, icosphere 02 (320 triangles)",
     "icosphere-320.obj",
     {0.5, 0.0, false},
     NULL,
     {{256, 2.710234e-07, "7 min 13 s", 2.712732e-07, "0.7 s"},
      {512, 2.724694e-07, "29 min 17 s", 2.731146e-07, "2.8 s"},
      {1024, 2.731104e-07, "1 h 55 min 27 s", 2.736871e-07, "10.6 s"},
      {2048, 2.730734e-07, "7 h 44 min 43 s", 2.747325e-07, "44.4 s"}}},
    {"Table 1, icosphere 03 (1280 triangles)",
     "icosphere-1280.obj",
     {0.5, 0.0, false},
     NULL,
     {{256, 6.594094e-08, "28 min 24 s", 6.618929e-08, "0.6 s"},
      {512, 7.005476e-08, "1 h 53 min 58 s", 7.046604e-08, "1.7 s"},
      {1024, 6.901487e-08, "7 h 43 min 42 s", 6.969292e-08, "10.8 s"},
      {2048, 6.893901e-08, "30 h 22 min 20 s", 7.143078e-08, "53.9 s"}}},
    {"Table 2, cube (12 triangles)",
     "cube.obj",
     {0.5, 0.1, false},
     "cube.plates",
     {{256, 2.622924e-08, "16.2 s", 2.961771e-08, "0.7 s"},
      {512, 1.831568e-08, "1 min 3 s", 2.767734e-08, "1.8 s"},
      {1024, 1.435540e-08, "4 min 10 s", 4.579024e-08, "5.5 s"},
      {2048, 7.640938e-09, "16 min 55 s", 2.802609e-07, "22.4 s"},
      {4096, 2.934854e-09, "1 h 7 min 22 s", 9.091753e-07, "3 min 2 s"}}},
};

static const double HALF_WINDOW = 1.75;

typedef struct result {
    double error; /* [m/s^2] */
    double time;  /* [s] */
} result;

static result measure(const srp_method *method, const srp_scene *scene,
                      const srp_method_params *params, const srp_vec3 *s, const srp_vec3 *truth) {
    srp_response responses[BENCH_PAPER_DIRECTIONS];
    srp_prepared *prepared = bench_prepare(method, scene, params);
    result out = {0.0, bench_time(prepared, BENCH_PAPER_DIRECTIONS, s, 3, responses)};
    double pressure = srp_sunlight_pressure(srp_sunlight_default(), SRP_AU);
    for (int k = 0; k < BENCH_PAPER_DIRECTIONS; ++k) {
        double off = srp_vec3_norm(srp_vec3_sub(responses[k].f, truth[k]));
        out.error += pressure * off / BENCH_PAPER_DIRECTIONS;
    }
    srp_prepared_release(prepared);
    return out;
}

static void find_truth(const paper_table *table, const srp_vec3 *s, srp_vec3 *truth) {
    if (table->plates == NULL) {
        for (int k = 0; k < BENCH_PAPER_DIRECTIONS; ++k) {
            truth[k] = srp_vec3_scale(-SRP_PI, s[k]);
        }
        return;
    }
    char path[1024];
    srp_error error;
    srp_plate *plates = NULL;
    size_t count = 0;
    srp_scene *scene = NULL;
    srp_response responses[BENCH_PAPER_DIRECTIONS];
    srp_method_params params = srp_method_params_default();
    (void)snprintf(path, sizeof path, "%s/%s", SRP_MODELS_DIR, table->plates);
    bench_require(srp_plates_read(path, &plates, &count, &error), &error);
    bench_require(srp_scene_from_plates(plates, count, &scene, &error), &error);
    srp_plates_free(plates);
    srp_prepared *prepared = bench_prepare(&srp_method_nplate, scene, &params);
    (void)bench_time(prepared, BENCH_PAPER_DIRECTIONS, s, 1, responses);
    for (int k = 0; k < BENCH_PAPER_DIRECTIONS; ++k) {
        truth[k] = responses[k].f;
    }
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}

static void run(const paper_table *table) {
    srp_vec3 s[BENCH_PAPER_DIRECTIONS], truth[BENCH_PAPER_DIRECTIONS];
    bench_paper_directions(s);
    find_truth(table, s, truth);
    srp_scene *scene = bench_scene(bench_model(table->model), table->optics);
    printf("%s: mean error [m/s^2] and time for %d directions\n", table->title,
           BENCH_PAPER_DIRECTIONS);
    printf(
        "       pixels        paper      raycast       turned   paper's time   raycast   turned\n");
    for (int k = 0; k < SIDE_COUNT && table->rows[k].side > 0; ++k) {
        const paper_row *row = &table->rows[k];
        srp_method_params params = srp_method_params_default();
        params.lattice.samples = row->side;
        result turned = measure(&srp_method_raycast, scene, &params, s, truth);
        bench_set_window(&params, HALF_WINDOW, row->side);
        result window = measure(&srp_method_raycast, scene, &params, s, truth);
        printf("  %4u x %4u  %.4e   %.4e   %.4e %16s %8.4f s %7.4f s\n", row->side, row->side,
               row->error, window.error, turned.error, row->time, window.time, turned.time);
    }
    srp_method_params params = srp_method_params_default();
    result exact = measure(&srp_method_exact, scene, &params, s, truth);
    printf("  exact                    %.4e                                  %8.4f s\n\n",
           exact.error, exact.time);
    srp_scene_destroy(scene);
}

/* ---- with OpenGL ---- */

enum { FEW_REPEATS = 2 };

static const srp_method *find_method(const char *device, const char *name) {
#ifdef SRP_BENCH_HAS_GL
    size_t count;
    const srp_method *const *methods = srp_gl_method_list(&count);
    for (size_t k = 0; k < count; ++k) {
        if (strcmp(methods[k]->device, device) == 0 && strcmp(methods[k]->name, name) == 0) {
            return methods[k];
        }
    }
#endif
    (void)fprintf(stderr, "paper_tables: no method %s on %s\n", name, device);
    exit(2);
}

static void run_gl(const paper_table *table, const char *device) {
    const srp_method *method = find_method(device, "raycast");
    srp_vec3 s[BENCH_PAPER_DIRECTIONS], truth[BENCH_PAPER_DIRECTIONS];
    bench_paper_directions(s);
    find_truth(table, s, truth);
    srp_scene *scene = bench_scene(bench_model(table->model), table->optics);
    printf("%s, on %s: mean error [m/s^2] and time for %d directions\n", table->title, device,
           BENCH_PAPER_DIRECTIONS);
    printf(
        "       pixels   paper's GPU      raycast       turned   paper's time   raycast   turned "
        "  turned on cpu\n");
    for (int k = 0; k < SIDE_COUNT && table->rows[k].side > 0; ++k) {
        const paper_row *row = &table->rows[k];
        srp_method_params params = srp_method_params_default();
        params.lattice.samples = row->side;
        result turned = measure(method, scene, &params, s, truth);
        result cpu = measure(&srp_method_raycast, scene, &params, s, truth);
        bench_set_window(&params, HALF_WINDOW, row->side);
        result window = measure(method, scene, &params, s, truth);
        printf("  %4u x %4u    %.4e   %.4e   %.4e %14s %8.4f s %7.4f s %9.4f s\n", row->side,
               row->side, row->gpu_error, window.error, turned.error, row->gpu_time, window.time,
               turned.time, cpu.time);
    }
    printf("\n");
    srp_scene_destroy(scene);
}

/* Responses of the cube at 512 x 512: paper's window, or turned. */
typedef struct run_of_cube {
    const char *name;
    uint32_t diffuse;
    bool window;
    double paper; /* its GPU against its CPU [m/s^2] */
    srp_response cpu[BENCH_PAPER_DIRECTIONS], gl[BENCH_PAPER_DIRECTIONS];
} run_of_cube;

static double difference(const srp_response *a, const srp_response *b) {
    double pressure = srp_sunlight_pressure(srp_sunlight_default(), SRP_AU), sum = 0.0;
    for (int k = 0; k < BENCH_PAPER_DIRECTIONS; ++k) {
        sum += pressure * srp_vec3_norm(srp_vec3_sub(a[k].f, b[k].f)) / BENCH_PAPER_DIRECTIONS;
    }
    return sum;
}

static void run_cube(run_of_cube *cube, const srp_scene *scene, const char *device) {
    srp_vec3 s[BENCH_PAPER_DIRECTIONS];
    bench_paper_directions(s);
    const srp_method *processor =
        strcmp(cube->name, "raycast") == 0 ? &srp_method_raycast : &srp_method_raytrace;
    srp_method_params params = srp_method_params_default();
    params.diffuse = cube->diffuse;
    if (cube->window) {
        bench_set_window(&params, HALF_WINDOW, 512);
    }
    srp_prepared *cpu = bench_prepare(processor, scene, &params);
    srp_prepared *gl = bench_prepare(find_method(device, cube->name), scene, &params);
    double cpu_time = bench_time(cpu, BENCH_PAPER_DIRECTIONS, s, FEW_REPEATS, cube->cpu);
    double gl_time = bench_time(gl, BENCH_PAPER_DIRECTIONS, s, FEW_REPEATS, cube->gl);
    srp_prepared_release(cpu);
    srp_prepared_release(gl);
    printf("  %-8s K = %u %-7s %.4e   %.4e %10.4f s %8.4f s\n", cube->name, cube->diffuse,
           cube->window ? "window" : "turned", cube->paper, difference(cube->gl, cube->cpu),
           cpu_time, gl_time);
}

static void run_tables_3_and_4(const char *device) {
    static run_of_cube cubes[] = {{.name = "raycast", .window = true, .paper = 1.705769e-08},
                                  {.name = "raycast", .paper = 1.705769e-08},
                                  {.name = "raytrace", .paper = 1.670238e-08},
                                  {.name = "raytrace", .diffuse = 4, .paper = 1.670238e-08}};
    srp_scene *scene = bench_scene(bench_model("cube.obj"), (srp_optics){0.5, 0.1, false});
    printf("Table 3, cube, 512 x 512: mean |a_gl - a_cpu| [m/s^2], on %s\n", device);
    printf("                              paper         ours      time cpu    time gl\n");
    for (size_t k = 0; k < sizeof cubes / sizeof cubes[0]; ++k) {
        run_cube(&cubes[k], scene, device);
    }
    printf(
        "\nTable 4, cube, 512 x 512: mean difference of methods [m/s^2] (here raytrace solves the "
        "direct part exactly: against raycast it shows raycast's sampling error)\n");
    printf("                         paper's CPU  ours   paper's GPU  ours\n");
    printf("  raycast, raytrace SS   0            %.4e  4.3691e-11  %.4e\n",
           difference(cubes[1].cpu, cubes[2].cpu), difference(cubes[1].gl, cubes[2].gl));
    printf("  raycast, raytrace MS   0            %.4e  4.4306e-10  %.4e\n",
           difference(cubes[1].cpu, cubes[3].cpu), difference(cubes[1].gl, cubes[3].gl));
    printf("  raytrace SS, MS        0            %.4e  0           %.4e\n",
           difference(cubes[2].cpu, cubes[3].cpu), difference(cubes[2].gl, cubes[3].gl));
    srp_scene_destroy(scene);
}

int main(int argc, char **argv) {
    const char *device = argc > 1 && strcmp(argv[1], "cpu") != 0 ? argv[1] : NULL;
    int wanted = argc > 2 ? atoi(argv[2]) : 0; /* 0: all */
    if (argc > 3 || wanted < 0 || wanted > 4) {
        (void)fprintf(stderr, "usage: paper_tables [DEVICE [1|2|3|4]]\n");
        return 2;
    }
    (void)setvbuf(stdout, NULL, _IOLBF, 0); /* rows take long */
    for (size_t k = 0; k < sizeof TABLES / sizeof TABLES[0]; ++k) {
        int number = TABLES[k].plates == NULL ? 1 : 2;
        if (wanted != 0 && wanted != number) {
            continue;
        }
        if (device != NULL) {
            run_gl(&TABLES[k], device);
        } else {
            run(&TABLES[k]);
        }
    }
    if (device != NULL && (wanted == 0 || wanted > 2)) {
        run_tables_3_and_4(device);
    }
    return EXIT_SUCCESS;
}
