/* SPDX-License-Identifier: Apache-2.0 */
#include "words.h"

#include "messages.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
