/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What a setup comes to: files read (shape), optics joined, method prepared (engine). Both are
 * frozen once made, are counted references, and may be used by several threads at once.
 */
#ifndef SRP_VIEWER_ENGINE_H
#define SRP_VIEWER_ENGINE_H

#include "info.h"
#include "setup.h"

#include <srp/method.h>
#include <srp/scene.h>

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

/* An OBJ file, as `srp info` sees it. */
typedef struct viewer_shape {
    atomic_int references;
    char *path, *unit; /* unit NULL: metres */
    cli_info info;
} viewer_shape;

/* Reads the model of the setup. NULL: it cannot be read, and `said` has why; else it has warnings.
 * Any thread. */
viewer_shape *viewer_shape_read(const viewer_setup *setup, viewer_words *said);
viewer_shape *viewer_shape_reference(viewer_shape *shape); /* may be NULL, as the next */
void viewer_shape_release(viewer_shape *shape);

typedef struct viewer_engine {
    atomic_int references;
    const viewer_setup *setup; /* that it was made for, but for the mass, which it does not need */
    viewer_shape *shape;       /* NULL: no OBJ file, or it could not be read */
    srp_scene *mesh;   /* the shape with its optics, for pictures; unknown materials absorb all */
    bool optics_known; /* of all materials of the mesh */
    const srp_method *method; /* NULL: the setup names none that works */
    srp_method_params params;
    srp_prepared *prepared; /* NULL: `problem` says why */
    bool owns_scene;        /* the scene of `prepared` is not `mesh` */
    viewer_words problem;
} viewer_engine;

/* Reads, joins and prepares; whatever fails is in `problem`. `known` (may be NULL) is taken for the
 * file when it is of the same path and unit, and `reload` is false or the file cannot be read any
 * more. NULL without memory. */
viewer_engine *viewer_engine_make(const viewer_setup *setup, viewer_shape *known, bool reload);
viewer_engine *viewer_engine_reference(viewer_engine *engine); /* may be NULL, as the next */
void viewer_engine_release(viewer_engine *engine);

/* Whether a plates file can be used; else `problem` has why. */
bool viewer_engine_takes_plates(const char *path, viewer_words *problem);

/* The optics that count for material `index` of the shape: what the user said, else the MTL; false:
 * nobody knows. */
bool viewer_engine_optics(const viewer_engine *engine, size_t index, srp_optics *out);

/* The MTL file that the shape names and that is not there, while a material has no optics; else
 * NULL, also for no engine. */
const char *viewer_engine_missing_mtl(const viewer_engine *engine);

/* What the Sun does from one direction. */
typedef struct viewer_force {
    double az_deg, el_deg;
    srp_vec3 s;
    srp_response response;
    double seconds;  /* it took */
    double asked_at; /* as the window asks, viewer_seconds() */
} viewer_force;

/* False with words; *out unchanged then. Any thread. */
bool viewer_engine_respond(const viewer_engine *engine, double az_deg, double el_deg,
                           viewer_force *out, viewer_words *problem);

/* Seconds of a clock that only goes forward. */
double viewer_seconds(void);

#endif
