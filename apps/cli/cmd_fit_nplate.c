/* SPDX-License-Identifier: Apache-2.0 */
/* srp fit-nplate: the plates that give most nearly what a table says. */
#include "commands.h"
#include "difference.h"
#include "fit_normals.h"
#include "messages.h"
#include "method_options.h"
#include "plate_fit.h"
#include "plate_output.h"
#include "system.h"
#include "table_fit.h"
#include "table_input.h"
#include "text_file.h"

#include <srp/const.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    FIT_OUTPUT,
    FIT_GMAT,
    FIT_RESIDUALS,
    FIT_NORMALS,
    FIT_PLATES,
    FIT_MESH,
    FIT_UNIT,
    FIT_SHADOW,
    FIT_AGAINST,
    FIT_MASS,
    FIT_OPTION_COUNT
};

typedef struct fit_options {
    cli_given given;
    const char *output, *gmat, *residuals, *normals, *against;
    cli_list mesh;
    uint32_t plates;
    double metres_per_unit, shadow, mass;
} fit_options;

static const double NEARLY_EQUAL = 0.017; /* sine of the angle between normals: one degree */

enum { PLATES_AUTO = 8 };

static const cli_range PLATE_COUNT = {1, CLI_NORMALS_MAX, "a whole number from 1 to 64"};
static const cli_range SHARE = {0.0, 1.0, "a number from 0 to 1"};

static const cli_option OPTIONS[FIT_OPTION_COUNT] = {
    [FIT_OUTPUT] = {.name = "output",
                    .letter = 'o',
                    .value = "FILE",
                    .complete = CLI_COMPLETE_FILE,
                    .help = "Write the plates, for --method nplate.",
                    .set = cli_set_text,
                    .offset = offsetof(fit_options, output)},
    [FIT_GMAT] = {.name = "gmat",
                  .value = "FILE",
                  .complete = CLI_COMPLETE_FILE,
                  .help = "Write a script for GMAT R2022a and later, with these plates.",
                  .set = cli_set_text,
                  .offset = offsetof(fit_options, gmat)},
    [FIT_RESIDUALS] = {.name = "residuals",
                       .value = "FILE",
                       .complete = CLI_COMPLETE_FILE,
                       .help = "Write the residual of every direction as text.",
                       .set = cli_set_text,
                       .offset = offsetof(fit_options, residuals)},
    [FIT_NORMALS] = {.name = "normals",
                     .value = "WHAT",
                     .complete = CLI_COMPLETE_FILE,
                     .help = "Normals of the plates: 'auto' searches them, 'mesh' takes those that "
                             "--mesh has most of, else a file: FILE.plates, or three numbers in "
                             "each line. Default: mesh with --mesh, else auto.",
                     .set = cli_set_text,
                     .offset = offsetof(fit_options, normals)},
    [FIT_PLATES] = {.name = "plates",
                    .value = "N",
                    .help = "How many plates to look for. Default: 8; with 'mesh' as many as have "
                            "95 % of the area, or fewer where those cannot be told apart.",
                    .set = cli_set_count,
                    .offset = offsetof(fit_options, plates),
                    .range = &PLATE_COUNT},
    [FIT_MESH] = {.name = "mesh",
                  .value = "MODEL.obj",
                  .complete = CLI_COMPLETE_FILE,
                  .help =
                      "The shape that the table is of, to tell directions where its parts shade "
                      "each other. Repeatable.",
                  .set = cli_set_list,
                  .offset = offsetof(fit_options, mesh)},
    [FIT_UNIT] = {.name = "unit",
                  .value = "UNIT",
                  .complete = CLI_COMPLETE_WORDS,
                  .words = "m cm mm in ft",
                  .help = "Unit of the mesh: m, cm, mm, in, ft or a number of metres. Default: m.",
                  .set = cli_set_unit,
                  .offset = offsetof(fit_options, metres_per_unit)},
    [FIT_SHADOW] = {.name = "shadow",
                    .value = "SHARE",
                    .help = "A direction counts as shaded when more than this share of the faces "
                            "that the Sun is in front of lies in shadow. Default: 0.01.",
                    .set = cli_set_number,
                    .offset = offsetof(fit_options, shadow),
                    .range = &SHARE},
    [FIT_AGAINST] = {.name = "against",
                     .value = "FILE",
                     .complete = CLI_COMPLETE_FILE,
                     .help = "Print the residuals of these plates beside those of the fit.",
                     .set = cli_set_text,
                     .offset = offsetof(fit_options, against)},
    [FIT_MASS] = {.name = "mass",
                  .value = "KG",
                  .help = "Mass of the spacecraft, for --gmat. Default: what the table states.",
                  .set = cli_set_number,
                  .offset = offsetof(fit_options, mass),
                  .range = &CLI_POSITIVE},
};

