/* SPDX-License-Identifier: Apache-2.0 */
#include "info_table.h"

#include "interp_check.h"
#include "json.h"
#include "messages.h"
#include "outputs.h"
#include "samples.h"

#include <srp/const.h>
#include <srp/table.h>

#include <math.h>
#include <stdio.h>

/* Lengths over all directions, each by its solid angle. */
typedef struct extent {
    double mean, low, high;
    double low_az_deg, low_el_deg, high_az_deg, high_el_deg;
} extent;

typedef struct summary {
    const char *path;
    const srp_table_format *format;
    const srp_table *table;
    const srp_table_info *info;
    srp_grid grid;
    size_t nodes, filled;
    extent force, moment, error; /* of complete tables; error: the standard error of f */
    double pull_share;
} summary;

/* ---- what is there ---- */

/* Less than this share of the largest is rounding, and 0; nor does it tell a direction from its
 * mirror image: of equals the first is named. */
static const double ROUNDING = 1e-12;

static void extent_add(extent *e, double value, const cli_direction *at) {
    e->mean += at->weight * value;
    if (value < e->low * (1.0 - ROUNDING)) {
        e->low = value;
        e->low_az_deg = at->az_deg;
        e->low_el_deg = at->el_deg;
    }
    if (!(value <= e->high * (1.0 + ROUNDING))) {
        e->high = value;
        e->high_az_deg = at->az_deg;
        e->high_el_deg = at->el_deg;
    }
}

static bool measure(const srp_table *table, bool moment, extent *out) {
    cli_samples samples;
    double most = 0.0;
    *out = (extent){.low = INFINITY, .high = -1.0};
    if (!cli_samples_take(table, srp_table_grid(table), moment, &samples)) {
        return false;
    }
    for (size_t k = 0; k < samples.count; ++k) {
        most = fmax(most, srp_vec3_norm(samples.value[k]));
    }
    for (size_t k = 0; k < samples.count; ++k) {
        double length = srp_vec3_norm(samples.value[k]);
        extent_add(out, length > ROUNDING * most ? length : 0.0, &samples.at[k]);
    }
    cli_samples_free(&samples);
    return true;
}

/* Nodes of the seam and the poles count by their part of the sphere. */
static void measure_error(const srp_table *table, srp_grid grid, extent *out) {
    *out = (extent){.low = INFINITY, .high = -1.0};
    for (uint32_t i = 0; i < grid.az_count; ++i) {
        for (uint32_t j = 0; j < grid.el_count; ++j) {
            const cli_direction at = {.az_deg = srp_grid_azimuth_deg(grid, i),
                                      .el_deg = srp_grid_elevation_deg(grid, j),
                                      .weight = srp_grid_solid_angle(grid, i, j) / (4.0 * SRP_PI)};
            extent_add(out, srp_table_node(table, i, j)->f_error, &at);
        }
    }
}

static int look(summary *s) {
    s->info = srp_table_get_info(s->table);
    s->grid = srp_table_grid(s->table);
    s->nodes = srp_grid_node_count(s->grid);
    s->filled = srp_table_filled_count(s->table);
    if (s->filled < s->nodes) {
        return CLI_DONE;
    }
    if (!measure(s->table, false, &s->force) ||
        (s->info->has_moment && !measure(s->table, true, &s->moment))) {
        cli_say("no memory for the report");
        return CLI_MACHINE_FAILED;
    }
    if (s->info->has_error) {
        measure_error(s->table, s->grid, &s->error);
    }
    s->pull_share = srp_table_pull_share(s->table);
    return CLI_DONE;
}

/* ---- text ---- */

static const char *stated(const char *text) {
    return text[0] != '\0' ? text : "not stated";
}

