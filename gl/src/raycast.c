/* SPDX-License-Identifier: Apache-2.0 */
/*
 * First hits sampled by a lattice, drawn by OpenGL.
 *
 * The lattice is the processor's (lattice.h), a sample is the centre of a cell, and what follows
 * from the counts is the same code (raycast_answer.h): only which facet a sample sees is found out
 * by the GPU, with a depth buffer. Numbers of facets come back, not floats. The processor projects
 * the mesh in double precision and leaves out what faces away or lies between samples; the GPU gets
 * vertices in samples, so that what float rounds is small beside a cell, whatever the shape of the
 * model.
 *
 * GPUs place vertices to 1/256 of a pixel. To have them placed to 1/512 of a cell, each cell is two
 * pixels wide and high. Its sample is the centre of the first; the other three are not used.
 *
 * Many directions are drawn before the first is read, each into a layer of its own; large lattices
 * are drawn in pieces. GPUs count fast, too, but the error of a response follows from where along
 * each row the numbers change, so that they are read.
 */
#include "raycast.h"

#include "canvas.h"
#include "error.h"
#include "methods.h"
#include "pool.h"
#include "raster_frame.h"
#include "raycast_answer.h"
#include "scene_internal.h"
#include "variation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    FINE = 2,              /* pixels along a side of a cell */
    SIDE_MAX = 2048,       /* samples along a side of a piece */
    SIDE_STEP = 64,        /* sides of layers are multiples of this [samples] */
    SAMPLES_MAX = 1 << 22, /* of all layers */
    DIRECTIONS_MAX = 64,   /* at a time; and layers */
    FACETS_MAX = 1 << 21   /* of all directions together */
};

/* A vertex is moved by up to half a step of the GPU's 1/512 of a cell, and by rounding to float: a
 * facet that comes no nearer to a sample than this [cells] is not drawn. */
static const double SNAP = 1.0 / 64.0;

/* Faces turned away lie behind others at the same place: by what moving the vertices of both may do
 * to their depth [pixels]. */
static const float BACK_RECEDES = 2.0F / 256.0F;

typedef struct raycast {
    srp_prepared head;
    srp_gl_pool pool;
    srp_raster_mesh mesh;
    double *lever2;
    srp_gl_raycast_watcher watch; /* NULL but in tests */
    void *user;
} raycast;

/* A direction in work. */
typedef struct shot {
    srp_raster_frame frame;
    size_t turned; /* facets of the frame that are turned to the Sun: the first */
    size_t begin;  /* of its triangles among those that were sent */
    srp_raster_tally *tally;
    srp_push *push;
    size_t capacity; /* of both */
    srp_variation variation;
    srp_basis *basis;
    size_t index; /* of the caller's direction */
    unsigned refine;
    bool done;
} shot;

/* Part of a direction's lattice, in a layer. */
typedef struct piece {
    shot *of;
    int32_t column, row, width, height; /* of the lattice */
} piece;

typedef struct raycast_worker {
    srp_gl_worker head;
    srp_gl_canvas canvas;
    int32_t side;    /* of a layer [samples] */
    uint32_t *ids;   /* (canvas.layers, canvas.side^2) pixels, packed to samples row by row */
    float *vertices; /* of all open directions, one after the other */
    uint32_t *indices;
    size_t vertex_capacity, index_capacity;
    size_t shot_count;
    shot *shots;
    shot **open;                  /* (shot_count) those that need another round */
    piece pieces[DIRECTIONS_MAX]; /* the k-th is in layer k */
    size_t piece_count;
} raycast_worker;

/* ---- workers ---- */

static size_t shots_for(const srp_scene *scene) {
    size_t count = FACETS_MAX / (scene->facet_count + 1);
    return count < 1 ? 1 : count > DIRECTIONS_MAX ? DIRECTIONS_MAX : count;
}

static void clear_shot(shot *of) {
    srp_raster_frame_clear(&of->frame);
    srp_variation_clear(&of->variation);
    free(of->tally);
    free(of->push);
    free(of->basis);
}

