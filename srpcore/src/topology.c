/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Vertices at one place are welded, edges are sorted so that the triangles which share one lie side
 * by side, and triangles that share an edge in opposite senses are joined into components
 * (union-find). Sorting rather than hashing: the result depends on nothing but the mesh.
 */
#include "topology.h"

#include "error.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

typedef struct place {
    double x, y, z;
    uint32_t vertex;
} place;

/* One of the three edges of a triangle, its ends in ascending order. */
typedef struct edge_use {
    uint32_t low, high;
    uint32_t triangle;
    uint8_t side;   /* edge v[side] -> v[(side+1)%3] */
    bool ascending; /* passed from low to high */
} edge_use;

static int compare_places(const void *left, const void *right) {
    const place *a = left, *b = right;
    if (a->x != b->x) {
        return a->x < b->x ? -1 : 1;
    }
    if (a->y != b->y) {
        return a->y < b->y ? -1 : 1;
    }
    if (a->z != b->z) {
        return a->z < b->z ? -1 : 1;
    }
    return a->vertex < b->vertex ? -1 : a->vertex > b->vertex;
}

static int compare_uses(const void *left, const void *right) {
    const edge_use *a = left, *b = right;
    if (a->low != b->low) {
        return a->low < b->low ? -1 : 1;
    }
    if (a->high != b->high) {
        return a->high < b->high ? -1 : 1;
    }
    if (a->triangle != b->triangle) {
        return a->triangle < b->triangle ? -1 : 1;
    }
    return (int)a->side - (int)b->side;
}

static bool weld_vertices(const srp_mesh *mesh, uint32_t *weld) {
    size_t count = srp_mesh_vertex_count(mesh);
    const srp_vec3 *vertices = srp_mesh_vertices(mesh);
    place *places = malloc((count + 1) * sizeof *places);
    if (places == NULL) {
        return false;
    }
    for (size_t i = 0; i < count; ++i) {
        places[i] = (place){vertices[i].x, vertices[i].y, vertices[i].z, (uint32_t)i};
    }
    qsort(places, count, sizeof *places, compare_places);
    for (size_t i = 0, first = 0; i < count; ++i) {
        if (places[i].x != places[first].x || places[i].y != places[first].y ||
            places[i].z != places[first].z) {
            first = i;
        }
        weld[places[i].vertex] = places[first].vertex;
    }
    free(places);
    return true;
}

/* Below a few rounding errors of the cross product the normal is noise. */
bool srp_triangle_is_degenerate(srp_vec3 a, srp_vec3 b, srp_vec3 c) {
    srp_vec3 ab = srp_vec3_sub(b, a), bc = srp_vec3_sub(c, b), ca = srp_vec3_sub(a, c);
    double longest = fmax(srp_vec3_norm(ab), fmax(srp_vec3_norm(bc), srp_vec3_norm(ca)));
    double twice_area = srp_vec3_norm(srp_vec3_cross(ab, ca));
    return !(twice_area > 16.0 * DBL_EPSILON * longest * longest);
}

static void weld_triangles(const srp_mesh *mesh, srp_topology *topology) {
    const srp_vec3 *vertices = srp_mesh_vertices(mesh);
    const srp_triangle *triangles = srp_mesh_triangles(mesh);
    for (size_t i = 0; i < topology->triangle_count; ++i) {
        srp_triangle *welded = &topology->welded[i];
        for (int k = 0; k < 3; ++k) {
            welded->v[k] = topology->weld[triangles[i].v[k]];
        }
        topology->degenerate[i] = srp_triangle_is_degenerate(
            vertices[welded->v[0]], vertices[welded->v[1]], vertices[welded->v[2]]);
    }
}

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

/* Triangles at the same places: `count` keys in ascending order of the triangles. */
static void compare_doubles(srp_topology *topology, const triangle_key *keys, size_t count) {
    size_t seen[2] = {0, 0}; /* by winding */
    for (size_t i = 0; i < count; ++i) {
        topology->repeats[keys[i].triangle] = seen[keys[i].even]++ > 0;
    }
    for (int even = 0; even < 2; ++even) {
        topology->duplicate += seen[even] > 1 ? seen[even] - 1 : 0;
        topology->opposite += seen[!even] > 0 ? seen[even] : 0;
    }
}

static bool find_doubles(srp_topology *topology) {
    size_t count = 0;
    triangle_key *keys = malloc((topology->triangle_count + 1) * sizeof *keys);
    if (keys == NULL) {
        return false;
    }
    for (size_t i = 0; i < topology->triangle_count; ++i) {
        topology->repeats[i] = false;
        if (!topology->degenerate[i]) {
            keys[count++] = key_of(topology->welded[i], (uint32_t)i);
        }
    }
    qsort(keys, count, sizeof *keys, compare_keys);
    for (size_t begin = 0, end; begin < count; begin = end) {
        end = begin + 1;
        while (end < count && same_places(&keys[end], &keys[begin])) {
            ++end;
        }
        compare_doubles(topology, keys + begin, end - begin);
    }
    free(keys);
    return true;
}

