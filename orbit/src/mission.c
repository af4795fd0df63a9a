/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"
#include "mission_internal.h"
#include "platform.h"
#include "text.h"

#include <srp/orbit/elements.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Columns --------------------------------------------------------------------------------- */

static const char *const COLUMNS[SRP_COLUMN_COUNT] = {
    "epoch", "elapsed", "a1_mjd", "tdb_mjd", "position", "velocity", "elements", "sun",
    "area",  "srp",     "seen",   "impulse", "attitude", "nodes",    "matrix"};

const char *srp_column_name(srp_column column) {
    return (unsigned)column < SRP_COLUMN_COUNT ? COLUMNS[column] : NULL;
}

bool srp_column_find(const char *name, srp_column *out) {
    for (int i = 0; i < SRP_COLUMN_COUNT; ++i) {
        if (strcmp(name, COLUMNS[i]) == 0) {
            *out = (srp_column)i;
            return true;
        }
    }
    return false;
}

/* ---- Reading the parts that are not forces ----------------------------------------------------
 */

static srp_status keep(srp_mission *mission, size_t slot, const char *text, const char **out,
                       srp_error *error) {
    if (text != NULL) {
        mission->texts[slot] = mission_copy(text);
        if (mission->texts[slot] == NULL) {
            return srp_fail(error, SRP_NO_MEMORY, "no memory for a mission");
        }
        *out = mission->texts[slot];
    }
    return SRP_OK;
}

/* What goes into an OEM is printable ASCII on one line. */
static srp_status check_text(const mission_source *source, const char *path, const char *text,
                             srp_error *error) {
    for (const char *at = text; at != NULL && *at != '\0'; ++at) {
        if ((unsigned char)*at < 32 || (unsigned char)*at > 126 || at - text >= 200) {
            return mission_fail(source, error, SRP_BAD_DATA, path,
                                "expected a line of at most 200 printable ASCII characters");
        }
    }
    return SRP_OK;
}

static srp_status check_texts(const mission_source *source, srp_error *error) {
    const mission_file *file = mission_source_file(source);
    srp_status status = check_text(source, "title", file->title, error);
    if (status == SRP_OK) {
        status = check_text(source, "spacecraft.name", file->spacecraft->name, error);
    }
    return status == SRP_OK ? check_text(source, "spacecraft.id", file->spacecraft->id, error)
                            : status;
}

static srp_status keep_texts(const mission_source *source, srp_mission *mission, srp_error *error) {
    const mission_file *file = mission_source_file(source);
    const mission_output *output = file->output;
    srp_mission_info *info = &mission->info;
    const struct {
        const char *text;
        const char **out;
    } all[] = {{mission_source_name(source), &info->file},
               {file->title != NULL ? file->title : "", &info->title},
               {file->spacecraft->name != NULL ? file->spacecraft->name : "SPACECRAFT",
                &info->object_name},
               {file->spacecraft->id != NULL ? file->spacecraft->id : "UNKNOWN", &info->object_id},
               {output != NULL ? output->oem : NULL, &info->oem},
               {output != NULL ? output->report : NULL, &info->report},
               {output != NULL ? output->events : NULL, &info->events}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i) {
        srp_status status = keep(mission, i, all[i].text, all[i].out, error);
        if (status != SRP_OK) {
            return status;
        }
    }
    return SRP_OK;
}

/* The years that ERFA's series of Earth and Sun are made for [JD - 2430000]. */
static const double YEAR_1900 = 2415020.5 - 2430000.0, YEAR_2100 = 2488069.5 - 2430000.0;

/* What is less sure outside some span of dates, of the begin and of the end. */
static void warn_of_date(const mission_source *source, const srp_log *log,
                         const srp_mission_info *info, const char *path, double t) {
    const srp_epoch now = srp_epoch_add(info->epoch, t);
    const double mjd = srp_epoch_gmat_mjd(now, SRP_TIME_TDB);
    char date[SRP_EPOCH_TEXT_SIZE], text[SRP_EPOCH_TEXT_SIZE + 8];
    srp_epoch same;
    srp_error ignored;
    bool beyond = false;
    srp_epoch_format(now, SRP_TIME_UTC, 3, date);
    snprintf(text, sizeof text, "%s UTC", date);
    if (info->scale == SRP_TIME_UTC && srp_epoch_parse(text, &same, &beyond, &ignored) == SRP_OK &&
        beyond) {
        mission_warn(source, log, path,
                     "%s is outside the table of leap seconds: UTC is a guess there", text);
    }
    if (!(mjd >= YEAR_1900 && mjd <= YEAR_2100)) {
        mission_warn(source, log, path,
                     "%s is outside the years 1900 to 2100, for which the series of Sun and Moon "
                     "are made",
                     text);
    }
}

