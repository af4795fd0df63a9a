/* SPDX-License-Identifier: Apache-2.0 */
#include "material_internal.h"
#include "srp_check.h"

#include <string.h>

START_TEST(shares_have_ranges) {
    srp_error error;
    const srp_optics good[] = {{0, 0, false},     {1, 0, false},     {0, 1, true},
                               {0.7, 0.3, false}, {0.1, 0.9, false}, {0.31, 0.27, false}};
    for (size_t i = 0; i < sizeof good / sizeof *good; ++i) {
        assert_ok(srp_optics_check(good[i], &error), error);
    }
    const srp_optics bad[] = {{-0.1, 0.5, false}, {0.5, -1e-9, false}, {1.01, 0, false},
                              {0, 2, false},      {0.6, 0.41, false},  {NAN, 0, false},
                              {0, NAN, false},    {INFINITY, 0, false}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
        ck_assert_int_eq(srp_optics_check(bad[i], &error), SRP_BAD_DATA);
        ck_assert_int_eq(srp_optics_check(bad[i], NULL), SRP_BAD_DATA);
    }
}
END_TEST

START_TEST(lists_keep_names_and_order) {
    srp_materials *list;
    srp_error error;
    assert_ok(srp_materials_create(&list, &error), error);
    ck_assert_uint_eq(srp_materials_count(list), 0);
    char name[20];
    for (int i = 0; i < 100; ++i) {
        snprintf(name, sizeof name, "m%d", i);
        assert_ok(
            srp_materials_set(list, name, (srp_optics){0.005 * i, 0.25, i % 2 == 0}, false, &error),
            error);
    }
    ck_assert_uint_eq(srp_materials_count(list), 100);
    ck_assert_str_eq(srp_materials_name(list, 37), "m37");
    ck_assert_ptr_null(srp_materials_name(list, 100));
    srp_optics optics = {-1, -1, false};
    ck_assert(srp_materials_find(list, "m74", &optics));
    ck_assert(optics.rho_s == 0.005 * 74 && optics.rho_d == 0.25 && optics.one_sided);
    optics.rho_s = -1;
    ck_assert(!srp_materials_find(list, "m100", &optics));
    ck_assert(optics.rho_s == -1);
    ck_assert_int_eq(srp_materials_set(list, "m1", (srp_optics){0.8, 0.8, false}, true, &error),
                     SRP_BAD_DATA);
    ck_assert(srp_materials_find(list, "m1", &optics));
    ck_assert(optics.rho_s == 0.005);
    srp_materials_destroy(list);
    srp_materials_destroy(NULL);
}
END_TEST

START_TEST(pinned_materials_stay) {
    srp_materials *list;
    srp_error error;
    srp_optics optics;
    const srp_optics first = {0.125, 0.25, false}, second = {0.5, 0.375, true};
    assert_ok(srp_materials_create(&list, &error), error);
    assert_ok(srp_materials_set(list, "a", first, false, &error), error);
    assert_ok(srp_materials_set(list, "a", second, true, &error), error);
    assert_ok(srp_materials_set(list, "a", first, false, &error), error);
    ck_assert(srp_materials_find(list, "a", &optics));
    ck_assert(optics.rho_s == 0.5 && optics.one_sided);
    assert_ok(srp_materials_set(list, "a", first, true, &error), error);
    ck_assert(srp_materials_find(list, "a", &optics));
    ck_assert(optics.rho_s == 0.125 && !optics.one_sided);
    ck_assert_uint_eq(srp_materials_count(list), 1);
    srp_materials_destroy(list);
}
END_TEST

START_TEST(clones_are_independent) {
    srp_materials *list;
    srp_error error;
    srp_optics optics;
    assert_ok(srp_materials_create(&list, &error), error);
    assert_ok(srp_materials_set(list, "a", (srp_optics){0.125, 0.25, true}, true, &error), error);
    ck_assert_ptr_nonnull(srp_materials_touch(list, "b"));
    srp_materials *clone = srp_materials_clone(list);
    ck_assert_ptr_nonnull(clone);
    srp_materials_destroy(list);
    ck_assert_uint_eq(srp_materials_count(clone), 2);
    ck_assert_str_eq(srp_materials_name(clone, 1), "b");
    ck_assert(srp_materials_find(clone, "a", &optics));
    ck_assert(optics.rho_s == 0.125 && optics.rho_d == 0.25 && optics.one_sided);
    ck_assert(srp_materials_get(clone, "a")->pinned);
    ck_assert(!srp_materials_find(clone, "b", &optics));
    srp_materials_destroy(clone);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("material");
    TCase *tcase = tcase_create("material");
    tcase_add_test(tcase, shares_have_ranges);
    tcase_add_test(tcase, lists_keep_names_and_order);
    tcase_add_test(tcase, pinned_materials_stay);
    tcase_add_test(tcase, clones_are_independent);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
