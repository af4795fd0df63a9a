/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Exact: the visible polygons of every face, by clipping, in double precision. No rays, no pixels.
 *
 * For one direction:
 *   1. project the vertices onto the plane that faces the Sun (view.h);
 *   2. keep the faces that light could hit first: of closed bodies those turned to the Sun, of open
 *      surfaces all, turned over where the Sun sees their back;
 *   3. list every pair whose boxes in the image overlap, once (exact_pairs.h), and find out for
 *      each whether the two overlap and which one hides the other (compare_pair());
 *   4. take away from each face what its list of occluders hides (exact_polygon.h); area and
 *      centroid of what is left go to the sums of its material.
 * Nothing is approximated: what is left over is the rounding of step 1, some 1e-16 of the size of
 * the mesh, times the length of the edges.
 *
 * Who hides whom. A pair is judged once for both of its members, from the heights of each one's
 * corners above the plane of the other, in body axes and not in the image, where nearly edge-on
 * planes are too steep to be told apart. Then
 *   - j can hide i only where a corner of j stands above i's plane and one of i below j's plane;
 *   - if both can hide the other, they cut through each other, or their planes do: j hides i within
 *     the half-plane where j is higher. The line is the same from both sides, to the bit;
 *   - if neither can, they lie in one plane (or only touch): the lower index hides the other, but
 *     an outside before a back, so that a box that stands on a foil keeps its own optics.
 * For each pair exactly one of the two loses each point of their overlap: light counts once.
 *
 * Heights below the rounding noise of a plane count as none. A small face that lies on a large one
 * is in the large one's plane to within that noise; the large one, seen from the ill-known plane of
 * the small one, is not. Hence a verdict needs both, and either can deny it.
 */
#include "error.h"
#include "exact_kernel.h"
#include "exact_pairs.h"
#include "exact_polygon.h"
#include "method_internal.h"
#include "scene_internal.h"
#include "view.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

/* Rounding noise, in units of DBL_EPSILON times the size of the mesh: of a coordinate in the image
 * after a few operations, and of a height above a well-shaped face. */
#define SLACK_ULPS 16.0
#define PLANE_ULPS 32.0

#define NO_OCCLUSION UINT32_MAX

typedef struct exact {
    srp_prepared head;
    srp_scratch_pool pool;
    double size; /* of the largest coordinate [m]: what rounding is relative to */
} exact;

/* A facet that light could hit first, from the side the Sun is on. */
typedef struct face {
    uint32_t v[3];       /* counter-clockwise in the image */
    uint32_t facet;      /* into scene->facets */
    uint32_t occlusions; /* first of its list, or NO_OCCLUSION */
    bool back;           /* the Sun is on the inner side */
    bool hidden;         /* wholly behind others */
    double cosine;       /* |n.s| > 0 */
    double top;          /* height of its nearest corner [m] */
} face;

/* Entry of the list of those that hide a face. */
typedef struct occlusion {
    uint32_t next;
    uint32_t occluder;  /* into faces */
    bool only_if_above; /* only where its plane is higher */
} occlusion;

typedef struct exact_scratch {
    srp_scratch base;
    const exact *method;
    srp_view view;
    double slack, plane_noise; /* [m] */
    srp_vec3 *image;           /* projected vertices, about the centre of the scene */
    face *faces;
    size_t face_count;
    uint32_t *order, *bucket; /* faces from near to far, and what sorts them */
    srp_box_stack boxes;
    occlusion *occlusions;
    size_t occlusion_count, occlusion_capacity;
    srp_occluder *occluders;
    size_t occluder_capacity;
    srp_visible_scratch visible;
} exact_scratch;

static void scratch_destroy(srp_scratch *base) {
    exact_scratch *work = (exact_scratch *)base;
    if (work == NULL) {
        return;
    }
    srp_visible_scratch_free(&work->visible);
    free(work->boxes.item);
    free(work->occluders);
    free(work->occlusions);
    free(work->bucket);
    free(work->order);
    free(work->faces);
    free(work->image);
    free(work);
}

