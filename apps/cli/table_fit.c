/* SPDX-License-Identifier: Apache-2.0 */
#include "table_fit.h"

#include "command.h"
#include "messages.h"

enum { SEARCH_DIRECTIONS = 800 };

int cli_table_explain(const char *name, const cli_samples *samples, cli_fit_status status,
                      size_t plates) {
    switch (status) {
    case CLI_FIT_DONE:
        return CLI_DONE;
    case CLI_FIT_NO_MEMORY:
        cli_say("no memory");
        return CLI_MACHINE_FAILED;
    case CLI_FIT_TOO_FEW:
        cli_say_of_file("%s: %zu directions give %zu numbers, too few for %zu plates", name,
                        samples->count, 3 * samples->count, plates);
        return CLI_BAD_INPUT;
    case CLI_FIT_NOT_FINITE:
        cli_say_of_file("%s: holds numbers that are not finite", name);
        return CLI_BAD_INPUT;
    case CLI_FIT_CANCELLED:
        return CLI_MACHINE_FAILED; /* who cancels knows */
    case CLI_FIT_AMBIGUOUS:
    default:
        if (plates == 1) {
            cli_say_of_file("%s: these directions do not determine a plate; a finer table, or "
                            "another normal, can",
                            name);
            return CLI_BAD_INPUT;
        }
        cli_say_of_file("%s: %zu plates cannot be told apart in these directions; fewer plates "
                        "(--plates N), or "
                        "normals farther apart, can",
                        name, plates);
        return CLI_BAD_INPUT;
    }
}

/* A part of the table's grid with few enough directions to search in. */
static srp_grid coarser(srp_grid grid) {
    static const uint32_t divisors[] = {2, 3, 5};
    for (bool more = true; more && srp_grid_node_count(grid) > SEARCH_DIRECTIONS;) {
        more = false;
        for (size_t k = 0; k < sizeof divisors / sizeof divisors[0] && !more; ++k) {
            uint32_t az = grid.az_count - 1, el = grid.el_count - 1;
            if (az % divisors[k] == 0 && el % divisors[k] == 0) {
                grid = (srp_grid){az / divisors[k] + 1, el / divisors[k] + 1};
                more = true;
            }
        }
    }
    return grid;
}

int cli_table_search(const srp_table *table, const char *name, const cli_samples *samples,
                     size_t count, const cli_fit_watch *watch, srp_vec3 *normals) {
    cli_samples few;
    if (!cli_samples_take(table, coarser(samples->grid), false, &few)) {
        cli_say("no memory");
        return CLI_MACHINE_FAILED;
    }
    cli_fit_status status = cli_plate_normals_search(&few, samples, count, watch, normals);
    cli_samples_free(&few);
    return cli_table_explain(name, samples, status, count);
}

int cli_table_fit(const char *name, const cli_samples *samples, size_t count,
                  const srp_vec3 *normals, const cli_fit_watch *watch, cli_plate_fit *out) {
    return cli_table_explain(name, samples,
                             cli_plate_fit_solve(samples, normals, count, watch, out), count);
}
