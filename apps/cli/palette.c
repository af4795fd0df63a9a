/* SPDX-License-Identifier: Apache-2.0 */
#include "palette.h"

#include <math.h>
#include <stddef.h>

/* ---- colour spaces (IEC 61966-2-1; CIE 15, white point D65) ---- */

static const double WHITE[3] = {0.95047, 1.0, 1.08883};
static const double XYZ_OF_RGB[3][3] = {{0.4124564, 0.3575761, 0.1804375},
                                        {0.2126729, 0.7151522, 0.0721750},
                                        {0.0193339, 0.1191920, 0.9503041}};
static const double RGB_OF_XYZ[3][3] = {{3.2404542, -1.5371385, -0.4985314},
                                        {-0.9692660, 1.8760108, 0.0415560},
                                        {0.0556434, -0.2040259, 1.0572252}};

static double linear_of(double c) {
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static double companded(double c) {
    c = fmin(fmax(c, 0.0), 1.0);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1.0 / 2.4) - 0.055;
}

static double lab_function(double t) {
    const double d = 6.0 / 29.0;
    return t > d * d * d ? cbrt(t) : t / (3.0 * d * d) + 4.0 / 29.0;
}

static double lab_inverse(double t) {
    const double d = 6.0 / 29.0;
    return t > d ? t * t * t : 3.0 * d * d * (t - 4.0 / 29.0);
}

void cli_lab_of_srgb(const double rgb[3], double lab[3]) {
    double f[3];
    for (int i = 0; i < 3; ++i) {
        double sum = 0.0;
        for (int j = 0; j < 3; ++j) {
            sum += XYZ_OF_RGB[i][j] * linear_of(rgb[j]);
        }
        f[i] = lab_function(sum / WHITE[i]);
    }
    lab[0] = 116.0 * f[1] - 16.0;
    lab[1] = 500.0 * (f[0] - f[1]);
    lab[2] = 200.0 * (f[1] - f[2]);
}

void cli_srgb_of_lab(const double lab[3], double rgb[3]) {
    double f = (lab[0] + 16.0) / 116.0;
    const double xyz[3] = {WHITE[0] * lab_inverse(f + lab[1] / 500.0), WHITE[1] * lab_inverse(f),
                           WHITE[2] * lab_inverse(f - lab[2] / 200.0)};
    for (int i = 0; i < 3; ++i) {
        double sum = 0.0;
        for (int j = 0; j < 3; ++j) {
            sum += RGB_OF_XYZ[i][j] * xyz[j];
        }
        rgb[i] = companded(sum);
    }
}

/* ---- palettes ---- */

typedef unsigned char colour[3];

enum { ANCHORS_MAX = 32 };

static double distance(const double a[3], const double b[3]) {
    double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

/* Colours first to last of `out`, evenly spaced in L*a*b* along the line through the anchors. */
static void spread(const colour *anchor, int count, cli_palette *out, int first, int last) {
    double lab[ANCHORS_MAX][3], way[ANCHORS_MAX];
    for (int k = 0; k < count; ++k) {
        const double rgb[3] = {anchor[k][0] / 255.0, anchor[k][1] / 255.0, anchor[k][2] / 255.0};
        cli_lab_of_srgb(rgb, lab[k]);
        way[k] = k > 0 ? way[k - 1] + distance(lab[k], lab[k - 1]) : 0.0;
    }
    for (int i = first, k = 1; i <= last; ++i) {
        double at = way[count - 1] * (i - first) / (last - first);
        while (k < count - 1 && way[k] < at) {
            ++k;
        }
        double t = (at - way[k - 1]) / (way[k] - way[k - 1]), mixed[3];
        for (int c = 0; c < 3; ++c) {
            mixed[c] = lab[k - 1][c] + t * (lab[k][c] - lab[k - 1][c]);
        }
        cli_srgb_of_lab(mixed, out->rgb[i]);
    }
}

void cli_palette_sequential(cli_palette *out) {
    /* Twenty colours of viridis (S. van der Walt and N. Smith, 2015; CC0). */
    static const colour VIRIDIS[20] = {
        {0x44, 0x01, 0x54}, {0x48, 0x15, 0x67}, {0x48, 0x26, 0x77}, {0x45, 0x37, 0x81},
        {0x40, 0x47, 0x88}, {0x39, 0x56, 0x8c}, {0x33, 0x63, 0x8d}, {0x2d, 0x70, 0x8e},
        {0x28, 0x7d, 0x8e}, {0x23, 0x8a, 0x8d}, {0x1f, 0x96, 0x8b}, {0x20, 0xa3, 0x87},
        {0x29, 0xaf, 0x7f}, {0x3c, 0xbb, 0x75}, {0x55, 0xc6, 0x67}, {0x73, 0xd0, 0x55},
        {0x95, 0xd8, 0x40}, {0xb8, 0xde, 0x29}, {0xdc, 0xe3, 0x19}, {0xfd, 0xe7, 0x25}};
    spread(VIRIDIS, 20, out, 0, CLI_PALETTE_SIZE - 1);
}

void cli_palette_diverging(cli_palette *out) {
    /* Ends and middle of K. Moreland, Diverging Color Maps for Scientific Visualization (2009). */
    static const colour COLD[2] = {{59, 76, 192}, {221, 221, 221}};
    static const colour WARM[2] = {{221, 221, 221}, {180, 4, 38}};
    const int middle = CLI_PALETTE_SIZE / 2;
    spread(COLD, 2, out, 0, middle - 1);
    spread(WARM, 2, out, middle, CLI_PALETTE_SIZE - 1);
}
