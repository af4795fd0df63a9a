/* SPDX-License-Identifier: Apache-2.0 */
/* srp picture: what the Sun sees, and where the force points. */
#include "commands.h"
#include "messages.h"
#include "methods.h"
#include "model.h"
#include "numbers.h"
#include "picture.h"
#include "system.h"
#include "utf8.h"

#include <srp/sunlight.h>
#include <srp/table.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    PICTURE_OUTPUT,
    PICTURE_AZ,
    PICTURE_EL,
    PICTURE_LIGHT,
    PICTURE_VIEW,
    PICTURE_SIZE,
    PICTURE_TITLE,
    PICTURE_DEVICE,
    PICTURE_OPTION_COUNT
};

typedef struct picture_options {
    cli_given given;
    const char *output, *title, *device;
    double az, el, view[2];
    cli_light light;
    uint32_t size[2];
} picture_options;

static const cli_range AZIMUTH = {-360.0, 360.0, "an angle from -360 to 360 degrees"};
static const cli_range ELEVATION = {-90.0, 90.0, "an angle from -90 to 90 degrees"};

static const char *const LIGHTS[] = {"material", "incidence", "force"};

static bool set_light(const cli_option *option, void *target, const char *text) {
    for (size_t k = 0; k < sizeof LIGHTS / sizeof LIGHTS[0]; ++k) {
        if (strcmp(text, LIGHTS[k]) == 0) {
            *(cli_light *)(void *)((char *)target + option->offset) = (cli_light)k;
            return true;
        }
    }
    return cli_reject(option, text, "material, incidence or force");
}

static bool set_view(const cli_option *option, void *target, const char *text) {
    double value[2];
    if (!cli_read_numbers(text, 2, value) || fabs(value[0]) > 360.0 || fabs(value[1]) > 90.0) {
        return cli_reject(option, text,
                          "AZ,EL: degrees from -360 to 360 and from -90 to 90, with a comma");
    }
    memcpy((char *)target + option->offset, value, sizeof value);
    return true;
}

enum { SIDE_MIN = 300, SIDE_MAX = 5000, SIZE_TEXT = 32 };

static bool set_size(const cli_option *option, void *target, const char *text) {
    static const char EXPECTED[] = "WIDTHxHEIGHT: whole numbers from 300 to 5000, as in 1600x900";
    char first[SIZE_TEXT];
    uint64_t value[2];
    const char *between = strchr(text, 'x');
    size_t length = between != NULL ? (size_t)(between - text) : SIZE_TEXT;
    if (length >= SIZE_TEXT) {
        return cli_reject(option, text, EXPECTED);
    }
    memcpy(first, text, length);
    first[length] = '\0';
    if (!cli_read_count(first, SIDE_MAX, &value[0]) ||
        !cli_read_count(between + 1, SIDE_MAX, &value[1]) || value[0] < SIDE_MIN ||
        value[1] < SIDE_MIN) {
        return cli_reject(option, text, EXPECTED);
    }
    uint32_t *size = (uint32_t *)(void *)((char *)target + option->offset);
    size[0] = (uint32_t)value[0];
    size[1] = (uint32_t)value[1];
    return true;
}

