/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L /* mkfifo, fork */

#include "malformed.h"
#include "polygon.h"
#include "text.h"

#include <srp/material.h>
#include <srp/mesh.h>

#include <fcntl.h>
#include <locale.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static srp_mesh *parse(const char *text, log_keeper *keeper) {
    srp_mesh *mesh = NULL;
    srp_error error;
    srp_log log = {log_keeper_warn, keeper};
    assert_ok(srp_mesh_parse_obj(text, strlen(text), "dir/f.obj", NULL, keeper ? &log : NULL, &mesh,
                                 &error),
              error);
    return mesh;
}

static void assert_same_mesh(const srp_mesh *a, const srp_mesh *b) {
    ck_assert_uint_eq(srp_mesh_vertex_count(a), srp_mesh_vertex_count(b));
    ck_assert_uint_eq(srp_mesh_triangle_count(a), srp_mesh_triangle_count(b));
    ck_assert_uint_eq(srp_mesh_material_count(a), srp_mesh_material_count(b));
    for (size_t i = 0; i < srp_mesh_vertex_count(a); ++i) {
        assert_vec3_close(srp_mesh_vertices(a)[i], srp_mesh_vertices(b)[i], 0.0, 0.0);
    }
    for (size_t i = 0; i < srp_mesh_triangle_count(a); ++i) {
        for (int k = 0; k < 3; ++k) {
            ck_assert_uint_eq(srp_mesh_triangles(a)[i].v[k], srp_mesh_triangles(b)[i].v[k]);
        }
        ck_assert_uint_eq(srp_mesh_triangle_materials(a)[i], srp_mesh_triangle_materials(b)[i]);
    }
    for (size_t i = 0; i < srp_mesh_material_count(a); ++i) {
        ck_assert_str_eq(srp_mesh_material_name(a, i), srp_mesh_material_name(b, i));
    }
}

static const char PLAIN[] = "v 0.25 -1.5 2\n"
                            "v 1e0 0 2.5e-1\n"
                            "v 0 1 .5\n"
                            "v +1 1 3.\n"
                            "usemtl gold foil\n"
                            "f 1 2 3\n"
                            "f 2 4 3\n";

START_TEST(all_spellings_give_the_same_mesh) {
    static const char *const spellings[] = {
        /* index forms, and indices from the end */
        "v 0.25 -1.5 2\nv 1e0 0 2.5e-1\nv 0 1 .5\nv +1 1 3.\nvt 0 0\nvn 0 0 1\nusemtl gold foil\n"
        "f 1/1 2/1 3/1\nf 2//1 4//1 3//-1\n",
        "v 0.25 -1.5 2\nv 1e0 0 2.5e-1\nv 0 1 .5\nusemtl gold foil\nf -3/1/1 -2/9/9 -1/-1/-1\n"
        "v +1 1 3.\nf -3 -1 3\n",
        /* a face above its vertices */
        "usemtl gold foil\nf 1 2 3\nf 2 4 3\nv 0.25 -1.5 2\nv 1e0 0 2.5e-1\nv 0 1 .5\nv +1 1 3.",
        /* weight, colour, both; statements that do not matter */
        "mtllib a.mtl\no part\nv 0.25 -1.5 2 1\nv 1e0 0 2.5e-1 .1 .2 .3\nv 0 1 .5 1 .1 .2 .3\ns "
        "off\n"
        "v +1 1 3.\nvt 0.5\ng a b c\nusemtl gold foil\ns 1\nf 1 2 3\nl 1 2\np 1\nfo 2 4 3\nvp 1 "
        "nan\n",
        /* CRLF, CR, tabs, comments, continued lines, a byte order mark */
        "v 0.25 -1.5 2\r\nv 1e0 0 2.5e-1\r\nv 0 1 .5\r\nv +1 1 3.\r\nusemtl gold foil\r\n"
        "f 1 2 3\r\nf 2 4 3",
        "v 0.25 -1.5 2\rv 1e0 0 2.5e-1\rv 0 1 .5\rv +1 1 3.\rusemtl gold foil\rf 1 2 3\rf 2 4 3\r",
        "\xef\xbb\xbfv\t0.25 -1.5\t2\t# f 9 9 9\n\n  v 1e0 0 2.5e-1\n#v 7 7 7\nv 0 1 .5\nv +1 1 "
        "3.\n"
        "usemtl \tgold foil \t# or silver\nf 1 2 3\n \t \nf 2 4 3 # last",
        "v 0.25 \\\n-1.5 2\nv 1e0 0 2.5e-1\nv 0 1 .5\nv \\\r\n +1 \\ \n 1 3.\nusemtl gold foil\n"
        "f 1 2\\\n3\nf 2 4 3 \\",
        /* materials that are named again, or for no face */
        "v 0.25 -1.5 2\nv 1e0 0 2.5e-1\nv 0 1 .5\nv +1 1 3.\nusemtl gold foil\nf 1 2 3\nusemtl x\n"
        "usemtl gold foil\nf 2 4 3",
    };
    srp_mesh *plain = parse(PLAIN, NULL);
    ck_assert_uint_eq(srp_mesh_vertex_count(plain), 4);
    ck_assert_uint_eq(srp_mesh_triangle_count(plain), 2);
    ck_assert_str_eq(srp_mesh_material_name(plain, 0), "gold foil");
    assert_vec3_close(srp_mesh_vertices(plain)[3], srp_vec3_make(1, 1, 3), 0.0, 0.0);
    for (size_t i = 0; i < sizeof spellings / sizeof *spellings; ++i) {
        srp_mesh *mesh = parse(spellings[i], NULL);
        assert_same_mesh(mesh, plain);
        srp_mesh_destroy(mesh);
    }
    srp_mesh_destroy(plain);
}
END_TEST

