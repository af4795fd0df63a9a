/* SPDX-License-Identifier: Apache-2.0 */
/* What tests of the propagator share: a sky, a list, an area model that is smooth. */
#ifndef SRP_TESTS_ORBIT_FIXTURE_H
#define SRP_TESTS_ORBIT_FIXTURE_H

#include "srp_check.h"

#include <srp/orbit/elements.h>
#include <srp/orbit/propagator.h>

#include <stdlib.h>
#include <string.h>

static const double FIXTURE_MU = 398600.4415e9, FIXTURE_RADIUS = 6378136.3;

static inline srp_ephemeris *fixture_sky(const char *date, double days) {
    srp_epoch epoch;
    srp_error error;
    srp_ephemeris *sky = NULL;
    assert_ok(srp_epoch_parse(date, &epoch, NULL, &error), error);
    srp_ephemeris_params params = srp_ephemeris_params_default(epoch);
    params.begin = -1000.0;
    params.end = days * 86400.0 + 1000.0;
    params.bodies |= 1u << SRP_MOON;
    assert_ok(srp_ephemeris_create(&params, &sky, &error), error);
    return sky;
}

static inline void fixture_add(srp_force_list *list, const srp_force *force) {
    srp_error error;
    assert_ok(srp_force_list_add(list, force, &error), error);
}

/* The Earth as a point, and with `others` the Sun and the Moon. */
static inline srp_force_list *fixture_list(const srp_ephemeris *sky, bool others) {
    srp_force_list *list = NULL;
    srp_force force;
    srp_error error;
    assert_ok(srp_force_list_create(sky, SRP_EARTH, &list, &error), error);
    assert_ok(srp_force_central(FIXTURE_MU, &force, &error), error);
    fixture_add(list, &force);
    for (int i = 0; others && i < 2; ++i) {
        const srp_celestial body = i == 0 ? SRP_SUN : SRP_MOON;
        assert_ok(srp_force_point_mass(body, srp_celestial_get(body)->mu, &force, &error), error);
        fixture_add(list, &force);
    }
    return list;
}

/* An area vector that turns with the body, with its derivatives: f = -(k + A s) (1 + c s_z^2). */
static const double FIXTURE_A[3][3] = {{21.0, 3.0, -1.0}, {2.0, 13.0, 4.0}, {-5.0, 1.0, 8.0}};

static inline int fixture_area(const void *user, srp_vec3 s, srp_vec3 *f, double (*df)[3]) {
    (void)user;
    const double c = 0.3, k = 1.0 + c * s.z * s.z, v[3] = {s.x, s.y, s.z};
    double value[3], full[3][3];
    for (int i = 0; i < 3; ++i) {
        const double linear =
            2.0 + FIXTURE_A[i][0] * s.x + FIXTURE_A[i][1] * s.y + FIXTURE_A[i][2] * s.z;
        value[i] = -linear * k;
        for (int j = 0; j < 3; ++j) {
            full[i][j] = -FIXTURE_A[i][j] * k - (j == 2 ? linear * 2.0 * c * s.z : 0.0);
        }
    }
    *f = srp_vec3_make(value[0], value[1], value[2]);
    for (int i = 0; df != NULL && i < 3; ++i) {
        const double along = full[i][0] * v[0] + full[i][1] * v[1] + full[i][2] * v[2];
        for (int j = 0; j < 3; ++j) {
            df[i][j] = full[i][j] - along * v[j];
        }
    }
    return 0;
}

/* Large enough to see: 5 times as light as a spacecraft would be. */
static inline srp_radiation_params fixture_radiation(const srp_attitude *attitude) {
    srp_radiation_params params = {.model = {"test", 0, fixture_area, NULL, NULL},
                                   .light = srp_sunlight_default(),
                                   .mass = 170.0,
                                   .scale = 1.1};
    params.shadow.sun_radius = 695990e3;
    params.shadow.count = 1;
    params.shadow.body[0] = SRP_EARTH;
    params.shadow.radius[0] = FIXTURE_RADIUS;
    if (attitude != NULL) {
        params.attitude = *attitude;
    } else {
        params.model.flags = SRP_AREA_MODEL_ROUND;
    }
    return params;
}

#endif
