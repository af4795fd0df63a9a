/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What the user has said about spacecraft, method and light: the options of `srp`, as text. They
 * are read by the command line's own setters, so that the window takes what the command line takes,
 * with the same words about what it does not.
 */
#ifndef SRP_VIEWER_SETUP_H
#define SRP_VIEWER_SETUP_H

#include "method_options.h"
#include "words.h"

#include <srp/material.h>
#include <srp/sunlight.h>

#include <stdbool.h>
#include <stddef.h>

typedef struct viewer_material {
    char *name;
    srp_optics optics;
} viewer_material;

typedef struct viewer_setup {
    char *model;                              /* OBJ file, NULL: none */
    char *model_option[MODEL_OPTION_COUNT];   /* NULL: not given; not MODEL_MATERIAL */
    char *method_option[METHOD_OPTION_COUNT]; /* NULL: not given */
    viewer_material *materials;               /* what the user says of them; wins over the MTL */
    size_t material_count;
    double mass;        /* [kg], NAN: not given */
    double distance_au; /* from the Sun */
    srp_sunlight light;
} viewer_setup;

/* Nothing but defaults. NULL without memory, as the copy; a copy lives for itself. */
viewer_setup *viewer_setup_create(void);
viewer_setup *viewer_setup_copy(const viewer_setup *setup);
void viewer_setup_destroy(viewer_setup *setup);

/* Each takes "" or NULL for "not given", and is false, with words and without effect, for what the
 * option does not take. So are methods and devices that are not there. */
bool viewer_setup_set_model(viewer_setup *setup, const char *path);
bool viewer_setup_set_model_option(viewer_setup *setup, int option, const char *text,
                                   viewer_words *problem);
bool viewer_setup_set_method_option(viewer_setup *setup, int option, const char *text,
                                    viewer_words *problem);
bool viewer_setup_set_mass(viewer_setup *setup, const char *text, viewer_words *problem);
bool viewer_setup_set_material(viewer_setup *setup, const char *name, srp_optics optics,
                               viewer_words *problem);
/* The same from NAME=RHO_S,RHO_D[,one-sided]. */
bool viewer_setup_set_material_text(viewer_setup *setup, const char *text, viewer_words *problem);
/* Forgets what was said of all materials. */
void viewer_setup_clear_materials(viewer_setup *setup);
/* Does an option of the method describe the spacecraft: its sphere, its reference point? */
bool viewer_setup_is_of_spacecraft(int method_option);
/* Forgets these and the mass before another spacecraft is there; but for what has changed since
 * `asked`, a copy from when the other one was asked for. */
void viewer_setup_forget_spacecraft(viewer_setup *setup, const viewer_setup *asked);
/* What was said of one; false, *out unchanged: nothing. */
bool viewer_setup_find_material(const viewer_setup *setup, const char *name, srp_optics *out);

/* The options as `srp` has them; texts are the setup's. What the chosen method does not use is left
 * out, and waits for one that does. `materials` is to be freed by cli_list_free() and holds no
 * material: those of a setup are looked up by name. */
void viewer_setup_options(const viewer_setup *setup, cli_model_options *model,
                          cli_method_options *method);

/* The method that is meant. False with words where cli_method_choose() refuses. */
bool viewer_setup_choose(const viewer_setup *setup, const srp_method **method,
                         srp_method_params *params, viewer_words *problem);
/* The method of the chosen name on the chosen device, whether or not it has all it needs; NULL:
 * there is none. */
const srp_method *viewer_setup_method(const viewer_setup *setup);

/* The command line that does the same: "srp force box-wing.obj --az 30 ...". `extra` are further
 * words (extra_count), behind. Freed by free(); NULL without memory. */
char *viewer_setup_command(const viewer_setup *setup, const char *command, char *const *extra,
                           int extra_count);

#endif
