/* SPDX-License-Identifier: Apache-2.0 */
/* Where the normals of fitted plates come from. */
#ifndef SRP_CLI_FIT_NORMALS_H
#define SRP_CLI_FIT_NORMALS_H

#include "facing.h"

#include <srp/scene.h>

typedef struct cli_normals {
    size_t count;
    srp_vec3 normal[CLI_NORMALS_MAX];
    size_t merged;   /* how many were left out, since they repeat others */
    char words[256]; /* where they are from */
} cli_normals;

/* The shape alone of OBJ files: all light is absorbed. An exit status, said if not CLI_DONE. */
int cli_shape_load(const char *const *paths, size_t count, double metres_per_unit, srp_scene **out);

/* From a plates file (FILE.plates), or from any other with three numbers in each line; `#` begins a
 * comment. */
int cli_normals_read(const char *path, cli_normals *out);
/* The dominant ones of a mesh; `wanted` 0 = as many as it needs. */
int cli_normals_of_mesh(const srp_scene *scene, size_t wanted, cli_normals *out);

#endif
