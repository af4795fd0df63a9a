/* SPDX-License-Identifier: Apache-2.0 */
/* In place of picture.c where OpenGL or Pango with cairo is missing. */
#include "messages.h"
#include "picture.h"

int cli_portrait_check(void) {
    cli_say("this program was built without OpenGL or without Pango and draws no pictures");
    return CLI_MACHINE_FAILED;
}

int cli_portrait_write(const cli_portrait *portrait, const char *path) {
    (void)portrait;
    (void)path;
    return cli_portrait_check();
}
