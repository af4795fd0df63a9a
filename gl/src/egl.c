/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Contexts of EGL without a surface: on the device of a GPU, or on Mesa's surfaceless platform.
 *
 * Displays belong to the process and are shared by all threads, so that none is ever terminated:
 * the contexts of others would go with it. eglInitialize() on one that is initialized does nothing.
 */
#include "error.h"
#include "platform.h"
#include "provider.h"

#define EGL_NO_X11 /* no window is opened */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stdlib.h>
#include <string.h>

/* X(type, name): of the library itself. */
#define EGL_FUNCTIONS(X)                                                                           \
    X(PFNEGLGETPROCADDRESSPROC, GetProcAddress)                                                    \
    X(PFNEGLQUERYSTRINGPROC, QueryString)                                                          \
    X(PFNEGLGETERRORPROC, GetError)                                                                \
    X(PFNEGLINITIALIZEPROC, Initialize)                                                            \
    X(PFNEGLBINDAPIPROC, BindAPI)                                                                  \
    X(PFNEGLCREATECONTEXTPROC, CreateContext)                                                      \
    X(PFNEGLDESTROYCONTEXTPROC, DestroyContext)                                                    \
    X(PFNEGLMAKECURRENTPROC, MakeCurrent)

enum { DEVICES_MAX = 64 };

struct srp_gl_binding {
    srp_platform_library *library;
#define FIELD(type, name) type name;
    EGL_FUNCTIONS(FIELD)
#undef FIELD
    EGLDisplay display;
    EGLContext context;
};

static void destroy(srp_gl_binding *binding) {
    if (binding->context != EGL_NO_CONTEXT) {
        (void)binding->DestroyContext(binding->display, binding->context);
    }
    srp_platform_library_close(binding->library);
    free(binding);
}

static srp_status open_library(srp_gl_binding *binding, srp_error *error) {
    static const char *const NAMES[] = {"libEGL.so.1", "libEGL.so", NULL};
    char reason[256];
    binding->library = srp_platform_library_open(NAMES, reason, sizeof reason);
    if (binding->library == NULL) {
        return srp_fail(
            error, SRP_NO_DEVICE,
            "no EGL on this machine (Debian package libegl1, or the driver of the GPU): "
            "%s",
            reason);
    }
    bool complete = true;
#define LOAD(type, name)                                                                           \
    binding->name = (type)srp_platform_library_function(binding->library, "egl" #name);            \
    complete = complete && binding->name != NULL;
    EGL_FUNCTIONS(LOAD)
#undef LOAD
    return complete ? SRP_OK
                    : srp_fail(error, SRP_NO_DEVICE, "the EGL of this machine lacks functions");
}

/* Whole words of a list with blanks. */
static bool has_word(const char *list, const char *word) {
    size_t length = strlen(word);
    while (list != NULL && (list = strstr(list, word)) != NULL) {
        if (list[length] == ' ' || list[length] == '\0') {
            return true;
        }
        list += length;
    }
    return false;
}

static const char *client_extensions(const srp_gl_binding *binding) {
    const char *list = binding->QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    return list != NULL ? list : "";
}

/* An initialized display of a platform; EGL_NO_DISPLAY: none. */
static EGLDisplay display_of(const srp_gl_binding *binding, EGLenum platform, void *native) {
    PFNEGLGETPLATFORMDISPLAYEXTPROC get =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)binding->GetProcAddress("eglGetPlatformDisplayEXT");
    EGLDisplay display = get != NULL ? get(platform, native, NULL) : EGL_NO_DISPLAY;
    if (display != EGL_NO_DISPLAY && !binding->Initialize(display, NULL, NULL)) {
        display = EGL_NO_DISPLAY;
    }
    return display;
}

static EGLint list_devices(const srp_gl_binding *binding, EGLDeviceEXT devices[DEVICES_MAX]) {
    PFNEGLQUERYDEVICESEXTPROC query =
        (PFNEGLQUERYDEVICESEXTPROC)binding->GetProcAddress("eglQueryDevicesEXT");
    EGLint count = 0;
    bool offered = has_word(client_extensions(binding), "EGL_EXT_platform_device");
    if (!offered || query == NULL || !query(DEVICES_MAX, devices, &count)) {
        return 0;
    }
    return count;
}

