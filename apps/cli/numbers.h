/* SPDX-License-Identifier: Apache-2.0 */
/* Numbers as users write them: the whole text or nothing. */
#ifndef SRP_CLI_NUMBERS_H
#define SRP_CLI_NUMBERS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A finite decimal number; no blanks, no hexadecimal digits. *out is unchanged on false. */
bool cli_read_number(const char *text, double *out);
/* Exactly `count` such numbers with commas between them. */
bool cli_read_numbers(const char *text, size_t count, double *out);
/* Decimal digits alone, up to `max`. */
bool cli_read_count(const char *text, uint64_t max, uint64_t *out);

enum { CLI_NUMBER_SIZE = 32 };
/* The shortest decimal text that reads back as `value`; "nan", "inf" as C has them. Returns
 * `buffer`, of CLI_NUMBER_SIZE bytes. */
const char *cli_write_number(double value, char *buffer);

#endif
