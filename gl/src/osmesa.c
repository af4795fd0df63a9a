/* SPDX-License-Identifier: Apache-2.0 */
/* Contexts of OSMesa: Mesa's software renderer, drawing into memory. Needs no GPU. */
#include "error.h"
#include "platform.h"
#include "provider.h"

#include <stdlib.h>
#include <string.h>

/* Of GL/osmesa.h, which is in a package that nothing else here needs. */
enum {
    OSMESA_FORMAT = 0x22,
    OSMESA_DEPTH_BITS = 0x30,
    OSMESA_STENCIL_BITS = 0x31,
    OSMESA_PROFILE = 0x33,
    OSMESA_CORE_PROFILE = 0x34,
    OSMESA_CONTEXT_MAJOR_VERSION = 0x36,
    OSMESA_CONTEXT_MINOR_VERSION = 0x37,
    GL_RGBA = 0x1908,
    GL_UNSIGNED_BYTE = 0x1401
};

/* OSMesa wants a colour buffer, though all that is drawn goes elsewhere. */
enum { BUFFER_SIDE = 16 };

/* Version of the shading language that our shaders are written in, times 100. */
enum { GLSL_MIN = 330 };

typedef void *(*create_function)(const int *attributes, void *shared);
typedef unsigned char (*enter_function)(void *context, void *buffer, unsigned type, int width,
                                        int height);
typedef void (*destroy_function)(void *context);
typedef srp_gl_function (*find_function)(const char *name);

struct srp_gl_binding {
    srp_platform_library *library;
    create_function create;
    enter_function enter;
    destroy_function destroy;
    find_function find;
    void *context;
    unsigned char buffer[BUFFER_SIDE * BUFFER_SIDE * 4];
};

static void destroy(srp_gl_binding *binding) {
    if (binding->context != NULL) {
        binding->destroy(binding->context);
    }
    srp_platform_library_close(binding->library);
    free(binding);
}

/* Mesa takes the name of its driver from the environment, and dereferences NULL when there is none
 * of that name; likewise when its shading language is said to be too old for a core context. */
static srp_status check_driver(srp_error *error) {
    const char *driver = getenv("GALLIUM_DRIVER");
    if (driver != NULL && strcmp(driver, "") != 0 && strcmp(driver, "llvmpipe") != 0 &&
        strcmp(driver, "softpipe") != 0) {
        return srp_fail(
            error, SRP_NO_DEVICE,
            "GALLIUM_DRIVER is '%.60s', but OSMesa draws with llvmpipe or softpipe only; "
            "unset it",
            driver);
    }
    const char *language = getenv("MESA_GLSL_VERSION_OVERRIDE");
    if (language != NULL && strtol(language, NULL, 10) < GLSL_MIN) {
        return srp_fail(error, SRP_NO_DEVICE,
                        "MESA_GLSL_VERSION_OVERRIDE is '%.60s', expected %d or more; unset it",
                        language, GLSL_MIN);
    }
    return SRP_OK;
}

static srp_status open_library(srp_gl_binding *binding, srp_error *error) {
    static const char *const NAMES[] = {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so", NULL};
    char reason[256];
    binding->library = srp_platform_library_open(NAMES, reason, sizeof reason);
    if (binding->library == NULL) {
        return srp_fail(error, SRP_NO_DEVICE,
                        "no OSMesa on this machine (Debian package libosmesa6): %s", reason);
    }
    srp_platform_library *from = binding->library;
    binding->create =
        (create_function)srp_platform_library_function(from, "OSMesaCreateContextAttribs");
    binding->enter = (enter_function)srp_platform_library_function(from, "OSMesaMakeCurrent");
    binding->destroy =
        (destroy_function)srp_platform_library_function(from, "OSMesaDestroyContext");
    binding->find = (find_function)srp_platform_library_function(from, "OSMesaGetProcAddress");
    if (binding->create == NULL || binding->enter == NULL || binding->destroy == NULL ||
        binding->find == NULL) {
        return srp_fail(error, SRP_NO_DEVICE, "the OSMesa of this machine is older than 11.2");
    }
    return SRP_OK;
}

static srp_status create(int index, int major, int minor, srp_gl_binding **out, srp_error *error) {
    if (index > 0) {
        return srp_fail(error, SRP_NO_DEVICE, "OSMesa has one device, number 0");
    }
    srp_status status = check_driver(error);
    if (status != SRP_OK) {
        return status;
    }
    srp_gl_binding *binding = calloc(1, sizeof *binding);
    if (binding == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for OSMesa");
    }
    status = open_library(binding, error);
    if (status == SRP_OK) {
        const int attributes[] = {OSMESA_FORMAT,
                                  GL_RGBA,
                                  OSMESA_DEPTH_BITS,
                                  0,
                                  OSMESA_STENCIL_BITS,
                                  0,
                                  OSMESA_PROFILE,
                                  OSMESA_CORE_PROFILE,
                                  OSMESA_CONTEXT_MAJOR_VERSION,
                                  major,
                                  OSMESA_CONTEXT_MINOR_VERSION,
                                  minor,
                                  0,
                                  0};
        binding->context = binding->create(attributes, NULL);
        if (binding->context == NULL) {
            status = srp_fail(error, SRP_NO_DEVICE, "OSMesa offers no core context of OpenGL %d.%d",
                              major, minor);
        }
    }
    if (status != SRP_OK) {
        destroy(binding);
        return status;
    }
    *out = binding;
    return SRP_OK;
}

static bool enter(srp_gl_binding *binding) {
    return binding->enter(binding->context, binding->buffer, GL_UNSIGNED_BYTE, BUFFER_SIDE,
                          BUFFER_SIDE) != 0;
}

static void leave(srp_gl_binding *binding) {
    (void)binding->enter(NULL, NULL, 0, 0, 0);
}

static srp_gl_function find(const srp_gl_binding *binding, const char *name) {
    return binding->find(name);
}

const srp_gl_provider srp_gl_osmesa = {"OSMesa", create, enter, leave, destroy, find};
