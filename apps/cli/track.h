/* SPDX-License-Identifier: Apache-2.0 */
/* Missions that are read, where a spacecraft was, row by row, and how far another was from it. */
#ifndef SRP_CLI_TRACK_H
#define SRP_CLI_TRACK_H

#include <srp/orbit/mission.h>

#include <stdbool.h>
#include <stdio.h>

/* All zeros at first. */
typedef struct cli_track {
    srp_vec3 *r, *v; /* (count) [m], [m/s] */
    double *t;       /* (count) [s] since the epoch */
    size_t count, capacity;
} cli_track;

/* Keeps a row. SRP_NO_MEMORY. */
srp_status cli_track_add(cli_track *to, const srp_mission_row *row, srp_error *error);
void cli_track_free(cli_track *t);

/* Rows i: b - a along the axes of a: x away from the centre, y along the orbit, z along its normal
 * [m]. */
srp_vec3 cli_track_difference(const cli_track *a, const cli_track *b, size_t i);
/* How far b is from a [m]. */
double cli_track_distance(const cli_track *a, const cli_track *b, size_t i);

/* CSV of rows: its names, then `t` [s], what is along the axes and the distance [m] of each. Rows
 * of one orbit are its position and the distance from the centre. */
void cli_rows_begin(FILE *out, bool is_difference);
void cli_rows_put(FILE *out, double t, srp_vec3 along, double distance);

/* Reads a mission with all that this program has: methods of every device, and the cache. Warnings
 * are said. Statuses of srp_mission_read(). */
srp_status cli_mission_read(const char *path, srp_mission **out, srp_error *error);

/* Can two missions be compared row by row: the same epoch, duration, output step, central body? An
 * exit status, said if not CLI_DONE. */
int cli_missions_check_pair(const srp_mission *a, const srp_mission *b);

#endif
