/* SPDX-License-Identifier: Apache-2.0 */
/* What the tests of OpenGL share: the device that they run on, and its methods. */
#ifndef SRP_TEST_GL_FIXTURE_H
#define SRP_TEST_GL_FIXTURE_H

#include <srp/method.h>
#include <srp/vec3.h>

#include <check.h>
#include <stdbool.h>

enum { PAPER_DIRECTIONS = 162 };

/* Of the run: "gl:osmesa" or "gl:egl". */
extern const char *gl_device_name;

/* Whether the device is there; if not, says "skipped: why". */
bool gl_device_is_there(const char *device);

/* A method on a device; NULL: there is none. */
const srp_method *gl_method_on(const char *device, const char *name);
/* The same on the device of the run. */
const srp_method *gl_method(const char *name);

/* The directions of AAS 20-481. */
void gl_paper_directions(srp_vec3 s[PAPER_DIRECTIONS]);

/* Runs a suite in this process: drivers do not survive fork(). The arguments are the device, and
 * perhaps "long". */
int gl_run(int argc, char **argv, Suite *(*make)(bool is_long));

#endif
