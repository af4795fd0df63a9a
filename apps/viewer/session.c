/* SPDX-License-Identifier: Apache-2.0 */
#include "session.h"

#include <srp/const.h>

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- attitude ---- */

/* `v` turned about axis 0, 1, 2. */
static srp_vec3 turned(srp_vec3 v, int axis, double angle) {
    double c = cos(angle), s = sin(angle);
    switch (axis) {
    case 0:
        return srp_vec3_make(v.x, c * v.y - s * v.z, s * v.y + c * v.z);
    case 1:
        return srp_vec3_make(c * v.x + s * v.z, v.y, c * v.z - s * v.x);
    default:
        return srp_vec3_make(c * v.x - s * v.y, s * v.x + c * v.y, v.z);
    }
}

srp_vec3 viewer_attitude_to_room(const viewer_attitude *attitude, srp_vec3 body) {
    for (int axis = 0; axis < 3; ++axis) {
        body = turned(body, axis, SRP_RAD_PER_DEG * attitude->turn_deg[axis]);
    }
    return body;
}

srp_vec3 viewer_attitude_to_body(const viewer_attitude *attitude, srp_vec3 room) {
    for (int axis = 2; axis >= 0; --axis) {
        room = turned(room, axis, -SRP_RAD_PER_DEG * attitude->turn_deg[axis]);
    }
    return room;
}

static double rounded(double degrees) {
    double r = round(1e9 * degrees) / 1e9;
    return r == 0.0 ? 0.0 : r; /* no -0 */
}

void viewer_attitude_sun(const viewer_attitude *attitude, double *az_deg, double *el_deg) {
    srp_vec3 s = viewer_attitude_to_body(attitude, srp_vec3_make(1.0, 0.0, 0.0));
    double across = hypot(s.x, s.y);
    *el_deg = rounded(atan2(s.z, across) / SRP_RAD_PER_DEG);
    *az_deg = across > 1e-12 ? rounded(atan2(s.y, s.x) / SRP_RAD_PER_DEG) : 0.0;
    if (*az_deg == -180.0) {
        *az_deg = 180.0;
    }
}

viewer_attitude viewer_attitude_for_sun(double az_deg, double el_deg) {
    srp_vec3 s = srp_direction_from_deg(az_deg, el_deg);
    double z = -asin(fmax(-1.0, fmin(1.0, s.y)));
    double y = hypot(s.x, s.z) > 1e-12 ? atan2(s.z, s.x) : 0.0;
    /* Not rounded: what is rounded on the way back is then the azimuth and elevation given here. */
    viewer_attitude attitude = {{0.0, y / SRP_RAD_PER_DEG + 0.0, z / SRP_RAD_PER_DEG + 0.0}};
    return attitude;
}

/* ---- life ---- */

viewer_session *viewer_session_create(void) {
    viewer_session *session = calloc(1, sizeof *session);
    if (session != NULL) {
        session->setup = viewer_setup_create();
        if (session->setup == NULL) {
            free(session);
            return NULL;
        }
    }
    return session;
}

viewer_table *viewer_table_reference(viewer_table *table) {
    if (table != NULL) {
        atomic_fetch_add(&table->references, 1);
    }
    return table;
}

static void free_contents(viewer_table *table) {
    srp_table_destroy(table->table);
    free(table->name);
    free(table->command);
    free(table->path);
}

void viewer_table_release(viewer_table *table) {
    if (table != NULL && atomic_fetch_sub(&table->references, 1) == 1) {
        free_contents(table);
        free(table);
    }
}

void viewer_session_destroy(viewer_session *session) {
    if (session == NULL) {
        return;
    }
    viewer_session_clear_tables(session);
    free((void *)session->tables);
    free(session->arrows);
    viewer_engine_release(session->engine);
    viewer_setup_destroy(session->setup);
    free(session);
}

/* ---- engine, force, arrows ---- */

static const char *optics_of(const viewer_engine *engine) {
    return engine->mesh != NULL ? srp_scene_optics_hash(engine->mesh) : "";
}

static bool comparable(const viewer_engine *a, const viewer_engine *b) {
    return a != NULL && b != NULL && a->shape == b->shape && a->method == b->method &&
           strcmp(optics_of(a), optics_of(b)) == 0;
}

void viewer_session_set_engine(viewer_session *session, viewer_engine *engine) {
    if (!comparable(session->engine, engine)) {
        viewer_session_clear_arrows(session);
    }
    session->latency_count = 0;
    viewer_engine_release(session->engine);
    session->engine = engine;
    session->force_known = false;
}

static bool is_recorded(const viewer_session *session, const viewer_force *force) {
    for (size_t i = session->arrow_count; i > 0; --i) {
        const viewer_arrow *arrow = &session->arrows[i - 1];
        if (arrow->az_deg == force->az_deg && arrow->el_deg == force->el_deg) {
            return true;
        }
    }
    return false;
}

