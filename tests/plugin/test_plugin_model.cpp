// SPDX-License-Identifier: Apache-2.0
// Fields and area models of the plugin, without GMAT and without a stand-in of it.
#include "AreaModel.hpp"
#include "Settings.hpp"

#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

// Last: libcheck has a macro that is called fail.
#include "../unit/srp_check.h"

using namespace srp_plugin;

static const char BOX_WING[] = SRP_MODELS_DIR "/box-wing.obj";

static const Field &field(const char *name) {
    for (const Field &one : fields()) {
        if (std::string(one.name) == name) {
            return one;
        }
    }
    ck_abort_msg("no field %s", name);
    return fields()[0];
}

// What `act` throws, "" for nothing.
template <typename Act>
static std::string complaint(Act act) {
    try {
        act();
    } catch (const BadSetting &bad) {
        return bad.what();
    }
    return "";
}

#define assert_says(act, text)                                                                     \
    do {                                                                                           \
        const std::string said_ = complaint([&] { act; });                                         \
        ck_assert_msg(said_.find(text) != std::string::npos, "%s: '%s' lacks '%s'", #act,          \
                      said_.c_str(), text);                                                        \
    } while (0)

START_TEST(fields_have_names_of_their_own) {
    ck_assert_uint_eq(fields().size(), 20);
    for (const Field &one : fields()) {
        const std::string name = one.name;
        // GMAT looks at the last part of a name alone, in all forces: SRP.Flux is another field.
        ck_assert_msg(name.compare(0, 3, "SRP") == 0 && name != "SRPModel", "%s", one.name);
        ck_assert_ptr_eq(&field(one.name), &one);
    }
}
END_TEST

START_TEST(numbers_stay_in_their_ranges) {
    Settings s;
    set_number(s, field("SRPScaleFactor"), 0.0);
    ck_assert_double_eq(s.scale, 0.0);
    set_number(s, field("SRPFlux"), 1361.25);
    ck_assert_double_eq(s.flux, 1361.25);
    set_integer(s, field("SRPReflections"), 100);
    ck_assert_int_eq(s.reflections, 100);
    assert_says(set_number(s, field("SRPFlux"), 0.0),
                "SRPFlux: found 0, expected above 0 and at most 1000000");
    assert_says(set_number(s, field("SRPScaleFactor"), -0.125),
                "SRPScaleFactor: found -0.125, expected 0 to 1000000");
    assert_says(set_number(s, field("SRPScaleFactor"), NAN), "SRPScaleFactor: found nan");
    assert_says(set_number(s, field("SRPScaleFactor"), INFINITY), "SRPScaleFactor: found inf");
    assert_says(set_integer(s, field("SRPReflections"), 101), "SRPReflections: found 101");
    ck_assert_double_eq(s.flux, 1361.25);
    ck_assert_int_eq(s.reflections, 100);
}
END_TEST

START_TEST(words_are_those_that_are_known) {
    Settings s;
    set_text(s, field("SRPInterpolation"), "gmat_bilinear");
    assert_says(set_text(s, field("SRPInterpolation"), "gmat"), "SRPInterpolation: found 'gmat'");
    assert_says(set_text(s, field("SRPMethod"), "Exactly"),
                "SRPMethod: found 'Exactly', expected one of exact raycast raytrace");
    ck_assert(s.interpolation == "gmat_bilinear");
    // As GMAT writes words of its own.
    set_text(s, field("SRPInterpolation"), "Bicubic");
    set_text(s, field("SRPMethod"), "RayTrace");
    ck_assert(s.interpolation == "bicubic" && s.method == "raytrace");
    const std::vector<std::string> names = names_in(" {Earth,Luna ; Sun}\t");
    ck_assert_uint_eq(names.size(), 3);
    ck_assert(names[1] == "Luna");
    ck_assert(names_in("").empty());
}
END_TEST