static srp_scratch *scratch_create(const srp_prepared *prepared) {
    const srp_scene *scene = prepared->scene;
    exact_scratch *work = calloc(1, sizeof *work);
    if (work == NULL) {
        return NULL;
    }
    work->method = (const exact *)prepared;
    work->slack = SLACK_ULPS * DBL_EPSILON * work->method->size;
    work->plane_noise = PLANE_ULPS * DBL_EPSILON * work->method->size;
    work->image = malloc(scene->vertex_count * sizeof *work->image);
    work->faces = malloc(scene->facet_count * sizeof *work->faces);
    work->order = malloc(scene->facet_count * sizeof *work->order);
    work->bucket = malloc((scene->facet_count + 1) * sizeof *work->bucket);
    if (work->image == NULL || work->faces == NULL || work->order == NULL || work->bucket == NULL ||
        srp_box_stack_reserve(&work->boxes, scene->facet_count) != SRP_OK) {
        scratch_destroy(&work->base);
        return NULL;
    }
    return &work->base;
}

/* fmax() is a call where the compiler must honour NaN. */
static double largest(double a, double b, double c) {
    double ab = a > b ? a : b;
    return ab > c ? ab : c;
}

/* ---- the faces and their boxes ---- */

static void project(exact_scratch *work, const srp_scene *scene) {
    for (size_t i = 0; i < scene->vertex_count; ++i) {
        work->image[i] =
            srp_view_project(&work->view, srp_vec3_sub(scene->vertices[i], scene->centre));
    }
}

/* Twice the signed area in the image; *thin when the triangle is no wider than rounding noise. */
static double twice_image_area(const exact_scratch *work, const uint32_t *v, bool *thin) {
    const srp_vec3 *a = &work->image[v[0]], *b = &work->image[v[1]], *c = &work->image[v[2]];
    double abx = b->x - a->x, aby = b->y - a->y, acx = c->x - a->x, acy = c->y - a->y;
    double twice = abx * acy - aby * acx;
    double longest =
        largest(fabs(abx) + fabs(aby), fabs(acx) + fabs(acy), fabs(abx - acx) + fabs(aby - acy));
    *thin = fabs(twice) <= 2.0 * work->slack * longest;
    return twice;
}

/* Its box in float, `pad` wider than the rounding to float can make it too small. */
static srp_box2 box_of(const exact_scratch *work, const uint32_t *v, double pad, uint32_t id) {
    const srp_vec3 *a = &work->image[v[0]], *b = &work->image[v[1]], *c = &work->image[v[2]];
    double x0 = a->x < b->x ? a->x : b->x, x1 = a->x < b->x ? b->x : a->x;
    double y0 = a->y < b->y ? a->y : b->y, y1 = a->y < b->y ? b->y : a->y;
    srp_box2 box;
    box.x0 = (float)((c->x < x0 ? c->x : x0) - pad);
    box.x1 = (float)((c->x > x1 ? c->x : x1) + pad);
    box.y0 = (float)((c->y < y0 ? c->y : y0) - pad);
    box.y1 = (float)((c->y > y1 ? c->y : y1) + pad);
    box.id = id;
    return box;
}

static void collect_faces(exact_scratch *work, const srp_scene *scene) {
    double pad = 2.0 * FLT_EPSILON * work->method->size;
    size_t count = 0;
    for (size_t i = 0; i < scene->facet_count; ++i) {
        const srp_facet *facet = &scene->facets[i];
        double cosine = srp_vec3_dot(facet->normal, work->view.s);
        bool back = cosine < 0.0, thin;
        if (back && facet->closed) {
            continue;
        }
        double twice = twice_image_area(work, facet->v, &thin);
        if (thin || (twice < 0.0) != back) {
            continue; /* edge-on: no light on it, no shadow from it */
        }
        face *f = &work->faces[count];
        f->v[0] = facet->v[0];
        f->v[1] = facet->v[back ? 2 : 1];
        f->v[2] = facet->v[back ? 1 : 2];
        f->facet = (uint32_t)i;
        f->occlusions = NO_OCCLUSION;
        f->back = back;
        f->hidden = false;
        f->cosine = fabs(cosine);
        f->top = largest(work->image[f->v[0]].z, work->image[f->v[1]].z, work->image[f->v[2]].z);
        work->boxes.item[count] = box_of(work, f->v, pad, (uint32_t)count);
        ++count;
    }
    work->face_count = count;
}

