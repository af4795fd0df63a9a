/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Interpolants: making one from a table, asking it.
 *
 * Before a scheme of order 3 or 4 sees the nodes, a field a + M s is taken off them, and added
 * again, with its exact derivatives, to what comes out. It is the one that fits the six nodes
 * nearest to the axes best, so that nothing but those need be known. Most of what sunlight does to
 * a spacecraft is of that form, and all that it does to a sphere.
 */
#include "error.h"
#include "interp_internal.h"

#include <srp/const.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Schemes -------------------------------------------------------------------------------- */

static const srp_interp_scheme *const SCHEMES[] = {&srp_interp_bilinear, &srp_interp_bicubic,
                                                   &srp_interp_spline};

_Static_assert(sizeof SCHEMES / sizeof SCHEMES[0] == SRP_TABLE_SCHEMES,
               "tables keep the errors of all schemes");

const srp_interp_scheme *const *srp_interp_list(size_t *count) {
    *count = sizeof SCHEMES / sizeof SCHEMES[0];
    return SCHEMES;
}

const srp_interp_scheme *srp_interp_find(const char *name) {
    for (size_t k = 0; k < sizeof SCHEMES / sizeof SCHEMES[0]; ++k) {
        if (strcmp(SCHEMES[k]->name, name) == 0) {
            return SCHEMES[k];
        }
    }
    return NULL;
}

/* ---- Nodes from the table ------------------------------------------------------------------- */

static void put_vec3(double *at, srp_vec3 v) {
    at[0] = v.x;
    at[1] = v.y;
    at[2] = v.z;
}

/* Node (i, j) of the grid to `at`. */
static srp_status put_response(const srp_interp *interp, srp_grid grid, uint32_t i, uint32_t j,
                               const srp_response *node, double *at, srp_error *error) {
    if (!(srp_vec3_is_finite(node->f) && srp_vec3_is_finite(node->t))) {
        return srp_fail(error, SRP_BAD_DATA,
                        "the node at azimuth %g, elevation %g degrees is not finite",
                        srp_grid_azimuth_deg(grid, i), srp_grid_elevation_deg(grid, j));
    }
    put_vec3(at, node->f);
    if (interp->has_moment) {
        put_vec3(at + SRP_INTERP_T, node->t);
    }
    return SRP_OK;
}

/* Column i may be the last one, which says the same as the first. Empty nodes are 0. */
static srp_status copy_column(srp_interp *interp, const srp_table *table, uint32_t i, double *out,
                              srp_error *error) {
    srp_status status = SRP_OK;
    memset(out, 0, srp_interp_column_size(interp) * sizeof *out);
    for (uint32_t j = 0; j <= interp->rows && status == SRP_OK; ++j) {
        const srp_response *node = srp_table_node(table, i, j);
        if (node != NULL) {
            status = put_response(interp, srp_table_grid(table), i, j, node,
                                  out + ((size_t)j + 1) * interp->width, error);
        }
    }
    return status;
}

/* Adds `factor` times the difference to `other`, so that equal numbers stay as they are. */
static void draw_towards(double *at, const double *other, double factor, size_t count) {
    for (size_t k = 0; k < count; ++k) {
        at[k] += factor * (other[k] - at[k]);
    }
}

/* One value for each pole: the mean of its nodes. */
static void join_pole(srp_interp *interp, int north) {
    long j = north ? (long)interp->rows : 0;
    const double *first = srp_interp_node(interp, 0, j);
    double *value = interp->poles[north].value;
    for (size_t k = 0; k < interp->width; ++k) {
        double sum = 0.0;
        for (uint32_t i = 0; i < interp->columns; ++i) {
            sum += srp_interp_node(interp, (long)i, j)[k] - first[k];
        }
        value[k] = first[k] + sum / interp->columns;
    }
    for (uint32_t i = 0; i < interp->columns; ++i) {
        memcpy(srp_interp_node(interp, (long)i, j), value, interp->width * sizeof *value);
    }
}

static srp_status copy_nodes(srp_interp *interp, const srp_table *table, srp_error *error) {
    srp_status status = SRP_OK;
    for (uint32_t i = 0; i <= interp->columns && status == SRP_OK; ++i) {
        double *column = srp_interp_node(interp, (long)i, -1);
        status = copy_column(interp, table, i, column, error);
    }
    if (status != SRP_OK) {
        return status;
    }
    draw_towards(srp_interp_node(interp, 0, -1), srp_interp_node(interp, (long)interp->columns, -1),
                 0.5, srp_interp_column_size(interp));
    join_pole(interp, 0);
    join_pole(interp, 1);
    return SRP_OK;
}

