/* SPDX-License-Identifier: Apache-2.0 */
#include "model.h"

#include <srp/const.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

_Noreturn void fail(const char *what, const char *name) {
    fprintf(stderr, "srp-models: %s: %s\n", name, what);
    exit(EXIT_FAILURE);
}

model model_make(const char *name, const char *comment) {
    model m;
    memset(&m, 0, sizeof m);
    m.name = name;
    m.comment = comment;
    m.points_per_metre = 1e6;
    return m;
}

void model_clear(model *m) {
    free(m->vertices);
    free(m->triangles);
    memset(m, 0, sizeof *m);
}

void model_part(model *m, const char *name) {
    if (m->part_count == MODEL_PARTS_MAX) {
        fail("too many parts", m->name);
    }
    m->parts[m->part_count++] = name;
}

uint32_t model_add_material(model *m, const char *name, double rho_s, double rho_d) {
    if (m->material_count == MODEL_MATERIALS_MAX) {
        fail("too many materials", m->name);
    }
    m->materials[m->material_count] = (model_material){name, rho_s, rho_d};
    return (uint32_t)m->material_count++;
}

/* Room for one element more. */
static void *grown(const model *m, void *array, size_t count, size_t *room, size_t size) {
    if (count < *room) {
        return array;
    }
    *room = *room == 0 ? 256 : 2 * *room;
    array = realloc(array, *room * size);
    if (array == NULL) {
        fail("out of memory", m->name);
    }
    return array;
}

static double rounded(double x, double points_per_metre) {
    double y = points_per_metre > 0.0 ? round(x * points_per_metre) / points_per_metre : x;
    return y + 0.0; /* no negative zero */
}

uint32_t model_add_vertex(model *m, srp_vec3 p) {
    m->vertices = grown(m, m->vertices, m->vertex_count, &m->vertex_room, sizeof *m->vertices);
    m->vertices[m->vertex_count] =
        srp_vec3_make(rounded(p.x, m->points_per_metre), rounded(p.y, m->points_per_metre),
                      rounded(p.z, m->points_per_metre));
    return (uint32_t)m->vertex_count++;
}

void model_add_triangle(model *m, uint32_t material, uint32_t a, uint32_t b, uint32_t c) {
    m->triangles =
        grown(m, m->triangles, m->triangle_count, &m->triangle_room, sizeof *m->triangles);
    m->triangles[m->triangle_count++] =
        (model_triangle){{a, b, c}, material, (uint32_t)(m->part_count - 1)};
}

void model_add_quad(model *m, uint32_t material, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    model_add_triangle(m, material, a, b, c);
    model_add_triangle(m, material, a, c, d);
}

srp_vec3 unit(srp_vec3 a) {
    double length = srp_vec3_norm(a);
    return srp_vec3_make(a.x / length, a.y / length, a.z / length);
}

