/* SPDX-License-Identifier: Apache-2.0 */
#include "malformed.h"

#include <srp/plates.h>

START_TEST(plates_are_read) {
    const char *text = "\xef\xbb\xbf# N-plate model\r\n 3 # plates\r\n1 0 0 2.5 .25 0.125 # +x\r\n"
                       "\r\n\t0 -3 4 1e1 0 0\r\n# between\r\n1e-200 1e-200 0 0.5 0.7 0.3";
    srp_plate *plates;
    size_t count;
    srp_error error;
    assert_ok(srp_plates_parse(text, strlen(text), "f", &plates, &count, &error), error);
    ck_assert_uint_eq(count, 3);
    assert_vec3_close(plates[0].normal, srp_vec3_make(1, 0, 0), 0.0, 0.0);
    ck_assert(plates[0].area == 2.5 && plates[0].optics.rho_s == 0.25 &&
              plates[0].optics.rho_d == 0.125 && !plates[0].optics.one_sided);
    assert_vec3_close(plates[1].normal, srp_vec3_make(0, -0.6, 0.8), 1e-15, 0.0);
    ck_assert(plates[1].area == 10.0);
    assert_vec3_close(plates[2].normal, srp_vec3_make(sqrt(0.5), sqrt(0.5), 0), 1e-15, 0.0);
    srp_plates_free(plates);
    srp_plates_free(NULL);
}
END_TEST

START_TEST(normals_of_any_length_become_units) {
    uint64_t state = 7;
    for (int i = 0; i < 200; ++i) {
        srp_vec3 n = random_direction(&state);
        double length = pow(10.0, 600.0 * random_unit(&state) - 300.0);
        char text[200];
        snprintf(text, sizeof text, "1\n%.17g %.17g %.17g 1 0 0\n", length * n.x, length * n.y,
                 length * n.z);
        srp_plate *plates;
        size_t count;
        srp_error error;
        assert_ok(srp_plates_parse(text, strlen(text), "f", &plates, &count, &error), error);
        assert_close(srp_vec3_norm(plates[0].normal), 1.0, 4e-16, 0.0);
        assert_vec3_close(plates[0].normal, n, 1e-15, 0.0);
        srp_plates_free(plates);
    }
}
END_TEST

START_TEST(long_lists_are_read) {
    enum { COUNT = 1000 };
    char *text = malloc(COUNT * 40);
    ck_assert_ptr_nonnull(text);
    size_t used = (size_t)snprintf(text, 40, "%d\n", COUNT);
    for (int i = 0; i < COUNT; ++i) {
        used += (size_t)snprintf(text + used, 40, "0 0 1 %d 0.5 0.25\n", i + 1);
    }
    srp_plate *plates;
    size_t count;
    srp_error error;
    assert_ok(srp_plates_parse(text, used, "f", &plates, &count, &error), error);
    ck_assert_uint_eq(count, COUNT);
    for (int i = 0; i < COUNT; ++i) {
        ck_assert(plates[i].area == i + 1);
    }
    srp_plates_free(plates);
    free(text);
}
END_TEST