START_TEST(materials_are_those_of_faces) {
    srp_mesh *mesh =
        parse("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl unused\nusemtl Material #25\n"
              "f 1 2 3\nusemtl b\nf 1 2 3\nusemtl Material #25 # x\nf 1 2 3\n",
              NULL);
    ck_assert_uint_eq(srp_mesh_material_count(mesh), 3);
    ck_assert_str_eq(srp_mesh_material_name(mesh, 0), "");
    ck_assert_str_eq(srp_mesh_material_name(mesh, 1), "Material #25");
    ck_assert_str_eq(srp_mesh_material_name(mesh, 2), "b");
    ck_assert_ptr_null(srp_mesh_material_name(mesh, 3));
    const uint32_t want[] = {0, 1, 2, 1};
    for (size_t i = 0; i < 4; ++i) {
        ck_assert_uint_eq(srp_mesh_triangle_materials(mesh)[i], want[i]);
    }
    srp_mesh_destroy(mesh);
}
END_TEST

/* The same in both kinds of file, so that optics find their faces. */
START_TEST(names_that_are_not_utf8_are_spelt_out) {
    log_keeper keeper = {0};
    srp_mesh *mesh =
        parse("v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl caf\xe9 1\nf 1 2 3\nusemtl caf\xe8 1\n"
              "f 1 2 3\nusemtl caf\xe9 1\nf 1 2 3\n",
              &keeper);
    ck_assert_uint_eq(srp_mesh_material_count(mesh), 2);
    ck_assert_str_eq(srp_mesh_material_name(mesh, 0), "caf\\xe9 1");
    ck_assert_str_eq(srp_mesh_material_name(mesh, 1), "caf\\xe8 1");
    ck_assert_uint_eq(srp_mesh_triangle_materials(mesh)[2], 0);
    ck_assert_uint_eq(keeper.count, 2);
    ck_assert(log_keeper_has(&keeper, "is not UTF-8: it is read as 'caf\\xe9 1'"));
    srp_materials *materials = NULL;
    srp_error error;
    srp_optics optics;
    const char text[] = "newmtl caf\xe9 1\nrho_s 0.13\nrho_d 0.27\n";
    assert_ok(srp_materials_create(&materials, &error), error);
    assert_ok(srp_materials_parse_mtl(materials, text, strlen(text), "f.mtl", NULL, &error), error);
    ck_assert(srp_materials_find(materials, srp_mesh_material_name(mesh, 0), &optics));
    ck_assert_double_eq(optics.rho_d, 0.27);
    srp_materials_destroy(materials);
    srp_mesh_destroy(mesh);
}
END_TEST

