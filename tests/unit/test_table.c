/* SPDX-License-Identifier: Apache-2.0 */
#include "srp_check.h"
#include "table_fixture.h"

#include <string.h>

static void assert_fails(srp_status got, srp_status expected, const srp_error *error,
                         const char *words) {
    ck_assert_msg(got == expected, "status '%s', expected '%s'", srp_status_string(got),
                  srp_status_string(expected));
    ck_assert_int_eq(error->status, expected);
    ck_assert_msg(strstr(error->message, words) != NULL, "'%s' lacks '%s'", error->message, words);
}

/* ---- Filling -------------------------------------------------------------------------------- */

START_TEST(nodes_hold_what_the_method_answers) {
    const srp_method *methods[] = {&srp_method_cannonball, &srp_method_nplate, &noise_method};
    for (size_t k = 0; k < sizeof methods / sizeof methods[0]; ++k) {
        table_fixture fixture = fixture_create(methods[k], NULL);
        srp_grid grid = grid_of(30, 15);
        bool with_basis = (methods[k]->capabilities & SRP_METHOD_BASIS) != 0;
        srp_table *table = noise_table(&fixture, grid, with_basis);
        ck_assert(srp_table_is_complete(table));
        srp_basis basis[3];
        srp_error error;
        for (uint32_t i = 0; i < grid.az_count; ++i) {
            for (uint32_t j = 0; j < grid.el_count; ++j) {
                srp_vec3 s = srp_grid_direction(grid, i, j);
                srp_response expected;
                assert_ok(srp_prepared_respond(fixture.prepared, 1, &s, &expected,
                                               with_basis ? basis : NULL, &error),
                          error);
                const srp_response *node = srp_table_node(table, i, j);
                ck_assert_ptr_nonnull(node);
                ck_assert_mem_eq(&node->f, &expected.f, sizeof expected.f);
                ck_assert_mem_eq(&node->t, &expected.t, sizeof expected.t);
                ck_assert(node->lit_area == expected.lit_area);
                ck_assert(node->samples == expected.samples);
                ck_assert((srp_table_node_basis(table, i, j) != NULL) == with_basis);
                if (with_basis) {
                    ck_assert_mem_eq(srp_table_node_basis(table, i, j), basis, sizeof basis);
                }
            }
        }
        srp_table_destroy(table);
        fixture_destroy(fixture);
    }
}
END_TEST

START_TEST(a_table_knows_its_origin) {
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_table *table = noise_table(&fixture, grid_of(90, 90), true);
    const srp_table_info *info = srp_table_get_info(table);
    ck_assert_str_eq(info->method, "noise");
    ck_assert_str_eq(info->device, "test");
    ck_assert_str_eq(info->shape_hash, srp_scene_shape_hash(fixture.scene));
    ck_assert_str_eq(info->optics_hash, srp_scene_optics_hash(fixture.scene));
    ck_assert_str_eq(info->version, SRP_VERSION);
    ck_assert(info->has_error && info->has_moment && info->has_basis);
    ck_assert(info->mass == 123.5 && info->light.flux == 1361.0);
    ck_assert_uint_eq(srp_table_material_count(table), 2);
    ck_assert_str_eq(srp_table_material_name(table, 1), srp_scene_material_name(fixture.scene, 1));
    ck_assert(srp_table_material_optics(table, 1).rho_d == 0.7);
    ck_assert(srp_table_material_optics(table, 1).one_sided);
    srp_table_destroy(table);
    fixture_destroy(fixture);
}
END_TEST

typedef struct watch {
    size_t calls, cancel_at; /* which call says no; SIZE_MAX = none */
    size_t last_done, total;
} watch;

static bool watch_report(void *user, const srp_table *table, size_t done, size_t total) {
    watch *state = user;
    ck_assert_uint_ge(done, state->last_done);
    ck_assert_uint_le(done, total);
    ck_assert(srp_table_is_complete(table) == (done == total));
    state->last_done = done;
    state->total = total;
    return state->calls++ != state->cancel_at;
}

