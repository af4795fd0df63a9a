/* SPDX-License-Identifier: Apache-2.0 */
/* The exact method, one direction at a time, for methods that add to its light. Internal. */
#ifndef SRP_SRC_EXACT_KERNEL_H
#define SRP_SRC_EXACT_KERNEL_H

#include "method_internal.h"

/* Its `prepared` is one of srp_method_exact. */
extern const srp_direction_kernel srp_exact_kernel;

#endif
