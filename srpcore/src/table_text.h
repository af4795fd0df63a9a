/* SPDX-License-Identifier: Apache-2.0 */
/* What the text formats of tables share: text that grows, and rows in the order of the grid.
 * Internal.
 */
#ifndef SRP_SRC_TABLE_TEXT_H
#define SRP_SRC_TABLE_TEXT_H

#include "table_internal.h"
#include "text.h"

#include <srp/export.h>

#include <stdbool.h>
#include <stddef.h>

/* Text being written, in memory. Once memory has run out it stays so; srp_sheet_save() tells. */
typedef struct srp_sheet {
    char *bytes;
    size_t size, capacity;
    bool failed;
} srp_sheet;

void srp_sheet_print(srp_sheet *sheet, const char *format, ...) SRP_PRINTF(2, 3);
/* Writes the text as the whole of a file, and ends the sheet whatever comes. SRP_IO, SRP_NO_MEMORY.
 */
srp_status srp_sheet_save(srp_sheet *sheet, const char *path, srp_error *error);

/* Azimuth and elevation of a node, in as many digits as the grid's steps need. */
void srp_sheet_print_angles(srp_sheet *sheet, srp_grid grid, uint32_t i, uint32_t j);

/* A row on its way in: its first two values, and where they stand. */
typedef struct srp_table_row {
    double az, el; /* [deg] */
    srp_token az_token, el_token;
} srp_table_row;

/* Takes the two angles of a row. SRP_BAD_FORMAT. */
srp_status srp_table_row_begin(srp_text *text, srp_table_row *out, srp_error *error);
/* SRP_BAD_FORMAT unless the row is number `index` of the grid: azimuth in the outer loop, elevation
 * in the inner, both ascending, each within a thousandth of a step (GMAT's own tolerance). */
srp_status srp_table_row_check(const srp_text *text, srp_grid grid, size_t index,
                               const srp_table_row *row, srp_error *error);
/* Takes the next three numbers, named "NAME(X)", ... in complaints, times `scale`, which
 * makes areas [m^2] and moments [m^3] of them. SRP_BAD_FORMAT, SRP_BAD_DATA (above
 * SRP_RESPONSE_MAX). */
srp_status srp_table_row_vec3(srp_text *text, const char *name, const double scale[3],
                              srp_vec3 *out, srp_error *error);
/* Remembers in *line (0 before) where `key` stands; SRP_BAD_FORMAT when it stands there again. */
srp_status srp_table_key_once(const srp_text *text, srp_token key, size_t *line, srp_error *error);
/* What our own files name as the program that wrote them. Whole, they end with the end of a line,
 * so that one cut inside its last number is told from one that has fewer digits. */
extern const char srp_table_writer[];
/* SRP_BAD_FORMAT where the text ends before the last of the grid's rows, which a message calls
 * `noun`; `count` have been read. `is_ours`: one of our files, see above. */
srp_status srp_table_end_of_rows(const srp_text *text, const srp_table *table, size_t count,
                                 const char *noun, bool is_ours, srp_error *error);
/* The grid of the steps [deg] that a file gives; SRP_BAD_FORMAT when they do not divide their
 * ranges, or when a text of `size` bytes is too short for all rows of the grid: asked before memory
 * is taken on the word of a file. */
srp_status srp_table_grid_of_file(const srp_text *text, size_t line, size_t size,
                                  double az_step_deg, double el_step_deg, srp_grid *out,
                                  srp_error *error);

#endif
