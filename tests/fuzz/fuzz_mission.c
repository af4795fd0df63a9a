/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A mission file: held against the schema; and, where that is cheap, read with all that it names
 * and run for some steps. It finds files in SRP_FUZZ_FILES only (cube.obj, cube.plates, coarse.spo,
 * field.gfc, two.aem); the readers of these have targets of their own.
 */
#include "fuzz.h"
#include "mission_internal.h"

#include <srp/const.h>

#include <gsl/gsl_errno.h>

static void check_entries(const mission_source *source) {
    const mission_file *file = mission_source_file(source);
    REQUIRE(file->epoch != NULL && file->duration != NULL && file->spacecraft->mass != NULL);
    for (int kind = 0; kind < MISSION_KIND_COUNT; ++kind) {
        double value[4];
        srp_error error;
        srp_status status = mission_values(source, "duration", file->duration, (mission_kind)kind,
                                           1, value, &error);
        REQUIRE(status == SRP_OK || (status == SRP_BAD_FORMAT && error.line > 0));
    }
}

/* ---- What is cheap --------------------------------------------------------------------------- */

static bool is_short(const char *text, size_t most) {
    return text == NULL || strlen(text) <= most;
}

/* A name in the directory of the mission. */
static bool is_near(const char *file) {
    return file == NULL || strchr(file, '/') == NULL;
}

static bool is_coarse(const mission_source *source, const char *step) {
    double angle = SRP_PI;
    srp_error error;
    srp_status status = mission_values(source, "", step, MISSION_ANGLE, 1, &angle, &error);
    return status != SRP_OK || angle > 0.05;
}

static bool radiation_is_cheap(const mission_source *source, const mission_radiation *in) {
    double pixel = 1.0;
    srp_error error;
    srp_status status = mission_values(source, "", in->pixel, MISSION_LENGTH, 1, &pixel, &error);
    return is_near(in->file) && is_short(in->grid, 2) && is_short(in->max_grid, 2) &&
           is_short(in->diffuse, 1) && is_short(in->reflections, 1) && is_short(in->threads, 1) &&
           is_short(in->beams, 3) && (status != SRP_OK || pixel > 0.01) &&
           is_coarse(source, in->step) && is_coarse(source, in->az_step) &&
           is_coarse(source, in->el_step);
}

static bool is_cheap(const mission_source *source) {
    const mission_file *file = mission_source_file(source);
    const mission_forces *forces = file->forces;
    const mission_attitude *attitude = file->spacecraft->attitude;
    double duration = 0.0;
    srp_error error;
    srp_status status =
        mission_values(source, "", file->duration, MISSION_TIME, 1, &duration, &error);
    return (status != SRP_OK || duration < 1e6) && (attitude == NULL || is_near(attitude->file)) &&
           (forces == NULL ||
            ((forces->gravity == NULL || is_near(forces->gravity->file)) &&
             (forces->radiation == NULL || radiation_is_cheap(source, forces->radiation))));
}

/* ---- Reading and running --------------------------------------------------------------------- */

static bool few_steps(void *user, double done) {
    (void)done;
    return ++*(int *)user < 20;
}

static void run(const srp_mission *mission) {
    int steps = 0;
    const srp_mission_watch watch = {NULL, NULL, few_steps, &steps};
    srp_mission_summary summary;
    srp_error error;
    srp_status status = srp_mission_run(mission, &watch, &summary, &error);
    REQUIRE(status == SRP_OK || (error.status == status && error.message[0] != '\0'));
    REQUIRE(status != SRP_OK || srp_vec3_is_finite(summary.r));
}

static void read_all(const char *text, size_t size) {
    srp_mission *mission = NULL;
    srp_error error;
    srp_status status =
        srp_mission_parse(text, size, SRP_FUZZ_FILES "/fuzz.yaml", NULL, &mission, &error);
    if (status == SRP_OK) {
        run(mission);
        srp_mission_destroy(mission);
        return;
    }
    REQUIRE(status == SRP_BAD_FORMAT || status == SRP_BAD_DATA || status == SRP_NOT_FOUND ||
            status == SRP_UNSUPPORTED || status == SRP_IO);
    REQUIRE(error.message[0] != '\0' && error.file[0] != '\0' && error.line > 0);
    REQUIRE(mission == NULL);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const char *text = (const char *)data;
    mission_source *source = NULL;
    srp_error error;
    gsl_set_error_handler_off();
    srp_status status = mission_source_open(text, size, "fuzz", &source, &error);
    if (status != SRP_OK) {
        REQUIRE(status == SRP_BAD_FORMAT);
        REQUIRE(error.message[0] != '\0' && error.line > 0 && source == NULL);
        return 0;
    }
    check_entries(source);
    const bool cheap = is_cheap(source);
    mission_source_close(source);
    if (cheap) {
        read_all(text, size);
    }
    return 0;
}