static void clear_worker(srp_gl_worker *worker) {
    raycast_worker *own = (raycast_worker *)worker;
    srp_gl_canvas_clear(&own->canvas);
    for (size_t k = 0; own->shots != NULL && k < own->shot_count; ++k) {
        clear_shot(&own->shots[k]);
    }
    free(own->shots);
    free(own->open);
    free(own->ids);
    free(own->vertices);
    free(own->indices);
}

/* Scratch memory for as many directions as are in work at once: made when first needed. */
static bool fill_shots(const raycast *state, raycast_worker *own, size_t count) {
    size_t row = state->head.scene->material_count + 1;
    for (size_t k = 0; k < count; ++k) {
        shot *of = &own->shots[k];
        if (of->basis == NULL) {
            of->basis = calloc(row, sizeof *of->basis);
        }
        if (of->basis == NULL ||
            (of->frame.mesh == NULL && !srp_raster_frame_create(&of->frame, &state->mesh))) {
            return false;
        }
    }
    return true;
}

static srp_status fill_worker(const srp_prepared *prepared, srp_gl_worker *worker,
                              srp_error *error) {
    raycast_worker *own = (raycast_worker *)worker;
    srp_status status = srp_gl_canvas_create(worker->context, &own->canvas, error);
    if (status != SRP_OK) {
        return status;
    }
    own->shot_count = shots_for(prepared->scene);
    own->shots = calloc(own->shot_count, sizeof *own->shots);
    own->open = calloc(own->shot_count, sizeof *own->open);
    if (own->shots == NULL || own->open == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for the %s method",
                        prepared->method->name);
    }
    return SRP_OK;
}

static const srp_gl_worker_kind WORKER = {sizeof(raycast_worker), fill_worker, clear_worker};

/* ---- what is drawn ---- */

/* Whether [low, high], widened by SNAP, holds one of the samples 0 .. count - 1. */
static inline bool holds_sample(double low, double high, double count) {
    low = low - SNAP > 0.0 ? low - SNAP : 0.0;
    high = high + SNAP < count - 1.0 ? high + SNAP : count - 1.0;
    return ceil(low) <= high;
}

static inline bool may_be_hit(const srp_raster_frame *frame, const uint32_t v[3]) {
    const double *x = frame->x, *y = frame->y;
    double ax = x[v[0]], bx = x[v[1]], cx = x[v[2]], ay = y[v[0]], by = y[v[1]], cy = y[v[2]];
    double left = ax < bx ? ax : bx, right = ax < bx ? bx : ax;
    double low = ay < by ? ay : by, high = ay < by ? by : ay;
    return holds_sample(left < cx ? left : cx, right > cx ? right : cx, frame->lattice.columns) &&
           holds_sample(low < cy ? low : cy, high > cy ? high : cy, frame->lattice.rows);
}

/* Lists facets that are drawn, those turned to the Sun first, in place of the rasteriser's own
 * list, which relies on its exact edges. */
static void list_facets(shot *of) {
    srp_raster_frame *frame = &of->frame;
    const srp_raster_mesh *mesh = frame->mesh;
    size_t count = 0;
    for (size_t k = 0; k < mesh->facet_count; ++k) {
        if (frame->cosine[k] > 0.0 && may_be_hit(frame, mesh->v[k])) {
            frame->facet[count++] = (uint32_t)k;
        }
    }
    of->turned = count;
    for (size_t k = 0; !mesh->all_closed && k < mesh->facet_count; ++k) {
        if (frame->cosine[k] < 0.0 && mesh->open[k] && may_be_hit(frame, mesh->v[k])) {
            frame->facet[count++] = (uint32_t)k;
        }
    }
    frame->facet_count = count;
}

static bool reserve(shot *of) {
    size_t count = of->frame.facet_count;
    if (count > of->capacity) {
        free(of->tally);
        free(of->push);
        of->capacity = 0;
        of->tally = malloc(count * sizeof *of->tally);
        of->push = malloc(count * sizeof *of->push);
        if (of->tally == NULL || of->push == NULL) {
            return false;
        }
        of->capacity = count;
    }
    return true;
}