START_TEST(progress_counts_directions) {
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_grid grid = grid_of(10, 10);
    srp_table *table;
    srp_error error;
    watch state = {0, SIZE_MAX, 0, 0};
    srp_table_progress progress = {watch_report, &state};
    assert_ok(srp_table_create(fixture.prepared, grid, false, &table, &error), error);
    ck_assert_ptr_null(srp_table_node(table, 3, 3));
    ck_assert_uint_eq(srp_table_filled_count(table), 0);
    assert_ok(srp_table_fill(table, fixture.prepared, &progress, &error), error);
    /* 36 azimuths on 17 circles, and two poles. */
    ck_assert_uint_eq(state.total, 36 * 17 + 2);
    ck_assert_uint_eq(state.last_done, state.total);
    ck_assert_uint_ge(state.calls, 3);
    ck_assert_uint_eq(srp_table_filled_count(table), srp_grid_node_count(grid));
    srp_table_destroy(table);
    fixture_destroy(fixture);
}
END_TEST

/* Interrupted at every possible batch and taken up again, on any number of threads. */
START_TEST(the_result_depends_on_neither_threads_nor_interruptions) {
    srp_grid grid = grid_of(10, 15);
    table_fixture first = fixture_create(&noise_method, NULL);
    srp_table *whole = noise_table(&first, grid, true);
    const int threads[] = {1, 2, 3, 7};
    for (size_t k = 0; k < sizeof threads / sizeof threads[0]; ++k) {
        srp_method_params params = fixture_params(threads[k]);
        table_fixture fixture = fixture_create(&noise_method, &params);
        for (size_t cancel_at = 0; cancel_at < 4; ++cancel_at) {
            srp_table *table;
            srp_error error;
            watch state = {0, cancel_at, 0, 0};
            srp_table_progress progress = {watch_report, &state};
            assert_ok(srp_table_create(fixture.prepared, grid, true, &table, &error), error);
            const srp_table_info *info = srp_table_get_info(whole);
            assert_ok(srp_table_describe(table, info->title, info->command_line, info->light,
                                         info->mass, &error),
                      error);
            srp_status status = srp_table_fill(table, fixture.prepared, &progress, &error);
            if (state.last_done < state.total) {
                assert_fails(status, SRP_CANCELLED, &error, "cancelled after");
                ck_assert(!srp_table_is_complete(table));
                ck_assert((srp_table_filled_count(table) > 0) == (cancel_at > 0));
            }
            assert_ok(srp_table_fill(table, fixture.prepared, NULL, &error), error);
            assert_same_table(table, whole);
            srp_table_destroy(table);
        }
        fixture_destroy(fixture);
    }
    srp_table_destroy(whole);
    fixture_destroy(first);
}
END_TEST

START_TEST(running_out_of_memory_keeps_what_is_done) {
    srp_grid grid = grid_of(10, 15);
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_table *whole = noise_table(&fixture, grid, false);
    srp_table *table;
    srp_error error;
    srp_table *described = noise_table(&fixture, grid, false);
    srp_table_destroy(described);
    assert_ok(srp_table_create(fixture.prepared, grid, false, &table, &error), error);
    noise_directions_left = 100;
    assert_fails(srp_table_fill(table, fixture.prepared, NULL, &error), SRP_NO_MEMORY, &error,
                 "no memory for the noise method");
    noise_directions_left = SIZE_MAX;
    size_t kept = srp_table_filled_count(table);
    ck_assert(kept > 0 && kept < srp_grid_node_count(grid));
    assert_ok(srp_table_fill(table, fixture.prepared, NULL, &error), error);
    for (uint32_t i = 0; i < grid.az_count; ++i) {
        for (uint32_t j = 0; j < grid.el_count; ++j) {
            ck_assert_mem_eq(srp_table_node(table, i, j), srp_table_node(whole, i, j),
                             sizeof(srp_vec3));
        }
    }
    srp_table_destroy(table);
    srp_table_destroy(whole);
    fixture_destroy(fixture);
}
END_TEST

