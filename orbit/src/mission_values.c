/* SPDX-License-Identifier: Apache-2.0 */
/* Texts of a mission file as values: numbers with units. */
#include "mission_internal.h"
#include "text.h"

#include <srp/const.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct unit {
    const char *name;
    mission_kind kind;
    double factor; /* to SI */
} unit;

static const unit UNITS[] = {
    {"m", MISSION_LENGTH, 1.0},
    {"km", MISSION_LENGTH, 1e3},
    {"au", MISSION_LENGTH, SRP_AU},
    {"m/s", MISSION_SPEED, 1.0},
    {"km/s", MISSION_SPEED, 1e3},
    {"s", MISSION_TIME, 1.0},
    {"min", MISSION_TIME, 60.0},
    {"h", MISSION_TIME, 3600.0},
    {"d", MISSION_TIME, 86400.0},
    {"kg", MISSION_MASS, 1.0},
    {"g", MISSION_MASS, 1e-3},
    {"deg", MISSION_ANGLE, SRP_RAD_PER_DEG},
    {"rad", MISSION_ANGLE, 1.0},
    {"arcsec", MISSION_ANGLE, SRP_RAD_PER_DEG / 3600.0},
    {"deg/s", MISSION_RATE, SRP_RAD_PER_DEG},
    {"rad/s", MISSION_RATE, 1.0},
    {"rpm", MISSION_RATE, SRP_PI / 30.0},
    {"m2", MISSION_AREA, 1.0},
    {"m^2", MISSION_AREA, 1.0},
    {"cm2", MISSION_AREA, 1e-4},
    {"W/m2", MISSION_FLUX, 1.0},
    {"W/m^2", MISSION_FLUX, 1.0},
    {"m3/s2", MISSION_MU, 1.0},
    {"m^3/s^2", MISSION_MU, 1.0},
    {"km3/s2", MISSION_MU, 1e9},
    {"km^3/s^2", MISSION_MU, 1e9},
};
enum { UNIT_COUNT = sizeof UNITS / sizeof UNITS[0] };

static void list_units(mission_kind kind, char *buffer, size_t size) {
    size_t used = 0;
    for (size_t i = 0; i < UNIT_COUNT && used < size; ++i) {
        if (UNITS[i].kind == kind && strchr(UNITS[i].name, '^') == NULL) {
            const int n =
                snprintf(buffer + used, size - used, "%s%s", used > 0 ? ", " : "", UNITS[i].name);
            used += n > 0 ? (size_t)n : 0;
        }
    }
}

static const char *skip_blanks(const char *at) {
    return at + strspn(at, " \t,");
}

/* A finite decimal number that ends with a blank, a comma or the text. */
static bool read_number(const char **at, double *out) {
    const size_t size = strcspn(*at, " \t,");
    if (size == 0 || strspn(*at, "+-0123456789.eE") < size) {
        return false;
    }
    char *end;
    const double value = strtod(*at, &end);
    if (end != *at + size || !isfinite(value)) {
        return false;
    }
    *at = end;
    *out = value;
    return true;
}

static srp_status wrong_unit(const mission_source *source, const char *path, const char *found,
                             mission_kind kind, srp_error *error) {
    char units[128];
    if (kind == MISSION_NUMBER) {
        return mission_fail(source, error, SRP_BAD_FORMAT, path,
                            "found '%.80s' behind the number, expected nothing", found);
    }
    list_units(kind, units, sizeof units);
    return mission_fail(source, error, SRP_BAD_FORMAT, path,
                        "found %s%.80s%s behind the number, expected a unit: %s",
                        *found != '\0' ? "'" : "", *found != '\0' ? found : "nothing",
                        *found != '\0' ? "'" : "", units);
}

