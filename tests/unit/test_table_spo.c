/* SPDX-License-Identifier: Apache-2.0 */
#include "gmat_spo_rules.h"
#include "srp_check.h"
#include "table_fixture.h"
#include "table_internal.h"

#include <locale.h>
#include <string.h>

/* ---- A file to change ----------------------------------------------------------------------- */

/* 3 azimuths x 2 elevations. */
static const char GOOD[] = "Version            : 4.27\n"                   /* 1 */
                           "System             : test\n"                   /* 2 */
                           "Analysis Type      : Area\n"                   /* 3 */
                           "Pressure           : 1\n"                      /* 4 */
                           "Center of Mass     : (1, -2.5, 3e-1)\n"        /* 5 */
                           "Current time       : May 7, 2009 15:53:38\n"   /* 6 */
                           "\n"                                            /* 7 */
                           "Motion    : 1\n"                               /* 8 */
                           "  Name    : Azimuth\n"                         /* 9 */
                           "  Method  : Step\n"                            /* 10 */
                           "  Minimum : -180\n"                            /* 11 */
                           "  Maximum : 180\n"                             /* 12 */
                           "  Step    : 180\n"                             /* 13 */
                           "Motion    : 2\n"                               /* 14 */
                           "  Name    : Elevation\n"                       /* 15 */
                           "  Method  : Step\n"                            /* 16 */
                           "  Minimum : -90\n"                             /* 17 */
                           "  Maximum : 90\n"                              /* 18 */
                           "  Step    : 180\n"                             /* 19 */
                           ": END\n"                                       /* 20 */
                           "Record count       : 6\n"                      /* 21 */
                           " AzimuthElevatio Force(X) Force(Y) Force(Z)\n" /* 22 */
                           " degrees degrees m^2 m^2 m^2\n"                /* 23 */
                           " ------- ------- --- --- ---\n"                /* 24 */
                           " -180.00 -90.00 1 2 3\n"                       /* 25 */
                           " -180.00  90.00 4 5 6\n"                       /* 26 */
                           "    0.00 -90.00 7 8 9\n"                       /* 27 */
                           "    0.00  90.00 10 11 12\n"                    /* 28 */
                           "  180.00 -90.00 13 14 15\n"                    /* 29 */
                           "  180.00  90.00 16 17 -1.75e1\n";              /* 30 */

/* GOOD with the first `find` replaced; freed by free(). */
static char *changed(const char *find, const char *replace) {
    const char *at = strstr(GOOD, find);
    ck_assert_msg(at != NULL, "'%s' is not in the file", find);
    size_t head = (size_t)(at - GOOD), tail = strlen(at + strlen(find));
    char *text = calloc(head + strlen(replace) + tail + 1, 1);
    ck_assert_ptr_nonnull(text);
    memcpy(text, GOOD, head);
    memcpy(text + head, replace, strlen(replace));
    memcpy(text + head + strlen(replace), at + strlen(find), tail);
    return text;
}

static srp_table *parse(const char *text) {
    srp_table *table = NULL;
    srp_error error;
    assert_ok(srp_table_parse_spo(text, strlen(text), "test.spo", &table, &error), error);
    return table;
}

static void assert_refused(const char *text, size_t size, size_t line, const char *words) {
    srp_table *table = NULL;
    srp_error error;
    srp_status status = srp_table_parse_spo(text, size, "test.spo", &table, &error);
    ck_assert_msg(status == SRP_BAD_FORMAT, "'%s': status '%s'", words, srp_status_string(status));
    ck_assert_str_eq(error.file, "test.spo");
    ck_assert_msg(strstr(error.message, words) != NULL, "'%s' lacks '%s'", error.message, words);
    ck_assert_msg(error.line == line, "'%s' in line %zu, expected line %zu", error.message,
                  error.line, line);
    ck_assert_ptr_null(table);
    ck_assert_int_eq(srp_table_parse_spo(text, size, "test.spo", &table, NULL), SRP_BAD_FORMAT);
}

/* ---- What is taken -------------------------------------------------------------------------- */

START_TEST(a_plain_file_is_read) {
    ck_assert_ptr_null(gmat_spo_broken_rule(GOOD));
    srp_table *table = parse(GOOD);
    srp_grid grid = srp_table_grid(table);
    ck_assert(grid.az_count == 3 && grid.el_count == 2);
    ck_assert(srp_table_is_complete(table));
    for (uint32_t i = 0; i < 3; ++i) {
        for (uint32_t j = 0; j < 2; ++j) {
            double first = 3.0 * (2.0 * i + j) + 1.0;
            srp_vec3 f = srp_table_node(table, i, j)->f;
            ck_assert(f.x == first && f.y == first + 1.0);
            ck_assert(f.z == (first == 16.0 ? -17.5 : first + 2.0));
        }
    }
    const srp_table_info *info = srp_table_get_info(table);
    ck_assert_str_eq(info->title, "test");
    ck_assert_str_eq(info->method, "");
    ck_assert_str_eq(info->shape_hash, "");
    ck_assert(!info->has_error && !info->has_moment && !info->has_basis);
    ck_assert(isnan(info->mass));
    ck_assert_uint_eq(srp_table_material_count(table), 0);
    srp_table_destroy(table);
}
END_TEST

