/* SPDX-License-Identifier: Apache-2.0 */
#include "numbers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool cli_read_number(const char *text, double *out) {
    /* strtod() also takes blanks, "inf", "nan" and hexadecimal digits. */
    if (text[0] == '\0' || text[strspn(text, "0123456789+-.eE")] != '\0') {
        return false;
    }
    char *end;
    double value = strtod(text, &end);
    if (*end != '\0' || !isfinite(value)) {
        return false;
    }
    *out = value;
    return true;
}

enum { LIST_TEXT_MAX = 255 };

bool cli_read_numbers(const char *text, size_t count, double *out) {
    char copy[LIST_TEXT_MAX + 1];
    size_t length = strlen(text);
    if (length > LIST_TEXT_MAX) {
        return false;
    }
    memcpy(copy, text, length + 1);
    char *item = copy;
    for (size_t i = 0; i < count; ++i) {
        char *comma = strchr(item, ',');
        if ((comma == NULL) != (i + 1 == count)) {
            return false;
        }
        if (comma != NULL) {
            *comma = '\0';
        }
        if (!cli_read_number(item, &out[i])) {
            return false;
        }
        item = comma != NULL ? comma + 1 : NULL;
    }
    return true;
}

bool cli_read_count(const char *text, uint64_t max, uint64_t *out) {
    uint64_t value = 0;
    if (text[0] == '\0') {
        return false;
    }
    for (const char *p = text; *p != '\0'; ++p) {
        if (*p < '0' || *p > '9') {
            return false;
        }
        uint64_t digit = (uint64_t)(*p - '0');
        if (value > (max - digit) / 10 || digit > max) {
            return false;
        }
        value = value * 10 + digit;
    }
    *out = value;
    return true;
}

const char *cli_write_number(double value, char *buffer) {
    for (int digits = 15; digits <= 17; ++digits) {
        snprintf(buffer, CLI_NUMBER_SIZE, "%.*g", digits, value);
        if (strtod(buffer, NULL) == value) {
            break;
        }
    }
    return buffer;
}
