/* SPDX-License-Identifier: Apache-2.0 */
/* A picture from views to file. */
#include "picture.h"

#include "figure_scale.h"
#include "messages.h"
#include "numbers.h"
#include "picture_page.h"
#include "text_file.h"

#include <srp/const.h>
#include <srp/table.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const srp_render_colour FORCE_COLOUR = {0.78F, 0.05F, 0.50F};
static const srp_render_colour SUN_COLOUR = {0.95F, 0.72F, 0.05F}, SUN_WORD = {0.62F, 0.45F, 0.0F};

int cli_portrait_check(void) {
    return CLI_DONE;
}

/* ---- arrows ---- */

/* Arrows end this share of the scene's size outside of it. */
static const double BEYOND = 0.22;

/* Where arrows begin, and how large the scene is about it. */
typedef struct anchor {
    srp_vec3 at; /* [m] */
    double size; /* [m] */
} anchor;

/* The origin of the body, or the middle of a scene that is far from it. */
static anchor find_anchor(const srp_scene *scene) {
    static const double FAR = 4.0; /* in units of half the diagonal of the scene's box */
    double low[3], high[3];
    for (int k = 0; k < 3; ++k) {
        srp_vec3 axis = {k == 0, k == 1, k == 2};
        high[k] = srp_render_reach(scene, axis);
        low[k] = -srp_render_reach(scene, srp_vec3_scale(-1.0, axis));
    }
    srp_vec3 sum = {low[0] + high[0], low[1] + high[1], low[2] + high[2]};
    srp_vec3 diagonal = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
    anchor out = {{0.0, 0.0, 0.0}, 0.5 * srp_vec3_norm(diagonal)};
    if (0.5 * srp_vec3_norm(sum) > FAR * out.size) {
        out.at = srp_vec3_scale(0.5, sum);
    } else {
        out.size = fmin(out.size, srp_scene_radius(scene));
    }
    return out;
}

static double reach_from(const srp_scene *scene, srp_vec3 at, srp_vec3 direction) {
    return fmax(srp_render_reach(scene, direction) - srp_vec3_dot(at, direction), 0.0);
}

static void add_mark(cli_panel_view *panel, srp_render_arrow *arrows, const cli_mark *mark,
                     srp_render_colour word) {
    arrows[panel->mark_count] =
        (srp_render_arrow){.from = mark->from, .to = mark->to, .colour = mark->colour};
    panel->marks[panel->mark_count] = *mark;
    panel->marks[panel->mark_count++].colour = word;
}

static void add_from_anchor(cli_panel_view *panel, srp_render_arrow *arrows, const char *word,
                            const anchor *from, srp_vec3 direction, double length,
                            srp_render_colour colour) {
    cli_mark mark = {word, from->at, srp_vec3_add_scaled(from->at, length, direction), colour};
    add_mark(panel, arrows, &mark, colour);
}

/* Axes and force, and at the side where the light comes from. */
static void add_marks(const cli_portrait *portrait, cli_panel_view *panel, srp_vec3 sun,
                      bool with_sun, srp_render_arrow *arrows) {
    static const char *const NAMES[3] = {"x", "y", "z"};
    const srp_scene *scene = portrait->scene;
    anchor from = find_anchor(scene);
    double more = BEYOND * from.size;
    for (int k = 0; k < 3; ++k) {
        srp_vec3 axis = {k == 0, k == 1, k == 2};
        add_from_anchor(panel, arrows, NAMES[k], &from, axis,
                        reach_from(scene, from.at, axis) + more, srp_render_axis_colour(k));
    }
    double size = srp_vec3_norm(portrait->response.f);
    if (size > 0.0) {
        srp_vec3 along = srp_vec3_scale(1.0 / size, portrait->response.f);
        add_from_anchor(panel, arrows, "f", &from, along,
                        reach_from(scene, from.at, along) + 1.6 * more, FORCE_COLOUR);
    }
    if (with_sun) {
        /* Beyond the tip of an axis that it would cover. */
        bool on_axis = fmax(fmax(sun.x, sun.y), sun.z) > 0.99;
        double tip = reach_from(scene, from.at, sun) + (on_axis ? 1.9 : 0.3) * more;
        cli_mark mark = {"Sun", srp_vec3_add_scaled(from.at, tip + 1.5 * more, sun),
                         srp_vec3_add_scaled(from.at, tip, sun), SUN_COLOUR};
        add_mark(panel, arrows, &mark, SUN_WORD);
        /* The word stands at the tail. */
        cli_mark *last = &panel->marks[panel->mark_count - 1];
        last->to = mark.from;
        last->from = mark.to;
    }
}

