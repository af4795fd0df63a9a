/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Wavefront OBJ (Advanced Visualizer manual, appendix B1, version 3.0). Read twice: first all
 * vertices, then the faces, because a face may name vertices that come after it.
 */
#include "error.h"
#include "limits.h"
#include "mesh_internal.h"
#include "platform.h"
#include "polygon.h"
#include "text.h"
#include "topology.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct obj_reader {
    srp_text text;
    const srp_log *log;
    srp_error *error;
    double metres_per_unit;
    srp_mesh *mesh;
    size_t vertex_capacity, triangle_capacity, material_capacity, library_capacity;
    size_t vertices_before; /* vertices above the line in work: what negative indices count from */
    srp_token material;     /* in force; size 0 before any usemtl */
    size_t material_index;  /* its index in the mesh, SIZE_MAX until a face needs it */
    srp_corner *corners;    /* of the face in work */
    size_t corner_capacity;
    bool has_area; /* some face has */
    srp_tally no_area, crossing, not_flat, repeated, not_utf8;
} obj_reader;

srp_mesh_read_params srp_mesh_read_params_default(void) {
    return (srp_mesh_read_params){.metres_per_unit = 1.0};
}

static srp_status no_memory(obj_reader *reader) {
    return srp_fail_at(reader->error, SRP_NO_MEMORY, reader->text.name, reader->text.line, 0,
                       "no memory for the mesh");
}

/* Makes room for one more item in a list that doubles; false without memory. */
static bool reserve(void **list, size_t *capacity, size_t needed, size_t size) {
    if (needed <= *capacity) {
        return true;
    }
    size_t wanted = *capacity < 32 ? 64 : 2 * *capacity;
    wanted = wanted < needed ? needed : wanted;
    void *larger = wanted > SIZE_MAX / size ? NULL : realloc(*list, wanted * size);
    if (larger == NULL) {
        return false;
    }
    *list = larger;
    *capacity = wanted;
    return true;
}

/* ---- Vertices ----------------------------------------------------------------------------- */

/* v x y z [w] [r g b]: what follows z must be numbers, and is not used. */
static srp_status read_vertex(obj_reader *reader) {
    static const char *const what[] = {"x of the vertex", "y of the vertex", "z of the vertex"};
    double value[3] = {0.0, 0.0, 0.0};
    srp_mesh *mesh = reader->mesh;
    for (int i = 0; i < 3; i++) {
        srp_token where;
        srp_status status =
            srp_text_double(&reader->text, what[i], &value[i], &where, reader->error);
        if (status != SRP_OK) {
            return status;
        }
        value[i] *= reader->metres_per_unit;
        if (!(fabs(value[i]) <= SRP_REACH_MAX)) {
            return srp_fail_at(reader->error, SRP_BAD_DATA, reader->text.name, where.line,
                               where.column,
                               "%s is %g m, expected at most %g m: is its unit right?", what[i],
                               value[i], SRP_REACH_MAX);
        }
    }
    srp_token token;
    for (int extra = 0; extra < 4 && srp_text_next_token(&reader->text, &token); extra++) {
        double unused;
        srp_status status = srp_token_double(&reader->text, token, "weight or colour of the vertex",
                                             &unused, reader->error);
        if (status != SRP_OK) {
            return status;
        }
    }
    if (mesh->vertex_count == SRP_MESH_COUNT_MAX) {
        return srp_fail_at(reader->error, SRP_BAD_FORMAT, reader->text.name, reader->text.line, 0,
                           "more than %zu vertices", SRP_MESH_COUNT_MAX);
    }
    void *list = mesh->vertices;
    if (!reserve(&list, &reader->vertex_capacity, mesh->vertex_count + 1, sizeof(srp_vec3))) {
        return no_memory(reader);
    }
    mesh->vertices = list;
    mesh->vertices[mesh->vertex_count++] = srp_vec3_make(value[0], value[1], value[2]);
    return srp_text_end_of_line(&reader->text, reader->error);
}

static srp_status read_vertices(obj_reader *reader) {
    srp_status status = SRP_OK;
    while (status == SRP_OK && srp_text_next_line(&reader->text)) {
        srp_token keyword;
        srp_text_next_token(&reader->text, &keyword);
        if (srp_token_is(keyword, "v")) {
            status = read_vertex(reader);
        }
    }
    return status;
}

