/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Embree in the mode that was fastest for parallel rays: rtcIntersect16 with
 * RTC_INTERSECT_CONTEXT_FLAG_COHERENT (16 rays that go the same way through the same boxes), scene
 * of the highest build quality. Counts per triangle and the force are done as sparingly as we can.
 */
#include "embree_cast.h"

#include "bench.h"
#include "view.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if SRP_EMBREE_VERSION == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

struct embree_cast {
    RTCDevice device;
    RTCScene scene;
    size_t triangle_count;
    srp_vec3 *normal;
    double reach; /* beyond the mesh [m] */
};

const char *embree_cast_version(void) {
    return RTC_VERSION_STRING;
}

static void fill_geometry(embree_cast *cast, RTCGeometry geometry, const srp_mesh *mesh) {
    size_t vertex_count = srp_mesh_vertex_count(mesh);
    const srp_vec3 *vertices = srp_mesh_vertices(mesh);
    const srp_triangle *triangles = srp_mesh_triangles(mesh);
    float *vertex = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                            3 * sizeof(float), vertex_count);
    uint32_t *index = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              3 * sizeof(uint32_t), cast->triangle_count);
    for (size_t i = 0; i < vertex_count; ++i) {
        vertex[3 * i] = (float)vertices[i].x;
        vertex[3 * i + 1] = (float)vertices[i].y;
        vertex[3 * i + 2] = (float)vertices[i].z;
        cast->reach = fmax(cast->reach, srp_vec3_norm(vertices[i]));
    }
    for (size_t k = 0; k < cast->triangle_count; ++k) {
        const uint32_t *v = triangles[k].v;
        memcpy(index + 3 * k, v, 3 * sizeof *v);
        srp_vec3 n = srp_vec3_cross(srp_vec3_sub(vertices[v[1]], vertices[v[0]]),
                                    srp_vec3_sub(vertices[v[2]], vertices[v[0]]));
        cast->normal[k] = srp_vec3_scale(1.0 / srp_vec3_norm(n), n);
    }
}

embree_cast *embree_cast_create(const srp_mesh *mesh, bool robust) {
    embree_cast *cast = bench_allocate(1, sizeof *cast);
    cast->triangle_count = srp_mesh_triangle_count(mesh);
    cast->normal = bench_allocate(cast->triangle_count, sizeof *cast->normal);
    cast->device = rtcNewDevice(NULL);
    if (cast->device == NULL) {
        (void)fprintf(stderr, "bench: Embree cannot start\n");
        exit(3);
    }
    cast->scene = rtcNewScene(cast->device);
    rtcSetSceneBuildQuality(cast->scene, RTC_BUILD_QUALITY_HIGH);
    rtcSetSceneFlags(cast->scene, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    RTCGeometry geometry = rtcNewGeometry(cast->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    fill_geometry(cast, geometry, mesh);
    rtcCommitGeometry(geometry);
    (void)rtcAttachGeometry(cast->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(cast->scene);
    return cast;
}

void embree_cast_destroy(embree_cast *cast) {
    if (cast != NULL) {
        rtcReleaseScene(cast->scene);
        rtcReleaseDevice(cast->device);
        free(cast->normal);
        free(cast);
    }
}

static void intersect(RTCScene scene, const int *valid, struct RTCRayHit16 *packet) {
#if SRP_EMBREE_VERSION == 4
    struct RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect16(valid, scene, packet, &arguments);
#else
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid, scene, &context, packet);
#endif
}

typedef struct ray_window {
    srp_view view;
    srp_vec3 corner; /* first sample */
    double pitch;
    float far;
} ray_window;

static void aim(struct RTCRayHit16 *packet, const ray_window *window,
                const double *restrict columns, const double *restrict rows) {
    const srp_vec3 o = window->corner, u = window->view.u, v = window->view.v, s = window->view.s;
    struct RTCRay16 *ray = &packet->ray;
    for (int k = 0; k < 16; ++k) {
        double a = columns[k] * window->pitch, b = rows[k] * window->pitch;
        ray->org_x[k] = (float)(o.x + a * u.x + b * v.x);
        ray->org_y[k] = (float)(o.y + a * u.y + b * v.y);
        ray->org_z[k] = (float)(o.z + a * u.z + b * v.z);
        ray->dir_x[k] = (float)-s.x;
        ray->dir_y[k] = (float)-s.y;
        ray->dir_z[k] = (float)-s.z;
        ray->tnear[k] = 0.0F;
        ray->tfar[k] = window->far;
        ray->time[k] = 0.0F;
        ray->mask[k] = UINT32_MAX;
        ray->flags[k] = 0;
        packet->hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
        packet->hit.primID[k] = RTC_INVALID_GEOMETRY_ID;
        packet->hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    }
}

/* Hits per triangle of one direction. */
static void count_hits(const embree_cast *cast, const ray_window *window, uint32_t side, bool tiles,
                       uint32_t *hits) {
    _Alignas(64) struct RTCRayHit16 packet;
    _Alignas(64) static const int VALID[16] = {-1, -1, -1, -1, -1, -1, -1, -1,
                                               -1, -1, -1, -1, -1, -1, -1, -1};
    uint32_t width = tiles ? 4 : 16, height = tiles ? 4 : 1;
    double columns[16], rows[16];
    for (uint32_t j = 0; j < side; j += height) {
        for (uint32_t i = 0; i < side; i += width) {
            for (uint32_t k = 0; k < 16; ++k) {
                columns[k] = i + k % width;
                rows[k] = j + k / width;
            }
            aim(&packet, window, columns, rows);
            intersect(cast->scene, VALID, &packet);
            for (int k = 0; k < 16; ++k) {
                if (packet.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID) {
                    ++hits[packet.hit.primID[k]];
                }
            }
        }
    }
}

static srp_vec3 sum_force(const embree_cast *cast, srp_vec3 s, double cell, uint32_t *hits) {
    /* The optics of the benchmark, rho_s = 0.5 and rho_d = 0, as in AAS 20-481's Table 1. */
    const double rho_s = 0.5;
    srp_vec3 f = {0.0, 0.0, 0.0};
    for (size_t k = 0; k < cast->triangle_count; ++k) {
        if (hits[k] != 0) {
            double lit = cell * hits[k];
            double cosine = srp_vec3_dot(cast->normal[k], s);
            f = srp_vec3_add_scaled(f, -lit * (1.0 - rho_s), s);
            f = srp_vec3_add_scaled(f, -2.0 * lit * rho_s * cosine, cast->normal[k]);
        }
    }
    memset(hits, 0, cast->triangle_count * sizeof *hits);
    return f;
}

void embree_cast_run(const embree_cast *cast, size_t count, const srp_vec3 *s, double half,
                     uint32_t side, int threads, bool tiles, srp_vec3 *f) {
    double pitch = 2.0 * half / side;
#pragma omp parallel num_threads(threads)
    {
        uint32_t *hits = bench_allocate(cast->triangle_count, sizeof *hits);
#pragma omp for schedule(dynamic, 1)
        for (size_t n = 0; n < count; ++n) {
            ray_window window = {.view = srp_view_of(s[n]), .pitch = pitch};
            double first = 0.5 * pitch - half;
            window.corner =
                srp_view_lift(&window.view, srp_vec3_make(first, first, 1.5 * cast->reach));
            window.far = (float)(3.0 * cast->reach);
            count_hits(cast, &window, side, tiles, hits);
            f[n] = sum_force(cast, s[n], pitch * pitch, hits);
        }
        free(hits);
    }
}
