/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Tables from NetCDF-4. Nothing is believed: the checksum of the bytes is looked at before they are
 * interpreted, every type, rank and length before memory is taken for it, and the checksum of the
 * content before the table is handed out.
 */
#include "error.h"
#include "limits.h"
#include "platform.h"
#include "table_netcdf.h"

#include <inttypes.h>
#include <math.h>
#include <netcdf.h>
#include <netcdf_mem.h>
#include <stdlib.h>
#include <string.h>

/* Longest text, and most materials, that are read. */
enum { TEXT_MAX = 1 << 20, MATERIALS_MAX = 1 << 20 };
/* zlib makes at most 1032 bytes of one (zlib.net/zlib_tech.html), so that a file cannot hold more
 * values than this times its size. */
static const size_t INFLATION_MAX = 1032;

/* Where a file is read from. Every step is skipped once one has failed, so that only the end needs
 * to look. */
typedef struct source {
    int ncid;
    const char *path;
    size_t image_size;
    srp_status status;
    srp_error *error;
    int az, el, component, material, name_length; /* dimensions */
    size_t name_size, material_size;
    srp_table *table;
    double *values; /* for one variable */
} source;

static bool is_fine(const source *in) {
    return in->status == SRP_OK;
}

/* `what` is not there, or not as our writer makes it. */
static void refuse(source *in, const char *what, const char *why) {
    if (is_fine(in)) {
        in->status = srp_fail_at(in->error, SRP_BAD_FORMAT, in->path, 0, 0, "%s %s", what, why);
    }
}

static void step(source *in, const char *doing, int code) {
    if (!is_fine(in) || code == NC_NOERR) {
        return;
    }
    if (code == NC_ENOMEM) {
        in->status =
            srp_fail_at(in->error, SRP_NO_MEMORY, in->path, 0, 0, "no memory to read %s", doing);
    } else {
        in->status =
            srp_fail_at(in->error, SRP_BAD_FORMAT, in->path, 0, 0,
                        "cannot read %s (%s): the file is damaged", doing, nc_strerror(code));
    }
}

/* ---- Attributes ----------------------------------------------------------------------------- */

/* Whether the file has the global attribute `name`, of this type and `count` values (0: any). */
static bool has_attribute(source *in, const char *name, nc_type type, size_t count,
                          size_t *length) {
    nc_type found;
    if (!is_fine(in) || nc_inq_att(in->ncid, NC_GLOBAL, name, &found, length) != NC_NOERR) {
        return false;
    }
    if (found != type || (count != 0 && *length != count) || *length > TEXT_MAX) {
        in->status = srp_fail_at(in->error, SRP_BAD_FORMAT, in->path, 0, 0,
                                 "attribute '%s' has another type or length than expected", name);
        return false;
    }
    return true;
}

/* A text attribute, "" when it is not there; freed by free(). NULL once something has failed. */
static char *get_text(source *in, const char *name) {
    size_t length = 0;
    if (!has_attribute(in, name, NC_CHAR, 0, &length)) {
        length = 0;
    }
    if (!is_fine(in)) {
        return NULL;
    }
    char *text = calloc(length + 1, 1);
    if (text == NULL) {
        step(in, name, NC_ENOMEM);
    } else if (length > 0) {
        step(in, name, nc_get_att_text(in->ncid, NC_GLOBAL, name, text));
    }
    if (!is_fine(in)) {
        free(text);
        return NULL;
    }
    return text;
}

/* Leaves *values as they are when the attribute is not there. */
static bool get_doubles(source *in, const char *name, size_t count, double *values) {
    size_t length;
    if (!has_attribute(in, name, NC_DOUBLE, count, &length)) {
        return false;
    }
    step(in, name, nc_get_att_double(in->ncid, NC_GLOBAL, name, values));
    return is_fine(in);
}

static bool get_uint(source *in, const char *name, uint32_t *value) {
    size_t length;
    unsigned read = 0;
    if (!has_attribute(in, name, NC_UINT, 1, &length)) {
        return false;
    }
    step(in, name, nc_get_att_uint(in->ncid, NC_GLOBAL, name, &read));
    *value = read;
    return is_fine(in);
}