/* Empties the counts of a direction, and finds out what light does to its facets. */
static bool begin_count(shot *of) {
    srp_raster_frame *frame = &of->frame;
    if (!reserve(of) || !srp_variation_begin(&of->variation, frame->kind, &frame->lattice)) {
        return false;
    }
    for (size_t n = 0; n < frame->facet_count; ++n) {
        srp_raster_side side = srp_raster_frame_side(frame, frame->facet[n]);
        of->push[n] = srp_push_make(srp_raster_side_push(&side, frame->lattice.view.s));
        of->tally[n] = (srp_raster_tally){0, 0, 0};
    }
    return true;
}

/* Everything of a direction that the processor does before it is drawn. */
static bool aim(const raycast *state, shot *of, srp_vec3 s) {
    srp_raster_frame *frame = &of->frame;
    srp_raycast_set_up_frame(&state->head, frame, s, of->refine);
    list_facets(of);
    return begin_count(of);
}

/* Vertices as the GPU takes them: in samples, and in depth with some room in its range. */
static void write_vertices(const srp_raster_frame *frame, double radius, float *out) {
    size_t count = frame->mesh->vertex_count;
    double far = INFINITY, near = -INFINITY;
    for (size_t i = 0; i < count; ++i) {
        double h = frame->depth[i];
        far = h < far ? h : far; /* not fmin(): that is a call for each vertex */
        near = h > near ? h : near;
    }
    /* A sheet that faces the Sun has no depth at all. */
    double range = fmax(near - far, 1e-6 * radius), middle = 0.5 * (near + far), room = 1.98;
    for (size_t i = 0; i < count; ++i) {
        out[3 * i] = (float)frame->x[i];
        out[3 * i + 1] = (float)frame->y[i];
        out[3 * i + 2] = (float)(room * (middle - frame->depth[i]) / range);
    }
}

/* `first`: number of the direction's first vertex. */
static void write_indices(const srp_raster_frame *frame, uint32_t first, uint32_t *out) {
    for (size_t n = 0; n < frame->facet_count; ++n) {
        const uint32_t *v = frame->mesh->v[frame->facet[n]];
        for (int corner = 0; corner < 3; ++corner) {
            *out++ = first + v[corner];
        }
    }
}

/* Room for `count` objects of `size` bytes in place of an array; what it holds may be lost. NULL:
 * no memory. */
static void *make_room(void *array, size_t *capacity, size_t count, size_t size) {
    if (array != NULL && count <= *capacity) {
        return array;
    }
    free(array);
    array = malloc((count > 0 ? count : 1) * size);
    *capacity = array != NULL ? count : 0;
    return array;
}

static bool send_triangles(const raycast *state, raycast_worker *own, size_t open_count) {
    size_t vertex_count = state->mesh.vertex_count, count = 0;
    for (size_t k = 0; k < open_count; ++k) {
        own->open[k]->begin = count;
        count += own->open[k]->frame.facet_count;
    }
    own->indices = make_room(own->indices, &own->index_capacity, 3 * count, sizeof *own->indices);
    own->vertices = make_room(own->vertices, &own->vertex_capacity, 3 * open_count * vertex_count,
                              sizeof *own->vertices);
    if (own->indices == NULL || own->vertices == NULL) {
        return false;
    }
    int threads = state->head.params.threads;
    (void)threads; /* without OpenMP */
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
    for (size_t k = 0; k < open_count; ++k) {
        const shot *of = own->open[k];
        write_vertices(&of->frame, state->head.scene->radius, own->vertices + 3 * k * vertex_count);
        write_indices(&of->frame, (uint32_t)(k * vertex_count), own->indices + 3 * of->begin);
    }
    srp_gl_canvas_send(&own->canvas, own->vertices, open_count * vertex_count, own->indices,
                       3 * count);
    return true;
}