static const cli_group FIT = {"Fit", OPTIONS, FIT_OPTION_COUNT};
static const cli_group *const GROUPS[] = {&FIT};

typedef struct fit_job {
    const fit_options *options;
    const char *path;
    srp_table *table;
    cli_samples samples;
    srp_scene *scene; /* NULL without a mesh */
    double *shaded;   /* (samples) shares; NULL without a mesh */
    bool *skip;       /* (samples) shaded directions; NULL without a mesh */
    size_t lit;       /* directions that are not */
    cli_normals normals;
    cli_plate_fit fit;
    srp_plate *against;
    size_t against_count;
} fit_job;

static int no_memory(void) {
    cli_say("no memory");
    return CLI_MACHINE_FAILED;
}

/* ---- before the work ---- */

static int check_output(const fit_job *job, const char *path) {
    const char *reason;
    if (path == NULL) {
        return CLI_DONE;
    }
    bool input =
        cli_system_same_file(path, job->path) ||
        (job->options->against != NULL && cli_system_same_file(path, job->options->against));
    for (size_t k = 0; k < job->options->mesh.count; ++k) {
        input = input || cli_system_same_file(path, job->options->mesh.items[k]);
    }
    if (input) {
        return cli_usage_error("%s is input and output at once", path);
    }
    if (!cli_system_can_write(path, &reason)) {
        fprintf(stderr, "%s: cannot write: %s\n", path, reason);
        return CLI_MACHINE_FAILED;
    }
    return CLI_DONE;
}

static bool wants(const fit_job *job, const char *what) {
    const char *normals = job->options->normals;
    if (normals == NULL) {
        normals = job->options->mesh.count > 0 ? "mesh" : "auto";
    }
    return strcmp(normals, what) == 0;
}

static int check(const fit_job *job) {
    const fit_options *options = job->options;
    if (!cli_plate_fit_exists()) {
        cli_say("this program was built without GSL and fits nothing");
        return CLI_MACHINE_FAILED;
    }
    const char *const outputs[3] = {options->output, options->gmat, options->residuals};
    bool file = !wants(job, "auto") && !wants(job, "mesh");
    if (wants(job, "mesh") && options->mesh.count == 0) {
        return cli_usage_error("--normals mesh: which mesh? --mesh MODEL.obj");
    }
    if (cli_is_given(options->given, FIT_SHADOW) && options->mesh.count == 0) {
        return cli_usage_error("--shadow: of which shape? --mesh MODEL.obj");
    }
    if (cli_is_given(options->given, FIT_UNIT) && options->mesh.count == 0) {
        return cli_usage_error("--unit is that of --mesh MODEL.obj");
    }
    if (cli_is_given(options->given, FIT_MASS) && options->gmat == NULL) {
        return cli_usage_error("--mass is for --gmat FILE");
    }
    if (file && cli_is_given(options->given, FIT_PLATES)) {
        return cli_usage_error("--plates: --normals %s says how many", options->normals);
    }
    for (int k = 0; k < 3; ++k) {
        for (int m = 0; m < k; ++m) {
            if (outputs[k] != NULL && outputs[m] != NULL && strcmp(outputs[k], outputs[m]) == 0) {
                return cli_usage_error("%s is given twice as output", outputs[k]);
            }
        }
        int status = check_output(job, outputs[k]);
        if (status != CLI_DONE) {
            return status;
        }
    }
    return CLI_DONE;
}

/* ---- input ---- */

static int load_shadow(fit_job *job) {
    const fit_options *options = job->options;
    int status = cli_shape_load(options->mesh.items, options->mesh.count, options->metres_per_unit,
                                &job->scene);
    if (status != CLI_DONE) {
        return status;
    }
    job->shaded = calloc(job->samples.count, sizeof *job->shaded);
    job->skip = calloc(job->samples.count, sizeof *job->skip);
    if (job->shaded == NULL || job->skip == NULL) {
        return no_memory();
    }
    const srp_table_info *info = srp_table_get_info(job->table);
    bool same = strcmp(info->shape_hash, srp_scene_shape_hash(job->scene)) == 0;
    if (!same && info->shape_hash[0] != '\0') {
        cli_say("warning: %s is of another shape than the mesh", job->path);
    }
    srp_error error;
    if (cli_facing_shaded(job->scene, &job->samples, same && info->has_error, job->shaded,
                          &error) != SRP_OK) {
        return cli_input_error(&error);
    }
    for (size_t k = 0; k < job->samples.count; ++k) {
        job->skip[k] = job->shaded[k] > options->shadow;
        job->lit += !job->skip[k];
    }
    return CLI_DONE;
}

