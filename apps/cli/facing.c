/* SPDX-License-Identifier: Apache-2.0 */
#include "facing.h"

#include <srp/const.h>
#include <srp/method.h>

#include <math.h>
#include <stdlib.h>

/* ---- dominant normals ---- */

static const double GROUP_DEG = 10.0;
static const double AREA_SHARE = 0.95;

enum { GROUPS_MAX = 1024 };

typedef struct group {
    srp_vec3 seed; /* normal of its largest face */
    srp_vec3 sum;  /* of area times normal */
    double area;
} group;

static int larger_area(const void *a, const void *b) {
    const srp_face *p = a, *q = b;
    return p->area < q->area ? 1 : p->area > q->area ? -1 : 0;
}

static int larger_group(const void *a, const void *b) {
    const group *p = a, *q = b;
    if (p->area != q->area) {
        return p->area < q->area ? 1 : -1;
    }
    /* Equal areas: an order that does not depend on the sorting. */
    const double pv[3] = {p->seed.x, p->seed.y, p->seed.z};
    const double qv[3] = {q->seed.x, q->seed.y, q->seed.z};
    for (int k = 0; k < 3; ++k) {
        if (pv[k] != qv[k]) {
            return pv[k] < qv[k] ? 1 : -1;
        }
    }
    return 0;
}

static void add_face(group *groups, size_t *count, srp_vec3 normal, double area) {
    double nearest = -2.0;
    size_t at = 0;
    for (size_t k = 0; k < *count; ++k) {
        double cosine = srp_vec3_dot(groups[k].seed, normal);
        if (cosine > nearest) {
            nearest = cosine;
            at = k;
        }
    }
    if (nearest < cos(GROUP_DEG * SRP_RAD_PER_DEG) && *count < GROUPS_MAX) {
        at = (*count)++;
        groups[at] = (group){.seed = normal};
    }
    groups[at].sum = srp_vec3_add_scaled(groups[at].sum, area, normal);
    groups[at].area += area;
}

static size_t choose(const group *groups, size_t count, double total, size_t wanted,
                     srp_vec3 *normals, double *share) {
    size_t taken = 0;
    double area = 0.0;
    while (taken < count && taken < CLI_NORMALS_MAX) {
        /* Groups as large as the last one come along: the other side of a box. */
        bool like_last = taken > 0 && groups[taken].area > (1.0 - 1e-6) * groups[taken - 1].area;
        if (wanted > 0 ? taken == wanted : area >= AREA_SHARE * total && !like_last) {
            break;
        }
        srp_vec3 sum = groups[taken].sum;
        normals[taken] = srp_vec3_scale(1.0 / srp_vec3_norm(sum), sum);
        area += groups[taken].area;
        ++taken;
    }
    *share = area / total;
    return taken;
}

size_t cli_facing_normals(const srp_scene *scene, size_t wanted, srp_vec3 *normals, double *share) {
    size_t faces = srp_scene_facet_count(scene), count = 0, taken = 0;
    srp_face *face = calloc(faces, sizeof *face);
    group *groups = calloc(GROUPS_MAX, sizeof *groups);
    double total = 0.0;
    if (face != NULL && groups != NULL) {
        for (size_t k = 0; k < faces; ++k) {
            face[k] = srp_scene_face(scene, k);
        }
        qsort(face, faces, sizeof *face, larger_area);
        for (size_t k = 0; k < faces; ++k) {
            add_face(groups, &count, face[k].normal, face[k].area);
            total += face[k].area;
            if (face[k].two_sided) {
                add_face(groups, &count, srp_vec3_scale(-1.0, face[k].normal), face[k].area);
                total += face[k].area;
            }
        }
        qsort(groups, count, sizeof *groups, larger_group);
        taken = choose(groups, count, total, wanted, normals, share);
    }
    free(face);
    free(groups);
    return taken;
}

/* ---- shadow ---- */

double cli_facing_area(const srp_scene *scene, srp_vec3 s) {
    double area = 0.0;
    for (size_t k = 0; k < srp_scene_facet_count(scene); ++k) {
        srp_face face = srp_scene_face(scene, k);
        double cosine = srp_vec3_dot(face.normal, s);
        area += face.area * (face.two_sided ? fabs(cosine) : fmax(cosine, 0.0));
    }
    return area;
}

/* Lit areas by the method exact into `lit` (count). */
static srp_status compute_lit(const srp_scene *scene, const cli_samples *samples, double *lit,
                              srp_error *error) {
    srp_method_params params = srp_method_params_default();
    srp_prepared *prepared = NULL;
    srp_response *responses = calloc(samples->count, sizeof *responses);
    srp_vec3 *s = calloc(samples->count, sizeof *s);
    srp_status status = SRP_NO_MEMORY;
    if (responses != NULL && s != NULL) {
        for (size_t k = 0; k < samples->count; ++k) {
            s[k] = samples->at[k].s;
        }
        status = srp_method_prepare(&srp_method_exact, scene, &params, &prepared, error);
    } else if (error != NULL) {
        *error = (srp_error){.status = SRP_NO_MEMORY, .message = "no memory for the shadows"};
    }
    if (status == SRP_OK) {
        status = srp_prepared_respond(prepared, samples->count, s, responses, NULL, error);
    }
    for (size_t k = 0; k < samples->count && status == SRP_OK; ++k) {
        lit[k] = responses[k].lit_area;
    }
    srp_prepared_release(prepared);
    free(responses);
    free(s);
    return status;
}

srp_status cli_facing_shaded(const srp_scene *scene, const cli_samples *samples, bool known,
                             double *shaded, srp_error *error) {
    if (!known) {
        srp_status status = compute_lit(scene, samples, shaded, error);
        if (status != SRP_OK) {
            return status;
        }
    }
    for (size_t k = 0; k < samples->count; ++k) {
        double lit = known ? samples->lit_area[k] : shaded[k];
        double facing = cli_facing_area(scene, samples->at[k].s);
        shaded[k] = facing > 0.0 ? fmax(0.0, 1.0 - lit / facing) : 0.0;
    }
    return SRP_OK;
}
