/* SPDX-License-Identifier: Apache-2.0 */
#include "info.h"

#include "messages.h"
#include "model.h"
#include "suggest.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int no_memory(void) {
    cli_say("no memory for the report");
    return CLI_MACHINE_FAILED;
}

/* ---- reading ---- */

/* Remembers the MTL files of `part`, once each. */
static int add_libraries(cli_info *info, const srp_mesh *part) {
    size_t count = srp_mesh_library_count(part);
    info_library *libraries =
        realloc(info->libraries, (info->library_count + count + 1) * sizeof *libraries);
    if (libraries == NULL) {
        return no_memory();
    }
    info->libraries = libraries;
    for (size_t i = 0; i < count; ++i) {
        const char *path = srp_mesh_library(part, i);
        size_t k = 0;
        while (k < info->library_count && strcmp(libraries[k].path, path) != 0) {
            ++k;
        }
        if (k < info->library_count) {
            continue;
        }
        size_t size = strlen(path) + 1;
        char *copy = malloc(size);
        if (copy == NULL) {
            return no_memory();
        }
        memcpy(copy, path, size);
        libraries[info->library_count++] = (info_library){copy, false, NULL};
    }
    return CLI_DONE;
}

static int read_file(cli_info *info, const char *path, double metres_per_unit) {
    srp_mesh_read_params params = srp_mesh_read_params_default();
    params.metres_per_unit = metres_per_unit;
    srp_log log = cli_log();
    srp_mesh *part = NULL;
    srp_error error;
    if (srp_mesh_read_obj(path, &params, &log, &part, &error) != SRP_OK) {
        return cli_input_error(&error);
    }
    info->files[info->file_count++] =
        (info_file){path, srp_mesh_vertex_count(part), srp_mesh_triangle_count(part)};
    int status = add_libraries(info, part);
    if (info->mesh == NULL) {
        info->mesh = part;
        return status;
    }
    if (status == CLI_DONE && srp_mesh_append(info->mesh, part, &error) != SRP_OK) {
        status = cli_input_error(&error);
    }
    srp_mesh_destroy(part);
    return status;
}

/* Pins what the user gave, so that a file's word on the same material does not count. */
static srp_status pin_given(srp_materials *list, const srp_materials *given, srp_error *error) {
    srp_status status = SRP_OK;
    for (size_t i = 0; i < srp_materials_count(given) && status == SRP_OK; ++i) {
        const char *name = srp_materials_name(given, i);
        srp_optics optics;
        if (srp_materials_find(given, name, &optics)) {
            status = srp_materials_set(list, name, optics, true, error);
        }
    }
    return status;
}

static int read_library(info_library *library, const srp_materials *given) {
    srp_log log = cli_log();
    srp_error error;
    srp_status status = srp_materials_create(&library->materials, &error);
    if (status == SRP_OK) {
        status = pin_given(library->materials, given, &error);
    }
    if (status == SRP_OK) {
        status = srp_materials_read_mtl(library->materials, library->path, &log, &error);
    }
    library->missing = status == SRP_NOT_FOUND;
    return status == SRP_OK || library->missing ? CLI_DONE : cli_input_error(&error);
}

/* ---- optics and where they are from ---- */

static bool same(srp_optics a, srp_optics b) {
    return a.rho_s == b.rho_s && a.rho_d == b.rho_d && a.one_sided == b.one_sided;
}

static void find_optics(const cli_info *info, info_material *material) {
    if (srp_materials_find(info->given, material->name, &material->optics)) {
        material->known = true;
        material->source = "--material";
        return;
    }
    for (size_t i = 0; i < info->library_count; ++i) {
        /* As in a scene: what is read later wins. */
        const info_library *library = &info->libraries[i];
        srp_optics optics;
        if (srp_materials_find(library->materials, material->name, &optics)) {
            material->contradicted =
                material->contradicted || (material->known && !same(optics, material->optics));
            material->known = true;
            material->optics = optics;
            material->source = library->path;
        }
    }
}

static int collect_materials(cli_info *info) {
    size_t count = srp_mesh_material_count(info->mesh);
    double *area = calloc(count + 1, sizeof *area);
    info->materials = calloc(count + 1, sizeof *info->materials);
    if (area == NULL || info->materials == NULL) {
        free(area);
        return no_memory();
    }
    srp_error error;
    if (srp_mesh_material_areas(info->mesh, area, &error) != SRP_OK) {
        free(area);
        return cli_input_error(&error);
    }
    for (size_t i = 0; i < count; ++i) {
        info_material *material = &info->materials[info->material_count++];
        material->name = srp_mesh_material_name(info->mesh, i);
        material->area = area[i];
        find_optics(info, material);
    }
    free(area);
    return CLI_DONE;
}

/* ---- findings ---- */

SRP_PRINTF(4, 5)
static void find(cli_info *info, const char *kind, size_t count, const char *format, ...) {
    if (count == 0) {
        return;
    }
    if (info->finding_count == INFO_FINDINGS_MAX) {
        ++info->findings_dropped;
        return;
    }
    info_finding *finding = &info->findings[info->finding_count++];
    finding->kind = kind;
    finding->count = count;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(finding->text, sizeof finding->text, format, arguments);
    va_end(arguments);
}

/* Longest sides that a spacecraft hardly has [m]: what is beyond was drawn in another unit. */
static const double LONGEST_LIKELY = 120.0, SHORTEST_LIKELY = 0.05;

