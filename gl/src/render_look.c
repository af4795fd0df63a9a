/* SPDX-License-Identifier: Apache-2.0 */
/* Views and colours. */
#include "error.h"
#include "render_internal.h"

#include <math.h>
#include <string.h>

static const srp_render_colour UNKNOWN = {0.62F, 0.62F, 0.62F}; /* a value that is NAN */

srp_render_view srp_render_view_default(void) {
    srp_render_view view = {
        .samples = 4,
        .camera = {.half_height = 1.0},
        .sun = {1.0, 0.0, 0.0},
        .shadows = true,
        .edges = true,
        .value_high = 1.0,
        .background = {1.0F, 1.0F, 1.0F},
    };
    return view;
}

srp_render_colour srp_render_material_colour(size_t index) {
    /* After M. Okabe and K. Ito, Color Universal Design (2008), and P. Tol's muted scheme (2021).
     */
    static const srp_render_colour COLOURS[10] = {
        {0.90F, 0.62F, 0.00F}, {0.34F, 0.71F, 0.91F}, {0.72F, 0.72F, 0.72F}, {0.00F, 0.62F, 0.45F},
        {0.80F, 0.47F, 0.65F}, {0.00F, 0.45F, 0.70F}, {0.84F, 0.37F, 0.00F}, {0.60F, 0.60F, 0.20F},
        {0.53F, 0.13F, 0.33F}, {0.94F, 0.89F, 0.26F}};
    return COLOURS[index % 10];
}

/* Of direct light on a facet of the normal n that the Sun sees at the cosine c: the force per lit
 * area A and pressure, AAS 20-481, Eq. 2 with s to the Sun. */
static double force_per_area(srp_optics optics, srp_vec3 n, srp_vec3 s, double c) {
    srp_vec3 f = srp_vec3_scale(1.0 - optics.rho_s, s);
    double along = 2.0 * (optics.rho_s * c + optics.rho_d / 3.0);
    return c * srp_vec3_norm(srp_vec3_add_scaled(f, along, n));
}

static double value_of(const srp_scene *scene, const srp_facet *facet, srp_vec3 sun,
                       srp_render_colouring colouring) {
    srp_vec3 n = facet->normal;
    double c = srp_vec3_dot(n, sun);
    srp_optics optics = scene->optics[facet->material];
    if (c < 0.0) {
        if (facet->closed) {
            return 0.0;
        }
        optics = optics.one_sided ? (srp_optics){0.0, 0.0, true} : optics;
        n = srp_vec3_scale(-1.0, n);
        c = -c;
    }
    return colouring == SRP_RENDER_FORCE ? force_per_area(optics, n, sun, c) : c;
}

void srp_render_values(const srp_scene *scene, srp_vec3 sun, srp_render_colouring colouring,
                       double *values) {
    for (size_t i = 0; i < scene->facet_count; ++i) {
        values[i] = value_of(scene, &scene->facets[i], sun, colouring);
    }
}

