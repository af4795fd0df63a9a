/* SPDX-License-Identifier: Apache-2.0 */
#ifndef SRP_VIEWER_COMPARISON_VIEW_H
#define SRP_VIEWER_COMPARISON_VIEW_H

#include "viewer.h"

/* The figure of the comparison's tab. */
bool viewer_comparison_save(viewer *v, const char *path, viewer_words *problem);

#endif
