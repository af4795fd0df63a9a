/* SPDX-License-Identifier: Apache-2.0 */
/* What the viewer knows: setups, engines, attitudes, arrows. */
#include "scene_look.h"
#include "session.h"
#include "srp_check.h"

#include <srp/const.h>
#include <srp/table.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char BOX_WING[] = SRP_MODELS_DIR "/box-wing.obj";
static const char PLATES[] = SRP_MODELS_DIR "/box-wing.plates";

static viewer_setup *box_wing(void) {
    viewer_setup *setup = viewer_setup_create();
    ck_assert_ptr_nonnull(setup);
    ck_assert(viewer_setup_set_model(setup, BOX_WING));
    return setup;
}

static void say(viewer_setup *setup, int option, const char *text) {
    viewer_words problem = {""};
    ck_assert_msg(viewer_setup_set_method_option(setup, option, text, &problem), "%s",
                  problem.text);
}

/* ---- setups ---- */

START_TEST(setup_takes_what_the_command_line_takes) {
    viewer_setup *setup = viewer_setup_create();
    viewer_words problem = {""};
    say(setup, METHOD_GRID, "731");
    ck_assert(!viewer_setup_set_method_option(setup, METHOD_GRID, "0", &problem));
    ck_assert_ptr_nonnull(strstr(problem.text, "a whole number from 1 to 32768"));
    ck_assert_str_eq(setup->method_option[METHOD_GRID], "731");
    problem.text[0] = '\0';
    ck_assert(!viewer_setup_set_mass(setup, "-3", &problem));
    ck_assert_ptr_nonnull(strstr(problem.text, "above 0"));
    ck_assert(isnan(setup->mass));
    ck_assert(viewer_setup_set_mass(setup, "857.31", &problem));
    ck_assert(setup->mass == 857.31);
    ck_assert(viewer_setup_set_mass(setup, "", &problem) && isnan(setup->mass));
    problem.text[0] = '\0';
    ck_assert(!viewer_setup_set_material_text(setup, "gold=0.7,0.6", &problem));
    ck_assert_ptr_nonnull(strstr(problem.text, "gold"));
    ck_assert(!viewer_setup_set_material_text(setup, "gold", &problem));
    ck_assert_uint_eq(setup->material_count, 0);
    viewer_setup_destroy(setup);
}
END_TEST

/* What another method uses waits, and is not in the way. */
START_TEST(setup_leaves_out_what_a_method_does_not_use) {
    viewer_setup *setup = box_wing();
    viewer_words problem = {""};
    const srp_method *method;
    srp_method_params params;
    say(setup, METHOD_GRID, "97");
    say(setup, METHOD_REFLECTIONS, "3");
    ck_assert(viewer_setup_choose(setup, &method, &params, &problem));
    ck_assert_str_eq(method->name, "exact");
    say(setup, METHOD_NAME, "raytrace");
    ck_assert_msg(viewer_setup_choose(setup, &method, &params, &problem), "%s", problem.text);
    ck_assert_uint_eq(params.lattice.samples, 97);
    ck_assert_uint_eq(params.reflections, 3);
    say(setup, METHOD_NAME, "nplate");
    ck_assert(!viewer_setup_choose(setup, &method, &params, &problem));
    ck_assert_ptr_nonnull(strstr(problem.text, "--plates"));
    viewer_setup_destroy(setup);
}
END_TEST

