/* SPDX-License-Identifier: Apache-2.0 */
/* A program of someone else with the propagator: a circular orbit comes back after its period. */
#include <srp/orbit/mission.h>

#include <stdio.h>
#include <string.h>

int main(void) {
    /* mu = 4e14 m^3/s^2, r = 1e7 m: v = sqrt(mu / r), period = 2 pi sqrt(r^3 / mu). */
    static const char TEXT[] = "epoch: 2024-03-20T00:00:00 TT\nduration: 9934.588265796101 s\n"
                               "state: {position: 10000 0 0 km, velocity: 0 6.324555320336759 0 "
                               "km/s}\nspacecraft: {mass: 1 kg}\n"
                               "constants: {mu: {earth: 400000 km3/s2}}\n";
    srp_mission *mission = NULL;
    srp_mission_summary summary;
    srp_error error;
    if (srp_mission_parse(TEXT, strlen(TEXT), "circle.yaml", NULL, &mission, &error) != SRP_OK ||
        srp_mission_run(mission, NULL, &summary, &error) != SRP_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    const double off = srp_vec3_norm(srp_vec3_sub(summary.r, srp_vec3_make(1e7, 0.0, 0.0)));
    printf("%llu steps, %.3g m from where it began\n", (unsigned long long)summary.counts.steps,
           off);
    srp_mission_destroy(mission);
    return off < 1e-3 ? 0 : 1;
}