static srp_status read_times(const mission_source *source, const srp_log *log, srp_mission *mission,
                             srp_error *error) {
    const mission_file *file = mission_source_file(source);
    srp_mission_info *info = &mission->info;
    srp_error why;
    srp_status status = srp_epoch_parse(file->epoch, &info->epoch, NULL, &why);
    if (status != SRP_OK) {
        return mission_fail(source, error, status, "epoch", "%s", why.message);
    }
    const char *scale = strrchr(file->epoch, ' ') + 1;
    if (!srp_time_scale_find(scale, &info->scale)) {
        info->scale = SRP_TIME_TAI;
    }
    warn_of_date(source, log, info, "epoch", 0.0);
    status =
        mission_positive(source, "duration", file->duration, MISSION_TIME, &info->duration, error);
    info->step = info->duration;
    if (status == SRP_OK && file->output != NULL) {
        status = mission_positive(source, "output.step", file->output->step, MISSION_TIME,
                                  &info->step, error);
    }
    if (status == SRP_OK && info->duration > 100.0 * 365.25 * 86400.0) {
        return mission_fail(source, error, SRP_BAD_DATA, "duration",
                            "'%s', expected at most 100 years", file->duration);
    }
    if (status == SRP_OK) {
        warn_of_date(source, log, info, "duration", info->duration);
    }
    if (status == SRP_OK && info->duration / info->step > 1e8) {
        return mission_fail(source, error, SRP_BAD_DATA, "output.step",
                            "'%s' makes more than 1e8 rows", file->output->step);
    }
    return status;
}

static srp_status read_worlds(const mission_source *source, const char *group,
                              const mission_worlds *in, mission_kind kind, double *out,
                              srp_error *error) {
    srp_status status = SRP_OK;
    for (int i = 0; in != NULL && status == SRP_OK && i < SRP_CELESTIAL_COUNT; ++i) {
        char path[64];
        snprintf(path, sizeof path, "constants.%s.%s", group,
                 srp_celestial_get((srp_celestial)i)->name);
        status = mission_positive(source, path, in->of[i], kind, &out[i], error);
    }
    return status;
}

static srp_status read_constants(const mission_source *source, srp_mission *mission,
                                 srp_error *error) {
    const mission_file *file = mission_source_file(source);
    for (int i = 0; i < SRP_CELESTIAL_COUNT; ++i) {
        mission->mu[i] = srp_celestial_get((srp_celestial)i)->mu;
        mission->radius[i] = srp_celestial_get((srp_celestial)i)->radius;
    }
    srp_status status = SRP_OK;
    if (file->constants != NULL) {
        status = read_worlds(source, "mu", file->constants->mu, MISSION_MU, mission->mu, error);
        if (status == SRP_OK) {
            status = read_worlds(source, "radius", file->constants->radius, MISSION_LENGTH,
                                 mission->radius, error);
        }
    }
    mission->info.central = SRP_EARTH;
    if (status == SRP_OK && file->central_body != NULL &&
        !srp_celestial_find(file->central_body, &mission->info.central)) {
        return mission_fail(source, error, SRP_BAD_DATA, "central_body",
                            "found '%.80s', expected sun, earth, moon or a planet",
                            file->central_body);
    }
    mission->info.mu = mission->mu[mission->info.central];
    return status;
}

static srp_status read_spacecraft(const mission_source *source, srp_mission *mission,
                                  srp_error *error) {
    const mission_file *file = mission_source_file(source);
    srp_status status = mission_positive(source, "spacecraft.mass", file->spacecraft->mass,
                                         MISSION_MASS, &mission->mass, error);
    if (status == SRP_OK) {
        status = mission_flag(source, "partials", file->partials, &mission->info.partials, error);
    }
    mission->propagator.partials = mission->info.partials;
    return status;
}

/* ---- Initial state --------------------------------------------------------------------------- */

