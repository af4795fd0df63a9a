/* SPDX-License-Identifier: Apache-2.0 */
/* The options that say what light falls on and how it is answered, shared by all commands that
 * compute. */
#ifndef SRP_CLI_METHOD_OPTIONS_H
#define SRP_CLI_METHOD_OPTIONS_H

#include "command.h"

#include <srp/method.h>

/* The model: files, and what is said about them. */
enum { MODEL_MATERIAL, MODEL_UNIT, MODEL_PLATES, MODEL_OPTION_COUNT };

typedef struct cli_model_options {
    cli_given given;
    cli_list materials; /* NAME=RHO_S,RHO_D[,one-sided] */
    double metres_per_unit;
    const char *plates; /* NULL = none */
} cli_model_options;

enum {
    METHOD_NAME,
    METHOD_DEVICE,
    METHOD_GRID,
    METHOD_PIXEL,
    METHOD_WINDOW,
    METHOD_COLUMNS,
    METHOD_ROWS,
    METHOD_SEED,
    METHOD_TOLERANCE,
    METHOD_MAX_GRID,
    METHOD_REFLECTIONS,
    METHOD_DIFFUSE,
    METHOD_BEAMS,
    METHOD_CR,
    METHOD_AREA,
    METHOD_REFERENCE,
    METHOD_THREADS,
    METHOD_OPTION_COUNT
};

typedef struct cli_method_options {
    cli_given given;
    const char *name, *device;
    uint32_t grid, columns, rows, threads;
    double pixel, window[4];
    uint64_t seed;
    double tolerance;
    uint32_t max_grid, reflections, diffuse, beams;
    double cr, area;
    srp_vec3 reference;
} cli_method_options;

extern const cli_group cli_group_model, cli_group_method;
/* The model's without --plates, for what needs a shape. */
extern const cli_group cli_group_shape;

/* Setter: metres in a unit of length, a double. */
bool cli_set_unit(const cli_option *option, void *target, const char *text);

cli_model_options cli_model_options_default(void);
cli_method_options cli_method_options_default(void);

/* Does `method` use the option METHOD_..., which is then worth showing? */
bool cli_method_uses(const srp_method *method, int option);

/*
 * The method that is meant and its parameters, after a check that it uses every option given and
 * lacks none. Reads no file. CLI_DONE, or CLI_BAD_USAGE after saying why.
 */
int cli_method_choose(const cli_model_options *model, const cli_method_options *options,
                      size_t operand_count, const srp_method **method, srp_method_params *params);

#endif