static srp_gl_view view_of(const piece *at) {
    srp_gl_view view = {.width = FINE * at->width, .height = FINE * at->height};
    /* A sample is the middle of a pixel: 0 lies half a pixel from the left edge. */
    const double half_pixel = 0.5 / FINE;
    view.middle[0] = (float)(at->column + 0.5 * at->width - half_pixel);
    view.middle[1] = (float)(at->row + 0.5 * at->height - half_pixel);
    view.scale[0] = (float)(2.0 / at->width);
    view.scale[1] = (float)(2.0 / at->height);
    return view;
}

static void draw_piece(const raycast_worker *own, const piece *at) {
    const shot *of = at->of;
    srp_gl_view view = view_of(at);
    srp_gl_canvas_draw(&own->canvas, &view, of->begin, of->turned, 1);
    view.recede = BACK_RECEDES;
    srp_gl_canvas_draw(&own->canvas, &view, of->begin + of->turned,
                       of->frame.facet_count - of->turned, (uint32_t)of->turned + 1);
}

/* ---- counting ---- */

static void count_row(shot *of, const uint32_t *ids, int32_t width, int32_t column, int32_t row) {
    for (int32_t i = 0; i < width;) {
        uint32_t id = ids[i];
        int32_t end = i + 1;
        while (end < width && ids[end] == id) {
            ++end;
        }
        size_t n = (size_t)id - 1; /* 0, nothing, is beyond all */
        if (n < of->frame.facet_count) {
            srp_raster_tally *tally = &of->tally[n];
            int64_t length = end - i, begin = column + i;
            tally->n += length;
            tally->i += length * (2 * begin + length - 1) / 2;
            tally->j += length * row;
            srp_variation_add(&of->variation, column + i, column + end, row, &of->push[n]);
        }
        i = end;
    }
}

/* Leaves the samples of a row of pixels, in place; returns them. */
static const uint32_t *pack_row(uint32_t *pixels, int32_t width) {
    for (int32_t i = 1; i < width; ++i) {
        pixels[i] = pixels[FINE * i];
    }
    return pixels;
}

static uint32_t *layer_of(const raycast_worker *own, size_t layer) {
    return own->ids + layer * (size_t)own->canvas.side * (size_t)own->canvas.side;
}

/* Counts all pieces of a direction. */
static void count_shot(const raycast *state, const raycast_worker *own, shot *of) {
    for (size_t k = 0; k < own->piece_count; ++k) {
        const piece *at = &own->pieces[k];
        for (int32_t j = 0; at->of == of && j < at->height; ++j) {
            size_t begin = (size_t)FINE * (size_t)j * (size_t)FINE * (size_t)at->width;
            const uint32_t *ids = pack_row(layer_of(own, k) + begin, at->width);
            if (state->watch != NULL) {
                state->watch(state->user, &of->frame, at->column, at->row + j, at->width, ids);
            }
            count_row(of, ids, at->width, at->column, at->row + j);
        }
    }
}

/* ---- layers ---- */

/* Makes layers that fit the directions that are open, unless they are there. */
static srp_status choose_layers(raycast_worker *own, size_t open_count, srp_error *error) {
    int32_t limit = own->head.context->side_max / FINE;
    limit = limit < SIDE_MAX ? limit : SIDE_MAX;
    int32_t longest = 1;
    for (size_t k = 0; k < open_count; ++k) {
        const srp_lattice *lattice = &own->open[k]->frame.lattice;
        longest = lattice->columns > longest ? lattice->columns : longest;
        longest = lattice->rows > longest ? lattice->rows : longest;
    }
    int32_t side = (longest + SIDE_STEP - 1) / SIDE_STEP * SIDE_STEP;
    side = side < limit ? side : limit;
    if (side <= own->side && own->side < 2 * side) {
        return SRP_OK; /* what lies beyond a lattice costs nothing */
    }
    own->side = 0; /* until there is memory for both */
    int32_t pixels = FINE * side;
    int32_t layers = SAMPLES_MAX / (side * side);
    layers = layers < 1 ? 1 : layers > DIRECTIONS_MAX ? DIRECTIONS_MAX : layers;
    free(own->ids);
    own->ids = malloc((size_t)layers * (size_t)pixels * (size_t)pixels * sizeof *own->ids);
    if (own->ids == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for %d pictures of %d x %d samples",
                        layers, side, side);
    }
    srp_status status = srp_gl_canvas_resize(&own->canvas, pixels, layers, error);
    own->side = status == SRP_OK ? side : 0;
    return status;
}

