/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L /* nanosleep */

#include "demand_fixture.h"

#include "error.h"
#include "method_internal.h"
#include "srp_check.h"
#include "table_internal.h"

#include <srp/const.h>

#include <string.h>
#include <time.h>

counting_state counting;

size_t counting_index(srp_demand_node node) {
    const srp_grid grid = counting.grid;
    bool pole = node.j == 0 || node.j == grid.el_count - 1;
    uint32_t i = pole || node.i == grid.az_count - 1 ? 0 : node.i;
    return (size_t)i * grid.el_count + node.j;
}

static void count_answer(srp_vec3 s) {
    const srp_grid grid = counting.grid;
    double az = atan2(s.y, s.x) / SRP_RAD_PER_DEG, el = asin(s.z) / SRP_RAD_PER_DEG;
    srp_demand_node node = {(uint32_t)lround((az + 180.0) / 360.0 * (grid.az_count - 1)),
                            (uint32_t)lround((el + 90.0) / 180.0 * (grid.el_count - 1))};
    atomic_fetch_add(&counting.answered[counting_index(node)], 1);
}

static void answer(srp_vec3 s, srp_response *out) {
    double u = 0.731 * s.x - 1.137 * s.y + 0.893 * s.z;
    double v = -0.419 * s.x + 0.677 * s.y + 1.271 * s.z;
    memset(out, 0, sizeof *out);
    out->f = srp_vec3_make(sin(1.7 * u) - s.x, exp(0.83 * v), u * v * v + cos(2.1 * v + 0.3));
    out->t = srp_vec3_make(cos(1.9 * u - 0.2), u * u * u - s.y, sin(u + 1.4 * v));
    out->lit_area = 1.0 + u * u;
    out->f_error = 0.01 * v * v;
}

static void sleep_us(long us) {
    struct timespec pause = {us / 1000000, us % 1000000 * 1000};
    if (us > 0) {
        nanosleep(&pause, NULL);
    }
}

static srp_status respond(const srp_prepared *prepared, size_t count, const srp_vec3 *s_body,
                          srp_response *responses, srp_basis *basis, srp_error *error) {
    (void)basis;
    long call = atomic_fetch_add(&counting.calls, 1) + 1;
    bool fails = counting.fail_every > 0 && call % counting.fail_every == 0;
    sleep_us(counting.delay_us);
    if (fails && counting.failure != SRP_OK) {
        return srp_fail(error, counting.failure, "call %ld fails", call);
    }
    for (size_t k = 0; k < count; ++k) {
        count_answer(s_body[k]);
        answer(s_body[k], &responses[k]);
        if (fails) {
            responses[k].f.y = NAN;
        }
        if (!(prepared->method->capabilities & SRP_METHOD_MOMENT)) {
            responses[k].t = srp_vec3_make(0.0, 0.0, 0.0);
        }
    }
    return SRP_OK;
}

static srp_status prepare(const srp_scene *scene, const srp_method_params *params,
                          srp_prepared **out, srp_error *error) {
    (void)error;
    srp_prepared *prepared = calloc(1, sizeof *prepared);
    ck_assert_ptr_nonnull(prepared);
    prepared->method = &counting_method;
    prepared->scene = scene;
    prepared->params = *params;
    *out = prepared;
    return SRP_OK;
}

static srp_status prepare_forceless(const srp_scene *scene, const srp_method_params *params,
                                    srp_prepared **out, srp_error *error) {
    srp_status status = prepare(scene, params, out, error);
    (*out)->method = &forceless_method;
    return status;
}

static void release(srp_prepared *prepared) {
    free(prepared);
}

const srp_method counting_method = {
    .name = "counting",
    .device = "test",
    .summary = "counts its answers",
    .shapes = SRP_SHAPE_PLATES,
    .capabilities = SRP_METHOD_MOMENT | SRP_METHOD_LATTICE,
    .prepare = prepare,
    .respond = respond,
    .release = release,
};

