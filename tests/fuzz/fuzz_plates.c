/* SPDX-License-Identifier: Apache-2.0 */
/* Plates file to plates, on to a scene. */
#include "fuzz.h"

#include <srp/scene.h>

#include <math.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const char *text = (const char *)data;
    srp_plate *plates, *again;
    size_t count, count_again;
    srp_error error;
    srp_status status = srp_plates_parse(text, size, "fuzz", &plates, &count, &error);
    if (status != SRP_OK) {
        REQUIRE(status == SRP_BAD_FORMAT || status == SRP_BAD_DATA);
        REQUIRE(error.message[0] != '\0');
        return 0;
    }
    REQUIRE(count > 0);
    for (size_t i = 0; i < count; ++i) {
        REQUIRE(fabs(srp_vec3_norm(plates[i].normal) - 1.0) < 1e-15);
        REQUIRE(plates[i].area > 0.0 && isfinite(plates[i].area));
        REQUIRE(srp_optics_check(plates[i].optics, NULL) == SRP_OK);
    }
    REQUIRE(srp_plates_parse(text, size, "fuzz", &again, &count_again, &error) == SRP_OK);
    REQUIRE(count == count_again);
    for (size_t i = 0; i < count; ++i) {
        srp_vec3 a = plates[i].normal, b = again[i].normal;
        REQUIRE(a.x == b.x && a.y == b.y && a.z == b.z && plates[i].area == again[i].area);
        REQUIRE(plates[i].optics.rho_s == again[i].optics.rho_s);
        REQUIRE(plates[i].optics.rho_d == again[i].optics.rho_d);
    }
    srp_scene *scene;
    REQUIRE(srp_scene_from_plates(plates, count, &scene, &error) == SRP_OK);
    srp_scene_destroy(scene);
    srp_plates_free(plates);
    srp_plates_free(again);
    return 0;
}
