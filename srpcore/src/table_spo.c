/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Tables as SPAD files (.spo), which GMAT and STK read. What GMAT's reader asks for is written down
 * in docs/file-formats.md. The force has the sign of our f: the Sun on +X pushes towards -X.
 *
 * The eleventh column, from the centre of pressure to the centre of mass, is the distance between
 * the reference point and the line along which the force acts, |f x t| / f.f.
 */
#include "error.h"
#include "platform.h"
#include "table_text.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* `text` as a value that GMAT takes: no colon, nothing that does not print, not empty. */
static void print_value(srp_sheet *sheet, const char *key, const char *text) {
    char value[256];
    size_t size = 0;
    for (; *text != '\0' && size < sizeof value - 1; ++text) {
        unsigned char byte = (unsigned char)*text;
        value[size++] = byte == ':' || byte < ' ' || byte == 127 ? ' ' : *text;
    }
    while (size > 0 && value[size - 1] == ' ') {
        size--;
    }
    value[size] = '\0';
    srp_sheet_print(sheet, "%-18s : %s\n", key, value[strspn(value, " ")] == '\0' ? "-" : value);
}

static void print_motion(srp_sheet *sheet, int number, const char *name, double range,
                         uint32_t count) {
    srp_sheet_print(sheet,
                    "Motion    : %d\n  Name    : %s\n  Method  : Step\n  Minimum : %g\n"
                    "  Maximum : %g\n  Step    : %.15g\n",
                    number, name, -range / 2.0, range / 2.0, range / (double)(count - 1));
}

static void print_header(srp_sheet *sheet, const srp_table *table) {
    const srp_table_info *info = &table->info;
    char text[256];
    srp_sheet_print(sheet, "%-18s : %s\n", "Version", "4.27");
    print_value(sheet, "System", info->title[0] != '\0' ? info->title : "spacecraft");
    srp_sheet_print(sheet, "%-18s : %s\n", "Analysis Type", "Area");
    srp_sheet_print(sheet, "%-18s : %s\n", "Pressure", "1");
    snprintf(text, sizeof text, "(%.17g, %.17g, %.17g)", info->params.reference.x,
             info->params.reference.y, info->params.reference.z);
    print_value(sheet, "Center of Mass", text);
    snprintf(text, sizeof text, "%s %s", srp_table_writer, info->version);
    print_value(sheet, "Software", text);
    if (info->method[0] != '\0') {
        snprintf(text, sizeof text, "%s on %s", info->method, info->device);
        print_value(sheet, "Method", text);
        print_value(sheet, "Shape hash", info->shape_hash);
        print_value(sheet, "Optics hash", info->optics_hash);
        if (info->traced_optics_hash[0] != '\0') {
            print_value(sheet, "Traced optics hash", info->traced_optics_hash);
        }
        if (info->bounce_kept) {
            print_value(sheet, "Reflected light", "as traced, not of these optics");
        }
    }
    srp_sheet_print(sheet, "\n");
    print_motion(sheet, 1, "Azimuth", 360.0, table->grid.az_count);
    print_motion(sheet, 2, "Elevation", 180.0, table->grid.el_count);
    srp_sheet_print(sheet, ": END\n\n%-18s : %zu\n\n", "Record count",
                    srp_grid_node_count(table->grid));
}

enum { NUMBER_WIDTH = 24 };

static void print_titles(srp_sheet *sheet, bool with_moment) {
    static const char *const TITLES[] = {"Force(X)",  "Force(Y)",  "Force(Z)", "Force", "Torque(X)",
                                         "Torque(Y)", "Torque(Z)", "Torque",   "CP-CG"};
    static const char *const UNITS[] = {"m^2", "m^2", "m^2", "m^2", "m^3",
                                        "m^3", "m^3", "m^3", "m"};
    static const char DASHES[] = "-----------------------";
    size_t columns = with_moment ? 9 : 3;
    srp_sheet_print(sheet, " AzimuthElevatio");
    for (size_t k = 0; k < columns; ++k) {
        srp_sheet_print(sheet, " %*s", NUMBER_WIDTH, TITLES[k]);
    }
    srp_sheet_print(sheet, "\n degrees degrees");
    for (size_t k = 0; k < columns; ++k) {
        srp_sheet_print(sheet, " %*s", NUMBER_WIDTH, UNITS[k]);
    }
    srp_sheet_print(sheet, "\n ------- -------");
    for (size_t k = 0; k < columns; ++k) {
        srp_sheet_print(sheet, " %*s", NUMBER_WIDTH, DASHES);
    }
    srp_sheet_print(sheet, "\n");
}

static void print_numbers(srp_sheet *sheet, size_t count, const double *values) {
    for (size_t k = 0; k < count; ++k) {
        srp_sheet_print(sheet, " %*.16e", NUMBER_WIDTH, values[k]);
    }
}

static void print_node(srp_sheet *sheet, const srp_response *node, bool with_moment) {
    const double force[] = {node->f.x, node->f.y, node->f.z};
    print_numbers(sheet, 3, force);
    if (with_moment) {
        /* |f x t| / f.f, without the product of four large numbers. */
        double size = srp_vec3_norm(node->f), distance = 0.0;
        if (size > 0.0) {
            srp_vec3 along = srp_vec3_scale(1.0 / size, node->f);
            distance = srp_vec3_norm(srp_vec3_cross(along, node->t)) / size;
        }
        const double rest[] = {size,    node->t.x, node->t.y, node->t.z, srp_vec3_norm(node->t),
                               distance};
        print_numbers(sheet, 6, rest);
    }
    srp_sheet_print(sheet, "\n");
}

static srp_status write_spo(const srp_table *table, const char *path, srp_error *error) {
    srp_sheet sheet = {0};
    srp_c_locale locale = srp_platform_c_locale_enter();
    print_header(&sheet, table);
    print_titles(&sheet, table->info.has_moment);
    for (uint32_t i = 0; i < table->grid.az_count; ++i) {
        for (uint32_t j = 0; j < table->grid.el_count; ++j) {
            srp_sheet_print_angles(&sheet, table->grid, i, j);
            print_node(&sheet, srp_table_node(table, i, j), table->info.has_moment);
        }
    }
    srp_platform_c_locale_leave(locale);
    return srp_sheet_save(&sheet, path, error);
}

static srp_status read_spo(const char *path, srp_table **out, srp_error *error) {
    char *bytes;
    size_t size;
    srp_status status = srp_text_read_file(path, &bytes, &size, error);
    if (status == SRP_OK) {
        status = srp_table_parse_spo(bytes, size, path, out, error);
        free(bytes);
    }
    return status;
}

const srp_table_format srp_table_format_spo = {
    .name = "spo",
    .ending = ".spo",
    .summary = "SPAD: force and torque, for GMAT and STK",
    .capabilities = 0,
    .write = write_spo,
    .read = read_spo,
};
