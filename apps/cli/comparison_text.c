/* SPDX-License-Identifier: Apache-2.0 */
#include "comparison.h"
#include "table_input.h"

#include <math.h>

static void print_rows(FILE *out, const cli_difference *d, double factor, const char *unit,
                       const char *squared) {
    char mse[32], rms[32], mean[32], largest[32];
    snprintf(mse, sizeof mse, "MSE [%s]", squared);
    snprintf(rms, sizeof rms, "RMS [%s]", unit);
    snprintf(mean, sizeof mean, "mean [%s]", unit);
    snprintf(largest, sizeof largest, "largest [%s]", unit);
    fprintf(out, "\n%-7s %15s %13s %13s %16s %8s %8s\n", "B - A", mse, rms, mean, largest,
            "az [deg]", "el [deg]");
    for (int c = 0; c < CLI_DIFFERENCE_COUNT; ++c) {
        const cli_difference_row *row = &d->row[c];
        fprintf(out, "%-7s %15.6e %13.6e %13.6e %16.6e %8g %8g\n", CLI_DIFFERENCE_NAME[c],
                factor * factor * row->mse, factor * row->rms, factor * row->mean,
                factor * row->largest, row->az_deg, row->el_deg);
    }
}

static void print_relative(FILE *out, const cli_difference *d) {
    fprintf(out, "\n%-7s %15s %13s %13s %16s\n", "/ A", "", "RMS", "mean", "largest");
    for (int c = 0; c < CLI_DIFFERENCE_COUNT; ++c) {
        const cli_difference_row *row = &d->row[c];
        fprintf(out, "%-7s %15s %13.6e %13.6e %16.6e\n", CLI_DIFFERENCE_NAME[c], "",
                row->rms / d->mean_a, row->mean / d->mean_a, row->largest / d->mean_a);
    }
}

double cli_acceleration_of_area(double mass, srp_sunlight light) {
    return srp_sunlight_pressure(light, light.au) / mass;
}

void cli_comparison_print(FILE *out, const cli_comparison *c, double mass, srp_sunlight light) {
    const char *unit = c->moment ? "m^3" : "m^2";
    for (int k = 0; k < 2; ++k) {
        char summary[256];
        cli_table_summary(c->table[k], summary, sizeof summary);
        fprintf(out, "%c          %s: %s%s%s\n", k == 0 ? 'A' : 'B', c->name[k], summary,
                c->is_interpolated[k] ? ", interpolated: " : "",
                c->is_interpolated[k] ? c->scheme->name : "");
    }
    fprintf(out,
            "compared   %s [%s] from %zu directions, steps of %g x %g degrees, each by its solid "
            "angle\n",
            c->moment ? "moments" : "forces", unit, c->directions, 360.0 / (c->grid.az_count - 1),
            180.0 / (c->grid.el_count - 1));
    fprintf(out, "mean size  A %.6g %s, B %.6g %s\n", c->difference.mean_a, unit,
            c->difference.mean_b, unit);
    print_rows(out, &c->difference, 1.0, unit, c->moment ? "m^6" : "m^4");
    print_relative(out, &c->difference);
    if (!c->moment && !isnan(mass)) {
        fprintf(out, "\nAccelerations of %g kg, 1 au from the Sun, %g W/m^2:\n", mass, light.flux);
        print_rows(out, &c->difference, cli_acceleration_of_area(mass, light), "m/s^2", "m^2/s^4");
    }
}
