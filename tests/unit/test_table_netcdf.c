/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L /* setrlimit */

#include "platform.h"
#include "srp_check.h"
#include "table_fixture.h"
#include "table_netcdf.h"

#include <netcdf.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>

static void assert_write(const srp_table *table, const char *path) {
    srp_error error;
    assert_ok(srp_table_write(table, &srp_table_format_netcdf, path, &error), error);
}

static srp_table *read_table(const char *path) {
    srp_table *table = NULL;
    srp_error error;
    assert_ok(srp_table_read(&srp_table_format_netcdf, path, &table, &error), error);
    return table;
}

/* Refused, with these words in the message. */
static void assert_refused(const char *path, srp_status expected, const char *words) {
    srp_table *table = NULL;
    srp_error error;
    srp_status status = srp_table_read(&srp_table_format_netcdf, path, &table, &error);
    ck_assert_msg(status == expected, "%s: status '%s', expected '%s'", words,
                  srp_status_string(status), srp_status_string(expected));
    ck_assert_int_eq(error.status, expected);
    ck_assert_str_eq(error.file, path);
    ck_assert_msg(strstr(error.message, words) != NULL, "'%s' lacks '%s'", error.message, words);
    ck_assert_ptr_null(table);
}

/* ---- There and back ------------------------------------------------------------------------- */

static void assert_round_trip(const srp_table *table) {
    char path[256];
    snprintf(path, sizeof path, "%s", scratch_path("round_trip.nc"));
    assert_write(table, path);
    srp_table *back = read_table(path);
    assert_same_table(back, table);
    srp_table_destroy(back);
    remove(path);
}

START_TEST(everything_comes_back) {
    srp_method_params params = fixture_params(1);
    params.reference = srp_vec3_make(0.1, -0.2, 0.3);
    params.seed = UINT64_MAX - 3;
    params.lattice.samples = 321;
    params.tolerance = 1e-3;
    params.max_samples = 999;
    const srp_method *methods[] = {&noise_method, &srp_method_nplate, &srp_method_cannonball};
    for (size_t k = 0; k < 3; ++k) {
        table_fixture fixture = fixture_create(methods[k], &params);
        bool can_basis = (methods[k]->capabilities & SRP_METHOD_BASIS) != 0;
        for (int with_basis = 0; with_basis <= can_basis; ++with_basis) {
            srp_table *table = noise_table(&fixture, grid_of(20, 30), with_basis);
            assert_round_trip(table);
            srp_table_destroy(table);
        }
        fixture_destroy(fixture);
    }
}
END_TEST

START_TEST(each_kind_of_lattice_comes_back) {
    srp_method_params params = fixture_params(1);
    for (int k = 0; k < 2; ++k) {
        params.lattice.pixel = k == 0 ? 0.0125 : NAN;
        if (k == 1) {
            const double window[4] = {-1.75, 1.75, -1.5, 1.25};
            params.lattice.kind = SRP_LATTICE_WINDOW;
            memcpy(params.lattice.window, window, sizeof window);
            params.lattice.columns = 64;
            params.lattice.rows = 48;
        }
        table_fixture fixture = fixture_create(&noise_method, &params);
        srp_table *table = noise_table(&fixture, grid_of(90, 90), false);
        assert_round_trip(table);
        srp_table_destroy(table);
        fixture_destroy(fixture);
    }
}
END_TEST

START_TEST(a_table_of_the_smallest_grid_comes_back) {
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_table *table = noise_table(&fixture, grid_of(360, 180), true);
    assert_round_trip(table);
    srp_table_destroy(table);
    fixture_destroy(fixture);
}
END_TEST

static bool cancel_later(void *user, const srp_table *table, size_t done, size_t total) {
    (void)user;
    (void)table;
    (void)total;
    return done == 0;
}