/* ---- who hides whom ---- */

static srp_vec3 turned_normal(const face *f, const srp_facet *facet) {
    return f->back ? srp_vec3_scale(-1.0, facet->normal) : facet->normal;
}

/* The line of an edge, its left side inside. Taken from the vertex of lower index, so that the two
 * faces at an edge have the same line to the bit. */
static srp_line2 edge_line(const exact_scratch *work, uint32_t from, uint32_t to) {
    double sign = from < to ? 1.0 : -1.0;
    const srp_vec3 *a = &work->image[from < to ? from : to];
    const srp_vec3 *b = &work->image[from < to ? to : from];
    double ex = b->x - a->x, ey = b->y - a->y;
    srp_line2 line;
    line.a = -sign * ey;
    line.b = sign * ex;
    line.c = sign * (ey * a->x - ex * a->y);
    line.slack = work->slack * (fabs(ex) + fabs(ey));
    return line;
}

static void edge_lines(const exact_scratch *work, const face *f, srp_line2 *line) {
    line[0] = edge_line(work, f->v[0], f->v[1]);
    line[1] = edge_line(work, f->v[1], f->v[2]);
    line[2] = edge_line(work, f->v[2], f->v[0]);
}

/* Where a triangle lies against the edges of another. */
typedef enum placement { APART, OVERLAPPING, WITHIN } placement;

static placement place_against(const exact_scratch *work, const srp_line2 *edge,
                               const uint32_t *v) {
    srp_point2 p[3];
    for (int k = 0; k < 3; ++k) {
        p[k] = (srp_point2){work->image[v[k]].x, work->image[v[k]].y};
    }
    bool within = true;
    for (int k = 0; k < 3; ++k) {
        double d0 = srp_line2_value(&edge[k], p[0]);
        double d1 = srp_line2_value(&edge[k], p[1]);
        double d2 = srp_line2_value(&edge[k], p[2]);
        double slack = edge[k].slack;
        if ((d0 <= slack) & (d1 <= slack) & (d2 <= slack)) {
            return APART;
        }
        within = within & (d0 >= -slack) & (d1 >= -slack) & (d2 >= -slack);
    }
    return within ? WITHIN : OVERLAPPING;
}

/* Heights of the corners of a face above the plane of another, beyond the noise of that plane. */
typedef struct heights {
    bool above, below;
} heights;

static heights heights_over(const exact_scratch *work, const srp_scene *scene, const face *over,
                            const face *corners) {
    const srp_facet *facet = &scene->facets[over->facet];
    srp_vec3 normal = turned_normal(over, facet);
    srp_vec3 a = scene->vertices[over->v[0]];
    srp_vec3 ab = srp_vec3_sub(scene->vertices[over->v[1]], a);
    srp_vec3 ac = srp_vec3_sub(scene->vertices[over->v[2]], a);
    srp_vec3 bc = srp_vec3_sub(ac, ab);
    double longest = largest(srp_vec3_dot(ab, ab), srp_vec3_dot(ac, ac), srp_vec3_dot(bc, bc));
    /* A plane through points known to e tilts by e / width: over its own length, e length/width. */
    double noise = work->plane_noise * (1.0 + longest / (2.0 * facet->area));
    heights h = {false, false};
    for (int k = 0; k < 3; ++k) {
        double height = srp_vec3_dot(normal, srp_vec3_sub(scene->vertices[corners->v[k]], a));
        h.above = h.above || height > noise;
        h.below = h.below || height < -noise;
    }
    return h;
}

