/* SPDX-License-Identifier: Apache-2.0 */
#ifndef SRP_VIEWER_SCREENSHOT_H
#define SRP_VIEWER_SCREENSHOT_H

#include "viewer.h"

/* Draws a widget that is shown into a PNG file. */
bool viewer_picture_save(GtkWidget *widget, const char *path, viewer_words *problem);
/* Draws the window into a PNG file; complains when that fails. */
void viewer_screenshot(viewer *v, const char *path);

#endif