START_TEST(libraries_are_found_beside_the_file) {
    srp_mesh *mesh = parse("mtllib a.mtl\nmtllib my first.mtl B.MTL \t c d.mtl\nmtllib /abs/e.mtl\n"
                           "mtllib a.mtl\nmtllib no ending # x\nmtllib ../f.mtlx g.mtl\n"
                           "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                           NULL);
    static const char *const want[] = {"dir/a.mtl",          "dir/my first.mtl", "dir/B.MTL",
                                       "dir/c d.mtl",        "/abs/e.mtl",       "dir/no ending",
                                       "dir/../f.mtlx g.mtl"};
    ck_assert_uint_eq(srp_mesh_library_count(mesh), 7);
    for (size_t i = 0; i < 7; ++i) {
        ck_assert_str_eq(srp_mesh_library(mesh, i), want[i]);
    }
    ck_assert_ptr_null(srp_mesh_library(mesh, 7));
    srp_mesh_destroy(mesh);
}
END_TEST

START_TEST(polygons_are_split_and_counted) {
    /* A dart, seen from +z, whose second corner is the reflex one; a pentagon; a triangle. */
    srp_mesh *mesh = parse("v 0 4 0\nv 1 1 0\nv 4 0 0\nv 0 0 0\nv -1 2 0\n"
                           "f 1 4 3 2\nf 1 5 4 3 2\nf 1 2 3\n",
                           NULL);
    srp_mesh_report report;
    srp_error error;
    assert_ok(srp_mesh_inspect(mesh, &report, &error), error);
    ck_assert_uint_eq(report.faces_triangle, 1);
    ck_assert_uint_eq(report.faces_quad, 1);
    ck_assert_uint_eq(report.faces_larger, 1);
    ck_assert_uint_eq(report.triangles, 6);
    double area = 0.0;
    for (size_t i = 0; i < report.triangles; ++i) {
        const srp_vec3 *v = srp_mesh_vertices(mesh);
        srp_triangle t = srp_mesh_triangles(mesh)[i];
        area += 0.5 * srp_vec3_norm(srp_vec3_cross(srp_vec3_sub(v[t.v[1]], v[t.v[0]]),
                                                   srp_vec3_sub(v[t.v[2]], v[t.v[0]])));
    }
    /* 4, 4 + 2, and the notch of 4: twice 2. */
    assert_close(area, 4.0 + 6.0 + 4.0, 1e-15, 0.0);
    srp_mesh_destroy(mesh);
}
END_TEST

START_TEST(units_scale_the_vertices) {
    srp_mesh_read_params params = srp_mesh_read_params_default();
    ck_assert(params.metres_per_unit == 1.0);
    params.metres_per_unit = 0.0254;
    srp_mesh *mesh;
    srp_error error;
    assert_ok(srp_mesh_parse_obj(PLAIN, strlen(PLAIN), "f", &params, NULL, &mesh, &error), error);
    assert_vec3_close(srp_mesh_vertices(mesh)[0],
                      srp_vec3_make(0.25 * 0.0254, -1.5 * 0.0254, 2 * 0.0254), 1e-16, 0.0);
    srp_mesh_destroy(mesh);
    const double bad[] = {0.0, -1.0, NAN, INFINITY};
    for (int i = 0; i < 4; ++i) {
        params.metres_per_unit = bad[i];
        ck_assert_int_eq(
            srp_mesh_parse_obj(PLAIN, strlen(PLAIN), "f", &params, NULL, &mesh, &error),
            SRP_BAD_ARGUMENT);
    }
    params.metres_per_unit = 1e200;
    ck_assert_int_eq(srp_mesh_parse_obj("v 0 1e200 0\n", 12, "f", &params, NULL, &mesh, &error),
                     SRP_BAD_DATA);
    ck_assert_uint_eq(error.column, 5);
    ck_assert_ptr_nonnull(strstr(error.message, "y of the vertex is inf m, expected at most"));
}
END_TEST

START_TEST(flawed_faces_are_warned_of_but_not_each) {
    char text[4000] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.4\nf 1 2 3\nf 1 2 2\nf 1 2 2 3\n"
                      "f 1 2 3 1\nf 1 3 2 4\nf 1 2 4 3\nf 1 1 1 1 1\n";
    for (int i = 0; i < 100; ++i) {
        strcat(text, "f 1 1 2\n");
    }
    log_keeper keeper = {0};
    srp_mesh *mesh = parse(text, &keeper);
    ck_assert(log_keeper_has(&keeper, "f.obj:6:1: the face has no area"));
    ck_assert(log_keeper_has(&keeper, "f.obj:7:1: the face names a vertex twice in a row"));
    ck_assert(log_keeper_has(&keeper, "f.obj:8:1: the face names a vertex twice in a row"));
    ck_assert(log_keeper_has(&keeper, "f.obj:9:1: the face "));
    ck_assert(log_keeper_has(&keeper, "f.obj:10:1: the face is not flat"));
    ck_assert(log_keeper_has(&keeper, "f.obj: and 97 more faces without area"));
    ck_assert_uint_lt(keeper.count, 15);
    srp_mesh_report report;
    srp_error error;
    assert_ok(srp_mesh_inspect(mesh, &report, &error), error);
    ck_assert_uint_eq(report.degenerate, 102);
    ck_assert_uint_eq(report.triangles, 3 + 4 + 102);
    srp_mesh_destroy(mesh);
}
END_TEST

/* Numbers are read the same whatever the program's locale says. */
START_TEST(locale_does_not_matter) {
    if (setlocale(LC_ALL, "de_DE.UTF-8") == NULL && setlocale(LC_ALL, "fr_FR.UTF-8") == NULL) {
        printf("skipped: no locale with a decimal comma is installed\n");
        return;
    }
    srp_mesh *mesh = parse(PLAIN, NULL);
    ck_assert(srp_mesh_vertices(mesh)[0].x == 0.25);
    ck_assert_str_eq(localeconv()->decimal_point, ",");
    srp_mesh_destroy(mesh);
}
END_TEST

#define V3 "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static const malformed BAD[] = {
    MALFORMED("empty file", "", SRP_BAD_FORMAT,
              "f: found 0 vertices and no face, expected an OBJ file with faces (f)"),
    MALFORMED("comments only", "# nothing\n\n", SRP_BAD_FORMAT,
              "f: found 0 vertices and no face, expected an OBJ file with faces (f)"),
    MALFORMED("no face", V3, SRP_BAD_FORMAT,
              "f: found 3 vertices and no face, expected an OBJ file with faces (f)"),
    MALFORMED("another format: STL", "solid x\n facet normal 0 0 1\n outer loop\n", SRP_BAD_FORMAT,
              "f: found 0 vertices and no face, expected an OBJ file with faces (f)"),
    MALFORMED("face of two vertices", V3 "f 1 2\n", SRP_BAD_FORMAT,
              "f:4:1: a face of 2 vertices, expected at least 3"),
    MALFORMED("face of one vertex", V3 "  f 1", SRP_BAD_FORMAT,
              "f:4:3: a face of 1 vertex, expected at least 3"),
    MALFORMED("face of no vertex", V3 "f # 1 2 3", SRP_BAD_FORMAT,
              "f:4:1: a face of 0 vertices, expected at least 3"),
    MALFORMED("index 0", V3 "f 1 0 3\n", SRP_BAD_FORMAT,
              "f:4:5: vertex index 0: expected 1 for the first vertex or -1 for the latest"),
    MALFORMED("index -0", V3 "f 1 2 -0\n", SRP_BAD_FORMAT,
              "f:4:7: vertex index 0: expected 1 for the first vertex or -1 for the latest"),
    MALFORMED("index beyond the last", V3 "f 1 2 4\n", SRP_BAD_FORMAT,
              "f:4:7: vertex index 4 is out of range: the file has 3 vertices"),
    MALFORMED("index before the first", V3 "f 1 -4 3\nv 1 1 1\n", SRP_BAD_FORMAT,
              "f:4:5: vertex index -4 is out of range: 3 vertices are above it"),
    MALFORMED("index past 2^32 that wraps to 1", V3 "f 4294967297 2 3\n", SRP_BAD_FORMAT,
              "f:4:3: vertex index 4294967297 is out of range: the file has 3 vertices"),
    MALFORMED("index past 2^64 that wraps to 1", V3 "f 18446744073709551617 2 3\n", SRP_BAD_FORMAT,
              "f:4:3: vertex index 18446744073709551617 is out of range: the file has 3 vertices"),
    MALFORMED("index below -2^63", V3 "f 1 2 -9223372036854775809\n", SRP_BAD_FORMAT,
              "f:4:7: vertex index -9223372036854775809 is out of range: 3 vertices are above it"),
    MALFORMED("index that is a word", V3 "f 1 2 x\n", SRP_BAD_FORMAT,
              "f:4:7: found 'x', expected a whole number: a vertex index"),
    MALFORMED("index with a point", V3 "f 1 2.0 3\n", SRP_BAD_FORMAT,
              "f:4:5: found '2.0', expected a whole number: a vertex index"),
    MALFORMED("comma between indices", V3 "f 1,2,3\n", SRP_BAD_FORMAT,
              "f:4:3: found '1,2,3', expected a whole number: a vertex index"),
    MALFORMED("slash without texture", V3 "f 1/ 2/ 3/\n", SRP_BAD_FORMAT,
              "f:4:3: found '1/', expected a corner: v, v/vt, v//vn or v/vt/vn"),
    MALFORMED("slashes without normal", V3 "f 1//1 2// 3//1\n", SRP_BAD_FORMAT,
              "f:4:8: found '2//', expected a corner: v, v/vt, v//vn or v/vt/vn"),
    MALFORMED("slash without vertex", V3 "f /1 2/1 3/1\n", SRP_BAD_FORMAT,
              "f:4:3: found '/1', expected a corner: v, v/vt, v//vn or v/vt/vn"),
    MALFORMED("four indices in a corner", V3 "f 1 2 3/1/1/1\n", SRP_BAD_FORMAT,
              "f:4:7: found '3/1/1/1', expected a corner: v, v/vt, v//vn or v/vt/vn"),
    MALFORMED("texture index that is a word", V3 "f 1/a 2/1 3/1\n", SRP_BAD_FORMAT,
              "f:4:5: found 'a', expected a whole number: a texture index"),
    MALFORMED("normal index that is a word", V3 "f 1/1/1 2//n 3/1/1\n", SRP_BAD_FORMAT,
              "f:4:12: found 'n', expected a whole number: a normal index"),
    MALFORMED("NaN", "v 0 nan 0\n" V3 "f 1 2 3\n", SRP_BAD_FORMAT,
              "f:1:5: found 'nan', expected a finite number: y of the vertex"),
    MALFORMED("infinity", V3 "v 0 0 -Infinity\nf 1 2 3\n", SRP_BAD_FORMAT,
              "f:4:7: found '-Infinity', expected a finite number: z of the vertex"),
    MALFORMED("infinity by overflow", "v 1e309 0 0\n" V3 "f 1 2 3\n", SRP_BAD_FORMAT,
              "f:1:3: '1e309' is too large for a double: x of the vertex"),
    /* Its cross product would overflow, and the face be taken for one without area. */
    MALFORMED("vertex out of all reach", V3 "v 0 -1e160 0\nf 1 2 3\n", SRP_BAD_DATA,
              "f:4:5: y of the vertex is -1e+160 m, expected at most 1e+30 m: is its unit right?"),
    MALFORMED("hexadecimal number", "v 0x10 0 0\n" V3 "f 1 2 3\n", SRP_BAD_FORMAT,
              "f:1:3: found '0x10', expected a finite number: x of the vertex"),
    MALFORMED("decimal comma", "v 0,5 0 0\n" V3 "f 1 2 3\n", SRP_BAD_FORMAT,
              "f:1:3: found '0,5', expected a finite number: x of the vertex"),
    MALFORMED("truncated number", V3 "f 1 2 3\nv 1 2 3.5e", SRP_BAD_FORMAT,
              "f:5:7: found '3.5e', expected a finite number: z of the vertex"),
    MALFORMED("truncated vertex", V3 "f 1 2 3\nv 1 2", SRP_BAD_FORMAT,
              "f:5:6: found the end of the line, expected a finite number: z of the vertex"),
    MALFORMED("colour that is a word", "v 0 0 0 red\n" V3 "f 1 2 3\n", SRP_BAD_FORMAT,
              "f:1:9: found 'red', expected a finite number: weight or colour of the vertex"),
    MALFORMED("two vertices on one line", "v 0 0 0 v 1 0 0\n" V3 "f 1 2 3\n", SRP_BAD_FORMAT,
              "f:1:9: found 'v', expected a finite number: weight or colour of the vertex"),
    MALFORMED("too many numbers", "v 1 2 3 4 5 6 7 8\n" V3 "f 1 2 3\n", SRP_BAD_FORMAT,
              "f:1:17: found '8', expected the end of the line"),
    MALFORMED("place on a continued line", V3 "f 1 \\\r\n 2 \\\r\n  9\r\n", SRP_BAD_FORMAT,
              "f:6:3: vertex index 9 is out of range: the file has 3 vertices"),
    MALFORMED("place behind a byte order mark", "\xef\xbb\xbfv 0 x 0\n", SRP_BAD_FORMAT,
              "f:1:5: found 'x', expected a finite number: y of the vertex"),
    MALFORMED("control characters", V3 "f 1 2 \x1b[2J\x07\n", SRP_BAD_FORMAT,
              "f:4:7: found '\\x1b[2J\\x07', expected a whole number: a vertex index"),
    MALFORMED("usemtl without name", V3 "usemtl \nf 1 2 3\n", SRP_BAD_FORMAT,
              "f:4:8: found the end of the line, expected the name of a material"),
    MALFORMED("mtllib without name", "mtllib  # a.mtl\n" V3 "f 1 2 3\n", SRP_BAD_FORMAT,
              "f:1:9: found the end of the line, expected the name of an MTL file"),
    MALFORMED("zero byte", V3 "f 1 \0 2 3\n", SRP_BAD_FORMAT,
              "f:4:5: found a zero byte: this is a binary file, expected text"),
    MALFORMED("PNG image", "\x89PNG\r\n\x1a\n\0\0\0\rIHDR", SRP_BAD_FORMAT,
              "f:3:1: found a zero byte: this is a binary file, expected text"),
    MALFORMED("UTF-16",
              "\xff\xfev\0 \0"
              "0\0",
              SRP_BAD_FORMAT, "f:1:1: found text in UTF-16, expected UTF-8 or ASCII"),
    MALFORMED("no face with an area", V3 "v 2 0 0\nf 1 2 4\nf 3 3 3\n", SRP_BAD_DATA,
              "f: none of its triangles has an area"),
};

