/* SPDX-License-Identifier: Apache-2.0 */
#include "method_options.h"

#include "messages.h"
#include "methods.h"
#include "numbers.h"
#include "suggest.h"

#include <ctype.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- tables of options ---- */

static const struct {
    const char *name;
    double metres;
} UNITS[] = {{"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}, {"in", 0.0254}, {"ft", 0.3048}};

bool cli_set_unit(const cli_option *option, void *target, const char *text) {
    double *metres = (double *)((char *)target + option->offset);
    for (size_t i = 0; i < sizeof UNITS / sizeof UNITS[0]; ++i) {
        if (strcmp(text, UNITS[i].name) == 0) {
            *metres = UNITS[i].metres;
            return true;
        }
    }
    double value;
    if (!cli_read_number(text, &value) || !(value > 0.0)) {
        return cli_reject(option, text, "m, mm, cm, in, ft, or the number of metres in one unit");
    }
    *metres = value;
    return true;
}

static const cli_option MODEL_OPTIONS[MODEL_OPTION_COUNT] = {
    [MODEL_MATERIAL] = {.name = "material",
                        .value = "NAME=RHO_S,RHO_D[,one-sided]",
                        .help =
                            "Optics of the material NAME: specular and diffuse share. Wins over "
                            "the MTL file. The back of a one-sided material absorbs. May be "
                            "given for several materials.",
                        .set = cli_set_list,
                        .offset = offsetof(cli_model_options, materials)},
    [MODEL_UNIT] = {.name = "unit",
                    .value = "UNIT",
                    .complete = CLI_COMPLETE_WORDS,
                    .words = "m mm cm in ft",
                    .help = "Unit of the OBJ files: m (default), mm, cm, in, ft, or a number of "
                            "metres.",
                    .set = cli_set_unit,
                    .offset = offsetof(cli_model_options, metres_per_unit)},
    [MODEL_PLATES] = {.name = "plates",
                      .value = "FILE",
                      .complete = CLI_COMPLETE_FILE,
                      .help = "Plates file of an N-plate model, in place of OBJ files.",
                      .set = cli_set_text,
                      .offset = offsetof(cli_model_options, plates)},
};

const cli_group cli_group_model = {"Model", MODEL_OPTIONS, MODEL_OPTION_COUNT};
/* Its last option is --plates. */
const cli_group cli_group_shape = {"Model", MODEL_OPTIONS, MODEL_PLATES};

static const cli_range CELLS = {1.0, 32768.0, "a whole number from 1 to 32768"};
static const cli_range REFLECTIONS = {0.0, 100.0, "a whole number from 0 to 100"};
static const cli_range DIFFUSE = {0.0, 1024.0, "a whole number from 0 to 1024"};
static const cli_range BEAMS = {0.0, 1e9, "a whole number from 0 to 1000000000"};
static const cli_range THREADS = {1.0, 1024.0, "a whole number from 1 to 1024"};

static const cli_option METHOD_OPTIONS[METHOD_OPTION_COUNT] = {
    [METHOD_NAME] = {.name = "method",
                     .value = "NAME",
                     .complete = CLI_COMPLETE_METHODS,
                     .help = "How to compute, see Methods. Default: exact.",
                     .set = cli_set_text,
                     .offset = offsetof(cli_method_options, name)},
    [METHOD_DEVICE] = {.name = "device",
                       .value = "NAME",
                       .complete = CLI_COMPLETE_WORDS,
                       .words = cli_device_words,
                       .help = cli_device_help,
                       .set = cli_set_text,
                       .offset = offsetof(cli_method_options, device)},
    [METHOD_GRID] = {.name = "grid",
                     .value = "N",
                     .help =
                         "Samples along the longer side of the silhouette's box; with --window, "
                         "cells along both of its sides. Default: 512.",
                     .set = cli_set_count,
                     .offset = offsetof(cli_method_options, grid),
                     .range = &CELLS},
    [METHOD_PIXEL] = {.name = "pixel",
                      .value = "METRES",
                      .help = "Side of a sample's cell, in place of --grid.",
                      .set = cli_set_number,
                      .offset = offsetof(cli_method_options, pixel),
                      .range = &CLI_POSITIVE},
    [METHOD_WINDOW] = {.name = "window",
                       .value = "U0,U1,V0,V1",
                       .help =
                           "Sample a fixed window of the plane that faces the Sun [m], about the "
                           "origin of the body: U along growing azimuth, V along growing "
                           "elevation.",
                       .set = cli_set_window,
                       .offset = offsetof(cli_method_options, window)},
    [METHOD_COLUMNS] = {.name = "columns",
                        .value = "N",
                        .help = "Cells of the window along U.",
                        .set = cli_set_count,
                        .offset = offsetof(cli_method_options, columns),
                        .range = &CELLS},
    [METHOD_ROWS] = {.name = "rows",
                     .value = "N",
                     .help = "Cells of the window along V.",
                     .set = cli_set_count,
                     .offset = offsetof(cli_method_options, rows),
                     .range = &CELLS},
    [METHOD_SEED] = {.name = "seed",
                     .value = "S",
                     .help = "Seed of all that is drawn at random. The same seed gives the same "
                             "result. Default: 0.",
                     .set = cli_set_bits,
                     .offset = offsetof(cli_method_options, seed)},
    [METHOD_TOLERANCE] = {.name = "tolerance",
                          .value = "REL",
                          .help = "Refine the samples until the standard error of f is below REL "
                                  "times |f|, or as far as --max-grid allows.",
                          .set = cli_set_number,
                          .offset = offsetof(cli_method_options, tolerance),
                          .range = &CLI_POSITIVE},
    [METHOD_MAX_GRID] = {.name = "max-grid",
                         .value = "N",
                         .help = "Samples along a side beyond which --tolerance gives up; the "
                                 "result says so. Default: 8192.",
                         .set = cli_set_count,
                         .offset = offsetof(cli_method_options, max_grid),
                         .range = &CELLS},
    [METHOD_REFLECTIONS] = {.name = "reflections",
                            .value = "R",
                            .help = "Bounces that light is followed for after its first hit. "
                                    "Default: 2.",
                            .set = cli_set_count,
                            .offset = offsetof(cli_method_options, reflections),
                            .range = &REFLECTIONS},
    [METHOD_DIFFUSE] = {.name = "diffuse",
                        .value = "K",
                        .help = "Rays that carry the diffuse light of each sample (multiple "
                                "scattering). Default: 0, only mirrored light is followed (single "
                                "scattering).",
                        .set = cli_set_count,
                        .offset = offsetof(cli_method_options, diffuse),
                        .range = &DIFFUSE},
    [METHOD_BEAMS] = {.name = "beams",
                      .value = "N",
                      .help = "Mirrored beams that are followed exactly for one direction, at "
                              "most. Where it would take more, mirrored light is sampled. 0: "
                              "always. Default: 8192.",
                      .set = cli_set_count,
                      .offset = offsetof(cli_method_options, beams),
                      .range = &BEAMS},
    [METHOD_CR] = {.name = "cr",
                   .value = "CR",
                   .help = "Reflectivity coefficient of a cannonball.",
                   .set = cli_set_number,
                   .offset = offsetof(cli_method_options, cr),
                   .range = &CLI_NOT_NEGATIVE},
    [METHOD_AREA] = {.name = "area",
                     .value = "M2",
                     .help = "Cross-section of a cannonball [m^2].",
                     .set = cli_set_number,
                     .offset = offsetof(cli_method_options, area),
                     .range = &CLI_POSITIVE},
    [METHOD_REFERENCE] = {.name = "reference",
                          .value = "X,Y,Z",
                          .help =
                              "Point that moments are taken about [m], often the centre of mass. "
                              "Default: 0,0,0.",
                          .set = cli_set_vector,
                          .offset = offsetof(cli_method_options, reference)},
    [METHOD_THREADS] = {.name = "threads",
                        .value = "T",
                        .help = "Threads to compute with. Default: one per processor. The result "
                                "does not depend on it.",
                        .set = cli_set_count,
                        .offset = offsetof(cli_method_options, threads),
                        .range = &THREADS},
};

const cli_group cli_group_method = {"Method", METHOD_OPTIONS, METHOD_OPTION_COUNT};

cli_model_options cli_model_options_default(void) {
    cli_model_options options;
    memset(&options, 0, sizeof options);
    options.metres_per_unit = 1.0;
    return options;
}

cli_method_options cli_method_options_default(void) {
    cli_method_options options;
    memset(&options, 0, sizeof options);
    options.name = "exact";
    options.device = "cpu";
    return options;
}

/* ---- which method uses which option ---- */

/* What a method must be or have for an option to mean anything to it; 0 = nothing. */
typedef struct use {
    unsigned shapes, capabilities;
} use;

static const use MODEL_USE[MODEL_OPTION_COUNT] = {
    [MODEL_MATERIAL] = {SRP_SHAPE_MESH, 0},
    [MODEL_UNIT] = {SRP_SHAPE_MESH, 0},
    [MODEL_PLATES] = {SRP_SHAPE_PLATES, 0},
};

static const use METHOD_USE[METHOD_OPTION_COUNT] = {
    [METHOD_GRID] = {0, SRP_METHOD_LATTICE},       [METHOD_PIXEL] = {0, SRP_METHOD_LATTICE},
    [METHOD_WINDOW] = {0, SRP_METHOD_LATTICE},     [METHOD_COLUMNS] = {0, SRP_METHOD_LATTICE},
    [METHOD_ROWS] = {0, SRP_METHOD_LATTICE},       [METHOD_SEED] = {0, SRP_METHOD_LATTICE},
    [METHOD_REFLECTIONS] = {0, SRP_METHOD_BOUNCE}, [METHOD_DIFFUSE] = {0, SRP_METHOD_BOUNCE},
    [METHOD_BEAMS] = {0, SRP_METHOD_BOUNCE},       [METHOD_MAX_GRID] = {0, SRP_METHOD_LATTICE},
    [METHOD_TOLERANCE] = {0, SRP_METHOD_LATTICE},  [METHOD_CR] = {SRP_SHAPE_SPHERE, 0},
    [METHOD_AREA] = {SRP_SHAPE_SPHERE, 0},         [METHOD_REFERENCE] = {0, SRP_METHOD_MOMENT},
};

static bool uses(const srp_method *method, use what) {
    return (what.shapes == 0 || (method->shapes & what.shapes) != 0) &&
           (what.capabilities == 0 || (method->capabilities & what.capabilities) != 0);
}

bool cli_method_uses(const srp_method *method, int option) {
    return uses(method, METHOD_USE[option]);
}

enum { NAMES_SIZE = 256 };

/* Names of the methods that use it, with commas. */
static void name_users(use what, char *names) {
    size_t used = 0;
    const srp_method *method;
    names[0] = '\0';
    for (size_t i = 0; (method = cli_method_named_at(i)) != NULL && used < NAMES_SIZE; ++i) {
        if (uses(method, what)) {
            used += (size_t)snprintf(names + used, NAMES_SIZE - used, "%s%s", used > 0 ? ", " : "",
                                     method->name);
        }
    }
}

static int check_uses(const cli_group *group, const use *table, cli_given given,
                      const srp_method *method) {
    for (size_t i = 0; i < group->count; ++i) {
        if (cli_is_given(given, (int)i) && !uses(method, table[i])) {
            char names[NAMES_SIZE];
            name_users(table[i], names);
            return cli_usage_error("method %s does not use --%s (methods that do: %s)",
                                   method->name, group->options[i].name, names);
        }
    }
    return CLI_DONE;
}

static int check_shape(const cli_model_options *model, const cli_method_options *options,
                       size_t operand_count, const srp_method *method) {
    bool mesh = (method->shapes & SRP_SHAPE_MESH) != 0;
    if (!mesh && operand_count > 0) {
        return cli_usage_error("method %s does not use OBJ files", method->name);
    }
    if (mesh && operand_count == 0) {
        return cli_usage_error("method %s needs an OBJ file: MODEL.obj", method->name);
    }
    if ((method->shapes & SRP_SHAPE_PLATES) != 0 && model->plates == NULL) {
        return cli_usage_error("method %s needs --plates FILE", method->name);
    }
    if ((method->shapes & SRP_SHAPE_SPHERE) != 0 &&
        !(cli_is_given(options->given, METHOD_CR) && cli_is_given(options->given, METHOD_AREA))) {
        return cli_usage_error("method %s needs --cr CR and --area M2", method->name);
    }
    return CLI_DONE;
}

/* ---- choosing ---- */

/* Devices that have a method of this name, with commas; those with a number are told of by the
 * caller. */
static void name_devices(const char *name, char *names) {
    size_t used = 0;
    const srp_method *method;
    names[0] = '\0';
    for (size_t i = 0; (method = cli_method_at(i)) != NULL && used < NAMES_SIZE; ++i) {
        bool numbered = isdigit((unsigned char)method->device[strlen(method->device) - 1]) != 0;
        if (strcmp(method->name, name) == 0 && !numbered) {
            used += (size_t)snprintf(names + used, NAMES_SIZE - used, "%s%s", used > 0 ? ", " : "",
                                     method->device);
        }
    }
}

static int refuse_device(const cli_method_options *options) {
    if (cli_device_is_left_out(options->device)) {
        return cli_usage_error("--device %s: this srp is built without OpenGL", options->device);
    }
    char names[NAMES_SIZE];
    name_devices(options->name, names);
    bool numbered = strstr(names, "gl:egl") != NULL;
    return cli_usage_error("method %s is not there for --device %s, only for %s%s", options->name,
                           options->device, names, numbered ? " and gl:egl:N, N from 0 to 15" : "");
}

static int find_method(const cli_method_options *options, const srp_method **method) {
    const srp_method *found = cli_method_find(options->name, options->device);
    if (found != NULL) {
        *method = found;
        return CLI_DONE;
    }
    const srp_method *candidate;
    cli_suggestion near = cli_suggestion_begin(options->name);
    bool named = false;
    for (size_t i = 0; (candidate = cli_method_at(i)) != NULL; ++i) {
        named = named || strcmp(candidate->name, options->name) == 0;
        cli_suggestion_offer(&near, candidate->name);
    }
    if (named) {
        return refuse_device(options);
    }
    if (near.best != NULL) {
        return cli_usage_error("unknown method '%s', did you mean '%s'?", options->name, near.best);
    }
    char names[NAMES_SIZE];
    name_users((use){0, 0}, names);
    return cli_usage_error("unknown method '%s' (methods: %s)", options->name, names);
}

static int choose_lattice(const cli_method_options *options, const srp_method *method,
                          srp_lattice_params *lattice) {
    cli_given given = options->given;
    bool window = cli_is_given(given, METHOD_WINDOW), grid = cli_is_given(given, METHOD_GRID);
    bool pixel = cli_is_given(given, METHOD_PIXEL);
    bool columns = cli_is_given(given, METHOD_COLUMNS), rows = cli_is_given(given, METHOD_ROWS);
    if (pixel && (grid || window)) {
        return cli_usage_error("--pixel and --%s exclude each other", grid ? "grid" : "window");
    }
    if ((columns || rows) && !window) {
        return cli_usage_error("--%s needs --window", columns ? "columns" : "rows");
    }
    if (columns != rows) {
        return cli_usage_error("--columns and --rows go together (--grid N sets both)");
    }
    if (columns && grid) {
        return cli_usage_error("--grid and --columns exclude each other");
    }
    if (cli_is_given(given, METHOD_MAX_GRID) && !cli_is_given(given, METHOD_TOLERANCE)) {
        return cli_usage_error("--max-grid needs --tolerance");
    }
    if (cli_is_given(given, METHOD_MAX_GRID) && !pixel && !window &&
        options->max_grid < (grid ? options->grid : lattice->samples)) {
        return cli_usage_error(
            "--max-grid %u is less than --grid %u, which is where refining begins",
            options->max_grid, grid ? options->grid : lattice->samples);
    }
    bool bounces = (method->capabilities & SRP_METHOD_BOUNCE) != 0;
    if (window && !bounces && cli_is_given(given, METHOD_SEED)) {
        return cli_usage_error("a --window has no random shift: --seed would be without effect");
    }
    if (grid) {
        lattice->samples = lattice->columns = lattice->rows = options->grid;
    }
    if (pixel) {
        lattice->pixel = options->pixel;
    }
    if (window) {
        lattice->kind = SRP_LATTICE_WINDOW;
        memcpy(lattice->window, options->window, sizeof lattice->window);
    }
    if (columns) {
        lattice->columns = options->columns;
        lattice->rows = options->rows;
    }
    return CLI_DONE;
}

int cli_method_choose(const cli_model_options *model, const cli_method_options *options,
                      size_t operand_count, const srp_method **method, srp_method_params *params) {
    int status = find_method(options, method);
    if (status == CLI_DONE) {
        status = check_uses(&cli_group_model, MODEL_USE, model->given, *method);
    }
    if (status == CLI_DONE) {
        status = check_uses(&cli_group_method, METHOD_USE, options->given, *method);
    }
    if (status == CLI_DONE) {
        status = check_shape(model, options, operand_count, *method);
    }
    *params = srp_method_params_default();
    if (status == CLI_DONE) {
        status = choose_lattice(options, *method, &params->lattice);
    }
    if (cli_is_given(options->given, METHOD_THREADS)) {
        params->threads = (int)options->threads;
    }
    if (cli_is_given(options->given, METHOD_TOLERANCE)) {
        params->tolerance = options->tolerance;
    }
    if (cli_is_given(options->given, METHOD_MAX_GRID)) {
        params->max_samples = options->max_grid;
    }
    if (cli_is_given(options->given, METHOD_BEAMS)) {
        params->mirrored_beams = options->beams;
    }
    if (cli_is_given(options->given, METHOD_REFLECTIONS)) {
        params->reflections = options->reflections;
    }
    params->diffuse = options->diffuse;
    params->seed = options->seed;
    params->reference = options->reference;
    return status;
}
