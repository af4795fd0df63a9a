/* SPDX-License-Identifier: Apache-2.0 */
#include "command_line.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

static const char PLAIN[] =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%^";

static char *append(char *to, const char *text) {
    size_t length = strlen(text);
    memcpy(to, text, length);
    return to + length;
}

/* In single quotes, with each single quote as '\''. */
static char *append_quoted(char *to, const char *word) {
    *to++ = '\'';
    for (; *word != '\0'; ++word) {
        if (*word == '\'') {
            to = append(to, "'\\''");
        } else {
            *to++ = *word;
        }
    }
    *to++ = '\'';
    return to;
}

char *cli_command_line_join(int argc, char *const *argv, const char *without) {
    size_t size = sizeof "srp";
    for (int i = 0; i < argc; ++i) {
        size += 4 * strlen(argv[i]) + 3;
    }
    char *line = malloc(size), *end = line;
    if (line == NULL) {
        return NULL;
    }
    end = append(end, "srp");
    bool options = true; /* no "--" yet */
    for (int i = 0; i < argc; ++i) {
        options = options && strcmp(argv[i], "--") != 0;
        if (options && strcmp(argv[i], without) == 0) {
            continue;
        }
        *end++ = ' ';
        bool plain = argv[i][0] != '\0' && argv[i][strspn(argv[i], PLAIN)] == '\0';
        end = plain ? append(end, argv[i]) : append_quoted(end, argv[i]);
    }
    *end = '\0';
    return line;
}
