/* SPDX-License-Identifier: Apache-2.0 */
/* A picture of a spacecraft in sunlight: as the Sun sees it, and from a side. Drawn by OpenGL and
 * cairo; a build that lacks one of them refuses every picture. */
#ifndef SRP_CLI_PICTURE_H
#define SRP_CLI_PICTURE_H

#include "command.h"

#include <srp/response.h>
#include <srp/scene.h>

/* What colours the facets. */
typedef enum cli_light { CLI_LIGHT_MATERIAL, CLI_LIGHT_INCIDENCE, CLI_LIGHT_FORCE } cli_light;

typedef struct cli_portrait {
    const char *title;
    const srp_scene *scene;
    double sun[2], side[2]; /* azimuth and elevation of the Sun, and of the eye at the side [deg] */
    srp_response response;  /* to the Sun */
    double pressure;        /* [N/m^2] */
    cli_light light;
    uint32_t width, height; /* [px] */
    const char *device;     /* NULL: the first that works */
} cli_portrait;

/* Its numbers, in two lines: the area vector of direct light; force and lit area. */
enum { CLI_PORTRAIT_WORDS = 160 };
void cli_portrait_words(const cli_portrait *portrait, char text[2][CLI_PORTRAIT_WORDS]);

/* Can this build draw pictures? An exit status, said if not CLI_DONE. */
int cli_portrait_check(void);
/* Draws it into a file .png, which appears whole or not at all. An exit status, said if not
 * CLI_DONE. */
int cli_portrait_write(const cli_portrait *portrait, const char *path);

#endif
