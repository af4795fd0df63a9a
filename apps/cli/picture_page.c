/* SPDX-License-Identifier: Apache-2.0 */
#include "picture_page.h"

#include "figure_scale.h"

#include <math.h>
#include <pango/pangocairo.h>
#include <stdio.h>
#include <string.h>

/* Of a page 1600 wide [px]. */
enum { TITLE = 26, WORDS = 17, EDGE = 16, TITLE_ROW = 54, CAPTION_ROW = 32, LEGEND_ROW = 30 };
enum { LEGEND_ROWS = 3, WORD_MIN_PX = 10 };

static const srp_render_colour INK = {0.10F, 0.10F, 0.10F}, PALE = {0.42F, 0.42F, 0.42F};
/* Of faces without sunlight, beside materials and beside values (shaders/render.frag.glsl). */
static const srp_render_colour DARK = {0.15F, 0.14F, 0.13F}, DARK_GREY = {0.36F, 0.36F, 0.36F};

/* Lines that the numbers below the legend take. */
static int number_rows(const cli_page *page) {
    return page->portrait->width / page->unit < 1000.0 ? 2 : 1;
}

static double footer_height(const cli_page *page) {
    return ((LEGEND_ROWS + number_rows(page)) * LEGEND_ROW + EDGE) * page->unit;
}

void cli_page_margins(const cli_page *page, double *across, double *along) {
    *across = 3.4 * WORDS * page->unit;
    *along = 1.9 * WORDS * page->unit;
}

void cli_page_lay_out(cli_page *page) {
    const cli_portrait *portrait = page->portrait;
    page->unit = fmin(portrait->width / 1600.0, portrait->height / 800.0);
    page->unit = fmax(page->unit, (double)WORD_MIN_PX / WORDS);
    double edge = EDGE * page->unit, top = (TITLE_ROW + CAPTION_ROW) * page->unit;
    double width = (portrait->width - 3.0 * edge) / CLI_PANELS;
    double height = portrait->height - top - footer_height(page);
    for (int k = 0; k < CLI_PANELS; ++k) {
        cli_panel_view *panel = &page->panel[k];
        panel->x = (int)(edge + k * (width + edge));
        panel->y = (int)top;
        panel->width = (int)fmax(width, 1.0);
        panel->height = (int)fmax(height, 1.0);
    }
}

/* ---- words ---- */

typedef struct words {
    const char *text;
    const char *brief;  /* in its place where there is no room for it in full; NULL: none */
    double x, y, width; /* the box: from x, about the middle y; longer text is cut there */
    double size;        /* [px] */
    PangoAlignment align;
    bool stands_out; /* bold, with a pale rim, on any ground */
    srp_render_colour colour;
} words;

/* Too long a text is made smaller before it is cut, down to this share. */
static const double SMALLEST = 0.72;

