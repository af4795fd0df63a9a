/* SPDX-License-Identifier: Apache-2.0 */
/* Forces: closed forms, partials beside differences, lists. */
#include "mat3.h"
#include "orbit_fixture.h"

#include <srp/interp.h>
#include <srp/method.h>
#include <srp/scene.h>
#include <srp/table.h>

static srp_ephemeris *sky;

static void set_up(void) {
    sky = fixture_sky("2024-03-20T00:00:00 UTC", 1.0);
}

static void tear_down(void) {
    srp_ephemeris_destroy(sky);
}

static const srp_vec3 R = {3.1e7, -2.2e7, 1.7e7}, V = {1.3e3, 2.6e3, 0.4e3};

/* Largest difference between the partials of a list and central differences, over their norm. */
static void check_partials(const srp_force_list *list, double t, srp_vec3 r, srp_vec3 v, double h_r,
                           double h_v, double tolerance) {
    srp_force_sum sum = {.partials = true};
    ck_assert_int_eq(srp_force_list_eval(list, t, r, v, &sum, NULL), 0);
    for (int of_v = 0; of_v < 2; ++of_v) {
        double off = 0.0, size = 0.0;
        double(*const got)[3] = of_v ? sum.da_dv : sum.da_dr;
        for (int j = 0; j < 3; ++j) {
            srp_vec3 column = {0, 0, 0};
            /* Fourth order. */
            for (int k = 1; k <= 2; ++k) {
                const double h = k * (of_v ? h_v : h_r);
                const srp_vec3 step = srp_vec3_scale(h, srp_axis(j));
                srp_force_sum up = {.partials = false}, down = {.partials = false};
                ck_assert_int_eq(srp_force_list_eval(list, t, of_v ? r : srp_vec3_add(r, step),
                                                     of_v ? srp_vec3_add(v, step) : v, &up, NULL),
                                 0);
                ck_assert_int_eq(srp_force_list_eval(list, t, of_v ? r : srp_vec3_sub(r, step),
                                                     of_v ? srp_vec3_sub(v, step) : v, &down, NULL),
                                 0);
                column = srp_vec3_add_scaled(column, (k == 1 ? 4.0 : -1.0) / (3.0 * 2.0 * h),
                                             srp_vec3_sub(up.a, down.a));
            }
            off = fmax(off, srp_vec3_norm(
                                srp_vec3_sub(column, srp_mat3_column((const double(*)[3])got, j))));
            size = fmax(size, srp_vec3_norm(column));
        }
        ck_assert_msg(off <= tolerance * size, "%s: %.3g of %.3g", of_v ? "da/dv" : "da/dr", off,
                      size);
    }
}

START_TEST(point_masses_have_their_partials) {
    srp_force_list *list = fixture_list(sky, false);
    check_partials(list, 100.0, R, V, 1e3, 1.0, 1e-9);
    srp_force_list_destroy(list);
    list = fixture_list(sky, true);
    check_partials(list, 100.0, R, V, 1e3, 1.0, 1e-9);
    srp_force_list_destroy(list);
}
END_TEST

START_TEST(the_sun_pulls_by_its_tide) {
    /* 2 mu r / d^3 towards and away, mu r / d^3 across: to terms of r / d. */
    srp_force_list *list = NULL;
    srp_force force;
    srp_error error;
    const double mu = srp_celestial_get(SRP_SUN)->mu;
    assert_ok(srp_force_list_create(sky, SRP_EARTH, &list, &error), error);
    assert_ok(srp_force_point_mass(SRP_SUN, mu, &force, &error), error);
    fixture_add(list, &force);
    const srp_vec3 sun = srp_ephemeris_position(sky, SRP_SUN, 500.0), n = srp_unit(sun);
    const double d = srp_vec3_norm(sun), r = 4.2e7;
    const srp_vec3 side = srp_unit(srp_vec3_cross(n, srp_axis(0)));
    srp_force_sum sum = {.partials = false};
    ck_assert_int_eq(srp_force_list_eval(list, 500.0, srp_vec3_scale(r, n), V, &sum, NULL), 0);
    assert_vec3_close(sum.a, srp_vec3_scale(2.0 * mu * r / (d * d * d), n), 5.0 * r / d, 0.0);
    ck_assert_int_eq(srp_force_list_eval(list, 500.0, srp_vec3_scale(r, side), V, &sum, NULL), 0);
    assert_vec3_close(sum.a, srp_vec3_scale(-mu * r / (d * d * d), side), 5.0 * r / d, 0.0);
    srp_force_list_destroy(list);
}
END_TEST

