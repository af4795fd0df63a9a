/* SPDX-License-Identifier: Apache-2.0 */
/* Small things that all of the viewer's model needs: texts, and messages that are collected. */
#ifndef SRP_VIEWER_WORDS_H
#define SRP_VIEWER_WORDS_H

#include <srp/status.h>

#include <stdbool.h>
#include <stddef.h>

/* Said where one is needed. */
extern const char VIEWER_NO_TABLE[], VIEWER_NO_SPACECRAFT[];

/* A copy, freed by free(); NULL for NULL and without memory. */
char *viewer_text_copy(const char *text);
/* Are both the same, or none? Either may be NULL. */
bool viewer_text_same(const char *a, const char *b);

/* A copy of a file's name that ends with the same ending once: "a.nc" for "a.nc.nc", which is typed
 * over the part that a dialog selects. */
char *viewer_text_end_once(const char *name);

/* What went wrong or is worth a warning: sentences, one a line. Put one on the stack, all zeros. */
enum { VIEWER_WORDS_SIZE = 2048 };
typedef struct viewer_words {
    char text[VIEWER_WORDS_SIZE];
} viewer_words;

void viewer_words_add(viewer_words *words, const char *line);
/* "file:line:column: message" of an error. */
void viewer_words_add_error(viewer_words *words, const srp_error *error);

/* `text` for people who see fields and no command line: "--grid 0: expected ..." becomes "Grid 0:
 * expected ...", and "needs --area M2" becomes "needs Area". */
void viewer_words_for_window(const char *text, char *out, size_t size);
/* The window's name of METHOD_...: "Grid". */
void viewer_words_method_field(int option, char *out, size_t size);

/* From here on what this thread says (messages.h) is collected in `words`; NULL: goes to stderr. */
void viewer_words_listen(viewer_words *words);

#endif
