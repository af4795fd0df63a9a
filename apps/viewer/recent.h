/* SPDX-License-Identifier: Apache-2.0 */
/* The spacecraft that were open before, the last one first. */
#ifndef SRP_VIEWER_RECENT_H
#define SRP_VIEWER_RECENT_H

#include "viewer.h"

/* Puts a file at the head. */
void viewer_recent_note(viewer *v, const char *path);
/* The files as a menu of "win.open"; it follows them. */
GMenuModel *viewer_recent_menu(viewer *v);

/* Takes the list of a key file, and puts the files of this window before what stands in one now:
 * another window may have written it since. */
void viewer_recent_load(viewer *v, GKeyFile *file);
void viewer_recent_save(viewer *v, GKeyFile *file);

#endif
