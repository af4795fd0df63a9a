/* SPDX-License-Identifier: Apache-2.0 */
#include "polygon.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

/* Turns below this share of the polygon's size squared are rounding: a few errors of the product
 * of two differences. */
static const double flat_turn = 64.0 * DBL_EPSILON;

/* The plane of a polygon: a normal of twice its area, a point, and its extent. */
typedef struct plane {
    srp_vec3 normal, origin;
    double size; /* longest distance of a corner from the origin */
} plane;

/* Newell's normal (Sutherland et al., ACM Computing Surveys 6(1), 1974), about a corner: a far
 * origin would cost digits. */
static plane find_plane(const srp_vec3 *vertices, const srp_corner *corners, size_t count) {
    plane found = {.origin = vertices[corners[0].vertex]};
    srp_vec3 a = srp_vec3_sub(vertices[corners[count - 1].vertex], found.origin);
    for (size_t i = 0; i < count; i++) {
        srp_vec3 b = srp_vec3_sub(vertices[corners[i].vertex], found.origin);
        found.normal = srp_vec3_add(found.normal, srp_vec3_cross(a, b));
        found.size = fmax(found.size, srp_vec3_norm(b));
        a = b;
    }
    return found;
}

static bool is_flat(const srp_vec3 *vertices, const srp_corner *corners, size_t count,
                    const plane *p) {
    double bound = 0.01 * p->size * srp_vec3_norm(p->normal);
    for (size_t i = 0; i < count; i++) {
        srp_vec3 r = srp_vec3_sub(vertices[corners[i].vertex], p->origin);
        if (fabs(srp_vec3_dot(r, p->normal)) > bound) {
            return false;
        }
    }
    return true;
}

/* Drops the axis that the normal is nearest to, keeping the sense of rotation positive: no
 * arithmetic beyond the difference, so equal places stay equal. */
static void project(const srp_vec3 *vertices, srp_corner *corners, size_t count, const plane *p) {
    double nx = fabs(p->normal.x), ny = fabs(p->normal.y), nz = fabs(p->normal.z);
    for (size_t i = 0; i < count; i++) {
        srp_vec3 r = srp_vec3_sub(vertices[corners[i].vertex], p->origin);
        double sign;
        if (nz >= nx && nz >= ny) {
            corners[i].x = r.x;
            corners[i].y = r.y;
            sign = p->normal.z;
        } else if (ny >= nx) {
            corners[i].x = r.z;
            corners[i].y = r.x;
            sign = p->normal.y;
        } else {
            corners[i].x = r.y;
            corners[i].y = r.z;
            sign = p->normal.x;
        }
        if (sign < 0.0) {
            corners[i].x = -corners[i].x;
        }
    }
}

/* Twice the signed area of a triangle. */
static double turn_of(const srp_corner *a, const srp_corner *b, const srp_corner *c) {
    return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
}

static void set_turn(srp_corner *corners, uint32_t i) {
    corners[i].turn =
        turn_of(&corners[corners[i].previous], &corners[i], &corners[corners[i].next]);
}

static void link_corners(srp_corner *corners, size_t count) {
    for (size_t i = 0; i < count; i++) {
        corners[i].previous = (uint32_t)(i == 0 ? count - 1 : i - 1);
        corners[i].next = (uint32_t)(i + 1 == count ? 0 : i + 1);
    }
    for (size_t i = 0; i < count; i++) {
        set_turn(corners, (uint32_t)i);
    }
}

static srp_triangle triangle_of(const srp_corner *corners, uint32_t a, uint32_t b, uint32_t c) {
    return (srp_triangle){{corners[a].vertex, corners[b].vertex, corners[c].vertex}};
}

static void fan(const srp_corner *corners, size_t count, srp_triangle *triangles) {
    for (size_t i = 0; i + 2 < count; i++) {
        triangles[i] = triangle_of(corners, 0, (uint32_t)i + 1, (uint32_t)i + 2);
    }
}

/* Does every corner turn left, and every triangle of the fan about the first? The corners alone are
 * not enough: a pentagram turns left at each. */
static bool is_convex(const srp_corner *corners, size_t count, double least) {
    for (size_t i = 0; i < count; i++) {
        if (corners[i].turn <= least) {
            return false;
        }
    }
    for (size_t i = 1; i + 1 < count; i++) {
        if (turn_of(&corners[0], &corners[i], &corners[i + 1]) <= least) {
            return false;
        }
    }
    return true;
}