START_TEST(malformed_texts_are_refused) {
    const malformed *bad = &BAD[_i];
    srp_mesh *mesh = (srp_mesh *)&mesh;
    srp_error error;
    srp_status status = srp_mesh_parse_obj(bad->text, bad->size, "f", NULL, NULL, &mesh, &error);
    assert_refused(bad, status, &error);
    ck_assert_ptr_eq(mesh, (srp_mesh *)&mesh);
    ck_assert_int_eq(srp_mesh_parse_obj(bad->text, bad->size, "f", NULL, NULL, &mesh, NULL),
                     bad->status);
}
END_TEST

/* Cut anywhere, a good file is read or refused; its first part never gives wrong numbers. */
START_TEST(truncated_files_are_refused_or_shorter) {
    srp_mesh *mesh;
    srp_error error;
    for (size_t size = 0; size < strlen(PLAIN); ++size) {
        srp_status status = srp_mesh_parse_obj(PLAIN, size, "f", NULL, NULL, &mesh, &error);
        if (status == SRP_OK) {
            ck_assert_uint_eq(srp_mesh_vertex_count(mesh), 4);
            srp_mesh_destroy(mesh);
        } else {
            ck_assert_int_eq(status, SRP_BAD_FORMAT);
        }
    }
}
END_TEST