static int load(fit_job *job) {
    int status = cli_table_open_checked(job->path, &job->table);
    if (status != CLI_DONE) {
        return status;
    }
    if (!cli_samples_take(job->table, srp_table_grid(job->table), false, &job->samples)) {
        return no_memory();
    }
    if (job->options->mesh.count > 0) {
        status = load_shadow(job);
    }
    srp_error error;
    if (status == CLI_DONE && job->options->against != NULL &&
        srp_plates_read(job->options->against, &job->against, &job->against_count, &error) !=
            SRP_OK) {
        status = cli_input_error(&error);
    }
    return status;
}

/* ---- the fit ---- */

static cli_fit_status solve(fit_job *job) {
    return cli_plate_fit_solve(&job->samples, job->normals.normal, job->normals.count, NULL,
                               &job->fit);
}

/* The mesh may have more normals than the directions can tell apart: unless the user wants a
 * number, those of the smallest faces are left out. */
static cli_fit_status solve_fewer(fit_job *job) {
    size_t all = job->normals.count;
    cli_fit_status status = solve(job);
    bool chosen = !wants(job, "mesh") || cli_is_given(job->options->given, FIT_PLATES);
    while (!chosen && job->normals.count > 1 &&
           (status == CLI_FIT_AMBIGUOUS || status == CLI_FIT_TOO_FEW)) {
        size_t count = job->normals.count;
        job->normals.count = count - 1 - count / 16;
        status = solve(job);
    }
    if (status == CLI_FIT_DONE && job->normals.count < all) {
        cli_say("warning: the %zu normals of the mesh cannot be told apart in these directions: "
                "the %zu with the most area are taken (--plates N chooses)",
                all, job->normals.count);
        snprintf(job->normals.words, sizeof job->normals.words, "of the mesh, those of most area");
    }
    return status;
}

/* Nothing of this plate is left but rounding. */
static bool is_dust(const fit_job *job, size_t plate) {
    double largest = 0.0;
    for (size_t k = 0; k < job->fit.count; ++k) {
        largest = fmax(largest, job->fit.plates[k].area);
    }
    return !(job->fit.plates[plate].area > 1e-10 * largest);
}

/* Plates that were looked for and got no area are left out; normals of a file stay as given. */
static cli_fit_status drop_dust(fit_job *job) {
    size_t kept = 0;
    for (size_t k = 0; k < job->fit.count; ++k) {
        if (!is_dust(job, k)) {
            job->normals.normal[kept++] = job->normals.normal[k];
        }
    }
    if (kept == 0 || kept == job->fit.count) {
        return CLI_FIT_DONE;
    }
    cli_say("%zu of %zu plates got no area and are left out", job->fit.count - kept,
            job->fit.count);
    job->normals.count = kept;
    cli_plate_fit_free(&job->fit);
    job->fit = (cli_plate_fit){.count = 0};
    return solve(job);
}

static void warn_of_vague(const fit_job *job) {
    size_t vague = 0;
    double near = 1.0;
    for (size_t k = 0; k < job->fit.count; ++k) {
        vague += !is_dust(job, k) &&
                 cli_plate_fit_sigma(&job->fit, k, CLI_FIT_AREA) > job->fit.plates[k].area;
        for (size_t m = 0; m < k; ++m) {
            near = fmin(near, srp_vec3_norm(srp_vec3_cross(job->fit.plates[k].normal,
                                                           job->fit.plates[m].normal)) +
                                  (srp_vec3_dot(job->fit.plates[k].normal,
                                                job->fit.plates[m].normal) < 0.0));
        }
    }
    if (vague > 0) {
        cli_say("warning: the areas of %zu of %zu plates are not determined (+- exceeds them); "
                "fewer plates are: --plates N",
                vague, job->fit.count);
    }
    if (near < NEARLY_EQUAL) {
        cli_say("warning: some normals are within %.2g degrees of each other; one plate would do",
                asin(near) / SRP_RAD_PER_DEG);
    }
}

