/* SPDX-License-Identifier: Apache-2.0 */
/* Four surfaces over azimuth and elevation, x, y, z and length, drawn by PLplot into the window:
 * they turn by mouse and keys, together or apart, and tell the value under the pointer. */
#ifndef SRP_VIEWER_CHART_H
#define SRP_VIEWER_CHART_H

#include "viewer.h"

#include <srp/table.h>

enum { CHARTS = VIEWER_CHARTS };

typedef struct viewer_charts viewer_charts;

/* `name` is that of the widgets: NAME-0 to NAME-3, and NAME-pointer for the value under the
 * pointer, in a line with `beside` (NULL: nothing). */
viewer_charts *viewer_charts_create(viewer *v, const char *name, GtkWidget *beside);
/* The widget, which owns the charts. */
GtkWidget *viewer_charts_widget(viewer_charts *charts);

/* Shows `value` (CHARTS, nodes), which is taken over and freed by free(); NULL: nothing. `names`
 * with units, as PLplot writes them ("f#dx#u [m²]"); constant strings. */
void viewer_charts_show(viewer_charts *charts, const char *title, srp_grid grid, double *value,
                        const char *const *names);
/* The same figure as a file, as `srp plot` and `srp compare` draw it. */
bool viewer_charts_save(viewer_charts *charts, const char *path, viewer_words *problem);

/* The figure of the graphics tab. */
bool viewer_chart_save(viewer *v, const char *path, viewer_words *problem);

#endif
