/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Direct and mirrored light solved exactly (mirrors.h), the rest sampled (bounce.h): diffuse light,
 * and mirrored light where it would take too many beams.
 *
 * The lattice of the raycast method says where paths begin: its samples' first hits, drawn and not
 * traced. Facets that reflect nothing, or from which nothing can be seen (sight.h), begin none; a
 * scene or a direction without others needs no lattice at all.
 *
 * The rows of a lattice are cut into a fixed number of strips with sums of their own, added in
 * order: the result is the same whoever works on them.
 */
#include "raytrace.h"

#include "bounce.h"
#include "error.h"
#include "lattice.h"
#include "method_internal.h"
#include "mirrors.h"
#include "raster_canvas.h"
#include "scene_internal.h"
#include "seed.h"
#include "sight.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE_MAX = 32768, STRIPS = 16 };

typedef struct raytrace {
    srp_prepared head;
    srp_scratch_pool pool;
    srp_raster_mesh mesh;
    srp_bounce_world world;
    bool reflects;              /* some facet begins paths */
    bool scatters;              /* some facet begins diffuse paths that are followed */
    srp_raytrace_tracer tracer; /* in place of our own lanes, when it has a function */
} raytrace;

/* What one thread needs for a strip. */
typedef struct lane {
    srp_raster_canvas canvas;
    srp_bounce_wave wave;
} lane;

typedef struct raytrace_scratch {
    srp_scratch head;
    const raytrace *state;
    srp_mirrors *mirrors; /* direct light too */
    srp_mirrored mirrored;
    srp_raster_frame frame;
    uint64_t seed;                  /* of this direction */
    int32_t row_begin, row_end;     /* rows in which paths begin */
    srp_bounce_sums strips[STRIPS]; /* the first collects what all have summed */
    int lane_count;
    lane lanes[];
} raytrace_scratch;

static void scratch_destroy(srp_scratch *scratch) {
    raytrace_scratch *own = (raytrace_scratch *)scratch;
    srp_mirrors_destroy(own->mirrors);
    srp_raster_frame_clear(&own->frame);
    for (int k = 0; k < own->lane_count; ++k) {
        srp_raster_canvas_clear(&own->lanes[k].canvas);
        srp_bounce_wave_clear(&own->lanes[k].wave);
    }
    free(own);
}

static srp_scratch *scratch_create(const srp_prepared *prepared) {
    const raytrace *state = (const raytrace *)prepared;
    int count = prepared->params.threads;
    raytrace_scratch *own = calloc(1, sizeof *own + (size_t)count * sizeof own->lanes[0]);
    if (own == NULL) {
        return NULL;
    }
    own->state = state;
    own->lane_count = count;
    own->mirrors = srp_mirrors_create(&state->world);
    if (own->mirrors == NULL ||
        (state->reflects && !srp_raster_frame_create(&own->frame, &state->mesh))) {
        scratch_destroy(&own->head);
        return NULL;
    }
    return &own->head;
}

/* ---- one lattice ---- */

static bool is_back(const srp_raster_frame *frame, uint32_t facet) {
    return frame->cosine[facet] < 0.0;
}

/* Rows that facets reach which begin paths; false when there are none. */
static bool find_rows(raytrace_scratch *own) {
    const srp_raster_frame *frame = &own->frame;
    own->row_begin = INT32_MAX;
    own->row_end = 0;
    for (size_t n = 0; n < frame->facet_count; ++n) {
        uint32_t facet = frame->facet[n];
        if (srp_bounce_starts(&own->state->world, facet, is_back(frame, facet))) {
            const int32_t *rows = frame->rows[n];
            own->row_begin = rows[0] < own->row_begin ? rows[0] : own->row_begin;
            own->row_end = rows[1] > own->row_end ? rows[1] : own->row_end;
        }
    }
    return own->row_begin < own->row_end;
}

