/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L /* mkdir */

#include "malformed.h"

#include <srp/scene.h>

#include <sys/stat.h>

/* Files are written below this folder in the build tree. */
#define AREA "test_scene_read.files/"

static void write_file(const char *path, const char *text) {
    FILE *file = fopen(path, "wb");
    ck_assert_msg(file != NULL, "cannot write %s", path);
    ck_assert_uint_eq(fwrite(text, 1, strlen(text), file), strlen(text));
    ck_assert_int_eq(fclose(file), 0);
}

static void write_files(void) {
    mkdir(AREA, 0777);
    mkdir(AREA "parts", 0777);
    write_file(AREA "a.obj", "mtllib my lib.mtl parts/more.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                             "usemtl gold\nf 1 2 3\nusemtl cells\nf 3 2 1\n");
    write_file(AREA "my lib.mtl", "newmtl gold\nrho_s 0.5\nrho_d 0.125\nnewmtl unused\n");
    write_file(AREA "parts/more.mtl", "newmtl cells\nrho_s 0.25\nrho_d 0.0625\none_sided 1\n");
    write_file(AREA "parts/b.obj", "mtllib more.mtl\nmtllib gone.mtl\nv 0 0 2\nv 1 0 2\nv 0 1 2\n"
                                   "usemtl cells\nf 1 2 3\nusemtl paint\nf 1 3 2\n");
    write_file(AREA "colours.obj", "mtllib colours.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                   "usemtl red\nf 1 2 3\n");
    write_file(AREA "colours.mtl", "newmtl red\nKs 0 0 0\nKd 0.8 0.1 0.1\n");
    write_file(AREA "plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
}

static srp_scene *scene_ok(const char *const *paths, size_t count, const srp_materials *given,
                           log_keeper *keeper) {
    srp_scene *scene = NULL;
    srp_error error;
    srp_log log = {log_keeper_warn, keeper};
    assert_ok(srp_scene_read_obj(paths, count, NULL, given, keeper ? &log : NULL, &scene, &error),
              error);
    return scene;
}

static srp_materials *one_material(const char *name, srp_optics optics) {
    srp_materials *given;
    srp_error error;
    assert_ok(srp_materials_create(&given, &error), error);
    assert_ok(srp_materials_set(given, name, optics, false, &error), error);
    return given;
}

START_TEST(one_file_with_its_libraries) {
    const char *path = AREA "a.obj";
    log_keeper keeper = {0};
    srp_scene *scene = scene_ok(&path, 1, NULL, &keeper);
    ck_assert_uint_eq(keeper.count, 0);
    ck_assert_uint_eq(srp_scene_facet_count(scene), 2);
    ck_assert_str_eq(srp_scene_material_name(scene, 0), "gold");
    ck_assert(srp_scene_material_optics(scene, 0).rho_s == 0.5);
    ck_assert(srp_scene_material_optics(scene, 1).rho_d == 0.0625);
    ck_assert(srp_scene_material_optics(scene, 1).one_sided);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(files_are_joined_and_units_scaled) {
    const char *paths[] = {AREA "a.obj", AREA "parts/b.obj"};
    srp_materials *given = one_material("paint", (srp_optics){0.375, 0.5, false});
    log_keeper keeper = {0};
    srp_scene *scene = scene_ok(paths, 2, given, &keeper);
    ck_assert_uint_eq(srp_scene_facet_count(scene), 4);
    ck_assert_uint_eq(srp_scene_material_count(scene), 3);
    ck_assert_str_eq(srp_scene_material_name(scene, 2), "paint");
    ck_assert(srp_scene_material_optics(scene, 2).rho_s == 0.375);
    assert_close(srp_scene_radius(scene), sqrt(5.0), 1e-15, 0.0);
    ck_assert_uint_eq(keeper.count, 1);
    ck_assert_str_eq(keeper.text[0], AREA "parts/gone.mtl: the MTL file does not exist");
    srp_scene_destroy(scene);

    srp_mesh_read_params params = {.metres_per_unit = 0.001};
    srp_error error;
    assert_ok(srp_scene_read_obj(paths, 2, &params, given, NULL, &scene, &error), error);
    assert_close(srp_scene_radius(scene), 0.001 * sqrt(5.0), 1e-15, 0.0);
    srp_scene_destroy(scene);
    srp_materials_destroy(given);
}
END_TEST

START_TEST(given_materials_win) {
    const char *path = AREA "a.obj";
    srp_materials *given = one_material("gold", (srp_optics){0.75, 0.25, false});
    srp_scene *scene = scene_ok(&path, 1, given, NULL);
    ck_assert(srp_scene_material_optics(scene, 0).rho_s == 0.75);
    srp_scene_destroy(scene);
    srp_materials_destroy(given);
    /* What an MTL says of a given material is not even looked at. */
    path = AREA "colours.obj";
    given = one_material("red", (srp_optics){0.125, 0.25, false});
    scene = scene_ok(&path, 1, given, NULL);
    ck_assert(srp_scene_material_optics(scene, 0).rho_s == 0.125);
    srp_scene_destroy(scene);
    srp_materials_destroy(given);
    /* Faces before any usemtl have the material "". */
    path = AREA "plain.obj";
    given = one_material("", (srp_optics){0.125, 0.5, false});
    scene = scene_ok(&path, 1, given, NULL);
    ck_assert(srp_scene_material_optics(scene, 0).rho_d == 0.5);
    srp_scene_destroy(scene);
    srp_materials_destroy(given);
}
END_TEST

START_TEST(misspelt_materials_are_told) {
    const char *path = AREA "a.obj";
    srp_materials *given = one_material("glod", (srp_optics){0.75, 0.25, false});
    log_keeper keeper = {0};
    srp_scene *scene = scene_ok(&path, 1, given, &keeper);
    ck_assert_uint_eq(keeper.count, 1);
    ck_assert_str_eq(keeper.text[0], "no face has the given material 'glod'");
    srp_scene_destroy(scene);
    srp_materials_destroy(given);
}
END_TEST

START_TEST(what_is_missing_is_named) {
    static const struct {
        const char *path, *message;
        srp_status status;
    } cases[] = {
        {AREA "no.obj", AREA "no.obj: cannot open: No such file or directory", SRP_NOT_FOUND},
        {AREA "parts", AREA "parts: is a directory, expected a file", SRP_IO},
        {AREA "parts/b.obj",
         AREA "parts/b.obj: no optics for 1 material: 'paint'; give them in the MTL file (rho_s, "
              "rho_d) (there is no file '" AREA "parts/gone.mtl')",
         SRP_NOT_FOUND},
        {AREA "plain.obj",
         AREA "plain.obj: no optics for 1 material: ''; give them in the MTL file (rho_s, rho_d)",
         SRP_NOT_FOUND},
        {AREA "colours.obj",
         AREA "colours.mtl:3:4: material 'red': Kd is 0.8 0.1 0.1, expected three equal channels; "
              "give rho_s and rho_d in the file",
         SRP_BAD_DATA},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        srp_scene *scene = NULL;
        srp_error error;
        const char *paths[] = {AREA "a.obj", cases[i].path};
        malformed wanted = {cases[i].path, NULL, 0, cases[i].status, cases[i].message};
        srp_status status = srp_scene_read_obj(&paths[1], 1, NULL, NULL, NULL, &scene, &error);
        assert_refused(&wanted, status, &error);
        ck_assert_ptr_null(scene);
        ck_assert_int_eq(srp_scene_read_obj(paths, 2, NULL, NULL, NULL, &scene, NULL),
                         cases[i].status);
    }
    srp_scene *scene = NULL;
    srp_error error;
    ck_assert_int_eq(srp_scene_read_obj(NULL, 0, NULL, NULL, NULL, &scene, &error),
                     SRP_BAD_ARGUMENT);
}
END_TEST

START_TEST(lists_of_missing_materials_are_bounded) {
    char text[8000] = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < 100; ++i) {
        snprintf(text + strlen(text), 80, "usemtl \x1b[31mmaterial with a long name %d\nf 1 2 3\n",
                 i);
    }
    write_file(AREA "many.obj", text);
    const char *path = AREA "many.obj";
    srp_scene *scene;
    srp_error error;
    ck_assert_int_eq(srp_scene_read_obj(&path, 1, NULL, NULL, NULL, &scene, &error), SRP_NOT_FOUND);
    ck_assert_ptr_nonnull(strstr(error.message, "no optics for 100 materials: "));
    ck_assert_ptr_nonnull(strstr(error.message, "a long name 7'"));
    ck_assert_ptr_null(strstr(error.message, "a long name 8'"));
    ck_assert_ptr_null(strstr(error.message, "--"));
    ck_assert_int_eq(error.remedy, SRP_REMEDY_OPTICS);
    ck_assert_ptr_null(strchr(error.message, '\x1b'));
}
END_TEST

START_TEST(lro_needs_its_materials) {
    const char *paths[] = {SRP_SHARED_DATA_DIR "/lro/bus.obj", SRP_SHARED_DATA_DIR "/lro/HGA.obj"};
    FILE *there = fopen(paths[0], "rb");
    if (there == NULL) {
        printf("skipped: %s is not there\n", paths[0]);
        return;
    }
    fclose(there);
    srp_scene *scene;
    srp_error error;
    log_keeper keeper = {0};
    srp_log log = {log_keeper_warn, &keeper};
    ck_assert_int_eq(srp_scene_read_obj(paths, 2, NULL, NULL, &log, &scene, &error), SRP_NOT_FOUND);
    ck_assert_ptr_nonnull(strstr(error.message, "'foil_silver', 'tex_01', 'tex_03', 'foil_gold', "
                                                "'foil_silver_dish'"));
    ck_assert_ptr_nonnull(strstr(error.message, "lro/bus.mtl"));
    ck_assert(log_keeper_has(&keeper, "HGA.mtl: the MTL file does not exist"));

    static const char *const names[] = {"foil_gold", "foil_silver", "foil_silver_dish", "tex_01",
                                        "tex_03"};
    srp_materials *given = one_material("foil_gold", (srp_optics){0.5, 0.25, false});
    for (int i = 1; i < 5; ++i) {
        assert_ok(
            srp_materials_set(given, names[i], (srp_optics){0.1 * i, 0.2, false}, false, &error),
            error);
    }
    scene = scene_ok(paths, 2, given, NULL);
    ck_assert_uint_eq(srp_scene_facet_count(scene), 5362 + 576);
    ck_assert_uint_eq(srp_scene_material_count(scene), 5);
    srp_scene_destroy(scene);
    srp_materials_destroy(given);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("scene_read");
    TCase *tcase = tcase_create("scene_read");
    tcase_add_unchecked_fixture(tcase, write_files, NULL);
    tcase_add_test(tcase, one_file_with_its_libraries);
    tcase_add_test(tcase, files_are_joined_and_units_scaled);
    tcase_add_test(tcase, given_materials_win);
    tcase_add_test(tcase, misspelt_materials_are_told);
    tcase_add_test(tcase, what_is_missing_is_named);
    tcase_add_test(tcase, lists_of_missing_materials_are_bounded);
    tcase_add_test(tcase, lro_needs_its_materials);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
