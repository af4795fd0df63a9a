/* SPDX-License-Identifier: Apache-2.0 */
#include "words.h"

#include "messages.h"
#include "method_options.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char VIEWER_NO_TABLE[] = "There is no table yet: compute or open one.";
const char VIEWER_NO_SPACECRAFT[] = "There is no spacecraft yet: open one.";

char *viewer_text_copy(const char *text) {
    if (text == NULL) {
        return NULL;
    }
    size_t size = strlen(text) + 1;
    char *copy = malloc(size);
    if (copy != NULL) {
        memcpy(copy, text, size);
    }
    return copy;
}

bool viewer_text_same(const char *a, const char *b) {
    return a == b || (a != NULL && b != NULL && strcmp(a, b) == 0);
}

char *viewer_text_end_once(const char *name) {
    char *copy = viewer_text_copy(name);
    const char *dot = copy != NULL ? strrchr(copy, '.') : NULL;
    size_t length = dot != NULL ? strlen(dot) : 0, before = dot != NULL ? (size_t)(dot - copy) : 0;
    if (length > 1 && before > length && strncmp(dot - length, dot, length) == 0) {
        copy[before] = '\0';
    }
    return copy;
}

void viewer_words_add(viewer_words *words, const char *line) {
    size_t used = strlen(words->text);
    snprintf(words->text + used, sizeof words->text - used, "%s%s", used > 0 ? "\n" : "", line);
}

void viewer_words_add_error(viewer_words *words, const srp_error *error) {
    char text[VIEWER_WORDS_SIZE];
    srp_error_format(error, text, sizeof text);
    viewer_words_add(words, text);
}

static void take(void *user, const char *text) {
    viewer_words_add(user, text);
}

void viewer_words_listen(viewer_words *words) {
    cli_messages_to(words != NULL ? take : NULL, words);
}

/* ---- for the window ---- */

static const cli_option MASS = {.name = "mass", .value = "KG"};

static const cli_option *option_in(const cli_group *group, size_t count, const char *name,
                                   size_t length) {
    for (size_t i = 0; i < count; ++i) {
        const cli_option *option = &group->options[i];
        if (strlen(option->name) == length && strncmp(option->name, name, length) == 0) {
            return option;
        }
    }
    return NULL;
}

/* The option that has a field in the window; NULL: it has none. */
static const cli_option *find_option(const char *name, size_t length) {
    const cli_option *option = option_in(&cli_group_model, MODEL_OPTION_COUNT, name, length);
    if (option == NULL) {
        option = option_in(&cli_group_method, METHOD_OPTION_COUNT, name, length);
    }
    return option == NULL && length == 4 && strncmp(name, "mass", 4) == 0 ? &MASS : option;
}

/* Its own name with a capital, where the window has no other. */
static void field_of(const cli_option *option, char *out, size_t size) {
    static const char *const other[][2] = {{"material", "Materials"},
                                           {"plates", "a file by Choose Plates…"},
                                           {"reference", "Moments about"}};
    for (size_t i = 0; i < sizeof other / sizeof other[0]; ++i) {
        if (strcmp(option->name, other[i][0]) == 0) {
            snprintf(out, size, "%s", other[i][1]);
            return;
        }
    }
    snprintf(out, size, "%s", option->name);
    out[0] = (char)toupper((unsigned char)out[0]);
}

void viewer_words_method_field(int option, char *out, size_t size) {
    field_of(&cli_group_method.options[option], out, size);
}

/* How much of `text` is the placeholder of a value, " KG". */
static size_t placeholder(const cli_option *option, const char *text) {
    size_t length = option->value != NULL ? strcspn(option->value, "[") : 0;
    if (length == 0 || text[0] != ' ' || strncmp(text + 1, option->value, length) != 0 ||
        isalnum((unsigned char)text[1 + length])) {
        return 0;
    }
    return 1 + length;
}

void viewer_words_for_window(const char *text, char *out, size_t size) {
    size_t used = 0;
    while (*text != '\0' && used + 1 < size) {
        size_t length = 0;
        char field[48];
        if (strncmp(text, "--", 2) == 0) {
            length = strspn(text + 2, "abcdefghijklmnopqrstuvwxyz-");
        }
        const cli_option *option = length > 0 ? find_option(text + 2, length) : NULL;
        if (option == NULL) {
            out[used++] = *text++;
            continue;
        }
        field_of(option, field, sizeof field);
        text += 2 + length;
        text += placeholder(option, text);
        snprintf(out + used, size - used, "%s", field);
        used += strlen(out + used);
    }
    out[used] = '\0';
}
