/* SPDX-License-Identifier: Apache-2.0 */
/* srp force: what the Sun does from one direction. */
#include "commands.h"
#include "json.h"
#include "messages.h"
#include "model.h"

#include <srp/sunlight.h>
#include <srp/table.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    FORCE_AZ,
    FORCE_EL,
    FORCE_MASS,
    FORCE_DISTANCE,
    FORCE_FLUX,
    FORCE_BASIS,
    FORCE_JSON,
    FORCE_OPTION_COUNT
};

typedef struct force_options {
    cli_given given;
    double az, el, mass, distance_au, flux;
    bool basis, json;
} force_options;

static const cli_range AZIMUTH = {-360.0, 360.0, "an angle from -360 to 360 degrees"};
static const cli_range ELEVATION = {-90.0, 90.0, "an angle from -90 to 90 degrees"};

static const cli_option OPTIONS[FORCE_OPTION_COUNT] = {
    [FORCE_AZ] = {.name = "az",
                  .value = "DEG",
                  .help = "Azimuth of the Sun in body axes: from +X towards +Y.",
                  .set = cli_set_number,
                  .offset = offsetof(force_options, az),
                  .range = &AZIMUTH},
    [FORCE_EL] = {.name = "el",
                  .value = "DEG",
                  .help = "Elevation of the Sun: from the XY plane towards +Z.",
                  .set = cli_set_number,
                  .offset = offsetof(force_options, el),
                  .range = &ELEVATION},
    [FORCE_MASS] = {.name = "mass",
                    .value = "KG",
                    .help = "Mass of the spacecraft; gives the acceleration.",
                    .set = cli_set_number,
                    .offset = offsetof(force_options, mass),
                    .range = &CLI_POSITIVE},
    [FORCE_DISTANCE] = {.name = "distance-au",
                        .value = "AU",
                        .help = "Distance from the Sun. Default: 1.",
                        .set = cli_set_number,
                        .offset = offsetof(force_options, distance_au),
                        .range = &CLI_POSITIVE},
    [FORCE_FLUX] = {.name = "flux",
                    .value = "W/M2",
                    .help = "Solar flux at 1 au. Default: 1367.",
                    .set = cli_set_number,
                    .offset = offsetof(force_options, flux),
                    .range = &CLI_POSITIVE},
    [FORCE_BASIS] = {.name = "basis",
                     .help = "Print the sums of each material, from which the force follows for "
                             "any optics.",
                     .set = cli_set_flag,
                     .offset = offsetof(force_options, basis)},
    [FORCE_JSON] = {.name = "json",
                    .help = "Print JSON.",
                    .set = cli_set_flag,
                    .offset = offsetof(force_options, json)},
};

static const cli_group DIRECTION = {"Direction and output", OPTIONS, FORCE_OPTION_COUNT};
static const cli_group *const GROUPS[] = {&DIRECTION, &cli_group_model, &cli_group_method};

/* All that is printed. */
typedef struct force_result {
    const force_options *options;
    const cli_operands *operands;
    const srp_prepared *prepared;
    srp_vec3 s;
    srp_response response;
    srp_basis *basis; /* NULL, or (material count + 1) */
    double pressure;  /* [N/m^2] */
} force_result;

static bool has(const force_result *result, unsigned capability) {
    return (srp_prepared_method(result->prepared)->capabilities & capability) != 0;
}

/* ---- text ---- */

static void print_vector(const char *label, srp_vec3 v, const char *unit) {
    printf("%-18s % .9e % .9e % .9e%s%s\n", label, v.x, v.y, v.z, unit[0] != '\0' ? " " : "", unit);
}

static void print_physical(const force_result *result) {
    const force_options *options = result->options;
    double p = result->pressure;
    printf("\nAt %g au from the Sun, P = %.9e N/m^2 (%g W/m^2 at 1 au):\n", options->distance_au, p,
           options->flux);
    print_vector("force F", srp_vec3_scale(p, result->response.f), "N");
    if (has(result, SRP_METHOD_MOMENT)) {
        print_vector("torque T", srp_vec3_scale(p, result->response.t), "N m");
    }
    if (cli_is_given(options->given, FORCE_MASS)) {
        print_vector("acceleration a", srp_vec3_scale(p / options->mass, result->response.f),
                     "m/s^2");
    }
}

