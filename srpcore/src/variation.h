/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What a lattice saw of its own coarseness, and the standard error that follows from it. Internal.
 *
 * A lattice errs where the push of light per cell jumps: at silhouettes, shadows and edges.
 * Counting records these jumps by where they fell, as integers, so that the sums do not depend on
 * the order:
 *
 *   turned lattice  by column and row modulo 4. From them follows what each of the 16 lattices of
 *                   four times the pitch inside this one would have found, and hence the four of
 *                   twice the pitch. How these scatter tells how this one errs.
 *   fixed window    by column, and by row. Edges of a spacecraft often lie along the pixels, and a
 *                   window has no shift drawn at random: coarser windows inside it then err alike,
 *                   so that their scatter tells nothing. Instead all jumps in one column count as
 *                   one edge, anywhere in its cell with equal chance, and so do those of one row.
 *
 * docs/theory.md, "Sampling and its error", has the formulas and the measurements behind them.
 */
#ifndef SRP_SRC_VARIATION_H
#define SRP_SRC_VARIATION_H

#include "lattice.h"

#include <srp/method.h>
#include <srp/vec3.h>

#include <stdbool.h>
#include <stdint.h>

/* Push of light on a cell, body frame, in units of 2^-28; the fourth is 0. It is below 2 in
 * magnitude, hence sums over all samples of the largest lattice stay within 63 bits. */
typedef struct srp_push {
    int32_t q[4];
} srp_push;

static inline srp_push srp_push_make(srp_vec3 push) {
    srp_push out = {
        {(int32_t)(push.x * 0x1p28), (int32_t)(push.y * 0x1p28), (int32_t)(push.z * 0x1p28), 0}};
    return out;
}

typedef struct srp_jump {
    int64_t q[4];
} srp_jump;

typedef struct srp_variation {
    srp_lattice_kind kind;
    int32_t columns, rows;            /* of the lattice */
    int32_t column_mask, row_mask;    /* which bits of a column and of a row choose the bin */
    int32_t joint_mask, joint_stride; /* the same for the row of an `edge` bin */
    srp_jump *edge;                   /* sum of (push to the left - push to the right) */
    srp_jump *row;                    /* sum of pushes */
    size_t edge_count, row_count, edge_capacity, row_capacity;
} srp_variation;

/* Empties the bins for a lattice; false when there is no memory. A zeroed struct is a fresh one. */
bool srp_variation_begin(srp_variation *variation, srp_lattice_kind kind,
                         const srp_lattice *lattice);
void srp_variation_clear(srp_variation *variation);
void srp_variation_merge(srp_variation *into, const srp_variation *from);

/* Samples [begin, end) of row j have the same push. */
static inline void srp_variation_add(srp_variation *variation, int32_t begin, int32_t end,
                                     int32_t j, const srp_push *push) {
    srp_jump *edges = variation->edge + (j & variation->joint_mask) * variation->joint_stride;
    int64_t *restrict left = edges[begin & variation->column_mask].q;
    int64_t *restrict right = edges[end & variation->column_mask].q;
    int64_t *restrict row = variation->row[j & variation->row_mask].q;
    int64_t length = end - begin;
    for (int k = 0; k < 4; ++k) {
        left[k] -= push->q[k];
    }
    for (int k = 0; k < 4; ++k) {
        right[k] += push->q[k];
        row[k] += length * push->q[k];
    }
}

/* Standard error of the sum of pushes times cell area: root of the summed variances [m^2]. */
double srp_variation_error(const srp_variation *variation, double cell);

#endif
