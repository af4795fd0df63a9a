/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Are two figures the same to the eye?
 *
 *     figure_compare reduce FIGURE.png SMALL.png     the mean of every 4 x 4 pixels
 *     figure_compare compare FIGURE.png SMALL.png    reduces FIGURE, and compares
 *     figure_compare lightness FIGURE.png X,Y        prints L* of the 4 x 4 pixels about X, Y
 *
 * Fonts and the smoothing of edges differ a little from one machine to the next; a surface of
 * another shape or colour differs over whole areas. Status 0 when they look the same, 1 when not, 2
 * when a file cannot be read or their sizes differ.
 */
#include "palette.h"

#include <math.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 4 };

/* Distances in L*a*b*, where 2.3 is just noticeable: of all pixels in the mean, and of the share of
 * pixels that may be farther apart than is seen at a glance. */
static const double MEAN_MAX = 0.8, GLANCE = 10.0, SHARE_MAX = 0.015;

typedef struct picture {
    size_t width, height;
    double *rgb; /* (height, width, 3) sRGB in [0, 1] */
} picture;

static picture read_png(const char *path) {
    picture out = {0, 0, NULL};
    png_image image;
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_file(&image, path)) {
        fprintf(stderr, "%s: %s\n", path, image.message);
        exit(2);
    }
    image.format = PNG_FORMAT_RGB;
    unsigned char *bytes = malloc(PNG_IMAGE_SIZE(image));
    const png_color white = {255, 255, 255};
    if (bytes == NULL || !png_image_finish_read(&image, &white, bytes, 0, NULL)) {
        fprintf(stderr, "%s: %s\n", path, image.message);
        exit(2);
    }
    out.width = image.width;
    out.height = image.height;
    out.rgb = malloc(3 * out.width * out.height * sizeof *out.rgb);
    for (size_t k = 0; out.rgb != NULL && k < 3 * out.width * out.height; ++k) {
        out.rgb[k] = bytes[k] / 255.0;
    }
    free(bytes);
    if (out.rgb == NULL) {
        exit(2);
    }
    return out;
}

static picture reduce(const picture *from) {
    picture out = {from->width / BLOCK, from->height / BLOCK, NULL};
    out.rgb = calloc(3 * out.width * out.height, sizeof *out.rgb);
    if (out.rgb == NULL) {
        exit(2);
    }
    for (size_t y = 0; y < BLOCK * out.height; ++y) {
        for (size_t x = 0; x < BLOCK * out.width; ++x) {
            for (size_t c = 0; c < 3; ++c) {
                out.rgb[3 * (y / BLOCK * out.width + x / BLOCK) + c] +=
                    from->rgb[3 * (y * from->width + x) + c] / (BLOCK * BLOCK);
            }
        }
    }
    return out;
}

static int write_png(const picture *p, const char *path) {
    png_image image;
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.format = PNG_FORMAT_RGB;
    image.width = (png_uint_32)p->width;
    image.height = (png_uint_32)p->height;
    unsigned char *bytes = malloc(3 * p->width * p->height);
    if (bytes == NULL) {
        return 2;
    }
    for (size_t k = 0; k < 3 * p->width * p->height; ++k) {
        bytes[k] = (unsigned char)lround(255.0 * p->rgb[k]);
    }
    int status = png_image_write_to_file(&image, path, 0, bytes, 0, NULL) ? 0 : 2;
    free(bytes);
    return status;
}

static int compare(const picture *a, const picture *b) {
    if (a->width != b->width || a->height != b->height) {
        printf("%zu x %zu pixels, expected %zu x %zu\n", a->width, a->height, b->width, b->height);
        return 2;
    }
    double sum = 0.0, most = 0.0;
    size_t count = a->width * a->height, far = 0;
    for (size_t k = 0; k < count; ++k) {
        double p[3], q[3], square = 0.0;
        cli_lab_of_srgb(&a->rgb[3 * k], p);
        cli_lab_of_srgb(&b->rgb[3 * k], q);
        for (int c = 0; c < 3; ++c) {
            square += (p[c] - q[c]) * (p[c] - q[c]);
        }
        sum += sqrt(square);
        most = fmax(most, sqrt(square));
        far += sqrt(square) > GLANCE;
    }
    double mean = sum / (double)count, share = (double)far / (double)count;
    printf("mean distance %.3f, largest %.1f, %.2f %% of the pixels beyond %g\n", mean, most,
           100.0 * share, GLANCE);
    return mean <= MEAN_MAX && share <= SHARE_MAX ? 0 : 1;
}

static int print_lightness(const picture *small, const char *at) {
    size_t x, y;
    double lab[3];
    if (sscanf(at, "%zu,%zu", &x, &y) != 2 || x / BLOCK >= small->width ||
        y / BLOCK >= small->height) {
        fprintf(stderr, "%s: no such pixel\n", at);
        return 2;
    }
    cli_lab_of_srgb(&small->rgb[3 * (y / BLOCK * small->width + x / BLOCK)], lab);
    printf("%.1f\n", lab[0]);
    return 0;
}

int main(int argc, char **argv) {
    if (argc != 4) {
        fprintf(stderr,
                "usage: figure_compare reduce|compare|lightness FIGURE.png SMALL.png|X,Y\n");
        return 2;
    }
    picture figure = read_png(argv[2]), small = reduce(&figure);
    int status;
    if (strcmp(argv[1], "reduce") == 0) {
        status = write_png(&small, argv[3]);
    } else if (strcmp(argv[1], "lightness") == 0) {
        status = print_lightness(&small, argv[3]);
    } else {
        picture golden = read_png(argv[3]);
        status = compare(&small, &golden);
        free(golden.rgb);
    }
    free(figure.rgb);
    free(small.rgb);
    return status;
}
