/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"
#include "mesh_internal.h"
#include "topology.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A triangle by its three places, in ascending order of the vertices that stand for them. */
typedef struct triangle_key {
    uint32_t v[3];
    bool even; /* reached from the triangle's own order by a rotation: the winding */
    uint32_t triangle;
} triangle_key;

static int compare_keys(const void *left, const void *right) {
    const triangle_key *a = left, *b = right;
    for (int k = 0; k < 3; k++) {
        if (a->v[k] != b->v[k]) {
            return a->v[k] < b->v[k] ? -1 : 1;
        }
    }
    return a->triangle < b->triangle ? -1 : a->triangle > b->triangle;
}

static bool same_places(const triangle_key *a, const triangle_key *b) {
    return a->v[0] == b->v[0] && a->v[1] == b->v[1] && a->v[2] == b->v[2];
}

static triangle_key key_of(srp_triangle triangle, uint32_t index) {
    uint32_t a = triangle.v[0], b = triangle.v[1], c = triangle.v[2];
    int first = a < b ? (a < c ? 0 : 2) : (b < c ? 1 : 2);
    triangle_key key = {.triangle = index};
    key.v[0] = triangle.v[first];
    uint32_t second = triangle.v[(first + 1) % 3], third = triangle.v[(first + 2) % 3];
    key.even = second < third;
    key.v[1] = key.even ? second : third;
    key.v[2] = key.even ? third : second;
    return key;
}

static srp_vec3 area_vector(const srp_vec3 *vertices, srp_triangle triangle) {
    srp_vec3 ab = srp_vec3_sub(vertices[triangle.v[1]], vertices[triangle.v[0]]);
    srp_vec3 ac = srp_vec3_sub(vertices[triangle.v[2]], vertices[triangle.v[0]]);
    return srp_vec3_scale(0.5, srp_vec3_cross(ab, ac));
}

/* Finds triangles at the same places, and adds up areas with each place counted once. */
static srp_status count_doubles(const srp_mesh *mesh, const srp_topology *topology,
                                srp_mesh_report *report, srp_error *error) {
    size_t count = 0;
    triangle_key *keys = malloc((topology->triangle_count + 1) * sizeof *keys);
    if (keys == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory to compare %zu triangles",
                        topology->triangle_count);
    }
    for (size_t i = 0; i < topology->triangle_count; i++) {
        if (!topology->degenerate[i]) {
            keys[count++] = key_of(topology->welded[i], (uint32_t)i);
        }
    }
    qsort(keys, count, sizeof *keys, compare_keys);
    for (size_t begin = 0, end; begin < count; begin = end) {
        size_t even = 0;
        for (end = begin; end < count && same_places(&keys[end], &keys[begin]); end++) {
            even += keys[end].even;
        }
        size_t odd = end - begin - even;
        report->duplicate += (even > 1 ? even - 1 : 0) + (odd > 1 ? odd - 1 : 0);
        report->opposite += even > 0 && odd > 0 ? even + odd : 0;
        report->area += srp_vec3_norm(
            area_vector(srp_mesh_vertices(mesh), srp_mesh_triangles(mesh)[keys[begin].triangle]));
    }
    free(keys);
    return SRP_OK;
}

static void measure(const srp_mesh *mesh, const srp_topology *topology, srp_mesh_report *report) {
    const srp_vec3 *vertices = srp_mesh_vertices(mesh);
    const srp_triangle *triangles = srp_mesh_triangles(mesh);
    report->box_min = srp_vec3_make(INFINITY, INFINITY, INFINITY);
    report->box_max = srp_vec3_scale(-1.0, report->box_min);
    for (size_t i = 0; i < topology->triangle_count; i++) {
        for (int k = 0; k < 3; k++) {
            srp_vec3 p = vertices[triangles[i].v[k]];
            srp_vec3 *low = &report->box_min, *high = &report->box_max;
            *low = srp_vec3_make(fmin(low->x, p.x), fmin(low->y, p.y), fmin(low->z, p.z));
            *high = srp_vec3_make(fmax(high->x, p.x), fmax(high->y, p.y), fmax(high->z, p.z));
        }
        report->area_vector_sum =
            srp_vec3_add(report->area_vector_sum, area_vector(vertices, triangles[i]));
        report->degenerate += topology->degenerate[i];
    }
    for (size_t c = 0; c < topology->component_count; c++) {
        report->closed_components += topology->components[c].closed;
        report->inward_components += topology->components[c].inward;
        report->volume += fabs(topology->components[c].volume);
    }
}

srp_status srp_mesh_inspect(const srp_mesh *mesh, srp_mesh_report *out, srp_error *error) {
    srp_topology topology;
    srp_status status = srp_topology_create(mesh, &topology, error);
    if (status != SRP_OK) {
        return status;
    }
    srp_mesh_report report = {.vertices = mesh->vertex_count,
                              .triangles = mesh->triangle_count,
                              .faces_triangle = mesh->faces_triangle,
                              .faces_quad = mesh->faces_quad,
                              .faces_larger = mesh->faces_larger,
                              .components = topology.component_count,
                              .boundary_edges = topology.boundary_edges,
                              .nonmanifold_edges = topology.nonmanifold_edges,
                              .inconsistent_edges = topology.inconsistent_edges};
    measure(mesh, &topology, &report);
    status = count_doubles(mesh, &topology, &report, error);
    srp_topology_clear(&topology);
    if (status == SRP_OK) {
        *out = report;
    }
    return status;
}

void srp_mesh_material_areas(const srp_mesh *mesh, double *area) {
    memset(area, 0, mesh->material_count * sizeof *area);
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        area[mesh->triangle_material[i]] +=
            srp_vec3_norm(area_vector(mesh->vertices, mesh->triangles[i]));
    }
}