static srp_status add_occlusion(exact_scratch *work, uint32_t target, uint32_t occluder,
                                bool only_if_above) {
    if (work->occlusion_count == work->occlusion_capacity) {
        size_t capacity = work->occlusion_capacity < 256 ? 256 : work->occlusion_capacity * 2;
        occlusion *larger =
            capacity > NO_OCCLUSION ? NULL : realloc(work->occlusions, capacity * sizeof *larger);
        if (larger == NULL) {
            return SRP_NO_MEMORY;
        }
        work->occlusions = larger;
        work->occlusion_capacity = capacity;
    }
    occlusion *entry = &work->occlusions[work->occlusion_count];
    entry->next = work->faces[target].occlusions;
    entry->occluder = occluder;
    entry->only_if_above = only_if_above;
    work->faces[target].occlusions = (uint32_t)work->occlusion_count++;
    return SRP_OK;
}

/* Of two faces in one plane, whether the first is the one that light hits. */
static bool comes_first(const face *i, const face *j) {
    return i->back != j->back ? j->back : i->facet < j->facet;
}

/* Notes that `occluder` hides `target` where they overlap. A face that lies within its occluder is
 * done with: whatever it could hide, the occluder hides too. */
static srp_status hide(exact_scratch *work, uint32_t target, uint32_t occluder, bool within) {
    if (within) {
        work->faces[target].hidden = true;
        return SRP_OK;
    }
    return add_occlusion(work, target, occluder, false);
}

/* Judges one pair for both; see the head of the file. `edge_a`: the edges of the first. */
static srp_status compare_pair(exact_scratch *work, uint32_t i, const srp_line2 *edge_a,
                               uint32_t j) {
    const srp_scene *scene = work->method->head.scene;
    const face *a = &work->faces[i], *b = &work->faces[j];
    placement b_in_a = place_against(work, edge_a, b->v);
    if (b_in_a == APART) {
        return SRP_OK;
    }
    srp_line2 edge_b[3];
    edge_lines(work, b, edge_b);
    placement a_in_b = place_against(work, edge_b, a->v);
    if (a_in_b == APART) {
        return SRP_OK;
    }
    heights b_over_a = heights_over(work, scene, a, b);
    heights a_over_b = heights_over(work, scene, b, a);
    bool b_hides = b_over_a.above && a_over_b.below;
    bool a_hides = a_over_b.above && b_over_a.below;
    if (a_hides && b_hides) {
        srp_status status = add_occlusion(work, i, j, true);
        return status != SRP_OK ? status : add_occlusion(work, j, i, true);
    }
    if (a_hides || (!b_hides && comes_first(a, b))) {
        return hide(work, j, i, b_in_a == WITHIN);
    }
    return hide(work, i, j, a_in_b == WITHIN);
}

static srp_status compare_faces(void *user, uint32_t i, const uint32_t *others, size_t count) {
    exact_scratch *work = user;
    srp_line2 edge[3];
    edge_lines(work, &work->faces[i], edge);
    srp_status status = SRP_OK;
    for (size_t k = 0; k < count && status == SRP_OK && !work->faces[i].hidden; ++k) {
        if (!work->faces[others[k]].hidden) {
            status = compare_pair(work, i, edge, others[k]);
        }
    }
    return status;
}

/* ---- what is left ---- */

/* Inside: where the plane of `upper` is higher than that of `lower`. With a plane n.p = h and
 * p = x u + y v + w s, w = (h - x n.u - y n.v) / n.s; both sides are multiplied by both cosines. */
static srp_line2 height_line(const exact_scratch *work, const srp_scene *scene, const face *upper,
                             const face *lower) {
    srp_vec3 n[2];
    double h[2];
    const face *f[2] = {upper, lower};
    for (int k = 0; k < 2; ++k) {
        n[k] = turned_normal(f[k], &scene->facets[f[k]->facet]);
        h[k] = srp_vec3_dot(n[k], srp_vec3_sub(scene->vertices[f[k]->v[0]], scene->centre));
    }
    double cu = upper->cosine, cl = lower->cosine;
    srp_line2 line;
    line.a = cu * srp_vec3_dot(n[1], work->view.u) - cl * srp_vec3_dot(n[0], work->view.u);
    line.b = cu * srp_vec3_dot(n[1], work->view.v) - cl * srp_vec3_dot(n[0], work->view.v);
    line.c = cl * h[0] - cu * h[1];
    line.slack = work->slack * (fabs(line.a) + fabs(line.b));
    return line;
}

