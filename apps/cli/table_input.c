/* SPDX-License-Identifier: Apache-2.0 */
#include "table_input.h"

#include "messages.h"
#include "restate.h"

#include <stdio.h>
#include <string.h>

int cli_table_check(const srp_table *table, const char *path) {
    srp_grid grid = srp_table_grid(table);
    double largest = 0.0;
    for (uint32_t i = 0; i < grid.az_count; ++i) {
        for (uint32_t j = 0; j < grid.el_count; ++j) {
            const srp_response *node = srp_table_node(table, i, j);
            if (node == NULL || !srp_vec3_is_finite(node->f) || !srp_vec3_is_finite(node->t)) {
                cli_say_of_file(
                    "%s: the node at azimuth %g, elevation %g is %s, expected finite numbers", path,
                    srp_grid_azimuth_deg(grid, i), srp_grid_elevation_deg(grid, j),
                    node == NULL ? "empty" : "not finite");
                return CLI_BAD_INPUT;
            }
            largest = fmax(largest, srp_vec3_norm(node->f));
        }
    }
    if (largest == 0.0) {
        cli_say_of_file("%s: the force is 0 from all directions, expected a spacecraft", path);
        return CLI_BAD_INPUT;
    }
    double pull = srp_table_pull_share(table);
    if (pull > SRP_TABLE_PULL_LIMIT) {
        cli_say_of_file(
            "%s: light pulls from %.0f %% of the directions: the signs follow the opposite "
            "convention; 'srp convert --flip' turns them round",
            path, 100.0 * pull);
        return CLI_BAD_INPUT;
    }
    return CLI_DONE;
}

int cli_table_open_checked(const char *path, srp_table **out) {
    srp_table *table = NULL;
    int status = cli_table_read(path, &table);
    if (status == CLI_DONE) {
        status = cli_table_check(table, path);
    }
    if (status != CLI_DONE) {
        srp_table_destroy(table);
        return status;
    }
    *out = table;
    return CLI_DONE;
}

void cli_table_summary(const srp_table *table, char *buffer, size_t size) {
    const srp_table_info *info = srp_table_get_info(table);
    srp_grid grid = srp_table_grid(table);
    const char *method = strcmp(info->method, info->title) == 0 ? "" : info->method;
    snprintf(buffer, size, "%s%s%s%s%g x %g degrees", info->title,
             info->title[0] != '\0' ? ", " : "", method, method[0] != '\0' ? ", " : "",
             360.0 / (grid.az_count - 1), 180.0 / (grid.el_count - 1));
}
