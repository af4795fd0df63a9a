/* SPDX-License-Identifier: Apache-2.0 */
/* Pictures that turn: by dragging, and by the arrow keys where they have the focus. */
#ifndef SRP_VIEWER_TURNING_H
#define SRP_VIEWER_TURNING_H

#include <gtk/gtk.h>

/* Where the eye is, in degrees, and where it goes; the widget's own. */
typedef struct viewer_turning {
    void (*look)(GtkWidget *widget, gpointer user, double *az_deg, double *el_deg);
    void (*turn)(GtkWidget *widget, gpointer user, double az_deg, double el_deg);
    double sense; /* 1: the azimuth grows as the front goes to the right, -1: it shrinks */
} viewer_turning;

/* `turning` is a constant. The front follows the pointer and the keys to the left and right; Up
 * lifts the eye. */
void viewer_turning_add(GtkWidget *widget, const viewer_turning *turning, gpointer user);

#endif