START_TEST(setup_as_a_command_line) {
    viewer_setup *setup = viewer_setup_create();
    viewer_words problem = {""};
    ck_assert(viewer_setup_set_model(setup, "my ship.obj"));
    ck_assert(viewer_setup_set_model_option(setup, MODEL_UNIT, "mm", &problem));
    ck_assert(viewer_setup_set_material_text(setup, "gold=0.25,0.125,one-sided", &problem));
    ck_assert(viewer_setup_set_mass(setup, "412.5", &problem));
    say(setup, METHOD_NAME, "raycast");
    say(setup, METHOD_GRID, "97");
    say(setup, METHOD_REFLECTIONS, "3");
    char az[] = "--az", value[] = "-12.5";
    char *const extra[] = {az, value};
    char *line = viewer_setup_command(setup, "force", extra, 2);
    ck_assert_str_eq(line, "srp force 'my ship.obj' --unit mm --material gold=0.25,0.125,one-sided "
                           "--method raycast --grid 97 --mass 412.5 --az -12.5");
    free(line);
    viewer_setup *copy = viewer_setup_copy(setup);
    viewer_setup_destroy(setup);
    line = viewer_setup_command(copy, "table", NULL, 0);
    ck_assert_ptr_nonnull(strstr(line, "srp table 'my ship.obj' --unit mm"));
    free(line);
    viewer_setup_destroy(copy);
}
END_TEST

static void expect_words(const char *text, const char *want) {
    char got[VIEWER_WORDS_SIZE];
    viewer_words_for_window(text, got, sizeof got);
    ck_assert_str_eq(got, want);
}

/* Who looks at a window is told of its fields. */
START_TEST(words_name_fields_and_no_options) {
    expect_words("--grid 0: expected a whole number", "Grid 0: expected a whole number");
    expect_words("--mass -3: expected more", "Mass -3: expected more");
    expect_words("method cannonball needs --cr CR and --area M2",
                 "method cannonball needs Cr and Area");
    expect_words("method nplate needs --plates FILE",
                 "method nplate needs a file by Choose Plates…");
    expect_words("needs the mass of the spacecraft: --mass KG",
                 "needs the mass of the spacecraft: Mass");
    expect_words("as --material NAME=RHO_S,RHO_D", "as Materials");
    expect_words("--max-grid 3 is less than --grid 5", "Max-grid 3 is less than Grid 5");
    expect_words("--reference x: expected", "Moments about x: expected");
    /* What is no field stays as it is. */
    expect_words("'srp convert --flip' turns them round -- or -3",
                 "'srp convert --flip' turns them round -- or -3");
    expect_words("--gridded --", "--gridded --");
    char shorter[8];
    viewer_words_for_window("a--grid 0", shorter, sizeof shorter);
    ck_assert_str_eq(shorter, "aGrid 0");
    viewer_words_for_window("abc--reference", shorter, sizeof shorter);
    ck_assert_str_eq(shorter, "abcMome");
}
END_TEST

/* ---- engines ---- */

/* The way of the command line: srp_scene_read_obj() and the same parameters. */
static srp_response truth(const char *name, double az, double el) {
    const char *const paths[] = {BOX_WING};
    srp_scene *scene;
    srp_prepared *prepared;
    srp_error error;
    srp_response response;
    size_t count;
    const srp_method *const *methods = srp_method_list(&count), *method = NULL;
    srp_method_params params = srp_method_params_default();
    srp_vec3 s = srp_direction_from_deg(az, el);
    for (size_t i = 0; i < count; ++i) {
        method = strcmp(methods[i]->name, name) == 0 ? methods[i] : method;
    }
    ck_assert_int_eq(srp_scene_read_obj(paths, 1, NULL, NULL, NULL, &scene, &error), SRP_OK);
    ck_assert_int_eq(srp_method_prepare(method, scene, &params, &prepared, &error), SRP_OK);
    ck_assert_int_eq(srp_prepared_respond(prepared, 1, &s, &response, NULL, &error), SRP_OK);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
    return response;
}

