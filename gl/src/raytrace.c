/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reflected light traced by a compute shader.
 *
 * The method is the processor's: direct light is solved exactly, and mirrored light as far as it is
 * there, the samples' first hits are drawn in double precision, and errors follow from the same
 * sums (raytrace.c of srpcore). Taken over are the rays: bounce.comp.glsl follows the same paths
 * through the same hierarchy, with the same points for scattered directions. It writes the sums of
 * each path by itself, in float, and they are added here in double and in order, so that the
 * scheduling of the GPU shows nowhere.
 */
#include "raytrace.h"

#include "error.h"
#include "methods.h"
#include "pool.h"
#include "program.h"
#include "raster_canvas.h"
#include "raytrace_world.h"

#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    GROUP = 64,                /* invocations of a work group, as in the shader */
    INVOCATIONS_MAX = 1 << 18, /* of a dispatch, unless one sample alone has more */
    STACK_MAX = 512,
    SUM_FLOATS = 16 /* of an invocation */
};

/* Whether buffers are read as storage; else as textures, which Mesa's software renderer reads half
 * again as fast. */
#ifndef SRP_GL_BUFFERS_ARE_STORAGE
#define SRP_GL_BUFFERS_ARE_STORAGE 0
#endif

/* Buffers by their place in the shader; the first is written, the others are read. */
enum { SUMS, NODES, BLOCKS, FACETS, GUIDES, POINTS, SAMPLES, BUFFERS };

typedef struct tracer {
    srp_gl_pool pool;
    srp_gl_world world;
    atomic_int failure; /* of a trace: its srp_status */
} tracer;

typedef struct raytrace_worker {
    srp_gl_worker head;
    GLuint program, buffers[BUFFERS], textures[BUFFERS];
    GLint sample_count, slots, diffuse, reflections, sun_ray; /* places of uniforms */
    srp_raster_canvas canvas;
    srp_gl_texel *points;
    size_t sample_capacity;
    srp_gl_texel *samples;
    float *sums;
} raytrace_worker;

static uint32_t slots_of(const srp_bounce_world *world) {
    return 1 + world->diffuse;
}

static size_t points_size(const srp_bounce_world *world) {
    size_t bounces = world->reflections > 0 ? world->reflections : 1;
    return bounces * SRP_BOUNCE_COORDINATES * SRP_GL_POINT_TEXELS * sizeof(srp_gl_texel);
}

/* ---- workers ---- */

static void clear_worker(srp_gl_worker *worker) {
    raytrace_worker *own = (raytrace_worker *)worker;
    const srp_gl_functions *gl = &worker->context->gl;
    gl->DeleteProgram(own->program);
    gl->DeleteBuffers(BUFFERS, own->buffers);
    gl->DeleteTextures(BUFFERS, own->textures);
    srp_raster_canvas_clear(&own->canvas);
    free(own->points);
    free(own->samples);
    free(own->sums);
}

static srp_status create_program(const tracer *state, raytrace_worker *own, srp_error *error) {
    static const srp_gl_stage STAGE = {GL_COMPUTE_SHADER, &srp_gl_bounce_comp};
    const srp_gl_context *context = own->head.context;
    unsigned stack = (state->world.stack + 16) / 16 * 16;
    char prelude[256];
    if (stack > STACK_MAX) {
        return srp_fail(error, SRP_UNSUPPORTED,
                        "searches of this model put %u places aside, OpenGL has room for %d", stack,
                        STACK_MAX);
    }
    (void)snprintf(prelude, sizeof prelude,
                   "#version 430 core\n#define STACK %u\n#define LIFT %.9g\n%s", stack, SRP_GL_LIFT,
                   SRP_GL_BUFFERS_ARE_STORAGE ? "#define STORAGE\n" : "");
    srp_status status = srp_gl_program_create(context, prelude, &STAGE, 1, &own->program, error);
    if (status == SRP_OK) {
        const srp_gl_functions *gl = &context->gl;
        own->sample_count = gl->GetUniformLocation(own->program, "sample_count");
        own->slots = gl->GetUniformLocation(own->program, "slots");
        own->diffuse = gl->GetUniformLocation(own->program, "diffuse");
        own->reflections = gl->GetUniformLocation(own->program, "reflections");
        own->sun_ray = gl->GetUniformLocation(own->program, "sun_ray");
    }
    return status;
}

