/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

const char *srp_status_string(srp_status status) {
    switch (status) {
#define SRP_STATUS_CASE(name, value, text)                                                         \
    case name:                                                                                     \
        return text;
        SRP_STATUS_LIST(SRP_STATUS_CASE)
#undef SRP_STATUS_CASE
    }
    return "unknown status";
}

size_t srp_error_format(const srp_error *error, char *buffer, size_t size) {
    int length;
    if (error->file[0] == '\0') {
        length = snprintf(buffer, size, "%s", error->message);
    } else if (error->line == 0) {
        length = snprintf(buffer, size, "%s: %s", error->file, error->message);
    } else if (error->column == 0) {
        length = snprintf(buffer, size, "%s:%zu: %s", error->file, error->line, error->message);
    } else {
        length = snprintf(buffer, size, "%s:%zu:%zu: %s", error->file, error->line, error->column,
                          error->message);
    }
    return length < 0 ? 0 : (size_t)length;
}

/* Copies a file name, keeping its end when it is too long: that is the part which tells. */
static void copy_file_name(char *out, size_t size, const char *file) {
    size_t length = strlen(file);
    if (length < size) {
        memcpy(out, file, length + 1);
        return;
    }
    memcpy(out, "...", 3);
    memcpy(out + 3, file + length - (size - 4), size - 4);
    out[size - 1] = '\0';
}

static void fill(srp_error *error, srp_status status, const char *file, size_t line, size_t column,
                 const char *format, va_list arguments) {
    error->status = status;
    copy_file_name(error->file, sizeof error->file, file);
    error->line = line;
    error->column = column;
    error->remedy = SRP_REMEDY_NONE;
    vsnprintf(error->message, sizeof error->message, format, arguments);
}

srp_status srp_fail(srp_error *error, srp_status status, const char *format, ...) {
    if (error != NULL) {
        va_list arguments;
        va_start(arguments, format);
        fill(error, status, "", 0, 0, format, arguments);
        va_end(arguments);
    }
    return status;
}

srp_status srp_fail_at(srp_error *error, srp_status status, const char *file, size_t line,
                       size_t column, const char *format, ...) {
    if (error != NULL) {
        va_list arguments;
        va_start(arguments, format);
        fill(error, status, file, line, column, format, arguments);
        va_end(arguments);
    }
    return status;
}

srp_status srp_advise(srp_error *error, srp_remedy remedy, srp_status status) {
    if (error != NULL) {
        error->remedy = remedy;
    }
    return status;
}

void srp_warn_at(const srp_log *log, const char *file, size_t line, size_t column,
                 const char *format, ...) {
    if (log == NULL || log->warn == NULL) {
        return;
    }
    srp_error what;
    va_list arguments;
    va_start(arguments, format);
    fill(&what, SRP_OK, file, line, column, format, arguments);
    va_end(arguments);
    log->warn(log->user, &what);
}
