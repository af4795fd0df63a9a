/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"
#include "material_internal.h"
#include "mesh_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_share(double value) {
    return isfinite(value) && value >= 0.0 && value <= 1.0;
}

srp_status srp_optics_check(srp_optics optics, srp_error *error) {
    if (!is_share(optics.rho_s)) {
        return srp_fail(error, SRP_BAD_DATA, "rho_s is %g, expected 0 to 1", optics.rho_s);
    }
    if (!is_share(optics.rho_d)) {
        return srp_fail(error, SRP_BAD_DATA, "rho_d is %g, expected 0 to 1", optics.rho_d);
    }
    /* 0.7 + 0.3 is 1 for the user, whatever the last bit says. */
    if (optics.rho_s + optics.rho_d > 1.0 + 1e-12) {
        return srp_fail(error, SRP_BAD_DATA,
                        "rho_s + rho_d is %g, expected at most 1 (the rest is absorbed)",
                        optics.rho_s + optics.rho_d);
    }
    return SRP_OK;
}

srp_status srp_materials_create(srp_materials **out, srp_error *error) {
    srp_materials *materials = calloc(1, sizeof *materials);
    if (materials == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for materials");
    }
    *out = materials;
    return SRP_OK;
}

void srp_materials_destroy(srp_materials *materials) {
    if (materials == NULL) {
        return;
    }
    for (size_t i = 0; i < materials->count; ++i) {
        free(materials->items[i].name);
    }
    free(materials->items);
    free(materials);
}

srp_material *srp_materials_get(const srp_materials *materials, const char *name) {
    for (size_t i = 0; i < materials->count; ++i) {
        if (strcmp(materials->items[i].name, name) == 0) {
            return &materials->items[i];
        }
    }
    return NULL;
}

srp_material *srp_materials_touch(srp_materials *materials, const char *name) {
    srp_material *known = srp_materials_get(materials, name);
    if (known != NULL) {
        return known;
    }
    if (materials->count == materials->capacity) {
        size_t capacity = materials->capacity > 0 ? 2 * materials->capacity : 8;
        srp_material *larger = realloc(materials->items, capacity * sizeof *larger);
        if (larger == NULL) {
            return NULL;
        }
        materials->items = larger;
        materials->capacity = capacity;
    }
    srp_material *added = &materials->items[materials->count];
    memset(added, 0, sizeof *added);
    added->name = srp_string_copy(name);
    if (added->name == NULL) {
        return NULL;
    }
    ++materials->count;
    return added;
}

srp_materials *srp_materials_clone(const srp_materials *materials) {
    srp_materials *clone = calloc(1, sizeof *clone);
    for (size_t i = 0; clone != NULL && i < materials->count; ++i) {
        const srp_material *item = &materials->items[i];
        srp_material *copy = srp_materials_touch(clone, item->name);
        if (copy == NULL) {
            srp_materials_destroy(clone);
            return NULL;
        }
        copy->optics = item->optics;
        copy->known = item->known;
        copy->pinned = item->pinned;
    }
    return clone;
}

srp_status srp_materials_set(srp_materials *materials, const char *name, srp_optics optics,
                             bool pinned, srp_error *error) {
    srp_status status = srp_optics_check(optics, error);
    if (status != SRP_OK) {
        return status;
    }
    srp_material *material = srp_materials_touch(materials, name);
    if (material == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for material '%s'", name);
    }
    if (pinned || !material->pinned) {
        material->optics = optics;
        material->known = true;
        material->pinned = pinned;
    }
    return SRP_OK;
}

size_t srp_materials_count(const srp_materials *materials) {
    return materials->count;
}

const char *srp_materials_name(const srp_materials *materials, size_t index) {
    return index < materials->count ? materials->items[index].name : NULL;
}

bool srp_materials_find(const srp_materials *materials, const char *name, srp_optics *out) {
    const srp_material *material = srp_materials_get(materials, name);
    if (material == NULL || !material->known) {
        return false;
    }
    *out = material->optics;
    return true;
}