/* Interrupted, written, read, resumed: the same file as that of an undisturbed run, to the byte. */
START_TEST(an_interrupted_table_goes_on_from_its_file) {
    char part[] = "scratch_part.nc", resumed[] = "scratch_resumed.nc", whole[] = "scratch_whole.nc";
    const int threads[] = {1, 2, 3, 7};
    srp_grid grid = grid_of(10, 10);
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_table *table = noise_table(&fixture, grid, true);
    assert_write(table, whole);
    size_t whole_size;
    char *whole_bytes = read_bytes(whole, &whole_size);
    const srp_table_info *info = srp_table_get_info(table);
    for (size_t k = 0; k < sizeof threads / sizeof threads[0]; ++k) {
        srp_method_params params = fixture_params(threads[k]);
        table_fixture other = fixture_create(&noise_method, &params);
        srp_table *begun;
        srp_error error;
        srp_table_progress progress = {cancel_later, NULL};
        assert_ok(srp_table_create(other.prepared, grid, true, &begun, &error), error);
        assert_ok(srp_table_describe(begun, info->title, info->command_line, info->light,
                                     info->mass, &error),
                  error);
        ck_assert_int_eq(srp_table_fill(begun, other.prepared, &progress, &error), SRP_CANCELLED);
        assert_write(begun, part);
        srp_table *loaded = read_table(part);
        assert_same_table(loaded, begun);
        ck_assert(!srp_table_is_complete(loaded));
        assert_ok(srp_table_check_origin(loaded, other.prepared, grid, true, &error), error);
        assert_ok(srp_table_fill(loaded, other.prepared, NULL, &error), error);
        assert_write(loaded, resumed);
        size_t size;
        char *bytes = read_bytes(resumed, &size);
        ck_assert_uint_eq(size, whole_size);
        ck_assert_mem_eq(bytes, whole_bytes, size);
        free(bytes);
        srp_table_destroy(loaded);
        srp_table_destroy(begun);
        fixture_destroy(other);
    }
    free(whole_bytes);
    srp_table_destroy(table);
    fixture_destroy(fixture);
    remove(part);
    remove(resumed);
    remove(whole);
}
END_TEST

/* ---- What other programs see ---------------------------------------------------------------- */

static void assert_text_attribute(int ncid, int var, const char *name, const char *expected) {
    char text[512] = {0};
    size_t length;
    ck_assert_int_eq(nc_inq_attlen(ncid, var, name, &length), NC_NOERR);
    ck_assert_uint_lt(length, sizeof text);
    ck_assert_int_eq(nc_get_att_text(ncid, var, name, text), NC_NOERR);
    ck_assert_str_eq(text, expected);
}

/* The NetCDF library itself opens the file, the line behind its end notwithstanding. */
START_TEST(other_programs_can_read_it) {
    char path[] = "scratch_other.nc";
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_grid grid = grid_of(30, 30);
    srp_table *table = noise_table(&fixture, grid, true);
    assert_write(table, path);
    int ncid, var, format;
    ck_assert_int_eq(nc_open(path, NC_NOWRITE, &ncid), NC_NOERR);
    ck_assert_int_eq(nc_inq_format(ncid, &format), NC_NOERR);
    ck_assert_int_eq(format, NC_FORMAT_NETCDF4);
    /* In the order of creation, not of the alphabet. */
    char name[NC_MAX_NAME + 1];
    ck_assert_int_eq(nc_inq_varname(ncid, 1, name), NC_NOERR);
    ck_assert_str_eq(name, "el");
    ck_assert_int_eq(nc_inq_varname(ncid, 3, name), NC_NOERR);
    ck_assert_str_eq(name, "force");
    assert_text_attribute(ncid, NC_GLOBAL, "Conventions", "CF-1.8");
    assert_text_attribute(ncid, NC_GLOBAL, "title", "box, with a \"wing\": 1");
    assert_text_attribute(ncid, NC_GLOBAL, "format", "srpcore table");
    assert_text_attribute(ncid, NC_GLOBAL, "shape_hash", srp_scene_shape_hash(fixture.scene));
    ck_assert_int_eq(nc_inq_varid(ncid, "az", &var), NC_NOERR);
    assert_text_attribute(ncid, var, "units", "degrees");
    double az[13];
    ck_assert_int_eq(nc_get_var_double(ncid, var, az), NC_NOERR);
    ck_assert(az[0] == -180.0 && az[1] == -150.0 && az[12] == 180.0);
    ck_assert_int_eq(nc_inq_varid(ncid, "moment", &var), NC_NOERR);
    assert_text_attribute(ncid, var, "units", "m3");
    ck_assert_int_eq(nc_inq_varid(ncid, "force", &var), NC_NOERR);
    assert_text_attribute(ncid, var, "units", "m2");
    double f[3];
    const size_t start[3] = {4, 2, 0}, count[3] = {1, 1, 3};
    ck_assert_int_eq(nc_get_vara_double(ncid, var, start, count, f), NC_NOERR);
    const srp_response *node = srp_table_node(table, 4, 2);
    ck_assert(f[0] == node->f.x && f[1] == node->f.y && f[2] == node->f.z);
    ck_assert_int_eq(nc_close(ncid), NC_NOERR);
    srp_table_destroy(table);
    fixture_destroy(fixture);
    remove(path);
}
END_TEST