START_TEST(what_cannot_be_made_is_refused) {
    table_fixture ball = fixture_create(&srp_method_cannonball, NULL);
    srp_table *table = NULL;
    srp_error error;
    assert_fails(srp_table_create(ball.prepared, grid_of(90, 90), true, &table, &error),
                 SRP_UNSUPPORTED, &error, "method cannonball gives no sums per material");
    const srp_grid bad[] = {{1, 5}, {5, 1}, {0, 0}, {36002, 3}, {3, 18002}};
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        assert_fails(srp_table_create(ball.prepared, bad[k], false, &table, &error),
                     SRP_BAD_ARGUMENT, &error, "expected 2 to 36001 azimuths");
    }
    ck_assert_ptr_null(table);
    srp_table_destroy(NULL);
    assert_ok(srp_table_create(ball.prepared, grid_of(90, 90), false, &table, &error), error);
    const struct {
        double flux, au, mass;
        const char *words;
    } cases[] = {{0, 1e11, 1, "solar flux 0"},
                 {NAN, 1e11, 1, "solar flux nan"},
                 {1367, -1, 1, "at -1 m"},
                 {1367, 1e11, 0, "mass of 0 kg"},
                 {1367, 1e11, -2, "mass of -2"},
                 {1367, 1e11, INFINITY, "mass of inf"},
                 {1367, 1e11, 1e-310, "mass of 1e-310"},
                 {1e31, 1e11, 1, "solar flux 1e+31"}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        srp_sunlight light = {cases[k].flux, cases[k].au};
        assert_fails(srp_table_describe(table, "a", "b", light, cases[k].mass, &error),
                     SRP_BAD_ARGUMENT, &error, cases[k].words);
    }
    srp_table_destroy(table);
    fixture_destroy(ball);
}
END_TEST

/* ---- Origin --------------------------------------------------------------------------------- */

START_TEST(a_table_goes_on_only_where_it_came_from) {
    srp_method_params params = fixture_params(1);
    params.lattice.samples = 100;
    params.tolerance = 1e-4;
    params.seed = 5;
    srp_grid grid = grid_of(90, 90);
    table_fixture origin = fixture_create(&noise_method, &params);
    srp_table *table;
    srp_error error;
    assert_ok(srp_table_create(origin.prepared, grid, true, &table, &error), error);
    assert_ok(srp_table_check_origin(table, origin.prepared, grid, true, &error), error);
    assert_fails(srp_table_check_origin(table, origin.prepared, grid_of(90, 45), true, &error),
                 SRP_MISMATCH, &error, "grid has 5 x 3 nodes, asked for are 5 x 5");
    assert_fails(srp_table_check_origin(table, origin.prepared, grid, false, &error), SRP_MISMATCH,
                 &error, "keeps sums per material");

    const char *words[] = {"reference point, y",       "seed is 5, asked for is 6",
                           "number of samples",        "cell of the lattice",
                           "kind of lattice",          "tolerance",
                           "largest number of samples"};
    for (int k = 0; k < 7; ++k) {
        srp_method_params other = params;
        other.threads = 3; /* never matters */
        other.reference.y = k == 0 ? 0.5 : 0.0;
        other.seed = k == 1 ? 6 : 5;
        other.lattice.samples = k == 2 ? 101 : 100;
        other.lattice.pixel = k == 3 ? 0.1 : NAN;
        if (k == 4) {
            other.lattice.kind = SRP_LATTICE_WINDOW;
            other.lattice.window[0] = other.lattice.window[2] = -1.0;
            other.lattice.window[1] = other.lattice.window[3] = 1.0;
        }
        other.tolerance = k == 5 ? 1e-5 : 1e-4;
        other.max_samples = k == 6 ? 4096 : 8192;
        table_fixture fixture = fixture_create(&noise_method, &other);
        assert_fails(srp_table_check_origin(table, fixture.prepared, grid, true, &error),
                     SRP_MISMATCH, &error, words[k]);
        assert_fails(srp_table_fill(table, fixture.prepared, NULL, &error), SRP_MISMATCH, &error,
                     words[k]);
        fixture_destroy(fixture);
    }
    table_fixture plates = fixture_create(&srp_method_nplate, NULL);
    assert_fails(srp_table_check_origin(table, plates.prepared, grid, true, &error), SRP_MISMATCH,
                 &error, "method is 'noise', asked for is 'nplate'");
    fixture_destroy(plates);
    srp_table_destroy(table);
    fixture_destroy(origin);
}
END_TEST