/* Room for `size` bytes, which are `data` unless that is NULL. */
static srp_status create_buffer(raytrace_worker *own, int place, const void *data, size_t size,
                                srp_error *error) {
    const srp_gl_context *context = own->head.context;
    const srp_gl_functions *gl = &context->gl;
    if (size / sizeof(srp_gl_texel) > (size_t)context->texels_max) {
        return srp_fail(error, SRP_NO_DEVICE,
                        "%s (%s) has textures of %d texels, the model wants %zu",
                        context->device->name, context->renderer, (int)context->texels_max,
                        size / sizeof(srp_gl_texel));
    }
    gl->GenBuffers(1, &own->buffers[place]);
    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, own->buffers[place]);
    gl->BufferData(GL_SHADER_STORAGE_BUFFER, (GLsizeiptr)size, data,
                   place == SUMS ? GL_STREAM_READ : GL_STATIC_DRAW);
    if (!SRP_GL_BUFFERS_ARE_STORAGE && place != SUMS) {
        gl->GenTextures(1, &own->textures[place]);
        gl->BindTexture(GL_TEXTURE_BUFFER, own->textures[place]);
        gl->TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32UI, own->buffers[place]);
    }
    return srp_gl_context_check(context, "the model", error);
}

static srp_status create_buffers(const tracer *state, raytrace_worker *own, srp_error *error) {
    const srp_gl_world *world = &state->world;
    const size_t texel = sizeof(srp_gl_texel);
    size_t facet_count = world->world->scene->facet_count;
    size_t invocations = own->sample_capacity * slots_of(world->world);
    const struct {
        const void *data;
        size_t size;
    } contents[BUFFERS] = {
        [SUMS] = {NULL, invocations * SUM_FLOATS * sizeof(float)},
        [NODES] = {world->nodes, world->node_count * SRP_GL_NODE_TEXELS * texel},
        [BLOCKS] = {world->blocks, world->block_count * SRP_GL_BLOCK_TEXELS * texel},
        [FACETS] = {world->facets, facet_count * SRP_GL_FACET_TEXELS * texel},
        [GUIDES] = {world->guides, world->guide_count * SRP_GL_GUIDE_TEXELS * texel},
        [POINTS] = {NULL, points_size(world->world)},
        [SAMPLES] = {NULL, own->sample_capacity * SRP_GL_SAMPLE_TEXELS * texel},
    };
    srp_status status = SRP_OK;
    for (int place = 0; place < BUFFERS && status == SRP_OK; ++place) {
        status = create_buffer(own, place, contents[place].data, contents[place].size, error);
    }
    return status;
}

static srp_status fill_worker(const srp_prepared *prepared, srp_gl_worker *worker,
                              srp_error *error) {
    const tracer *state = srp_raytrace_get_tracer(prepared).user;
    const srp_bounce_world *world = state->world.world;
    raytrace_worker *own = (raytrace_worker *)worker;
    if (!worker->context->computes) {
        return srp_fail(
            error, SRP_NO_DEVICE,
            "%s (%s) has no compute shaders: raytrace needs OpenGL 4.3, raycast does not",
            worker->context->device->name, worker->context->renderer);
    }
    own->sample_capacity = INVOCATIONS_MAX / slots_of(world);
    own->points = malloc(points_size(world));
    own->samples = malloc(own->sample_capacity * SRP_GL_SAMPLE_TEXELS * sizeof *own->samples);
    own->sums = malloc(own->sample_capacity * slots_of(world) * SUM_FLOATS * sizeof *own->sums);
    if (own->points == NULL || own->samples == NULL || own->sums == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for the %s method",
                        prepared->method->name);
    }
    srp_status status = create_program(state, own, error);
    return status == SRP_OK ? create_buffers(state, own, error) : status;
}

static const srp_gl_worker_kind WORKER = {sizeof(raytrace_worker), fill_worker, clear_worker};

/* ---- tracing ---- */

/* A direction on its way. */
typedef struct job {
    const tracer *state;
    const srp_raytrace_beam *beam;
    raytrace_worker *own;
    srp_bounce_sums *sums;
    size_t count; /* samples that wait */
    srp_status status;
} job;

static void bind_all(const raytrace_worker *own) {
    const srp_gl_functions *gl = &own->head.context->gl;
    for (GLuint place = 0; place < BUFFERS; ++place) {
        if (SRP_GL_BUFFERS_ARE_STORAGE || place == SUMS) {
            gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, place, own->buffers[place]);
        } else {
            gl->ActiveTexture(GL_TEXTURE0 + place);
            gl->BindTexture(GL_TEXTURE_BUFFER, own->textures[place]);
        }
    }
}

static void send(const raytrace_worker *own, int place, const void *data, size_t size) {
    const srp_gl_functions *gl = &own->head.context->gl;
    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, own->buffers[place]);
    gl->BufferSubData(GL_SHADER_STORAGE_BUFFER, 0, (GLsizeiptr)size, data);
}

