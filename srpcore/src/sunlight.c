/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Eclipses, on the plane of the sky around the Sun: bodies are disks there, at their angular
 * distance from the Sun's centre.
 *
 * One body leaves the Sun's disk less a lens of two circular segments (O. Montenbruck and E. Gill,
 * "Satellite Orbits", Springer 2000, Eq. 3.87 to 3.94). Departures: nothing is asked about the side
 * of the body that the spacecraft is on, since the angles tell it; segments are computed without
 * cancellation. Several bodies leave an area that is integrated along its edge.
 */
#include <srp/sunlight.h>

#include <math.h>
#include <stdbool.h>

enum { DISKS_MAX = 16 };

typedef struct disk {
    double x, y, radius; /* [rad], the Sun's centre at 0 */
} disk;

static double apparent_radius(double radius, double distance) {
    return radius < distance ? asin(radius / distance) : 0.5 * SRP_PI;
}

/* (u - sin u) / 2. */
static double half_excess(double u) {
    if (u > 0.5) {
        return 0.5 * (u - sin(u));
    }
    double uu = u * u, sum = 1.0;
    for (int k = 12; k >= 4; k -= 2) {
        sum = 1.0 - uu / (double)(k * (k + 1)) * sum;
    }
    return u * uu * sum / 12.0;
}

/* What a chord cuts off a circle: half the chord is y, and x its distance from the centre, below 0
 * when the centre is on the side that is cut off. */
static double segment_area(double radius, double x, double y) {
    return radius * radius * half_excess(2.0 * atan2(y, x));
}

/* Area that two circles of radii a and b share whose centres are c apart; they cross. */
static double lens_area(double a, double b, double c) {
    double product = (a + b + c) * (b + c - a) * (a - b + c) * (a + b - c);
    double y = 0.5 * sqrt(product > 0.0 ? product : 0.0) / c;
    double x = 0.5 * (c + (a - b) * (a + b) / c);
    return segment_area(a, x, y) + segment_area(b, c - x, y);
}

/* ---- Several bodies ------------------------------------------------------------------------- */

typedef enum relation { APART, WITHIN, CROSSING } relation;

/* Where the edge of `circle` runs inside `other`; an arc by its begin and its length. */
static relation edge_inside(disk circle, disk other, double *begin, double *length) {
    double dx = other.x - circle.x, dy = other.y - circle.y, distance = hypot(dx, dy);
    if (distance >= circle.radius + other.radius || distance + other.radius <= circle.radius) {
        return APART;
    }
    if (distance + circle.radius <= other.radius) {
        return WITHIN;
    }
    double r = circle.radius;
    double x = 0.5 * (distance + (r - other.radius) * (r + other.radius) / distance);
    double half = acos(fmax(-1.0, fmin(1.0, x / r)));
    *begin = atan2(dy, dx) - half;
    *length = 2.0 * half;
    return CROSSING;
}

/* An angle [rad] reduced to [0, 2 pi). */
static double turn(double angle) {
    double rest = fmod(angle, 2.0 * SRP_PI);
    return rest < 0.0 ? rest + 2.0 * SRP_PI : rest;
}

/* Parts of one edge that do not count. */
typedef struct cuts {
    double begin[DISKS_MAX + 1], length[DISKS_MAX + 1];
    size_t count;
} cuts;

/* What of the edge of disks[which] does not bound the seen part of the Sun, disks[0]; false: all of
 * it. */
static bool collect_cuts(const disk *disks, size_t count, size_t which, cuts *out) {
    out->count = 0;
    for (size_t k = 0; k < count; ++k) {
        double begin, length;
        relation is = k == which ? APART : edge_inside(disks[which], disks[k], &begin, &length);
        if (k == 0 && which != 0) { /* of a body's edge, what is off the Sun */
            if (is == APART) {
                return false;
            }
            begin = is == CROSSING ? begin + length : 0.0;
            length = is == CROSSING ? 2.0 * SRP_PI - length : 0.0;
        } else if (is == WITHIN) {
            return false;
        }
        if (is == CROSSING) {
            out->begin[out->count] = turn(begin);
            out->length[out->count++] = length;
        }
    }
    return true;
}

/* Twice the area between an arc of the edge and the origin. */
static double swept(disk circle, double begin, double length) {
    double end = begin + length;
    return circle.radius * (circle.radius * length + circle.x * (sin(end) - sin(begin)) -
                            circle.y * (cos(end) - cos(begin)));
}

