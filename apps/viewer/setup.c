/* SPDX-License-Identifier: Apache-2.0 */
#include "setup.h"

#include "command_line.h"
#include "methods.h"
#include "model.h"
#include "numbers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- life ---- */

viewer_setup *viewer_setup_create(void) {
    viewer_setup *setup = calloc(1, sizeof *setup);
    if (setup != NULL) {
        setup->mass = NAN;
        setup->distance_au = 1.0;
        setup->light = srp_sunlight_default();
    }
    return setup;
}

static bool copy_texts(char *const *from, char **to, size_t count) {
    bool good = true;
    for (size_t i = 0; i < count; ++i) {
        to[i] = viewer_text_copy(from[i]);
        good = good && (to[i] != NULL || from[i] == NULL);
    }
    return good;
}

static bool copy_materials(const viewer_setup *from, viewer_setup *to) {
    to->materials = calloc(from->material_count + 1, sizeof *to->materials);
    bool good = to->materials != NULL;
    for (size_t i = 0; good && i < from->material_count; ++i) {
        to->materials[i].optics = from->materials[i].optics;
        to->materials[i].name = viewer_text_copy(from->materials[i].name);
        good = to->materials[i].name != NULL;
        to->material_count += good;
    }
    return good;
}

viewer_setup *viewer_setup_copy(const viewer_setup *setup) {
    viewer_setup *copy = viewer_setup_create();
    if (copy == NULL) {
        return NULL;
    }
    copy->mass = setup->mass;
    copy->distance_au = setup->distance_au;
    copy->light = setup->light;
    if (!copy_texts(&setup->model, &copy->model, 1) ||
        !copy_texts(setup->model_option, copy->model_option, MODEL_OPTION_COUNT) ||
        !copy_texts(setup->method_option, copy->method_option, METHOD_OPTION_COUNT) ||
        !copy_materials(setup, copy)) {
        viewer_setup_destroy(copy);
        return NULL;
    }
    return copy;
}

void viewer_setup_destroy(viewer_setup *setup) {
    if (setup == NULL) {
        return;
    }
    free(setup->model);
    for (size_t i = 0; i < MODEL_OPTION_COUNT; ++i) {
        free(setup->model_option[i]);
    }
    for (size_t i = 0; i < METHOD_OPTION_COUNT; ++i) {
        free(setup->method_option[i]);
    }
    viewer_setup_clear_materials(setup);
    free(setup->materials);
    free(setup);
}

/* ---- saying ---- */

/* Puts a copy of `text` in `place`; NULL and "" empty it. */
static bool keep(char **place, const char *text) {
    char *copy = NULL;
    if (text != NULL && text[0] != '\0') {
        copy = viewer_text_copy(text);
        if (copy == NULL) {
            return false;
        }
    }
    free(*place);
    *place = copy;
    return true;
}

bool viewer_setup_set_model(viewer_setup *setup, const char *path) {
    return keep(&setup->model, path);
}

/* Whether `option` takes `text`, tried on a target that nobody uses. */
static bool takes(const cli_option *option, void *target, const char *text, viewer_words *problem) {
    if (text == NULL || text[0] == '\0') {
        return true;
    }
    viewer_words_listen(problem);
    bool good = option->set(option, target, text);
    viewer_words_listen(NULL);
    return good;
}

bool viewer_setup_set_model_option(viewer_setup *setup, int option, const char *text,
                                   viewer_words *problem) {
    cli_model_options scratch = cli_model_options_default();
    return takes(&cli_group_model.options[option], &scratch, text, problem) &&
           keep(&setup->model_option[option], text);
}

/* The name or the device of the method: together they have to name one that is there. A device that
 * lacks the method gives way. */
static bool set_which(viewer_setup *setup, int option, const char *text, viewer_words *problem) {
    viewer_setup tried = *setup; /* its texts are those of `setup` */
    const srp_method *method;
    srp_method_params params;
    tried.method_option[option] = text != NULL && text[0] != '\0' ? (char *)text : NULL;
    if (viewer_setup_method(&tried) == NULL && option == METHOD_NAME) {
        tried.method_option[METHOD_DEVICE] = NULL;
    }
    if (viewer_setup_method(&tried) == NULL) {
        (void)viewer_setup_choose(&tried, &method, &params, problem);
        return false;
    }
    if (!keep(&setup->method_option[option], text)) {
        return false;
    }
    return tried.method_option[METHOD_DEVICE] != NULL ||
           keep(&setup->method_option[METHOD_DEVICE], NULL);
}

