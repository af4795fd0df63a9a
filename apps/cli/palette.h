/* SPDX-License-Identifier: Apache-2.0 */
/* Colours for values: even to the eye, so that equal steps of a value look equally far apart. */
#ifndef SRP_CLI_PALETTE_H
#define SRP_CLI_PALETTE_H

enum { CLI_PALETTE_SIZE = 256 };

typedef struct cli_palette {
    double rgb[CLI_PALETTE_SIZE][3]; /* sRGB, each in [0, 1] */
} cli_palette;

/* From dark blue over green to yellow (viridis), ever lighter. */
void cli_palette_sequential(cli_palette *out);
/* From blue over a light grey in the middle to red (after Moreland), for values of either sign. */
void cli_palette_diverging(cli_palette *out);

/* CIE L*a*b* (D65) of an sRGB colour, and back; what is outside of sRGB is clipped. */
void cli_lab_of_srgb(const double rgb[3], double lab[3]);
void cli_srgb_of_lab(const double lab[3], double rgb[3]);

#endif
