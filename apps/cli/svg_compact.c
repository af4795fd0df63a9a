/* SPDX-License-Identifier: Apache-2.0 */
/* The plotting library draws surfaces and maps as ten thousands of small pieces, each a line with
 * all of its properties; three quarters of the bytes say nothing. */
#include "svg_compact.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_MAX_SIZE = 4096 };

/* What is written instead of a line; `full` when it does not fit. */
typedef struct draft {
    char text[LINE_MAX_SIZE];
    size_t size;
    bool full;
} draft;

static void add(draft *to, const char *text, size_t size) {
    if (to->size + size >= sizeof to->text) {
        to->full = true;
        return;
    }
    memcpy(to->text + to->size, text, size);
    to->size += size;
    to->text[to->size] = '\0';
}

static void add_text(draft *to, const char *text) {
    add(to, text, strlen(text));
}

/* The value of an attribute in a line; NULL: it has none. */
static const char *attribute(const char *line, const char *name, size_t *size) {
    const char *at = strstr(line, name);
    const char *end = at != NULL ? strchr(at + strlen(name), '"') : NULL;
    if (end == NULL) {
        return NULL;
    }
    at += strlen(name);
    *size = (size_t)(end - at);
    return at;
}

/* ---- style ---- */

/* What SVG 1.1 takes when nothing is said, and a limit that only sharp joins know. */
static bool says_nothing(const char *property, size_t size, bool bevelled) {
    static const char *const DEFAULTS[] = {"fill-rule:nonzero", "fill-opacity:1",
                                           "stroke-width:1",    "stroke-linecap:butt",
                                           "stroke-opacity:1",  "stroke-dasharray:none"};
    for (size_t k = 0; k < sizeof DEFAULTS / sizeof DEFAULTS[0]; ++k) {
        if (strlen(DEFAULTS[k]) == size && memcmp(DEFAULTS[k], property, size) == 0) {
            return true;
        }
    }
    return bevelled && strncmp(property, "stroke-miterlimit:", 18) == 0;
}

/* Numbers of a text in the order of `pattern`, where each '#' stands for one and a blank for any
 * blanks; returns where the text goes on, NULL: it is not so. */
static const char *read_pattern(const char *text, const char *pattern, double *number) {
    for (; *pattern != '\0'; ++pattern) {
        if (*pattern == '#') {
            char *end;
            *number++ = strtod(text, &end);
            if (end == text) {
                return NULL;
            }
            text = end;
        } else if (*pattern == ' ') {
            text += strspn(text, " ");
        } else if (*text++ != *pattern) {
            return NULL;
        }
    }
    return text;
}

/* "fill:rgb(a%,b%,c%)" as "fill:#aabbcc", anything else as it is. */
static void add_property(draft *to, const char *property, size_t size) {
    double share[3];
    char hex[8];
    const char *value = memchr(property, ':', size);
    if (value != NULL && read_pattern(value, ":rgb(#%,#%,#%)", share) == property + size) {
        add(to, property, (size_t)(value - property) + 1);
        snprintf(hex, sizeof hex, "#%02x%02x%02x", (unsigned)lround(2.55 * share[0]) & 255u,
                 (unsigned)lround(2.55 * share[1]) & 255u,
                 (unsigned)lround(2.55 * share[2]) & 255u);
        add_text(to, hex);
    } else {
        add(to, property, size);
    }
}

static void add_style(draft *to, const char *style, size_t size) {
    static const char BEVEL[] = "stroke-linejoin:bevel";
    const char *end = style + size, *bevel = strstr(style, BEVEL);
    bool bevelled = bevel != NULL && bevel < end, first = true;
    while (style < end) {
        const char *next = memchr(style, ';', (size_t)(end - style));
        size_t length = (size_t)((next != NULL ? next : end) - style);
        if (length > 0 && !says_nothing(style, length, bevelled)) {
            add(to, ";", first ? 0 : 1);
            add_property(to, style, length);
            first = false;
        }
        style += length + 1;
    }
}

/* ---- points ---- */

