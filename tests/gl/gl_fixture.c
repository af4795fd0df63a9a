/* SPDX-License-Identifier: Apache-2.0 */
#include "gl_fixture.h"

#include <srp/gl.h>
#include <srp/table.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *gl_device_name = "gl:osmesa";

bool gl_device_is_there(const char *device) {
    srp_gl_description description;
    srp_error error;
    srp_status status = srp_gl_device_describe(device, &description, &error);
    if (status == SRP_OK) {
        printf("%s: %s, OpenGL %s\n", device, description.renderer, description.version);
        return true;
    }
    printf("skipped: %s: %s\n", device, error.message);
    if (status != SRP_NO_DEVICE) {
        exit(EXIT_FAILURE);
    }
    return false;
}

const srp_method *gl_method_on(const char *device, const char *name) {
    size_t count;
    const srp_method *const *methods = srp_gl_method_list(&count);
    for (size_t k = 0; k < count; ++k) {
        if (strcmp(methods[k]->device, device) == 0 && strcmp(methods[k]->name, name) == 0) {
            return methods[k];
        }
    }
    return NULL;
}

const srp_method *gl_method(const char *name) {
    return gl_method_on(gl_device_name, name);
}

void gl_paper_directions(srp_vec3 s[PAPER_DIRECTIONS]) {
    int count = 0;
    for (int j = 0; j < 9; ++j) {
        for (int i = 0; i < 18; ++i) {
            s[count++] = srp_direction_from_deg(20.0 * i - 180.0, 20.0 * j - 90.0);
        }
    }
}

int gl_run(int argc, char **argv, Suite *(*make)(bool is_long)) {
    gl_device_name = argc > 1 ? argv[1] : gl_device_name;
    if (!gl_device_is_there(gl_device_name)) {
        return EXIT_SUCCESS;
    }
    SRunner *runner = srunner_create(make(argc > 2 && strcmp(argv[2], "long") == 0));
    srunner_set_fork_status(runner, CK_NOFORK);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