/* ---- cameras ---- */

/* A camera that shows the scene and all arrows of the panel. */
static srp_render_camera frame(const cli_page *page, const cli_panel_view *panel,
                               const double view[2]) {
    const srp_scene *scene = page->portrait->scene;
    double aspect = (double)panel->width / panel->height;
    srp_vec3 right, up, eye;
    srp_render_camera camera =
        srp_render_camera_fit(scene, view[0] * SRP_RAD_PER_DEG, view[1] * SRP_RAD_PER_DEG, aspect);
    srp_render_camera_axes(&camera, &right, &up, &eye);
    srp_vec3 left = srp_vec3_scale(-1.0, right), down = srp_vec3_scale(-1.0, up);
    double box[4] = {-srp_render_reach(scene, left), srp_render_reach(scene, right),
                     -srp_render_reach(scene, down), srp_render_reach(scene, up)};
    for (size_t k = 0; k < panel->mark_count; ++k) {
        double x = srp_vec3_dot(panel->marks[k].to, right);
        double y = srp_vec3_dot(panel->marks[k].to, up);
        box[0] = fmin(box[0], x);
        box[1] = fmax(box[1], x);
        box[2] = fmin(box[2], y);
        box[3] = fmax(box[3], y);
    }
    srp_vec3 middle = srp_vec3_add(srp_vec3_scale(0.5 * (box[0] + box[1]), right),
                                   srp_vec3_scale(0.5 * (box[2] + box[3]), up));
    camera.target = srp_vec3_add_scaled(middle, srp_vec3_dot(camera.target, eye), eye);
    double across, along;
    cli_page_margins(page, &across, &along);
    across = fmin(2.0 * across / panel->width, 0.5);
    along = fmin(2.0 * along / panel->height, 0.5);
    camera.half_height =
        0.5 * fmax((box[3] - box[2]) / (1.0 - along), (box[1] - box[0]) / aspect / (1.0 - across));
    return camera;
}

/* ---- values ---- */

/* The largest value, rounded up to a mark of the scale. */
static int find_range(const cli_portrait *portrait, srp_vec3 sun, double *high) {
    size_t count = srp_scene_facet_count(portrait->scene);
    *high = 1.0;
    if (portrait->light != CLI_LIGHT_FORCE) {
        return CLI_DONE;
    }
    double *value = malloc(count * sizeof *value), most = 0.0;
    if (value == NULL) {
        cli_say("no memory for the values of %zu facets", count);
        return CLI_MACHINE_FAILED;
    }
    srp_render_values(portrait->scene, sun, SRP_RENDER_FORCE, value);
    for (size_t k = 0; k < count; ++k) {
        most = fmax(most, value[k]);
    }
    free(value);
    most = fmax(most, 0.01);
    double step = cli_figure_step(most, 5);
    *high = step * ceil(most / step - 1e-9);
    return CLI_DONE;
}

/* ---- panels ---- */

/* Panels up to so many pixels are drawn twice as large, and made smaller: finer lines. */
static const double FINE_MAX = 3e6;

typedef struct studio {
    cli_page page;
    srp_render_view view[CLI_PANELS];
    srp_render_arrow arrows[CLI_PANELS][CLI_MARKS_MAX];
    srp_render_colour map[CLI_PALETTE_SIZE];
    uint8_t *pixels[CLI_PANELS];
    int fine; /* pixels drawn for one of the page, each way */
} studio;

