/* SPDX-License-Identifier: Apache-2.0 */
#include "table_text.h"

#include "error.h"
#include "limits.h"
#include "platform.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

/* ---- Writing -------------------------------------------------------------------------------- */

/* Makes room for `more` bytes and a terminator. */
static bool reserve(srp_sheet *sheet, size_t more) {
    if (more < sheet->capacity - sheet->size) {
        return true;
    }
    size_t capacity = sheet->capacity + sheet->capacity / 2 + more + 4096;
    char *bytes = realloc(sheet->bytes, capacity);
    if (bytes == NULL) {
        return false;
    }
    sheet->bytes = bytes;
    sheet->capacity = capacity;
    return true;
}

void srp_sheet_print(srp_sheet *sheet, const char *format, ...) {
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    size_t room = sheet->capacity - sheet->size;
    int length = vsnprintf(room > 0 ? sheet->bytes + sheet->size : NULL, room, format, arguments);
    if (length < 0 || sheet->failed) {
        sheet->failed = true;
    } else if ((size_t)length >= room) {
        sheet->failed = !reserve(sheet, (size_t)length);
        if (!sheet->failed) {
            vsnprintf(sheet->bytes + sheet->size, sheet->capacity - sheet->size, format, again);
        }
    }
    sheet->size += sheet->failed ? 0 : (size_t)length;
    va_end(again);
    va_end(arguments);
}

srp_status srp_sheet_save(srp_sheet *sheet, const char *path, srp_error *error) {
    srp_status status;
    if (sheet->failed) {
        status = srp_fail_at(error, SRP_NO_MEMORY, path, 0, 0, "no memory to write the table");
    } else {
        status = srp_platform_write_file(path, sheet->bytes, sheet->size, error);
    }
    free(sheet->bytes);
    *sheet = (srp_sheet){0};
    return status;
}

/* Digits behind the point that show multiples of `step` without rounding, 2 to 9. */
static int digits_of(double step) {
    double scaled = 100.0 * step;
    int digits = 2;
    while (digits < 9 && fabs(scaled - round(scaled)) > 1e-9 * scaled) {
        scaled *= 10.0;
        digits++;
    }
    return digits;
}

void srp_sheet_print_angles(srp_sheet *sheet, srp_grid grid, uint32_t i, uint32_t j) {
    int az_digits = digits_of(360.0 / (double)(grid.az_count - 1));
    int el_digits = digits_of(180.0 / (double)(grid.el_count - 1));
    srp_sheet_print(sheet, " %*.*f %*.*f", az_digits + 5, az_digits, srp_grid_azimuth_deg(grid, i),
                    el_digits + 5, el_digits, srp_grid_elevation_deg(grid, j));
}

/* ---- Reading -------------------------------------------------------------------------------- */

/* A row has five numbers, four blanks and a line end at least. */
enum { ROW_BYTES_MIN = 10 };

/* Share of a step that an angle may be off. */
static const double ANGLE_TOLERANCE = 1e-3;

srp_status srp_table_row_begin(srp_text *text, srp_table_row *out, srp_error *error) {
    srp_status status = srp_text_double(text, "azimuth [deg]", &out->az, &out->az_token, error);
    if (status == SRP_OK) {
        status = srp_text_double(text, "elevation [deg]", &out->el, &out->el_token, error);
    }
    return status;
}

static srp_status check_angle(const srp_text *text, const char *name, srp_token token, double found,
                              double expected, double step, srp_error *error) {
    if (fabs(found - expected) <= ANGLE_TOLERANCE * step) {
        return SRP_OK;
    }
    return srp_fail_at(error, SRP_BAD_FORMAT, text->name, token.line, token.column,
                       "found %s %g, expected %g: rows go by azimuth, and by elevation within each",
                       name, found, expected);
}

srp_status srp_table_row_check(const srp_text *text, srp_grid grid, size_t index,
                               const srp_table_row *row, srp_error *error) {
    uint32_t i = (uint32_t)(index / grid.el_count), j = (uint32_t)(index % grid.el_count);
    if (i >= grid.az_count) {
        return srp_fail_at(error, SRP_BAD_FORMAT, text->name, row->az_token.line, 0,
                           "found more than the %zu rows that the steps give",
                           srp_grid_node_count(grid));
    }
    srp_status status =
        check_angle(text, "azimuth", row->az_token, row->az, srp_grid_azimuth_deg(grid, i),
                    360.0 / (double)(grid.az_count - 1), error);
    if (status == SRP_OK) {
        status =
            check_angle(text, "elevation", row->el_token, row->el, srp_grid_elevation_deg(grid, j),
                        180.0 / (double)(grid.el_count - 1), error);
    }
    return status;
}

srp_status srp_table_row_vec3(srp_text *text, const char *name, const double scale[3],
                              srp_vec3 *out, srp_error *error) {
    double value[3];
    for (int k = 0; k < 3; ++k) {
        char what[64];
        snprintf(what, sizeof what, "%s(%c)", name, "XYZ"[k]);
        srp_token where;
        srp_status status = srp_text_double(text, what, &value[k], &where, error);
        if (status != SRP_OK) {
            return status;
        }
        value[k] *= scale[k];
        if (!(fabs(value[k]) <= SRP_RESPONSE_MAX)) {
            return srp_fail_at(error, SRP_BAD_DATA, text->name, where.line, where.column,
                               "found %s: %s is %g in metres, expected at most %g",
                               srp_token_excerpt(where).text, what, value[k], SRP_RESPONSE_MAX);
        }
    }
    *out = srp_vec3_make(value[0], value[1], value[2]);
    return SRP_OK;
}

srp_status srp_table_key_once(const srp_text *text, srp_token key, size_t *line, srp_error *error) {
    if (*line != 0) {
        return srp_fail_at(error, SRP_BAD_FORMAT, text->name, key.line, key.column,
                           "found %s again, expected it once: it is given in line %zu",
                           srp_token_excerpt(key).text, *line);
    }
    *line = key.line;
    return SRP_OK;
}

const char srp_table_writer[] = "srpcore";

srp_status srp_table_end_of_rows(const srp_text *text, const srp_table *table, size_t count,
                                 const char *noun, bool is_ours, srp_error *error) {
    if (!srp_table_is_complete(table)) {
        return srp_fail_at(error, SRP_BAD_FORMAT, text->name, text->line, 0,
                           "the file ends after %zu %s, expected %zu", count, noun,
                           srp_grid_node_count(table->grid));
    }
    if (is_ours && text->end[-1] != '\n' && text->end[-1] != '\r') {
        return srp_fail_at(error, SRP_BAD_FORMAT, text->name, text->line, 0,
                           "the last line has no end, expected one in a file of srpcore: it is cut "
                           "short");
    }
    return SRP_OK;
}

srp_status srp_table_grid_of_file(const srp_text *text, size_t line, size_t size,
                                  double az_step_deg, double el_step_deg, srp_grid *out,
                                  srp_error *error) {
    srp_grid grid;
    srp_error why;
    if (srp_grid_from_steps(az_step_deg, el_step_deg, &grid, &why) != SRP_OK) {
        return srp_fail_at(error, SRP_BAD_FORMAT, text->name, line, 0, "%s", why.message);
    }
    size_t count = srp_grid_node_count(grid);
    if (count > size / ROW_BYTES_MIN) {
        return srp_fail_at(error, SRP_BAD_FORMAT, text->name, line, 0,
                           "the steps give %zu rows, more than a file of %zu bytes can hold", count,
                           size);
    }
    *out = grid;
    return SRP_OK;
}