START_TEST(another_shape_or_optics_is_another_table) {
    const srp_plate plates[] = {{{0.0, 0.0, 1.0}, 2.0, {0.3, 0.2, false}}};
    srp_grid grid = grid_of(90, 90);
    srp_method_params params = fixture_params(1);
    srp_table *table = NULL;
    srp_error error;
    for (int k = 0; k < 3; ++k) {
        srp_plate plate = plates[0];
        plate.area = k == 1 ? 2.5 : 2.0;
        plate.optics.rho_s = k == 2 ? 0.4 : 0.3;
        srp_scene *scene;
        srp_prepared *prepared;
        assert_ok(srp_scene_from_plates(&plate, 1, &scene, &error), error);
        assert_ok(srp_method_prepare(&srp_method_nplate, scene, &params, &prepared, &error), error);
        if (k == 0) {
            assert_ok(srp_table_create(prepared, grid, false, &table, &error), error);
        } else {
            assert_fails(srp_table_fill(table, prepared, NULL, &error), SRP_MISMATCH, &error,
                         k == 1 ? "shape (its hash)" : "optics (their hash)");
        }
        srp_prepared_release(prepared);
        srp_scene_destroy(scene);
    }
    srp_table_destroy(table);
}
END_TEST

/* Parameters that a method does not look at make no other table. */
START_TEST(idle_parameters_do_not_matter) {
    srp_method_params params = fixture_params(1);
    srp_grid grid = grid_of(90, 90);
    srp_table *table;
    srp_error error;
    table_fixture first = fixture_create(&srp_method_nplate, &params);
    assert_ok(srp_table_create(first.prepared, grid, false, &table, &error), error);
    params.lattice.samples = 7;
    params.seed = 9;
    params.tolerance = 0.1;
    table_fixture second = fixture_create(&srp_method_nplate, &params);
    assert_ok(srp_table_check_origin(table, second.prepared, grid, false, &error), error);
    fixture_destroy(second);
    srp_table_destroy(table);
    fixture_destroy(first);
}
END_TEST

/* ---- Signs ---------------------------------------------------------------------------------- */

START_TEST(light_pushes_until_flipped) {
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_grid grid = grid_of(30, 30);
    srp_table *table = noise_table(&fixture, grid, true);
    srp_response node = *srp_table_node(table, 2, 3);
    srp_basis basis = srp_table_node_basis(table, 2, 3)[1];
    ck_assert(srp_table_pull_share(table) == 0.0);
    srp_table_flip(table);
    ck_assert(srp_table_pull_share(table) == 1.0);
    const srp_response *turned = srp_table_node(table, 2, 3);
    ck_assert(turned->f.x == -node.f.x && turned->t.z == -node.t.z);
    ck_assert(turned->lit_area == node.lit_area);
    ck_assert(srp_table_node_basis(table, 2, 3)[1].rc.y == -basis.rc.y);
    srp_table_flip(table);
    ck_assert_mem_eq(&srp_table_node(table, 2, 3)->f, &node.f, sizeof node.f);
    srp_table_destroy(table);
    fixture_destroy(fixture);
}
END_TEST

/* Only the upper half turned round: half of the sphere's solid angle, whatever the steps. The
 * equator's nodes turn too; their cells make sin(half a step) of it. */
START_TEST(the_share_is_one_of_solid_angle) {
    table_fixture fixture = fixture_create(&srp_method_cannonball, NULL);
    const double steps[] = {5.0, 30.0, 90.0};
    for (size_t k = 0; k < sizeof steps / sizeof steps[0]; ++k) {
        srp_grid grid = grid_of(steps[k], steps[k]);
        srp_table *table = noise_table(&fixture, grid, false);
        for (uint32_t i = 0; i < grid.az_count; ++i) {
            for (uint32_t j = 0; j < grid.el_count; ++j) {
                srp_response *node = (srp_response *)srp_table_node(table, i, j);
                double sign = srp_grid_elevation_deg(grid, j) >= 0.0 ? -1.0 : 1.0;
                node->f = srp_vec3_scale(sign, node->f);
            }
        }
        double half_step = 0.5 * steps[k] * 3.14159265358979323846 / 180.0;
        assert_close(srp_table_pull_share(table), 0.5 + 0.5 * sin(half_step), 1e-12, 0.0);
        srp_table_destroy(table);
    }
    fixture_destroy(fixture);
}
END_TEST

