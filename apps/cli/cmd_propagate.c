/* SPDX-License-Identifier: Apache-2.0 */
/* srp propagate: an orbit with the chosen model of radiation pressure. */
#include "commands.h"
#include "messages.h"
#include "progress.h"
#include "system.h"
#include "text_file.h"
#include "track.h"

#include <srp/orbit/mission.h>

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum {
    PROPAGATE_VERSUS,
    PROPAGATE_OUTPUT,
    PROPAGATE_OEM,
    PROPAGATE_REPORT,
    PROPAGATE_EVENTS,
    PROPAGATE_OPTION_COUNT
};

typedef struct propagate_options {
    cli_given given;
    const char *versus, *output, *oem, *report, *events;
} propagate_options;

static const cli_option OPTIONS[PROPAGATE_OPTION_COUNT] = {
    [PROPAGATE_VERSUS] = {.name = "versus",
                          .value = "OTHER.yaml",
                          .complete = CLI_COMPLETE_FILE,
                          .help = "Propagate another mission, too, and tell how far it is from "
                                  "this one: radial, along-track and cross-track over time, as "
                                  "CSV.",
                          .set = cli_set_text,
                          .offset = offsetof(propagate_options, versus)},
    [PROPAGATE_OUTPUT] = {.name = "output",
                          .letter = 'o',
                          .value = "FILE",
                          .complete = CLI_COMPLETE_FILE,
                          .help = "With --versus: file for the differences. Default: standard "
                                  "output.",
                          .set = cli_set_text,
                          .offset = offsetof(propagate_options, output)},
    [PROPAGATE_OEM] = {.name = "oem",
                       .value = "FILE",
                       .complete = CLI_COMPLETE_FILE,
                       .help = "Write the orbit as CCSDS OEM; wins over output.oem of the mission.",
                       .set = cli_set_text,
                       .offset = offsetof(propagate_options, oem)},
    [PROPAGATE_REPORT] = {.name = "report",
                          .value = "FILE",
                          .complete = CLI_COMPLETE_FILE,
                          .help = "Write the report as CSV; wins over output.report.",
                          .set = cli_set_text,
                          .offset = offsetof(propagate_options, report)},
    [PROPAGATE_EVENTS] = {.name = "events",
                          .value = "FILE",
                          .complete = CLI_COMPLETE_FILE,
                          .help = "Write shadow edges and apsides as CSV; wins over output.events.",
                          .set = cli_set_text,
                          .offset = offsetof(propagate_options, events)},
};

static const cli_group OUTPUT = {"Output", OPTIONS, PROPAGATE_OPTION_COUNT};
static const cli_group *const GROUPS[] = {&OUTPUT};

/* ---- one run ---- */

enum { FILE_COUNT = 3 }; /* OEM, report, events */

typedef struct propagate_job {
    const srp_mission *mission;
    srp_mission_file *files[FILE_COUNT];
    cli_track *kept; /* NULL: rows are not kept */
    bool file_failed;
    srp_error file_error;
    cli_progress progress;
    size_t units;
} propagate_job;

static srp_status on_row(void *user, const srp_mission *mission, const srp_mission_row *row,
                         srp_error *error) {
    propagate_job *job = user;
    (void)mission;
    for (size_t i = 0; i < FILE_COUNT; ++i) {
        srp_status status =
            job->files[i] != NULL ? srp_mission_file_row(job->files[i], row, error) : SRP_OK;
        if (status != SRP_OK) {
            job->file_failed = true;
            return status;
        }
    }
    return job->kept != NULL ? cli_track_add(job->kept, row, error) : SRP_OK;
}

static void on_event(void *user, const srp_event *event) {
    propagate_job *job = user;
    for (size_t i = 0; i < FILE_COUNT; ++i) {
        if (job->files[i] != NULL && !job->file_failed) {
            job->file_failed =
                srp_mission_file_event(job->files[i], event, &job->file_error) != SRP_OK;
        }
    }
}

static bool on_progress(void *user, double done) {
    propagate_job *job = user;
    cli_progress_show(&job->progress, (size_t)(done * (double)job->units), job->units);
    return cli_system_signal_seen() == 0;
}

