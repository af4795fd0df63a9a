/* SPDX-License-Identifier: Apache-2.0 */
#include "malformed.h"

#include <srp/material.h>

static srp_materials *empty_list(void) {
    srp_materials *list;
    srp_error error;
    assert_ok(srp_materials_create(&list, &error), error);
    return list;
}

static srp_status parse(srp_materials *list, const char *text, log_keeper *keeper,
                        srp_error *error) {
    srp_log log = {log_keeper_warn, keeper};
    return srp_materials_parse_mtl(list, text, strlen(text), "f", keeper ? &log : NULL, error);
}

static void expect(const srp_materials *list, const char *name, double rho_s, double rho_d,
                   bool one_sided) {
    srp_optics optics;
    ck_assert_msg(srp_materials_find(list, name, &optics), "material '%s' is not known", name);
    ck_assert_msg(optics.rho_s == rho_s && optics.rho_d == rho_d && optics.one_sided == one_sided,
                  "material '%s' has %g, %g, %d", name, optics.rho_s, optics.rho_d,
                  optics.one_sided);
}

START_TEST(keywords_are_read) {
    srp_materials *list = empty_list();
    log_keeper keeper = {0};
    srp_error error;
    assert_ok(parse(list,
                    "\xef\xbb\xbf# made by hand\r\nnewmtl gold foil\r\n  rho_s\t0.25 # mirror\r\n"
                    "rho_d 1.25e-1\r\nKs 1 0 0.5\r\nmap_Kd a b c.png\r\nillum 2\r\n"
                    "newmtl Material #25\r\none_sided 1\r\nrho_d \\\r\n .5\r\nrho_s 0.5\r\n"
                    "newmtl black # space\nrho_s 0\nrho_d 0\none_sided 0",
                    &keeper, &error),
              error);
    ck_assert_uint_eq(keeper.count, 0);
    ck_assert_uint_eq(srp_materials_count(list), 3);
    expect(list, "gold foil", 0.25, 0.125, false);
    expect(list, "Material #25", 0.5, 0.5, true);
    expect(list, "black", 0.0, 0.0, false);
    srp_materials_destroy(list);
}
END_TEST

START_TEST(looks_are_taken_with_a_warning) {
    srp_materials *list = empty_list();
    log_keeper keeper = {0};
    srp_error error;
    assert_ok(parse(list,
                    "newmtl both\nNs 10\nKa 1 0 1\nKd 0.5 0.5 0.5\nKs 0.25 0.25 0.25\n"
                    "newmtl one number\nKd 0.75\nnewmtl specular\nKs 0.5 0.50 5e-1\n"
                    "newmtl replaced\nKs nonsense\nKs 0.125 0.125 0.125\n"
                    "newmtl none\nNi 1.45\n",
                    &keeper, &error),
              error);
    expect(list, "both", 0.25, 0.5, false);
    expect(list, "one number", 0.0, 0.75, false);
    expect(list, "specular", 0.5, 0.0, false);
    expect(list, "replaced", 0.125, 0.0, false);
    ck_assert_uint_eq(srp_materials_count(list), 5);
    ck_assert(!srp_materials_find(list, "none", &(srp_optics){0}));
    ck_assert_uint_eq(keeper.count, 4);
    ck_assert_str_eq(keeper.text[0],
                     "f:1:1: material 'both': rho_s = 0.25 is taken from Ks and rho_d = 0.5 from "
                     "Kd, which were made for looks; give rho_s and rho_d");
    ck_assert_ptr_nonnull(strstr(keeper.text[1], "rho_s = 0 is taken from Ks (not given)"));
    srp_materials_destroy(list);
}
END_TEST

START_TEST(warnings_are_bounded) {
    srp_materials *list = empty_list();
    log_keeper keeper = {0};
    srp_error error;
    char text[4000] = "";
    for (int i = 0; i < 100; ++i) {
        snprintf(text + strlen(text), 40, "newmtl m%d\nKd 0.5 0.5 0.5\n", i);
    }
    assert_ok(parse(list, text, &keeper, &error), error);
    ck_assert_uint_eq(keeper.count, 6);
    ck_assert_str_eq(keeper.text[5], "f: and 95 more materials taken from Ks and Kd");
    srp_materials_destroy(list);
}
END_TEST

START_TEST(later_definitions_hold) {
    srp_materials *list = empty_list();
    log_keeper keeper = {0};
    srp_error error;
    assert_ok(parse(list,
                    "newmtl a\nrho_s 0.5\nrho_d 0.25\none_sided 1\nnewmtl b\nrho_s 0\nrho_d 0\n"
                    "newmtl a\nrho_s 0.125\nrho_d 0.5\n",
                    &keeper, &error),
              error);
    expect(list, "a", 0.125, 0.5, false);
    ck_assert_uint_eq(keeper.count, 1);
    ck_assert_str_eq(keeper.text[0],
                     "f:8:8: material 'a' is defined before in this file: the later definition "
                     "holds");
    /* Another file: the same optics are fine, others are told, none leave what is known. */
    assert_ok(parse(list, "newmtl a\nrho_s 0.125\nrho_d 0.5\nnewmtl b\n", &keeper, &error), error);
    ck_assert_uint_eq(keeper.count, 1);
    assert_ok(parse(list, "newmtl a\nrho_s 0.25\nrho_d 0.5\n", &keeper, &error), error);
    ck_assert_uint_eq(keeper.count, 2);
    ck_assert_ptr_nonnull(strstr(keeper.text[1], "material 'a' has other optics"));
    expect(list, "a", 0.25, 0.5, false);
    expect(list, "b", 0.0, 0.0, false);
    srp_materials_destroy(list);
}
END_TEST