static int fit(fit_job *job) {
    int status;
    if (wants(job, "auto")) {
        job->normals.count = cli_is_given(job->options->given, FIT_PLATES) ? job->options->plates
                                                                           : (size_t)PLATES_AUTO;
        snprintf(job->normals.words, sizeof job->normals.words,
                 "searched: a better set may exist, try other --plates, or give --normals");
        status = cli_table_search(job->table, job->path, &job->samples, job->normals.count, NULL,
                                  job->normals.normal);
    } else if (wants(job, "mesh")) {
        status = cli_normals_of_mesh(job->scene, job->options->plates, &job->normals);
    } else {
        status = cli_normals_read(job->options->normals, &job->normals);
    }
    if (status != CLI_DONE) {
        return status;
    }
    cli_fit_status solved = solve_fewer(job);
    if (solved == CLI_FIT_DONE && (wants(job, "auto") || wants(job, "mesh"))) {
        solved = drop_dust(job);
    }
    if (solved == CLI_FIT_DONE) {
        warn_of_vague(job);
    }
    return cli_table_explain(job->path, &job->samples, solved, job->normals.count);
}

/* ---- output ---- */

/* What five digits show as -0.00000 is 0. */
static double unsigned_zero(double value) {
    return fabs(value) < 5e-6 ? 0.0 : value;
}

static void print_plates(const fit_job *job) {
    printf("\n%9s %9s %9s %12s %9s %8s %8s %8s %8s\n", "n_x", "n_y", "n_z", "area [m^2]", "+-",
           "rho_s", "+-", "rho_d", "+-");
    for (size_t k = 0; k < job->fit.count; ++k) {
        const srp_plate *plate = &job->fit.plates[k];
        printf("%9.5f %9.5f %9.5f %12.6g %9.2g %8.4f %8.2g %8.4f %8.2g\n",
               unsigned_zero(plate->normal.x), unsigned_zero(plate->normal.y),
               unsigned_zero(plate->normal.z), plate->area,
               cli_plate_fit_sigma(&job->fit, k, CLI_FIT_AREA), plate->optics.rho_s,
               cli_plate_fit_sigma(&job->fit, k, CLI_FIT_RHO_S), plate->optics.rho_d,
               cli_plate_fit_sigma(&job->fit, k, CLI_FIT_RHO_D));
    }
}

static void print_residual(const fit_job *job, const char *name, const srp_vec3 *model, bool lit) {
    cli_difference d = cli_difference_measure(&job->samples, model, lit ? job->skip : NULL);
    const cli_difference_row *row = &d.row[CLI_DIFFERENCE_VECTOR];
    char where[32];
    snprintf(where, sizeof where, "%s, %s", name, lit ? "not shaded" : "all");
    printf("%-24s %10zu %11.5g %9.4f %11.5g %11.5g %5g, %g\n", where,
           lit ? job->lit : job->samples.count, row->rms, 100.0 * row->rms / d.mean_a, row->mean,
           row->largest, row->az_deg, row->el_deg);
}

static int print_residuals(const fit_job *job) {
    printf("\n%-24s %10s %11s %9s %11s %11s %s\n", "residual", "directions", "RMS [m^2]", "RMS [%]",
           "mean [m^2]", "largest", "at az, el [deg]");
    bool some_lit = job->skip != NULL && job->lit > 0;
    print_residual(job, "fit", job->fit.model, false);
    if (some_lit) {
        print_residual(job, "fit", job->fit.model, true);
    } else if (job->skip != NULL) {
        printf("%-24s %10d  from everywhere more than --shadow %g is shaded\n", "fit, not shaded",
               0, job->options->shadow);
    }
    if (job->against == NULL) {
        return CLI_DONE;
    }
    srp_vec3 *model = calloc(job->samples.count, sizeof *model);
    if (model == NULL) {
        return no_memory();
    }
    for (size_t k = 0; k < job->samples.count; ++k) {
        model[k] = cli_plates_force(job->against, job->against_count, job->samples.at[k].s);
    }
    print_residual(job, "against", model, false);
    if (some_lit) {
        print_residual(job, "against", model, true);
    }
    free(model);
    return CLI_DONE;
}

static int print_all(const fit_job *job) {
    char summary[256];
    cli_table_summary(job->table, summary, sizeof summary);
    const char *const outputs[3] = {job->options->output, job->options->gmat,
                                    job->options->residuals};
    for (int k = 0; k < 3; ++k) {
        if (outputs[k] != NULL) {
            printf("%s\n", outputs[k]);
        }
    }
    printf("table    %s: %s\nnormals  %zu, %s\n", job->path, summary, job->normals.count,
           job->normals.words);
    if (job->normals.merged > 0) {
        printf("         %zu more repeat others: plates of one normal are one plate\n",
               job->normals.merged);
    }
    print_plates(job);
    if (job->fit.tied) {
        printf(
            "Areas of opposite plates are not told apart by any table of these normals: they are "
            "taken as equal as they can be.\n");
    }
    return print_residuals(job);
}

