/* SPDX-License-Identifier: Apache-2.0 */
/* The man page (mdoc), made from the same tables as --help. */
#ifndef SRP_CLI_MANUAL_H
#define SRP_CLI_MANUAL_H

#include <stdio.h>

void cli_manual_write(FILE *out);

#endif
