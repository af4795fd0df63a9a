/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"
#include "mat3.h"
#include "shadow_edges.h"

#include <srp/orbit/propagator.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Integrators ----------------------------------------------------------------------------- */

const srp_integrator srp_integrator_rk8pd = {
    "rk8pd", "Runge-Kutta of Prince and Dormand, orders 8 and 9", 8, true};
const srp_integrator srp_integrator_rkf45 = {"rkf45", "Runge-Kutta-Fehlberg, orders 4 and 5", 5,
                                             true};
const srp_integrator srp_integrator_rkck = {"rkck", "Runge-Kutta of Cash and Karp, orders 4 and 5",
                                            5, true};
const srp_integrator srp_integrator_rk4 = {"rk4", "the classical Runge-Kutta, by halved steps", 4,
                                           false};

static const srp_integrator *const INTEGRATORS[] = {&srp_integrator_rk8pd, &srp_integrator_rkf45,
                                                    &srp_integrator_rkck, &srp_integrator_rk4};
enum { INTEGRATOR_COUNT = sizeof INTEGRATORS / sizeof INTEGRATORS[0] };

const srp_integrator *const *srp_integrator_list(size_t *count) {
    *count = INTEGRATOR_COUNT;
    return INTEGRATORS;
}

const srp_integrator *srp_integrator_find(const char *name) {
    for (size_t i = 0; i < INTEGRATOR_COUNT; ++i) {
        if (strcmp(INTEGRATORS[i]->name, name) == 0) {
            return INTEGRATORS[i];
        }
    }
    return NULL;
}

static const gsl_odeiv2_step_type *type_of(const srp_integrator *integrator) {
    return integrator == &srp_integrator_rk8pd   ? gsl_odeiv2_step_rk8pd
           : integrator == &srp_integrator_rkf45 ? gsl_odeiv2_step_rkf45
           : integrator == &srp_integrator_rkck  ? gsl_odeiv2_step_rkck
                                                 : gsl_odeiv2_step_rk4;
}

/* The power of the step that the estimated error of one step falls with. */
static double control_power(const srp_integrator *integrator) {
    return integrator == &srp_integrator_rk8pd ? 8.0 : 5.0;
}

/* ---- Equations of motion ----------------------------------------------------------------------
 */

/* y: position, velocity, impulse, and with partials the matrix, row by row. */
enum { IMPULSE = 6, MATRIX = 7, PLAIN = 7, WITH_MATRIX = 43 };

struct srp_propagator {
    const srp_force_list *forces;
    srp_propagator_params params;
    gsl_odeiv2_step *stepper;
    gsl_odeiv2_system system;
    size_t size;         /* of y */
    double t, next_step; /* [s], next_step > 0 */
    double y[WITH_MATRIX], slope[WITH_MATRIX];
    double trial[WITH_MATRIX], trial_slope[WITH_MATRIX], error[WITH_MATRIX];
    srp_edges edges;
    srp_propagator_counts counts;
};

static srp_vec3 vec3_of(const double *y) {
    return srp_vec3_make(y[0], y[1], y[2]);
}

static void put(double *y, srp_vec3 v) {
    y[0] = v.x;
    y[1] = v.y;
    y[2] = v.z;
}

/* Phi' = [0 1; da/dr da/dv] Phi */
static void matrix_slope(const srp_force_sum *sum, const double *phi, double *slope) {
    memcpy(slope, phi + 18, 18 * sizeof *slope);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 6; ++j) {
            double value = 0.0;
            for (int k = 0; k < 3; ++k) {
                value +=
                    sum->da_dr[i][k] * phi[6 * k + j] + sum->da_dv[i][k] * phi[6 * (k + 3) + j];
            }
            slope[18 + 6 * i + j] = value;
        }
    }
}