void srp_interp_repeat_columns(srp_interp *interp) {
    size_t bytes = srp_interp_column_size(interp) * sizeof *interp->nodes;
    const long columns[] = {-1, (long)interp->columns, (long)interp->columns + 1};
    for (size_t k = 0; k < sizeof columns / sizeof columns[0]; ++k) {
        long from = srp_interp_repeated(interp, columns[k]);
        memcpy(srp_interp_node(interp, columns[k], -1), srp_interp_node(interp, from, -1), bytes);
    }
}

/* ---- The linear part ------------------------------------------------------------------------ */

void srp_interp_axis_nodes(const srp_interp *interp, uint32_t at[6][2]) {
    uint32_t n = interp->columns, middle = interp->rows / 2;
    for (uint32_t k = 0; k < 4; ++k) {
        at[k][0] = ((k + 2) * n + 2) / 4 % n;
        at[k][1] = middle;
    }
    at[4][0] = at[5][0] = 0;
    at[4][1] = 0;
    at[5][1] = interp->rows;
}

/* Solves a x = b for all components by elimination with pivots; a is symmetric and positive. */
static void solve(double a[4][4], double x[4][SRP_INTERP_WIDTH_FT]) {
    for (int c = 0; c < 4; ++c) {
        int pivot = c;
        for (int r = c + 1; r < 4; ++r) {
            pivot = fabs(a[r][c]) > fabs(a[pivot][c]) ? r : pivot;
        }
        for (int k = 0; k < 4; ++k) {
            double swap = a[c][k];
            a[c][k] = a[pivot][k];
            a[pivot][k] = swap;
        }
        for (int k = 0; k < SRP_INTERP_WIDTH_FT; ++k) {
            double swap = x[c][k];
            x[c][k] = x[pivot][k];
            x[pivot][k] = swap;
        }
        for (int r = 0; r < 4; ++r) {
            double factor = r == c ? 0.0 : a[r][c] / a[c][c];
            for (int k = 0; k < 4; ++k) {
                a[r][k] -= factor * a[c][k];
            }
            for (int k = 0; k < SRP_INTERP_WIDTH_FT; ++k) {
                x[r][k] -= factor * x[c][k];
            }
        }
    }
    for (int c = 0; c < 4; ++c) {
        for (int k = 0; k < SRP_INTERP_WIDTH_FT; ++k) {
            x[c][k] /= a[c][c];
        }
    }
}

/* Least squares over the six nodes. */
static void fit_linear(srp_interp *interp, srp_grid grid) {
    uint32_t at[6][2];
    double normal[4][4] = {{0.0}};
    srp_interp_axis_nodes(interp, at);
    memset(interp->linear, 0, sizeof interp->linear);
    for (int node = 0; node < 6; ++node) {
        srp_vec3 s = srp_grid_direction(grid, at[node][0], at[node][1]);
        const double *value = srp_interp_node(interp, at[node][0], at[node][1]);
        const double term[4] = {1.0, s.x, s.y, s.z};
        for (int r = 0; r < 4; ++r) {
            for (int c = 0; c < 4; ++c) {
                normal[r][c] += term[r] * term[c];
            }
            for (size_t k = 0; k < interp->width; ++k) {
                interp->linear[r][k] += term[r] * value[k];
            }
        }
    }
    solve(normal, interp->linear);
}

static void take_linear_off_node(srp_interp *interp, srp_grid grid, uint32_t i, uint32_t j) {
    srp_vec3 s = srp_grid_direction(grid, i, j);
    double *value = srp_interp_node(interp, (long)i, (long)j);
    for (size_t k = 0; k < interp->width; ++k) {
        value[k] -= interp->linear[0][k] + s.x * interp->linear[1][k] + s.y * interp->linear[2][k] +
                    s.z * interp->linear[3][k];
    }
}

static void take_linear_off(srp_interp *interp, srp_grid grid) {
    for (uint32_t i = 0; i < interp->columns; ++i) {
        for (uint32_t j = 0; j <= interp->rows; ++j) {
            take_linear_off_node(interp, grid, i, j);
        }
    }
    memcpy(interp->poles[0].value, srp_interp_node(interp, 0, 0),
           interp->width * sizeof interp->nodes[0]);
    memcpy(interp->poles[1].value, srp_interp_node(interp, 0, (long)interp->rows),
           interp->width * sizeof interp->nodes[0]);
}