START_TEST(pinned_materials_are_not_looked_at) {
    srp_materials *list = empty_list();
    srp_error error;
    log_keeper keeper = {0};
    const srp_optics mine = {0.375, 0.25, false};
    assert_ok(srp_materials_set(list, "a", mine, true, &error), error);
    static const char *const texts[] = {
        "newmtl a\nrho_s 0\nrho_d 0\n", "newmtl a\nKs 0.1 0.2 0.3\n", "newmtl a\nKs 7\n",
        "newmtl a\nrho_s 2\n",          "newmtl a\nKs .8\nKd .8\n",   "newmtl a\nKs spectral x\n"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; ++i) {
        assert_ok(parse(list, texts[i], &keeper, &error), error);
        expect(list, "a", 0.375, 0.25, false);
    }
    ck_assert_uint_eq(keeper.count, 0);
    srp_materials_destroy(list);
}
END_TEST

START_TEST(files_without_materials_are_told) {
    srp_materials *list = empty_list();
    log_keeper keeper = {0};
    srp_error error;
    assert_ok(parse(list, "# Blender MTL File: 'None'\n# Material Count: 0\n", &keeper, &error),
              error);
    ck_assert_uint_eq(keeper.count, 1);
    ck_assert_str_eq(keeper.text[0], "f: the file defines no material (newmtl)");
    srp_materials_destroy(list);
}
END_TEST

#define LOOKS "expected three equal channels; give rho_s and rho_d in the file"

static const malformed BAD[] = {
    MALFORMED("share before any material", "rho_s 0.5\nnewmtl a\n", SRP_BAD_FORMAT,
              "f:1:1: found 'rho_s', expected newmtl NAME before it"),
    MALFORMED("one_sided before any material", "\n one_sided 1\n", SRP_BAD_FORMAT,
              "f:2:2: found 'one_sided', expected newmtl NAME before it"),
    MALFORMED("material without name", "newmtl \nrho_s 0\nrho_d 0\n", SRP_BAD_FORMAT,
              "f:1:8: found the end of the line, expected the name of a material"),
    MALFORMED("share without number", "newmtl a\nrho_s\nrho_d 0\n", SRP_BAD_FORMAT,
              "f:2:6: found the end of the line, expected a finite number: rho_s"),
    MALFORMED("share that is a word", "newmtl a\nrho_d shiny\n", SRP_BAD_FORMAT,
              "f:2:7: found 'shiny', expected a finite number: rho_d"),
    MALFORMED("share in percent", "newmtl a\nrho_s 50%\nrho_d 0\n", SRP_BAD_FORMAT,
              "f:2:7: found '50%', expected a finite number: rho_s"),
    MALFORMED("NaN", "newmtl a\nrho_s nan\nrho_d 0\n", SRP_BAD_FORMAT,
              "f:2:7: found 'nan', expected a finite number: rho_s"),
    MALFORMED("two numbers for a share", "newmtl a\nrho_s 0.5 0.5\nrho_d 0\n", SRP_BAD_FORMAT,
              "f:2:11: found '0.5', expected the end of the line"),
    MALFORMED("share above 1", "newmtl a\nrho_d 0\nrho_s 1.5\n", SRP_BAD_DATA,
              "f:3:7: material 'a': rho_s is 1.5, expected 0 to 1"),
    MALFORMED("share below 0", "newmtl a\nrho_s 0\nrho_d -0.25\nnewmtl b\n", SRP_BAD_DATA,
              "f:3:7: material 'a': rho_d is -0.25, expected 0 to 1"),
    MALFORMED("sum above 1", "newmtl a\nrho_s 0.75\nrho_d 0.5\n", SRP_BAD_DATA,
              "f:3:7: material 'a': rho_s + rho_d is 1.25, expected at most 1 (the rest is "
              "absorbed)"),
    MALFORMED("sum above 1, other order", "newmtl a\nrho_d 0.5\n\nrho_s 0.75\n", SRP_BAD_DATA,
              "f:4:7: material 'a': rho_s + rho_d is 1.25, expected at most 1 (the rest is "
              "absorbed)"),
    MALFORMED("rho_s alone", "newmtl a\nKd 0 0 0\nrho_s 0.5\nnewmtl b\n", SRP_BAD_FORMAT,
              "f:1:1: material 'a' has rho_s but no rho_d, expected both"),
    MALFORMED("rho_d alone, at the end", "newmtl b\nnewmtl a\nrho_d 0.5", SRP_BAD_FORMAT,
              "f:2:1: material 'a' has rho_d but no rho_s, expected both"),
    MALFORMED("share given twice", "newmtl a\nrho_s 0.5\nrho_s 0.5\nrho_d 0\n", SRP_BAD_FORMAT,
              "f:3:1: material 'a' has two statements rho_s, expected one"),
    MALFORMED("one_sided out of range", "newmtl a\none_sided 2\n", SRP_BAD_FORMAT,
              "f:2:11: found '2', expected a whole number from 0 to 1: one_sided"),
    MALFORMED("one_sided in words", "newmtl a\none_sided yes\n", SRP_BAD_FORMAT,
              "f:2:11: found 'yes', expected a whole number: one_sided"),
    MALFORMED("unequal channels", "newmtl gold foil\nKs 0.5 0.4 0.3\nKd 0 0 0\n", SRP_BAD_DATA,
              "f:2:4: material 'gold foil': Ks is 0.5 0.4 0.3, " LOOKS),
    MALFORMED("unequal diffuse channels", "newmtl a\nKd 0.5 0.5 0.25\n", SRP_BAD_DATA,
              "f:2:4: material 'a': Kd is 0.5 0.5 0.25, " LOOKS),
    MALFORMED("looks brighter than light", "newmtl a\nKs 0.5 0.5 0.5\nKd 0.8 0.8 0.8\n",
              SRP_BAD_DATA,
              "f:3:4: material 'a': Ks + Kd is 1.3, expected at most 1 (the rest is absorbed)"),
    MALFORMED("channel above 1", "newmtl a\nKd 255 255 255\n", SRP_BAD_DATA,
              "f:2:4: material 'a': Kd is 255, expected 0 to 1"),
    MALFORMED("two channels", "newmtl a\nKd 0.5 0.5\n", SRP_BAD_FORMAT,
              "f:2:11: found the end of the line, expected a finite number: Kd"),
    MALFORMED("spectral file", "newmtl a\nKs spectral gold.rfl\n", SRP_BAD_FORMAT,
              "f:2:4: found 'spectral', expected a finite number: Ks"),
    MALFORMED("zero byte", "newmtl a\nrho_s 0\0\n", SRP_BAD_FORMAT,
              "f:2:8: found a zero byte: this is a binary file, expected text"),
    MALFORMED("UTF-16", "\xfe\xff\0n", SRP_BAD_FORMAT,
              "f:1:1: found text in UTF-16, expected UTF-8 or ASCII"),
};

