/* SPDX-License-Identifier: Apache-2.0 */
/* What the inside of a list of materials looks like to its readers. Internal. */
#ifndef SRP_SRC_MATERIAL_INTERNAL_H
#define SRP_SRC_MATERIAL_INTERNAL_H

#include <srp/material.h>

typedef struct srp_material {
    char *name;
    srp_optics optics;
    bool known;  /* optics are set */
    bool pinned; /* set by the user: nothing read from a file changes it */
} srp_material;

struct srp_materials {
    size_t count, capacity;
    srp_material *items;
};

/* Material `name`, added without optics if it is new; NULL when there is no memory. */
srp_material *srp_materials_touch(srp_materials *materials, const char *name);

/* Material `name`, NULL when it is not in the list. */
srp_material *srp_materials_get(const srp_materials *materials, const char *name);

/* A copy of the list, NULL when there is no memory. */
srp_materials *srp_materials_clone(const srp_materials *materials);

#endif