START_TEST(enormous_faces_are_refused) {
    size_t size = 60 + 2 * ((size_t)SRP_POLYGON_MAX + 1);
    char *text = malloc(size);
    ck_assert_ptr_nonnull(text);
    size_t used = (size_t)snprintf(text, size, V3 "f ");
    for (int i = 0; i < SRP_POLYGON_MAX + 1; ++i) {
        memcpy(text + used, "1 ", 2);
        used += 2;
    }
    srp_mesh *mesh;
    srp_error error;
    ck_assert_int_eq(srp_mesh_parse_obj(text, used, "f", NULL, NULL, &mesh, &error),
                     SRP_BAD_FORMAT);
    ck_assert_str_eq(error.message, "a face of more than 10000 vertices: split it");
    ck_assert_uint_eq(error.line, 4);
    free(text);
}
END_TEST

START_TEST(files_that_cannot_be_read) {
    srp_mesh *mesh;
    srp_error error;
    ck_assert_int_eq(srp_mesh_read_obj("no/such.obj", NULL, NULL, &mesh, &error), SRP_NOT_FOUND);
    ck_assert_str_eq(error.file, "no/such.obj");
    ck_assert_int_eq(srp_mesh_read_obj(".", NULL, NULL, &mesh, &error), SRP_IO);
    ck_assert_ptr_nonnull(strstr(error.message, "is a directory"));
    ck_assert_int_eq(srp_mesh_read_obj("/dev/zero", NULL, NULL, &mesh, &error), SRP_BAD_FORMAT);
    ck_assert_ptr_nonnull(strstr(error.message, "binary"));
}
END_TEST

