/* SPDX-License-Identifier: Apache-2.0 */
/* Files .svg that say the same in fewer bytes. */
#ifndef SRP_CLI_SVG_COMPACT_H
#define SRP_CLI_SVG_COMPACT_H

#include <stdbool.h>
#include <stddef.h>

/*
 * Rewrites the lines `<path ...>` of an SVG by cairo that are made of straight lines alone: without
 * properties that are the default of SVG, colours in hexadecimal, coordinates to a hundredth of a
 * pixel and upright. Everything else stays as it is. The result is never longer; in place.
 * Returns its size.
 */
size_t cli_svg_compact(char *text, size_t size);

/* The same for a file. False when it could not be read or written, or without memory. */
bool cli_svg_compact_file(const char *path);

#endif