static srp_status read_state(const mission_source *source, srp_mission *mission, srp_error *error) {
    const mission_state *in = mission_source_file(source)->state;
    double r[3], v[3];
    srp_status status =
        mission_values(source, "state.position", in->position, MISSION_LENGTH, 3, r, error);
    if (status == SRP_OK) {
        status = mission_values(source, "state.velocity", in->velocity, MISSION_SPEED, 3, v, error);
    }
    if (status == SRP_OK) {
        mission->r = srp_vec3_make(r[0], r[1], r[2]);
        mission->v = srp_vec3_make(v[0], v[1], v[2]);
    }
    return status;
}

static srp_status read_elements(const mission_source *source, srp_mission *mission,
                                srp_error *error) {
    const mission_elements *in = mission_source_file(source)->elements;
    srp_elements el = {0};
    const struct {
        const char *path, *text;
        mission_kind kind;
        double *out;
    } all[] = {{"elements.semi_major_axis", in->semi_major_axis, MISSION_LENGTH, &el.a},
               {"elements.eccentricity", in->eccentricity, MISSION_NUMBER, &el.e},
               {"elements.inclination", in->inclination, MISSION_ANGLE, &el.i},
               {"elements.raan", in->raan, MISSION_ANGLE, &el.raan},
               {"elements.arg_periapsis", in->arg_periapsis, MISSION_ANGLE, &el.argp},
               {"elements.true_anomaly", in->true_anomaly, MISSION_ANGLE, &el.nu}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i) {
        srp_status status =
            mission_values(source, all[i].path, all[i].text, all[i].kind, 1, all[i].out, error);
        if (status != SRP_OK) {
            return status;
        }
    }
    srp_error why;
    if (srp_elements_to_state(mission->info.mu, &el, &mission->r, &mission->v, &why) != SRP_OK) {
        return mission_fail(source, error, SRP_BAD_DATA, "elements", "%s", why.message);
    }
    return SRP_OK;
}

static srp_status check_state(const mission_source *source, const srp_mission *mission,
                              const char *path, srp_error *error) {
    const mission_file *file = mission_source_file(source);
    const double r = srp_vec3_norm(mission->r), v2 = srp_vec3_dot(mission->v, mission->v);
    const srp_celestial_info *body = srp_celestial_get(mission->info.central);
    bool allowed = false;
    srp_status status = mission_flag(source, "hyperbolic", file->hyperbolic, &allowed, error);
    if (status != SRP_OK) {
        return status;
    }
    if (!(r > mission->radius[mission->info.central])) {
        return mission_fail(source, error, SRP_BAD_DATA, path,
                            "%.3f km from the centre of the body (%s): that is inside it, its "
                            "radius is %.3f km",
                            1e-3 * r, body->name, 1e-3 * mission->radius[mission->info.central]);
    }
    if (!allowed && !(0.5 * v2 - mission->info.mu / r < 0.0)) {
        return mission_fail(
            source, error, SRP_BAD_DATA, path,
            "the orbit is not bound to the central body (%s); if that is meant, say "
            "'hyperbolic: true'",
            body->name);
    }
    return SRP_OK;
}

static srp_status read_start(const mission_source *source, srp_mission *mission, srp_error *error) {
    const mission_file *file = mission_source_file(source);
    if ((file->state != NULL) == (file->elements != NULL)) {
        return mission_fail(source, error, SRP_BAD_FORMAT, file->state != NULL ? "elements" : "",
                            "expected one of 'state' and 'elements'");
    }
    srp_status status = file->state != NULL ? read_state(source, mission, error)
                                            : read_elements(source, mission, error);
    return status == SRP_OK
               ? check_state(source, mission, file->state != NULL ? "state.position" : "elements",
                             error)
               : status;
}

/* ---- Integrator, columns --------------------------------------------------------------------- */

/* More steps than this are a slip of the pen: hours of work. */
static const double STEPS_MAX = 1e8;

static srp_status check_steps(const mission_source *source, const srp_mission *mission,
                              srp_error *error) {
    const srp_propagator_params *params = &mission->propagator;
    const bool fixed = params->fixed_step > 0.0;
    const double step = fixed ? params->fixed_step : params->max_step;
    if (step * STEPS_MAX < fabs(mission->info.duration)) {
        return mission_fail(source, error, SRP_BAD_DATA,
                            fixed ? "integrator.fixed_step" : "integrator.max_step",
                            "%g s are %.1e steps, expected at most %.0e", step,
                            fabs(mission->info.duration) / step, STEPS_MAX);
    }
    return SRP_OK;
}

