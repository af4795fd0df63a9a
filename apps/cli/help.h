/* SPDX-License-Identifier: Apache-2.0 */
/* Help texts, made from the tables of commands and options. */
#ifndef SRP_CLI_HELP_H
#define SRP_CLI_HELP_H

#include "command.h"

#include <stdio.h>

void cli_help_version(FILE *out);
/* The program as a whole. */
void cli_help_program(FILE *out);
void cli_help_command(FILE *out, const cli_command *command);

/* Writes `text` in lines of at most CLI_HELP_WIDTH columns, the first beginning at column `column`,
 * the others at `indent`. "\n\n" begins a paragraph. Ends the last line. */
enum { CLI_HELP_WIDTH = 79 };
void cli_help_wrap(FILE *out, const char *text, int column, int indent);

#endif
