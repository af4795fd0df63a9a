/* SPDX-License-Identifier: Apache-2.0 */
#include "json.h"

#include "numbers.h"
#include "utf8.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

static void write_string(FILE *out, const char *text) {
    fputc('"', out);
    for (const char *p = text; *p != '\0';) {
        size_t length = cli_utf8_length(p);
        if (length == 0) {
            fputs("\\ufffd", out); /* file names need not be UTF-8, JSON must */
            length = 1;
        } else if (*p == '"' || *p == '\\') {
            fprintf(out, "\\%c", *p);
        } else if ((unsigned char)*p < 0x20) {
            fprintf(out, "\\u%04x", (unsigned)*p);
        } else {
            fwrite(p, 1, length, out);
        }
        p += length;
    }
    fputc('"', out);
}

static void write_number(FILE *out, double value) {
    char buffer[CLI_NUMBER_SIZE];
    fputs(isfinite(value) ? cli_write_number(value, buffer) : "null", out);
}

/* Comma, new line, indentation and name: all that stands before a value. */
static void lead(cli_json *json, const char *name) {
    fputs(json->first ? "\n" : ",\n", json->out);
    json->first = false;
    for (int i = 0; i < json->depth; ++i) {
        fputs("  ", json->out);
    }
    if (name != NULL) {
        write_string(json->out, name);
        fputs(": ", json->out);
    }
}

static void enter(cli_json *json, char bracket) {
    fputc(bracket, json->out);
    ++json->depth;
    json->first = true;
}

static void leave(cli_json *json, char bracket) {
    --json->depth;
    if (!json->first) {
        fputc('\n', json->out);
        for (int i = 0; i < json->depth; ++i) {
            fputs("  ", json->out);
        }
    }
    fputc(bracket, json->out);
    json->first = false;
}

void cli_json_begin(cli_json *json, FILE *out) {
    json->out = out;
    json->depth = 0;
    enter(json, '{');
}

void cli_json_end(cli_json *json) {
    leave(json, '}');
    fputc('\n', json->out);
}

void cli_json_open_object(cli_json *json, const char *name) {
    lead(json, name);
    enter(json, '{');
}

void cli_json_close_object(cli_json *json) {
    leave(json, '}');
}

void cli_json_open_array(cli_json *json, const char *name) {
    lead(json, name);
    enter(json, '[');
}

void cli_json_close_array(cli_json *json) {
    leave(json, ']');
}

void cli_json_text(cli_json *json, const char *name, const char *text) {
    lead(json, name);
    if (text == NULL) {
        fputs("null", json->out);
    } else {
        write_string(json->out, text);
    }
}

void cli_json_number(cli_json *json, const char *name, double value) {
    lead(json, name);
    write_number(json->out, value);
}

void cli_json_count(cli_json *json, const char *name, uint64_t value) {
    lead(json, name);
    fprintf(json->out, "%" PRIu64, value);
}

void cli_json_flag(cli_json *json, const char *name, bool value) {
    lead(json, name);
    fputs(value ? "true" : "false", json->out);
}

void cli_json_vector(cli_json *json, const char *name, srp_vec3 value) {
    const double parts[3] = {value.x, value.y, value.z};
    lead(json, name);
    for (int i = 0; i < 3; ++i) {
        fputs(i == 0 ? "[" : ", ", json->out);
        write_number(json->out, parts[i]);
    }
    fputc(']', json->out);
}
