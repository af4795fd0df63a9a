/* SPDX-License-Identifier: Apache-2.0 */
/* Radiation pressure: a = nu P(d) scale / m R^T f(R s), with s = (Sun - r) / d. */
#include "error.h"
#include "mat3.h"

#include <srp/orbit/radiation.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

double srp_shadow_fraction(const srp_shadow *shadow, srp_vec3 r, const srp_vec3 *bodies) {
    srp_body before[SRP_CELESTIAL_COUNT];
    for (size_t i = 0; i < shadow->count; ++i) {
        before[i].position = srp_vec3_sub(bodies[shadow->body[i]], r);
        before[i].radius = shadow->radius[i];
    }
    return srp_sunlight_fraction(srp_vec3_sub(bodies[SRP_SUN], r), shadow->sun_radius,
                                 shadow->count, before);
}

static const double ONE[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

static bool is_round(const srp_radiation_params *p) {
    return (p->model.flags & SRP_AREA_MODEL_ROUND) != 0;
}

static int matrix_at(const srp_radiation_params *p, const srp_force_state *state,
                     double matrix[3][3]) {
    if (is_round(p)) {
        memcpy(matrix, ONE, sizeof ONE);
        return 0;
    }
    return p->attitude.eval(p->attitude.user, state, matrix);
}

/* Of a state: direction, distance, factor nu P scale / m. */
typedef struct lighting {
    srp_vec3 s; /* inertial */
    double distance, seen, factor;
} lighting;

static lighting light_at(const srp_radiation_params *p, const srp_force_state *state) {
    lighting out;
    const srp_vec3 sun = srp_vec3_sub(state->bodies[SRP_SUN], state->r);
    out.distance = srp_vec3_norm(sun);
    out.s = srp_vec3_scale(1.0 / out.distance, sun);
    out.seen = srp_shadow_fraction(&p->shadow, state->r, state->bodies);
    out.factor = p->scale * srp_sunlight_pressure(p->light, out.distance) / p->mass;
    return out;
}

/* ---- Partials -------------------------------------------------------------------------------- */

/* Step of the differences over r and v, as a share of their length. What attitude and shadow do to
 * the state transition is small beside gravity; the formula is of second order. */
static const double STATE_STEP = 1e-5;
/* [m] of the share of the Sun, a smooth function over tens of kilometres. */
static const double SHADOW_STEP = 10.0;

typedef struct answer {
    double matrix[3][3];
    srp_vec3 s_body, f;
    double df[3][3];
} answer;

/* By the way that the direction to the Sun changes, and the distance: P ~ d^-2, ds = -(1 - s
 * s^T)/d. */
static void add_direction_part(const lighting *light, const answer *at, double k,
                               srp_force_sum *sum) {
    const srp_vec3 f = srp_mat3_apply_transposed((const double(*)[3])at->matrix, at->f);
    const double s[3] = {light->s.x, light->s.y, light->s.z};
    for (int j = 0; j < 3; ++j) {
        srp_vec3 ds = srp_vec3_add_scaled(srp_vec3_scale(-1.0, srp_axis(j)), s[j], light->s);
        ds = srp_mat3_apply((const double(*)[3])at->matrix,
                            srp_vec3_scale(1.0 / light->distance, ds));
        srp_vec3 column = srp_mat3_apply_transposed((const double(*)[3])at->matrix,
                                                    srp_mat3_apply((const double(*)[3])at->df, ds));
        column = srp_vec3_add_scaled(column, 2.0 * s[j] / light->distance, f);
        srp_mat3_add_column(sum->da_dr, j, srp_vec3_scale(k, column));
    }
}

/* By the turning of the body, M' = dM / dx: d(M^T f(M s)) = M'^T f + M^T df M' s. */
static int add_attitude_part(const srp_radiation_params *p, const srp_force_state *state,
                             const lighting *light, const answer *at, double k,
                             srp_force_sum *sum) {
    for (int j = 0; j < 6; ++j) {
        srp_force_state up = *state, down = *state;
        const double step = STATE_STEP * srp_vec3_norm(j < 3 ? state->r : state->v);
        srp_vec3 *const moved_up = j < 3 ? &up.r : &up.v, *const moved_down =
                                                              j < 3 ? &down.r : &down.v;
        double above[3][3], below[3][3];
        *moved_up = srp_vec3_add_scaled(*moved_up, step, srp_axis(j % 3));
        *moved_down = srp_vec3_add_scaled(*moved_down, -step, srp_axis(j % 3));
        int code = matrix_at(p, &up, above);
        if (code == 0) {
            code = matrix_at(p, &down, below);
        }
        if (code != 0) {
            return code;
        }
        for (int i = 0; i < 9; ++i) {
            above[i / 3][i % 3] = (above[i / 3][i % 3] - below[i / 3][i % 3]) * (0.5 / step);
        }
        srp_vec3 ds = srp_mat3_apply((const double(*)[3])above, light->s);
        srp_vec3 column = srp_mat3_apply_transposed((const double(*)[3])at->matrix,
                                                    srp_mat3_apply((const double(*)[3])at->df, ds));
        column = srp_vec3_add(column, srp_mat3_apply_transposed((const double(*)[3])above, at->f));
        srp_mat3_add_column(j < 3 ? sum->da_dr : sum->da_dv, j % 3, srp_vec3_scale(k, column));
    }
    return 0;
}

static void add_shadow_part(const srp_radiation_params *p, const srp_force_state *state,
                            const lighting *light, srp_vec3 f, srp_force_sum *sum) {
    for (int j = 0; j < 3; ++j) {
        const double up = srp_shadow_fraction(
            &p->shadow, srp_vec3_add_scaled(state->r, SHADOW_STEP, srp_axis(j)), state->bodies);
        const double down = srp_shadow_fraction(
            &p->shadow, srp_vec3_add_scaled(state->r, -SHADOW_STEP, srp_axis(j)), state->bodies);
        srp_mat3_add_column(sum->da_dr, j,
                            srp_vec3_scale(light->factor * (up - down) / (2.0 * SHADOW_STEP), f));
    }
}

/* ---- Force ----------------------------------------------------------------------------------- */

static int radiation_eval(const void *user, const srp_force_state *state, srp_force_sum *sum) {
    const srp_radiation_params *p = user;
    const lighting light = light_at(p, state);
    if (light.seen == 0.0) {
        return 0;
    }
    answer at;
    int code = matrix_at(p, state, at.matrix);
    if (code != 0) {
        return code;
    }
    /* Rounding of the matrix: the interpolant wants a unit vector. */
    at.s_body = srp_unit(srp_mat3_apply((const double(*)[3])at.matrix, light.s));
    code = p->model.eval(p->model.user, at.s_body, &at.f, sum->partials ? at.df : NULL);
    if (code != 0) {
        return code;
    }
    const srp_vec3 f = srp_mat3_apply_transposed((const double(*)[3])at.matrix, at.f);
    const double k = light.seen * light.factor;
    sum->a = srp_vec3_add_scaled(sum->a, k, f);
    if (sum->partials) {
        add_direction_part(&light, &at, k, sum);
        if (light.seen < 1.0) {
            add_shadow_part(p, state, &light, f, sum);
        }
        if (!is_round(p) && (p->attitude.flags & SRP_ATTITUDE_OF_STATE) != 0) {
            code = add_attitude_part(p, state, &light, &at, k, sum);
        }
    }
    return code;
}

static void radiation_destroy(void *user) {
    srp_radiation_params *p = user;
    srp_area_model_release(&p->model);
    srp_attitude_release(&p->attitude);
    free(p);
}

srp_status srp_force_radiation(const srp_radiation_params *params, srp_force *out,
                               srp_error *error) {
    if (!(params->mass > 0.0 && isfinite(params->mass))) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "a mass of %g kg, expected above 0", params->mass);
    }
    if (!isfinite(params->scale)) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "a scale factor of %g", params->scale);
    }
    if (!is_round(params) && params->attitude.eval == NULL) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "model %s needs an attitude", params->model.name);
    }
    srp_radiation_params *p = malloc(sizeof *p);
    if (p == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a force");
    }
    *p = *params;
    *out = (srp_force){"radiation", SRP_FORCE_PARTIALS | SRP_FORCE_RADIATION, radiation_eval,
                       radiation_destroy, p};
    return SRP_OK;
}

int srp_force_radiation_probe(const srp_force *force, const srp_force_state *state,
                              srp_radiation_probe *out) {
    const srp_radiation_params *p = force->user;
    const lighting light = light_at(p, state);
    srp_radiation_probe probe;
    int code = matrix_at(p, state, probe.matrix);
    if (code != 0) {
        return code;
    }
    probe.s_body = srp_unit(srp_mat3_apply((const double(*)[3])probe.matrix, light.s));
    code = p->model.eval(p->model.user, probe.s_body, &probe.f, NULL);
    if (code != 0) {
        return code;
    }
    probe.seen = light.seen;
    probe.a = srp_vec3_scale(light.seen * light.factor,
                             srp_mat3_apply_transposed((const double(*)[3])probe.matrix, probe.f));
    *out = probe;
    return 0;
}