/* What the bar counts in. */
static size_t units_of(double seconds, const char **things) {
    const struct {
        double length;
        const char *name;
    } units[] = {{86400.0, "days"}, {3600.0, "hours"}, {60.0, "minutes"}, {1.0, "seconds"}};
    size_t i = 0;
    while (i < 3 && seconds < 5.0 * units[i].length) {
        ++i;
    }
    *things = units[i].name;
    return (size_t)ceil(seconds / units[i].length);
}

/* A mission that asks for what is not there is wrong input, not wrong usage. */
static int mission_error(const srp_error *error) {
    const int status = cli_input_error(error);
    return status == CLI_BAD_USAGE ? CLI_BAD_INPUT : status;
}

static int run_mission(propagate_job *job, srp_mission_summary *summary) {
    const srp_mission_watch watch = {on_row, on_event, on_progress, job};
    const char *things;
    srp_error error;
    job->units = units_of(srp_mission_get_info(job->mission)->duration, &things);
    cli_progress_begin(&job->progress);
    job->progress.things = things;
    srp_status status = srp_mission_run(job->mission, &watch, summary, &error);
    cli_progress_clear(&job->progress);
    if (status == SRP_CANCELLED) {
        cli_say("interrupted");
        for (size_t i = 0; i < FILE_COUNT; ++i) {
            srp_mission_file_abandon(job->files[i]);
        }
        cli_system_die_by_signal(cli_system_signal_seen());
    }
    if (status != SRP_OK) {
        return job->file_failed ? cli_output_error(&error) : mission_error(&error);
    }
    return job->file_failed ? cli_output_error(&job->file_error) : CLI_DONE;
}

/* ---- files ---- */

/* Now, or the date that reproducible builds ask for. */
static const char *creation_date(char *buffer, size_t size) {
    const char *fixed = getenv("SOURCE_DATE_EPOCH");
    const time_t now = fixed != NULL ? (time_t)strtoll(fixed, NULL, 10) : time(NULL);
    const struct tm *utc = gmtime(&now);
    if (utc == NULL || strftime(buffer, size, "%Y-%m-%dT%H:%M:%S", utc) == 0) {
        snprintf(buffer, size, "2000-01-01T00:00:00");
    }
    return buffer;
}

typedef struct file_names {
    const char *oem, *report, *events;
} file_names;

static file_names names_of(const propagate_options *options, const srp_mission_info *info) {
    file_names names = {options->oem != NULL ? options->oem : info->oem,
                        options->report != NULL ? options->report : info->report,
                        options->events != NULL ? options->events : info->events};
    return names;
}

/* Can `path` be written, and is it none of the files that the mission is read from? `key`: the
 * entry of the mission that names it, NULL for an option. */
static int check_output(const char *path, const char *key, const srp_mission_info *info) {
    const char *const inputs[] = {info->file, info->gravity_file, info->radiation_file,
                                  info->attitude_file};
    for (size_t i = 0; i < sizeof inputs / sizeof inputs[0]; ++i) {
        if (inputs[i] != NULL && cli_system_same_file(path, inputs[i])) {
            return cli_usage_error("%s is input and output at once", path);
        }
    }
    const char *reason;
    if (!cli_system_can_write(path, &reason)) {
        if (key != NULL) {
            fprintf(stderr, "%s: %s: ", info->file, key);
        }
        fprintf(stderr, "%s: cannot write: %s\n", path, reason);
        return CLI_MACHINE_FAILED;
    }
    return CLI_DONE;
}

static int check_names(const file_names *names, const srp_mission_info *info) {
    const char *all[] = {names->oem, names->report, names->events};
    const char *own[] = {info->oem, info->report, info->events};
    const char *keys[] = {"output.oem", "output.report", "output.events"};
    for (size_t i = 0; i < FILE_COUNT; ++i) {
        const char *key = all[i] == own[i] ? keys[i] : NULL;
        int status = all[i] != NULL ? check_output(all[i], key, info) : CLI_DONE;
        if (status != CLI_DONE) {
            return status;
        }
        for (size_t k = 0; all[i] != NULL && k < i; ++k) {
            if (all[k] != NULL && cli_system_same_name(all[i], all[k])) {
                return cli_usage_error("'%s' is to be written twice", all[i]);
            }
        }
    }
    return CLI_DONE;
}