static void begin(const job *at) {
    const srp_bounce_world *world = at->beam->world;
    const srp_gl_functions *gl = &at->own->head.context->gl;
    srp_vec3 s = at->beam->frame->lattice.view.s;
    if (world->reflections > 0) {
        srp_gl_write_points(at->beam->seed, world->reflections, at->own->points);
        send(at->own, POINTS, at->own->points, points_size(world));
    }
    gl->UseProgram(at->own->program);
    gl->Uniform1ui(at->own->slots, slots_of(world));
    gl->Uniform1ui(at->own->diffuse, world->diffuse);
    gl->Uniform1ui(at->own->reflections, world->reflections);
    gl->Uniform3f(at->own->sun_ray, (float)-s.x, (float)-s.y, (float)-s.z);
    bind_all(at->own);
}

static void add_sum(srp_bounce_sum *into, const float *f, const float *t, double flux,
                    double per_unit, srp_vec3 lever) {
    srp_vec3 push = srp_vec3_scale(flux, srp_vec3_make(f[0], f[1], f[2]));
    srp_vec3 moment = srp_vec3_scale(flux * per_unit, srp_vec3_make(t[0], t[1], t[2]));
    into->f = srp_vec3_add(into->f, push);
    into->t = srp_vec3_add(into->t, srp_vec3_add(moment, srp_vec3_cross(lever, push)));
}

/* Adds what the samples' invocations found: in order. */
static void collect(const job *at) {
    const srp_bounce_world *world = at->beam->world;
    const srp_lattice *lattice = &at->beam->frame->lattice;
    double flux = lattice->du * lattice->dv, per_unit = 1.0 / at->state->world.unit;
    srp_vec3 lever = srp_vec3_sub(at->state->world.centre, world->reference);
    const float *sum = at->own->sums;
    for (size_t n = 0; n < at->count; ++n) {
        const uint32_t *place = at->own->samples[n * SRP_GL_SAMPLE_TEXELS + 1].word;
        srp_bounce_sum *group =
            at->sums->group[srp_bounce_group_of((int32_t)place[0], (int32_t)place[1])];
        for (uint32_t slot = 0; slot < slots_of(world); ++slot, sum += SUM_FLOATS) {
            add_sum(&group[SRP_BOUNCE_SPECULAR], sum, sum + 4, flux, per_unit, lever);
            add_sum(&group[SRP_BOUNCE_DIFFUSE], sum + 8, sum + 12, flux, per_unit, lever);
            at->sums->unresolved[SRP_BOUNCE_SPECULAR] += flux * (double)sum[3];
            at->sums->unresolved[SRP_BOUNCE_DIFFUSE] += flux * (double)sum[11];
            at->sums->rays += (uint64_t)sum[7];
        }
    }
}

/* Traces the samples that wait. */
static void flush(job *at) {
    const srp_gl_functions *gl = &at->own->head.context->gl;
    size_t invocations = at->count * slots_of(at->beam->world);
    if (at->count == 0 || at->status != SRP_OK) {
        return;
    }
    send(at->own, SAMPLES, at->own->samples,
         at->count * SRP_GL_SAMPLE_TEXELS * sizeof *at->own->samples);
    gl->Uniform1ui(at->own->sample_count, (GLuint)at->count);
    gl->DispatchCompute((GLuint)((invocations + GROUP - 1) / GROUP), 1, 1);
    gl->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, at->own->buffers[SUMS]);
    gl->GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0,
                         (GLsizeiptr)(invocations * SUM_FLOATS * sizeof *at->own->sums),
                         at->own->sums);
    at->status = srp_gl_context_check(at->own->head.context, "tracing rays", NULL);
    if (at->status == SRP_OK) {
        collect(at);
    }
    at->count = 0;
}

static void add_sample(job *at, const srp_raster_plane *plane, uint32_t facet, bool back, int32_t i,
                       int32_t j) {
    if (at->count == at->own->sample_capacity) {
        flush(at);
    }
    const srp_lattice *lattice = &at->beam->frame->lattice;
    const srp_gl_world *world = &at->state->world;
    double height = plane->at + i * plane->along_i + j * plane->along_j;
    srp_vec3 point =
        srp_view_lift(&lattice->view, srp_vec3_make(lattice->u0 + i * lattice->du,
                                                    lattice->v0 + j * lattice->dv, height));
    point = srp_vec3_scale(world->unit, srp_vec3_sub(point, world->centre));
    const float place[3] = {(float)point.x, (float)point.y, (float)point.z};
    srp_gl_texel *out = &at->own->samples[at->count++ * SRP_GL_SAMPLE_TEXELS];
    memcpy(out[0].word, place, sizeof place);
    out[0].word[3] = facet;
    out[1] = (srp_gl_texel){{(uint32_t)i, (uint32_t)j, back, 0}};
}

