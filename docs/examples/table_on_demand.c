/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A table of 1 degree that is never computed as a whole: the nodes that an orbit visits are
 * computed when it comes by, and remembered in a directory, so that the second run computes none.
 *
 *     table_on_demand MODEL.obj [CACHE_DIRECTORY]
 *
 * Built like force_on_orbit.c, which shows what to do with the force.
 */
#include <srp/cache.h>
#include <srp/const.h>
#include <srp/demand.h>
#include <srp/interp.h>
#include <srp/method.h>
#include <srp/scene.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void require(srp_status status, const srp_error *error) {
    if (status != SRP_OK) {
        char text[1400];
        srp_error_format(error, text, sizeof text);
        fprintf(stderr, "%s\n", text);
        exit(1);
    }
}

/* A directory that is full or out of reach stops nobody: it is said here, and things go on. */
static void warn(void *user, const srp_error *what) {
    char text[1400];
    (void)user;
    srp_error_format(what, text, sizeof text);
    fprintf(stderr, "warning: %s\n", text);
}

/* A spacecraft that points +Z at the Earth's centre, the Sun 35 degrees off the plane of its orbit.
 */
static void go_round(const srp_interp *interp, int steps) {
    const double beta = 35.0 * SRP_RAD_PER_DEG;
    double mean = 0.0;
    for (int k = 0; k < steps; ++k) {
        const double angle = 2.0 * SRP_PI * k / steps;
        const srp_vec3 s =
            srp_vec3_make(cos(beta) * sin(angle), sin(beta), -cos(beta) * cos(angle));
        srp_vec3 f;
        srp_error error;
        /* Computes what is missing; any number of threads may do this at once. */
        require(srp_interp_eval(interp, s, &f, NULL, NULL, &error), &error);
        mean += srp_vec3_norm(f) / steps;
    }
    printf("mean of |f| along the orbit: %.4f m^2\n", mean);
}

int main(int argc, char **argv) {
    if (argc != 2 && argc != 3) {
        fprintf(stderr, "usage: %s MODEL.obj [CACHE_DIRECTORY]\n", argv[0]);
        return 2;
    }
    srp_error error;
    srp_scene *scene = NULL;
    srp_prepared *prepared = NULL;
    srp_cache *cache = NULL;
    srp_demand *demand = NULL;
    srp_interp *interp = NULL;
    srp_grid grid;
    const char *model = argv[1];
    const srp_log log = {warn, NULL};
    const srp_method_params params = srp_method_params_default();
    srp_cache_params where = srp_cache_params_default();
    where.directory = argc == 3 ? argv[2] : NULL; /* NULL: the user's */

    require(srp_scene_read_obj(&model, 1, NULL, NULL, NULL, &scene, &error), &error);
    require(srp_method_prepare(&srp_method_exact, scene, &params, &prepared, &error), &error);
    require(srp_grid_from_steps(1.0, 1.0, &grid, &error), &error);
    require(srp_cache_open(&where, &log, &cache, &error), &error);
    require(srp_demand_create(prepared, grid, cache, &demand, &error), &error);
    require(srp_interp_create_on_demand(&srp_interp_bicubic, demand, &interp, &error), &error);
    go_round(interp, 1000);
    const srp_demand_counts counts = srp_demand_count(demand);
    printf("%zu of %zu directions are known, %zu of them computed now\n", counts.ready,
           counts.total, counts.computed);

    /* In this order; the table on demand writes what is new to the cache. */
    srp_interp_destroy(interp);
    srp_demand_destroy(demand);
    srp_cache_close(cache);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
    return 0;
}
