/* SPDX-License-Identifier: Apache-2.0 */
/* Attitudes from a CCSDS Attitude Ephemeris Message (504.0-B-1 and -2, key-value notation). */
#include "error.h"
#include "mat3.h"
#include "platform.h"
#include "text.h"

#include <srp/orbit/attitude.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct node {
    double t;
    double q[4]; /* inertial to body, scalar last */
} node;

typedef struct aem {
    node *nodes;
    size_t count, capacity;
} aem;

/* What the META section of a segment says. */
typedef struct meta {
    srp_time_scale scale;
    bool has_scale, scalar_first, inertial_is_b, b_to_a, is_quaternion;
    char frame[2][64];
} meta;

static void aem_destroy(void *user) {
    aem *a = user;
    if (a != NULL) {
        free(a->nodes);
        free(a);
    }
}

static int aem_eval(const void *user, const srp_force_state *state, double matrix[3][3]) {
    const aem *a = user;
    const double t = state->t;
    /* A step of an integrator that ends with the file may look a rounding error past it. */
    const double slack = 1e-6;
    if (!(t >= a->nodes[0].t - slack && t <= a->nodes[a->count - 1].t + slack)) {
        return -1;
    }
    size_t low = 0, high = a->count - 1;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        *(t < a->nodes[middle].t ? &high : &low) = middle;
    }
    const node *from = &a->nodes[low], *to = &a->nodes[high];
    double dot = 0.0, q[4];
    for (int i = 0; i < 4; ++i) {
        dot += from->q[i] * to->q[i];
    }
    const double share = low == high ? 0.0 : (t - from->t) / (to->t - from->t);
    const double angle = acos(fmin(1.0, fabs(dot))), sine = sin(angle);
    double k0 = 1.0 - share, k1 = share;
    if (sine > 1e-9) {
        k0 = sin((1.0 - share) * angle) / sine;
        k1 = sin(share * angle) / sine;
    }
    double norm = 0.0;
    for (int i = 0; i < 4; ++i) {
        q[i] = k0 * from->q[i] + (dot < 0.0 ? -k1 : k1) * to->q[i];
        norm += q[i] * q[i];
    }
    norm = sqrt(norm);
    for (int i = 0; i < 4; ++i) {
        q[i] /= norm;
    }
    srp_attitude_matrix_of_quaternion(q, matrix);
    return 0;
}

/* ---- Reading --------------------------------------------------------------------------------- */

static bool frame_is_inertial(const char *name) {
    static const char *const NAMES[] = {"EME2000", "ICRF", "GCRF", "J2000"};
    for (size_t i = 0; i < sizeof NAMES / sizeof NAMES[0]; ++i) {
        if (strcmp(name, NAMES[i]) == 0) {
            return true;
        }
    }
    return false;
}

static void copy_token(srp_token token, char *out, size_t size) {
    const size_t n = token.size < size ? token.size : size - 1;
    memcpy(out, token.text, n);
    out[n] = '\0';
}

static srp_status read_meta_key(const srp_text *text, srp_token key, srp_token value, meta *out,
                                srp_error *error) {
    char word[64];
    copy_token(value, word, sizeof word);
    if (srp_token_is(key, "REF_FRAME_A") || srp_token_is(key, "REF_FRAME_B")) {
        memcpy(out->frame[srp_token_is(key, "REF_FRAME_B")], word, sizeof word);
    } else if (srp_token_is(key, "ATTITUDE_DIR")) {
        if (strcmp(word, "A2B") != 0 && strcmp(word, "B2A") != 0) {
            return srp_text_expected(text, value, "A2B or B2A", error);
        }
        out->b_to_a = word[0] == 'B';
    } else if (srp_token_is(key, "TIME_SYSTEM")) {
        if (!srp_time_scale_find(word, &out->scale)) {
            return srp_text_expected(text, value, "UTC, TAI, TT or TDB", error);
        }
        out->has_scale = true;
    } else if (srp_token_is(key, "ATTITUDE_TYPE")) {
        out->is_quaternion = strcmp(word, "QUATERNION") == 0;
        if (!out->is_quaternion) {
            return srp_fail_at(error, SRP_UNSUPPORTED, text->name, value.line, value.column,
                               "attitude type %s, only QUATERNION is read", word);
        }
    } else if (srp_token_is(key, "QUATERNION_TYPE")) {
        out->scalar_first = strcmp(word, "FIRST") == 0;
        if (!out->scalar_first && strcmp(word, "LAST") != 0) {
            return srp_text_expected(text, value, "FIRST or LAST", error);
        }
    }
    return SRP_OK;
}

/* All lines up to META_STOP. */
static srp_status read_meta(srp_text *text, meta *out, srp_error *error) {
    memset(out, 0, sizeof *out);
    while (srp_text_next_line(text)) {
        srp_token key, equals;
        srp_text_next_token(text, &key);
        if (srp_token_is(key, "META_STOP")) {
            const bool first = frame_is_inertial(out->frame[0]);
            if (!out->has_scale || !out->is_quaternion) {
                return srp_text_expected(
                    text, key, "TIME_SYSTEM and ATTITUDE_TYPE before the end of META", error);
            }
            if (first == frame_is_inertial(out->frame[1])) {
                return srp_fail_at(error, SRP_UNSUPPORTED, text->name, key.line, key.column,
                                   "frames '%s' and '%s', expected one of EME2000, ICRF, GCRF, "
                                   "J2000, and the spacecraft's",
                                   out->frame[0], out->frame[1]);
            }
            out->inertial_is_b = !first;
            return SRP_OK;
        }
        if (srp_token_is(key, "COMMENT")) {
            continue;
        }
        if (!srp_text_next_token(text, &equals) || !srp_token_is(equals, "=")) {
            return srp_text_expected(text, equals, "KEY = VALUE", error);
        }
        srp_status status = read_meta_key(text, key, srp_text_rest(text), out, error);
        if (status != SRP_OK) {
            return status;
        }
    }
    return srp_fail_at(error, SRP_BAD_FORMAT, text->name, text->line, 0,
                       "the file ends within META");
}

