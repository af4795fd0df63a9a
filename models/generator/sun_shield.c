/* SPDX-License-Identifier: Apache-2.0 */
/* An observatory behind a five-layer Sun shield, after the James Webb Space Telescope: the Sun at
 * -z, the telescope on +z, boresight +x. */
#include "model.h"
#include "models.h"
#include "write.h"

#include <srp/const.h>

#include <math.h>
#include <stdlib.h>

typedef struct paints {
    uint32_t silicon, aluminium, gold, carbon, foil, cells, dish;
} paints;

enum { LAYERS = 5, ALONG = 18, ACROSS = 14 };

static const double HALF_LENGTH = 10.6; /* of the shield, along x [m] */
static const double HALF_WIDTH = 7.1;   /* at its widest, along y [m] */

/* Half width of the kite at `u` in [-1, 1] along the shield, as a share of the widest. */
static double kite(double u) {
    double beyond = fabs(u) - 1.0 / 3.0;
    return beyond > 0.0 ? 1.0 - 1.05 * beyond : 1.0;
}

/* Point (u, v) in [-1, 1]^2 of layer k, 0 the cold one. The layers lie close at the centre and part
 * towards the rim; all are folded along the keel and bent up at bow and stern. */
static srp_vec3 shield_point(int layer, double u, double v) {
    double scale = 1.0 - 0.02 * (LAYERS - 1 - layer);
    double rim = fmax(fabs(u), fabs(v));
    double bend = fmax(fabs(u) - 2.0 / 3.0, 0.0);
    double z = -layer * (0.07 + 0.28 * rim) + 1.1 * bend + 0.25 * fabs(v);
    return srp_vec3_make(scale * HALF_LENGTH * u, scale * HALF_WIDTH * kite(u) * v, z);
}

static void add_shield(model *m, const paints *p) {
    static const char *const names[LAYERS] = {"layer_cold", "layer_4", "layer_3", "layer_2",
                                              "layer_sun"};
    for (int layer = 0; layer < LAYERS; ++layer) {
        model_part(m, names[layer]);
        uint32_t first = (uint32_t)m->vertex_count;
        for (int i = 0; i <= ALONG; ++i) {
            for (int j = 0; j <= ACROSS; ++j) {
                (void)model_add_vertex(
                    m, shield_point(layer, 2.0 * i / ALONG - 1.0, 2.0 * j / ACROSS - 1.0));
            }
        }
        uint32_t material = layer < LAYERS - 2 ? p->aluminium : p->silicon;
        for (uint32_t i = 0; i < ALONG; ++i) {
            for (uint32_t j = 0; j < ACROSS; ++j) {
                uint32_t a = first + i * (ACROSS + 1) + j, b = a + ACROSS + 1;
                model_add_quad(m, material, a, b, b + 1, a + 1);
            }
        }
    }
}

/* Eighteen hexagons of 1.32 m across their flats on a sphere whose centre is far out at +x. */
static void add_primary(model *m, const paints *p, srp_vec3 vertex) {
    const double pitch = 1.35, across_flats = 1.32, curvature = 15.88;
    const srp_vec3 centre = srp_vec3_make(vertex.x + curvature, vertex.y, vertex.z);
    const srp_vec3 sideways = {0.0, 1.0, 0.0};
    model_part(m, "primary");
    for (int q = -2; q <= 2; ++q) {
        for (int r = -2; r <= 2; ++r) {
            if ((q == 0 && r == 0) || abs(q + r) > 2) {
                continue;
            }
            double y = pitch * (sqrt(3.0) / 2.0) * q;
            double z = pitch * (r + 0.5 * q);
            double sag = curvature - sqrt(curvature * curvature - y * y - z * z);
            srp_vec3 at = srp_vec3_make(vertex.x + sag, vertex.y + y, vertex.z + z);
            /* Flats face up and down: corners towards +-y. */
            frame f = frame_along(at, srp_vec3_sub(centre, at), sideways);
            model_add_prism(m, &f, across_flats / sqrt(3.0), -0.06, 0.0, 6, p->gold);
        }
    }
}

