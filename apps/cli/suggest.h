/* SPDX-License-Identifier: Apache-2.0 */
/* The word that a user may have meant. */
#ifndef SRP_CLI_SUGGEST_H
#define SRP_CLI_SUGGEST_H

#include <stddef.h>

/* Keeps the nearest of the words it has been offered. */
typedef struct cli_suggestion {
    const char *wanted;
    const char *best; /* NULL: none is near enough */
    size_t distance;
} cli_suggestion;

cli_suggestion cli_suggestion_begin(const char *wanted);
void cli_suggestion_offer(cli_suggestion *suggestion, const char *word);

#endif