/* ---- Radiation --------------------------------------------------------------------------------
 */

static srp_attitude attitude_of(int kind) {
    srp_attitude out = {"none", 0, NULL, NULL, NULL};
    srp_error error;
    const double q[4] = {0.1, 0.2, -0.3, 0.9};
    const srp_attitude_pointing nadir = {
        SRP_TARGET_NADIR, {0, 0, 1}, SRP_TARGET_ORBIT_NORMAL, {0, 1, 0}};
    const srp_attitude_pointing yaw = {SRP_TARGET_NADIR, {0, 0, 1}, SRP_TARGET_SUN, {1, 0, 0}};
    const srp_attitude_pointing sun = {SRP_TARGET_SUN, {1, 2, 3}, SRP_TARGET_VELOCITY, {1, 0, 0}};
    if (kind == 0) {
        assert_ok(srp_attitude_inertial(q, &out, &error), error);
    } else if (kind == 1) {
        assert_ok(srp_attitude_spinner(q, srp_axis(1), 0.01, &out, &error), error);
    } else {
        assert_ok(srp_attitude_pointing_create(kind == 2   ? &nadir
                                               : kind == 3 ? &yaw
                                                           : &sun,
                                               &out, &error),
                  error);
    }
    return out;
}

static srp_force_list *radiation_alone(int kind) {
    srp_force_list *list = NULL;
    srp_force force;
    srp_error error;
    const srp_attitude attitude = attitude_of(kind);
    const srp_radiation_params params = fixture_radiation(&attitude);
    assert_ok(srp_force_list_create(sky, SRP_EARTH, &list, &error), error);
    assert_ok(srp_force_radiation(&params, &force, &error), error);
    fixture_add(list, &force);
    return list;
}

START_TEST(radiation_has_its_partials) {
    srp_force_list *list = radiation_alone(_i);
    check_partials(list, 100.0, R, V, 300.0, 0.1, 1e-6);
    srp_force_list_destroy(list);
}
END_TEST

/* Half the Sun hidden: the gradient is that of the shadow. */
START_TEST(radiation_has_its_partials_in_penumbra) {
    srp_force_list *list = radiation_alone(_i);
    const srp_vec3 n = srp_unit(srp_ephemeris_position(sky, SRP_SUN, 100.0));
    const srp_vec3 side = srp_unit(srp_vec3_cross(n, srp_axis(2)));
    const srp_vec3 r = srp_vec3_add(srp_vec3_scale(-4.1e7, n), srp_vec3_scale(6.35e6, side));
    srp_force_sum sum = {.partials = false};
    srp_vec3 light;
    ck_assert_int_eq(srp_force_list_eval(list, 100.0, r, V, &sum, &light), 0);
    assert_vec3_close(sum.a, light, 0.0, 0.0);
    ck_assert(srp_vec3_norm(light) > 0.0);
    check_partials(list, 100.0, r, V, 100.0, 0.1, 2e-6);
    srp_force_list_destroy(list);
}
END_TEST

