/* SPDX-License-Identifier: Apache-2.0 */
/* The attitude of a mission from its file. */
#include "error.h"
#include "mission_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static srp_status fixed_attitude(const mission_source *source, const mission_attitude *in,
                                 bool spins, srp_attitude *out, srp_error *error) {
    double q[4] = {0, 0, 0, 1}, axis[3] = {0, 0, 1}, rate = 0.0;
    srp_status status = mission_values(source, "spacecraft.attitude.quaternion", in->quaternion,
                                       MISSION_NUMBER, 4, q, error);
    if (status == SRP_OK && spins) {
        status = mission_need(source, "spacecraft.attitude", in->rate, "rate", error);
    }
    if (status == SRP_OK) {
        status = mission_values(source, "spacecraft.attitude.axis", in->axis, MISSION_NUMBER, 3,
                                axis, error);
    }
    if (status == SRP_OK) {
        status = mission_values(source, "spacecraft.attitude.rate", in->rate, MISSION_RATE, 1,
                                &rate, error);
    }
    if (status != SRP_OK) {
        return status;
    }
    srp_error why;
    status =
        spins ? srp_attitude_spinner(q, srp_vec3_make(axis[0], axis[1], axis[2]), rate, out, &why)
              : srp_attitude_inertial(q, out, &why);
    return mission_at_entry(source, "spacecraft.attitude", status, &why, error);
}

static srp_status read_target(const mission_source *source, const char *path, const char *text,
                              srp_target *out, srp_error *error) {
    if (text == NULL || srp_target_find(text, out)) {
        return SRP_OK;
    }
    return mission_fail(source, error, SRP_BAD_DATA, path,
                        "found '%.80s', expected nadir, sun, velocity, orbit_normal or north",
                        text);
}

/* What the modes stand for, unless the file says otherwise. */
typedef struct preset {
    const char *mode;
    srp_attitude_pointing pointing;
} preset;

static const preset PRESETS[] = {
    {"nadir", {SRP_TARGET_NADIR, {0, 0, 1}, SRP_TARGET_ORBIT_NORMAL, {0, 1, 0}}},
    {"sun", {SRP_TARGET_SUN, {1, 0, 0}, SRP_TARGET_NORTH, {0, 0, 1}}},
    {"yaw_steering", {SRP_TARGET_NADIR, {0, 0, 1}, SRP_TARGET_SUN, {1, 0, 0}}},
};
enum { PRESET_COUNT = sizeof PRESETS / sizeof PRESETS[0] };

static srp_status pointing_attitude(const mission_source *source, const mission_attitude *in,
                                    srp_attitude_pointing pointing, srp_attitude *out,
                                    srp_error *error) {
    double align[3] = {pointing.align_body.x, pointing.align_body.y, pointing.align_body.z};
    double constrain[3] = {pointing.constrain_body.x, pointing.constrain_body.y,
                           pointing.constrain_body.z};
    srp_status status =
        read_target(source, "spacecraft.attitude.align", in->align, &pointing.align, error);
    if (status == SRP_OK) {
        status = read_target(source, "spacecraft.attitude.constrain", in->constrain,
                             &pointing.constrain, error);
    }
    if (status == SRP_OK) {
        status = mission_values(source, "spacecraft.attitude.align_body", in->align_body,
                                MISSION_NUMBER, 3, align, error);
    }
    if (status == SRP_OK) {
        status = mission_values(source, "spacecraft.attitude.constrain_body", in->constrain_body,
                                MISSION_NUMBER, 3, constrain, error);
    }
    if (status != SRP_OK) {
        return status;
    }
    pointing.align_body = srp_vec3_make(align[0], align[1], align[2]);
    pointing.constrain_body = srp_vec3_make(constrain[0], constrain[1], constrain[2]);
    srp_error why;
    status = srp_attitude_pointing_create(&pointing, out, &why);
    return mission_at_entry(source, "spacecraft.attitude", status, &why, error);
}

