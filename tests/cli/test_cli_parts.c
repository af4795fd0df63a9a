/* SPDX-License-Identifier: Apache-2.0 */
/* Parts of the command line that are easier to ask directly than through a run of srp. */
#include "command_line.h"
#include "json.h"
#include "numbers.h"
#include "palette.h"
#include "progress.h"
#include "srp_check.h"
#include "suggest.h"
#include "svg_compact.h"
#include "utf8.h"

#include <string.h>

START_TEST(numbers_are_read_whole_or_not_at_all) {
    static const struct {
        const char *text;
        double value;
    } good[] = {{"1.25", 1.25}, {"-3e-4", -3e-4}, {"+7", 7.0}, {".5", 0.5}, {"5.", 5.0}};
    static const char *const bad[] = {"",    " 1", "1 ",    "0x1p3", "nan", "inf", "-inf",
                                      "1,5", "1e", "1e999", "1.2.3", "--1", "e5",  "."};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; ++i) {
        double value = 99.0;
        ck_assert_msg(cli_read_number(good[i].text, &value), "%s", good[i].text);
        ck_assert(value == good[i].value);
    }
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        double value = 99.0;
        ck_assert_msg(!cli_read_number(bad[i], &value), "'%s'", bad[i]);
        ck_assert(value == 99.0);
    }
}
END_TEST

START_TEST(lists_of_numbers_have_their_length) {
    double v[4] = {0.0, 0.0, 0.0, 0.0};
    ck_assert(cli_read_numbers("1.5,-2,3e1", 3, v));
    ck_assert(v[0] == 1.5 && v[1] == -2.0 && v[2] == 30.0);
    ck_assert(!cli_read_numbers("1,2", 3, v));
    ck_assert(!cli_read_numbers("1,2,3,4", 3, v));
    ck_assert(!cli_read_numbers("1,2,", 3, v));
    ck_assert(!cli_read_numbers("1, 2,3", 3, v));
    char longer[1000];
    memset(longer, '1', sizeof longer);
    longer[sizeof longer - 1] = '\0';
    ck_assert(!cli_read_numbers(longer, 1, v));
}
END_TEST

START_TEST(counts_stop_at_their_maximum) {
    uint64_t n = 0;
    ck_assert(cli_read_count("18446744073709551615", UINT64_MAX, &n) && n == UINT64_MAX);
    ck_assert(!cli_read_count("18446744073709551616", UINT64_MAX, &n));
    ck_assert(cli_read_count("007", 7, &n) && n == 7);
    ck_assert(!cli_read_count("8", 7, &n));
    ck_assert(!cli_read_count("", 7, &n));
    ck_assert(!cli_read_count("-1", 7, &n));
    ck_assert(!cli_read_count("1.0", 7, &n));
}
END_TEST

START_TEST(numbers_are_written_as_short_as_they_read_back) {
    static const double values[] = {0.1, 1.0 / 3.0, 1e300, 5e-324, 123456789.125, -2.5e-7, 0.0};
    char text[CLI_NUMBER_SIZE];
    for (size_t i = 0; i < sizeof values / sizeof values[0]; ++i) {
        ck_assert(strtod(cli_write_number(values[i], text), NULL) == values[i]);
    }
    ck_assert_str_eq(cli_write_number(0.1, text), "0.1");
    ck_assert_str_eq(cli_write_number(1367.0, text), "1367");
}
END_TEST

