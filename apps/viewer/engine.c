/* SPDX-License-Identifier: Apache-2.0 */
#include "engine.h"

#include "model.h"
#include "system.h"

#include <srp/plates.h>
#include <srp/table.h>

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

double viewer_seconds(void) {
    return cli_system_seconds();
}

/* ---- shapes ---- */

viewer_shape *viewer_shape_reference(viewer_shape *shape) {
    if (shape != NULL) {
        atomic_fetch_add(&shape->references, 1);
    }
    return shape;
}

void viewer_shape_release(viewer_shape *shape) {
    if (shape != NULL && atomic_fetch_sub(&shape->references, 1) == 1) {
        cli_info_release(&shape->info);
        free(shape->path);
        free(shape->unit);
        free(shape);
    }
}

viewer_shape *viewer_shape_read(const viewer_setup *setup, viewer_words *said) {
    viewer_shape *shape = calloc(1, sizeof *shape);
    if (shape == NULL) {
        viewer_words_add(said, "no memory for the spacecraft");
        return NULL;
    }
    atomic_init(&shape->references, 1);
    shape->path = viewer_text_copy(setup->model);
    shape->unit = viewer_text_copy(setup->model_option[MODEL_UNIT]);
    cli_model_options model = cli_model_options_default();
    if (shape->unit != NULL) {
        const cli_option *unit = &cli_group_model.options[MODEL_UNIT];
        unit->set(unit, &model, shape->unit);
    }
    const char *const path = shape->path;
    cli_operands operands = {&path, 1};
    viewer_words_listen(said);
    int status = path != NULL ? cli_info_collect(&model, &operands, &shape->info) : CLI_BAD_INPUT;
    viewer_words_listen(NULL);
    if (status != CLI_DONE) {
        if (said->text[0] == '\0') {
            viewer_words_add(said, "no memory");
        }
        viewer_shape_release(shape);
        return NULL;
    }
    return shape;
}

/* ---- optics ---- */

bool viewer_engine_optics(const viewer_engine *engine, size_t index, srp_optics *out) {
    const info_material *material = &engine->shape->info.materials[index];
    if (viewer_setup_find_material(engine->setup, material->name, out)) {
        return true;
    }
    if (material->known) {
        *out = material->optics;
    }
    return material->known;
}

const char *viewer_engine_missing_mtl(const viewer_engine *engine) {
    if (engine == NULL || engine->shape == NULL || engine->optics_known) {
        return NULL;
    }
    const cli_info *info = &engine->shape->info;
    for (size_t i = 0; i < info->library_count; ++i) {
        if (info->libraries[i].missing) {
            return info->libraries[i].path;
        }
    }
    return NULL;
}

/* Before the materials that have no optics, the file that would have had them. */
static void ask_for_mtl(viewer_engine *engine) {
    const char *missing = viewer_engine_missing_mtl(engine);
    char line[VIEWER_WORDS_SIZE];
    if (missing == NULL) {
        return;
    }
    snprintf(line, sizeof line,
             "the MTL file %.1000s does not exist: another can be taken by Find MTL", missing);
    viewer_words said = engine->problem;
    engine->problem.text[0] = '\0';
    viewer_words_add(&engine->problem, line);
    viewer_words_add(&engine->problem, said.text);
}

enum { NAMES_MAX = 8 };

/* "the material 'a' has no optics" of those of `names`, or "the materials 'a', 'b' and 4 others
 * have". */
static void ask_for_optics(viewer_engine *engine, const char *const *names, size_t count) {
    char line[VIEWER_WORDS_SIZE];
    size_t named = count > NAMES_MAX ? NAMES_MAX - 1 : count, used = 0;
    if (count == 0) {
        return;
    }
    for (size_t i = 0; i < named; ++i) {
        used += (size_t)snprintf(line + used, sizeof line - used, "%s'%.200s'",
                                 i == 0           ? count == 1 ? "the material " : "the materials "
                                 : i + 1 == count ? " and "
                                                  : ", ",
                                 names[i]);
    }
    if (named < count) {
        used += (size_t)snprintf(line + used, sizeof line - used, " and %zu others", count - named);
    }
    snprintf(line + used, sizeof line - used, " %s no optics: give them in Materials",
             count == 1 ? "has" : "have");
    viewer_words_add(&engine->problem, line);
}

