/* SPDX-License-Identifier: Apache-2.0 */
/* A bus with a large open paraboloid: concave, two-sided, with parts that cut through each other.
 */
#include "model.h"
#include "models.h"
#include "write.h"

#include <srp/const.h>

#include <math.h>

enum { SEGMENTS = 48, RINGS = 12 };

static const double RIM = 1.6;       /* radius of the reflector [m] */
static const double FOCAL = 1.28;    /* focal length [m]: f/D = 0.4 */
static const double APEX = 0.85;     /* height of the apex [m] */
static const double FEED_RING = 0.1; /* radius at which the struts reach the feed [m] */

static double reflector_height(double r) {
    return APEX + r * r / (4.0 * FOCAL);
}

static void add_reflector(model *m, uint32_t material) {
    profile_point profile[RINGS + 1];
    for (int i = 0; i <= RINGS; ++i) {
        double r = RIM * (RINGS - i) / RINGS; /* rim to apex: the front faces +z */
        profile[i] = (profile_point){r, reflector_height(r)};
    }
    const frame body = frame_at(srp_vec3_make(0.0, 0.0, 0.0));
    model_part(m, "reflector");
    model_add_revolved(m, &body, profile, RINGS + 1, PROFILE_OPEN, SEGMENTS, material);
}

/* Feed horn at the focus, on three struts whose feet go through the reflector. */
static void add_feed(model *m, uint32_t horn, uint32_t strut) {
    const double focus = APEX + FOCAL;
    const double foot = 0.75 * RIM;
    const frame body = frame_at(srp_vec3_make(0.0, 0.0, 0.0));
    const profile_point profile[] = {
        {0.0, focus}, {0.12, focus}, {0.07, focus + 0.15}, {0.07, focus + 0.3}, {0.0, focus + 0.3}};
    model_part(m, "feed");
    model_add_revolved(m, &body, profile, 5, PROFILE_OPEN, 24, horn);
    model_part(m, "struts");
    for (int k = 0; k < 3; ++k) {
        double angle = 2.0 * SRP_PI * (k + 0.1) / 3.0;
        double c = cos(angle), s = sin(angle);
        model_add_rod(m, srp_vec3_make(foot * c, foot * s, reflector_height(foot) - 0.05),
                      srp_vec3_make(FEED_RING * c, FEED_RING * s, focus + 0.05), 0.015, 8, strut);
    }
}

void make_dish(const char *directory) {
    model m = model_make(
        "dish", "A bus under an open paraboloid of 3.2 m (two-sided, concave to +z), feed "
                "at the focus.\nThe struts go through the reflector, the pedestal into the bus.");
    uint32_t bus = model_add_material(&m, "bus", 0.28, 0.22);
    uint32_t reflector = model_add_material(&m, "reflector", 0.12, 0.64);
    uint32_t horn = model_add_material(&m, "feed", 0.21, 0.17);
    uint32_t carbon = model_add_material(&m, "carbon", 0.04, 0.06);
    const frame body = frame_at(srp_vec3_make(0.0, 0.0, 0.0));
    model_part(&m, "bus");
    model_add_block(&m, &body, srp_vec3_make(-0.7, -0.6, -0.5), srp_vec3_make(0.7, 0.6, 0.5), bus);
    model_part(&m, "pedestal");
    model_add_prism(&m, &body, 0.25, 0.45, 0.82, 24, carbon);
    add_reflector(&m, reflector);
    add_feed(&m, horn, carbon);
    write_model(&m, directory);
    model_clear(&m);
}
