/* SPDX-License-Identifier: Apache-2.0 */
/* A figure from the first to the last: device, page, panels, file. */
#include "figure.h"

#include "figure_draw.h"
#include "messages.h"
#include "svg_compact.h"
#include "system.h"
#include "text_file.h"
#include "utf8.h"

#include <errno.h>
#include <math.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

/* ---- formats ---- */

typedef struct format {
    const char *ending, *device;
    const char *tail; /* what a file that is whole ends with, but for white space */
    size_t tail_size;
    /* Finer surfaces and maps are not seen, and in an .svg each piece is a line of text. */
    uint32_t steps_max;               /* of surfaces */
    int rows, levels;                 /* of colours on maps */
    bool (*finish)(const char *path); /* what is still to be done; NULL: nothing */
} format;

static const format FORMATS[] = {
    {".png", "pngcairo", "IEND\xae\x42\x60\x82", 8, 90, 360, 64, NULL},
    {".svg", "svgcairo", "</svg>", 6, 40, 100, 40, cli_svg_compact_file},
    {".pdf", "pdfcairo", "%%EOF", 5, 90, 180, 64, NULL}};

static const format *format_of(const char *path) {
    for (size_t k = 0; k < sizeof FORMATS / sizeof FORMATS[0]; ++k) {
        if (cli_ends_with(path, FORMATS[k].ending)) {
            return &FORMATS[k];
        }
    }
    return NULL;
}

static bool has_device(const char *name) {
    const char *menu[128], *device[128], **menus = menu, **devices = device;
    int count = 128;
    plgFileDevs(&menus, &devices, &count);
    for (int k = 0; k < count; ++k) {
        if (strcmp(devices[k], name) == 0) {
            return true;
        }
    }
    return false;
}

int cli_figure_check(const cli_figure_options *options, const char *const *inputs,
                     size_t input_count) {
    const char *path = options->output, *reason;
    if (path == NULL) {
        return CLI_DONE;
    }
    const format *kind = format_of(path);
    if (kind == NULL) {
        return cli_usage_error("%s: unknown ending (formats of figures: .png, .svg, .pdf)", path);
    }
    for (size_t k = 0; k < input_count; ++k) {
        if (cli_system_same_file(path, inputs[k])) {
            return cli_usage_error("%s is input and output at once", path);
        }
    }
    if (!cli_system_can_write(path, &reason)) {
        cli_say_of_file("%s: cannot write: %s", path, reason);
        return CLI_MACHINE_FAILED;
    }
    /* PLplot goes back and forth in what it writes, and its end is looked at. */
    bool special;
    char *target = cli_system_write_target(path, &special);
    free(target);
    if (special) {
        cli_say_of_file("%s: cannot write: a figure needs a regular file", path);
        return CLI_MACHINE_FAILED;
    }
    if (!has_device(kind->device)) {
        cli_say("%s: PLplot lacks its driver %s (package plplot-driver-cairo)", path, kind->device);
        return CLI_MACHINE_FAILED;
    }
    return CLI_DONE;
}

/* PLplot does not say when a disk is full: a file that is whole has an end. */
static bool is_whole(const char *path, const format *kind) {
    char tail[64];
    bool whole = false;
    FILE *in = fopen(path, "rb");
    if (in == NULL) {
        return false;
    }
    if (fseek(in, -(long)kind->tail_size - 8, SEEK_END) == 0) {
        size_t size = fread(tail, 1, sizeof tail, in);
        while (size > 0 && (tail[size - 1] == '\n' || tail[size - 1] == '\r')) {
            --size;
        }
        whole = size >= kind->tail_size &&
                memcmp(tail + size - kind->tail_size, kind->tail, kind->tail_size) == 0;
    }
    fclose(in);
    return whole;
}

/* ---- what panels share ---- */

void cli_figure_colours(cli_scale scale, double low, double high) {
    cli_palette palette;
    PLINT rgb[3][CLI_PALETTE_SIZE];
    scale.is_signed ? cli_palette_diverging(&palette) : cli_palette_sequential(&palette);
    double reach = fmax(fabs(scale.low), fabs(scale.high));
    double first = scale.is_signed ? -reach : scale.low,
           last = scale.is_signed ? reach : scale.high;
    for (int k = 0; k < CLI_PALETTE_SIZE; ++k) {
        double value = low + (high - low) * (k + 0.5) / CLI_PALETTE_SIZE;
        double at = (value - first) / (last - first) * CLI_PALETTE_SIZE;
        int place = (int)fmin(fmax(at, 0.0), CLI_PALETTE_SIZE - 1.0);
        for (int c = 0; c < 3; ++c) {
            rgb[c][k] = (PLINT)lround(255.0 * palette.rgb[place][c]);
        }
    }
    plscmap1n(CLI_PALETTE_SIZE);
    plscmap1(rgb[0], rgb[1], rgb[2], CLI_PALETTE_SIZE);
}