static void print_basis_row(const char *name, srp_optics optics, const srp_basis *basis,
                            bool moment) {
    printf("\n%s: rho_s %g, rho_d %g%s\n", name, optics.rho_s, optics.rho_d,
           optics.one_sided ? ", one-sided" : "");
    printf("%-18s % .9e m^2\n", "  a", basis->a);
    print_vector("  b", basis->b, "m^2");
    print_vector("  c", basis->c, "m^2");
    if (moment) {
        print_vector("  ra", basis->ra, "m^3");
        print_vector("  rb", basis->rb, "m^3");
        print_vector("  rc", basis->rc, "m^3");
    }
}

static void print_basis(const force_result *result) {
    const srp_scene *scene = srp_prepared_scene(result->prepared);
    size_t count = srp_scene_material_count(scene);
    bool moment = has(result, SRP_METHOD_MOMENT);
    printf("\nSums per material: f = -[(1 - rho_s) a s + 2 rho_s b + 2/3 rho_d c]\n");
    for (size_t i = 0; i < count; ++i) {
        const char *name = srp_scene_material_name(scene, i);
        print_basis_row(name[0] != '\0' ? name : "(no name)", srp_scene_material_optics(scene, i),
                        &result->basis[i], moment);
    }
    if (result->response.back_area > 0.0) {
        print_basis_row("(backs of one-sided materials)", (srp_optics){0.0, 0.0, true},
                        &result->basis[count], moment);
    }
}

static bool mirrors_are_sampled(const srp_response *r) {
    return (r->flags & SRP_RESPONSE_MIRRORS_SAMPLED) != 0;
}

static const char *how_mirrored(const srp_response *r) {
    return mirrors_are_sampled(r) ? "sampled (more beams than --beams allows)" : "exact";
}

static void print_text(const force_result *result) {
    const force_options *options = result->options;
    const srp_response *r = &result->response;
    const srp_method *method = srp_prepared_method(result->prepared);
    srp_vec3 reference = srp_prepared_params(result->prepared)->reference;
    printf("method             %s (%s)\n", method->name, method->device);
    printf("Sun                az %g deg, el %g deg\n", options->az, options->el);
    print_vector("direction s", result->s, "");
    print_vector("area vector f", r->f, "m^2");
    printf("%-18s % .9e m^2\n", "  |f|", srp_vec3_norm(r->f));
    printf("%-18s % .9e m^2%s\n", "  standard error", r->f_error,
           has(result, SRP_METHOD_EXACT) ? " (no sampling)" : "");
    if (has(result, SRP_METHOD_BOUNCE)) {
        print_vector("  of it reflected", r->f_bounce, "m^2");
        printf("%-18s  %s\n", "  mirrored light", how_mirrored(r));
    }
    if (has(result, SRP_METHOD_MOMENT)) {
        print_vector("moment vector t", r->t, "m^3");
        printf("%-18s % .9e m^3\n", "  standard error", r->t_error);
        printf("%-18s % g % g % g m\n", "  about", reference.x, reference.y, reference.z);
    }
    printf("%-18s % .9e m^2\n", "lit area", r->lit_area);
    if (r->back_area > 0.0) {
        printf("%-18s % .9e m^2\n", "  absorbing backs", r->back_area);
    }
    if (has(result, SRP_METHOD_BOUNCE)) {
        printf("%-18s % .9e of the light\n", "unresolved", r->unresolved);
    }
    if (r->samples > 0) {
        printf("%-18s  %llu\n", "samples", (unsigned long long)r->samples);
    }
    print_physical(result);
    if (result->basis != NULL) {
        print_basis(result);
    }
}

/* ---- JSON ---- */