static int slopes(double t, const double y[], double dydt[], void *user) {
    srp_propagator *p = user;
    srp_force_sum sum = {.partials = p->params.partials};
    srp_vec3 light;
    ++p->counts.calls;
    const int code = srp_force_list_eval(p->forces, t, vec3_of(y), vec3_of(y + 3), &sum, &light);
    if (code != 0) {
        return code > 0 ? GSL_EFAILED : GSL_EBADFUNC;
    }
    if (!srp_vec3_is_finite(sum.a)) {
        return GSL_EFAILED;
    }
    put(dydt, vec3_of(y + 3));
    put(dydt + 3, sum.a);
    dydt[IMPULSE] = srp_vec3_norm(light);
    if (p->params.partials) {
        matrix_slope(&sum, y + MATRIX, dydt + MATRIX);
    }
    return GSL_SUCCESS;
}

/* ---- Life ------------------------------------------------------------------------------------ */

srp_propagator_params srp_propagator_params_default(void) {
    srp_propagator_params params = {.integrator = &srp_integrator_rk8pd,
                                    .tolerance = 1e-12,
                                    .fixed_step = NAN,
                                    .first_step = 60.0,
                                    .max_step = INFINITY};
    return params;
}

static srp_status check(const srp_force_list *forces, const srp_propagator_params *params,
                        srp_error *error) {
    if (!(params->tolerance > 0.0 && params->tolerance < 1.0)) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "a tolerance of %g, expected above 0 and below 1",
                        params->tolerance);
    }
    if (!isnan(params->fixed_step) && !(params->fixed_step > 0.0 && isfinite(params->fixed_step))) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "a step of %g s, expected above 0",
                        params->fixed_step);
    }
    if (!(params->first_step > 0.0 && isfinite(params->first_step) && params->max_step > 0.0)) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "a first step of %g s and a largest of %g s",
                        params->first_step, params->max_step);
    }
    if (params->integrator == NULL || params->shadow.count > SRP_CELESTIAL_COUNT) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "no integrator, or too many bodies with shadows");
    }
    for (size_t i = 0; params->partials && i < srp_force_list_count(forces); ++i) {
        const srp_force *force = srp_force_list_get(forces, i);
        if ((force->flags & SRP_FORCE_PARTIALS) == 0) {
            return srp_fail(error, SRP_UNSUPPORTED, "force %s gives no partials", force->name);
        }
    }
    return SRP_OK;
}

srp_status srp_propagator_create(const srp_force_list *forces, const srp_propagator_params *params,
                                 srp_propagator **out, srp_error *error) {
    srp_status status = check(forces, params, error);
    if (status != SRP_OK) {
        return status;
    }
    srp_propagator *p = calloc(1, sizeof *p);
    if (p != NULL) {
        p->forces = forces;
        p->params = *params;
        p->size = params->partials ? WITH_MATRIX : PLAIN;
        p->stepper = gsl_odeiv2_step_alloc(type_of(params->integrator), p->size);
        p->system = (gsl_odeiv2_system){slopes, NULL, p->size, p};
        p->edges.forces = forces;
        p->edges.shadow = &p->params.shadow;
    }
    if (p == NULL || p->stepper == NULL) {
        free(p);
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a propagator");
    }
    p->t = NAN;
    *out = p;
    return SRP_OK;
}

void srp_propagator_destroy(srp_propagator *p) {
    if (p != NULL) {
        gsl_odeiv2_step_free(p->stepper);
        free(p);
    }
}

