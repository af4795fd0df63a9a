/* SPDX-License-Identifier: Apache-2.0 */
#ifndef SRP_VIEWER_SCENE_AREA_H
#define SRP_VIEWER_SCENE_AREA_H

#include "viewer.h"

/* The spacecraft in sunlight, with axes, arrows and legend. Dragging turns the camera, scrolling
 * zooms; neither changes what is computed. */
GtkWidget *viewer_scene_area(viewer *v);

#endif
