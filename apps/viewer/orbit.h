/* SPDX-License-Identifier: Apache-2.0 */
/* Missions that are run beside the window: one, or two that differ in their radiation pressure. */
#ifndef SRP_VIEWER_ORBIT_H
#define SRP_VIEWER_ORBIT_H

#include "viewer.h"

/* What came of the last run. */
typedef struct viewer_orbit {
    char *path[2]; /* mission, and the one it is compared with; NULL: none */
    char *name[2]; /* of the missions of the last run, with their models of sunlight: "geo.yaml
                      (exact)"; NULL: not run */
    size_t count;  /* rows */
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
/* Sets mission 0, or 1, which it is compared with; "" for none. */
void viewer_orbit_open(viewer *v, int which, const char *path);
void viewer_orbit_run(viewer *v);
void viewer_orbit_cancel(viewer *v);
bool viewer_orbit_is_running(const viewer *v);
/* Share of the run that is done. */
double viewer_orbit_progress(viewer *v);

/* Saves the rows as CSV; those of a difference as `srp propagate --versus` writes them. */
bool viewer_orbit_save(viewer *v, const char *path, viewer_words *problem);

#endif
