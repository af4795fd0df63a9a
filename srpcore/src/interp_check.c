/* SPDX-License-Identifier: Apache-2.0 */
/* The error of interpolants, against responses that are known. */
#include "error.h"
#include "interp_internal.h"
#include "seed.h"

#include <srp/const.h>

#include <math.h>

void srp_interp_directions(size_t count, uint64_t seed, srp_vec3 *s_body) {
    /* 1/g and 1/g^2 with g^3 = g + 1. */
    const double step[2] = {0.7548776662466927, 0.5698402909980532};
    const double shift[2] = {srp_seed_unit(srp_seed_mix(seed, 0x5eedc0de5eedc0deu)),
                             srp_seed_unit(srp_seed_mix(seed, 0x0ff6271d0ff6271du))};
    for (size_t k = 0; k < count; ++k) {
        double n = (double)(k + 1), whole;
        double u = modf(shift[0] + n * step[0], &whole), v = modf(shift[1] + n * step[1], &whole);
        double az = 2.0 * SRP_PI * u, z = 2.0 * v - 1.0, h = sqrt(fmax(0.0, 1.0 - z * z));
        srp_vec3 s = srp_vec3_make(h * cos(az), h * sin(az), z);
        s_body[k] = srp_vec3_scale(1.0 / srp_vec3_norm(s), s);
    }
}

static srp_status measure(const srp_interp *interp, size_t count, const srp_vec3 *s_body,
                          const srp_response *responses, srp_table_error *out, srp_error *error) {
    srp_table_error sum = {0.0, 0.0, 0.0, 0.0};
    for (size_t k = 0; k < count; ++k) {
        srp_vec3 f, t;
        srp_status status = srp_interp_eval(interp, s_body[k], &f, &t, NULL, error);
        if (status != SRP_OK) {
            return status;
        }
        double f_off = srp_vec3_norm(srp_vec3_sub(f, responses[k].f)), t_off = 0.0;
        if (srp_interp_has_moment(interp)) {
            t_off = srp_vec3_norm(srp_vec3_sub(t, responses[k].t));
        }
        sum.f_mean += f_off / (double)count;
        sum.t_mean += t_off / (double)count;
        sum.f_max = fmax(sum.f_max, f_off);
        sum.t_max = fmax(sum.t_max, t_off);
    }
    *out = sum;
    return SRP_OK;
}

/* Whether a grid is too coarse for a scheme, which says nothing against the others. */
static bool is_too_coarse(const srp_interp_scheme *scheme, srp_grid grid) {
    return grid.az_count - 1 < scheme->steps_min || 2 * (grid.el_count - 1) < scheme->steps_min;
}

srp_status srp_interp_check(const srp_table *table, size_t count, const srp_vec3 *s_body,
                            const srp_response *responses, uint64_t seed, srp_table_check *out,
                            srp_error *error) {
    size_t schemes;
    const srp_interp_scheme *const *list = srp_interp_list(&schemes);
    srp_table_check check = {.count = (uint32_t)count, .seed = seed};
    if (count == 0 || count > UINT32_MAX) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "%zu directions to check, expected 1 to %lu",
                        count, (unsigned long)UINT32_MAX);
    }
    for (size_t k = 0; k < schemes; ++k) {
        if (is_too_coarse(list[k], srp_table_grid(table))) {
            check.errors[k] = (srp_table_error){NAN, NAN, NAN, NAN};
            continue;
        }
        srp_interp *interp = NULL;
        srp_status status = srp_interp_create(list[k], table, &interp, error);
        if (status == SRP_OK) {
            status = measure(interp, count, s_body, responses, &check.errors[k], error);
            srp_interp_destroy(interp);
        }
        if (status != SRP_OK) {
            return status;
        }
    }
    *out = check;
    return SRP_OK;
}
