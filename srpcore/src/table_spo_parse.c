/* SPDX-License-Identifier: Apache-2.0 */
/* Reading of SPAD files (.spo), as strict as GMAT's reader, and with a line for whatever it
 * refuses. */
#include "error.h"
#include "platform.h"
#include "table_text.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef enum section { IN_HEADER, IN_MOTIONS, BEHIND_END, IN_DATA } section;

enum { FIELD_NAME, FIELD_METHOD, FIELD_MINIMUM, FIELD_MAXIMUM, FIELD_STEP, FIELD_COUNT };

/* What a `Motion` block says; NAN, "" while it has not. */
typedef struct motion {
    srp_token name, method;
    double minimum, maximum, step;
    size_t line;
    size_t field_line[FIELD_COUNT]; /* 0 while it has not */
} motion;

typedef struct reader {
    srp_text text;
    size_t size;
    srp_error *error;
    section section;
    /* Lines of what may be said once, 0 while it is not. */
    size_t analysis_line, center_line, count_line, units_line;
    bool is_ours; /* srpcore wrote the file */
    srp_token title;
    double center[3];
    motion motions[2];
    int motion_count;
    int64_t record_count; /* -1 while unknown */
    bool has_total, has_torque;
    double force_scale[3], total_scale, torque_scale[3];
    srp_table *table;
    size_t rows, columns; /* columns of the first row */
} reader;

static bool starts_with(srp_token token, const char *prefix) {
    size_t size = strlen(prefix);
    return token.size >= size && memcmp(token.text, prefix, size) == 0;
}

static bool contains(srp_token token, const char *word) {
    size_t size = strlen(word);
    for (size_t k = 0; k + size <= token.size; ++k) {
        if (memcmp(token.text + k, word, size) == 0) {
            return true;
        }
    }
    return false;
}

static bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

/* The part without blanks at its ends. */
static srp_token trimmed_part(srp_token token, size_t begin, size_t end) {
    while (begin < end && is_blank(token.text[begin])) {
        begin++;
    }
    while (end > begin && is_blank(token.text[end - 1])) {
        end--;
    }
    return srp_token_part(token, begin, end);
}

/* Only dashes and blanks, with two dashes side by side. */
static bool is_dashed(srp_token line) {
    for (size_t k = 0; k < line.size; ++k) {
        if (line.text[k] != '-' && !is_blank(line.text[k])) {
            return false;
        }
    }
    return contains(line, "--");
}

/* Splits `key : value` at its only colon. */
static srp_status split(const reader *in, srp_token line, srp_token *key, srp_token *value) {
    size_t colon = line.size, colons = 0;
    for (size_t k = 0; k < line.size; ++k) {
        if (line.text[k] == ':') {
            colon = colons++ == 0 ? k : colon;
        }
    }
    if (colons != 1) {
        return srp_fail_at(in->error, SRP_BAD_FORMAT, in->text.name, line.line, line.column,
                           "found %zu colons in %s, expected 'key : value' with one colon", colons,
                           srp_token_excerpt(line).text);
    }
    *key = trimmed_part(line, 0, colon);
    *value = trimmed_part(line, colon + 1, line.size);
    if (key->size == 0 || value->size == 0) {
        return srp_text_expected(&in->text, line, "'key : value'", in->error);
    }
    return SRP_OK;
}

/* `(x, y, z)`. Other programs may write what they like there: false when it is something else. */
static bool parse_center(const reader *in, srp_token value, double center[3]) {
    size_t begin = 1;
    if (value.size < 2 || value.text[0] != '(' || value.text[value.size - 1] != ')') {
        return false;
    }
    for (int k = 0; k < 3; ++k) {
        size_t end = begin;
        while (end < value.size - 1 && value.text[end] != ',') {
            end++;
        }
        srp_token part = trimmed_part(value, begin, end);
        if (part.size == 0 || (k < 2) != (end < value.size - 1) ||
            srp_token_double(&in->text, part, "a coordinate", &center[k], NULL) != SRP_OK) {
            return false;
        }
        begin = end + 1;
    }
    return true;
}

