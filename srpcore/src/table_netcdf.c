/* SPDX-License-Identifier: Apache-2.0 */
/* What the writer and the reader of the format share: its description of itself, and their turns.
 */
#include "table_netcdf.h"

#include "platform.h"

#include <hdf5.h>

#define RESPONSE(member) offsetof(srp_response, member)
#define BASIS(member) offsetof(srp_basis, member)

const srp_column srp_table_columns[SRP_COLUMN_COUNT] = {
    {"force", "m2", "force per unit radiation pressure, body axes", SRP_COLUMN_ALWAYS, RESPONSE(f),
     3},
    {"moment", "m3", "torque per unit radiation pressure about the reference point, body axes",
     SRP_COLUMN_MOMENT, RESPONSE(t), 3},
    {"force_error", "m2", "standard error of force: root of the summed variances; 0 = exact",
     SRP_COLUMN_ERROR, RESPONSE(f_error), 1},
    {"moment_error", "m3", "standard error of moment: root of the summed variances; 0 = exact",
     SRP_COLUMN_MOMENT_ERROR, RESPONSE(t_error), 1},
    {"force_bounce", "m2", "part of force from light that was reflected before, body axes",
     SRP_COLUMN_BOUNCE, RESPONSE(f_bounce), 3},
    {"moment_bounce", "m3", "part of moment from light that was reflected before, body axes",
     SRP_COLUMN_BOUNCE, RESPONSE(t_bounce), 3},
    {"lit_area", "m2", "cross-section that stops light, seen from the Sun", SRP_COLUMN_ERROR,
     RESPONSE(lit_area), 1},
    {"back_area", "m2", "part of lit_area on absorbing backs of one-sided materials",
     SRP_COLUMN_ERROR, RESPONSE(back_area), 1},
    {"unresolved", "1", "flux still in flight when paths were cut, share of the incoming",
     SRP_COLUMN_ERROR, RESPONSE(unresolved), 1},
    {"basis_a", "m2", "sum of A c over the lit facets of a material", SRP_COLUMN_BASIS, BASIS(a),
     1},
    {"basis_b", "m2", "sum of A c^2 n", SRP_COLUMN_BASIS, BASIS(b), 3},
    {"basis_c", "m2", "sum of A c n", SRP_COLUMN_BASIS, BASIS(c), 3},
    {"basis_ra", "m3", "sum of A c r", SRP_COLUMN_BASIS, BASIS(ra), 3},
    {"basis_rb", "m3", "sum of A c^2 (r x n)", SRP_COLUMN_BASIS, BASIS(rb), 3},
    {"basis_rc", "m3", "sum of A c (r x n)", SRP_COLUMN_BASIS, BASIS(rc), 3},
};

#define INFO(member) offsetof(srp_table_info, member)

const srp_text_attribute srp_table_texts[SRP_TEXT_ATTRIBUTE_COUNT] = {
    {"title", INFO(title)},
    {"method", INFO(method)},
    {"device", INFO(device)},
    {"shape_hash", INFO(shape_hash)},
    {"optics_hash", INFO(optics_hash)},
    {"library_version", INFO(version)},
    {"command_line", INFO(command_line)},
    {"traced_optics_hash", INFO(traced_optics_hash)},
    {"traced_command_line", INFO(traced_command_line)},
};

const char *const srp_table_check_names[SRP_TABLE_SCHEMES] = {
    "interpolation_error_bilinear", "interpolation_error_bicubic", "interpolation_error_spline"};

bool srp_column_is_in(const srp_column *column, const srp_table *table) {
    const srp_table_info *info = &table->info;
    switch (column->when) {
    case SRP_COLUMN_ALWAYS:
        return true;
    case SRP_COLUMN_MOMENT:
        return info->has_moment;
    case SRP_COLUMN_ERROR:
        return info->has_error;
    case SRP_COLUMN_MOMENT_ERROR:
        return info->has_moment && info->has_error;
    case SRP_COLUMN_BOUNCE:
        return info->has_bounce;
    case SRP_COLUMN_BASIS:
        return info->has_basis;
    }
    return false;
}

/* Elements per node. */
static size_t per_node(const srp_column *column, const srp_table *table) {
    return column->when == SRP_COLUMN_BASIS ? table->material_count + 1 : 1;
}

size_t srp_column_size(const srp_column *column, const srp_table *table) {
    return srp_grid_node_count(table->grid) * per_node(column, table) * column->width;
}

double *srp_column_at(const srp_column *column, const srp_table *table, size_t k) {
    char *element =
        column->when == SRP_COLUMN_BASIS ? (char *)&table->basis[k] : (char *)&table->nodes[k];
    return (double *)(void *)(element + column->offset);
}

size_t srp_column_node(const srp_column *column, const srp_table *table, size_t k) {
    return k / per_node(column, table);
}

const srp_table_format srp_table_format_netcdf = {
    .name = "netcdf",
    .ending = ".nc",
    .summary = "NetCDF-4: everything a table holds, also a partly filled one",
    .capabilities = SRP_FORMAT_PARTIAL | SRP_FORMAT_BASIS,
    .write = srp_table_netcdf_write,
    .read = srp_table_netcdf_read,
};

void srp_table_netcdf_enter(void) {
    srp_platform_netcdf_enter();
    /* HDF5 prints errors until it is told not to, by each thread. NetCDF, which asks it for things
     * that may not be there, tells it in the first thread only. */
    (void)H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
}

void srp_table_netcdf_leave(void) {
    srp_platform_netcdf_leave();
}
