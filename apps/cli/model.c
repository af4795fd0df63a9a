/* SPDX-License-Identifier: Apache-2.0 */
#include "model.h"

#include "messages.h"
#include "numbers.h"

#include <stdlib.h>
#include <string.h>

static const char MATERIAL_EXPECTED[] = "NAME=RHO_S,RHO_D or NAME=RHO_S,RHO_D,one-sided";

bool cli_material_split(const char *text, char *name, srp_optics *optics) {
    const char *equals = strrchr(text, '=');
    if (equals == NULL) {
        return false;
    }
    memcpy(name, text, (size_t)(equals - text));
    name[equals - text] = '\0';

    char shares[128];
    size_t length = strlen(equals + 1);
    static const char one_sided[] = ",one-sided";
    size_t ending = sizeof one_sided - 1;
    if (length >= sizeof shares) {
        return false;
    }
    memcpy(shares, equals + 1, length + 1);
    optics->one_sided = length > ending && strcmp(shares + length - ending, one_sided) == 0;
    if (optics->one_sided) {
        shares[length - ending] = '\0';
    }
    double rho[2];
    if (!cli_read_numbers(shares, 2, rho)) {
        return false;
    }
    optics->rho_s = rho[0];
    optics->rho_d = rho[1];
    return true;
}

static int add_material(srp_materials *materials, const char *text) {
    char *name = malloc(strlen(text) + 1);
    if (name == NULL) {
        cli_say("no memory for the material %s", text);
        return CLI_MACHINE_FAILED;
    }
    srp_optics optics;
    int exit_status = CLI_DONE;
    if (!cli_material_split(text, name, &optics)) {
        exit_status = cli_usage_error("--material %s: expected %s", text, MATERIAL_EXPECTED);
    } else {
        srp_error error;
        srp_status status = srp_materials_set(materials, name, optics, true, &error);
        if (status == SRP_NO_MEMORY) {
            exit_status = cli_input_error(&error);
        } else if (status != SRP_OK) {
            exit_status = cli_usage_error("--material %s: %s", text, error.message);
        }
    }
    free(name);
    return exit_status;
}

int cli_materials_given(const cli_list *list, srp_materials **out) {
    srp_materials *materials = NULL;
    srp_error error;
    if (srp_materials_create(&materials, &error) != SRP_OK) {
        return cli_input_error(&error);
    }
    for (size_t i = 0; i < list->count; ++i) {
        int status = add_material(materials, list->items[i]);
        if (status != CLI_DONE) {
            srp_materials_destroy(materials);
            return status;
        }
    }
    *out = materials;
    return CLI_DONE;
}

static int load_mesh(const cli_model_options *options, const cli_operands *operands,
                     srp_scene **out) {
    srp_materials *given = NULL;
    srp_scene *scene = NULL;
    int status = cli_materials_given(&options->materials, &given);
    if (status != CLI_DONE) {
        return status;
    }
    srp_mesh_read_params params = srp_mesh_read_params_default();
    params.metres_per_unit = options->metres_per_unit;
    srp_log log = cli_log();
    srp_error error;
    if (srp_scene_read_obj(operands->items, operands->count, &params, given, &log, &scene,
                           &error) != SRP_OK) {
        status = cli_input_error(&error);
    }
    srp_materials_destroy(given);
    if (status == CLI_DONE) {
        *out = scene;
    }
    return status;
}

static int load_plates(const char *path, srp_scene **out) {
    srp_plate *plates = NULL;
    size_t count;
    srp_error error;
    srp_status status = srp_plates_read(path, &plates, &count, &error);
    if (status == SRP_OK) {
        status = srp_scene_from_plates(plates, count, out, &error);
        srp_plates_free(plates);
    }
    return status == SRP_OK ? CLI_DONE : cli_input_error(&error);
}

/* What lies outside of a window that the user fixed is never sampled. */
static void warn_of_window(const srp_scene *scene, const srp_method *method,
                           const srp_lattice_params *lattice) {
    double radius = srp_scene_radius(scene);
    const double *w = lattice->window;
    if ((method->capabilities & SRP_METHOD_LATTICE) != 0 && lattice->kind == SRP_LATTICE_WINDOW &&
        (w[0] > -radius || w[1] < radius || w[2] > -radius || w[3] < radius)) {
        cli_say("warning: the model reaches %g m from the origin, --window may miss parts of it",
                radius);
    }
}

int cli_model_load(const cli_model_options *model, const cli_method_options *options,
                   const cli_operands *operands, const srp_method *method,
                   const srp_method_params *params, cli_model *out) {
    cli_model loaded = {NULL, NULL};
    srp_error error;
    int status = CLI_DONE;
    if ((method->shapes & SRP_SHAPE_MESH) != 0) {
        status = load_mesh(model, operands, &loaded.scene);
    } else if ((method->shapes & SRP_SHAPE_PLATES) != 0) {
        status = load_plates(model->plates, &loaded.scene);
    } else if (srp_scene_from_sphere(options->cr, options->area, &loaded.scene, &error) != SRP_OK) {
        status = cli_input_error(&error);
    }
    if (status == CLI_DONE &&
        srp_method_prepare(method, loaded.scene, params, &loaded.prepared, &error) != SRP_OK) {
        status = cli_input_error(&error);
    }
    if (status != CLI_DONE) {
        cli_model_release(&loaded);
        return status;
    }
    warn_of_window(loaded.scene, method, &params->lattice);
    *out = loaded;
    return CLI_DONE;
}

void cli_model_release(cli_model *model) {
    srp_prepared_release(model->prepared);
    srp_scene_destroy(model->scene);
    model->prepared = NULL;
    model->scene = NULL;
}