bool viewer_setup_set_method_option(viewer_setup *setup, int option, const char *text,
                                    viewer_words *problem) {
    cli_method_options scratch = cli_method_options_default();
    if (!takes(&cli_group_method.options[option], &scratch, text, problem)) {
        return false;
    }
    return option == METHOD_NAME || option == METHOD_DEVICE
               ? set_which(setup, option, text, problem)
               : keep(&setup->method_option[option], text);
}

bool viewer_setup_set_mass(viewer_setup *setup, const char *text, viewer_words *problem) {
    static const cli_option mass = {.name = "mass", .set = cli_set_number, .range = &CLI_POSITIVE};
    double value = NAN;
    if (!takes(&mass, &value, text, problem)) {
        return false;
    }
    setup->mass = value;
    return true;
}

bool viewer_setup_set_material(viewer_setup *setup, const char *name, srp_optics optics,
                               viewer_words *problem) {
    srp_error error;
    if (srp_optics_check(optics, &error) != SRP_OK) {
        char line[VIEWER_WORDS_SIZE];
        snprintf(line, sizeof line, "%.200s: %s", name, error.message);
        viewer_words_add(problem, line);
        return false;
    }
    for (size_t i = 0; i < setup->material_count; ++i) {
        if (strcmp(setup->materials[i].name, name) == 0) {
            setup->materials[i].optics = optics;
            return true;
        }
    }
    viewer_material *grown = realloc(setup->materials, (setup->material_count + 2) * sizeof *grown);
    char *copy = viewer_text_copy(name);
    setup->materials = grown != NULL ? grown : setup->materials;
    if (grown == NULL || copy == NULL) {
        free(copy);
        viewer_words_add(problem, "no memory");
        return false;
    }
    setup->materials[setup->material_count++] = (viewer_material){copy, optics};
    return true;
}

bool viewer_setup_set_material_text(viewer_setup *setup, const char *text, viewer_words *problem) {
    char *name = viewer_text_copy(text);
    srp_optics optics;
    bool good = name != NULL && cli_material_split(text, name, &optics);
    if (!good) {
        viewer_words_add(problem, "expected NAME=RHO_S,RHO_D or NAME=RHO_S,RHO_D,one-sided");
    } else {
        good = viewer_setup_set_material(setup, name, optics, problem);
    }
    free(name);
    return good;
}

void viewer_setup_clear_materials(viewer_setup *setup) {
    for (size_t i = 0; i < setup->material_count; ++i) {
        free(setup->materials[i].name);
    }
    setup->material_count = 0;
}

bool viewer_setup_is_of_spacecraft(int method_option) {
    return method_option == METHOD_CR || method_option == METHOD_AREA ||
           method_option == METHOD_REFERENCE;
}

void viewer_setup_forget_spacecraft(viewer_setup *setup, const viewer_setup *asked) {
    if (setup->mass == asked->mass) {
        setup->mass = NAN;
    }
    for (int i = 0; i < METHOD_OPTION_COUNT; ++i) {
        if (viewer_setup_is_of_spacecraft(i) &&
            viewer_text_same(setup->method_option[i], asked->method_option[i])) {
            keep(&setup->method_option[i], NULL);
        }
    }
}

bool viewer_setup_find_material(const viewer_setup *setup, const char *name, srp_optics *out) {
    for (size_t i = 0; i < setup->material_count; ++i) {
        if (strcmp(setup->materials[i].name, name) == 0) {
            *out = setup->materials[i].optics;
            return true;
        }
    }
    return false;
}

/* ---- reading it again ---- */

/* What is kept was taken once, so that no setter says a word here. */
static void apply(const cli_option *option, void *target, int bit, const char *text) {
    if (option->set(option, target, text)) {
        *(cli_given *)target |= (cli_given)1 << bit;
    }
}

const srp_method *viewer_setup_method(const viewer_setup *setup) {
    const char *name = setup->method_option[METHOD_NAME];
    const char *device = setup->method_option[METHOD_DEVICE];
    return cli_method_find(name != NULL ? name : "exact", device != NULL ? device : "cpu");
}

static bool applies(const viewer_setup *setup, const srp_method *method, int option) {
    return setup->method_option[option] != NULL &&
           (option == METHOD_NAME || option == METHOD_DEVICE || option == METHOD_THREADS ||
            method == NULL || cli_method_uses(method, option));
}