/* One line of 1 GB comes through a pipe: it is refused after its first megabyte. */
START_TEST(endless_line_is_refused_early) {
    const char *pipe_name = "test_obj.pipe";
    unlink(pipe_name);
    ck_assert_int_eq(mkfifo(pipe_name, 0600), 0);
    pid_t writer = fork();
    ck_assert_int_ge(writer, 0);
    if (writer == 0) {
        static char piece[1 << 16];
        memset(piece, '7', sizeof piece);
        signal(SIGPIPE, SIG_IGN);
        int out = open(pipe_name, O_WRONLY);
        long written = 0;
        while (written < 1L << 30 && write(out, piece, sizeof piece) == (ssize_t)sizeof piece) {
            written += (long)sizeof piece;
        }
        _exit(written < 4L << 20 ? 0 : 1);
    }
    srp_mesh *mesh;
    srp_error error;
    srp_status status = srp_mesh_read_obj(pipe_name, NULL, NULL, &mesh, &error);
    int result;
    waitpid(writer, &result, 0);
    unlink(pipe_name);
    ck_assert_int_eq(status, SRP_BAD_FORMAT);
    ck_assert_uint_eq(error.line, 1);
    ck_assert_ptr_nonnull(strstr(error.message, "longer than 1048576 bytes"));
    ck_assert_msg(WIFEXITED(result) && WEXITSTATUS(result) == 0, "more than 4 MB were read");
}
END_TEST