/* Reads the pictures that were drawn, and counts them. */
static srp_status flush(const raycast *state, raycast_worker *own, size_t open_count,
                        srp_error *error) {
    for (size_t k = 0; k < own->piece_count; ++k) {
        srp_gl_canvas_read(&own->canvas, (GLint)k, FINE * own->pieces[k].width,
                           FINE * own->pieces[k].height, layer_of(own, k));
    }
    srp_status status = srp_gl_context_check(own->head.context, "drawing triangles", error);
    if (status == SRP_OK && own->piece_count > 0) {
        int threads = state->head.params.threads;
        (void)threads; /* without OpenMP */
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
        for (size_t k = 0; k < open_count; ++k) {
            count_shot(state, own, own->open[k]);
        }
    }
    own->piece_count = 0;
    return status;
}

/* Draws a piece into the next layer, and makes room first when all are in use. */
static srp_status add_piece(const raycast *state, raycast_worker *own, size_t open_count,
                            const piece *at, srp_error *error) {
    srp_status status = SRP_OK;
    if (own->piece_count == (size_t)own->canvas.layers) {
        status = flush(state, own, open_count, error);
    }
    if (status == SRP_OK) {
        srp_gl_canvas_begin(&own->canvas, (GLint)own->piece_count, FINE * at->width,
                            FINE * at->height);
        draw_piece(own, at);
        own->pieces[own->piece_count++] = *at;
    }
    return status;
}

/* Draws and counts all directions that are open. */
static srp_status draw_all(const raycast *state, raycast_worker *own, size_t open_count,
                           srp_error *error) {
    srp_status status = choose_layers(own, open_count, error);
    int32_t side = own->side;
    own->piece_count = 0;
    for (size_t k = 0; k < open_count && status == SRP_OK; ++k) {
        const srp_lattice *lattice = &own->open[k]->frame.lattice;
        for (int32_t row = 0; row < lattice->rows; row += side) {
            for (int32_t column = 0; column < lattice->columns && status == SRP_OK;
                 column += side) {
                int32_t width = lattice->columns - column, height = lattice->rows - row;
                piece at = {.of = own->open[k],
                            .column = column,
                            .row = row,
                            .width = width < side ? width : side,
                            .height = height < side ? height : side};
                status = add_piece(state, own, open_count, &at, error);
            }
        }
    }
    return status == SRP_OK ? flush(state, own, open_count, error) : status;
}

/* ---- directions ---- */

/* Leaves those in own->open that need another round; returns how many. */
static size_t answer(const raycast *state, raycast_worker *own, size_t open_count,
                     srp_response *responses) {
    int threads = state->head.params.threads;
    (void)threads; /* without OpenMP */
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
    for (size_t k = 0; k < open_count; ++k) {
        shot *of = own->open[k];
        srp_raycast_count count = {&of->frame, of->tally, &of->variation};
        of->done = srp_raycast_answer(&state->head, state->lever2, &count, of->basis,
                                      &responses[of->index]);
        of->refine += 1;
    }
    size_t left = 0;
    for (size_t k = 0; k < open_count; ++k) {
        if (!own->open[k]->done) {
            own->open[left++] = own->open[k];
        }
    }
    return left;
}

/* Draws the directions that are open once; *open_count is then of those that need it again. */
static srp_status run_round(const raycast *state, raycast_worker *own, const srp_vec3 *s,
                            srp_response *responses, size_t *open_count, srp_error *error) {
    int failed = 0, threads = state->head.params.threads;
    (void)threads; /* without OpenMP */
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1) reduction(|| : failed)
    for (size_t k = 0; k < *open_count; ++k) {
        failed = failed || !aim(state, own->open[k], s[own->open[k]->index]);
    }
    if (failed || !send_triangles(state, own, *open_count)) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for the %s method",
                        state->head.method->name);
    }
    srp_status status = draw_all(state, own, *open_count, error);
    if (status == SRP_OK) {
        *open_count = answer(state, own, *open_count, responses);
    }
    return status;
}