START_TEST(bytes_that_are_no_text_are_found) {
    static const struct {
        const char *text, *mended;
    } cases[] = {
        {"", ""},
        {"plain", "plain"},
        {"\xc3\xa9 \xe2\x82\xac \xf0\x9f\x9b\xb0", "\xc3\xa9 \xe2\x82\xac \xf0\x9f\x9b\xb0"},
        {"caf\xe9", "caf?"},
        {"\xff\xfe.obj", "??.obj"},
        {"\xc0\xaf \xed\xa0\x80", "?? ???"},
        {"cut \xe2\x82", "cut ??"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        char text[64];
        snprintf(text, sizeof text, "%s", cases[i].text);
        cli_utf8_mend(text);
        ck_assert_str_eq(text, cases[i].mended);
        ck_assert_uint_eq(cli_utf8_find_bad(text), strlen(text));
    }
    ck_assert_uint_eq(cli_utf8_find_bad("caf\xe9"), 3);
}
END_TEST

static const char *nearest(const char *wanted, const char *a, const char *b) {
    cli_suggestion near = cli_suggestion_begin(wanted);
    cli_suggestion_offer(&near, a);
    cli_suggestion_offer(&near, b);
    return near.best;
}

START_TEST(suggestions_are_near) {
    ck_assert_str_eq(nearest("tabel", "table", "force"), "table"); /* a swap is one slip */
    ck_assert_str_eq(nearest("forc", "table", "force"), "force");
    ck_assert_str_eq(nearest("tolerence", "threads", "tolerance"), "tolerance");
    ck_assert_ptr_null(nearest("xyzzy", "table", "force"));
    ck_assert_ptr_null(nearest("", "table", "force"));
    char longer[200];
    memset(longer, 'a', sizeof longer);
    longer[sizeof longer - 1] = '\0';
    ck_assert_ptr_null(nearest(longer, "table", longer));
}
END_TEST

START_TEST(command_lines_can_be_typed_again) {
    static char *const argv[] = {"table", "my model.obj", "--material", "it's=0,1",
                                 "-o",    "a.nc",         "--restart",  "--restart",
                                 "",      "--",           "--restart"};
    char *line = cli_command_line_join((int)(sizeof argv / sizeof argv[0]), argv, "--restart");
    ck_assert_ptr_nonnull(line);
    ck_assert_str_eq(line, "srp table 'my model.obj' --material 'it'\\''s=0,1' -o a.nc '' -- "
                           "--restart");
    free(line);
}
END_TEST

/* What `write` writes into a JSON object. */
static void json_text(void (*write)(cli_json *json), char *out, size_t size) {
    FILE *file = tmpfile();
    ck_assert_ptr_nonnull(file);
    cli_json json;
    cli_json_begin(&json, file);
    write(&json);
    cli_json_end(&json);
    rewind(file);
    out[fread(out, 1, size - 1, file)] = '\0';
    fclose(file);
}

static void write_nothing(cli_json *json) {
    (void)json;
}

static void write_everything(cli_json *json) {
    cli_json_text(json, "text", "a \"b\" \\ \n \xc3\xa9 \xff \xc3");
    cli_json_text(json, "none", NULL);
    cli_json_number(json, "number", -0.1);
    cli_json_number(json, "nan", (double)NAN);
    cli_json_count(json, "count", UINT64_MAX);
    cli_json_open_array(json, "empty");
    cli_json_close_array(json);
    cli_json_open_array(json, "array");
    cli_json_flag(json, NULL, true);
    cli_json_open_object(json, NULL);
    cli_json_vector(json, "v", srp_vec3_make(1.0, -2.5, (double)INFINITY));
    cli_json_close_object(json);
    cli_json_close_array(json);
}

START_TEST(json_is_json) {
    char text[1000];
    json_text(write_nothing, text, sizeof text);
    ck_assert_str_eq(text, "{}\n");
    json_text(write_everything, text, sizeof text);
    ck_assert_str_eq(text, "{\n"
                           "  \"text\": \"a \\\"b\\\" \\\\ \\u000a \xc3\xa9 \\ufffd \\ufffd\",\n"
                           "  \"none\": null,\n"
                           "  \"number\": -0.1,\n"
                           "  \"nan\": null,\n"
                           "  \"count\": 18446744073709551615,\n"
                           "  \"empty\": [],\n"
                           "  \"array\": [\n"
                           "    true,\n"
                           "    {\n"
                           "      \"v\": [1, -2.5, null]\n"
                           "    }\n"
                           "  ]\n"
                           "}\n");
}
END_TEST

START_TEST(progress_fits_every_terminal) {
    char line[512];
    for (int columns = 0; columns <= 300; ++columns) {
        for (size_t done = 0; done <= 65341; done += 9334) {
            cli_progress_format(line, sizeof line, columns, 4000.0, 0, done, 65341, "nodes");
            ck_assert_msg(columns == 0 || strlen(line) < (size_t)columns, "%d columns: %s", columns,
                          line);
        }
    }
}
END_TEST

START_TEST(progress_tells_the_time_left) {
    char line[512];
    cli_progress_format(line, sizeof line, 100, 10.0, 0, 25, 100, "nodes");
    ck_assert_str_eq(line, "[==========                              ]  25 %  25 of 100 nodes, "
                           "0:30 left");
    /* What a resumed run found says nothing about speed: 25 in 10 s, 50 to go. */
    cli_progress_format(line, sizeof line, 100, 10.0, 25, 50, 100, "nodes");
    ck_assert_ptr_nonnull(strstr(line, "0:20 left"));
    cli_progress_format(line, sizeof line, 100, 7200.0, 0, 50, 100, "nodes");
    ck_assert_ptr_nonnull(strstr(line, "2:00:00 left"));
    cli_progress_format(line, sizeof line, 100, 5.0, 50, 50, 100, "nodes");
    ck_assert_ptr_null(strstr(line, "left"));
}
END_TEST

static double step_of(const cli_palette *palette, int k) {
    double a[3], b[3], sum = 0.0;
    cli_lab_of_srgb(palette->rgb[k - 1], a);
    cli_lab_of_srgb(palette->rgb[k], b);
    for (int c = 0; c < 3; ++c) {
        sum += (a[c] - b[c]) * (a[c] - b[c]);
    }
    return sqrt(sum);
}

/* Steps `first` to `last` are alike. */
static void check_even(const cli_palette *palette, int first, int last) {
    double least = INFINITY, most = 0.0;
    for (int k = first; k <= last; ++k) {
        least = fmin(least, step_of(palette, k));
        most = fmax(most, step_of(palette, k));
    }
    printf("steps %d to %d of a palette: %.4f to %.4f in L*a*b*\n", first, last, least, most);
    ck_assert(least > 0.0 && most < 1.05 * least);
}

START_TEST(palettes_are_even_to_the_eye) {
    const int end = CLI_PALETTE_SIZE - 1, middle = CLI_PALETTE_SIZE / 2;
    cli_palette sequential, diverging;
    double here[3], before[3];
    cli_palette_sequential(&sequential);
    cli_palette_diverging(&diverging);
    check_even(&sequential, 1, end);
    check_even(&diverging, 1, middle - 1);
    check_even(&diverging, middle + 1, end);
    for (int k = 1; k <= end; ++k) { /* ever lighter; lightest in the middle */
        cli_lab_of_srgb(sequential.rgb[k - 1], before);
        cli_lab_of_srgb(sequential.rgb[k], here);
        ck_assert(here[0] > before[0]);
        cli_lab_of_srgb(diverging.rgb[k - 1], before);
        cli_lab_of_srgb(diverging.rgb[k], here);
        ck_assert(k == middle || (here[0] > before[0]) == (k < middle));
    }
}
END_TEST

START_TEST(colours_go_there_and_back) {
    const double white[3] = {1.0, 1.0, 1.0}, red[3] = {1.0, 0.0, 0.0};
    const double some[3] = {0.123, 0.456, 0.789};
    double lab[3], rgb[3];
    cli_lab_of_srgb(white, lab);
    assert_close(lab[0], 100.0, 1e-4, 0.0);
    assert_close(hypot(lab[1], lab[2]), 0.0, 0.0, 0.02);
    cli_lab_of_srgb(red, lab); /* B. Lindbloom's calculator */
    assert_close(lab[0], 53.2408, 1e-4, 0.0);
    assert_close(lab[1], 80.0925, 1e-4, 0.0);
    assert_close(lab[2], 67.2032, 1e-4, 0.0);
    cli_lab_of_srgb(some, lab);
    cli_srgb_of_lab(lab, rgb);
    for (int c = 0; c < 3; ++c) {
        assert_close(rgb[c], some[c], 1e-5, 0.0);
    }
}
END_TEST

static const char *compacted(const char *line) {
    static char text[1000];
    snprintf(text, sizeof text, "%s\n", line);
    size_t size = cli_svg_compact(text, strlen(text));
    ck_assert_uint_gt(size, 0);
    ck_assert(text[size - 1] == '\n');
    text[size - 1] = '\0';
    return text;
}

#define DULL "stroke-width:1;stroke-linecap:butt;stroke-linejoin:bevel;"
#define TAIL "stroke-opacity:1;stroke-miterlimit:10;"

START_TEST(svg_says_the_same_in_less) {
    /* A piece of a surface, counted from below in a picture 960 high. */
    ck_assert_str_eq(
        compacted("<path style=\"fill-rule:nonzero;fill:rgb(47.843137%,46.666667%,79.215686%);"
                  "fill-opacity:1;" DULL "stroke:rgb(100%,0%,0.4%);" TAIL
                  "\" d=\"M 269.722656 661.800781 L 268.148438 659.015625 L 960.004 960.001 \" "
                  "transform=\"matrix(1,0,0,-1,0,960)\"/>"),
        "<path style=\"fill:#7a77ca;stroke-linejoin:bevel;stroke:#ff0001\" "
        "d=\"M269.72 298.2 268.15 300.98 960 0\"/>");
    /* Upright; two strokes; a width that is not the usual one. */
    ck_assert_str_eq(compacted("<path style=\"fill:none;stroke-width:0.5;stroke:rgb(0%,0%,0%);\" "
                               "d=\"M 1 2 L 3.5 4 M -0.001 -5.126 L 100 200\"/>"),
                     "<path style=\"fill:none;stroke-width:0.5;stroke:#000000\" d=\"M1 2 3.5 4M0 "
                     "-5.13 100 200\"/>");
    /* What cannot be told to mean the same stays: curves, other transforms, clips, other lines. */
    static const char *const kept[] = {
        "<path style=\"stroke:none;\" d=\"M 0.921875 3.25 C 1 2 3 4 5 6 Z M 1.953125 2.234375 \"/>",
        "<path style=\"fill:none;stroke-opacity:1;\" d=\"M 1 2 L 3 4 \" "
        "transform=\"matrix(2,0,0,-1,0,960)\"/>",
        "<path style=\"fill:none;stroke-opacity:1;\" d=\"M 1 2 L 3 4 \" "
        "transform=\"matrix(1,0,0,-1,0,960) scale(2)\"/>",
        "<path style=\"fill:none;stroke-opacity:1;\" clip-path=\"url(#c)\" d=\"M 1 2 L 3 4 \"/>",
        "<path style=\"fill:none;stroke-opacity:1;\" d=\"M 1 2 L 3 \"/>",
        "<path style=\"fill:none;stroke-opacity:1;\" d=\"M 1 2 L 3 4 \"",
        "<path",
        "<use xlink:href=\"#glyph0-1\" x=\"1.0000\" y=\"2.0000\"/>",
        "",
    };
    for (size_t k = 0; k < sizeof kept / sizeof kept[0]; ++k) {
        ck_assert_str_eq(compacted(kept[k]), kept[k]);
    }
    /* Without a break at the end, and more than one line. */
    char two[] = "<svg>\n<path style=\"fill-opacity:1;\" d=\"M 1.500000 2 L 3 4 \"/>\n</svg>";
    size_t size = cli_svg_compact(two, strlen(two));
    two[size] = '\0';
    ck_assert_str_eq(two, "<svg>\n<path style=\"\" d=\"M1.5 2 3 4\"/>\n</svg>");
    ck_assert(!cli_svg_compact_file("no/such.svg"));
}
END_TEST

int main(void) {
    Suite *suite = suite_create("cli_parts");
    TCase *tcase = tcase_create("cli_parts");
    tcase_add_test(tcase, numbers_are_read_whole_or_not_at_all);
    tcase_add_test(tcase, lists_of_numbers_have_their_length);
    tcase_add_test(tcase, counts_stop_at_their_maximum);
    tcase_add_test(tcase, numbers_are_written_as_short_as_they_read_back);
    tcase_add_test(tcase, bytes_that_are_no_text_are_found);
    tcase_add_test(tcase, suggestions_are_near);
    tcase_add_test(tcase, command_lines_can_be_typed_again);
    tcase_add_test(tcase, json_is_json);
    tcase_add_test(tcase, progress_fits_every_terminal);
    tcase_add_test(tcase, palettes_are_even_to_the_eye);
    tcase_add_test(tcase, colours_go_there_and_back);
    tcase_add_test(tcase, progress_tells_the_time_left);
    tcase_add_test(tcase, svg_says_the_same_in_less);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