static int open_files(propagate_job *job, const file_names *names) {
    char date[32];
    srp_error error;
    srp_status status = SRP_OK;
    if (names->oem != NULL) {
        status = srp_oem_begin(names->oem, job->mission, creation_date(date, sizeof date),
                               &job->files[0], &error);
    }
    if (status == SRP_OK && names->report != NULL) {
        status = srp_report_begin(names->report, job->mission, &job->files[1], &error);
    }
    if (status == SRP_OK && names->events != NULL) {
        status = srp_events_begin(names->events, job->mission, &job->files[2], &error);
    }
    return status == SRP_OK ? CLI_DONE : cli_output_error(&error);
}

static int close_files(propagate_job *job, int status) {
    for (size_t i = 0; i < FILE_COUNT; ++i) {
        srp_error error;
        if (job->files[i] == NULL) {
            continue;
        }
        if (status != CLI_DONE) {
            srp_mission_file_abandon(job->files[i]);
        } else if (srp_mission_file_commit(job->files[i], &error) != SRP_OK) {
            status = cli_output_error(&error);
        }
        job->files[i] = NULL;
    }
    return status;
}

/* ---- summary ---- */

static void print_summary(const srp_mission_info *info, const srp_mission_summary *sum) {
    char from[SRP_EPOCH_TEXT_SIZE], to[SRP_EPOCH_TEXT_SIZE];
    const char *scale = srp_time_scale_name(info->scale);
    if (info->title[0] != '\0') {
        printf("%s\n\n", info->title);
    }
    printf("from           %s %s\n", srp_epoch_format(info->epoch, info->scale, 3, from), scale);
    printf("to             %s %s\n",
           srp_epoch_format(srp_epoch_add(info->epoch, info->duration), info->scale, 3, to), scale);
    printf("steps          %llu, %llu rejected, %llu cut at shadow edges\n",
           (unsigned long long)sum->counts.steps, (unsigned long long)sum->counts.rejected,
           (unsigned long long)sum->counts.cut);
    printf("force calls    %llu\n", (unsigned long long)sum->counts.calls);
    if (sum->nodes_total > 0) {
        printf("nodes          %zu computed, %zu from the cache, %zu in the grid\n",
               sum->nodes_computed, sum->nodes_cached, sum->nodes_total);
    }
    printf("SRP            %s, impulse %.6g m/s\n", info->model, sum->impulse);
    printf("eclipses       %zu penumbras (%.1f s), %zu umbras (%.1f s)\n", sum->penumbras,
           sum->in_penumbra, sum->umbras, sum->in_umbra);
    printf("position       %.6f %.6f %.6f km\n", 1e-3 * sum->r.x, 1e-3 * sum->r.y, 1e-3 * sum->r.z);
    printf("velocity       %.9f %.9f %.9f km/s\n", 1e-3 * sum->v.x, 1e-3 * sum->v.y,
           1e-3 * sum->v.z);
}

static int propagate_one(const propagate_options *options, const srp_mission *mission,
                         cli_track *kept) {
    const srp_mission_info *info = srp_mission_get_info(mission);
    const file_names names = names_of(options, info);
    propagate_job job = {.mission = mission, .kept = kept};
    srp_mission_summary summary;
    int status = check_names(&names, info);
    if (status == CLI_DONE) {
        status = open_files(&job, &names);
    }
    if (status == CLI_DONE) {
        status = run_mission(&job, &summary);
    }
    status = close_files(&job, status);
    if (status == CLI_DONE && kept == NULL) {
        print_summary(info, &summary);
    }
    return status;
}

/* ---- differences ---- */

static void print_differences(FILE *out, const cli_track *a, const cli_track *b) {
    cli_rows_begin(out, true);
    for (size_t i = 0; i < a->count; ++i) {
        cli_rows_put(out, a->t[i], cli_track_difference(a, b, i), cli_track_distance(a, b, i));
    }
}

static int write_differences(const propagate_options *options, const cli_track *a,
                             const cli_track *b) {
    cli_text_file file;
    if (options->output == NULL) {
        print_differences(stdout, a, b);
        return CLI_DONE;
    }
    int status = cli_text_file_begin(&file, options->output);
    if (status == CLI_DONE) {
        print_differences(file.out, a, b);
        status = cli_text_file_end(&file);
    }
    return status;
}