static void check_format(source *in) {
    uint32_t version = 0;
    char *format = get_text(in, "format");
    if (format != NULL && strcmp(format, SRP_TABLE_FORMAT_NAME) != 0) {
        refuse(in, "the file is NetCDF, but not a table of srpcore:",
               format[0] == '\0' ? "its attribute 'format' is missing"
                                 : "its attribute 'format' says something else");
    }
    free(format);
    if (is_fine(in) && !get_uint(in, "format_version", &version)) {
        refuse(in, "attribute 'format_version'", "is missing");
    }
    if (is_fine(in) && version != SRP_TABLE_FORMAT_VERSION) {
        in->status = srp_fail_at(in->error, SRP_BAD_FORMAT, in->path, 0, 0,
                                 "the table has format version %u, this library reads version %d",
                                 version, SRP_TABLE_FORMAT_VERSION);
    }
}

static bool get_seed(source *in, const char *name, uint64_t *seed) {
    size_t length;
    unsigned long long read = 0;
    if (!has_attribute(in, name, NC_UINT64, 1, &length)) {
        return false;
    }
    step(in, name, nc_get_att_ulonglong(in->ncid, NC_GLOBAL, name, &read));
    *seed = read;
    return is_fine(in);
}

/* Errors are there all together, or none. */
static void get_check(source *in, srp_table_check *check) {
    if (!get_uint(in, "check_directions", &check->count)) {
        return;
    }
    if (!get_seed(in, "check_seed", &check->seed)) {
        refuse(in, "attribute 'check_seed'", "is missing");
    }
    for (size_t k = 0; k < SRP_TABLE_SCHEMES && is_fine(in); ++k) {
        double e[4] = {0.0, 0.0, 0.0, 0.0};
        if (!get_doubles(in, srp_table_check_names[k], 4, e)) {
            refuse(in, srp_table_check_names[k], "is missing");
        }
        check->errors[k] = (srp_table_error){e[0], e[1], e[2], e[3]};
    }
}

static void get_lattice(source *in) {
    srp_method_params *params = &in->table->info.params;
    srp_lattice_params *lattice = &params->lattice;
    char *kind = get_text(in, "lattice");
    if (kind == NULL || kind[0] == '\0') {
        free(kind);
        return;
    }
    in->table->has_lattice = true;
    if (strcmp(kind, "window") == 0) {
        lattice->kind = SRP_LATTICE_WINDOW;
        get_doubles(in, "lattice_window_m", 4, lattice->window);
        get_uint(in, "lattice_columns", &lattice->columns);
        get_uint(in, "lattice_rows", &lattice->rows);
    } else if (strcmp(kind, "turned") != 0) {
        refuse(in, "attribute 'lattice'", "is neither 'turned' nor 'window'");
    } else if (!get_doubles(in, "lattice_cell_m", 1, &lattice->pixel)) {
        get_uint(in, "lattice_samples", &lattice->samples);
    }
    free(kind);
    get_seed(in, "seed", &params->seed);
    if (get_doubles(in, "tolerance", 1, &params->tolerance)) {
        get_uint(in, "max_samples", &params->max_samples);
    }
}

/* What a hostile file may say of the light, under a checksum that fits. */
static void check_origin(source *in) {
    srp_error why;
    srp_table *table = in->table;
    if (!is_fine(in)) {
        return;
    }
    if (srp_table_check_light(table->info.light, table->info.mass, &why) != SRP_OK) {
        in->status = srp_fail_at(in->error, SRP_BAD_DATA, in->path, 0, 0, "%s", why.message);
    } else if (!srp_vec3_is_finite(table->info.params.reference)) {
        in->status = srp_fail_at(in->error, SRP_BAD_DATA, in->path, 0, 0,
                                 "the reference point is not finite");
    }
}