static void set_occluder(const exact_scratch *work, const srp_scene *scene, const face *target,
                         const face *by, bool only_if_above, srp_occluder *out) {
    edge_lines(work, by, out->line);
    out->line_count = 3;
    if (only_if_above) {
        out->line[out->line_count++] = height_line(work, scene, by, target);
    }
}

static srp_status reserve_occluders(exact_scratch *work, size_t count) {
    if (count > work->occluder_capacity) {
        size_t capacity = count + count / 2 + 32;
        srp_occluder *larger = realloc(work->occluders, capacity * sizeof *larger);
        if (larger == NULL) {
            return SRP_NO_MEMORY;
        }
        work->occluders = larger;
        work->occluder_capacity = capacity;
    }
    return srp_box_stack_reserve(&work->visible.lists, count);
}

static srp_status gather_occluders(exact_scratch *work, const srp_scene *scene, const face *target,
                                   size_t *count) {
    size_t n = 0;
    for (uint32_t k = target->occlusions; k != NO_OCCLUSION; k = work->occlusions[k].next) {
        const occlusion *entry = &work->occlusions[k];
        const face *by = &work->faces[entry->occluder];
        if (by->hidden) {
            continue;
        }
        srp_status status = reserve_occluders(work, n + 1);
        if (status != SRP_OK) {
            return status;
        }
        set_occluder(work, scene, target, by, entry->only_if_above, &work->occluders[n]);
        work->visible.lists.item[n] = work->boxes.item[entry->occluder];
        work->visible.lists.item[n].id = (uint32_t)n;
        ++n;
    }
    *count = n;
    return SRP_OK;
}

/* The point of the facet that is seen at (x, y) from the image of its corner v[0]. */
static srp_vec3 lift(const exact_scratch *work, const srp_scene *scene, const face *f, double x,
                     double y) {
    srp_vec3 n = turned_normal(f, &scene->facets[f->facet]);
    double w = -(x * srp_vec3_dot(n, work->view.u) + y * srp_vec3_dot(n, work->view.v)) / f->cosine;
    srp_vec3 offset = srp_view_lift(&work->view, srp_vec3_make(x, y, w));
    return srp_vec3_add(scene->vertices[f->v[0]], offset);
}

static srp_vec3 middle(const srp_scene *scene, const uint32_t *v) {
    srp_vec3 sum = srp_vec3_add(scene->vertices[v[0]], scene->vertices[v[1]]);
    return srp_vec3_scale(1.0 / 3.0, srp_vec3_add(sum, scene->vertices[v[2]]));
}

/* Lit cross-section of a face and the centroid of the lit part. */
static srp_status measure_face(exact_scratch *work, const srp_scene *scene, const face *f,
                               double *lit, srp_vec3 *centroid) {
    size_t count;
    srp_status status = gather_occluders(work, scene, f, &count);
    if (status != SRP_OK) {
        return status;
    }
    if (count == 0) {
        *lit = scene->facets[f->facet].area * f->cosine;
        *centroid = middle(scene, f->v);
        return SRP_OK;
    }
    srp_polygon outline;
    outline.count = 3;
    for (int k = 0; k < 3; ++k) {
        outline.p[k] = (srp_point2){work->image[f->v[k]].x, work->image[f->v[k]].y};
    }
    srp_moments seen;
    status = srp_polygon_visible(&work->visible, &outline, work->occluders, count, &seen);
    if (status == SRP_OK) {
        *lit = seen.area;
        if (seen.area > 0.0) {
            *centroid = lift(work, scene, f, seen.x / seen.area - outline.p[0].x,
                             seen.y / seen.area - outline.p[0].y);
        }
    }
    return status;
}

