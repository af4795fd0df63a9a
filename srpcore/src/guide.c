/* SPDX-License-Identifier: Apache-2.0 */
#include "guide.h"

#include "error.h"
#include "sight.h"

#include <srp/const.h>

#include <math.h>
#include <stdlib.h>

enum { SIDE = SRP_GUIDE_SIDE, CELLS = SIDE * SIDE };

/* Pilot rays per cell: at most, and so many as keep the whole near the budget, but one. */
enum { PILOTS_MAX = 16, PILOT_BUDGET = 1 << 19 };

/* Density that every cell has at least, relative to a uniform one. */
static const double LEAST_DENSITY = 0.2;

#define NO_MAP SRP_GUIDE_NONE

/* Cumulated shares: of the rows of cells, and of the cells in each row. */
typedef struct guide_map {
    float row[SIDE + 1];
    float cell[SIDE][SIDE + 1];
} guide_map;

struct srp_guide {
    uint32_t (*index)[2]; /* per facet, front and back: into maps, or NO_MAP */
    guide_map *maps;
    size_t map_count;
};

void srp_guide_destroy(srp_guide *guide) {
    if (guide != NULL) {
        free(guide->index);
        free(guide->maps);
        free(guide);
    }
}

_Static_assert(sizeof(guide_map) == SRP_GUIDE_FLOATS * sizeof(float), "a map is its numbers");

size_t srp_guide_count(const srp_guide *guide) {
    return guide->map_count;
}

const float *srp_guide_map(const srp_guide *guide, size_t k) {
    return guide->maps[k].row;
}

uint32_t srp_guide_index(const srp_guide *guide, uint32_t facet, bool back) {
    return guide->index[facet][back ? 1 : 0];
}

/* Malley's method: points of the unit disc, lifted to the hemisphere. The frame about the normal is
 * that of Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017. */