/* To a hundredth, without zeros at the end. */
static void add_number(draft *to, double value) {
    char number[32];
    int size = snprintf(number, sizeof number, "%.2f", value);
    while (size > 0 && number[size - 1] == '0') {
        --size;
    }
    size -= size > 0 && number[size - 1] == '.';
    number[size] = '\0';
    add_text(to, strcmp(number, "-0") == 0 ? "0" : number);
}

/* "M x y L x y L x y" as "Mx y x y x y"; false: there is something else in it. `height`: of the
 * picture that y counts from below in; NAN: from above. */
static bool add_points(draft *to, const char *d, size_t size, double height) {
    const char *end = d + size;
    while (d < end && *d == ' ') {
        ++d;
    }
    bool lifted = true;
    while (d < end) {
        double p[2];
        bool moves = *d == 'M';
        const char *next = moves || *d == 'L' ? read_pattern(d + 1, " # # ", p) : NULL;
        if (next == NULL || next > end) {
            return false;
        }
        add_text(to, moves ? "M" : lifted ? "L" : " ");
        add_number(to, p[0]);
        add_text(to, " ");
        add_number(to, isnan(height) ? p[1] : height - p[1]);
        lifted = false;
        d = next;
    }
    return true;
}

/* ---- lines ---- */

/* The height of "matrix(1,0,0,-1,0,HEIGHT)", NAN where there is no transform; false: another. */
static bool height_of(const char *line, double *height) {
    size_t size;
    const char *transform = attribute(line, " transform=\"", &size);
    *height = NAN;
    return transform == NULL ||
           read_pattern(transform, "matrix(1,0,0,-1,0,#)", height) == transform + size;
}

/* False: the line stays as it is. */
static bool rewrite(const char *line, draft *to) {
    size_t style_size = 0, d_size = 0;
    double height;
    const char *style = attribute(line, "<path style=\"", &style_size);
    const char *d = attribute(line, " d=\"", &d_size), *end = line + strlen(line);
    if (style != line + 13 || d == NULL || !height_of(line, &height) || end < line + 2 ||
        strcmp(end - 2, "/>") != 0 || strstr(line, "clip-path") != NULL) {
        return false;
    }
    add_text(to, "<path style=\"");
    add_style(to, style, style_size);
    add_text(to, "\" d=\"");
    bool good = add_points(to, d, d_size, height);
    add_text(to, "\"/>");
    return good && !to->full;
}

size_t cli_svg_compact(char *text, size_t size) {
    size_t from = 0, to = 0;
    while (from < size) {
        char line[LINE_MAX_SIZE];
        const char *break_at = memchr(text + from, '\n', size - from);
        size_t length = break_at != NULL ? (size_t)(break_at - text) - from : size - from;
        draft instead;
        instead.size = 0;
        instead.full = false;
        bool shorter = false;
        if (length < sizeof line && memcmp(text + from, "<path", length < 5 ? length : 5) == 0) {
            memcpy(line, text + from, length);
            line[length] = '\0';
            shorter = rewrite(line, &instead) && instead.size < length;
        }
        if (shorter) {
            memcpy(text + to, instead.text, instead.size);
            to += instead.size;
        } else {
            memmove(text + to, text + from, length);
            to += length;
        }
        from += length;
        if (from < size) {
            text[to++] = text[from++];
        }
    }
    return to;
}

static char *read_all(const char *path, size_t *size) {
    FILE *in = fopen(path, "rb");
    char *text = NULL;
    long length = -1;
    if (in == NULL) {
        return NULL;
    }
    if (fseek(in, 0, SEEK_END) == 0 && (length = ftell(in)) > 0 && fseek(in, 0, SEEK_SET) == 0) {
        text = malloc((size_t)length);
    }
    if (text != NULL && fread(text, 1, (size_t)length, in) != (size_t)length) {
        free(text);
        text = NULL;
    }
    fclose(in);
    *size = text != NULL ? (size_t)length : 0;
    return text;
}

bool cli_svg_compact_file(const char *path) {
    size_t size;
    char *text = read_all(path, &size);
    FILE *out = text != NULL ? fopen(path, "wb") : NULL;
    bool good = false;
    if (out != NULL) {
        size = cli_svg_compact(text, size);
        good = fwrite(text, 1, size, out) == size;
        good = fclose(out) == 0 && good;
    }
    free(text);
    return good;
}
