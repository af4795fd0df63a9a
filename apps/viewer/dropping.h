/* SPDX-License-Identifier: Apache-2.0 */
/* Files that are dropped on the window: what each is, its ending tells. */
#ifndef SRP_VIEWER_DROPPING_H
#define SRP_VIEWER_DROPPING_H

#include "viewer.h"

/* Takes each of `paths` (count) as what its ending says, and says which it cannot take. */
void viewer_drop(viewer *v, const char *const *paths, size_t count);

/* The window takes what is dropped on it. */
void viewer_drop_begin(viewer *v);

#endif
