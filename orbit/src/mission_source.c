/* SPDX-License-Identifier: Apache-2.0 */
/* Mission files: libcyaml holds them against a schema, libyaml tells where each entry stands. */
#include "error.h"
#include "mission_internal.h"
#include "text.h"

#include <cyaml/cyaml.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

/* ---- Schema ---------------------------------------------------------------------------------- */

#define TEXT(key, type, member)                                                                    \
    CYAML_FIELD_STRING_PTR(key, CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, type, member, 1, 4096)
#define NEEDED(key, type, member)                                                                  \
    CYAML_FIELD_STRING_PTR(key, CYAML_FLAG_POINTER, type, member, 1, 4096)
#define PART(key, type, member, fields)                                                            \
    CYAML_FIELD_MAPPING_PTR(key, CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, type, member, fields)

static const cyaml_schema_value_t WORD = {
    CYAML_VALUE_STRING(CYAML_FLAG_POINTER, char *, 1, 64),
};
#define WORDS(word, holder, items, counter)                                                        \
    {                                                                                              \
        .key = word,                                                                               \
        .value = {.type = CYAML_SEQUENCE,                                                          \
                  .flags = CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL,                               \
                  .data_size = sizeof(char *),                                                     \
                  .sequence = {.entry = &WORD, .min = 0, .max = 64}},                              \
        .data_offset = offsetof(holder, items), .count_offset = offsetof(holder, counter),         \
        .count_size = sizeof(((holder *)NULL)->counter)                                            \
    }

static const cyaml_schema_field_t STATE[] = {NEEDED("position", mission_state, position),
                                             NEEDED("velocity", mission_state, velocity),
                                             CYAML_FIELD_END};

static const cyaml_schema_field_t ELEMENTS[] = {
    NEEDED("semi_major_axis", mission_elements, semi_major_axis),
    NEEDED("eccentricity", mission_elements, eccentricity),
    NEEDED("inclination", mission_elements, inclination),
    NEEDED("raan", mission_elements, raan),
    NEEDED("arg_periapsis", mission_elements, arg_periapsis),
    NEEDED("true_anomaly", mission_elements, true_anomaly),
    CYAML_FIELD_END};

static const cyaml_schema_field_t ATTITUDE[] = {
    NEEDED("mode", mission_attitude, mode),
    TEXT("quaternion", mission_attitude, quaternion),
    TEXT("axis", mission_attitude, axis),
    TEXT("rate", mission_attitude, rate),
    TEXT("file", mission_attitude, file),
    TEXT("align", mission_attitude, align),
    TEXT("align_body", mission_attitude, align_body),
    TEXT("constrain", mission_attitude, constrain),
    TEXT("constrain_body", mission_attitude, constrain_body),
    CYAML_FIELD_END};

static const cyaml_schema_field_t SPACECRAFT[] = {
    TEXT("name", mission_spacecraft, name), TEXT("id", mission_spacecraft, id),
    NEEDED("mass", mission_spacecraft, mass),
    PART("attitude", mission_spacecraft, attitude, ATTITUDE), CYAML_FIELD_END};

static const cyaml_schema_field_t GRAVITY[] = {
    NEEDED("file", mission_gravity, file),
    NEEDED("degree", mission_gravity, degree),
    TEXT("order", mission_gravity, order),
    TEXT("ut1_minus_utc", mission_gravity, ut1_minus_utc),
    TEXT("pole_x", mission_gravity, pole_x),
    TEXT("pole_y", mission_gravity, pole_y),
    CYAML_FIELD_END};

static const cyaml_schema_field_t MATERIAL[] = {
    NEEDED("name", mission_material, name), NEEDED("rho_s", mission_material, rho_s),
    NEEDED("rho_d", mission_material, rho_d), TEXT("one_sided", mission_material, one_sided),
    CYAML_FIELD_END};

static const cyaml_schema_value_t ONE_MATERIAL = {
    CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, mission_material, MATERIAL),
};

