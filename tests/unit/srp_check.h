/* SPDX-License-Identifier: Apache-2.0 */
/* What our libcheck programs share: tolerant comparison and a main. */
#ifndef SRP_CHECK_H
#define SRP_CHECK_H

#include <srp/status.h>
#include <srp/vec3.h>

#include <check.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

/* |got - want| <= rtol |want| + atol; false for NaN. */
#define assert_close(got, want, rtol, atol)                                                        \
    do {                                                                                           \
        double got_ = (got), want_ = (want), rtol_ = (rtol), atol_ = (atol);                       \
        ck_assert_msg(fabs(got_ - want_) <= rtol_ * fabs(want_) + atol_,                           \
                      "%s = %.17g, expected %.17g (off by %.3g, rtol %.3g, atol %.3g)", #got,      \
                      got_, want_, got_ - want_, rtol_, atol_);                                    \
    } while (0)

/* |got - want| <= rtol |want| + atol as vectors. */
#define assert_vec3_close(got, want, rtol, atol)                                                   \
    do {                                                                                           \
        srp_vec3 gotv_ = (got), wantv_ = (want);                                                   \
        double off_ = srp_vec3_norm(srp_vec3_sub(gotv_, wantv_));                                  \
        ck_assert_msg(off_ <= (rtol)*srp_vec3_norm(wantv_) + (atol),                               \
                      "%s = (%.17g, %.17g, %.17g), expected (%.17g, %.17g, %.17g), off by %.3g",   \
                      #got, gotv_.x, gotv_.y, gotv_.z, wantv_.x, wantv_.y, wantv_.z, off_);        \
    } while (0)

/* The call succeeds; its error text otherwise. `error` is the srp_error it was given. */
#define assert_ok(call, error)                                                                     \
    do {                                                                                           \
        srp_status status_ = (call);                                                               \
        ck_assert_msg(status_ == SRP_OK, "%s: %s (%s)", #call, srp_status_string(status_),         \
                      status_ == SRP_OK ? "" : (error).message);                                   \
    } while (0)

/* Deterministic random numbers for tests: SplitMix64. */
static inline uint64_t random_bits(uint64_t *state) {
    uint64_t z = (*state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/* Uniform in [0, 1). */
static inline double random_unit(uint64_t *state) {
    return (double)(random_bits(state) >> 11) * 0x1p-53;
}

/* Uniform on the sphere. */
static inline srp_vec3 random_direction(uint64_t *state) {
    double z = 2.0 * random_unit(state) - 1.0;
    double az = 2.0 * 3.14159265358979323846 * random_unit(state);
    double h = sqrt(1.0 - z * z);
    srp_vec3 s = srp_vec3_make(h * cos(az), h * sin(az), z);
    return srp_vec3_scale(1.0 / srp_vec3_norm(s), s);
}

/* Runs a suite; the program's exit status. */
static inline int run_suite(Suite *suite) {
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

#endif