void viewer_setup_options(const viewer_setup *setup, cli_model_options *model,
                          cli_method_options *method) {
    const srp_method *chosen = viewer_setup_method(setup);
    unsigned shapes = chosen != NULL ? chosen->shapes : SRP_SHAPE_MESH;
    *model = cli_model_options_default();
    *method = cli_method_options_default();
    if (setup->model_option[MODEL_UNIT] != NULL && (shapes & SRP_SHAPE_MESH) != 0) {
        apply(&cli_group_model.options[MODEL_UNIT], model, MODEL_UNIT,
              setup->model_option[MODEL_UNIT]);
    }
    if (setup->model_option[MODEL_PLATES] != NULL && (shapes & SRP_SHAPE_PLATES) != 0) {
        apply(&cli_group_model.options[MODEL_PLATES], model, MODEL_PLATES,
              setup->model_option[MODEL_PLATES]);
    }
    for (int i = 0; i < METHOD_OPTION_COUNT; ++i) {
        if (applies(setup, chosen, i)) {
            apply(&cli_group_method.options[i], method, i, setup->method_option[i]);
        }
    }
}

bool viewer_setup_choose(const viewer_setup *setup, const srp_method **method,
                         srp_method_params *params, viewer_words *problem) {
    cli_model_options model;
    cli_method_options how;
    viewer_setup_options(setup, &model, &how);
    const srp_method *chosen = viewer_setup_method(setup);
    bool mesh = chosen == NULL || (chosen->shapes & SRP_SHAPE_MESH) != 0;
    if (chosen != NULL && mesh && setup->model == NULL) {
        char line[100];
        snprintf(line, sizeof line, "method %s needs an OBJ file: open one", chosen->name);
        viewer_words_add(problem, line);
        return false;
    }
    viewer_words_listen(problem);
    int status =
        cli_method_choose(&model, &how, mesh && setup->model != NULL ? 1 : 0, method, params);
    viewer_words_listen(NULL);
    return status == CLI_DONE;
}

/* ---- as a command line ---- */

enum { WORDS_MAX = 160 };

typedef struct word_list {
    char *word[WORDS_MAX];
    int count;
} word_list;

static void add(word_list *list, const char *text) {
    if (list->count < WORDS_MAX && text != NULL) {
        list->word[list->count] = viewer_text_copy(text);
        list->count += list->word[list->count] != NULL;
    }
}

static void add_option(word_list *list, const char *name, const char *value) {
    char option[64];
    snprintf(option, sizeof option, "--%s", name);
    add(list, option);
    add(list, value);
}

static void add_materials(word_list *list, const viewer_setup *setup) {
    for (size_t i = 0; i < setup->material_count; ++i) {
        const viewer_material *material = &setup->materials[i];
        char rho_s[CLI_NUMBER_SIZE], rho_d[CLI_NUMBER_SIZE], text[512];
        snprintf(text, sizeof text, "%.400s=%s,%s%s", material->name,
                 cli_write_number(material->optics.rho_s, rho_s),
                 cli_write_number(material->optics.rho_d, rho_d),
                 material->optics.one_sided ? ",one-sided" : "");
        add_option(list, "material", text);
    }
}

char *viewer_setup_command(const viewer_setup *setup, const char *command, char *const *extra,
                           int extra_count) {
    const srp_method *method = viewer_setup_method(setup);
    unsigned shapes = method != NULL ? method->shapes : SRP_SHAPE_MESH;
    word_list list = {.count = 0};
    char number[CLI_NUMBER_SIZE];
    add(&list, command);
    if ((shapes & SRP_SHAPE_MESH) != 0) {
        add(&list, setup->model);
        if (setup->model_option[MODEL_UNIT] != NULL) {
            add_option(&list, "unit", setup->model_option[MODEL_UNIT]);
        }
        add_materials(&list, setup);
    }
    if ((shapes & SRP_SHAPE_PLATES) != 0 && setup->model_option[MODEL_PLATES] != NULL) {
        add_option(&list, "plates", setup->model_option[MODEL_PLATES]);
    }
    for (int i = 0; i < METHOD_OPTION_COUNT; ++i) {
        if (applies(setup, method, i)) {
            add_option(&list, cli_group_method.options[i].name, setup->method_option[i]);
        }
    }
    if (!isnan(setup->mass)) {
        add_option(&list, "mass", cli_write_number(setup->mass, number));
    }
    for (int i = 0; i < extra_count; ++i) {
        add(&list, extra[i]);
    }
    char *line = cli_command_line_join(list.count, list.word, "");
    for (int i = 0; i < list.count; ++i) {
        free(list.word[i]);
    }
    return line;
}
