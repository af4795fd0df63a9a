/* SPDX-License-Identifier: Apache-2.0 */
/* MTL text to materials, on top of one that is pinned and one that is not. */
#include "fuzz.h"

#include <srp/material.h>

static const srp_optics pinned = {0.25, 0.125, true};

static srp_materials *list_with_two(void) {
    srp_materials *list;
    srp_error error;
    REQUIRE(srp_materials_create(&list, &error) == SRP_OK);
    REQUIRE(srp_materials_set(list, "a", pinned, true, &error) == SRP_OK);
    REQUIRE(srp_materials_set(list, "b", pinned, false, &error) == SRP_OK);
    return list;
}

static int same(srp_optics a, srp_optics b) {
    return a.rho_s == b.rho_s && a.rho_d == b.rho_d && a.one_sided == b.one_sided;
}

static void check_same(const srp_materials *a, const srp_materials *b) {
    REQUIRE(srp_materials_count(a) == srp_materials_count(b));
    for (size_t i = 0; i < srp_materials_count(a); ++i) {
        const char *name = srp_materials_name(a, i);
        srp_optics left = {0}, right = {0};
        REQUIRE(strcmp(name, srp_materials_name(b, i)) == 0);
        REQUIRE(srp_materials_find(a, name, &left) == srp_materials_find(b, name, &right));
        REQUIRE(same(left, right));
        REQUIRE(srp_optics_check(left, NULL) == SRP_OK);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const char *text = (const char *)data;
    srp_materials *list = list_with_two(), *again = list_with_two();
    srp_error error;
    srp_optics optics;
    srp_status status = srp_materials_parse_mtl(list, text, size, "fuzz", NULL, &error);
    REQUIRE(srp_materials_find(list, "a", &optics) && same(optics, pinned));
    if (status == SRP_OK) {
        REQUIRE(srp_materials_parse_mtl(again, text, size, "fuzz", NULL, &error) == SRP_OK);
    } else {
        REQUIRE(status == SRP_BAD_FORMAT || status == SRP_BAD_DATA);
        REQUIRE(error.message[0] != '\0');
    }
    /* After a failure both are as they were made. */
    check_same(list, again);
    srp_materials_destroy(list);
    srp_materials_destroy(again);
    return 0;
}