static void write_residuals(FILE *out, const fit_job *job) {
    fprintf(out, "# residual of the plates fitted to %s: model minus table [m^2]\n", job->path);
    fprintf(out, "# az el rx ry rz |r| |f|%s\n", job->shaded != NULL ? " shaded" : "");
    for (size_t k = 0; k < job->samples.count; ++k) {
        const cli_direction *at = &job->samples.at[k];
        srp_vec3 r = srp_vec3_sub(job->fit.model[k], job->samples.value[k]);
        fprintf(out, "%g %g %.9e %.9e %.9e %.9e %.9e", at->az_deg, at->el_deg, r.x, r.y, r.z,
                srp_vec3_norm(r), srp_vec3_norm(job->samples.value[k]));
        if (job->shaded != NULL) {
            fprintf(out, " %.4f", job->shaded[k]);
        }
        fputc('\n', out);
    }
}

static void write_gmat(FILE *out, const fit_job *job, const char *about) {
    const srp_table_info *info = srp_table_get_info(job->table);
    double mass = cli_is_given(job->options->given, FIT_MASS) ? job->options->mass : info->mass;
    if (!isfinite(mass)) {
        cli_say("warning: %s lacks the mass (DryMass): the table states none; --mass KG",
                job->options->gmat);
    }
    cli_plates_write_gmat(out, job->fit.plates, job->fit.count, about, mass, info->light);
}

static int write_files(const fit_job *job) {
    const char *const outputs[3] = {job->options->output, job->options->gmat,
                                    job->options->residuals};
    char about[600];
    snprintf(about, sizeof about, "plates fitted to %.500s by srp " SRP_VERSION, job->path);
    for (int k = 0; k < 3; ++k) {
        cli_text_file file;
        if (outputs[k] == NULL) {
            continue;
        }
        int status = cli_text_file_begin(&file, outputs[k]);
        if (status != CLI_DONE) {
            return status;
        }
        if (k == 0) {
            cli_plates_write(file.out, job->fit.plates, job->fit.count, about);
        } else if (k == 1) {
            write_gmat(file.out, job, about);
        } else {
            write_residuals(file.out, job);
        }
        status = cli_text_file_end(&file);
        if (status != CLI_DONE) {
            return status;
        }
    }
    return CLI_DONE;
}

/* ---- the command ---- */

static int fit_nplate(fit_job *job) {
    int status = check(job);
    if (status == CLI_DONE) {
        status = load(job);
    }
    if (status == CLI_DONE) {
        status = fit(job);
    }
    if (status == CLI_DONE) {
        status = write_files(job);
    }
    if (status == CLI_DONE) {
        status = print_all(job);
    }
    cli_plate_fit_free(&job->fit);
    cli_samples_free(&job->samples);
    srp_plates_free(job->against);
    srp_scene_destroy(job->scene);
    srp_table_destroy(job->table);
    free(job->shaded);
    free(job->skip);
    return status;
}

static int run(const cli_command *command, int argc, char **argv) {
    fit_options options = {.metres_per_unit = 1.0, .shadow = 0.01, .mass = NAN};
    void *const targets[] = {&options};
    cli_operands operands;
    int status;
    if (cli_command_parse(command, argc, argv, targets, &operands, &status)) {
        if (operands.count != 1) {
            status = cli_usage_error("expected one table, found %zu", operands.count);
        } else {
            fit_job job = {.options = &options, .path = operands.items[0]};
            status = fit_nplate(&job);
        }
    }
    cli_list_free(&options.mesh);
    return status;
}

const cli_command cli_command_fit_nplate = {
    .name = "fit-nplate",
    .operands = "TABLE",
    .operand_files = "nc spo txt",
    .summary = "plates that give most nearly what a table says",
    .description =
        "Fits an N-plate model to a table: areas and optics by least squares over the sphere, each "
        "direction by its solid angle, within their bounds (areas not negative, shares of light "
        "from 0 to 1 together). Prints the plates with their standard deviations, and what the "
        "model misses; with --mesh also without the directions in which parts of the spacecraft "
        "shade each other, where every model of plates is wrong.\n\n"
        "Standard deviations take what is missed for noise: they say how well the table tells a "
        "number, not how well plates describe the spacecraft.",
    .examples = "srp fit-nplate wing.nc --plates 6 -o fitted.plates\n"
                "srp fit-nplate wing.nc --mesh wing.obj -o fitted.plates --gmat my.script\n"
                "srp fit-nplate wing.nc --normals my.plates --against my.plates",
    .groups = GROUPS,
    .group_count = sizeof GROUPS / sizeof GROUPS[0],
    .run = run,
};