START_TEST(engine_gives_the_bits_of_the_library) {
    static const char *const names[] = {"exact", "raycast", "raytrace"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        viewer_setup *setup = box_wing();
        say(setup, METHOD_NAME, names[i]);
        viewer_engine *engine = viewer_engine_make(setup, NULL, false);
        ck_assert_ptr_nonnull(engine);
        ck_assert_str_eq(engine->problem.text, "");
        ck_assert(engine->optics_known);
        viewer_force force;
        viewer_words problem = {""};
        ck_assert(viewer_engine_respond(engine, 37.123456789, -21.987654321, &force, &problem));
        srp_response want = truth(names[i], 37.123456789, -21.987654321);
        ck_assert(force.response.f.x == want.f.x && force.response.f.y == want.f.y &&
                  force.response.f.z == want.f.z);
        ck_assert(force.response.t.x == want.t.x && force.response.t.z == want.t.z);
        ck_assert(force.response.f_error == want.f_error);
        ck_assert(force.response.lit_area == want.lit_area);
        viewer_engine_release(engine);
        viewer_setup_destroy(setup);
    }
}
END_TEST

START_TEST(engine_takes_a_known_shape) {
    viewer_setup *setup = box_wing();
    viewer_engine *first = viewer_engine_make(setup, NULL, false);
    viewer_words problem = {""};
    ck_assert(viewer_setup_set_material_text(setup, "cells=0.9,0.05", &problem));
    viewer_engine *second = viewer_engine_make(setup, first->shape, false);
    ck_assert_ptr_eq(first->shape, second->shape);
    ck_assert_str_ne(srp_scene_optics_hash(first->mesh), srp_scene_optics_hash(second->mesh));
    viewer_engine *third = viewer_engine_make(setup, first->shape, true);
    ck_assert_ptr_ne(first->shape, third->shape);
    viewer_engine_release(first);
    srp_optics optics = {0.0, 0.0, false};
    for (size_t i = 0; i < second->shape->info.material_count; ++i) {
        if (strcmp(second->shape->info.materials[i].name, "cells") == 0) {
            ck_assert(viewer_engine_optics(second, i, &optics));
        }
    }
    ck_assert(optics.rho_s == 0.9 && optics.rho_d == 0.05);
    viewer_engine_release(second);
    viewer_engine_release(third);
    viewer_setup_destroy(setup);
}
END_TEST

static void expect_problem(viewer_setup *setup, const char *words, bool has_shape) {
    viewer_engine *engine = viewer_engine_make(setup, NULL, false);
    viewer_force force = {.az_deg = 5.5};
    viewer_words problem = {""};
    ck_assert_ptr_nonnull(engine);
    ck_assert_ptr_null(engine->prepared);
    ck_assert_msg(strstr(engine->problem.text, words) != NULL, "says '%s'", engine->problem.text);
    ck_assert((engine->shape != NULL) == has_shape);
    ck_assert(!viewer_engine_respond(engine, 1.0, 2.0, &force, &problem));
    ck_assert(force.az_deg == 5.5);
    viewer_engine_release(engine);
    viewer_setup_destroy(setup);
}

static void write_file(const char *path, const char *text) {
    FILE *out = fopen(path, "w");
    ck_assert_ptr_nonnull(out);
    fputs(text, out);
    fclose(out);
}

START_TEST(engine_says_what_is_wrong) {
    viewer_setup *setup = viewer_setup_create();
    viewer_setup_set_model(setup, "no-such.obj");
    expect_problem(setup, "no-such.obj", false);
    expect_problem(viewer_setup_create(), "needs an OBJ file", false);
    write_file("broken.obj", "v 1 2 3\nv 1 2 x\n");
    setup = viewer_setup_create();
    viewer_setup_set_model(setup, "broken.obj");
    expect_problem(setup, "broken.obj:2:", false);
    setup = box_wing();
    say(setup, METHOD_NAME, "cannonball");
    expect_problem(setup, "--cr", true);
}
END_TEST

