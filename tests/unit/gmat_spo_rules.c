/* SPDX-License-Identifier: Apache-2.0 */
#include "gmat_spo_rules.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_MAX_BYTES = 4096, COLUMNS_MAX = 64 };

/* What is known at a line; one pass, as GMAT's. */
typedef struct rules {
    int line;
    char why[512];
    bool broken;
    enum { HEADER, META, DATA } part;
    bool behind_end, has_analysis, has_units;
    int motions; /* begun so far; the last is number `motions` */
    char name[3][64], method[3][64];
    double minimum[3], maximum[3], step[3];
    long records, rows;
} rules;

static void breaks(rules *r, const char *format, ...) {
    if (r->broken) {
        return;
    }
    va_list arguments;
    va_start(arguments, format);
    int head = snprintf(r->why, sizeof r->why, "line %d: ", r->line);
    vsnprintf(r->why + head, sizeof r->why - (size_t)head, format, arguments);
    va_end(arguments);
    r->broken = true;
}

/* Cuts the blanks at both ends, in place. */
static char *trim(char *text) {
    while (isspace((unsigned char)*text)) {
        text++;
    }
    size_t length = strlen(text);
    while (length > 0 && isspace((unsigned char)text[length - 1])) {
        text[--length] = '\0';
    }
    return text;
}

static bool begins(const char *text, const char *word) {
    return strncmp(text, word, strlen(word)) == 0;
}

static bool to_real(const char *text, double *value) {
    char *end;
    *value = strtod(text, &end);
    return end != text && *end == '\0' && isfinite(*value) && strpbrk(text, "xX") == NULL;
}

/* ---- Before the data ------------------------------------------------------------------------ */

static void header_field(rules *r, const char *key, const char *value) {
    double number;
    if (strcmp(key, "Analysis Type") == 0) {
        if (strcmp(value, "Area") != 0) {
            breaks(r, "the analysis type must be Area, not '%s'", value);
        }
        r->has_analysis = true;
    } else if (strcmp(key, "Pressure") == 0 && !to_real(value, &number)) {
        breaks(r, "the pressure must be a real number, not '%s'", value);
    }
}

static void meta_number(rules *r, const char *key, const char *value, double *out) {
    if (!to_real(value, out)) {
        breaks(r, "%s must be a real number, not '%s'", key, value);
    }
}

static void begin_motion(rules *r, const char *value) {
    double number;
    if (!to_real(value, &number) || number != r->motions + 1 || r->motions == 2) {
        breaks(r, "motions must be 1, azimuth, and 2, elevation, not '%s'", value);
        return;
    }
    r->motions++;
    r->step[r->motions] = NAN;
}

static void meta_field(rules *r, const char *key, const char *value) {
    double number;
    int m = r->motions;
    if (strcmp(key, "Record count") == 0) {
        if (!to_real(value, &number) || number != floor(number)) {
            breaks(r, "the record count must be a whole number, not '%s'", value);
        } else {
            r->records = (long)number;
        }
    } else if (r->behind_end) {
        breaks(r, "the record count must follow END, not '%s'", key);
    } else if (strcmp(key, "Motion") == 0) {
        begin_motion(r, value);
    } else if (m == 0) {
        breaks(r, "the first motion must come before '%s'", key);
    } else if (strcmp(key, "Name") == 0) {
        snprintf(r->name[m], sizeof r->name[m], "%s", value);
    } else if (strcmp(key, "Method") == 0) {
        snprintf(r->method[m], sizeof r->method[m], "%s", value);
    } else if (strcmp(key, "Minimum") == 0) {
        meta_number(r, key, value, &r->minimum[m]);
    } else if (strcmp(key, "Maximum") == 0) {
        meta_number(r, key, value, &r->maximum[m]);
    } else if (strcmp(key, "Step") == 0) {
        meta_number(r, key, value, &r->step[m]);
    } else {
        breaks(r, "'%s' is no field of a motion", key);
    }
}

/* A line before the data: `key : value`, one colon, nothing missing. */
static void take_field(rules *r, char *line) {
    char *colon = strchr(line, ':');
    if (begins(line, "Current")) {
        return;
    }
    if (r->part == META && strstr(line, "END") != NULL) {
        r->behind_end = true;
        return;
    }
    if (colon == NULL || strchr(colon + 1, ':') != NULL) {
        breaks(r, "must have exactly one colon: '%.100s'", line);
        return;
    }
    *colon = '\0';
    char *key = trim(line), *value = trim(colon + 1);
    if (key[0] == '\0' || value[0] == '\0') {
        breaks(r, "must be 'key : value'");
    } else if (r->part == HEADER) {
        header_field(r, key, value);
    } else {
        meta_field(r, key, value);
    }
}

