/* SPDX-License-Identifier: Apache-2.0 */
/* srp info: what a model is like, before it is computed with. */
#include "commands.h"
#include "info.h"
#include "info_table.h"
#include "json.h"
#include "messages.h"
#include "outputs.h"

#include <srp/plates.h>
#include <srp/table.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { INFO_JSON, INFO_OPTION_COUNT };

typedef struct info_options {
    cli_given given;
    bool json;
} info_options;

static const cli_option OPTIONS[INFO_OPTION_COUNT] = {
    [INFO_JSON] = {.name = "json",
                   .help = "Print JSON.",
                   .set = cli_set_flag,
                   .offset = offsetof(info_options, json)},
};

static const cli_group OUTPUT = {"Output", OPTIONS, INFO_OPTION_COUNT};
static const cli_group *const GROUPS[] = {&OUTPUT, &cli_group_model};

/* ---- text ---- */

static const char *shown_name(const char *name) {
    return name[0] != '\0' ? name : "(no name)";
}

static void print_counts(size_t vertices, size_t triangles) {
    printf("%zu %s, %zu %s\n", vertices, cli_form(vertices, "vertex", "vertices"), triangles,
           cli_form(triangles, "triangle", "triangles"));
}

static void print_mesh(const cli_info *info) {
    const srp_mesh_report *r = &info->report;
    srp_vec3 size = srp_vec3_sub(r->box_max, r->box_min);
    for (size_t i = 0; i < info->file_count; ++i) {
        printf("%s: ", info->files[i].path);
        print_counts(info->files[i].vertices, info->files[i].triangles);
    }
    fputc('\n', stdout);
    if (info->file_count > 1) {
        printf("%-14s ", "together");
        print_counts(r->vertices, r->triangles);
    }
    printf("%-14s %zu %s, %zu %s, %zu larger\n", "faces", r->faces_triangle,
           cli_form(r->faces_triangle, "triangle", "triangles"), r->faces_quad,
           cli_form(r->faces_quad, "quadrilateral", "quadrilaterals"), r->faces_larger);
    printf("%-14s %g x %g x %g m, from (%g, %g, %g) to (%g, %g, %g)\n", "box", size.x, size.y,
           size.z, r->box_min.x, r->box_min.y, r->box_min.z, r->box_max.x, r->box_max.y,
           r->box_max.z);
    printf("%-14s %zu, %zu of them closed\n", "components", r->components, r->closed_components);
    printf("%-14s %.9g m^2\n", "area", r->area);
    printf("%-14s %.9g m^3 in closed components\n", "volume", r->volume);
}

static void print_materials(const cli_info *info) {
    int width = (int)strlen("material");
    for (size_t i = 0; i < info->material_count; ++i) {
        int length = (int)strlen(shown_name(info->materials[i].name));
        width = length > width ? length : width;
    }
    printf("\n%-*s  %12s  %6s  %7s  %7s  %s\n", width, "material", "area [m^2]", "share", "rho_s",
           "rho_d", "from");
    for (size_t i = 0; i < info->material_count; ++i) {
        const info_material *m = &info->materials[i];
        double share = info->report.area > 0.0 ? 100.0 * m->area / info->report.area : 0.0;
        printf("%-*s  %12.6g  %5.1f%%  ", width, shown_name(m->name), m->area, share);
        if (m->known) {
            printf("%7g  %7g  %s%s\n", m->optics.rho_s, m->optics.rho_d, m->source,
                   m->optics.one_sided ? " (one-sided)" : "");
        } else {
            printf("%7s  %7s  %s\n", "-", "-", "nowhere");
        }
    }
}

static void print_text(const cli_info *info) {
    print_mesh(info);
    print_materials(info);
    if (info->finding_count == 0) {
        printf("\nNothing to complain about.\n");
        return;
    }
    printf("\nFindings:\n");
    for (size_t i = 0; i < info->finding_count; ++i) {
        printf("- %s\n", info->findings[i].text);
    }
    if (info->findings_dropped > 0) {
        printf("- and %zu more\n", info->findings_dropped);
    }
}

/* ---- JSON ---- */

static void write_mesh(cli_json *json, const cli_info *info) {
    const srp_mesh_report *r = &info->report;
    cli_json_open_array(json, "files");
    for (size_t i = 0; i < info->file_count; ++i) {
        cli_json_open_object(json, NULL);
        cli_json_text(json, "path", info->files[i].path);
        cli_json_count(json, "vertices", info->files[i].vertices);
        cli_json_count(json, "triangles", info->files[i].triangles);
        cli_json_close_object(json);
    }
    cli_json_close_array(json);
    cli_json_count(json, "vertices", r->vertices);
    cli_json_count(json, "triangles", r->triangles);
    cli_json_count(json, "faces_triangle", r->faces_triangle);
    cli_json_count(json, "faces_quad", r->faces_quad);
    cli_json_count(json, "faces_larger", r->faces_larger);
    cli_json_vector(json, "box_min_m", r->box_min);
    cli_json_vector(json, "box_max_m", r->box_max);
    cli_json_count(json, "components", r->components);
    cli_json_count(json, "closed_components", r->closed_components);
    cli_json_number(json, "area_m2", r->area);
    cli_json_vector(json, "area_vector_sum_m2", r->area_vector_sum);
    cli_json_number(json, "volume_m3", r->volume);
}

