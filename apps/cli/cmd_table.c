/* SPDX-License-Identifier: Apache-2.0 */
/* srp table: the response over the whole sphere of directions, in one file or several. */
#include "command_line.h"
#include "commands.h"
#include "interp_check.h"
#include "messages.h"
#include "model.h"
#include "outputs.h"
#include "progress.h"
#include "system.h"
#include "table_options.h"
#include "utf8.h"

#include <srp/cache.h>
#include <srp/table.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const cli_group *const GROUPS[] = {&cli_group_table, &cli_group_model, &cli_group_method};

static const double CHECKPOINT_SECONDS = 30.0;

/* One run. */
typedef struct table_job {
    const cli_table_options *options;
    const cli_model_options *model;
    const cli_method_options *how;
    const cli_operands *operands;
    srp_grid grid;
    cli_model loaded;
    srp_table *table;
    const char *command_line; /* as it can be typed again */
    char *title, *stored_command_line,
        *partial; /* partial: where an interrupted run leaves its nodes */
    cli_progress progress;
    double saved; /* time of the last checkpoint [s] */
    bool save_failed;
    cli_interp_check check;
    srp_cache *cache; /* NULL: none asked for, or it cannot be used */
} table_job;

/* Whether the step is for us to choose; such a run leaves no partial file. */
static bool chooses_step(const table_job *job) {
    return cli_is_given(job->options->given, TABLE_MAX_ERROR);
}

/* ---- before the computing ---- */

/* All that can be said without reading the model. */
static int check(table_job *job, const srp_method **method, srp_method_params *params) {
    const cli_table_options *options = job->options;
    if (options->outputs.count == 0) {
        return cli_usage_error("no output: -o FILE.nc, -o FILE.spo or -o FILE.txt");
    }
    int status = cli_method_choose(job->model, job->how, job->operands->count, method, params);
    if (status == CLI_DONE) {
        status = cli_table_choose_grid(options, &job->grid);
    }
    if (status == CLI_DONE && options->basis && !((*method)->capabilities & SRP_METHOD_BASIS)) {
        status = cli_usage_error("method %s gives no sums per material: --basis", (*method)->name);
    }
    cli_table_content content = {cli_is_given(options->given, TABLE_MASS), options->basis};
    if (status == CLI_DONE) {
        status = cli_outputs_check(&options->outputs, content, job->operands->items,
                                   job->operands->count);
    }
    if (status == CLI_DONE) {
        status = cli_outputs_check(&options->outputs, content, &job->model->plates, 1);
    }
    return status;
}

/* Names of the model's files without directories: "bus.obj, HGA.obj". NULL without memory. */
static char *name_model(const table_job *job) {
    size_t size = 1;
    const cli_operands *files = job->operands;
    cli_operands plates = {&job->model->plates, 1}, method = {&job->how->name, 1};
    if (files->count == 0) {
        files = job->model->plates != NULL ? &plates : &method;
    }
    for (size_t i = 0; i < files->count; ++i) {
        size += strlen(files->items[i]) + 2;
    }
    char *title = calloc(size, 1);
    size_t used = 0;
    for (size_t i = 0; title != NULL && i < files->count; ++i) {
        const char *slash = strrchr(files->items[i], '/');
        used += (size_t)snprintf(title + used, size - used, "%s%s", i > 0 ? ", " : "",
                                 slash != NULL ? slash + 1 : files->items[i]);
    }
    return title;
}

static int name_things(table_job *job) {
    const char *first = job->options->outputs.items[0];
    size_t line_size = strlen(job->command_line) + 1;
    job->title = name_model(job);
    job->stored_command_line = malloc(line_size);
    size_t size = strlen(first) + sizeof CLI_PARTIAL_ENDING;
    job->partial = malloc(size);
    if (job->title == NULL || job->stored_command_line == NULL || job->partial == NULL) {
        cli_say("no memory");
        return CLI_MACHINE_FAILED;
    }
    /* Tables hold UTF-8, names of files any bytes. */
    memcpy(job->stored_command_line, job->command_line, line_size);
    cli_utf8_mend(job->stored_command_line);
    cli_utf8_mend(job->title);
    snprintf(job->partial, size, "%s" CLI_PARTIAL_ENDING, first);
    return CLI_DONE;
}

/* ---- what an interrupted run left ---- */

static int refuse_partial(const table_job *job, const srp_error *error) {
    int status = cli_input_error(error);
    cli_say("'%s' is of an interrupted run that this one cannot go on with; --restart discards it",
            job->partial);
    return status == CLI_MACHINE_FAILED ? status : CLI_BAD_INPUT;
}

