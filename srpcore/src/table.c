/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"
#include "limits.h"
#include "table_internal.h"

#include <srp/const.h>

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* What the strings of a table point to until they are set. */
static const char NO_TEXT[] = "";

/* ---- Making and ending ---------------------------------------------------------------------- */

srp_status srp_table_set_text(const char **slot, const char *text, size_t size, srp_error *error) {
    char *copy = malloc(size + 1);
    if (copy == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a text of %zu bytes", size);
    }
    memcpy(copy, text, size);
    copy[size] = '\0';
    if (*slot != NO_TEXT) {
        free((char *)*slot);
    }
    *slot = copy;
    return SRP_OK;
}

static const char **text_slot(srp_table_info *info, size_t index) {
    const char **slots[] = {&info->title,
                            &info->method,
                            &info->device,
                            &info->shape_hash,
                            &info->optics_hash,
                            &info->version,
                            &info->command_line,
                            &info->traced_optics_hash,
                            &info->traced_command_line};
    return index < sizeof slots / sizeof slots[0] ? slots[index] : NULL;
}

void srp_table_destroy(srp_table *table) {
    if (table == NULL) {
        return;
    }
    for (size_t k = 0; text_slot(&table->info, k) != NULL; ++k) {
        const char *text = *text_slot(&table->info, k);
        if (text != NO_TEXT) {
            free((char *)text);
        }
    }
    for (size_t m = 0; table->material_names != NULL && m < table->material_count; ++m) {
        free(table->material_names[m]);
    }
    free(table->material_names);
    free(table->material_optics);
    free(table->nodes);
    free(table->basis);
    free(table->filled);
    free(table);
}

static srp_status check_grid(srp_grid grid, srp_error *error) {
    if (grid.az_count < 2 || grid.az_count > SRP_GRID_AZ_MAX || grid.el_count < 2 ||
        grid.el_count > SRP_GRID_EL_MAX) {
        return srp_fail(error, SRP_BAD_ARGUMENT,
                        "grid of %u x %u nodes, expected 2 to %d azimuths and 2 to %d elevations",
                        grid.az_count, grid.el_count, SRP_GRID_AZ_MAX, SRP_GRID_EL_MAX);
    }
    return SRP_OK;
}

srp_status srp_table_create_blank(srp_grid grid, size_t material_count, bool with_basis,
                                  srp_table **out, srp_error *error) {
    srp_status status = check_grid(grid, error);
    if (status != SRP_OK) {
        return status;
    }
    srp_table *table = calloc(1, sizeof *table);
    if (table == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a table");
    }
    size_t count = srp_grid_node_count(grid);
    size_t row = material_count + 1;
    table->grid = grid;
    table->material_count = material_count;
    for (size_t k = 0; text_slot(&table->info, k) != NULL; ++k) {
        *text_slot(&table->info, k) = NO_TEXT;
    }
    table->info.params = srp_method_params_default();
    table->info.light = srp_sunlight_default();
    table->info.mass = NAN;
    table->info.has_basis = with_basis;
    table->material_names = calloc(row, sizeof *table->material_names);
    table->material_optics = calloc(row, sizeof *table->material_optics);
    table->nodes = calloc(count, sizeof *table->nodes);
    table->filled = calloc(count, sizeof *table->filled);
    if (with_basis && row <= SIZE_MAX / count) {
        table->basis = calloc(count * row, sizeof *table->basis);
    }
    if (table->material_names == NULL || table->material_optics == NULL || table->nodes == NULL ||
        table->filled == NULL || (with_basis && table->basis == NULL)) {
        srp_table_destroy(table);
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a table of %zu nodes", count);
    }
    *out = table;
    return SRP_OK;
}

srp_status srp_table_set_material(srp_table *table, size_t index, const char *name, size_t size,
                                  srp_optics optics, srp_error *error) {
    char *copy = malloc(size + 1);
    if (copy == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for the name of a material");
    }
    memcpy(copy, name, size);
    copy[size] = '\0';
    free(table->material_names[index]);
    table->material_names[index] = copy;
    table->material_optics[index] = optics;
    return SRP_OK;
}

