/* SPDX-License-Identifier: Apache-2.0 */
/* Text files of models: deterministic, every number in the fewest digits that read back the same.
 */
#ifndef MODELS_WRITE_H
#define MODELS_WRITE_H

#include "model.h"

/* DIRECTORY/NAME.obj and DIRECTORY/NAME.mtl. */
void write_model(const model *m, const char *directory);

/* A row of a plates file. */
typedef struct plate_row {
    const char *what; /* comment on the line */
    srp_vec3 normal;
    double area, rho_s, rho_d;
} plate_row;

/* DIRECTORY/NAME.plates. */
void write_plates(const char *name, const char *comment, const plate_row *rows, size_t count,
                  const char *directory);

#endif
