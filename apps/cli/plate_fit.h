/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The N-plate model that fits a table best, its normals given.
 *
 * A plate of area A, with c = n.s > 0, adds (docs/theory.md, "The force on one facet")
 *     f = -A c [ (1 - rho_s) s + 2 (rho_s c + rho_d / 3) n ]
 * In the absorbing, the specular and the diffuse area of the plate,
 *     a = A (1 - rho_s - rho_d),  v = A rho_s,  w = A rho_d,
 * this is linear:
 *     f = -[ a c s + v 2 c^2 n + w c (s + 2/3 n) ]
 * and area >= 0, 0 <= rho_s, 0 <= rho_d, rho_s + rho_d <= 1 are nothing but a, v, w >= 0. So the
 * best plates are the one solution of a linear least-squares problem with non-negative unknowns.
 */
#ifndef SRP_CLI_PLATE_FIT_H
#define SRP_CLI_PLATE_FIT_H

#include "samples.h"

#include <srp/plates.h>

#include <stdbool.h>
#include <stddef.h>

typedef enum cli_fit_status {
    CLI_FIT_DONE,
    CLI_FIT_NO_MEMORY,
    CLI_FIT_TOO_FEW,   /* fewer numbers than unknowns */
    CLI_FIT_AMBIGUOUS, /* some plates cannot be told apart in these directions */
    CLI_FIT_NOT_FINITE,
    CLI_FIT_CANCELLED /* its watch did not want it to go on */
} cli_fit_status;

/* Asked many times a second, on the thread that fits; once false, it stays so. NULL in place of a
 * watch: nobody cancels. */
typedef struct cli_fit_watch {
    bool (*go_on)(void *user);
    void *user;
} cli_fit_watch;

static inline bool cli_fit_goes_on(const cli_fit_watch *watch) {
    return watch == NULL || watch->go_on(watch->user);
}

enum { CLI_FIT_AREA, CLI_FIT_RHO_S, CLI_FIT_RHO_D, CLI_FIT_UNKNOWNS };

typedef struct cli_plate_fit {
    size_t count;
    srp_plate *plates; /* (count) normals as given, made unit; area 0 where a plate is not wanted */
    /* (3 count, 3 count) covariance of area, rho_s, rho_d of the first plate, the second, ... It
     * takes residuals for noise, alike and independent in all directions and components, and does
     * not know the bounds: for a value that rests on one it says how far it would go without. */
    double *covariance;
    double noise;    /* standard deviation of that noise [m^2] */
    bool tied;       /* opposite plates were given areas as equal as possible, see below */
    srp_vec3 *model; /* (samples) what the plates give [m^2] */
} cli_plate_fit;

/* Whether this build can fit: it takes GSL. */
bool cli_plate_fit_exists(void);

/* Force of one-sided plates that do not shade each other [m^2]. */
srp_vec3 cli_plates_force(const srp_plate *plates, size_t count, srp_vec3 s);

/*
 * Areas of opposite plates may not be told apart. The absorbing area of a plate acts by max(n.s, 0)
 * = (|n.s| + n.s) / 2, so that of the differences between front and back only the one vector
 * sum of (a_front - a_back) n shows: with more than three pairs in general, with fewer whose
 * normals lie in a plane, nothing tells the differences one by one. No table could, and forces do
 * not depend on it. Then opposite plates are made as equal in area as they can be, as panels and
 * boxes are.
 */
/* Fits plates with these normals (count, not 0) to the samples, each by its weight. *out is freed
 * by cli_plate_fit_free(), and as it was unless the fit is done. */
cli_fit_status cli_plate_fit_solve(const cli_samples *samples, const srp_vec3 *normals,
                                   size_t count, const cli_fit_watch *watch, cli_plate_fit *out);
/* The same without covariance and noise, which stay 0: for a search, which wants neither. */
cli_fit_status cli_plate_fit_solve_only(const cli_samples *samples, const srp_vec3 *normals,
                                        size_t count, const cli_fit_watch *watch,
                                        cli_plate_fit *out);
void cli_plate_fit_free(cli_plate_fit *fit);

/* Standard deviation of a fitted number, CLI_FIT_AREA, ... of `plate`. */
double cli_plate_fit_sigma(const cli_plate_fit *fit, size_t plate, int unknown);

/*
 * Searches `count` normals as well: plates are added one by one where they help most, and all
 * normals are turned after each (Levenberg-Marquardt), until turning no longer helps. A good local
 * optimum, not a proven global one; always the same for the same samples. search   samples to
 * search with; a few hundred directions are enough all      samples that the normals are turned on
 * in the end normals: (count), written only when done.
 */
cli_fit_status cli_plate_normals_search(const cli_samples *search, const cli_samples *all,
                                        size_t count, const cli_fit_watch *watch,
                                        srp_vec3 *normals);

#endif