/* The parameters that decide the numbers of `method`; the others as by default, so that a table
 * says the same however they were set. */
static srp_method_params deciding_params(const srp_method *method,
                                         const srp_method_params *params) {
    srp_method_params result = srp_method_params_default();
    result.reference = params->reference;
    if (method->capabilities & SRP_METHOD_BOUNCE) {
        result.reflections = params->reflections;
        result.diffuse = params->diffuse;
        result.mirrored_beams = params->mirrored_beams;
    }
    if (!(method->capabilities & SRP_METHOD_LATTICE)) {
        return result;
    }
    srp_lattice_params *lattice = &result.lattice;
    lattice->kind = params->lattice.kind;
    if (lattice->kind == SRP_LATTICE_WINDOW) {
        memcpy(lattice->window, params->lattice.window, sizeof lattice->window);
        lattice->columns = params->lattice.columns;
        lattice->rows = params->lattice.rows;
    } else if (isnan(params->lattice.pixel)) {
        lattice->samples = params->lattice.samples;
    } else {
        lattice->pixel = params->lattice.pixel;
    }
    result.seed = params->seed;
    if (isfinite(params->tolerance)) {
        result.tolerance = params->tolerance;
        result.max_samples = params->max_samples;
    }
    return result;
}

static srp_status copy_origin(srp_table *table, const srp_prepared *prepared, srp_error *error) {
    const srp_scene *scene = srp_prepared_scene(prepared);
    const srp_method *method = srp_prepared_method(prepared);
    srp_table_info *info = &table->info;
    const struct {
        const char **slot;
        const char *text;
    } texts[] = {{&info->method, method->name},
                 {&info->device, method->device},
                 {&info->shape_hash, srp_scene_shape_hash(scene)},
                 {&info->optics_hash, srp_scene_optics_hash(scene)},
                 {&info->version, SRP_VERSION}};
    for (size_t k = 0; k < sizeof texts / sizeof texts[0]; ++k) {
        srp_status status =
            srp_table_set_text(texts[k].slot, texts[k].text, strlen(texts[k].text), error);
        if (status != SRP_OK) {
            return status;
        }
    }
    for (size_t m = 0; m < table->material_count; ++m) {
        const char *name = srp_scene_material_name(scene, m);
        srp_status status = srp_table_set_material(table, m, name, strlen(name),
                                                   srp_scene_material_optics(scene, m), error);
        if (status != SRP_OK) {
            return status;
        }
    }
    info->params = deciding_params(method, srp_prepared_params(prepared));
    table->has_lattice = (method->capabilities & SRP_METHOD_LATTICE) != 0;
    info->has_error = true;
    info->has_moment = (method->capabilities & SRP_METHOD_MOMENT) != 0;
    info->has_bounce = (method->capabilities & SRP_METHOD_BOUNCE) != 0;
    return SRP_OK;
}

srp_status srp_table_create(const srp_prepared *prepared, srp_grid grid, bool with_basis,
                            srp_table **out, srp_error *error) {
    const srp_method *method = srp_prepared_method(prepared);
    if (with_basis && !(method->capabilities & SRP_METHOD_BASIS)) {
        return srp_fail(error, SRP_UNSUPPORTED, "method %s gives no sums per material",
                        method->name);
    }
    srp_table *table;
    size_t materials = srp_scene_material_count(srp_prepared_scene(prepared));
    srp_status status = srp_table_create_blank(grid, materials, with_basis, &table, error);
    if (status != SRP_OK) {
        return status;
    }
    status = copy_origin(table, prepared, error);
    if (status != SRP_OK) {
        srp_table_destroy(table);
        return status;
    }
    *out = table;
    return SRP_OK;
}

