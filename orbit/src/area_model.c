/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"
#include "mat3.h"

#include <srp/acceleration.h>
#include <srp/orbit/area_model.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

void srp_area_model_release(srp_area_model *model) {
    if (model->destroy != NULL) {
        model->destroy(model->user);
    }
    model->destroy = NULL;
    model->user = NULL;
}

/* ---- Sphere --------------------------------------------------------------------------------- */

/* f(s / |s|) = -k s / |s|: df = -k (1 - s s^T). */
static int cannonball_eval(const void *user, srp_vec3 s, srp_vec3 *f, double (*df)[3]) {
    const double k = *(const double *)user;
    *f = srp_vec3_scale(-k, s);
    if (df != NULL) {
        const double v[3] = {s.x, s.y, s.z};
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                df[i][j] = -k * ((i == j) - v[i] * v[j]);
            }
        }
    }
    return 0;
}

srp_status srp_area_model_cannonball(double cr, double area, srp_area_model *out,
                                     srp_error *error) {
    if (!(cr >= 0.0 && isfinite(cr))) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "a reflectivity coefficient of %g, expected >= 0",
                        cr);
    }
    if (!(area > 0.0 && isfinite(area))) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "an area of %g m^2, expected above 0", area);
    }
    double *k = malloc(sizeof *k);
    if (k == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for an area model");
    }
    *k = cr * area;
    *out = (srp_area_model){"cannonball", SRP_AREA_MODEL_ROUND, cannonball_eval, free, k};
    return SRP_OK;
}

/* ---- Interpolant ---------------------------------------------------------------------------- */

static int interp_eval(const void *user, srp_vec3 s, srp_vec3 *f, double (*df)[3]) {
    const srp_area_source source = srp_area_source_interp(user);
    return source.eval(source.user, s, f, df, NULL) == SRP_OK ? 0 : -1;
}

static void interp_destroy(void *user) {
    srp_interp_destroy(user);
}

srp_status srp_area_model_interp(srp_interp *interp, srp_area_model *out, srp_error *error) {
    if (interp == NULL) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "no interpolant");
    }
    *out = (srp_area_model){srp_interp_get_scheme(interp)->name, 0, interp_eval, interp_destroy,
                            interp};
    return SRP_OK;
}

/* ---- A method, asked anew -------------------------------------------------------------------- */

static int direct_at(const srp_prepared *prepared, srp_vec3 s, srp_vec3 *f) {
    srp_response response;
    if (srp_prepared_respond(prepared, 1, &s, &response, NULL, NULL) != SRP_OK) {
        return -1;
    }
    *f = response.f;
    return 0;
}

static const double DIRECT_STEP = 1e-5; /* [rad] */

/* Derivatives in two directions across s. */
static int direct_slopes(const srp_prepared *prepared, srp_vec3 s, double df[3][3]) {
    const srp_vec3 aside = fabs(s.x) < 0.6 ? srp_axis(0) : srp_axis(1);
    srp_vec3 across[2];
    across[0] = srp_unit(srp_vec3_cross(s, aside));
    across[1] = srp_vec3_cross(s, across[0]);
    memset(df, 0, 9 * sizeof(double));
    for (int k = 0; k < 2; ++k) {
        srp_vec3 up, down;
        if (direct_at(prepared, srp_unit(srp_vec3_add_scaled(s, DIRECT_STEP, across[k])), &up) ||
            direct_at(prepared, srp_unit(srp_vec3_add_scaled(s, -DIRECT_STEP, across[k])), &down)) {
            return -1;
        }
        const srp_vec3 slope = srp_vec3_scale(0.5 / DIRECT_STEP, srp_vec3_sub(up, down));
        srp_mat3_add_column(df, 0, srp_vec3_scale(across[k].x, slope));
        srp_mat3_add_column(df, 1, srp_vec3_scale(across[k].y, slope));
        srp_mat3_add_column(df, 2, srp_vec3_scale(across[k].z, slope));
    }
    return 0;
}

static int direct_eval(const void *user, srp_vec3 s, srp_vec3 *f, double (*df)[3]) {
    int code = direct_at(user, s, f);
    if (code == 0 && df != NULL) {
        code = direct_slopes(user, s, df);
    }
    return code;
}

srp_status srp_area_model_direct(const srp_prepared *prepared, srp_area_model *out,
                                 srp_error *error) {
    if (prepared == NULL) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "no prepared method");
    }
    *out = (srp_area_model){srp_prepared_method(prepared)->name, 0, direct_eval, NULL,
                            (void *)prepared};
    return SRP_OK;
}