START_TEST(fields_fit_together) {
    Settings s;
    assert_says(check(s), "SRPTableFile: not set");
    s.obj_file = BOX_WING;
    ck_assert(complaint([&] { check(s); }) == "");
    s.interpolation = "spline";
    assert_says(check(s), "SRPInterpolation: spline needs all nodes at once");
    s.on_demand = false;
    check(s);
    s.table_file = "a.nc";
    assert_says(check(s), "exclude each other");
    s.obj_file = "";
    check(s);
    s.mtl_file = "a.mtl";
    assert_says(check(s), "SRPMtlFile: goes with SRPObjFile");
}
END_TEST

// Whoever sets what counts for nothing believes that it counts.
START_TEST(fields_that_count_for_nothing_are_refused) {
    Settings s;
    s.table_file = "a.nc";
    s.method = "raytrace";
    assert_says(check(s), "SRPMethod: goes with SRPObjFile");
    s.method = "exact";
    s.azimuth_step_deg = 7.0;
    assert_says(check(s), "SRPAzimuthStep: goes with SRPObjFile");
    s = Settings();
    s.obj_file = BOX_WING;
    s.diffuse = 8;
    assert_says(check(s), "SRPDiffuse: goes with SRPMethod = raytrace");
    s.diffuse = 0;
    s.reflections = 5;
    assert_says(check(s), "SRPReflections: goes with SRPMethod = raytrace");
    s.reflections = 2;
    s.grid = 64;
    assert_says(check(s), "SRPGrid: goes with SRPMethod raycast or raytrace");
    s.method = "raytrace";
    s.diffuse = 8;
    check(s);
    for (const char *bodies : {"", "None, Earth", "Sun", "Sun, Earth"}) {
        s.shadow_bodies = bodies;
        assert_says(check(s), "SRPShadowBodies: found '");
    }
    s.shadow_bodies = "None";
    check(s);
}
END_TEST

// ---- Models -------------------------------------------------------------------------------------

struct Heard {
    std::string text;
    Messages to() {
        return [this](const std::string &line) { text += line + "\n"; };
    }
};

// The box-wing on a coarse grid, without a cache.
static Settings box_wing() {
    Settings s;
    s.obj_file = BOX_WING;
    s.azimuth_step_deg = 15.0;
    s.elevation_step_deg = 15.0;
    s.cache = false;
    s.threads = 2;
    return s;
}

static srp_vec3 look_up(const AreaModel &model, srp_vec3 s) {
    srp_vec3 f = {NAN, NAN, NAN};
    srp_error error;
    const srp_area_source source = model.source();
    assert_ok(source.eval(source.user, s, &f, nullptr, &error), error);
    return f;
}

static const srp_vec3 S = {0.36, -0.48, 0.8};

START_TEST(at_once_and_on_demand_are_the_same) {
    Heard heard;
    Settings s = box_wing();
    {
        const AreaModel demand(s, heard.to());
        s.on_demand = false;
        const AreaModel full(s, heard.to());
        uint64_t random = 3;
        for (int i = 0; i < 100; ++i) {
            const srp_vec3 at = random_direction(&random);
            const srp_vec3 a = look_up(demand, at), b = look_up(full, at);
            ck_assert(a.x == b.x && a.y == b.y && a.z == b.z);
        }
        ck_assert(srp_vec3_dot(look_up(full, S), S) < -5.0);
    }
    ck_assert(heard.text.find("directions traced") != std::string::npos);
    ck_assert(heard.text.find("known of 266") != std::string::npos);
}
END_TEST

START_TEST(a_cache_that_does_not_work_is_told_of_once) {
    Heard heard;
    Settings s = box_wing();
    s.on_demand = false;
    s.cache = true;
    s.cache_directory = "test_plugin_no_directory";
    std::ofstream(s.cache_directory) << "a file\n";
    const AreaModel model(s, heard.to());
    ck_assert(srp_vec3_dot(look_up(model, S), S) < -5.0);
    const std::string field_name = "SRPCacheDirectory";
    const size_t first = heard.text.find(field_name);
    ck_assert_msg(first != std::string::npos, "said: '%s'", heard.text.c_str());
    ck_assert_msg(heard.text.find(field_name, first + 1) == std::string::npos, "said: '%s'",
                  heard.text.c_str());
    std::remove(s.cache_directory.c_str());
}
END_TEST