static const cli_option OPTIONS[PICTURE_OPTION_COUNT] = {
    [PICTURE_OUTPUT] = {.name = "output",
                        .letter = 'o',
                        .value = "PNG",
                        .complete = CLI_COMPLETE_FILE,
                        .help = "Draw into this file; its ending is .png.",
                        .set = cli_set_text,
                        .offset = offsetof(picture_options, output)},
    [PICTURE_AZ] = {.name = "az",
                    .value = "DEG",
                    .help = "Azimuth of the Sun in body axes: from +X towards +Y.",
                    .set = cli_set_number,
                    .offset = offsetof(picture_options, az),
                    .range = &AZIMUTH},
    [PICTURE_EL] = {.name = "el",
                    .value = "DEG",
                    .help = "Elevation of the Sun: from the XY plane towards +Z.",
                    .set = cli_set_number,
                    .offset = offsetof(picture_options, el),
                    .range = &ELEVATION},
    [PICTURE_LIGHT] = {.name = "light",
                       .value = "WHAT",
                       .complete = CLI_COMPLETE_WORDS,
                       .words = "material incidence force",
                       .help =
                           "What colours the sunlit surface: its material (default), the cosine "
                           "of the angle between normal and Sun (incidence), or the force on "
                           "it for each square metre (force).",
                       .set = set_light,
                       .offset = offsetof(picture_options, light)},
    [PICTURE_VIEW] = {.name = "view",
                      .value = "AZ,EL",
                      .help =
                          "Where the second picture is seen from, in degrees of the body axes. "
                          "Default: 75 degrees of azimuth from the Sun, at elevation 15, or -15 "
                          "where the Sun is below.",
                      .set = set_view,
                      .offset = offsetof(picture_options, view)},
    [PICTURE_SIZE] = {.name = "size",
                      .value = "WxH",
                      .help =
                          "Width and height in pixels, each from 300 to 5000. Default: 1600x900.",
                      .set = set_size,
                      .offset = offsetof(picture_options, size)},
    [PICTURE_TITLE] = {.name = "title",
                       .value = "TEXT",
                       .help = "Title of the picture. Default: the files, and where the Sun is.",
                       .set = cli_set_title,
                       .offset = offsetof(picture_options, title)},
    [PICTURE_DEVICE] = {.name = "device",
                        .value = "DEVICE",
                        .complete = CLI_COMPLETE_WORDS,
                        .words = "gl gl:osmesa gl:egl",
                        .help = "What draws: gl:osmesa (OpenGL without a GPU; gl is short for it), "
                                "gl:egl, gl:egl:N. Default: the first of the first two that works.",
                        .set = cli_set_text,
                        .offset = offsetof(picture_options, device)},
};

static const cli_group PICTURE = {"Picture", OPTIONS, PICTURE_OPTION_COUNT};
static const cli_group *const GROUPS[] = {&PICTURE, &cli_group_shape};

/* ---- before the work ---- */

static int check_output(const char *path, const cli_operands *operands) {
    const char *reason;
    if (!cli_ends_with(path, ".png")) {
        return cli_usage_error("%s: unknown ending (the format of pictures: .png)", path);
    }
    for (size_t k = 0; k < operands->count; ++k) {
        if (cli_system_same_file(path, operands->items[k])) {
            return cli_usage_error("%s is input and output at once", path);
        }
    }
    if (!cli_system_can_write(path, &reason)) {
        fprintf(stderr, "%s: cannot write: %s\n", path, reason);
        return CLI_MACHINE_FAILED;
    }
    return cli_portrait_check();
}

static int check(const picture_options *options, const cli_operands *operands) {
    if (operands->count == 0) {
        return cli_usage_error("expected one model or more: MODEL.obj");
    }
    if (options->output == NULL) {
        return cli_usage_error("where to? -o PICTURE.png");
    }
    if (!cli_is_given(options->given, PICTURE_AZ) || !cli_is_given(options->given, PICTURE_EL)) {
        return cli_usage_error("the direction of the Sun is missing: --az DEG --el DEG");
    }
    return check_output(options->output, operands);
}

/* ---- the work ---- */

/* The files without their folders, and the Sun; freed by the caller. NULL without memory. */
static char *make_title(const picture_options *options, const cli_operands *operands) {
    char az[CLI_NUMBER_SIZE], el[CLI_NUMBER_SIZE], sun[2 * CLI_NUMBER_SIZE + 40];
    snprintf(sun, sizeof sun, ", Sun at azimuth %s°, elevation %s°",
             cli_write_number(options->az, az), cli_write_number(options->el, el));
    size_t size = strlen(sun) + 1;
    for (size_t k = 0; k < operands->count; ++k) {
        size += strlen(operands->items[k]) + 3;
    }
    char *title = malloc(size);
    size_t used = 0;
    for (size_t k = 0; title != NULL && k < operands->count; ++k) {
        const char *slash = strrchr(operands->items[k], '/');
        used += (size_t)snprintf(title + used, size - used, "%s%s", k > 0 ? " + " : "",
                                 slash != NULL ? slash + 1 : operands->items[k]);
    }
    if (title != NULL) {
        snprintf(title + used, size - used, "%s", sun);
    }
    return title;
}

