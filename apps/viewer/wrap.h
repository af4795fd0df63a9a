/* SPDX-License-Identifier: Apache-2.0 */
/* A line of widgets that goes on below where the window is too narrow for it. */
#ifndef SRP_VIEWER_WRAP_H
#define SRP_VIEWER_WRAP_H

#include <gtk/gtk.h>
#include <stdbool.h>

/* A line takes as many children as fit by their least widths; the room that is left is shared, up
 * to their natural widths first, and then among those that expand. Lines are `spacing` apart, as
 * children are at least. `titled`: further lines begin below the second child. */
GtkLayoutManager *viewer_wrap_new(int spacing, bool titled);

#endif
