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
#include "scene_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE_MAX = 32768 };

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

/* Projects, fits the lattice and sets up what is drawn on it. */
static void set_up_frame(const srp_prepared *prepared, srp_raster_frame *frame, srp_vec3 s,
                         unsigned refine) {
    const srp_lattice_params *params = &prepared->params.lattice;
    srp_view axes = srp_lattice_axes(params, s);
    srp_extent extent = srp_raster_frame_project(frame, &axes);
    srp_lattice lattice = srp_lattice_fit(params, &axes, extent, refine, prepared->params.seed);
    srp_raster_frame_bind(frame, params->kind, &lattice);
}

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

/* Adds what was counted to the sums per material. */
static void add_facets(const srp_prepared *prepared, const raycast_scratch *own, srp_basis *basis) {
    const srp_raster_frame *frame = &own->frame;
    const srp_lattice *lattice = &frame->lattice;
    const double cell = lattice->du * lattice->dv;
    for (size_t k = 0; k < frame->facet_count; ++k) {
        const srp_raster_tally *tally = &own->canvas[0].tally[k];
        if (tally->n == 0) {
            continue;
        }
        uint32_t facet = frame->facet[k];
        srp_raster_side side = srp_raster_frame_side(frame, facet);
        srp_raster_plane plane = srp_raster_frame_plane(frame, facet, frame->mesh->v[facet][0]);
        double per_sample = 1.0 / (double)tally->n;
        double i = (double)tally->i * per_sample, j = (double)tally->j * per_sample;
        srp_vec3 centroid = srp_view_lift(
            &lattice->view,
            srp_vec3_make(lattice->u0 + i * lattice->du, lattice->v0 + j * lattice->dv,
                          plane.at + i * plane.along_i + j * plane.along_j));
        srp_basis_add(&basis[side.surface->row], (double)tally->n * cell, side.cosine, side.normal,
                      srp_vec3_sub(centroid, prepared->params.reference));
    }
}

/* ---- errors ---- */

/* Cross-section of all that is turned to the Sun, hidden or not: no more than it can be lit. */
static double exposed_area(const srp_scene *scene, const srp_raster_frame *frame) {
    double sum = 0.0;
    for (size_t k = 0; k < scene->facet_count; ++k) {
        bool exposed = frame->cosine[k] > 0.0 || !scene->facets[k].closed;
        sum += exposed ? scene->facets[k].area * fabs(frame->cosine[k]) : 0.0;
    }
    return sum;
}

/* No less than the push on what lies outside a window; 0 when it holds the whole silhouette. */
static double cut_push(const srp_scene *scene, const srp_raster_frame *frame) {
    if (!srp_raster_frame_is_cut(frame)) {
        return 0.0;
    }
    double sum = 0.0;
    for (size_t k = 0; k < scene->facet_count; ++k) {
        const srp_facet *facet = &scene->facets[k];
        bool exposed = frame->cosine[k] > 0.0 || !facet->closed;
        if (exposed && srp_raster_frame_cuts(frame, facet)) {
            srp_optics optics = scene->optics[facet->material];
            double cosine = fabs(frame->cosine[k]);
            sum += facet->area * cosine *
                   (1.0 - optics.rho_s + 2.0 * (optics.rho_s * cosine + optics.rho_d / 3.0));
        }
    }
    return sum;
}

/* Distance from the reference at which errors act: the root mean square over what is lit; the
 * largest there is when nothing is, or when something is cut that may be anywhere. */
static double lever_of(const raycast *state, const raycast_scratch *own, bool anywhere) {
    double samples = 0.0, sum = 0.0;
    for (size_t n = 0; n < own->frame.facet_count; ++n) {
        double lit = (double)own->canvas[0].tally[n].n;
        samples += lit;
        sum += lit * state->lever2[own->frame.facet[n]];
    }
    if (samples > 0.0 && !anywhere) {
        return sqrt(sum / samples);
    }
    const srp_scene *scene = state->head.scene;
    return srp_vec3_norm(srp_vec3_sub(scene->centre, state->head.params.reference)) + scene->radius;
}

