/* SPDX-License-Identifier: Apache-2.0 */
/* The command as it could be typed into a shell again. */
#ifndef SRP_CLI_COMMAND_LINE_H
#define SRP_CLI_COMMAND_LINE_H

/* "srp " and the words of argv, quoted where a POSIX shell needs it. The long option `without`,
 * which takes no value, is left out, also when it was abbreviated. Freed by the caller; NULL
 * without memory. */
char *cli_command_line_join(int argc, char *const *argv, const char *without);

#endif
