/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Optics of surfaces, and a list of named materials.
 *
 * Shares of the sunlight: specular rho_s, diffuse (Lambertian) rho_d, absorbed 1 - rho_s - rho_d;
 * each in [0, 1].
 */
#ifndef SRP_MATERIAL_H
#define SRP_MATERIAL_H

#include <srp/status.h>

#include <stdbool.h>
#include <stddef.h>

SRP_BEGIN_DECLS

typedef struct srp_optics {
    double rho_s;   /* [-] in [0, 1] */
    double rho_d;   /* [-] in [0, 1], rho_s + rho_d <= 1 */
    bool one_sided; /* true: the back absorbs all light; false (default): both sides alike */
} srp_optics;

/* A list of materials with unique names, in order of their first mention. */
typedef struct srp_materials srp_materials;

/* SRP_BAD_DATA unless both shares are finite and within their ranges. */
SRP_API SRP_CHECK srp_status srp_optics_check(srp_optics optics, srp_error *error);

/* An empty list. SRP_NO_MEMORY. */
SRP_API SRP_CHECK srp_status srp_materials_create(srp_materials **out, srp_error *error);
SRP_API void srp_materials_destroy(srp_materials *materials);

/* Sets the optics of `name`, adding it if it is new. A material set with `pinned` is not changed by
 * anything read or set unpinned later: what the user says on the command line wins over the MTL.
 * SRP_BAD_DATA (shares), SRP_NO_MEMORY. */
SRP_API SRP_CHECK srp_status srp_materials_set(srp_materials *materials, const char *name,
                                               srp_optics optics, bool pinned, srp_error *error);

/* Reads a Wavefront MTL file and sets, unpinned, every material in it. Keywords: `newmtl NAME`,
 * `rho_s VALUE`, `rho_d VALUE`, `one_sided 0|1`; where neither rho is given, Ks and Kd when their
 * three channels are equal (with a warning). A material without optics is listed as unknown.
 * SRP_NOT_FOUND, SRP_IO, SRP_BAD_FORMAT, SRP_BAD_DATA (shares out of range, unequal channels),
 * SRP_NO_MEMORY. On failure `materials` is as before. */
SRP_API SRP_CHECK srp_status srp_materials_read_mtl(srp_materials *materials, const char *path,
                                                    const srp_log *log, srp_error *error);

/* The same from memory (`name` stands for the file in messages). Never SRP_NOT_FOUND or SRP_IO. */
SRP_API SRP_CHECK srp_status srp_materials_parse_mtl(srp_materials *materials, const char *text,
                                                     size_t size, const char *name,
                                                     const srp_log *log, srp_error *error);

SRP_API size_t srp_materials_count(const srp_materials *materials);
/* Name of material `index`; owned by the list. NULL when index is out of range. */
SRP_API const char *srp_materials_name(const srp_materials *materials, size_t index);
/* Looks up the optics of `name`: true and *out when known; false, *out unchanged, otherwise. */
SRP_API bool srp_materials_find(const srp_materials *materials, const char *name, srp_optics *out);

SRP_END_DECLS

#endif
