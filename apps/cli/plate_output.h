/* SPDX-License-Identifier: Apache-2.0 */
/* Plates as files: our own, and a script of GMAT. */
#ifndef SRP_CLI_PLATE_OUTPUT_H
#define SRP_CLI_PLATE_OUTPUT_H

#include <srp/plates.h>
#include <srp/sunlight.h>

#include <stddef.h>
#include <stdio.h>

/* `about`: one line on what they are. Plates without area are left out. */
void cli_plates_write(FILE *out, const srp_plate *plates, size_t count, const char *about);
/* A script that GMAT R2022a and later run: a spacecraft of `mass` [kg] (NAN: GMAT's own) with these
 * plates, propagated for a minute. */
void cli_plates_write_gmat(FILE *out, const srp_plate *plates, size_t count, const char *about,
                           double mass, srp_sunlight light);

#endif
