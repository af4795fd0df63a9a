/* SPDX-License-Identifier: Apache-2.0 */
#include "visibility_oracle.h"

#include "method_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The image is turned by an odd angle, so that edges along the axes of the body are not vertical.
 */
#define TURN 0.7391

/* Faces nearer to one plane than this, relative to the size of the scene, count as in one plane:
 * far above rounding, far below what scenes in tests are made of. */
#define COPLANAR 1e-11

typedef struct vec2 {
    double x, y;
} vec2;

typedef struct segment {
    vec2 p, q;
} segment;

typedef struct oracle {
    const srp_scene *scene;
    srp_vec3 u, v, s, reference;
    double size;
    srp_vec3 *corner; /* (3 facet_count) in the image, z to the Sun */
    double *least_x, *most_x;
    srp_basis *rows;
    /* of one line */
    struct span {
        uint32_t facet;
        double y0, y1, z0, z1;
    } * span;
    double *cuts;
    size_t cuts_capacity;
} oracle;

static void *checked(void *memory) {
    if (memory == NULL) {
        abort();
    }
    return memory;
}

static void make_frame(oracle *o, srp_vec3 s) {
    srp_vec3 axis = fabs(s.x) < 0.6 ? srp_vec3_make(1, 0, 0) : srp_vec3_make(0, 1, 0);
    srp_vec3 a = srp_vec3_cross(s, axis);
    a = srp_vec3_scale(1.0 / srp_vec3_norm(a), a);
    srp_vec3 b = srp_vec3_cross(s, a);
    o->s = s;
    o->u = srp_vec3_add_scaled(srp_vec3_scale(cos(TURN), a), sin(TURN), b);
    o->v = srp_vec3_cross(s, o->u);
}

static int by_double(const void *left, const void *right) {
    double a = *(const double *)left, b = *(const double *)right;
    return a < b ? -1 : a > b;
}

static void oracle_begin(oracle *o, const srp_scene *scene, srp_vec3 s, srp_vec3 reference,
                         srp_basis *rows) {
    memset(o, 0, sizeof *o);
    o->scene = scene;
    o->reference = reference;
    o->rows = rows;
    o->size = scene->radius;
    memset(rows, 0, (scene->material_count + 1) * sizeof *rows);
    make_frame(o, s);
    size_t n = scene->facet_count;
    o->corner = checked(malloc(3 * n * sizeof *o->corner));
    o->least_x = checked(malloc(n * sizeof *o->least_x));
    o->most_x = checked(malloc(n * sizeof *o->most_x));
    o->span = checked(malloc(n * sizeof *o->span));
    for (size_t i = 0; i < n; ++i) {
        o->least_x[i] = INFINITY;
        o->most_x[i] = -INFINITY;
        for (int k = 0; k < 3; ++k) {
            srp_vec3 p = srp_vec3_sub(scene->vertices[scene->facets[i].v[k]], scene->centre);
            srp_vec3 q =
                srp_vec3_make(srp_vec3_dot(p, o->u), srp_vec3_dot(p, o->v), srp_vec3_dot(p, o->s));
            o->corner[3 * i + (size_t)k] = q;
            o->least_x[i] = fmin(o->least_x[i], q.x);
            o->most_x[i] = fmax(o->most_x[i], q.x);
        }
    }
}

static void oracle_end(oracle *o) {
    free(o->corner);
    free(o->least_x);
    free(o->most_x);
    free(o->span);
    free(o->cuts);
}

/* ---- one vertical line ---- */

static bool lies_in_plane(const oracle *o, uint32_t i, uint32_t j) {
    const srp_facet *plane = &o->scene->facets[i], *facet = &o->scene->facets[j];
    for (int k = 0; k < 3; ++k) {
        srp_vec3 d = srp_vec3_sub(o->scene->vertices[facet->v[k]], o->scene->vertices[plane->v[0]]);
        if (fabs(srp_vec3_dot(d, plane->normal)) > COPLANAR * o->size) {
            return false;
        }
    }
    return true;
}

static double height_at(const struct span *span, double y) {
    double t = span->y1 > span->y0 ? (y - span->y0) / (span->y1 - span->y0) : 0.5;
    return span->z0 + t * (span->z1 - span->z0);
}

/* Whether a is hit rather than b, at y where both are. */
static bool is_before(const oracle *o, const struct span *a, const struct span *b, double y) {
    if (lies_in_plane(o, a->facet, b->facet) || lies_in_plane(o, b->facet, a->facet)) {
        bool a_out = srp_vec3_dot(o->scene->facets[a->facet].normal, o->s) > 0.0;
        bool b_out = srp_vec3_dot(o->scene->facets[b->facet].normal, o->s) > 0.0;
        return a_out != b_out ? a_out : a->facet < b->facet;
    }
    return height_at(a, y) > height_at(b, y);
}

