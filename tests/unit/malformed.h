/* SPDX-License-Identifier: Apache-2.0 */
/* Tables of texts that a reader must refuse, and a log that keeps what it is told. */
#ifndef SRP_TEST_MALFORMED_H
#define SRP_TEST_MALFORMED_H

#include "srp_check.h"

#include <srp/status.h>

#include <string.h>

typedef struct malformed {
    const char *why;
    const char *text;
    size_t size;
    srp_status status;
    const char *message; /* the whole of it, as srp_error_format() writes it for a file "f" */
} malformed;

/* For texts in string literals, which may hold 0 bytes. */
#define MALFORMED(why, text, status, message)                                                      \
    { why, text, sizeof(text) - 1, status, message }

/* The reader refused `wanted` as it should. */
static inline void assert_refused(const malformed *wanted, srp_status status,
                                  const srp_error *error) {
    char words[2048] = "no error";
    if (status != SRP_OK) {
        srp_error_format(error, words, sizeof words);
    }
    ck_assert_msg(status == wanted->status, "%s: status %d (%s), expected %d", wanted->why, status,
                  words, wanted->status);
    ck_assert_int_eq(error->status, status);
    ck_assert_msg(strcmp(words, wanted->message) == 0, "%s:\n   got: %s\nwanted: %s", wanted->why,
                  words, wanted->message);
}

/* Warnings, formatted, in the order in which they came; those beyond the last are only counted. */
typedef struct log_keeper {
    size_t count;
    char text[32][1024];
} log_keeper;

static inline void log_keeper_warn(void *user, const srp_error *what) {
    log_keeper *keeper = user;
    if (keeper->count < 32) {
        srp_error_format(what, keeper->text[keeper->count], sizeof keeper->text[0]);
    }
    ++keeper->count;
}

/* Did a warning hold `part`? */
static inline bool log_keeper_has(const log_keeper *keeper, const char *part) {
    for (size_t i = 0; i < keeper->count && i < 32; ++i) {
        if (strstr(keeper->text[i], part) != NULL) {
            return true;
        }
    }
    return false;
}

#endif
