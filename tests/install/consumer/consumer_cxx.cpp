// SPDX-License-Identifier: Apache-2.0
// The headers are usable from C++, and link to the C library.
#include <srp/interp.h>
#include <srp/method.h>
#include <srp/scene.h>
#include <srp/sunlight.h>
#include <srp/table.h>

#include <cstdio>

int main() {
    srp_scene *scene = nullptr;
    srp_error error;
    if (srp_scene_from_sphere(1.25, 55.7, &scene, &error) != SRP_OK) {
        std::fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    std::printf("facets %zu, pressure %.9g N/m^2\n", srp_scene_facet_count(scene),
                srp_sunlight_pressure(srp_sunlight_default(), SRP_AU));
    srp_scene_destroy(scene);
    return 0;
}
