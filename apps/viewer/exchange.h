/* SPDX-License-Identifier: Apache-2.0 */
/* Files that come in, and the dialogs that ask for files. */
#ifndef SRP_VIEWER_EXCHANGE_H
#define SRP_VIEWER_EXCHANGE_H

#include "viewer.h"

/* Takes the optics of the spacecraft's materials from an MTL file, as if they were typed. */
void viewer_exchange_open_mtl(viewer *v, const char *path);
/* Asks for the MTL file that a newly opened spacecraft names and lacks; once, and no script. */
void viewer_exchange_miss_mtl(viewer *v);

void viewer_exchange_ask_open(viewer *v);
void viewer_exchange_ask_mtl(viewer *v);
void viewer_exchange_ask_plates(viewer *v);
void viewer_exchange_ask_table(viewer *v);
void viewer_exchange_ask_save(viewer *v);
/* Mission 0, or 1, which it is compared with. */
void viewer_exchange_ask_mission(viewer *v, int which);

/* `srp force ...` for the attitude shown; freed by free(). */
char *viewer_exchange_force_command(const viewer *v);

#endif
