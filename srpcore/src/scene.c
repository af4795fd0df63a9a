/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"
#include "limits.h"
#include "mesh_internal.h"
#include "scene_internal.h"
#include "text.h"
#include "topology.h"
#include "winding.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

void srp_scene_destroy(srp_scene *scene) {
    if (scene == NULL) {
        return;
    }
    for (size_t i = 0; scene->material_names != NULL && i < scene->material_count; ++i) {
        free(scene->material_names[i]);
    }
    free(scene->material_names);
    free(scene->optics);
    free(scene->vertices);
    free(scene->facets);
    free(scene->plates);
    free(scene);
}

static srp_scene *scene_new(srp_shape shape, size_t material_count) {
    srp_scene *scene = calloc(1, sizeof *scene);
    if (scene == NULL) {
        return NULL;
    }
    scene->shape = shape;
    scene->material_count = material_count;
    scene->optics = calloc(material_count + 1, sizeof *scene->optics);
    scene->material_names = calloc(material_count + 1, sizeof *scene->material_names);
    if (scene->optics == NULL || scene->material_names == NULL) {
        srp_scene_destroy(scene);
        return NULL;
    }
    return scene;
}

/* ---- hashes ---- */

static void hash_text(XXH3_state_t *state, char out[33]) {
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state));
    for (size_t i = 0; i < sizeof canonical.digest; ++i) {
        snprintf(out + 2 * i, 3, "%02x", canonical.digest[i]);
    }
}

/* -0 and +0 are the same place. */
static void hash_double(XXH3_state_t *state, double value) {
    double plain = value + 0.0;
    XXH3_128bits_update(state, &plain, sizeof plain);
}

static void hash_vec3(XXH3_state_t *state, srp_vec3 v) {
    hash_double(state, v.x);
    hash_double(state, v.y);
    hash_double(state, v.z);
}

static void hash_shape(XXH3_state_t *state, const srp_scene *scene) {
    uint32_t shape = (uint32_t)scene->shape;
    XXH3_128bits_update(state, &shape, sizeof shape);
    for (size_t i = 0; i < scene->facet_count; ++i) {
        const srp_facet *facet = &scene->facets[i];
        for (int k = 0; k < 3; ++k) {
            hash_vec3(state, scene->vertices[facet->v[k]]);
        }
        XXH3_128bits_update(state, &facet->material, sizeof facet->material);
    }
    for (size_t i = 0; i < scene->plate_count; ++i) {
        hash_vec3(state, scene->plates[i].normal);
        hash_double(state, scene->plates[i].area);
    }
    hash_double(state, scene->area);
}

bool srp_optics_hash(size_t count, char *const *names, const srp_optics *optics, double cr,
                     char out[33]) {
    XXH3_state_t *state = XXH3_createState();
    if (state == NULL) {
        return false;
    }
    XXH3_128bits_reset(state);
    for (size_t i = 0; i < count; ++i) {
        uint8_t one_sided = optics[i].one_sided;
        XXH3_128bits_update(state, names[i], strlen(names[i]) + 1);
        hash_double(state, optics[i].rho_s);
        hash_double(state, optics[i].rho_d);
        XXH3_128bits_update(state, &one_sided, sizeof one_sided);
    }
    hash_double(state, cr);
    hash_text(state, out);
    XXH3_freeState(state);
    return true;
}

static bool hash_scene(srp_scene *scene) {
    XXH3_state_t *state = XXH3_createState();
    if (state == NULL) {
        return false;
    }
    XXH3_128bits_reset(state);
    hash_shape(state, scene);
    hash_text(state, scene->shape_hash);
    XXH3_freeState(state);
    return srp_optics_hash(scene->material_count, scene->material_names, scene->optics, scene->cr,
                           scene->optics_hash);
}

/* ---- meshes ---- */

/* Names of up to a handful of materials without optics, for the message. */
static size_t list_missing(const srp_mesh *mesh, const srp_materials *materials, char *text,
                           size_t size) {
    size_t missing = 0, used = 0;
    srp_optics optics;
    for (size_t i = 0; i < srp_mesh_material_count(mesh); ++i) {
        const char *name = srp_mesh_material_name(mesh, i);
        if (materials != NULL && srp_materials_find(materials, name, &optics)) {
            continue;
        }
        if (missing < 8 && used < size) {
            int length = snprintf(text + used, size - used, "%s%s", missing > 0 ? ", " : "",
                                  srp_string_excerpt(name).text);
            used += length > 0 ? (size_t)length : 0;
        }
        ++missing;
    }
    return missing;
}

