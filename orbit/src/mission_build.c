/* SPDX-License-Identifier: Apache-2.0 */
/* The forces of a mission from its file. */
#include "error.h"
#include "mat3.h"
#include "mission_internal.h"

#include <srp/scene.h>
#include <srp/table.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Attitude -------------------------------------------------------------------------------- */

/* Tells an error of a constructor at an entry of the mission; one that has a file keeps it. */
static srp_status at_entry(const mission_source *source, const char *path, srp_status status,
                           const srp_error *why, srp_error *error) {
    if (status == SRP_OK || status == SRP_NO_MEMORY || why->file[0] != '\0') {
        if (status != SRP_OK && error != NULL) {
            *error = *why;
        }
        return status;
    }
    return mission_fail(source, error, SRP_BAD_DATA, path, "%s", why->message);
}

/* A file that cannot be opened, or is wrong as a whole, is told at the entry that names it. */
static srp_status at_file(const mission_source *source, const char *path, srp_status status,
                          const srp_error *why, srp_error *error) {
    if (status == SRP_NOT_FOUND || status == SRP_IO ||
        (status != SRP_OK && why->file[0] != '\0' && why->line == 0)) {
        return mission_fail(source, error, status, path, "%s: %s", why->file, why->message);
    }
    return at_entry(source, path, status, why, error);
}

static srp_status need(const mission_source *source, const char *path, const char *text,
                       const char *key, srp_error *error) {
    return text != NULL
               ? SRP_OK
               : mission_fail(source, error, SRP_BAD_FORMAT, path, "'%s' is missing here", key);
}

