/* SPDX-License-Identifier: Apache-2.0 */
/* Radiation pressure: a = nu P(d) scale / m R^T f(R s), with s = (Sun - r) / d. */
#include "error.h"
#include "mat3.h"

#include <srp/acceleration.h>
#include <srp/orbit/radiation.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void place_bodies(const srp_shadow *shadow, srp_vec3 r, const srp_vec3 *bodies,
                         srp_body before[SRP_CELESTIAL_COUNT]) {
    for (size_t i = 0; i < shadow->count; ++i) {
        before[i].position = srp_vec3_sub(bodies[shadow->body[i]], r);
        before[i].radius = shadow->radius[i];
    }
}

double srp_shadow_fraction(const srp_shadow *shadow, srp_vec3 r, const srp_vec3 *bodies) {
    srp_body before[SRP_CELESTIAL_COUNT];
    place_bodies(shadow, r, bodies, before);
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

/* A state as srpcore sees it; not to be copied, for `state` points into it. */
typedef struct instant {
    srp_acceleration_params params;
    srp_acceleration_state state;
    srp_acceleration_lighting light;
    srp_body before[SRP_CELESTIAL_COUNT];
} instant;
_Static_assert((int)SRP_CELESTIAL_COUNT <= (int)SRP_ACCELERATION_BODIES_MAX,
               "all bodies may cast shadows");

static int see(const srp_radiation_params *p, const srp_force_state *state, instant *out) {
    const int code = matrix_at(p, state, out->state.matrix);
    if (code != 0) {
        return code;
    }
    place_bodies(&p->shadow, state->r, state->bodies, out->before);
    out->params = (srp_acceleration_params){p->light, p->shadow.sun_radius, p->scale};
    out->state.sun = srp_vec3_sub(state->bodies[SRP_SUN], state->r);
    out->state.count = p->shadow.count;
    out->state.bodies = out->before;
    out->state.mass = p->mass;
    return srp_acceleration_light(&out->params, &out->state, &out->light, NULL) == SRP_OK ? 0 : -1;
}

/* ---- Partials -------------------------------------------------------------------------------- */

/* Step of the differences over r and v, as a share of their length. What the attitude does to the
 * state transition is small beside gravity; the formula is of second order. */
static const double STATE_STEP = 1e-5;

typedef struct answer {
    srp_vec3 f;
    double df[3][3];
} answer;

/* By the turning of the body, M' = dM / dx: d(M^T f(M s)) = M'^T f + M^T df M' s. */
static int add_attitude_part(const srp_radiation_params *p, const srp_force_state *state,
                             const instant *seen, const answer *at, srp_force_sum *sum) {
    const double k = seen->light.seen * seen->light.factor;
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
        srp_vec3 ds = srp_mat3_apply((const double(*)[3])above, seen->light.s);
        srp_vec3 column = srp_mat3_apply_transposed(seen->state.matrix,
                                                    srp_mat3_apply((const double(*)[3])at->df, ds));
        column = srp_vec3_add(column, srp_mat3_apply_transposed((const double(*)[3])above, at->f));
        srp_mat3_add_column(j < 3 ? sum->da_dr : sum->da_dv, j % 3, srp_vec3_scale(k, column));
    }
    return 0;
}

/* ---- Force ----------------------------------------------------------------------------------- */

static int radiation_eval(const void *user, const srp_force_state *state, srp_force_sum *sum) {
    const srp_radiation_params *p = user;
    instant seen;
    answer at;
    int code = see(p, state, &seen);
    if (code != 0 && srp_shadow_fraction(&p->shadow, state->r, state->bodies) == 0.0) {
        return 0; /* in the dark no attitude is needed, and there may be none */
    }
    if (code != 0 || seen.light.seen == 0.0) {
        return code;
    }
    code = p->model.eval(p->model.user, seen.light.s_body, &at.f, sum->partials ? at.df : NULL);
    if (code != 0) {
        return code;
    }
    sum->a =
        srp_vec3_add_scaled(sum->a, seen.light.seen * seen.light.factor,
                            srp_mat3_apply_transposed((const double(*)[3])seen.state.matrix, at.f));
    if (sum->partials) {
        srp_acceleration_add_partials(&seen.params, &seen.state, &seen.light, at.f,
                                      (const double(*)[3])at.df, sum->da_dr);
        if (!is_round(p) && (p->attitude.flags & SRP_ATTITUDE_OF_STATE) != 0) {
            code = add_attitude_part(p, state, &seen, &at, sum);
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
    instant seen;
    srp_radiation_probe probe;
    int code = see(p, state, &seen);
    if (code == 0) {
        code = p->model.eval(p->model.user, seen.light.s_body, &probe.f, NULL);
    }
    if (code != 0) {
        return code;
    }
    memcpy(probe.matrix, seen.state.matrix, sizeof probe.matrix);
    probe.s_body = seen.light.s_body;
    probe.seen = seen.light.seen;
    probe.a =
        srp_vec3_scale(seen.light.seen * seen.light.factor,
                       srp_mat3_apply_transposed((const double(*)[3])seen.state.matrix, probe.f));
    *out = probe;
    return 0;
}
