/* SPDX-License-Identifier: Apache-2.0 */
/* The forces of a mission from its file. */
#include "error.h"
#include "mission_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Complaints ------------------------------------------------------------------------------ */

srp_status mission_at_entry(const mission_source *source, const char *path, srp_status status,
                            const srp_error *why, srp_error *error) {
    if (status == SRP_OK || status == SRP_NO_MEMORY || why->file[0] != '\0') {
        if (status != SRP_OK && error != NULL) {
            *error = *why;
        }
        return status;
    }
    /* What is a wrong argument to a constructor is wrong data in a file. */
    return mission_fail(source, error, status == SRP_BAD_ARGUMENT ? SRP_BAD_DATA : status, path,
                        "%s", why->message);
}

srp_status mission_at_file(const mission_source *source, const char *path, srp_status status,
                           const srp_error *why, srp_error *error) {
    if (status == SRP_NOT_FOUND || status == SRP_IO ||
        (status != SRP_OK && why->file[0] != '\0' && why->line == 0)) {
        return mission_fail(source, error, status, path, "%s%s%s", why->file,
                            why->file[0] != '\0' ? ": " : "", why->message);
    }
    return mission_at_entry(source, path, status, why, error);
}

srp_status mission_need(const mission_source *source, const char *path, const char *text,
                        const char *key, srp_error *error) {
    return text != NULL
               ? SRP_OK
               : mission_fail(source, error, SRP_BAD_FORMAT, path, "'%s' is missing here", key);
}

srp_status mission_path(const mission_site *site, int slot, const char *file, const char **out,
                        srp_error *error) {
    char *path = mission_beside(mission_source_name(site->source), file);
    if (path == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a file name");
    }
    site->mission->texts[slot] = path;
    *out = path;
    return SRP_OK;
}

void mission_warn_unused(const mission_site *site, const char *group, const char *what,
                         size_t count, const mission_key *keys) {
    for (size_t i = 0; i < count; ++i) {
        char path[96];
        snprintf(path, sizeof path, "%s.%s", group, keys[i].name);
        if (keys[i].text != NULL) {
            mission_warn(site->source, site->context->log, path, "%s does not use it", what);
        }
    }
}

/* ---- Radiation ------------------------------------------------------------------------------- */

static srp_status shadow_of(const mission_source *source, const mission_radiation *in,
                            const srp_mission *mission, srp_shadow *out, srp_error *error) {
    *out = (srp_shadow){.sun_radius = mission->radius[SRP_SUN]};
    srp_status status = mission_positive(source, "forces.radiation.sun_radius", in->sun_radius,
                                         MISSION_LENGTH, &out->sun_radius, error);
    if (!mission_has(source, "forces.radiation.shadow") && mission->info.central != SRP_SUN) {
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

static srp_status fill_radiation(const mission_site *site, const mission_radiation *in,
                                 srp_radiation_params *params, srp_error *error) {
    const mission_source *source = site->source;
    const srp_mission *mission = site->mission;
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
        if (status == SRP_OK && !(params->scale >= 0.0)) {
            return mission_fail(source, error, SRP_BAD_DATA, "forces.radiation.scale",
                                "'%.80s', expected 0 or more: light does not pull", in->scale);
        }
    }
    if (status == SRP_OK) {
        status = mission_build_model(site, &params->model, error);
    }
    if (status == SRP_OK && (params->model.flags & SRP_AREA_MODEL_ROUND) == 0) {
        status = mission_build_attitude(site, &params->attitude, error);
    }
    return status;
}

static srp_status add_radiation(const mission_site *site, srp_error *error) {
    const mission_source *source = site->source;
    srp_mission *mission = site->mission;
    const mission_radiation *in = mission_source_file(source)->forces->radiation;
    srp_radiation_params params = {.scale = 1.0};
    srp_force force;
    srp_error why;
    srp_status status = fill_radiation(site, in, &params, error);
    if (status == SRP_OK) {
        status = srp_force_radiation(&params, &force, &why);
        status = mission_at_entry(source, "forces.radiation", status, &why, error);
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

static srp_status read_field(const mission_site *site, const mission_gravity *in,
                             srp_error *error) {
    const mission_source *source = site->source;
    srp_mission *mission = site->mission;
    unsigned degree = 0;
    if (mission->info.central != SRP_EARTH) {
        return mission_fail(source, error, SRP_UNSUPPORTED, "forces.gravity",
                            "only the Earth's axes are known: a field needs 'central_body: earth'");
    }
    srp_status status = mission_count(source, "forces.gravity.degree", in->degree, 0,
                                      SRP_GRAVITY_DEGREE_MAX, &degree, error);
    unsigned order = degree;
    if (status == SRP_OK) {
        status = mission_count(source, "forces.gravity.order", in->order, 0, degree, &order, error);
    }
    if (status != SRP_OK) {
        return status;
    }
    srp_error why;
    const char **path = &mission->info.gravity_file;
    status = mission_path(site, MISSION_TEXT_GRAVITY, in->file, path, error);
    if (status != SRP_OK) {
        return status;
    }
    status = srp_gravity_read(*path, degree, order, site->context->log, &mission->gravity, &why);
    return mission_at_file(source, "forces.gravity.file", status, &why, error);
}

/* The central body: its field, or a point. */
static srp_status add_central(const mission_site *site, srp_error *error) {
    const mission_forces *forces = mission_source_file(site->source)->forces;
    srp_mission *mission = site->mission;
    srp_force force;
    srp_status status;
    if (forces != NULL && forces->gravity != NULL) {
        status = read_field(site, forces->gravity, error);
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

srp_status mission_build_forces(const mission_site *site, srp_error *error) {
    const mission_forces *forces = mission_source_file(site->source)->forces;
    srp_status status = make_sky(site->source, site->mission, error);
    if (status == SRP_OK) {
        status = add_central(site, error);
    }
    if (status == SRP_OK) {
        status = add_point_masses(site->source, site->mission, error);
    }
    if (status == SRP_OK && forces != NULL && forces->radiation != NULL) {
        status = add_radiation(site, error);
    }
    return status;
}
