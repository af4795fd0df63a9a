/* SPDX-License-Identifier: Apache-2.0 */
/* Shapes with a closed form: cube, spheres, corners. */
#include "model.h"
#include "models.h"
#include "write.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

void make_cube(const char *directory) {
    model m = model_make("cube", "Cube of edge 2 m about the origin (AAS 20-481, Tables 1 to 4).");
    uint32_t surface = model_add_material(&m, "surface", 0.5, 0.1);
    const frame body = frame_at(srp_vec3_make(0.0, 0.0, 0.0));
    model_part(&m, "cube");
    model_add_block(&m, &body, srp_vec3_make(-1.0, -1.0, -1.0), srp_vec3_make(1.0, 1.0, 1.0),
                    surface);
    write_model(&m, directory);
    model_clear(&m);

    const plate_row rows[6] = {
        {"-x", {-1.0, 0.0, 0.0}, 4.0, 0.5, 0.1}, {"+x", {1.0, 0.0, 0.0}, 4.0, 0.5, 0.1},
        {"-y", {0.0, -1.0, 0.0}, 4.0, 0.5, 0.1}, {"+y", {0.0, 1.0, 0.0}, 4.0, 0.5, 0.1},
        {"-z", {0.0, 0.0, -1.0}, 4.0, 0.5, 0.1}, {"+z", {0.0, 0.0, 1.0}, 4.0, 0.5, 0.1},
    };
    write_plates("cube", "The six faces of cube.obj.", rows, 6, directory);
}

/* The vertex half way between a and b, pushed out to the sphere; made once per edge. */
typedef struct midpoint {
    uint32_t a, b, vertex;
} midpoint;

static uint32_t find_midpoint(model *m, midpoint *known, size_t *count, uint32_t a, uint32_t b) {
    uint32_t low = a < b ? a : b, high = a < b ? b : a;
    for (size_t i = 0; i < *count; ++i) {
        if (known[i].a == low && known[i].b == high) {
            return known[i].vertex;
        }
    }
    uint32_t vertex = model_add_vertex(m, unit(srp_vec3_add(m->vertices[a], m->vertices[b])));
    known[*count] = (midpoint){low, high, vertex};
    ++*count;
    return vertex;
}

/* Each triangle into four. */
static void subdivide(model *m) {
    size_t before = m->triangle_count, edges = 0;
    midpoint *known = malloc(3 * before / 2 * sizeof *known);
    if (known == NULL) {
        fail("out of memory", m->name);
    }
    for (size_t i = 0; i < before; ++i) {
        model_triangle t = m->triangles[i];
        uint32_t ab = find_midpoint(m, known, &edges, t.v[0], t.v[1]);
        uint32_t bc = find_midpoint(m, known, &edges, t.v[1], t.v[2]);
        uint32_t ca = find_midpoint(m, known, &edges, t.v[2], t.v[0]);
        m->triangles[i] = (model_triangle){{ab, bc, ca}, t.material, t.part};
        model_add_triangle(m, t.material, t.v[0], ab, ca);
        model_add_triangle(m, t.material, t.v[1], bc, ab);
        model_add_triangle(m, t.material, t.v[2], ca, bc);
    }
    free(known);
}

/* The triangle, turned so that its front looks away from the origin. */
static void add_outward(model *m, uint32_t material, uint32_t a, uint32_t b, uint32_t c) {
    const srp_vec3 *v = m->vertices;
    double volume = srp_vec3_dot(v[a], srp_vec3_cross(v[b], v[c]));
    model_add_triangle(m, material, a, volume > 0.0 ? b : c, volume > 0.0 ? c : b);
}

/* Icosahedron with its corners at (0, +-1, +-phi) and cyclic permutations, brought to radius 1:
 * the orientation that the exact values of AAS 20-481's Table 1 belong to. */
static void add_icosahedron(model *m, uint32_t material) {
    const double cosine_of_edge = 1.0 / sqrt(5.0); /* between neighbours, seen from the centre */
    const double phi = (1.0 + sqrt(5.0)) / 2.0;
    for (int axis = 0; axis < 3; ++axis) {
        for (int k = 0; k < 4; ++k) {
            double one = (k & 2) ? 1.0 : -1.0;
            double long_side = (k & 1) ? phi : -phi;
            const double c[3] = {0.0, one, long_side};
            (void)model_add_vertex(
                m, unit(srp_vec3_make(c[(3 - axis) % 3], c[(4 - axis) % 3], c[(5 - axis) % 3])));
        }
    }
    for (uint32_t a = 0; a < 12; ++a) {
        for (uint32_t b = a + 1; b < 12; ++b) {
            for (uint32_t c = b + 1; c < 12; ++c) {
                const srp_vec3 *v = m->vertices;
                if (srp_vec3_dot(v[a], v[b]) > 0.9 * cosine_of_edge &&
                    srp_vec3_dot(v[b], v[c]) > 0.9 * cosine_of_edge &&
                    srp_vec3_dot(v[c], v[a]) > 0.9 * cosine_of_edge) {
                    add_outward(m, material, a, b, c);
                }
            }
        }
    }
}

static void make_icosphere(const char *name, int subdivisions, const char *directory) {
    model m = model_make(name, "Sphere of radius 1 m about the origin: an icosahedron with corners "
                               "at (0, +-1, +-phi)\nand cyclic permutations, subdivided, every "
                               "vertex on the sphere.");
    m.points_per_metre = 0.0; /* nothing but +, *, / and sqrt: the same bits everywhere */
    uint32_t surface = model_add_material(&m, "surface", 0.5, 0.0);
    model_part(&m, "sphere");
    add_icosahedron(&m, surface);
    for (int i = 0; i < subdivisions; ++i) {
        subdivide(&m);
    }
    write_model(&m, directory);
    model_clear(&m);
}

void make_icospheres(const char *directory) {
    make_icosphere("icosphere-80", 1, directory);
    make_icosphere("icosphere-320", 2, directory);
    make_icosphere("icosphere-1280", 3, directory);
}

/* Two unit squares that meet at the z axis under 90 degrees, fronts to +x and +y. */
static void make_corner(const char *name, const char *comment, double rho_s, double rho_d,
                        const char *directory) {
    model m = model_make(name, comment);
    uint32_t surface = model_add_material(&m, "surface", rho_s, rho_d);
    uint32_t v[6];
    for (uint32_t k = 0; k < 6; ++k) {
        v[k] = model_add_vertex(&m, srp_vec3_make(k >= 4 ? 1.0 : 0.0, k >= 2 && k < 4 ? 1.0 : 0.0,
                                                  (k & 1) ? 1.0 : 0.0));
    }
    model_part(&m, "plate_x");
    model_add_quad(&m, surface, v[0], v[2], v[3], v[1]);
    model_part(&m, "plate_y");
    model_add_quad(&m, surface, v[0], v[1], v[5], v[4]);
    write_model(&m, directory);
    model_clear(&m);
}

void make_l_corner(const char *directory) {
    make_corner("l-corner",
                "Two open unit plates at right angles, x = 0 and y = 0, that meet at the z axis;\n"
                "all light that falls on them is scattered (rho_d = 1).",
                0.0, 1.0, directory);
}

void make_dihedral(const char *directory) {
    make_corner("dihedral",
                "Two open unit mirrors at right angles, x = 0 and y = 0, that meet at the z axis;\n"
                "with the Sun along the bisector (1, 1, 0) every ray goes back where it came from.",
                1.0, 0.0, directory);
}