static void set_up_frame(raytrace_scratch *own, srp_vec3 s, unsigned refine) {
    const srp_method_params *params = &own->state->head.params;
    srp_view axes = srp_lattice_axes(&params->lattice, s);
    srp_extent extent = srp_raster_frame_project(&own->frame, &axes);
    srp_lattice lattice = srp_lattice_fit(&params->lattice, &axes, extent, refine, params->seed);
    own->seed = srp_seed_mix(srp_seed_of_direction(params->seed, s), refine);
    srp_raster_frame_bind(&own->frame, params->lattice.kind, &lattice);
}

typedef struct strip {
    const raytrace_scratch *own;
    srp_bounce_wave *wave;
} strip;

/* Samples [begin, end) of row j hit one facet. */
static void start_paths(void *user, uint32_t n, int32_t begin, int32_t end, int32_t j) {
    const strip *at = user;
    const srp_raster_frame *frame = &at->own->frame;
    uint32_t facet = frame->facet[n];
    if (!srp_bounce_starts(&at->own->state->world, facet, is_back(frame, facet))) {
        return;
    }
    srp_raster_plane plane = srp_raster_frame_plane(frame, facet, frame->mesh->v[facet][0]);
    const srp_lattice *lattice = &frame->lattice;
    srp_bounce_start start = {.j = j,
                              .flux = lattice->du * lattice->dv,
                              .direction = srp_vec3_scale(-1.0, lattice->view.s),
                              .facet = facet,
                              .back = is_back(frame, facet)};
    for (start.i = begin; start.i < end; ++start.i) {
        double i = start.i, height = plane.at + i * plane.along_i + j * plane.along_j;
        start.point =
            srp_view_lift(&lattice->view, srp_vec3_make(lattice->u0 + i * lattice->du,
                                                        lattice->v0 + j * lattice->dv, height));
        srp_bounce_wave_start(at->wave, &start);
    }
}

static void trace_strip(const raytrace_scratch *own, lane *with, srp_bounce_sums *sums, int k) {
    int64_t rows = own->row_end - own->row_begin;
    strip at = {own, &with->wave};
    memset(sums, 0, sizeof *sums);
    with->wave.sums = sums;
    srp_raster_canvas_visit(&with->canvas, &own->frame,
                            own->row_begin + (int32_t)(rows * k / STRIPS),
                            own->row_begin + (int32_t)(rows * (k + 1) / STRIPS), start_paths, &at);
    srp_bounce_wave_finish(&with->wave);
}

/* Traces all strips on `parts` lanes at once, and leaves the sums in the first. */
static bool trace_strips(raytrace_scratch *own, int parts) {
    const srp_raytrace_tracer *tracer = &own->state->tracer;
    if (tracer->trace != NULL) {
        srp_raytrace_beam beam = {&own->state->world, &own->frame, own->seed, own->row_begin,
                                  own->row_end};
        memset(&own->strips[0], 0, sizeof own->strips[0]);
        return tracer->trace(tracer->user, &beam, &own->strips[0]) == SRP_OK;
    }
    for (int k = 0; k < parts; ++k) {
        if (!srp_raster_canvas_begin(&own->lanes[k].canvas, &own->frame) ||
            !srp_bounce_wave_begin(&own->lanes[k].wave, &own->state->world, own->seed, NULL)) {
            return false;
        }
    }
    atomic_int next = 0;
#pragma omp parallel for num_threads(parts) schedule(static, 1) if (parts > 1)
    for (int part = 0; part < parts; ++part) {
        for (int k; (k = atomic_fetch_add(&next, 1)) < STRIPS;) {
            trace_strip(own, &own->lanes[part], &own->strips[k], k);
        }
    }
    for (int k = 1; k < STRIPS; ++k) {
        srp_bounce_sums_add(&own->strips[0], &own->strips[k]);
    }
    return true;
}

/* ---- one direction ---- */

