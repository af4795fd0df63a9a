/* SPDX-License-Identifier: Apache-2.0 */
/* What a beam of parallel light hits first, exactly. Internal. */
#ifndef SRP_SRC_EXACT_VISIBLE_H
#define SRP_SRC_EXACT_VISIBLE_H

#include "exact_polygon.h"
#include "scene_internal.h"
#include "view.h"

#include <srp/status.h>
#include <srp/vec3.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Where mirrored light comes through: the lit part of a mirror. Polygons of the image of the beam,
 * convex, disjoint, counter-clockwise. */
typedef struct srp_window {
    uint32_t facet; /* the mirror */
    const srp_polygon *part;
    size_t part_count;
    const uint32_t *reach; /* facets that the light may fall on, others are not looked at */
    size_t reach_count;
} srp_window;

/*
 * Parallel light. The image is the plane through `centre` along view.u and view.v. Of mirrored
 * light these are the mirror images of those that the light had before, so that the mirror has the
 * same coordinates in both: a beam runs straight on, into a mirrored world.
 */
typedef struct srp_beam {
    srp_view view;            /* view.s: to where the light comes from */
    bool mirrored;            /* u, v, s are left-handed: after an odd number of mirrors */
    srp_vec3 centre;          /* at the origin of the image, body frame [m] */
    const srp_window *window; /* NULL: sunlight */
} srp_beam;

/* Sunlight from `s`. */
srp_beam srp_beam_of_sun(const srp_scene *scene, srp_vec3 s);
/* What a mirror, one of the scene's facets, makes of a beam; without a window. */
srp_beam srp_beam_mirrored(const srp_beam *beam, const srp_scene *scene, uint32_t mirror);

/* The lit part of a facet. */
typedef struct srp_lit {
    uint32_t facet;
    bool back;               /* on its inner side */
    srp_vec3 normal;         /* turned to the light */
    double cosine;           /* of normal and view.s, > 0 */
    double area;             /* cross-section, A cosine [m^2] > 0 */
    srp_vec3 centroid;       /* body frame [m] */
    const srp_polygon *part; /* in the image, until the visit ends; NULL unless asked for */
    size_t part_count;
} srp_lit;

/* Anything but SRP_OK ends the search. */
typedef srp_status (*srp_lit_visit)(void *user, const srp_lit *lit);

/* Memory for one search at a time. */
typedef struct srp_visible srp_visible;

/* NULL when there is no memory. The scene must stay. */
srp_visible *srp_visible_create(const srp_scene *scene);
void srp_visible_destroy(srp_visible *visible);

/* Tells `visit` of every facet that the beam hits, roughly from near to far, in an order that
 * depends on scene and beam alone. `parts`: with the polygons. The first status of a visit that is
 * not SRP_OK; SRP_NO_MEMORY. */
srp_status srp_visible_find(srp_visible *visible, const srp_beam *beam, bool parts,
                            srp_lit_visit visit, void *user);

#endif