/* Before the work: the file of the differences. */
static int check_differences(const propagate_options *options, const srp_mission *a,
                             const srp_mission *b) {
    if (options->output == NULL) {
        return CLI_DONE;
    }
    const file_names names = names_of(options, srp_mission_get_info(a));
    const char *all[] = {names.oem, names.report, names.events};
    for (size_t i = 0; i < FILE_COUNT; ++i) {
        if (all[i] != NULL && cli_system_same_name(options->output, all[i])) {
            return cli_usage_error("'%s' is to be written twice", all[i]);
        }
    }
    int status = check_output(options->output, NULL, srp_mission_get_info(a));
    return status == CLI_DONE ? check_output(options->output, NULL, srp_mission_get_info(b))
                              : status;
}

/* What both must have alike; the first that they have not. */
static int propagate_both(const propagate_options *options, const srp_mission *a,
                          const srp_mission *b) {
    cli_track one = {0}, other = {0};
    /* Only the first mission writes its files: the two may name the same. */
    propagate_job job = {.mission = b, .kept = &other};
    srp_mission_summary summary;
    int status = cli_missions_check_pair(a, b);
    if (status == CLI_DONE) {
        status = check_differences(options, a, b);
    }
    if (status == CLI_DONE) {
        status = propagate_one(options, a, &one);
    }
    if (status == CLI_DONE) {
        status = run_mission(&job, &summary);
    }
    if (status == CLI_DONE) {
        status = write_differences(options, &one, &other);
    }
    cli_track_free(&one);
    cli_track_free(&other);
    return status;
}

static int propagate(const propagate_options *options, const cli_operands *operands) {
    srp_mission *a = NULL, *b = NULL;
    srp_error error;
    if (operands->count != 1) {
        return cli_usage_error("expected one file, MISSION.yaml, found %zu", operands->count);
    }
    if (options->output != NULL && options->versus == NULL) {
        return cli_usage_error(
            "--output goes with --versus; files of one orbit are --oem, --report "
            "and --events");
    }
    if (cli_mission_read(operands->items[0], &a, &error) != SRP_OK) {
        return mission_error(&error);
    }
    int status = CLI_DONE;
    if (options->versus != NULL && cli_mission_read(options->versus, &b, &error) != SRP_OK) {
        status = mission_error(&error);
    }
    cli_system_catch_signals();
    if (status == CLI_DONE) {
        status = b != NULL ? propagate_both(options, a, b) : propagate_one(options, a, NULL);
    }
    srp_mission_destroy(a);
    srp_mission_destroy(b);
    return status;
}

static int run(const cli_command *command, int argc, char **argv) {
    propagate_options options = {0};
    void *const targets[] = {&options};
    cli_operands operands;
    int status;
    gsl_set_error_handler_off(); /* it would end the program */
    if (cli_command_parse(command, argc, argv, targets, &operands, &status)) {
        status = propagate(&options, &operands);
    }
    return status;
}

const cli_command cli_command_propagate = {
    .name = "propagate",
    .operands = "MISSION.yaml",
    .operand_files = "yaml",
    .summary = "orbit with the chosen model of radiation pressure",
    .description =
        "Integrates an orbit that a mission file describes: epoch, state, spacecraft, attitude, "
        "forces, output. Sun, Moon and planets come from ERFA, shadows of several bodies are "
        "followed to their edges.\n\n"
        "The model of radiation pressure is a cannonball, plates, a table, a mesh that is asked at "
        "each call, or a table on demand, which fills itself as the orbit asks and keeps its "
        "nodes in the cache ('srp cache').\n\n"
        "Prints a summary. The orbit goes into files that the mission or the options name: a "
        "CCSDS Orbit Ephemeris Message, a report of columns that the mission chooses, events.",
    .examples = "srp propagate geo.yaml\n"
                "srp propagate geo.yaml --oem geo.oem --report geo.csv\n"
                "srp propagate cannonball.yaml --versus table.yaml -o difference.csv",
    .groups = GROUPS,
    .group_count = sizeof GROUPS / sizeof GROUPS[0],
    .run = run,
};