START_TEST(radiation_is_p_f_over_m) {
    const srp_attitude attitude = attitude_of(2);
    srp_radiation_params params = fixture_radiation(&attitude);
    srp_force force;
    srp_error error;
    assert_ok(srp_force_radiation(&params, &force, &error), error);
    srp_vec3 bodies[SRP_CELESTIAL_COUNT];
    srp_ephemeris_positions(sky, SRP_EARTH, 100.0, bodies);
    const srp_force_state state = {100.0, R, V, bodies};
    srp_radiation_probe probe;
    ck_assert_int_eq(srp_force_radiation_probe(&force, &state, &probe), 0);
    assert_close(probe.seen, 1.0, 0.0, 0.0);
    const srp_vec3 sun = srp_vec3_sub(bodies[SRP_SUN], R);
    assert_vec3_close(probe.s_body, srp_mat3_apply((const double(*)[3])probe.matrix, srp_unit(sun)),
                      1e-15, 0.0);
    srp_vec3 f;
    fixture_area(NULL, probe.s_body, &f, NULL);
    assert_vec3_close(probe.f, f, 1e-15, 0.0);
    const double p = 1367.0 / 299792458.0 * pow(149597870700.0 / srp_vec3_norm(sun), 2.0);
    assert_vec3_close(probe.a,
                      srp_vec3_scale(1.1 * p / 170.0, srp_mat3_apply_transposed(
                                                          (const double(*)[3])probe.matrix, f)),
                      1e-14, 0.0);
    srp_force_sum sum = {.partials = false};
    ck_assert_int_eq(force.eval(force.user, &state, &sum), 0);
    assert_vec3_close(sum.a, probe.a, 1e-15, 0.0);
    /* Behind the Earth. */
    srp_force_state dark = state;
    dark.r = srp_vec3_scale(-4.2e7, srp_unit(bodies[SRP_SUN]));
    ck_assert_int_eq(srp_force_radiation_probe(&force, &dark, &probe), 0);
    assert_close(probe.seen, 0.0, 0.0, 0.0);
    assert_vec3_close(probe.a, srp_vec3_make(0, 0, 0), 0.0, 0.0);
    srp_force_release(&force);
}
END_TEST

static int no_attitude(const void *user, const srp_force_state *state, double matrix[3][3]) {
    (void)user;
    (void)state;
    (void)matrix;
    return -1;
}

/* An attitude may have gaps, and yaw steering has none where Sun and nadir are in line: in the dark
 * it is not missed. */
START_TEST(radiation_needs_no_attitude_in_the_dark) {
    const srp_attitude attitude = {"none", 0, no_attitude, NULL, NULL};
    srp_radiation_params params = fixture_radiation(&attitude);
    srp_force force;
    srp_error error;
    assert_ok(srp_force_radiation(&params, &force, &error), error);
    srp_vec3 bodies[SRP_CELESTIAL_COUNT];
    srp_ephemeris_positions(sky, SRP_EARTH, 100.0, bodies);
    const srp_vec3 n = srp_unit(bodies[SRP_SUN]);
    srp_force_state state = {100.0, srp_vec3_scale(-4.2e7, n), V, bodies};
    srp_force_sum sum = {.partials = false};
    ck_assert_int_eq(force.eval(force.user, &state, &sum), 0);
    assert_vec3_close(sum.a, srp_vec3_make(0, 0, 0), 0.0, 0.0);
    state.r = srp_vec3_scale(4.2e7, n);
    ck_assert_int_eq(force.eval(force.user, &state, &sum), -1);
    srp_force_release(&force);
}
END_TEST

START_TEST(radiation_refuses_nonsense) {
    srp_force force = {"untouched", 0, NULL, NULL, NULL};
    srp_error error;
    srp_radiation_params params = fixture_radiation(NULL);
    params.mass = 0.0;
    ck_assert_int_eq(srp_force_radiation(&params, &force, &error), SRP_BAD_ARGUMENT);
    params.mass = 1.0;
    params.scale = NAN;
    ck_assert_int_eq(srp_force_radiation(&params, &force, &error), SRP_BAD_ARGUMENT);
    params.scale = 1.0;
    params.model.flags = 0; /* and no attitude */
    ck_assert_int_eq(srp_force_radiation(&params, &force, &error), SRP_BAD_ARGUMENT);
    ck_assert_str_eq(force.name, "untouched");
    srp_area_model model;
    ck_assert_int_eq(srp_area_model_cannonball(-1.0, 1.0, &model, &error), SRP_BAD_ARGUMENT);
    ck_assert_int_eq(srp_area_model_cannonball(1.0, 0.0, &model, &error), SRP_BAD_ARGUMENT);
    ck_assert_int_eq(srp_area_model_interp(NULL, &model, &error), SRP_BAD_ARGUMENT);
    ck_assert_int_eq(srp_area_model_direct(NULL, &model, &error), SRP_BAD_ARGUMENT);
    ck_assert_int_eq(srp_force_central(-1.0, &force, &error), SRP_BAD_ARGUMENT);
    ck_assert_int_eq(srp_force_point_mass((srp_celestial)77, 1.0, &force, &error),
                     SRP_BAD_ARGUMENT);
}
END_TEST