static srp_render_colour colour_of_value(const srp_render_view *view, double value) {
    if (isnan(value)) {
        return UNKNOWN;
    }
    double share = (value - view->value_low) / (view->value_high - view->value_low);
    double place = fmin(fmax(share, 0.0), 1.0) * (double)(view->map_count - 1);
    size_t below = (size_t)place;
    size_t above = below + 1 < view->map_count ? below + 1 : below;
    float t = (float)(place - (double)below);
    srp_render_colour a = view->map[below], b = view->map[above];
    return (srp_render_colour){a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

static srp_render_colour colour_of(const srp_scene *scene, const srp_render_view *view, size_t i) {
    const srp_facet *facet = &scene->facets[i];
    switch (view->colouring) {
    case SRP_RENDER_VALUES:
        return colour_of_value(view, view->values[i]);
    case SRP_RENDER_INCIDENCE:
    case SRP_RENDER_FORCE:
        return colour_of_value(view, value_of(scene, facet, view->sun, view->colouring));
    default:
        return view->material_colours != NULL ? view->material_colours[facet->material]
                                              : srp_render_material_colour(facet->material);
    }
}

void srp_render_send_colours(srp_renderer *renderer, const srp_render_view *view) {
    const srp_gl_functions *gl = &renderer->context.gl;
    const srp_scene *scene = renderer->scene;
    /* Most pictures differ from the last in the camera alone. */
    bool plain = view->colouring == SRP_RENDER_MATERIAL && view->material_colours == NULL;
    if (plain && renderer->paint_known) {
        return;
    }
    bool changed = false;
    renderer->paint_known = plain;
    for (size_t i = 0; i < scene->facet_count; ++i) {
        uint32_t paint = srp_render_paint(colour_of(scene, view, i));
        const uint8_t now[4] = {(uint8_t)(paint >> 16), (uint8_t)(paint >> 8), (uint8_t)paint, 255};
        changed = changed || memcmp(&renderer->paint[4 * i], now, sizeof now) != 0;
        memcpy(&renderer->paint[4 * i], now, sizeof now);
    }
    if (!changed) {
        return;
    }
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, SRP_RENDER_ROW,
                   (GLsizei)((scene->facet_count + SRP_RENDER_ROW - 1) / SRP_RENDER_ROW), 0,
                   GL_RGBA, GL_UNSIGNED_BYTE, renderer->paint);
}

static bool is_camera(const srp_render_camera *camera) {
    return isfinite(camera->az) && fabs(camera->el) <= 1.5707963267948968 &&
           isfinite(camera->roll) && srp_vec3_is_finite(camera->target) &&
           camera->half_height > 0.0 && isfinite(camera->half_height) && camera->field >= 0.0 &&
           camera->field <= 2.8;
}

static bool are_arrows(const srp_render_view *view) {
    for (size_t k = 0; k < view->arrow_count; ++k) {
        const srp_render_arrow *arrow = &view->arrows[k];
        if (!srp_vec3_is_finite(arrow->from) || !srp_vec3_is_finite(arrow->to) ||
            !(arrow->width >= 0.0) || !isfinite(arrow->width)) {
            return false;
        }
    }
    return true;
}

srp_status srp_render_check(const srp_renderer *renderer, const srp_render_view *view,
                            srp_error *error) {
    const char *wrong = NULL;
    GLint most = renderer->context.side_max;
    bool valued = view->colouring != SRP_RENDER_MATERIAL;
    if (view->width < 1 || view->height < 1 || view->width > most || view->height > most) {
        return srp_fail(error, SRP_BAD_ARGUMENT,
                        "a picture of %d x %d pixels, expected 1 to %d each way", view->width,
                        view->height, (int)most);
    }
    if (!is_camera(&view->camera)) {
        wrong = "the camera";
    } else if (!(fabs(srp_vec3_norm(view->sun) - 1.0) <= 1e-9)) {
        wrong = "the direction of the Sun (unit vector)";
    } else if ((unsigned)view->colouring > SRP_RENDER_VALUES) {
        wrong = "the colouring";
    } else if (valued && (view->map == NULL || view->map_count < 1)) {
        wrong = "the map of colours";
    } else if (valued && !(view->value_low < view->value_high && isfinite(view->value_low) &&
                           isfinite(view->value_high))) {
        wrong = "the range of values";
    } else if (view->colouring == SRP_RENDER_VALUES && view->values == NULL) {
        wrong = "the values of facets";
    } else if (!(view->axes >= 0.0 && view->sun_line >= 0.0 && isfinite(view->axes) &&
                 isfinite(view->sun_line))) {
        wrong = "the length of axes or of the Sun's line";
    } else if (!are_arrows(view)) {
        wrong = "an arrow";
    }
    return wrong == NULL
               ? SRP_OK
               : srp_fail(error, SRP_BAD_ARGUMENT, "%s of the view is out of its range", wrong);
}
