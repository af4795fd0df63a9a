/* SPDX-License-Identifier: Apache-2.0 */
#include "interp_check.h"

#include "messages.h"
#include "progress.h"
#include "system.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Directions between two looks at the signals, per thread. */
enum { BATCH = 8 };

int cli_interp_check_begin(cli_interp_check *check, const srp_prepared *prepared, uint32_t count,
                           uint64_t seed) {
    check->count = count;
    check->seed = seed;
    check->s = malloc(count * sizeof *check->s);
    check->truth = malloc(count * sizeof *check->truth);
    if (check->s == NULL || check->truth == NULL) {
        cli_say("no memory");
        return CLI_MACHINE_FAILED;
    }
    srp_interp_directions(count, seed, check->s);
    cli_progress progress;
    cli_system_catch_signals();
    cli_progress_begin(&progress);
    size_t batch = (size_t)BATCH * (size_t)srp_prepared_params(prepared)->threads;
    srp_status status = SRP_OK;
    srp_error error;
    for (size_t done = 0; done < count && status == SRP_OK; done += batch) {
        size_t next = batch < count - done ? batch : count - done;
        cli_progress_show(&progress, done, count);
        status = srp_prepared_respond(prepared, next, check->s + done, check->truth + done, NULL,
                                      &error);
        if (cli_system_signal_seen() != 0) {
            cli_progress_clear(&progress);
            cli_say("interrupted");
            cli_system_die_by_signal(cli_system_signal_seen());
        }
    }
    cli_progress_clear(&progress);
    return status == SRP_OK ? CLI_DONE : cli_input_error(&error);
}

void cli_interp_check_end(cli_interp_check *check) {
    free(check->s);
    free(check->truth);
    check->s = NULL;
    check->truth = NULL;
}

int cli_interp_check_table(const cli_interp_check *check, srp_table *table) {
    srp_table_check found;
    srp_error error;
    if (srp_interp_check(table, check->count, check->s, check->truth, check->seed, &found,
                         &error) != SRP_OK) {
        return cli_input_error(&error);
    }
    srp_table_set_check(table, &found);
    return CLI_DONE;
}

double cli_interp_largest(const srp_table *table) {
    srp_table_report report;
    srp_table_inspect(table, "", NULL, &report);
    return report.f_max;
}

void cli_interp_check_report(const srp_table *table) {
    const srp_table_check *check = &srp_table_get_info(table)->check;
    if (check->count == 0) {
        return;
    }
    double largest = cli_interp_largest(table);
    double share = largest > 0.0 ? 100.0 / largest : 0.0;
    size_t count;
    const srp_interp_scheme *const *schemes = srp_interp_list(&count);
    printf("interpolation error of f in %u directions, mean and largest:\n", check->count);
    for (size_t k = 0; k < count; ++k) {
        const srp_table_error *e = &check->errors[k];
        if (isnan(e->f_mean)) {
            printf("  %-8s  steps are too large for it\n", schemes[k]->name);
        } else {
            printf("  %-8s  %.2e and %.2e m^2 (%.2g and %.2g %% of the largest |f|)\n",
                   schemes[k]->name, e->f_mean, e->f_max, share * e->f_mean, share * e->f_max);
        }
    }
}
