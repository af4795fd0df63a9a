/* SPDX-License-Identifier: Apache-2.0 */
/* srp reoptic: the direct light of a table under other optics, without tracing. */
#include "command_line.h"
#include "commands.h"
#include "messages.h"
#include "model.h"
#include "restate.h"
#include "suggest.h"

#include <srp/table.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { REOPTIC_OUTPUT, REOPTIC_MATERIAL, REOPTIC_MTL, REOPTIC_KEEP_BOUNCE, REOPTIC_OPTION_COUNT };

typedef struct reoptic_options {
    cli_given given;
    cli_list outputs, materials;
    const char *mtl; /* NULL = none */
    bool keep_bounce;
} reoptic_options;

static const cli_option OPTIONS[REOPTIC_OPTION_COUNT] = {
    [REOPTIC_OUTPUT] = {.name = "output",
                        .letter = 'o',
                        .value = "FILE",
                        .complete = CLI_COMPLETE_FILE,
                        .help = "File to write; its ending chooses the format. May be given "
                                "several times.",
                        .set = cli_set_list,
                        .offset = offsetof(reoptic_options, outputs)},
    [REOPTIC_MATERIAL] = {.name = "material",
                          .value = "NAME=RHO_S,RHO_D",
                          .help = "New optics of the material NAME: specular and diffuse share. "
                                  "Wins over the MTL file. May be given for several materials; "
                                  "the others keep their optics.",
                          .set = cli_set_list,
                          .offset = offsetof(reoptic_options, materials)},
    [REOPTIC_MTL] = {.name = "mtl",
                     .value = "FILE",
                     .complete = CLI_COMPLETE_FILE,
                     .help = "New optics of all materials of the table that this MTL file has.",
                     .set = cli_set_text,
                     .offset = offsetof(reoptic_options, mtl)},
    [REOPTIC_KEEP_BOUNCE] = {.name = "keep-bounce",
                             .help = "Keep light that was reflected before as it was traced, and "
                                     "say so in the output. Without it tables that hold such "
                                     "light are refused.",
                             .set = cli_set_flag,
                             .offset = offsetof(reoptic_options, keep_bounce)},
};

static const cli_group REOPTIC = {"Optics", OPTIONS, REOPTIC_OPTION_COUNT};
static const cli_group *const GROUPS[] = {&REOPTIC, &cli_group_restate};

/* One run. */
typedef struct reoptic_job {
    const reoptic_options *options;
    const cli_restate_options *statement;
    const char *command_line, *input;
    srp_table *from, *to;
    srp_materials *given;  /* --material, then what the MTL file adds */
    srp_materials *chosen; /* those of them that the table has */
} reoptic_job;

static bool has_material(const srp_table *table, const char *name) {
    for (size_t m = 0; m < srp_table_material_count(table); ++m) {
        if (strcmp(srp_table_material_name(table, m), name) == 0) {
            return true;
        }
    }
    return false;
}

/* The library lists the names that there are; the nearest of them was meant, perhaps. */
static int refuse_name(const reoptic_job *job, const char *name, const srp_error *error) {
    cli_suggestion near = cli_suggestion_begin(name);
    for (size_t m = 0; m < srp_table_material_count(job->from); ++m) {
        cli_suggestion_offer(&near, srp_table_material_name(job->from, m));
    }
    return cli_usage_error("--material %s: %s%s%s%s", name, error->message,
                           near.best != NULL ? "; did you mean '" : "",
                           near.best != NULL ? near.best : "", near.best != NULL ? "'?" : "");
}

/* A name of --material that the table lacks is a slip of the pen. */
static int explain_unknown(const reoptic_job *job, const srp_error *error) {
    for (size_t i = 0; i < srp_materials_count(job->given); ++i) {
        const char *name = srp_materials_name(job->given, i);
        if (!has_material(job->from, name)) {
            return refuse_name(job, name, error);
        }
    }
    return cli_input_error(error);
}

/* An MTL file may have materials of other models too: only those of the table count. */
static int choose(reoptic_job *job) {
    srp_error error;
    srp_log log = cli_log();
    if (srp_materials_read_mtl(job->given, job->options->mtl, &log, &error) != SRP_OK ||
        srp_materials_create(&job->chosen, &error) != SRP_OK) {
        return cli_input_error(&error);
    }
    for (size_t m = 0; m < srp_table_material_count(job->from); ++m) {
        const char *name = srp_table_material_name(job->from, m);
        srp_optics optics;
        if (srp_materials_find(job->given, name, &optics) &&
            srp_materials_set(job->chosen, name, optics, true, &error) != SRP_OK) {
            return cli_input_error(&error);
        }
    }
    if (srp_materials_count(job->chosen) == 0) {
        fprintf(stderr, "%s: has optics for none of the materials of %s\n", job->options->mtl,
                job->input);
        return CLI_BAD_INPUT;
    }
    return CLI_DONE;
}

