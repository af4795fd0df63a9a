/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What one direction of sunlight yields, per unit pressure. Force F = P f [N], torque T = P t [N
 * m], acceleration P f / m, with P the radiation pressure (sunlight.h).
 */
#ifndef SRP_RESPONSE_H
#define SRP_RESPONSE_H

#include <srp/export.h>
#include <srp/material.h>
#include <srp/vec3.h>

#include <stddef.h>
#include <stdint.h>

SRP_BEGIN_DECLS

/* Notes on a response; bits. */
enum {
    SRP_RESPONSE_TOLERANCE_MISSED = 1, /* the largest sample count did not reach the tolerance */
    SRP_RESPONSE_MIRRORS_SAMPLED = 4, /* mirrored light would have taken more beams than allowed: it
                                         was sampled */
    SRP_RESPONSE_CUT = 2 /* part of the model lies outside the window that was asked for: what it
                            may add to f and t is in their errors */
};

typedef struct srp_response {
    srp_vec3 f;        /* area vector [m^2], body frame */
    srp_vec3 t;        /* moment vector about the reference point [m^3], body frame */
    srp_vec3 f_bounce; /* part of f from light that was reflected before; 0 where not followed */
    srp_vec3 t_bounce; /* part of t from it */
    double lit_area;   /* cross-section that stops light, seen from the Sun [m^2] */
    double back_area;  /* part of it on absorbing backs of one-sided materials [m^2] */
    double unresolved; /* flux still in flight when paths were cut, share of the incoming [-] */
    double f_error;    /* standard error of f: root of the summed variances [m^2]; 0 = exact */
    double t_error;    /* standard error of t [m^3] */
    uint64_t samples;  /* rays behind the numbers; 0 when none were taken */
    uint32_t flags;    /* SRP_RESPONSE_... */
} srp_response;

/*
 * Sums over the lit facets of one material from which direct light gives f and t for any optics
 * (PHYSICS: "Direct light is linear in the optics"). With A the lit area of a facet, c = n.s, r the
 * lit part's centroid relative to the reference point:
 *   a = sum A c,  b = sum A c^2 n,  c = sum A c n, and with the lever arms inside
 *   ra = sum A c r,  rb = sum A c^2 r x n,  rc = sum A c r x n
 *   f = -[ (1 - rho_s) a s + 2 rho_s b + (2/3) rho_d c ]
 *   t = -[ (1 - rho_s) ra x s + 2 rho_s rb + (2/3) rho_d rc ]
 */
typedef struct srp_basis {
    double a;            /* [m^2] */
    srp_vec3 b, c;       /* [m^2] */
    srp_vec3 ra, rb, rc; /* [m^3] */
} srp_basis;

/* Adds to *f and *t what `basis` gives under `optics` with the Sun at `s` (unit, body frame). */
SRP_API void srp_basis_apply(const srp_basis *basis, srp_optics optics, srp_vec3 s, srp_vec3 *f,
                             srp_vec3 *t);

/*
 * What f and t gain for each unit by which the shares of one material grow, exactly and for any
 * optics: direct light is linear in them. From srp_basis_apply(), whose formulas stand above:
 *   df/drho_s = a s - 2 b        df/drho_d = -(2/3) c
 *   dt/drho_s = ra x s - 2 rb    dt/drho_d = -(2/3) rc
 * (AAS 20-481, Eq. 2 with s to the Sun, summed and differentiated; docs/theory.md, "Other optics").
 * Each share grows at the expense of what is absorbed. For absorbing backs of one-sided materials
 * (the last sums of a row) they mean nothing: their optics are fixed at 0, 0.
 */
typedef struct srp_partials {
    srp_vec3 f_rho_s, f_rho_d; /* [m^2], body frame */
    srp_vec3 t_rho_s, t_rho_d; /* [m^3], body frame, about the reference point of `basis` */
} srp_partials;

/* The partials of the material of `basis` with the Sun at `s` (unit, body frame, the one that
 * `basis` belongs to). They are of direct light alone; light reflected before is not linear in the
 * optics. Any thread. */
SRP_API void srp_basis_partials(const srp_basis *basis, srp_vec3 s, srp_partials *out);

SRP_END_DECLS

#endif