char *cli_figure_text(const char *text) {
    char *masked = malloc(2 * strlen(text) + 1), *to = masked;
    for (; masked != NULL && *text != '\0'; ++text) {
        if (*text == '#') {
            *to++ = '#';
        }
        *to++ = *text;
    }
    if (masked != NULL) {
        *to = '\0';
    }
    return masked;
}

/* ---- the page ---- */

enum { TITLE_PX = 60, HEADING_PX = 40, SURFACE_PX = 450, MAP_PX = 370, PAGE_PX = 1200 };

static size_t page_rows(const cli_figure_options *options, const cli_picture *picture) {
    bool pairs = picture->columns == 1 && !options->map && picture->rows > 1;
    return pairs ? (picture->rows + 1) / 2 : picture->rows;
}

/* Height of the page in units of which its width is PAGE_PX. */
static double page_height(const cli_figure_options *options, const cli_picture *picture) {
    double row = options->map ? MAP_PX : SURFACE_PX;
    return TITLE_PX + (picture->columns > 1 ? HEADING_PX : 0) +
           row * (double)page_rows(options, picture);
}

/* Letters that fit across the page at size 1; a text that is longer is made smaller, down to a
 * share, before its middle is left out. */
enum { PAGE_LETTERS = 130 };
static const double SMALLEST = 0.7;

/* At most `most` letters of `text`, of which the middle is left out if need be; freed by the
 * caller. NULL without memory. */
static char *shortened(const char *text, size_t count, size_t most) {
    static const char DOTS[] = "…";
    char *out = malloc(strlen(text) + sizeof DOTS), *to = out;
    size_t head = count > most ? most / 2 : count,
           tail = count > most ? count - (most - head - 1) : count;
    for (size_t k = 0; out != NULL && *text != '\0'; ++k) {
        size_t size = cli_utf8_length(text);
        size = size > 0 ? size : 1;
        if (k == head && count > most) {
            memcpy(to, DOTS, sizeof DOTS - 1);
            to += sizeof DOTS - 1;
        }
        if (k < head || k >= tail) {
            memcpy(to, text, size);
            to += size;
        }
        text += size;
    }
    if (out != NULL) {
        *to = '\0';
    }
    return out;
}

/* Words about a point, on a share of the page's width. */
static void put_words(double x, double y, double size, double share, const char *text) {
    size_t count = 0, room = (size_t)(share * PAGE_LETTERS / size);
    for (const char *at = text; *at != '\0'; ++count) {
        size_t length = cli_utf8_length(at);
        at += length > 0 ? length : 1;
    }
    if (count > room) {
        size *= fmax((double)room / (double)count, SMALLEST);
    }
    char *cut = shortened(text, count, (size_t)((double)room / SMALLEST));
    char *masked = cut != NULL ? cli_figure_text(cut) : NULL;
    plvpor(0.0, 1.0, 0.0, 1.0);
    plwind(0.0, 1.0, 0.0, 1.0);
    plcol0(INK_BLACK);
    plschr(0.0, size);
    plptex(x, y, 1.0, 0.0, 0.5, masked != NULL ? masked : "");
    plschr(0.0, 1.0);
    free(masked);
    free(cut);
}

void cli_figure_pen(double width) {
    double dpi_x, dpi_y;
    PLINT across, down, x, y;
    plgpage(&dpi_x, &dpi_y, &across, &down, &x, &y);
    plwidth(width * (double)across / PAGE_PX);
}

/* The place of column c of `columns`, row r from above; `x` and `y` margins in page units. */
static cli_panel cell(const cli_figure_options *options, const cli_picture *picture, double left,
                      double right, size_t r) {
    double height = page_height(options, picture), row = options->map ? MAP_PX : SURFACE_PX;
    double top = TITLE_PX + (picture->columns > 1 ? HEADING_PX : 0) + row * (double)r;
    double above = options->map ? 40.0 : 4.0, below = options->map ? 66.0 : 4.0;
    return (cli_panel){left / PAGE_PX, right / PAGE_PX, 1.0 - (top + row - below) / height,
                       1.0 - (top + above) / height};
}

