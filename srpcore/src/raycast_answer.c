/* SPDX-License-Identifier: Apache-2.0 */
#include "raycast_answer.h"

#include "error.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- before ---- */

enum { SIDE_MAX = 32768 };

srp_status srp_raycast_check_lattice(const srp_scene *scene, const srp_method_params *params,
                                     srp_error *error) {
    double side = srp_lattice_side(&params->lattice, 2.0 * scene->radius);
    if (side > SIDE_MAX) {
        return srp_fail(
            error, SRP_BAD_ARGUMENT,
            "cells of %g m on a model of %g m are %.0f along a side, expected at most %d",
            params->lattice.pixel, 2.0 * scene->radius, side, SIDE_MAX);
    }
    return SRP_OK;
}

double *srp_raycast_measure_levers(const srp_scene *scene, srp_vec3 reference) {
    double *lever2 = malloc(scene->facet_count * sizeof *lever2);
    for (size_t k = 0; lever2 != NULL && k < scene->facet_count; ++k) {
        lever2[k] = 0.0;
        for (int e = 0; e < 3; ++e) {
            srp_vec3 r = srp_vec3_sub(scene->vertices[scene->facets[k].v[e]], reference);
            lever2[k] += srp_vec3_dot(r, r) / 3.0;
        }
    }
    return lever2;
}

void srp_raycast_set_up_frame(const srp_prepared *prepared, srp_raster_frame *frame, srp_vec3 s,
                              unsigned refine) {
    const srp_lattice_params *params = &prepared->params.lattice;
    srp_view axes = srp_lattice_axes(params, s);
    srp_extent extent = srp_raster_frame_project(frame, &axes);
    srp_lattice lattice = srp_lattice_fit(params, &axes, extent, refine, prepared->params.seed);
    srp_raster_frame_bind(frame, params->kind, &lattice);
}

/* ---- sums ---- */

/* Height of a facet's samples in the mean, at the mean sample. OpenGL may see a facet from a sample
 * that only comes close to it, where the plane of one that light grazes is anywhere: no sample is
 * higher or lower than the corners. */
static double mean_height(const srp_raster_frame *frame, uint32_t facet, double i, double j) {
    const uint32_t *v = frame->mesh->v[facet];
    double a = frame->depth[v[0]], b = frame->depth[v[1]], c = frame->depth[v[2]];
    srp_raster_plane plane = srp_raster_frame_plane(frame, facet, v[0]);
    double height = plane.at + i * plane.along_i + j * plane.along_j;
    return fmax(fmin(a, fmin(b, c)), fmin(fmax(a, fmax(b, c)), height));
}

/* Adds what was counted to the sums per material. */
static void add_facets(const srp_prepared *prepared, const srp_raycast_count *count,
                       srp_basis *basis) {
    const srp_raster_frame *frame = count->frame;
    const srp_lattice *lattice = &frame->lattice;
    const double cell = lattice->du * lattice->dv;
    for (size_t k = 0; k < frame->facet_count; ++k) {
        const srp_raster_tally *tally = &count->tally[k];
        if (tally->n == 0) {
            continue;
        }
        uint32_t facet = frame->facet[k];
        srp_raster_side side = srp_raster_frame_side(frame, facet);
        double per_sample = 1.0 / (double)tally->n;
        double i = (double)tally->i * per_sample, j = (double)tally->j * per_sample;
        srp_vec3 centroid =
            srp_view_lift(&lattice->view, srp_vec3_make(lattice->u0 + i * lattice->du,
                                                        lattice->v0 + j * lattice->dv,
                                                        mean_height(frame, facet, i, j)));
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
static double lever_of(const srp_prepared *prepared, const double *lever2,
                       const srp_raycast_count *count, bool anywhere) {
    double samples = 0.0, sum = 0.0;
    for (size_t n = 0; n < count->frame->facet_count; ++n) {
        double lit = (double)count->tally[n].n;
        samples += lit;
        sum += lit * lever2[count->frame->facet[n]];
    }
    if (samples > 0.0 && !anywhere) {
        return sqrt(sum / samples);
    }
    const srp_scene *scene = prepared->scene;
    return srp_vec3_norm(srp_vec3_sub(scene->centre, prepared->params.reference)) + scene->radius;
}

static void estimate_errors(const srp_prepared *prepared, const double *lever2,
                            const srp_raycast_count *count, srp_response *out) {
    const srp_scene *scene = prepared->scene;
    const srp_raster_frame *frame = count->frame;
    double cell = frame->lattice.du * frame->lattice.dv;
    double scatter = srp_variation_error(count->variation, cell);
    /* Something smaller than a cell may have been missed, or hit by luck. */
    double unseen = cell;
    if (scatter == 0.0) {
        unseen = fmin(unseen, exposed_area(scene, frame));
    }
    double cut = cut_push(scene, frame);
    out->flags &= ~(uint32_t)SRP_RESPONSE_CUT;
    out->flags |= cut > 0.0 ? SRP_RESPONSE_CUT : 0;
    out->f_error = sqrt(scatter * scatter + unseen * unseen + cut * cut);
    out->t_error = out->f_error * lever_of(prepared, lever2, count, cut > 0.0);
}

/* ---- together ---- */

static double force_of(const srp_scene *scene, const srp_basis *basis, srp_vec3 s) {
    srp_vec3 f = {0.0, 0.0, 0.0}, t = {0.0, 0.0, 0.0};
    srp_basis_add_force(scene, basis, s, &f, &t);
    return srp_vec3_norm(f);
}

static bool may_refine(const srp_method_params *params, const srp_lattice *lattice) {
    uint64_t side = (uint64_t)(lattice->columns > lattice->rows ? lattice->columns : lattice->rows);
    return 2 * side <= params->max_samples;
}

bool srp_raycast_answer(const srp_prepared *prepared, const double *lever2,
                        const srp_raycast_count *count, srp_basis *basis, srp_response *out) {
    const srp_method_params *params = &prepared->params;
    const srp_lattice *lattice = &count->frame->lattice;
    memset(basis, 0, (prepared->scene->material_count + 1) * sizeof *basis);
    add_facets(prepared, count, basis);
    estimate_errors(prepared, lever2, count, out);
    out->samples = (uint64_t)lattice->columns * (uint64_t)lattice->rows;
    double allowed = params->tolerance * force_of(prepared->scene, basis, lattice->view.s);
    if (isinf(params->tolerance) || out->f_error <= allowed) {
        return true;
    }
    if (may_refine(params, lattice)) {
        return false;
    }
    out->flags |= SRP_RESPONSE_TOLERANCE_MISSED;
    return true;
}
