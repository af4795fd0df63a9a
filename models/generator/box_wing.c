/* SPDX-License-Identifier: Apache-2.0 */
/* The classical box-wing: a cube and two panels, parts that nowhere touch. */
#include "model.h"
#include "models.h"
#include "write.h"

static const model_material BUS = {"bus", 0.3, 0.25};
static const model_material CELLS = {"cells", 0.07, 0.02};
static const model_material PANEL_BACK = {"panel_back", 0.05, 0.35};
static const model_material BOOM = {"boom", 0.15, 0.1};

static uint32_t add(model *m, model_material material) {
    return model_add_material(m, material.name, material.rho_s, material.rho_d);
}

/* The wing at the side `side` (-1 or 1) of y. */
static void add_wing(model *m, double side, uint32_t cells, uint32_t back, uint32_t boom) {
    const frame f = frame_at(srp_vec3_make(0.0, 5.5 * side, 0.0));
    const uint32_t panel[6] = {back, cells, back, back, back, back};
    model_part(m, side < 0.0 ? "panel_minus_y" : "panel_plus_y");
    model_add_box(m, &f, srp_vec3_make(-0.0125, -4.0, -1.0), srp_vec3_make(0.0125, 4.0, 1.0),
                  panel);

    const frame root = frame_at(srp_vec3_make(0.0, 1.25 * side, 0.0));
    model_part(m, side < 0.0 ? "boom_minus_y" : "boom_plus_y");
    model_add_block(m, &root, srp_vec3_make(-0.04, -0.24, -0.04), srp_vec3_make(0.04, 0.24, 0.04),
                    boom);
}

static void write_box_wing_plates(const char *directory) {
    const plate_row rows[8] = {
        {"bus -x", {-1.0, 0.0, 0.0}, 4.0, BUS.rho_s, BUS.rho_d},
        {"bus +x", {1.0, 0.0, 0.0}, 4.0, BUS.rho_s, BUS.rho_d},
        {"bus -y", {0.0, -1.0, 0.0}, 4.0, BUS.rho_s, BUS.rho_d},
        {"bus +y", {0.0, 1.0, 0.0}, 4.0, BUS.rho_s, BUS.rho_d},
        {"bus -z", {0.0, 0.0, -1.0}, 4.0, BUS.rho_s, BUS.rho_d},
        {"bus +z", {0.0, 0.0, 1.0}, 4.0, BUS.rho_s, BUS.rho_d},
        {"both panels, cells", {1.0, 0.0, 0.0}, 32.0, CELLS.rho_s, CELLS.rho_d},
        {"both panels, back", {-1.0, 0.0, 0.0}, 32.0, PANEL_BACK.rho_s, PANEL_BACK.rho_d},
    };
    write_plates("box-wing", "box-wing.obj without its booms, panel edges and shadows.", rows, 8,
                 directory);
}

void make_box_wing(const char *directory) {
    model m = model_make("box-wing",
                         "Box-wing: a 2 m cube about the origin, two panels of 2 m x 8 m along y,\n"
                         "cells towards +x, on booms. No part touches another.");
    uint32_t bus = add(&m, BUS);
    uint32_t cells = add(&m, CELLS);
    uint32_t back = add(&m, PANEL_BACK);
    uint32_t boom = add(&m, BOOM);
    const frame body = frame_at(srp_vec3_make(0.0, 0.0, 0.0));
    model_part(&m, "bus");
    model_add_block(&m, &body, srp_vec3_make(-1.0, -1.0, -1.0), srp_vec3_make(1.0, 1.0, 1.0), bus);
    add_wing(&m, -1.0, cells, back, boom);
    add_wing(&m, 1.0, cells, back, boom);
    write_model(&m, directory);
    model_clear(&m);
    write_box_wing_plates(directory);
}
