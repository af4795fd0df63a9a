/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"
#include "platform.h"
#include "text.h"

#include <srp/orbit/gravity.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Where degree n, order m lies in a triangle. */
static size_t at(unsigned n, unsigned m) {
    return (size_t)n * (n + 1) / 2 + m;
}

enum { TRIANGLE_MAX = (SRP_GRAVITY_DEGREE_MAX + 2) * (SRP_GRAVITY_DEGREE_MAX + 3) / 2 };

/* Of one term: fully normalised coefficients, and the factors of the sums and recursions. */
typedef struct term {
    double c, s;
    double up, down, along; /* V(n+1, m+1), V(n+1, m-1), V(n+1, m) in the acceleration */
} term;

struct srp_gravity {
    double mu, radius;
    unsigned degree, order;
    term *terms;        /* (degree, order) */
    double (*steps)[2]; /* of V(n, m) from V(n-1, m) and V(n-2, m), up to degree + 1 */
};

double srp_gravity_mu(const srp_gravity *gravity) {
    return gravity->mu;
}

double srp_gravity_radius(const srp_gravity *gravity) {
    return gravity->radius;
}

void srp_gravity_destroy(srp_gravity *gravity) {
    if (gravity != NULL) {
        free(gravity->terms);
        free(gravity->steps);
        free(gravity);
    }
}

/* ---- Evaluation ------------------------------------------------------------------------------ */

/* Normalised V and W (Montenbruck and Gill 3.29 to 3.31, times sqrt of their norms). */
static void solid_harmonics(const srp_gravity *g, srp_vec3 r, double *v, double *w) {
    const double r2 = srp_vec3_dot(r, r), rho = g->radius * g->radius / r2;
    const double x = r.x * g->radius / r2, y = r.y * g->radius / r2, z = r.z * g->radius / r2;
    const unsigned top = g->degree + 1;
    const unsigned last = g->order + 1 < top ? g->order + 1 : top;
    v[0] = g->radius / sqrt(r2);
    w[0] = 0.0;
    for (unsigned m = 0; m <= last; ++m) {
        if (m > 0) {
            const double k = m == 1 ? sqrt(3.0) : sqrt((2.0 * m + 1.0) / (2.0 * m));
            const double vp = v[at(m - 1, m - 1)], wp = w[at(m - 1, m - 1)];
            v[at(m, m)] = k * (x * vp - y * wp);
            w[at(m, m)] = k * (x * wp + y * vp);
        }
        for (unsigned n = m + 1; n <= top; ++n) {
            const double *step = g->steps[at(n, m)];
            const size_t here = at(n, m), one = at(n - 1, m);
            v[here] = step[0] * z * v[one];
            w[here] = step[0] * z * w[one];
            if (n > m + 1) {
                const size_t two = at(n - 2, m);
                v[here] -= step[1] * rho * v[two];
                w[here] -= step[1] * rho * w[two];
            }
        }
    }
}

srp_vec3 srp_gravity_eval(const srp_gravity *g, srp_vec3 r) {
    double v[TRIANGLE_MAX], w[TRIANGLE_MAX];
    srp_vec3 a = {0, 0, 0};
    solid_harmonics(g, r, v, w);
    /* Small terms first; Montenbruck and Gill 3.32, 3.33. */
    for (unsigned n = g->degree + 1; n-- > 0;) {
        const unsigned last = n < g->order ? n : g->order;
        for (unsigned m = 0; m <= last; ++m) {
            const term *k = &g->terms[at(n, m)];
            const size_t up = at(n + 1, m + 1), along = at(n + 1, m);
            a.z -= k->along * (k->c * v[along] + k->s * w[along]);
            if (m == 0) {
                a.x -= k->up * k->c * v[up];
                a.y -= k->up * k->c * w[up];
            } else {
                const size_t down = at(n + 1, m - 1);
                a.x += 0.5 * (-k->up * (k->c * v[up] + k->s * w[up]) +
                              k->down * (k->c * v[down] + k->s * w[down]));
                a.y += 0.5 * (k->up * (k->s * v[up] - k->c * w[up]) +
                              k->down * (k->s * v[down] - k->c * w[down]));
            }
        }
    }
    return srp_vec3_scale(g->mu / (g->radius * g->radius), a);
}

