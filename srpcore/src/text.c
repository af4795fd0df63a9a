/* SPDX-License-Identifier: Apache-2.0 */
#include "text.h"

#include "error.h"
#include "platform.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Longest number that is read [byte]: more than any program prints. */
enum { NUMBER_MAX = 512 };

/* ---- Is it text at all? ------------------------------------------------------------------- */

/* Where a look through the bytes has come to. */
typedef struct probe {
    const char *name;
    size_t line, column; /* of the next byte */
    size_t total;        /* bytes seen */
    unsigned char first; /* of the whole file */
    bool after_cr;
} probe;

static void probe_begin(probe *state, const char *name) {
    *state = (probe){.name = name, .line = 1, .column = 1};
}

static srp_status probe_bytes(void *user, const char *bytes, size_t size, srp_error *error) {
    probe *state = user;
    for (size_t i = 0; i < size; i++, state->total++) {
        unsigned char byte = (unsigned char)bytes[i];
        if (state->total == 0) {
            state->first = byte;
        }
        if (state->total == 1 &&
            ((state->first == 0xff && byte == 0xfe) || (state->first == 0xfe && byte == 0xff))) {
            return srp_fail_at(error, SRP_BAD_FORMAT, state->name, 1, 1,
                               "found text in UTF-16, expected UTF-8 or ASCII");
        }
        if (byte == 0) {
            return srp_fail_at(error, SRP_BAD_FORMAT, state->name, state->line, state->column,
                               "found a zero byte: this is a binary file, expected text");
        }
        if (byte == '\n' || byte == '\r') {
            state->line += byte == '\r' || !state->after_cr;
            state->column = 1;
        } else if (state->column++ > SRP_TEXT_LINE_MAX) {
            return srp_fail_at(error, SRP_BAD_FORMAT, state->name, state->line, state->column - 1,
                               "the line is longer than %d bytes: expected text in lines",
                               (int)SRP_TEXT_LINE_MAX);
        }
        state->after_cr = byte == '\r';
    }
    return SRP_OK;
}

srp_status srp_text_read_file(const char *path, char **bytes, size_t *size, srp_error *error) {
    probe state;
    probe_begin(&state, path);
    return srp_platform_read_file(path, probe_bytes, &state, bytes, size, error);
}

srp_status srp_text_open(srp_text *out, const char *bytes, size_t size, const char *name,
                         unsigned flags, srp_error *error) {
    probe state;
    probe_begin(&state, name);
    srp_status status = probe_bytes(&state, bytes, size, error);
    if (status != SRP_OK) {
        return status;
    }
    size_t mark = size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    *out = (srp_text){.name = name,
                      .at = bytes + mark,
                      .end = bytes + size,
                      .line_start = bytes + mark,
                      .line = 1,
                      .flags = flags};
    return SRP_OK;
}

/* ---- Lines and tokens --------------------------------------------------------------------- */

static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

static bool is_line_end(char c) {
    return c == '\n' || c == '\r';
}

/* Takes the end of a line. */
static void eat_line_end(srp_text *text) {
    bool cr = *text->at == '\r';
    text->at++;
    if (cr && text->at < text->end && *text->at == '\n') {
        text->at++;
    }
    text->line++;
    text->line_start = text->at;
}

/* Is the byte at `p` a backslash that joins two lines? Blanks behind it are overlooked. */
static bool is_joint(const srp_text *text, const char *p) {
    if ((text->flags & SRP_TEXT_CONTINUED_LINES) == 0 || *p != '\\') {
        return false;
    }
    do {
        p++;
    } while (p < text->end && is_blank(*p));
    return p == text->end || is_line_end(*p);
}

static void skip_blanks(srp_text *text) {
    while (text->at < text->end) {
        if (is_blank(*text->at)) {
            text->at++;
        } else if (is_joint(text, text->at)) {
            do {
                text->at++;
            } while (text->at < text->end && is_blank(*text->at));
            if (text->at < text->end) {
                eat_line_end(text);
            }
        } else {
            return;
        }
    }
}

