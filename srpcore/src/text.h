/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Scanner that every reader of text shares: lines, tokens with their places, strict numbers, and
 * the words in which a reader complains. Internal.
 *
 *     srp_text text;
 *     status = srp_text_open(&text, bytes, size, name, SRP_TEXT_COMMENTS, error);
 *     while (srp_text_next_line(&text)) {
 *         status = srp_text_double(&text, "the area", &area, NULL, error);
 *         status = srp_text_end_of_line(&text, error);
 *     }
 *
 * Nothing is copied: tokens point into the text. Lines end in LF, CRLF or CR; the last one may lack
 * its end. A byte order mark of UTF-8 is skipped. Numbers are those of the C locale: readers put
 * srp_platform_c_locale_enter() around their work.
 */
#ifndef SRP_SRC_TEXT_H
#define SRP_SRC_TEXT_H

#include <srp/status.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    /* A token that begins with '#' and all that follows on its line is not there. */
    SRP_TEXT_COMMENTS = 1,
    /* A backslash at the end of a line joins the next line to it, as a blank would; not inside
     * comments. */
    SRP_TEXT_CONTINUED_LINES = 2
};

/* Longest line that is read [byte]. Longer ones are no text that a person or an exporter writes,
 * and refusing them bounds the memory that a file without line ends can take. */
enum { SRP_TEXT_LINE_MAX = 1 << 20 };

typedef struct srp_text {
    const char *name;       /* of the file, for messages */
    const char *at;         /* next byte */
    const char *end;        /* behind the last byte */
    const char *line_start; /* of the line that holds `at` */
    size_t line;            /* its number, 1-based */
    unsigned flags;
    bool inside; /* a line has been begun */
} srp_text;

/* Bytes between blanks, or, with size 0, the end of a line. */
typedef struct srp_token {
    const char *text; /* not terminated */
    size_t size;
    size_t line, column; /* 1-based; column counts bytes */
} srp_token;

/*
 * Reads a text file whole, with a 0 byte behind it; *bytes is freed by free(). Stops at the first
 * byte that shows that it is no text, so that a large binary file costs nothing.
 * SRP_NOT_FOUND, SRP_IO, SRP_NO_MEMORY, SRP_BAD_FORMAT (as srp_text_open).
 */
srp_status srp_text_read_file(const char *path, char **bytes, size_t *size, srp_error *error);

/* Begins to scan `size` bytes, which with `name` must outlive *out. SRP_BAD_FORMAT: a 0 byte
 * (binary data), UTF-16, a line longer than SRP_TEXT_LINE_MAX. */
srp_status srp_text_open(srp_text *out, const char *bytes, size_t size, const char *name,
                         unsigned flags, srp_error *error);

/* Skips what is left of this line and goes on to the next that is not blank; false at the end. */
bool srp_text_next_line(srp_text *text);
/* Takes the next token of the line; false, and a token of size 0 at the line's end, if none. */
bool srp_text_next_token(srp_text *text, srp_token *out);
/* Takes what is left of the line, without blanks at its ends: names with blanks, free text. A '#'
 * begins a comment here only with a blank (or nothing) on both sides: "Material #25" is a name. */
srp_token srp_text_rest(srp_text *text);

/* Takes the next token as a finite number. `what` completes "expected ...": "x of the vertex".
 * `where` (NULL allowed) gets the token, for complaints about the value. SRP_BAD_FORMAT. */
srp_status srp_text_double(srp_text *text, const char *what, double *out, srp_token *where,
                           srp_error *error);
/* The same for a whole number in [min, max]. */
srp_status srp_text_integer(srp_text *text, const char *what, int64_t min, int64_t max,
                            int64_t *out, srp_token *where, srp_error *error);
/* SRP_BAD_FORMAT when a token is left on the line. */
srp_status srp_text_end_of_line(srp_text *text, srp_error *error);

/* The same for a token (or a part of one) already taken. */
srp_status srp_token_double(const srp_text *text, srp_token token, const char *what, double *out,
                            srp_error *error);
srp_status srp_token_integer(const srp_text *text, srp_token token, const char *what, int64_t min,
                             int64_t max, int64_t *out, srp_error *error);

bool srp_token_is(srp_token token, const char *word);
/* The part of a token from byte `begin` up to `end`, with its own place. */
srp_token srp_token_part(srp_token token, size_t begin, size_t end);
/* A terminated copy, freed by free(); NULL without memory. */
char *srp_token_copy(srp_token token);
/* Whether the token is UTF-8 throughout. */
bool srp_token_is_utf8(srp_token token);
/* A copy for names that go into tables, which hold UTF-8: a byte that is none becomes the four
 * characters \xNN, so that different names stay different. Freed by free(); NULL without memory. */
char *srp_token_name(srp_token token);

/* A token as messages show it: quoted, bounded, bytes that do not print written as \xNN; "the end
 * of the line" for size 0. Use within one expression: srp_token_excerpt(token).text. */
typedef struct srp_excerpt {
    char text[200];
} srp_excerpt;
srp_excerpt srp_token_excerpt(srp_token token);
/* The same for a string. */
srp_excerpt srp_string_excerpt(const char *string);

/* Fails with SRP_BAD_FORMAT at `found`: "found 'x', expected EXPECTED". */
srp_status srp_text_expected(const srp_text *text, srp_token found, const char *expected,
                             srp_error *error);

/* Warnings of one kind, of which a file may have thousands: the first few are shown, the rest are
 * counted.
 *     if (srp_tally_shows(&tally)) { srp_warn_at(...); }
 *     srp_tally_close(&tally, log, name, "faces without area"); */
typedef struct srp_tally {
    size_t count;
} srp_tally;
enum { SRP_TALLY_SHOWN = 5 };
/* Counts one more; true while they are to be shown. */
bool srp_tally_shows(srp_tally *tally);
/* Warns "and 132 more WHAT" when some were not shown. */
void srp_tally_close(const srp_tally *tally, const srp_log *log, const char *name,
                     const char *what);

#endif