static bool may_refine(const srp_method_params *params, const srp_lattice *lattice) {
    uint64_t side = (uint64_t)(lattice->columns > lattice->rows ? lattice->columns : lattice->rows);
    return 2 * side <= params->max_samples;
}

/* No less than the push of reflected light that no path stands for because it begins outside a
 * window: at most 2 per bounce of what is reflected there. */
static double cut_push(const raytrace_scratch *own) {
    const srp_raster_frame *frame = &own->frame;
    const srp_bounce_world *world = &own->state->world;
    if (!srp_raster_frame_is_cut(frame)) {
        return 0.0;
    }
    double sum = 0.0;
    for (size_t k = 0; k < world->scene->facet_count; ++k) {
        const srp_facet *facet = &world->scene->facets[k];
        bool back = frame->cosine[k] < 0.0;
        if (!(back && facet->closed) && srp_bounce_starts(world, (uint32_t)k, back) &&
            srp_raster_frame_cuts(frame, facet)) {
            srp_optics optics = world->scene->optics[facet->material];
            sum += 2.0 * facet->area * fabs(frame->cosine[k]) * (optics.rho_s + optics.rho_d);
        }
    }
    return sum * world->reflections;
}

static void take_cut(const raytrace_scratch *own, srp_response *out) {
    double cut = cut_push(own);
    if (cut > 0.0) {
        const srp_scene *scene = own->state->head.scene;
        srp_vec3 lever = srp_vec3_sub(scene->centre, own->state->world.reference);
        out->flags |= SRP_RESPONSE_CUT;
        out->f_error = hypot(out->f_error, cut);
        out->t_error = hypot(out->t_error, cut * (srp_vec3_norm(lever) + scene->radius));
    }
}

/* Light of one kind by its samples. */
typedef struct sampled {
    srp_bounce_sum sum;
    double unresolved, f_variance, t_variance;
} sampled;

/* `available`: the flux that there is of it. */
static void add_samples(const raytrace_scratch *own, srp_bounce_kind kind, double available,
                        sampled *into) {
    const srp_bounce_sums *sums = &own->strips[0];
    srp_bounce_sum sum = srp_bounce_sums_total(sums, kind);
    into->sum.f = srp_vec3_add(into->sum.f, sum.f);
    into->sum.t = srp_vec3_add(into->sum.t, sum.t);
    into->unresolved += sums->unresolved[kind];
    /* Where the groups have seen no light, their scatter says nothing: one cell of the lattice may
     * have missed as much as it stands for, though no more than there is. */
    double cell = own->frame.lattice.du * own->frame.lattice.dv;
    double missed = fmin(cell, available);
    double unseen = missed * missed * srp_bounce_sums_dark(sums, kind);
    const srp_scene *scene = own->state->head.scene;
    srp_vec3 lever = srp_vec3_sub(scene->centre, own->state->world.reference);
    into->f_variance += unseen;
    /* Somewhere in the ball that holds the model: the mean of its squared distances. */
    into->t_variance += unseen * (srp_vec3_dot(lever, lever) + 0.6 * scene->radius * scene->radius);
    srp_bounce_sums_variance(sums, kind, own->frame.kind == SRP_LATTICE_TURNED, &into->f_variance,
                             &into->t_variance);
}

static bool needs_samples(const srp_mirrored *mirrored) {
    return !mirrored->complete || mirrored->scattered > 0.0;
}

/* Mirrored light as it was solved, the rest as it was sampled. */
static void take_sums(const raytrace_scratch *own, double incoming, srp_response *out) {
    const srp_mirrored *mirrored = &own->mirrored;
    sampled all = {.unresolved = 0.0};
    if (mirrored->complete) {
        all.sum = mirrored->sum;
        all.unresolved = mirrored->unresolved;
    } else {
        add_samples(own, SRP_BOUNCE_SPECULAR, mirrored->goes_on, &all);
    }
    if (own->state->scatters && needs_samples(mirrored)) {
        double beyond = mirrored->complete ? 0.0 : mirrored->goes_on;
        add_samples(own, SRP_BOUNCE_DIFFUSE, mirrored->scattered + beyond, &all);
    }
    out->f_bounce = all.sum.f;
    out->t_bounce = all.sum.t;
    out->unresolved = incoming > 0.0 ? all.unresolved / incoming : 0.0;
    out->f_error = sqrt(all.f_variance);
    out->t_error = sqrt(all.t_variance);
}