static void get_origin(source *in) {
    srp_table_info *info = &in->table->info;
    for (size_t k = 0; k < SRP_TEXT_ATTRIBUTE_COUNT && is_fine(in); ++k) {
        const char **slot = (const char **)(void *)((char *)info + srp_table_texts[k].offset);
        char *text = get_text(in, srp_table_texts[k].name);
        if (text != NULL) {
            in->status = srp_table_set_text(slot, text, strlen(text), in->error);
        }
        free(text);
    }
    get_check(in, &info->check);
    double reference[3] = {0.0, 0.0, 0.0};
    get_doubles(in, "reference_point_m", 3, reference);
    info->params.reference = srp_vec3_make(reference[0], reference[1], reference[2]);
    get_lattice(in);
    get_uint(in, "reflections", &info->params.reflections);
    get_uint(in, "diffuse_rays", &info->params.diffuse);
    get_uint(in, "mirrored_beams", &info->params.mirrored_beams);
    get_doubles(in, "solar_flux_w_m2", 1, &info->light.flux);
    get_doubles(in, "astronomical_unit_m", 1, &info->light.au);
    get_doubles(in, "mass_kg", 1, &info->mass);
    check_origin(in);
}

/* ---- Dimensions and variables --------------------------------------------------------------- */

static size_t get_dimension(source *in, const char *name, size_t min, size_t max, int *id) {
    size_t length = 0;
    if (!is_fine(in)) {
        return 0;
    }
    if (nc_inq_dimid(in->ncid, name, id) != NC_NOERR) {
        in->status = srp_fail_at(in->error, SRP_BAD_FORMAT, in->path, 0, 0,
                                 "dimension '%s' is missing", name);
        return 0;
    }
    step(in, name, nc_inq_dimlen(in->ncid, *id, &length));
    if (is_fine(in) && (length < min || length > max)) {
        in->status =
            srp_fail_at(in->error, SRP_BAD_FORMAT, in->path, 0, 0,
                        "dimension '%s' is %zu long, expected %zu to %zu", name, length, min, max);
    }
    return length;
}

static bool has_variable(const source *in, const char *name) {
    int var;
    return is_fine(in) && nc_inq_varid(in->ncid, name, &var) == NC_NOERR;
}

/* A variable, which must be there with this type and these dimensions. */
static int get_variable(source *in, const char *name, nc_type type, int rank,
                        const int *dimensions) {
    int var = -1, found_rank = 0, found[NC_MAX_VAR_DIMS];
    nc_type found_type = NC_NAT;
    if (!is_fine(in)) {
        return var;
    }
    if (nc_inq_varid(in->ncid, name, &var) != NC_NOERR) {
        in->status = srp_fail_at(in->error, SRP_BAD_FORMAT, in->path, 0, 0,
                                 "variable '%s' is missing", name);
        return var;
    }
    step(in, name, nc_inq_var(in->ncid, var, NULL, &found_type, &found_rank, NULL, NULL));
    if (is_fine(in) && found_rank == rank) {
        step(in, name, nc_inq_vardimid(in->ncid, var, found));
    }
    if (is_fine(in) && (found_type != type || found_rank != rank ||
                        memcmp(found, dimensions, (size_t)rank * sizeof *found) != 0)) {
        in->status =
            srp_fail_at(in->error, SRP_BAD_FORMAT, in->path, 0, 0,
                        "variable '%s' has another type or other dimensions than expected", name);
    }
    return var;
}

static srp_status bad_node(source *in, size_t index, const char *name, double value) {
    srp_grid grid = in->table->grid;
    return srp_fail_at(in->error, SRP_BAD_DATA, in->path, 0, 0,
                       "%s is %g at azimuth %g, elevation %g: expected a number of at most %g",
                       name, value, srp_grid_azimuth_deg(grid, (uint32_t)(index / grid.el_count)),
                       srp_grid_elevation_deg(grid, (uint32_t)(index % grid.el_count)),
                       SRP_RESPONSE_MAX);
}