/* Materials without optics are asked for: the shape is there, and answers when they are given. */
START_TEST(engine_waits_for_missing_optics) {
    viewer_setup *setup = viewer_setup_create();
    viewer_words problem = {""};
    viewer_force force;
    write_file("bare.obj", "usemtl foil\nv 0 0 0\nv 1 0 0\nv 0 1.5 0\nf 1 2 3\n");
    viewer_setup_set_model(setup, "bare.obj");
    viewer_engine *engine = viewer_engine_make(setup, NULL, false);
    ck_assert_ptr_nonnull(engine->mesh);
    ck_assert(!engine->optics_known);
    ck_assert_ptr_nonnull(strstr(engine->problem.text, "foil"));
    ck_assert(!viewer_engine_respond(engine, 0.0, 90.0, &force, &problem));
    ck_assert(viewer_setup_set_material_text(setup, "foil=0.25,0", &problem));
    viewer_engine *good = viewer_engine_make(setup, engine->shape, false);
    ck_assert(viewer_engine_respond(good, 0.0, 90.0, &force, &problem));
    assert_close(force.response.f.z, -0.75 * 1.25, 1e-14, 0.0);
    viewer_engine_release(engine);
    viewer_engine_release(good);
    viewer_setup_destroy(setup);
}
END_TEST

/* The mass changes without a new engine, which other threads read. */
START_TEST(mass_is_no_part_of_an_engine) {
    viewer_setup *setup = box_wing();
    viewer_words problem = {""};
    ck_assert(viewer_setup_set_mass(setup, "12", &problem));
    viewer_engine *engine = viewer_engine_make(setup, NULL, false);
    ck_assert(isnan(engine->setup->mass) && setup->mass == 12.0);
    viewer_engine_release(engine);
    viewer_setup_destroy(setup);
}
END_TEST

START_TEST(engine_misses_an_mtl) {
    viewer_setup *setup = viewer_setup_create();
    viewer_words problem = {""};
    write_file("lost.obj",
               "mtllib no-such.mtl\nusemtl foil\nv 0 0 0\nv 1 0 0\nv 0 1.5 0\nf 1 2 3\n");
    viewer_setup_set_model(setup, "lost.obj");
    viewer_engine *engine = viewer_engine_make(setup, NULL, false);
    ck_assert_ptr_nonnull(viewer_engine_missing_mtl(engine));
    ck_assert_ptr_nonnull(strstr(viewer_engine_missing_mtl(engine), "no-such.mtl"));
    const char *file = strstr(engine->problem.text, "no-such.mtl does not exist");
    const char *material = strstr(engine->problem.text, "'foil' has no optics");
    ck_assert_msg(file != NULL && material != NULL && file < material, "%s", engine->problem.text);
    /* Nothing is missed once the optics are known. */
    ck_assert(viewer_setup_set_material_text(setup, "foil=0.25,0", &problem));
    viewer_engine *good = viewer_engine_make(setup, engine->shape, false);
    ck_assert_str_eq(good->problem.text, "");
    ck_assert_ptr_null(viewer_engine_missing_mtl(good));
    ck_assert_ptr_null(viewer_engine_missing_mtl(NULL));
    viewer_engine_release(engine);
    viewer_engine_release(good);
    viewer_setup_destroy(setup);
}
END_TEST

START_TEST(engine_of_plates_and_ball) {
    viewer_setup *setup = box_wing();
    viewer_words problem = {""};
    viewer_force force;
    say(setup, METHOD_NAME, "nplate");
    ck_assert(viewer_setup_set_model_option(setup, MODEL_PLATES, PLATES, &problem));
    viewer_engine *engine = viewer_engine_make(setup, NULL, false);
    ck_assert_str_eq(engine->problem.text, "");
    ck_assert_ptr_nonnull(engine->mesh); /* still to be looked at */
    ck_assert(viewer_engine_respond(engine, 12.5, 7.25, &force, &problem));
    viewer_engine_release(engine);
    say(setup, METHOD_NAME, "cannonball");
    say(setup, METHOD_CR, "1.3");
    say(setup, METHOD_AREA, "17.25");
    engine = viewer_engine_make(setup, NULL, false);
    ck_assert(viewer_engine_respond(engine, 12.5, 7.25, &force, &problem));
    assert_close(srp_vec3_norm(force.response.f), 1.3 * 17.25, 1e-14, 0.0);
    viewer_engine_release(engine);
    viewer_setup_destroy(setup);
}
END_TEST