static bool is_precise(const srp_method_params *params, srp_vec3 direct, const srp_response *out) {
    double f = srp_vec3_norm(srp_vec3_add(direct, out->f_bounce));
    return isinf(params->tolerance) || out->f_error <= params->tolerance * f;
}

/* Refines until the error is as asked. */
static srp_status trace_bounces(raytrace_scratch *own, srp_vec3 s, int parts, srp_response *out) {
    const raytrace *state = own->state;
    const srp_method_params *params = &state->head.params;
    const srp_scene *scene = state->head.scene;
    double incoming = srp_basis_lit_area(scene, own->head.basis);
    srp_vec3 f = {0.0, 0.0, 0.0}, t = {0.0, 0.0, 0.0};
    srp_basis_add_force(scene, own->head.basis, s, &f, &t);
    for (unsigned refine = 0;; ++refine) {
        set_up_frame(own, s, refine);
        if (find_rows(own)) {
            if (!trace_strips(own, parts)) {
                return SRP_NO_MEMORY;
            }
            const srp_lattice *lattice = &own->frame.lattice;
            out->samples =
                (uint64_t)lattice->columns * (uint64_t)lattice->rows + own->strips[0].rays;
        } else {
            memset(&own->strips[0], 0, sizeof own->strips[0]);
        }
        take_sums(own, incoming, out);
        take_cut(own, out);
        if (is_precise(params, f, out)) {
            return SRP_OK;
        }
        if (!may_refine(params, &own->frame.lattice)) {
            out->flags |= SRP_RESPONSE_TOLERANCE_MISSED;
            return SRP_OK;
        }
    }
}

static srp_status respond_in_parts(srp_scratch *scratch, srp_vec3 s, srp_response *out, int parts) {
    raytrace_scratch *own = (raytrace_scratch *)scratch;
    const raytrace *state = own->state;
    srp_status status = srp_mirrors_respond(own->mirrors, s, state->head.params.mirrored_beams,
                                            own->head.basis, &own->mirrored);
    if (status != SRP_OK) {
        return status;
    }
    if (!own->mirrored.complete) {
        out->flags |= SRP_RESPONSE_MIRRORS_SAMPLED;
    }
    if (needs_samples(&own->mirrored)) {
        status = trace_bounces(own, s, parts, out);
    } else {
        take_sums(own, srp_basis_lit_area(state->head.scene, own->head.basis), out);
    }
    out->f = out->f_bounce;
    out->t = out->t_bounce;
    return status;
}

static srp_status respond_alone(const srp_prepared *prepared, srp_scratch *scratch, srp_vec3 s,
                                srp_response *out) {
    (void)prepared;
    return respond_in_parts(scratch, s, out, 1);
}

static srp_status respond_shared(const srp_prepared *prepared, srp_scratch *scratch, srp_vec3 s,
                                 srp_response *out) {
    return respond_in_parts(scratch, s, out, prepared->params.threads);
}

static const srp_direction_kernel ALONE = {scratch_create, scratch_destroy, respond_alone};
static const srp_direction_kernel SHARED = {scratch_create, scratch_destroy, respond_shared};

/* ---- the method ---- */

static srp_status respond(const srp_prepared *prepared, size_t count, const srp_vec3 *s_body,
                          srp_response *responses, srp_basis *basis, srp_error *error) {
    raytrace *state = (raytrace *)prepared;
    /* Few directions share the threads among their samples, where they are likely to have any. */
    if (count >= (size_t)prepared->params.threads || (count > 1 && !state->scatters)) {
        return srp_respond_each(prepared, &ALONE, &state->pool, count, s_body, responses, basis,
                                error);
    }
    return srp_respond_in_turn(prepared, &SHARED, &state->pool, count, s_body, responses, basis,
                               error);
}