static int resume(table_job *job) {
    srp_error error;
    if (srp_table_read(&srp_table_format_netcdf, job->partial, &job->table, &error) != SRP_OK) {
        return refuse_partial(job, &error);
    }
    if (srp_table_check_origin(job->table, job->loaded.prepared, job->grid, job->options->basis,
                               &error) != SRP_OK) {
        return refuse_partial(job, &error);
    }
    cli_say("going on with %s: %zu of %zu nodes are there", job->partial,
            srp_table_filled_count(job->table), srp_grid_node_count(job->grid));
    return CLI_DONE;
}

static int open_table(table_job *job) {
    const cli_table_options *options = job->options;
    srp_error error;
    int status = CLI_DONE;
    bool left = !chooses_step(job) && cli_system_file_exists(job->partial);
    if (left && options->restart && remove(job->partial) != 0) {
        fprintf(stderr, "%s: cannot remove the file\n", job->partial);
        return CLI_MACHINE_FAILED;
    }
    if (left && !options->restart) {
        status = resume(job);
    } else if (srp_table_create(job->loaded.prepared, job->grid, options->basis, &job->table,
                                &error) != SRP_OK) {
        status = cli_input_error(&error);
    }
    srp_sunlight light = srp_sunlight_default();
    light.flux = options->flux;
    if (status == CLI_DONE &&
        srp_table_describe(job->table, options->title != NULL ? options->title : job->title,
                           job->stored_command_line, light, options->mass, &error) != SRP_OK) {
        status = cli_input_error(&error);
    }
    return status;
}

/* ---- the cache ---- */

/* A cache that cannot be used costs a warning, and time. */
static void give_cache_up(table_job *job, const srp_error *why) {
    cli_output_error(why);
    cli_say("warning: the run goes on without the cache");
    srp_cache_close(job->cache);
    job->cache = NULL;
}

static void open_cache(table_job *job) {
    const srp_cache_params params = srp_cache_params_default();
    srp_log log = cli_log();
    srp_error error;
    if (job->options->cache && srp_cache_open(&params, &log, &job->cache, &error) != SRP_OK) {
        job->cache = NULL;
        give_cache_up(job, &error);
    }
}

/* Takes what is remembered, and has what is new remembered. */
static void exchange_nodes(table_job *job) {
    size_t before = srp_table_filled_count(job->table);
    srp_error error;
    if (job->cache == NULL) {
        return;
    }
    /* One that cannot be written may still have given nodes. */
    if (srp_cache_exchange(job->cache, job->loaded.prepared, job->table, NULL, &error) != SRP_OK) {
        give_cache_up(job, &error);
    }
    size_t after = srp_table_filled_count(job->table);
    if (after > before) {
        cli_say("%zu of %zu nodes come from the cache", after - before,
                srp_grid_node_count(job->grid));
    }
}

/* Has what is new remembered, while the table is being filled; whether that could be done. */
static bool keep_nodes(table_job *job, const srp_table *table) {
    srp_error error;
    if (job->cache == NULL) {
        return false;
    }
    if (srp_cache_keep(job->cache, job->loaded.prepared, table, &error) != SRP_OK) {
        cli_progress_clear(&job->progress);
        give_cache_up(job, &error);
    }
    return job->cache != NULL;
}

/* ---- computing ---- */

static bool save_partial(table_job *job, const srp_table *table, srp_error *error) {
    return srp_table_write(table, &srp_table_format_netcdf, job->partial, error) == SRP_OK;
}

static void save(table_job *job, const srp_table *table) {
    srp_error error;
    if (!chooses_step(job) && !save_partial(job, table, &error) && !job->save_failed) {
        cli_progress_clear(&job->progress);
        cli_output_error(&error);
        cli_say("warning: the run goes on, but could not be resumed after an interruption");
        job->save_failed = true;
    }
    (void)keep_nodes(job, table);
    job->saved = cli_system_seconds();
}

/* Shown in nodes, as everywhere: several of them may share a direction. */
static bool report(void *user, const srp_table *table, size_t done, size_t total) {
    table_job *job = user;
    if (cli_system_seconds() - job->saved >= CHECKPOINT_SECONDS && done < total) {
        save(job, table);
    }
    cli_progress_show(&job->progress, srp_table_filled_count(table),
                      srp_grid_node_count(job->grid));
    return cli_system_signal_seen() == 0;
}