/* Do the edges of triangle `i` count? */
static bool has_edges(const srp_topology *topology, size_t i) {
    const uint32_t *v = topology->welded[i].v;
    return !topology->repeats[i] && v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
}

/* Sorted uses of all edges. */
static edge_use *collect_uses(const srp_topology *topology, size_t *count) {
    edge_use *uses = malloc((3 * topology->triangle_count + 1) * sizeof *uses);
    if (uses == NULL) {
        return NULL;
    }
    size_t n = 0;
    for (size_t i = 0; i < topology->triangle_count; ++i) {
        for (uint8_t k = 0; k < 3 && has_edges(topology, i); ++k) {
            uint32_t from = topology->welded[i].v[k], to = topology->welded[i].v[(k + 1) % 3];
            bool ascending = from < to;
            uses[n++] =
                (edge_use){ascending ? from : to, ascending ? to : from, (uint32_t)i, k, ascending};
        }
    }
    qsort(uses, n, sizeof *uses, compare_uses);
    *count = n;
    return uses;
}

static size_t group_end(const edge_use *uses, size_t count, size_t begin) {
    size_t end = begin + 1;
    while (end < count && uses[end].low == uses[begin].low && uses[end].high == uses[begin].high) {
        ++end;
    }
    return end;
}

static bool is_pair(const edge_use *uses, size_t begin, size_t end) {
    return end - begin == 2 && uses[begin].ascending != uses[begin + 1].ascending;
}

/* Takes out the edges of triangles without area that close no crack; the number of those left.
 * `component` is scratch. */
static size_t drop_loose(const srp_topology *topology, edge_use *uses, size_t count) {
    uint32_t *loose = topology->component;
    memset(loose, 0, topology->triangle_count * sizeof *loose);
    for (size_t begin = 0, end; begin < count; begin = end) {
        end = group_end(uses, count, begin);
        for (size_t i = begin; i < end && !is_pair(uses, begin, end); ++i) {
            loose[uses[i].triangle] = topology->degenerate[uses[i].triangle];
        }
    }
    size_t kept = 0;
    for (size_t i = 0; i < count; ++i) {
        if (!loose[uses[i].triangle]) {
            uses[kept++] = uses[i];
        }
    }
    return kept;
}

