/* SPDX-License-Identifier: Apache-2.0 */
/* A model as the command line names it: files read, optics joined, method prepared. */
#ifndef SRP_CLI_MODEL_H
#define SRP_CLI_MODEL_H

#include "method_options.h"

#include <srp/material.h>
#include <srp/method.h>
#include <srp/scene.h>

typedef struct cli_model {
    srp_scene *scene;
    srp_prepared *prepared;
} cli_model;

/* Splits NAME=RHO_S,RHO_D[,one-sided]; the name may hold '=' itself. `name` has room for `text`. */
bool cli_material_split(const char *text, char *name, srp_optics *optics);

/* The materials of --material, pinned. CLI_DONE, or what went wrong after saying it; then *out is
 * unchanged. */
int cli_materials_given(const cli_list *list, srp_materials **out);

/* Reads what the options name and prepares `method` on it. An exit status, said if not CLI_DONE. */
int cli_model_load(const cli_model_options *model, const cli_method_options *options,
                   const cli_operands *operands, const srp_method *method,
                   const srp_method_params *params, cli_model *out);
void cli_model_release(cli_model *model);

#endif
