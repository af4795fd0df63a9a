/* SPDX-License-Identifier: Apache-2.0 */
/* Writes JSON (RFC 8259), one value at a time, indented. A `name` of NULL stands for an element of
 * an array. Numbers are the shortest that read back the same; what is not finite becomes null. */
#ifndef SRP_CLI_JSON_H
#define SRP_CLI_JSON_H

#include <srp/vec3.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef struct cli_json {
    FILE *out;
    int depth;
    bool first; /* nothing yet in the innermost object or array */
} cli_json;

void cli_json_begin(cli_json *json, FILE *out); /* opens the outermost object */
void cli_json_end(cli_json *json);

void cli_json_open_object(cli_json *json, const char *name);
void cli_json_close_object(cli_json *json);
void cli_json_open_array(cli_json *json, const char *name);
void cli_json_close_array(cli_json *json);
void cli_json_text(cli_json *json, const char *name, const char *text); /* NULL: null */
void cli_json_number(cli_json *json, const char *name, double value);
void cli_json_count(cli_json *json, const char *name, uint64_t value);
void cli_json_flag(cli_json *json, const char *name, bool value);
void cli_json_vector(cli_json *json, const char *name, srp_vec3 value);

#endif