/* ---- Area models ------------------------------------------------------------------------------
 */

static void check_slopes(const srp_area_model *model, double tolerance) {
    uint64_t random = 17;
    for (int i = 0; i < 50; ++i) {
        const srp_vec3 s = random_direction(&random);
        srp_vec3 f, up, down;
        double df[3][3];
        ck_assert_int_eq(model->eval(model->user, s, &f, df), 0);
        for (int j = 0; j < 3; ++j) {
            const double h = 1e-6;
            const srp_vec3 a = srp_unit(srp_vec3_add_scaled(s, h, srp_axis(j)));
            const srp_vec3 b = srp_unit(srp_vec3_add_scaled(s, -h, srp_axis(j)));
            ck_assert_int_eq(model->eval(model->user, a, &up, NULL), 0);
            ck_assert_int_eq(model->eval(model->user, b, &down, NULL), 0);
            const srp_vec3 want = srp_vec3_scale(0.5 / h, srp_vec3_sub(up, down));
            assert_vec3_close(srp_mat3_column((const double(*)[3])df, j), want, 0.0,
                              tolerance * srp_vec3_norm(f));
        }
    }
}

/* A table of a box of plates. */
static srp_table *make_table(srp_scene **scene, srp_prepared **prepared, double step) {
    srp_plate plates[6];
    srp_method_params params = srp_method_params_default();
    srp_table *table = NULL;
    srp_grid grid;
    srp_error error;
    for (int i = 0; i < 6; ++i) {
        const double sign = i % 2 == 0 ? 1.0 : -1.0;
        plates[i] = (srp_plate){srp_vec3_scale(sign, srp_axis(i / 2)), 3.0 + i, {0.2, 0.3, false}};
    }
    params.threads = 1;
    assert_ok(srp_scene_from_plates(plates, 6, scene, &error), error);
    assert_ok(srp_method_prepare(&srp_method_nplate, *scene, &params, prepared, &error), error);
    assert_ok(srp_grid_from_steps(step, step, &grid, &error), error);
    assert_ok(srp_table_create(*prepared, grid, false, &table, &error), error);
    assert_ok(srp_table_fill(table, *prepared, NULL, &error), error);
    return table;
}

START_TEST(area_models_have_their_slopes) {
    srp_scene *scene = NULL;
    srp_prepared *prepared = NULL;
    srp_table *table = make_table(&scene, &prepared, 10.0);
    srp_area_model model;
    srp_error error;
    assert_ok(srp_area_model_cannonball(1.4, 7.0, &model, &error), error);
    check_slopes(&model, 1e-8);
    srp_area_model_release(&model);
    assert_ok(srp_area_model_direct(prepared, &model, &error), error);
    check_slopes(&model, 1e-6);
    srp_area_model_release(&model);
    for (int cubic = 0; cubic < 2; ++cubic) {
        assert_ok(srp_area_model_spad(table, cubic != 0, &model, &error), error);
        check_slopes(&model, 1e-5);
        srp_area_model_release(&model);
    }
    size_t count;
    const srp_interp_scheme *const *schemes = srp_interp_list(&count);
    for (size_t i = 0; i < count; ++i) {
        srp_interp *interp = NULL;
        assert_ok(srp_interp_create(schemes[i], table, &interp, &error), error);
        assert_ok(srp_area_model_interp(interp, &model, &error), error);
        ck_assert_str_eq(model.name, schemes[i]->name);
        check_slopes(&model, 1e-5);
        srp_area_model_release(&model);
    }
    srp_table_destroy(table);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}
END_TEST

