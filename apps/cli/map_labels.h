/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Numbers at the contours of a map. PLplot's own are cut by the frame and lie on each other; these
 * are level, whole and apart. Lengths are in degrees of the map, which is 360 wide and 180 high.
 */
#ifndef SRP_CLI_MAP_LABELS_H
#define SRP_CLI_MAP_LABELS_H

#include <stdbool.h>

enum { CLI_MAP_LABELS_MAX = 96 };

/* Width of a letter and half the height of a number, of the size that they are drawn in. */
#define CLI_MAP_LABEL_SIZE 0.68
#define CLI_MAP_LETTER 5.2
#define CLI_MAP_LABEL_HALF 4.0

/* A field over all directions, and the map that it is drawn on. */
typedef struct cli_map_field {
    double (*value)(const void *data, double az_deg, double el_deg);
    const void *data;
    bool mollweide; /* else azimuth and elevation are x and y */
} cli_map_field;

typedef struct cli_map_label {
    double x, y, half; /* middle, half of its width */
    double level;
    char text[16];
} cli_map_label;

typedef struct cli_map_labels {
    cli_map_label at[CLI_MAP_LABELS_MAX];
    int count;
} cli_map_labels;

/* Where a direction is on the map: degrees, or for Mollweide's an ellipse of the same size. */
void cli_map_place(double az_deg, double el_deg, bool mollweide, double *x, double *y);

/* Places numbers at the contours of `level` (count), which are `step` apart, up to four each: whole
 * within the map, off each other, and where contours leave room. */
void cli_map_label_contours(const cli_map_field *field, const double *level, int count, double step,
                            cli_map_labels *out);

#endif
