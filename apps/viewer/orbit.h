/* SPDX-License-Identifier: Apache-2.0 */
/* Missions that are run beside the window: one, or two that differ in their radiation pressure. */
#ifndef SRP_VIEWER_ORBIT_H
#define SRP_VIEWER_ORBIT_H

#include "viewer.h"

/* The missions that are chosen, and what came of their run. */
typedef struct viewer_orbit {
    char *path[2]; /* mission, and the one it is compared with; NULL: none */
    char *name[2]; /* of both, with their models of sunlight: "geo.yaml (exact)" */
    size_t count;  /* rows; 0: these missions have not been run, or in vain */
    double *t;     /* (count) [s] */
    double
        *value[4]; /* (count each) [m] radial, along, cross, distance of the second from the first;
                      of one mission alone: its position, and its distance from the centre */
    bool is_difference;
    bool is_identical; /* the differences are 0 everywhere */
    char summary[400];
    double seconds; /* it took */
} viewer_orbit;

/* What the session has; never NULL. */
const viewer_orbit *viewer_orbit_get(viewer *v);
/* Reads mission 0, or 1, which it is compared with, beside the window, and chooses it if it is one;
 * "" for none. Another choice ends the run of the last one and takes away what came of it. */
void viewer_orbit_open(viewer *v, int which, const char *path);
/* As soon as missions that are being read have been. */
void viewer_orbit_run(viewer *v);
/* Missions that are being read are not chosen, too. */
void viewer_orbit_cancel(viewer *v);
/* Or about to run: missions are being read. */
bool viewer_orbit_is_running(const viewer *v);
bool viewer_orbit_is_cancelling(const viewer *v);
/* Share of the run that is done. */
double viewer_orbit_progress(viewer *v);

/* Saves the rows as CSV; those of a difference as `srp propagate --versus` writes them. */
bool viewer_orbit_save(viewer *v, const char *path, viewer_words *problem);

#endif
