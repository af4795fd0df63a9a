/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Looks at a part of a PNG file:
 *     picture_check FILE WIDTH HEIGHT X Y W H COLOURS SHARE
 * The picture is WIDTH x HEIGHT, and the W x H pixels from (X, Y) on have at least COLOURS
 * different colours (of 4096), none of which covers more than SHARE of them. Or compares a part of
 * two of one size:
 *     picture_check differ FILE OTHER X Y W H LEAST MOST
 * The smallest square around all pixels that differ has sides from LEAST to MOST, 0 if none do.
 * Status 1 and words otherwise.
 */
#include <png.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COLOURS = 4096 };

static int look(const unsigned char *pixels, const png_image *image, char **argv) {
    static unsigned counts[COLOURS];
    unsigned x = (unsigned)atoi(argv[4]), y = (unsigned)atoi(argv[5]);
    unsigned w = (unsigned)atoi(argv[6]), h = (unsigned)atoi(argv[7]), kinds = 0, most = 0;
    if (image->width != (unsigned)atoi(argv[2]) || image->height != (unsigned)atoi(argv[3])) {
        printf("%s: %u x %u pixels, expected %s x %s\n", argv[1], image->width, image->height,
               argv[2], argv[3]);
        return 1;
    }
    for (unsigned j = y; j < y + h && j < image->height; ++j) {
        for (unsigned i = x; i < x + w && i < image->width; ++i) {
            const unsigned char *p = &pixels[3 * ((size_t)j * image->width + i)];
            ++counts[(unsigned)(p[0] >> 4) << 8 | (unsigned)(p[1] >> 4) << 4 |
                     (unsigned)(p[2] >> 4)];
        }
    }
    for (unsigned k = 0; k < COLOURS; ++k) {
        kinds += counts[k] > 0;
        most = counts[k] > most ? counts[k] : most;
    }
    double share = (double)most / ((double)w * h);
    printf("%s: %u colours, one on %.1f %%\n", argv[1], kinds, 100.0 * share);
    return kinds >= (unsigned)atoi(argv[8]) && share <= strtod(argv[9], NULL) ? 0 : 1;
}

static unsigned larger(unsigned a, unsigned b) {
    return a > b ? a : b;
}

static int compare(const unsigned char *pixels, const unsigned char *others, const png_image *image,
                   char **argv) {
    unsigned x = (unsigned)atoi(argv[4]), y = (unsigned)atoi(argv[5]);
    unsigned w = (unsigned)atoi(argv[6]), h = (unsigned)atoi(argv[7]);
    unsigned left = x + w, right = x, top = y + h, bottom = y, side = 0;
    for (unsigned j = y; j < y + h && j < image->height; ++j) {
        for (unsigned i = x; i < x + w && i < image->width; ++i) {
            size_t at = 3 * ((size_t)j * image->width + i);
            if (memcmp(&pixels[at], &others[at], 3) != 0) {
                left = i < left ? i : left;
                right = larger(right, i + 1);
                top = j < top ? j : top;
                bottom = larger(bottom, j + 1);
                side = larger(right - left, bottom - top);
            }
        }
    }
    printf("%s, %s: differ in a square of %u pixels\n", argv[2], argv[3], side);
    return side >= (unsigned)atoi(argv[8]) && side <= (unsigned)atoi(argv[9]) ? 0 : 1;
}

/* Three bytes a pixel, freed by free(); NULL, said, if it cannot be read. */
static unsigned char *read_picture(const char *path, png_image *image) {
    unsigned char *pixels = NULL;
    memset(image, 0, sizeof *image);
    image->version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(image, path)) {
        image->format = PNG_FORMAT_RGB;
        pixels = malloc(PNG_IMAGE_SIZE(*image));
        if (pixels != NULL && png_image_finish_read(image, NULL, pixels, 0, NULL)) {
            return pixels;
        }
    }
    printf("%s: cannot be read\n", path);
    free(pixels);
    return NULL;
}

int main(int argc, char **argv) {
    png_image image, other;
    if (argc != 10) {
        printf("expected 9 arguments\n");
        return 1;
    }
    bool differ = strcmp(argv[1], "differ") == 0;
    unsigned char *pixels = read_picture(differ ? argv[2] : argv[1], &image), *others = NULL;
    int status = 1;
    if (pixels != NULL && !differ) {
        status = look(pixels, &image, argv);
    } else if (pixels != NULL && (others = read_picture(argv[3], &other)) != NULL) {
        status = image.width == other.width && image.height == other.height
                     ? compare(pixels, others, &image, argv)
                     : 1;
    }
    free(others);
    free(pixels);
    return status;
}
