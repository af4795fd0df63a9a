/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Tables to NetCDF-4. The file is made in memory and then written by ourselves: HDF5 does not
 * survive a disk that fills up, a pipe will do, and failures are told in the words of the system.
 * The same table gives the same bytes: NetCDF-C writes no times.
 */
#include "error.h"
#include "platform.h"
#include "table_netcdf.h"

#include <math.h>
#include <netcdf.h>
#include <netcdf_mem.h>
#include <stdlib.h>
#include <string.h>

/* Chunks of about this many values: long enough to compress, short enough to read in parts. */
static const size_t CHUNK_VALUES = (size_t)1 << 17;
enum { DEFLATE_LEVEL = 4 };

enum { RANK_MAX = 4 };

/*
 * An HDF5 file that holds nothing yet (HDF5 File Format Specification, version 3.0): a superblock
 * of version 2, and the header of the root group with the order of creation tracked and indexed for
 * links and attributes. That order is what NetCDF asks of a file to keep its variables in order and
 * to open it for writing; a file begun by nc_create_mem() lacks it.
 */
enum { SEED_SIZE = 239 };
static const unsigned char SEED[SEED_SIZE] = {
    /* Superblock: signature, version 2, 8 bytes per address and length, no flags */
    0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n', 2, 8, 8, 0,
    /* base address 0, no extension, end of the file, address of the root group, checksum */
    0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, SEED_SIZE, 0, 0, 0, 0,
    0, 0, 0, 48, 0, 0, 0, 0, 0, 0, 0, 0x94, 0x33, 0x45, 0x0f,
    /* Object header: version 2, attribute order tracked and indexed, 180 bytes of messages */
    'O', 'H', 'D', 'R', 2, 0x0c, 180,
    /* link info, 34 bytes: order tracked and indexed, no link yet, no heap, no indices */
    2, 34, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff,
    0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff,
    /* group info, 2 bytes; an empty message for the 126 bytes that are left */
    10, 2, 0, 1, 0, 0, 0, 0, 0, 126, 0,
    /* checksum */
    [SEED_SIZE - 4] = 0x63, 0x28, 0xac, 0x1c};

/* Where a file is written to. Every step is skipped once one has failed, so that only the end needs
 * to look. */
typedef struct sink {
    int ncid;
    int code;          /* NC_NOERR until something fails */
    const char *doing; /* what failed, for the message */
    const srp_table *table;
    int az, el, component, material, name_length; /* dimensions */
    double *values;                               /* for one variable */
} sink;

static void step(sink *out, const char *doing, int code) {
    if (out->code == NC_NOERR && code != NC_NOERR) {
        out->code = code;
        out->doing = doing;
    }
}

static bool is_fine(const sink *out) {
    return out->code == NC_NOERR;
}

/* ---- Attributes ----------------------------------------------------------------------------- */

static void put_text(sink *out, int var, const char *name, const char *text) {
    if (is_fine(out) && text[0] != '\0') {
        step(out, name, nc_put_att_text(out->ncid, var, name, strlen(text), text));
    }
}

static void put_doubles(sink *out, const char *name, size_t count, const double *values) {
    if (is_fine(out)) {
        step(out, name, nc_put_att_double(out->ncid, NC_GLOBAL, name, NC_DOUBLE, count, values));
    }
}

static void put_uint(sink *out, const char *name, unsigned value) {
    if (is_fine(out)) {
        step(out, name, nc_put_att_uint(out->ncid, NC_GLOBAL, name, NC_UINT, 1, &value));
    }
}

static void put_seed(sink *out, const char *name, unsigned long long seed) {
    if (is_fine(out)) {
        step(out, name, nc_put_att_ulonglong(out->ncid, NC_GLOBAL, name, NC_UINT64, 1, &seed));
    }
}