START_TEST(an_empty_table_pulls_nowhere) {
    table_fixture fixture = fixture_create(&srp_method_cannonball, NULL);
    srp_table *table;
    srp_error error;
    assert_ok(srp_table_create(fixture.prepared, grid_of(90, 90), false, &table, &error), error);
    ck_assert(srp_table_pull_share(table) == 0.0);
    srp_table_destroy(table);
    fixture_destroy(fixture);
}
END_TEST

/* ---- Formats -------------------------------------------------------------------------------- */

START_TEST(the_ending_names_the_format) {
    size_t count;
    const srp_table_format *const *formats = srp_table_format_list(&count);
    ck_assert_uint_eq(count, 3);
    for (size_t k = 0; k < count; ++k) {
        char path[64];
        snprintf(path, sizeof path, "dir.x/a%s", formats[k]->ending);
        ck_assert_ptr_eq(srp_table_format_of(path), formats[k]);
    }
    ck_assert_ptr_eq(srp_table_format_of("TABLE.SPO"), &srp_table_format_spo);
    ck_assert_ptr_eq(srp_table_format_of("a.Nc"), &srp_table_format_netcdf);
    ck_assert_ptr_null(srp_table_format_of("a.csv"));
    ck_assert_ptr_null(srp_table_format_of("nc"));
    ck_assert_ptr_null(srp_table_format_of(".nc"));
    ck_assert_ptr_null(srp_table_format_of(""));
}
END_TEST

START_TEST(formats_ask_for_what_they_need) {
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_table *table;
    srp_error error;
    assert_ok(srp_table_create(fixture.prepared, grid_of(90, 90), false, &table, &error), error);
    assert_fails(srp_table_write(table, &srp_table_format_spo, "unwritten.spo", &error),
                 SRP_BAD_ARGUMENT, &error, "holds 0 of 15 nodes");
    assert_ok(srp_table_fill(table, fixture.prepared, NULL, &error), error);
    assert_fails(srp_table_write(table, &srp_table_format_txt, "unwritten.txt", &error),
                 SRP_BAD_ARGUMENT, &error, "the mass must be given");
    ck_assert_ptr_null(fopen("unwritten.spo", "rb"));
    ck_assert_ptr_null(fopen("unwritten.txt", "rb"));
    srp_table_destroy(table);
    fixture_destroy(fixture);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("table");
    TCase *tcase = tcase_create("fill");
    tcase_add_test(tcase, nodes_hold_what_the_method_answers);
    tcase_add_test(tcase, a_table_knows_its_origin);
    tcase_add_test(tcase, progress_counts_directions);
    tcase_add_test(tcase, the_result_depends_on_neither_threads_nor_interruptions);
    tcase_add_test(tcase, running_out_of_memory_keeps_what_is_done);
    tcase_add_test(tcase, what_cannot_be_made_is_refused);
    suite_add_tcase(suite, tcase);
    tcase = tcase_create("origin");
    tcase_add_test(tcase, a_table_goes_on_only_where_it_came_from);
    tcase_add_test(tcase, another_shape_or_optics_is_another_table);
    tcase_add_test(tcase, idle_parameters_do_not_matter);
    suite_add_tcase(suite, tcase);
    tcase = tcase_create("signs");
    tcase_add_test(tcase, light_pushes_until_flipped);
    tcase_add_test(tcase, the_share_is_one_of_solid_angle);
    tcase_add_test(tcase, an_empty_table_pulls_nowhere);
    suite_add_tcase(suite, tcase);
    tcase = tcase_create("formats");
    tcase_add_test(tcase, the_ending_names_the_format);
    tcase_add_test(tcase, formats_ask_for_what_they_need);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
