/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"
#include "limits.h"
#include "method_internal.h"
#include "platform.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const srp_method *const METHODS[] = {&srp_method_cannonball, &srp_method_nplate,
                                            &srp_method_exact, &srp_method_raycast,
                                            &srp_method_raytrace};

const srp_method *const *srp_method_list(size_t *count) {
    *count = sizeof METHODS / sizeof METHODS[0];
    return METHODS;
}

srp_method_params srp_method_params_default(void) {
    srp_method_params params;
    memset(&params, 0, sizeof params);
    params.threads = srp_platform_processor_count();
    params.lattice.kind = SRP_LATTICE_TURNED;
    params.lattice.samples = 512;
    params.lattice.pixel = NAN;
    params.lattice.columns = 512;
    params.lattice.rows = 512;
    params.tolerance = INFINITY;
    params.max_samples = 8192;
    params.reflections = 2;
    params.diffuse = 0;
    params.mirrored_beams = 8192;
    return params;
}

enum { LATTICE_SIDE_MAX = 32768, REFLECTIONS_MAX = 100, DIFFUSE_MAX = 1024 };

static bool side_is_valid(uint32_t cells) {
    return cells >= 1 && cells <= LATTICE_SIDE_MAX;
}

static srp_status check_lattice(const srp_lattice_params *lattice, srp_error *error) {
    if (lattice->kind == SRP_LATTICE_WINDOW) {
        const double *w = lattice->window;
        if (!side_is_valid(lattice->columns) || !side_is_valid(lattice->rows)) {
            return srp_fail(error, SRP_BAD_ARGUMENT,
                            "lattice of %u x %u cells, expected 1 to %d along each side",
                            lattice->columns, lattice->rows, LATTICE_SIDE_MAX);
        }
        if (!(isfinite(w[0]) && isfinite(w[1]) && isfinite(w[2]) && isfinite(w[3]) && w[0] < w[1] &&
              w[2] < w[3])) {
            return srp_fail(error, SRP_BAD_ARGUMENT,
                            "window %g, %g, %g, %g: expected u_min < u_max and v_min < v_max [m]",
                            w[0], w[1], w[2], w[3]);
        }
        return SRP_OK;
    }
    if (lattice->kind != SRP_LATTICE_TURNED) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "unknown kind of lattice %d", (int)lattice->kind);
    }
    if (isnan(lattice->pixel) && !side_is_valid(lattice->samples)) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "lattice of %u cells a side, expected 1 to %d",
                        lattice->samples, LATTICE_SIDE_MAX);
    }
    if (!isnan(lattice->pixel) && !(lattice->pixel > 0.0 && isfinite(lattice->pixel))) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "lattice cell of %g m, expected more than 0",
                        lattice->pixel);
    }
    return SRP_OK;
}

static srp_status check_bounces(const srp_method_params *params, srp_error *error) {
    if (params->reflections > REFLECTIONS_MAX) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "%u reflections, expected 0 to %d",
                        params->reflections, REFLECTIONS_MAX);
    }
    if (params->diffuse > DIFFUSE_MAX) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "%u diffuse rays, expected 0 to %d",
                        params->diffuse, DIFFUSE_MAX);
    }
    return SRP_OK;
}

static srp_status check_params(const srp_method *method, const srp_method_params *params,
                               srp_error *error) {
    if (params->threads < 1) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "%d threads, expected at least 1",
                        params->threads);
    }
    if (!srp_vec3_is_finite(params->reference)) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "the reference point is not finite");
    }
    if (!(srp_vec3_largest(params->reference) <= SRP_REACH_MAX)) {
        return srp_fail(error, SRP_BAD_ARGUMENT,
                        "the reference point has a coordinate of %g m, expected at most %g m",
                        srp_vec3_largest(params->reference), SRP_REACH_MAX);
    }
    if (method->capabilities & SRP_METHOD_BOUNCE) {
        srp_status status = check_bounces(params, error);
        if (status != SRP_OK) {
            return status;
        }
    }
    if (!(method->capabilities & SRP_METHOD_LATTICE)) {
        return SRP_OK;
    }
    if (!(params->tolerance > 0.0)) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "tolerance %g, expected more than 0",
                        params->tolerance);
    }
    if (!side_is_valid(params->max_samples)) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "at most %u samples a side, expected 1 to %d",
                        params->max_samples, LATTICE_SIDE_MAX);
    }
    return check_lattice(&params->lattice, error);
}

static const char *shape_name(srp_shape shape) {
    switch (shape) {
    case SRP_SHAPE_MESH:
        return "a mesh";
    case SRP_SHAPE_PLATES:
        return "plates";
    case SRP_SHAPE_SPHERE:
        return "a cannonball's area and coefficient";
    }
    return "an unknown shape";
}

srp_status srp_method_prepare(const srp_method *method, const srp_scene *scene,
                              const srp_method_params *params, srp_prepared **out,
                              srp_error *error) {
    if (!(method->shapes & (unsigned)srp_scene_shape(scene))) {
        return srp_fail(error, SRP_UNSUPPORTED, "method %s cannot work on %s", method->name,
                        shape_name(srp_scene_shape(scene)));
    }
    srp_status status = check_params(method, params, error);
    return status != SRP_OK ? status : method->prepare(scene, params, out, error);
}

/* Unit to 1e-9: what a direction loses on the way through a file of 10 digits. */
static bool is_unit(srp_vec3 s) {
    return fabs(srp_vec3_dot(s, s) - 1.0) <= 2e-9;
}

srp_status srp_prepared_respond(const srp_prepared *prepared, size_t count, const srp_vec3 *s_body,
                                srp_response *responses, srp_basis *basis, srp_error *error) {
    if (basis != NULL && !(prepared->method->capabilities & SRP_METHOD_BASIS)) {
        return srp_fail(error, SRP_UNSUPPORTED, "method %s gives no sums per material",
                        prepared->method->name);
    }
    for (size_t i = 0; i < count; ++i) {
        if (!is_unit(s_body[i])) {
            return srp_fail(error, SRP_BAD_ARGUMENT,
                            "direction %zu is (%.17g, %.17g, %.17g), expected a unit vector", i,
                            s_body[i].x, s_body[i].y, s_body[i].z);
        }
    }
    return prepared->method->respond(prepared, count, s_body, responses, basis, error);
}

void srp_prepared_release(srp_prepared *prepared) {
    if (prepared != NULL) {
        prepared->method->release(prepared);
    }
}

const srp_method *srp_prepared_method(const srp_prepared *prepared) {
    return prepared->method;
}

const srp_scene *srp_prepared_scene(const srp_prepared *prepared) {
    return prepared->scene;
}

const srp_method_params *srp_prepared_params(const srp_prepared *prepared) {
    return &prepared->params;
}