/* ---- Set-up ---------------------------------------------------------------------------------- */

static void set_factors(srp_gravity *g) {
    for (unsigned n = 0; n <= g->degree + 1; ++n) {
        for (unsigned m = 0; m <= n; ++m) {
            const double N = n, M = m;
            if (n > m) {
                double *step = g->steps[at(n, m)];
                step[0] = sqrt((2 * N + 1) * (2 * N - 1) / ((N - M) * (N + M)));
                step[1] = n > m + 1 ? sqrt((2 * N + 1) * (N + M - 1) * (N - M - 1) /
                                           ((2 * N - 3) * (N + M) * (N - M)))
                                    : 0.0;
            }
            if (n <= g->degree) {
                term *k = &g->terms[at(n, m)];
                const double ratio = (2 * N + 1) / (2 * N + 3);
                k->up = sqrt((m == 0 ? 0.5 : 1.0) * ratio * (N + M + 2) * (N + M + 1));
                k->down = sqrt((m == 1 ? 2.0 : 1.0) * ratio * (N - M + 2) * (N - M + 1));
                k->along = sqrt(ratio * (N + M + 1) * (N - M + 1));
            }
        }
    }
}

static srp_status allocate(unsigned degree, unsigned order, srp_gravity **out, srp_error *error) {
    if (degree > SRP_GRAVITY_DEGREE_MAX || order > degree) {
        return srp_fail(error, SRP_BAD_ARGUMENT,
                        "degree %u and order %u, expected order <= degree <= %d", degree, order,
                        SRP_GRAVITY_DEGREE_MAX);
    }
    srp_gravity *g = calloc(1, sizeof *g);
    if (g != NULL) {
        g->degree = degree;
        g->order = order;
        g->terms = calloc(at(degree + 1, 0), sizeof *g->terms);
        g->steps = calloc(at(degree + 2, 0), sizeof *g->steps);
    }
    if (g == NULL || g->terms == NULL || g->steps == NULL) {
        srp_gravity_destroy(g);
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a gravity field of degree %u", degree);
    }
    *out = g;
    return SRP_OK;
}

/* ---- Reading ICGEM's format ------------------------------------------------------------------ */

typedef struct gfc {
    srp_gravity *g;
    bool unnormalised, has_mu, has_radius;
    unsigned highest; /* degree that was met */
    srp_tally left_out;
    const srp_log *log;
} gfc;

/* A number that may have Fortran's D for an exponent. */
static srp_status fortran_double(srp_text *text, const char *what, double *out, srp_error *error) {
    char copy[64];
    srp_token token;
    srp_text_next_token(text, &token);
    if (token.size == 0 || token.size >= sizeof copy) {
        return srp_token_double(text, token, what, out, error);
    }
    for (size_t i = 0; i < token.size; ++i) {
        copy[i] = token.text[i] == 'D' || token.text[i] == 'd' ? 'e' : token.text[i];
    }
    copy[token.size] = '\0';
    token.text = copy;
    return srp_token_double(text, token, what, out, error);
}

static srp_status read_positive(srp_text *text, const char *what, double *out, srp_error *error) {
    const size_t line = text->line;
    double value;
    srp_status status = fortran_double(text, what, &value, error);
    if (status == SRP_OK && !(value > 0.0)) {
        return srp_fail_at(error, SRP_BAD_DATA, text->name, line, 0, "%s is %g, expected above 0",
                           what, value);
    }
    if (status == SRP_OK) {
        *out = value;
    }
    return status;
}

static srp_status read_head_line(srp_text *text, gfc *file, srp_token key, srp_error *error) {
    srp_token word;
    if (srp_token_is(key, "earth_gravity_constant") || srp_token_is(key, "gravity_constant")) {
        file->has_mu = true;
        return read_positive(text, "the gravity constant", &file->g->mu, error);
    }
    if (srp_token_is(key, "radius")) {
        file->has_radius = true;
        return read_positive(text, "the radius", &file->g->radius, error);
    }
    if (srp_token_is(key, "norm")) {
        srp_text_next_token(text, &word);
        file->unnormalised = srp_token_is(word, "unnormalized");
        if (!file->unnormalised && !srp_token_is(word, "fully_normalized")) {
            return srp_text_expected(text, word, "fully_normalized or unnormalized", error);
        }
    }
    return SRP_OK;
}

