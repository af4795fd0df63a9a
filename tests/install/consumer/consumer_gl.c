/* SPDX-License-Identifier: Apache-2.0 */
/* A program of someone else with the methods in OpenGL: a driver need not be there. */
#include <srp/gl.h>

#include <stdio.h>

int main(void) {
    size_t count;
    const srp_method *const *methods = srp_gl_method_list(&count);
    srp_gl_description description;
    srp_error error;
    srp_status status = srp_gl_device_describe(methods[0]->device, &description, &error);
    printf("%zu methods, %s on %s: %s\n", count, methods[0]->name, methods[0]->device,
           status == SRP_OK ? description.renderer : error.message);
    return count > 0 && (status == SRP_OK || status == SRP_NO_DEVICE) ? 0 : 1;
}