/* With blanks skipped: is there nothing more on this line? */
static bool at_line_end(const srp_text *text) {
    return text->at == text->end || is_line_end(*text->at) ||
           ((text->flags & SRP_TEXT_COMMENTS) != 0 && *text->at == '#');
}

static void finish_line(srp_text *text) {
    srp_token token;
    while (srp_text_next_token(text, &token)) {
    }
    while (text->at < text->end && !is_line_end(*text->at)) {
        text->at++;
    }
    if (text->at < text->end) {
        eat_line_end(text);
    }
}

bool srp_text_next_line(srp_text *text) {
    if (text->inside) {
        finish_line(text);
    }
    text->inside = true;
    for (;;) {
        skip_blanks(text);
        if (text->at == text->end) {
            return false;
        }
        if (!at_line_end(text)) {
            return true;
        }
        finish_line(text);
    }
}

bool srp_text_next_token(srp_text *text, srp_token *out) {
    skip_blanks(text);
    *out = (srp_token){
        .text = text->at, .line = text->line, .column = (size_t)(text->at - text->line_start) + 1};
    if (at_line_end(text)) {
        return false;
    }
    while (text->at < text->end && !is_blank(*text->at) && !is_line_end(*text->at) &&
           !is_joint(text, text->at)) {
        text->at++;
    }
    out->size = (size_t)(text->at - out->text);
    return true;
}

srp_token srp_text_rest(srp_text *text) {
    srp_token rest;
    skip_blanks(text);
    rest = (srp_token){
        .text = text->at, .line = text->line, .column = (size_t)(text->at - text->line_start) + 1};
    const char *stop = text->at; /* behind the last byte that is not blank */
    while (text->at < text->end && !is_line_end(*text->at) && !is_joint(text, text->at)) {
        bool alone = text->at + 1 == text->end || is_blank(text->at[1]) || is_line_end(text->at[1]);
        bool after_blank = text->at == rest.text || is_blank(text->at[-1]);
        if ((text->flags & SRP_TEXT_COMMENTS) != 0 && *text->at == '#' && alone && after_blank) {
            break;
        }
        text->at++;
        if (!is_blank(text->at[-1])) {
            stop = text->at;
        }
    }
    rest.size = (size_t)(stop - rest.text);
    return rest;
}

/* ---- Numbers ------------------------------------------------------------------------------ */

static size_t digits(const char *p, size_t size) {
    size_t n = 0;
    while (n < size && p[n] >= '0' && p[n] <= '9') {
        n++;
    }
    return n;
}

/* [+-] digits [. digits] [(e|E) [+-] digits], with a digit before or after the point: what strtod
 * takes, less hexadecimal, "inf" and "nan". */
static bool is_decimal(srp_token token) {
    const char *p = token.text, *end = p + token.size;
    p += p < end && (*p == '+' || *p == '-');
    size_t whole = digits(p, (size_t)(end - p)), part = 0;
    p += whole;
    if (p < end && *p == '.') {
        p++;
        part = digits(p, (size_t)(end - p));
        p += part;
    }
    if (whole + part == 0) {
        return false;
    }
    if (p < end && (*p == 'e' || *p == 'E')) {
        p++;
        p += p < end && (*p == '+' || *p == '-');
        size_t power = digits(p, (size_t)(end - p));
        if (power == 0) {
            return false;
        }
        p += power;
    }
    return p == end;
}

