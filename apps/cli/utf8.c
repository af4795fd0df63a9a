/* SPDX-License-Identifier: Apache-2.0 */
#include "utf8.h"

#include <string.h>

size_t cli_utf8_length(const char *text) {
    const unsigned char *p = (const unsigned char *)text;
    if (p[0] < 0x80) {
        return 1;
    }
    size_t length = p[0] >= 0xf0 ? 4 : p[0] >= 0xe0 ? 3 : 2;
    if (p[0] < 0xc2 || p[0] > 0xf4 || (p[0] == 0xe0 && p[1] < 0xa0) ||
        (p[0] == 0xed && p[1] > 0x9f) || (p[0] == 0xf0 && p[1] < 0x90) ||
        (p[0] == 0xf4 && p[1] > 0x8f)) {
        return 0;
    }
    for (size_t i = 1; i < length; ++i) {
        if ((p[i] & 0xc0) != 0x80) { /* the final 0 byte, too */
            return 0;
        }
    }
    return length;
}

size_t cli_utf8_find_bad(const char *text) {
    size_t at = 0;
    while (text[at] != '\0' && cli_utf8_length(text + at) > 0) {
        at += cli_utf8_length(text + at);
    }
    return at;
}

void cli_utf8_mend(char *text) {
    for (text += cli_utf8_find_bad(text); *text != '\0'; text += cli_utf8_find_bad(text)) {
        *text = '?';
    }
}

static char small(char letter) {
    return letter >= 'A' && letter <= 'Z' ? (char)(letter - 'A' + 'a') : letter;
}

/* Are these the same but for the case of the letters A to Z? */
static bool same_letters(const char *a, const char *b) {
    while (*a != '\0' && small(*a) == small(*b)) {
        ++a;
        ++b;
    }
    return *a == '\0' && *b == '\0';
}

bool cli_ends_with(const char *text, const char *ending) {
    size_t length = strlen(text), size = strlen(ending);
    return length > size && same_letters(text + length - size, ending);
}
