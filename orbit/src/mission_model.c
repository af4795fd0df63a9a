/* SPDX-License-Identifier: Apache-2.0 */
/* The models of radiation pressure that a mission names. */
#include "error.h"
#include "mission_internal.h"

#include <srp/acceleration.h>
#include <srp/const.h>
#include <srp/scene.h>
#include <srp/table.h>

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Sphere, table --------------------------------------------------------------------------- */

static srp_status cannonball(const mission_source *source, const mission_radiation *in,
                             srp_area_model *out, srp_error *error) {
    double cr = 0.0, area = 0.0;
    srp_error why;
    srp_status status = mission_need(source, "forces.radiation", in->cr, "cr", error);
    if (status == SRP_OK) {
        status = mission_need(source, "forces.radiation", in->area, "area", error);
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
    return mission_at_entry(source, "forces.radiation", status, &why, error);
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
        return mission_at_entry(source, "forces.radiation.file", status, &why, error);
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
    return mission_at_entry(source, "forces.radiation.file", status, &why, error);
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
    status = mission_at_file(source, "forces.radiation.file", status, &why, error);
    if (status == SRP_OK) {
        status = of_table(source, in, table, out, error);
    }
    srp_table_destroy(table);
    return status;
}

/* ---- Plates, and a mesh for those who have the time ------------------------------------------ */

static srp_status read_plates(const mission_site *site, const char *path, srp_error *error) {
    srp_mission *mission = site->mission;
    srp_method_params params = srp_method_params_default();
    srp_plate *list = NULL;
    size_t count;
    srp_error why;
    params.threads = 1;
    srp_status status = srp_plates_read(path, &list, &count, &why);
    if (status == SRP_OK) {
        status = srp_scene_from_plates(list, count, &mission->scene, &why);
    }
    srp_plates_free(list);
    if (status == SRP_OK) {
        status = srp_method_prepare(&srp_method_nplate, mission->scene, &params, &mission->prepared,
                                    &why);
    }
    return mission_at_file(site->source, "forces.radiation.file", status, &why, error);
}

/* A scene that is asked at each call. */
static srp_status from_scene(const mission_site *site, const char *path, bool plates,
                             srp_area_model *out, srp_error *error) {
    srp_error why;
    srp_status status =
        plates ? read_plates(site, path, error) : mission_prepare_mesh(site, path, 1, error);
    if (status != SRP_OK) {
        return status;
    }
    status = srp_area_model_direct(site->mission->prepared, out, &why);
    return mission_at_entry(site->source, "forces.radiation.file", status, &why, error);
}

/* ---- A table that fills itself --------------------------------------------------------------- */

struct mission_failure {
    atomic_flag taken;
    atomic_bool ready;
    srp_error error;
};

void mission_failure_destroy(mission_failure *failure) {
    free(failure);
}

bool mission_failure_get(const mission_failure *failure, srp_error *error) {
    if (failure == NULL || !atomic_load_explicit(&failure->ready, memory_order_acquire)) {
        return false;
    }
    if (error != NULL) {
        *error = failure->error;
    }
    return true;
}

typedef struct on_demand_model {
    srp_interp *interp;
    mission_failure *failure; /* the mission's */
} on_demand_model;

static int on_demand_eval(const void *user, srp_vec3 s, srp_vec3 *f, double (*df)[3]) {
    const on_demand_model *model = user;
    const srp_area_source source = srp_area_source_interp(model->interp);
    srp_error error;
    if (source.eval(source.user, s, f, df, &error) != SRP_OK) {
        if (!atomic_flag_test_and_set(&model->failure->taken)) {
            model->failure->error = error;
            atomic_store_explicit(&model->failure->ready, true, memory_order_release);
        }
        return -1;
    }
    return 0;
}

static void on_demand_destroy(void *user) {
    on_demand_model *model = user;
    srp_interp_destroy(model->interp);
    free(model);
}

static srp_status read_step(const mission_source *source, const char *path, const char *text,
                            double *deg, srp_error *error) {
    double step = *deg * SRP_RAD_PER_DEG;
    srp_status status = mission_positive(source, path, text, MISSION_ANGLE, &step, error);
    if (status == SRP_OK && text != NULL) {
        /* To the last digits, of which srp_grid_from_steps() asks for nine. */
        *deg = step / SRP_RAD_PER_DEG;
    }
    return status;
}

static srp_status read_grid(const mission_source *source, const mission_radiation *in,
                            srp_grid *grid, srp_error *error) {
    double step[2] = {5.0, 5.0};
    srp_error why;
    if (in->step != NULL && (in->az_step != NULL || in->el_step != NULL)) {
        return mission_fail(source, error, SRP_BAD_FORMAT, "forces.radiation.step",
                            "expected either 'step' or 'az_step' and 'el_step'");
    }
    srp_status status = read_step(source, "forces.radiation.step", in->step, &step[0], error);
    step[1] = step[0];
    if (status == SRP_OK) {
        status = read_step(source, "forces.radiation.az_step", in->az_step, &step[0], error);
    }
    if (status == SRP_OK) {
        status = read_step(source, "forces.radiation.el_step", in->el_step, &step[1], error);
    }
    if (status != SRP_OK) {
        return status;
    }
    const char *path = in->az_step != NULL ? "forces.radiation.az_step" : "forces.radiation.step";
    status = srp_grid_from_steps(step[0], 90.0, grid, &why);
    if (status == SRP_OK) {
        path = in->el_step != NULL ? "forces.radiation.el_step" : "forces.radiation.step";
        status = srp_grid_from_steps(step[0], step[1], grid, &why);
    }
    return mission_at_entry(source, path, status, &why, error);
}

/* Without the cache where there is none: that costs time, and is warned of. */
static srp_status open_cache(const mission_site *site, const mission_radiation *in,
                             srp_error *error) {
    const srp_mission_context *context = site->context;
    bool wanted = true;
    srp_error why;
    srp_status status =
        mission_flag(site->source, "forces.radiation.cache", in->cache, &wanted, error);
    if (status == SRP_OK && wanted && context->cache != NULL) {
        status = srp_cache_open(context->cache, context->log, &site->mission->cache, &why);
        if (status == SRP_NO_MEMORY) {
            return mission_at_entry(site->source, "forces.radiation.cache", status, &why, error);
        }
        if (status != SRP_OK) {
            mission_warn(site->source, context->log, "forces.radiation.cache",
                         "the run goes on without the cache: %s", why.message);
        }
        status = SRP_OK;
    }
    return status;
}

static srp_status make_table(const mission_site *site, const srp_interp_scheme *scheme,
                             srp_grid grid, srp_area_model *out, srp_error *error) {
    srp_mission *mission = site->mission;
    srp_error why;
    srp_interp *interp = NULL;
    srp_status status =
        srp_demand_create(mission->prepared, grid, mission->cache, &mission->demand, &why);
    if (status == SRP_OK) {
        status = srp_interp_create_on_demand(scheme, mission->demand, &interp, &why);
    }
    if (status != SRP_OK) {
        return mission_at_entry(site->source, "forces.radiation.step", status, &why, error);
    }
    on_demand_model *model = malloc(sizeof *model);
    mission->failure = malloc(sizeof *mission->failure);
    if (model == NULL || mission->failure == NULL) {
        free(model);
        srp_interp_destroy(interp);
        return srp_fail(error, SRP_NO_MEMORY, "no memory for an area model");
    }
    atomic_flag_clear(&mission->failure->taken);
    atomic_init(&mission->failure->ready, false);
    *model = (on_demand_model){interp, mission->failure};
    *out = (srp_area_model){scheme->name, 0, on_demand_eval, on_demand_destroy, model};
    return SRP_OK;
}

static srp_status on_demand(const mission_site *site, const mission_radiation *in, const char *path,
                            srp_area_model *out, srp_error *error) {
    const mission_source *source = site->source;
    const char *name = in->interpolation != NULL ? in->interpolation : "bicubic";
    const srp_interp_scheme *scheme = srp_interp_find(name);
    srp_grid grid;
    if (scheme == NULL || (scheme->capabilities & SRP_INTERP_LOCAL) == 0) {
        return mission_fail(source, error, SRP_BAD_DATA, "forces.radiation.interpolation",
                            "found '%.80s', expected bilinear or bicubic: others need all nodes of "
                            "a table, 'srp table' makes one",
                            name);
    }
    srp_status status = read_grid(source, in, &grid, error);
    if (status == SRP_OK) {
        status = mission_prepare_mesh(site, path, srp_method_params_default().threads, error);
    }
    if (status == SRP_OK) {
        status = open_cache(site, in, error);
    }
    return status == SRP_OK ? make_table(site, scheme, grid, out, error) : status;
}

/* ---- Which ----------------------------------------------------------------------------------- */

static const char *const MODELS[] = {"cannonball", "plates", "table", "direct", "on_demand"};
enum { CANNONBALL, PLATES, TABLE, DIRECT, ON_DEMAND, MODEL_COUNT };

static void warn_of_unused(const mission_site *site, const mission_radiation *in, int model) {
    const bool mesh = model == DIRECT || model == ON_DEMAND;
    const mission_key keys[] = {
        {"cr", model == CANNONBALL ? NULL : in->cr},
        {"area", model == CANNONBALL ? NULL : in->area},
        {"file", model == CANNONBALL ? in->file : NULL},
        {"interpolation", model == TABLE || model == ON_DEMAND ? NULL : in->interpolation},
        {"step", model == ON_DEMAND ? NULL : in->step},
        {"az_step", model == ON_DEMAND ? NULL : in->az_step},
        {"el_step", model == ON_DEMAND ? NULL : in->el_step},
        {"cache", model == ON_DEMAND ? NULL : in->cache},
        {"method", mesh ? NULL : in->method},
        {"device", mesh ? NULL : in->device},
        {"unit", mesh ? NULL : in->unit},
        {"materials", mesh || in->material_count == 0 ? NULL : ""},
        {"grid", mesh ? NULL : in->grid},
        {"pixel", mesh ? NULL : in->pixel},
        {"tolerance", mesh ? NULL : in->tolerance},
        {"max_grid", mesh ? NULL : in->max_grid},
        {"seed", mesh ? NULL : in->seed},
        {"reflections", mesh ? NULL : in->reflections},
        {"diffuse", mesh ? NULL : in->diffuse},
        {"beams", mesh ? NULL : in->beams},
        {"threads", mesh ? NULL : in->threads},
    };
    char what[80];
    snprintf(what, sizeof what, "model %s", MODELS[model]);
    mission_warn_unused(site, "forces.radiation", what, sizeof keys / sizeof keys[0], keys);
}

srp_status mission_build_model(const mission_site *site, srp_area_model *out, srp_error *error) {
    const mission_source *source = site->source;
    const mission_radiation *in = mission_source_file(source)->forces->radiation;
    int model = 0;
    while (model < MODEL_COUNT && strcmp(in->model, MODELS[model]) != 0) {
        ++model;
    }
    if (model == MODEL_COUNT) {
        return mission_fail(
            source, error, SRP_BAD_DATA, "forces.radiation.model",
            "found '%.80s', expected cannonball, plates, table, direct or on_demand", in->model);
    }
    warn_of_unused(site, in, model);
    if (model == CANNONBALL) {
        return cannonball(source, in, out, error);
    }
    const char **path = &site->mission->info.radiation_file;
    srp_status status = mission_need(source, "forces.radiation", in->file, "file", error);
    if (status == SRP_OK) {
        status = mission_path(site, MISSION_TEXT_RADIATION, in->file, path, error);
    }
    if (status != SRP_OK) {
        return status;
    }
    switch (model) {
    case TABLE:
        return from_table(source, in, *path, out, error);
    case ON_DEMAND:
        return on_demand(site, in, *path, out, error);
    default:
        return from_scene(site, *path, model == PLATES, out, error);
    }
}