static const cyaml_schema_field_t RADIATION[] = {
    NEEDED("model", mission_radiation, model),
    TEXT("file", mission_radiation, file),
    TEXT("interpolation", mission_radiation, interpolation),
    TEXT("scale", mission_radiation, scale),
    TEXT("cr", mission_radiation, cr),
    TEXT("area", mission_radiation, area),
    TEXT("flux", mission_radiation, flux),
    TEXT("au", mission_radiation, au),
    TEXT("sun_radius", mission_radiation, sun_radius),
    TEXT("unit", mission_radiation, unit),
    TEXT("method", mission_radiation, method),
    TEXT("device", mission_radiation, device),
    TEXT("grid", mission_radiation, grid),
    TEXT("pixel", mission_radiation, pixel),
    TEXT("tolerance", mission_radiation, tolerance),
    TEXT("max_grid", mission_radiation, max_grid),
    TEXT("seed", mission_radiation, seed),
    TEXT("reflections", mission_radiation, reflections),
    TEXT("diffuse", mission_radiation, diffuse),
    TEXT("beams", mission_radiation, beams),
    TEXT("threads", mission_radiation, threads),
    TEXT("step", mission_radiation, step),
    TEXT("az_step", mission_radiation, az_step),
    TEXT("el_step", mission_radiation, el_step),
    TEXT("cache", mission_radiation, cache),
    {.key = "materials",
     .value = {.type = CYAML_SEQUENCE,
               .flags = CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL,
               .data_size = sizeof(mission_material),
               .sequence = {.entry = &ONE_MATERIAL, .min = 0, .max = 1000}},
     .data_offset = offsetof(mission_radiation, materials),
     .count_offset = offsetof(mission_radiation, material_count),
     .count_size = sizeof(((mission_radiation *)NULL)->material_count)},
    WORDS("shadow", mission_radiation, shadow, shadow_count),
    CYAML_FIELD_END};

static const cyaml_schema_field_t FORCES[] = {
    PART("gravity", mission_forces, gravity, GRAVITY),
    WORDS("point_masses", mission_forces, point_masses, point_mass_count),
    PART("radiation", mission_forces, radiation, RADIATION), CYAML_FIELD_END};

#define WORLD(name, id) TEXT(name, mission_worlds, of[id])
static const cyaml_schema_field_t WORLDS[] = {WORLD("sun", SRP_SUN),
                                              WORLD("mercury", SRP_MERCURY),
                                              WORLD("venus", SRP_VENUS),
                                              WORLD("earth", SRP_EARTH),
                                              WORLD("mars", SRP_MARS),
                                              WORLD("jupiter", SRP_JUPITER),
                                              WORLD("saturn", SRP_SATURN),
                                              WORLD("uranus", SRP_URANUS),
                                              WORLD("neptune", SRP_NEPTUNE),
                                              WORLD("moon", SRP_MOON),
                                              CYAML_FIELD_END};

static const cyaml_schema_field_t CONSTANTS[] = {PART("mu", mission_constants, mu, WORLDS),
                                                 PART("radius", mission_constants, radius, WORLDS),
                                                 CYAML_FIELD_END};

static const cyaml_schema_field_t INTEGRATOR[] = {
    TEXT("method", mission_integrator, method),
    TEXT("tolerance", mission_integrator, tolerance),
    TEXT("fixed_step", mission_integrator, fixed_step),
    TEXT("first_step", mission_integrator, first_step),
    TEXT("max_step", mission_integrator, max_step),
    CYAML_FIELD_END};

static const cyaml_schema_field_t OUTPUT[] = {
    TEXT("step", mission_output, step),
    TEXT("oem", mission_output, oem),
    TEXT("report", mission_output, report),
    TEXT("events", mission_output, events),
    WORDS("columns", mission_output, columns, column_count),
    CYAML_FIELD_END};

static const cyaml_schema_field_t MISSION[] = {
    TEXT("title", mission_file, title),
    NEEDED("epoch", mission_file, epoch),
    NEEDED("duration", mission_file, duration),
    TEXT("central_body", mission_file, central_body),
    TEXT("hyperbolic", mission_file, hyperbolic),
    TEXT("partials", mission_file, partials),
    PART("state", mission_file, state, STATE),
    PART("elements", mission_file, elements, ELEMENTS),
    CYAML_FIELD_MAPPING_PTR("spacecraft", CYAML_FLAG_POINTER, mission_file, spacecraft, SPACECRAFT),
    PART("forces", mission_file, forces, FORCES),
    PART("constants", mission_file, constants, CONSTANTS),
    PART("integrator", mission_file, integrator, INTEGRATOR),
    PART("output", mission_file, output, OUTPUT),
    CYAML_FIELD_END};

static const cyaml_schema_value_t SCHEMA = {
    CYAML_VALUE_MAPPING(CYAML_FLAG_POINTER, mission_file, MISSION)};

