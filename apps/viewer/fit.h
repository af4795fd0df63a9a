/* SPDX-License-Identifier: Apache-2.0 */
/* Plates that are fitted to a table: the N-plate model that comes nearest, as a table to compare
 * with. */
#ifndef SRP_VIEWER_FIT_H
#define SRP_VIEWER_FIT_H

#include "viewer.h"

/* Fits `plates` plates (1 to CLI_NORMALS_MAX), normals searched, to table A of the comparison; what
 * they give on its grid becomes table B. */
void viewer_fit_request(viewer *v, unsigned plates);
void viewer_fit_cancel(viewer *v);
bool viewer_fit_is_running(const viewer *v);
bool viewer_fit_is_cancelling(const viewer *v);
/* Since it began, or was asked for. */
double viewer_fit_seconds(viewer *v);
/* Saves the plates of the last fit, for the method nplate. */
bool viewer_fit_save(viewer *v, const char *path, viewer_words *problem);

#endif