static void get_column(source *in, const srp_column *column) {
    srp_table *table = in->table;
    int dimensions[4] = {in->az, in->el}, rank = 2;
    if (column->when == SRP_COLUMN_BASIS) {
        dimensions[rank++] = in->material;
    }
    if (column->width > 1) {
        dimensions[rank++] = in->component;
    }
    int var = get_variable(in, column->name, NC_DOUBLE, rank, dimensions);
    if (is_fine(in)) {
        step(in, column->name, nc_get_var_double(in->ncid, var, in->values));
    }
    size_t elements = srp_column_size(column, table) / column->width;
    const double *from = in->values;
    for (size_t k = 0; k < elements && is_fine(in); ++k, from += column->width) {
        size_t node = srp_column_node(column, table, k);
        if (!table->filled[node]) {
            continue;
        }
        for (size_t n = 0; n < column->width && is_fine(in); ++n) {
            if (!(fabs(from[n]) <= SRP_RESPONSE_MAX)) {
                in->status = bad_node(in, node, column->name, from[n]);
            }
        }
        memcpy(srp_column_at(column, table, k), from, column->width * sizeof *from);
    }
}

static void get_filled(source *in) {
    srp_table *table = in->table;
    const int dimensions[2] = {in->az, in->el};
    int var = get_variable(in, "filled", NC_UBYTE, 2, dimensions);
    if (is_fine(in)) {
        step(in, "filled", nc_get_var_uchar(in->ncid, var, table->filled));
    }
    size_t count = srp_grid_node_count(table->grid);
    for (size_t k = 0; k < count && is_fine(in); ++k) {
        if (table->filled[k] > 1) {
            refuse(in, "variable 'filled'", "holds something else than 0 and 1");
        }
        table->filled_count += table->filled[k];
    }
}

static void get_counts(source *in) {
    srp_table *table = in->table;
    const int dimensions[2] = {in->az, in->el};
    size_t count = srp_grid_node_count(table->grid);
    int samples = get_variable(in, "samples", NC_UINT64, 2, dimensions);
    int flags = get_variable(in, "flags", NC_UINT, 2, dimensions);
    /* The buffer holds three doubles per node: room for either kind. */
    unsigned long long *rays = (unsigned long long *)(void *)in->values;
    if (is_fine(in)) {
        step(in, "samples", nc_get_var_ulonglong(in->ncid, samples, rays));
    }
    for (size_t k = 0; k < count && is_fine(in); ++k) {
        table->nodes[k].samples = table->filled[k] ? rays[k] : 0;
    }
    unsigned *bits = (unsigned *)(void *)in->values;
    if (is_fine(in)) {
        step(in, "flags", nc_get_var_uint(in->ncid, flags, bits));
    }
    for (size_t k = 0; k < count && is_fine(in); ++k) {
        table->nodes[k].flags = table->filled[k] ? bits[k] : 0;
    }
}

/* The coordinates say what the grid of their counts implies; anything else is another grid. */
static void check_coordinates(source *in) {
    srp_grid grid = in->table->grid;
    int az = get_variable(in, "az", NC_DOUBLE, 1, &in->az);
    if (is_fine(in)) {
        step(in, "az", nc_get_var_double(in->ncid, az, in->values));
    }
    for (uint32_t i = 0; i < grid.az_count && is_fine(in); ++i) {
        if (in->values[i] != srp_grid_azimuth_deg(grid, i)) {
            refuse(in, "variable 'az'", "does not run from -180 to 180 in equal steps");
        }
    }
    int el = get_variable(in, "el", NC_DOUBLE, 1, &in->el);
    if (is_fine(in)) {
        step(in, "el", nc_get_var_double(in->ncid, el, in->values));
    }
    for (uint32_t j = 0; j < grid.el_count && is_fine(in); ++j) {
        if (in->values[j] != srp_grid_elevation_deg(grid, j)) {
            refuse(in, "variable 'el'", "does not run from -90 to 90 in equal steps");
        }
    }
}