static srp_status take_header_line(reader *in, srp_token line) {
    srp_token key, value;
    if (starts_with(line, "Current")) {
        return SRP_OK; /* a time, with colons of its own */
    }
    srp_status status = split(in, line, &key, &value);
    if (status != SRP_OK) {
        return status;
    }
    if (srp_token_is(key, "Analysis Type")) {
        if (!srp_token_is(value, "Area")) {
            return srp_text_expected(&in->text, value, "the analysis type 'Area'", in->error);
        }
        return srp_table_key_once(&in->text, key, &in->analysis_line, in->error);
    } else if (srp_token_is(key, "System")) {
        in->title = value;
    } else if (srp_token_is(key, "Center of Mass")) {
        double center[3];
        if (parse_center(in, value, center)) {
            memcpy(in->center, center, sizeof center);
        }
        return srp_table_key_once(&in->text, key, &in->center_line, in->error);
    } else if (srp_token_is(key, "Software")) {
        in->is_ours = starts_with(value, srp_table_writer);
    }
    return SRP_OK;
}

static srp_status begin_motion(reader *in, srp_token value) {
    if (in->motion_count == 2) {
        return srp_text_expected(&in->text, value,
                                 "two motions, azimuth and elevation, and no third", in->error);
    }
    bool first = in->motion_count == 0;
    if (!srp_token_is(value, first ? "1" : "2")) {
        return srp_text_expected(&in->text, value,
                                 first ? "1, the motion in azimuth" : "2, the motion in elevation",
                                 in->error);
    }
    motion *next = &in->motions[in->motion_count++];
    next->minimum = next->maximum = next->step = NAN;
    next->line = value.line;
    return SRP_OK;
}

static srp_status take_record_count(reader *in, srp_token value) {
    return srp_token_integer(&in->text, value, "the number of records", 1,
                             (int64_t)SRP_GRID_AZ_MAX * SRP_GRID_EL_MAX, &in->record_count,
                             in->error);
}

static srp_status take_field(const reader *in, motion *to, srp_token key, srp_token value) {
    static const char *const names[FIELD_COUNT] = {"Name", "Method", "Minimum", "Maximum", "Step"};
    size_t field = 0;
    while (field < FIELD_COUNT && !srp_token_is(key, names[field])) {
        field++;
    }
    if (field == FIELD_COUNT) {
        return srp_text_expected(&in->text, key,
                                 "Motion, Name, Method, Minimum, Maximum, Step or Record count",
                                 in->error);
    }
    srp_status status = srp_table_key_once(&in->text, key, &to->field_line[field], in->error);
    if (status != SRP_OK) {
        return status;
    }
    switch (field) {
    case FIELD_NAME:
        to->name = value;
        return SRP_OK;
    case FIELD_METHOD:
        to->method = value;
        return SRP_OK;
    case FIELD_MINIMUM:
        return srp_token_double(&in->text, value, "the smallest angle", &to->minimum, in->error);
    case FIELD_MAXIMUM:
        return srp_token_double(&in->text, value, "the largest angle", &to->maximum, in->error);
    default:
        return srp_token_double(&in->text, value, "the step", &to->step, in->error);
    }
}

static srp_status take_motion_line(reader *in, srp_token line) {
    srp_token key, value;
    if (starts_with(line, "Current")) {
        return SRP_OK;
    }
    if (contains(line, "END")) {
        in->section = BEHIND_END;
        return SRP_OK;
    }
    srp_status status = split(in, line, &key, &value);
    if (status != SRP_OK) {
        return status;
    }
    if (srp_token_is(key, "Record count")) {
        status = srp_table_key_once(&in->text, key, &in->count_line, in->error);
        return status == SRP_OK ? take_record_count(in, value) : status;
    }
    if (in->section == BEHIND_END) {
        return srp_text_expected(&in->text, key, "'Record count : N'", in->error);
    }
    if (srp_token_is(key, "Motion")) {
        return begin_motion(in, value);
    }
    if (in->motion_count == 0) {
        return srp_text_expected(&in->text, key, "'Motion : 1'", in->error);
    }
    return take_field(in, &in->motions[in->motion_count - 1], key, value);
}

static srp_status check_motion(const reader *in, const motion *found, const char *name,
                               double range) {
    if (!srp_token_is(found->name, name) || !srp_token_is(found->method, "Step")) {
        return srp_fail_at(in->error, SRP_BAD_FORMAT, in->text.name, found->line, 0,
                           "expected a motion with 'Name : %s' and 'Method : Step'", name);
    }
    if (found->minimum != -range / 2.0 || found->maximum != range / 2.0) {
        return srp_fail_at(in->error, SRP_BAD_FORMAT, in->text.name, found->line, 0,
                           "found %s from %g to %g, expected %g to %g", name, found->minimum,
                           found->maximum, -range / 2.0, range / 2.0);
    }
    if (isnan(found->step)) {
        return srp_fail_at(in->error, SRP_BAD_FORMAT, in->text.name, found->line, 0,
                           "expected 'Step : DEGREES' for %s", name);
    }
    return SRP_OK;
}