static srp_status run_batch(const raycast *state, raycast_worker *own, size_t count,
                            const srp_vec3 *s, srp_response *responses, srp_basis *basis,
                            srp_error *error) {
    const srp_scene *scene = state->head.scene;
    size_t row = scene->material_count + 1, open_count = count;
    if (!fill_shots(state, own, count)) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for the %s method",
                        state->head.method->name);
    }
    for (size_t k = 0; k < count; ++k) {
        own->open[k] = &own->shots[k];
        own->shots[k].index = k;
        own->shots[k].refine = 0;
        memset(&responses[k], 0, sizeof responses[k]);
    }
    while (open_count > 0) {
        srp_status status = run_round(state, own, s, responses, &open_count, error);
        if (status != SRP_OK) {
            return status;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        srp_basis_finish(scene, own->shots[k].basis, s[k], &responses[k]);
        if (basis != NULL) {
            memcpy(basis + k * row, own->shots[k].basis, row * sizeof *basis);
        }
    }
    return SRP_OK;
}

srp_status srp_gl_raycast_respond(const srp_prepared *prepared, size_t count,
                                  const srp_vec3 *s_body, srp_response *responses, srp_basis *basis,
                                  srp_error *error) {
    raycast *state = (raycast *)prepared;
    srp_gl_worker *worker = NULL;
    srp_status status = srp_gl_pool_take(&state->pool, &worker, error);
    if (status != SRP_OK) {
        return status;
    }
    raycast_worker *own = (raycast_worker *)worker;
    size_t row = prepared->scene->material_count + 1;
    for (size_t begin = 0; begin < count && status == SRP_OK; begin += own->shot_count) {
        size_t left = count - begin;
        status =
            run_batch(state, own, left < own->shot_count ? left : own->shot_count, s_body + begin,
                      responses + begin, basis != NULL ? basis + begin * row : NULL, error);
    }
    srp_gl_pool_give(&state->pool, worker);
    return status;
}

/* ---- the method ---- */

void srp_gl_raycast_release(srp_prepared *prepared) {
    raycast *state = (raycast *)prepared;
    srp_gl_pool_clear(&state->pool);
    srp_raster_mesh_clear(&state->mesh);
    free(state->lever2);
    free(state);
}

srp_status srp_gl_raycast_prepare(const srp_method *method, const srp_gl_device *device,
                                  const srp_scene *scene, const srp_method_params *params,
                                  srp_prepared **out, srp_error *error) {
    srp_status status = srp_raycast_check_lattice(scene, params, error);
    if (status != SRP_OK) {
        return status;
    }
    raycast *state = calloc(1, sizeof *state);
    if (state == NULL) {
        goto fail;
    }
    state->head.method = method;
    state->head.scene = scene;
    state->head.params = *params;
    state->pool.device = device;
    state->pool.kind = &WORKER;
    state->pool.prepared = &state->head;
    state->lever2 = srp_raycast_measure_levers(scene, params->reference);
    if (state->lever2 == NULL || !srp_raster_mesh_create(&state->mesh, scene)) {
        srp_gl_raycast_release(&state->head);
        goto fail;
    }
    status = srp_gl_pool_warm_up(&state->pool, error);
    if (status != SRP_OK) {
        srp_gl_raycast_release(&state->head);
        return status;
    }
    *out = &state->head;
    return SRP_OK;
fail:
    return srp_fail(error, SRP_NO_MEMORY, "no memory for the raycast method on %zu facets",
                    scene->facet_count);
}

void srp_gl_raycast_watch(srp_prepared *prepared, srp_gl_raycast_watcher watch, void *user) {
    raycast *state = (raycast *)prepared;
    state->watch = watch;
    state->user = user;
}
