/* SPDX-License-Identifier: Apache-2.0 */
#include "comparison.h"

#include "command.h"
#include "messages.h"

/* What table t says at a node of the grid. */
static srp_vec3 value_at(const cli_comparison *c, int t, uint32_t i, uint32_t j) {
    srp_vec3 force = {0.0, 0.0, 0.0}, moment = {0.0, 0.0, 0.0};
    if (c->interp[t] != NULL) {
        srp_status status = srp_interp_eval(c->interp[t], srp_grid_direction(c->grid, i, j), &force,
                                            &moment, NULL, NULL);
        return status == SRP_OK && !c->moment ? force : moment;
    }
    srp_grid own = srp_table_grid(c->table[t]);
    const srp_response *node =
        srp_table_node(c->table[t], i * ((own.az_count - 1) / (c->grid.az_count - 1)),
                       j * ((own.el_count - 1) / (c->grid.el_count - 1)));
    return c->moment ? node->t : node->f;
}

void cli_comparison_fields(const cli_comparison *c, double *value) {
    size_t nodes = srp_grid_node_count(c->grid), k = 0;
    for (uint32_t i = 0; i < c->grid.az_count; ++i) {
        for (uint32_t j = 0; j < c->grid.el_count; ++j, ++k) {
            srp_vec3 d = srp_vec3_sub(value_at(c, 1, i, j), value_at(c, 0, i, j));
            value[k] = d.x;
            value[nodes + k] = d.y;
            value[2 * nodes + k] = d.z;
            value[3 * nodes + k] = srp_vec3_norm(d);
        }
    }
}

static int same_reference(const cli_comparison *c) {
    const srp_table_info *a = srp_table_get_info(c->table[0]);
    const srp_table_info *b = srp_table_get_info(c->table[1]);
    for (int k = 0; k < 2; ++k) {
        if (!srp_table_get_info(c->table[k])->has_moment) {
            cli_say_of_file("%s: holds no moments, expected them for --moment", c->name[k]);
            return CLI_BAD_INPUT;
        }
    }
    srp_vec3 apart = srp_vec3_sub(a->params.reference, b->params.reference);
    if (srp_vec3_norm(apart) > 0.0) {
        srp_vec3 p = b->params.reference, q = a->params.reference;
        cli_say_of_file("%s: moments are about (%g, %g, %g) m, expected (%g, %g, %g) m as in %s",
                        c->name[1], p.x, p.y, p.z, q.x, q.y, q.z, c->name[0]);
        return CLI_BAD_INPUT;
    }
    return CLI_DONE;
}

/* The grid to compare on, and interpolants of the table that lacks its nodes. */
static int choose_grid(cli_comparison *c) {
    c->grid = cli_grid_finer(srp_table_grid(c->table[0]), srp_table_grid(c->table[1]));
    for (int k = 0; k < 2; ++k) {
        srp_error error;
        if (!cli_grid_contains(srp_table_grid(c->table[k]), c->grid) &&
            srp_interp_create(c->scheme, c->table[k], &c->interp[k], &error) != SRP_OK) {
            cli_say_of_file("%s: cannot be interpolated: %s", c->name[k], error.message);
            return error.status == SRP_NO_MEMORY ? CLI_MACHINE_FAILED : CLI_BAD_INPUT;
        }
        c->is_interpolated[k] = c->interp[k] != NULL;
    }
    return CLI_DONE;
}

static bool take(const cli_comparison *c, int k, cli_samples *out) {
    return c->interp[k] != NULL ? cli_samples_interpolate(c->interp[k], c->grid, c->moment, out)
                                : cli_samples_take(c->table[k], c->grid, c->moment, out);
}

static int measure(cli_comparison *c) {
    cli_samples a, b;
    if (!take(c, 0, &a)) {
        cli_say("no memory");
        return CLI_MACHINE_FAILED;
    }
    if (!take(c, 1, &b)) {
        cli_samples_free(&a);
        cli_say("no memory");
        return CLI_MACHINE_FAILED;
    }
    c->directions = a.count;
    c->difference = cli_difference_measure(&a, b.value, NULL);
    cli_samples_free(&a);
    cli_samples_free(&b);
    return CLI_DONE;
}

int cli_comparison_make(cli_comparison *c) {
    int status = c->moment ? same_reference(c) : CLI_DONE;
    if (status == CLI_DONE) {
        status = choose_grid(c);
    }
    return status == CLI_DONE ? measure(c) : status;
}

void cli_comparison_release(cli_comparison *c) {
    for (int k = 0; k < 2; ++k) {
        srp_interp_destroy(c->interp[k]);
        c->interp[k] = NULL;
    }
}
