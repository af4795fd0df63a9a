/* SPDX-License-Identifier: Apache-2.0 */
/* srp-models DIRECTORY: writes every file of models/. The same bytes on every machine. */
#include "models.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv) {
    static void (*const MAKERS[])(const char *directory) = {
        make_cube,     make_icospheres, make_l_corner,   make_dihedral,
        make_box_wing, make_dish,       make_sun_shield, make_gnss,
    };
    if (argc != 2) {
        fprintf(stderr, "usage: srp-models DIRECTORY\n");
        return EXIT_FAILURE;
    }
    for (size_t i = 0; i < sizeof MAKERS / sizeof MAKERS[0]; ++i) {
        MAKERS[i](argv[1]);
    }
    return EXIT_SUCCESS;
}
