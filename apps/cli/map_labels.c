/* SPDX-License-Identifier: Apache-2.0 */
#include "map_labels.h"

#include <srp/const.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

/* theta of Mollweide's projection: 2 theta + sin 2 theta = pi sin el (Snyder, Map Projections,
 * 1987, eq. 31-3), by bisection and Newton steps. */
static double mollweide_angle(double el) {
    double want = SRP_PI * sin(el), theta = el;
    if (fabs(el) > 0.5 * SRP_PI - 1e-12) {
        return el;
    }
    double low = -0.5 * SRP_PI, high = 0.5 * SRP_PI;
    for (int k = 0; k < 60; ++k) {
        double off = 2.0 * theta + sin(2.0 * theta) - want;
        *(off > 0.0 ? &high : &low) = theta;
        double slope = 2.0 + 2.0 * cos(2.0 * theta), next = theta - off / slope;
        theta = next > low && next < high ? next : 0.5 * (low + high);
    }
    return theta;
}

void cli_map_place(double az_deg, double el_deg, bool mollweide, double *x, double *y) {
    *x = az_deg;
    *y = el_deg;
    if (mollweide) {
        double theta = mollweide_angle(el_deg * SRP_RAD_PER_DEG);
        *x = az_deg * cos(theta);
        *y = 90.0 * sin(theta);
    }
}

/* Numbers of one contour, and degrees between places that are tried. */
enum { LABELS_OF_LEVEL = 4, SCAN = 3 };
/* Of numbers of one contour, and between contours where there is room for a number. */
static const double APART = 75.0, ROOM = 6.0;

static bool is_on_map(double x, double y, bool mollweide) {
    if (mollweide) {
        return x * x / (180.0 * 180.0) + y * y / (90.0 * 90.0) < 0.96;
    }
    return fabs(x) < 168.0 && fabs(y) < 81.0; /* off the marks at the frame */
}

/* Is all of the label on the map? */
static bool is_whole(const cli_map_label *l, bool mollweide) {
    return is_on_map(l->x - l->half, l->y - CLI_MAP_LABEL_HALF, mollweide) &&
           is_on_map(l->x + l->half, l->y - CLI_MAP_LABEL_HALF, mollweide) &&
           is_on_map(l->x - l->half, l->y + CLI_MAP_LABEL_HALF, mollweide) &&
           is_on_map(l->x + l->half, l->y + CLI_MAP_LABEL_HALF, mollweide);
}

/* How good a place is: how far from other labels, and how wide the space between contours is there.
 * Below 0: none. */
static double merit_of(const cli_map_field *f, const cli_map_labels *all, const cli_map_label *l,
                       double space) {
    double nearest = APART;
    if (!is_whole(l, f->mollweide) || space < ROOM) {
        return -1.0;
    }
    for (int k = 0; k < all->count; ++k) {
        const cli_map_label *other = &all->at[k];
        double dx = fabs(l->x - other->x), dy = 2.0 * fabs(l->y - other->y);
        if (dx < l->half + other->half + 3.0 && dy < 4.0 * CLI_MAP_LABEL_HALF + 2.0) {
            return -1.0;
        }
        double distance = hypot(dx, dy);
        if (other->level == l->level && distance < APART) {
            return -1.0;
        }
        nearest = fmin(nearest, distance);
    }
    return nearest + fmin(space, 4.0 * ROOM);
}

/* Degrees between contours about a place. */
static double space_at(const cli_map_field *f, double az, double el, double step) {
    const double h = 2.0;
    double east = fmin(az + h, 180.0), west = fmax(az - h, -180.0);
    double north = fmin(el + h, 90.0), south = fmax(el - h, -90.0);
    double dx = (f->value(f->data, east, el) - f->value(f->data, west, el)) / (east - west);
    double dy = (f->value(f->data, az, north) - f->value(f->data, az, south)) / (north - south);
    double slope = hypot(dx, dy);
    return slope > 0.0 ? step / slope : 360.0;
}

/* Takes the place between two directions where the field has the level of `l`, if it is better. */
static void try_between(const cli_map_field *f, const cli_map_labels *all, double step,
                        const double from[2], const double to[2], cli_map_label *l,
                        cli_map_label *best, double *merit) {
    double a = f->value(f->data, from[0], from[1]) - l->level,
           b = f->value(f->data, to[0], to[1]) - l->level;
    if (!(a * b < 0.0)) { /* nor at the edge of a plateau, where no line is */
        return;
    }
    double share = a / (a - b), az = from[0] + share * (to[0] - from[0]),
           el = from[1] + share * (to[1] - from[1]);
    cli_map_place(az, el, f->mollweide, &l->x, &l->y);
    double good = merit_of(f, all, l, space_at(f, az, el, step));
    if (good > *merit) {
        *merit = good;
        *best = *l;
    }
}

/* One label more for a contour, if there is a place. */
static void add_label(const cli_map_field *f, cli_map_labels *all, double level, double step) {
    cli_map_label l = {.level = level}, best = l;
    double merit = -0.5;
    snprintf(l.text, sizeof l.text, "%g", level);
    l.half = 0.5 * CLI_MAP_LETTER * (double)strlen(l.text);
    /* Not along lines of nodes: contours may lie on them. */
    for (double az = -179.3; az + SCAN < 180.0; az += SCAN) {
        for (double el = -89.3; el + SCAN < 90.0; el += SCAN) {
            const double at[2] = {az, el}, east[2] = {az + SCAN, el}, north[2] = {az, el + SCAN};
            try_between(f, all, step, at, east, &l, &best, &merit);
            try_between(f, all, step, at, north, &l, &best, &merit);
        }
    }
    if (merit >= 0.0) {
        all->at[all->count++] = best;
    }
}

/* Numbers of the equator, which the frame has (figure_map.c). */
static void keep_off_equator(cli_map_labels *all) {
    for (int az = -90; az <= 90; az += 90) {
        all->at[all->count++] = (cli_map_label){az, 0.0, 1.5 * CLI_MAP_LETTER, (double)NAN, ""};
    }
}

void cli_map_label_contours(const cli_map_field *f, const double *level, int count, double step,
                            cli_map_labels *out) {
    int kept = 0;
    out->count = 0;
    if (f->mollweide) {
        keep_off_equator(out);
        kept = out->count;
    }
    for (int turn = 0; turn < LABELS_OF_LEVEL; ++turn) {
        for (int k = 0; k < count && out->count < CLI_MAP_LABELS_MAX; ++k) {
            add_label(f, out, level[k], step);
        }
    }
    out->count -= kept;
    memmove(out->at, out->at + kept, (size_t)out->count * sizeof *out->at);
}
