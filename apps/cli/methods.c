/* SPDX-License-Identifier: Apache-2.0 */
#include "methods.h"

#include <string.h>

#ifdef SRP_CLI_HAS_GL
#include <srp/gl.h>

const char cli_device_words[] = "cpu gl gl:osmesa gl:egl";
const char cli_device_help[] =
    "Where to compute: cpu (default), gl:osmesa (OpenGL without a GPU; gl is short for it), gl:egl "
    "(OpenGL on the first GPU, or without one where there is none), gl:egl:N (device N of EGL).";

static const srp_method *gl_method_at(size_t k) {
    size_t count;
    const srp_method *const *methods = srp_gl_method_list(&count);
    return k < count ? methods[k] : NULL;
}

bool cli_device_is_left_out(const char *text) {
    (void)text;
    return false;
}
#else
const char cli_device_words[] = "cpu";
const char cli_device_help[] = "Where to compute: cpu. (This srp is built without OpenGL.)";

static const srp_method *gl_method_at(size_t k) {
    (void)k;
    return NULL;
}

bool cli_device_is_left_out(const char *text) {
    return strcmp(text, "gl") == 0 || strncmp(text, "gl:", 3) == 0;
}
#endif

const srp_method *cli_method_at(size_t k) {
    size_t count;
    const srp_method *const *methods = srp_method_list(&count);
    return k < count ? methods[k] : gl_method_at(k - count);
}

/* Every name is there for the processor. */
const srp_method *cli_method_named_at(size_t k) {
    size_t count;
    const srp_method *const *methods = srp_method_list(&count);
    return k < count ? methods[k] : NULL;
}

const char *cli_device_of(const char *text) {
    return strcmp(text, "gl") == 0 ? "gl:osmesa" : text;
}

const srp_method *cli_method_find(const char *name, const char *device) {
    const srp_method *method;
    device = cli_device_of(device);
    for (size_t i = 0; (method = cli_method_at(i)) != NULL; ++i) {
        if (strcmp(method->name, name) == 0 && strcmp(method->device, device) == 0) {
            return method;
        }
    }
    return NULL;
}