/* ---- Names -------------------------------------------------------------------------------- */

static srp_status read_material(obj_reader *reader) {
    srp_token name = srp_text_rest(&reader->text);
    if (name.size == 0) {
        return srp_text_expected(&reader->text, name, "the name of a material", reader->error);
    }
    reader->material = name;
    reader->material_index = SIZE_MAX;
    return SRP_OK;
}

/* Adds `name`, which is the mesh's from here on, as material `index` of the mesh. */
static srp_status add_material(obj_reader *reader, size_t index, char *name) {
    srp_mesh *mesh = reader->mesh;
    void *list = mesh->material_names;
    if (!reserve(&list, &reader->material_capacity, index + 1, sizeof(char *))) {
        free(name);
        return no_memory(reader);
    }
    mesh->material_names = list;
    mesh->material_names[index] = name;
    mesh->material_count++;
    if (!srp_token_is_utf8(reader->material) && srp_tally_shows(&reader->not_utf8)) {
        srp_warn_at(reader->log, reader->text.name, reader->material.line, reader->material.column,
                    "the name of a material is not UTF-8: it is read as %s",
                    srp_token_excerpt(reader->material).text);
    }
    return SRP_OK;
}

/* Index of the material in force; added to the mesh when it is new. */
static srp_status find_material(obj_reader *reader, uint32_t *index) {
    srp_mesh *mesh = reader->mesh;
    if (reader->material_index == SIZE_MAX) {
        char *name = srp_token_name(reader->material);
        size_t i = 0;
        if (name == NULL) {
            return no_memory(reader);
        }
        while (i < mesh->material_count && strcmp(name, mesh->material_names[i]) != 0) {
            i++;
        }
        if (i < mesh->material_count) {
            free(name);
        } else if (add_material(reader, i, name) != SRP_OK) {
            return SRP_NO_MEMORY;
        }
        reader->material_index = i;
    }
    *index = (uint32_t)reader->material_index;
    return SRP_OK;
}

/* `name` against the directory of the OBJ file, by malloc; NULL without memory. */
static char *resolve(const char *obj_name, srp_token name) {
    const char *slash = strrchr(obj_name, '/');
    size_t directory = slash == NULL || name.text[0] == '/' ? 0 : (size_t)(slash - obj_name) + 1;
    char *path = malloc(directory + name.size + 1);
    if (path != NULL) {
        memcpy(path, obj_name, directory);
        memcpy(path + directory, name.text, name.size);
        path[directory + name.size] = '\0';
    }
    return path;
}

static srp_status add_library(obj_reader *reader, srp_token name) {
    srp_mesh *mesh = reader->mesh;
    void *list = mesh->libraries;
    if (!reserve(&list, &reader->library_capacity, mesh->library_count + 1, sizeof(char *))) {
        return no_memory(reader);
    }
    mesh->libraries = list;
    char *path = resolve(reader->text.name, name);
    if (path == NULL) {
        return no_memory(reader);
    }
    mesh->libraries[mesh->library_count++] = path;
    for (size_t i = 0; i + 1 < mesh->library_count; i++) {
        if (strcmp(mesh->libraries[i], path) == 0) {
            mesh->library_count--;
            free(path);
            break;
        }
    }
    return SRP_OK;
}

/* Does the name that ends before byte `end` end in .mtl? */
static bool ends_as_library(srp_token names, size_t end) {
    static const char ending[] = ".mtl";
    for (size_t i = 0; i < 4; i++) {
        if (end < 4 || (names.text[end - 4 + i] | (i > 0 ? 0x20 : 0)) != ending[i]) {
            return false;
        }
    }
    return true;
}

/* mtllib a.mtl b.mtl: several names, each of which may hold blanks. A name ends where ".mtl" stands
 * before a blank, or with the line. */
