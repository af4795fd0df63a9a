/* SPDX-License-Identifier: Apache-2.0 */
#include "table_fixture.h"

#include "error.h"
#include "method_internal.h"
#include "srp_check.h"
#include "table_internal.h"

#include <stdlib.h>
#include <string.h>

size_t noise_directions_left = SIZE_MAX;

static double noise(uint64_t *state) {
    return 2.0 * random_unit(state) - 1.0;
}

static srp_vec3 noise_vec3(uint64_t *state) {
    double x = noise(state), y = noise(state), z = noise(state);
    return srp_vec3_make(x, y, z);
}

static srp_status noise_prepare(const srp_scene *scene, const srp_method_params *params,
                                srp_prepared **out, srp_error *error) {
    (void)error;
    srp_prepared *prepared = calloc(1, sizeof *prepared);
    ck_assert_ptr_nonnull(prepared);
    prepared->method = &noise_method;
    prepared->scene = scene;
    prepared->params = *params;
    *out = prepared;
    return SRP_OK;
}

static void answer(srp_vec3 s, srp_response *out, srp_basis *basis, size_t row) {
    uint64_t state = 0;
    memcpy(&state, &s.x, sizeof state);
    uint64_t bits;
    memcpy(&bits, &s.y, sizeof bits);
    state = random_bits(&state) ^ bits;
    memcpy(&bits, &s.z, sizeof bits);
    state = random_bits(&state) ^ bits;
    memset(out, 0, sizeof *out);
    out->f = srp_vec3_sub(srp_vec3_scale(0.1, noise_vec3(&state)), srp_vec3_scale(4.0, s));
    out->t = noise_vec3(&state);
    out->lit_area = random_unit(&state);
    out->back_area = random_unit(&state);
    out->unresolved = random_unit(&state);
    out->f_error = random_unit(&state);
    out->t_error = random_unit(&state);
    out->samples = random_bits(&state);
    out->flags = (uint32_t)random_bits(&state) & 1;
    out->f_bounce = noise_vec3(&state);
    out->t_bounce = noise_vec3(&state);
    for (size_t m = 0; basis != NULL && m < row; ++m) {
        basis[m].a = noise(&state);
        basis[m].b = noise_vec3(&state);
        basis[m].c = noise_vec3(&state);
        basis[m].ra = noise_vec3(&state);
        basis[m].rb = noise_vec3(&state);
        basis[m].rc = noise_vec3(&state);
    }
}

static srp_status noise_respond(const srp_prepared *prepared, size_t count, const srp_vec3 *s_body,
                                srp_response *responses, srp_basis *basis, srp_error *error) {
    size_t row = srp_scene_material_count(prepared->scene) + 1;
    for (size_t k = 0; k < count; ++k) {
        if (noise_directions_left == 0) {
            return srp_fail(error, SRP_NO_MEMORY, "no memory for the noise method");
        }
        noise_directions_left -= noise_directions_left != SIZE_MAX;
        answer(s_body[k], &responses[k], basis != NULL ? basis + k * row : NULL, row);
    }
    return SRP_OK;
}

static void noise_release(srp_prepared *prepared) {
    free(prepared);
}

const srp_method noise_method = {
    .name = "noise",
    .device = "test",
    .summary = "different numbers for every direction",
    .shapes = SRP_SHAPE_PLATES,
    .capabilities = SRP_METHOD_BASIS | SRP_METHOD_LATTICE | SRP_METHOD_MOMENT | SRP_METHOD_BOUNCE,
    .prepare = noise_prepare,
    .respond = noise_respond,
    .release = noise_release,
};

srp_method_params fixture_params(int threads) {
    srp_method_params params = srp_method_params_default();
    params.threads = threads;
    return params;
}

table_fixture fixture_create(const srp_method *method, const srp_method_params *params) {
    const srp_plate plates[] = {
        {{0.0, 0.6, 0.8}, 2.0, {0.3, 0.2, false}},
        {{0.0, 0.0, -1.0}, 3.0, {0.1, 0.7, true}},
    };
    const srp_method_params defaults = fixture_params(2);
    table_fixture fixture;
    srp_error error;
    if (method == &srp_method_cannonball) {
        assert_ok(srp_scene_from_sphere(1.5, 2.0, &fixture.scene, &error), error);
    } else {
        assert_ok(srp_scene_from_plates(plates, 2, &fixture.scene, &error), error);
    }
    assert_ok(srp_method_prepare(method, fixture.scene, params != NULL ? params : &defaults,
                                 &fixture.prepared, &error),
              error);
    return fixture;
}

void fixture_destroy(table_fixture fixture) {
    srp_prepared_release(fixture.prepared);
    srp_scene_destroy(fixture.scene);
}

srp_grid grid_of(double az_step_deg, double el_step_deg) {
    srp_grid grid;
    srp_error error;
    assert_ok(srp_grid_from_steps(az_step_deg, el_step_deg, &grid, &error), error);
    return grid;
}

srp_table *noise_table(const table_fixture *fixture, srp_grid grid, bool with_basis) {
    srp_table *table;
    srp_error error;
    srp_sunlight light = {1361.0, 1.496e11};
    assert_ok(srp_table_create(fixture->prepared, grid, with_basis, &table, &error), error);
    assert_ok(srp_table_describe(table, "box, with a \"wing\": 1", "srp table box.obj -o a b.nc",
                                 light, 123.5, &error),
              error);
    assert_ok(srp_table_fill(table, fixture->prepared, NULL, &error), error);
    return table;
}

