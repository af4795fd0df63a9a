/* SPDX-License-Identifier: Apache-2.0 */
/* The models of models/, read for tests, and turned or mirrored on the way to a scene. Failures end
 * the test. */
#ifndef SRP_TEST_MODEL_FILES_H
#define SRP_TEST_MODEL_FILES_H

#include <srp/material.h>
#include <srp/mesh.h>
#include <srp/method.h>
#include <srp/scene.h>
#include <srp/vec3.h>

#include <stddef.h>
#include <stdint.h>

/* Names of all OBJ models, without the ending. */
extern const char *const MODEL_NAMES[];
extern const size_t MODEL_COUNT;

typedef struct model_file {
    srp_mesh *mesh;
    srp_materials *materials;
} model_file;

model_file model_read(const char *name);
void model_free(model_file *model);

/* Rows of an orthogonal matrix; a mirror when its determinant is -1. */
typedef struct turn {
    srp_vec3 row[3];
} turn;

turn turn_random(uint64_t *state);
turn turn_mirrored(turn rotation); /* the same after x -> -x */
srp_vec3 turn_apply(const turn *t, srp_vec3 v);

/* The model as it is, or turned; a mirror turns the triangles' winding round, so that their fronts
 * stay outside. */
srp_scene *model_scene(const model_file *model);
srp_scene *model_scene_turned(const model_file *model, const turn *t);
/* The model with every material's optics replaced. */
srp_scene *model_scene_painted(const model_file *model, srp_optics optics);

#endif