srp_status srp_propagator_start(srp_propagator *p, double t, srp_vec3 r, srp_vec3 v,
                                srp_error *error) {
    if (!isfinite(t) || !srp_vec3_is_finite(r) || !srp_vec3_is_finite(v) ||
        srp_vec3_norm(r) == 0.0) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "a state that is not finite, or at the centre");
    }
    memset(p->y, 0, sizeof p->y);
    put(p->y, r);
    put(p->y + 3, v);
    for (int i = 0; i < 6; ++i) {
        p->y[MATRIX + 7 * i] = 1.0;
    }
    p->t = t;
    p->next_step = isnan(p->params.fixed_step) ? p->params.first_step : p->params.fixed_step;
    p->counts = (srp_propagator_counts){0};
    gsl_odeiv2_step_reset(p->stepper);
    if (p->params.shadow_edges) {
        srp_edges_begin(&p->edges, t, r);
    }
    return slopes(t, p->y, p->slope, p) == GSL_SUCCESS
               ? SRP_OK
               : srp_fail(error, SRP_BAD_ARGUMENT, "the forces are not defined at the first state");
}

/* ---- One step -------------------------------------------------------------------------------- */

/* From the state on by h, into trial, trial_slope and error. A status of GSL. */
static int attempt(srp_propagator *p, double h) {
    memcpy(p->trial, p->y, sizeof p->y);
    int code = gsl_odeiv2_step_apply(p->stepper, p->t, h, p->trial, p->error, p->slope,
                                     p->trial_slope, &p->system);
    for (size_t i = 0; code == GSL_SUCCESS && i < p->size; ++i) {
        code = isfinite(p->trial[i]) ? GSL_SUCCESS : GSL_EFAILED;
    }
    return code;
}

/* Error over tolerance. Lengths are those of whole vectors, at rest and at the centre what the step
 * moves: no component is measured by itself, which may be 0. */
static double error_ratio(const srp_propagator *p, double h) {
    const double r = srp_vec3_norm(vec3_of(p->trial)), v = srp_vec3_norm(vec3_of(p->trial + 3));
    const double a = srp_vec3_norm(vec3_of(p->trial_slope + 3));
    const double length = r + fabs(h) * v, speed = v + fabs(h) * a;
    return fmax(srp_vec3_norm(vec3_of(p->error)) / length,
                srp_vec3_norm(vec3_of(p->error + 3)) / speed) /
           p->params.tolerance;
}

static void adapt(srp_propagator *p, double h, double ratio) {
    const double power = control_power(p->params.integrator);
    const double factor = ratio > 0.0 ? 0.9 * pow(ratio, -1.0 / power) : 5.0;
    p->next_step = fmin(fabs(h) * fmin(5.0, fmax(0.2, factor)), p->params.max_step);
}

static srp_arc arc_of(const srp_propagator *p, double h) {
    srp_arc arc = {p->t,
                   h,
                   {vec3_of(p->y), vec3_of(p->trial)},
                   {vec3_of(p->y + 3), vec3_of(p->trial + 3)},
                   {vec3_of(p->slope + 3), vec3_of(p->trial_slope + 3)}};
    return arc;
}

static void report(const srp_propagator *p, const srp_propagator_watch *watch, srp_event_kind kind,
                   srp_celestial body, double t, const double *y) {
    if (watch != NULL && watch->event != NULL) {
        const srp_event event = {kind, body, t, vec3_of(y), vec3_of(y + 3)};
        watch->event(watch->user, &event);
    }
    (void)p;
}

/* ---- Apsides --------------------------------------------------------------------------------- */

static double radial(srp_vec3 r, srp_vec3 v) {
    return srp_vec3_dot(r, v);
}

/* Of the step that has been tried and is good: r.v changes its sign. Overwrites the trial, which is
 * made anew. */