/* ---- Files that must be refused ------------------------------------------------------------- */

/* Ends a file that another program has changed with a fitting line, so that it gets past the first
 * check. What other programs append or leave behind the end of HDF5 counts as part of it. */
static void sign(const char *path) {
    size_t size;
    char *bytes = read_bytes(path, &size);
    char checksum[33];
    FILE *file = fopen(path, "ab");
    srp_bytes_checksum(bytes, size, checksum);
    ck_assert_ptr_nonnull(file);
    fprintf(file, "%s%s\n", SRP_TABLE_TRAILER, checksum);
    ck_assert_int_eq(fclose(file), 0);
    free(bytes);
}

/* A small file of ours; freed by free(). */
static char *small_file(size_t *size) {
    char path[] = "scratch_small.nc";
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_table *table = noise_table(&fixture, grid_of(90, 90), true);
    assert_write(table, path);
    char *bytes = read_bytes(path, size);
    srp_table_destroy(table);
    fixture_destroy(fixture);
    remove(path);
    return bytes;
}

START_TEST(what_is_no_table_is_refused) {
    char path[] = "scratch_bad.nc";
    assert_refused("no_such_file.nc", SRP_NOT_FOUND, "No such file");
    assert_refused(".", SRP_IO, "is a directory");
    write_bytes(path, "", 0);
    assert_refused(path, SRP_BAD_FORMAT, "is empty");
    write_bytes(path, "\211HD", 3);
    assert_refused(path, SRP_BAD_FORMAT, "is not a NetCDF-4 file");
    write_bytes(path, "Version : 4.27\n", 15);
    assert_refused(path, SRP_BAD_FORMAT, "is not a NetCDF-4 file");
    write_bytes(path, "CDF\1\0\0\0\0\0\0\0\0", 12); /* NetCDF-3 */
    assert_refused(path, SRP_BAD_FORMAT, "is not a NetCDF-4 file");
    write_bytes(path, "\211HDF\r\n\032\nand then something else", 30);
    assert_refused(path, SRP_BAD_FORMAT, "the line that ends a table of srpcore is missing");
    sign(path);
    assert_refused(path, SRP_BAD_FORMAT, "cannot be read as NetCDF-4");
    write_bytes(path, "\211HDF\r\n\032\n", 8);
    assert_refused(path, SRP_BAD_FORMAT, "the line that ends a table of srpcore is missing");
    remove(path);
}
END_TEST

START_TEST(a_file_cut_short_is_refused) {
    char path[] = "scratch_cut.nc";
    size_t size;
    char *bytes = small_file(&size);
    size_t image = size - SRP_TABLE_TRAILER_SIZE;
    for (size_t k = 1; k < 16; ++k) {
        write_bytes(path, bytes, image * k / 16);
        assert_refused(path, SRP_BAD_FORMAT, "the line that ends a table of srpcore is missing");
        sign(path);
        assert_refused(path, SRP_BAD_FORMAT, "cannot be read as NetCDF-4");
    }
    write_bytes(path, bytes, size - 1);
    assert_refused(path, SRP_BAD_FORMAT, "the line that ends a table of srpcore is missing");
    write_bytes(path, bytes, image);
    assert_refused(path, SRP_BAD_FORMAT, "the line that ends a table of srpcore is missing");
    free(bytes);
    remove(path);
}
END_TEST

/* One bit turned anywhere: refused before HDF5 sees it. */
START_TEST(a_turned_bit_is_found) {
    char path[] = "scratch_bit.nc";
    size_t size;
    char *bytes = small_file(&size);
    size_t image = size - SRP_TABLE_TRAILER_SIZE;
    for (size_t k = 0; k < size; k += k < image - 29 ? 29 : 1) {
        char good = bytes[k];
        bytes[k] = (char)(good ^ (1 << (k % 8)));
        write_bytes(path, bytes, size);
        assert_refused(path, SRP_BAD_FORMAT,
                       k < 8                         ? "is not a NetCDF-4 file"
                       : k < image || k >= size - 33 ? "do not match their checksum"
                                                     : "the line that ends a table");
        bytes[k] = good;
    }
    free(bytes);
    remove(path);
}
END_TEST

