/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Tables for tests: a method that answers every direction with numbers of its own in every member,
 * so that whatever a file format loses or swaps shows.
 */
#ifndef TABLE_FIXTURE_H
#define TABLE_FIXTURE_H

#include <srp/table.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Takes plates; gives force, moment, errors, samples, flags and sums, all different from one
 * direction to the next. f.s < 0 everywhere. */
extern const srp_method noise_method;
/* How many directions noise_method answers before it is out of memory; SIZE_MAX = all. */
extern size_t noise_directions_left;

typedef struct table_fixture {
    srp_scene *scene;
    srp_prepared *prepared;
} table_fixture;

/* Two plates of different optics under `method`, on `threads` threads; defaults otherwise. */
table_fixture fixture_create(const srp_method *method, const srp_method_params *params);
void fixture_destroy(table_fixture fixture);
srp_method_params fixture_params(int threads);

srp_grid grid_of(double az_step_deg, double el_step_deg);
/* A filled table of noise, described. */
srp_table *noise_table(const table_fixture *fixture, srp_grid grid, bool with_basis);

/* All that two tables hold is the same to the bit. */
void assert_same_table(const srp_table *a, const srp_table *b);

/* Name of a file of this test in the working directory, removed by remove_file(). */
const char *scratch_path(const char *ending);
void write_bytes(const char *path, const void *bytes, size_t size);
/* Freed by free(). */
char *read_bytes(const char *path, size_t *size);

#endif
