/* SPDX-License-Identifier: Apache-2.0 */
#ifndef SRP_VIEWER_COMPARISON_VIEW_H
#define SRP_VIEWER_COMPARISON_VIEW_H

#include "viewer.h"

/* The figure of the comparison's tab, and what `srp compare` prints of the two tables. */
bool viewer_comparison_save_figure(viewer *v, const char *path, viewer_words *problem);
bool viewer_comparison_save_text(viewer *v, const char *path, viewer_words *problem);

#endif