/* Damage under a fitting line is found by the checksum of the content. */
START_TEST(changed_content_is_found) {
    char path[] = "scratch_changed.nc";
    size_t size;
    char *bytes = small_file(&size);
    const struct {
        const char *var;
        double value;
        const char *words;
        srp_status status;
    } cases[] = {
        {"force", 0.5, "does not match its checksum", SRP_BAD_FORMAT},
        {"basis_rc", 0.5, "does not match its checksum", SRP_BAD_FORMAT},
        {"basis_a", NAN, "basis_a is nan at azimuth -180, elevation -90", SRP_BAD_DATA},
        {"basis_rb", INFINITY, "basis_rb is inf at azimuth -180", SRP_BAD_DATA},
        {"moment_error", 0.5, "does not match its checksum", SRP_BAD_FORMAT},
        {"samples", 1.0, "does not match its checksum", SRP_BAD_FORMAT},
        {"filled", 0.0, "does not match its checksum", SRP_BAD_FORMAT},
        {"filled", 2.0, "something else than 0 and 1", SRP_BAD_FORMAT},
        {"rho_s", 0.25, "does not match its checksum", SRP_BAD_FORMAT},
        {"rho_s", 2.0, "rho_s 2", SRP_BAD_DATA},
        {"force", NAN, "force is nan at azimuth -180, elevation -90", SRP_BAD_DATA},
        {"force", -1e300,
         "force is -1e+300 at azimuth -180, elevation -90: expected a number of at "
         "most 1e+100",
         SRP_BAD_DATA},
        {"unresolved", INFINITY, "unresolved is inf", SRP_BAD_DATA},
        {"az", -170.0, "'az' does not run from -180 to 180", SRP_BAD_FORMAT},
        {"el", 7.0, "'el' does not run from -90 to 90", SRP_BAD_FORMAT},
    };
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        int ncid, var;
        const size_t first[4] = {0, 0, 0, 0};
        write_bytes(path, bytes, size);
        ck_assert_int_eq(nc_open(path, NC_WRITE, &ncid), NC_NOERR);
        ck_assert_int_eq(nc_inq_varid(ncid, cases[k].var, &var), NC_NOERR);
        ck_assert_int_eq(nc_put_var1_double(ncid, var, first, &cases[k].value), NC_NOERR);
        ck_assert_int_eq(nc_close(ncid), NC_NOERR);
        assert_refused(path, SRP_BAD_FORMAT, "the line that ends a table");
        sign(path);
        assert_refused(path, cases[k].status, cases[k].words);
    }
    free(bytes);
    remove(path);
}
END_TEST

/* Changes a copy of a good file by the NetCDF library. */
typedef void (*tamper)(int ncid);

