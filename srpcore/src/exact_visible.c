/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What a beam of parallel light hits first: the visible polygons of every face, by clipping, in
 * double precision. No rays, no pixels.
 *
 * For one beam:
 *   1. project the vertices onto the plane that faces the light (view.h);
 *   2. keep the faces that light could hit first: of closed bodies those turned to it, of open
 *      surfaces all, turned over where the light sees their back; of mirrored light only those in
 *      front of the mirror;
 *   3. list every pair whose boxes in the image overlap, once (exact_pairs.h), and find out for
 *      each whether the two overlap and which one hides the other (compare_pair());
 *   4. take away from each face what its list of occluders hides (exact_polygon.h), and tell area
 *      and centroid of what is left.
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
 *
 * Mirrored light comes through a window, the lit part of the mirror, as if from a Sun behind it. A
 * face that the mirror's plane cuts is lit, and hides others, in front of the plane only.
 */
#include "exact_visible.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

/* Rounding noise, in units of DBL_EPSILON times the size of the mesh: of a coordinate in the image
 * after a few operations, and of a height above a well-shaped face. */
#define SLACK_ULPS 16.0
#define PLANE_ULPS 32.0

#define NO_OCCLUSION UINT32_MAX

/* A facet that light could hit first, from the side the light is on. */
typedef struct srp_exact_face {
    uint32_t v[3];       /* counter-clockwise in the image */
    uint32_t facet;      /* into scene->facets */
    uint32_t occlusions; /* first of its list, or NO_OCCLUSION */
    bool back;           /* the light is on the inner side */
    bool hidden;         /* wholly behind others */
    bool cut;            /* the window's plane cuts it */
    double cosine;       /* |n.s| > 0 */
    double top;          /* height of its nearest corner [m] */
} face;

/* Entry of the list of those that hide a face. */
typedef struct srp_exact_occlusion {
    uint32_t next;
    uint32_t occluder;  /* into faces */
    bool only_if_above; /* only where its plane is higher */
} occlusion;

struct srp_visible {
    const srp_scene *scene;
    const srp_beam *beam;
    double size;               /* of the largest coordinate [m]: what rounding is relative to */
    double slack, plane_noise; /* [m] */
    srp_vec3 *image;           /* projected vertices */
    face *faces;
    size_t face_count;
    uint32_t *order, *bucket; /* faces from near to far, and what sorts them */
    srp_box_stack boxes;
    occlusion *occlusions;
    size_t occlusion_count, occlusion_capacity;
    srp_occluder *occluders;
    size_t occluder_capacity;
    srp_visible_scratch clipping;
    face mirror;    /* that the beam comes from; its normal turned to where the light seems to be */
    srp_box2 frame; /* about the window */
};

void srp_visible_destroy(srp_visible *work) {
    if (work == NULL) {
        return;
    }
    srp_visible_scratch_free(&work->clipping);
    free(work->boxes.item);
    free(work->occluders);
    free(work->occlusions);
    free(work->bucket);
    free(work->order);
    free(work->faces);
    free(work->image);
    free(work);
}

srp_visible *srp_visible_create(const srp_scene *scene) {
    srp_visible *work = calloc(1, sizeof *work);
    if (work == NULL) {
        return NULL;
    }
    work->scene = scene;
    work->image = malloc(scene->vertex_count * sizeof *work->image);
    work->faces = malloc(scene->facet_count * sizeof *work->faces);
    work->order = malloc(scene->facet_count * sizeof *work->order);
    work->bucket = malloc((scene->facet_count + 1) * sizeof *work->bucket);
    if (work->image == NULL || work->faces == NULL || work->order == NULL || work->bucket == NULL ||
        srp_box_stack_reserve(&work->boxes, scene->facet_count) != SRP_OK) {
        srp_visible_destroy(work);
        return NULL;
    }
    return work;
}

srp_beam srp_beam_of_sun(const srp_scene *scene, srp_vec3 s) {
    return (srp_beam){srp_view_of(s), false, scene->centre, NULL};
}

