/* SPDX-License-Identifier: Apache-2.0 */
/* SPAD table text to table. */
#include "fuzz.h"

#include <srp/table.h>

static void check_node(const srp_table *a, const srp_table *b, uint32_t i, uint32_t j) {
    const srp_response *node = srp_table_node(a, i, j), *again = srp_table_node(b, i, j);
    REQUIRE(node != NULL && again != NULL);
    REQUIRE(srp_vec3_is_finite(node->f) && srp_vec3_is_finite(node->t));
    REQUIRE(node->f.x == again->f.x && node->f.y == again->f.y && node->f.z == again->f.z);
    REQUIRE(node->t.x == again->t.x && node->t.y == again->t.y && node->t.z == again->t.z);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const char *text = (const char *)data;
    srp_table *table, *again;
    srp_error error;
    srp_status status = srp_table_parse_spo(text, size, "fuzz", &table, &error);
    if (status != SRP_OK) {
        REQUIRE(status == SRP_BAD_FORMAT || status == SRP_BAD_DATA);
        REQUIRE(error.message[0] != '\0');
        return 0;
    }
    REQUIRE(srp_table_parse_spo(text, size, "fuzz", &again, &error) == SRP_OK);
    srp_grid grid = srp_table_grid(table), grid_again = srp_table_grid(again);
    REQUIRE(grid.az_count >= 2 && grid.el_count >= 2);
    REQUIRE(grid.az_count == grid_again.az_count && grid.el_count == grid_again.el_count);
    REQUIRE(srp_table_is_complete(table));
    for (uint32_t i = 0; i < grid.az_count; ++i) {
        for (uint32_t j = 0; j < grid.el_count; ++j) {
            check_node(table, again, i, j);
        }
    }
    double share = srp_table_pull_share(table);
    REQUIRE(share >= 0.0 && share <= 1.0);
    srp_table_destroy(table);
    srp_table_destroy(again);
    return 0;
}
