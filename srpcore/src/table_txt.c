/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Tables as plain text (.txt): one row `az el ax ay az |a|` per node, accelerations in m/s^2 of a
 * given mass at 1 AU, as the tool of AAS 20-481 writes them; azimuth in the outer loop. Lines that
 * begin with '#' say what the numbers were made with: `# key: value`.
 *
 *     a = (P0 / c) f / m,  |a| its norm
 */
#include "error.h"
#include "limits.h"
#include "platform.h"
#include "table_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Acceleration per area [m/s^2 per m^2] at 1 AU. */
static double acceleration_per_area(srp_sunlight light, double mass) {
    return srp_sunlight_pressure(light, light.au) / mass;
}

/* Keys of the numbers in the head. */
static const char KEY_TITLE[] = "title";
static const char KEY_SOFTWARE[] = "software";
static const char KEY_MASS[] = "mass [kg]";
static const char KEY_FLUX[] = "solar flux [W/m^2]";
static const char KEY_AU[] = "astronomical unit [m]";
static const char KEY_AZ_STEP[] = "azimuth step [deg]";
static const char KEY_EL_STEP[] = "elevation step [deg]";
enum { NUMBER_COUNT = 5 };

/* ---- Writing -------------------------------------------------------------------------------- */

/* A text of the user on one line. */
static void print_text(srp_sheet *sheet, const char *key, const char *text) {
    srp_sheet_print(sheet, "# %s: ", key);
    for (; *text != '\0'; ++text) {
        unsigned char byte = (unsigned char)*text;
        srp_sheet_print(sheet, "%c", byte < ' ' || byte == 127 ? ' ' : *text);
    }
    srp_sheet_print(sheet, "\n");
}

static void print_head(srp_sheet *sheet, const srp_table *table) {
    const srp_table_info *info = &table->info;
    srp_sheet_print(sheet, "# Acceleration by sunlight at 1 AU, over the direction to the Sun in "
                           "body axes\n");
    print_text(sheet, KEY_TITLE, info->title);
    print_text(sheet, KEY_SOFTWARE, srp_table_writer);
    if (info->method[0] != '\0') {
        print_text(sheet, "library version", info->version);
        print_text(sheet, "method", info->method);
        print_text(sheet, "shape hash", info->shape_hash);
        print_text(sheet, "optics hash", info->optics_hash);
        if (info->traced_optics_hash[0] != '\0') {
            print_text(sheet, "traced optics hash", info->traced_optics_hash);
        }
        if (info->bounce_kept) {
            print_text(sheet, "reflected light", "as traced, not of these optics");
        }
    }
    srp_sheet_print(sheet, "# %s: %.17g\n", KEY_MASS, info->mass);
    srp_sheet_print(sheet, "# %s: %.17g\n", KEY_FLUX, info->light.flux);
    srp_sheet_print(sheet, "# %s: %.17g\n", KEY_AU, info->light.au);
    srp_sheet_print(sheet, "# %s: %.15g\n", KEY_AZ_STEP, 360.0 / (table->grid.az_count - 1));
    srp_sheet_print(sheet, "# %s: %.15g\n", KEY_EL_STEP, 180.0 / (table->grid.el_count - 1));
    srp_sheet_print(sheet, "# az [deg] el [deg] ax ay az |a| [m/s^2]\n");
}

static srp_status write_txt(const srp_table *table, const char *path, srp_error *error) {
    srp_sheet sheet = {0};
    double scale = acceleration_per_area(table->info.light, table->info.mass);
    srp_c_locale locale = srp_platform_c_locale_enter();
    print_head(&sheet, table);
    for (uint32_t i = 0; i < table->grid.az_count; ++i) {
        for (uint32_t j = 0; j < table->grid.el_count; ++j) {
            srp_vec3 a = srp_vec3_scale(scale, srp_table_node(table, i, j)->f);
            srp_sheet_print_angles(&sheet, table->grid, i, j);
            srp_sheet_print(&sheet, " %24.16e %24.16e %24.16e %24.16e\n", a.x, a.y, a.z,
                            srp_vec3_norm(a));
        }
    }
    srp_platform_c_locale_leave(locale);
    return srp_sheet_save(&sheet, path, error);
}