srp_status srp_table_check_light(srp_sunlight light, double mass, srp_error *error) {
    if (!SRP_WITHIN(light.flux, SRP_SCALE_MIN, SRP_SCALE_MAX) ||
        !SRP_WITHIN(light.au, SRP_SCALE_MIN, SRP_SCALE_MAX)) {
        return srp_fail(error, SRP_BAD_ARGUMENT,
                        "solar flux %g W/m^2 at %g m, expected both above 0 (%g to %g)", light.flux,
                        light.au, SRP_SCALE_MIN, SRP_SCALE_MAX);
    }
    if (!isnan(mass) && !SRP_WITHIN(mass, SRP_SCALE_MIN, SRP_SCALE_MAX)) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "mass of %g kg, expected above 0 (%g to %g)", mass,
                        SRP_SCALE_MIN, SRP_SCALE_MAX);
    }
    return SRP_OK;
}

srp_status srp_table_describe(srp_table *table, const char *title, const char *command_line,
                              srp_sunlight light, double mass, srp_error *error) {
    srp_status status = srp_table_check_light(light, mass, error);
    if (status == SRP_OK) {
        status = srp_table_set_text(&table->info.title, title, strlen(title), error);
    }
    if (status == SRP_OK) {
        status = srp_table_set_text(&table->info.command_line, command_line, strlen(command_line),
                                    error);
    }
    if (status == SRP_OK) {
        table->info.light = light;
        table->info.mass = isnan(mass) ? NAN : mass;
    }
    return status;
}

void srp_table_set_check(srp_table *table, const srp_table_check *check) {
    table->info.check = *check;
}

/* ---- Asking --------------------------------------------------------------------------------- */

srp_grid srp_table_grid(const srp_table *table) {
    return table->grid;
}

const srp_table_info *srp_table_get_info(const srp_table *table) {
    return &table->info;
}

bool srp_table_is_complete(const srp_table *table) {
    return table->filled_count == srp_grid_node_count(table->grid);
}

size_t srp_table_filled_count(const srp_table *table) {
    return table->filled_count;
}

const srp_response *srp_table_node(const srp_table *table, uint32_t i, uint32_t j) {
    size_t index = srp_table_index(table, i, j);
    return table->filled[index] ? &table->nodes[index] : NULL;
}

const srp_basis *srp_table_node_basis(const srp_table *table, uint32_t i, uint32_t j) {
    size_t index = srp_table_index(table, i, j);
    return table->basis != NULL && table->filled[index]
               ? &table->basis[index * (table->material_count + 1)]
               : NULL;
}

size_t srp_table_material_count(const srp_table *table) {
    return table->material_count;
}

const char *srp_table_material_name(const srp_table *table, size_t index) {
    return table->material_names[index];
}

srp_optics srp_table_material_optics(const srp_table *table, size_t index) {
    return table->material_optics[index];
}

void srp_table_mark_filled(srp_table *table, size_t index) {
    table->filled_count += !table->filled[index];
    table->filled[index] = 1;
}

/* ---- Signs ---------------------------------------------------------------------------------- */

static srp_vec3 turned(srp_vec3 a) {
    return srp_vec3_make(0.0 - a.x, 0.0 - a.y, 0.0 - a.z);
}

void srp_table_flip(srp_table *table) {
    size_t count = srp_grid_node_count(table->grid);
    for (size_t k = 0; k < count; ++k) {
        table->nodes[k].f = turned(table->nodes[k].f);
        table->nodes[k].t = turned(table->nodes[k].t);
        table->nodes[k].f_bounce = turned(table->nodes[k].f_bounce);
        table->nodes[k].t_bounce = turned(table->nodes[k].t_bounce);
    }
    /* The sums follow, so that they go on giving f and t. */
    for (size_t k = 0; table->basis != NULL && k < count * (table->material_count + 1); ++k) {
        srp_basis *basis = &table->basis[k];
        basis->a = 0.0 - basis->a;
        srp_vec3 *sums[] = {&basis->b, &basis->c, &basis->ra, &basis->rb, &basis->rc};
        for (size_t n = 0; n < sizeof sums / sizeof sums[0]; ++n) {
            *sums[n] = turned(*sums[n]);
        }
    }
}