/* ---- attitude ---- */

START_TEST(attitude_there_and_back) {
    const viewer_attitude attitude = {{31.7, -62.3, 118.9}};
    srp_vec3 v = {0.31, -0.72, 0.53};
    srp_vec3 back = viewer_attitude_to_body(&attitude, viewer_attitude_to_room(&attitude, v));
    ck_assert(srp_vec3_norm(srp_vec3_sub(back, v)) < 1e-15);
    /* About Z alone: the Sun goes round the other way. */
    double az, el;
    viewer_attitude_sun(&(viewer_attitude){{0.0, 0.0, 33.25}}, &az, &el);
    assert_close(az, -33.25, 0.0, 1e-9);
    assert_close(el, 0.0, 0.0, 1e-9);
    /* About Y: the nose goes down, so the Sun stands above it. */
    viewer_attitude_sun(&(viewer_attitude){{0.0, 20.5, 0.0}}, &az, &el);
    assert_close(el, 20.5, 0.0, 1e-9);
    assert_close(az, 0.0, 0.0, 1e-9);
}
END_TEST

START_TEST(attitude_for_a_sun) {
    for (double az = -170.3; az < 180.0; az += 23.7) {
        for (double el = -90.0; el <= 90.0; el += 22.5) {
            double got_az, got_el;
            viewer_attitude attitude = viewer_attitude_for_sun(az, el);
            viewer_attitude_sun(&attitude, &got_az, &got_el);
            srp_vec3 want = srp_direction_from_deg(az, el);
            srp_vec3 got = srp_direction_from_deg(got_az, got_el);
            ck_assert(srp_vec3_norm(srp_vec3_sub(want, got)) < 1e-10);
        }
    }
    /* What was typed is what is computed: sampled methods choose their samples by it. */
    for (int az = -179; az <= 180; ++az) {
        for (int el = -89; el <= 89; ++el) {
            double got_az, got_el;
            viewer_attitude attitude = viewer_attitude_for_sun(az, el);
            viewer_attitude_sun(&attitude, &got_az, &got_el);
            ck_assert_msg(got_az == az && got_el == el, "%d, %d: %.17g, %.17g", az, el, got_az,
                          got_el);
        }
    }
}
END_TEST

/* ---- arrows, latency ---- */

static viewer_force force_of(double az, srp_vec3 f) {
    viewer_force force = {.az_deg = az, .el_deg = 0.5};
    force.response.f = f;
    return force;
}

START_TEST(arrows_are_recorded_once) {
    viewer_session *session = viewer_session_create();
    double least = -1.0, largest = -1.0;
    viewer_force force = force_of(10.5, srp_vec3_make(3.0, 4.0, 0.0));
    ck_assert(viewer_session_set_force(session, &force));
    ck_assert(!viewer_session_arrow_range(session, &least, &largest));
    session->recording = true;
    for (int i = 0; i < 200; ++i) {
        force = force_of(10.5 + i, srp_vec3_make(3.0 + i, 4.0, 0.0));
        ck_assert(viewer_session_set_force(session, &force));
        ck_assert(viewer_session_set_force(session, &force));
    }
    ck_assert_uint_eq(session->arrow_count, 200);
    ck_assert(viewer_session_arrow_range(session, &least, &largest));
    ck_assert(least == 5.0);
    assert_close(largest, hypot(202.0, 4.0), 1e-15, 0.0);
    assert_close(session->arrows[0].direction.y, 0.8, 1e-15, 0.0);
    viewer_session_clear_arrows(session);
    ck_assert_uint_eq(session->arrow_count, 0);
    viewer_session_destroy(session);
}
END_TEST

