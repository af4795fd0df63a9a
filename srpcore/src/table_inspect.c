/* SPDX-License-Identifier: Apache-2.0 */
/* What may be odd about the numbers of a table. */
#include "error.h"
#include "table_internal.h"

#include <math.h>

/* Shares of the largest |f| from which spreads, rounding and a wrong |f| are worth a word. */
static const double SPREAD_MIN = 1e-9;
static const double QUANTUM_MIN = 1e-7;
static const double TOTAL_MIN = 1e-4;
/* Few numbers are round by chance. */
static const size_t QUANTUM_NODES_MIN = 24;

static double pole_spread(const srp_table *table, uint32_t j) {
    uint32_t count = table->grid.az_count - 1; /* the last one is the first */
    const srp_vec3 first = srp_table_node(table, 0, j)->f;
    srp_vec3 mean = first; /* by differences: equal numbers have themselves as their mean */
    double spread = 0.0;
    for (uint32_t i = 0; i < count; ++i) {
        srp_vec3 off = srp_vec3_sub(srp_table_node(table, i, j)->f, first);
        mean = srp_vec3_add_scaled(mean, 1.0 / count, off);
    }
    for (uint32_t i = 0; i < count; ++i) {
        spread = fmax(spread, srp_vec3_norm(srp_vec3_sub(srp_table_node(table, i, j)->f, mean)));
    }
    return spread;
}

static double seam_spread(const srp_table *table) {
    double spread = 0.0;
    for (uint32_t j = 0; j < table->grid.el_count; ++j) {
        srp_vec3 first = srp_table_node(table, 0, j)->f;
        srp_vec3 last = srp_table_node(table, table->grid.az_count - 1, j)->f;
        spread = fmax(spread, srp_vec3_norm(srp_vec3_sub(first, last)));
    }
    return spread;
}

/* Whether x is a multiple of 1/scale, as far as decimal digits go through doubles. */
static bool is_multiple(double x, double scale) {
    double y = x * scale;
    return fabs(y - round(y)) <= 1e-14 * fabs(y) + 1e-9;
}

static bool all_are_multiples(const srp_table *table, double scale) {
    size_t count = srp_grid_node_count(table->grid);
    for (size_t k = 0; k < count; ++k) {
        srp_vec3 f = table->nodes[k].f;
        if (!(is_multiple(f.x, scale) && is_multiple(f.y, scale) && is_multiple(f.z, scale))) {
            return false;
        }
    }
    return true;
}

static double quantum(const srp_table *table, double f_max) {
    if (srp_grid_node_count(table->grid) < QUANTUM_NODES_MIN) {
        return 0.0;
    }
    for (int digits = -6; digits <= 12; ++digits) {
        double scale = pow(10.0, digits);
        if (1.0 / scale < QUANTUM_MIN * f_max || !(f_max > 0.0)) {
            break;
        }
        if (1.0 / scale <= f_max && all_are_multiples(table, scale)) {
            return 1.0 / scale;
        }
    }
    return 0.0;
}

/* A column of |f| that its row belies: the text was changed by hand, or is not what it seems. */
static void warn_of_total(const srp_table *table, const srp_table_report *report, const char *name,
                          const srp_log *log) {
    if (table->total.off > fmax(4.0 * report->quantum, TOTAL_MIN * report->f_max)) {
        srp_warn_at(log, name, table->total.line, 0,
                    "the sixth column says a |f| of %.6g m^2, which is %.3g m^2 from that of the "
                    "components before it; these count",
                    table->total.said, table->total.off);
    }
}

static void warn(const srp_table_report *report, const char *name, const srp_log *log) {
    static const char *const POLES[2] = {"-90", "90"};
    double least = SPREAD_MIN * report->f_max;
    for (int north = 0; north < 2; ++north) {
        if (report->pole_spread[north] > least) {
            srp_warn_at(
                log, name, 0, 0,
                "the nodes at elevation %s are one direction, but f differs by up to %.3g "
                "m^2 from its mean (%.2g %% of the largest |f|); interpolants take the mean",
                POLES[north], report->pole_spread[north],
                100.0 * report->pole_spread[north] / report->f_max);
        }
    }
    if (report->seam_spread > least) {
        srp_warn_at(log, name, 0, 0,
                    "azimuths -180 and 180 are one direction, but f differs by up to %.3g m^2 "
                    "between them; interpolants take the mean",
                    report->seam_spread);
    }
    if (report->quantum > 0.0) {
        srp_warn_at(log, name, 0, 0, "forces are rounded to %g m^2 (%.2g %% of the largest |f|)",
                    report->quantum, 100.0 * report->quantum / report->f_max);
    }
}

void srp_table_inspect(const srp_table *table, const char *name, const srp_log *log,
                       srp_table_report *out) {
    srp_table_report report = {{0.0, 0.0}, 0.0, 0.0, 0.0};
    size_t count = srp_grid_node_count(table->grid);
    for (size_t k = 0; k < count; ++k) {
        report.f_max = fmax(report.f_max, srp_vec3_norm(table->nodes[k].f));
    }
    report.pole_spread[0] = pole_spread(table, 0);
    report.pole_spread[1] = pole_spread(table, table->grid.el_count - 1);
    report.seam_spread = seam_spread(table);
    report.quantum = quantum(table, report.f_max);
    warn(&report, name, log);
    warn_of_total(table, &report, name, log);
    if (out != NULL) {
        *out = report;
    }
}
