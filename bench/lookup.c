/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What a look-up costs, GSL's interp2d and spline2d beside us on the same nodes in the same run: a
 * table of 1 degree, random directions and those along an orbit.
 *
 * Ours begin with a unit vector and give f, or f and t, or both and their derivatives. GSL's give
 * one component a call, three calls with one accelerator per angle make a vector. They begin with
 * azimuth and elevation, and are timed twice: from unit vectors, with an atan2 and an asin, which
 * is the same job as ours, and with both angles at hand. Times are the least of several rounds in
 * turns, one thread.
 */
#include "bench.h"

#include <srp/const.h>
#include <srp/demand.h>
#include <srp/interp.h>
#include <srp/table.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_interp2d.h>
#include <gsl/gsl_spline2d.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { DIRECTIONS = 1 << 18, ROUNDS = 15 };

typedef struct walk {
    const char *name;
    srp_vec3 *s;
    double *az_deg, *el_deg;
} walk;

/* Splittable random numbers, Steele, Lea and Flood 2014. */
static double random_unit(uint64_t *state) {
    uint64_t z = (*state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static walk walk_create(const char *name) {
    walk w = {name, bench_allocate(DIRECTIONS, sizeof(srp_vec3)),
              bench_allocate(DIRECTIONS, sizeof(double)),
              bench_allocate(DIRECTIONS, sizeof(double))};
    return w;
}

static void walk_finish(walk *w) {
    for (size_t k = 0; k < DIRECTIONS; ++k) {
        srp_vec3 s = w->s[k];
        w->az_deg[k] = atan2(s.y, s.x) / SRP_RAD_PER_DEG;
        w->el_deg[k] = atan2(s.z, hypot(s.x, s.y)) / SRP_RAD_PER_DEG;
    }
}

static walk random_walk(void) {
    walk w = walk_create("random");
    uint64_t state = 1;
    for (size_t k = 0; k < DIRECTIONS; ++k) {
        double z = 2.0 * random_unit(&state) - 1.0;
        double az = 2.0 * SRP_PI * random_unit(&state), h = sqrt(1.0 - z * z);
        w.s[k] = srp_vec3_make(h * cos(az), h * sin(az), z);
    }
    walk_finish(&w);
    return w;
}

/* A spacecraft that points at the nadir, the Sun 40 degrees off the orbit's plane: a step of 0.05
 * degrees at a time. */
static walk orbit_walk(void) {
    walk w = walk_create("orbit");
    for (size_t k = 0; k < DIRECTIONS; ++k) {
        double u = 0.05 * (double)k * SRP_RAD_PER_DEG, b = 40.0 * SRP_RAD_PER_DEG;
        w.s[k] = srp_vec3_make(cos(b) * cos(u), sin(b), -cos(b) * sin(u));
    }
    walk_finish(&w);
    return w;
}

static void walk_destroy(walk *w) {
    free(w->s);
    free(w->az_deg);
    free(w->el_deg);
}

/* ---- The table ------------------------------------------------------------------------------ */

static const srp_grid GRID = {361, 181};

static srp_table *make_table(const srp_prepared *prepared) {
    srp_table *table = NULL;
    srp_error error;
    bench_require(srp_table_create(prepared, GRID, false, &table, &error), &error);
    bench_require(srp_table_fill(table, prepared, NULL, &error), &error);
    return table;
}

/* One that fills itself, with all nodes there already. */
static srp_demand *make_demand(const srp_prepared *prepared) {
    srp_demand *demand = NULL;
    srp_error error;
    bench_require(srp_demand_create(prepared, GRID, NULL, &demand, &error), &error);
    for (uint32_t i = 0; i < GRID.az_count; ++i) {
        for (uint32_t j = 0; j < GRID.el_count; ++j) {
            const srp_demand_node node = {i, j};
            bench_require(srp_demand_need(demand, 1, &node, &error), &error);
        }
    }
    return demand;
}

/* The same table without moments, by way of a file that has none. */
static srp_table *without_moments(const srp_table *table) {
    static const char path[] = "lookup.txt";
    srp_table *copy = NULL, *back = NULL;
    srp_error error;
    const srp_table_info *info = srp_table_get_info(table);
    bench_require(srp_table_write(table, &srp_table_format_spo, "lookup.spo", &error), &error);
    bench_require(srp_table_read(&srp_table_format_spo, "lookup.spo", &copy, &error), &error);
    bench_require(srp_table_describe(copy, "", "", info->light, 1.0, &error), &error);
    bench_require(srp_table_write(copy, &srp_table_format_txt, path, &error), &error);
    bench_require(srp_table_read(&srp_table_format_txt, path, &back, &error), &error);
    srp_table_destroy(copy);
    remove(path);
    remove("lookup.spo");
    return back;
}

/* ---- Timing --------------------------------------------------------------------------------- */

/* What was summed, so that nothing is optimised away. */
static double sink;

typedef enum wanted { FORCE, FORCE_MOMENT, SLOPES } wanted;

static double time_ours(const srp_interp *interp, const walk *w, wanted what) {
    double sum = 0.0, start = bench_now();
    for (size_t k = 0; k < DIRECTIONS; ++k) {
        srp_vec3 f, t = {0.0, 0.0, 0.0};
        srp_interp_jacobian slopes;
        slopes.df[1][1] = 0.0;
        if (srp_interp_eval(interp, w->s[k], &f, what == FORCE ? NULL : &t,
                            what == SLOPES ? &slopes : NULL, NULL) != SRP_OK) {
            abort();
        }
        sum += f.x + f.y + f.z + t.x + t.y + t.z + (what == SLOPES ? slopes.df[1][1] : 0.0);
    }
    double took = bench_now() - start;
    sink += sum;
    return took;
}

typedef struct yardstick {
    double az[361], el[181];
    double *z[3];
    gsl_interp2d *linear[3];
    gsl_spline2d *cubic[3];
    gsl_interp_accel *in_az, *in_el;
} yardstick;

static yardstick *yardstick_create(const srp_table *table) {
    yardstick *y = bench_allocate(1, sizeof *y);
    srp_grid grid = srp_table_grid(table);
    for (uint32_t i = 0; i < grid.az_count; ++i) {
        y->az[i] = srp_grid_azimuth_deg(grid, i);
    }
    for (uint32_t j = 0; j < grid.el_count; ++j) {
        y->el[j] = srp_grid_elevation_deg(grid, j);
    }
    for (int c = 0; c < 3; ++c) {
        y->z[c] = bench_allocate(srp_grid_node_count(grid), sizeof(double));
        for (uint32_t i = 0; i < grid.az_count; ++i) {
            for (uint32_t j = 0; j < grid.el_count; ++j) {
                srp_vec3 f = srp_table_node(table, i, j)->f;
                y->z[c][(size_t)j * grid.az_count + i] = c == 0 ? f.x : c == 1 ? f.y : f.z;
            }
        }
        y->linear[c] = gsl_interp2d_alloc(gsl_interp2d_bilinear, grid.az_count, grid.el_count);
        y->cubic[c] = gsl_spline2d_alloc(gsl_interp2d_bicubic, grid.az_count, grid.el_count);
        gsl_interp2d_init(y->linear[c], y->az, y->el, y->z[c], grid.az_count, grid.el_count);
        gsl_spline2d_init(y->cubic[c], y->az, y->el, y->z[c], grid.az_count, grid.el_count);
    }
    y->in_az = gsl_interp_accel_alloc();
    y->in_el = gsl_interp_accel_alloc();
    return y;
}

static void yardstick_destroy(yardstick *y) {
    for (int c = 0; c < 3; ++c) {
        gsl_interp2d_free(y->linear[c]);
        gsl_spline2d_free(y->cubic[c]);
        free(y->z[c]);
    }
    gsl_interp_accel_free(y->in_az);
    gsl_interp_accel_free(y->in_el);
    free(y);
}

/* `angles`: azimuth and elevation are at hand. */
static double time_gsl(const yardstick *y, const walk *w, bool cubic, bool angles) {
    const double per_rad = 1.0 / SRP_RAD_PER_DEG;
    double sum = 0.0, start = bench_now();
    for (size_t k = 0; k < DIRECTIONS; ++k) {
        double f[3];
        const srp_vec3 s = w->s[k];
        const double az = angles ? w->az_deg[k] : atan2(s.y, s.x) * per_rad;
        const double el = angles ? w->el_deg[k] : asin(s.z) * per_rad;
        for (int c = 0; c < 3; ++c) {
            if (cubic) {
                gsl_spline2d_eval_e(y->cubic[c], az, el, y->in_az, y->in_el, &f[c]);
            } else {
                gsl_interp2d_eval_e(y->linear[c], y->az, y->el, y->z[c], az, el, y->in_az, y->in_el,
                                    &f[c]);
            }
        }
        sum += f[0] + f[1] + f[2];
    }
    double took = bench_now() - start;
    sink += sum;
    return took;
}

enum { OURS = 3, KINDS = 3 };

typedef struct times {
    double ours[OURS][KINDS], linear[2], cubic[2]; /* GSL's from vectors, from angles */
} times;

/* A look-up of f and t gives two vectors. */
static void print_ratios(const walk *w, const times *best) {
    static const char *const JOBS[] = {"from vectors, f alone", "from vectors, f and t",
                                       "GSL's from angles, f alone", "GSL's from angles, f and t"};
    const double demanded = w->name[0] == 'r' ? 8.0 : 5.0;
    const double ours[2] = {best->ours[2][FORCE], 0.5 * best->ours[2][FORCE_MOMENT]};
    for (int k = 0; k < 4; ++k) {
        double ratio = best->cubic[k / 2] / ours[k % 2];
        printf("  GSL's bicubic over our spline, per vector, %-27s %5.1f   asked: %g %s\n", JOBS[k],
               ratio, demanded, ratio >= demanded ? "(held)" : "(MISSED)");
    }
}

static void run(const walk *w, srp_interp *const plain[OURS], srp_interp *const full[OURS],
                const yardstick *y) {
    times best = {{{0.0}}, {INFINITY, INFINITY}, {INFINITY, INFINITY}};
    for (int round = 0; round < ROUNDS; ++round) {
        for (int k = 0; k < OURS * KINDS; ++k) {
            int scheme = k / KINDS;
            wanted what = (wanted)(k % KINDS);
            double took = time_ours(what == FORCE ? plain[scheme] : full[scheme], w, what);
            double *least = &best.ours[scheme][what];
            *least = round == 0 ? took : fmin(*least, took);
        }
        for (int k = 0; k < 2; ++k) {
            best.linear[k] = fmin(best.linear[k], time_gsl(y, w, false, k == 1));
            best.cubic[k] = fmin(best.cubic[k], time_gsl(y, w, true, k == 1));
        }
    }
    const double ns = 1e9 / DIRECTIONS;
    printf("%s directions, ns per look-up        f    f and t   f, t and derivatives\n", w->name);
    for (int k = 0; k < OURS; ++k) {
        printf("  %-32s %6.1f     %6.1f     %6.1f\n", srp_interp_get_scheme(full[k])->name,
               ns * best.ours[k][FORCE], ns * best.ours[k][FORCE_MOMENT],
               ns * best.ours[k][SLOPES]);
    }
    printf("  GSL interp2d, bilinear           %6.1f     from azimuth and elevation %.1f\n",
           ns * best.linear[0], ns * best.linear[1]);
    printf("  GSL spline2d, bicubic            %6.1f     from azimuth and elevation %.1f\n",
           ns * best.cubic[0], ns * best.cubic[1]);
    print_ratios(w, &best);
}

/* Look-ups of a table that fills itself, in cells that are ready, beside those of the full one. */
static void run_on_demand(const walk *w, const srp_interp *full, srp_demand *demand) {
    srp_interp *interp = NULL;
    srp_error error;
    double ours = INFINITY, plain = INFINITY;
    bench_require(srp_interp_create_on_demand(srp_interp_get_scheme(full), demand, &interp, &error),
                  &error);
    (void)time_ours(interp, w, FORCE_MOMENT);
    for (int round = 0; round < ROUNDS; ++round) {
        ours = fmin(ours, time_ours(interp, w, FORCE_MOMENT));
        plain = fmin(plain, time_ours(full, w, FORCE_MOMENT));
    }
    printf("  %s on demand, f and t      %6.1f     on the full table %.1f\n",
           srp_interp_get_scheme(full)->name, 1e9 / DIRECTIONS * ours, 1e9 / DIRECTIONS * plain);
    srp_interp_destroy(interp);
}

int main(void) {
    gsl_set_error_handler_off();
    /* The box-wing, by `exact`. */
    srp_method_params params = srp_method_params_default();
    srp_scene *scene = bench_scene(bench_model("box-wing.obj"), (srp_optics){0.3, 0.2, false});
    srp_prepared *prepared = bench_prepare(&srp_method_exact, scene, &params);
    srp_table *table = make_table(prepared), *forces = without_moments(table);
    srp_demand *demand = make_demand(prepared);
    size_t count;
    const srp_interp_scheme *const *schemes = srp_interp_list(&count);
    srp_interp *plain[OURS], *full[OURS];
    srp_error error;
    for (int k = 0; k < OURS; ++k) {
        bench_require(srp_interp_create(schemes[k], forces, &plain[k], &error), &error);
        double start = bench_now();
        bench_require(srp_interp_create(schemes[k], table, &full[k], &error), &error);
        printf("%s of 361 x 181 nodes made in %.1f ms\n", schemes[k]->name,
               1e3 * (bench_now() - start));
    }
    yardstick *y = yardstick_create(table);
    walk walks[2] = {random_walk(), orbit_walk()};
    for (int k = 0; k < 2; ++k) {
        run(&walks[k], plain, full, y);
        run_on_demand(&walks[k], full[0], demand);
        run_on_demand(&walks[k], full[1], demand);
        walk_destroy(&walks[k]);
    }
    for (int k = 0; k < OURS; ++k) {
        srp_interp_destroy(plain[k]);
        srp_interp_destroy(full[k]);
    }
    yardstick_destroy(y);
    srp_demand_destroy(demand);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
    srp_table_destroy(table);
    srp_table_destroy(forces);
    return isfinite(sink) ? EXIT_SUCCESS : EXIT_FAILURE;
}