/* ---- Places ---------------------------------------------------------------------------------- */

struct mission_source {
    const char *name;
    yaml_document_t document;
    bool has_document;
    mission_file *file;
    cyaml_config_t config;
    /* What libcyaml says of a failure: its first words, and its first place. */
    char words[512];
    unsigned line, column;
    char fields[8][64]; /* of its backtrace, the innermost first */
    size_t depth;
};

static yaml_node_t *child(yaml_document_t *document, yaml_node_t *node, const char *key,
                          size_t size) {
    if (node->type == YAML_MAPPING_NODE) {
        for (yaml_node_pair_t *pair = node->data.mapping.pairs.start;
             pair < node->data.mapping.pairs.top; ++pair) {
            yaml_node_t *name = yaml_document_get_node(document, pair->key);
            if (name->type == YAML_SCALAR_NODE && name->data.scalar.length == size &&
                memcmp(name->data.scalar.value, key, size) == 0) {
                return yaml_document_get_node(document, pair->value);
            }
        }
    } else if (node->type == YAML_SEQUENCE_NODE) {
        const size_t index = strtoul(key, NULL, 10);
        yaml_node_item_t *start = node->data.sequence.items.start;
        if (index < (size_t)(node->data.sequence.items.top - start)) {
            return yaml_document_get_node(document, start[index]);
        }
    }
    return NULL;
}

/* The node of a path, or the nearest around it that is there; *rest is what was not found. */
static yaml_node_t *follow(const mission_source *source, const char *path, const char **rest) {
    yaml_document_t *document = (yaml_document_t *)&source->document;
    yaml_node_t *node = yaml_document_get_root_node(document);
    while (*path != '\0') {
        const size_t size = strcspn(path, ".");
        yaml_node_t *next = child(document, node, path, size);
        if (next == NULL) {
            break;
        }
        node = next;
        path += size + (path[size] == '.');
    }
    *rest = path;
    return node;
}

static yaml_mark_t place_of(const mission_source *source, const char *path) {
    const char *rest;
    return follow(source, path, &rest)->start_mark;
}

bool mission_has(const mission_source *source, const char *path) {
    const char *rest;
    follow(source, path, &rest);
    return *rest == '\0';
}

srp_status mission_fail(const mission_source *source, srp_error *error, srp_status status,
                        const char *path, const char *format, ...) {
    char message[768];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    const yaml_mark_t mark = place_of(source, path);
    return srp_fail_at(error, status, source->name, mark.line + 1, mark.column + 1, "%s: %.700s",
                       path, message);
}

void mission_warn(const mission_source *source, const srp_log *log, const char *path,
                  const char *format, ...) {
    char message[768];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    const yaml_mark_t mark = place_of(source, path);
    srp_warn_at(log, source->name, mark.line + 1, mark.column + 1, "%s: %.700s", path, message);
}

/* ---- Opening --------------------------------------------------------------------------------- */

/* Mappings that a search goes through: aliases can make a short text endless. */
enum { VISITS_MAX = 10000 };

/* Of a mapping with more keys than this many, some are unknown, and libcyaml finds them. */
enum { KEYS_MAX = 1000 };

/* Keys given twice, which libcyaml lets pass; NULL: none. */
static yaml_node_t *doubled_key(yaml_document_t *document, yaml_node_t *node, int *left) {
    if (node->type != YAML_MAPPING_NODE || --*left < 0) {
        return NULL;
    }
    yaml_node_pair_t *const start = node->data.mapping.pairs.start;
    for (yaml_node_pair_t *pair = start;
         pair < node->data.mapping.pairs.top && pair - start < KEYS_MAX; ++pair) {
        yaml_node_t *key = yaml_document_get_node(document, pair->key);
        yaml_node_t *value = yaml_document_get_node(document, pair->value);
        if (key->type == YAML_SCALAR_NODE &&
            child(document, node, (const char *)key->data.scalar.value, key->data.scalar.length) !=
                value) {
            return key;
        }
        yaml_node_t *inside = doubled_key(document, value, left);
        if (inside != NULL) {
            return inside;
        }
    }
    return NULL;
}

