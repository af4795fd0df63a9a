/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Scripts: what a user could do, written down, one step a line. For tests, and for the pictures of
 * the documentation.
 *
 *     ACTION [PARAMETER]       an action (actions.h), with the rest of the line as its parameter
 *     wait                     until nothing is computed and the window shows it
 *     pause SECONDS
 *     resize WIDTH HEIGHT      of the window
 *     print WIDGET             the widget's text, "WIDGET: text", on standard output
 *     expect WIDGET TEXT       ends the program with status 1 unless the widget's text has TEXT
 *     place WIDGET             where it is in the window's picture, "place of WIDGET: X Y W H"
 *     enter WIDGET TEXT        writes into an entry or a number and leaves it
 *     type WIDGET TEXT         writes into it and stays there
 *     focus WIDGET             leads the keyboard there, as Tab does
 *     press WIDGET KEY         gives it the focus and a key, "Left"
 *     point WIDGET X,Y         moves the pointer to this pixel of it
 *     screenshot FILE          as the action, when what there is by then is drawn
 *     note TEXT                on standard output
 *     # ...                    nothing
 *
 * It begins when the model is shown. Nothing fades or blinks meanwhile: pictures are the same each
 * time. A complaint of the window that no `expect message` has seen when the next one comes, or at
 * the end, makes the status 1, too, but does not end the script. At its end the window is closed.
 */
#ifndef SRP_VIEWER_SCRIPT_H
#define SRP_VIEWER_SCRIPT_H

#include "viewer.h"

/* Takes `text` over and begins to run it; `name` stands for it in messages, NULL for a script that
 * options stand for. */
void viewer_script_run(viewer *v, const char *name, char *text);

#endif
