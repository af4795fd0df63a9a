/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Space has no preferred direction: turning or mirroring spacecraft and Sun together turns or
 * mirrors the force. On every model; `test_symmetry long` takes 200 rotations of each, without it
 * fewer of the large ones.
 */
#include "model_files.h"
#include "prepared.h"
#include "srp_check.h"

#include <string.h>

enum { ROTATIONS = 200, ROTATIONS_LEAST = 3, FACETS_IN_ALL = 50000 };

static int is_long;

/* |f of the turned - turned f| over |f|, and the same of the moment over radius times |f|, since it
 * may vanish. `want` is the response to `s` of the model as it is. */
static void compare(const model_file *model, const srp_response *want, const turn *t, srp_vec3 s,
                    double *f_off, double *t_off) {
    srp_vec3 s_turned = turn_apply(t, s);
    s_turned = srp_vec3_scale(1.0 / srp_vec3_norm(s_turned), s_turned);
    srp_scene *scene = model_scene_turned(model, t);
    srp_prepared *turned = prepare_on(&srp_method_exact, scene);
    srp_response got = respond_to(turned, s_turned);
    double size = srp_vec3_norm(want->f);
    ck_assert(size > 0.0);
    /* A moment is an axial vector: a mirror turns it round once more. */
    double handedness = srp_vec3_dot(t->row[0], srp_vec3_cross(t->row[1], t->row[2]));
    srp_vec3 f = turn_apply(t, want->f);
    srp_vec3 moment = srp_vec3_scale(handedness > 0.0 ? 1.0 : -1.0, turn_apply(t, want->t));
    *f_off = fmax(*f_off, srp_vec3_norm(srp_vec3_sub(got.f, f)) / size);
    *t_off =
        fmax(*t_off, srp_vec3_norm(srp_vec3_sub(got.t, moment)) / (size * srp_scene_radius(scene)));
    srp_prepared_release(turned);
    srp_scene_destroy(scene);
}

static int rotations_of(const srp_scene *scene) {
    int affordable = (int)(FACETS_IN_ALL / srp_scene_facet_count(scene));
    if (is_long || affordable > ROTATIONS) {
        return ROTATIONS;
    }
    return affordable > ROTATIONS_LEAST ? affordable : ROTATIONS_LEAST;
}

START_TEST(force_turns_with_the_spacecraft) {
    model_file model = model_read(MODEL_NAMES[_i]);
    srp_scene *scene = model_scene(&model);
    srp_prepared *plain = prepare_on(&srp_method_exact, scene);
    int rotations = rotations_of(scene);
    uint64_t random = 101 + (uint64_t)_i;
    double f_turned = 0.0, t_turned = 0.0, f_mirrored = 0.0, t_mirrored = 0.0;
    for (int i = 0; i < rotations; ++i) {
        turn rotation = turn_random(&random);
        turn mirror = turn_mirrored(rotation);
        srp_vec3 s = random_direction(&random);
        srp_response want = respond_to(plain, s);
        compare(&model, &want, &rotation, s, &f_turned, &t_turned);
        compare(&model, &want, &mirror, s, &f_mirrored, &t_mirrored);
    }
    printf("%s, %d rotations: force %.1e turned, %.1e mirrored; moment %.1e, %.1e\n",
           MODEL_NAMES[_i], rotations, f_turned, f_mirrored, t_turned, t_mirrored);
    ck_assert(f_turned < 1e-12 && f_mirrored < 1e-12);
    ck_assert(t_turned < 1e-12 && t_mirrored < 1e-12);
    srp_prepared_release(plain);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

int main(int argc, char **argv) {
    is_long = argc > 1 && strcmp(argv[1], "long") == 0;
    Suite *suite = suite_create("symmetry");
    TCase *tcase = tcase_create("symmetry");
    tcase_set_timeout(tcase, 600.0);
    tcase_add_loop_test(tcase, force_turns_with_the_spacecraft, 0, (int)MODEL_COUNT);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