static void find_apsis(srp_propagator *p, const srp_propagator_watch *watch, double h) {
    const srp_arc arc = arc_of(p, h);
    const double from = radial(arc.r[0], arc.v[0]), to = radial(arc.r[1], arc.v[1]);
    if (!(from * to < 0.0)) {
        return;
    }
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 50; ++i) {
        const double x = 0.5 * (low + high);
        const double now = radial(srp_arc_position(&arc, x), srp_arc_velocity(&arc, x));
        *(now * from > 0.0 ? &low : &high) = x;
    }
    double at = high * h;
    for (int i = 0; i < 3 && attempt(p, at) == GSL_SUCCESS; ++i) {
        const srp_vec3 r = vec3_of(p->trial), v = vec3_of(p->trial + 3);
        const double rate = srp_vec3_dot(v, v) + srp_vec3_dot(r, vec3_of(p->trial_slope + 3));
        const double change = radial(r, v) / rate;
        if (i == 2 || fabs(change) < 1e-6) {
            report(p, watch, rate > 0.0 ? SRP_EVENT_PERIAPSIS : SRP_EVENT_APOAPSIS,
                   srp_force_list_central(p->forces), p->t + at, p->trial);
            break;
        }
        at -= change;
    }
    if (attempt(p, h) != GSL_SUCCESS) {
        return; /* it was good a moment ago */
    }
}

/* ---- Edges of shadows -------------------------------------------------------------------------
 */

static const double EDGE_TIME = 1e-7; /* [s] that an edge is met to */

/* Makes the trial end on the edge, by Newton's method on the integrated state; *h is its step. A
 * status of GSL. */
static int meet_edge(srp_propagator *p, int edge, double *h) {
    for (int i = 0; i < 5; ++i) {
        const int code = attempt(p, *h);
        if (code != GSL_SUCCESS) {
            return code;
        }
        const double t = p->t + *h, d = 0.01;
        const srp_vec3 r = vec3_of(p->trial), v = vec3_of(p->trial + 3);
        const double depth = srp_edges_depth(&p->edges, edge, t, r);
        const double rate =
            (srp_edges_depth(&p->edges, edge, t + d, srp_vec3_add_scaled(r, d, v)) -
             srp_edges_depth(&p->edges, edge, t - d, srp_vec3_add_scaled(r, -d, v))) /
            (2.0 * d);
        const double change = depth / rate;
        /* Where the edge is only grazed the rate says little: stay near what the arc has said. */
        if (!(fabs(change) > EDGE_TIME) || fabs(change) > 0.1 * fabs(*h) + 1.0) {
            return code;
        }
        *h -= change;
    }
    return attempt(p, *h);
}

static void cross_edge(srp_propagator *p, const srp_propagator_watch *watch, int edge, double h) {
    bool *inside = &p->edges.inside[edge];
    *inside = !*inside;
    /* Told as time goes, also when we go against it. */
    const bool entry = *inside == (h > 0.0);
    const int kind = SRP_EVENT_PENUMBRA_ENTRY + 2 * (edge % SRP_EDGE_KINDS) + (entry ? 0 : 1);
    report(p, watch, (srp_event_kind)kind, p->params.shadow.body[edge / SRP_EDGE_KINDS], p->t,
           p->y);
}

/* ---- Advance --------------------------------------------------------------------------------- */

static void accept(srp_propagator *p, double t) {
    memcpy(p->y, p->trial, sizeof p->y);
    memcpy(p->slope, p->trial_slope, sizeof p->slope);
    p->t = t;
    ++p->counts.steps;
}

static srp_status too_small(const srp_propagator *p, double h, srp_error *error) {
    return srp_fail(
        error, SRP_BAD_DATA,
        "at t = %.6f s, %.3f km from the centre, a step of %.3g s is still too long for "
        "a tolerance of %g",
        p->t, 1e-3 * srp_vec3_norm(vec3_of(p->y)), h, p->params.tolerance);
}

static srp_status stopped(const srp_propagator *p, srp_error *error) {
    return srp_fail(error, SRP_BAD_DATA,
                    "at t = %.6f s a force cannot be computed (an attitude file that has ended?)",
                    p->t);
}