/* Keeps what was computed, and says how to go on. */
static void leave_partial(table_job *job) {
    srp_error error;
    size_t filled = srp_table_filled_count(job->table);
    if (filled == 0) {
        return;
    }
    bool remembered = keep_nodes(job, job->table);
    if (chooses_step(job)) {
        if (remembered) {
            cli_say("%zu of %zu nodes of this step are in the cache; to go on:\n  %s", filled,
                    srp_grid_node_count(job->grid), job->command_line);
        }
        return;
    }
    if (!save_partial(job, job->table, &error)) {
        cli_output_error(&error);
        cli_say("what was computed is lost");
        return;
    }
    cli_say("%zu of %zu nodes are kept in %s; to go on:\n  %s", filled,
            srp_grid_node_count(job->grid), job->partial, job->command_line);
}

static int fill(table_job *job) {
    srp_table_progress progress = {report, job};
    srp_error error;
    cli_system_catch_signals();
    job->saved = cli_system_seconds();
    cli_progress_begin(&job->progress);
    srp_status status = srp_table_fill(job->table, job->loaded.prepared, &progress, &error);
    cli_progress_clear(&job->progress);
    if (status == SRP_OK) {
        return CLI_DONE;
    }
    int exit_status = CLI_MACHINE_FAILED;
    if (status == SRP_CANCELLED) {
        cli_say("interrupted");
    } else {
        exit_status = cli_input_error(&error);
    }
    leave_partial(job);
    if (status == SRP_CANCELLED) {
        cli_system_die_by_signal(cli_system_signal_seen());
    }
    return exit_status;
}

/* Nodes with this note (SRP_RESPONSE_...). */
static size_t count_flagged(const srp_table *table, unsigned flag) {
    srp_grid grid = srp_table_grid(table);
    size_t flagged = 0;
    for (uint32_t i = 0; i < grid.az_count; ++i) {
        for (uint32_t j = 0; j < grid.el_count; ++j) {
            flagged += (srp_table_node(table, i, j)->flags & flag) != 0;
        }
    }
    return flagged;
}

static int finish(table_job *job) {
    size_t written, missed = count_flagged(job->table, SRP_RESPONSE_TOLERANCE_MISSED);
    size_t cut = count_flagged(job->table, SRP_RESPONSE_CUT);
    size_t sampled = count_flagged(job->table, SRP_RESPONSE_MIRRORS_SAMPLED);
    int status = cli_outputs_write(&job->options->outputs, job->table, &written);
    if (status != CLI_DONE) {
        leave_partial(job);
        return status;
    }
    remove(job->partial);
    cli_outputs_report(&job->options->outputs, job->table);
    if (missed > 0) {
        cli_say("warning: %zu %s did not reach the tolerance with %u samples a side", missed,
                cli_form(missed, "node", "nodes"),
                srp_prepared_params(job->loaded.prepared)->max_samples);
    }
    uint32_t beams = srp_prepared_params(job->loaded.prepared)->mirrored_beams;
    if (sampled > 0 && beams > 0) {
        cli_say("in %zu %s mirrored light takes more than %u beams and was sampled (--beams)",
                sampled, cli_form(sampled, "node", "nodes"), beams);
    }
    if (cut > 0) {
        cli_say("warning: in %zu %s, part of the model lies outside the window", cut,
                cli_form(cut, "node", "nodes"));
    }
    return CLI_DONE;
}

/* ---- the error between nodes ---- */

static int begin_check(table_job *job) {
    const cli_table_options *options = job->options;
    if (!cli_is_given(options->given, TABLE_CHECK) && !chooses_step(job)) {
        return CLI_DONE;
    }
    return cli_interp_check_begin(&job->check, job->loaded.prepared, options->check,
                                  job->how->seed);
}

/* A table of job->grid, checked. */
static int compute(table_job *job) {
    int status = open_table(job);
    if (status == CLI_DONE) {
        exchange_nodes(job);
        status = fill(job);
    }
    if (status == CLI_DONE) {
        exchange_nodes(job);
    }
    if (status == CLI_DONE && job->check.count > 0) {
        status = cli_interp_check_table(&job->check, job->table);
    }
    return status;
}

/* Largest error by the scheme that --max-error is about, as a share of the largest |f|. */
static double checked_error(const table_job *job) {
    size_t count;
    const srp_interp_scheme *const *schemes = srp_interp_list(&count);
    const srp_interp_scheme *asked = srp_interp_find(job->options->interpolation);
    const srp_table_check *check = &srp_table_get_info(job->table)->check;
    for (size_t k = 0; k < count; ++k) {
        if (schemes[k] == asked) {
            double largest = cli_interp_largest(job->table);
            return largest > 0.0 ? check->errors[k].f_max / largest : 0.0;
        }
    }
    return NAN;
}

