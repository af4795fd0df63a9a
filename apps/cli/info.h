/* SPDX-License-Identifier: Apache-2.0 */
/* What `srp info` finds out about a model, apart from how it is printed. */
#ifndef SRP_CLI_INFO_H
#define SRP_CLI_INFO_H

#include "method_options.h"

#include <srp/material.h>
#include <srp/mesh.h>

#include <stdbool.h>
#include <stddef.h>

typedef struct info_file {
    const char *path;
    size_t vertices, triangles;
} info_file;

typedef struct info_library {
    char *path;
    bool missing;             /* the MTL file does not exist */
    srp_materials *materials; /* of this file alone */
} info_library;

typedef struct info_material {
    const char *name; /* owned by the mesh */
    double area;      /* [m^2] */
    bool known;
    srp_optics optics;
    const char *source; /* where the optics are from: a file, "--material"; NULL = nowhere */
    bool contradicted;  /* another MTL file has other optics for it */
} info_material;

/* Something that a user should know about before trusting a result. */
typedef struct info_finding {
    const char *kind; /* one word, for scripts */
    size_t count;
    char text[400];
} info_finding;

enum { INFO_FINDINGS_MAX = 64 };

typedef struct cli_info {
    info_file *files;
    size_t file_count;
    srp_mesh *mesh; /* all files joined */
    srp_mesh_report report;
    srp_materials *given; /* --material */
    info_library *libraries;
    size_t library_count;
    info_material *materials;
    size_t material_count;
    info_finding findings[INFO_FINDINGS_MAX];
    size_t finding_count, findings_dropped;
} cli_info;

/* Fills *out, which is released by cli_info_release() in any case. An exit status, said if not
 * CLI_DONE. */
int cli_info_collect(const cli_model_options *model, const cli_operands *operands, cli_info *out);
void cli_info_release(cli_info *info);

#endif
