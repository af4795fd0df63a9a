/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"
#include "mat3.h"

#include <srp/const.h>
#include <srp/orbit/ephemeris.h>

#include <erfa.h>
#include <erfam.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* GM: E. M. Standish, "JPL Planetary and Lunar Ephemerides, DE405/LE405"; Earth and Moon as GMAT
 * R2020a has them. Radii: GMAT R2020a. */
static const srp_celestial_info WORLDS[SRP_CELESTIAL_COUNT] = {
    [SRP_SUN] = {"sun", 132712440017.99e9, 695990e3},
    [SRP_MERCURY] = {"mercury", 22032.080486418e9, 2439.7e3},
    [SRP_VENUS] = {"venus", 324858.59882646e9, 6051.9e3},
    [SRP_EARTH] = {"earth", 398600.4415e9, 6378.1363e3},
    [SRP_MARS] = {"mars", 42828.314258067e9, 3397.0e3},
    [SRP_JUPITER] = {"jupiter", 126712767.85780e9, 71492.0e3},
    [SRP_SATURN] = {"saturn", 37940626.061137e9, 60268.0e3},
    [SRP_URANUS] = {"uranus", 5794549.0070719e9, 25559.0e3},
    [SRP_NEPTUNE] = {"neptune", 6836534.0638793e9, 25269.0e3},
    [SRP_MOON] = {"moon", 4902.8005821478e9, 1738.2e3},
};

const srp_celestial_info *srp_celestial_get(srp_celestial body) {
    return (unsigned)body < SRP_CELESTIAL_COUNT ? &WORLDS[body] : NULL;
}

bool srp_celestial_find(const char *name, srp_celestial *out) {
    for (int i = 0; i < SRP_CELESTIAL_COUNT; ++i) {
        if (strcmp(name, WORLDS[i].name) == 0) {
            *out = (srp_celestial)i;
            return true;
        }
    }
    return false;
}

/* ---- The series ------------------------------------------------------------------------------ */

static srp_vec3 from_au(const double pv[2][3]) {
    return srp_vec3_make(pv[0][0] * ERFA_DAU, pv[0][1] * ERFA_DAU, pv[0][2] * ERFA_DAU);
}

/* Geocentric, but for planets heliocentric: that is what is smooth. */
static srp_vec3 series(srp_celestial body, srp_epoch when) {
    double jd, fraction, pv[2][3], barycentric[2][3];
    srp_epoch_julian(when, SRP_TIME_TDB, &jd, &fraction);
    switch (body) {
    case SRP_SUN:
        eraEpv00(jd, fraction, pv, barycentric);
        return srp_vec3_scale(-1.0, from_au((const double(*)[3])pv));
    case SRP_MOON:
        eraMoon98(jd, fraction, pv);
        return from_au((const double(*)[3])pv);
    case SRP_EARTH:
        return srp_vec3_make(0.0, 0.0, 0.0);
    default:
        eraPlan94(jd, fraction, (int)body, pv);
        return from_au((const double(*)[3])pv);
    }
}

/* Celestial pole X, Y [rad] and the CIO locator s [rad]. */
static srp_vec3 pole_series(srp_epoch when) {
    double jd, fraction;
    srp_vec3 out;
    srp_epoch_julian(when, SRP_TIME_TT, &jd, &fraction);
    eraXys06a(jd, fraction, &out.x, &out.y, &out.z);
    return out;
}

/* ---- Chebyshev polynomials ------------------------------------------------------------------- */

enum { TERMS = 14, POLE = SRP_CELESTIAL_COUNT, CURVES = SRP_CELESTIAL_COUNT + 1 };

/* One vector over the span: (segments, TERMS) coefficients. */
typedef struct curve {
    double length; /* of a segment [s] */
    size_t segments;
    srp_vec3 *terms; /* NULL: not there */
} curve;

struct srp_ephemeris {
    srp_ephemeris_params params;
    curve curves[CURVES];
};

