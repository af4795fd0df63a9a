/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Every constructor of the propagator meets the end of memory at each of its allocations in turn:
 * it answers SRP_NO_MEMORY, leaves its out parameter alone and gives back all that it took.
 */
#include "failing_alloc.h"
#include "orbit_fixture.h"

#include <srp/orbit/mission.h>

#include <gsl/gsl_errno.h>
#include <stdio.h>

static srp_ephemeris *sky;
static srp_force_list *list;

static void set_up(void) {
    gsl_set_error_handler_off();
    sky = fixture_sky("2024-03-20 UTC", 0.1);
    list = fixture_list(sky, true);
}

static void tear_down(void) {
    srp_force_list_destroy(list);
    srp_ephemeris_destroy(sky);
}

/* ---- What is tried -----------------------------------------------------------------------------
 */

static srp_status try_ephemeris(srp_error *error) {
    srp_ephemeris_params params = srp_ephemeris_params_default(srp_ephemeris_epoch(sky));
    srp_ephemeris *out = NULL;
    params.orientation = true;
    srp_status status = srp_ephemeris_create(&params, &out, error);
    const bool right = (status == SRP_OK) == (out != NULL);
    srp_ephemeris_destroy(out);
    return right ? status : SRP_MISMATCH; /* libcheck's own asserts allocate, too */
}

static srp_status try_list(srp_error *error) {
    srp_force_list *out = NULL;
    srp_status status = srp_force_list_create(sky, SRP_EARTH, &out, error);
    for (int i = 0; status == SRP_OK && i < 6; ++i) {
        srp_force force = {"untouched", 0, NULL, NULL, NULL};
        status = srp_force_central(1e14, &force, error);
        if (status == SRP_OK) {
            status = srp_force_list_add(out, &force, error);
            if (status != SRP_OK) {
                srp_force_release(&force);
            }
        }
    }
    srp_force_list_destroy(out);
    return status;
}

static srp_status try_gravity(srp_error *error) {
    static const char TEXT[] =
        "earth_gravity_constant 4e14\nradius 6e6\nend_of_head\ngfc 2 0 1e-3 0\n";
    srp_gravity *out = NULL;
    srp_force force;
    srp_status status = srp_gravity_parse(TEXT, sizeof TEXT - 1, "t", 2, 2, NULL, &out, error);
    if (status == SRP_OK) {
        status = srp_force_gravity(out, sky, &force, error);
        if (status == SRP_OK) {
            srp_force_release(&force);
        }
    }
    srp_gravity_destroy(out);
    return status;
}

static srp_status try_radiation(srp_error *error) {
    const double q[4] = {0, 0, 0, 1};
    srp_attitude attitude = {"none", 0, NULL, NULL, NULL};
    srp_force force;
    srp_status status = srp_attitude_spinner(q, srp_vec3_make(0, 0, 1), 0.1, &attitude, error);
    srp_radiation_params params = fixture_radiation(&attitude);
    if (status == SRP_OK) {
        status = srp_area_model_cannonball(1.2, 3.0, &params.model, error);
        if (status != SRP_OK) {
            params.model.destroy = NULL;
        }
    }
    if (status == SRP_OK) {
        status = srp_force_radiation(&params, &force, error);
        if (status == SRP_OK) {
            srp_force_release(&force);
            return status;
        }
    }
    if (params.model.destroy != NULL) {
        srp_area_model_release(&params.model);
    }
    srp_attitude_release(&params.attitude);
    return status;
}

static srp_status try_aem(srp_error *error) {
    char text[6000];
    int used =
        sprintf(text, "CCSDS_AEM_VERS = 1.0\nMETA_START\nREF_FRAME_A = EME2000\nREF_FRAME_B = "
                      "SC\nTIME_SYSTEM = TT\nATTITUDE_TYPE = QUATERNION\nMETA_STOP\n");
    for (int i = 0; i < 59; ++i) {
        used += sprintf(text + used, "2024-03-20T00:%02d:00 0 0 0 1\n", i);
    }
    srp_attitude out = {"untouched", 0, NULL, NULL, NULL};
    srp_status status =
        srp_attitude_aem_parse(text, (size_t)used, "t", srp_ephemeris_epoch(sky), &out, error);
    if (status == SRP_OK) {
        srp_attitude_release(&out);
        return status;
    }
    return strcmp(out.name, "untouched") == 0 ? status : SRP_MISMATCH;
}

static srp_status try_propagator(srp_error *error) {
    const srp_propagator_params params = srp_propagator_params_default();
    srp_propagator *out = NULL;
    srp_status status = srp_propagator_create(list, &params, &out, error);
    srp_propagator_destroy(out);
    return status;
}

#ifdef SRP_HAS_MISSIONS
#define HEAD                                                                                       \
    "epoch: 2024-03-20 TT\nduration: 1 h\nspacecraft: {mass: 9 kg, attitude: {mode: sun}}\n"       \
    "state: {position: 7000 0 0 km, velocity: 0 7.5 0 km/s}\n"

/* libcyaml's and libyaml's own allocations are not ours. */
static srp_status try_mission(srp_error *error) {
    static const char TEXT[] = HEAD
        "forces: {point_masses: [sun, moon], radiation: {model: plates, file: box-wing.plates}}\n";
    srp_mission *out = NULL;
    srp_mission_file *file = NULL;
    srp_status status =
        srp_mission_parse(TEXT, sizeof TEXT - 1, SRP_MODELS_DIR "/t.yaml", NULL, &out, error);
    if (status == SRP_OK) {
        status = srp_oem_begin("alloc.oem", out, "2024-01-01T00:00:00", &file, error);
        if (status == SRP_OK) {
            srp_mission_file_abandon(file);
        }
    }
    srp_mission_destroy(out);
    return status;
}

static srp_status try_on_demand(srp_error *error) {
    static const char TEXT[] =
        HEAD "forces: {radiation: {model: on_demand, file: cube.obj, step: 30 deg, threads: 1}}\n";
    srp_mission *out = NULL;
    srp_status status =
        srp_mission_parse(TEXT, sizeof TEXT - 1, SRP_MODELS_DIR "/t.yaml", NULL, &out, error);
    const bool right = (status == SRP_OK) == (out != NULL);
    srp_mission_destroy(out);
    return right ? status : SRP_MISMATCH;
}
#endif

static const struct {
    const char *name;
    srp_status (*try)(srp_error *error);
} TRIES[] = {
    {"ephemeris", try_ephemeris},
    {"list", try_list},
    {"gravity", try_gravity},
    {"radiation", try_radiation},
    {"aem", try_aem},
    {"propagator", try_propagator},
#ifdef SRP_HAS_MISSIONS
    {"mission", try_mission},
    {"on_demand", try_on_demand},
#endif
};

static srp_status run_try(void *user, srp_error *error) {
    const int *which = user;
    return TRIES[*which].try(error);
}

START_TEST(the_end_of_memory_is_survived) {
    srp_error error;
    ck_assert_int_eq(TRIES[_i].try(&error), SRP_OK); /* whatever is kept for later is there now */
    failing_alloc_exhaust(TRIES[_i].name, run_try, &_i);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("orbit_alloc_failure");
    TCase *all = tcase_create("alloc_failure");
    tcase_add_checked_fixture(all, set_up, tear_down);
    tcase_add_loop_test(all, the_end_of_memory_is_survived, 0, sizeof TRIES / sizeof TRIES[0]);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