static void find_unit(cli_info *info) {
    static const struct {
        const char *name, *option;
        double metres;
    } units[] = {{"millimetres", "mm", 1e-3}, {"centimetres", "cm", 1e-2}};
    srp_vec3 size = srp_vec3_sub(info->report.box_max, info->report.box_min);
    double longest = fmax(size.x, fmax(size.y, size.z));
    if (longest < SHORTEST_LIKELY) {
        find(info, "unit", 1, "the longest side is %g m, less than any spacecraft: check --unit",
             longest);
        return;
    }
    if (longest <= LONGEST_LIKELY) {
        return;
    }
    const int k = longest >= 1000.0 ? 0 : 1;
    find(info, "unit", 1,
         "the longest side is %g m, more than any spacecraft: in %s it would be %g m (--unit %s)",
         longest, units[k].name, longest * units[k].metres, units[k].option);
}

static void find_shape(cli_info *info) {
    const srp_mesh_report *r = &info->report;
    size_t open = r->components - r->closed_components;
    find(info, "open-edges", r->boundary_edges,
         "%zu open %s: %zu of %zu %s not closed. Light can fall on the backs of "
         "their faces, which carry the same material unless it is one-sided",
         r->boundary_edges, cli_form(r->boundary_edges, "edge", "edges"), open, r->components,
         r->components == 1 ? "component is" : cli_form(open, "components is", "components are"));
    find(info, "non-manifold-edges", r->nonmanifold_edges, "%zu %s to more than two triangles",
         r->nonmanifold_edges, cli_form(r->nonmanifold_edges, "edge belongs", "edges belong"));
    find(info, "inconsistent-winding", r->inconsistent_edges,
         "%zu %s between triangles that disagree about which side is outside",
         r->inconsistent_edges, cli_form(r->inconsistent_edges, "edge lies", "edges lie"));
    find(info, "inward-components", r->inward_components,
         "%zu closed %s wound inside out; methods turn %s", r->inward_components,
         cli_form(r->inward_components, "component is", "components are"),
         cli_form(r->inward_components, "it", "them"));
    find(info, "degenerate", r->degenerate, "%zu %s no area; methods leave %s out", r->degenerate,
         cli_form(r->degenerate, "triangle has", "triangles have"),
         cli_form(r->degenerate, "it", "them"));
    find(info, "duplicate", r->duplicate, "%zu %s another one with the same winding", r->duplicate,
         cli_form(r->duplicate, "triangle repeats", "triangles repeat"));
    find(info, "back-to-back", r->opposite,
         "%zu triangles lie back to back with another one: shells without thickness", r->opposite);
    int kinds = (r->faces_triangle > 0) + (r->faces_quad > 0) + (r->faces_larger > 0);
    find(info, "mixed-faces", kinds > 1 ? 1 : 0,
         "faces are mixed: %zu %s, %zu %s, %zu larger; all were split into triangles",
         r->faces_triangle, cli_form(r->faces_triangle, "triangle", "triangles"), r->faces_quad,
         cli_form(r->faces_quad, "quadrilateral", "quadrilaterals"), r->faces_larger);
}

static void find_optics_missing(cli_info *info) {
    for (size_t i = 0; i < info->library_count; ++i) {
        find(info, "missing-mtl", info->libraries[i].missing, "the MTL file %s does not exist",
             info->libraries[i].path);
    }
    for (size_t i = 0; i < info->material_count; ++i) {
        const info_material *material = &info->materials[i];
        find(info, "no-optics", !material->known,
             "the material '%s' has no optics: give --material '%s=RHO_S,RHO_D'", material->name,
             material->name);
        find(info, "contradicting-mtl", material->contradicted,
             "several MTL files have different optics for the material '%s': those of %s are taken",
             material->name, material->source);
    }
}

/* Materials of --material that no face has: slips of the pen, most likely. */
static void find_strangers(cli_info *info) {
    for (size_t i = 0; i < srp_materials_count(info->given); ++i) {
        const char *name = srp_materials_name(info->given, i);
        cli_suggestion near = cli_suggestion_begin(name);
        bool used = false;
        for (size_t k = 0; k < info->material_count && !used; ++k) {
            used = strcmp(info->materials[k].name, name) == 0;
            cli_suggestion_offer(&near, info->materials[k].name);
        }
        find(info, "unused-material", !used, "no face has the material '%s' of --material%s%s%s",
             name, near.best != NULL ? "; did you mean '" : "", near.best != NULL ? near.best : "",
             near.best != NULL ? "'?" : "");
    }
}

/* ---- together ---- */

int cli_info_collect(const cli_model_options *model, const cli_operands *operands, cli_info *out) {
    memset(out, 0, sizeof *out);
    out->files = calloc(operands->count + 1, sizeof *out->files);
    int status = out->files != NULL ? CLI_DONE : no_memory();
    if (status == CLI_DONE) {
        status = cli_materials_given(&model->materials, &out->given);
    }
    for (size_t i = 0; i < operands->count && status == CLI_DONE; ++i) {
        status = read_file(out, operands->items[i], model->metres_per_unit);
    }
    for (size_t i = 0; i < out->library_count && status == CLI_DONE; ++i) {
        status = read_library(&out->libraries[i], out->given);
    }
    srp_error error;
    if (status == CLI_DONE && srp_mesh_inspect(out->mesh, &out->report, &error) != SRP_OK) {
        status = cli_input_error(&error);
    }
    if (status == CLI_DONE) {
        status = collect_materials(out);
    }
    if (status == CLI_DONE) {
        find_unit(out);
        find_shape(out);
        find_optics_missing(out);
        find_strangers(out);
    }
    return status;
}

void cli_info_release(cli_info *info) {
    for (size_t i = 0; i < info->library_count; ++i) {
        free(info->libraries[i].path);
        srp_materials_destroy(info->libraries[i].materials);
    }
    free(info->libraries);
    free(info->materials);
    free(info->files);
    srp_materials_destroy(info->given);
    srp_mesh_destroy(info->mesh);
}