static void write_basis(cli_json *json, const force_result *result) {
    const srp_scene *scene = srp_prepared_scene(result->prepared);
    size_t count = srp_scene_material_count(scene);
    cli_json_open_array(json, "materials");
    for (size_t i = 0; i <= count; ++i) {
        srp_optics optics = {0.0, 0.0, true}; /* the last row: backs of one-sided materials */
        if (i < count) {
            optics = srp_scene_material_optics(scene, i);
        }
        cli_json_open_object(json, NULL);
        cli_json_text(json, "name", i < count ? srp_scene_material_name(scene, i) : NULL);
        cli_json_number(json, "rho_s", optics.rho_s);
        cli_json_number(json, "rho_d", optics.rho_d);
        cli_json_flag(json, "one_sided", optics.one_sided);
        cli_json_number(json, "a_m2", result->basis[i].a);
        cli_json_vector(json, "b_m2", result->basis[i].b);
        cli_json_vector(json, "c_m2", result->basis[i].c);
        if (has(result, SRP_METHOD_MOMENT)) {
            cli_json_vector(json, "ra_m3", result->basis[i].ra);
            cli_json_vector(json, "rb_m3", result->basis[i].rb);
            cli_json_vector(json, "rc_m3", result->basis[i].rc);
        }
        cli_json_close_object(json);
    }
    cli_json_close_array(json);
}

static void write_physical(cli_json *json, const force_result *result) {
    const force_options *options = result->options;
    double p = result->pressure;
    cli_json_number(json, "flux_w_m2", options->flux);
    cli_json_number(json, "distance_au", options->distance_au);
    cli_json_number(json, "pressure_n_m2", p);
    cli_json_vector(json, "force_n", srp_vec3_scale(p, result->response.f));
    if (has(result, SRP_METHOD_MOMENT)) {
        cli_json_vector(json, "torque_n_m", srp_vec3_scale(p, result->response.t));
    }
    if (cli_is_given(options->given, FORCE_MASS)) {
        cli_json_number(json, "mass_kg", options->mass);
        cli_json_vector(json, "acceleration_m_s2",
                        srp_vec3_scale(p / options->mass, result->response.f));
    }
}

static void write_json(const force_result *result) {
    const srp_response *r = &result->response;
    const srp_method *method = srp_prepared_method(result->prepared);
    cli_json json;
    cli_json_begin(&json, stdout);
    cli_json_open_array(&json, "models");
    for (size_t i = 0; i < result->operands->count; ++i) {
        cli_json_text(&json, NULL, result->operands->items[i]);
    }
    cli_json_close_array(&json);
    cli_json_text(&json, "method", method->name);
    cli_json_text(&json, "device", method->device);
    cli_json_number(&json, "azimuth_deg", result->options->az);
    cli_json_number(&json, "elevation_deg", result->options->el);
    cli_json_vector(&json, "sun_direction", result->s);
    cli_json_vector(&json, "f_m2", r->f);
    cli_json_number(&json, "f_error_m2", r->f_error);
    if (has(result, SRP_METHOD_MOMENT)) {
        cli_json_vector(&json, "t_m3", r->t);
        cli_json_number(&json, "t_error_m3", r->t_error);
        cli_json_vector(&json, "reference_m", srp_prepared_params(result->prepared)->reference);
    }
    if (has(result, SRP_METHOD_BOUNCE)) {
        cli_json_vector(&json, "f_bounce_m2", r->f_bounce);
        cli_json_vector(&json, "t_bounce_m3", r->t_bounce);
        cli_json_number(&json, "unresolved", r->unresolved);
        cli_json_flag(&json, "mirrors_sampled", mirrors_are_sampled(r));
    }
    cli_json_number(&json, "lit_area_m2", r->lit_area);
    cli_json_number(&json, "back_area_m2", r->back_area);
    cli_json_count(&json, "samples", r->samples);
    cli_json_flag(&json, "tolerance_missed", (r->flags & SRP_RESPONSE_TOLERANCE_MISSED) != 0);
    cli_json_flag(&json, "cut", (r->flags & SRP_RESPONSE_CUT) != 0);
    write_physical(&json, result);
    if (result->basis != NULL) {
        write_basis(&json, result);
    }
    cli_json_end(&json);
}