static bool draw_surfaces(const cli_figure_options *options, const cli_picture *picture) {
    bool good = true;
    cli_look look = {
        {options->view[0], options->view[1]}, format_of(options->output)->steps_max, false};
    for (size_t r = 0; r < picture->rows; ++r) {
        cli_scale scale = cli_figure_scale(picture, r);
        for (size_t c = 0; c < picture->columns; ++c) {
            size_t across = picture->columns > 1 ? c : r % 2;
            size_t down = picture->columns > 1 || picture->rows == 1 ? r : r / 2;
            double left = 600.0 * (double)across + 10.0;
            double right = picture->rows == 1 && picture->columns == 1 ? 1190.0 : left + 580.0;
            cli_panel panel = cell(options, picture, left, right, down);
            good = good && cli_figure_surface(&panel, picture, c, r, scale, &look);
        }
    }
    return good;
}

static bool draw_maps(const cli_figure_options *options, const cli_picture *picture) {
    bool good = true;
    const format *kind = format_of(options->output);
    for (size_t r = 0; r < picture->rows; ++r) {
        cli_scale scale = cli_figure_scale(picture, r);
        for (size_t k = 0; k < 2; ++k) {
            double left = k == 0 ? 85.0 : picture->columns > 1 ? 625.0 : 590.0;
            cli_panel panel = cell(options, picture, left, left + 460.0, r);
            size_t column = picture->columns > 1 ? k : 0;
            bool mollweide = picture->columns == 1 && k == 1;
            good = good && cli_figure_map(&panel, picture, column, r, scale, kind->rows,
                                          kind->levels, mollweide);
        }
        cli_panel bar = cell(options, picture, 1100.0, 1122.0, r);
        cli_figure_bar(&bar, scale);
    }
    return good;
}

static bool draw_page(const cli_figure_options *options, const cli_picture *picture) {
    double height = page_height(options, picture);
    pladv(0);
    put_words(0.5, 1.0 - 0.5 * TITLE_PX / height, 1.25, 1.0, picture->title);
    for (size_t c = 0; c < picture->columns && picture->columns > 1; ++c) {
        put_words(0.25 + 0.5 * (double)c, 1.0 - (TITLE_PX + 0.4 * HEADING_PX) / height, 1.0, 0.5,
                  picture->heading[c]);
    }
    return options->map ? draw_maps(options, picture) : draw_surfaces(options, picture);
}

/* ---- PLplot, which ends the program when it fails ---- */

static jmp_buf way_out;

static int leave(const char *message) {
    cli_say("PLplot: %s", message);
    longjmp(way_out, 1);
}

static void open_page(const cli_figure_options *options, const cli_picture *picture,
                      const format *kind, const char *path) {
    double pixels = options->width, height = page_height(options, picture) * pixels / PAGE_PX;
    plsdev(kind->device);
    plsfnam(path);
    plscolbg(255, 255, 255);
    plspage(90.0 * pixels / PAGE_PX, 90.0 * pixels / PAGE_PX, (PLINT)lround(pixels),
            (PLINT)lround(height), 0, 0);
    plscol0(INK_BLACK, 25, 25, 25);
    plscol0(INK_GREY, 120, 120, 120);
    plfontld(1);
    plinit();
    /* Letters, marks and lines are of pixels, whatever the page's resolution says. */
    double zoom = pixels / PAGE_PX;
    plschr(3.9 * zoom, 1.0);
    plsmaj(0.0, 0.7 * zoom);
    plsmin(0.0, 0.7 * zoom);
    cli_figure_pen(1.0);
}

int cli_figure_write(const cli_figure_options *options, const cli_picture *picture) {
    const format *kind = format_of(options->output);
    bool special;
    char *const target = cli_system_write_target(options->output, &special);
    char *const part = target != NULL ? cli_part_name(target) : NULL;
    if (part == NULL) {
        cli_say("no memory for the figure");
        free(target);
        return CLI_MACHINE_FAILED;
    }
    FILE *probe = fopen(part, "wb"); /* PLplot asks for another name */
    if (probe == NULL) {
        cli_say_of_file("%s: cannot write: %s", options->output, strerror(errno));
        free(part);
        free(target);
        return CLI_MACHINE_FAILED;
    }
    fclose(probe);
    volatile bool drawn = false;
    plsexit(leave);
    if (setjmp(way_out) == 0) {
        open_page(options, picture, kind, part);
        drawn = draw_page(options, picture);
        plend();
    }
    int status = CLI_MACHINE_FAILED;
    bool whole = drawn && is_whole(part, kind);
    if (whole && kind->finish != NULL) {
        whole = kind->finish(part) && is_whole(part, kind);
    }
    if (!whole) {
        cli_say_of_file("%s: the figure could not be written", options->output);
        remove(part);
    } else {
        status = cli_part_rename(part, target);
    }
    free(part);
    free(target);
    return status;
}