static srp_status read_integrator(const mission_source *source, srp_mission *mission,
                                  srp_error *error) {
    const mission_integrator *in = mission_source_file(source)->integrator;
    srp_propagator_params *out = &mission->propagator;
    if (in == NULL) {
        return SRP_OK;
    }
    if (in->method != NULL) {
        out->integrator = srp_integrator_find(in->method);
        if (out->integrator == NULL) {
            return mission_fail(source, error, SRP_BAD_DATA, "integrator.method",
                                "found '%.80s', expected rk8pd, rkf45, rkck or rk4", in->method);
        }
    }
    srp_status status = mission_positive(source, "integrator.tolerance", in->tolerance,
                                         MISSION_NUMBER, &out->tolerance, error);
    if (status == SRP_OK && !(out->tolerance >= 1e-16 && out->tolerance <= 1e-2)) {
        return mission_fail(source, error, SRP_BAD_DATA, "integrator.tolerance",
                            "'%s', expected from 1e-16 to 1e-2", in->tolerance);
    }
    if (status == SRP_OK) {
        status = mission_positive(source, "integrator.fixed_step", in->fixed_step, MISSION_TIME,
                                  &out->fixed_step, error);
    }
    if (status == SRP_OK) {
        status = mission_positive(source, "integrator.first_step", in->first_step, MISSION_TIME,
                                  &out->first_step, error);
    }
    if (status == SRP_OK) {
        status = mission_positive(source, "integrator.max_step", in->max_step, MISSION_TIME,
                                  &out->max_step, error);
    }
    return status == SRP_OK ? check_steps(source, mission, error) : status;
}

/* What an integrator of fixed steps has no use for. */
static void warn_of_steps(const mission_site *site) {
    const mission_integrator *in = mission_source_file(site->source)->integrator;
    if (in != NULL && in->fixed_step != NULL) {
        const mission_key keys[] = {{"tolerance", in->tolerance},
                                    {"first_step", in->first_step},
                                    {"max_step", in->max_step}};
        mission_warn_unused(site, "integrator", "fixed_step", sizeof keys / sizeof keys[0], keys);
    }
}

/* A column of nodes of a model that has none. */
static void warn_of_nodes(const mission_site *site) {
    const srp_mission_info *info = &site->mission->info;
    for (size_t k = 0; k < info->column_count; ++k) {
        if (info->columns[k] == SRP_COLUMN_NODES && site->mission->demand == NULL) {
            mission_warn(site->source, site->context->log, "output.columns",
                         "nodes will be 0: only the model on_demand computes some");
        }
    }
}

/* Each file is written once. */
static srp_status check_files(const mission_source *source, const srp_mission *mission,
                              srp_error *error) {
    const srp_mission_info *info = &mission->info;
    const char *const files[] = {info->oem, info->report, info->events};
    static const char *const PATHS[] = {"output.oem", "output.report", "output.events"};
    for (int i = 1; i < 3; ++i) {
        for (int k = 0; k < i; ++k) {
            if (files[i] != NULL && files[k] != NULL && strcmp(files[i], files[k]) == 0) {
                return mission_fail(source, error, SRP_BAD_DATA, PATHS[i],
                                    "'%.80s' is %s, too; expected a file of its own", files[i],
                                    PATHS[k]);
            }
        }
    }
    return SRP_OK;
}

static srp_status read_columns(const mission_source *source, srp_mission *mission,
                               srp_error *error) {
    static const srp_column USUAL[] = {SRP_COLUMN_EPOCH, SRP_COLUMN_ELAPSED, SRP_COLUMN_POSITION,
                                       SRP_COLUMN_VELOCITY, SRP_COLUMN_SEEN};
    const mission_output *output = mission_source_file(source)->output;
    const unsigned count = output != NULL ? output->column_count : 0;
    mission->info.columns = mission->columns;
    if (!mission_has(source, "output.columns")) {
        memcpy(mission->columns, USUAL, sizeof USUAL);
        mission->info.column_count = sizeof USUAL / sizeof USUAL[0];
        return SRP_OK;
    }
    if (count == 0) {
        return mission_fail(source, error, SRP_BAD_DATA, "output.columns",
                            "expected one column or more");
    }
    for (unsigned i = 0; i < count; ++i) {
        char path[64];
        srp_column column = SRP_COLUMN_EPOCH;
        snprintf(path, sizeof path, "output.columns.%u", i);
        bool good = srp_column_find(output->columns[i], &column);
        for (size_t k = 0; k < mission->info.column_count; ++k) {
            good = good && mission->columns[k] != column;
        }
        if (!good) {
            return mission_fail(source, error, SRP_BAD_DATA, path,
                                "'%.80s', expected a column, each once: epoch, elapsed, a1_mjd, "
                                "tdb_mjd, position, velocity, elements, sun, area, srp, seen, "
                                "impulse, attitude, nodes, matrix",
                                output->columns[i]);
        }
        if (column == SRP_COLUMN_MATRIX && !mission->info.partials) {
            return mission_fail(source, error, SRP_BAD_DATA, path,
                                "the matrix needs 'partials: true'");
        }
        mission->columns[mission->info.column_count++] = column;
    }
    return SRP_OK;
}

