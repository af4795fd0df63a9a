/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What methods share: the head of every prepared method, the parallel loop over directions for
 * methods that answer one direction at a time, and the step from visible facets to a response.
 * Internal.
 */
#ifndef SRP_SRC_METHOD_INTERNAL_H
#define SRP_SRC_METHOD_INTERNAL_H

#include <srp/method.h>

#include <stdatomic.h>
#include <stdbool.h>

/* First member of every method's own state. */
struct srp_prepared {
    const srp_method *method;
    const srp_scene *scene;
    srp_method_params params;
};

/*
 * Scratch memory of one thread. Methods put this first in a struct of their own. Scratches are kept
 * in a pool between calls, so that nothing is allocated per direction; a scratch only grows.
 */
typedef struct srp_scratch {
    srp_basis *basis; /* (material count + 1) sums of the direction in work */
} srp_scratch;

enum { SRP_SCRATCH_SLOTS = 256 };

typedef struct srp_scratch_pool {
    _Atomic(srp_scratch *) slot[SRP_SCRATCH_SLOTS];
} srp_scratch_pool;

/* How a method answers one direction. */
typedef struct srp_direction_kernel {
    /* NULL on failure of memory. `basis` is made and freed by the caller. */
    srp_scratch *(*scratch_create)(const srp_prepared *prepared);
    void (*scratch_destroy)(srp_scratch *scratch);
    /* Adds the lit facets' sums to scratch->basis (zeroed on entry) and sets in *out (zeroed on
     * entry) whatever is not derived from them: errors, samples, flags, and in f and t what is to
     * be added to direct light. SRP_OK or SRP_NO_MEMORY. */
    srp_status (*respond)(const srp_prepared *prepared, srp_scratch *scratch, srp_vec3 s,
                          srp_response *out);
} srp_direction_kernel;

/* srp_method.respond for such methods: loops over directions on params.threads threads, derives f,
 * t and areas from the sums. */
srp_status srp_respond_each(const srp_prepared *prepared, const srp_direction_kernel *kernel,
                            srp_scratch_pool *pool, size_t count, const srp_vec3 *s_body,
                            srp_response *responses, srp_basis *basis, srp_error *error);
/* The same, one direction after the other: for fewer directions than threads, with a kernel that
 * shares the work on one direction among its threads itself. */
srp_status srp_respond_in_turn(const srp_prepared *prepared, const srp_direction_kernel *kernel,
                               srp_scratch_pool *pool, size_t count, const srp_vec3 *s_body,
                               srp_response *responses, srp_basis *basis, srp_error *error);
void srp_scratch_pool_clear(srp_scratch_pool *pool, const srp_direction_kernel *kernel);

/* Adds to *f and *t what the (material count + 1) sums of a direction give under the scene's
 * optics.
 */
void srp_basis_add_force(const srp_scene *scene, const srp_basis *basis, srp_vec3 s, srp_vec3 *f,
                         srp_vec3 *t);
/* The lit cross-section that the sums stand for [m^2]. */
double srp_basis_lit_area(const srp_scene *scene, const srp_basis *basis);
/* Sets areas, and adds to f and t, which hold what a method gives beyond direct light. */
void srp_basis_finish(const srp_scene *scene, const srp_basis *basis, srp_vec3 s,
                      srp_response *out);

/*
 * Adds the lit part of a flat facet to the sums of its material.
 *   lit      its cross-section seen from the Sun, A |n.s| [m^2]
 *   cosine   |n.s| > 0
 *   normal   turned to the Sun
 *   lever    centroid of the lit part relative to the reference point [m]
 */
static inline void srp_basis_add(srp_basis *basis, double lit, double cosine, srp_vec3 normal,
                                 srp_vec3 lever) {
    srp_vec3 moment = srp_vec3_cross(lever, normal);
    basis->a += lit;
    basis->b = srp_vec3_add_scaled(basis->b, lit * cosine, normal);
    basis->c = srp_vec3_add_scaled(basis->c, lit, normal);
    basis->ra = srp_vec3_add_scaled(basis->ra, lit, lever);
    basis->rb = srp_vec3_add_scaled(basis->rb, lit * cosine, moment);
    basis->rc = srp_vec3_add_scaled(basis->rc, lit, moment);
}

#endif
