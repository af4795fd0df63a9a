/* SPDX-License-Identifier: Apache-2.0 */
/* What is remembered from one run to the next: $XDG_CONFIG_HOME/srpcore/viewer.ini, a key file; in
 * ~/.config where that is not an absolute path. */
#ifndef SRP_VIEWER_STATE_H
#define SRP_VIEWER_STATE_H

#include "viewer.h"

/* Takes what the last run left; a file that is not there or damaged is as good as none. */
void viewer_state_load(viewer *v);
/* Writes it; what hinders that is said on stderr, since the window closes. */
void viewer_state_save(viewer *v);

#endif