static void check_motion(rules *r, int m, const char *name, double range) {
    double steps = range / r->step[m];
    if (strcmp(r->name[m], name) != 0 || strcmp(r->method[m], "Step") != 0) {
        breaks(r, "motion %d must be %s by Step", m, name);
    } else if (r->minimum[m] != -range / 2.0 || r->maximum[m] != range / 2.0) {
        breaks(r, "%s must run from %g to %g", name, -range / 2.0, range / 2.0);
    } else if (!(r->step[m] > 0.0) || fabs(steps - round(steps)) > 1e-9) {
        breaks(r, "the step of %s must be above 0 and divide %g", name, range);
    }
}

static long nodes(const rules *r, int m, double range) {
    return lround(range / r->step[m]) + 1;
}

/* The line of titles, which begins with "Azimuth". */
static void begin_data(rules *r) {
    if (!r->has_analysis) {
        breaks(r, "the analysis type is missing");
    } else if (r->motions != 2) {
        breaks(r, "there must be two motions, not %d", r->motions);
    } else if (r->records < 0) {
        breaks(r, "the record count is missing");
    }
    if (!r->broken) {
        check_motion(r, 1, "Azimuth", 360.0);
        check_motion(r, 2, "Elevation", 180.0);
    }
    if (!r->broken && r->records != nodes(r, 1, 360.0) * nodes(r, 2, 180.0)) {
        breaks(r, "the record count must be (360/step + 1) (180/step + 1), not %ld", r->records);
    }
    r->part = DATA;
}

/* ---- The data ------------------------------------------------------------------------------- */

/* Splits at blanks and tabs, in place; the number of columns. */
static int columns_of(char *line, char *column[COLUMNS_MAX]) {
    int count = 0;
    for (char *at = strtok(line, " \t"); at != NULL && count < COLUMNS_MAX;
         at = strtok(NULL, " \t")) {
        column[count++] = at;
    }
    return count;
}

static void take_units(rules *r, char *line) {
    static const char *const AREAS[] = {"mm^2", "m^2", "cm^2", "in^2", "ft^2"};
    char *column[COLUMNS_MAX];
    int count = columns_of(line, column);
    if (count < 5 || strcmp(column[0], "degrees") != 0 || strcmp(column[1], "degrees") != 0) {
        breaks(r, "units must begin with 'degrees degrees', and name five columns");
        return;
    }
    for (int k = 2; k < 5; ++k) {
        bool known = false;
        for (size_t n = 0; n < sizeof AREAS / sizeof AREAS[0]; ++n) {
            known = known || strcmp(column[k], AREAS[n]) == 0;
        }
        if (!known) {
            breaks(r, "'%s' is no unit of area", column[k]);
        }
    }
    r->has_units = true;
}

static void take_row(rules *r, char *line) {
    char *column[COLUMNS_MAX];
    double value[5];
    int count = columns_of(line, column);
    if (count < 5) {
        breaks(r, "a row must have five columns, not %d", count);
        return;
    }
    for (int k = 0; k < 5; ++k) {
        if (!to_real(column[k], &value[k])) {
            breaks(r, "'%s' is no real number", column[k]);
            return;
        }
    }
    long per_azimuth = nodes(r, 2, 180.0);
    double az = -180.0 + r->step[1] * (double)(r->rows / per_azimuth);
    double el = -90.0 + r->step[2] * (double)(r->rows % per_azimuth);
    if (fabs(value[0] - az) > r->step[1] / 1000.0 || fabs(value[1] - el) > r->step[2] / 1000.0) {
        breaks(r, "row %ld must be at %g, %g, not %g, %g", r->rows + 1, az, el, value[0], value[1]);
    }
    r->rows++;
}

static bool is_dashed(const char *line) {
    return strstr(line, "--") != NULL && line[strspn(line, "- \t")] == '\0';
}

static void take_line(rules *r, char *line) {
    if (r->part == HEADER && begins(line, "Motion")) {
        r->part = META;
    }
    if (r->part != DATA && begins(line, "Azimuth")) {
        if (r->part == HEADER) {
            breaks(r, "the data must follow the motions");
        } else {
            begin_data(r);
        }
    } else if (r->part != DATA) {
        take_field(r, line);
    } else if (begins(line, "degree")) {
        take_units(r, line);
    } else if (!is_dashed(line) && !begins(line, "Azimuth")) {
        if (!r->has_units) {
            breaks(r, "units must come before the first row");
        } else {
            take_row(r, line);
        }
    }
}

const char *gmat_spo_broken_rule(const char *text) {
    static rules r;
    char line[LINE_MAX_BYTES];
    memset(&r, 0, sizeof r);
    r.records = -1;
    while (*text != '\0' && !r.broken) {
        size_t length = strcspn(text, "\n");
        r.line++;
        if (length >= sizeof line) {
            breaks(&r, "is longer than %d bytes", LINE_MAX_BYTES);
            break;
        }
        memcpy(line, text, length);
        line[length] = '\0';
        text += length + (text[length] == '\n');
        char *content = trim(line);
        if (content[0] != '\0') {
            take_line(&r, content);
        }
    }
    if (r.part != DATA) {
        breaks(&r, "there are no data");
    } else if (r.rows != r.records) {
        breaks(&r, "there must be %ld rows, not %ld", r.records, r.rows);
    }
    return r.broken ? r.why : NULL;
}
