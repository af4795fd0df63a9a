/* SPDX-License-Identifier: Apache-2.0 */
/* The style sheet, compiled in. */
#ifndef SRP_VIEWER_STYLE_H
#define SRP_VIEWER_STYLE_H

typedef struct viewer_text {
    const char *name, *text;
} viewer_text;

extern const viewer_text viewer_style_css;
#define viewer_style viewer_style_css

#endif