static void write_materials(cli_json *json, const cli_info *info) {
    cli_json_open_array(json, "materials");
    for (size_t i = 0; i < info->material_count; ++i) {
        const info_material *m = &info->materials[i];
        cli_json_open_object(json, NULL);
        cli_json_text(json, "name", m->name);
        cli_json_number(json, "area_m2", m->area);
        cli_json_number(json, "rho_s", m->known ? m->optics.rho_s : (double)NAN);
        cli_json_number(json, "rho_d", m->known ? m->optics.rho_d : (double)NAN);
        cli_json_flag(json, "one_sided", m->known && m->optics.one_sided);
        cli_json_text(json, "source", m->source);
        cli_json_close_object(json);
    }
    cli_json_close_array(json);
}

static void write_json(const cli_info *info) {
    cli_json json;
    cli_json_begin(&json, stdout);
    write_mesh(&json, info);
    write_materials(&json, info);
    cli_json_open_array(&json, "findings");
    for (size_t i = 0; i < info->finding_count; ++i) {
        cli_json_open_object(&json, NULL);
        cli_json_text(&json, "kind", info->findings[i].kind);
        cli_json_count(&json, "count", info->findings[i].count);
        cli_json_text(&json, "text", info->findings[i].text);
        cli_json_close_object(&json);
    }
    cli_json_close_array(&json);
    cli_json_end(&json);
}

/* ---- plates ---- */

static void print_plates(const char *path, const srp_plate *plates, size_t count) {
    double area = 0.0;
    for (size_t i = 0; i < count; ++i) {
        area += plates[i].area;
    }
    printf("%s: %zu %s, %.9g m^2\n\n", path, count, cli_form(count, "plate", "plates"), area);
    printf("%5s  %9s  %9s  %9s  %12s  %7s  %7s\n", "plate", "nx", "ny", "nz", "area [m^2]", "rho_s",
           "rho_d");
    for (size_t i = 0; i < count; ++i) {
        const srp_plate *p = &plates[i];
        printf("%5zu  %9.6f  %9.6f  %9.6f  %12.6g  %7g  %7g\n", i + 1, p->normal.x, p->normal.y,
               p->normal.z, p->area, p->optics.rho_s, p->optics.rho_d);
    }
}

static void write_plates(const char *path, const srp_plate *plates, size_t count) {
    cli_json json;
    cli_json_begin(&json, stdout);
    cli_json_text(&json, "path", path);
    cli_json_open_array(&json, "plates");
    for (size_t i = 0; i < count; ++i) {
        cli_json_open_object(&json, NULL);
        cli_json_vector(&json, "normal", plates[i].normal);
        cli_json_number(&json, "area_m2", plates[i].area);
        cli_json_number(&json, "rho_s", plates[i].optics.rho_s);
        cli_json_number(&json, "rho_d", plates[i].optics.rho_d);
        cli_json_close_object(&json);
    }
    cli_json_close_array(&json);
    cli_json_end(&json);
}

static int show_plates(const char *path, bool json) {
    srp_plate *plates = NULL;
    size_t count;
    srp_error error;
    if (srp_plates_read(path, &plates, &count, &error) != SRP_OK) {
        return cli_input_error(&error);
    }
    json ? write_plates(path, plates, count) : print_plates(path, plates, count);
    srp_plates_free(plates);
    return CLI_DONE;
}

/* ---- the command ---- */

static int show(const info_options *options, const cli_model_options *model,
                const cli_operands *operands) {
    if (model->plates != NULL) {
        if (operands->count > 0 || model->given != (cli_given)1 << MODEL_PLATES) {
            return cli_usage_error(
                "--plates FILE stands alone, without OBJ files and their options");
        }
        return show_plates(model->plates, options->json);
    }
    if (operands->count == 0) {
        return cli_usage_error("nothing given: MODEL.obj, --plates FILE or a table");
    }
    if (cli_input_format_of(operands->items[0]) != NULL) {
        if (operands->count > 1 || model->given != 0) {
            return cli_usage_error("%s is a table and stands alone, without options of a model",
                                   operands->items[0]);
        }
        return cli_info_table(operands->items[0], options->json);
    }
    cli_info info;
    int status = cli_info_collect(model, operands, &info);
    if (status == CLI_DONE) {
        options->json ? write_json(&info) : print_text(&info);
    }
    cli_info_release(&info);
    return status;
}

static int run(const cli_command *command, int argc, char **argv) {
    info_options options = {0};
    cli_model_options model = cli_model_options_default();
    void *const targets[] = {&options, &model};
    cli_operands operands;
    int status;
    if (cli_command_parse(command, argc, argv, targets, &operands, &status)) {
        status = show(&options, &model, &operands);
    }
    cli_list_free(&model.materials);
    return status;
}

const cli_command cli_command_info = {
    .name = "info",
    .operands = "MODEL.obj... | TABLE",
    .operand_files = "obj nc spo txt",
    .summary = "what a model or a table is like: sizes, areas, optics, faults",
    .description =
        "Reports on a mesh before it is computed with: sizes and a guess at the unit, area and "
        "optics of each material and where they came from, and what a user should know about: "
        "holes, duplicate, degenerate and back-to-back faces, inconsistent winding, missing MTL "
        "files and materials. Several OBJ files are joined. A missing MTL file is a finding, not "
        "an error.\n\n"
        "Of a table, told by its ending, it reports where it came from and what it holds: grid, "
        "method, mass, sunlight, the smallest, mean and largest force, moment and standard error "
        "with their directions, errors of interpolation if they were checked, materials, and what "
        "is odd about its numbers.",
    .examples = "srp info box-wing.obj\n"
                "srp info box-wing.nc\n"
                "srp info bus.obj antenna.obj --unit mm --json\n"
                "srp info --plates box-wing.plates",
    .groups = GROUPS,
    .group_count = sizeof GROUPS / sizeof GROUPS[0],
    .run = run,
};