/* All that stands before the data has been read: checks it, and makes the table. */
static srp_status end_header(reader *in, srp_token line) {
    const char *missing = in->analysis_line == 0   ? "'Analysis Type : Area'"
                          : in->motion_count < 2   ? "two motions, azimuth and elevation,"
                          : in->record_count == -1 ? "'Record count : N'"
                                                   : NULL;
    if (missing != NULL) {
        return srp_fail_at(in->error, SRP_BAD_FORMAT, in->text.name, line.line, line.column,
                           "the data begin here, expected %s before them", missing);
    }
    srp_status status = check_motion(in, &in->motions[0], "Azimuth", 360.0);
    if (status == SRP_OK) {
        status = check_motion(in, &in->motions[1], "Elevation", 180.0);
    }
    srp_grid grid;
    if (status == SRP_OK) {
        status = srp_table_grid_of_file(&in->text, in->motions[0].line, in->size,
                                        in->motions[0].step, in->motions[1].step, &grid, in->error);
    }
    if (status == SRP_OK && (uint64_t)in->record_count != srp_grid_node_count(grid)) {
        return srp_fail_at(in->error, SRP_BAD_FORMAT, in->text.name, line.line, 0,
                           "found a record count of %lld, expected the %zu that the steps give",
                           (long long)in->record_count, srp_grid_node_count(grid));
    }
    if (status == SRP_OK) {
        status = srp_table_create_blank(grid, 0, false, &in->table, in->error);
    }
    in->section = IN_DATA;
    return status;
}

typedef struct length_unit {
    const char *name;
    double metres;
} length_unit;

static const length_unit UNITS[] = {
    {"mm", 1e-3}, {"m", 1.0}, {"cm", 1e-2}, {"in", 0.0254}, {"ft", 0.3048}};

/* Factor to [m^power] of a unit such as "cm^2"; NAN when it is none. */
static double unit_scale(srp_token token, int power) {
    for (size_t k = 0; k < sizeof UNITS / sizeof UNITS[0]; ++k) {
        char name[8];
        snprintf(name, sizeof name, "%s^%d", UNITS[k].name, power);
        if (srp_token_is(token, name)) {
            return power == 2 ? UNITS[k].metres * UNITS[k].metres
                              : UNITS[k].metres * UNITS[k].metres * UNITS[k].metres;
        }
    }
    return NAN;
}

static srp_status take_units(reader *in) {
    srp_token token;
    for (int k = 0; k < 2; ++k) {
        if (!srp_text_next_token(&in->text, &token) || !srp_token_is(token, "degrees")) {
            return srp_text_expected(&in->text, token, "the unit 'degrees'", in->error);
        }
    }
    for (int k = 0; k < 3; ++k) {
        srp_text_next_token(&in->text, &token);
        in->force_scale[k] = unit_scale(token, 2);
        if (isnan(in->force_scale[k])) {
            return srp_text_expected(&in->text, token,
                                     "a unit of force, mm^2, m^2, cm^2, in^2 or ft^2", in->error);
        }
    }
    /* Total force, then the torques; files with fewer columns, or other ones, are fine without. */
    in->has_total = srp_text_next_token(&in->text, &token) && !isnan(unit_scale(token, 2));
    in->total_scale = in->has_total ? unit_scale(token, 2) : NAN;
    in->has_torque = in->has_total;
    for (int k = 0; k < 3 && in->has_torque; ++k) {
        srp_text_next_token(&in->text, &token);
        in->torque_scale[k] = unit_scale(token, 3);
        in->has_torque = !isnan(in->torque_scale[k]);
    }
    in->table->info.has_moment = in->has_torque;
    return SRP_OK;
}

/* A row with fewer columns than the others has lost some, one with more is no row. */
static srp_status check_columns(reader *in, srp_token line) {
    srp_text row = in->text;
    srp_token token;
    size_t count = 0;
    row.at = line.text;
    while (srp_text_next_token(&row, &token)) {
        count++;
    }
    in->columns = in->rows == 0 ? count : in->columns;
    if (count != in->columns) {
        return srp_fail_at(in->error, SRP_BAD_FORMAT, in->text.name, line.line, 0,
                           "found %zu columns, expected %zu as in the first row", count,
                           in->columns);
    }
    return SRP_OK;
}

/* |f| as the sixth column has it, which counts for nothing. Other columns than torques may follow;
 * without these it is not asked to be a number. */
