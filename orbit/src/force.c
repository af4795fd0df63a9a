/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"
#include "mat3.h"

#include <srp/orbit/force.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

void srp_force_release(srp_force *force) {
    if (force->destroy != NULL) {
        force->destroy(force->user);
    }
    force->destroy = NULL;
    force->user = NULL;
}

/* ---- Points --------------------------------------------------------------------------------- */

typedef struct point {
    double mu;
    srp_celestial body;
} point;

/* a += -mu d / |d|^3 and its derivative with respect to d. */
static void attract(double mu, srp_vec3 d, srp_force_sum *sum) {
    const double r2 = srp_vec3_dot(d, d), r = sqrt(r2);
    const double k = mu / (r2 * r);
    sum->a = srp_vec3_add_scaled(sum->a, -k, d);
    if (sum->partials) {
        for (int j = 0; j < 3; ++j) {
            const double dj = j == 0 ? d.x : j == 1 ? d.y : d.z;
            srp_vec3 column = srp_vec3_scale(3.0 * k * dj / r2, d);
            srp_mat3_add_column(sum->da_dr, j, srp_vec3_add_scaled(column, -k, srp_axis(j)));
        }
    }
}

static int central_eval(const void *user, const srp_force_state *state, srp_force_sum *sum) {
    attract(((const point *)user)->mu, state->r, sum);
    return 0;
}

static int point_eval(const void *user, const srp_force_state *state, srp_force_sum *sum) {
    const point *p = user;
    const srp_vec3 at = state->bodies[p->body];
    const double r = srp_vec3_norm(at);
    attract(p->mu, srp_vec3_sub(state->r, at), sum);
    sum->a = srp_vec3_add_scaled(sum->a, -p->mu / (r * r * r), at);
    return 0;
}

static srp_status make_point(double mu, srp_celestial body, const char *name,
                             int (*eval)(const void *, const srp_force_state *, srp_force_sum *),
                             srp_force *out, srp_error *error) {
    if (!(mu > 0.0 && isfinite(mu))) {
        return srp_fail(error, SRP_BAD_ARGUMENT,
                        "a gravitational parameter of %g m^3/s^2, expected above 0", mu);
    }
    point *p = malloc(sizeof *p);
    if (p == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a force");
    }
    p->mu = mu;
    p->body = body;
    *out = (srp_force){name, SRP_FORCE_PARTIALS, eval, free, p};
    return SRP_OK;
}

srp_status srp_force_central(double mu, srp_force *out, srp_error *error) {
    return make_point(mu, SRP_EARTH, "central", central_eval, out, error);
}

srp_status srp_force_point_mass(srp_celestial body, double mu, srp_force *out, srp_error *error) {
    const srp_celestial_info *info = srp_celestial_get(body);
    if (info == NULL) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "there is no body %d", (int)body);
    }
    return make_point(mu, body, info->name, point_eval, out, error);
}

/* ---- Spherical harmonics -------------------------------------------------------------------- */

typedef struct harmonics {
    const srp_gravity *field;
    const srp_ephemeris *ephemeris;
} harmonics;

static srp_vec3 harmonics_at(const harmonics *h, const double axes[3][3], srp_vec3 r) {
    return srp_mat3_apply_transposed(axes, srp_gravity_eval(h->field, srp_mat3_apply(axes, r)));
}

static int harmonics_eval(const void *user, const srp_force_state *state, srp_force_sum *sum) {
    const harmonics *h = user;
    double axes[3][3];
    srp_ephemeris_earth_axes(h->ephemeris, state->t, axes);
    sum->a = srp_vec3_add(sum->a, harmonics_at(h, (const double(*)[3])axes, state->r));
    if (sum->partials) {
        /* Central differences: what is cut off is of the order of 1e-10 of the gradient, and so is
         * what rounding adds. */
        const double step = 1e-5 * srp_vec3_norm(state->r);
        for (int j = 0; j < 3; ++j) {
            srp_vec3 up = harmonics_at(h, (const double(*)[3])axes,
                                       srp_vec3_add_scaled(state->r, step, srp_axis(j)));
            srp_vec3 down = harmonics_at(h, (const double(*)[3])axes,
                                         srp_vec3_add_scaled(state->r, -step, srp_axis(j)));
            srp_mat3_add_column(sum->da_dr, j, srp_vec3_scale(0.5 / step, srp_vec3_sub(up, down)));
        }
    }
    return 0;
}