/* Factor from unnormalised to fully normalised coefficients. */
static double normalising(unsigned n, unsigned m) {
    double product = 1.0;
    for (unsigned k = n - m + 1; k <= n + m; ++k) {
        product *= k;
    }
    return sqrt(product / ((m == 0 ? 1.0 : 2.0) * (2.0 * n + 1.0)));
}

static srp_status read_term(srp_text *text, gfc *file, srp_error *error) {
    int64_t n, m;
    double c, s;
    srp_status status = srp_text_integer(text, "the degree", 0, 100000, &n, NULL, error);
    if (status == SRP_OK) {
        status = srp_text_integer(text, "the order", 0, n, &m, NULL, error);
    }
    if (status == SRP_OK) {
        status = fortran_double(text, "coefficient C", &c, error);
    }
    if (status == SRP_OK) {
        status = fortran_double(text, "coefficient S", &s, error);
    }
    if (status != SRP_OK) {
        return status;
    }
    const unsigned degree = (unsigned)n, order = (unsigned)m;
    file->highest = degree > file->highest ? degree : file->highest;
    if (degree <= file->g->degree && order <= file->g->order) {
        const double k = file->unnormalised ? normalising(degree, order) : 1.0;
        file->g->terms[at(degree, order)].c = k * c;
        file->g->terms[at(degree, order)].s = k * s;
    }
    return SRP_OK;
}

static srp_status read_lines(srp_text *text, gfc *file, srp_error *error) {
    bool body = false;
    srp_status status = SRP_OK;
    while (status == SRP_OK && srp_text_next_line(text)) {
        srp_token key;
        srp_text_next_token(text, &key);
        if (!body) {
            body = srp_token_is(key, "end_of_head");
            status = read_head_line(text, file, key, error);
        } else if (srp_token_is(key, "gfc") || srp_token_is(key, "gfct")) {
            status = read_term(text, file, error);
        } else if (srp_tally_shows(&file->left_out)) {
            srp_warn_at(file->log, text->name, key.line, key.column,
                        "%s is left out: only the static field is used",
                        srp_token_excerpt(key).text);
        }
    }
    srp_tally_close(&file->left_out, file->log, text->name, "terms left out");
    if (status == SRP_OK && !(body && file->has_mu && file->has_radius)) {
        return srp_fail_at(error, SRP_BAD_FORMAT, text->name, text->line, 0,
                           "no head with earth_gravity_constant, radius and end_of_head: this is "
                           "no .gfc file");
    }
    if (status == SRP_OK && file->highest < file->g->degree) {
        return srp_fail_at(error, SRP_BAD_DATA, text->name, text->line, 0,
                           "the field ends with degree %u, expected %u", file->highest,
                           file->g->degree);
    }
    return status;
}

srp_status srp_gravity_parse(const char *bytes, size_t size, const char *name, unsigned degree,
                             unsigned order, const srp_log *log, srp_gravity **out,
                             srp_error *error) {
    srp_text text;
    gfc file = {.log = log};
    srp_status status = srp_text_open(&text, bytes, size, name, 0, error);
    if (status == SRP_OK) {
        status = allocate(degree, order, &file.g, error);
    }
    if (status != SRP_OK) {
        return status;
    }
    file.g->terms[0].c = 1.0; /* files may leave it out */
    srp_c_locale locale = srp_platform_c_locale_enter();
    status = read_lines(&text, &file, error);
    srp_platform_c_locale_leave(locale);
    if (status != SRP_OK) {
        srp_gravity_destroy(file.g);
        return status;
    }
    set_factors(file.g);
    *out = file.g;
    return SRP_OK;
}

srp_status srp_gravity_read(const char *path, unsigned degree, unsigned order, const srp_log *log,
                            srp_gravity **out, srp_error *error) {
    char *bytes;
    size_t size;
    srp_status status = srp_text_read_file(path, &bytes, &size, error);
    if (status == SRP_OK) {
        status = srp_gravity_parse(bytes, size, path, degree, order, log, out, error);
        free(bytes);
    }
    return status;
}
