/* SPDX-License-Identifier: Apache-2.0 */
/* What 1 m^2 of a plate gives when it absorbs, mirrors or scatters all light; see plate_fit.h. */
#ifndef SRP_CLI_PLATE_COLUMNS_H
#define SRP_CLI_PLATE_COLUMNS_H

#include <srp/vec3.h>

/* Forces per m^2 of absorbing, specular and diffuse area, with the Sun at `s`. */
static inline void cli_plate_columns(srp_vec3 normal, srp_vec3 s, srp_vec3 column[3]) {
    double c = fmax(srp_vec3_dot(normal, s), 0.0);
    column[0] = srp_vec3_scale(-c, s);
    column[1] = srp_vec3_scale(-2.0 * c * c, normal);
    column[2] = srp_vec3_add_scaled(column[0], -2.0 / 3.0 * c, normal);
}

#endif