/* The first key of this name at or behind a line, anywhere. */
static yaml_node_t *find_key(yaml_document_t *document, yaml_node_t *node, const char *name,
                             size_t line, int *left) {
    if (node->type != YAML_MAPPING_NODE || --*left < 0) {
        return NULL;
    }
    for (yaml_node_pair_t *pair = node->data.mapping.pairs.start;
         pair < node->data.mapping.pairs.top; ++pair) {
        yaml_node_t *key = yaml_document_get_node(document, pair->key);
        if (key->type == YAML_SCALAR_NODE && key->start_mark.line >= line &&
            strcmp((const char *)key->data.scalar.value, name) == 0) {
            return key;
        }
        yaml_node_t *inside =
            find_key(document, yaml_document_get_node(document, pair->value), name, line, left);
        if (inside != NULL) {
            return inside;
        }
    }
    return NULL;
}

/* libyaml takes a time that grows with the square of the depth of brackets: 40 s for 100,000. */
enum { BRACKETS_MAX = 10000 };

static srp_status check_brackets(const mission_source *source, const char *text, size_t size,
                                 srp_error *error) {
    size_t brackets = 0, line = 1;
    for (size_t i = 0; i < size; ++i) {
        line += text[i] == '\n';
        brackets += text[i] == '[' || text[i] == '{';
        if (brackets > BRACKETS_MAX) {
            return srp_fail_at(error, SRP_BAD_FORMAT, source->name, line, 0,
                               "more than %d brackets: expected a mission", BRACKETS_MAX);
        }
    }
    return SRP_OK;
}

static srp_status load_document(mission_source *source, const char *text, size_t size,
                                srp_error *error) {
    yaml_parser_t parser;
    if (!yaml_parser_initialize(&parser)) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a mission file");
    }
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, size);
    srp_status status = SRP_OK;
    if (!yaml_parser_load(&parser, &source->document)) {
        status =
            parser.error == YAML_MEMORY_ERROR
                ? srp_fail(error, SRP_NO_MEMORY, "no memory for a mission file")
                : srp_fail_at(error, SRP_BAD_FORMAT, source->name, parser.problem_mark.line + 1,
                              parser.problem_mark.column + 1, "this is not YAML: %s",
                              parser.problem != NULL ? parser.problem : "unreadable bytes");
    } else {
        source->has_document = true;
        yaml_node_t *root = yaml_document_get_root_node(&source->document);
        if (root == NULL || root->type != YAML_MAPPING_NODE) {
            status = srp_fail_at(error, SRP_BAD_FORMAT, source->name, 1, 1,
                                 "expected a mapping of keys to values, as in 'epoch: ...'");
        }
    }
    yaml_parser_delete(&parser);
    return status;
}

/* libcyaml's log: "Load: Unexpected key: x", then a backtrace with places. */
static void listen(cyaml_log_t level, void *user, const char *format, va_list arguments) {
    mission_source *source = user;
    char line[512];
    if (level < CYAML_LOG_ERROR) {
        return;
    }
    vsnprintf(line, sizeof line, format, arguments);
    const char *place = strstr(line, "(line: ");
    if (place != NULL && source->depth < 8 &&
        sscanf(line, " in mapping field '%63[^']'", source->fields[source->depth]) == 1) {
        ++source->depth;
    }
    if (place != NULL && source->line == 0) {
        sscanf(place, "(line: %u, column: %u)", &source->line, &source->column);
    } else if (source->words[0] == '\0' && place == NULL && strstr(line, "Backtrace") == NULL) {
        const char *words = strncmp(line, "Load: ", 6) == 0 ? line + 6 : line;
        snprintf(source->words, sizeof source->words, "%.*s", (int)strcspn(words, "\n"), words);
    }
}

/* The backtrace begins with the last entry that was there; those around it are the way to the
 * mapping. */
static srp_status missing_key(const mission_source *source, const char *key, srp_error *error) {
    char path[600] = "";
    for (size_t i = source->depth; i > 1; --i) {
        strcat(path, source->fields[i - 1]);
        strcat(path, i > 2 ? "." : "");
    }
    const yaml_mark_t mark = place_of(source, path);
    return srp_fail_at(error, SRP_BAD_FORMAT, source->name, mark.line + 1, mark.column + 1,
                       "%s%s'%s' is missing here", path, path[0] != '\0' ? ": " : "", key);
}

/* libcyaml's words for an entry of the wrong kind, and ours. */
static const struct {
    const char *words, *ours;
} KINDS[] = {
    {"Expecting SEQUENCE, got", "expected a list, as in [sun, moon]"},
    {"Expecting MAPPING, got", "expected keys with values, one below the other"},
    {"Expecting STRING, got", "expected one value"},
    {"STRING length <", "expected a value, found none"},
    {"STRING length >", "the text is too long for a value"},
    {"Excessive entries", "too many entries"},
};