frame frame_at(srp_vec3 origin) {
    return (frame){origin, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
}

frame frame_along(srp_vec3 origin, srp_vec3 axis, srp_vec3 towards) {
    frame f;
    f.origin = origin;
    f.z = unit(axis);
    f.x = unit(srp_vec3_add_scaled(towards, -srp_vec3_dot(towards, f.z), f.z));
    f.y = srp_vec3_cross(f.z, f.x);
    return f;
}

srp_vec3 frame_point(const frame *f, double x, double y, double z) {
    srp_vec3 p = srp_vec3_add_scaled(f->origin, x, f->x);
    p = srp_vec3_add_scaled(p, y, f->y);
    return srp_vec3_add_scaled(p, z, f->z);
}

void model_add_box(model *m, const frame *f, srp_vec3 lo, srp_vec3 hi, const uint32_t material[6]) {
    /* Corner k: bit 0 of k chooses x, bit 1 y, bit 2 z. */
    static const uint32_t face[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    uint32_t corner[8];
    for (uint32_t k = 0; k < 8; ++k) {
        corner[k] = model_add_vertex(
            m, frame_point(f, (k & 1) ? hi.x : lo.x, (k & 2) ? hi.y : lo.y, (k & 4) ? hi.z : lo.z));
    }
    for (size_t i = 0; i < 6; ++i) {
        model_add_quad(m, material[i], corner[face[i][0]], corner[face[i][1]], corner[face[i][2]],
                       corner[face[i][3]]);
    }
}

void model_add_block(model *m, const frame *f, srp_vec3 lo, srp_vec3 hi, uint32_t material) {
    const uint32_t same[6] = {material, material, material, material, material, material};
    model_add_box(m, f, lo, hi, same);
}

/* Adds the ring of one profile point; its first vertex. A point on the axis is one vertex. */
static uint32_t add_ring(model *m, const frame *f, profile_point p, uint32_t segments) {
    if (p.r == 0.0) {
        return model_add_vertex(m, frame_point(f, 0.0, 0.0, p.z));
    }
    uint32_t first = (uint32_t)m->vertex_count;
    for (uint32_t k = 0; k < segments; ++k) {
        double angle = 2.0 * SRP_PI * k / segments;
        (void)model_add_vertex(m, frame_point(f, p.r * cos(angle), p.r * sin(angle), p.z));
    }
    return first;
}

/* The band between two rings; either may be a point on the axis. */
static void add_band(model *m, uint32_t material, uint32_t segments, uint32_t lower,
                     int lower_is_point, uint32_t upper, int upper_is_point) {
    for (uint32_t k = 0; k < segments; ++k) {
        uint32_t next = (k + 1) % segments;
        if (lower_is_point) {
            model_add_triangle(m, material, lower, upper + next, upper + k);
        } else if (upper_is_point) {
            model_add_triangle(m, material, lower + k, lower + next, upper);
        } else {
            model_add_quad(m, material, lower + k, lower + next, upper + next, upper + k);
        }
    }
}

void model_add_revolved(model *m, const frame *f, const profile_point *profile, size_t count,
                        profile_kind kind, uint32_t segments, uint32_t material) {
    uint32_t first = add_ring(m, f, profile[0], segments);
    uint32_t lower = first;
    for (size_t i = 1; i < count; ++i) {
        uint32_t upper = add_ring(m, f, profile[i], segments);
        add_band(m, material, segments, lower, profile[i - 1].r == 0.0, upper, profile[i].r == 0.0);
        lower = upper;
    }
    if (kind == PROFILE_LOOP) {
        add_band(m, material, segments, lower, 0, first, 0);
    }
}

void model_add_prism(model *m, const frame *f, double r, double z0, double z1, uint32_t sides,
                     uint32_t material) {
    const profile_point profile[] = {{0.0, z0}, {r, z0}, {r, z1}, {0.0, z1}};
    model_add_revolved(m, f, profile, 4, PROFILE_OPEN, sides, material);
}

/* Direction of the path at point i: of its chord between the neighbours. */
static srp_vec3 path_tangent(const srp_vec3 *path, size_t count, size_t i) {
    const srp_vec3 *before = &path[i > 0 ? i - 1 : i];
    const srp_vec3 *after = &path[i + 1 < count ? i + 1 : i];
    return unit(srp_vec3_sub(*after, *before));
}

/* The body axis that is farthest from `direction`. */
static srp_vec3 transverse_axis(srp_vec3 direction) {
    double x = fabs(direction.x), y = fabs(direction.y), z = fabs(direction.z);
    if (x <= y && x <= z) {
        return srp_vec3_make(1.0, 0.0, 0.0);
    }
    return y <= z ? srp_vec3_make(0.0, 1.0, 0.0) : srp_vec3_make(0.0, 0.0, 1.0);
}

void model_add_tube(model *m, const srp_vec3 *path, size_t count, double radius, uint32_t sides,
                    uint32_t material) {
    const profile_point circle = {radius, 0.0};
    srp_vec3 towards = transverse_axis(path_tangent(path, count, 0));
    uint32_t start = model_add_vertex(m, path[0]);
    uint32_t lower = 0;
    for (size_t i = 0; i < count; ++i) {
        /* Carrying x on from ring to ring keeps the tube from twisting. */
        frame f = frame_along(path[i], path_tangent(path, count, i), towards);
        towards = f.x;
        uint32_t upper = add_ring(m, &f, circle, sides);
        add_band(m, material, sides, i == 0 ? start : lower, i == 0, upper, 0);
        lower = upper;
    }
    uint32_t end = model_add_vertex(m, path[count - 1]);
    add_band(m, material, sides, lower, 0, end, 1);
}

void model_add_rod(model *m, srp_vec3 from, srp_vec3 to, double radius, uint32_t sides,
                   uint32_t material) {
    const srp_vec3 path[2] = {from, to};
    model_add_tube(m, path, 2, radius, sides, material);
}