static void put_lattice(sink *out, const srp_method_params *params) {
    const srp_lattice_params *lattice = &params->lattice;
    if (lattice->kind == SRP_LATTICE_WINDOW) {
        put_text(out, NC_GLOBAL, "lattice", "window");
        put_doubles(out, "lattice_window_m", 4, lattice->window);
        put_uint(out, "lattice_columns", lattice->columns);
        put_uint(out, "lattice_rows", lattice->rows);
    } else {
        put_text(out, NC_GLOBAL, "lattice", "turned");
        if (isnan(lattice->pixel)) {
            put_uint(out, "lattice_samples", lattice->samples);
        } else {
            put_doubles(out, "lattice_cell_m", 1, &lattice->pixel);
        }
    }
    put_seed(out, "seed", params->seed);
    if (isfinite(params->tolerance)) {
        put_doubles(out, "tolerance", 1, &params->tolerance);
        put_uint(out, "max_samples", params->max_samples);
    }
}

/* Mean and largest error of f, mean and largest of t. */
static void put_check(sink *out, const srp_table_check *check) {
    put_uint(out, "check_directions", check->count);
    put_seed(out, "check_seed", check->seed);
    for (size_t k = 0; k < SRP_TABLE_SCHEMES; ++k) {
        const srp_table_error *e = &check->errors[k];
        put_doubles(out, srp_table_check_names[k], 4,
                    (double[]){e->f_mean, e->f_max, e->t_mean, e->t_max});
    }
}

static void put_origin(sink *out) {
    const srp_table_info *info = &out->table->info;
    put_text(out, NC_GLOBAL, "Conventions", "CF-1.8");
    put_text(out, NC_GLOBAL, "format", SRP_TABLE_FORMAT_NAME);
    put_uint(out, "format_version", SRP_TABLE_FORMAT_VERSION);
    for (size_t k = 0; k < SRP_TEXT_ATTRIBUTE_COUNT; ++k) {
        const char *text;
        memcpy(&text, (const char *)info + srp_table_texts[k].offset, sizeof text);
        put_text(out, NC_GLOBAL, srp_table_texts[k].name, text);
    }
    if (info->bounce_kept) {
        put_text(out, NC_GLOBAL, SRP_TABLE_BOUNCE_OPTICS, info->traced_optics_hash);
    }
    const srp_vec3 reference = info->params.reference;
    put_doubles(out, "reference_point_m", 3, (double[]){reference.x, reference.y, reference.z});
    if (out->table->has_lattice) {
        put_lattice(out, &info->params);
    }
    if (info->has_bounce) {
        put_uint(out, "reflections", info->params.reflections);
        put_uint(out, "diffuse_rays", info->params.diffuse);
        put_uint(out, "mirrored_beams", info->params.mirrored_beams);
    }
    put_doubles(out, "solar_flux_w_m2", 1, &info->light.flux);
    put_doubles(out, "astronomical_unit_m", 1, &info->light.au);
    if (!isnan(info->mass)) {
        put_doubles(out, "mass_kg", 1, &info->mass);
    }
    if (info->check.count > 0) {
        put_check(out, &info->check);
    }
    put_text(out, NC_GLOBAL, "comment",
             "Directions are those from the spacecraft to the Sun in body axes, "
             "s = (cos el cos az, cos el sin az, sin el). At the distance r from the Sun the "
             "radiation pressure is P = solar_flux / c * (astronomical_unit / r)^2; "
             "force [N] = P force, torque [N m] = P moment, acceleration = P force / mass.");
    char checksum[sizeof SRP_TABLE_CHECKSUM_PREFIX + 32] = SRP_TABLE_CHECKSUM_PREFIX;
    srp_table_checksum(out->table, checksum + strlen(checksum));
    put_text(out, NC_GLOBAL, "content_checksum", checksum);
}

/* ---- Dimensions and variables --------------------------------------------------------------- */

static void define_dimension(sink *out, const char *name, size_t length, int *dimension) {
    if (is_fine(out)) {
        step(out, name, nc_def_dim(out->ncid, name, length, dimension));
    }
}

static int define(sink *out, const char *name, nc_type type, int rank, const int *dimensions,
                  const char *units, const char *long_name) {
    int var = -1;
    if (is_fine(out)) {
        step(out, name, nc_def_var(out->ncid, name, type, rank, dimensions, &var));
    }
    put_text(out, var, "units", units);
    put_text(out, var, "long_name", long_name);
    return var;
}