bool viewer_session_set_force(viewer_session *session, const viewer_force *force) {
    session->force = *force;
    session->force_known = true;
    if (!session->recording || force->asked_at < session->recorded_from ||
        is_recorded(session, force)) {
        return true;
    }
    if (session->arrow_count == session->arrow_room) {
        size_t room = 2 * session->arrow_room + 64;
        viewer_arrow *grown = realloc(session->arrows, room * sizeof *grown);
        if (grown == NULL) {
            return false;
        }
        session->arrows = grown;
        session->arrow_room = room;
    }
    double magnitude = srp_vec3_norm(force->response.f);
    srp_vec3 direction = srp_vec3_make(0.0, 0.0, 0.0);
    if (magnitude > 0.0) {
        direction = srp_vec3_scale(1.0 / magnitude, force->response.f);
    }
    session->arrows[session->arrow_count++] =
        (viewer_arrow){force->az_deg, force->el_deg, direction, magnitude};
    return true;
}

bool viewer_session_record(viewer_session *session, bool recording) {
    session->recording = recording;
    session->recorded_from = session->asked_at;
    return !session->force_known || viewer_session_set_force(session, &session->force);
}

void viewer_session_clear_arrows(viewer_session *session) {
    session->arrow_count = 0;
}

bool viewer_session_arrow_range(const viewer_session *session, double *least, double *largest) {
    if (session->arrow_count == 0) {
        return false;
    }
    *least = INFINITY;
    *largest = -INFINITY;
    for (size_t i = 0; i < session->arrow_count; ++i) {
        *least = fmin(*least, session->arrows[i].magnitude);
        *largest = fmax(*largest, session->arrows[i].magnitude);
    }
    return true;
}

void viewer_arrow_colour(double share, float rgb[3]) {
    /* Blue, cyan, green, yellow, red, as the paper has them, a little darker in the middle. */
    static const float stops[5][3] = {{0.13f, 0.24f, 0.85f},
                                      {0.07f, 0.62f, 0.83f},
                                      {0.18f, 0.65f, 0.29f},
                                      {0.93f, 0.70f, 0.13f},
                                      {0.85f, 0.13f, 0.10f}};
    double at = 4.0 * fmax(0.0, fmin(1.0, isnan(share) ? 0.0 : share));
    int k = at >= 4.0 ? 3 : (int)at;
    float part = (float)(at - k);
    for (int c = 0; c < 3; ++c) {
        rgb[c] = stops[k][c] + part * (stops[k + 1][c] - stops[k][c]);
    }
}

/* ---- latency ---- */

enum { LATENCIES = sizeof((viewer_session *)0)->latency / sizeof(viewer_latency) };

void viewer_session_add_latency(viewer_session *session, double shown) {
    session->latency[session->latency_count++ % LATENCIES] =
        (viewer_latency){shown, session->force.seconds};
}

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values, size_t count) {
    qsort(values, count, sizeof *values, by_size);
    return count % 2 == 1 ? values[count / 2] : 0.5 * (values[count / 2 - 1] + values[count / 2]);
}

viewer_latency viewer_session_median_latency(const viewer_session *session) {
    double shown[LATENCIES], computed[LATENCIES];
    size_t count = session->latency_count < LATENCIES ? session->latency_count : LATENCIES;
    if (count == 0) {
        return (viewer_latency){NAN, NAN};
    }
    for (size_t i = 0; i < count; ++i) {
        shown[i] = session->latency[i].shown;
        computed[i] = session->latency[i].computed;
    }
    return (viewer_latency){median(shown, count), median(computed, count)};
}

/* ---- tables ---- */

bool viewer_session_add_table(viewer_session *session, viewer_table table) {
    viewer_table **grown =
        realloc((void *)session->tables, (session->table_count + 1) * sizeof *session->tables);
    viewer_table *entry = malloc(sizeof *entry);
    session->tables = grown != NULL ? grown : session->tables;
    if (grown == NULL || entry == NULL) {
        free(entry);
        free_contents(&table);
        return false;
    }
    entry->table = table.table;
    entry->name = table.name;
    entry->command = table.command;
    entry->path = table.path;
    atomic_init(&entry->references, 1);
    session->tables[session->table_count++] = entry;
    return true;
}

void viewer_session_clear_tables(viewer_session *session) {
    for (size_t i = 0; i < session->table_count; ++i) {
        viewer_table_release(session->tables[i]);
    }
    session->table_count = 0;
}

/* ---- tables and optics ---- */