srp_status mission_values(const mission_source *source, const char *path, const char *text,
                          mission_kind kind, size_t count, double *out, srp_error *error) {
    double value[4], factor = 1.0;
    if (text == NULL) {
        return SRP_OK;
    }
    const char *at = skip_blanks(text);
    for (size_t i = 0; i < count; ++i, at = skip_blanks(at)) {
        if (!read_number(&at, &value[i])) {
            return mission_fail(source, error, SRP_BAD_FORMAT, path,
                                "found '%.80s', expected %zu number%s", text, count,
                                count == 1 ? "" : "s");
        }
    }
    if (kind == MISSION_NUMBER) {
        if (*at != '\0') {
            return wrong_unit(source, path, at, kind, error);
        }
    } else {
        size_t i = 0;
        while (i < UNIT_COUNT && (UNITS[i].kind != kind || strcmp(UNITS[i].name, at) != 0)) {
            ++i;
        }
        if (i == UNIT_COUNT) {
            return wrong_unit(source, path, at, kind, error);
        }
        factor = UNITS[i].factor;
    }
    for (size_t i = 0; i < count; ++i) {
        out[i] = value[i] * factor;
    }
    return SRP_OK;
}

srp_status mission_positive(const mission_source *source, const char *path, const char *text,
                            mission_kind kind, double *out, srp_error *error) {
    double value = 1.0;
    srp_status status = mission_values(source, path, text, kind, 1, &value, error);
    if (status == SRP_OK && !(value > 0.0 && isfinite(value))) {
        return mission_fail(source, error, SRP_BAD_DATA, path, "'%s', expected a value above 0",
                            text);
    }
    if (status == SRP_OK && text != NULL) {
        *out = value;
    }
    return status;
}

srp_status mission_flag(const mission_source *source, const char *path, const char *text, bool *out,
                        srp_error *error) {
    if (text == NULL) {
        return SRP_OK;
    }
    const bool yes = strcmp(text, "true") == 0 || strcmp(text, "yes") == 0;
    if (!yes && strcmp(text, "false") != 0 && strcmp(text, "no") != 0) {
        return mission_fail(source, error, SRP_BAD_FORMAT, path,
                            "found '%.80s', expected true or false", text);
    }
    *out = yes;
    return SRP_OK;
}

srp_status mission_count(const mission_source *source, const char *path, const char *text,
                         unsigned min, unsigned max, unsigned *out, srp_error *error) {
    if (text == NULL) {
        return SRP_OK;
    }
    const size_t size = strlen(text);
    const bool whole = size <= 9 && strspn(text, "0123456789") == size;
    const unsigned long value = whole ? strtoul(text, NULL, 10) : 0;
    if (!whole || value < min || value > max) {
        return mission_fail(source, error, SRP_BAD_DATA, path,
                            "found '%.80s', expected a whole number from %u to %u", text, min, max);
    }
    *out = (unsigned)value;
    return SRP_OK;
}

srp_status mission_bits(const mission_source *source, const char *path, const char *text,
                        uint64_t *out, srp_error *error) {
    uint64_t value = 0;
    for (const char *at = text; at != NULL && *at != '\0'; ++at) {
        const unsigned digit = (unsigned)(*at - '0');
        if (digit > 9 || value > (UINT64_MAX - digit) / 10) {
            return mission_fail(source, error, SRP_BAD_DATA, path,
                                "found '%.80s', expected a whole number from 0 to 2^64 - 1", text);
        }
        value = 10 * value + digit;
    }
    if (text != NULL) {
        *out = value;
    }
    return SRP_OK;
}

char *mission_copy(const char *text) {
    const size_t size = strlen(text) + 1;
    char *copy = malloc(size);
    return copy != NULL ? memcpy(copy, text, size) : NULL;
}

char *mission_beside(const char *mission, const char *file) {
    const char *slash = strrchr(mission, '/');
    if (file[0] == '/' || slash == NULL) {
        return mission_copy(file);
    }
    const size_t head = (size_t)(slash - mission) + 1, size = head + strlen(file) + 1;
    char *path = malloc(size);
    if (path != NULL) {
        memcpy(path, mission, head);
        memcpy(path + head, file, size - head);
    }
    return path;
}