/* ---- Reading -------------------------------------------------------------------------------- */

typedef struct reader {
    srp_text text;
    size_t size;
    srp_error *error;
    srp_token title;
    bool is_ours;                     /* srpcore wrote the file */
    size_t number_line[NUMBER_COUNT]; /* of the keys above, 0 while not given */
    double mass, az_step, el_step;    /* NAN while unknown */
    srp_sunlight light;
    srp_table *table; /* NULL until the first row */
    double scale;     /* area per acceleration */
    size_t rows;
} reader;

/* Takes a number above 0, which is given once and before the rows that it decides. */
static srp_status take_number(const reader *in, srp_token key, srp_token value, const char *name,
                              size_t *line, double *out) {
    double number;
    srp_status status = srp_table_key_once(&in->text, key, line, in->error);
    if (status == SRP_OK && in->table != NULL) {
        status = srp_text_expected(&in->text, key, "it above the first row", in->error);
    }
    if (status == SRP_OK) {
        status = srp_token_double(&in->text, value, name, &number, in->error);
    }
    if (status != SRP_OK) {
        return status;
    }
    if (!(number > 0.0)) {
        return srp_fail_at(in->error, SRP_BAD_DATA, in->text.name, value.line, value.column,
                           "%s is %g, expected more than 0", name, number);
    }
    if (!SRP_WITHIN(number, SRP_SCALE_MIN, SRP_SCALE_MAX)) {
        return srp_fail_at(in->error, SRP_BAD_DATA, in->text.name, value.line, value.column,
                           "%s is %g, expected %g to %g", name, number, SRP_SCALE_MIN,
                           SRP_SCALE_MAX);
    }
    *out = number;
    return SRP_OK;
}

/* A line `# key: value`; one without a colon, or with another key, is a remark. */
static srp_status take_remark(reader *in, srp_token line) {
    size_t begin = 1, colon = 1;
    while (colon < line.size && line.text[colon] != ':') {
        colon++;
    }
    size_t value_begin = colon + 1;
    while (begin < colon && line.text[begin] == ' ') {
        begin++;
    }
    while (value_begin < line.size && line.text[value_begin] == ' ') {
        value_begin++;
    }
    if (colon == line.size || value_begin >= line.size) {
        return SRP_OK;
    }
    srp_token key = srp_token_part(line, begin, colon);
    srp_token value = srp_token_part(line, value_begin, line.size);
    if (srp_token_is(key, KEY_TITLE)) {
        in->title = value;
        return SRP_OK;
    }
    if (srp_token_is(key, KEY_SOFTWARE)) {
        in->is_ours = srp_token_is(value, srp_table_writer);
        return SRP_OK;
    }
    const struct {
        const char *name;
        double *out;
    } numbers[NUMBER_COUNT] = {{KEY_MASS, &in->mass},
                               {KEY_FLUX, &in->light.flux},
                               {KEY_AU, &in->light.au},
                               {KEY_AZ_STEP, &in->az_step},
                               {KEY_EL_STEP, &in->el_step}};
    srp_status status = SRP_OK;
    for (size_t k = 0; k < NUMBER_COUNT && status == SRP_OK; ++k) {
        if (srp_token_is(key, numbers[k].name)) {
            status =
                take_number(in, key, value, numbers[k].name, &in->number_line[k], numbers[k].out);
        }
    }
    return status;
}

