/* SPDX-License-Identifier: Apache-2.0 */
#include "outputs.h"

#include "interp_check.h"
#include "messages.h"
#include "system.h"
#include "utf8.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const srp_table_format *cli_format_of(const char *path) {
    const srp_table_format *format = srp_table_format_of(path);
    if (format == NULL) {
        char endings[128];
        size_t count, used = 0;
        const srp_table_format *const *formats = srp_table_format_list(&count);
        for (size_t i = 0; i < count && used < sizeof endings; ++i) {
            used += (size_t)snprintf(endings + used, sizeof endings - used, "%s%s",
                                     i > 0 ? ", " : "", formats[i]->ending);
        }
        cli_usage_error("%s: unknown ending (formats of tables: %s)", path, endings);
    }
    return format;
}

const srp_table_format *cli_input_format_of(const char *path) {
    return cli_ends_with(path, CLI_PARTIAL_ENDING) ? &srp_table_format_netcdf
                                                   : srp_table_format_of(path);
}

static int check_output(const char *path, cli_table_content content, const char *const *inputs,
                        size_t input_count) {
    const srp_table_format *format = cli_format_of(path);
    if (format == NULL) {
        return CLI_BAD_USAGE;
    }
    if ((format->capabilities & SRP_FORMAT_MASS) != 0 && !content.mass) {
        return cli_usage_error("%s holds accelerations and needs the mass of the spacecraft: "
                               "--mass KG",
                               path);
    }
    for (size_t i = 0; i < input_count; ++i) {
        if (inputs[i] != NULL && cli_system_same_file(path, inputs[i])) {
            return cli_usage_error("%s is input and output at once", path);
        }
    }
    const char *reason;
    if (!cli_system_can_write(path, &reason)) {
        cli_say_of_file("%s: cannot write: %s", path, reason);
        return CLI_MACHINE_FAILED;
    }
    return CLI_DONE;
}

int cli_outputs_check(const cli_list *paths, cli_table_content content, const char *const *inputs,
                      size_t input_count) {
    bool keeps_basis = false;
    for (size_t i = 0; i < paths->count; ++i) {
        int status = check_output(paths->items[i], content, inputs, input_count);
        if (status != CLI_DONE) {
            return status;
        }
        for (size_t k = 0; k < i; ++k) {
            if (cli_system_same_name(paths->items[i], paths->items[k])) {
                return cli_usage_error("%s is given twice as output", paths->items[i]);
            }
        }
        const srp_table_format *format = srp_table_format_of(paths->items[i]);
        keeps_basis = keeps_basis || (format->capabilities & SRP_FORMAT_BASIS) != 0;
    }
    if (content.basis && !keeps_basis) {
        return cli_usage_error("--basis needs an output that keeps sums per material: FILE.nc");
    }
    return CLI_DONE;
}

int cli_outputs_write(const cli_list *paths, const srp_table *table, size_t *written) {
    int result = CLI_DONE;
    *written = 0;
    for (size_t i = 0; i < paths->count; ++i) {
        srp_error error;
        const srp_table_format *format = srp_table_format_of(paths->items[i]);
        if (srp_table_write(table, format, paths->items[i], &error) == SRP_OK) {
            ++*written;
            continue;
        }
        int status = cli_output_error(&error);
        result = result == CLI_DONE ? status : result;
    }
    return result;
}

void cli_outputs_report(const cli_list *paths, const srp_table *table) {
    srp_grid grid = srp_table_grid(table);
    double least = INFINITY, most = 0.0, error = 0.0;
    for (uint32_t i = 0; i < grid.az_count; ++i) {
        for (uint32_t j = 0; j < grid.el_count; ++j) {
            const srp_response *node = srp_table_node(table, i, j);
            double size = srp_vec3_norm(node->f);
            least = fmin(least, size);
            most = fmax(most, size);
            error = fmax(error, node->f_error);
        }
    }
    for (size_t i = 0; i < paths->count; ++i) {
        printf("%s\n", paths->items[i]);
    }
    printf("%zu nodes, steps of %g x %g degrees, |f| from %g to %g m^2", srp_grid_node_count(grid),
           360.0 / (grid.az_count - 1), 180.0 / (grid.el_count - 1), least, most);
    if (srp_table_get_info(table)->has_error) {
        error > 0.0 ? printf(", standard error up to %.2g m^2", error)
                    : printf(", no sampling error");
    }
    fputc('\n', stdout);
    cli_interp_check_report(table);
}
