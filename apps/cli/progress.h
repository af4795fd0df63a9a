/* SPDX-License-Identifier: Apache-2.0 */
/* A bar on stderr with the time left, when stderr is a terminal; else nothing. */
#ifndef SRP_CLI_PROGRESS_H
#define SRP_CLI_PROGRESS_H

#include <stdbool.h>
#include <stddef.h>

typedef struct cli_progress {
    const char *things; /* what is counted: "nodes" unless set after the begin */
    bool visible;       /* stderr is a terminal */
    bool shown, drawn;  /* ever; on the screen now */
    double began, last; /* [s] */
    size_t done_at_begin;
} cli_progress;

void cli_progress_begin(cli_progress *progress);
/* What is done at the first call was there already: it says nothing about speed. */
void cli_progress_show(cli_progress *progress, size_t done, size_t total);
/* Leaves the line as it was before the bar. Showing draws it again. */
void cli_progress_clear(cli_progress *progress);

/* The text of the bar, for `columns` columns (its last one stays free), `seconds` after the begin.
 * Writes at most `size` bytes; empty when there is no room for anything useful. */
void cli_progress_format(char *buffer, size_t size, int columns, double seconds, size_t done_before,
                         size_t done, size_t total, const char *things);

#endif
