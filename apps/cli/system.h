/* SPDX-License-Identifier: Apache-2.0 */
/* What the command line needs from POSIX beyond getopt: terminal, signals, files. Nothing else in
 * apps/cli assumes POSIX. */
#ifndef SRP_CLI_SYSTEM_H
#define SRP_CLI_SYSTEM_H

#include <stdbool.h>
#include <stddef.h>

/* Is stderr a terminal, and how many columns does it have (80 when it does not tell)? */
bool cli_system_stderr_is_terminal(void);
int cli_system_stderr_columns(void);

/* Seconds of a clock that only goes forward. */
double cli_system_seconds(void);

/* Once, before all else: a file that grows beyond the limit of the system (ulimit -f) fails to be
 * written, as on a full disk, and does not end the program. */
void cli_system_begin(void);

/* From here on the first SIGINT, SIGTERM or SIGHUP is kept; a second one ends the program. */
void cli_system_catch_signals(void);
/* The signal that came, 0 when none did. */
int cli_system_signal_seen(void);
/* Ends the program as `signal_number` would have, so that shells and scripts see it. */
void cli_system_die_by_signal(int signal_number);

/* Can `path` be written: is it a file that may be replaced, or a name in a directory that takes new
 * files? On false *reason says why not, in words of the system or our own; a constant string. */
bool cli_system_can_write(const char *path, const char **reason);
/* Where a file that is to be called `path` must go: `path`, or what it is a link to; freed by the
 * caller, NULL without memory. *special: it is no file that another could take the place of (a
 * device, a pipe, a link to nothing yet), but one to write into. */
char *cli_system_write_target(const char *path, bool *special);
/* Are these two names of one file that exists? */
bool cli_system_same_file(const char *a, const char *b);
/* Do these two name one place for a file, whether it exists or not: one name in one directory? */
bool cli_system_same_name(const char *a, const char *b);
bool cli_system_file_exists(const char *path);

#endif
