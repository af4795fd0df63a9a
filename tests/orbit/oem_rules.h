/* SPDX-License-Identifier: Apache-2.0 */
/* The rules of CCSDS 502.0-B-2, section 5, for Orbit Ephemeris Messages in KVN, as far as a file
 * without covariances can break them. */
#ifndef SRP_TESTS_OEM_RULES_H
#define SRP_TESTS_OEM_RULES_H

#include <stdbool.h>
#include <stddef.h>

/* False: `why` says which rule, and where. */
bool oem_is_valid(const char *path, char *why, size_t size);

#endif