static srp_status take_materials(srp_scene *scene, const srp_mesh *mesh,
                                 const srp_materials *materials, srp_error *error) {
    char names[600];
    size_t missing = list_missing(mesh, materials, names, sizeof names);
    if (missing > 0) {
        srp_status status =
            srp_fail(error, SRP_NOT_FOUND,
                     "no optics for %zu material%s: %s%s; give them in the MTL file (rho_s, rho_d)",
                     missing, missing == 1 ? "" : "s", names, missing > 8 ? ", ..." : "");
        return srp_advise(error, SRP_REMEDY_OPTICS, status);
    }
    for (size_t i = 0; i < scene->material_count; ++i) {
        const char *name = srp_mesh_material_name(mesh, i);
        if (!srp_materials_find(materials, name, &scene->optics[i])) {
            return srp_fail(error, SRP_NOT_FOUND, "no optics for material '%s'", name);
        }
        scene->material_names[i] = srp_string_copy(name);
        if (scene->material_names[i] == NULL) {
            return srp_fail(error, SRP_NO_MEMORY, "no memory for the scene");
        }
    }
    return SRP_OK;
}

/* Vertices that facets use, in the order of the mesh; place[] maps welded mesh vertices to them. */
static void take_vertices(srp_scene *scene, const srp_mesh *mesh, const srp_topology *topology,
                          uint32_t *place) {
    memset(place, 0, topology->vertex_count * sizeof *place);
    for (size_t i = 0; i < topology->triangle_count; ++i) {
        for (int k = 0; k < 3 && !topology->degenerate[i]; ++k) {
            place[topology->welded[i].v[k]] = 1;
        }
    }
    const srp_vec3 *vertices = srp_mesh_vertices(mesh);
    for (size_t i = 0; i < topology->vertex_count; ++i) {
        if (place[i]) {
            place[i] = (uint32_t)scene->vertex_count;
            scene->vertices[scene->vertex_count++] = vertices[i];
        }
    }
}

static void measure_facet(const srp_scene *scene, srp_facet *facet) {
    srp_vec3 a = scene->vertices[facet->v[0]];
    srp_vec3 b = scene->vertices[facet->v[1]];
    srp_vec3 c = scene->vertices[facet->v[2]];
    srp_vec3 cross = srp_vec3_cross(srp_vec3_sub(b, a), srp_vec3_sub(c, a));
    double length = srp_vec3_norm(cross);
    facet->normal = srp_vec3_scale(1.0 / length, cross);
    facet->area = 0.5 * length;
}

/* Facets are the triangles with an area, each once: of faces at the same places the lower index
 * hides the others. Those of components that are inside out are turned. */
static void take_facets(srp_scene *scene, const srp_mesh *mesh, const srp_topology *topology,
                        const uint32_t *place, uint32_t *facet_of) {
    const uint32_t *material = srp_mesh_triangle_materials(mesh);
    for (size_t i = 0; i < topology->triangle_count; ++i) {
        bool seen = !topology->degenerate[i] && !topology->repeats[i];
        facet_of[i] = seen ? (uint32_t)scene->facet_count++ : SRP_NO_NEIGHBOUR;
    }
    for (size_t i = 0; i < topology->triangle_count; ++i) {
        if (facet_of[i] == SRP_NO_NEIGHBOUR) {
            continue;
        }
        const srp_component *component = &topology->components[topology->component[i]];
        srp_facet *facet = &scene->facets[facet_of[i]];
        for (int k = 0; k < 3; ++k) {
            /* Turned: vertices 0, 2, 1, and so edges 2, 1, 0. */
            int vertex = component->inward ? (3 - k) % 3 : k;
            int edge = component->inward ? 2 - k : k;
            uint32_t across = topology->neighbour[i][edge];
            facet->v[k] = place[topology->welded[i].v[vertex]];
            facet->neighbour[k] = across == SRP_NO_TRIANGLE ? SRP_NO_NEIGHBOUR : facet_of[across];
        }
        facet->material = material[i];
        facet->closed = component->closed;
        measure_facet(scene, facet);
    }
}

