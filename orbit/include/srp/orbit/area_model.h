/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Area models: what answers the question "which area vector for this direction of the Sun" during
 * an orbit. An interpolant, a method that is asked anew at each call, a sphere; whoever has another
 * one fills in five fields.
 */
#ifndef SRP_ORBIT_AREA_MODEL_H
#define SRP_ORBIT_AREA_MODEL_H

#include <srp/export.h>
#include <srp/interp.h>
#include <srp/method.h>
#include <srp/status.h>
#include <srp/vec3.h>

SRP_BEGIN_DECLS

/* Bits. */
enum { SRP_AREA_MODEL_ROUND = 1 /* f is along s whatever the attitude */ };

typedef struct srp_area_model srp_area_model;
struct srp_area_model {
    const char *name;
    unsigned flags;
    /* f [m^2] for the unit vector s_body to the Sun; df (NULL: not wanted) its derivatives,
     * tangential as srp_interp_jacobian's. 0: done; > 0: not here; < 0: stop. Re-entrant. */
    int (*eval)(const void *user, srp_vec3 s_body, srp_vec3 *f, double (*df)[3]);
    void (*destroy)(void *user); /* NULL: nothing to do */
    void *user;
};

SRP_API void srp_area_model_release(srp_area_model *model);

/* f = -cr area s. SRP_BAD_ARGUMENT (cr < 0, area <= 0), SRP_NO_MEMORY. */
SRP_API SRP_CHECK srp_status srp_area_model_cannonball(double cr, double area, srp_area_model *out,
                                                       srp_error *error);
/* Takes over `interp`. SRP_NO_MEMORY: then it is still the caller's. */
SRP_API SRP_CHECK srp_status srp_area_model_interp(srp_interp *interp, srp_area_model *out,
                                                   srp_error *error);
/* GMAT's own interpolation (SPADSRPInterpolationMethod): bilinear, or Lagrange's cubic through 4 x
 * 4 nodes. The nodes are copied. For agreement with GMAT to the last digit; srp_interp_... are
 * better behaved at the poles. SRP_BAD_ARGUMENT (table not complete, or smaller than the stencil),
 * SRP_NO_MEMORY. */
SRP_API SRP_CHECK srp_status srp_area_model_spad(const srp_table *table, bool cubic,
                                                 srp_area_model *out, srp_error *error);
/* Asks `prepared`, which must outlive the model, at each call; derivatives by central differences
 * over 1e-5 rad. N-plate models, and the yardstick of tables. SRP_NO_MEMORY. */
SRP_API SRP_CHECK srp_status srp_area_model_direct(const srp_prepared *prepared,
                                                   srp_area_model *out, srp_error *error);

SRP_END_DECLS

#endif