static void get_material(source *in, const int var[4], size_t m, char *name) {
    const size_t start[2] = {m, 0}, count[2] = {1, in->name_size};
    srp_optics optics = {0.0, 0.0, false};
    unsigned char one_sided = 0;
    memset(name, 0, in->name_size + 1);
    step(in, "material_name", nc_get_vara_text(in->ncid, var[0], start, count, name));
    step(in, "rho_s", nc_get_var1_double(in->ncid, var[1], start, &optics.rho_s));
    step(in, "rho_d", nc_get_var1_double(in->ncid, var[2], start, &optics.rho_d));
    step(in, "one_sided", nc_get_var1_uchar(in->ncid, var[3], start, &one_sided));
    optics.one_sided = one_sided != 0;
    if (is_fine(in) && srp_optics_check(optics, NULL) != SRP_OK) {
        in->status = srp_fail_at(in->error, SRP_BAD_DATA, in->path, 0, 0,
                                 "material %zu has rho_s %g and rho_d %g, expected shares", m,
                                 optics.rho_s, optics.rho_d);
    }
    if (is_fine(in)) {
        in->status = srp_table_set_material(in->table, m, name, strlen(name), optics, in->error);
    }
}

static void get_materials(source *in) {
    const int name_dimensions[2] = {in->material, in->name_length};
    int var[4];
    var[0] = get_variable(in, "material_name", NC_CHAR, 2, name_dimensions);
    var[1] = get_variable(in, "rho_s", NC_DOUBLE, 1, &in->material);
    var[2] = get_variable(in, "rho_d", NC_DOUBLE, 1, &in->material);
    var[3] = get_variable(in, "one_sided", NC_UBYTE, 1, &in->material);
    char *name = is_fine(in) ? malloc(in->name_size + 1) : NULL;
    if (name == NULL) {
        step(in, "material_name", NC_ENOMEM);
        return;
    }
    for (size_t m = 0; m < in->table->material_count && is_fine(in); ++m) {
        get_material(in, var, m, name);
    }
    free(name);
}

/* ---- The whole ------------------------------------------------------------------------------ */

/* Takes memory for what the file says it holds, if a file of its size can hold it. */
static void make_table(source *in) {
    srp_grid grid;
    grid.az_count = (uint32_t)get_dimension(in, "az", 2, SRP_GRID_AZ_MAX, &in->az);
    grid.el_count = (uint32_t)get_dimension(in, "el", 2, SRP_GRID_EL_MAX, &in->el);
    get_dimension(in, "component", 3, 3, &in->component);
    in->material_size = get_dimension(in, "material", 1, MATERIALS_MAX, &in->material);
    in->name_size = get_dimension(in, "name_length", 1, TEXT_MAX, &in->name_length);
    if (!is_fine(in)) {
        return;
    }
    bool with_basis = has_variable(in, "basis_a");
    /* At most 36001 * 18001 * 2^20 * 3 < 2^52 values. */
    size_t values = 3 * srp_grid_node_count(grid) * (with_basis ? in->material_size : 1);
    if (values / INFLATION_MAX > in->image_size / sizeof(double)) {
        refuse(in, "the file", "says that it holds more nodes than a file of its size can");
        return;
    }
    in->status =
        srp_table_create_blank(grid, in->material_size - 1, with_basis, &in->table, in->error);
    in->values = malloc(values * sizeof *in->values);
    if (is_fine(in) && in->values == NULL) {
        step(in, "the table", NC_ENOMEM);
    }
}

/* Whether the bounce part was kept as traced. */
static void get_kept_bounce(source *in) {
    srp_table_info *info = &in->table->info;
    char *hash = get_text(in, SRP_TABLE_BOUNCE_OPTICS);
    if (hash == NULL) {
        return;
    }
    info->bounce_kept = hash[0] != '\0';
    if (info->bounce_kept && (!info->has_bounce || strcmp(hash, info->traced_optics_hash) != 0)) {
        refuse(in, "attribute '" SRP_TABLE_BOUNCE_OPTICS "'",
               "does not fit: there is no bounce part, or the traced optics are others");
    }
    free(hash);
}

static void get_content(source *in) {
    srp_table *table = in->table;
    get_origin(in);
    check_coordinates(in);
    get_materials(in);
    get_filled(in);
    table->info.has_moment = has_variable(in, "moment");
    table->info.has_error = has_variable(in, "force_error");
    table->info.has_bounce = has_variable(in, "force_bounce");
    get_kept_bounce(in);
    for (size_t k = 0; k < SRP_COLUMN_COUNT && is_fine(in); ++k) {
        if (srp_column_is_in(&srp_table_columns[k], table)) {
            get_column(in, &srp_table_columns[k]);
        }
    }
    if (table->info.has_error) {
        get_counts(in);
    }
}

