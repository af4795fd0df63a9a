/* SPDX-License-Identifier: Apache-2.0 */
/* Values of options: read, checked and kept. */
#include "command.h"
#include "messages.h"
#include "numbers.h"
#include "utf8.h"

#include <srp/vec3.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The library's own limits, within which every result is finite. */
const cli_range CLI_POSITIVE = {1e-30, 1e30, "a number above 0 (1e-30 to 1e30)"};
const cli_range CLI_NOT_NEGATIVE = {0.0, 1e30, "a number not below 0 (up to 1e30)"};

static void *field(const cli_option *option, void *target) {
    return (char *)target + option->offset;
}

bool cli_set_flag(const cli_option *option, void *target, const char *text) {
    (void)text;
    *(bool *)field(option, target) = true;
    return true;
}

bool cli_set_text(const cli_option *option, void *target, const char *text) {
    if (text[0] == '\0') {
        return cli_reject(option, text, option->value);
    }
    *(const char **)field(option, target) = text;
    return true;
}

bool cli_set_title(const cli_option *option, void *target, const char *text) {
    size_t bad = cli_utf8_find_bad(text);
    if (text[bad] != '\0') {
        cli_usage_error("--%s: byte %zu is not UTF-8", option->name, bad + 1);
        return false;
    }
    for (size_t k = 0; text[k] != '\0'; ++k) {
        if ((unsigned char)text[k] < 0x20 || text[k] == 0x7f) {
            cli_usage_error("--%s: byte %zu is a control character", option->name, k + 1);
            return false;
        }
    }
    return cli_set_text(option, target, text);
}

static bool in_range(const cli_range *range, double value) {
    return value >= range->min && value <= range->max;
}

bool cli_set_number(const cli_option *option, void *target, const char *text) {
    double value;
    if (!cli_read_number(text, &value) || !in_range(option->range, value)) {
        return cli_reject(option, text, option->range->words);
    }
    *(double *)field(option, target) = value;
    return true;
}

bool cli_set_count(const cli_option *option, void *target, const char *text) {
    uint64_t value;
    if (!cli_read_count(text, UINT32_MAX, &value) || !in_range(option->range, (double)value)) {
        return cli_reject(option, text, option->range->words);
    }
    *(uint32_t *)field(option, target) = (uint32_t)value;
    return true;
}

bool cli_set_bits(const cli_option *option, void *target, const char *text) {
    uint64_t value;
    if (!cli_read_count(text, UINT64_MAX, &value)) {
        return cli_reject(option, text, "a whole number from 0 to 18446744073709551615");
    }
    *(uint64_t *)field(option, target) = value;
    return true;
}

/* No coordinate is larger than the library takes. */
static bool all_within(const double *value, size_t count) {
    bool within = true;
    for (size_t i = 0; i < count; ++i) {
        within = within && fabs(value[i]) <= CLI_NOT_NEGATIVE.max;
    }
    return within;
}

bool cli_set_vector(const cli_option *option, void *target, const char *text) {
    double value[3];
    if (!cli_read_numbers(text, 3, value) || !all_within(value, 3)) {
        return cli_reject(option, text,
                          "three numbers X,Y,Z with commas and no blanks, each up to 1e30");
    }
    *(srp_vec3 *)field(option, target) = srp_vec3_make(value[0], value[1], value[2]);
    return true;
}

bool cli_set_window(const cli_option *option, void *target, const char *text) {
    double value[4];
    if (!cli_read_numbers(text, 4, value) || !all_within(value, 4) || !(value[0] < value[1]) ||
        !(value[2] < value[3])) {
        return cli_reject(
            option, text,
            "four numbers U0,U1,V0,V1 with U0 < U1 and V0 < V1, commas and no blanks, each up to "
            "1e30");
    }
    memcpy(field(option, target), value, sizeof value);
    return true;
}

bool cli_set_list(const cli_option *option, void *target, const char *text) {
    cli_list *list = field(option, target);
    if (text[0] == '\0') {
        return cli_reject(option, text, option->value);
    }
    const char **items = realloc((void *)list->items, (list->count + 1) * sizeof *items);
    if (items == NULL) {
        return cli_reject(option, text, "memory for it, which there is not");
    }
    list->items = items;
    items[list->count++] = text;
    return true;
}

void cli_list_free(cli_list *list) {
    free((void *)list->items);
    list->items = NULL;
    list->count = 0;
}
