/* SPDX-License-Identifier: Apache-2.0 */
/* What `srp info` says about a table. */
#ifndef SRP_CLI_INFO_TABLE_H
#define SRP_CLI_INFO_TABLE_H

#include <stdbool.h>

/* Reads the table `path`, which may be incomplete, and prints what it is like. An exit status, said
 * if not CLI_DONE. */
int cli_info_table(const char *path, bool json);

#endif
