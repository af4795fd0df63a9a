/* SPDX-License-Identifier: Apache-2.0 */
/* Tables that a command reads: opened, and checked for what would make its result worthless. */
#ifndef SRP_CLI_TABLE_INPUT_H
#define SRP_CLI_TABLE_INPUT_H

#include <srp/table.h>

/* Reads the table `path` as cli_table_read() does, and refuses tables that are no physics: nodes
 * that are not finite, nothing but zeros, light that pulls. An exit status, said if not CLI_DONE.
 */
int cli_table_open_checked(const char *path, srp_table **out);

/* The checks alone; `path` is for messages. */
int cli_table_check(const srp_table *table, const char *path);

/* One line about a table: its title, method and steps. Writes to `buffer`, always terminated. */
void cli_table_summary(const srp_table *table, char *buffer, size_t size);

#endif
