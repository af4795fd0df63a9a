/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A scene is a shape with its optics, frozen: what a method answers questions about. It is
 * read-only after creation and may be used from any number of threads.
 */
#ifndef SRP_SCENE_H
#define SRP_SCENE_H

#include <srp/material.h>
#include <srp/mesh.h>
#include <srp/plates.h>
#include <srp/status.h>
#include <srp/vec3.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

SRP_BEGIN_DECLS

typedef struct srp_scene srp_scene;

/* What a scene is made of; methods say which kind they take. Bits, so that they can be joined. */
typedef enum srp_shape {
    SRP_SHAPE_MESH = 1,
    SRP_SHAPE_PLATES = 2,
    SRP_SHAPE_SPHERE = 4 /* the cannonball: an area and a reflectivity coefficient */
} srp_shape;

/* All constructors copy what they are given.
 * SRP_NOT_FOUND (a material of the mesh without optics; the message says how to give it),
 * SRP_BAD_DATA (every triangle degenerate; a mesh so far from the origin that rounding
 * hides its faces), SRP_NO_MEMORY. */
SRP_API SRP_CHECK srp_status srp_scene_from_mesh(const srp_mesh *mesh,
                                                 const srp_materials *materials, srp_scene **out,
                                                 srp_error *error);
/* Areas up to 1e60 m^2. SRP_BAD_ARGUMENT (no plate), SRP_BAD_DATA, SRP_NO_MEMORY. */
SRP_API SRP_CHECK srp_status srp_scene_from_plates(const srp_plate *plates, size_t count,
                                                   srp_scene **out, srp_error *error);
/* cr: reflectivity coefficient [-], 0 to 1e30; area: cross-section [m^2] > 0, up to 1e60.
 * SRP_BAD_ARGUMENT. */
SRP_API SRP_CHECK srp_status srp_scene_from_sphere(double cr, double area, srp_scene **out,
                                                   srp_error *error);

/*
 * The whole way from files: reads and joins one or more OBJ files, finds their MTL files, and
 * freezes. `given` are materials that the user states (NULL for none); they win over the files. A
 * missing MTL is an error only when a material stays without optics.
 * Statuses of srp_mesh_read_obj, srp_materials_read_mtl and srp_scene_from_mesh.
 */
SRP_API SRP_CHECK srp_status srp_scene_read_obj(const char *const *paths, size_t count,
                                                const srp_mesh_read_params *params,
                                                const srp_materials *given, const srp_log *log,
                                                srp_scene **out, srp_error *error);
SRP_API void srp_scene_destroy(srp_scene *scene);

SRP_API srp_shape srp_scene_shape(const srp_scene *scene);
/* Materials of the scene: of a mesh as it names them, of plates one each ("plate 1", ...), of a
 * sphere none. */
SRP_API size_t srp_scene_material_count(const srp_scene *scene);
SRP_API const char *srp_scene_material_name(const srp_scene *scene, size_t index);
SRP_API srp_optics srp_scene_material_optics(const srp_scene *scene, size_t index);
/* Triangles or plates that light can fall on (degenerate triangles are left out). */
SRP_API size_t srp_scene_facet_count(const srp_scene *scene);
/* A triangle or plate that light can fall on. */
typedef struct srp_face {
    srp_vec3 normal;   /* [-] outward, unit, body frame */
    double area;       /* [m^2] > 0 */
    uint32_t material; /* index of its material */
    bool two_sided;    /* of an open surface: light can fall on its back as well */
} srp_face;
/* Face `index` (below srp_scene_facet_count()); closed parts that were wound inside out are turned.
 * Any thread. */
SRP_API srp_face srp_scene_face(const srp_scene *scene, size_t index);
/* Radius of the smallest sphere about the body origin that holds the mesh [m]; 0 without a mesh. */
SRP_API double srp_scene_radius(const srp_scene *scene);
/* Hash (XXH3, 128 bits, 32 hexadecimal digits) of everything about shape, and of the optics, that
 * decides a result; owned by the scene. */
SRP_API const char *srp_scene_shape_hash(const srp_scene *scene);
SRP_API const char *srp_scene_optics_hash(const srp_scene *scene);

SRP_END_DECLS

#endif
