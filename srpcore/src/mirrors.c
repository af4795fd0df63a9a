/* SPDX-License-Identifier: Apache-2.0 */
#include "mirrors.h"

#include "exact_lit.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

/* A lit part of a facet that mirrors light. */
typedef struct mirror {
    uint32_t facet;
    bool back;
    double area;        /* cross-section [m^2] */
    size_t part, count; /* its polygons in the level */
} mirror;

/* Those that one beam lights. */
typedef struct level {
    mirror *mirrors;
    size_t count, capacity;
    srp_polygon *parts;
    size_t part_count, part_capacity;
} level;

struct srp_mirrors {
    const srp_bounce_world *world;
    srp_visible *visible;
    uint32_t *reach; /* facets that a beam may hit */
    double
        trifle; /* cross-section that may be rounding noise: the light is left unresolved [m^2] */
    uint32_t limit, beams;
    srp_basis *basis;
    srp_mirrored *out;
    level levels[]; /* (reflections) by bounces behind */
};

void srp_mirrors_destroy(srp_mirrors *work) {
    if (work == NULL) {
        return;
    }
    for (uint32_t k = 0; k < work->world->reflections; ++k) {
        free(work->levels[k].mirrors);
        free(work->levels[k].parts);
    }
    srp_visible_destroy(work->visible);
    free(work->reach);
    free(work);
}

srp_mirrors *srp_mirrors_create(const srp_bounce_world *world) {
    const srp_scene *scene = world->scene;
    srp_mirrors *work = calloc(1, sizeof *work + world->reflections * sizeof work->levels[0]);
    if (work == NULL) {
        return NULL;
    }
    double size = srp_vec3_norm(scene->centre) + scene->radius;
    work->world = world;
    work->trifle = 16.0 * DBL_EPSILON * size * scene->radius;
    work->visible = srp_visible_create(scene);
    work->reach = malloc(scene->facet_count * sizeof *work->reach);
    if (work->visible == NULL || work->reach == NULL) {
        srp_mirrors_destroy(work);
        return NULL;
    }
    return work;
}

static void tell(const srp_mirrors *work, srp_bounce_event event) {
    /* Where samples are traced as well, they tell the whole story. */
    if (work->world->watch != NULL && work->world->diffuse == 0 && work->limit > 0) {
        work->world->watch(work->world->user, &event);
    }
}

/* ---- mirrors ahead ---- */

static srp_status reserve(level *at, size_t parts) {
    if (at->count == at->capacity) {
        size_t capacity = 2 * at->capacity + 16;
        mirror *larger = realloc(at->mirrors, capacity * sizeof *larger);
        if (larger == NULL) {
            return SRP_NO_MEMORY;
        }
        at->mirrors = larger;
        at->capacity = capacity;
    }
    if (at->part_count + parts > at->part_capacity) {
        size_t capacity = 2 * (at->part_count + parts) + 16;
        srp_polygon *larger = realloc(at->parts, capacity * sizeof *larger);
        if (larger == NULL) {
            return SRP_NO_MEMORY;
        }
        at->parts = larger;
        at->part_capacity = capacity;
    }
    return SRP_OK;
}

static srp_status remember(level *at, const srp_lit *lit) {
    srp_status status = reserve(at, lit->part_count);
    if (status == SRP_OK) {
        at->mirrors[at->count++] =
            (mirror){lit->facet, lit->back, lit->area, at->part_count, lit->part_count};
        memcpy(at->parts + at->part_count, lit->part, lit->part_count * sizeof *lit->part);
        at->part_count += lit->part_count;
    }
    return status;
}

/* What becomes of light that has landed, after `bounces`, with the flux `weight` lit->area. */
static srp_status leave(srp_mirrors *work, uint32_t bounces, const srp_lit *lit, double weight,
                        srp_vec3 direction) {
    const srp_bounce_world *world = work->world;
    srp_optics optics = srp_bounce_optics(world->scene, lit->facet, lit->back);
    double share = srp_bounce_share(world, optics), flux = weight * lit->area;
    if (share == 0.0) {
        return SRP_OK;
    }
    bool blind = srp_bounce_is_blind(world, lit->facet, lit->back);
    if (!blind && bounces < world->reflections) {
        work->out->goes_on += flux * optics.rho_s;
        work->out->scattered += flux * (share - optics.rho_s);
        if (optics.rho_s > 0.0 && lit->area > work->trifle) {
            return remember(&work->levels[bounces], lit);
        }
        work->out->unresolved += flux * optics.rho_s;
        return SRP_OK;
    }
    work->out->unresolved += blind ? 0.0 : flux * share;
    tell(work, (srp_bounce_event){.step = blind ? SRP_BOUNCE_ESCAPES : SRP_BOUNCE_IS_CUT,
                                  .facet = lit->facet,
                                  .back = lit->back,
                                  .flux = flux * optics.rho_s,
                                  .direction = srp_vec3_mirrored(direction, lit->normal)});
    return SRP_OK;
}

/* ---- beams ---- */

/* Light on its way from a mirror. */
typedef struct landing {
    srp_mirrors *work;
    uint32_t bounces; /* behind it when it lands */
    double weight;    /* flux per cross-section */
    srp_vec3 direction;
    double landed; /* flux */
} landing;

