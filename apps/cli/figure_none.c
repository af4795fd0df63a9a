/* SPDX-License-Identifier: Apache-2.0 */
/* In place of figure.c where PLplot is missing. */
#include "figure.h"
#include "messages.h"

int cli_figure_check(const cli_figure_options *options, const char *const *inputs,
                     size_t input_count) {
    (void)inputs;
    (void)input_count;
    if (options->output == NULL) {
        return CLI_DONE;
    }
    cli_say("%s: this program was built without PLplot and draws no figures", options->output);
    return CLI_MACHINE_FAILED;
}

int cli_figure_write(const cli_figure_options *options, const cli_picture *picture) {
    (void)picture;
    return cli_figure_check(options, NULL, 0);
}
