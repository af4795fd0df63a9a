/* SPDX-License-Identifier: Apache-2.0 */
/* What the inside of a scene looks like to methods. Internal. */
#ifndef SRP_SRC_SCENE_INTERNAL_H
#define SRP_SRC_SCENE_INTERNAL_H

#include <srp/scene.h>

#include <stdbool.h>
#include <stdint.h>

#define SRP_NO_NEIGHBOUR UINT32_MAX

/* A triangle that light can fall on. */
typedef struct srp_facet {
    uint32_t v[3];         /* into srp_scene.vertices, counter-clockwise from outside */
    uint32_t material;     /* into srp_scene.optics */
    uint32_t neighbour[3]; /* facet across edge v[k] -> v[(k+1)%3], SRP_NO_NEIGHBOUR at a rim */
    bool closed;           /* part of a closed component: its back is never the first hit */
    srp_vec3 normal;       /* unit, outward */
    double area;           /* [m^2] > 0 */
} srp_facet;

struct srp_scene {
    srp_shape shape;
    char shape_hash[33], optics_hash[33];

    /* Materials: optics and names; plates have one each, a sphere none. */
    size_t material_count;
    srp_optics *optics;
    char **material_names;

    /* SRP_SHAPE_MESH. Vertices at the same place are one, unused ones are dropped, closed
     * components that were wound inside out are turned. `centre` and `radius`: a sphere that holds
     * it all. */
    size_t vertex_count;
    srp_vec3 *vertices;
    size_t facet_count;
    srp_facet *facets;
    srp_vec3 box_min, box_max;
    srp_vec3 centre;
    double radius;
    bool all_closed; /* every facet is */

    /* SRP_SHAPE_PLATES: plate k has material k. */
    size_t plate_count;
    srp_plate *plates;

    /* SRP_SHAPE_SPHERE */
    double cr, area;
};

/* The hash of optics, as srp_scene_optics_hash() gives it: of `count` materials, and of the
 * coefficient of a sphere (0 for others). False without memory. */
bool srp_optics_hash(size_t count, char *const *names, const srp_optics *optics, double cr,
                     char out[33]);

#endif
