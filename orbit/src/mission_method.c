/* SPDX-License-Identifier: Apache-2.0 */
/* Meshes of a mission, and how light on them is computed. */
#include "error.h"
#include "mission_internal.h"

#include <srp/scene.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Mesh and materials ---------------------------------------------------------------------- */

static srp_status read_unit(const mission_source *source, const char *text, double *metres,
                            srp_error *error) {
    static const struct {
        const char *name;
        double metres;
    } UNITS[] = {{"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}, {"in", 0.0254}, {"ft", 0.3048}};
    for (size_t i = 0; text != NULL && i < sizeof UNITS / sizeof UNITS[0]; ++i) {
        if (strcmp(text, UNITS[i].name) == 0) {
            *metres = UNITS[i].metres;
            return SRP_OK;
        }
    }
    return text == NULL ? SRP_OK
                        : mission_fail(source, error, SRP_BAD_DATA, "forces.radiation.unit",
                                       "found '%.80s', expected m, mm, cm, in or ft", text);
}

static srp_status add_material(const mission_source *source, const mission_radiation *in,
                               unsigned index, srp_materials *materials, srp_error *error) {
    const mission_material *material = &in->materials[index];
    char path[64], at[80];
    srp_optics optics = {0.0, 0.0, false}, other;
    srp_error why;
    snprintf(path, sizeof path, "forces.radiation.materials.%u", index);
    if (srp_materials_find(materials, material->name, &other)) {
        return mission_fail(source, error, SRP_BAD_DATA, path, "'%.80s' is given twice",
                            material->name);
    }
    snprintf(at, sizeof at, "%s.rho_s", path);
    srp_status status =
        mission_values(source, at, material->rho_s, MISSION_NUMBER, 1, &optics.rho_s, error);
    if (status == SRP_OK) {
        snprintf(at, sizeof at, "%s.rho_d", path);
        status =
            mission_values(source, at, material->rho_d, MISSION_NUMBER, 1, &optics.rho_d, error);
    }
    if (status == SRP_OK) {
        snprintf(at, sizeof at, "%s.one_sided", path);
        status = mission_flag(source, at, material->one_sided, &optics.one_sided, error);
    }
    if (status != SRP_OK) {
        return status;
    }
    status = srp_materials_set(materials, material->name, optics, true, &why);
    return mission_at_entry(source, path, status, &why, error);
}

/* What the library says of materials has no place, as it does not know where they were given. */
static void place_log(void *user, const srp_error *what) {
    const mission_site *site = user;
    const srp_log *log = site->context->log;
    if (log != NULL && what->file[0] == '\0') {
        mission_warn(site->source, log, "forces.radiation.materials", "%s", what->message);
    } else if (log != NULL && log->warn != NULL) {
        log->warn(log->user, what);
    }
}

/* Where optics are given here. */
static void add_remedy(srp_error *why) {
    if (why->remedy == SRP_REMEDY_OPTICS) {
        size_t used = strlen(why->message);
        snprintf(why->message + used, sizeof why->message - used,
                 " or under 'materials' of the mission");
        why->remedy = SRP_REMEDY_NONE;
    }
}

static srp_status read_mesh(const mission_site *site, const mission_radiation *in, const char *path,
                            srp_error *error) {
    const mission_source *source = site->source;
    srp_mesh_read_params params = srp_mesh_read_params_default();
    srp_materials *given = NULL;
    srp_status status = read_unit(source, in->unit, &params.metres_per_unit, error);
    if (status == SRP_OK) {
        status = srp_materials_create(&given, error);
    }
    for (unsigned i = 0; status == SRP_OK && i < in->material_count; ++i) {
        status = add_material(source, in, i, given, error);
    }
    if (status == SRP_OK) {
        srp_error why;
        const srp_log log = {place_log, (void *)site};
        status = srp_scene_read_obj(&path, 1, &params, given, &log, &site->mission->scene, &why);
        if (status != SRP_OK) {
            add_remedy(&why);
        }
        status = mission_at_file(source, "forces.radiation.file", status, &why, error);
    }
    srp_materials_destroy(given);
    return status;
}

/* ---- Method ---------------------------------------------------------------------------------- */

static const srp_method *find_method(const srp_mission_context *context, const char *name,
                                     const char *device) {
    if (context->find_method != NULL) {
        return context->find_method(context->user, name, device);
    }
    size_t count;
    const srp_method *const *methods = srp_method_list(&count);
    for (size_t i = 0; i < count; ++i) {
        if (strcmp(methods[i]->name, name) == 0 && strcmp(methods[i]->device, device) == 0) {
            return methods[i];
        }
    }
    return NULL;
}

static srp_status choose_method(const mission_site *site, const mission_radiation *in,
                                const srp_method **out, srp_error *error) {
    const char *name = in->method != NULL ? in->method : "exact";
    const char *device = in->device != NULL ? in->device : "cpu";
    const srp_method *any = find_method(site->context, name, "cpu");
    if (any == NULL || (any->shapes & SRP_SHAPE_MESH) == 0) {
        return mission_fail(site->source, error, SRP_BAD_DATA, "forces.radiation.method",
                            "found '%.80s', expected exact, raycast or raytrace", name);
    }
    *out = find_method(site->context, name, device);
    return *out != NULL
               ? SRP_OK
               : mission_fail(site->source, error, SRP_BAD_DATA, "forces.radiation.device",
                              "method %s is not there for '%.80s', expected cpu, or a device of "
                              "OpenGL where the program and the method have it",
                              name, device);
}

static void warn_of_unused(const mission_site *site, const mission_radiation *in,
                           const srp_method *method) {
    const bool lattice = (method->capabilities & SRP_METHOD_LATTICE) != 0;
    const bool bounces = (method->capabilities & SRP_METHOD_BOUNCE) != 0;
    const mission_key keys[] = {{"grid", lattice ? NULL : in->grid},
                                {"pixel", lattice ? NULL : in->pixel},
                                {"tolerance", lattice ? NULL : in->tolerance},
                                {"max_grid", lattice ? NULL : in->max_grid},
                                {"seed", lattice ? NULL : in->seed},
                                {"reflections", bounces ? NULL : in->reflections},
                                {"diffuse", bounces ? NULL : in->diffuse},
                                {"beams", bounces ? NULL : in->beams}};
    char what[80];
    snprintf(what, sizeof what, "method %.60s", method->name);
    mission_warn_unused(site, "forces.radiation", what, sizeof keys / sizeof keys[0], keys);
}

static srp_status read_counts(const mission_source *source, const mission_radiation *in,
                              srp_method_params *out, srp_error *error) {
    unsigned threads = (unsigned)out->threads;
    const struct {
        const char *path, *text;
        unsigned min, max;
        unsigned *out;
    } all[] = {{"forces.radiation.grid", in->grid, 1, 32768, &out->lattice.samples},
               {"forces.radiation.max_grid", in->max_grid, 1, 32768, &out->max_samples},
               {"forces.radiation.reflections", in->reflections, 0, 100, &out->reflections},
               {"forces.radiation.diffuse", in->diffuse, 0, 1024, &out->diffuse},
               {"forces.radiation.beams", in->beams, 0, 999999999, &out->mirrored_beams},
               {"forces.radiation.threads", in->threads, 1, 1024, &threads}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i) {
        srp_status status = mission_count(source, all[i].path, all[i].text, all[i].min, all[i].max,
                                          all[i].out, error);
        if (status != SRP_OK) {
            return status;
        }
    }
    out->threads = (int)threads;
    return mission_bits(source, "forces.radiation.seed", in->seed, &out->seed, error);
}

static srp_status read_params(const mission_source *source, const mission_radiation *in,
                              srp_method_params *out, srp_error *error) {
    if (in->grid != NULL && in->pixel != NULL) {
        return mission_fail(source, error, SRP_BAD_FORMAT, "forces.radiation.pixel",
                            "expected one of 'grid' and 'pixel'");
    }
    if (in->max_grid != NULL && in->tolerance == NULL) {
        return mission_fail(source, error, SRP_BAD_FORMAT, "forces.radiation.max_grid",
                            "it needs 'tolerance'");
    }
    srp_status status = read_counts(source, in, out, error);
    if (status == SRP_OK) {
        status = mission_positive(source, "forces.radiation.pixel", in->pixel, MISSION_LENGTH,
                                  &out->lattice.pixel, error);
    }
    return status == SRP_OK ? mission_positive(source, "forces.radiation.tolerance", in->tolerance,
                                               MISSION_NUMBER, &out->tolerance, error)
                            : status;
}

srp_status mission_prepare_mesh(const mission_site *site, const char *path, int threads,
                                srp_error *error) {
    const mission_radiation *in = mission_source_file(site->source)->forces->radiation;
    srp_method_params params = srp_method_params_default();
    const srp_method *method = NULL;
    srp_mission *mission = site->mission;
    srp_error why;
    params.threads = threads;
    srp_status status = choose_method(site, in, &method, error);
    if (status == SRP_OK) {
        status = read_params(site->source, in, &params, error);
    }
    if (status != SRP_OK) {
        return status;
    }
    warn_of_unused(site, in, method);
    status = read_mesh(site, in, path, error);
    if (status == SRP_OK) {
        status = srp_method_prepare(method, mission->scene, &params, &mission->prepared, &why);
        status = mission_at_entry(site->source, "forces.radiation.method", status, &why, error);
    }
    return status;
}