/* Do edges i and j pass through each other, not merely touch? */
static bool edges_cross(const srp_corner *corners, size_t count, size_t i, size_t j, double least) {
    const srp_corner *a = &corners[i], *b = &corners[i + 1 == count ? 0 : i + 1];
    const srp_corner *c = &corners[j], *d = &corners[j + 1 == count ? 0 : j + 1];
    double abc = turn_of(a, b, c), abd = turn_of(a, b, d);
    double cda = turn_of(c, d, a), cdb = turn_of(c, d, b);
    return ((abc > least && abd < -least) || (abc < -least && abd > least)) &&
           ((cda > least && cdb < -least) || (cda < -least && cdb > least));
}

static bool crosses_itself(const srp_corner *corners, size_t count, double least) {
    for (size_t i = 0; i < count; i++) {
        for (size_t j = i + 2; j < count; j++) {
            if (edges_cross(corners, count, i, j, least)) {
                return true;
            }
        }
    }
    return false;
}

static bool same_place(const srp_corner *a, const srp_corner *b) {
    return a->x == b->x && a->y == b->y;
}

/* May corner i be cut off? It turns left, and no corner that does not lies in its triangle or on
 * its rim. (Corners at the place of one of its own are a double edge's other side.) */
static bool is_ear(const srp_corner *corners, uint32_t i, double least) {
    const srp_corner *b = &corners[i], *a = &corners[b->previous], *c = &corners[b->next];
    if (b->turn <= least) {
        return false;
    }
    for (uint32_t k = c->next; k != b->previous; k = corners[k].next) {
        const srp_corner *p = &corners[k];
        if (p->turn <= least && turn_of(a, b, p) >= 0.0 && turn_of(b, c, p) >= 0.0 &&
            turn_of(c, a, p) >= -least && !same_place(p, a) && !same_place(p, b) &&
            !same_place(p, c)) {
            return false;
        }
    }
    return true;
}

/* Looks at each of the `left` corners from i on. */
static void mark_ears(srp_corner *corners, uint32_t i, size_t left, double least) {
    for (size_t n = 0; n < left; n++, i = corners[i].next) {
        corners[i].ear = is_ear(corners, i, least);
    }
}

/* Goes on from *i to the next ear; false when none of the `left` corners is one. */
static bool find_ear(const srp_corner *corners, uint32_t *i, size_t left) {
    for (size_t n = 0; n < left; n++, *i = corners[*i].next) {
        if (corners[*i].ear) {
            return true;
        }
    }
    return false;
}

/* Takes corner i out of the ring. Whether a corner is an ear changes for its neighbours only
 * (O'Rourke, Computational Geometry in C, 1.3), but for corners on a line. */
static void cut(srp_corner *corners, uint32_t i, double least) {
    uint32_t before = corners[i].previous, after = corners[i].next;
    corners[before].next = after;
    corners[after].previous = before;
    set_turn(corners, before);
    set_turn(corners, after);
    corners[before].ear = is_ear(corners, before, least);
    corners[after].ear = is_ear(corners, after, least);
}

/* Cuts ears until a triangle is left; false when none is to be found: the rest is then cut as it
 * comes. */
static bool clip_ears(srp_corner *corners, size_t count, double least, srp_triangle *triangles) {
    uint32_t i = 0;
    bool simple = true;
    mark_ears(corners, i, count, least);
    for (size_t left = count; left > 2; left--) {
        if (simple && !find_ear(corners, &i, left)) {
            mark_ears(corners, i, left, least);
            simple = find_ear(corners, &i, left);
        }
        uint32_t after = corners[i].next;
        *triangles++ = triangle_of(corners, corners[i].previous, i, after);
        cut(corners, i, least);
        /* Leaving one out spreads the cuts: slivers are fewer than with neighbours in a row. */
        i = corners[after].next;
    }
    return simple;
}

unsigned srp_polygon_split(const srp_vec3 *vertices, srp_corner *corners, size_t count,
                           srp_triangle *triangles) {
    plane p = find_plane(vertices, corners, count);
    double least = flat_turn * p.size * p.size;
    if (!(srp_vec3_norm(p.normal) > least)) {
        fan(corners, count, triangles);
        return SRP_POLYGON_NO_AREA;
    }
    unsigned flaws =
        is_flat(vertices, corners, count, &p) ? SRP_POLYGON_FLAWLESS : SRP_POLYGON_NOT_FLAT;
    project(vertices, corners, count, &p);
    link_corners(corners, count);
    if (count == 3 || is_convex(corners, count, least)) {
        fan(corners, count, triangles);
        return flaws;
    }
    bool crosses = crosses_itself(corners, count, least);
    bool cut = clip_ears(corners, count, least, triangles);
    return crosses || !cut ? flaws | SRP_POLYGON_CROSSES : flaws;
}