srp_status srp_force_gravity(const srp_gravity *field, const srp_ephemeris *ephemeris,
                             srp_force *out, srp_error *error) {
    harmonics *h = malloc(sizeof *h);
    if (h == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a force");
    }
    h->field = field;
    h->ephemeris = ephemeris;
    *out = (srp_force){"gravity", SRP_FORCE_PARTIALS, harmonics_eval, free, h};
    return SRP_OK;
}

/* ---- Lists ---------------------------------------------------------------------------------- */

struct srp_force_list {
    const srp_ephemeris *ephemeris;
    srp_celestial central;
    srp_force *forces;
    size_t count, capacity;
};

srp_status srp_force_list_create(const srp_ephemeris *ephemeris, srp_celestial central,
                                 srp_force_list **out, srp_error *error) {
    if ((unsigned)central >= SRP_CELESTIAL_COUNT ||
        !srp_vec3_is_finite(srp_ephemeris_position(ephemeris, central, 0.0))) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "the central body is not in the ephemeris");
    }
    srp_force_list *list = calloc(1, sizeof *list);
    if (list == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a list of forces");
    }
    list->ephemeris = ephemeris;
    list->central = central;
    *out = list;
    return SRP_OK;
}

void srp_force_list_destroy(srp_force_list *list) {
    if (list != NULL) {
        for (size_t i = 0; i < list->count; ++i) {
            srp_force_release(&list->forces[i]);
        }
        free(list->forces);
        free(list);
    }
}

srp_status srp_force_list_add(srp_force_list *list, const srp_force *force, srp_error *error) {
    if (list->count == list->capacity) {
        const size_t capacity = 2 * list->capacity + 4;
        srp_force *grown = realloc(list->forces, capacity * sizeof *grown);
        if (grown == NULL) {
            return srp_fail(error, SRP_NO_MEMORY, "no memory for %zu forces", capacity);
        }
        list->forces = grown;
        list->capacity = capacity;
    }
    list->forces[list->count++] = *force;
    return SRP_OK;
}

size_t srp_force_list_count(const srp_force_list *list) {
    return list->count;
}

const srp_force *srp_force_list_get(const srp_force_list *list, size_t index) {
    return index < list->count ? &list->forces[index] : NULL;
}

const srp_ephemeris *srp_force_list_ephemeris(const srp_force_list *list) {
    return list->ephemeris;
}

srp_celestial srp_force_list_central(const srp_force_list *list) {
    return list->central;
}

int srp_force_list_eval(const srp_force_list *list, double t, srp_vec3 r, srp_vec3 v,
                        srp_force_sum *sum, srp_vec3 *radiation) {
    srp_vec3 bodies[SRP_CELESTIAL_COUNT], light = {0, 0, 0};
    srp_ephemeris_positions(list->ephemeris, list->central, t, bodies);
    const srp_force_state state = {t, r, v, bodies};
    const bool partials = sum->partials;
    memset(sum, 0, sizeof *sum);
    sum->partials = partials;
    for (size_t i = 0; i < list->count; ++i) {
        const srp_force *force = &list->forces[i];
        const srp_vec3 before = sum->a;
        if ((force->flags & SRP_FORCE_RADIATION) != 0) {
            /* Summed apart, so that it is not what is left of a difference of large numbers. */
            sum->a = srp_vec3_make(0.0, 0.0, 0.0);
        }
        int code = force->eval(force->user, &state, sum);
        if (code != 0) {
            return code;
        }
        if ((force->flags & SRP_FORCE_RADIATION) != 0) {
            light = srp_vec3_add(light, sum->a);
            sum->a = srp_vec3_add(before, sum->a);
        }
    }
    if (radiation != NULL) {
        *radiation = light;
    }
    return 0;
}
