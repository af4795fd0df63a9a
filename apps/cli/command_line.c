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

/* getopt_long() takes any beginning of a long name that no other option shares. With two letters of
 * it nothing else is meant that starts so, or parsing would have failed. */
static bool means(const char *word, const char *option) {
    size_t length = strlen(word);
    return length > 4 && strncmp(word, option, length) == 0;
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
        if (options && means(argv[i], without)) {
            continue;
        }
        *end++ = ' ';
        bool plain = argv[i][0] != '\0' && argv[i][strspn(argv[i], PLAIN)] == '\0';
        end = plain ? append(end, argv[i]) : append_quoted(end, argv[i]);
    }
    *end = '\0';
    return line;
}