srp_status srp_token_double(const srp_text *text, srp_token token, const char *what, double *out,
                            srp_error *error) {
    if (!is_decimal(token) || token.size > NUMBER_MAX) {
        return srp_fail_at(error, SRP_BAD_FORMAT, text->name, token.line, token.column,
                           "found %s, expected a finite number: %s", srp_token_excerpt(token).text,
                           what);
    }
    char buffer[NUMBER_MAX + 1];
    memcpy(buffer, token.text, token.size);
    buffer[token.size] = '\0';
    double value = strtod(buffer, NULL);
    if (!isfinite(value)) {
        return srp_fail_at(error, SRP_BAD_FORMAT, text->name, token.line, token.column,
                           "%s is too large for a double: %s", srp_token_excerpt(token).text, what);
    }
    *out = value;
    return SRP_OK;
}

/* Value of [+-] digits, held at the ends of int64_t; false when the token is something else. */
static bool parse_integer(srp_token token, int64_t *out) {
    size_t sign = token.size > 0 && (token.text[0] == '+' || token.text[0] == '-');
    bool negative = sign == 1 && token.text[0] == '-';
    if (token.size == sign || digits(token.text + sign, token.size - sign) != token.size - sign) {
        return false;
    }
    int64_t value = 0;
    for (size_t i = sign; i < token.size; i++) {
        int digit = token.text[i] - '0';
        if (value > (INT64_MAX - digit) / 10) {
            *out = negative ? INT64_MIN : INT64_MAX;
            return true;
        }
        value = value * 10 + digit;
    }
    *out = negative ? -value : value;
    return true;
}

srp_status srp_token_integer(const srp_text *text, srp_token token, const char *what, int64_t min,
                             int64_t max, int64_t *out, srp_error *error) {
    int64_t value;
    if (!parse_integer(token, &value)) {
        return srp_fail_at(error, SRP_BAD_FORMAT, text->name, token.line, token.column,
                           "found %s, expected a whole number: %s", srp_token_excerpt(token).text,
                           what);
    }
    if (value < min || value > max) {
        return srp_fail_at(error, SRP_BAD_FORMAT, text->name, token.line, token.column,
                           "found %s, expected a whole number from %lld to %lld: %s",
                           srp_token_excerpt(token).text, (long long)min, (long long)max, what);
    }
    *out = value;
    return SRP_OK;
}

srp_status srp_text_double(srp_text *text, const char *what, double *out, srp_token *where,
                           srp_error *error) {
    srp_token token;
    srp_text_next_token(text, &token);
    if (where != NULL) {
        *where = token;
    }
    return srp_token_double(text, token, what, out, error);
}

srp_status srp_text_integer(srp_text *text, const char *what, int64_t min, int64_t max,
                            int64_t *out, srp_token *where, srp_error *error) {
    srp_token token;
    srp_text_next_token(text, &token);
    if (where != NULL) {
        *where = token;
    }
    return srp_token_integer(text, token, what, min, max, out, error);
}

srp_status srp_text_end_of_line(srp_text *text, srp_error *error) {
    srp_token token;
    if (srp_text_next_token(text, &token)) {
        return srp_text_expected(text, token, "the end of the line", error);
    }
    return SRP_OK;
}

/* ---- Tokens as words ---------------------------------------------------------------------- */

bool srp_token_is(srp_token token, const char *word) {
    return strlen(word) == token.size && memcmp(token.text, word, token.size) == 0;
}

srp_token srp_token_part(srp_token token, size_t begin, size_t end) {
    return (srp_token){.text = token.text + begin,
                       .size = end - begin,
                       .line = token.line,
                       .column = token.column + begin};
}

char *srp_token_copy(srp_token token) {
    char *copy = malloc(token.size + 1);
    if (copy != NULL) {
        memcpy(copy, token.text, token.size);
        copy[token.size] = '\0';
    }
    return copy;
}

/* Bytes of the character at `p`: 1 for ASCII, 2 to 4 for well-formed UTF-8 (Unicode 15, table 3-7),
 * 0 for anything else. */