// A table of the box-wing in a file.
static void write_table(const char *path) {
    Heard heard;
    srp_error error;
    srp_scene *scene = nullptr;
    srp_prepared *prepared = nullptr;
    srp_table *table = nullptr;
    srp_grid grid;
    const char *obj = BOX_WING;
    assert_ok(srp_scene_read_obj(&obj, 1, nullptr, nullptr, nullptr, &scene, &error), error);
    const srp_method_params params = srp_method_params_default();
    assert_ok(srp_method_prepare(&srp_method_exact, scene, &params, &prepared, &error), error);
    assert_ok(srp_grid_from_steps(15.0, 15.0, &grid, &error), error);
    assert_ok(srp_table_create(prepared, grid, false, &table, &error), error);
    assert_ok(srp_table_fill(table, prepared, nullptr, &error), error);
    assert_ok(srp_table_write(table, srp_table_format_of(path), path, &error), error);
    srp_table_destroy(table);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}

START_TEST(tables_are_looked_up_by_each_scheme) {
    Heard heard;
    Settings traced = box_wing(), read;
    traced.on_demand = false;
    for (const char *path : {"test_plugin.nc", "test_plugin.spo"}) {
        write_table(path);
        read.table_file = path;
        for (const char *scheme :
             {"bilinear", "bicubic", "spline", "gmat_bilinear", "gmat_bicubic"}) {
            read.interpolation = traced.interpolation = scheme;
            const AreaModel a(read, heard.to()), b(traced, heard.to());
            assert_vec3_close(look_up(a, S), look_up(b, S), 1e-12, 0.0);
        }
        std::remove(path);
    }
}
END_TEST

START_TEST(bad_files_are_told_with_field_and_place) {
    Heard heard;
    Settings s = box_wing();
    s.obj_file = "nowhere.obj";
    assert_says(AreaModel(s, heard.to()), "SRPObjFile: nowhere.obj");
    std::ofstream("test_plugin_bad.obj") << "v 0 0 0\nv 1 0 0\nv 0 one 0\nf 1 2 3\n";
    s.obj_file = "test_plugin_bad.obj";
    assert_says(AreaModel(s, heard.to()), "SRPObjFile: test_plugin_bad.obj:3:");
    std::remove("test_plugin_bad.obj");
    s = box_wing();
    s.mtl_file = "nowhere.mtl";
    assert_says(AreaModel(s, heard.to()), "SRPMtlFile: nowhere.mtl");
    s = box_wing();
    s.azimuth_step_deg = 7.0;
    assert_says(AreaModel(s, heard.to()), "SRPAzimuthStep, SRPElevationStep: ");
    Settings table;
    table.table_file = "nowhere.nc";
    assert_says(AreaModel(table, heard.to()), "SRPTableFile: nowhere.nc");
    table.table_file = "table.dat";
    assert_says(AreaModel(table, heard.to()), "is no name of a table");
}
END_TEST

START_TEST(materials_of_a_file_win) {
    Heard heard;
    Settings s = box_wing();
    const srp_vec3 before = look_up(AreaModel(s, heard.to()), S);
    std::ofstream("test_plugin.mtl") << "newmtl bus\nrho_s 0.875\nrho_d 0.0625\n";
    s.mtl_file = "test_plugin.mtl";
    const srp_vec3 after = look_up(AreaModel(s, heard.to()), S);
    ck_assert(srp_vec3_norm(srp_vec3_sub(before, after)) > 0.1);
    std::remove("test_plugin.mtl");
}
END_TEST

START_TEST(errors_above_the_limit_are_told) {
    Heard quiet, loud;
    Settings s = box_wing();
    s.on_demand = false;
    s.method = "raycast";
    s.grid = 16;
    s.max_error = 1.0;
    AreaModel(s, quiet.to());
    ck_assert(quiet.text == "");
    s.max_error = 1e-9;
    AreaModel(s, loud.to());
    ck_assert(loud.text.find("above SRPMaxError") != std::string::npos);
    s.on_demand = true;
    loud.text.clear();
    AreaModel(s, loud.to());
    ck_assert(loud.text.find("above SRPMaxError") != std::string::npos);
}
END_TEST