static void release(srp_prepared *prepared) {
    raytrace *state = (raytrace *)prepared;
    srp_scratch_pool_clear(&state->pool, &ALONE);
    srp_raster_mesh_clear(&state->mesh);
    srp_guide_destroy(state->world.guide);
    srp_bvh_destroy(state->world.bvh);
    free(state->world.sight);
    free(state);
}

/* What the sides of facets begin. */
static void look_at_facets(raytrace *state) {
    const srp_bounce_world *world = &state->world;
    for (uint32_t k = 0; k < world->scene->facet_count; ++k) {
        int sides = world->scene->facets[k].closed ? 1 : 2;
        for (int back = 0; back < sides; ++back) {
            srp_optics optics = srp_bounce_optics(world->scene, k, back != 0);
            bool starts = srp_bounce_starts(world, k, back != 0);
            state->reflects = state->reflects || starts;
            state->scatters = state->scatters || (starts && optics.rho_d > 0.0);
        }
    }
    state->scatters = state->scatters && world->diffuse > 0 && world->reflections > 0;
}

static srp_status prepare_bounces(raytrace *state, srp_error *error) {
    const srp_scene *scene = state->head.scene;
    int threads = state->head.params.threads;
    srp_status status = srp_sight_create(scene, threads, &state->world.sight, error);
    if (status != SRP_OK) {
        return status;
    }
    look_at_facets(state);
    if (!state->reflects) {
        return SRP_OK;
    }
    if (!srp_raster_mesh_create(&state->mesh, scene)) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for the raytrace method on %zu facets",
                        scene->facet_count);
    }
    status = srp_bvh_create(scene, threads, &state->world.bvh, error);
    if (status == SRP_OK && state->world.diffuse > 0 && state->world.reflections > 0) {
        status = srp_guide_create(scene, state->world.bvh, state->world.sight, threads,
                                  &state->world.guide, error);
    }
    return status;
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
    raytrace *state = calloc(1, sizeof *state);
    if (state == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for the raytrace method");
    }
    state->head.method = &srp_method_raytrace;
    state->head.scene = scene;
    state->head.params = *params;
    state->world.scene = scene;
    state->world.reference = params->reference;
    state->world.reflections = params->reflections;
    state->world.diffuse = params->diffuse;
    srp_status status = prepare_bounces(state, error);
    if (status != SRP_OK) {
        release(&state->head);
        return status;
    }
    *out = &state->head;
    return SRP_OK;
}

void srp_raytrace_watch(srp_prepared *prepared,
                        void (*watch)(void *user, const srp_bounce_event *event), void *user) {
    raytrace *state = (raytrace *)prepared;
    state->world.watch = watch;
    state->world.user = user;
}

void srp_raytrace_set_tracer(srp_prepared *prepared, srp_raytrace_tracer tracer) {
    ((raytrace *)prepared)->tracer = tracer;
}

srp_raytrace_tracer srp_raytrace_get_tracer(const srp_prepared *prepared) {
    return ((const raytrace *)prepared)->tracer;
}

const srp_bounce_world *srp_raytrace_world(const srp_prepared *prepared) {
    const raytrace *state = (const raytrace *)prepared;
    return state->reflects ? &state->world : NULL;
}

const srp_method srp_method_raytrace = {
    .name = "raytrace",
    .device = "cpu",
    .summary = "first hit and mirrored light solved exactly, the rest sampled by rays",
    .shapes = SRP_SHAPE_MESH,
    .capabilities = SRP_METHOD_BASIS | SRP_METHOD_LATTICE | SRP_METHOD_MOMENT | SRP_METHOD_BOUNCE,
    .prepare = prepare,
    .respond = respond,
    .release = release,
};