static srp_status fixed_attitude(const mission_source *source, const mission_attitude *in,
                                 bool spins, srp_attitude *out, srp_error *error) {
    double q[4] = {0, 0, 0, 1}, axis[3] = {0, 0, 1}, rate = 0.0;
    srp_status status = mission_values(source, "spacecraft.attitude.quaternion", in->quaternion,
                                       MISSION_NUMBER, 4, q, error);
    if (status == SRP_OK && spins) {
        status = need(source, "spacecraft.attitude", in->rate, "rate", error);
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
    return at_entry(source, "spacecraft.attitude", status, &why, error);
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
    return at_entry(source, "spacecraft.attitude", status, &why, error);
}

static srp_status file_attitude(const mission_source *source, const srp_mission *mission,
                                const mission_attitude *in, srp_attitude *out, srp_error *error) {
    srp_status status = need(source, "spacecraft.attitude", in->file, "file", error);
    if (status != SRP_OK) {
        return status;
    }
    srp_error why;
    char *path = mission_beside(mission_source_name(source), in->file);
    if (path == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a file name");
    }
    status = srp_attitude_aem_read(path, mission->info.epoch, out, &why);
    free(path);
    return at_file(source, "spacecraft.attitude.file", status, &why, error);
}

srp_status mission_build_attitude(const mission_source *source, const srp_mission *mission,
                                  srp_attitude *out, srp_error *error) {
    const mission_attitude *in = mission_source_file(source)->spacecraft->attitude;
    if (in == NULL) {
        return mission_fail(
            source, error, SRP_BAD_FORMAT, "spacecraft",
            "'attitude' is missing here: this model of radiation pressure needs one");
    }
    if (strcmp(in->mode, "inertial") == 0 || strcmp(in->mode, "spinner") == 0) {
        return fixed_attitude(source, in, in->mode[0] == 's', out, error);
    }
    for (size_t i = 0; i < PRESET_COUNT; ++i) {
        if (strcmp(in->mode, PRESETS[i].mode) == 0) {
            return pointing_attitude(source, in, PRESETS[i].pointing, out, error);
        }
    }
    if (strcmp(in->mode, "aem") == 0) {
        return file_attitude(source, mission, in, out, error);
    }
    return mission_fail(
        source, error, SRP_BAD_DATA, "spacecraft.attitude.mode",
        "found '%.80s', expected inertial, spinner, nadir, sun, yaw_steering or aem", in->mode);
}

/* ---- Area models ----------------------------------------------------------------------------- */

static srp_status cannonball(const mission_source *source, const mission_radiation *in,
                             srp_area_model *out, srp_error *error) {
    double cr = 0.0, area = 0.0;
    srp_error why;
    srp_status status = need(source, "forces.radiation", in->cr, "cr", error);
    if (status == SRP_OK) {
        status = need(source, "forces.radiation", in->area, "area", error);
    }
    if (status == SRP_OK) {
        status =
            mission_values(source, "forces.radiation.cr", in->cr, MISSION_NUMBER, 1, &cr, error);
    }
    if (status == SRP_OK && cr < 0.0) {
        return mission_fail(source, error, SRP_BAD_DATA, "forces.radiation.cr",
                            "'%s', expected 0 or more", in->cr);
    }
    if (status == SRP_OK) {
        status =
            mission_positive(source, "forces.radiation.area", in->area, MISSION_AREA, &area, error);
    }
    if (status != SRP_OK) {
        return status;
    }
    status = srp_area_model_cannonball(cr, area, out, &why);
    return at_entry(source, "forces.radiation", status, &why, error);
}

/* From a table that has been read. */
static srp_status of_table(const mission_source *source, const mission_radiation *in,
                           const srp_table *table, srp_area_model *out, srp_error *error) {
    const char *name = in->interpolation != NULL ? in->interpolation : "spline";
    srp_error why;
    srp_interp *interp = NULL;
    if (!srp_table_is_complete(table)) {
        return mission_fail(source, error, SRP_BAD_DATA, "forces.radiation.file",
                            "the table is not complete");
    }
    if (srp_table_pull_share(table) > SRP_TABLE_PULL_LIMIT) {
        return mission_fail(source, error, SRP_BAD_DATA, "forces.radiation.file",
                            "its forces pull towards the Sun: it follows the opposite sign "
                            "convention, srp convert --flip turns it round");
    }
    if (strcmp(name, "gmat_bilinear") == 0 || strcmp(name, "gmat_bicubic") == 0) {
        srp_status status =
            srp_area_model_spad(table, strcmp(name, "gmat_bicubic") == 0, out, &why);
        return at_entry(source, "forces.radiation.file", status, &why, error);
    }
    const srp_interp_scheme *scheme = srp_interp_find(name);
    if (scheme == NULL) {
        return mission_fail(source, error, SRP_BAD_DATA, "forces.radiation.interpolation",
                            "found '%.80s', expected bilinear, bicubic, spline, gmat_bilinear or "
                            "gmat_bicubic",
                            name);
    }
    srp_status status = srp_interp_create(scheme, table, &interp, &why);
    if (status == SRP_OK) {
        status = srp_area_model_interp(interp, out, &why);
        if (status != SRP_OK) {
            srp_interp_destroy(interp);
        }
    }
    return at_entry(source, "forces.radiation.file", status, &why, error);
}

static srp_status from_table(const mission_source *source, const mission_radiation *in,
                             const char *path, srp_area_model *out, srp_error *error) {
    srp_error why;
    srp_table *table = NULL;
    const srp_table_format *format = srp_table_format_of(path);
    if (format == NULL) {
        return mission_fail(source, error, SRP_BAD_DATA, "forces.radiation.file",
                            "'%.200s' is no name of a table, expected .nc, .spo or .txt", in->file);
    }
    srp_status status = srp_table_read(format, path, &table, &why);
    status = at_file(source, "forces.radiation.file", status, &why, error);
    if (status == SRP_OK) {
        status = of_table(source, in, table, out, error);
    }
    srp_table_destroy(table);
    return status;
}

/* A scene that is asked at each call: plates, or a mesh for those who have the time. */
static srp_status from_scene(const mission_source *source, const mission_radiation *in,
                             const char *path, const srp_log *log, srp_mission *mission,
                             srp_area_model *out, srp_error *error) {
    const bool plates = strcmp(in->model, "plates") == 0;
    srp_method_params params = srp_method_params_default();
    srp_error why;
    srp_status status;
    params.threads = 1;
    if (plates) {
        srp_plate *list = NULL;
        size_t count;
        status = srp_plates_read(path, &list, &count, &why);
        if (status == SRP_OK) {
            status = srp_scene_from_plates(list, count, &mission->scene, &why);
        }
        srp_plates_free(list);
    } else {
        status = srp_scene_read_obj(&path, 1, NULL, NULL, log, &mission->scene, &why);
    }
    status = at_file(source, "forces.radiation.file", status, &why, error);
    if (status != SRP_OK) {
        return status;
    }
    status = srp_method_prepare(plates ? &srp_method_nplate : &srp_method_exact, mission->scene,
                                &params, &mission->prepared, &why);
    if (status == SRP_OK) {
        status = srp_area_model_direct(mission->prepared, out, &why);
    }
    return at_entry(source, "forces.radiation.file", status, &why, error);
}

/* Tables that are filled while the orbit asks for them belong here: an area model like the others,
 * whose eval looks its nodes up and computes those that are missing. */
static srp_status on_demand(const mission_source *source, srp_error *error) {
    return mission_fail(source, error, SRP_UNSUPPORTED, "forces.radiation.model",
                        "tables on demand are not there yet: make one with 'srp table MODEL.obj -o "
                        "TABLE.nc' and say 'model: table', or say 'model: direct'");
}

static srp_status area_model(const mission_source *source, const mission_radiation *in,
                             const srp_log *log, srp_mission *mission, srp_area_model *out,
                             srp_error *error) {
    if (strcmp(in->model, "cannonball") == 0) {
        return cannonball(source, in, out, error);
    }
    if (strcmp(in->model, "on_demand") == 0) {
        return on_demand(source, error);
    }
    const bool table = strcmp(in->model, "table") == 0;
    if (!table && strcmp(in->model, "plates") != 0 && strcmp(in->model, "direct") != 0) {
        return mission_fail(
            source, error, SRP_BAD_DATA, "forces.radiation.model",
            "found '%.80s', expected cannonball, plates, table, direct or on_demand", in->model);
    }
    srp_status status = need(source, "forces.radiation", in->file, "file", error);
    if (status != SRP_OK) {
        return status;
    }
    char *path = mission_beside(mission_source_name(source), in->file);
    if (path == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a file name");
    }
    status = table ? from_table(source, in, path, out, error)
                   : from_scene(source, in, path, log, mission, out, error);
    free(path);
    return status;
}

/* ---- Radiation ------------------------------------------------------------------------------- */

static srp_status shadow_of(const mission_source *source, const mission_radiation *in,
                            const srp_mission *mission, srp_shadow *out, srp_error *error) {
    *out = (srp_shadow){.sun_radius = mission->radius[SRP_SUN]};
    srp_status status = mission_positive(source, "forces.radiation.sun_radius", in->sun_radius,
                                         MISSION_LENGTH, &out->sun_radius, error);
    if (in->shadow == NULL && mission->info.central != SRP_SUN) {
        out->count = 1;
        out->body[0] = mission->info.central;
        out->radius[0] = mission->radius[mission->info.central];
    }
    for (unsigned i = 0; status == SRP_OK && i < in->shadow_count; ++i) {
        char path[64];
        srp_celestial body = SRP_SUN;
        snprintf(path, sizeof path, "forces.radiation.shadow.%u", i);
        if (!srp_celestial_find(in->shadow[i], &body) || body == SRP_SUN) {
            return mission_fail(source, error, SRP_BAD_DATA, path,
                                "'%.80s' is no body that may stand before the Sun", in->shadow[i]);
        }
        for (size_t k = 0; k < out->count; ++k) {
            if (out->body[k] == body) {
                return mission_fail(source, error, SRP_BAD_DATA, path, "'%s' is given twice",
                                    in->shadow[i]);
            }
        }
        out->body[out->count] = body;
        out->radius[out->count++] = mission->radius[body];
    }
    return status;
}

static srp_status add(srp_mission *mission, srp_force *force, srp_error *error) {
    srp_status status = srp_force_list_add(mission->forces, force, error);
    if (status != SRP_OK) {
        srp_force_release(force);
    }
    return status;
}

static srp_status fill_radiation(const mission_source *source, const mission_radiation *in,
                                 const srp_log *log, srp_mission *mission,
                                 srp_radiation_params *params, srp_error *error) {
    params->light = srp_sunlight_default();
    params->mass = mission->mass;
    params->scale = 1.0;
    srp_status status = shadow_of(source, in, mission, &params->shadow, error);
    if (status == SRP_OK) {
        status = mission_positive(source, "forces.radiation.flux", in->flux, MISSION_FLUX,
                                  &params->light.flux, error);
    }
    if (status == SRP_OK) {
        status = mission_positive(source, "forces.radiation.au", in->au, MISSION_LENGTH,
                                  &params->light.au, error);
    }
    if (status == SRP_OK) {
        status = mission_values(source, "forces.radiation.scale", in->scale, MISSION_NUMBER, 1,
                                &params->scale, error);
    }
    if (status == SRP_OK) {
        status = area_model(source, in, log, mission, &params->model, error);
    }
    if (status == SRP_OK && (params->model.flags & SRP_AREA_MODEL_ROUND) == 0) {
        status = mission_build_attitude(source, mission, &params->attitude, error);
    }
    return status;
}

static srp_status add_radiation(const mission_source *source, const srp_log *log,
                                srp_mission *mission, srp_error *error) {
    const mission_radiation *in = mission_source_file(source)->forces->radiation;
    srp_radiation_params params = {.scale = 1.0};
    srp_force force;
    srp_error why;
    srp_status status = fill_radiation(source, in, log, mission, &params, error);
    if (status == SRP_OK) {
        status = srp_force_radiation(&params, &force, &why);
        status = at_entry(source, "forces.radiation", status, &why, error);
    }
    if (status != SRP_OK) {
        srp_area_model_release(&params.model);
        srp_attitude_release(&params.attitude);
        return status;
    }
    mission->info.model = params.model.name;
    mission->propagator.shadow = params.shadow;
    mission->propagator.shadow_edges = params.shadow.count > 0;
    status = add(mission, &force, error);
    if (status == SRP_OK) {
        mission->radiation =
            srp_force_list_get(mission->forces, srp_force_list_count(mission->forces) - 1);
    }
    return status;
}

/* ---- Gravity --------------------------------------------------------------------------------- */

static srp_status read_field(const mission_source *source, const mission_gravity *in,
                             const srp_log *log, srp_mission *mission, srp_error *error) {
    unsigned degree = 0;
    if (mission->info.central != SRP_EARTH) {
        return mission_fail(source, error, SRP_UNSUPPORTED, "forces.gravity",
                            "only the Earth's axes are known: a field needs 'central_body: earth'");
    }
    srp_status status = mission_count(source, "forces.gravity.degree", in->degree,
                                      SRP_GRAVITY_DEGREE_MAX, &degree, error);
    unsigned order = degree;
    if (status == SRP_OK) {
        status = mission_count(source, "forces.gravity.order", in->order, degree, &order, error);
    }
    if (status != SRP_OK) {
        return status;
    }
    char *path = mission_beside(mission_source_name(source), in->file);
    if (path == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a file name");
    }
    srp_error why;
    status = srp_gravity_read(path, degree, order, log, &mission->gravity, &why);
    free(path);
    return at_file(source, "forces.gravity.file", status, &why, error);
}

/* The central body: its field, or a point. */
static srp_status add_central(const mission_source *source, const srp_log *log,
                              srp_mission *mission, srp_error *error) {
    const mission_forces *forces = mission_source_file(source)->forces;
    srp_force force;
    srp_status status;
    if (forces != NULL && forces->gravity != NULL) {
        status = read_field(source, forces->gravity, log, mission, error);
        if (status != SRP_OK) {
            return status;
        }
        mission->info.mu = srp_gravity_mu(mission->gravity);
        status = srp_force_gravity(mission->gravity, mission->ephemeris, &force, error);
    } else {
        status = srp_force_central(mission->info.mu, &force, error);
    }
    return status == SRP_OK ? add(mission, &force, error) : status;
}

static srp_status add_point_masses(const mission_source *source, srp_mission *mission,
                                   srp_error *error) {
    const mission_forces *forces = mission_source_file(source)->forces;
    unsigned met = 0;
    for (unsigned i = 0; forces != NULL && i < forces->point_mass_count; ++i) {
        char path[64];
        srp_celestial body = SRP_SUN;
        srp_force force;
        snprintf(path, sizeof path, "forces.point_masses.%u", i);
        if (!srp_celestial_find(forces->point_masses[i], &body) || body == mission->info.central ||
            (met >> body & 1) != 0) {
            return mission_fail(source, error, SRP_BAD_DATA, path,
                                "'%.80s', expected another body than the central one, each once",
                                forces->point_masses[i]);
        }
        met |= 1u << body;
        srp_status status = srp_force_point_mass(body, mission->mu[body], &force, error);
        if (status == SRP_OK) {
            status = add(mission, &force, error);
        }
        if (status != SRP_OK) {
            return status;
        }
    }
    return SRP_OK;
}

/* ---- Sky ------------------------------------------------------------------------------------- */

static srp_celestial_set bodies_of(const mission_forces *forces, srp_celestial central) {
    srp_celestial_set set = 1u << central;
    srp_celestial body = SRP_SUN;
    for (unsigned i = 0; forces != NULL && i < forces->point_mass_count; ++i) {
        set |= srp_celestial_find(forces->point_masses[i], &body) ? 1u << body : 0;
    }
    const mission_radiation *light = forces != NULL ? forces->radiation : NULL;
    for (unsigned i = 0; light != NULL && i < light->shadow_count; ++i) {
        set |= srp_celestial_find(light->shadow[i], &body) ? 1u << body : 0;
    }
    return set;
}

static srp_status make_sky(const mission_source *source, srp_mission *mission, srp_error *error) {
    const mission_forces *forces = mission_source_file(source)->forces;
    const mission_gravity *field = forces != NULL ? forces->gravity : NULL;
    srp_ephemeris_params params = srp_ephemeris_params_default(mission->info.epoch);
    params.begin = -60.0;
    params.end = mission->info.duration + 60.0;
    params.bodies = bodies_of(forces, mission->info.central);
    if (field != NULL) {
        params.orientation = true;
        srp_status status =
            mission_values(source, "forces.gravity.ut1_minus_utc", field->ut1_minus_utc,
                           MISSION_TIME, 1, &params.ut1_minus_utc, error);
        if (status == SRP_OK) {
            status = mission_values(source, "forces.gravity.pole_x", field->pole_x, MISSION_ANGLE,
                                    1, &params.pole_x, error);
        }
        if (status == SRP_OK) {
            status = mission_values(source, "forces.gravity.pole_y", field->pole_y, MISSION_ANGLE,
                                    1, &params.pole_y, error);
        }
        if (status != SRP_OK) {
            return status;
        }
    }
    srp_status status = srp_ephemeris_create(&params, &mission->ephemeris, error);
    return status == SRP_OK ? srp_force_list_create(mission->ephemeris, mission->info.central,
                                                    &mission->forces, error)
                            : status;
}

srp_status mission_build_forces(const mission_source *source, const srp_log *log,
                                srp_mission *mission, srp_error *error) {
    const mission_forces *forces = mission_source_file(source)->forces;
    srp_status status = make_sky(source, mission, error);
    if (status == SRP_OK) {
        status = add_central(source, log, mission, error);
    }
    if (status == SRP_OK) {
        status = add_point_masses(source, mission, error);
    }
    if (status == SRP_OK && forces != NULL && forces->radiation != NULL) {
        status = add_radiation(source, log, mission, error);
    }
    return status;
}