static void print_origin(const summary *s) {
    const srp_table_info *info = s->info;
    srp_vec3 about = info->params.reference;
    printf("%-15s %s\n", "title", stated(info->title));
    printf("%-15s %s%s%s%s\n", "method", stated(info->method), info->device[0] != '\0' ? " (" : "",
           info->device, info->device[0] != '\0' ? ")" : "");
    printf("%-15s %s%s\n", "made by", info->version[0] != '\0' ? "srpcore " : "",
           stated(info->version));
    printf("%-15s %s\n", "command", stated(info->command_line));
    if (info->traced_command_line[0] != '\0') {
        printf("%-15s %s\n", "traced by", info->traced_command_line);
    }
    if (isnan(info->mass)) {
        printf("%-15s not stated\n", "mass");
    } else {
        printf("%-15s %g kg\n", "mass", info->mass);
    }
    printf("%-15s %g W/m^2 at 1 au = %.9g km\n", "sunlight", info->light.flux,
           info->light.au / 1000.0);
    if (info->has_moment) {
        printf("%-15s (%g, %g, %g) m\n", "moments about", about.x, about.y, about.z);
    }
}

static void print_content(const summary *s) {
    const srp_table_info *info = s->info;
    printf("%-15s forces%s%s%s\n", "holds", info->has_moment ? ", moments" : "",
           info->has_error ? ", standard errors" : "",
           info->has_basis ? ", sums per material" : "");
    printf("%-15s %u x %u nodes, steps of %g x %g degrees", "grid", s->grid.az_count,
           s->grid.el_count, 360.0 / (s->grid.az_count - 1), 180.0 / (s->grid.el_count - 1));
    if (s->filled < s->nodes) {
        printf("; only %zu of %zu are filled", s->filled, s->nodes);
    }
    fputc('\n', stdout);
}

static void print_extent(const char *name, const extent *e, const char *unit) {
    printf("%-15s %12.6g %12.6g %12.6g %-5s  %7g, %-7g  %7g, %g\n", name, e->mean, e->low, e->high,
           unit, e->low_az_deg, e->low_el_deg, e->high_az_deg, e->high_el_deg);
}

static void print_lengths(const summary *s) {
    printf("\n%-15s %12s %12s %12s %-5s  %-16s  %s\n", "", "mean", "smallest", "largest", "",
           "smallest at az, el", "largest at az, el [deg]");
    print_extent("|f|", &s->force, "m^2");
    if (s->info->has_moment) {
        print_extent("|t|", &s->moment, "m^3");
    }
    if (s->info->has_error && s->error.high > 0.0) {
        print_extent("standard error", &s->error, "m^2");
    } else {
        printf("%-15s %s\n", "standard error",
               s->info->has_error ? "0: no sampling" : "not known: the format holds none");
    }
    if (!isnan(s->info->mass)) {
        double factor = srp_sunlight_pressure(s->info->light, s->info->light.au) / s->info->mass;
        printf("%-15s %12.6g %12.6g %12.6g m/s^2, at 1 au\n", "acceleration",
               factor * s->force.mean, factor * s->force.low, factor * s->force.high);
    }
}

static void print_materials(const srp_table *table) {
    size_t count = srp_table_material_count(table);
    if (count == 0) {
        return;
    }
    printf("\n%-24s %7s  %7s\n", "material", "rho_s", "rho_d");
    for (size_t k = 0; k < count; ++k) {
        srp_optics optics = srp_table_material_optics(table, k);
        const char *name = srp_table_material_name(table, k);
        printf("%-24s %7g  %7g%s\n", name[0] != '\0' ? name : "(no name)", optics.rho_s,
               optics.rho_d, optics.one_sided ? "  one-sided" : "");
    }
}

/* What the library finds odd, as a list. */
static void print_finding(void *user, const srp_error *what) {
    bool *any = user;
    fputs(*any ? "- " : "\nFindings:\n- ", stdout);
    if (what->line > 0) {
        printf("line %zu: ", what->line);
    }
    puts(what->message);
    *any = true;
}

static void print_findings(const summary *s) {
    bool any = false;
    const srp_log log = {print_finding, &any};
    srp_table_report report;
    if (s->pull_share > SRP_TABLE_PULL_LIMIT) {
        srp_error what = {.line = 0};
        snprintf(what.message, sizeof what.message,
                 "light pulls from %.0f %% of the directions: the signs follow the opposite "
                 "convention; 'srp convert --flip' turns them round",
                 100.0 * s->pull_share);
        print_finding(&any, &what);
    }
    srp_table_inspect(s->table, s->path, &log, &report);
}