double srp_table_pull_share(const srp_table *table) {
    double all = 0.0, pulling = 0.0;
    for (uint32_t i = 0; i < table->grid.az_count; ++i) {
        for (uint32_t j = 0; j < table->grid.el_count; ++j) {
            const srp_response *node = srp_table_node(table, i, j);
            if (node == NULL || srp_vec3_norm(node->f) == 0.0) {
                continue;
            }
            double weight = srp_grid_solid_angle(table->grid, i, j);
            all += weight;
            if (srp_vec3_dot(node->f, srp_grid_direction(table->grid, i, j)) > 0.0) {
                pulling += weight;
            }
        }
    }
    return all > 0.0 ? pulling / all : 0.0;
}

/* ---- Origin --------------------------------------------------------------------------------- */

/* SRP_OK when two texts are equal; `what` names them. */
static srp_status same_text(const char *what, const char *in_table, const char *asked,
                            srp_error *error) {
    if (strcmp(in_table, asked) == 0) {
        return SRP_OK;
    }
    return srp_fail(error, SRP_MISMATCH, "the table's %s is '%s', asked for is '%s'", what,
                    in_table, asked);
}

static srp_status same_number(const char *what, double in_table, double asked, srp_error *error) {
    if (in_table == asked || (isnan(in_table) && isnan(asked))) {
        return SRP_OK;
    }
    return srp_fail(error, SRP_MISMATCH, "the table's %s is %.17g, asked for is %.17g", what,
                    in_table, asked);
}

static srp_status same_params(const srp_method_params *a, const srp_method_params *b,
                              srp_error *error) {
    const struct {
        const char *what;
        double in_table, asked;
    } numbers[] = {
        {"reference point, x [m]", a->reference.x, b->reference.x},
        {"reference point, y [m]", a->reference.y, b->reference.y},
        {"reference point, z [m]", a->reference.z, b->reference.z},
        {"kind of lattice", (double)a->lattice.kind, (double)b->lattice.kind},
        {"cell of the lattice [m]", a->lattice.pixel, b->lattice.pixel},
        {"number of samples along a side", a->lattice.samples, b->lattice.samples},
        {"window, u_min [m]", a->lattice.window[0], b->lattice.window[0]},
        {"window, u_max [m]", a->lattice.window[1], b->lattice.window[1]},
        {"window, v_min [m]", a->lattice.window[2], b->lattice.window[2]},
        {"window, v_max [m]", a->lattice.window[3], b->lattice.window[3]},
        {"number of columns", a->lattice.columns, b->lattice.columns},
        {"number of rows", a->lattice.rows, b->lattice.rows},
        {"tolerance", a->tolerance, b->tolerance},
        {"largest number of samples along a side", a->max_samples, b->max_samples},
        {"number of reflections", a->reflections, b->reflections},
        {"number of diffuse rays", a->diffuse, b->diffuse},
        {"number of mirrored beams", a->mirrored_beams, b->mirrored_beams},
    };
    for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; ++k) {
        srp_status status =
            same_number(numbers[k].what, numbers[k].in_table, numbers[k].asked, error);
        if (status != SRP_OK) {
            return status;
        }
    }
    if (a->seed != b->seed) {
        return srp_fail(error, SRP_MISMATCH, "the table's seed is %llu, asked for is %llu",
                        (unsigned long long)a->seed, (unsigned long long)b->seed);
    }
    return SRP_OK;
}

