/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Tables 1 and 2 of AAS 20-481 on this machine: mean over 162 directions of |a - a_truth|, mass
 * 1 kg, P0/c = 4.55982e-6 N/m^2.
 *
 *   Table 1  icospheres of radius 1, rho_s = 0.5, rho_d = 0, against the sphere: f = -pi r^2 s
 *            (Cr = 1: what the paper's figures are against, whatever its text says)
 *   Table 2  cube of edge 2, rho_s = 0.5, rho_d = 0.1, against its six plates
 *
 * raycast takes the paper's window, [-1.75, 1.75]^2, and its pixels; turned is raycast with as many
 * samples along the silhouette's box, as it does by itself; exact needs no samples. The paper's
 * times are of another machine (Ryzen 5 3600X, one thread), ours of all processors of this one.
 */
#include "bench.h"

#include <srp/const.h>
#include <srp/method.h>
#include <srp/sunlight.h>

#include <stdio.h>
#include <stdlib.h>

enum { SIDE_COUNT = 5 };

typedef struct paper_row {
    uint32_t side;
    double error;     /* raycast on the CPU [m/s^2] */
    const char *time; /* of it */
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
     {{256, 1.041336e-06, "1 min 53 s"},
      {512, 1.041429e-06, "7 min 28 s"},
      {1024, 1.042106e-06, "29 min 57 s"},
      {2048, 1.041116e-06, "1 h 58 min 43 s"}}},
    {"Table 1, icosphere 02 (320 triangles)",
     "icosphere-320.obj",
     {0.5, 0.0, false},
     NULL,
     {{256, 2.710234e-07, "7 min 13 s"},
      {512, 2.724694e-07, "29 min 17 s"},
      {1024, 2.731104e-07, "1 h 55 min 27 s"},
      {2048, 2.730734e-07, "7 h 44 min 43 s"}}},
    {"Table 1, icosphere 03 (1280 triangles)",
     "icosphere-1280.obj",
     {0.5, 0.0, false},
     NULL,
     {{256, 6.594094e-08, "28 min 24 s"},
      {512, 7.005476e-08, "1 h 53 min 58 s"},
      {1024, 6.901487e-08, "7 h 43 min 42 s"},
      {2048, 6.893901e-08, "30 h 22 min 20 s"}}},
    {"Table 2, cube (12 triangles)",
     "cube.obj",
     {0.5, 0.1, false},
     "cube.plates",
     {{256, 2.622924e-08, "16.2 s"},
      {512, 1.831568e-08, "1 min 3 s"},
      {1024, 1.435540e-08, "4 min 10 s"},
      {2048, 7.640938e-09, "16 min 55 s"},
      {4096, 2.934854e-09, "1 h 7 min 22 s"}}},
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

int main(void) {
    for (size_t k = 0; k < sizeof TABLES / sizeof TABLES[0]; ++k) {
        run(&TABLES[k]);
    }
    return EXIT_SUCCESS;
}