static void check_content(source *in) {
    char found[33];
    size_t prefix = strlen(SRP_TABLE_CHECKSUM_PREFIX);
    char *stated = get_text(in, "content_checksum");
    if (stated == NULL) {
        return;
    }
    srp_table_checksum(in->table, found);
    if (stated[0] == '\0') {
        refuse(in, "attribute 'content_checksum'", "is missing");
    } else if (strncmp(stated, SRP_TABLE_CHECKSUM_PREFIX, prefix) != 0 ||
               strcmp(stated + prefix, found) != 0) {
        refuse(in,
               "the content does not match its checksum:", "the file is damaged or was changed");
    }
    free(stated);
}

/* Refuses what is no HDF5 file at its first bytes. */
static srp_status check_signature(void *user, const char *bytes, size_t size, srp_error *error) {
    static const char SIGNATURE[] = "\211HDF\r\n\032\n";
    source *in = user;
    /* The first piece: no system reads less than 8 bytes of a longer file. */
    if (in->image_size == 0 &&
        (size < sizeof SIGNATURE - 1 || memcmp(bytes, SIGNATURE, sizeof SIGNATURE - 1) != 0)) {
        return srp_fail_at(error, SRP_BAD_FORMAT, in->path, 0, 0,
                           size == 0 ? "is empty, expected a NetCDF-4 table"
                                     : "is not a NetCDF-4 file: expected a table of srpcore");
    }
    in->image_size += size;
    return SRP_OK;
}

/* Checks and takes off the trailer. */
static srp_status check_trailer(source *in, const char *bytes) {
    size_t text = sizeof SRP_TABLE_TRAILER - 1;
    if (in->image_size < SRP_TABLE_TRAILER_SIZE ||
        memcmp(bytes + in->image_size - SRP_TABLE_TRAILER_SIZE, SRP_TABLE_TRAILER, text) != 0) {
        return srp_fail_at(in->error, SRP_BAD_FORMAT, in->path, 0, 0,
                           "the line that ends a table of srpcore is missing: the file is cut "
                           "short, or another program has written it");
    }
    in->image_size -= SRP_TABLE_TRAILER_SIZE;
    const char *trailer = bytes + in->image_size;
    char found[33];
    srp_bytes_checksum(bytes, in->image_size, found);
    if (memcmp(trailer + text, found, 32) != 0 || trailer[text + 32] != '\n') {
        return srp_fail_at(in->error, SRP_BAD_FORMAT, in->path, 0, 0,
                           "the file is damaged: its bytes do not match their checksum");
    }
    return SRP_OK;
}

static srp_status read_image(source *in, char *bytes) {
    int code = nc_open_mem("table.nc", NC_NOWRITE, in->image_size, bytes, &in->ncid);
    if (code != NC_NOERR) {
        return srp_fail_at(in->error, code == NC_ENOMEM ? SRP_NO_MEMORY : SRP_BAD_FORMAT, in->path,
                           0, 0, "cannot be read as NetCDF-4 (%s): it is damaged",
                           nc_strerror(code));
    }
    check_format(in);
    make_table(in);
    if (is_fine(in)) {
        get_content(in);
        check_content(in);
    }
    nc_close(in->ncid);
    free(in->values);
    return in->status;
}

srp_status srp_table_netcdf_read(const char *path, srp_table **out, srp_error *error) {
    source in;
    memset(&in, 0, sizeof in);
    in.path = path;
    in.error = error;
    char *bytes;
    size_t size;
    srp_status status = srp_platform_read_file(path, check_signature, &in, &bytes, &size, error);
    if (status != SRP_OK) {
        return status;
    }
    status = check_trailer(&in, bytes);
    if (status == SRP_OK) {
        srp_table_netcdf_enter();
        status = read_image(&in, bytes);
        srp_table_netcdf_leave();
    }
    free(bytes);
    if (status != SRP_OK) {
        srp_table_destroy(in.table);
        return status;
    }
    *out = in.table;
    return SRP_OK;
}