static void assert_same_info(const srp_table_info *a, const srp_table_info *b) {
    ck_assert_str_eq(a->title, b->title);
    ck_assert_str_eq(a->method, b->method);
    ck_assert_str_eq(a->device, b->device);
    ck_assert_str_eq(a->shape_hash, b->shape_hash);
    ck_assert_str_eq(a->optics_hash, b->optics_hash);
    ck_assert_str_eq(a->version, b->version);
    ck_assert_str_eq(a->command_line, b->command_line);
    ck_assert_str_eq(a->traced_optics_hash, b->traced_optics_hash);
    ck_assert_str_eq(a->traced_command_line, b->traced_command_line);
    ck_assert(a->bounce_kept == b->bounce_kept);
    ck_assert(a->params.reference.x == b->params.reference.x);
    ck_assert(a->params.reference.y == b->params.reference.y);
    ck_assert(a->params.reference.z == b->params.reference.z);
    ck_assert(a->params.seed == b->params.seed);
    ck_assert_int_eq(a->params.lattice.kind, b->params.lattice.kind);
    ck_assert_uint_eq(a->params.lattice.samples, b->params.lattice.samples);
    ck_assert_mem_eq(&a->params.lattice.window, &b->params.lattice.window, 4 * sizeof(double));
    ck_assert_uint_eq(a->params.lattice.columns, b->params.lattice.columns);
    ck_assert_uint_eq(a->params.lattice.rows, b->params.lattice.rows);
    ck_assert(a->params.lattice.pixel == b->params.lattice.pixel ||
              (isnan(a->params.lattice.pixel) && isnan(b->params.lattice.pixel)));
    ck_assert(a->params.tolerance == b->params.tolerance);
    ck_assert_uint_eq(a->params.max_samples, b->params.max_samples);
    ck_assert(a->light.flux == b->light.flux && a->light.au == b->light.au);
    ck_assert(a->mass == b->mass || (isnan(a->mass) && isnan(b->mass)));
    ck_assert(a->has_error == b->has_error && a->has_moment == b->has_moment &&
              a->has_basis == b->has_basis && a->has_bounce == b->has_bounce);
    ck_assert_uint_eq(a->params.reflections, b->params.reflections);
    ck_assert_uint_eq(a->params.diffuse, b->params.diffuse);
}

static void assert_same_node(const srp_response *a, const srp_response *b) {
    ck_assert_mem_eq(&a->f, &b->f, sizeof a->f);
    ck_assert_mem_eq(&a->t, &b->t, sizeof a->t);
    ck_assert_mem_eq(&a->f_bounce, &b->f_bounce, sizeof a->f_bounce);
    ck_assert_mem_eq(&a->t_bounce, &b->t_bounce, sizeof a->t_bounce);
    ck_assert(a->lit_area == b->lit_area && a->back_area == b->back_area);
    ck_assert(a->unresolved == b->unresolved);
    ck_assert(a->f_error == b->f_error && a->t_error == b->t_error);
    ck_assert(a->samples == b->samples && a->flags == b->flags);
}

void assert_same_table(const srp_table *a, const srp_table *b) {
    assert_same_info(&a->info, &b->info);
    ck_assert_uint_eq(a->grid.az_count, b->grid.az_count);
    ck_assert_uint_eq(a->grid.el_count, b->grid.el_count);
    ck_assert_uint_eq(a->material_count, b->material_count);
    for (size_t m = 0; m < a->material_count; ++m) {
        ck_assert_str_eq(a->material_names[m], b->material_names[m]);
        ck_assert(a->material_optics[m].rho_s == b->material_optics[m].rho_s);
        ck_assert(a->material_optics[m].rho_d == b->material_optics[m].rho_d);
        ck_assert(a->material_optics[m].one_sided == b->material_optics[m].one_sided);
    }
    size_t count = srp_grid_node_count(a->grid), row = a->material_count + 1;
    ck_assert_uint_eq(a->filled_count, b->filled_count);
    ck_assert_mem_eq(a->filled, b->filled, count);
    for (size_t k = 0; k < count; ++k) {
        assert_same_node(&a->nodes[k], &b->nodes[k]);
    }
    ck_assert((a->basis == NULL) == (b->basis == NULL));
    if (a->basis != NULL) {
        ck_assert_mem_eq(a->basis, b->basis, count * row * sizeof *a->basis);
    }
}

const char *scratch_path(const char *ending) {
    static char path[256];
    snprintf(path, sizeof path, "scratch_%s", ending);
    return path;
}

void write_bytes(const char *path, const void *bytes, size_t size) {
    FILE *file = fopen(path, "wb");
    ck_assert_ptr_nonnull(file);
    ck_assert_uint_eq(fwrite(bytes, 1, size, file), size);
    ck_assert_int_eq(fclose(file), 0);
}

char *read_bytes(const char *path, size_t *size) {
    FILE *file = fopen(path, "rb");
    ck_assert_ptr_nonnull(file);
    ck_assert_int_eq(fseek(file, 0, SEEK_END), 0);
    long length = ftell(file);
    ck_assert_int_ge(length, 0);
    rewind(file);
    char *bytes = calloc((size_t)length + 1, 1);
    ck_assert_ptr_nonnull(bytes);
    *size = fread(bytes, 1, (size_t)length, file);
    fclose(file);
    return bytes;
}
