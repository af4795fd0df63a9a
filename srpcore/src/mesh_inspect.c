/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"
#include "mesh_internal.h"
#include "topology.h"

#include <math.h>
#include <string.h>

static srp_vec3 area_vector(const srp_vec3 *vertices, srp_triangle triangle) {
    srp_vec3 ab = srp_vec3_sub(vertices[triangle.v[1]], vertices[triangle.v[0]]);
    srp_vec3 ac = srp_vec3_sub(vertices[triangle.v[2]], vertices[triangle.v[0]]);
    return srp_vec3_scale(0.5, srp_vec3_cross(ab, ac));
}

/* Does the triangle count as a side of the surface? Not without an area, nor when it repeats
 * another one: light only ever finds the first. */
static bool is_side(const srp_topology *topology, size_t i) {
    return !topology->degenerate[i] && !topology->repeats[i];
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
        if (is_side(topology, i)) {
            report->area += srp_vec3_norm(area_vector(vertices, triangles[i]));
        }
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
                              .inconsistent_edges = topology.inconsistent_edges,
                              .duplicate = topology.duplicate,
                              .opposite = topology.opposite};
    measure(mesh, &topology, &report);
    srp_topology_clear(&topology);
    *out = report;
    return SRP_OK;
}

srp_status srp_mesh_material_areas(const srp_mesh *mesh, double *area, srp_error *error) {
    srp_topology topology;
    srp_status status = srp_topology_create(mesh, &topology, error);
    if (status != SRP_OK) {
        return status;
    }
    memset(area, 0, mesh->material_count * sizeof *area);
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        if (is_side(&topology, i)) {
            area[mesh->triangle_material[i]] +=
                srp_vec3_norm(area_vector(mesh->vertices, mesh->triangles[i]));
        }
    }
    srp_topology_clear(&topology);
    return SRP_OK;
}
