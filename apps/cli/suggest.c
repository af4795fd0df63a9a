/* SPDX-License-Identifier: Apache-2.0 */
#include "suggest.h"

#include <string.h>

enum { WORD_MAX = 63 };

static size_t least(size_t a, size_t b) {
    return a < b ? a : b;
}

/* Optimal string alignment distance: insertions, deletions, replacements and swaps of neighbours
 * that turn `a` into `b`. Words beyond WORD_MAX bytes are infinitely far. */
static size_t distance(const char *a, const char *b) {
    size_t n = strlen(a), m = strlen(b);
    if (n > WORD_MAX || m > WORD_MAX) {
        return (size_t)-1;
    }
    size_t row[3][WORD_MAX + 1];
    size_t *before = row[0], *last = row[1], *now = row[2];
    for (size_t j = 0; j <= m; ++j) {
        last[j] = j;
    }
    for (size_t i = 1; i <= n; ++i) {
        now[0] = i;
        for (size_t j = 1; j <= m; ++j) {
            size_t replaced = last[j - 1] + (a[i - 1] != b[j - 1]);
            now[j] = least(replaced, least(last[j], now[j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                now[j] = least(now[j], before[j - 2] + 1);
            }
        }
        size_t *spare = before;
        before = last;
        last = now;
        now = spare;
    }
    return last[m];
}

cli_suggestion cli_suggestion_begin(const char *wanted) {
    /* A third of the letters may be wrong, one in the shortest words. */
    cli_suggestion suggestion = {wanted, NULL, 1 + strlen(wanted) / 3};
    ++suggestion.distance;
    return suggestion;
}

void cli_suggestion_offer(cli_suggestion *suggestion, const char *word) {
    size_t d = distance(suggestion->wanted, word);
    if (d < suggestion->distance) {
        suggestion->distance = d;
        suggestion->best = word;
    }
}
