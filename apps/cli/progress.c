/* SPDX-License-Identifier: Apache-2.0 */
#include "progress.h"

#include "system.h"

#include <stdio.h>
#include <string.h>

static const double REDRAW_SECONDS = 0.1;
enum { BAR_MIN = 10, BAR_MAX = 40, LINE_MAX_BYTES = 512 };

void cli_progress_begin(cli_progress *progress) {
    progress->things = "nodes";
    progress->visible = cli_system_stderr_is_terminal();
    progress->shown = false;
    progress->drawn = false;
    progress->began = cli_system_seconds();
    progress->last = progress->began - REDRAW_SECONDS;
    progress->done_at_begin = 0;
}

static void format_time(char *buffer, size_t size, double seconds) {
    unsigned long long s = (unsigned long long)(seconds + 0.5);
    if (s < 3600) {
        snprintf(buffer, size, "%llu:%02llu", s / 60, s % 60);
    } else {
        snprintf(buffer, size, "%llu:%02llu:%02llu", s / 3600, s / 60 % 60, s % 60);
    }
}

void cli_progress_format(char *buffer, size_t size, int columns, double seconds, size_t done_before,
                         size_t done, size_t total, const char *things) {
    char left[32] = "", tail[128], bar[BAR_MAX + 1];
    double share = total > 0 ? (double)done / (double)total : 1.0;
    if (done > done_before) {
        double each = seconds / (double)(done - done_before);
        format_time(left, sizeof left, each * (double)(total - done));
    }
    int percent = (int)(100.0 * share);
    int tail_width =
        snprintf(tail, sizeof tail, "%3d %%  %zu of %zu %s%s%s%s", percent, done, total, things,
                 left[0] != '\0' ? ", " : "", left, left[0] != '\0' ? " left" : "");
    int room = columns - 1 - tail_width - 3; /* "[", "] " */
    if (room >= BAR_MIN) {
        int width = room < BAR_MAX ? room : BAR_MAX;
        int full = (int)(share * width);
        memset(bar, '=', (size_t)full);
        memset(bar + full, ' ', (size_t)(width - full));
        bar[width] = '\0';
        snprintf(buffer, size, "[%s] %s", bar, tail);
    } else if (tail_width <= columns - 1) {
        snprintf(buffer, size, "%s", tail);
    } else {
        snprintf(buffer, size, "%.*s", columns > 6 ? 5 : 0, tail); /* "100 %" */
    }
}

void cli_progress_clear(cli_progress *progress) {
    if (progress->drawn) {
        fputs("\r\033[K", stderr);
        fflush(stderr);
        progress->drawn = false;
    }
}

void cli_progress_show(cli_progress *progress, size_t done, size_t total) {
    double now = cli_system_seconds();
    if (!progress->shown) {
        progress->shown = true;
        progress->done_at_begin = done;
    }
    if (!progress->visible || (now - progress->last < REDRAW_SECONDS && done < total)) {
        return;
    }
    char line[LINE_MAX_BYTES];
    cli_progress_format(line, sizeof line, cli_system_stderr_columns(), now - progress->began,
                        progress->done_at_begin, done, total, progress->things);
    fprintf(stderr, "\r%s\033[K", line);
    fflush(stderr);
    progress->drawn = true;
    progress->last = now;
}
