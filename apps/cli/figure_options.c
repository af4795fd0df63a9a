/* SPDX-License-Identifier: Apache-2.0 */
/* What a user can say about a figure, whether or not this build can draw one. */
#include "figure.h"
#include "messages.h"
#include "numbers.h"

static bool set_view(const cli_option *option, void *target, const char *text) {
    double value[2];
    if (!cli_read_numbers(text, 2, value) || value[0] < -360.0 || value[0] > 360.0 ||
        value[1] < 0.0 || value[1] > 85.0) {
        return cli_reject(option, text,
                          "AZ,EL: degrees from -360 to 360 and from 0 to 85, with a comma");
    }
    double *view = (double *)(void *)((char *)target + option->offset);
    view[0] = value[0];
    view[1] = value[1];
    return true;
}

static const cli_range WIDTH = {600, 10000, "a whole number from 600 to 10000"};

static const cli_option OPTIONS[FIGURE_OPTION_COUNT] = {
    [FIGURE_OUTPUT] = {.name = "output",
                       .letter = 'o',
                       .value = "FIG",
                       .complete = CLI_COMPLETE_FILE,
                       .help =
                           "Draw a figure into this file; the ending .png, .svg or .pdf chooses "
                           "its format.",
                       .set = cli_set_text,
                       .offset = offsetof(cli_figure_options, output)},
    [FIGURE_MAP] =
        {.name = "map",
         .help = "Draw flat maps with contours instead of surfaces: equirectangular and, of a "
                 "single table, also by Mollweide's projection, whose areas are true.",
         .set = cli_set_flag,
         .offset = offsetof(cli_figure_options, map)},
    [FIGURE_VIEW] = {.name = "view",
                     .value = "AZ,EL",
                     .help = "Where surfaces are looked at from, in degrees: turned by AZ, from EL "
                             "above, at most 85. Default: 210,35.",
                     .set = set_view,
                     .offset = offsetof(cli_figure_options, view)},
    [FIGURE_WIDTH] =
        {.name = "width",
         .value = "PX",
         .help =
             "Width of the figure in pixels, from 600 to 10000; the height follows. Default: 1200.",
         .set = cli_set_count,
         .offset = offsetof(cli_figure_options, width),
         .range = &WIDTH},
};

const cli_group cli_group_figure = {"Figure", OPTIONS, FIGURE_OPTION_COUNT};

cli_figure_options cli_figure_options_default(void) {
    cli_figure_options options = {.view = {210.0, 35.0}, .width = 1200};
    return options;
}