/* The entry at fault is the innermost of the backtrace. */
static srp_status wrong_kind(const mission_source *source, size_t line, size_t column,
                             const char *ours, srp_error *error) {
    char path[600] = "";
    for (size_t i = source->depth; i > 0; --i) {
        strcat(path, source->fields[i - 1]);
        strcat(path, i > 1 ? "." : "");
    }
    return srp_fail_at(error, SRP_BAD_FORMAT, source->name, line, column, "%s%s%s", path,
                       path[0] != '\0' ? ": " : "", ours);
}

static srp_status schema_failure(mission_source *source, cyaml_err_t code, srp_error *error) {
    static const char UNKNOWN[] = "Unexpected key: ",
                      MISSING[] = "Missing required mapping field: ";
    if (code == CYAML_ERR_OOM) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a mission file");
    }
    size_t line = source->line, column = source->column;
    yaml_node_t *root = yaml_document_get_root_node(&source->document);
    if (strncmp(source->words, UNKNOWN, sizeof UNKNOWN - 1) == 0) {
        const char *key = source->words + sizeof UNKNOWN - 1;
        int left = VISITS_MAX;
        yaml_node_t *at = find_key(&source->document, root, key, line > 0 ? line - 1 : 0, &left);
        if (at != NULL) {
            line = at->start_mark.line + 1;
            column = at->start_mark.column + 1;
        }
        return srp_fail_at(error, SRP_BAD_FORMAT, source->name, line, column,
                           "'%s' is no key of a mission here", key);
    }
    if (strncmp(source->words, MISSING, sizeof MISSING - 1) == 0) {
        return missing_key(source, source->words + sizeof MISSING - 1, error);
    }
    for (size_t i = 0; i < sizeof KINDS / sizeof KINDS[0]; ++i) {
        if (strncmp(source->words, KINDS[i].words, strlen(KINDS[i].words)) == 0) {
            return wrong_kind(source, line, column, KINDS[i].ours, error);
        }
    }
    return srp_fail_at(error, SRP_BAD_FORMAT, source->name, line, column,
                       "%s (%s): expected keys that are words, with values",
                       source->words[0] != '\0' ? source->words : "not as a mission is written",
                       cyaml_strerror(code));
}

static srp_status load_file(mission_source *source, const char *text, size_t size,
                            srp_error *error) {
    source->config = (cyaml_config_t){.log_fn = listen,
                                      .log_ctx = source,
                                      .mem_fn = cyaml_mem,
                                      .log_level = CYAML_LOG_ERROR,
                                      .flags = CYAML_CFG_NO_ALIAS};
    const cyaml_err_t code = cyaml_load_data((const uint8_t *)text, size, &source->config, &SCHEMA,
                                             (cyaml_data_t **)&source->file, NULL);
    return code == CYAML_OK ? SRP_OK : schema_failure(source, code, error);
}

srp_status mission_source_open(const char *text, size_t size, const char *name,
                               mission_source **out, srp_error *error) {
    mission_source *source = calloc(1, sizeof *source);
    if (source == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a mission file");
    }
    source->name = name;
    srp_status status = check_brackets(source, text, size, error);
    if (status == SRP_OK) {
        status = load_document(source, text, size, error);
    }
    if (status == SRP_OK) {
        int left = VISITS_MAX;
        yaml_node_t *twice =
            doubled_key(&source->document, yaml_document_get_root_node(&source->document), &left);
        if (twice != NULL) {
            status = srp_fail_at(error, SRP_BAD_FORMAT, name, twice->start_mark.line + 1,
                                 twice->start_mark.column + 1, "'%s' is given twice",
                                 (const char *)twice->data.scalar.value);
        }
    }
    if (status == SRP_OK) {
        status = load_file(source, text, size, error);
    }
    if (status != SRP_OK) {
        mission_source_close(source);
        return status;
    }
    *out = source;
    return SRP_OK;
}

void mission_source_close(mission_source *source) {
    if (source != NULL) {
        if (source->file != NULL) {
            cyaml_free(&source->config, &SCHEMA, source->file, 0);
        }
        if (source->has_document) {
            yaml_document_delete(&source->document);
        }
        free(source);
    }
}

const mission_file *mission_source_file(const mission_source *source) {
    return source->file;
}

const char *mission_source_name(const mission_source *source) {
    return source->name;
}