static void drop_format(int ncid) {
    ck_assert_int_eq(nc_del_att(ncid, NC_GLOBAL, "format"), NC_NOERR);
}
static void other_format(int ncid) {
    ck_assert_int_eq(nc_put_att_text(ncid, NC_GLOBAL, "format", 5, "other"), NC_NOERR);
}
static void number_as_format(int ncid) {
    const double one = 1.0;
    ck_assert_int_eq(nc_put_att_double(ncid, NC_GLOBAL, "format", NC_DOUBLE, 1, &one), NC_NOERR);
}
static void drop_version(int ncid) {
    ck_assert_int_eq(nc_del_att(ncid, NC_GLOBAL, "format_version"), NC_NOERR);
}
static void later_version(int ncid) {
    const unsigned version = 99;
    ck_assert_int_eq(nc_put_att_uint(ncid, NC_GLOBAL, "format_version", NC_UINT, 1, &version),
                     NC_NOERR);
}
static void drop_checksum(int ncid) {
    ck_assert_int_eq(nc_del_att(ncid, NC_GLOBAL, "content_checksum"), NC_NOERR);
}
static void other_mass(int ncid) {
    const double mass = 124.0;
    ck_assert_int_eq(nc_put_att_double(ncid, NC_GLOBAL, "mass_kg", NC_DOUBLE, 1, &mass), NC_NOERR);
}
static void two_masses(int ncid) {
    const double masses[2] = {1.0, 2.0};
    ck_assert_int_eq(nc_put_att_double(ncid, NC_GLOBAL, "mass_kg", NC_DOUBLE, 2, masses), NC_NOERR);
}
static void no_mass_at_all(int ncid) {
    const double mass = -1.0;
    ck_assert_int_eq(nc_put_att_double(ncid, NC_GLOBAL, "mass_kg", NC_DOUBLE, 1, &mass), NC_NOERR);
}
static void other_lattice(int ncid) {
    ck_assert_int_eq(nc_put_att_text(ncid, NC_GLOBAL, "lattice", 3, "hex"), NC_NOERR);
}
static void rename_variable(int ncid, const char *from, const char *to) {
    int var;
    ck_assert_int_eq(nc_inq_varid(ncid, from, &var), NC_NOERR);
    ck_assert_int_eq(nc_rename_var(ncid, var, to), NC_NOERR);
}
static void rename_force(int ncid) {
    rename_variable(ncid, "force", "forces");
}
static void lose_basis_b(int ncid) {
    rename_variable(ncid, "basis_b", "basis_bb");
}
static void lose_basis_a(int ncid) {
    rename_variable(ncid, "basis_a", "basis_aa");
}
static void samples_as_basis_c(int ncid) {
    rename_variable(ncid, "basis_c", "basis_cc");
    rename_variable(ncid, "samples", "basis_c");
}
static void swap_basis(int ncid) {
    rename_variable(ncid, "basis_b", "basis_bb");
    rename_variable(ncid, "basis_c", "basis_b");
    rename_variable(ncid, "basis_bb", "basis_c");
}
static void keep_bounce(int ncid) {
    ck_assert_int_eq(nc_put_att_text(ncid, NC_GLOBAL, "bounce_optics_hash", 3, "abc"), NC_NOERR);
}
static void trace_earlier(int ncid) {
    ck_assert_int_eq(nc_put_att_text(ncid, NC_GLOBAL, "traced_optics_hash", 3, "abc"), NC_NOERR);
}
static void keep_number(int ncid) {
    const double one = 1.0;
    ck_assert_int_eq(nc_put_att_double(ncid, NC_GLOBAL, "traced_optics_hash", NC_DOUBLE, 1, &one),
                     NC_NOERR);
}
static void rename_dimension(int ncid) {
    int dimension;
    ck_assert_int_eq(nc_inq_dimid(ncid, "component", &dimension), NC_NOERR);
    ck_assert_int_eq(nc_rename_dim(ncid, dimension, "axis"), NC_NOERR);
}

START_TEST(changed_descriptions_are_refused) {
    char path[] = "scratch_tampered.nc";
    const struct {
        tamper change;
        const char *words;
        srp_status status;
    } cases[] = {
        {drop_format, "attribute 'format' is missing", SRP_BAD_FORMAT},
        {other_format, "'format' says something else", SRP_BAD_FORMAT},
        {number_as_format, "'format' has another type", SRP_BAD_FORMAT},
        {drop_version, "'format_version' is missing", SRP_BAD_FORMAT},
        {later_version, "format version 99, this library reads version 1", SRP_BAD_FORMAT},
        {drop_checksum, "'content_checksum' is missing", SRP_BAD_FORMAT},
        {other_mass, "does not match its checksum", SRP_BAD_FORMAT},
        {two_masses, "'mass_kg' has another type or length", SRP_BAD_FORMAT},
        {no_mass_at_all, "mass of -1 kg", SRP_BAD_DATA},
        {other_lattice, "'lattice' is neither", SRP_BAD_FORMAT},
        {rename_force, "variable 'force' is missing", SRP_BAD_FORMAT},
        {lose_basis_a, "does not match its checksum", SRP_BAD_FORMAT},
        {lose_basis_b, "variable 'basis_b' is missing", SRP_BAD_FORMAT},
        {samples_as_basis_c, "variable 'basis_c' has another type or other dim", SRP_BAD_FORMAT},
        {swap_basis, "does not match its checksum", SRP_BAD_FORMAT},
        {keep_bounce, "'bounce_optics_hash' does not fit", SRP_BAD_FORMAT},
        {trace_earlier, "does not match its checksum", SRP_BAD_FORMAT},
        {keep_number, "'traced_optics_hash' has another type", SRP_BAD_FORMAT},
        {rename_dimension, "dimension 'component' is missing", SRP_BAD_FORMAT},
    };
    size_t size;
    char *bytes = small_file(&size);
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        int ncid;
        write_bytes(path, bytes, size);
        ck_assert_int_eq(nc_open(path, NC_WRITE, &ncid), NC_NOERR);
        cases[k].change(ncid);
        ck_assert_int_eq(nc_close(ncid), NC_NOERR);
        assert_refused(path, SRP_BAD_FORMAT, "the line that ends a table");
        sign(path);
        assert_refused(path, cases[k].status, cases[k].words);
    }
    free(bytes);
    remove(path);
}
END_TEST