/* At the nodes, GMAT's schemes give what the table has; between them, lines and cubics come out. */
START_TEST(gmat_schemes_meet_their_nodes) {
    srp_scene *scene = NULL;
    srp_prepared *prepared = NULL;
    srp_table *table = make_table(&scene, &prepared, 15.0);
    srp_error error;
    for (int cubic = 0; cubic < 2; ++cubic) {
        srp_area_model model;
        assert_ok(srp_area_model_spad(table, cubic != 0, &model, &error), error);
        for (uint32_t i = 0; i < 25; ++i) {
            for (uint32_t j = 1; j < 12; ++j) { /* poles: azimuth is lost */
                const double az = (-180.0 + 15.0 * i) * SRP_RAD_PER_DEG;
                const double el = (-90.0 + 15.0 * j) * SRP_RAD_PER_DEG;
                srp_vec3 f;
                ck_assert_int_eq(
                    model.eval(model.user,
                               srp_vec3_make(cos(el) * cos(az), cos(el) * sin(az), sin(el)), &f,
                               NULL),
                    0);
                assert_vec3_close(f, srp_table_node(table, i, j)->f, 1e-12, 0.0);
            }
        }
        srp_vec3 f;
        ck_assert_int_eq(model.eval(model.user, srp_axis(2), &f, NULL), 0);
        assert_vec3_close(f, srp_table_node(table, 12, 12)->f, 1e-12, 0.0);
        ck_assert_int_ne(model.eval(model.user, srp_vec3_make(NAN, 0, 0), &f, NULL), 0);
        srp_area_model_release(&model);
    }
    srp_table_destroy(table);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}
END_TEST

/* A table whose nodes are drawn at random, each by itself: poles and the ends of azimuth disagree.
 */
static srp_table *random_table(uint64_t *random) {
    static char text[20000];
    srp_table *table = NULL;
    srp_error error;
    size_t used = (size_t)snprintf(
        text, sizeof text,
        "Version : 4.27\nSystem : t\nAnalysis Type : Area\nPressure : 1\nMotion : 1\n Name : "
        "Azimuth\n Method : Step\n Minimum : -180\n Maximum : 180\n Step : 30\nMotion : 2\n Name : "
        "Elevation\n Method : Step\n Minimum : -90\n Maximum : 90\n Step : 30\n: END\nRecord count "
        ": 91\n\nAzimuth Elevation Force(X) Force(Y) Force(Z)\ndegrees degrees m^2 m^2 m^2\n");
    for (int i = 0; i < 91; ++i) {
        const srp_vec3 f = random_direction(random);
        used += (size_t)snprintf(text + used, sizeof text - used, "%d %d %.17g %.17g %.17g\n",
                                 -180 + 30 * (i / 7), -90 + 30 * (i % 7), f.x, f.y, f.z);
    }
    assert_ok(srp_table_parse_spo(text, used, "t.spo", &table, &error), error);
    return table;
}

/* The rules of GMAT R2020a in its own words, degrees: the cubic's coefficients from four values, an
 * azimuth beyond 180 less a turn, an elevation beyond 90 on the other side. */
static srp_vec3 gmat_bicubic(const srp_table *table, double az, double el) {
    static const double C[4][4] = {{-1.0 / 6, 1.0 / 2, -1.0 / 2, 1.0 / 6},
                                   {1.0 / 2, -1.0, 1.0 / 2, 0.0},
                                   {-1.0 / 3, -1.0 / 2, 1.0, -1.0 / 6},
                                   {0.0, 1.0, 0.0, 0.0}};
    const double low_az = floor((az + 180.0) / 30.0) * 30.0 - 180.0;
    const double low_el = floor((el + 90.0) / 30.0) * 30.0 - 90.0;
    const double x = (az - low_az) / 30.0, y = (el - low_el) / 30.0;
    const double px[4] = {x * x * x, x * x, x, 1.0}, py[4] = {y * y * y, y * y, y, 1.0};
    srp_vec3 sum = {0, 0, 0};
    for (int j = 0; j < 4; ++j) {
        for (int k = 0; k < 4; ++k) {
            double a = low_az + 30.0 * (j - 1), e = low_el + 30.0 * (k - 1), weight = 0.0;
            a += a > 180.0 ? -360.0 : a < -180.0 ? 360.0 : 0.0;
            if (e > 90.0) {
                e = 180.0 - e;
                a += a > 0.0 ? -180.0 : 180.0;
            }
            for (int m = 0; m < 4; ++m) {
                for (int n = 0; n < 4; ++n) {
                    weight += px[m] * C[m][j] * py[n] * C[n][k];
                }
            }
            const srp_response *node = srp_table_node(table, (uint32_t)lround((a + 180.0) / 30.0),
                                                      (uint32_t)lround((e + 90.0) / 30.0));
            sum = srp_vec3_add_scaled(sum, weight, node->f);
        }
    }
    return sum;
}

