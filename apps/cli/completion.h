/* SPDX-License-Identifier: Apache-2.0 */
/* The completion of bash, made from the same tables as --help. */
#ifndef SRP_CLI_COMPLETION_H
#define SRP_CLI_COMPLETION_H

#include <stdio.h>

void cli_completion_write(FILE *out);

#endif