/* A file that ends before the mission does is told before the work. */
static srp_status check_span(const mission_site *site, const srp_attitude *attitude,
                             srp_error *error) {
    const srp_mission_info *info = &site->mission->info;
    const double ends[] = {0.0, info->duration};
    for (int i = 0; i < 2; ++i) {
        const srp_force_state state = {.t = ends[i]};
        double matrix[3][3];
        if (attitude->eval(attitude->user, &state, matrix) != 0) {
            char date[SRP_EPOCH_TEXT_SIZE];
            srp_epoch_format(srp_epoch_add(info->epoch, ends[i]), info->scale, 3, date);
            return mission_fail(site->source, error, SRP_BAD_DATA, "spacecraft.attitude.file",
                                "%s has no attitude for %s %s, the %s of the mission",
                                info->attitude_file, date, srp_time_scale_name(info->scale),
                                i == 0 ? "begin" : "end");
        }
    }
    return SRP_OK;
}

static srp_status file_attitude(const mission_site *site, const mission_attitude *in,
                                srp_attitude *out, srp_error *error) {
    const mission_source *source = site->source;
    srp_mission_info *info = &site->mission->info;
    srp_error why;
    srp_status status = mission_need(source, "spacecraft.attitude", in->file, "file", error);
    if (status == SRP_OK) {
        status = mission_path(site, MISSION_TEXT_ATTITUDE, in->file, &info->attitude_file, error);
    }
    if (status != SRP_OK) {
        return status;
    }
    status = srp_attitude_aem_read(info->attitude_file, info->epoch, out, &why);
    status = mission_at_file(source, "spacecraft.attitude.file", status, &why, error);
    if (status == SRP_OK) {
        status = check_span(site, out, error);
        if (status != SRP_OK) {
            srp_attitude_release(out);
        }
    }
    return status;
}

/* Entries that each kind of mode uses. */
static void warn_of_unused(const mission_site *site, const mission_attitude *in, bool fixed,
                           bool pointing) {
    const bool spins = strcmp(in->mode, "spinner") == 0, file = strcmp(in->mode, "aem") == 0;
    const mission_key keys[] = {{"quaternion", fixed ? NULL : in->quaternion},
                                {"axis", spins ? NULL : in->axis},
                                {"rate", spins ? NULL : in->rate},
                                {"file", file ? NULL : in->file},
                                {"align", pointing ? NULL : in->align},
                                {"align_body", pointing ? NULL : in->align_body},
                                {"constrain", pointing ? NULL : in->constrain},
                                {"constrain_body", pointing ? NULL : in->constrain_body}};
    char what[80];
    snprintf(what, sizeof what, "mode %.60s", in->mode);
    mission_warn_unused(site, "spacecraft.attitude", what, sizeof keys / sizeof keys[0], keys);
}

srp_status mission_build_attitude(const mission_site *site, srp_attitude *out, srp_error *error) {
    const mission_source *source = site->source;
    const mission_attitude *in = mission_source_file(source)->spacecraft->attitude;
    if (in == NULL) {
        return mission_fail(
            source, error, SRP_BAD_FORMAT, "spacecraft",
            "'attitude' is missing here: this model of radiation pressure needs one");
    }
    if (strcmp(in->mode, "inertial") == 0 || strcmp(in->mode, "spinner") == 0) {
        warn_of_unused(site, in, true, false);
        return fixed_attitude(source, in, in->mode[0] == 's', out, error);
    }
    for (size_t i = 0; i < PRESET_COUNT; ++i) {
        if (strcmp(in->mode, PRESETS[i].mode) == 0) {
            warn_of_unused(site, in, false, true);
            return pointing_attitude(source, in, PRESETS[i].pointing, out, error);
        }
    }
    if (strcmp(in->mode, "aem") == 0) {
        warn_of_unused(site, in, false, false);
        return file_attitude(site, in, out, error);
    }
    return mission_fail(
        source, error, SRP_BAD_DATA, "spacecraft.attitude.mode",
        "found '%.80s', expected inertial, spinner, nadir, sun, yaw_steering or aem", in->mode);
}