static uint32_t find_root(uint32_t *parent, uint32_t i) {
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

/* The lower root wins, so that a component is named by its first triangle. */
static void unite(uint32_t *parent, uint32_t a, uint32_t b) {
    a = find_root(parent, a);
    b = find_root(parent, b);
    if (a < b) {
        parent[b] = a;
    } else {
        parent[a] = b;
    }
}

/* Sets neighbours, counts the kinds of edges, and joins triangles in `parent`. */
static void join_triangles(srp_topology *topology, const edge_use *uses, size_t count,
                           uint32_t *parent) {
    for (size_t begin = 0, end; begin < count; begin = end) {
        end = group_end(uses, count, begin);
        const edge_use *a = &uses[begin];
        if (end - begin == 1) {
            ++topology->boundary_edges;
        } else if (end - begin > 2) {
            ++topology->nonmanifold_edges;
        } else if (!is_pair(uses, begin, end)) {
            ++topology->inconsistent_edges;
        } else {
            topology->neighbour[a[0].triangle][a[0].side] = a[1].triangle;
            topology->neighbour[a[1].triangle][a[1].side] = a[0].triangle;
            unite(parent, a[0].triangle, a[1].triangle);
        }
    }
}

/* What holds no triangle with an area is no component. */
static bool number_components(srp_topology *topology, uint32_t *parent) {
    uint32_t *component = topology->component;
    memset(component, 0xff, topology->triangle_count * sizeof *component);
    for (size_t i = 0; i < topology->triangle_count; ++i) {
        if (!topology->degenerate[i] && !topology->repeats[i]) {
            component[find_root(parent, (uint32_t)i)] = 0;
        }
    }
    for (size_t i = 0; i < topology->triangle_count; ++i) {
        uint32_t root = find_root(parent, (uint32_t)i);
        if (root == i && component[i] != SRP_NO_TRIANGLE) {
            component[i] = (uint32_t)topology->component_count++;
        } else {
            component[i] = component[root];
        }
    }
    topology->components = calloc(topology->component_count + 1, sizeof *topology->components);
    if (topology->components == NULL) {
        return false;
    }
    for (size_t i = 0; i < topology->triangle_count; ++i) {
        if (component[i] != SRP_NO_TRIANGLE &&
            topology->components[component[i]].triangles++ == 0) {
            topology->components[component[i]].first = (uint32_t)i;
        }
    }
    return true;
}

/* A component is closed when it passes each of its edges as often one way as the other; other
 * components may share the edge. */
static bool find_closed(srp_topology *topology, const edge_use *uses, size_t count) {
    long *balance = calloc(topology->component_count + 1, sizeof *balance);
    if (balance == NULL) {
        return false;
    }
    for (size_t c = 0; c < topology->component_count; ++c) {
        topology->components[c].closed = true;
    }
    for (size_t begin = 0, end; begin < count; begin = end) {
        end = group_end(uses, count, begin);
        for (size_t i = begin; i < end; ++i) {
            uint32_t component = topology->component[uses[i].triangle];
            if (component != SRP_NO_TRIANGLE) {
                balance[component] += uses[i].ascending ? 1 : -1;
            }
        }
        for (size_t i = begin; i < end; ++i) {
            uint32_t component = topology->component[uses[i].triangle];
            if (component != SRP_NO_TRIANGLE && balance[component] != 0) {
                topology->components[component].closed = false;
                balance[component] = 0;
            }
        }
    }
    free(balance);
    return true;
}

/* Volumes about a vertex of the component itself: a far origin would cost digits. The two sides of
 * a foil, closed at the rim, hold no volume; the sign of what rounding makes of it must not turn
 * them round. */
static void measure_volumes(const srp_mesh *mesh, srp_topology *topology) {
    const srp_vec3 *vertices = srp_mesh_vertices(mesh);
    for (size_t i = 0; i < topology->triangle_count; ++i) {
        if (topology->component[i] == SRP_NO_TRIANGLE) {
            continue;
        }
        srp_component *component = &topology->components[topology->component[i]];
        if (component->closed) {
            const uint32_t *v = topology->welded[i].v;
            srp_vec3 origin = vertices[topology->welded[component->first].v[0]];
            srp_vec3 a = srp_vec3_sub(vertices[v[0]], origin);
            srp_vec3 b = srp_vec3_sub(vertices[v[1]], origin);
            srp_vec3 c = srp_vec3_sub(vertices[v[2]], origin);
            double reach = srp_vec3_norm(vertices[v[0]]) + srp_vec3_norm(a);
            component->volume += srp_vec3_dot(a, srp_vec3_cross(b, c)) / 6.0;
            component->noise += 4.0 * DBL_EPSILON * reach * srp_vec3_norm(b) * srp_vec3_norm(c);
        }
    }
    for (size_t c = 0; c < topology->component_count; ++c) {
        srp_component *component = &topology->components[c];
        component->inward = component->volume < -component->noise;
    }
}

static bool allocate(srp_topology *topology) {
    size_t triangles = topology->triangle_count + 1;
    topology->weld = malloc((topology->vertex_count + 1) * sizeof *topology->weld);
    topology->welded = malloc(triangles * sizeof *topology->welded);
    topology->component = malloc(triangles * sizeof *topology->component);
    topology->neighbour = malloc(triangles * sizeof *topology->neighbour);
    topology->degenerate = malloc(triangles * sizeof *topology->degenerate);
    topology->repeats = malloc(triangles * sizeof *topology->repeats);
    if (topology->weld == NULL || topology->welded == NULL || topology->component == NULL ||
        topology->neighbour == NULL || topology->degenerate == NULL || topology->repeats == NULL) {
        return false;
    }
    memset(topology->neighbour, 0xff, triangles * sizeof *topology->neighbour);
    return true;
}

srp_status srp_topology_create(const srp_mesh *mesh, srp_topology *out, srp_error *error) {
    srp_topology topology;
    memset(&topology, 0, sizeof topology);
    topology.triangle_count = srp_mesh_triangle_count(mesh);
    topology.vertex_count = srp_mesh_vertex_count(mesh);
    edge_use *uses = NULL;
    size_t use_count = 0;
    uint32_t *parent = malloc((topology.triangle_count + 1) * sizeof *parent);
    if (parent == NULL || !allocate(&topology) || !weld_vertices(mesh, topology.weld)) {
        goto fail;
    }
    weld_triangles(mesh, &topology);
    if (!find_doubles(&topology)) {
        goto fail;
    }
    uses = collect_uses(&topology, &use_count);
    if (uses == NULL) {
        goto fail;
    }
    for (size_t i = 0; i < topology.triangle_count; ++i) {
        parent[i] = (uint32_t)i;
    }
    use_count = drop_loose(&topology, uses, use_count);
    join_triangles(&topology, uses, use_count, parent);
    if (!number_components(&topology, parent) || !find_closed(&topology, uses, use_count)) {
        goto fail;
    }
    measure_volumes(mesh, &topology);
    free(parent);
    free(uses);
    *out = topology;
    return SRP_OK;
fail:
    free(parent);
    free(uses);
    srp_topology_clear(&topology);
    return srp_fail(error, SRP_NO_MEMORY, "no memory to join %zu triangles",
                    srp_mesh_triangle_count(mesh));
}

void srp_topology_clear(srp_topology *topology) {
    free(topology->weld);
    free(topology->welded);
    free(topology->component);
    free(topology->components);
    free(topology->neighbour);
    free(topology->degenerate);
    free(topology->repeats);
    memset(topology, 0, sizeof *topology);
}
