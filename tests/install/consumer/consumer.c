/* SPDX-License-Identifier: Apache-2.0 */
/* The force of sunlight on one plate that faces it: -A (1 + rho_s + 2/3 rho_d) s. */
#include <srp/method.h>
#include <srp/plates.h>
#include <srp/scene.h>

#include <math.h>
#include <stdio.h>

int main(void) {
    const srp_plate plate = {{1.0, 0.0, 0.0}, 3.7, {0.31, 0.23, false}};
    const srp_vec3 s = {1.0, 0.0, 0.0};
    const double want = -3.7 * (1.0 + 0.31 + 2.0 / 3.0 * 0.23);
    srp_error error;
    srp_scene *scene = NULL;
    srp_prepared *prepared = NULL;
    srp_response response;
    srp_method_params params = srp_method_params_default();
    if (srp_scene_from_plates(&plate, 1, &scene, &error) != SRP_OK ||
        srp_method_prepare(&srp_method_nplate, scene, &params, &prepared, &error) != SRP_OK ||
        srp_prepared_respond(prepared, 1, &s, &response, NULL, &error) != SRP_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
    printf("f = %.15g m^2, expected %.15g\n", response.f.x, want);
    return fabs(response.f.x - want) < 1e-14 ? 0 : 1;
}