static srp_status read_libraries(obj_reader *reader) {
    srp_token names = srp_text_rest(&reader->text);
    if (names.size == 0) {
        return srp_text_expected(&reader->text, names, "the name of an MTL file", reader->error);
    }
    size_t begin = 0;
    for (size_t end = 1; end <= names.size; end++) {
        bool blank = end < names.size && (names.text[end] == ' ' || names.text[end] == '\t');
        if (end == names.size || (blank && ends_as_library(names, end))) {
            srp_status status = add_library(reader, srp_token_part(names, begin, end));
            if (status != SRP_OK) {
                return status;
            }
            while (end < names.size && (names.text[end] == ' ' || names.text[end] == '\t')) {
                end++;
            }
            begin = end;
        }
    }
    return SRP_OK;
}

/* ---- Faces -------------------------------------------------------------------------------- */

static srp_status read_vertex_index(obj_reader *reader, srp_token token, uint32_t *out) {
    size_t count = reader->mesh->vertex_count;
    int64_t index;
    srp_status status = srp_token_integer(&reader->text, token, "a vertex index", INT64_MIN,
                                          INT64_MAX, &index, reader->error);
    if (status != SRP_OK) {
        return status;
    }
    if (index > 0 && (uint64_t)index <= count) {
        *out = (uint32_t)(index - 1);
        return SRP_OK;
    }
    if (index < 0 && index >= -(int64_t)reader->vertices_before) {
        *out = (uint32_t)((int64_t)reader->vertices_before + index);
        return SRP_OK;
    }
    if (index == 0) {
        return srp_fail_at(reader->error, SRP_BAD_FORMAT, reader->text.name, token.line,
                           token.column,
                           "vertex index 0: expected 1 for the first vertex or -1 for the latest");
    }
    return srp_fail_at(reader->error, SRP_BAD_FORMAT, reader->text.name, token.line, token.column,
                       index > 0 ? "vertex index %.*s is out of range: the file has %zu vertices"
                                 : "vertex index %.*s is out of range: %zu vertices are above it",
                       token.size < 40 ? (int)token.size : 40, token.text,
                       index > 0 ? count : reader->vertices_before);
}

/* v, v/vt, v//vn or v/vt/vn; the texture and normal indices must be numbers, and are not used. */
static srp_status read_corner(obj_reader *reader, srp_token token, uint32_t *out) {
    size_t slash[2] = {token.size, token.size}, slashes = 0;
    for (size_t i = 0; i < token.size; i++) {
        if (token.text[i] == '/') {
            if (slashes < 2) {
                slash[slashes] = i;
            }
            slashes++;
        }
    }
    srp_token v = srp_token_part(token, 0, slash[0]);
    srp_token vt = srp_token_part(token, slash[0], slash[0]);
    srp_token vn = vt;
    if (slashes > 0) {
        vt = srp_token_part(token, slash[0] + 1, slash[1]);
    }
    if (slashes > 1) {
        vn = srp_token_part(token, slash[1] + 1, token.size);
    }
    if (slashes > 2 || v.size == 0 || (slashes == 1 && vt.size == 0) ||
        (slashes == 2 && vn.size == 0)) {
        return srp_text_expected(&reader->text, token, "a corner: v, v/vt, v//vn or v/vt/vn",
                                 reader->error);
    }
    int64_t unused;
    srp_status status = SRP_OK;
    if (vt.size > 0) {
        status = srp_token_integer(&reader->text, vt, "a texture index", INT64_MIN, INT64_MAX,
                                   &unused, reader->error);
    }
    if (status == SRP_OK && vn.size > 0) {
        status = srp_token_integer(&reader->text, vn, "a normal index", INT64_MIN, INT64_MAX,
                                   &unused, reader->error);
    }
    return status == SRP_OK ? read_vertex_index(reader, v, out) : status;
}

/* Reads the corners of a face into reader->corners. */
static srp_status read_corners(obj_reader *reader, srp_token keyword, size_t *count) {
    srp_token token;
    size_t used = 0;
    while (srp_text_next_token(&reader->text, &token)) {
        if (used == SRP_POLYGON_MAX) {
            return srp_fail_at(reader->error, SRP_BAD_FORMAT, reader->text.name, keyword.line,
                               keyword.column, "a face of more than %d vertices: split it",
                               (int)SRP_POLYGON_MAX);
        }
        void *list = reader->corners;
        if (!reserve(&list, &reader->corner_capacity, used + 1, sizeof(srp_corner))) {
            return no_memory(reader);
        }
        reader->corners = list;
        srp_status status = read_corner(reader, token, &reader->corners[used].vertex);
        if (status != SRP_OK) {
            return status;
        }
        used++;
    }
    if (used < 3) {
        return srp_fail_at(reader->error, SRP_BAD_FORMAT, reader->text.name, keyword.line,
                           keyword.column, "a face of %zu %s, expected at least 3", used,
                           used == 1 ? "vertex" : "vertices");
    }
    *count = used;
    return SRP_OK;
}

