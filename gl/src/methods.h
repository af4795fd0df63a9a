/* SPDX-License-Identifier: Apache-2.0 */
/* What each method does on a device of OpenGL. Internal. */
#ifndef SRP_GL_SRC_METHODS_H
#define SRP_GL_SRC_METHODS_H

#include "context.h"

#include <srp/method.h>

/* srp_method.prepare with what its table says of itself. */
srp_status srp_gl_raycast_prepare(const srp_method *method, const srp_gl_device *device,
                                  const srp_scene *scene, const srp_method_params *params,
                                  srp_prepared **out, srp_error *error);
srp_status srp_gl_raycast_respond(const srp_prepared *prepared, size_t count,
                                  const srp_vec3 *s_body, srp_response *responses, srp_basis *basis,
                                  srp_error *error);
void srp_gl_raycast_release(srp_prepared *prepared);

srp_status srp_gl_raytrace_prepare(const srp_method *method, const srp_gl_device *device,
                                   const srp_scene *scene, const srp_method_params *params,
                                   srp_prepared **out, srp_error *error);
srp_status srp_gl_raytrace_respond(const srp_prepared *prepared, size_t count,
                                   const srp_vec3 *s_body, srp_response *responses,
                                   srp_basis *basis, srp_error *error);
void srp_gl_raytrace_release(srp_prepared *prepared);

#endif