/* The first row is here: makes the table from what the head said. */
static srp_status begin_rows(reader *in) {
    const struct {
        const char *key;
        double value;
    } needed[] = {{KEY_MASS, in->mass},
                  {KEY_FLUX, in->light.flux},
                  {KEY_AZ_STEP, in->az_step},
                  {KEY_EL_STEP, in->el_step}};
    for (size_t k = 0; k < sizeof needed / sizeof needed[0]; ++k) {
        if (isnan(needed[k].value)) {
            return srp_fail_at(in->error, SRP_BAD_FORMAT, in->text.name, in->text.line, 0,
                               "the rows begin here, expected a line '# %s: VALUE' before them",
                               needed[k].key);
        }
    }
    srp_grid grid;
    srp_status status = srp_table_grid_of_file(&in->text, in->text.line, in->size, in->az_step,
                                               in->el_step, &grid, in->error);
    if (status == SRP_OK) {
        status = srp_table_create_blank(grid, 0, false, &in->table, in->error);
    }
    in->scale = 1.0 / acceleration_per_area(in->light, in->mass);
    return status;
}

static srp_status take_row(reader *in) {
    srp_table_row row;
    srp_vec3 f = {0.0, 0.0, 0.0};
    double norm;
    const double scale[3] = {in->scale, in->scale, in->scale};
    srp_status status = srp_table_row_begin(&in->text, &row, in->error);
    if (status == SRP_OK) {
        status = srp_table_row_check(&in->text, in->table->grid, in->rows, &row, in->error);
    }
    if (status == SRP_OK) {
        status = srp_table_row_vec3(&in->text, "a", scale, &f, in->error);
    }
    if (status == SRP_OK) {
        status = srp_text_double(&in->text, "|a|", &norm, NULL, in->error);
    }
    if (status == SRP_OK) {
        status = srp_text_end_of_line(&in->text, in->error);
    }
    if (status == SRP_OK) {
        in->table->nodes[in->rows].f = f;
        srp_table_mark_filled(in->table, in->rows++);
    }
    return status;
}

static srp_status take_line(reader *in) {
    /* The line as a whole, without moving on. */
    srp_text ahead = in->text;
    srp_token line = srp_text_rest(&ahead);
    if (line.text[0] == '#') {
        return take_remark(in, line);
    }
    srp_status status = in->table == NULL ? begin_rows(in) : SRP_OK;
    return status == SRP_OK ? take_row(in) : status;
}

static srp_status end_file(reader *in) {
    if (in->table == NULL) {
        return srp_fail_at(in->error, SRP_BAD_FORMAT, in->text.name, in->text.line, 0,
                           "the text ends before any row, expected `az el ax ay az |a|`");
    }
    srp_status status =
        srp_table_end_of_rows(&in->text, in->table, in->rows, "rows", in->is_ours, in->error);
    if (status != SRP_OK) {
        return status;
    }
    in->table->info.mass = in->mass;
    in->table->info.light = in->light;
    return srp_table_set_text(&in->table->info.title, in->title.text != NULL ? in->title.text : "",
                              in->title.size, in->error);
}

static srp_status parse(reader *in, const char *bytes, const char *path) {
    srp_status status = srp_text_open(&in->text, bytes, in->size, path, 0, in->error);
    if (status != SRP_OK) {
        return status;
    }
    while (status == SRP_OK && srp_text_next_line(&in->text)) {
        status = take_line(in);
    }
    return status == SRP_OK ? end_file(in) : status;
}

static srp_status read_txt(const char *path, srp_table **out, srp_error *error) {
    char *bytes;
    reader in;
    memset(&in, 0, sizeof in);
    in.error = error;
    in.mass = in.az_step = in.el_step = NAN;
    in.light = srp_sunlight_default();
    in.light.flux = NAN;
    srp_status status = srp_text_read_file(path, &bytes, &in.size, error);
    if (status != SRP_OK) {
        return status;
    }
    srp_c_locale locale = srp_platform_c_locale_enter();
    status = parse(&in, bytes, path);
    srp_platform_c_locale_leave(locale);
    free(bytes);
    if (status != SRP_OK) {
        srp_table_destroy(in.table);
        return status;
    }
    *out = in.table;
    return SRP_OK;
}

const srp_table_format srp_table_format_txt = {
    .name = "txt",
    .ending = ".txt",
    .summary = "text: acceleration of the given mass at 1 AU, as AAS 20-481",
    .capabilities = SRP_FORMAT_MASS,
    .write = write_txt,
    .read = read_txt,
};
