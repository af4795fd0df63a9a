/* SPDX-License-Identifier: Apache-2.0 */
#include <srp/response.h>

void srp_basis_apply(const srp_basis *basis, srp_optics optics, srp_vec3 s, srp_vec3 *f,
                     srp_vec3 *t) {
    double along = 1.0 - optics.rho_s;
    double specular = 2.0 * optics.rho_s;
    double diffuse = 2.0 / 3.0 * optics.rho_d;

    srp_vec3 push = srp_vec3_scale(along * basis->a, s);
    push = srp_vec3_add_scaled(push, specular, basis->b);
    push = srp_vec3_add_scaled(push, diffuse, basis->c);
    *f = srp_vec3_sub(*f, push);

    srp_vec3 turn = srp_vec3_scale(along, srp_vec3_cross(basis->ra, s));
    turn = srp_vec3_add_scaled(turn, specular, basis->rb);
    turn = srp_vec3_add_scaled(turn, diffuse, basis->rc);
    *t = srp_vec3_sub(*t, turn);
}

void srp_basis_partials(const srp_basis *basis, srp_vec3 s, srp_partials *out) {
    out->f_rho_s = srp_vec3_add_scaled(srp_vec3_scale(basis->a, s), -2.0, basis->b);
    out->f_rho_d = srp_vec3_scale(-2.0 / 3.0, basis->c);
    out->t_rho_s = srp_vec3_add_scaled(srp_vec3_cross(basis->ra, s), -2.0, basis->rb);
    out->t_rho_d = srp_vec3_scale(-2.0 / 3.0, basis->rc);
}