/* A step of at most h that ends at `end` when it is as long as that; *done tells. */
static srp_status step(srp_propagator *p, double h, double end, const srp_propagator_watch *watch,
                       srp_error *error) {
    const bool adaptive = isnan(p->params.fixed_step);
    const bool last = h == end - p->t;
    int code = attempt(p, h);
    if (code == GSL_EBADFUNC) {
        return stopped(p, error);
    }
    const double ratio = code == GSL_SUCCESS ? adaptive ? error_ratio(p, h) : 0.0 : INFINITY;
    double share;
    const srp_arc arc = arc_of(p, h);
    const int edge = code == GSL_SUCCESS && p->params.shadow_edges
                         ? srp_edges_first(&p->edges, &arc, &share)
                         : -1;
    if (ratio > 1.0) {
        ++p->counts.rejected;
        if (!adaptive) {
            return stopped(p, error);
        }
        adapt(p, h, ratio);
        /* It may be the edge that the error test does not like. */
        if (edge >= 0 && share * fabs(h) > 0.2 * p->next_step) {
            p->next_step = fmin(p->next_step, share * fabs(h));
        }
        return p->next_step > 1e-9 + 1e-15 * fabs(p->t) ? SRP_OK : too_small(p, h, error);
    }
    if (edge < 0) {
        if (p->params.apsides) {
            find_apsis(p, watch, h);
        }
        accept(p, last ? end : p->t + h);
        if (adaptive && !(last && fabs(h) < p->next_step && ratio < 1e-3)) {
            adapt(p, h, ratio);
        }
        return SRP_OK;
    }
    const double proposed = p->next_step;
    double to_edge = share * h;
    ++p->counts.cut;
    if (meet_edge(p, edge, &to_edge) != GSL_SUCCESS) {
        return stopped(p, error);
    }
    if (p->params.apsides) {
        find_apsis(p, watch, to_edge);
    }
    accept(p, p->t + to_edge);
    cross_edge(p, watch, edge, h);
    gsl_odeiv2_step_reset(p->stepper);
    p->next_step = proposed;
    return SRP_OK;
}

srp_status srp_propagator_advance(srp_propagator *p, double end, const srp_propagator_watch *watch,
                                  srp_error *error) {
    if (!isfinite(p->t) || !isfinite(end)) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "not started, or to no time");
    }
    while (p->t != end) {
        const double left = end - p->t;
        double h = copysign(fmin(p->next_step, p->params.max_step), left);
        /* No step that is nothing but the rest of one. */
        if (fabs(h) * (1.0 + 1e-10) >= fabs(left)) {
            h = left;
        } else if (isnan(p->params.fixed_step) && 2.0 * fabs(h) > fabs(left)) {
            h = 0.5 * left;
        }
        srp_status status = step(p, h, end, watch, error);
        if (status != SRP_OK) {
            return status;
        }
        if (watch != NULL && watch->step != NULL && !watch->step(watch->user, p->t)) {
            return srp_fail(error, SRP_CANCELLED, "cancelled at t = %.6f s", p->t);
        }
    }
    return SRP_OK;
}

/* ---- Questions ------------------------------------------------------------------------------- */

double srp_propagator_time(const srp_propagator *p) {
    return p->t;
}

srp_vec3 srp_propagator_position(const srp_propagator *p) {
    return vec3_of(p->y);
}

srp_vec3 srp_propagator_velocity(const srp_propagator *p) {
    return vec3_of(p->y + 3);
}

double srp_propagator_impulse(const srp_propagator *p) {
    return p->y[IMPULSE];
}

const double *srp_propagator_matrix(const srp_propagator *p) {
    return p->params.partials ? p->y + MATRIX : NULL;
}

srp_propagator_counts srp_propagator_get_counts(const srp_propagator *p) {
    return p->counts;
}

const char *srp_event_name(srp_event_kind kind) {
    static const char *const NAMES[SRP_EVENT_KIND_COUNT] = {
        "penumbra entry", "penumbra exit", "umbra entry", "umbra exit",
        "antumbra entry", "antumbra exit", "periapsis",   "apoapsis"};
    return (unsigned)kind < SRP_EVENT_KIND_COUNT ? NAMES[kind] : NULL;
}
