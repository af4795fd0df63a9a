/* SPDX-License-Identifier: Apache-2.0 */
#include "oem_rules.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct reader {
    FILE *in;
    char line[400];
    int number;
    char *why;
    size_t size;
} reader;

static bool broken(const reader *r, const char *rule) {
    snprintf(r->why, r->size, "line %d: %s: %.80s", r->number, rule, r->line);
    return false;
}

/* The next line that is not blank; 7.3: printable ASCII of at most 254 characters. */
static bool next(reader *r) {
    while (fgets(r->line, sizeof r->line, r->in) != NULL) {
        ++r->number;
        r->line[strcspn(r->line, "\r\n")] = '\0';
        if (r->line[strspn(r->line, " ")] != '\0') {
            return true;
        }
    }
    r->line[0] = '\0';
    return false;
}

static bool is_plain(const char *line) {
    for (const char *at = line; *at != '\0'; ++at) {
        if ((unsigned char)*at < 32 || (unsigned char)*at > 126) {
            return false;
        }
    }
    return strlen(line) <= 254;
}

/* KEY = VALUE with this key and a value; NULL otherwise. */
static const char *value_of(const char *line, const char *key) {
    const size_t n = strlen(key);
    if (strncmp(line, key, n) != 0) {
        return NULL;
    }
    const char *at = line + n + strspn(line + n, " ");
    if (*at != '=') {
        return NULL;
    }
    at += 1 + strspn(at + 1, " ");
    return *at != '\0' ? at : NULL;
}

/* 7.5.10: YYYY-MM-DDThh:mm:ss[.d...][Z] */
static bool is_date(const char *text, size_t length) {
    static const char FORM[] = "0000-00-00T00:00:00";
    if (length < sizeof FORM - 1) {
        return false;
    }
    for (size_t i = 0; i < sizeof FORM - 1; ++i) {
        if (FORM[i] == '0' ? !isdigit((unsigned char)text[i]) : text[i] != FORM[i]) {
            return false;
        }
    }
    size_t i = sizeof FORM - 1;
    if (i < length && text[i] == '.') {
        ++i;
        while (i < length && isdigit((unsigned char)text[i])) {
            ++i;
        }
    }
    return i == length || (i + 1 == length && text[i] == 'Z');
}

static bool is_one_of(const char *text, const char *const *words) {
    for (; *words != NULL; ++words) {
        if (strcmp(text, *words) == 0) {
            return true;
        }
    }
    return false;
}

/* 5.2.2: version first, then optional comments, CREATION_DATE, ORIGINATOR. */
static bool head_is_valid(reader *r) {
    const char *value;
    if (!next(r) || (value = value_of(r->line, "CCSDS_OEM_VERS")) == NULL ||
        (strcmp(value, "1.0") != 0 && strcmp(value, "2.0") != 0)) {
        return broken(r, "the first line is CCSDS_OEM_VERS, 1.0 or 2.0");
    }
    while (next(r) && strncmp(r->line, "COMMENT", 7) == 0) {
    }
    value = value_of(r->line, "CREATION_DATE");
    if (value == NULL || !is_date(value, strlen(value))) {
        return broken(r, "CREATION_DATE with a date");
    }
    if (!next(r) || value_of(r->line, "ORIGINATOR") == NULL) {
        return broken(r, "ORIGINATOR");
    }
    return next(r) && strcmp(r->line, "META_START") == 0 ? true : broken(r, "META_START");
}

/* 5.2.3, table 5-3, in its order. */
static bool meta_is_valid(reader *r, char start[64], char stop[64]) {
    static const char *const KEYS[] = {"OBJECT_NAME", "OBJECT_ID",  "CENTER_NAME", "REF_FRAME",
                                       "TIME_SYSTEM", "START_TIME", "STOP_TIME"};
    static const char *const FRAMES[] = {"EME2000", "GCRF", "GRC",  "ICRF", "ITRF2000",
                                         "MCI",     "TDR",  "TEME", "TOD",  NULL};
    static const char *const SYSTEMS[] = {"GMST", "GPS", "MET", "MRT", "SCLK", "TAI", "TCB",
                                          "TDB",  "TCG", "TT",  "UT1", "UTC",  NULL};
    for (size_t i = 0; i < sizeof KEYS / sizeof KEYS[0]; ++i) {
        const char *value = next(r) ? value_of(r->line, KEYS[i]) : NULL;
        if (value == NULL) {
            return broken(r, KEYS[i]);
        }
        if ((i == 3 && !is_one_of(value, FRAMES)) || (i == 4 && !is_one_of(value, SYSTEMS))) {
            return broken(r, "a value that the standard knows");
        }
        if (i >= 5) {
            if (!is_date(value, strlen(value)) || strlen(value) >= 64) {
                return broken(r, "a date");
            }
            strcpy(i == 5 ? start : stop, value);
        }
    }
    return next(r) && strcmp(r->line, "META_STOP") == 0 ? true : broken(r, "META_STOP");
}

/* 5.2.4: epoch, three lengths [km], three speeds [km/s]; epochs grow and stay within the span. */
static bool data_is_valid(reader *r, const char *start, const char *stop) {
    char last[64] = "";
    size_t rows = 0;
    while (next(r)) {
        if (!is_plain(r->line)) {
            return broken(r, "printable ASCII, 254 characters");
        }
        if (strncmp(r->line, "COMMENT", 7) == 0) {
            if (rows > 0) {
                return broken(r, "comments stand before the data");
            }
            continue;
        }
        const size_t n = strcspn(r->line, " ");
        if (n >= sizeof last || !is_date(r->line, n)) {
            return broken(r, "a date at the beginning");
        }
        char date[64], *at = r->line + n;
        memcpy(date, r->line, n);
        date[n] = '\0';
        if (strcmp(date, last) <= 0 || strcmp(date, start) < 0 || strcmp(date, stop) > 0) {
            return broken(r, "epochs grow from START_TIME to STOP_TIME");
        }
        for (int i = 0; i < 6; ++i) {
            char *end;
            strtod(at, &end);
            if (end == at) {
                return broken(r, "six numbers");
            }
            at = end;
        }
        if (*at != '\0') {
            return broken(r, "six numbers and no more");
        }
        strcpy(last, date);
        ++rows;
    }
    return rows > 0 && strcmp(last, stop) == 0 ? true : broken(r, "the last epoch is STOP_TIME");
}

bool oem_is_valid(const char *path, char *why, size_t size) {
    reader r = {.in = fopen(path, "r"), .why = why, .size = size};
    char start[64] = "", stop[64] = "";
    if (r.in == NULL) {
        snprintf(why, size, "%s is not there", path);
        return false;
    }
    const bool valid =
        head_is_valid(&r) && meta_is_valid(&r, start, stop) && data_is_valid(&r, start, stop);
    fclose(r.in);
    return valid;
}
