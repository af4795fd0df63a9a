/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What tables do to an orbit, and what they cost: a box-wing in GEO, nadir pointing, 30 days at
 * 1e-12, by step and interpolant, beside the exact method asked at every call. Then the time of a
 * call of the forces, and the part of radiation pressure in it, with points and with a field of 20
 * x 20 (made up, as large as the Earth's). One thread; shares are of times in the same run.
 */
#include "bench.h"

#include <srp/interp.h>
#include <srp/orbit/elements.h>
#include <srp/orbit/propagator.h>
#include <srp/table.h>

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double MU = 398600.4415e9, DAYS = 30.0;

static srp_ephemeris *make_sky(void) {
    srp_epoch epoch;
    srp_error error;
    srp_ephemeris *sky = NULL;
    bench_require(srp_epoch_parse("2024-03-20T00:00:00 UTC", &epoch, NULL, &error), &error);
    srp_ephemeris_params params = srp_ephemeris_params_default(epoch);
    params.end = DAYS * 86400.0;
    params.bodies |= 1u << SRP_MOON;
    params.orientation = true;
    bench_require(srp_ephemeris_create(&params, &sky, &error), &error);
    return sky;
}

static void add(srp_force_list *list, const srp_force *force) {
    srp_error error;
    bench_require(srp_force_list_add(list, force, &error), &error);
}

/* Earth (a point, or `field`), Sun, Moon, and the model's light. */
static srp_force_list *make_list(const srp_ephemeris *sky, const srp_gravity *field,
                                 const srp_area_model *model, srp_shadow *shadow) {
    srp_force_list *list = NULL;
    srp_force force;
    srp_error error;
    bench_require(srp_force_list_create(sky, SRP_EARTH, &list, &error), &error);
    bench_require(field != NULL ? srp_force_gravity(field, sky, &force, &error)
                                : srp_force_central(MU, &force, &error),
                  &error);
    add(list, &force);
    for (int i = 0; i < 2; ++i) {
        const srp_celestial body = i == 0 ? SRP_SUN : SRP_MOON;
        bench_require(srp_force_point_mass(body, srp_celestial_get(body)->mu, &force, &error),
                      &error);
        add(list, &force);
    }
    srp_radiation_params params = {
        .model = *model, .light = srp_sunlight_default(), .mass = 850.0, .scale = 1.0};
    params.shadow.sun_radius = 695990e3;
    params.shadow.count = 1;
    params.shadow.body[0] = SRP_EARTH;
    params.shadow.radius[0] = 6378136.3;
    const srp_attitude_pointing nadir = {
        SRP_TARGET_NADIR, {0, 0, 1}, SRP_TARGET_ORBIT_NORMAL, {0, 1, 0}};
    bench_require(srp_attitude_pointing_create(&nadir, &params.attitude, &error), &error);
    bench_require(srp_force_radiation(&params, &force, &error), &error);
    add(list, &force);
    *shadow = params.shadow;
    return list;
}

typedef struct outcome {
    srp_vec3 r;
    srp_propagator_counts counts;
    double seconds;
} outcome;

static outcome propagate(const srp_force_list *list, const srp_shadow *shadow) {
    srp_propagator_params params = srp_propagator_params_default();
    srp_propagator *p = NULL;
    srp_error error;
    outcome out;
    params.shadow_edges = true;
    params.shadow = *shadow;
    const srp_elements el = {42164.17e3, 2e-4, 9e-4, 1.48, 0.17, 2.1};
    srp_vec3 r, v;
    bench_require(srp_elements_to_state(MU, &el, &r, &v, &error), &error);
    bench_require(srp_propagator_create(list, &params, &p, &error), &error);
    bench_require(srp_propagator_start(p, 0.0, r, v, &error), &error);
    const double began = bench_now();
    bench_require(srp_propagator_advance(p, DAYS * 86400.0, NULL, &error), &error);
    out.seconds = bench_now() - began;
    out.r = srp_propagator_position(p);
    out.counts = srp_propagator_get_counts(p);
    srp_propagator_destroy(p);
    return out;
}

static void print_row(double step, const char *name, const outcome *got, const outcome *exact) {
    if (step > 0.0) {
        printf("| %g | %s |", step, name);
    } else {
        printf("| - | %s |", name);
    }
    printf(" %.3g | %llu | %llu | %llu | %.2f |\n", srp_vec3_norm(srp_vec3_sub(got->r, exact->r)),
           (unsigned long long)got->counts.steps, (unsigned long long)got->counts.rejected,
           (unsigned long long)got->counts.calls, 1e6 * got->seconds / (double)got->counts.calls);
    fflush(stdout);
}

static srp_table *make_table(const srp_prepared *prepared, double step) {
    srp_grid grid;
    srp_table *table = NULL;
    srp_error error;
    bench_require(srp_grid_from_steps(step, step, &grid, &error), &error);
    bench_require(srp_table_create(prepared, grid, false, &table, &error), &error);
    bench_require(srp_table_fill(table, prepared, NULL, &error), &error);
    return table;
}

static srp_area_model model_of(const srp_interp_scheme *scheme, const srp_table *table) {
    srp_interp *interp = NULL;
    srp_area_model model;
    srp_error error;
    bench_require(srp_interp_create(scheme, table, &interp, &error), &error);
    bench_require(srp_area_model_interp(interp, &model, &error), &error);
    return model;
}

static void compare_tables(const srp_ephemeris *sky, const srp_prepared *prepared) {
    static const double STEPS[] = {15.0, 10.0, 5.0, 2.0, 1.0};
    srp_area_model model;
    srp_shadow shadow;
    srp_error error;
    size_t count;
    const srp_interp_scheme *const *schemes = srp_interp_list(&count);
    printf(
        "| step [deg] | interpolant | off after 30 days [m] | steps | rejected | calls | us a call "
        "|\n|---|---|---|---|---|---|---|\n");
    bench_require(srp_area_model_direct(prepared, &model, &error), &error);
    srp_force_list *list = make_list(sky, NULL, &model, &shadow);
    const outcome exact = propagate(list, &shadow);
    print_row(0.0, "none: exact", &exact, &exact);
    srp_force_list_destroy(list);
    for (size_t k = 0; k < sizeof STEPS / sizeof STEPS[0]; ++k) {
        srp_table *table = make_table(prepared, STEPS[k]);
        for (size_t i = 0; i < count; ++i) {
            model = model_of(schemes[i], table);
            list = make_list(sky, NULL, &model, &shadow);
            const outcome got = propagate(list, &shadow);
            print_row(STEPS[k], schemes[i]->name, &got, &exact);
            srp_force_list_destroy(list);
        }
        srp_table_destroy(table);
    }
}

/* ---- Time of a call ----------------------------------------------------------------------------
 */

/* Coefficients by Kaula's rule, 1e-5 / n^2. */
static srp_gravity *make_field(unsigned degree) {
    static char text[60000];
    size_t used = (size_t)sprintf(text,
                                  "earth_gravity_constant %.17g\nradius 6378136.3\nend_of_head\n"
                                  "gfc 0 0 1 0\n",
                                  MU);
    for (unsigned n = 2; n <= degree; ++n) {
        for (unsigned m = 0; m <= n; ++m) {
            used += (size_t)sprintf(text + used, "gfc %u %u %.9e %.9e\n", n, m,
                                    1e-5 / (n * n) * cos(7.0 * n + m),
                                    m > 0 ? 1e-5 / (n * n) * sin(7.0 * n + m) : 0.0);
        }
    }
    srp_gravity *out = NULL;
    srp_error error;
    bench_require(srp_gravity_parse(text, used, "made up", degree, degree, NULL, &out, &error),
                  &error);
    return out;
}

enum { CALLS = 100000, ROUNDS = 7 };

/* Least time of a call [us] of all forces; of the last alone; of its model alone. */
static void time_list(const srp_force_list *list, const srp_area_model *model, double out[3]) {
    srp_vec3 bodies[SRP_CELESTIAL_COUNT];
    const srp_force *light = srp_force_list_get(list, srp_force_list_count(list) - 1);
    double sink = 0.0;
    out[0] = out[1] = out[2] = INFINITY;
    srp_ephemeris_positions(srp_force_list_ephemeris(list), SRP_EARTH, 1000.0, bodies);
    for (int round = 0; round < ROUNDS; ++round) {
        for (int part = 0; part < 3; ++part) {
            const double began = bench_now();
            for (int i = 0; i < CALLS; ++i) {
                const double a = 6.283185307179586 * i / 97.0, t = 20.0 * i;
                const srp_vec3 r = {4.2e7 * cos(a), 4.2e7 * sin(a), 1e4},
                               v = {-3e3 * sin(a), 3e3 * cos(a), 9};
                srp_force_sum sum = {.partials = false};
                if (part == 0) {
                    srp_force_list_eval(list, t, r, v, &sum, NULL);
                } else if (part == 1) {
                    const srp_force_state state = {t, r, v, bodies};
                    light->eval(light->user, &state, &sum);
                } else {
                    const srp_vec3 s = {cos(a), sin(a) * 0.8, sin(a) * 0.6};
                    model->eval(model->user, s, &sum.a, NULL);
                }
                sink += sum.a.x;
            }
            out[part] = fmin(out[part], 1e6 * (bench_now() - began) / CALLS);
        }
    }
    if (isnan(sink)) {
        exit(3);
    }
}

static void time_calls(const srp_ephemeris *sky, const srp_prepared *prepared) {
    srp_table *table = make_table(prepared, 5.0);
    srp_gravity *field = make_field(20);
    for (int with_field = 0; with_field < 2; ++with_field) {
        srp_area_model model = model_of(&srp_interp_spline, table);
        srp_shadow shadow;
        double us[3];
        srp_force_list *list = make_list(sky, with_field ? field : NULL, &model, &shadow);
        time_list(list, &model, us);
        printf("%s: %.3f us a call of all forces; radiation pressure %.3f us, %.1f %% (attitude, "
               "shadow, "
               "look-up); the look-up %.4f us, %.1f %%\n",
               with_field ? "field of 20 x 20, Sun, Moon" : "points Earth, Sun, Moon", us[0], us[1],
               100.0 * us[1] / us[0], us[2], 100.0 * us[2] / us[0]);
        srp_force_list_destroy(list);
    }
    srp_gravity_destroy(field);
    srp_table_destroy(table);
}

int main(void) {
    gsl_set_error_handler_off();
    srp_method_params params = srp_method_params_default();
    srp_ephemeris *sky = make_sky();
    srp_error error;
    srp_scene *scene = NULL;
    const char *path = SRP_MODELS_DIR "/box-wing.obj";
    bench_require(srp_scene_read_obj(&path, 1, NULL, NULL, NULL, &scene, &error), &error);
    params.threads = 1;
    srp_prepared *prepared = bench_prepare(&srp_method_exact, scene, &params);
    time_calls(sky, prepared);
    printf("\n");
    compare_tables(sky, prepared);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
    srp_ephemeris_destroy(sky);
    return 0;
}