static void add_telescope(model *m, const paints *p) {
    const srp_vec3 vertex = srp_vec3_make(-1.6, 0.0, 5.2);
    const srp_vec3 secondary = srp_vec3_make(vertex.x + 7.17, 0.0, vertex.z);
    add_primary(m, p, vertex);

    model_part(m, "secondary");
    frame f = frame_along(secondary, srp_vec3_make(-1.0, 0.0, 0.0), srp_vec3_make(0.0, 0.0, 1.0));
    model_add_prism(m, &f, 0.37, -0.05, 0.0, 24, p->gold);
    model_part(m, "struts");
    for (int k = 0; k < 3; ++k) {
        double angle = SRP_PI / 2.0 + 2.0 * SRP_PI * k / 3.0;
        double c = cos(angle), s = sin(angle);
        model_add_rod(m, srp_vec3_make(vertex.x - 0.1, 3.45 * c, vertex.z + 3.45 * s),
                      srp_vec3_make(secondary.x + 0.03, 0.3 * c, secondary.z + 0.3 * s), 0.06, 8,
                      p->carbon);
    }

    const frame body = frame_at(srp_vec3_make(0.0, 0.0, 0.0));
    model_part(m, "instruments");
    model_add_block(m, &body, srp_vec3_make(-4.1, -1.3, 3.6), srp_vec3_make(-1.9, 1.3, 6.2),
                    p->carbon);
}

/* What lies on the warm side, and the tower that goes through the layers to the telescope. */
static void add_spacecraft(model *m, const paints *p) {
    const frame body = frame_at(srp_vec3_make(0.0, 0.0, 0.0));
    model_part(m, "tower");
    model_add_rod(m, srp_vec3_make(-2.6, 0.0, -1.3), srp_vec3_make(-2.6, 0.0, 3.8), 0.45, 16,
                  p->carbon);
    model_part(m, "bus");
    model_add_block(m, &body, srp_vec3_make(-4.2, -1.6, -2.7), srp_vec3_make(-0.9, 1.6, -1.15),
                    p->foil);
    model_part(m, "solar_array");
    const frame array = frame_along(srp_vec3_make(-4.4, 0.0, -2.5), srp_vec3_make(0.4, 0.0, -1.0),
                                    srp_vec3_make(-1.0, 0.0, 0.0));
    const uint32_t sides[6] = {p->carbon, p->carbon, p->carbon, p->carbon, p->carbon, p->cells};
    model_add_box(m, &array, srp_vec3_make(0.1, -1.3, -0.02), srp_vec3_make(6.0, 1.3, 0.02), sides);

    const frame antenna = frame_along(srp_vec3_make(0.3, 0.0, -2.4), srp_vec3_make(0.3, 0.0, -1.0),
                                      srp_vec3_make(1.0, 0.0, 0.0));
    profile_point profile[7];
    for (int i = 0; i < 7; ++i) {
        double r = 0.3 * (6 - i) / 6.0;
        profile[i] = (profile_point){r, r * r / 0.6};
    }
    model_part(m, "antenna");
    model_add_revolved(m, &antenna, profile, 7, PROFILE_OPEN, 20, p->dish);
    model_add_rod(m, srp_vec3_make(-0.95, 0.0, -2.3), srp_vec3_make(0.27, 0.0, -2.36), 0.03, 8,
                  p->carbon);

    model_part(m, "momentum_flap");
    const frame flap = frame_along(srp_vec3_make(-10.63, 0.0, -0.95), srp_vec3_make(0.6, 0.0, 1.0),
                                   srp_vec3_make(-1.0, 0.0, 0.0));
    model_add_block(m, &flap, srp_vec3_make(0.0, -1.1, -0.01), srp_vec3_make(1.2, 1.1, 0.01),
                    p->aluminium);
}

void make_sun_shield(const char *directory) {
    model m = model_make("sun-shield",
                         "Observatory behind a five-layer Sun shield (open, two-sided membranes "
                         "with kinks),\nprimary of 18 hexagons, secondary on struts, bus, array. "
                         "Sun side -z, boresight +x.");
    paints p;
    p.silicon = model_add_material(&m, "silicon", 0.44, 0.09);
    p.aluminium = model_add_material(&m, "aluminium", 0.81, 0.07);
    p.gold = model_add_material(&m, "gold", 0.79, 0.02);
    p.carbon = model_add_material(&m, "carbon", 0.03, 0.07);
    p.foil = model_add_material(&m, "foil", 0.37, 0.23);
    p.cells = model_add_material(&m, "cells", 0.06, 0.03);
    p.dish = model_add_material(&m, "dish", 0.11, 0.58);
    add_shield(&m, &p);
    add_telescope(&m, &p);
    add_spacecraft(&m, &p);
    write_model(&m, directory);
    model_clear(&m);
}