static void measure_bounds(srp_scene *scene) {
    srp_vec3 low = scene->vertices[0], high = low;
    for (size_t i = 1; i < scene->vertex_count; ++i) {
        srp_vec3 p = scene->vertices[i];
        low = srp_vec3_make(fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z));
        high = srp_vec3_make(fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z));
    }
    scene->box_min = low;
    scene->box_max = high;
    scene->centre = srp_vec3_scale(0.5, srp_vec3_add(low, high));
    for (size_t i = 0; i < scene->vertex_count; ++i) {
        scene->radius =
            fmax(scene->radius, srp_vec3_norm(srp_vec3_sub(scene->vertices[i], scene->centre)));
    }
    scene->all_closed = true;
    for (size_t i = 0; i < scene->facet_count; ++i) {
        scene->all_closed = scene->all_closed && scene->facets[i].closed;
    }
}

/* Coordinates are known to some units of their last place. Faces that are hardly larger than that
 * are noise; a few needles may be, but not a noticeable part of the surface. */
#define RESOLUTION (0x1p14 * DBL_EPSILON)
#define UNRESOLVED_SHARE_MAX 1e-6

static srp_status check_resolution(const srp_scene *scene, srp_error *error) {
    double size = srp_vec3_norm(scene->centre) + scene->radius;
    double total = 0.0, unresolved = 0.0;
    for (size_t i = 0; i < scene->facet_count; ++i) {
        const srp_facet *facet = &scene->facets[i];
        double longest = 0.0;
        for (int k = 0; k < 3; ++k) {
            srp_vec3 a = scene->vertices[facet->v[k]], b = scene->vertices[facet->v[(k + 1) % 3]];
            longest = fmax(longest, srp_vec3_norm(srp_vec3_sub(b, a)));
        }
        total += facet->area;
        unresolved += 2.0 * facet->area < RESOLUTION * size * longest ? facet->area : 0.0;
    }
    if (unresolved > UNRESOLVED_SHARE_MAX * total) {
        return srp_fail(
            error, SRP_BAD_DATA,
            "the mesh reaches %g m from the origin, too far for the size of its faces to "
            "be told from rounding; expected a model near the origin of the body",
            size);
    }
    return SRP_OK;
}

static srp_status take_mesh(srp_scene *scene, const srp_mesh *mesh, srp_error *error) {
    srp_topology topology;
    srp_status status = srp_topology_create(mesh, &topology, error);
    if (status != SRP_OK) {
        return status;
    }
    uint32_t *place = malloc((topology.vertex_count + 1) * sizeof *place);
    uint32_t *facet_of = malloc((topology.triangle_count + 1) * sizeof *facet_of);
    scene->vertices = malloc((topology.vertex_count + 1) * sizeof *scene->vertices);
    scene->facets = malloc((topology.triangle_count + 1) * sizeof *scene->facets);
    if (place == NULL || facet_of == NULL || scene->vertices == NULL || scene->facets == NULL) {
        status = srp_fail(error, SRP_NO_MEMORY, "no memory for the scene");
        goto done;
    }
    take_vertices(scene, mesh, &topology, place);
    take_facets(scene, mesh, &topology, place, facet_of);
    if (scene->facet_count == 0) {
        status = srp_fail(error, SRP_BAD_DATA, "none of the mesh's triangles has an area");
        goto done;
    }
    status = srp_winding_open_negative(scene, topology.component, facet_of, topology.triangle_count,
                                       error);
    measure_bounds(scene);
    if (status == SRP_OK) {
        status = check_resolution(scene, error);
    }
done:
    free(place);
    free(facet_of);
    srp_topology_clear(&topology);
    return status;
}

/* The last step of every constructor. */
static srp_status finish(srp_scene *scene, srp_status status, srp_scene **out, srp_error *error) {
    if (status == SRP_OK && !hash_scene(scene)) {
        status = srp_fail(error, SRP_NO_MEMORY, "no memory for the scene");
    }
    if (status != SRP_OK) {
        srp_scene_destroy(scene);
        return status;
    }
    *out = scene;
    return SRP_OK;
}

srp_status srp_scene_from_mesh(const srp_mesh *mesh, const srp_materials *materials,
                               srp_scene **out, srp_error *error) {
    srp_scene *scene = scene_new(SRP_SHAPE_MESH, srp_mesh_material_count(mesh));
    if (scene == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for the scene");
    }
    srp_status status = take_materials(scene, mesh, materials, error);
    if (status == SRP_OK) {
        status = take_mesh(scene, mesh, error);
    }
    return finish(scene, status, out, error);
}

