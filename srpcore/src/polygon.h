/* SPDX-License-Identifier: Apache-2.0 */
/* Polygons into triangles. Internal. */
#ifndef SRP_SRC_POLYGON_H
#define SRP_SRC_POLYGON_H

#include <srp/mesh.h>
#include <srp/vec3.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Most corners of one polygon: the time of clipping ears grows with their square. */
enum { SRP_POLYGON_MAX = 10000 };

/* What a polygon turned out to be; bits. */
enum {
    SRP_POLYGON_FLAWLESS = 0,
    SRP_POLYGON_NO_AREA = 1,  /* its corners lie on a line, or in a point */
    SRP_POLYGON_CROSSES = 2,  /* it cuts itself: what it covers is not defined */
    SRP_POLYGON_NOT_FLAT = 4, /* corners are off its plane by more than 1 % of its size */
};

/* One corner: the vertex, and its place in the plane of the polygon. */
typedef struct srp_corner {
    uint32_t vertex;
    uint32_t previous, next;
    double x, y;
    double turn; /* twice the signed area of (previous, this, next) */
    bool ear;    /* may be cut off */
} srp_corner;

/*
 * Splits a polygon into count - 2 triangles of the same winding that together cover it and use
 * every corner, so that neighbours still share whole edges. A convex one becomes a fan about its
 * first corner, others are cut ear by ear (Meisters, American Mathematical Monthly 82, 1975).
 * Corners that lie on a line with their neighbours are kept; a polygon with holes joined to its rim
 * by double edges is split right.
 *   vertices   (indexed by corner.vertex, finite)
 *   corners    (count >= 3, count <= SRP_POLYGON_MAX): `vertex` set; the rest is scratch
 *   triangles  (count - 2), filled
 * Returns what was found, SRP_POLYGON_... joined; with a flaw the triangles are a best effort.
 */
unsigned srp_polygon_split(const srp_vec3 *vertices, srp_corner *corners, size_t count,
                           srp_triangle *triangles);

#endif