srp_status srp_table_check_origin(const srp_table *table, const srp_prepared *prepared,
                                  srp_grid grid, bool with_basis, srp_error *error) {
    const srp_table_info *info = &table->info;
    const srp_scene *scene = srp_prepared_scene(prepared);
    const srp_method *method = srp_prepared_method(prepared);
    const struct {
        const char *what, *in_table, *asked;
    } texts[] = {
        {"method", info->method, method->name},
        {"device", info->device, method->device},
        {"shape (its hash)", info->shape_hash, srp_scene_shape_hash(scene)},
        {"optics (their hash)", info->optics_hash, srp_scene_optics_hash(scene)},
        {"library version", info->version, SRP_VERSION},
    };
    if (table->grid.az_count != grid.az_count || table->grid.el_count != grid.el_count) {
        return srp_fail(error, SRP_MISMATCH,
                        "the table's grid has %u x %u nodes, asked for are %u x %u",
                        table->grid.az_count, table->grid.el_count, grid.az_count, grid.el_count);
    }
    if (info->traced_optics_hash[0] != '\0') {
        return srp_fail(error, SRP_MISMATCH,
                        "the table was given other optics than it was traced with (hash '%s'): "
                        "only a traced one can be filled further",
                        info->traced_optics_hash);
    }
    for (size_t k = 0; k < sizeof texts / sizeof texts[0]; ++k) {
        srp_status status = same_text(texts[k].what, texts[k].in_table, texts[k].asked, error);
        if (status != SRP_OK) {
            return status;
        }
    }
    srp_method_params asked = deciding_params(method, srp_prepared_params(prepared));
    srp_status status = same_params(&info->params, &asked, error);
    if (status != SRP_OK) {
        return status;
    }
    if (info->has_basis != with_basis || table->material_count != srp_scene_material_count(scene)) {
        return srp_fail(error, SRP_MISMATCH, "the table %s sums per material, asked for is one %s",
                        info->has_basis ? "keeps" : "does not keep",
                        with_basis ? "with" : "without");
    }
    return SRP_OK;
}

/* ---- Formats -------------------------------------------------------------------------------- */

static const srp_table_format *const FORMATS[] = {&srp_table_format_netcdf, &srp_table_format_spo,
                                                  &srp_table_format_txt};

const srp_table_format *const *srp_table_format_list(size_t *count) {
    *count = sizeof FORMATS / sizeof FORMATS[0];
    return FORMATS;
}

/* `ending` is in small letters; in `path` they may be capitals. */
static bool ends_with(const char *path, const char *ending) {
    size_t length = strlen(path), size = strlen(ending);
    if (length <= size) {
        return false;
    }
    for (size_t k = 0; k < size; ++k) {
        char c = path[length - size + k];
        if ((c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c) != ending[k]) {
            return false;
        }
    }
    return true;
}

const srp_table_format *srp_table_format_of(const char *path) {
    for (size_t k = 0; k < sizeof FORMATS / sizeof FORMATS[0]; ++k) {
        if (ends_with(path, FORMATS[k]->ending)) {
            return FORMATS[k];
        }
    }
    return NULL;
}

srp_status srp_table_write(const srp_table *table, const srp_table_format *format, const char *path,
                           srp_error *error) {
    if (!(format->capabilities & SRP_FORMAT_PARTIAL) && !srp_table_is_complete(table)) {
        return srp_fail_at(error, SRP_BAD_ARGUMENT, path, 0, 0,
                           "the table holds %zu of %zu nodes, and a %s file holds only whole ones",
                           table->filled_count, srp_grid_node_count(table->grid), format->ending);
    }
    if ((format->capabilities & SRP_FORMAT_MASS) && isnan(table->info.mass)) {
        srp_status status =
            srp_fail_at(error, SRP_BAD_ARGUMENT, path, 0, 0,
                        "a %s file holds accelerations: the mass must be given", format->ending);
        return srp_advise(error, SRP_REMEDY_MASS, status);
    }
    return format->write(table, path, error);
}

srp_status srp_table_read(const srp_table_format *format, const char *path, srp_table **out,
                          srp_error *error) {
    return format->read(path, out, error);
}
