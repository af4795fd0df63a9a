/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Methods that run in OpenGL, off screen. They are srp_method tables like those of srp/method.h,
 * and are prepared and asked in the same way. No library of OpenGL is linked: OSMesa and EGL are
 * opened when a method is prepared.
 *
 *     size_t count;
 *     const srp_method *const *methods = srp_gl_method_list(&count);
 *     ... the one whose `name` is "raycast" and whose `device` is "gl:osmesa" ...
 *
 * Devices (srp_method.device):
 *     "gl:osmesa"   Mesa's software renderer in memory; needs no GPU
 *     "gl:egl"      the first GPU that EGL lists and can use; without one, Mesa's surfaceless
 *                   platform, which is its software renderer again
 *     "gl:egl:N"    EGL's device number N, 0 to 15
 *
 * One context serves one call at a time: several threads may call srp_prepared_respond() on one
 * prepared method, each with a context of its own, made when first needed. A context is current on
 * the calling thread during a call and none afterwards: a program that draws itself makes its own
 * current again.
 *
 * Preparing returns, beyond what srp/method.h says, SRP_NO_DEVICE: a library or a device is not
 * there, the driver is too old, does not compile our shaders, or draws two triangles wrongly (each
 * new context has to). srp_prepared_respond() may return it too.
 *
 * A response depends on its direction alone, to the bit, for one driver; drivers differ in the last
 * digits of where edges cross the samples (docs/theory.md, "In OpenGL").
 */
#ifndef SRP_GL_H
#define SRP_GL_H

#include <srp/method.h>
#include <srp/status.h>

#include <stdbool.h>
#include <stddef.h>

SRP_BEGIN_DECLS

/* All methods on all devices, whether this machine has them or not; *count of them. Constant. */
SRP_API const srp_method *const *srp_gl_method_list(size_t *count);

/* What a driver says of itself. */
typedef struct srp_gl_description {
    char renderer[128]; /* often the name of the GPU */
    char version[64];   /* of OpenGL and of the driver */
    bool computes;      /* has compute shaders (OpenGL 4.3) */
} srp_gl_description;

/* Makes a context on `device` (as in srp_method.device), asks it and destroys it. Any thread.
 * SRP_NOT_FOUND (no device is called so), SRP_NO_DEVICE, SRP_NO_MEMORY. */
SRP_API SRP_CHECK srp_status srp_gl_device_describe(const char *device, srp_gl_description *out,
                                                    srp_error *error);

SRP_END_DECLS

#endif