static srp_status take_total(reader *in, srp_token line, srp_vec3 f) {
    srp_token token;
    double total;
    if (!in->has_torque && !srp_text_next_token(&in->text, &token)) {
        return SRP_OK;
    }
    srp_status status = in->has_torque
                            ? srp_text_double(&in->text, "the total force", &total, NULL, in->error)
                            : srp_token_double(&in->text, token, "the total force", &total, NULL);
    if (status != SRP_OK) {
        return in->has_torque ? status : SRP_OK;
    }
    double said = total * in->total_scale, off = fabs(said - srp_vec3_norm(f));
    if (off > in->table->total.off) {
        in->table->total.line = line.line;
        in->table->total.said = said;
        in->table->total.off = off;
    }
    return SRP_OK;
}

static srp_status take_row(reader *in, srp_token line) {
    srp_table_row row;
    srp_vec3 f, t = {0.0, 0.0, 0.0};
    srp_status status = srp_table_row_begin(&in->text, &row, in->error);
    if (status == SRP_OK) {
        status = srp_table_row_check(&in->text, in->table->grid, in->rows, &row, in->error);
    }
    if (status == SRP_OK) {
        status = srp_table_row_vec3(&in->text, "Force", in->force_scale, &f, in->error);
    }
    if (status == SRP_OK && in->has_total) {
        status = take_total(in, line, f);
    }
    if (status == SRP_OK && in->has_torque) {
        status = srp_table_row_vec3(&in->text, "Torque", in->torque_scale, &t, in->error);
    }
    if (status == SRP_OK) {
        status = check_columns(in, line);
    }
    if (status == SRP_OK) {
        in->table->nodes[in->rows].f = f;
        in->table->nodes[in->rows].t = t;
        srp_table_mark_filled(in->table, in->rows++);
    }
    return status;
}

static srp_status take_data_line(reader *in, srp_token line) {
    if (starts_with(line, "Azimuth") || is_dashed(line)) {
        return SRP_OK;
    }
    if (starts_with(line, "degree")) {
        srp_status status = srp_table_key_once(&in->text, srp_token_part(line, 0, strlen("degree")),
                                               &in->units_line, in->error);
        return status == SRP_OK ? take_units(in) : status;
    }
    if (in->units_line == 0) {
        return srp_text_expected(&in->text, line, "a line of units, 'degrees degrees m^2 ...'",
                                 in->error);
    }
    return take_row(in, line);
}

static srp_status take_line(reader *in) {
    /* The line as a whole, without moving on. */
    srp_text ahead = in->text;
    srp_token line = srp_text_rest(&ahead);
    if (in->section == IN_HEADER && starts_with(line, "Motion")) {
        in->section = IN_MOTIONS;
    }
    if (in->section != IN_DATA && starts_with(line, "Azimuth")) {
        return end_header(in, line);
    }
    switch (in->section) {
    case IN_HEADER:
        return take_header_line(in, line);
    case IN_MOTIONS:
    case BEHIND_END:
        return take_motion_line(in, line);
    case IN_DATA:
        break;
    }
    return take_data_line(in, line);
}

static srp_status end_file(reader *in) {
    if (in->section != IN_DATA) {
        return srp_fail_at(in->error, SRP_BAD_FORMAT, in->text.name, in->text.line, 0,
                           "the text ends before any data, expected a SPAD file");
    }
    srp_status status =
        srp_table_end_of_rows(&in->text, in->table, in->rows, "records", in->is_ours, in->error);
    if (status != SRP_OK) {
        return status;
    }
    if (in->has_torque) {
        in->table->info.params.reference =
            srp_vec3_make(in->center[0], in->center[1], in->center[2]);
    }
    return srp_table_set_text(&in->table->info.title, in->title.text != NULL ? in->title.text : "",
                              in->title.size, in->error);
}

srp_status srp_table_parse_spo(const char *text, size_t size, const char *name, srp_table **out,
                               srp_error *error) {
    reader in;
    memset(&in, 0, sizeof in);
    in.error = error;
    in.size = size;
    in.record_count = -1;
    srp_status status = srp_text_open(&in.text, text, size, name, 0, in.error);
    if (status != SRP_OK) {
        return status;
    }
    srp_c_locale locale = srp_platform_c_locale_enter();
    while (status == SRP_OK && srp_text_next_line(&in.text)) {
        status = take_line(&in);
    }
    if (status == SRP_OK) {
        status = end_file(&in);
    }
    srp_platform_c_locale_leave(locale);
    if (status != SRP_OK) {
        srp_table_destroy(in.table);
        return status;
    }
    *out = in.table;
    return SRP_OK;
}
