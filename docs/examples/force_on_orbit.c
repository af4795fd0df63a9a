/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Radiation pressure for an integrator: a table is read, or computed from a mesh, an interpolant is
 * made of it, and asked with the direction of the Sun in body axes.
 *
 *     force_on_orbit MODEL.obj     or     force_on_orbit TABLE.nc
 *
 * Build it against an installed srpcore with CMake,
 *
 *     find_package(srpcore 0.1 REQUIRED COMPONENTS shared)
 *     target_link_libraries(force_on_orbit PRIVATE srpcore::shared m)
 *
 * or with pkg-config:
 *
 *     cc -std=c11 force_on_orbit.c $(pkg-config --cflags --libs srpcore) -lm
 */
#include <srp/interp.h>
#include <srp/method.h>
#include <srp/scene.h>
#include <srp/sunlight.h>
#include <srp/table.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double EARTH_RADIUS = 6378136.3;  /* [m] */
static const double ORBIT_RADIUS = 42164172.0; /* [m] */
static const double MASS = 850.0;              /* [kg] */

static void require(srp_status status, const srp_error *error) {
    if (status != SRP_OK) {
        char text[1400];
        srp_error_format(error, text, sizeof text);
        fprintf(stderr, "%s\n", text);
        exit(1);
    }
}

/* First hits by `exact`, every 5 degrees; moments about the origin of the mesh. */
static srp_table *compute_table(const char *model) {
    srp_error error;
    srp_scene *scene = NULL;
    srp_prepared *prepared = NULL;
    srp_table *table = NULL;
    srp_grid grid;
    srp_method_params params = srp_method_params_default();
    require(srp_scene_read_obj(&model, 1, NULL, NULL, NULL, &scene, &error), &error);
    require(srp_method_prepare(&srp_method_exact, scene, &params, &prepared, &error), &error);
    require(srp_grid_from_steps(5.0, 5.0, &grid, &error), &error);
    require(srp_table_create(prepared, grid, false, &table, &error), &error);
    require(srp_table_fill(table, prepared, NULL, &error), &error);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
    return table;
}

static srp_interp *make_interpolant(const char *path) {
    srp_error error;
    srp_table *table = NULL;
    srp_interp *interp = NULL;
    const srp_table_format *format = srp_table_format_of(path);
    if (format != NULL) {
        require(srp_table_read(format, path, &table, &error), &error);
    } else {
        table = compute_table(path);
    }
    require(srp_interp_create(&srp_interp_spline, table, &interp, &error), &error);
    srp_table_destroy(table); /* the interpolant has what it needs */
    return interp;
}

/*
 * What a force model does at each call. `sun` and `earth` are positions relative to the spacecraft
 * [m] in body axes; how they are found is the integrator's business. Any number of threads may do
 * this with one interpolant.
 */
static srp_status acceleration(const srp_interp *interp, srp_vec3 sun, srp_vec3 earth, srp_vec3 *a,
                               srp_interp_jacobian *slopes, double *seen, srp_error *error) {
    const double distance = srp_vec3_norm(sun);
    const srp_vec3 s = srp_vec3_scale(1.0 / distance, sun);
    const srp_body occulting = {earth, EARTH_RADIUS};
    srp_vec3 f, t;
    srp_status status = srp_interp_eval(interp, s, &f, &t, slopes, error);
    if (status != SRP_OK) {
        return status;
    }
    *seen = srp_sunlight_fraction(sun, SRP_SUN_RADIUS, 1, &occulting);
    *a = srp_vec3_scale(*seen * srp_sunlight_pressure(srp_sunlight_default(), distance) / MASS, f);
    return SRP_OK;
}

/* A spacecraft that points +Z at the Earth's centre, the Sun in the plane of its orbit; the angle
 * is that from local noon. */
int main(int argc, char **argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: %s MODEL.obj|TABLE.nc\n", argv[0]);
        return 2;
    }
    srp_interp *interp = make_interpolant(argv[1]);
    printf("   deg     seen       ax           ay           az [m/s^2]    d fx/d sx [m^2]\n");
    for (double deg = 0.0; deg < 360.0; deg += 30.0) {
        const double angle = deg * SRP_RAD_PER_DEG;
        const srp_vec3 earth = srp_vec3_make(0.0, 0.0, ORBIT_RADIUS);
        const srp_vec3 from_earth = srp_vec3_make(SRP_AU * sin(angle), 0.0, -SRP_AU * cos(angle));
        srp_vec3 a;
        srp_interp_jacobian slopes;
        double seen;
        srp_error error;
        require(acceleration(interp, srp_vec3_add(earth, from_earth), earth, &a, &slopes, &seen,
                             &error),
                &error);
        printf("%6.1f   %6.4f  %11.4e  %11.4e  %11.4e  %11.4f\n", deg, seen, a.x, a.y, a.z,
               slopes.df[0][0]);
    }
    srp_interp_destroy(interp);
    return 0;
}