START_TEST(lro_meshes) {
    static const struct {
        const char *path;
        size_t triangles, faces_triangle, faces_quad, materials;
    } want[] = {{SRP_SHARED_DATA_DIR "/lro/bus.obj", 5362, 846, 2258, 4},
                {SRP_SHARED_DATA_DIR "/lro/HGA.obj", 576, 64, 256, 2}};
    for (int i = 0; i < 2; ++i) {
        srp_mesh *mesh;
        srp_mesh_report report;
        srp_error error;
        log_keeper keeper = {0};
        srp_log log = {log_keeper_warn, &keeper};
        srp_status status = srp_mesh_read_obj(want[i].path, NULL, &log, &mesh, &error);
        if (status == SRP_NOT_FOUND) {
            printf("skipped: %s is not there\n", want[i].path);
            return;
        }
        assert_ok(status, error);
        assert_ok(srp_mesh_inspect(mesh, &report, &error), error);
        ck_assert_uint_eq(report.triangles, want[i].triangles);
        ck_assert_uint_eq(report.faces_triangle, want[i].faces_triangle);
        ck_assert_uint_eq(report.faces_quad, want[i].faces_quad);
        ck_assert_uint_eq(srp_mesh_material_count(mesh), want[i].materials);
        ck_assert_uint_eq(srp_mesh_library_count(mesh), 1);
        ck_assert_uint_gt(report.boundary_edges, 0);
        ck_assert_uint_lt(keeper.count, 20);
        srp_mesh_destroy(mesh);
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("obj");
    TCase *tcase = tcase_create("obj");
    tcase_add_test(tcase, all_spellings_give_the_same_mesh);
    tcase_add_test(tcase, materials_are_those_of_faces);
    tcase_add_test(tcase, names_that_are_not_utf8_are_spelt_out);
    tcase_add_test(tcase, libraries_are_found_beside_the_file);
    tcase_add_test(tcase, polygons_are_split_and_counted);
    tcase_add_test(tcase, units_scale_the_vertices);
    tcase_add_test(tcase, flawed_faces_are_warned_of_but_not_each);
    tcase_add_test(tcase, locale_does_not_matter);
    tcase_add_loop_test(tcase, malformed_texts_are_refused, 0, sizeof BAD / sizeof *BAD);
    tcase_add_test(tcase, truncated_files_are_refused_or_shorter);
    tcase_add_test(tcase, enormous_faces_are_refused);
    tcase_add_test(tcase, files_that_cannot_be_read);
    tcase_add_test(tcase, endless_line_is_refused_early);
    tcase_add_test(tcase, lro_meshes);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
