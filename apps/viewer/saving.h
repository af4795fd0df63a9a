/* SPDX-License-Identifier: Apache-2.0 */
/* What each tab can save: the ending chooses. */
#ifndef SRP_VIEWER_SAVING_H
#define SRP_VIEWER_SAVING_H

#include "viewer.h"

typedef struct viewer_saving {
    const char *title;       /* of the dialog */
    const char *name;        /* of the file, proposed there */
    const char *what;        /* "the table (.nc, .spo, .txt) or its figure (.png, .svg, .pdf)" */
    const char *patterns[8]; /* "*.nc", as dialogs take them; NULL ends them */
    bool (*save)(viewer *v, const char *path, viewer_words *problem);
} viewer_saving;

/* Of the tab that is shown. */
const viewer_saving *viewer_saving_now(const viewer *v);
/* Does it save files that end so? */
bool viewer_saving_takes(const viewer_saving *saving, const char *path);
/* Saves what the tab shows, or says what it can save. */
void viewer_save(viewer *v, const char *path);

#endif