static const malformed BAD[] = {
    MALFORMED("empty file", "", SRP_BAD_FORMAT,
              "f: the file is empty, expected the number of plates on its first line"),
    MALFORMED("comments only", "# none\n", SRP_BAD_FORMAT,
              "f: the file is empty, expected the number of plates on its first line"),
    MALFORMED("no count", "1 0 0 1 0 0\n", SRP_BAD_FORMAT,
              "f:1:3: found '0', expected the end of the line"),
    MALFORMED("count that is a word", "six\n", SRP_BAD_FORMAT,
              "f:1:1: found 'six', expected a whole number: the number of plates"),
    MALFORMED("count 0", "0\n", SRP_BAD_FORMAT,
              "f:1:1: found '0', expected a whole number from 1 to 4294967295: the number of "
              "plates"),
    MALFORMED("negative count", "-1\n1 0 0 1 0 0\n", SRP_BAD_FORMAT,
              "f:1:1: found '-1', expected a whole number from 1 to 4294967295: the number of "
              "plates"),
    MALFORMED("count with a point", "1.0\n1 0 0 1 0 0\n", SRP_BAD_FORMAT,
              "f:1:1: found '1.0', expected a whole number: the number of plates"),
    MALFORMED("enormous count", "4000000000\n1 0 0 1 0 0\n", SRP_BAD_FORMAT,
              "f:3: the file ends after 1 of 4000000000 plates"),
    MALFORMED("too few plates", "2\n1 0 0 1 0 0\n\n", SRP_BAD_FORMAT,
              "f:4: the file ends after 1 of 2 plates"),
    MALFORMED("too many plates", "1\n1 0 0 1 0 0\n -1 0 0 1 0 0\n", SRP_BAD_FORMAT,
              "f:3:2: found more lines than plates: the first line says 1"),
    MALFORMED("truncated plate", "1\n1 0 0 1 0", SRP_BAD_FORMAT,
              "f:2:10: found the end of the line, expected a finite number: the diffuse share "
              "rho_d"),
    MALFORMED("seven numbers", "1\n1 0 0 1 0 0 0\n", SRP_BAD_FORMAT,
              "f:2:13: found '0', expected the end of the line"),
    MALFORMED("comma separated", "1\n1,0,0,1,0,0\n", SRP_BAD_FORMAT,
              "f:2:1: found '1,0,0,1,0,0', expected a finite number: x of the normal"),
    MALFORMED("NaN normal", "1\n1 NaN 0 1 0 0\n", SRP_BAD_FORMAT,
              "f:2:3: found 'NaN', expected a finite number: y of the normal"),
    MALFORMED("infinite area", "1\n1 0 0 inf 0 0\n", SRP_BAD_FORMAT,
              "f:2:7: found 'inf', expected a finite number: the area [m^2]"),
    MALFORMED("zero normal", "1\n 0 -0 0 1 0 0\n", SRP_BAD_DATA,
              "f:2:2: the normal is 0 0 0, expected a direction"),
    MALFORMED("no area", "1\n1 0 0 0 0 0\n", SRP_BAD_DATA,
              "f:2:7: found '0', expected an area above 0 m^2"),
    MALFORMED("area out of all range", "1\n1 0 0 1e300 0 0\n", SRP_BAD_DATA,
              "f:2:7: found '1e300', expected an area of at most 1e60 m^2"),
    MALFORMED("negative area", "1\n1 0 0 -2.5 0 0\n", SRP_BAD_DATA,
              "f:2:7: found '-2.5', expected an area above 0 m^2"),
    MALFORMED("rho_s above 1", "1\n1 0 0 1 1.5 0\n", SRP_BAD_DATA,
              "f:2:9: found '1.5', expected rho_s from 0 to 1"),
    MALFORMED("rho_d below 0", "1\n1 0 0 1 0 -.5\n", SRP_BAD_DATA,
              "f:2:11: found '-.5', expected rho_d from 0 to 1"),
    MALFORMED("sum above 1", "2\n1 0 0 1 0 0\n1 0 0 1 .75 .5\n", SRP_BAD_DATA,
              "f:3:13: rho_s + rho_d is 1.25, expected at most 1 (the rest is absorbed)"),
    MALFORMED("zero byte", "1\n1 0 0\0 1 0 0\n", SRP_BAD_FORMAT,
              "f:2:6: found a zero byte: this is a binary file, expected text"),
};

START_TEST(malformed_texts_are_refused) {
    const malformed *bad = &BAD[_i];
    srp_plate *plates = (srp_plate *)&plates;
    size_t count = 77;
    srp_error error;
    srp_status status = srp_plates_parse(bad->text, bad->size, "f", &plates, &count, &error);
    assert_refused(bad, status, &error);
    ck_assert_ptr_eq(plates, (srp_plate *)&plates);
    ck_assert_uint_eq(count, 77);
}
END_TEST

START_TEST(files_are_read_or_refused) {
    srp_plate *plates;
    size_t count;
    srp_error error;
    assert_ok(srp_plates_read(SRP_MODELS_DIR "/cube.plates", &plates, &count, &error), error);
    ck_assert_uint_eq(count, 6);
    ck_assert(plates[5].area == 4.0);
    srp_plates_free(plates);
    assert_ok(srp_plates_read(SRP_MODELS_DIR "/box-wing.plates", &plates, &count, &error), error);
    srp_plates_free(plates);
    ck_assert_int_eq(srp_plates_read("no/such", &plates, &count, &error), SRP_NOT_FOUND);
    ck_assert_int_eq(srp_plates_read(".", &plates, &count, &error), SRP_IO);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("plates");
    TCase *tcase = tcase_create("plates");
    tcase_add_test(tcase, plates_are_read);
    tcase_add_test(tcase, normals_of_any_length_become_units);
    tcase_add_test(tcase, long_lists_are_read);
    tcase_add_loop_test(tcase, malformed_texts_are_refused, 0, sizeof BAD / sizeof *BAD);
    tcase_add_test(tcase, files_are_read_or_refused);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
