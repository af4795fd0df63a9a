/* SPDX-License-Identifier: Apache-2.0 */
/* N-plate models: one-sided flat plates that know nothing of each other (AAS 20-481, Eq. 5). */
#ifndef SRP_PLATES_H
#define SRP_PLATES_H

#include <srp/material.h>
#include <srp/status.h>
#include <srp/vec3.h>

#include <stddef.h>

SRP_BEGIN_DECLS

typedef struct srp_plate {
    srp_vec3 normal; /* [-] outward, unit (readers normalise it), body frame */
    double area;     /* [m^2] > 0 */
    srp_optics optics;
} srp_plate;

/* Reads a plates file: N on the first line, then N lines `nx ny nz area rho_s rho_d`; `#` starts a
 * comment. *out is allocated and freed by srp_plates_free().
 * SRP_NOT_FOUND, SRP_IO, SRP_BAD_FORMAT, SRP_BAD_DATA (zero normal, area, shares), SRP_NO_MEMORY.
 */
SRP_API SRP_CHECK srp_status srp_plates_read(const char *path, srp_plate **out, size_t *count,
                                             srp_error *error);
SRP_API SRP_CHECK srp_status srp_plates_parse(const char *text, size_t size, const char *name,
                                              srp_plate **out, size_t *count, srp_error *error);
SRP_API void srp_plates_free(srp_plate *plates);

SRP_END_DECLS

#endif