bool viewer_session_table_is_old(const viewer_session *session, size_t index) {
    const srp_table_info *info = srp_table_get_info(session->tables[index]->table);
    const viewer_engine *engine = session->engine;
    return engine != NULL && engine->mesh != NULL && engine->optics_known &&
           strcmp(info->shape_hash, srp_scene_shape_hash(engine->mesh)) == 0 &&
           strcmp(info->optics_hash, srp_scene_optics_hash(engine->mesh)) != 0;
}

/* The number first, then what must not be cut off. */
char *viewer_session_table_label(const viewer_session *session, size_t index) {
    const char *name = session->tables[index]->name != NULL ? session->tables[index]->name : "";
    const char *old = viewer_session_table_is_old(session, index) ? " (of other optics)" : "";
    int number = (int)strcspn(name, ":");
    size_t size = strlen(name) + strlen(old) + 1;
    char *label = malloc(size);
    if (label != NULL) {
        snprintf(label, size, "%.*s%s%s", number, name, old, name + number);
    }
    return label;
}

/* ---- what a table is of ---- */

typedef struct text {
    char *at;
    size_t room;
} text;

static void append(text *t, const char *format, ...) {
    va_list list;
    va_start(list, format);
    int length = vsnprintf(t->at, t->room, format, list);
    va_end(list);
    size_t used = length > 0 && t->room > 0 ? (size_t)length : 0;
    used = used < t->room ? used : t->room - 1;
    t->at += used;
    t->room -= used;
}

static void append_lattice(text *t, const srp_lattice_params *lattice) {
    if (lattice->kind == SRP_LATTICE_WINDOW) {
        const double *w = lattice->window;
        append(t, " window %g,%g,%g,%g of %u × %u", w[0], w[1], w[2], w[3],
               (unsigned)lattice->columns, (unsigned)lattice->rows);
    } else if (!isnan(lattice->pixel)) {
        append(t, " pixel %g m", lattice->pixel);
    }
}

/* A table keeps what its method uses, the rest is as by default. */
static void append_params(text *t, const srp_method_params *params) {
    const srp_method_params usual = srp_method_params_default();
    const struct {
        const char *name;
        double value, usual;
    } numbers[] = {
        {"grid", params->lattice.samples, usual.lattice.samples},
        {"seed", (double)params->seed, (double)usual.seed},
        {"tolerance", params->tolerance, usual.tolerance},
        {"max grid", params->max_samples, usual.max_samples},
        {"reflections", params->reflections, usual.reflections},
        {"diffuse", params->diffuse, usual.diffuse},
        {"beams", params->mirrored_beams, usual.mirrored_beams},
    };
    append_lattice(t, &params->lattice);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; ++i) {
        if (numbers[i].value != numbers[i].usual) {
            append(t, " %s %.15g", numbers[i].name, numbers[i].value);
        }
    }
}

/* Cannonball and unit are in no table. */
static void append_setup(text *t, const viewer_setup *setup) {
    const srp_method *method = viewer_setup_method(setup);
    const char *unit = setup->model_option[MODEL_UNIT];
    if (method != NULL && cli_method_uses(method, METHOD_CR)) {
        append(t, " Cr %s area %s m²", setup->method_option[METHOD_CR],
               setup->method_option[METHOD_AREA]);
    }
    if (unit != NULL && method != NULL && (method->shapes & SRP_SHAPE_MESH) != 0) {
        append(t, ", unit %s", unit);
    }
}

void viewer_table_summary(const srp_table *table, const viewer_setup *setup, char *buffer,
                          size_t size) {
    const srp_table_info *info = srp_table_get_info(table);
    srp_grid grid = srp_table_grid(table);
    text t = {buffer, size};
    bool named = info->method[0] != '\0' && strcmp(info->method, info->title) != 0;
    append(&t, "%.100s%s%s", info->title, named && info->title[0] != '\0' ? ", " : "",
           named ? info->method : "");
    append_params(&t, &info->params);
    if (setup != NULL) {
        append_setup(&t, setup);
    }
    append(&t, "%s%g° × %g°", t.at > buffer ? ", " : "", 360.0 / (grid.az_count - 1),
           180.0 / (grid.el_count - 1));
}

srp_status viewer_table_reoptic(const viewer_table *table, const viewer_engine *engine,
                                srp_table **out, srp_error *error) {
    srp_materials *materials = NULL;
    srp_status status = srp_materials_create(&materials, error);
    for (size_t i = 0; status == SRP_OK && i < srp_scene_material_count(engine->mesh); ++i) {
        status = srp_materials_set(materials, srp_scene_material_name(engine->mesh, i),
                                   srp_scene_material_optics(engine->mesh, i), false, error);
    }
    if (status == SRP_OK) {
        status = srp_table_reoptic(table->table, materials, false, out, error);
    }
    srp_materials_destroy(materials);
    return status;
}
