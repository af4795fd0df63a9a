/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The winding number at a point is the signed count of faces that a ray from it passes: +1 through
 * a face from inside, -1 from outside. Just outside a face of a surface that bounds a body it is 0
 * or more; it is -1 in a lobe that is inside out. Looked at from the centroids of up to SAMPLES
 * faces of a component, along two skew rays each, so that one ray that grazes an edge decides
 * nothing.
 */
#include "winding.h"

#include "error.h"

#include <stdlib.h>

enum { SAMPLES = 64 };

typedef struct face_list {
    const srp_scene *scene;
    const uint32_t *facets;
    size_t count;
} face_list;

/* Signed passage of the ray p + t d, t > 0, through a facet: +1, -1 or 0 (Moeller and Trumbore,
 * Journal of Graphics Tools 2(1), 1997). */
static int passage(const srp_scene *scene, const srp_facet *facet, srp_vec3 p, srp_vec3 d) {
    srp_vec3 a = scene->vertices[facet->v[0]];
    srp_vec3 ab = srp_vec3_sub(scene->vertices[facet->v[1]], a);
    srp_vec3 ac = srp_vec3_sub(scene->vertices[facet->v[2]], a);
    srp_vec3 h = srp_vec3_cross(d, ac);
    double det = srp_vec3_dot(ab, h);
    if (det == 0.0) {
        return 0;
    }
    srp_vec3 ap = srp_vec3_sub(p, a);
    double u = srp_vec3_dot(ap, h) / det;
    srp_vec3 q = srp_vec3_cross(ap, ab);
    double v = srp_vec3_dot(d, q) / det;
    double t = srp_vec3_dot(ac, q) / det;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || t <= 0.0) {
        return 0;
    }
    return srp_vec3_dot(d, facet->normal) > 0.0 ? 1 : -1;
}

static int winding_along(const face_list *faces, uint32_t own, srp_vec3 p, srp_vec3 d) {
    int winding = 0;
    for (size_t i = 0; i < faces->count; ++i) {
        if (faces->facets[i] != own) {
            winding += passage(faces->scene, &faces->scene->facets[faces->facets[i]], p, d);
        }
    }
    return winding;
}

static bool outside_is_negative(const face_list *faces, uint32_t own) {
    const srp_facet *facet = &faces->scene->facets[own];
    const srp_vec3 *vertices = faces->scene->vertices;
    srp_vec3 a = vertices[facet->v[0]], b = vertices[facet->v[1]], c = vertices[facet->v[2]];
    srp_vec3 centroid = srp_vec3_scale(1.0 / 3.0, srp_vec3_add(a, srp_vec3_add(b, c)));
    srp_vec3 along = srp_vec3_sub(b, a);
    along = srp_vec3_scale(1.0 / srp_vec3_norm(along), along);
    srp_vec3 across = srp_vec3_cross(facet->normal, along);
    srp_vec3 skew = srp_vec3_add_scaled(facet->normal, 0.3719, along);
    srp_vec3 first = srp_vec3_add_scaled(skew, 0.1153, across);
    srp_vec3 second = srp_vec3_add_scaled(skew, -0.6427, across);
    return winding_along(faces, own, centroid, first) < 0 &&
           winding_along(faces, own, centroid, second) < 0;
}

static bool has_negative_lobe(const face_list *faces) {
    size_t stride = faces->count / SAMPLES + 1;
    for (size_t i = 0; i < faces->count; i += stride) {
        if (outside_is_negative(faces, faces->facets[i])) {
            return true;
        }
    }
    return false;
}

/* Facets sorted by component: those of component c stand at begin[c] to begin[c + 1]. */
static void sort_by_component(const uint32_t *component, const uint32_t *facet_of,
                              size_t triangle_count, size_t component_count, size_t *begin,
                              uint32_t *facets) {
    for (size_t i = 0; i < triangle_count; ++i) {
        if (facet_of[i] != SRP_NO_NEIGHBOUR) {
            ++begin[component[i] + 2];
        }
    }
    for (size_t c = 2; c < component_count + 2; ++c) {
        begin[c] += begin[c - 1];
    }
    for (size_t i = 0; i < triangle_count; ++i) {
        if (facet_of[i] != SRP_NO_NEIGHBOUR) {
            facets[begin[component[i] + 1]++] = facet_of[i];
        }
    }
}

srp_status srp_winding_open_negative(srp_scene *scene, const uint32_t *component,
                                     const uint32_t *facet_of, size_t triangle_count,
                                     srp_error *error) {
    size_t component_count = 0;
    for (size_t i = 0; i < triangle_count; ++i) {
        if (facet_of[i] != SRP_NO_NEIGHBOUR && component[i] >= component_count) {
            component_count = component[i] + 1;
        }
    }
    size_t *begin = calloc(component_count + 3, sizeof *begin);
    uint32_t *facets = malloc((triangle_count + 1) * sizeof *facets);
    if (begin == NULL || facets == NULL) {
        free(begin);
        free(facets);
        return srp_fail(error, SRP_NO_MEMORY, "no memory for the scene");
    }
    sort_by_component(component, facet_of, triangle_count, component_count, begin, facets);
    for (size_t c = 0; c < component_count; ++c) {
        face_list faces = {scene, facets + begin[c], begin[c + 1] - begin[c]};
        if (faces.count == 0 || !scene->facets[faces.facets[0]].closed ||
            !has_negative_lobe(&faces)) {
            continue;
        }
        for (size_t i = 0; i < faces.count; ++i) {
            scene->facets[faces.facets[i]].closed = false;
        }
    }
    free(begin);
    free(facets);
    return SRP_OK;
}
