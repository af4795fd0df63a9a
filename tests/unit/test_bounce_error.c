/* SPDX-License-Identifier: Apache-2.0 */
/* Whether the standard errors of reflected light are honest: how far coarse runs are from converged
 * ones, in units of what they say of themselves. */
#include "model_files.h"
#include "prepared.h"
#include "srp_check.h"

#include <string.h>

enum { MODELS = 4, COARSE = 64, CONVERGED = 4 };
static const char *const NAMES[MODELS] = {"box-wing", "dish", "sun-shield", "gnss"};
static int directions = 24;

typedef struct shares {
    int cases, f_within, t_within;
} shares;

static srp_prepared *prepare(const srp_scene *scene, uint32_t samples, uint32_t diffuse,
                             uint32_t beams) {
    srp_method_params params = srp_method_params_default();
    params.threads = 1;
    params.diffuse = diffuse;
    params.lattice.samples = samples;
    params.seed = samples;
    params.mirrored_beams = beams;
    return prepare_with(&srp_method_raytrace, scene, &params);
}

static bool is_within(srp_vec3 got, srp_vec3 want, double error, double want_error) {
    double off = srp_vec3_norm(srp_vec3_sub(got, want));
    return off <= 2.0 * sqrt(error * error + want_error * want_error);
}

/* Mirrors alone, sampled, against beams; then diffuse light: the two have errors of different
 * kinds.
 */
static shares compare(const char *name, uint32_t diffuse) {
    model_file model = model_read(name);
    srp_scene *scene = model_scene(&model);
    uint32_t beams = srp_method_params_default().mirrored_beams;
    srp_prepared *coarse = prepare(scene, COARSE, diffuse, diffuse > 0 ? beams : 0);
    srp_prepared *converged =
        prepare(scene, CONVERGED * COARSE, diffuse, diffuse > 0 ? beams : 1000000);
    shares sum = {0, 0, 0};
    uint64_t random = 2020;
    for (int k = 0; k < directions; ++k) {
        srp_vec3 s = random_direction(&random);
        srp_response got = respond_to(coarse, s);
        srp_response want = respond_to(converged, s);
        if (srp_vec3_norm(want.f_bounce) == 0.0 && got.f_error == 0.0) {
            continue; /* nothing is reflected on something else */
        }
        ++sum.cases;
        sum.f_within += is_within(got.f, want.f, got.f_error, want.f_error);
        sum.t_within += is_within(got.t, want.t, got.t_error, want.t_error);
    }
    printf("%-10s K %u: %d of %d within 2 errors (moment: %d)\n", name, diffuse, sum.f_within,
           sum.cases, sum.t_within);
    (void)fflush(stdout);
    srp_prepared_release(converged);
    srp_prepared_release(coarse);
    srp_scene_destroy(scene);
    model_free(&model);
    return sum;
}

START_TEST(errors_are_honest) {
    static const uint32_t DIFFUSE[2] = {0, 4};
    shares sum = {0, 0, 0};
    for (int m = 0; m < MODELS; ++m) {
        shares one = compare(NAMES[m], DIFFUSE[_i]);
        sum.cases += one.cases;
        sum.f_within += one.f_within;
        sum.t_within += one.t_within;
    }
    double f = (double)sum.f_within / sum.cases, t = (double)sum.t_within / sum.cases;
    /* Three deviations of a share of so many cases on either side. */
    double margin = 3.0 * sqrt(0.05 * 0.95 / sum.cases);
    printf("within 2 errors, K %u: %.1f %% of forces, %.1f %% of moments, %d cases\n", DIFFUSE[_i],
           100.0 * f, 100.0 * t, sum.cases);
    ck_assert(f >= 0.93 - margin && f <= 0.98 + margin);
    ck_assert(t >= 0.93 - margin && t <= 0.98 + margin);
}
END_TEST

/* `long` as an argument: 300 directions of each model. */
int main(int argc, char **argv) {
    if (argc > 1 && strcmp(argv[1], "long") == 0) {
        directions = 300;
    }
    Suite *suite = suite_create("bounce_error");
    TCase *tcase = tcase_create("bounce_error");
    tcase_set_timeout(tcase, 1200.0);
    tcase_add_loop_test(tcase, errors_are_honest, 0, 2);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