srp_vec3 srp_guide_direction(srp_vec3 normal, double across, double around) {
    double radius = sqrt(across), angle = 2.0 * SRP_PI * around;
    double x = radius * cos(angle), y = radius * sin(angle), z = sqrt(1.0 - across);
    double sign = copysign(1.0, normal.z);
    double a = -1.0 / (sign + normal.z), b = normal.x * normal.y * a;
    srp_vec3 u = srp_vec3_make(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    srp_vec3 v = srp_vec3_make(b, sign + normal.y * normal.y * a, -normal.y);
    return srp_vec3_add_scaled(srp_vec3_add_scaled(srp_vec3_scale(z, normal), x, u), y, v);
}

/* Moves x within [0, 1) so that interval k is met with the share cumulated[k + 1] - cumulated[k];
 * returns k, and the weight of its points. */
static int move(const float cumulated[SIDE + 1], double *x, double *weight) {
    int k = 0;
    while (k < SIDE - 1 && *x >= (double)cumulated[k + 1]) {
        ++k;
    }
    double share = (double)cumulated[k + 1] - (double)cumulated[k];
    double within = (*x - (double)cumulated[k]) / share;
    *x = (k + (within < 1.0 ? within : 0x1.fffffffffffffp-1)) / SIDE;
    *weight /= share * SIDE;
    return k;
}

double srp_guide_point(const srp_guide *guide, uint32_t facet, bool back, double *across,
                       double *around) {
    uint32_t index = guide != NULL ? guide->index[facet][back ? 1 : 0] : NO_MAP;
    double weight = 1.0;
    if (index != NO_MAP) {
        const guide_map *map = &guide->maps[index];
        int row = move(map->row, across, &weight);
        move(map->cell[row], around, &weight);
    }
    return weight;
}

/* ---- pilots ---- */

/* Pilot n of a facet starts anywhere on it and goes anywhere in a cell: coordinates of Roberts' R4
 * sequence (powers of the root of x^5 = x + 1). */
static srp_ray pilot_of(const srp_scene *scene, uint32_t facet, bool back, int cell, uint64_t n) {
    static const double STEP[4] = {0.85667488385450287, 0.73389185662744224, 0.62870672080787105,
                                   0.53859725722361103};
    double x[4];
    for (int k = 0; k < 4; ++k) {
        double at = 0.5 + (double)(n + 1) * STEP[k];
        x[k] = at - floor(at);
    }
    const srp_facet *from = &scene->facets[facet];
    double u = x[0] + x[1] > 1.0 ? 1.0 - x[0] : x[0], v = x[0] + x[1] > 1.0 ? 1.0 - x[1] : x[1];
    srp_vec3 a = scene->vertices[from->v[0]];
    srp_vec3 p = srp_vec3_add_scaled(a, u, srp_vec3_sub(scene->vertices[from->v[1]], a));
    p = srp_vec3_add_scaled(p, v, srp_vec3_sub(scene->vertices[from->v[2]], a));
    srp_vec3 normal = srp_vec3_scale(back ? -1.0 : 1.0, from->normal);
    srp_ray ray;
    ray.origin = p;
    ray.direction =
        srp_guide_direction(normal, (cell / SIDE + x[2]) / SIDE, (cell % SIDE + x[3]) / SIDE);
    ray.from = facet;
    return ray;
}

/* How often each cell is worth being met: the root of its share of hits, or half of the best of its
 * neighbours', whose edge may run through it; `around` is periodic. */
static void worth_of(const double hits[CELLS], double worth[CELLS]) {
    for (int cell = 0; cell < CELLS; ++cell) {
        int row = cell / SIDE, column = cell % SIDE;
        worth[cell] = sqrt(hits[cell]);
        for (int i = -1; i <= 1; ++i) {
            for (int j = -1; j <= 1; ++j) {
                if (row + i >= 0 && row + i < SIDE) {
                    int near = (row + i) * SIDE + (column + j + SIDE) % SIDE;
                    worth[cell] = fmax(worth[cell], 0.5 * sqrt(hits[near]));
                }
            }
        }
    }
}

static void fill_map(const double hits[CELLS], guide_map *map) {
    double worth[CELLS], sum = 0.0;
    worth_of(hits, worth);
    for (int cell = 0; cell < CELLS; ++cell) {
        sum += worth[cell];
    }
    double done = 0.0;
    map->row[0] = 0.0f;
    for (int row = 0; row < SIDE; ++row) {
        double density[SIDE], in_row = 0.0, done_in_row = 0.0;
        for (int k = 0; k < SIDE; ++k) {
            double share = sum > 0.0 ? worth[row * SIDE + k] / sum : 1.0 / CELLS;
            density[k] = LEAST_DENSITY / CELLS + (1.0 - LEAST_DENSITY) * share;
            in_row += density[k];
        }
        map->cell[row][0] = 0.0f;
        for (int k = 0; k < SIDE; ++k) {
            done_in_row += density[k] / in_row;
            map->cell[row][k + 1] = k == SIDE - 1 ? 1.0f : (float)done_in_row;
        }
        done += in_row;
        map->row[row + 1] = row == SIDE - 1 ? 1.0f : (float)done;
    }
}

static void guide_side(const srp_scene *scene, const srp_bvh *bvh, uint32_t facet, bool back,
                       int pilots, guide_map *map) {
    srp_ray rays[CELLS];
    srp_hit found[CELLS];
    double hits[CELLS] = {0.0};
    for (int k = 0; k < pilots; ++k) {
        for (int cell = 0; cell < CELLS; ++cell) {
            rays[cell] = pilot_of(scene, facet, back, cell, (uint64_t)(k * CELLS + cell));
        }
        srp_bvh_hit_many(bvh, CELLS, rays, found);
        for (int cell = 0; cell < CELLS; ++cell) {
            hits[cell] += found[cell].facet != SRP_NO_NEIGHBOUR ? 1.0 / pilots : 0.0;
        }
    }
    fill_map(hits, map);
}

static void list_sides(const srp_scene *scene, const uint8_t *sight, srp_guide *guide) {
    for (size_t k = 0; k < scene->facet_count; ++k) {
        const srp_optics *optics = &scene->optics[scene->facets[k].material];
        for (int back = 0; back < 2; ++back) {
            bool sees = (sight[k] & (back ? SRP_SIGHT_BACK : SRP_SIGHT_FRONT)) != 0;
            /* Backs of closed bodies are met by light that has slipped inside only. */
            bool shows = !back || (!scene->facets[k].closed && !optics->one_sided);
            guide->index[k][back] =
                sees && shows && optics->rho_d > 0.0 ? (uint32_t)guide->map_count++ : NO_MAP;
        }
    }
}

srp_status srp_guide_create(const srp_scene *scene, const srp_bvh *bvh, const uint8_t *sight,
                            int threads, srp_guide **out, srp_error *error) {
    srp_guide *guide = calloc(1, sizeof *guide);
    if (guide == NULL) {
        goto fail;
    }
    guide->index = malloc(scene->facet_count * sizeof *guide->index);
    if (guide->index == NULL) {
        goto fail;
    }
    list_sides(scene, sight, guide);
    guide->maps = malloc((guide->map_count + 1) * sizeof *guide->maps);
    if (guide->maps == NULL) {
        goto fail;
    }
    size_t share = PILOT_BUDGET / CELLS / (guide->map_count + 1);
    int pilots = share < 1 ? 1 : share > PILOTS_MAX ? PILOTS_MAX : (int)share;
#pragma omp parallel for num_threads(threads) schedule(dynamic, 16)
    for (size_t k = 0; k < scene->facet_count; ++k) {
        for (int back = 0; back < 2; ++back) {
            if (guide->index[k][back] != NO_MAP) {
                guide_side(scene, bvh, (uint32_t)k, back != 0, pilots,
                           &guide->maps[guide->index[k][back]]);
            }
        }
    }
    *out = guide;
    return SRP_OK;
fail:
    srp_guide_destroy(guide);
    return srp_fail(error, SRP_NO_MEMORY, "no memory to guide the rays of %zu facets",
                    scene->facet_count);
}
