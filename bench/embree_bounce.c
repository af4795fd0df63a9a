/* SPDX-License-Identifier: Apache-2.0 */
#include "embree_bounce.h"

#include "bench.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if SRP_EMBREE_VERSION == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

struct embree_bounce {
    RTCDevice device;
    RTCScene scene;
    const srp_scene *shape;
    float offset, near; /* of origins, and where hits begin [m]: positions are float */
};

const char *embree_bounce_version(void) {
    return RTC_VERSION_STRING;
}

static void fill_geometry(RTCGeometry geometry, const srp_scene *scene) {
    float *vertex = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                            3 * sizeof(float), scene->vertex_count);
    uint32_t *index = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              3 * sizeof(uint32_t), scene->facet_count);
    for (size_t i = 0; i < scene->vertex_count; ++i) {
        vertex[3 * i] = (float)scene->vertices[i].x;
        vertex[3 * i + 1] = (float)scene->vertices[i].y;
        vertex[3 * i + 2] = (float)scene->vertices[i].z;
    }
    for (size_t k = 0; k < scene->facet_count; ++k) {
        memcpy(index + 3 * k, scene->facets[k].v, 3 * sizeof *index);
    }
}

embree_bounce *embree_bounce_create(const srp_scene *scene, bool robust) {
    embree_bounce *bounce = bench_allocate(1, sizeof *bounce);
    bounce->shape = scene;
    bounce->offset = 1e-6F * (float)scene->radius;
    bounce->near = 1e-5F * (float)scene->radius;
    bounce->device = rtcNewDevice(NULL);
    if (bounce->device == NULL) {
        (void)fprintf(stderr, "bench: Embree cannot start\n");
        exit(3);
    }
    bounce->scene = rtcNewScene(bounce->device);
    rtcSetSceneBuildQuality(bounce->scene, RTC_BUILD_QUALITY_HIGH);
    rtcSetSceneFlags(bounce->scene, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    RTCGeometry geometry = rtcNewGeometry(bounce->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    fill_geometry(geometry, scene);
    rtcCommitGeometry(geometry);
    (void)rtcAttachGeometry(bounce->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(bounce->scene);
    return bounce;
}

void embree_bounce_destroy(embree_bounce *bounce) {
    rtcReleaseScene(bounce->scene);
    rtcReleaseDevice(bounce->device);
    free(bounce);
}

embree_ray embree_bounce_ray(const embree_bounce *bounce, const srp_ray *ray) {
    srp_vec3 n = bounce->shape->facets[ray->from].normal;
    double lift = copysign(bounce->offset, srp_vec3_dot(n, ray->direction));
    srp_vec3 o = srp_vec3_add_scaled(ray->origin, lift, n), d = ray->direction;
    return (embree_ray){{(float)o.x, (float)o.y, (float)o.z}, {(float)d.x, (float)d.y, (float)d.z}};
}

void embree_bounce_single(const embree_bounce *bounce, size_t count, const embree_ray *rays,
                          uint32_t *hits) {
    for (size_t k = 0; k < count; ++k) {
        struct RTCRayHit query;
        const embree_ray *ray = &rays[k];
        query.ray = (struct RTCRay){.org_x = ray->org[0],
                                    .org_y = ray->org[1],
                                    .org_z = ray->org[2],
                                    .dir_x = ray->dir[0],
                                    .dir_y = ray->dir[1],
                                    .dir_z = ray->dir[2],
                                    .tnear = bounce->near,
                                    .tfar = INFINITY,
                                    .mask = UINT32_MAX};
        query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        query.hit.primID = RTC_INVALID_GEOMETRY_ID;
#if SRP_EMBREE_VERSION == 4
        rtcIntersect1(bounce->scene, &query, NULL);
#else
        struct RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(bounce->scene, &context, &query);
#endif
        hits[k] = query.hit.primID;
    }
}

void embree_bounce_wave(const embree_bounce *bounce, size_t count, const embree_ray *rays,
                        uint32_t *hits) {
    _Alignas(64) struct RTCRayHit16 packet;
    _Alignas(64) int valid[16];
    for (size_t first = 0; first < count; first += 16) {
        size_t lanes = count - first < 16 ? count - first : 16;
        for (size_t k = 0; k < 16; ++k) {
            const embree_ray *ray = &rays[first + (k < lanes ? k : 0)];
            valid[k] = k < lanes ? -1 : 0;
            packet.ray.org_x[k] = ray->org[0];
            packet.ray.org_y[k] = ray->org[1];
            packet.ray.org_z[k] = ray->org[2];
            packet.ray.dir_x[k] = ray->dir[0];
            packet.ray.dir_y[k] = ray->dir[1];
            packet.ray.dir_z[k] = ray->dir[2];
            packet.ray.tnear[k] = bounce->near;
            packet.ray.tfar[k] = INFINITY;
            packet.ray.time[k] = 0.0F;
            packet.ray.mask[k] = UINT32_MAX;
            packet.ray.flags[k] = 0;
            packet.hit.geomID[k] = packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
            packet.hit.primID[k] = RTC_INVALID_GEOMETRY_ID;
        }
#if SRP_EMBREE_VERSION == 4
        rtcIntersect16(valid, bounce->scene, &packet, NULL);
#else
        struct RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect16(valid, bounce->scene, &context, &packet);
#endif
        for (size_t k = 0; k < lanes; ++k) {
            hits[first + k] = packet.hit.primID[k];
        }
    }
}