/* Chunks filled up from the last dimension, compressed. */
static void compress(sink *out, const char *name, int var, int rank, const int *dimensions) {
    size_t chunk[RANK_MAX], left = CHUNK_VALUES;
    for (int k = rank - 1; k >= 0 && is_fine(out); --k) {
        size_t length = 0;
        step(out, name, nc_inq_dimlen(out->ncid, dimensions[k], &length));
        chunk[k] = length < left ? length : left;
        left /= chunk[k] > 0 ? chunk[k] : 1;
        left = left > 0 ? left : 1;
    }
    if (is_fine(out)) {
        step(out, name, nc_def_var_chunking(out->ncid, var, NC_CHUNKED, chunk));
    }
    if (is_fine(out)) {
        step(out, name, nc_def_var_deflate(out->ncid, var, 1, 1, DEFLATE_LEVEL));
    }
}

static int define_column(sink *out, const srp_column *column) {
    int dimensions[RANK_MAX] = {out->az, out->el};
    int rank = 2;
    if (column->when == SRP_COLUMN_BASIS) {
        dimensions[rank++] = out->material;
    }
    if (column->width > 1) {
        dimensions[rank++] = out->component;
    }
    int var =
        define(out, column->name, NC_DOUBLE, rank, dimensions, column->units, column->long_name);
    compress(out, column->name, var, rank, dimensions);
    const double empty = NAN;
    if (is_fine(out)) {
        step(out, column->name, nc_def_var_fill(out->ncid, var, NC_FILL, &empty));
    }
    return var;
}

static void put_column(sink *out, const srp_column *column, int var) {
    const srp_table *table = out->table;
    size_t elements = srp_column_size(column, table) / column->width;
    double *to = out->values;
    for (size_t k = 0; k < elements; ++k, to += column->width) {
        if (table->filled[srp_column_node(column, table, k)]) {
            memcpy(to, srp_column_at(column, table, k), column->width * sizeof *to);
        } else {
            for (size_t n = 0; n < column->width; ++n) {
                to[n] = NAN;
            }
        }
    }
    if (is_fine(out)) {
        step(out, column->name, nc_put_var_double(out->ncid, var, out->values));
    }
}

static void put_columns(sink *out) {
    for (size_t k = 0; k < SRP_COLUMN_COUNT; ++k) {
        if (srp_column_is_in(&srp_table_columns[k], out->table)) {
            put_column(out, &srp_table_columns[k], define_column(out, &srp_table_columns[k]));
        }
    }
}

/* Samples and flags, which are whole numbers, and the mask of what is there. */
static void put_counts(sink *out) {
    const srp_table *table = out->table;
    const int dimensions[2] = {out->az, out->el};
    size_t count = srp_grid_node_count(table->grid);
    int filled =
        define(out, "filled", NC_UBYTE, 2, dimensions, "1", "1 where the node is computed");
    compress(out, "filled", filled, 2, dimensions);
    if (is_fine(out)) {
        step(out, "filled", nc_put_var_uchar(out->ncid, filled, table->filled));
    }
    if (!table->info.has_error) {
        return;
    }
    int samples = define(out, "samples", NC_UINT64, 2, dimensions, "1",
                         "rays behind the numbers; 0 for methods that take none");
    compress(out, "samples", samples, 2, dimensions);
    /* The buffer holds three doubles per node: room for either kind. */
    unsigned long long *rays = (unsigned long long *)out->values;
    for (size_t k = 0; k < count; ++k) {
        rays[k] = table->nodes[k].samples;
    }
    if (is_fine(out)) {
        step(out, "samples", nc_put_var_ulonglong(out->ncid, samples, rays));
    }
    int flags = define(out, "flags", NC_UINT, 2, dimensions, "1", "notes on the node, bits");
    compress(out, "flags", flags, 2, dimensions);
    const unsigned masks[] = {SRP_RESPONSE_TOLERANCE_MISSED, SRP_RESPONSE_CUT,
                              SRP_RESPONSE_MIRRORS_SAMPLED};
    if (is_fine(out)) {
        step(out, "flags", nc_put_att_uint(out->ncid, flags, "flag_masks", NC_UINT, 3, masks));
    }
    put_text(out, flags, "flag_meanings", "tolerance_missed cut mirrors_sampled");
    unsigned *bits = (unsigned *)out->values;
    for (size_t k = 0; k < count; ++k) {
        bits[k] = table->nodes[k].flags;
    }
    if (is_fine(out)) {
        step(out, "flags", nc_put_var_uint(out->ncid, flags, bits));
    }
}

