/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Looks at a part of a PNG file:
 *     picture_check FILE WIDTH HEIGHT X Y W H COLOURS SHARE
 * The picture is WIDTH x HEIGHT, and the W x H pixels from (X, Y) on have at least COLOURS
 * different colours (of 4096), none of which covers more than SHARE of them. Status 1 and words
 * otherwise.
 */
#include <png.h>
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

int main(int argc, char **argv) {
    png_image image;
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    if (argc != 10 || !png_image_begin_read_from_file(&image, argv[1])) {
        printf("%s: cannot be read\n", argc > 1 ? argv[1] : "no file");
        return 1;
    }
    image.format = PNG_FORMAT_RGB;
    unsigned char *pixels = malloc(PNG_IMAGE_SIZE(image));
    if (pixels == NULL || !png_image_finish_read(&image, NULL, pixels, 0, NULL)) {
        printf("%s: cannot be read\n", argv[1]);
        free(pixels);
        return 1;
    }
    int status = look(pixels, &image, argv);
    free(pixels);
    return status;
}
