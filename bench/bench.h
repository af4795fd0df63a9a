/* SPDX-License-Identifier: Apache-2.0 */
/* What the benchmark programs share: scenes, directions, a clock. Failures end the program. */
#ifndef SRP_BENCH_H
#define SRP_BENCH_H

#include <srp/material.h>
#include <srp/mesh.h>
#include <srp/method.h>
#include <srp/scene.h>
#include <srp/status.h>
#include <srp/vec3.h>

#include <stddef.h>
#include <stdint.h>

/* Time since some start [s]. */
double bench_now(void);

/* Ends the program with exit status 3 and the text of `error` unless `status` is SRP_OK. */
void bench_require(srp_status status, const srp_error *error);

/* Memory that is there. */
void *bench_allocate(size_t count, size_t size);

/* A model of models/, by the name of its file. */
srp_mesh *bench_model(const char *name);

/* A sphere of 12 side^2 triangles: a cube's faces, meshed, pushed out to `radius`. */
srp_mesh *bench_sphere(uint32_t side, double radius, srp_vec3 centre);

/* 98,224 triangles of closed bodies: a sphere, a bus and two thin panels, finely meshed. */
srp_mesh *bench_satellite(void);

/* Freezes `mesh` with one optics for all its materials, and destroys it. */
srp_scene *bench_scene(srp_mesh *mesh, srp_optics optics);

enum { BENCH_PAPER_DIRECTIONS = 162 };
/* The directions of AAS 20-481: az from -180 deg in steps of 20, el from -90 in steps of 20, the
 * upper ends left out. */
void bench_paper_directions(srp_vec3 s[BENCH_PAPER_DIRECTIONS]);

/* A prepared method. */
srp_prepared *bench_prepare(const srp_method *method, const srp_scene *scene,
                            const srp_method_params *params);

/* Least time of `repeats` runs over all directions [s]. */
double bench_time(const srp_prepared *prepared, size_t count, const srp_vec3 *s, int repeats,
                  srp_response *responses);

/* side x side samples of the window [-half, half]^2, as AAS 20-481 lays them. */
void bench_set_window(srp_method_params *params, double half, uint32_t side);

#endif
