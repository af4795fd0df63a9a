/* SPDX-License-Identifier: Apache-2.0 */
#include "shadow_edges.h"

#include "mat3.h"

#include <math.h>

/* ---- Arc ------------------------------------------------------------------------------------- */

/* Hermite's quintic in x from 0 to 1: weights of r0, v0 h, a0 h^2, r1, v1 h, a1 h^2. */
static srp_vec3 weigh(const srp_arc *arc, const double w[6]) {
    const double h = arc->h;
    srp_vec3 sum = srp_vec3_scale(w[0], arc->r[0]);
    sum = srp_vec3_add_scaled(sum, w[1] * h, arc->v[0]);
    sum = srp_vec3_add_scaled(sum, w[2] * h * h, arc->a[0]);
    sum = srp_vec3_add_scaled(sum, w[3], arc->r[1]);
    sum = srp_vec3_add_scaled(sum, w[4] * h, arc->v[1]);
    return srp_vec3_add_scaled(sum, w[5] * h * h, arc->a[1]);
}

srp_vec3 srp_arc_position(const srp_arc *arc, double x) {
    const double x2 = x * x, x3 = x2 * x, x4 = x3 * x, x5 = x4 * x;
    const double w[6] = {
        1.0 - 10.0 * x3 + 15.0 * x4 - 6.0 * x5,    x - 6.0 * x3 + 8.0 * x4 - 3.0 * x5,
        0.5 * x2 - 1.5 * x3 + 1.5 * x4 - 0.5 * x5, 10.0 * x3 - 15.0 * x4 + 6.0 * x5,
        -4.0 * x3 + 7.0 * x4 - 3.0 * x5,           0.5 * x3 - x4 + 0.5 * x5};
    return weigh(arc, w);
}

srp_vec3 srp_arc_velocity(const srp_arc *arc, double x) {
    const double x2 = x * x, x3 = x2 * x, x4 = x3 * x;
    const double w[6] = {
        -30.0 * x2 + 60.0 * x3 - 30.0 * x4, 1.0 - 18.0 * x2 + 32.0 * x3 - 15.0 * x4,
        x - 4.5 * x2 + 6.0 * x3 - 2.5 * x4, 30.0 * x2 - 60.0 * x3 + 30.0 * x4,
        -12.0 * x2 + 28.0 * x3 - 15.0 * x4, 1.5 * x2 - 4.0 * x3 + 2.5 * x4};
    return srp_vec3_scale(1.0 / arc->h, weigh(arc, w));
}

/* ---- Depth ----------------------------------------------------------------------------------- */

/* Apparent radii a of the Sun, b of the body, c their distance: penumbra while c < a + b, umbra
 * while c < b - a, antumbra while c < a - b (srp_sunlight_fraction()). */
double srp_edges_depth(const srp_edges *edges, int edge, double t, srp_vec3 r) {
    const int index = edge / SRP_EDGE_KINDS;
    const srp_celestial central = srp_force_list_central(edges->forces);
    const srp_ephemeris *ephemeris = srp_force_list_ephemeris(edges->forces);
    const srp_vec3 at = srp_vec3_add(r, srp_ephemeris_position(ephemeris, central, t));
    const srp_vec3 sun = srp_vec3_sub(srp_ephemeris_position(ephemeris, SRP_SUN, t), at);
    const srp_vec3 body =
        srp_vec3_sub(srp_ephemeris_position(ephemeris, edges->shadow->body[index], t), at);
    const double ds = srp_vec3_norm(sun), db = srp_vec3_norm(body);
    if (db >= ds) {
        return -1.0;
    }
    const double a = asin(fmin(1.0, edges->shadow->sun_radius / ds));
    const double b = asin(fmin(1.0, edges->shadow->radius[index] / db));
    const double c = atan2(srp_vec3_norm(srp_vec3_cross(sun, body)), srp_vec3_dot(sun, body));
    switch (edge % SRP_EDGE_KINDS) {
    case 0:
        return a + b - c;
    case 1:
        return b - a - c;
    default:
        return a - b - c;
    }
}

void srp_edges_begin(srp_edges *edges, double t, srp_vec3 r) {
    const int count = SRP_EDGE_KINDS * (int)edges->shadow->count;
    for (int edge = 0; edge < count; ++edge) {
        edges->inside[edge] = srp_edges_depth(edges, edge, t, r) > 0.0;
    }
}

/* ---- Crossings ------------------------------------------------------------------------------- */

/* Looks per step: it is a fraction of a revolution, and a shadow is passed on a part of it. What
 * lies between two looks is found by the bend of the depth. */
enum { LOOKS = 8 };

static double depth_at(const srp_edges *edges, int edge, const srp_arc *arc, double x) {
    const double depth =
        srp_edges_depth(edges, edge, arc->t + x * arc->h, srp_arc_position(arc, x));
    return edges->inside[edge] ? depth : -depth; /* below 0: crossed */
}

/* depth >= 0 at low (or there before the last event), < 0 at high. */
static double bisect(const srp_edges *edges, int edge, const srp_arc *arc, double low,
                     double high) {
    for (int i = 0; i < 50 && high - low > 1e-12; ++i) {
        const double middle = 0.5 * (low + high);
        *(depth_at(edges, edge, arc, middle) < 0.0 ? &high : &low) = middle;
    }
    return high;
}

/* The least depth between low and high, by the golden section; stops when it is below 0. */
static double least(const srp_edges *edges, int edge, const srp_arc *arc, double low, double high,
                    double *depth) {
    const double golden = 0.3819660112501051;
    double x = low + golden * (high - low), y = high - golden * (high - low);
    double dx = depth_at(edges, edge, arc, x), dy = depth_at(edges, edge, arc, y);
    for (int i = 0; i < 40 && fmin(dx, dy) >= 0.0 && high - low > 1e-9; ++i) {
        if (dx < dy) {
            high = y;
            y = x;
            dy = dx;
            x = low + golden * (high - low);
            dx = depth_at(edges, edge, arc, x);
        } else {
            low = x;
            x = y;
            dx = dy;
            y = high - golden * (high - low);
            dy = depth_at(edges, edge, arc, y);
        }
    }
    *depth = fmin(dx, dy);
    return dx < dy ? x : y;
}

/* Where the arc first crosses one edge; 2: nowhere. */
static double first_of(const srp_edges *edges, int edge, const srp_arc *arc) {
    double before = INFINITY, last = depth_at(edges, edge, arc, 0.0);
    for (int i = 1; i <= LOOKS; ++i) {
        const double x = (double)i / LOOKS, now = depth_at(edges, edge, arc, x);
        if (i > 1 && last >= 0.0 && last < before && last < now) {
            double depth;
            const double lowest = (double)(i - 2) / LOOKS;
            const double bottom = least(edges, edge, arc, lowest, x, &depth);
            if (depth < 0.0) {
                return bisect(edges, edge, arc, lowest, bottom);
            }
        }
        if (now < 0.0) {
            return bisect(edges, edge, arc, (double)(i - 1) / LOOKS, x);
        }
        before = last;
        last = now;
    }
    return 2.0;
}

int srp_edges_first(const srp_edges *edges, const srp_arc *arc, double *share) {
    int found = -1;
    *share = 2.0;
    const int count = SRP_EDGE_KINDS * (int)edges->shadow->count;
    for (int edge = 0; edge < count; ++edge) {
        const double at = first_of(edges, edge, arc);
        if (at < *share) {
            *share = at;
            found = edge;
        }
    }
    return found;
}