static void print_text(const summary *s) {
    printf("%s: a table (%s)\n\n", s->path, s->format->name);
    print_origin(s);
    print_content(s);
    if (s->filled == s->nodes) {
        print_lengths(s);
        cli_interp_check_report(s->table);
    }
    print_materials(s->table);
    if (s->filled == s->nodes) {
        print_findings(s);
    }
}

/* ---- JSON ---- */

static void write_extent(cli_json *json, const char *name, const extent *e) {
    cli_json_open_object(json, name);
    cli_json_number(json, "mean", e->mean);
    cli_json_number(json, "smallest", e->low);
    cli_json_number(json, "smallest_azimuth_deg", e->low_az_deg);
    cli_json_number(json, "smallest_elevation_deg", e->low_el_deg);
    cli_json_number(json, "largest", e->high);
    cli_json_number(json, "largest_azimuth_deg", e->high_az_deg);
    cli_json_number(json, "largest_elevation_deg", e->high_el_deg);
    cli_json_close_object(json);
}

static void write_values(cli_json *json, const summary *s) {
    write_extent(json, "f_m2", &s->force);
    if (s->info->has_moment) {
        write_extent(json, "t_m3", &s->moment);
    }
    if (s->info->has_error) {
        write_extent(json, "f_error_m2", &s->error);
    }
    cli_json_number(json, "pull_share", s->pull_share);
    srp_table_report report;
    srp_table_inspect(s->table, s->path, NULL, &report);
    cli_json_number(json, "pole_spread_m2", fmax(report.pole_spread[0], report.pole_spread[1]));
    cli_json_number(json, "seam_spread_m2", report.seam_spread);
    cli_json_number(json, "quantum_m2", report.quantum);
}

static void write_materials(cli_json *json, const srp_table *table) {
    cli_json_open_array(json, "materials");
    for (size_t k = 0; k < srp_table_material_count(table); ++k) {
        srp_optics optics = srp_table_material_optics(table, k);
        cli_json_open_object(json, NULL);
        cli_json_text(json, "name", srp_table_material_name(table, k));
        cli_json_number(json, "rho_s", optics.rho_s);
        cli_json_number(json, "rho_d", optics.rho_d);
        cli_json_flag(json, "one_sided", optics.one_sided);
        cli_json_close_object(json);
    }
    cli_json_close_array(json);
}

static void write_json(const summary *s) {
    const srp_table_info *info = s->info;
    cli_json json;
    cli_json_begin(&json, stdout);
    cli_json_text(&json, "path", s->path);
    cli_json_text(&json, "format", s->format->name);
    cli_json_text(&json, "title", info->title);
    cli_json_text(&json, "method", info->method);
    cli_json_text(&json, "device", info->device);
    cli_json_text(&json, "version", info->version);
    cli_json_text(&json, "command_line", info->command_line);
    cli_json_text(&json, "shape_hash", info->shape_hash);
    cli_json_text(&json, "optics_hash", info->optics_hash);
    cli_json_number(&json, "mass_kg", info->mass);
    cli_json_number(&json, "flux_w_m2", info->light.flux);
    cli_json_number(&json, "au_m", info->light.au);
    cli_json_vector(&json, "reference_m", info->params.reference);
    cli_json_flag(&json, "has_moment", info->has_moment);
    cli_json_flag(&json, "has_error", info->has_error);
    cli_json_flag(&json, "has_basis", info->has_basis);
    cli_json_number(&json, "azimuth_step_deg", 360.0 / (s->grid.az_count - 1));
    cli_json_number(&json, "elevation_step_deg", 180.0 / (s->grid.el_count - 1));
    cli_json_count(&json, "nodes", s->nodes);
    cli_json_count(&json, "filled", s->filled);
    if (s->filled == s->nodes) {
        write_values(&json, s);
    }
    write_materials(&json, s->table);
    cli_json_end(&json);
}

int cli_info_table(const char *path, bool json) {
    srp_table *table = NULL;
    srp_error error;
    summary s = {.path = path, .format = cli_input_format_of(path)};
    if (srp_table_read(s.format, path, &table, &error) != SRP_OK) {
        return cli_input_error(&error);
    }
    s.table = table;
    int status = look(&s);
    if (status == CLI_DONE) {
        json ? write_json(&s) : print_text(&s);
    }
    srp_table_destroy(table);
    return status;
}