static bool has_material(const cli_info *info, const char *name) {
    for (size_t i = 0; i < info->material_count; ++i) {
        if (strcmp(info->materials[i].name, name) == 0) {
            return true;
        }
    }
    return false;
}

/* In the words of srp_scene_from_mesh(), which here is given only what the mesh has. */
static void warn_of_strangers(viewer_engine *engine) {
    const viewer_setup *setup = engine->setup;
    for (size_t i = 0; i < setup->material_count; ++i) {
        const char *name = setup->materials[i].name;
        char line[300];
        if (!has_material(&engine->shape->info, name)) {
            snprintf(line, sizeof line, "no face has the given material '%.200s'", name);
            viewer_words_add(&engine->problem, line);
        }
    }
}

static srp_status join_optics(viewer_engine *engine, srp_error *error) {
    srp_materials *materials = NULL;
    srp_status status = srp_materials_create(&materials, error);
    const cli_info *info = &engine->shape->info;
    const char *lacking[NAMES_MAX];
    size_t lacking_count = 0;
    for (size_t i = 0; i < info->material_count && status == SRP_OK; ++i) {
        srp_optics optics = {0.0, 0.0, false};
        if (!viewer_engine_optics(engine, i, &optics)) {
            if (lacking_count < NAMES_MAX) {
                lacking[lacking_count] = info->materials[i].name;
            }
            ++lacking_count;
        }
        status = srp_materials_set(materials, info->materials[i].name, optics, false, error);
    }
    engine->optics_known = lacking_count == 0;
    ask_for_optics(engine, lacking, lacking_count);
    ask_for_mtl(engine);
    warn_of_strangers(engine);
    if (status == SRP_OK) {
        status = srp_scene_from_mesh(info->mesh, materials, &engine->mesh, error);
    }
    srp_materials_destroy(materials);
    return status;
}

/* ---- engines ---- */

static srp_status plates_scene(const char *path, srp_scene **out, srp_error *error) {
    srp_plate *plates = NULL;
    size_t count;
    srp_status status = srp_plates_read(path, &plates, &count, error);
    if (status == SRP_OK) {
        status = srp_scene_from_plates(plates, count, out, error);
        srp_plates_free(plates);
    }
    return status;
}

bool viewer_engine_takes_plates(const char *path, viewer_words *problem) {
    srp_scene *scene = NULL;
    srp_error error;
    if (plates_scene(path, &scene, &error) != SRP_OK) {
        viewer_words_add_error(problem, &error);
        return false;
    }
    srp_scene_destroy(scene);
    return true;
}

/* The scene that the method takes; NULL with words where there is none. */
static srp_scene *scene_of_method(viewer_engine *engine) {
    cli_model_options model;
    cli_method_options how;
    srp_scene *scene = NULL;
    srp_error error;
    srp_status status = SRP_OK;
    viewer_setup_options(engine->setup, &model, &how);
    if ((engine->method->shapes & SRP_SHAPE_MESH) != 0) {
        return engine->optics_known ? engine->mesh : NULL;
    }
    engine->owns_scene = true;
    if ((engine->method->shapes & SRP_SHAPE_PLATES) != 0) {
        status = plates_scene(model.plates, &scene, &error);
    } else {
        status = srp_scene_from_sphere(how.cr, how.area, &scene, &error);
    }
    if (status != SRP_OK) {
        viewer_words_add_error(&engine->problem, &error);
        return NULL;
    }
    return scene;
}