static int set_up(const cli_portrait *portrait, studio *s) {
    static const srp_render_colouring COLOURING[] = {SRP_RENDER_MATERIAL, SRP_RENDER_INCIDENCE,
                                                     SRP_RENDER_FORCE};
    cli_page *page = &s->page;
    srp_vec3 sun = srp_direction_from_deg(portrait->sun[0], portrait->sun[1]);
    page->portrait = portrait;
    cli_page_lay_out(page);
    char number[2][CLI_NUMBER_SIZE];
    cli_write_number(portrait->side[0], number[0]);
    cli_write_number(portrait->side[1], number[1]);
    snprintf(page->panel[0].caption, sizeof page->panel[0].caption, "as the Sun sees it");
    snprintf(page->panel[0].brief, sizeof page->panel[0].brief, "from the Sun");
    snprintf(page->panel[1].caption, sizeof page->panel[1].caption,
             "from azimuth %s°, elevation %s°", number[0], number[1]);
    snprintf(page->panel[1].brief, sizeof page->panel[1].brief, "from az %s°, el %s°", number[0],
             number[1]);
    cli_palette_sequential(&page->palette);
    for (int k = 0; k < CLI_PALETTE_SIZE; ++k) {
        const double *c = page->palette.rgb[k];
        s->map[k] = (srp_render_colour){(float)c[0], (float)c[1], (float)c[2]};
    }
    double area = (double)page->panel[0].width * page->panel[0].height;
    s->fine = area <= FINE_MAX ? 2 : 1;
    for (int k = 0; k < CLI_PANELS; ++k) {
        cli_panel_view *panel = &page->panel[k];
        srp_render_view *view = &s->view[k];
        add_marks(portrait, panel, sun, k == 1, s->arrows[k]);
        panel->camera = frame(page, panel, k == 0 ? portrait->sun : portrait->side);
        *view = srp_render_view_default();
        view->width = s->fine * panel->width;
        view->height = s->fine * panel->height;
        view->camera = panel->camera;
        view->sun = sun;
        view->colouring = COLOURING[portrait->light];
        view->map = s->map;
        view->map_count = CLI_PALETTE_SIZE;
        view->background = (srp_render_colour){0.97F, 0.97F, 0.98F};
        for (size_t j = 0; j < panel->mark_count; ++j) {
            /* The force covers an axis that it lies on. */
            double width = fmax(fmin(view->height, view->width) / 200.0, 1.0);
            bool is_force = strcmp(panel->marks[j].word, "f") == 0;
            s->arrows[k][j].width = (is_force ? 1.4 : 1.0) * width;
        }
        view->arrows = s->arrows[k];
        view->arrow_count = panel->mark_count;
    }
    int status = find_range(portrait, sun, &page->value_high);
    s->view[0].value_high = s->view[1].value_high = page->value_high;
    return status;
}

/* On the device that was asked for, or the first that is there. */
static int render(const cli_portrait *portrait, studio *s) {
    static const char *const ANY[] = {"gl:osmesa", "gl:egl"};
    srp_error error, second;
    for (int k = 0; k < CLI_PANELS; ++k) {
        s->pixels[k] = malloc(4 * (size_t)s->view[k].width * (size_t)s->view[k].height);
        if (s->pixels[k] == NULL) {
            cli_say("no memory for %d x %d pixels", s->view[k].width, s->view[k].height);
            return CLI_MACHINE_FAILED;
        }
    }
    const char *device = portrait->device != NULL ? portrait->device : ANY[0];
    srp_status status =
        srp_render_offscreen(device, portrait->scene, s->view, CLI_PANELS, s->pixels, &error);
    if (status == SRP_NO_DEVICE && portrait->device == NULL) {
        status =
            srp_render_offscreen(ANY[1], portrait->scene, s->view, CLI_PANELS, s->pixels, &second);
        if (status == SRP_NO_DEVICE) {
            cli_say("%s: %s", ANY[0], error.message);
            cli_say("%s: %s", ANY[1], second.message);
            return CLI_MACHINE_FAILED;
        }
        error = second;
    }
    if (status == SRP_NOT_FOUND) {
        return cli_usage_error(
            "--device %s: expected gl:osmesa, gl:egl or gl:egl:N, N from 0 to 15", device);
    }
    return status == SRP_OK ? CLI_DONE : cli_input_error(&error);
}