/* ---- Poles ---------------------------------------------------------------------------------- */

/* Nodes of the rows next to the poles that slopes are fitted to: the smallest divisor of the number
 * of columns that tells the first harmonic from those up to the sixth, else all. */
static uint32_t slope_nodes(uint32_t columns) {
    for (uint32_t count = 8; count < columns; ++count) {
        if (columns % count == 0) {
            return count;
        }
    }
    return columns;
}

uint32_t srp_interp_slope_nodes(const srp_interp *interp) {
    uint32_t count = slope_nodes(interp->columns);
    return count < 3 ? 0 : count; /* no first harmonic in fewer */
}

void srp_interp_column_direction(const srp_interp *interp, uint32_t i, double *cosine,
                                 double *sine) {
    srp_vec3 s = srp_direction_from_deg(360.0 * i / interp->columns - 180.0, 0.0);
    *cosine = s.x;
    *sine = s.y;
}

void srp_interp_fit_slopes(srp_interp *interp) {
    uint32_t count = srp_interp_slope_nodes(interp);
    if (count == 0) {
        return;
    }
    uint32_t step = interp->columns / count;
    for (int north = 0; north < 2; ++north) {
        srp_interp_pole *pole = &interp->poles[north];
        long j = north ? (long)interp->rows - 1 : 1;
        for (uint32_t node = 0; node < count; ++node) {
            double c, s;
            srp_interp_column_direction(interp, node * step, &c, &s);
            const double *value = srp_interp_node(interp, (long)(node * step), j);
            for (size_t k = 0; k < interp->width; ++k) {
                pole->slope[0][k] += 2.0 / count * c * (value[k] - pole->value[k]);
                pole->slope[1][k] += 2.0 / count * s * (value[k] - pole->value[k]);
            }
        }
    }
}

/* ---- Making and ending ---------------------------------------------------------------------- */

void srp_interp_set_grid(srp_interp *interp, uint32_t columns, uint32_t rows) {
    /* Quarters of a turn and halves of the way from pole to pole. */
    static const double AZ_BASE[8] = {2, 2, 4, 0, 3, 1, 3, 1};
    static const double AZ_SIGN[8] = {1, -1, -1, 1, -1, 1, 1, -1};
    static const double EL_BASE[4] = {1, 1, 2, 0};
    static const double EL_SIGN[4] = {1, -1, -1, 1};
    interp->columns = columns;
    interp->rows = rows;
    interp->columns_per_rad = columns / (2.0 * SRP_PI);
    interp->rows_per_rad = rows / SRP_PI;
    for (int k = 0; k < 8; ++k) {
        interp->az_base[k] = 0.25 * AZ_BASE[k] * columns;
        interp->az_scale[k] = AZ_SIGN[k] * interp->columns_per_rad;
    }
    for (int k = 0; k < 4; ++k) {
        interp->el_base[k] = 0.5 * EL_BASE[k] * rows;
        interp->el_scale[k] = EL_SIGN[k] * interp->rows_per_rad;
    }
}

/* Memory for the nodes; srp_interp_destroy() gives it back whatever else fails. */
static srp_status set_up(srp_interp *interp, const srp_interp_scheme *scheme,
                         const srp_table *table, srp_error *error) {
    srp_grid grid = srp_table_grid(table);
    interp->scheme = scheme;
    interp->has_moment = srp_table_get_info(table)->has_moment;
    interp->width = interp->has_moment ? SRP_INTERP_WIDTH_FT : SRP_INTERP_WIDTH_F;
    srp_interp_set_grid(interp, grid.az_count - 1, grid.el_count - 1);
    size_t size = ((size_t)interp->columns + 3) * srp_interp_column_size(interp);
    /* A whole number of the lines that it is aligned to. */
    interp->nodes = aligned_alloc(64, (size * sizeof *interp->nodes + 63) / 64 * 64);
    if (interp->nodes == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for an interpolant of %zu nodes",
                        srp_grid_node_count(grid));
    }
    memset(interp->nodes, 0, size * sizeof *interp->nodes);
    srp_status status = copy_nodes(interp, table, error);
    if (status == SRP_OK && (scheme->capabilities & SRP_INTERP_LINEAR)) {
        fit_linear(interp, grid);
        take_linear_off(interp, grid);
    }
    return status == SRP_OK ? scheme->prepare(interp, error) : status;
}

