/* SPDX-License-Identifier: Apache-2.0 */
/* Linear least squares with non-negative unknowns. */
#ifndef SRP_CLI_NNLS_H
#define SRP_CLI_NNLS_H

#include <gsl/gsl_matrix.h>
#include <gsl/gsl_vector.h>
#include <stdbool.h>

/*
 * Minimises |A x - b| over x >= 0, by the active-set method of Lawson and Hanson (Solving Least
 * Squares Problems, 1974, chapter 23), with QR decompositions for the unknowns that are not at
 * their bound. A (m, n), m >= n, b (m), x (n). False without memory or when it finds no end; x is
 * then of no use. Handles errors of GSL by status: the caller has switched its handler off.
 */
bool cli_nnls(const gsl_matrix *a, const gsl_vector *b, gsl_vector *x);

#endif