START_TEST(arrows_begin_with_the_force_of_now) {
    viewer_session *session = viewer_session_create();
    viewer_force old = force_of(1.5, srp_vec3_make(-1.0, 0.0, 0.0));
    viewer_force now = force_of(2.5, srp_vec3_make(-1.0, 0.0, 0.0));
    old.asked_at = 10.0;
    now.asked_at = session->asked_at = 11.0;
    ck_assert(viewer_session_record(session, true));
    ck_assert(viewer_session_set_force(session, &old)); /* was still being computed */
    ck_assert_uint_eq(session->arrow_count, 0);
    ck_assert(viewer_session_set_force(session, &now));
    ck_assert_uint_eq(session->arrow_count, 1);
    ck_assert(viewer_session_record(session, false));
    viewer_session_clear_arrows(session);
    ck_assert(viewer_session_record(session, true));
    ck_assert_uint_eq(session->arrow_count, 1);
    viewer_session_destroy(session);
}
END_TEST

START_TEST(arrows_end_with_their_method) {
    viewer_session *session = viewer_session_create();
    viewer_setup *setup = box_wing();
    viewer_engine *first = viewer_engine_make(setup, NULL, false);
    viewer_session_set_engine(session, first);
    session->recording = true;
    viewer_force force = force_of(1.5, srp_vec3_make(-1.0, 0.0, 0.0));
    ck_assert(viewer_session_set_force(session, &force));
    viewer_words problem = {""};
    ck_assert(viewer_setup_set_mass(setup, "12", &problem));
    viewer_session_set_engine(session, viewer_engine_make(setup, first->shape, false));
    ck_assert_uint_eq(session->arrow_count, 1);
    say(setup, METHOD_NAME, "raycast");
    viewer_session_set_engine(session, viewer_engine_make(setup, session->engine->shape, false));
    ck_assert_uint_eq(session->arrow_count, 0);
    viewer_setup_destroy(setup);
    viewer_session_destroy(session);
}
END_TEST

START_TEST(colours_from_blue_to_red) {
    float blue[3], red[3], middle[3];
    viewer_arrow_colour(0.0, blue);
    viewer_arrow_colour(1.0, red);
    viewer_arrow_colour(0.5, middle);
    ck_assert(blue[2] > blue[0] && blue[2] > blue[1]);
    ck_assert(red[0] > red[1] && red[0] > red[2]);
    ck_assert(middle[1] > middle[0] && middle[1] > middle[2]);
    viewer_arrow_colour((double)NAN, middle);
    ck_assert(middle[0] == blue[0]);
}
END_TEST

START_TEST(names_end_once) {
    static const char *const names[][2] = {
        {"/a.nc.nc", "/a.nc"}, {"a.b.nc", "a.b.nc"},   {"a.nc", "a.nc"}, {".nc.nc", ".nc.nc"},
        {"b.c/a", "b.c/a"},    {"nothing", "nothing"}, {"a..", "a.."}};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        char *name = viewer_text_end_once(names[i][0]);
        ck_assert_str_eq(name, names[i][1]);
        free(name);
    }
}
END_TEST

static void add_latency(viewer_session *session, double shown, double computed) {
    session->force.seconds = computed;
    viewer_session_add_latency(session, shown);
}

START_TEST(latency_is_a_median) {
    viewer_session *session = viewer_session_create();
    ck_assert(isnan(viewer_session_median_latency(session).shown));
    add_latency(session, 0.5, 0.125);
    add_latency(session, 0.25, 0.25);
    add_latency(session, 7.0, 6.0);
    ck_assert(viewer_session_median_latency(session).shown == 0.5);
    ck_assert(viewer_session_median_latency(session).computed == 0.25);
    for (int i = 0; i < 100; ++i) {
        add_latency(session, 0.125, 0.0625);
    }
    ck_assert(viewer_session_median_latency(session).shown == 0.125);
    ck_assert(viewer_session_median_latency(session).computed == 0.0625);
    viewer_setup *setup = box_wing();
    viewer_engine *engine = viewer_engine_make(setup, NULL, false);
    viewer_session_set_engine(session, engine);
    add_latency(session, 0.5, 0.25);
    say(setup, METHOD_NAME, "raycast");
    viewer_session_set_engine(session, viewer_engine_make(setup, engine->shape, false));
    ck_assert(isnan(viewer_session_median_latency(session).shown)); /* those were the old one's */
    viewer_setup_destroy(setup);
    viewer_session_destroy(session);
}
END_TEST

