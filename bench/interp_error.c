/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How far interpolants are off on real shapes: tables of 10, 5, 2 and 1 degrees by `exact`, against
 * `exact` in 2000 directions of no grid. Each node is computed once: the table of 1 degree holds
 * the others.
 *
 * Usage: interp_error [FINEST] [MODEL.obj of models/...]: steps down to FINEST degrees (1); without
 * models, box-wing, sun-shield and gnss, the last of which takes some twenty minutes of two
 * processors, five with FINEST 2.
 */
#include "bench.h"
#include "table_internal.h"

#include <srp/interp.h>
#include <srp/table.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { DIRECTIONS = 2000, STEPS = 4 };
static const uint32_t STEPS_DEG[STEPS] = {10, 5, 2, 1};

static srp_vec3 directions[DIRECTIONS];
static srp_response truth[DIRECTIONS];

static srp_scene *read_model(const char *name) {
    char path[512];
    const char *paths[] = {path};
    srp_scene *scene = NULL;
    srp_error error;
    snprintf(path, sizeof path, "%s/%s", SRP_MODELS_DIR, name);
    bench_require(srp_scene_read_obj(paths, 1, NULL, NULL, NULL, &scene, &error), &error);
    return scene;
}

static srp_table *empty_table(const srp_prepared *prepared, uint32_t step) {
    srp_table *table = NULL;
    srp_error error;
    srp_grid grid = {360 / step + 1, 180 / step + 1};
    bench_require(srp_table_create(prepared, grid, false, &table, &error), &error);
    return table;
}

/* Nodes that another table has. */
static void take_nodes(srp_table *table, const srp_table *other) {
    srp_grid grid = srp_table_grid(table), from = srp_table_grid(other);
    for (uint32_t i = 0; i < grid.az_count; ++i) {
        for (uint32_t j = 0; j < grid.el_count; ++j) {
            uint32_t x = i * (from.az_count - 1), y = j * (from.el_count - 1);
            if (x % (grid.az_count - 1) == 0 && y % (grid.el_count - 1) == 0) {
                size_t index = srp_table_index(table, i, j);
                table->nodes[index] =
                    *srp_table_node(other, x / (grid.az_count - 1), y / (grid.el_count - 1));
                srp_table_mark_filled(table, index);
            }
        }
    }
}

static void print_errors(const srp_table *table, uint32_t step) {
    size_t count;
    const srp_interp_scheme *const *schemes = srp_interp_list(&count);
    double f_max = 0.0, t_max = 0.0;
    srp_table_check check;
    srp_error error;
    for (size_t k = 0; k < srp_grid_node_count(srp_table_grid(table)); ++k) {
        f_max = fmax(f_max, srp_vec3_norm(table->nodes[k].f));
        t_max = fmax(t_max, srp_vec3_norm(table->nodes[k].t));
    }
    bench_require(srp_interp_check(table, DIRECTIONS, directions, truth, 0, &check, &error),
                  &error);
    printf("  %2u deg |", step);
    for (size_t k = 0; k < count; ++k) {
        const srp_table_error *e = &check.errors[k];
        printf(" %s f %.1e %.1e, t %.1e %.1e |", schemes[k]->name, e->f_mean / f_max,
               e->f_max / f_max, e->t_mean / t_max, e->t_max / t_max);
    }
    printf("\n");
    (void)fflush(stdout);
}

static void run(const char *name, uint32_t finest) {
    srp_scene *scene = read_model(name);
    srp_method_params params = srp_method_params_default();
    srp_prepared *prepared = bench_prepare(&srp_method_exact, scene, &params);
    srp_table *tables[STEPS] = {NULL};
    srp_error error;
    double start = bench_now();
    bench_require(srp_prepared_respond(prepared, DIRECTIONS, directions, truth, NULL, &error),
                  &error);
    printf("%s: mean and largest error, as shares of the largest |f| and |t|\n", name);
    for (size_t n = 0; n < STEPS && STEPS_DEG[n] >= finest; ++n) {
        tables[n] = empty_table(prepared, STEPS_DEG[n]);
        for (size_t k = 0; k < n; ++k) {
            take_nodes(tables[n], tables[k]);
        }
        bench_require(srp_table_fill(tables[n], prepared, NULL, &error), &error);
        print_errors(tables[n], STEPS_DEG[n]);
    }
    printf("  %.0f s\n", bench_now() - start);
    for (size_t n = 0; n < STEPS; ++n) {
        srp_table_destroy(tables[n]);
    }
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}

int main(int argc, char **argv) {
    static const char *const MODELS[] = {"box-wing.obj", "sun-shield.obj", "gnss.obj"};
    uint32_t finest = 1;
    int first = 1;
    if (argc > 1 && strtoul(argv[1], NULL, 10) > 0) {
        finest = (uint32_t)strtoul(argv[1], NULL, 10);
        first = 2;
    }
    srp_interp_directions(DIRECTIONS, 0, directions);
    for (int k = first; k < argc; ++k) {
        run(argv[k], finest);
    }
    for (size_t k = 0; argc <= first && k < sizeof MODELS / sizeof MODELS[0]; ++k) {
        run(MODELS[k], finest);
    }
    return EXIT_SUCCESS;
}
