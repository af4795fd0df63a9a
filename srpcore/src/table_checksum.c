/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The checksum of a table's content: XXH3 (128 bits) over everything that it says, written out in
 * one fixed order and in little-endian bytes, so that it depends on neither the machine nor the
 * file.
 */
#include "table_netcdf.h"

#define XXH_STATIC_LINKING_ONLY /* XXH3_state_t on the stack */
#include <math.h>
#include <stdint.h>
#include <string.h>
#include <xxhash.h>

static void mix_u64(XXH3_state_t *state, uint64_t value) {
    unsigned char bytes[8];
    for (int k = 0; k < 8; ++k) {
        bytes[k] = (unsigned char)(value >> (8 * k));
    }
    XXH3_128bits_update(state, bytes, sizeof bytes);
}

/* All NaNs count as one: they only ever mean "not given". */
static void mix_double(XXH3_state_t *state, double value) {
    uint64_t bits = UINT64_MAX;
    if (!isnan(value)) {
        memcpy(&bits, &value, sizeof bits);
    }
    mix_u64(state, bits);
}

static void mix_vec3(XXH3_state_t *state, srp_vec3 v) {
    mix_double(state, v.x);
    mix_double(state, v.y);
    mix_double(state, v.z);
}

static void mix_text(XXH3_state_t *state, const char *text) {
    size_t size = strlen(text);
    mix_u64(state, size);
    XXH3_128bits_update(state, text, size);
}

static void mix_params(XXH3_state_t *state, const srp_method_params *params) {
    mix_vec3(state, params->reference);
    mix_u64(state, params->seed);
    mix_u64(state, (uint64_t)params->lattice.kind);
    mix_u64(state, params->lattice.samples);
    mix_double(state, params->lattice.pixel);
    for (int k = 0; k < 4; ++k) {
        mix_double(state, params->lattice.window[k]);
    }
    mix_u64(state, params->lattice.columns);
    mix_u64(state, params->lattice.rows);
    mix_double(state, params->tolerance);
    mix_u64(state, params->max_samples);
    mix_u64(state, params->reflections);
    mix_u64(state, params->diffuse);
    mix_u64(state, params->mirrored_beams);
}

static void mix_check(XXH3_state_t *state, const srp_table_check *check) {
    mix_u64(state, check->count);
    mix_u64(state, check->seed);
    for (size_t k = 0; k < SRP_TABLE_SCHEMES; ++k) {
        mix_double(state, check->errors[k].f_mean);
        mix_double(state, check->errors[k].f_max);
        mix_double(state, check->errors[k].t_mean);
        mix_double(state, check->errors[k].t_max);
    }
}

static void mix_head(XXH3_state_t *state, const srp_table *table) {
    const srp_table_info *info = &table->info;
    mix_u64(state, table->grid.az_count);
    mix_u64(state, table->grid.el_count);
    mix_text(state, info->title);
    mix_text(state, info->method);
    mix_text(state, info->device);
    mix_text(state, info->shape_hash);
    mix_text(state, info->optics_hash);
    mix_text(state, info->version);
    mix_text(state, info->command_line);
    mix_u64(state, table->has_lattice);
    mix_params(state, &info->params);
    mix_double(state, info->light.flux);
    mix_double(state, info->light.au);
    mix_double(state, info->mass);
    mix_u64(state, info->has_error);
    mix_u64(state, info->has_moment);
    mix_u64(state, info->has_basis);
    mix_u64(state, info->has_bounce);
    if (info->check.count > 0) {
        mix_check(state, &info->check);
    }
    mix_u64(state, table->material_count);
    for (size_t m = 0; m < table->material_count; ++m) {
        mix_text(state, table->material_names[m]);
        mix_double(state, table->material_optics[m].rho_s);
        mix_double(state, table->material_optics[m].rho_d);
        mix_u64(state, table->material_optics[m].one_sided);
    }
    /* Only where they say something, so that traced tables keep the checksum that they have. */
    if (info->traced_optics_hash[0] != '\0') {
        mix_text(state, info->traced_optics_hash);
        mix_text(state, info->traced_command_line);
        mix_u64(state, info->bounce_kept);
    }
}

static void mix_basis(XXH3_state_t *state, const srp_basis *basis) {
    mix_double(state, basis->a);
    mix_vec3(state, basis->b);
    mix_vec3(state, basis->c);
    mix_vec3(state, basis->ra);
    mix_vec3(state, basis->rb);
    mix_vec3(state, basis->rc);
}

static void mix_node(XXH3_state_t *state, const srp_table *table, size_t index) {
    mix_u64(state, table->filled[index]);
    if (!table->filled[index]) {
        return;
    }
    const srp_response *node = &table->nodes[index];
    mix_vec3(state, node->f);
    mix_double(state, node->lit_area);
    mix_double(state, node->back_area);
    mix_double(state, node->unresolved);
    mix_double(state, node->f_error);
    if (table->info.has_moment) {
        mix_vec3(state, node->t);
        mix_double(state, node->t_error);
    }
    if (table->info.has_bounce) {
        mix_vec3(state, node->f_bounce);
        mix_vec3(state, node->t_bounce);
    }
    mix_u64(state, node->samples);
    mix_u64(state, node->flags);
    size_t row = table->material_count + 1;
    for (size_t m = 0; table->basis != NULL && m < row; ++m) {
        mix_basis(state, &table->basis[index * row + m]);
    }
}

/* 32 hexadecimal digits. */
static void spell(XXH128_hash_t hash, char out[33]) {
    static const char DIGITS[] = "0123456789abcdef";
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, hash);
    for (size_t k = 0; k < sizeof canonical.digest; ++k) {
        out[2 * k] = DIGITS[canonical.digest[k] >> 4];
        out[2 * k + 1] = DIGITS[canonical.digest[k] & 15];
    }
    out[32] = '\0';
}

void srp_table_checksum(const srp_table *table, char out[33]) {
    XXH3_state_t state;
    XXH3_INITSTATE(&state);
    XXH3_128bits_reset(&state);
    mix_head(&state, table);
    size_t count = srp_grid_node_count(table->grid);
    for (size_t k = 0; k < count; ++k) {
        mix_node(&state, table, k);
    }
    spell(XXH3_128bits_digest(&state), out);
}

void srp_table_key(const srp_table *table, char out[33]) {
    const srp_table_info *info = &table->info;
    XXH3_state_t state;
    XXH3_INITSTATE(&state);
    XXH3_128bits_reset(&state);
    mix_text(&state, SRP_TABLE_FORMAT_NAME);
    mix_u64(&state, SRP_TABLE_FORMAT_VERSION);
    mix_u64(&state, table->grid.az_count);
    mix_u64(&state, table->grid.el_count);
    mix_text(&state, info->method);
    mix_text(&state, info->device);
    mix_text(&state, info->shape_hash);
    mix_text(&state, info->optics_hash);
    mix_text(&state, info->version);
    mix_params(&state, &info->params);
    mix_u64(&state, info->has_basis);
    mix_u64(&state, table->material_count);
    mix_text(&state, info->traced_optics_hash);
    spell(XXH3_128bits_digest(&state), out);
}

void srp_bytes_checksum(const void *bytes, size_t size, char out[33]) {
    spell(XXH3_128bits(bytes, size), out);
}