srp_beam srp_beam_mirrored(const srp_beam *beam, const srp_scene *scene, uint32_t mirror) {
    const srp_facet *facet = &scene->facets[mirror];
    srp_vec3 on = scene->vertices[facet->v[0]], n = facet->normal;
    srp_beam out;
    out.view.u = srp_vec3_mirrored(beam->view.u, n);
    out.view.v = srp_vec3_mirrored(beam->view.v, n);
    out.view.s = srp_vec3_mirrored(beam->view.s, n);
    out.mirrored = !beam->mirrored;
    out.centre = srp_vec3_add(on, srp_vec3_mirrored(srp_vec3_sub(beam->centre, on), n));
    out.window = NULL;
    return out;
}

/* fmax() is a call where the compiler must honour NaN. */
static double largest(double a, double b, double c) {
    double ab = a > b ? a : b;
    return ab > c ? ab : c;
}

/* ---- the faces and their boxes ---- */

static void project(srp_visible *work, uint32_t vertex) {
    srp_vec3 p = srp_vec3_sub(work->scene->vertices[vertex], work->beam->centre);
    work->image[vertex] = srp_view_project(&work->beam->view, p);
}

/* Twice the signed area in the image; *thin when the triangle is no wider than rounding noise. */
static double twice_image_area(const srp_visible *work, const uint32_t *v, bool *thin) {
    const srp_vec3 *a = &work->image[v[0]], *b = &work->image[v[1]], *c = &work->image[v[2]];
    double abx = b->x - a->x, aby = b->y - a->y, acx = c->x - a->x, acy = c->y - a->y;
    double twice = abx * acy - aby * acx;
    double longest =
        largest(fabs(abx) + fabs(aby), fabs(acx) + fabs(acy), fabs(abx - acx) + fabs(aby - acy));
    *thin = fabs(twice) <= 2.0 * work->slack * longest;
    return twice;
}

