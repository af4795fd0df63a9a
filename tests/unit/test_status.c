/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"
#include "srp_check.h"

#include <string.h>

START_TEST(every_status_has_words) {
#define ASK(name, value, text) ck_assert_str_eq(srp_status_string(name), text);
    SRP_STATUS_LIST(ASK)
#undef ASK
    ck_assert_str_eq(srp_status_string((srp_status)999), "unknown status");
}
END_TEST

START_TEST(error_names_the_place) {
    srp_error error;
    char text[2048];
    ck_assert_int_eq(srp_fail_at(&error, SRP_BAD_FORMAT, "a.obj", 12, 3, "found %d", 7),
                     SRP_BAD_FORMAT);
    srp_error_format(&error, text, sizeof text);
    ck_assert_str_eq(text, "a.obj:12:3: found 7");
    ck_assert_int_eq(srp_fail(&error, SRP_NO_MEMORY, "no memory"), SRP_NO_MEMORY);
    srp_error_format(&error, text, sizeof text);
    ck_assert_str_eq(text, "no memory");
    ck_assert_int_eq(srp_fail_at(NULL, SRP_IO, "a", 0, 0, "x"), SRP_IO);
}
END_TEST

START_TEST(long_file_names_keep_their_end) {
    char name[2000];
    memset(name, 'd', sizeof name);
    memcpy(name + sizeof name - 10, "/last.obj", 10);
    srp_error error;
    ck_assert_int_eq(srp_fail_at(&error, SRP_IO, name, 0, 0, "x"), SRP_IO);
    ck_assert(strlen(error.file) == sizeof error.file - 1);
    ck_assert_str_eq(error.file + strlen(error.file) - 9, "/last.obj");
}
END_TEST

int main(void) {
    Suite *suite = suite_create("status");
    TCase *tcase = tcase_create("status");
    tcase_add_test(tcase, every_status_has_words);
    tcase_add_test(tcase, error_names_the_place);
    tcase_add_test(tcase, long_file_names_keep_their_end);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
