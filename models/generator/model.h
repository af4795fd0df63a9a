/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A model while it is being put together: parts, materials, vertices, triangles, and the few
 * primitives that the spacecraft in models/ are made of. Failures (memory, disk) end the program:
 * see fail().
 */
#ifndef MODELS_MODEL_H
#define MODELS_MODEL_H

#include <srp/vec3.h>

#include <stddef.h>
#include <stdint.h>

typedef struct model_material {
    const char *name;
    double rho_s, rho_d;
} model_material;

typedef struct model_triangle {
    uint32_t v[3];
    uint32_t material, part;
} model_triangle;

enum { MODEL_MATERIALS_MAX = 16, MODEL_PARTS_MAX = 64 };

typedef struct model {
    const char *name;    /* of the files */
    const char *comment; /* lines of text at the head of the OBJ, separated by \n */
    /* Coordinates are rounded to this many to the metre, so that the last bit of the sine in one C
     * library or another does not show in the files. 0: as computed. */
    double points_per_metre;

    model_material materials[MODEL_MATERIALS_MAX];
    size_t material_count;
    const char *parts[MODEL_PARTS_MAX];
    size_t part_count;

    srp_vec3 *vertices;
    size_t vertex_count, vertex_room;
    model_triangle *triangles;
    size_t triangle_count, triangle_room;
} model;

/* An origin and three orthonormal axes: where a primitive stands. */
typedef struct frame {
    srp_vec3 origin, x, y, z;
} frame;

/* Says what went wrong on stderr and ends the program. */
_Noreturn void fail(const char *what, const char *name);

model model_make(const char *name, const char *comment);
void model_clear(model *m);

/* Names the part that triangles belong to from here on. */
void model_part(model *m, const char *name);
/* Adds a material; its index. */
uint32_t model_add_material(model *m, const char *name, double rho_s, double rho_d);
uint32_t model_add_vertex(model *m, srp_vec3 p);
void model_add_triangle(model *m, uint32_t material, uint32_t a, uint32_t b, uint32_t c);
void model_add_quad(model *m, uint32_t material, uint32_t a, uint32_t b, uint32_t c, uint32_t d);

/* The body frame moved to `origin`. */
frame frame_at(srp_vec3 origin);
/* z along `axis`, x as near to `towards` as it can be. */
frame frame_along(srp_vec3 origin, srp_vec3 axis, srp_vec3 towards);
srp_vec3 frame_point(const frame *f, double x, double y, double z);
srp_vec3 unit(srp_vec3 a);

/* Closed box between two corners of `f`; materials of the faces -x +x -y +y -z +z. */
void model_add_box(model *m, const frame *f, srp_vec3 lo, srp_vec3 hi, const uint32_t material[6]);
/* The same in one material. */
void model_add_block(model *m, const frame *f, srp_vec3 lo, srp_vec3 hi, uint32_t material);

/* A point of a profile that is turned about the z axis: radius >= 0 and height. */
typedef struct profile_point {
    double r, z;
} profile_point;

typedef enum profile_kind {
    PROFILE_OPEN, /* from the first point to the last; closed surface if both are on the axis */
    PROFILE_LOOP  /* and back to the first: a ring */
} profile_kind;

/*
 * Surface of revolution about the z axis of `f`, in `segments` steps. Outside is at the right hand
 * of who walks along the profile with the axis at the left (r to the right, z up). Points on the
 * axis (r = 0) become one vertex each.
 */
void model_add_revolved(model *m, const frame *f, const profile_point *profile, size_t count,
                        profile_kind kind, uint32_t segments, uint32_t material);
/* Closed prism of `sides` sides, corners at radius r, from z0 to z1. */
void model_add_prism(model *m, const frame *f, double r, double z0, double z1, uint32_t sides,
                     uint32_t material);

/* Closed tube of `sides` sides about a path of at least two points. */
void model_add_tube(model *m, const srp_vec3 *path, size_t count, double radius, uint32_t sides,
                    uint32_t material);
/* A straight one. */
void model_add_rod(model *m, srp_vec3 from, srp_vec3 to, double radius, uint32_t sides,
                   uint32_t material);

#endif