static void put_coordinates(sink *out) {
    srp_grid grid = out->table->grid;
    int az = define(out, "az", NC_DOUBLE, 1, &out->az, "degrees",
                    "azimuth of the Sun seen from the spacecraft, body axes");
    int el = define(out, "el", NC_DOUBLE, 1, &out->el, "degrees",
                    "elevation of the Sun seen from the spacecraft, body axes");
    int component =
        define(out, "component", NC_CHAR, 1, &out->component, "", "axis of the body frame");
    for (uint32_t i = 0; i < grid.az_count; ++i) {
        out->values[i] = srp_grid_azimuth_deg(grid, i);
    }
    if (is_fine(out)) {
        step(out, "az", nc_put_var_double(out->ncid, az, out->values));
    }
    for (uint32_t j = 0; j < grid.el_count; ++j) {
        out->values[j] = srp_grid_elevation_deg(grid, j);
    }
    if (is_fine(out)) {
        step(out, "el", nc_put_var_double(out->ncid, el, out->values));
    }
    if (is_fine(out)) {
        step(out, "component", nc_put_var_text(out->ncid, component, "xyz"));
    }
}

/* The last material stands for the absorbing backs of one-sided ones. */
static const char BACKS[] = "(absorbing backs)";

static const char *material_name(const srp_table *table, size_t m) {
    return m < table->material_count ? table->material_names[m] : BACKS;
}

static void put_material(sink *out, const int var[4], size_t m) {
    const srp_optics backs = {0.0, 0.0, true};
    srp_optics optics = m < out->table->material_count ? out->table->material_optics[m] : backs;
    const char *name = material_name(out->table, m);
    const size_t start[2] = {m, 0}, count[2] = {1, strlen(name)};
    unsigned char one_sided = optics.one_sided;
    if (is_fine(out)) {
        step(out, "material_name", nc_put_vara_text(out->ncid, var[0], start, count, name));
    }
    if (is_fine(out)) {
        step(out, "rho_s", nc_put_var1_double(out->ncid, var[1], start, &optics.rho_s));
    }
    if (is_fine(out)) {
        step(out, "rho_d", nc_put_var1_double(out->ncid, var[2], start, &optics.rho_d));
    }
    if (is_fine(out)) {
        step(out, "one_sided", nc_put_var1_uchar(out->ncid, var[3], start, &one_sided));
    }
}

static void put_materials(sink *out) {
    const int name_dimensions[2] = {out->material, out->name_length};
    int var[4];
    var[0] = define(out, "material_name", NC_CHAR, 2, name_dimensions, "", "name of the material");
    var[1] = define(out, "rho_s", NC_DOUBLE, 1, &out->material, "1",
                    "share of the light reflected specularly");
    var[2] = define(out, "rho_d", NC_DOUBLE, 1, &out->material, "1",
                    "share of the light reflected diffusely");
    var[3] = define(out, "one_sided", NC_UBYTE, 1, &out->material, "1",
                    "1 where the back absorbs all light");
    for (size_t m = 0; m <= out->table->material_count; ++m) {
        put_material(out, var, m);
    }
}

/* ---- The whole ------------------------------------------------------------------------------ */