/* The same of all that is left of the edge between the cuts. */
static double swept_between(disk circle, const cuts *all) {
    double sum = all->count == 0 ? swept(circle, 0.0, 2.0 * SRP_PI) : 0.0;
    for (size_t j = 0; j < all->count; ++j) {
        /* An arc begins where cut j ends, unless another cut goes on there. */
        double from = turn(all->begin[j] + all->length[j]), length = 2.0 * SRP_PI;
        bool begins = true;
        for (size_t k = 0; k < all->count; ++k) {
            double into = turn(from - all->begin[k]);
            begins =
                begins && (k == j || into > all->length[k] || (into == all->length[k] && j < k));
            length = fmin(length, turn(all->begin[k] - from));
        }
        sum += begins ? swept(circle, from, length) : 0.0;
    }
    return sum;
}

/* Area of disks[0] that none of the others covers. */
static double uncovered_area(const disk *disks, size_t count) {
    double twice = 0.0;
    for (size_t k = 0; k < count; ++k) {
        cuts all;
        if (collect_cuts(disks, count, k, &all)) {
            twice += (k == 0 ? 1.0 : -1.0) * swept_between(disks[k], &all);
        }
    }
    return 0.5 * twice;
}

/* ---- All of them ---------------------------------------------------------------------------- */

typedef struct sky {
    srp_vec3 to_sun, east, north; /* unit vectors */
    double distance, radius;      /* of the Sun: [m], apparent [rad] */
    disk disks[DISKS_MAX + 1];    /* the Sun's and those that cover part of it */
    size_t count;
    double rest; /* area that further bodies cover */
} sky;

static void set_axes(sky *s, srp_vec3 sun) {
    s->to_sun = srp_vec3_scale(1.0 / s->distance, sun);
    srp_vec3 n = s->to_sun;
    srp_vec3 aside = fabs(n.z) < 0.7 ? srp_vec3_make(0.0, 0.0, 1.0) : srp_vec3_make(1.0, 0.0, 0.0);
    srp_vec3 east = srp_vec3_cross(aside, n);
    s->east = srp_vec3_scale(1.0 / srp_vec3_norm(east), east);
    s->north = srp_vec3_cross(n, s->east);
}

/* Whether a disk covers no more than another that is there covers already. */
static bool is_hidden(const sky *s, disk d) {
    for (size_t k = 1; k < s->count; ++k) {
        double off = hypot(d.x - s->disks[k].x, d.y - s->disks[k].y);
        if (off + d.radius <= s->disks[k].radius) {
            return true;
        }
    }
    return false;
}

/* Takes a body in; false when it hides the Sun altogether. */
static bool add_body(sky *s, const srp_body *body) {
    double distance = srp_vec3_norm(body->position);
    if (distance >= s->distance || body->radius == 0.0) {
        return true;
    }
    if (distance == 0.0) {
        return false;
    }
    double b = apparent_radius(body->radius, distance), a = s->radius;
    double x = srp_vec3_dot(body->position, s->east), y = srp_vec3_dot(body->position, s->north);
    double across = hypot(x, y);
    double c = atan2(across, srp_vec3_dot(body->position, s->to_sun));
    if (c >= a + b) {
        return true;
    }
    if (c + a <= b) {
        return false;
    }
    disk d = {across > 0.0 ? c * x / across : 0.0, across > 0.0 ? c * y / across : 0.0, b};
    if (s->count <= DISKS_MAX) {
        if (!is_hidden(s, d)) {
            s->disks[s->count++] = d;
        }
    } else {
        s->rest += c + b <= a ? SRP_PI * b * b : lens_area(a, b, c);
    }
    return true;
}

/* Area of the Sun that is seen. */
static double seen_area(const sky *s) {
    double a = s->radius, whole = SRP_PI * a * a;
    if (s->count == 1) {
        return whole;
    }
    if (s->count > 2) {
        return uncovered_area(s->disks, s->count) - s->rest;
    }
    double b = s->disks[1].radius, c = hypot(s->disks[1].x, s->disks[1].y);
    return whole - (c + b <= a ? SRP_PI * b * b : lens_area(a, b, c));
}

double srp_sunlight_fraction(srp_vec3 sun, double sun_radius, size_t count,
                             const srp_body *bodies) {
    sky s = {.distance = srp_vec3_norm(sun), .count = 1, .rest = 0.0};
    bool valid = srp_vec3_is_finite(sun) && sun_radius >= 0.0;
    for (size_t k = 0; k < count; ++k) {
        valid = valid && srp_vec3_is_finite(bodies[k].position) && bodies[k].radius >= 0.0;
    }
    if (!valid) {
        return NAN;
    }
    if (s.distance == 0.0) {
        return 1.0;
    }
    set_axes(&s, sun);
    s.radius = apparent_radius(sun_radius, s.distance);
    s.disks[0] = (disk){0.0, 0.0, s.radius};
    for (size_t k = 0; k < count; ++k) {
        if (!add_body(&s, &bodies[k])) {
            return 0.0;
        }
    }
    if (s.count == 1) {
        return 1.0; /* a point's area says nothing */
    }
    double share = seen_area(&s) / (SRP_PI * s.radius * s.radius);
    return fmin(1.0, fmax(0.0, share));
}
