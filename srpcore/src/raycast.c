/* SPDX-License-Identifier: Apache-2.0 */
/*
 * First-hit visibility sampled by a lattice of rays (AAS 20-481, Eq. 6 without the second cosine: a
 * cell's area is already projected). Facets are drawn, not searched for: raster_canvas.h. Each
 * facet's samples are counted as integers, and so are the jumps that tell the error: the result
 * depends on neither order nor threads.
 */
#include "error.h"
#include "lattice.h"
#include "method_internal.h"
#include "raster_canvas.h"
#include "raycast_answer.h"
#include "scene_internal.h"

#include <math.h>
#include <stdlib.h>

/* Lattices from this side on are worth sharing among threads. */
enum { SHARED_SIDE = 1024 };

typedef struct raycast {
    srp_prepared head;
    srp_scratch_pool pool;
    srp_raster_mesh mesh;
    double *lever2; /* per facet: mean square of its corners' distance from the reference [m^2] */
} raycast;

typedef struct raycast_scratch {
    srp_scratch head;
    srp_raster_frame frame;
    int canvas_count;
    srp_raster_canvas canvas[]; /* the first collects what all have counted */
} raycast_scratch;

static void scratch_destroy(srp_scratch *scratch) {
    raycast_scratch *own = (raycast_scratch *)scratch;
    srp_raster_frame_clear(&own->frame);
    for (int k = 0; k < own->canvas_count; ++k) {
        srp_raster_canvas_clear(&own->canvas[k]);
    }
    free(own);
}

static srp_scratch *scratch_create(const srp_prepared *prepared) {
    const raycast *state = (const raycast *)prepared;
    int count = prepared->params.threads;
    raycast_scratch *own = calloc(1, sizeof *own + (size_t)count * sizeof own->canvas[0]);
    if (own == NULL) {
        return NULL;
    }
    own->canvas_count = count;
    if (!srp_raster_frame_create(&own->frame, &state->mesh)) {
        free(own);
        return NULL;
    }
    return &own->head;
}

/* ---- one lattice ---- */

/* Counts all rows on `parts` canvases at once, and leaves the sums on the first. */
static bool count_rows(raycast_scratch *own, int parts) {
    const srp_raster_frame *frame = &own->frame;
    for (int k = 0; k < parts; ++k) {
        if (!srp_raster_canvas_begin(&own->canvas[k], frame)) {
            return false;
        }
    }
    int64_t rows = frame->lattice.rows;
#pragma omp parallel for num_threads(parts) schedule(static, 1) if (parts > 1)
    for (int k = 0; k < parts; ++k) {
        srp_raster_canvas_count(&own->canvas[k], frame, (int32_t)(rows * k / parts),
                                (int32_t)(rows * (k + 1) / parts));
    }
    for (int k = 1; k < parts; ++k) {
        srp_raster_canvas_merge(&own->canvas[0], &own->canvas[k], frame);
    }
    return true;
}

/* ---- one direction ---- */

static srp_status respond_in_parts(const srp_prepared *prepared, srp_scratch *scratch, srp_vec3 s,
                                   srp_response *out, int parts) {
    const raycast *state = (const raycast *)prepared;
    raycast_scratch *own = (raycast_scratch *)scratch;
    for (unsigned refine = 0;; ++refine) {
        srp_raycast_set_up_frame(prepared, &own->frame, s, refine);
        if (!count_rows(own, parts)) {
            return SRP_NO_MEMORY;
        }
        srp_raycast_count count = {&own->frame, own->canvas[0].tally, &own->canvas[0].variation};
        if (srp_raycast_answer(prepared, state->lever2, &count, scratch->basis, out)) {
            return SRP_OK;
        }
    }
}

static srp_status respond_alone(const srp_prepared *prepared, srp_scratch *scratch, srp_vec3 s,
                                srp_response *out) {
    return respond_in_parts(prepared, scratch, s, out, 1);
}

static srp_status respond_shared(const srp_prepared *prepared, srp_scratch *scratch, srp_vec3 s,
                                 srp_response *out) {
    return respond_in_parts(prepared, scratch, s, out, prepared->params.threads);
}

static const srp_direction_kernel ALONE = {scratch_create, scratch_destroy, respond_alone};
static const srp_direction_kernel SHARED = {scratch_create, scratch_destroy, respond_shared};

static srp_status respond(const srp_prepared *prepared, size_t count, const srp_vec3 *s_body,
                          srp_response *responses, srp_basis *basis, srp_error *error) {
    raycast *state = (raycast *)prepared;
    const srp_method_params *params = &prepared->params;
    bool large = srp_lattice_side(&params->lattice, 2.0 * prepared->scene->radius) >= SHARED_SIDE ||
                 !isinf(params->tolerance);
    if (large && count < (size_t)params->threads) {
        return srp_respond_in_turn(prepared, &SHARED, &state->pool, count, s_body, responses, basis,
                                   error);
    }
    return srp_respond_each(prepared, &ALONE, &state->pool, count, s_body, responses, basis, error);
}

/* ---- the method ---- */

static void release(srp_prepared *prepared) {
    raycast *state = (raycast *)prepared;
    srp_scratch_pool_clear(&state->pool, &ALONE);
    srp_raster_mesh_clear(&state->mesh);
    free(state->lever2);
    free(state);
}

static srp_status prepare(const srp_scene *scene, const srp_method_params *params,
                          srp_prepared **out, srp_error *error) {
    srp_status status = srp_raycast_check_lattice(scene, params, error);
    if (status != SRP_OK) {
        return status;
    }
    raycast *state = calloc(1, sizeof *state);
    if (state == NULL) {
        goto fail;
    }
    state->head.method = &srp_method_raycast;
    state->head.scene = scene;
    state->head.params = *params;
    state->lever2 = srp_raycast_measure_levers(scene, params->reference);
    if (state->lever2 == NULL || !srp_raster_mesh_create(&state->mesh, scene)) {
        release(&state->head);
        goto fail;
    }
    *out = &state->head;
    return SRP_OK;
fail:
    return srp_fail(error, SRP_NO_MEMORY, "no memory for the raycast method on %zu facets",
                    scene->facet_count);
}

const srp_method srp_method_raycast = {
    .name = "raycast",
    .device = "cpu",
    .summary = "first-hit visibility sampled by a lattice of rays",
    .shapes = SRP_SHAPE_MESH,
    .capabilities = SRP_METHOD_BASIS | SRP_METHOD_LATTICE | SRP_METHOD_MOMENT,
    .prepare = prepare,
    .respond = respond,
    .release = release,
};
