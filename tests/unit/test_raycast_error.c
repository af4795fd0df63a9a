/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Is the standard error of `raycast` honest? Against `exact`: the true error is to stay below three
 * estimated ones in at least 97 % of cases, and the estimate is not to be wastefully large: the
 * ratio of the medians, estimated over true, is printed and bounded. On a grid of directions:
 * test_lro.c.
 */
#include "model_files.h"
#include "prepared.h"
#include "srp_check.h"

#include <string.h>

/* The large ones are compared in fewer directions unless the program is called as `... long`. */
static const struct {
    const char *name;
    size_t directions, directions_long;
} SUBJECTS[] = {
    {"cube", 500, 500},      {"box-wing", 500, 500}, {"icosphere-1280", 500, 500},
    {"dish", 500, 500},      {"l-corner", 200, 500}, {"dihedral", 200, 500},
    {"sun-shield", 40, 500}, {"gnss", 30, 500},
};
enum { SUBJECT_COUNT = sizeof SUBJECTS / sizeof SUBJECTS[0] };

static int is_long;

static int compare_doubles(const void *left, const void *right) {
    double a = *(const double *)left, b = *(const double *)right;
    return a < b ? -1 : a > b;
}

static double median(double *values, size_t count) {
    qsort(values, count, sizeof *values, compare_doubles);
    return values[count / 2];
}

/* True errors beside estimated ones, of one kind: force or moment. */
typedef struct record {
    size_t count, within;
    double worst; /* true over estimated */
    double *truth, *estimate;
} record;

static record record_make(size_t capacity) {
    record out = {0, 0, 0.0, malloc(capacity * sizeof(double)), malloc(capacity * sizeof(double))};
    ck_assert(out.truth != NULL && out.estimate != NULL);
    return out;
}

static void record_free(record *of) {
    free(of->truth);
    free(of->estimate);
}

/* `noise`: rounding of what is compared. */
static void record_add(record *of, srp_vec3 got, srp_vec3 want, double estimate, double noise) {
    double off = srp_vec3_norm(srp_vec3_sub(got, want));
    ck_assert(isfinite(off) && isfinite(estimate) && estimate >= 0.0);
    of->truth[of->count] = off;
    of->estimate[of->count] = estimate;
    ++of->count;
    of->within += off < 3.0 * estimate + noise;
    of->worst = fmax(of->worst, off > noise ? off / estimate : 0.0);
}

static double record_share(const record *of) {
    return (double)of->within / (double)of->count;
}

/* At least 97 %; of a few directions, one may always be outside. */
static bool record_is_honest(const record *of) {
    return (double)of->within >= fmin(0.97 * (double)of->count, (double)of->count - 1.0);
}

/* Prints the figures of one kind; the ratio of medians, estimated over true. */
static double record_print(record *of, const char *what) {
    double ratio = median(of->estimate, of->count) / median(of->truth, of->count);
    printf("  %s: %5.1f %% within 3 errors, worst %4.1f; estimated over true %5.2f\n", what,
           100.0 * record_share(of), of->worst, ratio);
    return ratio;
}

/* What is compared: a scene in some directions, and what `exact` says of it. */
typedef struct subject {
    srp_scene *scene;
    size_t count;
    srp_vec3 *s;
    srp_response *want;
} subject;

static void respond_all(const srp_method *method, const subject *on,
                        const srp_method_params *params, srp_response *responses) {
    srp_prepared *prepared = prepare_with(method, on->scene, params);
    respond_each(prepared, on->count, on->s, responses);
    srp_prepared_release(prepared);
}

static subject subject_make(srp_scene *scene, size_t count) {
    subject out = {scene, count, malloc(count * sizeof(srp_vec3)),
                   calloc(count, sizeof(srp_response))};
    ck_assert(out.s != NULL && out.want != NULL);
    return out;
}

static void subject_free(subject *on) {
    srp_scene_destroy(on->scene);
    free(on->s);
    free(on->want);
}

/* Both shares are at least 97 %, and the median estimate of the force's error is at most so many
 * times the median error. */
static void check_errors(const subject *on, const srp_method_params *params, const char *what,
                         double ratio_max) {
    srp_response *got = calloc(on->count, sizeof *got);
    ck_assert_ptr_nonnull(got);
    respond_all(&srp_method_raycast, on, params, got);
    double radius = srp_scene_radius(on->scene), noise = 1e-13 * radius * radius;
    record f = record_make(on->count), t = record_make(on->count);
    for (size_t k = 0; k < on->count; ++k) {
        ck_assert_uint_eq(got[k].flags, 0);
        record_add(&f, got[k].f, on->want[k].f, got[k].f_error, noise);
        record_add(&t, got[k].t, on->want[k].t, got[k].t_error, noise * radius);
    }
    printf("  %s, %zu directions\n", what, on->count);
    double ratio = record_print(&f, "force ");
    record_print(&t, "moment");
    ck_assert_msg(record_is_honest(&f), "force within 3 errors in %g", record_share(&f));
    ck_assert_msg(record_is_honest(&t), "moment within 3 errors in %g", record_share(&t));
    ck_assert_msg(ratio < ratio_max, "estimate is %g times the true error", ratio);
    record_free(&f);
    record_free(&t);
    free(got);
}

START_TEST(lattices_know_their_errors) {
    uint64_t random = 12;
    model_file model = model_read(SUBJECTS[_i].name);
    subject on = subject_make(model_scene(&model),
                              is_long ? SUBJECTS[_i].directions_long : SUBJECTS[_i].directions);
    srp_method_params params = srp_method_params_default();
    for (size_t k = 0; k < on.count; ++k) {
        on.s[k] = random_direction(&random);
    }
    respond_all(&srp_method_exact, &on, &params, on.want);
    printf("%s\n", SUBJECTS[_i].name);
    check_errors(&on, &params, "turned lattice, 512", 4.0);
    params.lattice.samples = 64;
    check_errors(&on, &params, "turned lattice, 64", 4.0);
    params.lattice.kind = SRP_LATTICE_WINDOW;
    params.lattice.columns = params.lattice.rows = 256;
    for (int k = 0; k < 4; ++k) {
        double half = 1.01 * srp_scene_radius(on.scene);
        params.lattice.window[k] = k & 1 ? half : -half;
    }
    check_errors(&on, &params, "window of 256 x 256", 8.0);
    subject_free(&on);
    model_free(&model);
}
END_TEST

int main(int argc, char **argv) {
    is_long = argc > 1 && strcmp(argv[1], "long") == 0;
    Suite *suite = suite_create("raycast_error");
    TCase *tcase = tcase_create("raycast_error");
    tcase_set_timeout(tcase, 600.0);
    tcase_add_loop_test(tcase, lattices_know_their_errors, 0, SUBJECT_COUNT);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