static int reweigh(reoptic_job *job, const srp_materials *materials) {
    srp_error error;
    srp_status status =
        srp_table_reoptic(job->from, materials, job->options->keep_bounce, &job->to, &error);
    if (status == SRP_NOT_FOUND) {
        return explain_unknown(job, &error);
    }
    if (status == SRP_NO_MEMORY) {
        return cli_input_error(&error);
    }
    if (status != SRP_OK) {
        snprintf(error.file, sizeof error.file, "%s", job->input);
        (void)cli_input_error(&error);
        return CLI_BAD_INPUT; /* the table's fault, whatever was asked for */
    }
    return CLI_DONE;
}

/* --material alone is checked against the table before the MTL file adds to it. */
static int apply(reoptic_job *job) {
    int status = reweigh(job, job->given);
    if (status == CLI_DONE && job->options->mtl != NULL) {
        status = choose(job);
        if (status == CLI_DONE) {
            srp_table_destroy(job->to);
            job->to = NULL;
            status = reweigh(job, job->chosen);
        }
    }
    return status;
}

static int finish(reoptic_job *job) {
    int status = cli_restate(job->statement, job->command_line, job->to);
    if (status == CLI_DONE) {
        status = cli_restate_write(&job->options->outputs, job->to, job->input);
    }
    if (status == CLI_DONE && srp_table_get_info(job->to)->bounce_kept) {
        cli_say("warning: reflected light was kept as traced; it is not that of these optics");
    }
    return status;
}

static int check(const reoptic_options *options, const cli_operands *operands) {
    if (operands->count != 1) {
        return cli_usage_error("expected one file, TABLE, found %zu", operands->count);
    }
    if (options->outputs.count == 0) {
        return cli_usage_error("no output: -o FILE.nc, -o FILE.spo or -o FILE.txt");
    }
    if (options->materials.count == 0 && options->mtl == NULL) {
        return cli_usage_error("no optics: --material NAME=RHO_S,RHO_D or --mtl FILE");
    }
    return CLI_DONE;
}

static int reoptic(reoptic_job *job, const cli_operands *operands) {
    int status = check(job->options, operands);
    if (status == CLI_DONE) {
        job->input = operands->items[0];
        status = cli_materials_given(&job->options->materials, &job->given);
    }
    if (status == CLI_DONE) {
        status = cli_table_read(job->input, &job->from);
    }
    if (status == CLI_DONE) {
        status = apply(job);
    }
    if (status == CLI_DONE) {
        status = finish(job);
    }
    srp_table_destroy(job->from);
    srp_table_destroy(job->to);
    srp_materials_destroy(job->given);
    srp_materials_destroy(job->chosen);
    return status;
}

static int run(const cli_command *command, int argc, char **argv) {
    reoptic_options options = {.mtl = NULL};
    cli_restate_options statement = cli_restate_options_default();
    void *const targets[] = {&options, &statement};
    cli_operands operands;
    /* Before getopt_long() reorders the words. */
    char *command_line = cli_command_line_join(argc, argv, "");
    if (command_line == NULL) {
        cli_say("no memory");
        return CLI_MACHINE_FAILED;
    }
    int status;
    if (cli_command_parse(command, argc, argv, targets, &operands, &status)) {
        reoptic_job job = {
            .options = &options, .statement = &statement, .command_line = command_line};
        status = reoptic(&job, &operands);
    }
    free(command_line);
    cli_list_free(&options.outputs);
    cli_list_free(&options.materials);
    return status;
}

const cli_command cli_command_reoptic = {
    .name = "reoptic",
    .operands = "TABLE.nc -o FILE",
    .operand_files = "nc",
    .summary = "table for other optics, without tracing",
    .description =
        "Gives the materials of a table other optics. Direct light is linear in the optics, so "
        "that it follows from the sums of each material that a table keeps when it is made with "
        "--basis; nothing is traced, and materials that are not named keep their optics.\n\n"
        "Light that was reflected before is not linear in the optics. Tables that hold it (method "
        "raytrace, unless with --reflections 0) are refused, unless --keep-bounce leaves that part "
        "as it was traced. The back "
        "of a one-sided material stays black; which sides a material has cannot be changed.",
    .examples = "srp table box-wing.obj -o box-wing.nc --basis\n"
                "srp reoptic box-wing.nc --material cells=0.1,0.05 -o worn.nc -o worn.spo\n"
                "srp reoptic box-wing.nc --mtl worn.mtl -o worn.txt --mass 850",
    .groups = GROUPS,
    .group_count = sizeof GROUPS / sizeof GROUPS[0],
    .run = run,
};