/* Sorts the faces by their nearest corner into as many buckets as there are faces. */
static void sort_by_height(exact_scratch *work) {
    size_t n = work->face_count;
    double high = -INFINITY, low = INFINITY;
    for (size_t i = 0; i < n; ++i) {
        high = work->faces[i].top > high ? work->faces[i].top : high;
        low = work->faces[i].top < low ? work->faces[i].top : low;
    }
    double scale = high > low ? (double)(n - 1) / (high - low) : 0.0;
    memset(work->bucket, 0, (n + 1) * sizeof *work->bucket);
    for (size_t i = 0; i < n; ++i) {
        ++work->bucket[(size_t)((high - work->faces[i].top) * scale) + 1];
    }
    for (size_t i = 0; i < n; ++i) {
        work->bucket[i + 1] += work->bucket[i];
    }
    for (size_t i = 0; i < n; ++i) {
        size_t to = (size_t)((high - work->faces[i].top) * scale);
        work->order[work->bucket[to]++] = (uint32_t)i;
    }
}

/* From near to far: a face of which nothing is left need not be taken from those behind it. */
static srp_status add_light(exact_scratch *work, const srp_scene *scene, srp_vec3 reference) {
    sort_by_height(work);
    for (size_t i = 0; i < work->face_count; ++i) {
        face *f = &work->faces[work->order[i]];
        if (f->hidden) {
            continue;
        }
        double lit = 0.0;
        srp_vec3 centroid = {0.0, 0.0, 0.0};
        srp_status status = measure_face(work, scene, f, &lit, &centroid);
        if (status != SRP_OK) {
            return status;
        }
        f->hidden = !(lit > 0.0);
        if (!f->hidden) {
            const srp_facet *facet = &scene->facets[f->facet];
            bool absorbs = f->back && scene->optics[facet->material].one_sided;
            size_t row = absorbs ? scene->material_count : facet->material;
            srp_basis_add(&work->base.basis[row], lit, f->cosine, turned_normal(f, facet),
                          srp_vec3_sub(centroid, reference));
        }
    }
    return SRP_OK;
}

static srp_status respond_direction(const srp_prepared *prepared, srp_scratch *base, srp_vec3 s,
                                    srp_response *out) {
    (void)out;
    exact_scratch *work = (exact_scratch *)base;
    const srp_scene *scene = prepared->scene;
    work->view = srp_view_of(s);
    work->occlusion_count = 0;
    project(work, scene);
    collect_faces(work, scene);
    srp_status status = srp_box_pairs(&work->boxes, work->face_count, compare_faces, work);
    return status != SRP_OK ? status : add_light(work, scene, prepared->params.reference);
}

/* ---- the method ---- */

const srp_direction_kernel srp_exact_kernel = {scratch_create, scratch_destroy, respond_direction};

static srp_status prepare(const srp_scene *scene, const srp_method_params *params,
                          srp_prepared **out, srp_error *error) {
    exact *state = calloc(1, sizeof *state);
    if (state == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for the exact method");
    }
    state->head.method = &srp_method_exact;
    state->head.scene = scene;
    state->head.params = *params;
    state->size = srp_vec3_norm(scene->centre) + scene->radius;
    *out = &state->head;
    return SRP_OK;
}

static srp_status respond(const srp_prepared *prepared, size_t count, const srp_vec3 *s_body,
                          srp_response *responses, srp_basis *basis, srp_error *error) {
    exact *state = (exact *)prepared;
    return srp_respond_each(prepared, &srp_exact_kernel, &state->pool, count, s_body, responses,
                            basis, error);
}

static void release(srp_prepared *prepared) {
    srp_scratch_pool_clear(&((exact *)prepared)->pool, &srp_exact_kernel);
    free(prepared);
}

const srp_method srp_method_exact = {
    .name = "exact",
    .device = "cpu",
    .summary = "first hit of the light, visible polygons by clipping; no sampling error",
    .shapes = SRP_SHAPE_MESH,
    .capabilities = SRP_METHOD_EXACT | SRP_METHOD_BASIS | SRP_METHOD_MOMENT,
    .prepare = prepare,
    .respond = respond,
    .release = release,
};
