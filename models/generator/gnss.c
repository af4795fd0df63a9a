/* SPDX-License-Identifier: Apache-2.0 */
/* A navigation satellite with a cylindrical body: helix antennas on the deck that faces the Earth
 * (+z), two wings along y, an apogee engine at -z. Every part is closed; parts stand in each other
 * where the real ones are bolted together. */
#include "model.h"
#include "models.h"
#include "write.h"

#include <srp/const.h>

#include <math.h>

typedef struct paints {
    uint32_t foil, radiator, cells, panel_back, metal, glass, engine;
} paints;

static const double BODY_RADIUS = 1.15; /* [m] */
static const double DECK = 1.4;         /* height of the Earth-facing deck [m] */
static const double FLOOR = -1.2;       /* the other end of the body [m] */

enum { BODY_SEGMENTS = 96, BODY_ROWS = 10 };

static void add_body(model *m, const paints *p) {
    const frame body = frame_at(srp_vec3_make(0.0, 0.0, 0.0));
    profile_point profile[BODY_ROWS + 3];
    profile[0] = (profile_point){0.0, FLOOR};
    for (int i = 0; i <= BODY_ROWS; ++i) {
        profile[i + 1] = (profile_point){BODY_RADIUS, FLOOR + (DECK - FLOOR) * i / BODY_ROWS};
    }
    profile[BODY_ROWS + 2] = (profile_point){0.0, DECK};
    model_part(m, "body");
    model_add_revolved(m, &body, profile, BODY_ROWS + 3, PROFILE_OPEN, BODY_SEGMENTS, p->foil);

    /* Radiators: slabs that stand out of the skin at +-x. */
    model_part(m, "radiators");
    for (int side = -1; side <= 1; side += 2) {
        frame f = frame_at(srp_vec3_make(1.12 * side, 0.0, 0.1));
        model_add_block(m, &f, srp_vec3_make(-0.06, -0.5, -0.9), srp_vec3_make(0.06, 0.5, 0.9),
                        p->radiator);
    }
}

enum { HELIX_TURNS = 7, HELIX_STEPS = 16, HELIX_POINTS = HELIX_TURNS * HELIX_STEPS + 1 };

/* One helix in its cup, standing on the deck at (x, y). `phase` turns its start [rad]. */
static void add_helix(model *m, const paints *p, double x, double y, double phase) {
    const double radius = 0.055, rise = 0.09;
    const frame f = frame_at(srp_vec3_make(x, y, DECK));
    const profile_point cup[] = {{0.02, -0.02}, {0.13, -0.02}, {0.13, 0.08},
                                 {0.12, 0.08},  {0.12, 0.01},  {0.02, 0.01}};
    model_add_revolved(m, &f, cup, 6, PROFILE_LOOP, 24, p->metal);
    model_add_prism(m, &f, 0.018, -0.01, 0.74, 8, p->glass);

    srp_vec3 path[HELIX_POINTS];
    for (int i = 0; i < HELIX_POINTS; ++i) {
        double turn = (double)i / HELIX_STEPS;
        double angle = phase + 2.0 * SRP_PI * turn;
        path[i] = frame_point(&f, radius * cos(angle), radius * sin(angle), 0.03 + rise * turn);
    }
    model_add_tube(m, path, HELIX_POINTS, 0.006, 6, p->metal);
}

static void add_helices(model *m, const paints *p) {
    model_part(m, "helices");
    for (int k = 0; k < 4; ++k) {
        double angle = 2.0 * SRP_PI * (k + 0.5) / 4.0;
        add_helix(m, p, 0.3 * cos(angle), 0.3 * sin(angle), angle);
    }
    for (int k = 0; k < 8; ++k) {
        double angle = 2.0 * SRP_PI * (k + 0.25) / 8.0;
        add_helix(m, p, 0.78 * cos(angle), 0.78 * sin(angle), angle);
    }
}

/* Corner-cube reflectors in a tray, and a few more antennas. */
static void add_deck(model *m, const paints *p) {
    const frame body = frame_at(srp_vec3_make(0.0, 0.0, DECK));
    model_part(m, "retroreflectors");
    model_add_block(m, &body, srp_vec3_make(0.42, -0.13, -0.02), srp_vec3_make(0.62, 0.13, 0.03),
                    p->metal);
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 6; ++j) {
            frame f = frame_at(srp_vec3_make(0.445 + 0.05 * i, -0.105 + 0.042 * j, DECK));
            model_add_prism(m, &f, 0.017, 0.02, 0.04, 12, p->glass);
        }
    }
    model_part(m, "patches");
    for (int k = 0; k < 6; ++k) {
        double angle = 2.0 * SRP_PI * (k + 0.1) / 6.0;
        frame f = frame_at(srp_vec3_make(1.03 * cos(angle), 1.03 * sin(angle), DECK));
        model_add_prism(m, &f, 0.07, -0.01, 0.05, 24, p->metal);
    }
    model_part(m, "mast");
    model_add_rod(m, srp_vec3_make(0.02, 0.03, DECK - 0.05), srp_vec3_make(0.1, 0.06, DECK + 1.3),
                  0.02, 12, p->metal);
}