START_TEST(gmat_bicubic_is_gmats) {
    uint64_t random = 23;
    srp_table *table = random_table(&random);
    srp_area_model model;
    srp_error error;
    assert_ok(srp_area_model_spad(table, true, &model, &error), error);
    for (int i = 0; i < 2000; ++i) {
        const srp_vec3 s = random_direction(&random);
        const double az = atan2(s.y, s.x) / SRP_RAD_PER_DEG, el = asin(s.z) / SRP_RAD_PER_DEG;
        srp_vec3 f;
        ck_assert_int_eq(model.eval(model.user, s, &f, NULL), 0);
        if (el > -60.0) { /* GMAT gives up nearer to that pole */
            assert_vec3_close(f, gmat_bicubic(table, az, el), 0.0, 1e-12);
        }
    }
    srp_area_model_release(&model);
    srp_table_destroy(table);
}
END_TEST

/* ---- Lists ------------------------------------------------------------------------------------
 */

static int destroyed;

static int push(const void *user, const srp_force_state *state, srp_force_sum *sum) {
    const double limit = *(const double *)user;
    sum->a.x += 1.0;
    return state->t > limit ? -7 : state->t > 0.5 * limit ? 3 : 0;
}

static void count_destroyed(void *user) {
    (void)user;
    ++destroyed;
}

START_TEST(a_list_sums_what_users_bring) {
    static double limit = 100.0;
    srp_force_list *list = NULL;
    srp_error error;
    assert_ok(srp_force_list_create(sky, SRP_EARTH, &list, &error), error);
    for (int i = 0; i < 9; ++i) {
        const srp_force force = {"push", i == 0 ? SRP_FORCE_RADIATION : 0, push, count_destroyed,
                                 &limit};
        fixture_add(list, &force);
    }
    srp_force_sum sum = {.partials = false};
    srp_vec3 light;
    ck_assert_int_eq(srp_force_list_eval(list, 0.0, R, V, &sum, &light), 0);
    assert_close(sum.a.x, 9.0, 0.0, 0.0);
    assert_close(light.x, 1.0, 0.0, 0.0);
    ck_assert_int_eq(srp_force_list_eval(list, 60.0, R, V, &sum, NULL), 3);
    ck_assert_int_eq(srp_force_list_eval(list, 101.0, R, V, &sum, NULL), -7);
    ck_assert_uint_eq(srp_force_list_count(list), 9);
    ck_assert(srp_force_list_get(list, 9) == NULL);
    srp_force_list_destroy(list);
    ck_assert_int_eq(destroyed, 9);
    srp_force_list_destroy(NULL);
    list = NULL;
    ck_assert_int_eq(srp_force_list_create(sky, SRP_MARS, &list, &error), SRP_BAD_ARGUMENT);
    ck_assert(list == NULL);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("orbit_force");
    TCase *all = tcase_create("force");
    tcase_add_checked_fixture(all, set_up, tear_down);
    tcase_add_test(all, point_masses_have_their_partials);
    tcase_add_test(all, the_sun_pulls_by_its_tide);
    tcase_add_loop_test(all, radiation_has_its_partials, 0, 5);
    tcase_add_loop_test(all, radiation_has_its_partials_in_penumbra, 0, 5);
    tcase_add_test(all, radiation_is_p_f_over_m);
    tcase_add_test(all, radiation_needs_no_attitude_in_the_dark);
    tcase_add_test(all, radiation_refuses_nonsense);
    tcase_add_test(all, area_models_have_their_slopes);
    tcase_add_test(all, gmat_schemes_meet_their_nodes);
    tcase_add_test(all, gmat_bicubic_is_gmats);
    tcase_add_test(all, a_list_sums_what_users_bring);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
