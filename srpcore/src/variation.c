/* SPDX-License-Identifier: Apache-2.0 */
#include "variation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SUB = 4 }; /* a lattice of SUB times the pitch starts at each of SUB columns and SUB rows */

static const double PUSH_UNIT = 0x1p-28;

static bool reserve(srp_jump **bins, size_t *capacity, size_t count) {
    if (count > *capacity) {
        srp_jump *grown = realloc(*bins, count * sizeof *grown);
        if (grown == NULL) {
            return false;
        }
        *bins = grown;
        *capacity = count;
    }
    memset(*bins, 0, count * sizeof **bins);
    return true;
}

bool srp_variation_begin(srp_variation *variation, srp_lattice_kind kind,
                         const srp_lattice *lattice) {
    bool window = kind == SRP_LATTICE_WINDOW;
    variation->kind = kind;
    variation->columns = lattice->columns;
    variation->rows = lattice->rows;
    variation->column_mask = window ? INT32_MAX : SUB - 1;
    variation->row_mask = variation->column_mask;
    variation->joint_mask = window ? 0 : SUB - 1;
    variation->joint_stride = window ? 0 : SUB;
    variation->edge_count = window ? (size_t)lattice->columns + 1 : SUB * SUB;
    variation->row_count = window ? (size_t)lattice->rows : SUB;
    return reserve(&variation->edge, &variation->edge_capacity, variation->edge_count) &&
           reserve(&variation->row, &variation->row_capacity, variation->row_count);
}

void srp_variation_clear(srp_variation *variation) {
    free(variation->edge);
    free(variation->row);
    memset(variation, 0, sizeof *variation);
}

static void merge_bins(srp_jump *into, const srp_jump *from, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        for (int k = 0; k < 4; ++k) {
            into[i].q[k] += from[i].q[k];
        }
    }
}

void srp_variation_merge(srp_variation *into, const srp_variation *from) {
    merge_bins(into->edge, from->edge, from->edge_count);
    merge_bins(into->row, from->row, from->row_count);
}

static srp_vec3 jump_vector(const srp_jump *jump) {
    return srp_vec3_make((double)jump->q[0] * PUSH_UNIT, (double)jump->q[1] * PUSH_UNIT,
                         (double)jump->q[2] * PUSH_UNIT);
}

/*
 * What the lattice of every fourth sample from column p and row q finds, less what the whole one
 * finds, in cells of the whole one.
 *
 * Of the columns left of b, every fourth from p on are b/4 + W[(b - p) mod 4] + a constant; along a
 * row the constants cancel, because the jumps add up to 0. Summing by parts, four times the sum of
 * pushes over every fourth column of a row is the sum over the row plus 4 sum W jump.
 */
static void find_deviations(const srp_variation *variation, srp_vec3 deviation[SUB][SUB]) {
    static const double W[SUB] = {-0.375, 0.375, 0.125, -0.125};
    srp_vec3 rows[SUB], whole = {0.0, 0.0, 0.0};
    for (int q = 0; q < SUB; ++q) {
        rows[q] = jump_vector(&variation->row[q]);
        whole = srp_vec3_add(whole, rows[q]);
    }
    for (int q = 0; q < SUB; ++q) {
        for (int p = 0; p < SUB; ++p) {
            srp_vec3 d = srp_vec3_sub(srp_vec3_scale(SUB, rows[q]), whole);
            for (int b = 0; b < SUB; ++b) {
                srp_vec3 jump = jump_vector(&variation->edge[SUB * q + b]);
                d = srp_vec3_add_scaled(d, SUB * SUB * W[(b - p + SUB) % SUB], jump);
            }
            deviation[q][p] = d;
        }
    }
}

/* Weights of the scatter of lattices of two and four times the pitch in the variance of this one.
 * Were errors independent from cell to cell, 1/3 and 1/15 would each be right alone; along straight
 * edges they go down faster. Fitted once to the models and LRO, 32 to 1024 samples a side. */
static const double WEIGHT_2 = 1.0 / 9.0;
static const double WEIGHT_4 = 1.0 / 81.0;

static double turned_variance(const srp_variation *variation) {
    srp_vec3 deviation[SUB][SUB];
    find_deviations(variation, deviation);
    double by_4 = 0.0, by_2 = 0.0;
    for (int q = 0; q < SUB; ++q) {
        for (int p = 0; p < SUB; ++p) {
            by_4 += srp_vec3_dot(deviation[q][p], deviation[q][p]) / (SUB * SUB);
        }
    }
    for (int q = 0; q < 2; ++q) {
        for (int p = 0; p < 2; ++p) {
            srp_vec3 d = srp_vec3_add(srp_vec3_add(deviation[q][p], deviation[q][p + 2]),
                                      srp_vec3_add(deviation[q + 2][p], deviation[q + 2][p + 2]));
            by_2 += srp_vec3_dot(d, d) / (16.0 * 4.0);
        }
    }
    return WEIGHT_2 * by_2 + WEIGHT_4 * by_4;
}

/* An edge anywhere in its cell with equal chance has the variance 1/12 of a cell. Twice that,
 * because edges come in pairs: of a model that is symmetric about the window's centre opposite ones
 * err alike, and their common error has twice the variance of two independent ones. */
static double window_variance(const srp_variation *variation) {
    double sum = 0.0;
    for (size_t i = 0; i < variation->edge_count; ++i) {
        srp_vec3 jump = jump_vector(&variation->edge[i]);
        sum += srp_vec3_dot(jump, jump);
    }
    srp_vec3 before = {0.0, 0.0, 0.0};
    for (size_t j = 0; j < variation->row_count; ++j) {
        srp_vec3 row = jump_vector(&variation->row[j]);
        srp_vec3 jump = srp_vec3_sub(row, before);
        sum += srp_vec3_dot(jump, jump);
        before = row;
    }
    sum += srp_vec3_dot(before, before);
    return sum / 6.0;
}

double srp_variation_error(const srp_variation *variation, double cell) {
    double variance = variation->kind == SRP_LATTICE_WINDOW ? window_variance(variation)
                                                            : turned_variance(variation);
    return cell * sqrt(variance);
}
