/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Look-up in a table as GMAT does it in SPAD files (SPADSRPInterpolationMethod), for missions that
 * must agree with GMAT to the last digits: nodes are used as the file has them, those of a pole and
 * of the two ends of azimuth each by itself, and the cubic is Lagrange's through 4 x 4 nodes.
 * Beyond a pole it goes on with the node opposite. The schemes of srp/interp.h are better behaved
 * there. Departures from GMAT: a pole and the seam are ordinary directions, the south pole is
 * treated as the north pole is (GMAT gives up within a step of it), and where azimuth has an odd
 * number of steps, and so no node opposite another, the stencil moves inwards.
 */
#ifndef SRP_SPAD_H
#define SRP_SPAD_H

#include <srp/export.h>
#include <srp/status.h>
#include <srp/table.h>
#include <srp/vec3.h>

#include <stdbool.h>

SRP_BEGIN_DECLS

typedef struct srp_spad srp_spad;

/* `cubic`: Lagrange's cubic, else bilinear. The nodes are copied. SRP_BAD_ARGUMENT (table not
 * complete, or smaller than the stencil), SRP_NO_MEMORY. Ownership: *out is the caller's. */
SRP_API SRP_CHECK srp_status srp_spad_create(const srp_table *table, bool cubic, srp_spad **out,
                                             srp_error *error);
SRP_API void srp_spad_destroy(srp_spad *spad);

/*
 * Area vector f [m^2] for s_body, the unit vector to the Sun in body axes, and df (3,3; NULL: not
 * wanted), its derivatives by s_body, tangential as srp_interp_jacobian's; at a pole without the
 * part along azimuth. SRP_BAD_ARGUMENT: s_body or a node is not finite. Allocates nothing; any
 * number of threads at once.
 */
SRP_API SRP_CHECK srp_status srp_spad_eval(const srp_spad *spad, srp_vec3 s_body, srp_vec3 *f,
                                           double df[3][3], srp_error *error);

SRP_END_DECLS

#endif
