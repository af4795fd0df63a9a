/* SPDX-License-Identifier: Apache-2.0 */
#include "interp_fixture.h"

#include "srp_check.h"
#include "table_internal.h"

#include <math.h>

field_value smooth_field(srp_vec3 s) {
    double u = 0.731 * s.x - 1.137 * s.y + 0.893 * s.z;
    double v = -0.419 * s.x + 0.677 * s.y + 1.271 * s.z;
    field_value value;
    value.f = srp_vec3_make(sin(1.7 * u) - s.x, exp(0.83 * v), u * v * v + cos(2.1 * v + 0.3));
    value.t = srp_vec3_make(cos(1.9 * u - 0.2), u * u * u - s.y, sin(u + 1.4 * v));
    return value;
}

void set_node(srp_table *table, uint32_t i, uint32_t j, field_value value) {
    size_t index = srp_table_index(table, i, j);
    table->nodes[index].f = value.f;
    table->nodes[index].t = value.t;
    srp_table_mark_filled(table, index);
}

static srp_vec3 random_vec3(uint64_t *state) {
    double x = 2.0 * random_unit(state) - 1.0, y = 2.0 * random_unit(state) - 1.0;
    return srp_vec3_make(x, y, 2.0 * random_unit(state) - 1.0);
}

srp_table *field_table(uint32_t az_steps, uint32_t el_steps, bool moment, field_function *field) {
    srp_table *table = NULL;
    srp_error error;
    srp_grid grid = {az_steps + 1, el_steps + 1};
    uint64_t state = 20241124;
    assert_ok(srp_table_create_blank(grid, 0, false, &table, &error), error);
    table->info.has_moment = moment;
    for (uint32_t i = 0; i <= az_steps; ++i) {
        for (uint32_t j = 0; j <= el_steps; ++j) {
            field_value value = {random_vec3(&state), random_vec3(&state)};
            bool pole = j == 0 || j == el_steps;
            if (field != NULL) {
                value = field(srp_grid_direction(grid, i, j));
            } else if ((pole && i > 0) || i == az_steps) {
                const srp_response *same = srp_table_node(table, 0, j);
                value.f = same->f;
                value.t = same->t;
            }
            set_node(table, i, j, value);
        }
    }
    return table;
}

srp_interp *make_interp(const srp_interp_scheme *scheme, const srp_table *table) {
    srp_interp *interp = NULL;
    srp_error error;
    assert_ok(srp_interp_create(scheme, table, &interp, &error), error);
    return interp;
}

srp_interp *field_interp(const srp_interp_scheme *scheme, uint32_t az_steps, uint32_t el_steps,
                         field_function *field) {
    srp_table *table = field_table(az_steps, el_steps, true, field);
    srp_interp *interp = make_interp(scheme, table);
    srp_table_destroy(table);
    return interp;
}

field_value ask(const srp_interp *interp, srp_vec3 s) {
    field_value value;
    srp_error error;
    assert_ok(srp_interp_eval(interp, s, &value.f, &value.t, NULL, &error), error);
    return value;
}

srp_interp_jacobian ask_slopes(const srp_interp *interp, srp_vec3 s) {
    field_value value, alone = ask(interp, s);
    srp_interp_jacobian slopes;
    srp_error error;
    assert_ok(srp_interp_eval(interp, s, &value.f, &value.t, &slopes, &error), error);
    ck_assert(field_distance(value, alone) == 0.0);
    return slopes;
}

double field_distance(field_value a, field_value b) {
    return hypot(srp_vec3_norm(srp_vec3_sub(a.f, b.f)), srp_vec3_norm(srp_vec3_sub(a.t, b.t)));
}

double jacobian_distance(const srp_interp_jacobian *a, const srp_interp_jacobian *b) {
    double most = 0.0;
    for (int k = 0; k < 9; ++k) {
        most = fmax(most, fabs(a->df[k / 3][k % 3] - b->df[k / 3][k % 3]));
        most = fmax(most, fabs(a->dt[k / 3][k % 3] - b->dt[k / 3][k % 3]));
        ck_assert(isfinite(a->df[k / 3][k % 3]) && isfinite(a->dt[k / 3][k % 3]));
    }
    return most;
}

double jacobian_size(const srp_interp_jacobian *a) {
    const srp_interp_jacobian zero = {{{0.0}}, {{0.0}}};
    return jacobian_distance(a, &zero);
}

srp_vec3 turned_towards(srp_vec3 s, srp_vec3 towards, double angle) {
    srp_vec3 side = srp_vec3_add_scaled(towards, -srp_vec3_dot(towards, s), s);
    side = srp_vec3_scale(1.0 / srp_vec3_norm(side), side);
    return srp_vec3_add_scaled(srp_vec3_scale(cos(angle), s), sin(angle), side);
}