/* ---- the command ---- */

static int compute(force_result *result) {
    srp_error error;
    if (result->options->basis) {
        size_t rows = srp_scene_material_count(srp_prepared_scene(result->prepared)) + 1;
        result->basis = calloc(rows, sizeof *result->basis);
        if (result->basis == NULL) {
            cli_say("no memory for %zu materials", rows);
            return CLI_MACHINE_FAILED;
        }
    }
    result->s = srp_direction_from_deg(result->options->az, result->options->el);
    if (srp_prepared_respond(result->prepared, 1, &result->s, &result->response, result->basis,
                             &error) != SRP_OK) {
        return cli_input_error(&error);
    }
    srp_sunlight light = srp_sunlight_default();
    light.flux = result->options->flux;
    result->pressure = srp_sunlight_pressure(light, result->options->distance_au * light.au);
    return CLI_DONE;
}

static int force(const force_options *options, const cli_model_options *model,
                 const cli_method_options *how, const cli_operands *operands) {
    const srp_method *method = NULL;
    srp_method_params params;
    if (!cli_is_given(options->given, FORCE_AZ) || !cli_is_given(options->given, FORCE_EL)) {
        return cli_usage_error("the direction of the Sun is missing: --az DEG --el DEG");
    }
    int status = cli_method_choose(model, how, operands->count, &method, &params);
    if (status != CLI_DONE) {
        return status;
    }
    if (options->basis && (method->capabilities & SRP_METHOD_BASIS) == 0) {
        return cli_usage_error("method %s gives no sums per material: --basis", method->name);
    }
    cli_model loaded;
    status = cli_model_load(model, how, operands, method, &params, &loaded);
    if (status != CLI_DONE) {
        return status;
    }
    force_result result = {.options = options, .operands = operands, .prepared = loaded.prepared};
    status = compute(&result);
    if (status == CLI_DONE) {
        options->json ? write_json(&result) : print_text(&result);
        if ((result.response.flags & SRP_RESPONSE_TOLERANCE_MISSED) != 0) {
            cli_say("warning: the tolerance was not reached with %u samples a side",
                    params.max_samples);
        }
        if ((result.response.flags & SRP_RESPONSE_CUT) != 0) {
            cli_say("warning: part of the model lies outside the window");
        }
    }
    free(result.basis);
    cli_model_release(&loaded);
    return status;
}

static int run(const cli_command *command, int argc, char **argv) {
    force_options options = {.distance_au = 1.0, .flux = SRP_SOLAR_FLUX};
    cli_model_options model = cli_model_options_default();
    cli_method_options how = cli_method_options_default();
    void *const targets[] = {&options, &model, &how};
    cli_operands operands;
    int status;
    if (cli_command_parse(command, argc, argv, targets, &operands, &status)) {
        status = force(&options, &model, &how, &operands);
    }
    cli_list_free(&model.materials);
    return status;
}

const cli_command cli_command_force = {
    .name = "force",
    .operands = "MODEL.obj...",
    .operand_files = "obj",
    .summary = "force, moment and lit area for one direction of the Sun",
    .description =
        "Computes the response of a spacecraft to sunlight from one direction: the area vector f "
        "[m^2] and the moment vector t [m^3] in body axes, the lit cross-section, and the standard "
        "error of f. Force F = P f, torque T = P t and, with --mass, acceleration P f / m follow "
        "with the radiation pressure P at the distance from the Sun. Several OBJ files are joined.",
    .examples = "srp force box-wing.obj --az 30 --el 10\n"
                "srp force box-wing.obj --az 30 --el 10 --mass 850 --json\n"
                "srp force --method cannonball --cr 1.8 --area 20 --az 0 --el 0",
    .groups = GROUPS,
    .group_count = sizeof GROUPS / sizeof GROUPS[0],
    .run = run,
};