static srp_vec3 sum_series(const srp_ephemeris *ephemeris, int which, double t) {
    const srp_epoch when = srp_epoch_add(ephemeris->params.epoch, t);
    return which == POLE ? pole_series(when) : series((srp_celestial)which, when);
}

/* Interpolation at the zeros of T_14. */
static void fit_segment(const srp_ephemeris *ephemeris, int which, double middle, double half,
                        srp_vec3 *terms) {
    srp_vec3 value[TERMS];
    for (int k = 0; k < TERMS; ++k) {
        value[k] = sum_series(ephemeris, which, middle + half * cos(SRP_PI * (k + 0.5) / TERMS));
    }
    for (int j = 0; j < TERMS; ++j) {
        srp_vec3 sum = {0, 0, 0};
        for (int k = 0; k < TERMS; ++k) {
            sum = srp_vec3_add_scaled(sum, cos(SRP_PI * j * (k + 0.5) / TERMS), value[k]);
        }
        terms[j] = srp_vec3_scale((j == 0 ? 1.0 : 2.0) / TERMS, sum);
    }
}

/* Days that 14 terms are good for. */
static double segment_days(int which) {
    switch (which) {
    case SRP_SUN: /* the Earth's own way around the barycentre with the Moon is in it */
        return 4.0;
    case SRP_MOON:
    case POLE:
        return 1.0;
    case SRP_MERCURY:
        return 4.0;
    default:
        return 8.0;
    }
}

static srp_status fit(srp_ephemeris *ephemeris, int which, srp_error *error) {
    curve *c = &ephemeris->curves[which];
    const double span = ephemeris->params.end - ephemeris->params.begin;
    c->length = fmin(segment_days(which) * 86400.0, span);
    c->segments = (size_t)ceil(span / c->length);
    c->terms = malloc(c->segments * TERMS * sizeof *c->terms);
    if (c->terms == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for %zu segments of an ephemeris",
                        c->segments);
    }
    for (size_t i = 0; i < c->segments; ++i) {
        const double middle = ephemeris->params.begin + ((double)i + 0.5) * c->length;
        fit_segment(ephemeris, which, middle, 0.5 * c->length, c->terms + i * TERMS);
    }
    return SRP_OK;
}

/* Clenshaw's recurrence. */
static srp_vec3 evaluate(const srp_ephemeris *ephemeris, int which, double t) {
    const curve *c = &ephemeris->curves[which];
    const double at = (t - ephemeris->params.begin) / c->length;
    if (!(at >= 0.0 && at <= (double)c->segments)) {
        return sum_series(ephemeris, which, t);
    }
    size_t i = (size_t)at;
    i = i < c->segments ? i : c->segments - 1;
    const srp_vec3 *terms = c->terms + i * TERMS;
    const double x = 2.0 * (at - (double)i) - 1.0;
    srp_vec3 b1 = {0, 0, 0}, b2 = {0, 0, 0};
    for (int j = TERMS - 1; j > 0; --j) {
        srp_vec3 b = srp_vec3_add(terms[j], srp_vec3_sub(srp_vec3_scale(2.0 * x, b1), b2));
        b2 = b1;
        b1 = b;
    }
    return srp_vec3_add(terms[0], srp_vec3_sub(srp_vec3_scale(x, b1), b2));
}

/* ---- Interface ------------------------------------------------------------------------------- */

srp_ephemeris_params srp_ephemeris_params_default(srp_epoch epoch) {
    srp_ephemeris_params params = {
        .epoch = epoch, .begin = 0.0, .end = 86400.0, .bodies = 1u << SRP_SUN};
    return params;
}

static const double SPAN_MAX = 200.0 * 365.25 * 86400.0;