static srp_status land(void *user, const srp_lit *lit) {
    landing *from = user;
    srp_mirrors *work = from->work;
    const srp_bounce_world *world = work->world;
    srp_optics optics = srp_bounce_optics(world->scene, lit->facet, lit->back);
    double flux = from->weight * lit->area;
    srp_vec3 push = srp_bounce_push(optics, lit->normal, from->direction, flux);
    srp_vec3 lever = srp_vec3_sub(lit->centroid, world->reference);
    srp_bounce_sum *sum = &work->out->sum;
    sum->f = srp_vec3_add(sum->f, push);
    sum->t = srp_vec3_add(sum->t, srp_vec3_cross(lever, push));
    from->landed += flux;
    tell(work,
         (srp_bounce_event){SRP_BOUNCE_HITS, lit->facet, lit->back, flux, from->direction, push});
    return leave(work, from->bounces, lit, from->weight, from->direction);
}

/* All that lies in front of the mirror, in line with the box about the window. */
static size_t find_reach(const srp_mirrors *work, const srp_beam *beam, const mirror *at) {
    const srp_scene *scene = work->world->scene;
    const srp_window *window = beam->window;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t k = 0; k < window->part_count; ++k) {
        for (uint32_t c = 0; c < window->part[k].count; ++c) {
            const double p[2] = {window->part[k].p[c].x, window->part[k].p[c].y};
            for (int a = 0; a < 2; ++a) {
                low[a] = p[a] < low[a] ? p[a] : low[a];
                high[a] = p[a] > high[a] ? p[a] : high[a];
            }
        }
    }
    const srp_view *view = &beam->view;
    double u = srp_vec3_dot(view->u, beam->centre), v = srp_vec3_dot(view->v, beam->centre);
    srp_vec3 behind = scene->facets[at->facet].normal;
    behind = at->back ? behind : srp_vec3_scale(-1.0, behind);
    srp_vec3 on = scene->vertices[scene->facets[at->facet].v[0]];
    const srp_half_space spaces[5] = {{view->u, u + high[0]},
                                      {view->v, v + high[1]},
                                      {srp_vec3_scale(-1.0, view->u), -u - low[0]},
                                      {srp_vec3_scale(-1.0, view->v), -v - low[1]},
                                      {behind, srp_vec3_dot(behind, on)}};
    return srp_bvh_gather(work->world->bvh, spaces, 5, work->reach);
}

static srp_status follow(srp_mirrors *work, uint32_t bounces, const srp_beam *beam, double weight);

/* The beam that one of the mirrors throws which `beam` has lit. */
static srp_status throw_beam(srp_mirrors *work, uint32_t bounces, const srp_beam *beam,
                             double weight, const mirror *at) {
    const srp_bounce_world *world = work->world;
    const level *here = &work->levels[bounces];
    srp_window window = {at->facet, here->parts + at->part, at->count, work->reach, 0};
    srp_beam next = srp_beam_mirrored(beam, world->scene, at->facet);
    next.window = &window;
    window.reach_count = find_reach(work, &next, at);
    landing to = {work, bounces + 1,
                  weight * srp_bounce_optics(world->scene, at->facet, at->back).rho_s,
                  srp_vec3_scale(-1.0, next.view.s), 0.0};
    bool last = to.bounces == world->reflections;
    if (!last) {
        work->levels[to.bounces].count = work->levels[to.bounces].part_count = 0;
    }
    srp_status status = srp_visible_find(work->visible, &next, !last, land, &to);
    tell(work, (srp_bounce_event){.step = SRP_BOUNCE_ESCAPES,
                                  .facet = at->facet,
                                  .back = at->back,
                                  .flux = to.weight * at->area - to.landed,
                                  .direction = to.direction});
    return status == SRP_OK && !last ? follow(work, to.bounces, &next, to.weight) : status;
}

static srp_status follow(srp_mirrors *work, uint32_t bounces, const srp_beam *beam, double weight) {
    const level *here = &work->levels[bounces];
    srp_status status = SRP_OK;
    for (size_t k = 0; k < here->count && status == SRP_OK && work->out->complete; ++k) {
        work->out->complete = work->beams < work->limit;
        if (work->out->complete) {
            ++work->beams;
            status = throw_beam(work, bounces, beam, weight, &here->mirrors[k]);
        }
    }
    return status;
}

/* ---- sunlight ---- */

static srp_status land_sunlight(void *user, const srp_lit *lit) {
    landing *from = user;
    srp_mirrors *work = from->work;
    const srp_bounce_world *world = work->world;
    srp_exact_add_lit(world->scene, world->reference, lit, work->basis);
    if (srp_bounce_starts(world, lit->facet, lit->back)) {
        tell(work, (srp_bounce_event){.step = SRP_BOUNCE_STARTS,
                                      .facet = lit->facet,
                                      .back = lit->back,
                                      .flux = lit->area,
                                      .direction = from->direction});
        return leave(work, 0, lit, 1.0, from->direction);
    }
    return SRP_OK;
}

srp_status srp_mirrors_respond(srp_mirrors *work, srp_vec3 s, uint32_t limit, srp_basis *basis,
                               srp_mirrored *out) {
    const srp_bounce_world *world = work->world;
    srp_beam sun = srp_beam_of_sun(world->scene, s);
    landing from = {.work = work, .weight = 1.0, .direction = srp_vec3_scale(-1.0, s)};
    memset(out, 0, sizeof *out);
    out->complete = true;
    work->limit = limit;
    work->beams = 0;
    work->basis = basis;
    work->out = out;
    bool bounces = world->reflections > 0;
    if (bounces) {
        work->levels[0].count = work->levels[0].part_count = 0;
    }
    srp_status status = srp_visible_find(work->visible, &sun, bounces, land_sunlight, &from);
    if (status != SRP_OK || !bounces) {
        return status;
    }
    out->complete = work->levels[0].count <= limit;
    return out->complete ? follow(work, 0, &sun, 1.0) : SRP_OK;
}