/* Refused, and the list is as it was. */
START_TEST(malformed_texts_are_refused) {
    const malformed *bad = &BAD[_i];
    srp_materials *list = empty_list();
    srp_error error;
    assert_ok(srp_materials_set(list, "b", (srp_optics){0.5, 0.25, true}, false, &error), error);
    srp_status status = srp_materials_parse_mtl(list, bad->text, bad->size, "f", NULL, &error);
    assert_refused(bad, status, &error);
    ck_assert_uint_eq(srp_materials_count(list), 1);
    expect(list, "b", 0.5, 0.25, true);
    srp_materials_destroy(list);
}
END_TEST

START_TEST(files_that_cannot_be_read) {
    srp_materials *list = empty_list();
    srp_error error;
    ck_assert_int_eq(srp_materials_read_mtl(list, "no/such.mtl", NULL, &error), SRP_NOT_FOUND);
    ck_assert_str_eq(error.file, "no/such.mtl");
    ck_assert_int_eq(srp_materials_read_mtl(list, ".", NULL, &error), SRP_IO);
    ck_assert_int_eq(srp_materials_read_mtl(list, "/dev/zero", NULL, &error), SRP_BAD_FORMAT);
    srp_materials_destroy(list);
}
END_TEST

START_TEST(model_files_are_read) {
    srp_materials *list = empty_list();
    srp_error error;
    log_keeper keeper = {0};
    srp_log log = {log_keeper_warn, &keeper};
    assert_ok(srp_materials_read_mtl(list, SRP_MODELS_DIR "/cube.mtl", &log, &error), error);
    ck_assert_uint_eq(srp_materials_count(list), 1);
    srp_optics optics;
    ck_assert(srp_materials_find(list, srp_materials_name(list, 0), &optics));
    ck_assert(optics.rho_s == 0.5 && optics.rho_d == 0.1);
    ck_assert_uint_eq(keeper.count, 0);
    srp_materials_destroy(list);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("mtl");
    TCase *tcase = tcase_create("mtl");
    tcase_add_test(tcase, keywords_are_read);
    tcase_add_test(tcase, looks_are_taken_with_a_warning);
    tcase_add_test(tcase, warnings_are_bounded);
    tcase_add_test(tcase, later_definitions_hold);
    tcase_add_test(tcase, pinned_materials_are_not_looked_at);
    tcase_add_test(tcase, files_without_materials_are_told);
    tcase_add_loop_test(tcase, malformed_texts_are_refused, 0, sizeof BAD / sizeof *BAD);
    tcase_add_test(tcase, files_that_cannot_be_read);
    tcase_add_test(tcase, model_files_are_read);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