/* A foreign file with the marks of ours, and lengths of `az`, `el` and type of `force` as given. */
static void write_foreign(const char *path, size_t az_count, size_t el_count, nc_type force_type,
                          int force_rank) {
    int ncid, d[5], var;
    const unsigned version = 1;
    ck_assert_int_eq(nc_create(path, NC_NETCDF4 | NC_CLOBBER, &ncid), NC_NOERR);
    nc_put_att_text(ncid, NC_GLOBAL, "format", 13, "srpcore table");
    nc_put_att_uint(ncid, NC_GLOBAL, "format_version", NC_UINT, 1, &version);
    nc_def_dim(ncid, "az", az_count, &d[0]);
    nc_def_dim(ncid, "el", el_count, &d[1]);
    nc_def_dim(ncid, "component", 3, &d[2]);
    nc_def_dim(ncid, "material", 1, &d[3]);
    nc_def_dim(ncid, "name_length", 1, &d[4]);
    nc_def_var(ncid, "az", NC_DOUBLE, 1, &d[0], &var);
    nc_def_var(ncid, "el", NC_DOUBLE, 1, &d[1], &var);
    nc_def_var(ncid, "material_name", NC_CHAR, 2, &d[3], &var);
    nc_def_var(ncid, "force", force_type, force_rank, d, &var);
    ck_assert_int_eq(nc_close(ncid), NC_NOERR);
    sign(path);
}

START_TEST(claims_are_checked_before_memory_is_taken) {
    char path[] = "scratch_claims.nc";
    write_foreign(path, 36001, 18001, NC_DOUBLE, 3);
    assert_refused(path, SRP_BAD_FORMAT, "more nodes than a file of its size can");
    write_foreign(path, 1000000, 5, NC_DOUBLE, 3);
    assert_refused(path, SRP_BAD_FORMAT, "dimension 'az' is 1000000 long, expected 2 to 36001");
    write_foreign(path, 5, 1, NC_DOUBLE, 3);
    assert_refused(path, SRP_BAD_FORMAT, "dimension 'el' is 1 long");
    write_foreign(path, NC_UNLIMITED, 5, NC_DOUBLE, 3);
    assert_refused(path, SRP_BAD_FORMAT, "dimension 'az' is 0 long");
    write_foreign(path, 5, 3, NC_DOUBLE, 3);
    assert_refused(path, SRP_BAD_FORMAT, "'az' does not run from");
    remove(path);
}
END_TEST

/* ---- Places that cannot be written ---------------------------------------------------------- */

static void assert_write_fails(const char *path, const char *words) {
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_table *table = noise_table(&fixture, grid_of(90, 90), false);
    srp_error error;
    ck_assert_int_eq(srp_table_write(table, &srp_table_format_netcdf, path, &error), SRP_IO);
    ck_assert_int_eq(error.status, SRP_IO);
    ck_assert_str_eq(error.file, path);
    ck_assert_msg(strstr(error.message, words) != NULL, "'%s' lacks '%s'", error.message, words);
    srp_table_destroy(table);
    fixture_destroy(fixture);
}

START_TEST(unwritable_places_are_named) {
    assert_write_fails("/dev/full", "No space left on device");
    assert_write_fails("no_such_directory/a.nc", "No such file or directory");
    assert_write_fails(".", "is a directory");
    assert_write_fails("/proc/a.nc", "cannot write");
}
END_TEST

