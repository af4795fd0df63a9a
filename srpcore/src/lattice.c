/* SPDX-License-Identifier: Apache-2.0 */
#include "lattice.h"

#include "seed.h"

#include <math.h>

/* 31.7 degrees: tan = 0.6176, close to the golden ratio's 0.6180, the slope worst approximated by
 * fractions; an edge along a body axis then meets all parts of the cells alike. */
static const double TURN_COS = 0.85081110942405125;
static const double TURN_SIN = 0.52547165107226779;

srp_view srp_lattice_axes(const srp_lattice_params *params, srp_vec3 s) {
    srp_view view = srp_view_of(s);
    if (params->kind == SRP_LATTICE_WINDOW) {
        return view;
    }
    srp_view turned = view;
    turned.u = srp_vec3_add_scaled(srp_vec3_scale(TURN_COS, view.u), TURN_SIN, view.v);
    turned.v = srp_vec3_add_scaled(srp_vec3_scale(TURN_COS, view.v), -TURN_SIN, view.u);
    return turned;
}

static int32_t cells_across(double length, double pitch) {
    double cells = ceil(length / pitch);
    return cells < 1.0 ? 1 : (int32_t)cells;
}

static srp_lattice fit_window(const srp_lattice_params *params, const srp_view *axes,
                              unsigned refine) {
    srp_lattice lattice;
    lattice.view = *axes;
    lattice.columns = (int32_t)(params->columns << refine);
    lattice.rows = (int32_t)(params->rows << refine);
    lattice.du = (params->window[1] - params->window[0]) / lattice.columns;
    lattice.dv = (params->window[3] - params->window[2]) / lattice.rows;
    lattice.u0 = params->window[0] + 0.5 * lattice.du;
    lattice.v0 = params->window[2] + 0.5 * lattice.dv;
    return lattice;
}

srp_lattice srp_lattice_fit(const srp_lattice_params *params, const srp_view *axes,
                            srp_extent extent, unsigned refine, uint64_t seed) {
    if (params->kind == SRP_LATTICE_WINDOW) {
        return fit_window(params, axes, refine);
    }
    double width = extent.u_max - extent.u_min;
    double height = extent.v_max - extent.v_min;
    double longer = width > height ? width : height;
    double pitch = isnan(params->pixel) ? longer / params->samples : params->pixel;
    pitch = ldexp(pitch, -(int)refine);

    uint64_t hash = srp_seed_mix(srp_seed_of_direction(seed, axes->s), refine);
    srp_lattice lattice;
    lattice.view = *axes;
    lattice.du = pitch;
    lattice.dv = pitch;
    lattice.u0 = extent.u_min + srp_seed_unit(hash) * pitch;
    lattice.v0 = extent.v_min + srp_seed_unit(srp_seed_mix(hash, 1)) * pitch;
    lattice.columns = cells_across(width, pitch);
    lattice.rows = cells_across(height, pitch);
    if (isnan(params->pixel)) {
        /* The division may have gone one unit of the last place over. */
        int32_t most = (int32_t)(params->samples << refine);
        lattice.columns = lattice.columns < most ? lattice.columns : most;
        lattice.rows = lattice.rows < most ? lattice.rows : most;
    }
    return lattice;
}

double srp_lattice_side(const srp_lattice_params *params, double diameter) {
    if (params->kind == SRP_LATTICE_WINDOW) {
        return params->columns > params->rows ? params->columns : params->rows;
    }
    return isnan(params->pixel) ? params->samples : ceil(diameter / params->pixel);
}
