/* SPDX-License-Identifier: Apache-2.0 */
/* Plates that are fitted to a table, with words about what stands in the way. */
#ifndef SRP_CLI_TABLE_FIT_H
#define SRP_CLI_TABLE_FIT_H

#include "plate_fit.h"

/* Searches `count` normals (count) for a table, of which `samples` are all directions. `name` is
 * for messages. An exit status, said if neither CLI_DONE nor cancelled, as is the other's. */
int cli_table_search(const srp_table *table, const char *name, const cli_samples *samples,
                     size_t count, const cli_fit_watch *watch, srp_vec3 *normals);
/* Fits plates with these normals; *out is freed by cli_plate_fit_free(), and as it was unless done.
 */
int cli_table_fit(const char *name, const cli_samples *samples, size_t count,
                  const srp_vec3 *normals, const cli_fit_watch *watch, cli_plate_fit *out);
/* Says what a fit of so many plates came to; its exit status. */
int cli_table_explain(const char *name, const cli_samples *samples, cli_fit_status status,
                      size_t plates);

#endif