const srp_method forceless_method = {
    .name = "forces",
    .device = "test",
    .summary = "counts its answers, and knows no moments",
    .shapes = SRP_SHAPE_PLATES,
    .capabilities = 0,
    .prepare = prepare_forceless,
    .respond = respond,
    .release = release,
};

counting_fixture counting_begin(const srp_method *method, srp_grid grid) {
    const srp_plate plate = {{0.0, 0.6, 0.8}, 2.0, {0.3, 0.2, false}};
    srp_method_params params = srp_method_params_default();
    counting_fixture fixture = {.grid = grid};
    srp_error error;
    params.threads = 1;
    assert_ok(srp_scene_from_plates(&plate, 1, &fixture.scene, &error), error);
    assert_ok(srp_method_prepare(method, fixture.scene, &params, &fixture.prepared, &error), error);
    memset(&counting, 0, sizeof counting);
    counting.grid = grid;
    counting.answered = calloc(srp_grid_node_count(grid), sizeof *counting.answered);
    ck_assert_ptr_nonnull(counting.answered);
    return fixture;
}

void counting_end(counting_fixture *fixture) {
    srp_prepared_release(fixture->prepared);
    srp_scene_destroy(fixture->scene);
    free(counting.answered);
    counting.answered = NULL;
}

size_t counting_nodes(void) {
    size_t nodes = 0;
    for (size_t k = 0; k < srp_grid_node_count(counting.grid); ++k) {
        nodes += atomic_load(&counting.answered[k]) > 0;
    }
    return nodes;
}

int counting_most(void) {
    int most = 0;
    for (size_t k = 0; k < srp_grid_node_count(counting.grid); ++k) {
        int times = atomic_load(&counting.answered[k]);
        most = times > most ? times : most;
    }
    return most;
}

srp_demand *make_demand(const counting_fixture *fixture, srp_cache *cache) {
    srp_demand *demand = NULL;
    srp_error error;
    assert_ok(srp_demand_create(fixture->prepared, fixture->grid, cache, &demand, &error), error);
    return demand;
}

srp_table *full_table(const counting_fixture *fixture) {
    srp_table *table = NULL;
    srp_error error;
    assert_ok(srp_table_create(fixture->prepared, fixture->grid, false, &table, &error), error);
    assert_ok(srp_table_fill(table, fixture->prepared, NULL, &error), error);
    /* These are not what is counted. */
    for (size_t k = 0; k < srp_grid_node_count(counting.grid); ++k) {
        atomic_store(&counting.answered[k], 0);
    }
    atomic_store(&counting.calls, 0);
    return table;
}

void need_columns(srp_demand *demand, uint32_t begin, uint32_t end) {
    const srp_grid grid = srp_demand_grid(demand);
    srp_error error;
    for (uint32_t i = begin; i < end; ++i) {
        srp_demand_node nodes[512];
        ck_assert(grid.el_count <= 512);
        for (uint32_t j = 0; j < grid.el_count; ++j) {
            nodes[j] = (srp_demand_node){i, j};
        }
        assert_ok(srp_demand_need(demand, grid.el_count, nodes, &error), error);
    }
}

void assert_is_full(const counting_fixture *fixture, const srp_demand *demand) {
    srp_table *full = NULL, *ours = NULL;
    srp_error error;
    char wanted[33], got[33];
    assert_ok(srp_table_create(fixture->prepared, fixture->grid, false, &full, &error), error);
    assert_ok(srp_table_fill(full, fixture->prepared, NULL, &error), error);
    assert_ok(srp_demand_copy(demand, &ours, &error), error);
    ck_assert(srp_table_is_complete(ours));
    srp_table_checksum(full, wanted);
    srp_table_checksum(ours, got);
    ck_assert_str_eq(got, wanted);
    srp_table_destroy(full);
    srp_table_destroy(ours);
}