/* Crosses facet with the line at x; false when it misses. */
static bool cross_facet(const oracle *o, uint32_t facet, double x, struct span *out) {
    const srp_vec3 *p = &o->corner[3 * (size_t)facet];
    double y[3], z[3];
    int found = 0;
    for (int k = 0; k < 3 && found < 2; ++k) {
        srp_vec3 a = p[k], b = p[(k + 1) % 3];
        if ((a.x < x) != (b.x < x)) {
            double t = (x - a.x) / (b.x - a.x);
            y[found] = a.y + t * (b.y - a.y);
            z[found] = a.z + t * (b.z - a.z);
            ++found;
        }
    }
    if (found < 2) {
        return false;
    }
    int low = y[0] <= y[1] ? 0 : 1;
    *out = (struct span){facet, y[low], y[1 - low], z[low], z[1 - low]};
    return true;
}

static size_t add_cut(oracle *o, size_t count, double y) {
    if (count == o->cuts_capacity) {
        o->cuts_capacity = o->cuts_capacity * 2 + 64;
        o->cuts = checked(realloc(o->cuts, o->cuts_capacity * sizeof *o->cuts));
    }
    o->cuts[count] = y;
    return count + 1;
}

/* Ends of spans, and where two of them are at one height. */
static size_t cut_line(oracle *o, size_t spans) {
    size_t count = 0;
    for (size_t i = 0; i < spans; ++i) {
        const struct span *a = &o->span[i];
        count = add_cut(o, count, a->y0);
        count = add_cut(o, count, a->y1);
        for (size_t j = 0; j < i; ++j) {
            const struct span *b = &o->span[j];
            double y0 = fmax(a->y0, b->y0), y1 = fmin(a->y1, b->y1);
            if (y0 < y1) {
                double d0 = height_at(a, y0) - height_at(b, y0);
                double d1 = height_at(a, y1) - height_at(b, y1);
                if ((d0 < 0.0) != (d1 < 0.0)) {
                    count = add_cut(o, count, y0 + d0 / (d0 - d1) * (y1 - y0));
                }
            }
        }
    }
    if (count > 1) {
        qsort(o->cuts, count, sizeof *o->cuts, by_double);
    }
    return count;
}

static void add_light(oracle *o, const struct span *span, double x, double y, double lit) {
    const srp_facet *facet = &o->scene->facets[span->facet];
    double cosine = srp_vec3_dot(facet->normal, o->s);
    bool back = cosine < 0.0;
    bool absorbs = back && o->scene->optics[facet->material].one_sided;
    srp_vec3 p = srp_vec3_add_scaled(srp_vec3_scale(x, o->u), y, o->v);
    p = srp_vec3_add(srp_vec3_add_scaled(p, height_at(span, y), o->s), o->scene->centre);
    srp_basis_add(&o->rows[absorbs ? o->scene->material_count : facet->material], lit, fabs(cosine),
                  back ? srp_vec3_scale(-1.0, facet->normal) : facet->normal,
                  srp_vec3_sub(p, o->reference));
}

/* Adds `weight` times the visible lengths on the line at x, among the facets listed. */
static void add_line(oracle *o, const uint32_t *facets, size_t facet_count, double x,
                     double weight) {
    size_t spans = 0;
    for (size_t i = 0; i < facet_count; ++i) {
        spans += cross_facet(o, facets[i], x, &o->span[spans]) ? 1 : 0;
    }
    size_t cuts = cut_line(o, spans);
    for (size_t k = 0; k + 1 < cuts; ++k) {
        double y = 0.5 * (o->cuts[k] + o->cuts[k + 1]), length = o->cuts[k + 1] - o->cuts[k];
        const struct span *best = NULL;
        for (size_t i = 0; i < spans && length > 0.0; ++i) {
            const struct span *span = &o->span[i];
            if (span->y0 < y && y < span->y1 && (best == NULL || is_before(o, span, best, y))) {
                best = span;
            }
        }
        if (best != NULL) {
            add_light(o, best, x, y, weight * length);
        }
    }
}

/* ---- strips ---- */

typedef struct events {
    segment *segment;
    size_t segment_count, segment_capacity;
    double *x;
    size_t count, capacity;
} events;

static void add_event(events *e, double x) {
    if (e->count == e->capacity) {
        e->capacity = e->capacity * 2 + 256;
        e->x = checked(realloc(e->x, e->capacity * sizeof *e->x));
    }
    e->x[e->count++] = x;
}

static void add_segment(events *e, vec2 p, vec2 q) {
    if (e->segment_count == e->segment_capacity) {
        e->segment_capacity = e->segment_capacity * 2 + 64;
        e->segment = checked(realloc(e->segment, e->segment_capacity * sizeof *e->segment));
    }
    e->segment[e->segment_count++] = (segment){p, q};
    add_event(e, p.x);
    add_event(e, q.x);
}

/* The points where edges of facet j pass through the plane of facet i; false when there are none.
 */