srp_status srp_interp_check_steps(const srp_interp_scheme *scheme, srp_grid grid,
                                  srp_error *error) {
    if (grid.az_count - 1 < scheme->steps_min || 2 * (grid.el_count - 1) < scheme->steps_min) {
        return srp_fail(error, SRP_BAD_ARGUMENT,
                        "steps of %g x %g degrees, %s takes at most %g degrees",
                        360.0 / (grid.az_count - 1), 180.0 / (grid.el_count - 1), scheme->name,
                        360.0 / scheme->steps_min);
    }
    return SRP_OK;
}

srp_status srp_interp_create(const srp_interp_scheme *scheme, const srp_table *table,
                             srp_interp **out, srp_error *error) {
    if (!srp_table_is_complete(table)) {
        return srp_fail(error, SRP_BAD_ARGUMENT,
                        "the table holds %zu of %zu nodes, expected a complete one",
                        srp_table_filled_count(table), srp_grid_node_count(srp_table_grid(table)));
    }
    return srp_interp_create_partial(scheme, table, out, error);
}

srp_status srp_interp_create_partial(const srp_interp_scheme *scheme, const srp_table *table,
                                     srp_interp **out, srp_error *error) {
    srp_status status = srp_interp_check_steps(scheme, srp_table_grid(table), error);
    if (status != SRP_OK) {
        return status;
    }
    srp_interp *interp = calloc(1, sizeof *interp);
    if (interp == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for an interpolant");
    }
    status = set_up(interp, scheme, table, error);
    if (status != SRP_OK) {
        srp_interp_destroy(interp);
        return status;
    }
    *out = interp;
    return SRP_OK;
}

/* To the columns before the first and behind the last, if they repeat this one. */
static void repeat_node(srp_interp *interp, long i, long j) {
    const long columns[] = {-1, (long)interp->columns, (long)interp->columns + 1};
    const double *from = srp_interp_node(interp, i, j);
    for (size_t k = 0; k < sizeof columns / sizeof columns[0]; ++k) {
        if (srp_interp_repeated(interp, columns[k]) == i) {
            memcpy(srp_interp_node(interp, columns[k], j), from, interp->width * sizeof *from);
        }
    }
}

srp_status srp_interp_put_node(srp_interp *interp, srp_grid grid, uint32_t i, uint32_t j,
                               const srp_response *response, srp_error *error) {
    const srp_interp_scheme *scheme = interp->scheme;
    double *at = srp_interp_node(interp, (long)i, (long)j);
    srp_status status = put_response(interp, grid, i, j, response, at, error);
    if (status != SRP_OK) {
        return status;
    }
    if (i == 0) {
        draw_towards(at, at, 0.5, interp->width); /* as in copy_nodes(), to the sign of 0 */
    }
    if (scheme->capabilities & SRP_INTERP_LINEAR) {
        take_linear_off_node(interp, grid, i, j);
    }
    repeat_node(interp, (long)i, (long)j);
    for (int north = 0; scheme->extend != NULL && north < 2; ++north) {
        if (j == (north ? interp->rows - 1 : 1)) {
            scheme->extend(interp, i, north);
            repeat_node(interp, (long)i, north ? (long)interp->rows + 1 : -1);
        }
    }
    return SRP_OK;
}

void srp_interp_destroy(srp_interp *interp) {
    if (interp != NULL) {
        srp_interp_supply_destroy(interp->supply);
        free(interp->nodes);
        free(interp);
    }
}

const srp_interp_scheme *srp_interp_get_scheme(const srp_interp *interp) {
    return interp->scheme;
}

bool srp_interp_has_moment(const srp_interp *interp) {
    return interp->has_moment;
}

/* ---- Asking --------------------------------------------------------------------------------- */

srp_status srp_interp_eval(const srp_interp *interp, srp_vec3 s_body, srp_vec3 *f, srp_vec3 *t,
                           srp_interp_jacobian *jacobian, srp_error *error) {
    srp_interp_target to = {f, t, jacobian};
    if (interp->supply != NULL) {
        srp_status status = srp_interp_supply_at(interp, &s_body, error);
        if (status != SRP_OK) {
            return status;
        }
    }
    if (interp->scheme->eval(interp, &s_body, &to)) {
        return SRP_OK;
    }
    return srp_fail(error, SRP_BAD_ARGUMENT,
                    "direction (%.17g, %.17g, %.17g), expected a unit vector", s_body.x, s_body.y,
                    s_body.z);
}