/* Drops corners that repeat the one before them, as long as three are left. */
static size_t drop_repeated(srp_corner *corners, size_t count) {
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        bool repeats = kept > 0 && corners[i].vertex == corners[kept - 1].vertex;
        if (!repeats || count - i + kept <= 3) {
            corners[kept++].vertex = corners[i].vertex;
        }
    }
    while (kept > 3 && corners[kept - 1].vertex == corners[0].vertex) {
        kept--;
    }
    return kept;
}

static void warn_of_flaws(obj_reader *reader, srp_token keyword, unsigned flaws) {
    const char *what = NULL;
    if ((flaws & SRP_POLYGON_NO_AREA) != 0 && srp_tally_shows(&reader->no_area)) {
        what = "the face has no area";
    } else if ((flaws & SRP_POLYGON_CROSSES) != 0 && srp_tally_shows(&reader->crossing)) {
        what = "the face crosses itself: what it covers is not defined";
    } else if ((flaws & SRP_POLYGON_NOT_FLAT) != 0 && srp_tally_shows(&reader->not_flat)) {
        what = "the face is not flat: its corners are off a plane by more than 1 % of its size";
    }
    if (what != NULL) {
        srp_warn_at(reader->log, reader->text.name, keyword.line, keyword.column, "%s", what);
    }
}

static void count_face(srp_mesh *mesh, size_t corners) {
    if (corners == 3) {
        mesh->faces_triangle++;
    } else if (corners == 4) {
        mesh->faces_quad++;
    } else {
        mesh->faces_larger++;
    }
}

/* Makes room for `more` triangles and their materials. */
static srp_status reserve_triangles(obj_reader *reader, size_t more) {
    srp_mesh *mesh = reader->mesh;
    if (more > SRP_MESH_COUNT_MAX - mesh->triangle_count) {
        return srp_fail_at(reader->error, SRP_BAD_FORMAT, reader->text.name, reader->text.line, 0,
                           "more than %zu triangles", SRP_MESH_COUNT_MAX);
    }
    size_t needed = mesh->triangle_count + more, capacity = reader->triangle_capacity;
    void *triangles = mesh->triangles, *materials = mesh->triangle_material;
    bool done = reserve(&triangles, &capacity, needed, sizeof(srp_triangle));
    mesh->triangles = triangles;
    done = done && reserve(&materials, &reader->triangle_capacity, needed, sizeof(uint32_t));
    mesh->triangle_material = materials;
    return done ? SRP_OK : no_memory(reader);
}

static bool has_area(const srp_mesh *mesh, const srp_triangle *triangle) {
    return !srp_triangle_is_degenerate(mesh->vertices[triangle->v[0]],
                                       mesh->vertices[triangle->v[1]],
                                       mesh->vertices[triangle->v[2]]);
}

static srp_status read_face(obj_reader *reader, srp_token keyword) {
    srp_mesh *mesh = reader->mesh;
    size_t count = 0;
    uint32_t material = 0;
    srp_status status = read_corners(reader, keyword, &count);
    if (status == SRP_OK) {
        status = find_material(reader, &material);
    }
    if (status == SRP_OK) {
        status = reserve_triangles(reader, count - 2);
    }
    if (status != SRP_OK) {
        return status;
    }
    count_face(mesh, count);
    size_t kept = drop_repeated(reader->corners, count);
    if (kept < count && srp_tally_shows(&reader->repeated)) {
        srp_warn_at(reader->log, reader->text.name, keyword.line, keyword.column,
                    "the face names a vertex twice in a row");
    }
    srp_triangle *triangles = mesh->triangles + mesh->triangle_count;
    warn_of_flaws(reader, keyword,
                  srp_polygon_split(mesh->vertices, reader->corners, kept, triangles));
    for (size_t i = 0; i < kept - 2; i++) {
        mesh->triangle_material[mesh->triangle_count++] = material;
        reader->has_area = reader->has_area || has_area(mesh, &triangles[i]);
    }
    return SRP_OK;
}