/* ---- plates and spheres ---- */

static srp_status check_plate(const srp_plate *plate, size_t number, srp_error *error) {
    double length = srp_vec3_norm(plate->normal);
    if (!(isfinite(length) && length > 0.0)) {
        return srp_fail(error, SRP_BAD_DATA, "plate %zu has no normal", number);
    }
    if (!(plate->area > 0.0 && plate->area <= SRP_AREA_MAX)) {
        return srp_fail(error, SRP_BAD_DATA,
                        "plate %zu has area %g m^2, expected more than 0 and at most %g", number,
                        plate->area, SRP_AREA_MAX);
    }
    return srp_optics_check(plate->optics, error);
}

srp_status srp_scene_from_plates(const srp_plate *plates, size_t count, srp_scene **out,
                                 srp_error *error) {
    if (count == 0) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "an N-plate model needs at least one plate");
    }
    srp_scene *scene = scene_new(SRP_SHAPE_PLATES, count);
    if (scene == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for %zu plates", count);
    }
    srp_status status = SRP_OK;
    scene->plates = calloc(count, sizeof *scene->plates);
    for (size_t i = 0; status == SRP_OK && i < count; ++i) {
        char name[32];
        snprintf(name, sizeof name, "plate %zu", i + 1);
        scene->material_names[i] = srp_string_copy(name);
        if (scene->plates == NULL || scene->material_names[i] == NULL) {
            status = srp_fail(error, SRP_NO_MEMORY, "no memory for %zu plates", count);
            break;
        }
        status = check_plate(&plates[i], i + 1, error);
        if (status == SRP_OK) {
            scene->plates[i] = plates[i];
            scene->plates[i].normal =
                srp_vec3_scale(1.0 / srp_vec3_norm(plates[i].normal), plates[i].normal);
            scene->optics[i] = plates[i].optics;
        }
    }
    scene->plate_count = count;
    return finish(scene, status, out, error);
}

srp_status srp_scene_from_sphere(double cr, double area, srp_scene **out, srp_error *error) {
    if (!SRP_WITHIN(cr, 0.0, SRP_CR_MAX)) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "coefficient Cr of %g, expected 0 to %g", cr,
                        SRP_CR_MAX);
    }
    if (!(area > 0.0 && area <= SRP_AREA_MAX)) {
        return srp_fail(error, SRP_BAD_ARGUMENT,
                        "area of %g m^2, expected more than 0 and at most %g", area, SRP_AREA_MAX);
    }
    srp_scene *scene = scene_new(SRP_SHAPE_SPHERE, 0);
    if (scene == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for the scene");
    }
    scene->cr = cr;
    scene->area = area;
    return finish(scene, SRP_OK, out, error);
}

/* ---- what a scene tells ---- */

srp_shape srp_scene_shape(const srp_scene *scene) {
    return scene->shape;
}

size_t srp_scene_material_count(const srp_scene *scene) {
    return scene->material_count;
}

const char *srp_scene_material_name(const srp_scene *scene, size_t index) {
    return index < scene->material_count ? scene->material_names[index] : NULL;
}

srp_optics srp_scene_material_optics(const srp_scene *scene, size_t index) {
    const srp_optics none = {0.0, 0.0, false};
    return index < scene->material_count ? scene->optics[index] : none;
}

size_t srp_scene_facet_count(const srp_scene *scene) {
    return scene->shape == SRP_SHAPE_PLATES ? scene->plate_count : scene->facet_count;
}

srp_face srp_scene_face(const srp_scene *scene, size_t index) {
    if (scene->shape == SRP_SHAPE_PLATES) {
        const srp_plate *plate = &scene->plates[index];
        return (srp_face){plate->normal, plate->area, (uint32_t)index, false};
    }
    const srp_facet *facet = &scene->facets[index];
    return (srp_face){facet->normal, facet->area, facet->material, !facet->closed};
}

double srp_scene_radius(const srp_scene *scene) {
    double radius = 0.0;
    for (size_t i = 0; i < scene->vertex_count; ++i) {
        radius = fmax(radius, srp_vec3_norm(scene->vertices[i]));
    }
    return radius;
}

const char *srp_scene_shape_hash(const srp_scene *scene) {
    return scene->shape_hash;
}

const char *srp_scene_optics_hash(const srp_scene *scene) {
    return scene->optics_hash;
}