/* One line of `size` [px]; for g_object_unref(). */
static PangoLayout *line_of(cairo_t *to, const words *w, const char *text, double size) {
    PangoLayout *layout = pango_cairo_create_layout(to);
    PangoFontDescription *font = pango_font_description_from_string("DejaVu Sans, sans-serif");
    pango_font_description_set_absolute_size(font, size * PANGO_SCALE);
    pango_font_description_set_weight(font,
                                      w->stands_out ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
    pango_layout_set_font_description(layout, font);
    pango_font_description_free(font);
    pango_layout_set_single_paragraph_mode(layout, TRUE);
    pango_layout_set_text(layout, text, -1);
    return layout;
}

static void put(cairo_t *to, const words *w) {
    int width, height;
    const char *text = w->text;
    PangoLayout *layout = line_of(to, w, text, w->size);
    pango_layout_get_pixel_size(layout, &width, &height);
    if (width > w->width && w->width > 0.0 && w->brief != NULL) {
        g_object_unref(layout);
        text = w->brief;
        layout = line_of(to, w, text, w->size);
        pango_layout_get_pixel_size(layout, &width, &height);
    }
    if (width > w->width && w->width > 0.0) {
        g_object_unref(layout);
        layout = line_of(to, w, text, w->size * fmax(0.98 * w->width / width, SMALLEST));
    }
    if (w->width > 0.0) {
        pango_layout_set_width(layout, (int)(w->width * PANGO_SCALE));
        pango_layout_set_ellipsize(layout, PANGO_ELLIPSIZE_MIDDLE);
        pango_layout_set_alignment(layout, w->align);
    }
    pango_layout_get_pixel_size(layout, &width, &height);
    cairo_move_to(to, w->x, w->y - 0.5 * height);
    if (w->stands_out) {
        pango_cairo_layout_path(to, layout);
        cairo_set_source_rgba(to, 1.0, 1.0, 1.0, 0.85);
        cairo_set_line_width(to, 0.22 * w->size);
        cairo_set_line_join(to, CAIRO_LINE_JOIN_ROUND);
        cairo_stroke(to);
        cairo_move_to(to, w->x, w->y - 0.5 * height);
    }
    cairo_set_source_rgb(to, (double)w->colour.r, (double)w->colour.g, (double)w->colour.b);
    pango_cairo_show_layout(to, layout);
    g_object_unref(layout);
}

/* ---- over the panels ---- */

/* The word stands beyond the tip, or beside it where the arrow points at the eye. */
static void put_mark(const cli_page *page, const cli_panel_view *panel, const cli_mark *mark,
                     cairo_t *to) {
    double x0, y0, x1, y1, away = 0.9 * WORDS * page->unit;
    const srp_render_camera *camera = &panel->camera;
    if (!srp_render_project(camera, panel->width, panel->height, mark->from, &x0, &y0) ||
        !srp_render_project(camera, panel->width, panel->height, mark->to, &x1, &y1)) {
        return;
    }
    double dx = x1 - x0, dy = y1 - y0, length = hypot(dx, dy);
    bool beside = length < 2.0 * away;
    dx = beside ? 0.7 : dx / length;
    dy = beside ? -0.7 : dy / length;
    words w = {.text = mark->word, .size = WORDS * page->unit, .stands_out = true};
    w.width = 5.0 * WORDS * page->unit;
    w.align = PANGO_ALIGN_CENTER;
    double reach = away * (1.0 + 0.28 * (double)(strlen(mark->word) - 1) * fabs(dx));
    w.x = panel->x + x1 + dx * reach - 0.5 * w.width;
    w.y = panel->y + y1 + dy * away;
    w.colour = mark->colour;
    put(to, &w);
}

static void draw_panel(const cli_page *page, const cli_panel_view *panel, cairo_t *to) {
    words caption = {.text = panel->caption,
                     .brief = panel->brief,
                     .x = panel->x,
                     .y = panel->y - 0.5 * CAPTION_ROW * page->unit,
                     .width = panel->width,
                     .size = WORDS * page->unit,
                     .align = PANGO_ALIGN_CENTER,
                     .colour = PALE};
    put(to, &caption);
    cairo_save(to);
    cairo_rectangle(to, panel->x, panel->y, panel->width, panel->height);
    cairo_clip(to);
    for (size_t k = 0; k < panel->mark_count; ++k) {
        put_mark(page, panel, &panel->marks[k], to);
    }
    cairo_restore(to);
    cairo_set_source_rgb(to, 0.8, 0.8, 0.8);
    cairo_set_line_width(to, 1.0);
    cairo_rectangle(to, panel->x + 0.5, panel->y + 0.5, panel->width - 1, panel->height - 1);
    cairo_stroke(to);
}

/* ---- below them ---- */

static void put_swatch(const cli_page *page, cairo_t *to, double x, double y,
                       srp_render_colour colour) {
    double side = 0.9 * WORDS * page->unit;
    cairo_rectangle(to, x, y - 0.5 * side, side, side);
    cairo_set_source_rgb(to, (double)colour.r, (double)colour.g, (double)colour.b);
    cairo_fill_preserve(to);
    cairo_set_source_rgb(to, 0.3, 0.3, 0.3);
    cairo_set_line_width(to, 1.0);
    cairo_stroke(to);
}

/* What has no sunlight, in any picture. */
static void put_dark(const cli_page *page, cairo_t *to, double x, double y, const char *text,
                     srp_render_colour colour) {
    words w = {.text = text,
               .brief = "in the dark",
               .x = x + 1.5 * WORDS * page->unit,
               .y = y,
               .size = 0.9 * WORDS * page->unit,
               .colour = INK};
    w.width = page->portrait->width - w.x - EDGE * page->unit;
    put_swatch(page, to, x, y, colour);
    put(to, &w);
}

static void put_material(const cli_page *page, cairo_t *to, size_t k, words *w) {
    char text[320];
    const srp_scene *scene = page->portrait->scene;
    srp_optics optics = srp_scene_material_optics(scene, k);
    const char *name = srp_scene_material_name(scene, k);
    snprintf(text, sizeof text, "%.200s: ρs %.4g, ρd %.4g%s", name[0] != '\0' ? name : "(no name)",
             optics.rho_s, optics.rho_d, optics.one_sided ? ", one-sided" : "");
    w->text = text;
    put_swatch(page, to, w->x - 1.5 * WORDS * page->unit, w->y, srp_render_material_colour(k));
    put(to, w);
}

/* Materials in columns, as many as there is room for, and what is dark. */
static void draw_materials(const cli_page *page, cairo_t *to, double top) {
    const cli_portrait *portrait = page->portrait;
    size_t count = srp_scene_material_count(portrait->scene);
    size_t columns = (count + 1 + LEGEND_ROWS - 1) / LEGEND_ROWS;
    size_t most = (size_t)fmax(1.0, floor(portrait->width / (330.0 * page->unit)));
    columns = columns < most ? columns : most;
    double edge = EDGE * page->unit, width = (portrait->width - 2.0 * edge) / (double)columns;
    width = fmin(width, 460.0 * page->unit);
    size_t room = columns * LEGEND_ROWS;
    for (size_t k = 0; k < count + 1 && k < room; ++k) {
        char more[64];
        double x = edge + width * (double)(k / LEGEND_ROWS);
        double y = top + ((double)(k % LEGEND_ROWS) + 0.5) * LEGEND_ROW * page->unit;
        words w = {.text = more,
                   .x = x + 1.5 * WORDS * page->unit,
                   .y = y,
                   .width = width - 3.0 * WORDS * page->unit,
                   .size = 0.9 * WORDS * page->unit,
                   .colour = INK};
        if (k == count || k + 1 == room) {
            put_dark(page, to, x, y, "dark: no sunlight", DARK);
        } else if (k + 2 == room && count + 1 > room) {
            snprintf(more, sizeof more, "and %zu more materials", count - k);
            put(to, &w);
        } else {
            put_material(page, to, k, &w);
        }
    }
}

/* The colours of values as a bar with numbers, and what they are. */
static void draw_scale(const cli_page *page, cairo_t *to, double top) {
    const cli_portrait *portrait = page->portrait;
    double unit = page->unit, x = EDGE * unit, width = 0.45 * portrait->width;
    double y = top + 0.15 * LEGEND_ROW * unit, height = 0.7 * LEGEND_ROW * unit;
    for (int k = 0; k < CLI_PALETTE_SIZE; ++k) {
        const double *c = page->palette.rgb[k];
        cairo_set_source_rgb(to, c[0], c[1], c[2]);
        cairo_rectangle(to, x + width * k / CLI_PALETTE_SIZE, y, width / CLI_PALETTE_SIZE + 1.0,
                        height);
        cairo_fill(to);
    }
    double step = cli_figure_step(page->value_high, 5);
    cairo_set_source_rgb(to, 0.1, 0.1, 0.1);
    cairo_set_line_width(to, fmax(unit, 1.0));
    for (int k = 0; k * step <= page->value_high * (1.0 + 1e-9); ++k) {
        char number[32];
        double room = 100.0 * unit, middle = x + width * k * step / page->value_high;
        cairo_move_to(to, middle, y + height);
        cairo_line_to(to, middle, y + 1.2 * height);
        cairo_stroke(to);
        snprintf(number, sizeof number, "%.3g", k * step);
        words w = {.text = number,
                   .x = k == 0 ? x : middle - 0.5 * room,
                   .y = top + 1.45 * LEGEND_ROW * unit,
                   .width = room,
                   .size = 0.9 * WORDS * unit,
                   .align = k == 0 ? PANGO_ALIGN_LEFT : PANGO_ALIGN_CENTER,
                   .colour = INK};
        put(to, &w);
    }
    bool force = portrait->light == CLI_LIGHT_FORCE;
    words what = {.text = force ? "force of direct light on each square metre of the surface, in "
                                  "units of the radiation pressure"
                                : "cosine of the angle between the normal and the Sun",
                  .x = x,
                  .y = top + 2.4 * LEGEND_ROW * unit,
                  .width = portrait->width - 2.0 * x,
                  .size = 0.9 * WORDS * unit,
                  .colour = INK};
    put(to, &what);
    put_dark(page, to, x + width + 60.0 * unit, top + 0.5 * LEGEND_ROW * unit, "no sunlight",
             DARK_GREY);
}

static void draw_numbers(const cli_page *page, cairo_t *to, double y) {
    const cli_portrait *portrait = page->portrait;
    char text[2][CLI_PORTRAIT_WORDS], line[2 * CLI_PORTRAIT_WORDS + 2];
    cli_portrait_words(portrait, text);
    int rows = number_rows(page);
    if (rows == 1) {
        snprintf(line, sizeof line, "%s; %s", text[0], text[1]);
    }
    for (int k = 0; k < rows; ++k) {
        words w = {.text = rows == 1 ? line : text[k],
                   .x = EDGE * page->unit,
                   .y = y + k * LEGEND_ROW * page->unit,
                   .width = portrait->width - 2.0 * EDGE * page->unit,
                   .size = 0.95 * WORDS * page->unit,
                   .colour = INK};
        put(to, &w);
    }
}

void cli_page_draw(const cli_page *page, cairo_t *to) {
    const cli_portrait *portrait = page->portrait;
    double edge = EDGE * page->unit;
    words title = {.text = portrait->title,
                   .x = edge,
                   .y = 0.55 * TITLE_ROW * page->unit,
                   .width = portrait->width - 2.0 * edge,
                   .size = TITLE * page->unit,
                   .align = PANGO_ALIGN_CENTER,
                   .colour = INK};
    put(to, &title);
    for (int k = 0; k < CLI_PANELS; ++k) {
        draw_panel(page, &page->panel[k], to);
    }
    double top = portrait->height - footer_height(page) + 0.6 * edge;
    if (portrait->light == CLI_LIGHT_MATERIAL) {
        draw_materials(page, to, top);
    } else {
        draw_scale(page, to, top);
    }
    draw_numbers(page, to, top + (LEGEND_ROWS + 0.5) * LEGEND_ROW * page->unit);
}