/* For millimetres also where a bilinear table has a kink at each of its cells, and the spacecraft
 * crosses them fast: two days in GEO at a degree per second are 100 mm off with the propagator's
 * own 1e-12, and 3 mm with this (tests/orbit/test_orbit_gmat.c). */
static const double TOLERANCE = 1e-14;

/* ---- Life ------------------------------------------------------------------------------------ */

static srp_status build(const mission_site *site, srp_error *error) {
    const mission_source *source = site->source;
    srp_mission *mission = site->mission;
    srp_status status = check_texts(source, error);
    status = status == SRP_OK ? keep_texts(source, mission, error) : status;
    status = status == SRP_OK ? read_times(source, site->context->log, mission, error) : status;
    status = status == SRP_OK ? read_constants(source, mission, error) : status;
    status = status == SRP_OK ? read_spacecraft(source, mission, error) : status;
    status = status == SRP_OK ? read_integrator(source, mission, error) : status;
    status = status == SRP_OK ? read_columns(source, mission, error) : status;
    status = status == SRP_OK ? check_files(source, mission, error) : status;
    status = status == SRP_OK ? mission_build_forces(site, error) : status;
    if (status == SRP_OK) {
        warn_of_steps(site);
        warn_of_nodes(site);
    }
    return status == SRP_OK ? read_start(source, mission, error) : status;
}

srp_status srp_mission_parse(const char *text, size_t size, const char *name,
                             const srp_mission_context *context, srp_mission **out,
                             srp_error *error) {
    static const srp_mission_context NOTHING = {NULL, NULL, NULL, NULL};
    srp_c_locale locale = srp_platform_c_locale_enter();
    mission_source *source = NULL;
    srp_mission *mission = NULL;
    srp_status status = mission_source_open(text, size, name, &source, error);
    if (status == SRP_OK) {
        mission = calloc(1, sizeof *mission);
        status =
            mission != NULL ? SRP_OK : srp_fail(error, SRP_NO_MEMORY, "no memory for a mission");
    }
    if (status == SRP_OK) {
        mission->propagator = srp_propagator_params_default();
        mission->propagator.tolerance = TOLERANCE;
        mission->propagator.apsides = true;
        mission->info.model = "none";
        const mission_site site = {source, context != NULL ? context : &NOTHING, mission};
        status = build(&site, error);
    }
    mission_source_close(source);
    srp_platform_c_locale_leave(locale);
    if (status != SRP_OK) {
        srp_mission_destroy(mission);
        return status;
    }
    *out = mission;
    return SRP_OK;
}

srp_status srp_mission_read(const char *path, const srp_mission_context *context, srp_mission **out,
                            srp_error *error) {
    char *text;
    size_t size;
    srp_status status = srp_text_read_file(path, &text, &size, error);
    if (status == SRP_OK) {
        status = srp_mission_parse(text, size, path, context, out, error);
        free(text);
    }
    return status;
}

void srp_mission_destroy(srp_mission *mission) {
    if (mission != NULL) {
        srp_force_list_destroy(mission->forces); /* and the interpolants in it */
        srp_demand_destroy(mission->demand);
        srp_cache_close(mission->cache);
        mission_failure_destroy(mission->failure);
        srp_prepared_release(mission->prepared);
        srp_scene_destroy(mission->scene);
        srp_gravity_destroy(mission->gravity);
        srp_ephemeris_destroy(mission->ephemeris);
        for (size_t i = 0; i < sizeof mission->texts / sizeof mission->texts[0]; ++i) {
            free(mission->texts[i]);
        }
        free(mission);
    }
}

const srp_mission_info *srp_mission_get_info(const srp_mission *mission) {
    return &mission->info;
}

const srp_force_list *srp_mission_forces(const srp_mission *mission) {
    return mission->forces;
}