START_TEST(whatever_gmat_takes_is_taken) {
    const struct {
        const char *find, *replace;
    } cases[] = {
        {": END\n", ""},
        {": END\n", "  : END of it\n\n\n"},
        {"Version            : 4.27\n", ""},
        {"Pressure           : 1\n", ""},
        {"Center of Mass     : (1, -2.5, 3e-1)\n", "Center of Mass : somewhere\n"},
        {"Center of Mass     : (1, -2.5, 3e-1)\n", "Pixel Size : 5\nReemission Pct\t: 63%\n"},
        {"Current time       : May 7, 2009 15:53:38\n", ""},
        {" ------- ------- --- --- ---\n", ""},
        {"Force(X) Force(Y) Force(Z)", ""},
        {"16 17 -1.75e1\n", "16 17 -1.75e1"},
        {"16 17 -1.75e1\n", "16\t17 -1.75e1\n ---- ----\n\n"},
        {" -180.00 -90.00 1 2 3", "\t-180.1 -90.1\t1 2.0 +3.0000000000000000e+00   "},
        {"  Step    : 180\nMotion", "Step:1.8e2\nMotion"},
        {"m^2 m^2 m^2", "m^2 m^2 m^2 stone stone"},
        {"Version", "\xef\xbb\xbfVersion"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        char *text = changed(cases[k].find, cases[k].replace);
        srp_table *table = parse(text);
        ck_assert(srp_table_node(table, 0, 0)->f.x == 1.0);
        ck_assert(srp_table_node(table, 2, 1)->f.z == -17.5);
        srp_table_destroy(table);
        if (strncmp(text, "\xef\xbb\xbf", 3) != 0) {
            const char *broken = gmat_spo_broken_rule(text);
            ck_assert_msg(broken == NULL, "%s", broken);
        }
        free(text);
    }
}
END_TEST

START_TEST(line_ends_of_every_system_are_taken) {
    char text[2 * sizeof GOOD];
    size_t size = 0;
    for (const char *at = GOOD; *at != '\0'; ++at) {
        if (*at == '\n') {
            text[size++] = '\r';
        }
        text[size++] = *at;
    }
    text[size] = '\0';
    srp_table *table = parse(text);
    ck_assert(srp_table_node(table, 2, 1)->f.z == -17.5);
    srp_table_destroy(table);
}
END_TEST

START_TEST(units_are_converted) {
    const struct {
        const char *unit;
        double square_metres;
    } cases[] = {{"mm^2", 1e-6}, {"cm^2", 1e-4}, {"in^2", 6.4516e-4}, {"ft^2", 9.290304e-2}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        char units[32];
        snprintf(units, sizeof units, "%s m^2 %s", cases[k].unit, cases[k].unit);
        char *text = changed("m^2 m^2 m^2", units);
        srp_table *table = parse(text);
        srp_vec3 f = srp_table_node(table, 1, 1)->f;
        assert_close(f.x, 10.0 * cases[k].square_metres, 4e-16, 0.0);
        ck_assert(f.y == 11.0);
        assert_close(f.z, 12.0 * cases[k].square_metres, 4e-16, 0.0);
        srp_table_destroy(table);
        free(text);
    }
}
END_TEST

/* ---- A |f| that its row belies -------------------------------------------------------------- */

/* Warnings about the sixth column go to `user`. */
static void keep_total(void *user, const srp_error *what) {
    if (strstr(what->message, "sixth column") != NULL) {
        *(srp_error *)user = *what;
    }
}

/* What is said of GOOD with these units in place of its own and this first row. */
static srp_error said_of_total(const char *units, const char *row) {
    srp_error said = {.line = 0};
    const srp_log log = {keep_total, &said};
    char *some = changed("m^2 m^2 m^2", units);
    char *at = strstr(some, " -180.00 -90.00 1 2 3\n");
    ck_assert_ptr_nonnull(at);
    size_t size = strlen(some) + 400;
    char *text = calloc(size, 1);
    ck_assert_ptr_nonnull(text);
    snprintf(text, size, "%.*s -180.00 -90.00 %s\n", (int)(at - some), some, row);
    /* The other rows have a sixth column, too, that is right. */
    for (const char *line = strchr(at, '\n') + 1; *line != '\0'; line = strchr(line, '\n') + 1) {
        double f[5];
        ck_assert_int_eq(sscanf(line, "%lf %lf %lf %lf %lf", &f[0], &f[1], &f[2], &f[3], &f[4]), 5);
        snprintf(text + strlen(text), size - strlen(text), "%g %g %g %g %g %.4f\n", f[0], f[1],
                 f[2], f[3], f[4], sqrt(f[2] * f[2] + f[3] * f[3] + f[4] * f[4]));
    }
    srp_table *table = parse(text);
    srp_table_inspect(table, "some.spo", &log, NULL);
    srp_table_destroy(table);
    free(text);
    free(some);
    return said;
}

START_TEST(a_total_that_its_row_belies_is_told) {
    ck_assert_uint_eq(said_of_total("m^2 m^2 m^2 m^2", "1 2 3 3.7417").line, 0);
    ck_assert_uint_eq(said_of_total("m^2 m^2 m^2 cm^2", "1 2 3 37417").line, 30);
    ck_assert_uint_eq(said_of_total("m^2 m^2 m^2 stone", "1 2 3 99").line, 0);
    ck_assert_uint_eq(said_of_total("m^2 m^2 m^2", "1 2 3 99").line, 0);
    ck_assert_uint_eq(said_of_total("m^2 m^2 m^2 m^2", "1 2 3 none").line, 0);
    const srp_error said = said_of_total("m^2 m^2 m^2 m^2", "1 2 33 3.7417");
    ck_assert_str_eq(said.file, "some.spo");
    ck_assert_uint_eq(said.line, 25);
    ck_assert_ptr_nonnull(strstr(said.message, "a |f| of 3.7417 m^2, which is 29.3 m^2 from"));
    /* GOOD has none. */
    srp_error none = {.line = 0};
    const srp_log log = {keep_total, &none};
    srp_table *table = parse(GOOD);
    srp_table_inspect(table, "some.spo", &log, NULL);
    ck_assert_uint_eq(none.line, 0);
    srp_table_destroy(table);
}
END_TEST

/* ---- What is refused ------------------------------------------------------------------------ */

START_TEST(malformed_files_are_refused_with_their_place) {
    const struct {
        const char *find, *replace;
        size_t line;
        const char *words;
    } cases[] = {
        {"System             : test", "System             : C:\\test", 2, "found 2 colons"},
        {"System             : test", "System test", 2, "found 0 colons"},
        {"System             : test", "System             :", 2, "expected 'key : value'"},
        {"System             : test", ": test", 2, "expected 'key : value'"},
        {": Area", ": Force", 3, "expected the analysis type 'Area'"},
        {": Area", ": area", 3, "expected the analysis type 'Area'"},
        {"Analysis Type", "Analysis", 22, "expected 'Analysis Type : Area'"},
        {"Motion    : 1", "Motion    : 2", 8, "'2', expected 1, the motion in azimuth"},
        {"Motion    : 2", "Motion    : x", 14, "'x', expected 2, the motion in elevation"},
        {": END", "Motion : 3", 20, "no third"},
        /* Found by fuzzing: a field before any motion. */
        {"Motion    : 1", "Motions   : 1", 8, "'Motions', expected 'Motion : 1'"},
        {"Azimuth", "Elevation", 8, "'Name : Azimuth' and 'Method : Step'"},
        {"Elevation", "Azimuth", 14, "'Name : Elevation' and 'Method : Step'"},
        {"  Name    : Azimuth\n", "", 8, "'Name : Azimuth' and 'Method : Step'"},
        {": Step", ": List", 8, "'Name : Azimuth' and 'Method : Step'"},
        {": -180", ": 0", 8, "found Azimuth from 0 to 180"},
        {": 90", ": 85", 14, "found Elevation from -90 to 85"},
        {"  Minimum : -90\n", "", 14, "found Elevation from nan"},
        {"  Step    : 180\n", "", 8, "expected 'Step : DEGREES'"},
        {"  Step    : 180", "  Step    : 7", 8, "step of 7 degrees does not divide 360"},
        {"  Step    : 180", "  Step    : 0.7", 8, "does not divide 360"},
        {"  Step    : 180", "  Step    : 0", 8, "azimuth step of 0"},
        {"  Step    : 180", "  Step    : -180", 8, "azimuth step of -180"},
        {"  Step    : 180", "  Step    : nan", 13, "'nan', expected a finite number: the step"},
        {"  Step    : 180", "  Step    : 0.01", 8, "more than a file of"},
        {"  Step    : 180", "  Stride  : 180", 13, "'Stride', expected Motion, Name"},
        {": 6", ": 7", 22, "record count of 7, expected the 6"},
        {": 6", ": 5", 22, "record count of 5, expected the 6"},
        {": 6", ": -6", 21, "'-6', expected a whole number"},
        {": 6", ": 99999999999999999999", 21, ": the number of records"},
        {"Record count       : 6\n", "", 21, "expected 'Record count : N'"},
        {"Record count ", "Number of them ", 21, "expected 'Record count : N'"},
        {" AzimuthElevatio Force(X) Force(Y) Force(Z)\n", "", 22, "found 0 colons"},
        {" degrees degrees m^2 m^2 m^2\n", "", 24, "expected a line of units"},
        {"degrees degrees", "degrees radians", 23, "'radians', expected the unit 'degrees'"},
        {"degrees degrees", "degree degrees", 23, "'degree', expected the unit 'degrees'"},
        {"m^2 m^2 m^2", "m^2 m^2 km^2", 23, "'km^2', expected a unit of force"},
        {"m^2 m^2 m^2", "m^2 m^2", 23, "expected a unit of force"},
        {"m^2 m^2 m^2", "m ^2 m^2", 23, "'m', expected a unit of force"},
        {" 0.00 -90.00 7 8 9", " 0.00  90.00 7 8 9", 27, "found elevation 90, expected -90"},
        {"    0.00 -90.00 7 8 9\n", "", 27, "found elevation 90, expected -90"},
        {"    0.00 -90.00 7 8 9", "    1.00 -90.00 7 8 9", 27, "found azimuth 1, expected 0"},
        {"    0.00 -90.00 7 8 9", "    0.00 -90.00 7 8", 27, "expected a finite number: Force(Z)"},
        {"    0.00 -90.00 7 8 9", "    0.00 -90.00 7 NaN 9", 27,
         "'NaN', expected a finite number: Force(Y)"},
        {"    0.00 -90.00 7 8 9", "    0.00 -90.00 inf 8 9", 27,
         "'inf', expected a finite number: Force(X)"},
        {"    0.00 -90.00 7 8 9", "    0.00 -90.00 1e999 8 9", 27, "1e999"},
        {"    0.00 -90.00 7 8 9", "    0.00, -90.00, 7, 8, 9", 27,
         "'0.00,', expected a finite number: azimuth"},
        {"    0.00 -90.00 7 8 9", "# a remark", 27, "'#', expected a finite number: azimuth"},
        {"    0.00 -90.00 7 8 9", "    0.00 -90.00 7 0x8 9", 27,
         "'0x8', expected a finite number: Force(Y)"},
        {"  180.00  90.00 16 17 -1.75e1\n", "", 30, "ends after 5 records, expected 6"},
        {"-1.75e1\n", "-1.75e1\n180 90 1 2 3\n", 31, "found more than the 6 rows"},
        {"  Minimum : -180\n", "  Minimum : x\n", 11,
         "'x', expected a finite number: the smallest angle"},
    };
    size_t count = sizeof cases / sizeof cases[0];
    ck_assert_uint_ge(count, 20);
    for (size_t k = 0; k < count; ++k) {
        char *text = changed(cases[k].find, cases[k].replace);
        assert_refused(text, strlen(text), cases[k].line, cases[k].words);
        ck_assert_msg(gmat_spo_broken_rule(text) != NULL, "the checker takes '%s'",
                      cases[k].replace);
        free(text);
    }
}
END_TEST

START_TEST(columns_are_named) {
    char *text = changed("7 8 9", "7 8 9x");
    srp_table *table = NULL;
    srp_error error;
    ck_assert_int_eq(srp_table_parse_spo(text, strlen(text), "a.spo", &table, &error),
                     SRP_BAD_FORMAT);
    ck_assert_uint_eq(error.line, 27);
    ck_assert_uint_eq(error.column, 21);
    free(text);
}
END_TEST

/* |f| would be infinite: what is read must be writable. */
START_TEST(forces_out_of_all_range_are_refused) {
    srp_table *table = NULL;
    srp_error error;
    char *text = changed("7 8 9", "7 -1e300 9");
    ck_assert_int_eq(srp_table_parse_spo(text, strlen(text), "a.spo", &table, &error),
                     SRP_BAD_DATA);
    ck_assert_ptr_nonnull(strstr(error.message, "found '-1e300': Force(Y) is -1e+300 in metres"));
    ck_assert(error.line == 27 && error.column == 19);
    free(text);
    ck_assert_ptr_null(table);
}
END_TEST

/* ... to the last column, which is made of products of two of them. */
START_TEST(the_largest_forces_are_written_and_read) {
    const char path[] = "scratch_large.spo";
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_table *table = noise_table(&fixture, grid_of(90, 90), false), *back;
    srp_error error;
    for (size_t k = 0; k < srp_grid_node_count(table->grid); ++k) {
        table->nodes[k].f = srp_vec3_make(1e100, -1e100, 0.3e100);
        table->nodes[k].t = srp_vec3_make(-1e100, 0.7e100, 1e100);
    }
    assert_ok(srp_table_write(table, &srp_table_format_spo, path, &error), error);
    size_t size;
    char *text = read_bytes(path, &size);
    ck_assert_ptr_null(strstr(text, "inf"));
    ck_assert_ptr_null(strstr(text, "nan"));
    free(text);
    assert_ok(srp_table_read(&srp_table_format_spo, path, &back, &error), error);
    ck_assert(back->nodes[4].f.y == -1e100 && back->nodes[4].t.z == 1e100);
    srp_table_destroy(back);
    srp_table_destroy(table);
    fixture_destroy(fixture);
    remove(path);
}
END_TEST

/* GMAT ignores what stands behind the fifth column, but rows of different lengths are damaged. */
START_TEST(all_rows_have_as_many_columns_as_the_first) {
    char wide[2 * sizeof GOOD];
    size_t size = 0;
    for (const char *at = GOOD, *rows = strstr(GOOD, " -180.00 -90"); *at != '\0'; ++at) {
        if (*at == '\n' && at > rows) {
            size += (size_t)snprintf(wide + size, sizeof wide - size, " x -");
        }
        wide[size++] = *at;
    }
    wide[size] = '\0';
    srp_table_destroy(parse(wide));
    const char *cut = strstr(wide, "15 x -") + 4;
    char *text = calloc(size + 1, 1);
    ck_assert_ptr_nonnull(text);
    memcpy(text, wide, (size_t)(cut - wide));
    strcat(text, strchr(cut, '\n'));
    assert_refused(text, strlen(text), 29, "found 6 columns, expected 7 as in the first row");
    free(text);
    text = changed("7 8 9", "7 8 9 1");
    assert_refused(text, strlen(text), 27, "found 6 columns, expected 5 as in the first row");
    free(text);
}
END_TEST

START_TEST(what_decides_is_said_once) {
    const struct {
        const char *find, *replace;
        size_t line;
        const char *words;
    } cases[] = {
        {"Pressure           : 1", "Analysis Type : Area", 4,
         "found 'Analysis Type' again, expected it once: it is given in line 3"},
        {"Pressure           : 1", "Center of Mass : (0, 0, 0)", 5,
         "found 'Center of Mass' again, expected it once: it is given in line 4"},
        {"  Step    : 180\n", "  Step    : 180\n  Step : 90\n", 14,
         "found 'Step' again, expected it once: it is given in line 13"},
        {"  Name    : Azimuth\n", "  Name : Azimuth\n  Name : Azimuth\n", 10, "in line 9"},
        {"  Maximum : 90\n", "  Maximum : 90\n  Maximum : 90\n", 19, "in line 18"},
        {": 6\n", ": 6\nRecord count : 6\n", 22,
         "found 'Record count' again, expected it once: it is given in line 21"},
        {" ------- ------- --- --- ---", " degrees degrees mm^2 mm^2 mm^2", 24,
         "found 'degree' again, expected it once: it is given in line 23"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        char *text = changed(cases[k].find, cases[k].replace);
        assert_refused(text, strlen(text), cases[k].line, cases[k].words);
        free(text);
    }
}
END_TEST

START_TEST(a_file_cut_anywhere_is_refused) {
    size_t size = sizeof GOOD - 1;
    for (size_t cut = 0; cut < size - 1; ++cut) {
        srp_table *table = NULL;
        srp_error error;
        srp_status status = srp_table_parse_spo(GOOD, cut, "cut.spo", &table, &error);
        /* Only the last number can lose digits without a trace. */
        if (cut >= size - strlen("1.75e1\n")) {
            srp_table_destroy(table);
        } else {
            ck_assert_msg(status == SRP_BAD_FORMAT, "cut at %zu: %s", cut,
                          srp_status_string(status));
        }
    }
}
END_TEST

START_TEST(what_is_no_text_is_refused) {
    static const char BINARY[] = "\211HDF\r\n\032\n\0\1\2\3";
    assert_refused("", 0, 1, "ends before any data");
    assert_refused("\n\n  \n", 5, 4, "ends before any data");
    assert_refused(BINARY, sizeof BINARY, 3, "binary");
    assert_refused("Motion", 6, 1, "found 0 colons");
    assert_refused("Azimuth", 7, 1, "expected 'Analysis Type : Area'");
    assert_refused(": END\nMotion : 1\nName : Azimuth\n", 32, 1, "expected 'key : value'");
    srp_table *table = NULL;
    srp_error error;
    ck_assert_int_eq(srp_table_read(&srp_table_format_spo, ".", &table, &error), SRP_IO);
    ck_assert_ptr_nonnull(strstr(error.message, "is a directory"));
    ck_assert_int_eq(srp_table_read(&srp_table_format_spo, "none.spo", &table, &error),
                     SRP_NOT_FOUND);
    ck_assert_ptr_null(table);
}
END_TEST

/* One byte at a time changed to one that upsets parsers: refused or read, never more. */
START_TEST(no_single_byte_does_harm) {
    static const char BYTES[] = {'\0', ':', '\n', ' ', '-', '9', 'e', '"', '\177', '\xff', '#'};
    char text[sizeof GOOD];
    for (size_t k = 0; k < sizeof GOOD - 1; ++k) {
        for (size_t n = 0; n < sizeof BYTES; ++n) {
            srp_table *table = NULL;
            memcpy(text, GOOD, sizeof GOOD);
            text[k] = BYTES[n];
            srp_status status =
                srp_table_parse_spo(text, sizeof GOOD - 1, "byte.spo", &table, NULL);
            ck_assert((status == SRP_OK) == (table != NULL));
            ck_assert(status == SRP_OK || status == SRP_BAD_FORMAT);
            srp_table_destroy(table);
        }
    }
}
END_TEST

/* ---- What we write -------------------------------------------------------------------------- */

static char *written(const srp_table *table, const char *path) {
    srp_error error;
    size_t size;
    assert_ok(srp_table_write(table, &srp_table_format_spo, path, &error), error);
    return read_bytes(path, &size);
}

START_TEST(our_files_keep_gmats_rules) {
    const struct {
        double az_step, el_step;
    } grids[] = {{5, 5}, {10, 5}, {0.5, 90}, {22.5, 22.5}, {360, 180}, {51.4285714286, 20},
                 {20, 1}};
    const srp_method *methods[] = {&noise_method, &srp_method_nplate, &srp_method_cannonball};
    const char path[] = "scratch_rules.spo";
    for (size_t m = 0; m < 3; ++m) {
        table_fixture fixture = fixture_create(methods[m], NULL);
        for (size_t k = 0; k < sizeof grids / sizeof grids[0]; ++k) {
            srp_table *table =
                noise_table(&fixture, grid_of(grids[k].az_step, grids[k].el_step), false);
            char *text = written(table, path);
            const char *broken = gmat_spo_broken_rule(text);
            ck_assert_msg(broken == NULL, "%g x %g: %s", grids[k].az_step, grids[k].el_step,
                          broken);
            free(text);
            srp_table_destroy(table);
        }
        fixture_destroy(fixture);
    }
    remove(path);
}
END_TEST

/* Bytes from the end to the beginning of the third row from it. */
static size_t last_rows(const char *text, size_t size) {
    size_t begin = size;
    for (int rows = 0; rows < 4;) {
        rows += text[--begin] == '\n';
    }
    return size - begin - 1;
}

/* However few bytes are missing, be they digits of the last number. */
START_TEST(our_files_cut_in_the_last_rows_are_refused) {
    const char path[] = "scratch_cut.spo";
    const srp_method *methods[] = {&noise_method, &srp_method_cannonball}; /* 11 and 5 columns */
    for (size_t m = 0; m < 2; ++m) {
        table_fixture fixture = fixture_create(methods[m], NULL);
        srp_table *table = noise_table(&fixture, grid_of(90, 90), false), *again = NULL;
        for (int pass = 0; pass < 2; ++pass) {
            char *text = written(table, path);
            size_t size = strlen(text), rows = last_rows(text, size);
            ck_assert_uint_gt(rows, 3 * 80);
            for (size_t cut = size - rows; cut < size; ++cut) {
                srp_table *none = NULL;
                srp_error error;
                ck_assert_msg(srp_table_parse_spo(text, cut, "cut.spo", &none, &error) ==
                                  SRP_BAD_FORMAT,
                              "%zu bytes are missing", size - cut);
            }
            srp_table_destroy(table);
            /* A second time as a table that was read, not computed. */
            again = parse(text);
            table = again;
            free(text);
        }
        srp_table_destroy(again);
        fixture_destroy(fixture);
    }
    remove(path);
}
END_TEST

/* Names that a user may give must not upset GMAT. */
START_TEST(odd_titles_keep_gmats_rules) {
    const char *titles[] = {
        "",           " ",        ":",   "C:\\models\\a.obj", "a\nMotion : 1", "a: b: c", "\t",
        "Current: x", "\x7f\x01", "END", "name \xc3\xa9"};
    const char path[] = "scratch_titles.spo";
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_table *table = noise_table(&fixture, grid_of(90, 90), false);
    for (size_t k = 0; k < sizeof titles / sizeof titles[0]; ++k) {
        srp_error error;
        assert_ok(
            srp_table_describe(table, titles[k], titles[k], srp_sunlight_default(), NAN, &error),
            error);
        char *text = written(table, path);
        const char *broken = gmat_spo_broken_rule(text);
        ck_assert_msg(broken == NULL, "title %zu: %s", k, broken);
        srp_table_destroy(parse(text));
        free(text);
    }
    srp_table_destroy(table);
    fixture_destroy(fixture);
    remove(path);
}
END_TEST

START_TEST(force_and_torque_come_back_to_the_bit) {
    const char path[] = "scratch_back.spo";
    srp_method_params params = fixture_params(1);
    params.reference = srp_vec3_make(0.1, -2.0 / 3.0, 1e-9);
    table_fixture fixture = fixture_create(&noise_method, &params);
    srp_grid grid = grid_of(22.5, 20);
    srp_table *table = noise_table(&fixture, grid, true), *back;
    srp_error error;
    assert_ok(srp_table_write(table, &srp_table_format_spo, path, &error), error);
    assert_ok(srp_table_read(&srp_table_format_spo, path, &back, &error), error);
    const srp_table_info *info = srp_table_get_info(back);
    ck_assert(info->has_moment && !info->has_error && !info->has_basis);
    ck_assert_mem_eq(&info->params.reference, &params.reference, sizeof params.reference);
    ck_assert_str_eq(info->title, "box, with a \"wing\"  1");
    for (uint32_t i = 0; i < grid.az_count; ++i) {
        for (uint32_t j = 0; j < grid.el_count; ++j) {
            const srp_response *a = srp_table_node(table, i, j), *b = srp_table_node(back, i, j);
            ck_assert_mem_eq(&a->f, &b->f, sizeof a->f);
            ck_assert_mem_eq(&a->t, &b->t, sizeof a->t);
            ck_assert(b->lit_area == 0.0 && b->samples == 0);
        }
    }
    srp_table_destroy(back);
    srp_table_destroy(table);
    fixture_destroy(fixture);
    remove(path);
}
END_TEST

/* nc -> spo -> nc: the force is the same, the rest is gone and said to be. */
START_TEST(a_table_survives_the_way_through_netcdf_and_back) {
    const char *paths[] = {"scratch_way.nc", "scratch_way.spo"};
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_grid grid = grid_of(30, 30);
    srp_table *table = noise_table(&fixture, grid, true);
    const srp_table_format *way[] = {&srp_table_format_netcdf, &srp_table_format_spo,
                                     &srp_table_format_netcdf};
    srp_table *now = table;
    srp_error error;
    for (size_t k = 0; k < 3; ++k) {
        srp_table *next;
        assert_ok(srp_table_write(now, way[k], paths[k % 2], &error), error);
        assert_ok(srp_table_read(way[k], paths[k % 2], &next, &error), error);
        if (now != table) {
            srp_table_destroy(now);
        }
        now = next;
    }
    ck_assert(!srp_table_get_info(now)->has_error && srp_table_get_info(now)->has_moment);
    for (size_t k = 0; k < srp_grid_node_count(grid); ++k) {
        ck_assert_mem_eq(&now->nodes[k].f, &table->nodes[k].f, sizeof(srp_vec3));
        ck_assert_mem_eq(&now->nodes[k].t, &table->nodes[k].t, sizeof(srp_vec3));
    }
    ck_assert_int_eq(srp_table_check_origin(now, fixture.prepared, grid, false, &error),
                     SRP_MISMATCH);
    srp_table_destroy(now);
    srp_table_destroy(table);
    fixture_destroy(fixture);
    remove(paths[0]);
    remove(paths[1]);
}
END_TEST

/* The Sun on +X pushes towards -X: GMAT's sign. The columns that GMAT does not read are sums of
 * those that it does. */
START_TEST(columns_mean_what_they_say) {
    const char path[] = "scratch_columns.spo";
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_table *table = noise_table(&fixture, grid_of(90, 90), false);
    char *text = written(table, path);
    const char *at = strstr(text, "\n    0.00    0.00");
    ck_assert_ptr_nonnull(at);
    double c[11];
    char *end = (char *)at;
    for (int k = 0; k < 11; ++k) {
        c[k] = strtod(end, &end);
    }
    srp_vec3 f = srp_vec3_make(c[2], c[3], c[4]), t = srp_vec3_make(c[6], c[7], c[8]);
    ck_assert(c[2] < 0.0);
    assert_close(c[5], srp_vec3_norm(f), 1e-15, 0.0);
    assert_close(c[9], srp_vec3_norm(t), 1e-15, 0.0);
    /* The line of the force passes through r with t = r x f, up to the part of t along f. */
    srp_vec3 r = srp_vec3_scale(1.0 / srp_vec3_dot(f, f), srp_vec3_cross(f, t));
    assert_close(c[10], srp_vec3_norm(r), 1e-14, 0.0);
    srp_vec3 across = srp_vec3_add_scaled(t, -srp_vec3_dot(t, f) / srp_vec3_dot(f, f), f);
    assert_vec3_close(srp_vec3_cross(r, f), across, 1e-14, 0.0);
    free(text);
    srp_table_destroy(table);
    fixture_destroy(fixture);
    remove(path);
}
END_TEST

/* Both ways are the C locale's, whatever the program has set. */
START_TEST(numbers_have_points_in_every_locale) {
    const char path[] = "scratch_locale.spo";
    if (setlocale(LC_ALL, "de_DE.UTF-8") == NULL && setlocale(LC_ALL, "fr_FR.UTF-8") == NULL) {
        printf("skipped: no locale with a decimal comma\n");
    }
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_table *table = noise_table(&fixture, grid_of(90, 90), false);
    char *text = written(table, path);
    ck_assert_ptr_null(strchr(strstr(text, "Motion"), ','));
    srp_table_destroy(parse(text));
    free(text);
    srp_table_destroy(table);
    fixture_destroy(fixture);
    remove(path);
}
END_TEST

START_TEST(unwritable_places_are_named) {
    const struct {
        const char *path, *words;
    } cases[] = {{"/dev/full", "No space left on device"},
                 {"no_such_directory/a.spo", "No such file or directory"},
                 {".", "is a directory"}};
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_table *table = noise_table(&fixture, grid_of(90, 90), false);
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        srp_error error;
        ck_assert_int_eq(srp_table_write(table, &srp_table_format_spo, cases[k].path, &error),
                         SRP_IO);
        ck_assert_str_eq(error.file, cases[k].path);
        ck_assert_msg(strstr(error.message, cases[k].words) != NULL, "'%s' lacks '%s'",
                      error.message, cases[k].words);
    }
    srp_table_destroy(table);
    fixture_destroy(fixture);
}
END_TEST

/* ---- Files of others ------------------------------------------------------------------------ */

/* NULL where the data are not there. */
static srp_table *shared_table(const char *name) {
    char path[1024];
    srp_table *table = NULL;
    srp_error error;
    snprintf(path, sizeof path, "%s/spad/%s", SRP_SHARED_DATA_DIR, name);
    srp_status status = srp_table_read(&srp_table_format_spo, path, &table, &error);
    if (status == SRP_NOT_FOUND) {
        printf("skipped: no %s\n", path);
        return NULL;
    }
    assert_ok(status, error);
    size_t size;
    char *text = read_bytes(path, &size);
    const char *broken = gmat_spo_broken_rule(text);
    ck_assert_msg(broken == NULL, "%s: %s", name, broken);
    free(text);
    return table;
}

START_TEST(the_opposite_convention_is_noticed) {
    srp_table *table = shared_table("SphericalModel.spo");
    if (table != NULL) {
        double share = srp_table_pull_share(table);
        printf("SphericalModel.spo pulls over %.4f of the sphere\n", share);
        ck_assert(share > 0.99 && share > SRP_TABLE_PULL_LIMIT);
        srp_table_flip(table);
        ck_assert(srp_table_pull_share(table) < 0.01);
        srp_table_destroy(table);
    }
}
END_TEST

START_TEST(a_table_that_pushes_is_not_accused) {
    srp_table *table = shared_table("One-Wing-Sat.spo");
    if (table != NULL) {
        double share = srp_table_pull_share(table);
        printf("One-Wing-Sat.spo pulls over %.4f of the sphere\n", share);
        ck_assert(share < 0.01);
        ck_assert(srp_table_node(table, 0, 1)->f.z == 5.84);
        srp_table_destroy(table);
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("table_spo");
    TCase *tcase = tcase_create("reading");
    tcase_set_timeout(tcase, 60);
    tcase_add_test(tcase, a_plain_file_is_read);
    tcase_add_test(tcase, whatever_gmat_takes_is_taken);
    tcase_add_test(tcase, line_ends_of_every_system_are_taken);
    tcase_add_test(tcase, units_are_converted);
    tcase_add_test(tcase, a_total_that_its_row_belies_is_told);
    tcase_add_test(tcase, malformed_files_are_refused_with_their_place);
    tcase_add_test(tcase, columns_are_named);
    tcase_add_test(tcase, forces_out_of_all_range_are_refused);
    tcase_add_test(tcase, all_rows_have_as_many_columns_as_the_first);
    tcase_add_test(tcase, what_decides_is_said_once);
    tcase_add_test(tcase, a_file_cut_anywhere_is_refused);
    tcase_add_test(tcase, what_is_no_text_is_refused);
    tcase_add_test(tcase, no_single_byte_does_harm);
    suite_add_tcase(suite, tcase);
    tcase = tcase_create("writing");
    tcase_set_timeout(tcase, 60);
    tcase_add_test(tcase, the_largest_forces_are_written_and_read);
    tcase_add_test(tcase, our_files_keep_gmats_rules);
    tcase_add_test(tcase, our_files_cut_in_the_last_rows_are_refused);
    tcase_add_test(tcase, odd_titles_keep_gmats_rules);
    tcase_add_test(tcase, force_and_torque_come_back_to_the_bit);
    tcase_add_test(tcase, a_table_survives_the_way_through_netcdf_and_back);
    tcase_add_test(tcase, columns_mean_what_they_say);
    tcase_add_test(tcase, numbers_have_points_in_every_locale);
    tcase_add_test(tcase, unwritable_places_are_named);
    suite_add_tcase(suite, tcase);
    tcase = tcase_create("files of others");
    tcase_set_timeout(tcase, 60);
    tcase_add_test(tcase, the_opposite_convention_is_noticed);
    tcase_add_test(tcase, a_table_that_pushes_is_not_accused);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