static void prepare(viewer_engine *engine) {
    if (!viewer_setup_choose(engine->setup, &engine->method, &engine->params, &engine->problem)) {
        engine->method = viewer_setup_method(engine->setup);
        return;
    }
    srp_scene *scene = scene_of_method(engine);
    srp_error error;
    if (scene != NULL && srp_method_prepare(engine->method, scene, &engine->params,
                                            &engine->prepared, &error) != SRP_OK) {
        viewer_words_add_error(&engine->problem, &error);
        if (engine->owns_scene) {
            srp_scene_destroy(scene);
        }
    }
}

viewer_engine *viewer_engine_make(const viewer_setup *setup, viewer_shape *known, bool reload) {
    viewer_engine *engine = calloc(1, sizeof *engine);
    viewer_setup *copy = viewer_setup_copy(setup);
    if (engine == NULL || copy == NULL) {
        free(engine);
        viewer_setup_destroy(copy);
        return NULL;
    }
    atomic_init(&engine->references, 1);
    copy->mass = NAN; /* changes without a new engine; whoever wants it asks the session */
    engine->setup = copy;
    bool is_known = setup->model != NULL && known != NULL &&
                    viewer_text_same(known->path, setup->model) &&
                    viewer_text_same(known->unit, setup->model_option[MODEL_UNIT]);
    if (setup->model != NULL && (reload || !is_known)) {
        engine->shape = viewer_shape_read(setup, &engine->problem);
    }
    if (engine->shape == NULL && is_known) {
        engine->shape = viewer_shape_reference(known);
    }
    srp_error error;
    viewer_words_listen(&engine->problem);
    if (engine->shape != NULL && join_optics(engine, &error) != SRP_OK) {
        viewer_words_add_error(&engine->problem, &error);
        engine->optics_known = false;
    }
    viewer_words_listen(NULL);
    if (engine->shape != NULL || setup->model == NULL) {
        prepare(engine);
    }
    return engine;
}

viewer_engine *viewer_engine_reference(viewer_engine *engine) {
    if (engine != NULL) {
        atomic_fetch_add(&engine->references, 1);
    }
    return engine;
}

static void *give_back(void *prepared) {
    srp_prepared_release(prepared);
    return NULL;
}

/* A method of OpenGL leaves no context current on the thread that gives it back (srp/gl.h), and the
 * window may be drawing by OpenGL on this one: another thread does it. */
static void release_prepared(const viewer_engine *engine) {
    pthread_t thread;
    if (engine->prepared != NULL && strcmp(engine->method->device, "cpu") != 0 &&
        pthread_create(&thread, NULL, give_back, engine->prepared) == 0) {
        (void)pthread_join(thread, NULL);
    } else {
        srp_prepared_release(engine->prepared);
    }
}

void viewer_engine_release(viewer_engine *engine) {
    if (engine == NULL || atomic_fetch_sub(&engine->references, 1) != 1) {
        return;
    }
    const srp_scene *own = engine->owns_scene && engine->prepared != NULL
                               ? srp_prepared_scene(engine->prepared)
                               : NULL;
    release_prepared(engine);
    srp_scene_destroy((srp_scene *)own);
    srp_scene_destroy(engine->mesh);
    viewer_shape_release(engine->shape);
    viewer_setup_destroy((viewer_setup *)engine->setup);
    free(engine);
}

bool viewer_engine_respond(const viewer_engine *engine, double az_deg, double el_deg,
                           viewer_force *out, viewer_words *problem) {
    viewer_force force = {.az_deg = az_deg, .el_deg = el_deg};
    if (engine->prepared == NULL) {
        viewer_words_add(problem, engine->problem.text);
        return false;
    }
    double began = viewer_seconds();
    srp_error error;
    force.s = srp_direction_from_deg(az_deg, el_deg);
    if (srp_prepared_respond(engine->prepared, 1, &force.s, &force.response, NULL, &error) !=
        SRP_OK) {
        viewer_words_add_error(problem, &error);
        return false;
    }
    force.seconds = viewer_seconds() - began;
    *out = force;
    return true;
}
