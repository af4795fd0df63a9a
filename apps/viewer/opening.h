/* SPDX-License-Identifier: Apache-2.0 */
/* Tables from disk, read beside the window, one after the other. */
#ifndef SRP_VIEWER_OPENING_H
#define SRP_VIEWER_OPENING_H

#include "viewer.h"

/* Reads a table, after those that were asked for before, and puts it into the list. */
void viewer_opening_add(viewer *v, const char *path);
/* Those that have not been read yet are not wanted any more. */
void viewer_opening_cancel(viewer *v);
bool viewer_opening_is_running(const viewer *v);

#endif