// A library is read for SRPMtlFile and for the model, and a force has many copies.
START_TEST(things_are_said_once_and_of_whom) {
    Heard heard;
    std::ofstream("test_plugin_said.mtl") << "newmtl paint\nKd 0.5 0.5 0.5\n";
    std::ofstream("test_plugin_said.obj") << "mtllib test_plugin_said.mtl\nusemtl paint\n"
                                             "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    Settings s = box_wing();
    s.obj_file = "test_plugin_said.obj";
    s.mtl_file = "test_plugin_said.mtl";
    {
        SharedModel shared(heard.to());
        shared.get(s);
        ck_assert_msg(heard.text == "", "%s", heard.text.c_str()); // not known yet of whom
        shared.notes().concern({"A", "B"});
        const size_t first = heard.text.find("A, B: test_plugin_said.mtl:");
        ck_assert_msg(first == 0, "%s", heard.text.c_str());
        ck_assert(heard.text.find("test_plugin_said.mtl:", first + 10) == std::string::npos);
        s.grid = 64; // another model of the same files
        s.method = "raycast";
        shared.get(s);
        ck_assert(heard.text.find("test_plugin_said.mtl:", first + 10) == std::string::npos);
        shared.notes().concern({"B", "C"});
        shared.notes().add("later");
        ck_assert(heard.text.find("A, B, C: later\n") != std::string::npos);
    }
    // Nobody came: said all the same, at the end or before an error.
    heard.text.clear();
    { SharedModel(heard.to()).notes().add("alone"); }
    ck_assert(heard.text == "alone\n");
    std::remove("test_plugin_said.obj");
    std::remove("test_plugin_said.mtl");
    ck_assert(list_of({"A", "B", "C", "D", "E", "F"}) == "A, B, C, D, E, ...");
}
END_TEST

START_TEST(advice_is_of_fields) {
    Heard heard;
    std::ofstream("test_plugin_bare.obj") << "usemtl foil\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    Settings s = box_wing();
    s.obj_file = "test_plugin_bare.obj";
    assert_says(AreaModel(s, heard.to()),
                "in the MTL file (rho_s, rho_d) or in one that SRPMtlFile "
                "names");
    std::remove("test_plugin_bare.obj");
}
END_TEST

START_TEST(copies_share_until_something_changes) {
    Heard heard;
    SharedModel shared(heard.to());
    Settings s;
    write_table("test_plugin_shared.spo");
    s.table_file = "test_plugin_shared.spo";
    const auto first = shared.get(s);
    s.scale = 1.5; // of the force, not of the model
    ck_assert_ptr_eq(shared.get(s).get(), first.get());
    s.interpolation = "bilinear";
    const auto second = shared.get(s);
    ck_assert_ptr_ne(second.get(), first.get());
    std::ofstream("test_plugin_shared.spo", std::ios::app) << "\n";
    ck_assert_ptr_ne(shared.get(s).get(), second.get());
    std::remove("test_plugin_shared.spo");
    assert_says(shared.get(s), "SRPTableFile");
}
END_TEST

int main() {
    Suite *suite = suite_create("plugin_model");
    TCase *tcase = tcase_create("plugin_model");
    tcase_add_test(tcase, fields_have_names_of_their_own);
    tcase_add_test(tcase, numbers_stay_in_their_ranges);
    tcase_add_test(tcase, words_are_those_that_are_known);
    tcase_add_test(tcase, fields_fit_together);
    tcase_add_test(tcase, fields_that_count_for_nothing_are_refused);
    tcase_add_test(tcase, at_once_and_on_demand_are_the_same);
    tcase_add_test(tcase, a_cache_that_does_not_work_is_told_of_once);
    tcase_add_test(tcase, tables_are_looked_up_by_each_scheme);
    tcase_add_test(tcase, bad_files_are_told_with_field_and_place);
    tcase_add_test(tcase, materials_of_a_file_win);
    tcase_add_test(tcase, errors_above_the_limit_are_told);
    tcase_add_test(tcase, things_are_said_once_and_of_whom);
    tcase_add_test(tcase, advice_is_of_fields);
    tcase_add_test(tcase, copies_share_until_something_changes);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
