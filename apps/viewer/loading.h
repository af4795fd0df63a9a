/* SPDX-License-Identifier: Apache-2.0 */
/* A spacecraft from disk, read beside the window: the one that is there stays until it is. */
#ifndef SRP_VIEWER_LOADING_H
#define SRP_VIEWER_LOADING_H

#include "viewer.h"

/* Reads an OBJ file and takes it for the spacecraft, with what was said of the materials of another
 * file forgotten; one that cannot be read is told of, and changes nothing. The newest one wins. The
 * file that is open already is read anew. */
void viewer_loading_open(viewer *v, const char *path);
/* The one that is read is not wanted any more. */
void viewer_loading_cancel(viewer *v);
bool viewer_loading_is_running(const viewer *v);

#endif