static void estimate_errors(const raycast *state, const raycast_scratch *own, srp_response *out) {
    const srp_scene *scene = state->head.scene;
    const srp_raster_frame *frame = &own->frame;
    double cell = frame->lattice.du * frame->lattice.dv;
    double scatter = srp_variation_error(&own->canvas[0].variation, cell);
    /* Something smaller than a cell may have been missed, or hit by luck. */
    double unseen = cell;
    if (scatter == 0.0) {
        unseen = fmin(unseen, exposed_area(scene, frame));
    }
    double cut = cut_push(scene, frame);
    out->flags &= ~(uint32_t)SRP_RESPONSE_CUT;
    out->flags |= cut > 0.0 ? SRP_RESPONSE_CUT : 0;
    out->f_error = sqrt(scatter * scatter + unseen * unseen + cut * cut);
    out->t_error = out->f_error * lever_of(state, own, cut > 0.0);
}

/* ---- one direction ---- */

static double force_of(const srp_scene *scene, const srp_basis *basis, srp_vec3 s) {
    srp_vec3 f = {0.0, 0.0, 0.0}, t = {0.0, 0.0, 0.0};
    srp_basis_add_force(scene, basis, s, &f, &t);
    return srp_vec3_norm(f);
}

static bool may_refine(const srp_method_params *params, const srp_lattice *lattice) {
    uint64_t side = (uint64_t)(lattice->columns > lattice->rows ? lattice->columns : lattice->rows);
    return 2 * side <= params->max_samples;
}

static srp_status respond_in_parts(const srp_prepared *prepared, srp_scratch *scratch, srp_vec3 s,
                                   srp_response *out, int parts) {
    const raycast *state = (const raycast *)prepared;
    raycast_scratch *own = (raycast_scratch *)scratch;
    const srp_lattice *lattice = &own->frame.lattice;
    for (unsigned refine = 0;; ++refine) {
        memset(scratch->basis, 0, (prepared->scene->material_count + 1) * sizeof *scratch->basis);
        set_up_frame(prepared, &own->frame, s, refine);
        if (!count_rows(own, parts)) {
            return SRP_NO_MEMORY;
        }
        add_facets(prepared, own, scratch->basis);
        estimate_errors(state, own, out);
        double allowed = prepared->params.tolerance * force_of(prepared->scene, scratch->basis, s);
        if (isinf(prepared->params.tolerance) || out->f_error <= allowed) {
            break;
        }
        if (!may_refine(&prepared->params, lattice)) {
            out->flags |= SRP_RESPONSE_TOLERANCE_MISSED;
            break;
        }
    }
    out->samples = (uint64_t)lattice->columns * (uint64_t)lattice->rows;
    return SRP_OK;
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

static void measure_levers(const srp_scene *scene, srp_vec3 reference, double *lever2) {
    for (size_t k = 0; k < scene->facet_count; ++k) {
        lever2[k] = 0.0;
        for (int e = 0; e < 3; ++e) {
            srp_vec3 r = srp_vec3_sub(scene->vertices[scene->facets[k].v[e]], reference);
            lever2[k] += srp_vec3_dot(r, r) / 3.0;
        }
    }
}

static srp_status prepare(const srp_scene *scene, const srp_method_params *params,
                          srp_prepared **out, srp_error *error) {
    double side = srp_lattice_side(&params->lattice, 2.0 * scene->radius);
    if (side > SIDE_MAX) {
        return srp_fail(
            error, SRP_BAD_ARGUMENT,
            "cells of %g m on a model of %g m are %.0f along a side, expected at most %d",
            params->lattice.pixel, 2.0 * scene->radius, side, SIDE_MAX);
    }
    raycast *state = calloc(1, sizeof *state);
    if (state == NULL) {
        goto fail;
    }
    state->head.method = &srp_method_raycast;
    state->head.scene = scene;
    state->head.params = *params;
    state->lever2 = malloc(scene->facet_count * sizeof *state->lever2);
    if (state->lever2 == NULL || !srp_raster_mesh_create(&state->mesh, scene)) {
        release(&state->head);
        goto fail;
    }
    measure_levers(scene, params->reference, state->lever2);
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
