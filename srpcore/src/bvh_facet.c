/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Whether a ray hits a facet, in double precision.
 *
 * The test of Woop, Benthin & Wald (2013): the vertices are moved so that the ray starts at the
 * origin and sheared so that it runs along z; what is left is whether the origin of the plane lies
 * in a triangle. Each of the three edge functions is the difference of two rounded products.
 * Rounding is monotonic: such a difference may be 0 where it should not be, but never has the wrong
 * sign; and swapping the ends of an edge swaps its sign exactly. Zero counts as inside, therefore
 * the sheared triangles of a closed mesh cover the plane without a gap. Departures from the paper:
 * double instead of float with a fallback; ties go to both sides; starts on a facet (bvh.h).
 *
 * This holds because neither the compiler nor the processor fuses a multiplication with a
 * subtraction here (-ffp-contract=off).
 */
#include "bvh_internal.h"

#include <math.h>

static double largest(srp_vec3 v) {
    return fmax(fabs(v.x), fmax(fabs(v.y), fabs(v.z)));
}

srp_bvh_scale srp_bvh_scale_of(const srp_scene *scene) {
    double longest = largest(srp_vec3_sub(scene->box_max, scene->box_min));
    double size = fmax(longest, fmax(largest(scene->box_min), largest(scene->box_max)));
    return (srp_bvh_scale){.clearance = ldexp(size, -42), .lift = ldexp(size, -48)};
}

srp_bvh_triangle srp_bvh_triangle_of(const srp_scene *scene, uint32_t facet) {
    srp_bvh_triangle triangle;
    for (int k = 0; k < 3; ++k) {
        srp_vec3 p = scene->vertices[scene->facets[facet].v[k]];
        triangle.v[k][0] = p.x;
        triangle.v[k][1] = p.y;
        triangle.v[k][2] = p.z;
    }
    return triangle;
}

srp_bvh_leaving srp_bvh_leaving_of(const srp_scene *scene, const srp_bvh_scale *scale,
                                   uint32_t facet) {
    const srp_facet *of = &scene->facets[facet];
    srp_bvh_leaving leaving = {.normal = of->normal, .unseen = {SRP_BVH_NOTHING, SRP_BVH_NOTHING}};
    double round = 0.0;
    for (int k = 0; k < 3; ++k) {
        /* The side across from the vertex is its weight. */
        srp_vec3 side =
            srp_vec3_sub(scene->vertices[of->v[(k + 2) % 3]], scene->vertices[of->v[(k + 1) % 3]]);
        double length = srp_vec3_norm(side);
        leaving.inner = srp_vec3_add_scaled(leaving.inner, length, scene->vertices[of->v[k]]);
        round += length;
    }
    leaving.inner = srp_vec3_scale(1.0 / round, leaving.inner);
    double radius = 2.0 * of->area / round;
    leaving.pull = fmin(scale->clearance / radius, 0.25);
    return leaving;
}

void srp_bvh_test(const srp_bvh_path *path, const srp_bvh_triangle *triangle, uint32_t facet,
                  srp_bvh_best *best) {
    double x[3], y[3], z[3];
    for (int k = 0; k < 3; ++k) {
        const double *v = triangle->v[k];
        double along = v[path->kz] - path->origin[path->kz];
        x[k] = (v[path->kx] - path->origin[path->kx]) - path->shear_x * along;
        y[k] = (v[path->ky] - path->origin[path->ky]) - path->shear_y * along;
        z[k] = path->sign * along;
    }
    double u = x[1] * y[2] - y[1] * x[2];
    double v = x[2] * y[0] - y[2] * x[0];
    double w = x[0] * y[1] - y[0] * x[1];
    /* No branch for each: whether a facet is met from the front is anybody's guess. */
    int negative = (u < 0.0) + (v < 0.0) + (w < 0.0), positive = (u > 0.0) + (v > 0.0) + (w > 0.0);
    if (negative * positive != 0) {
        return;
    }
    double area = u + v + w; /* twice that of the sheared triangle */
    if (area == 0.0) {
        return;
    }
    double volume = u * z[0] + v * z[1] + w * z[2];
    double at = volume / area;
    if (!(at > 0.0)) {
        return;
    }
    if (at < best->z || (at == best->z && facet < best->facet)) {
        best->z = at;
        best->facet = facet;
        best->back = (area < 0.0) == (path->sign < 0.0);
    }
}

bool srp_bvh_finish(const srp_bvh *bvh, const srp_ray *ray, const srp_bvh_path *path,
                    const srp_bvh_best *best, srp_hit *out) {
    if (best->facet == SRP_NO_NEIGHBOUR) {
        return false;
    }
    out->t = best->z * fabs(path->per_z);
    out->facet = best->facet;
    out->back = best->back;
    if (path->from != SRP_NO_NEIGHBOUR) {
        /* Where the ray from the given start, not the moved one, meets the same plane: the next
         * start will be there. */
        srp_vec3 n = bvh->leaving[best->facet].normal;
        double rate = srp_vec3_dot(n, ray->direction);
        if (rate != 0.0) {
            out->t = fmax(out->t + srp_vec3_dot(n, srp_bvh_start_of(bvh, ray)) / rate, 0.0);
        }
    }
    return true;
}
