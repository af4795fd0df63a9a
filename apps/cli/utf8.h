/* SPDX-License-Identifier: Apache-2.0 */
/* Text in UTF-8 (RFC 3629, section 4), and bytes that are not. */
#ifndef SRP_CLI_UTF8_H
#define SRP_CLI_UTF8_H

#include <stdbool.h>
#include <stddef.h>

/* Bytes of the sequence that begins at `p`, in a string that ends in a 0 byte; 0 when it is none.
 */
size_t cli_utf8_length(const char *p);
/* Place of the first byte that is not UTF-8; that of the final 0 byte when all are. */
size_t cli_utf8_find_bad(const char *text);
/* Puts '?' in place of each such byte: names of files may hold any. */
void cli_utf8_mend(char *text);

/* Does a longer text end with this, but for the case of the letters A to Z? */
bool cli_ends_with(const char *text, const char *ending);

#endif
