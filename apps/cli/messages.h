/* SPDX-License-Identifier: Apache-2.0 */
/* What the program says on stderr, and the exit status that follows from it. */
#ifndef SRP_CLI_MESSAGES_H
#define SRP_CLI_MESSAGES_H

#include "command.h"

#include <srp/status.h>

/* Messages without a file begin with this: "srp table". A constant string. */
void cli_messages_begin(const char *program);

/* Where the messages of this thread go: to `take`, a line each, without the program's name; NULL:
 * to stderr, as at the start. For programs with a window. */
typedef void (*cli_message_taker)(void *user, const char *text);
void cli_messages_to(cli_message_taker take, void *user);

/* Words on stderr, with the program's name in front. */
void cli_say(const char *format, ...) SRP_PRINTF(1, 2);
/* The same about a file, which the words begin with: no name in front. */
void cli_say_of_file(const char *format, ...) SRP_PRINTF(1, 2);
/* The same, and how to get help. Returns CLI_BAD_USAGE. */
int cli_usage_error(const char *format, ...) SRP_PRINTF(1, 2);
/* "--grid x: expected ..."; false, for setters of options. */
bool cli_reject(const cli_option *option, const char *text, const char *expected);

/* The word that goes with a number: cli_form(1, "triangle", "triangles"). */
static inline const char *cli_form(size_t count, const char *one, const char *many) {
    return count == 1 ? one : many;
}

/* What went wrong, as "file:line:column: message", and the exit status for it: something was read,
 * or asked of the library with values from the command line ... */
int cli_input_error(const srp_error *error);
/* ... or written. */
int cli_output_error(const srp_error *error);

/* Sends the library's warnings to stderr. */
srp_log cli_log(void);

#endif