static int draw(const picture_options *options, const cli_operands *operands,
                const cli_model *model) {
    srp_error error;
    cli_portrait portrait = {
        .scene = model->scene,
        .sun = {options->az, options->el},
        .side = {remainder(options->az + 75.0, 360.0), options->el < 0.0 ? -15.0 : 15.0},
        .light = options->light,
        .width = options->size[0],
        .height = options->size[1],
        .device = options->device};
    if (cli_is_given(options->given, PICTURE_VIEW)) {
        memcpy(portrait.side, options->view, sizeof portrait.side);
    }
    srp_vec3 s = srp_direction_from_deg(options->az, options->el);
    if (srp_prepared_respond(model->prepared, 1, &s, &portrait.response, NULL, &error) != SRP_OK) {
        return cli_input_error(&error);
    }
    srp_sunlight light = srp_sunlight_default();
    portrait.pressure = srp_sunlight_pressure(light, light.au);
    char *title = make_title(options, operands);
    if (title == NULL) {
        cli_say("no memory for the title");
        return CLI_MACHINE_FAILED;
    }
    portrait.title = options->title != NULL ? options->title : title;
    int status = cli_portrait_write(&portrait, options->output);
    if (status == CLI_DONE) {
        char text[2][CLI_PORTRAIT_WORDS];
        cli_portrait_words(&portrait, text);
        printf("%s\n%s\n%s\n", options->output, text[0], text[1]);
    }
    free(title);
    return status;
}

static int picture(picture_options *options, const cli_model_options *model_options,
                   const cli_operands *operands) {
    cli_model model;
    cli_method_options how = cli_method_options_default();
    srp_method_params params = srp_method_params_default();
    int status = check(options, operands);
    if (status == CLI_DONE) {
        status = cli_model_load(model_options, &how, operands, &srp_method_exact, &params, &model);
    }
    if (status != CLI_DONE) {
        return status;
    }
    options->device = options->device != NULL ? cli_device_of(options->device) : NULL;
    status = draw(options, operands, &model);
    cli_model_release(&model);
    return status;
}

static int run(const cli_command *command, int argc, char **argv) {
    picture_options options = {.size = {1600, 900}};
    cli_model_options model = cli_model_options_default();
    void *const targets[] = {&options, &model};
    cli_operands operands;
    int status;
    if (cli_command_parse(command, argc, argv, targets, &operands, &status)) {
        status = picture(&options, &model, &operands);
    }
    cli_list_free(&model.materials);
    return status;
}

const cli_command cli_command_picture = {
    .name = "picture",
    .operands = "MODEL.obj... --az DEG --el DEG -o PNG",
    .operand_files = "obj",
    .summary = "picture of a spacecraft in sunlight",
    .description =
        "Draws the spacecraft twice: as the Sun sees it, and from a side. What the Sun does not "
        "reach is dark, with the edges of shadows where the exact method finds them. Arrows show "
        "the body axes, the sunlight and the force of direct light, which is also written below "
        "and printed: "
        "the area vector f [m^2], and the force at 1 au from the Sun. What a surface hides of an "
        "arrow shines through.\n\n"
        "With --light incidence or --light force the sunlit surface is coloured by its share of "
        "the light, or by the length of the force that direct light has on each square metre of it "
        "in units of the radiation pressure.",
    .examples = "srp picture box-wing.obj --az 30 --el 10 -o box-wing.png\n"
                "srp picture dish.obj --az 30 --el 40 -o dish.png --light force\n"
                "srp picture gnss.obj --az 0 --el 0 -o gnss.png --view 60,-30 --size 2400x1200",
    .groups = GROUPS,
    .group_count = sizeof GROUPS / sizeof GROUPS[0],
    .run = run,
};