static size_t character_length(const char *p, size_t size) {
    unsigned char c[4] = {0};
    memcpy(c, p, size < 4 ? size : 4);
    if (c[0] < 0x80) {
        return 1;
    }
    size_t length = c[0] < 0xc2 ? 0 : c[0] < 0xe0 ? 2 : c[0] < 0xf0 ? 3 : c[0] < 0xf5 ? 4 : 0;
    for (size_t i = 1; i < length; i++) {
        if ((c[i] & 0xc0) != 0x80) {
            return 0;
        }
    }
    bool overlong = (c[0] == 0xe0 && c[1] < 0xa0) || (c[0] == 0xf0 && c[1] < 0x90);
    bool outside = (c[0] == 0xed && c[1] > 0x9f) || (c[0] == 0xf4 && c[1] > 0x8f);
    return overlong || outside ? 0 : length;
}

/* The same, and 0 for control characters. */
static size_t printable_length(const char *p, size_t size) {
    size_t length = character_length(p, size);
    unsigned first = (unsigned char)p[0], second = length == 2 ? (unsigned char)p[1] : 0xff;
    bool control = (length == 1 && (first < 0x20 || first == 0x7f)) ||
                   (length == 2 && first == 0xc2 && second < 0xa0);
    return control ? 0 : length;
}

bool srp_token_is_utf8(srp_token token) {
    size_t i = 0, length = 1;
    while (i < token.size && length > 0) {
        length = character_length(token.text + i, token.size - i);
        i += length;
    }
    return length > 0;
}

char *srp_token_name(srp_token token) {
    if (srp_token_is_utf8(token)) {
        return srp_token_copy(token);
    }
    char *name = malloc(4 * token.size + 1);
    size_t used = 0, i = 0;
    while (name != NULL && i < token.size) {
        size_t length = character_length(token.text + i, token.size - i);
        if (length == 0) {
            snprintf(name + used, 5, "\\x%02x", (unsigned)(unsigned char)token.text[i]);
            used += 4;
            i++;
        } else {
            memcpy(name + used, token.text + i, length);
            used += length;
            i += length;
        }
    }
    if (name != NULL) {
        name[used] = '\0';
    }
    return name;
}

srp_excerpt srp_token_excerpt(srp_token token) {
    enum { SHOWN = 48 }; /* bytes of the token; each may become 4 */
    srp_excerpt out;
    if (token.size == 0) {
        snprintf(out.text, sizeof out.text, "the end of the line");
        return out;
    }
    size_t used = 0, i = 0;
    out.text[used++] = '\'';
    while (i < token.size && i < SHOWN) {
        size_t length = printable_length(token.text + i, token.size - i);
        if (length == 0) {
            snprintf(out.text + used, 5, "\\x%02x", (unsigned)(unsigned char)token.text[i]);
            used += 4;
            i++;
        } else if (i + length > SHOWN) {
            break;
        } else {
            memcpy(out.text + used, token.text + i, length);
            used += length;
            i += length;
        }
    }
    snprintf(out.text + used, sizeof out.text - used, "%s'", i < token.size ? "..." : "");
    return out;
}

srp_excerpt srp_string_excerpt(const char *string) {
    if (string[0] == '\0') {
        srp_excerpt empty = {"''"};
        return empty;
    }
    return srp_token_excerpt((srp_token){.text = string, .size = strlen(string)});
}

srp_status srp_text_expected(const srp_text *text, srp_token found, const char *expected,
                             srp_error *error) {
    return srp_fail_at(error, SRP_BAD_FORMAT, text->name, found.line, found.column,
                       "found %s, expected %s", srp_token_excerpt(found).text, expected);
}

bool srp_tally_shows(srp_tally *tally) {
    return tally->count++ < SRP_TALLY_SHOWN;
}

void srp_tally_close(const srp_tally *tally, const srp_log *log, const char *name,
                     const char *what) {
    if (tally->count > SRP_TALLY_SHOWN) {
        srp_warn_at(log, name, 0, 0, "and %zu more %s", tally->count - SRP_TALLY_SHOWN, what);
    }
}
