/* SPDX-License-Identifier: Apache-2.0 */
/* Where the light falls on a large spacecraft: found beside the window, newest Sun first. */
#ifndef SRP_VIEWER_SCENE_LIGHT_H
#define SRP_VIEWER_SCENE_LIGHT_H

#include "engine.h"
#include "worker.h"

#include <srp/render.h>

typedef struct scene_light scene_light;

/* `ready` is called, on the window's thread, when what was last asked for is there, or cannot be.
 * The worker does nothing else. */
scene_light *scene_light_create(viewer_worker *worker, void (*ready)(void *user), void *user);
/* Ends the work, and does not wait for that: the worker is destroyed by whoever made it. */
void scene_light_destroy(scene_light *light);

/* The engine has a mesh. What is there already, or on its way, is not asked for again. */
void scene_light_ask(scene_light *light, viewer_engine *engine, srp_vec3 sun);

typedef enum scene_light_state { LIGHT_UNKNOWN, LIGHT_FOUND, LIGHT_FAILED } scene_light_state;
/* Of this engine and Sun; `found` stays until the next call of scene_light_ask(). */
scene_light_state scene_light_look(const scene_light *light, const viewer_engine *engine,
                                   srp_vec3 sun, const srp_render_light **found);

#endif