/* A disk that fills up on the way, played by a limit to the size of files: HDF5 has written part of
 * the draft by then. What stood under the name before stands there still, and no draft is left. */
START_TEST(a_failed_write_leaves_the_old_file) {
    char path[] = "scratch_limit.nc";
    write_bytes(path, "old", 3);
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_table *table = noise_table(&fixture, grid_of(5, 5), false);
    const struct rlimit limit = {40000, 40000};
    srp_error error;
    signal(SIGXFSZ, SIG_IGN);
    ck_assert_int_eq(setrlimit(RLIMIT_FSIZE, &limit), 0);
    ck_assert_int_eq(srp_table_write(table, &srp_table_format_netcdf, path, &error), SRP_IO);
    ck_assert_str_eq(error.file, path);
    ck_assert_msg(strstr(error.message, "File too large") != NULL, "%s", error.message);
    size_t size;
    char *bytes = read_bytes(path, &size);
    ck_assert_uint_eq(size, 3);
    ck_assert_mem_eq(bytes, "old", 3);
    free(bytes);
    srp_table_destroy(table);
    fixture_destroy(fixture);
    remove(path);
}
END_TEST

/* Whatever is wrong, it is said through the srp_error alone, in whatever thread. */
START_TEST(libraries_below_are_silent) {
    char path[] = "scratch_silent.nc", log[] = "scratch_silent.log";
    size_t size;
    char *bytes = small_file(&size);
    ck_assert_ptr_nonnull(freopen(log, "w", stderr));
    for (size_t k = 1; k < 8; ++k) {
        write_bytes(path, bytes, (size - SRP_TABLE_TRAILER_SIZE) * k / 8);
        sign(path);
        assert_refused(path, SRP_BAD_FORMAT, "cannot be read as NetCDF-4");
    }
    int read = 0;
#pragma omp parallel num_threads(4) reduction(+ : read)
    {
        srp_table *table = NULL;
        read += srp_table_read(&srp_table_format_netcdf, path, &table, NULL) == SRP_OK;
    }
    ck_assert_int_eq(read, 0);
    assert_write_fails("/dev/full", "No space left on device");
    fflush(stderr);
    free(bytes);
    bytes = read_bytes(log, &size);
    ck_assert_msg(size == 0, "%s", bytes);
    free(bytes);
    remove(path);
    remove(log);
}
END_TEST

/* What stood there before a failure stands there after it. */
START_TEST(a_failed_read_changes_nothing) {
    char path[] = "scratch_kept.nc";
    write_bytes(path, "x", 1);
    srp_table *table = (srp_table *)path;
    srp_error error;
    ck_assert_int_eq(srp_table_read(&srp_table_format_netcdf, path, &table, &error),
                     SRP_BAD_FORMAT);
    ck_assert_ptr_eq(table, (srp_table *)path);
    ck_assert_int_eq(srp_table_read(&srp_table_format_netcdf, path, &table, NULL), SRP_BAD_FORMAT);
    remove(path);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("table_netcdf");
    TCase *tcase = tcase_create("round trips");
    tcase_set_timeout(tcase, 60);
    tcase_add_test(tcase, everything_comes_back);
    tcase_add_test(tcase, each_kind_of_lattice_comes_back);
    tcase_add_test(tcase, a_table_of_the_smallest_grid_comes_back);
    tcase_add_test(tcase, an_interrupted_table_goes_on_from_its_file);
    tcase_add_test(tcase, other_programs_can_read_it);
    suite_add_tcase(suite, tcase);
    tcase = tcase_create("refusals");
    tcase_set_timeout(tcase, 60);
    tcase_add_test(tcase, what_is_no_table_is_refused);
    tcase_add_test(tcase, a_file_cut_short_is_refused);
    tcase_add_test(tcase, a_turned_bit_is_found);
    tcase_add_test(tcase, changed_content_is_found);
    tcase_add_test(tcase, changed_descriptions_are_refused);
    tcase_add_test(tcase, claims_are_checked_before_memory_is_taken);
    tcase_add_test(tcase, unwritable_places_are_named);
    tcase_add_test(tcase, a_failed_read_changes_nothing);
    tcase_add_test(tcase, a_failed_write_leaves_the_old_file);
    tcase_add_test(tcase, libraries_below_are_silent);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