/* ---- the page ---- */

/* Means of fine x fine pixels, as cairo has them: 32 bits, red above green above blue. */
static void put_panel(const studio *s, int k, cairo_surface_t *surface) {
    const cli_panel_view *panel = &s->page.panel[k];
    unsigned char *data = cairo_image_surface_get_data(surface);
    int stride = cairo_image_surface_get_stride(surface), fine = s->fine;
    for (int y = 0; y < panel->height; ++y) {
        uint32_t *row = (uint32_t *)(void *)(data + (size_t)stride * (size_t)(panel->y + y));
        for (int x = 0; x < panel->width; ++x) {
            uint32_t sum[3] = {0, 0, 0};
            for (int j = 0; j < fine * fine; ++j) {
                size_t from = (size_t)(fine * y + j / fine) * (size_t)s->view[k].width +
                              (size_t)(fine * x + j % fine);
                for (int c = 0; c < 3; ++c) {
                    sum[c] += s->pixels[k][4 * from + (size_t)c];
                }
            }
            uint32_t count = (uint32_t)(fine * fine), half = count / 2;
            row[panel->x + x] = ((sum[0] + half) / count) << 16 | ((sum[1] + half) / count) << 8 |
                                (sum[2] + half) / count;
        }
    }
}

static cairo_status_t write_bytes(void *file, const unsigned char *bytes, unsigned count) {
    return fwrite(bytes, 1, count, file) == count ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

static int save(cairo_surface_t *surface, const char *path) {
    cli_text_file file;
    int status = cli_text_file_begin(&file, path);
    if (status == CLI_DONE) {
        cairo_status_t written = cairo_surface_write_to_png_stream(surface, write_bytes, file.out);
        if (written != CAIRO_STATUS_SUCCESS && written != CAIRO_STATUS_WRITE_ERROR) {
            cli_say("cairo: %s", cairo_status_to_string(written));
            cli_text_file_drop(&file);
            return CLI_MACHINE_FAILED;
        }
        status = cli_text_file_end(&file); /* says why it could not be written */
    }
    return status;
}

static int compose(const studio *s, const char *path) {
    const cli_portrait *portrait = s->page.portrait;
    cairo_surface_t *surface =
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)portrait->width, (int)portrait->height);
    cairo_t *to = cairo_create(surface);
    int status = CLI_MACHINE_FAILED;
    cairo_set_source_rgb(to, 1.0, 1.0, 1.0);
    cairo_paint(to);
    cairo_surface_flush(surface);
    if (cairo_status(to) == CAIRO_STATUS_SUCCESS) {
        put_panel(s, 0, surface);
        put_panel(s, 1, surface);
        cairo_surface_mark_dirty(surface);
        cli_page_draw(&s->page, to);
    }
    if (cairo_status(to) != CAIRO_STATUS_SUCCESS) {
        cli_say("cairo: %s", cairo_status_to_string(cairo_status(to)));
    } else {
        status = save(surface, path);
    }
    cairo_destroy(to);
    cairo_surface_destroy(surface);
    return status;
}

int cli_portrait_write(const cli_portrait *portrait, const char *path) {
    studio *s = calloc(1, sizeof *s);
    if (s == NULL) {
        cli_say("no memory for the picture");
        return CLI_MACHINE_FAILED;
    }
    int status = set_up(portrait, s);
    if (status == CLI_DONE) {
        status = render(portrait, s);
    }
    if (status == CLI_DONE) {
        status = compose(s, path);
    }
    for (int k = 0; k < CLI_PANELS; ++k) {
        free(s->pixels[k]);
    }
    free(s);
    return status;
}