/* Samples [begin, end) of row j hit one facet. */
static void start_paths(void *user, uint32_t n, int32_t first, int32_t end, int32_t j) {
    job *at = user;
    const srp_raster_frame *frame = at->beam->frame;
    uint32_t facet = frame->facet[n];
    bool back = frame->cosine[facet] < 0.0;
    if (srp_bounce_starts(at->beam->world, facet, back)) {
        srp_raster_plane plane = srp_raster_frame_plane(frame, facet, frame->mesh->v[facet][0]);
        for (int32_t i = first; i < end; ++i) {
            add_sample(at, &plane, facet, back, i, j);
        }
    }
}

static srp_status trace_with(const tracer *state, raytrace_worker *own,
                             const srp_raytrace_beam *beam, srp_bounce_sums *sums) {
    job at = {.state = state, .beam = beam, .own = own, .sums = sums, .status = SRP_OK};
    if (!srp_raster_canvas_begin(&own->canvas, beam->frame)) {
        return SRP_NO_MEMORY;
    }
    begin(&at);
    srp_raster_canvas_visit(&own->canvas, beam->frame, beam->row_begin, beam->row_end, start_paths,
                            &at);
    flush(&at);
    return at.status;
}

/* srp_raytrace_tracer.trace */
static srp_status trace(void *user, const srp_raytrace_beam *beam, srp_bounce_sums *sums) {
    tracer *state = user;
    srp_gl_worker *worker = NULL;
    srp_status status = srp_gl_pool_take(&state->pool, &worker, NULL);
    if (status == SRP_OK) {
        status = trace_with(state, (raytrace_worker *)worker, beam, sums);
        srp_gl_pool_give(&state->pool, worker);
    }
    if (status != SRP_OK) {
        atomic_store(&state->failure, (int)status);
    }
    return status;
}

/* ---- the method ---- */

srp_status srp_gl_raytrace_respond(const srp_prepared *prepared, size_t count,
                                   const srp_vec3 *s_body, srp_response *responses,
                                   srp_basis *basis, srp_error *error) {
    tracer *state = srp_raytrace_get_tracer(prepared).user;
    srp_status status =
        srp_method_raytrace.respond(prepared, count, s_body, responses, basis, error);
    if (status != SRP_OK && state != NULL &&
        atomic_exchange(&state->failure, SRP_OK) == SRP_NO_DEVICE) {
        return srp_fail(error, SRP_NO_DEVICE, "%s failed while it traced rays",
                        state->pool.device->name);
    }
    return status;
}

void srp_gl_raytrace_release(srp_prepared *prepared) {
    tracer *state = srp_raytrace_get_tracer(prepared).user;
    if (state != NULL) {
        srp_gl_pool_clear(&state->pool);
        srp_gl_world_clear(&state->world);
        free(state);
    }
    srp_method_raytrace.release(prepared);
}

/* Has the rays of a prepared raytrace method traced by OpenGL. */
static srp_status take_over(srp_prepared *prepared, const srp_gl_device *device, srp_error *error) {
    tracer *state = calloc(1, sizeof *state);
    if (state == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for the raytrace method");
    }
    state->pool.device = device;
    state->pool.kind = &WORKER;
    state->pool.prepared = prepared;
    srp_raytrace_set_tracer(prepared, (srp_raytrace_tracer){trace, state});
    srp_status status = srp_gl_world_create(srp_raytrace_world(prepared), &state->world, error);
    return status == SRP_OK ? srp_gl_pool_warm_up(&state->pool, error) : status;
}

/* A device that is not there is told of, though there are no rays for it. */
static srp_status try_device(const srp_gl_device *device, srp_error *error) {
    srp_gl_context *context = NULL;
    srp_status status = srp_gl_context_create(device, &context, error);
    srp_gl_context_destroy(context);
    return status;
}

srp_status srp_gl_raytrace_prepare(const srp_method *method, const srp_gl_device *device,
                                   const srp_scene *scene, const srp_method_params *params,
                                   srp_prepared **out, srp_error *error) {
    srp_prepared *prepared = NULL;
    srp_status status = srp_method_raytrace.prepare(scene, params, &prepared, error);
    if (status != SRP_OK) {
        return status;
    }
    prepared->method = method;
    status = srp_raytrace_world(prepared) != NULL ? take_over(prepared, device, error)
                                                  : try_device(device, error);
    if (status != SRP_OK) {
        srp_gl_raytrace_release(prepared);
        return status;
    }
    *out = prepared;
    return SRP_OK;
}