/* From coarse to fine, the first that is good enough. */
static int compute_by_error(table_job *job) {
    static const double STEPS[] = {30, 20, 15, 10, 7.5, 6, 5, 4, 3, 2.5, 2, 1.5, 1};
    const double asked = job->options->max_error;
    for (size_t k = 0; k < sizeof STEPS / sizeof STEPS[0]; ++k) {
        srp_error error;
        srp_table_destroy(job->table);
        job->table = NULL;
        if (srp_grid_from_steps(STEPS[k], STEPS[k], &job->grid, &error) != SRP_OK) {
            return cli_input_error(&error);
        }
        int status = compute(job);
        if (status != CLI_DONE || checked_error(job) <= asked) {
            return status;
        }
    }
    cli_say("warning: with steps of 1 degree the interpolation error is still %.2g of the largest "
            "|f|, more than %g",
            checked_error(job), asked);
    return CLI_DONE;
}

static int make_table(table_job *job) {
    const srp_method *method = NULL;
    srp_method_params params;
    int status = check(job, &method, &params);
    if (status == CLI_DONE) {
        status = name_things(job);
    }
    if (status == CLI_DONE) {
        status = cli_model_load(job->model, job->how, job->operands, method, &params, &job->loaded);
    }
    if (status == CLI_DONE) {
        status = begin_check(job);
        open_cache(job);
    }
    if (status == CLI_DONE) {
        status = chooses_step(job) ? compute_by_error(job) : compute(job);
    }
    if (status == CLI_DONE) {
        status = finish(job);
    }
    srp_table_destroy(job->table);
    cli_interp_check_end(&job->check);
    srp_cache_close(job->cache);
    cli_model_release(&job->loaded);
    free(job->title);
    free(job->stored_command_line);
    free(job->partial);
    return status;
}

static int run(const cli_command *command, int argc, char **argv) {
    cli_table_options options = cli_table_options_default();
    cli_model_options model = cli_model_options_default();
    cli_method_options how = cli_method_options_default();
    void *const targets[] = {&options, &model, &how};
    cli_operands operands;
    /* Before getopt_long() reorders the words. */
    char *command_line = cli_command_line_join(argc, argv, "--restart");
    if (command_line == NULL) {
        cli_say("no memory");
        return CLI_MACHINE_FAILED;
    }
    int status;
    if (cli_command_parse(command, argc, argv, targets, &operands, &status)) {
        table_job job = {.options = &options,
                         .model = &model,
                         .how = &how,
                         .operands = &operands,
                         .command_line = command_line};
        status = make_table(&job);
    }
    free(command_line);
    cli_list_free(&options.outputs);
    cli_list_free(&model.materials);
    return status;
}

const cli_command cli_command_table = {
    .name = "table",
    .operands = "MODEL.obj... -o FILE",
    .operand_files = "obj",
    .summary = "table of forces over azimuth and elevation of the Sun",
    .description =
        "Computes the response of a spacecraft to sunlight from all directions of a grid of "
        "azimuth and elevation, and writes it to one file or several. Several OBJ files are "
        "joined.\n\n"
        "Everything that can be checked is checked before the computing begins. A run that is "
        "interrupted (Ctrl-C) leaves its nodes in a file FIRST_OUTPUT.partial, and so does every "
        "half minute of a long one; the same command again goes on from there and gives the same "
        "table. With --cache a run takes the nodes that earlier runs have remembered, and gives "
        "the same table; its own are remembered at these times and in the end. A run that chooses "
        "its step (--max-error) leaves no such file and goes on only with --cache.\n\n"
        "Between nodes a table is interpolated. --check and --max-error compare that with what the "
        "method gives in other directions.",
    .examples = "srp table box-wing.obj -o box-wing.nc -o box-wing.spo\n"
                "srp table box-wing.obj -o box-wing.txt --step 10 --mass 850\n"
                "srp table bus.obj antenna.obj -o all.nc --material gold=0.6,0.1 --basis\n"
                "srp table dish.obj -o dish.nc --method raycast --tolerance 1e-4\n"
                "srp table box-wing.obj -o box-wing.nc --max-error 0.01",
    .groups = GROUPS,
    .group_count = sizeof GROUPS / sizeof GROUPS[0],
    .run = run,
};
