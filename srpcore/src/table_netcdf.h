/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How a table lies in a NetCDF-4 file: what writer and reader share. docs/file-formats.md describes
 * it for users. Internal.
 *
 * A file is a NetCDF-4 (HDF5) file with one line of text behind it: SRP_TABLE_TRAILER and the
 * checksum of all before it. HDF5 reads a file up to the end that its own head names, so that the
 * line disturbs nobody. Our reader asks for it and checks it before any byte of the rest is
 * interpreted, because the HDF5 library does not survive every damaged file: of single bits turned
 * in a small table, 2 in 100 made version 1.10.8 abort.
 */
#ifndef SRP_SRC_TABLE_NETCDF_H
#define SRP_SRC_TABLE_NETCDF_H

#include "table_internal.h"

#include <stddef.h>

#define SRP_TABLE_FORMAT_NAME "srpcore table"
enum { SRP_TABLE_FORMAT_VERSION = 1 };
#define SRP_TABLE_CHECKSUM_PREFIX "xxh3-128 "

/* Of tables with a kept bounce part: the hash of the optics that it is of. */
#define SRP_TABLE_BOUNCE_OPTICS "bounce_optics_hash"

#define SRP_TABLE_TRAILER "\n#srpcore table ends; xxh3-128 "
enum { SRP_TABLE_TRAILER_SIZE = sizeof SRP_TABLE_TRAILER - 1 + 32 + 1 };

/* Which tables have a variable. */
typedef enum srp_column_when {
    SRP_COLUMN_ALWAYS,
    SRP_COLUMN_MOMENT,       /* info.has_moment */
    SRP_COLUMN_ERROR,        /* info.has_error */
    SRP_COLUMN_MOMENT_ERROR, /* both */
    SRP_COLUMN_BOUNCE,       /* info.has_bounce */
    SRP_COLUMN_BASIS         /* info.has_basis */
} srp_column_when;

/* A variable of doubles: one member of srp_response per node, or, with SRP_COLUMN_BASIS, of
 * srp_basis per node and material. */
typedef struct srp_column {
    const char *name, *units, *long_name;
    srp_column_when when;
    size_t offset; /* of the member */
    size_t width;  /* doubles: 3 for vectors, which have the last dimension `component` */
} srp_column;

enum { SRP_COLUMN_COUNT = 15 };
extern const srp_column srp_table_columns[SRP_COLUMN_COUNT];

/* Whether `table` has that variable. */
bool srp_column_is_in(const srp_column *column, const srp_table *table);
/* Doubles in the whole variable. */
size_t srp_column_size(const srp_column *column, const srp_table *table);
/* Element k of the variable's vectors (or scalars), in the order of the file: where its doubles are
 * in the table. */
double *srp_column_at(const srp_column *column, const srp_table *table, size_t k);
/* The node that element belongs to. */
size_t srp_column_node(const srp_column *column, const srp_table *table, size_t k);

/* A string of srp_table_info and the attribute that holds it. */
typedef struct srp_text_attribute {
    const char *name;
    size_t offset; /* of the const char * in srp_table_info */
} srp_text_attribute;

enum { SRP_TEXT_ATTRIBUTE_COUNT = 9 };
extern const srp_text_attribute srp_table_texts[SRP_TEXT_ATTRIBUTE_COUNT];

/* Attributes that hold the errors of srp_table_check, in the order of its schemes. */
extern const char *const srp_table_check_names[SRP_TABLE_SCHEMES];

/* From one to the other this thread has NetCDF for itself, and HDF5 beneath it prints nothing. */
void srp_table_netcdf_enter(void);
void srp_table_netcdf_leave(void);

srp_status srp_table_netcdf_write(const srp_table *table, const char *path, srp_error *error);
srp_status srp_table_netcdf_read(const char *path, srp_table **out, srp_error *error);

#endif