static void add_wing(model *m, const paints *p, double side) {
    const uint32_t leaf[6] = {p->panel_back, p->cells,      p->panel_back,
                              p->panel_back, p->panel_back, p->panel_back};
    model_part(m, side < 0.0 ? "wing_minus_y" : "wing_plus_y");
    for (int i = 0; i < 3; ++i) {
        frame f = frame_at(srp_vec3_make(0.0, side * (2.9 + 1.85 * i), 0.1));
        model_add_box(m, &f, srp_vec3_make(-0.012, -0.9, -0.95), srp_vec3_make(0.012, 0.9, 0.95),
                      leaf);
    }
    /* Boom from the skin to the first leaf, and hinges that bridge the leaves. */
    model_add_rod(m, srp_vec3_make(0.0, side * 1.05, 0.1), srp_vec3_make(0.0, side * 2.1, 0.1),
                  0.05, 24, p->metal);
    for (int i = 0; i < 2; ++i) {
        for (int end = -1; end <= 1; end += 2) {
            double y = 3.825 + 1.85 * i, z = 0.1 + 0.6 * end;
            model_add_rod(m, srp_vec3_make(0.0, side * (y - 0.06), z),
                          srp_vec3_make(0.0, side * (y + 0.06), z), 0.02, 12, p->metal);
        }
    }
}

/* The engine's bell: a closed shell of 5 mm, open downwards; and four small thrusters. */
static void add_engine(model *m, const paints *p) {
    enum { STEPS = 10 };
    const double wall = 0.005;
    const frame body = frame_at(srp_vec3_make(0.0, 0.0, FLOOR));
    profile_point bell[2 * (STEPS + 1)];
    for (int i = 0; i <= STEPS; ++i) {
        double along = (double)i / STEPS;
        double r = 0.08 + 0.3 * sqrt(along);
        double z = 0.03 - 0.6 * along;
        bell[STEPS - i] = (profile_point){r, z};            /* outside, upwards */
        bell[STEPS + 1 + i] = (profile_point){r - wall, z}; /* inside, downwards */
    }
    model_part(m, "engine");
    model_add_revolved(m, &body, bell, 2 * (STEPS + 1), PROFILE_LOOP, 48, p->engine);
    model_part(m, "thrusters");
    for (int k = 0; k < 4; ++k) {
        double angle = 2.0 * SRP_PI * (k + 0.5) / 4.0;
        frame f = frame_at(srp_vec3_make(0.85 * cos(angle), 0.85 * sin(angle), FLOOR));
        const profile_point cone[] = {{0.0, -0.15}, {0.05, -0.15}, {0.02, 0.02}, {0.0, 0.02}};
        model_add_revolved(m, &f, cone, 4, PROFILE_OPEN, 16, p->engine);
    }
}

void make_gnss(const char *directory) {
    model m = model_make(
        "gnss", "Navigation satellite: cylindrical body, twelve helix antennas and more on "
                "the deck (+z),\ntwo wings of three leaves along y (cells towards +x), "
                "apogee engine (-z). Every part is closed.");
    paints p;
    p.foil = model_add_material(&m, "foil", 0.33, 0.21);
    p.radiator = model_add_material(&m, "radiator", 0.72, 0.13);
    p.cells = model_add_material(&m, "cells", 0.08, 0.02);
    p.panel_back = model_add_material(&m, "panel_back", 0.06, 0.31);
    p.metal = model_add_material(&m, "metal", 0.55, 0.24);
    p.glass = model_add_material(&m, "glass", 0.17, 0.11);
    p.engine = model_add_material(&m, "engine", 0.29, 0.19);
    add_body(&m, &p);
    add_helices(&m, &p);
    add_deck(&m, &p);
    add_wing(&m, &p, -1.0);
    add_wing(&m, &p, 1.0);
    add_engine(&m, &p);
    write_model(&m, directory);
    model_clear(&m);
}