static void define_dimensions(sink *out) {
    const srp_table *table = out->table;
    size_t longest = 1;
    for (size_t m = 0; m <= table->material_count; ++m) {
        size_t length = strlen(material_name(table, m));
        longest = length > longest ? length : longest;
    }
    define_dimension(out, "az", table->grid.az_count, &out->az);
    define_dimension(out, "el", table->grid.el_count, &out->el);
    define_dimension(out, "component", 3, &out->component);
    define_dimension(out, "material", table->material_count + 1, &out->material);
    define_dimension(out, "name_length", longest, &out->name_length);
}

/* Makes the file in memory; image->memory is freed by free(). */
static void make_image(sink *out, NC_memio *image) {
    NC_memio seed = {SEED_SIZE, malloc(SEED_SIZE), 0};
    if (seed.memory == NULL) {
        step(out, "the file", NC_ENOMEM);
        return;
    }
    memcpy(seed.memory, SEED, SEED_SIZE);
    /* NetCDF takes the seed over, and sets seed.memory to NULL; nobody sees the name. */
    step(out, "the file", nc_open_memio("table.nc", NC_WRITE, &seed, &out->ncid));
    if (!is_fine(out)) {
        free(seed.memory);
        return;
    }
    step(out, "the file", nc_redef(out->ncid));
    put_origin(out);
    define_dimensions(out);
    put_coordinates(out);
    put_columns(out);
    put_counts(out);
    put_materials(out);
    if (is_fine(out)) {
        step(out, "the file", nc_close_memio(out->ncid, image));
    } else {
        nc_abort(out->ncid);
    }
}

static srp_status fail_content(const sink *out, const char *path, srp_error *error) {
    if (out->code == NC_ENOMEM) {
        return srp_fail_at(error, SRP_NO_MEMORY, path, 0, 0, "no memory to write %s", out->doing);
    }
    return srp_fail_at(error, SRP_IO, path, 0, 0, "cannot write %s: %s", out->doing,
                       nc_strerror(out->code));
}

/* Where the file in the image ends, by its own superblock: memory comes in larger pieces. */
static size_t image_end(const NC_memio *image) {
    enum { END_FIELD = 28 };
    const unsigned char *field = (const unsigned char *)image->memory + END_FIELD;
    uint64_t end = 0;
    for (int k = 7; k >= 0; --k) {
        end = end << 8 | field[k];
    }
    return end < image->size ? (size_t)end : image->size;
}

/* Writes the image, and the line behind it, to `path`. */
static srp_status save(NC_memio *image, const char *path, srp_error *error) {
    size_t end = image_end(image), size = end + SRP_TABLE_TRAILER_SIZE;
    /* One more for the 0 behind the checksum. */
    char *bytes = realloc(image->memory, size + 1);
    if (bytes == NULL) {
        free(image->memory);
        return srp_fail_at(error, SRP_NO_MEMORY, path, 0, 0, "no memory for a file of %zu bytes",
                           size);
    }
    char *trailer = bytes + end;
    memcpy(trailer, SRP_TABLE_TRAILER, sizeof SRP_TABLE_TRAILER - 1);
    srp_bytes_checksum(bytes, end, trailer + sizeof SRP_TABLE_TRAILER - 1);
    trailer[SRP_TABLE_TRAILER_SIZE - 1] = '\n';
    srp_status status = srp_platform_write_file(path, bytes, size, error);
    free(bytes);
    return status;
}

srp_status srp_table_netcdf_write(const srp_table *table, const char *path, srp_error *error) {
    sink out;
    NC_memio image = {0, NULL, 0};
    memset(&out, 0, sizeof out);
    out.table = table;
    size_t widest = table->info.has_basis ? table->material_count + 1 : 1;
    out.values = malloc(3 * widest * srp_grid_node_count(table->grid) * sizeof *out.values);
    if (out.values == NULL) {
        return srp_fail_at(error, SRP_NO_MEMORY, path, 0, 0, "no memory to write the table");
    }
    srp_table_netcdf_enter();
    make_image(&out, &image);
    srp_table_netcdf_leave();
    free(out.values);
    return is_fine(&out) ? save(&image, path, error) : fail_content(&out, path, error);
}
