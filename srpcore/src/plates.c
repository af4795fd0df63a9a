/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"
#include "limits.h"
#include "platform.h"
#include "text.h"

#include <srp/plates.h>

#include <math.h>
#include <stdlib.h>

static srp_status bad_value(const srp_text *text, srp_token where, const char *expected,
                            srp_error *error) {
    return srp_fail_at(error, SRP_BAD_DATA, text->name, where.line, where.column,
                       "found %s, expected %s", srp_token_excerpt(where).text, expected);
}

/* A unit vector along v; scaled first, so that no square over- or underflows. */
static srp_vec3 unit_of(srp_vec3 v) {
    double largest = srp_vec3_largest(v);
    srp_vec3 scaled = srp_vec3_make(v.x / largest, v.y / largest, v.z / largest);
    return srp_vec3_scale(1.0 / srp_vec3_norm(scaled), scaled);
}

/* nx ny nz area rho_s rho_d */
static srp_status read_plate(srp_text *text, srp_plate *out, srp_error *error) {
    static const char *const what[6] = {"x of the normal",          "y of the normal",
                                        "z of the normal",          "the area [m^2]",
                                        "the specular share rho_s", "the diffuse share rho_d"};
    double value[6] = {0.0};
    srp_token where[6];
    for (int i = 0; i < 6; i++) {
        srp_status status = srp_text_double(text, what[i], &value[i], &where[i], error);
        if (status != SRP_OK) {
            return status;
        }
    }
    srp_status status = srp_text_end_of_line(text, error);
    if (status != SRP_OK) {
        return status;
    }
    if (value[0] == 0.0 && value[1] == 0.0 && value[2] == 0.0) {
        return srp_fail_at(error, SRP_BAD_DATA, text->name, where[0].line, where[0].column,
                           "the normal is 0 0 0, expected a direction");
    }
    if (!(value[3] > 0.0 && value[3] <= SRP_AREA_MAX)) {
        return bad_value(text, where[3],
                         value[3] > 0.0 ? "an area of at most 1e60 m^2" : "an area above 0 m^2",
                         error);
    }
    for (int i = 4; i < 6; i++) {
        if (value[i] < 0.0 || value[i] > 1.0) {
            return bad_value(text, where[i], i == 4 ? "rho_s from 0 to 1" : "rho_d from 0 to 1",
                             error);
        }
    }
    srp_plate plate = {.normal = unit_of(srp_vec3_make(value[0], value[1], value[2])),
                       .area = value[3],
                       .optics = {value[4], value[5], false}};
    if (srp_optics_check(plate.optics, NULL) != SRP_OK) {
        return srp_fail_at(error, SRP_BAD_DATA, text->name, where[5].line, where[5].column,
                           "rho_s + rho_d is %g, expected at most 1 (the rest is absorbed)",
                           value[4] + value[5]);
    }
    *out = plate;
    return SRP_OK;
}

/* Appends a plate to a list that doubles: the count in the file is not trusted with memory. */
static srp_status append(srp_plate **list, size_t *capacity, size_t used, srp_plate plate,
                         srp_error *error) {
    if (used == *capacity) {
        size_t wanted = *capacity == 0 ? 16 : 2 * *capacity;
        srp_plate *larger = realloc(*list, wanted * sizeof *larger);
        if (larger == NULL) {
            return srp_fail(error, SRP_NO_MEMORY, "no memory for %zu plates", used + 1);
        }
        *list = larger;
        *capacity = wanted;
    }
    (*list)[used] = plate;
    return SRP_OK;
}

static srp_status read_count(srp_text *text, int64_t *count, srp_error *error) {
    if (!srp_text_next_line(text)) {
        return srp_fail_at(error, SRP_BAD_FORMAT, text->name, 0, 0,
                           "the file is empty, expected the number of plates on its first line");
    }
    srp_status status =
        srp_text_integer(text, "the number of plates", 1, UINT32_MAX, count, NULL, error);
    return status == SRP_OK ? srp_text_end_of_line(text, error) : status;
}

static srp_status read_plates(srp_text *text, srp_plate **list, size_t *used, srp_error *error) {
    size_t capacity = 0;
    int64_t count = 0;
    srp_status status = read_count(text, &count, error);
    while (status == SRP_OK && srp_text_next_line(text)) {
        srp_plate plate = {.area = 0.0};
        if ((int64_t)*used == count) {
            srp_token token;
            srp_text_next_token(text, &token);
            return srp_fail_at(error, SRP_BAD_FORMAT, text->name, token.line, token.column,
                               "found more lines than plates: the first line says %zu", *used);
        }
        status = read_plate(text, &plate, error);
        if (status == SRP_OK) {
            status = append(list, &capacity, *used, plate, error);
        }
        *used += status == SRP_OK;
    }
    if (status == SRP_OK && (int64_t)*used < count) {
        return srp_fail_at(error, SRP_BAD_FORMAT, text->name, text->line, 0,
                           "the file ends after %zu of %lld plates", *used, (long long)count);
    }
    return status;
}

srp_status srp_plates_parse(const char *text, size_t size, const char *name, srp_plate **out,
                            size_t *count, srp_error *error) {
    srp_text scanner;
    srp_status status = srp_text_open(&scanner, text, size, name, SRP_TEXT_COMMENTS, error);
    if (status != SRP_OK) {
        return status;
    }
    srp_plate *list = NULL;
    size_t used = 0;
    srp_c_locale locale = srp_platform_c_locale_enter();
    status = read_plates(&scanner, &list, &used, error);
    srp_platform_c_locale_leave(locale);
    if (status != SRP_OK) {
        free(list);
        return status;
    }
    *out = list;
    *count = used;
    return SRP_OK;
}

srp_status srp_plates_read(const char *path, srp_plate **out, size_t *count, srp_error *error) {
    char *text;
    size_t size;
    srp_status status = srp_text_read_file(path, &text, &size, error);
    if (status != SRP_OK) {
        return status;
    }
    status = srp_plates_parse(text, size, path, out, count, error);
    free(text);
    return status;
}

void srp_plates_free(srp_plate *plates) {
    free(plates);
}