static srp_status read_faces(obj_reader *reader) {
    srp_status status = SRP_OK;
    while (status == SRP_OK && srp_text_next_line(&reader->text)) {
        srp_token keyword;
        srp_text_next_token(&reader->text, &keyword);
        if (srp_token_is(keyword, "v")) {
            reader->vertices_before++;
        } else if (srp_token_is(keyword, "f") || srp_token_is(keyword, "fo")) {
            status = read_face(reader, keyword);
        } else if (srp_token_is(keyword, "usemtl")) {
            status = read_material(reader);
        } else if (srp_token_is(keyword, "mtllib")) {
            status = read_libraries(reader);
        }
    }
    srp_tally_close(&reader->no_area, reader->log, reader->text.name, "faces without area");
    srp_tally_close(&reader->crossing, reader->log, reader->text.name,
                    "faces that cross themselves");
    srp_tally_close(&reader->not_flat, reader->log, reader->text.name, "faces that are not flat");
    srp_tally_close(&reader->repeated, reader->log, reader->text.name,
                    "faces that name a vertex twice in a row");
    srp_tally_close(&reader->not_utf8, reader->log, reader->text.name, "names that are not UTF-8");
    return status;
}

/* ---- The whole ---------------------------------------------------------------------------- */

static srp_status read_mesh(obj_reader *reader) {
    srp_text start = reader->text;
    srp_status status = read_vertices(reader);
    if (status == SRP_OK) {
        reader->text = start;
        status = read_faces(reader);
    }
    if (status != SRP_OK) {
        return status;
    }
    if (reader->mesh->triangle_count == 0) {
        return srp_fail_at(reader->error, SRP_BAD_FORMAT, reader->text.name, 0, 0,
                           "found %zu vert%s and no face, expected an OBJ file with faces (f)",
                           reader->mesh->vertex_count,
                           reader->mesh->vertex_count == 1 ? "ex" : "ices");
    }
    if (!reader->has_area) {
        return srp_fail_at(reader->error, SRP_BAD_DATA, reader->text.name, 0, 0,
                           "none of its triangles has an area");
    }
    return SRP_OK;
}

srp_status srp_mesh_parse_obj(const char *text, size_t size, const char *name,
                              const srp_mesh_read_params *params, const srp_log *log,
                              srp_mesh **out, srp_error *error) {
    obj_reader reader = {.log = log, .error = error, .material = {.text = ""}};
    reader.material_index = SIZE_MAX;
    reader.metres_per_unit = params == NULL ? 1.0 : params->metres_per_unit;
    if (!(isfinite(reader.metres_per_unit) && reader.metres_per_unit > 0.0)) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "%g metres per unit, expected more than 0",
                        reader.metres_per_unit);
    }
    srp_status status = srp_text_open(&reader.text, text, size, name,
                                      SRP_TEXT_COMMENTS | SRP_TEXT_CONTINUED_LINES, error);
    if (status != SRP_OK) {
        return status;
    }
    reader.mesh = calloc(1, sizeof *reader.mesh);
    if (reader.mesh == NULL) {
        return no_memory(&reader);
    }
    srp_c_locale locale = srp_platform_c_locale_enter();
    status = read_mesh(&reader);
    srp_platform_c_locale_leave(locale);
    free(reader.corners);
    if (status != SRP_OK) {
        srp_mesh_destroy(reader.mesh);
        return status;
    }
    *out = reader.mesh;
    return SRP_OK;
}

srp_status srp_mesh_read_obj(const char *path, const srp_mesh_read_params *params,
                             const srp_log *log, srp_mesh **out, srp_error *error) {
    char *text;
    size_t size;
    srp_status status = srp_text_read_file(path, &text, &size, error);
    if (status != SRP_OK) {
        return status;
    }
    status = srp_mesh_parse_obj(text, size, path, params, log, out, error);
    free(text);
    return status;
}