static srp_status add_node(aem *a, const node *n, srp_error *error) {
    if (a->count == a->capacity) {
        const size_t capacity = 2 * a->capacity + 16;
        node *grown = realloc(a->nodes, capacity * sizeof *grown);
        if (grown == NULL) {
            return srp_fail(error, SRP_NO_MEMORY, "no memory for %zu quaternions", capacity);
        }
        a->nodes = grown;
        a->capacity = capacity;
    }
    a->nodes[a->count++] = *n;
    return SRP_OK;
}

/* A line of the data: an epoch, then four numbers. */
static srp_status read_row(srp_text *text, srp_token when, const meta *m, srp_epoch epoch, aem *a,
                           srp_error *error) {
    char date[64];
    node n;
    srp_epoch instant;
    srp_error why;
    double value[4], norm = 0.0;
    copy_token(when, date, sizeof date);
    if (srp_epoch_parse_in(date, m->scale, &instant, NULL, &why) != SRP_OK) {
        return srp_fail_at(error, why.status, text->name, when.line, when.column, "%s",
                           why.message);
    }
    n.t = srp_epoch_difference(instant, epoch);
    for (int i = 0; i < 4; ++i) {
        srp_status status =
            srp_text_double(text, "a component of the quaternion", &value[i], NULL, error);
        if (status != SRP_OK) {
            return status;
        }
        norm += value[i] * value[i];
    }
    norm = sqrt(norm);
    /* The standard's quaternion of unit length; rounding of a few digits is let pass. */
    if (!(fabs(norm - 1.0) < 1e-2)) {
        return srp_fail_at(error, SRP_BAD_DATA, text->name, when.line, when.column,
                           "a quaternion of length %g, expected 1", norm);
    }
    if (a->count > 0 && !(n.t > a->nodes[a->count - 1].t)) {
        return srp_fail_at(error, SRP_BAD_DATA, text->name, when.line, when.column,
                           "an epoch that is not after the one before");
    }
    for (int i = 0; i < 4; ++i) {
        n.q[i] = value[m->scalar_first ? (i + 1) % 4 : i] / norm;
    }
    if (m->inertial_is_b != m->b_to_a) { /* it turns the body's axes into inertial ones */
        n.q[0] = -n.q[0];
        n.q[1] = -n.q[1];
        n.q[2] = -n.q[2];
    }
    srp_status status = add_node(a, &n, error);
    return status == SRP_OK ? srp_text_end_of_line(text, error) : status;
}

static srp_status read_all(srp_text *text, srp_epoch epoch, aem *a, srp_error *error) {
    meta m;
    bool have_meta = false;
    srp_status status = SRP_OK;
    while (status == SRP_OK && srp_text_next_line(text)) {
        srp_token word;
        srp_text_next_token(text, &word);
        if (text->line == 1 && !srp_token_is(word, "CCSDS_AEM_VERS")) {
            return srp_text_expected(text, word, "CCSDS_AEM_VERS", error);
        }
        if (srp_token_is(word, "META_START")) {
            status = read_meta(text, &m, error);
            have_meta = true;
        } else if (have_meta && !srp_token_is(word, "COMMENT") &&
                   !srp_token_is(word, "DATA_START") && !srp_token_is(word, "DATA_STOP")) {
            status = read_row(text, word, &m, epoch, a, error);
        }
    }
    if (status == SRP_OK && a->count < 2) {
        return srp_fail_at(error, SRP_BAD_FORMAT, text->name, text->line, 0,
                           "%zu quaternions, expected 2 or more", a->count);
    }
    return status;
}

srp_status srp_attitude_aem_parse(const char *bytes, size_t size, const char *name, srp_epoch epoch,
                                  srp_attitude *out, srp_error *error) {
    srp_text text;
    srp_status status = srp_text_open(&text, bytes, size, name, 0, error);
    if (status != SRP_OK) {
        return status;
    }
    aem *a = calloc(1, sizeof *a);
    if (a == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for an attitude");
    }
    srp_c_locale locale = srp_platform_c_locale_enter();
    status = read_all(&text, epoch, a, error);
    srp_platform_c_locale_leave(locale);
    if (status != SRP_OK) {
        aem_destroy(a);
        return status;
    }
    *out = (srp_attitude){"aem", 0, aem_eval, aem_destroy, a};
    return SRP_OK;
}

srp_status srp_attitude_aem_read(const char *path, srp_epoch epoch, srp_attitude *out,
                                 srp_error *error) {
    char *bytes;
    size_t size;
    srp_status status = srp_text_read_file(path, &bytes, &size, error);
    if (status == SRP_OK) {
        status = srp_attitude_aem_parse(bytes, size, path, epoch, out, error);
        free(bytes);
    }
    return status;
}
