/* SPDX-License-Identifier: Apache-2.0 */
/* Filling in an srp_error. Internal. */
#ifndef SRP_SRC_ERROR_H
#define SRP_SRC_ERROR_H

#include <srp/status.h>

/* Sets *error (may be NULL) and returns `status`, so that a failure is one line:
 *     return srp_fail(error, SRP_NO_MEMORY, "no memory for %zu vertices", count); */
srp_status srp_fail(srp_error *error, srp_status status, const char *format, ...) SRP_PRINTF(3, 4);

/* The same with the place in a file; line and column 0 = does not apply. */
srp_status srp_fail_at(srp_error *error, srp_status status, const char *file, size_t line,
                       size_t column, const char *format, ...) SRP_PRINTF(6, 7);

/* Adds what would help, and returns the status: return srp_advise(error, REMEDY, srp_fail(...)); */
srp_status srp_advise(srp_error *error, srp_remedy remedy, srp_status status);

/* Sends a warning to `log` (may be NULL). */
void srp_warn_at(const srp_log *log, const char *file, size_t line, size_t column,
                 const char *format, ...) SRP_PRINTF(5, 6);

#endif