/* Its box in float, `pad` wider than the rounding to float can make it too small. */
static srp_box2 box_of(const srp_visible *work, const uint32_t *v, double pad, uint32_t id) {
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

/* The facet as the light sees it; false when it sees none of it. */
static bool set_face(const srp_visible *work, uint32_t index, face *f) {
    const srp_facet *facet = &work->scene->facets[index];
    double cosine = srp_vec3_dot(facet->normal, work->beam->view.s);
    bool back = cosine < 0.0, thin;
    if (back && facet->closed) {
        return false;
    }
    double twice = twice_image_area(work, facet->v, &thin);
    bool clockwise = back != work->beam->mirrored;
    if (thin || (twice < 0.0) != clockwise) {
        return false; /* edge-on: no light on it, no shadow from it */
    }
    f->v[0] = facet->v[0];
    f->v[1] = facet->v[clockwise ? 2 : 1];
    f->v[2] = facet->v[clockwise ? 1 : 2];
    f->facet = index;
    f->occlusions = NO_OCCLUSION;
    f->back = back;
    f->hidden = false;
    f->cut = false;
    f->cosine = fabs(cosine);
    f->top = largest(work->image[f->v[0]].z, work->image[f->v[1]].z, work->image[f->v[2]].z);
    return true;
}

static void collect_sunlit(srp_visible *work, double pad) {
    const srp_scene *scene = work->scene;
    for (size_t i = 0; i < scene->vertex_count; ++i) {
        project(work, (uint32_t)i);
    }
    for (size_t i = 0; i < scene->facet_count; ++i) {
        face *f = &work->faces[work->face_count];
        if (set_face(work, (uint32_t)i, f)) {
            uint32_t place = (uint32_t)work->face_count++;
            work->boxes.item[place] = box_of(work, f->v, pad, place);
        }
    }
}

static srp_vec3 turned_normal(const face *f, const srp_facet *facet) {
    return f->back ? srp_vec3_scale(-1.0, facet->normal) : facet->normal;
}

/* Heights of the corners of a face above the plane of another, beyond the noise of that plane. */
typedef struct heights {
    bool above, below;
} heights;

static heights heights_over(const srp_visible *work, const face *over, const face *corners) {
    const srp_scene *scene = work->scene;
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

/* The box about all parts of the window. */
static srp_box2 box_of_window(const srp_window *window) {
    srp_box2 box = srp_polygon_box(&window->part[0]);
    for (size_t k = 1; k < window->part_count; ++k) {
        srp_box2 more = srp_polygon_box(&window->part[k]);
        box.x0 = more.x0 < box.x0 ? more.x0 : box.x0;
        box.y0 = more.y0 < box.y0 ? more.y0 : box.y0;
        box.x1 = more.x1 > box.x1 ? more.x1 : box.x1;
        box.y1 = more.y1 > box.y1 ? more.y1 : box.y1;
    }
    return box;
}

/* Makes `box` what it has in common with the frame; false when that is nothing. */
static bool crop(srp_box2 *box, const srp_box2 *frame) {
    box->x0 = frame->x0 > box->x0 ? frame->x0 : box->x0;
    box->y0 = frame->y0 > box->y0 ? frame->y0 : box->y0;
    box->x1 = frame->x1 < box->x1 ? frame->x1 : box->x1;
    box->y1 = frame->y1 < box->y1 ? frame->y1 : box->y1;
    return box->x0 <= box->x1 && box->y0 <= box->y1;
}

/* What can be met behind the window: in its frame, and not wholly behind the mirror. */
static void collect_beyond(srp_visible *work, double pad) {
    const srp_window *window = work->beam->window;
    const srp_facet *mirror = &work->scene->facets[window->facet];
    work->mirror.facet = window->facet;
    work->mirror.cosine = srp_vec3_dot(mirror->normal, work->beam->view.s);
    work->mirror.back = work->mirror.cosine < 0.0;
    work->mirror.cosine = fabs(work->mirror.cosine);
    memcpy(work->mirror.v, mirror->v, sizeof mirror->v);
    work->frame = box_of_window(window);
    for (size_t i = 0; i < window->reach_count; ++i) {
        const srp_facet *facet = &work->scene->facets[window->reach[i]];
        for (int k = 0; k < 3; ++k) {
            project(work, facet->v[k]);
        }
        uint32_t place = (uint32_t)work->face_count;
        srp_box2 box = box_of(work, facet->v, pad, place);
        face *f = &work->faces[place];
        if (window->reach[i] == window->facet || !crop(&box, &work->frame) ||
            !set_face(work, window->reach[i], f)) {
            continue;
        }
        heights h = heights_over(work, &work->mirror, f);
        if (h.below) {
            f->cut = h.above;
            work->boxes.item[place] = box;
            ++work->face_count;
        }
    }
}

static void collect_faces(srp_visible *work) {
    double pad = 2.0 * FLT_EPSILON * work->size;
    work->face_count = 0;
    if (work->beam->window == NULL) {
        collect_sunlit(work, pad);
    } else {
        collect_beyond(work, pad);
    }
}

/* ---- who hides whom ---- */

/* The line of an edge, its left side inside. Taken from the vertex of lower index, so that the two
 * faces at an edge have the same line to the bit. */
static srp_line2 edge_line(const srp_visible *work, uint32_t from, uint32_t to) {
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

static void edge_lines(const srp_visible *work, const face *f, srp_line2 *line) {
    line[0] = edge_line(work, f->v[0], f->v[1]);
    line[1] = edge_line(work, f->v[1], f->v[2]);
    line[2] = edge_line(work, f->v[2], f->v[0]);
}

/* Where a triangle lies against the edges of another. */
typedef enum placement { APART, OVERLAPPING, WITHIN } placement;

static placement place_against(const srp_visible *work, const srp_line2 *edge, const uint32_t *v) {
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

static srp_status add_occlusion(srp_visible *work, uint32_t target, uint32_t occluder,
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
 * done with: whatever it could hide, the occluder hides too, unless part of it is behind the
 * mirror. */
static srp_status hide(srp_visible *work, uint32_t target, uint32_t occluder, bool within) {
    if (within && !work->faces[occluder].cut) {
        work->faces[target].hidden = true;
        return SRP_OK;
    }
    return add_occlusion(work, target, occluder, false);
}

/* Judges one pair for both; see the head of the file. `edge_a`: the edges of the first. */
static srp_status compare_pair(srp_visible *work, uint32_t i, const srp_line2 *edge_a, uint32_t j) {
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
    heights b_over_a = heights_over(work, a, b);
    heights a_over_b = heights_over(work, b, a);
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
    srp_visible *work = user;
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
static srp_line2 height_line(const srp_visible *work, const face *upper, const face *lower) {
    srp_vec3 n[2];
    double h[2];
    const face *f[2] = {upper, lower};
    for (int k = 0; k < 2; ++k) {
        n[k] = turned_normal(f[k], &work->scene->facets[f[k]->facet]);
        srp_vec3 on = work->scene->vertices[f[k]->v[0]];
        h[k] = srp_vec3_dot(n[k], srp_vec3_sub(on, work->beam->centre));
    }
    double cu = upper->cosine, cl = lower->cosine;
    const srp_view *view = &work->beam->view;
    srp_line2 line;
    line.a = cu * srp_vec3_dot(n[1], view->u) - cl * srp_vec3_dot(n[0], view->u);
    line.b = cu * srp_vec3_dot(n[1], view->v) - cl * srp_vec3_dot(n[0], view->v);
    line.c = cl * h[0] - cu * h[1];
    line.slack = work->slack * (fabs(line.a) + fabs(line.b));
    return line;
}

static void set_occluder(const srp_visible *work, const face *target, const face *by,
                         bool only_if_above, srp_occluder *out) {
    edge_lines(work, by, out->line);
    out->line_count = 3;
    if (only_if_above) {
        out->line[out->line_count++] = height_line(work, by, target);
    }
    if (by->cut) {
        out->line[out->line_count++] = height_line(work, &work->mirror, by);
    }
}

static srp_status reserve_occluders(srp_visible *work, size_t count) {
    if (count > work->occluder_capacity) {
        size_t capacity = count + count / 2 + 32;
        srp_occluder *larger = realloc(work->occluders, capacity * sizeof *larger);
        if (larger == NULL) {
            return SRP_NO_MEMORY;
        }
        work->occluders = larger;
        work->occluder_capacity = capacity;
    }
    return srp_box_stack_reserve(&work->clipping.lists, count);
}

static srp_status gather_occluders(srp_visible *work, const face *target, size_t *count) {
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
        set_occluder(work, target, by, entry->only_if_above, &work->occluders[n]);
        work->clipping.lists.item[n] = work->boxes.item[entry->occluder];
        work->clipping.lists.item[n].id = (uint32_t)n;
        ++n;
    }
    *count = n;
    return SRP_OK;
}

/* The point of the facet that is seen at (x, y) from the image of its corner v[0]. */
static srp_vec3 lift(const srp_visible *work, const face *f, double x, double y) {
    const srp_view *view = &work->beam->view;
    srp_vec3 n = turned_normal(f, &work->scene->facets[f->facet]);
    double w = -(x * srp_vec3_dot(n, view->u) + y * srp_vec3_dot(n, view->v)) / f->cosine;
    srp_vec3 offset = srp_view_lift(view, srp_vec3_make(x, y, w));
    return srp_vec3_add(work->scene->vertices[f->v[0]], offset);
}

static srp_vec3 middle(const srp_scene *scene, const uint32_t *v) {
    srp_vec3 sum = srp_vec3_add(scene->vertices[v[0]], scene->vertices[v[1]]);
    return srp_vec3_scale(1.0 / 3.0, srp_vec3_add(sum, scene->vertices[v[2]]));
}

static srp_polygon outline_of(const srp_visible *work, const face *f) {
    srp_polygon outline;
    outline.count = 3;
    for (int k = 0; k < 3; ++k) {
        outline.p[k] = (srp_point2){work->image[f->v[k]].x, work->image[f->v[k]].y};
    }
    return outline;
}

/* What is left of a face in the window, adding to *seen. */
static srp_status look_through(srp_visible *work, const face *f, size_t occluders,
                               srp_moments *seen) {
    const srp_window *window = work->beam->window;
    srp_box2 box = work->boxes.item[f - work->faces];
    srp_occluder inside;
    set_occluder(work, f, f, false, &inside);
    for (size_t k = 0; k < window->part_count; ++k) {
        srp_box2 part_box = srp_polygon_box(&window->part[k]);
        srp_polygon part = window->part[k];
        if (!crop(&part_box, &box) || !srp_polygon_keep(&part, &inside)) {
            continue;
        }
        srp_status status =
            srp_polygon_visible(&work->clipping, &part, work->occluders, occluders, seen);
        if (status != SRP_OK) {
            return status;
        }
    }
    return SRP_OK;
}

/* Fills in what is lit of a face: area, centroid, polygons. */
static srp_status measure_face(srp_visible *work, const face *f, srp_lit *lit) {
    size_t count;
    srp_moments seen = {0.0, 0.0, 0.0};
    srp_polygon outline = outline_of(work, f);
    srp_status status = gather_occluders(work, f, &count);
    work->clipping.kept_count = 0;
    if (status != SRP_OK) {
        return status;
    }
    if (work->beam->window != NULL) {
        status = look_through(work, f, count, &seen);
    } else if (count > 0 || work->clipping.keep) {
        status = srp_polygon_visible(&work->clipping, &outline, work->occluders, count, &seen);
    }
    if (count == 0 && work->beam->window == NULL) {
        lit->area = work->scene->facets[f->facet].area * f->cosine;
        lit->centroid = middle(work->scene, f->v);
    } else if (seen.area > 0.0) {
        lit->area = seen.area;
        lit->centroid =
            lift(work, f, seen.x / seen.area - outline.p[0].x, seen.y / seen.area - outline.p[0].y);
    }
    lit->part = work->clipping.keep ? work->clipping.kept : NULL;
    lit->part_count = work->clipping.kept_count;
    return status;
}

/* Sorts the faces by their nearest corner into as many buckets as there are faces. */
static void sort_by_height(srp_visible *work) {
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
static srp_status tell_lit(srp_visible *work, srp_lit_visit visit, void *user) {
    sort_by_height(work);
    for (size_t i = 0; i < work->face_count; ++i) {
        face *f = &work->faces[work->order[i]];
        if (f->hidden) {
            continue;
        }
        srp_lit lit = {.facet = f->facet, .back = f->back, .cosine = f->cosine};
        srp_status status = measure_face(work, f, &lit);
        if (status != SRP_OK) {
            return status;
        }
        f->hidden = !(lit.area > 0.0);
        if (!f->hidden) {
            lit.normal = turned_normal(f, &work->scene->facets[f->facet]);
            status = visit(user, &lit);
            if (status != SRP_OK) {
                return status;
            }
        }
    }
    return SRP_OK;
}

srp_status srp_visible_find(srp_visible *work, const srp_beam *beam, bool parts,
                            srp_lit_visit visit, void *user) {
    const srp_scene *scene = work->scene;
    double size = srp_vec3_norm(scene->centre) + scene->radius;
    work->beam = beam;
    /* Unfolded, the world of a mirror lies further out. */
    work->size = size + srp_vec3_norm(srp_vec3_sub(beam->centre, scene->centre));
    work->slack = SLACK_ULPS * DBL_EPSILON * work->size;
    work->plane_noise = PLANE_ULPS * DBL_EPSILON * size;
    work->occlusion_count = 0;
    work->clipping.keep = parts;
    collect_faces(work);
    srp_status status = srp_box_pairs(&work->boxes, work->face_count, compare_faces, work);
    return status != SRP_OK ? status : tell_lit(work, visit, user);
}