/* ---- pictures ---- */

/* The camera stands still in the room while the spacecraft turns: what is above stays above. */
START_TEST(camera_stays_in_the_room) {
    viewer_session *session = viewer_session_create();
    viewer_setup *setup = box_wing();
    viewer_look *look = malloc(sizeof *look);
    ck_assert_ptr_nonnull(look);
    viewer_session_set_engine(session, viewer_engine_make(setup, NULL, false));
    for (int i = 0; i < 30; ++i) {
        session->attitude = (viewer_attitude){{13.7 * i - 180.0, 170.0 - 11.3 * i, 7.9 * i - 90.0}};
        viewer_look_make(session, -35.0, 25.0, 1.0, 640, 480, look);
        srp_vec3 right, up, eye;
        srp_render_camera_axes(&look->view.camera, &right, &up, &eye);
        srp_vec3 room_up = viewer_attitude_to_room(&session->attitude, up);
        srp_vec3 room_eye = viewer_attitude_to_room(&session->attitude, eye);
        srp_vec3 want_eye = srp_direction_from_deg(-35.0, 25.0);
        srp_vec3 want_up = srp_vec3_make(-want_eye.x * want_eye.z, -want_eye.y * want_eye.z,
                                         1.0 - want_eye.z * want_eye.z);
        want_up = srp_vec3_scale(1.0 / srp_vec3_norm(want_up), want_up);
        ck_assert(srp_vec3_norm(srp_vec3_sub(room_eye, want_eye)) < 1e-9);
        ck_assert(srp_vec3_norm(srp_vec3_sub(room_up, want_up)) < 1e-9);
        ck_assert(
            srp_vec3_norm(srp_vec3_sub(viewer_attitude_to_room(&session->attitude, look->view.sun),
                                       srp_vec3_make(1.0, 0.0, 0.0))) < 1e-9);
    }
    free(look);
    viewer_setup_destroy(setup);
    viewer_session_destroy(session);
}
END_TEST

static Suite *make_suite(void) {
    Suite *suite = suite_create("viewer session");
    TCase *cases = tcase_create("session");
    tcase_set_timeout(cases, 120);
    tcase_add_test(cases, setup_takes_what_the_command_line_takes);
    tcase_add_test(cases, setup_leaves_out_what_a_method_does_not_use);
    tcase_add_test(cases, setup_as_a_command_line);
    tcase_add_test(cases, words_name_fields_and_no_options);
    tcase_add_test(cases, engine_gives_the_bits_of_the_library);
    tcase_add_test(cases, engine_takes_a_known_shape);
    tcase_add_test(cases, engine_says_what_is_wrong);
    tcase_add_test(cases, engine_waits_for_missing_optics);
    tcase_add_test(cases, mass_is_no_part_of_an_engine);
    tcase_add_test(cases, engine_misses_an_mtl);
    tcase_add_test(cases, engine_of_plates_and_ball);
    tcase_add_test(cases, attitude_there_and_back);
    tcase_add_test(cases, attitude_for_a_sun);
    tcase_add_test(cases, arrows_are_recorded_once);
    tcase_add_test(cases, arrows_begin_with_the_force_of_now);
    tcase_add_test(cases, arrows_end_with_their_method);
    tcase_add_test(cases, colours_from_blue_to_red);
    tcase_add_test(cases, names_end_once);
    tcase_add_test(cases, latency_is_a_median);
    tcase_add_test(cases, camera_stays_in_the_room);
    suite_add_tcase(suite, cases);
    return suite;
}

int main(void) {
    return run_suite(make_suite());
}