srp_status srp_ephemeris_create(const srp_ephemeris_params *params, srp_ephemeris **out,
                                srp_error *error) {
    const double span = params->end - params->begin;
    if (!(span > 0.0 && span <= SPAN_MAX)) {
        return srp_fail(error, SRP_BAD_ARGUMENT,
                        "a span of %g s for an ephemeris, expected above 0 and at most 200 years",
                        span);
    }
    srp_ephemeris *ephemeris = calloc(1, sizeof *ephemeris);
    if (ephemeris == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for an ephemeris");
    }
    ephemeris->params = *params;
    ephemeris->params.bodies |= 1u << SRP_SUN | 1u << SRP_EARTH;
    srp_status status = SRP_OK;
    for (int which = 0; status == SRP_OK && which < CURVES; ++which) {
        bool wanted = which == POLE ? params->orientation
                                    : which != SRP_EARTH && (ephemeris->params.bodies >> which & 1);
        if (wanted) {
            status = fit(ephemeris, which, error);
        }
    }
    if (status != SRP_OK) {
        srp_ephemeris_destroy(ephemeris);
        return status;
    }
    *out = ephemeris;
    return SRP_OK;
}

void srp_ephemeris_destroy(srp_ephemeris *ephemeris) {
    if (ephemeris != NULL) {
        for (int which = 0; which < CURVES; ++which) {
            free(ephemeris->curves[which].terms);
        }
        free(ephemeris);
    }
}

srp_epoch srp_ephemeris_epoch(const srp_ephemeris *ephemeris) {
    return ephemeris->params.epoch;
}

srp_vec3 srp_ephemeris_position(const srp_ephemeris *ephemeris, srp_celestial body, double t) {
    if (body == SRP_EARTH) {
        return srp_vec3_make(0.0, 0.0, 0.0);
    }
    if ((unsigned)body >= SRP_CELESTIAL_COUNT || ephemeris->curves[body].terms == NULL) {
        return srp_vec3_make(NAN, NAN, NAN);
    }
    srp_vec3 r = evaluate(ephemeris, (int)body, t);
    return body == SRP_SUN || body == SRP_MOON
               ? r
               : srp_vec3_add(r, srp_ephemeris_position(ephemeris, SRP_SUN, t));
}

void srp_ephemeris_positions(const srp_ephemeris *ephemeris, srp_celestial central, double t,
                             srp_vec3 out[SRP_CELESTIAL_COUNT]) {
    for (int body = 0; body < SRP_CELESTIAL_COUNT; ++body) {
        out[body] = (ephemeris->params.bodies >> body & 1) != 0
                        ? srp_ephemeris_position(ephemeris, (srp_celestial)body, t)
                        : srp_vec3_make(NAN, NAN, NAN);
    }
    if (central != SRP_EARTH) {
        const srp_vec3 origin = out[central];
        for (int body = 0; body < SRP_CELESTIAL_COUNT; ++body) {
            out[body] = srp_vec3_sub(out[body], origin);
        }
    }
}

void srp_ephemeris_earth_axes(const srp_ephemeris *ephemeris, double t, double matrix[3][3]) {
    if (ephemeris->curves[POLE].terms == NULL) {
        for (int i = 0; i < 9; ++i) {
            matrix[i / 3][i % 3] = NAN;
        }
        return;
    }
    const srp_ephemeris_params *params = &ephemeris->params;
    const srp_epoch when = srp_epoch_add(params->epoch, t);
    const srp_vec3 pole = evaluate(ephemeris, POLE, t);
    double celestial[3][3], polar[3][3], jd, fraction;
    eraC2ixys(pole.x, pole.y, pole.z, celestial);
    srp_epoch_julian(when, SRP_TIME_TT, &jd, &fraction);
    eraPom00(params->pole_x, params->pole_y, eraSp00(jd, fraction), polar);
    srp_epoch_julian(when, SRP_TIME_UTC, &jd, &fraction);
    eraC2tcio(celestial, eraEra00(jd, fraction + params->ut1_minus_utc / 86400.0), polar, matrix);
}