/* Devices that are software renderers say so. */
static bool is_software(const srp_gl_binding *binding, EGLDeviceEXT device) {
    PFNEGLQUERYDEVICESTRINGEXTPROC query =
        (PFNEGLQUERYDEVICESTRINGEXTPROC)binding->GetProcAddress("eglQueryDeviceStringEXT");
    return query != NULL && has_word(query(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
}

/* The first GPU that works. */
static EGLDisplay find_gpu(const srp_gl_binding *binding) {
    EGLDeviceEXT devices[DEVICES_MAX];
    EGLint count = list_devices(binding, devices);
    EGLDisplay display = EGL_NO_DISPLAY;
    for (EGLint k = 0; k < count && display == EGL_NO_DISPLAY; ++k) {
        if (!is_software(binding, devices[k])) {
            display = display_of(binding, EGL_PLATFORM_DEVICE_EXT, devices[k]);
        }
    }
    return display;
}

static srp_status open_display(srp_gl_binding *binding, int index, srp_error *error) {
    if (index == SRP_GL_ANY_DEVICE) {
        binding->display = find_gpu(binding);
        if (binding->display == EGL_NO_DISPLAY &&
            has_word(client_extensions(binding), "EGL_MESA_platform_surfaceless")) {
            binding->display =
                display_of(binding, EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY);
        }
        if (binding->display == EGL_NO_DISPLAY) {
            return srp_fail(error, SRP_NO_DEVICE,
                            "EGL finds no GPU and no surfaceless platform that works here: the "
                            "driver of the GPU is missing, and so are Mesa's (Debian package "
                            "libgl1-mesa-dri), or GALLIUM_DRIVER or LIBGL_DRIVERS_PATH name "
                            "something else");
        }
        return SRP_OK;
    }
    EGLDeviceEXT devices[DEVICES_MAX];
    EGLint count = list_devices(binding, devices);
    if (index >= count) {
        return srp_fail(error, SRP_NO_DEVICE,
                        "devices that EGL lists here: %d; there is no number %d", (int)count,
                        index);
    }
    binding->display = display_of(binding, EGL_PLATFORM_DEVICE_EXT, devices[index]);
    if (binding->display == EGL_NO_DISPLAY) {
        return srp_fail(error, SRP_NO_DEVICE,
                        "EGL cannot use its device %d: its driver is not there (for a software "
                        "renderer the Debian package libgl1-mesa-dri)",
                        index);
    }
    return SRP_OK;
}

static srp_status create_context(srp_gl_binding *binding, int major, int minor, srp_error *error) {
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 major,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 minor,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
    if (binding->BindAPI(EGL_OPENGL_API)) {
        binding->context =
            binding->CreateContext(binding->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    }
    if (binding->context == EGL_NO_CONTEXT) {
        return srp_fail(error, SRP_NO_DEVICE,
                        "EGL offers no core context of OpenGL %d.%d (error 0x%04x)", major, minor,
                        (unsigned)binding->GetError());
    }
    return SRP_OK;
}

/* Mesa's virpipe draws in another process, and aborts this one when there is none. */
static srp_status check_driver(srp_error *error) {
    const char *driver = getenv("GALLIUM_DRIVER");
    if (driver != NULL && strcmp(driver, "virpipe") == 0) {
        return srp_fail(error, SRP_NO_DEVICE,
                        "GALLIUM_DRIVER is 'virpipe', which draws in another process; unset it");
    }
    return SRP_OK;
}

static srp_status create(int index, int major, int minor, srp_gl_binding **out, srp_error *error) {
    srp_status status = check_driver(error);
    if (status != SRP_OK) {
        return status;
    }
    srp_gl_binding *binding = calloc(1, sizeof *binding);
    if (binding == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for EGL");
    }
    status = open_library(binding, error);
    if (status == SRP_OK) {
        status = open_display(binding, index, error);
    }
    if (status == SRP_OK) {
        status = create_context(binding, major, minor, error);
    }
    if (status != SRP_OK) {
        destroy(binding);
        return status;
    }
    *out = binding;
    return SRP_OK;
}

static bool enter(srp_gl_binding *binding) {
    /* The API is a setting of each thread. */
    return binding->BindAPI(EGL_OPENGL_API) &&
           binding->MakeCurrent(binding->display, EGL_NO_SURFACE, EGL_NO_SURFACE, binding->context);
}

static void leave(srp_gl_binding *binding) {
    (void)binding->MakeCurrent(binding->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

static srp_gl_function find(const srp_gl_binding *binding, const char *name) {
    return (srp_gl_function)binding->GetProcAddress(name);
}

const srp_gl_provider srp_gl_egl = {"EGL", create, enter, leave, destroy, find};