static bool pierce(const oracle *o, uint32_t i, uint32_t j, srp_vec3 found[3]) {
    const srp_vec3 *p = &o->corner[3 * (size_t)i], *q = &o->corner[3 * (size_t)j];
    srp_vec3 n = srp_vec3_cross(srp_vec3_sub(p[1], p[0]), srp_vec3_sub(p[2], p[0]));
    int count = 0;
    for (int k = 0; k < 3; ++k) {
        srp_vec3 a = q[k], b = q[(k + 1) % 3];
        double da = srp_vec3_dot(n, srp_vec3_sub(a, p[0]));
        double db = srp_vec3_dot(n, srp_vec3_sub(b, p[0]));
        if ((da < 0.0) != (db < 0.0)) {
            found[count++] = srp_vec3_add_scaled(a, da / (da - db), srp_vec3_sub(b, a));
        }
    }
    return count >= 2;
}

/* Segments along which facets cut through each other: both meet the line that their planes have in
 * common in an interval, and the segment is what the intervals share. */
static void add_cut_segments(const oracle *o, events *e) {
    uint32_t n = (uint32_t)o->scene->facet_count;
    for (uint32_t i = 0; i < n; ++i) {
        for (uint32_t j = 0; j < i; ++j) {
            srp_vec3 a[3], b[3];
            if (!pierce(o, i, j, a) || !pierce(o, j, i, b)) {
                continue;
            }
            srp_vec3 along = srp_vec3_sub(a[1], a[0]);
            double length = srp_vec3_dot(along, along);
            double t0 = srp_vec3_dot(srp_vec3_sub(b[0], a[0]), along) / length;
            double t1 = srp_vec3_dot(srp_vec3_sub(b[1], a[0]), along) / length;
            double low = fmax(0.0, fmin(t0, t1)), high = fmin(1.0, fmax(t0, t1));
            if (low < high) {
                add_segment(e, (vec2){a[0].x + low * along.x, a[0].y + low * along.y},
                            (vec2){a[0].x + high * along.x, a[0].y + high * along.y});
            }
        }
    }
}

static void add_crossing(events *e, const segment *a, const segment *b) {
    double ax = a->q.x - a->p.x, ay = a->q.y - a->p.y;
    double bx = b->q.x - b->p.x, by = b->q.y - b->p.y;
    double dx = b->p.x - a->p.x, dy = b->p.y - a->p.y;
    double det = ax * by - ay * bx;
    double t = (dx * by - dy * bx) / det, r = (dx * ay - dy * ax) / det;
    if (t > 0.0 && t < 1.0 && r > 0.0 && r < 1.0) {
        add_event(e, a->p.x + t * ax);
    }
}

static void collect_events(const oracle *o, events *e) {
    for (size_t i = 0; i < o->scene->facet_count; ++i) {
        const srp_vec3 *p = &o->corner[3 * i];
        for (int k = 0; k < 3; ++k) {
            srp_vec3 a = p[k], b = p[(k + 1) % 3];
            add_segment(e, (vec2){a.x, a.y}, (vec2){b.x, b.y});
        }
    }
    add_cut_segments(o, e);
    for (size_t i = 0; i < e->segment_count; ++i) {
        for (size_t j = 0; j < i; ++j) {
            add_crossing(e, &e->segment[i], &e->segment[j]);
        }
    }
    qsort(e->x, e->count, sizeof *e->x, by_double);
}

void oracle_strips(const srp_scene *scene, srp_vec3 s, srp_vec3 reference, srp_basis *rows) {
    oracle o;
    events e;
    memset(&e, 0, sizeof e);
    oracle_begin(&o, scene, s, reference, rows);
    collect_events(&o, &e);
    uint32_t *near = checked(malloc(scene->facet_count * sizeof *near));
    const double gauss = 0.5 / sqrt(3.0);
    for (size_t k = 0; k + 1 < e.count; ++k) {
        double width = e.x[k + 1] - e.x[k], middle = 0.5 * (e.x[k] + e.x[k + 1]);
        size_t count = 0;
        for (uint32_t i = 0; i < scene->facet_count; ++i) {
            near[count] = i;
            count += o.least_x[i] < middle && middle < o.most_x[i] ? 1 : 0;
        }
        if (width > 0.0) {
            add_line(&o, near, count, middle - gauss * width, 0.5 * width);
            add_line(&o, near, count, middle + gauss * width, 0.5 * width);
        }
    }
    free(near);
    free(e.segment);
    free(e.x);
    oracle_end(&o);
}

void oracle_lines(const srp_scene *scene, srp_vec3 s, srp_vec3 reference, size_t lines,
                  srp_basis *rows) {
    oracle o;
    oracle_begin(&o, scene, s, reference, rows);
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < scene->facet_count; ++i) {
        low = fmin(low, o.least_x[i]);
        high = fmax(high, o.most_x[i]);
    }
    uint32_t *near = checked(malloc(scene->facet_count * sizeof *near));
    double width = (high - low) / (double)lines;
    for (size_t k = 0; k < lines; ++k) {
        double x = low + ((double)k + 0.5) * width;
        size_t count = 0;
        for (uint32_t i = 0; i < scene->facet_count; ++i) {
            near[count] = i;
            count += o.least_x[i] < x && x < o.most_x[i] ? 1 : 0;
        }
        add_line(&o, near, count, x, width);
    }
    free(near);
    oracle_end(&o);
}
