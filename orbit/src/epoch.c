/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"

#include <srp/const.h>
#include <srp/orbit/epoch.h>

#include <ctype.h>
#include <erfa.h>
#include <erfam.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double DAY = 86400.0;
static const double TT_MINUS_TAI = 32.184;    /* [s], IAU 1991 */
static const double A1_MINUS_TAI = 0.0343817; /* [s], GMAT's constant */
static const double GMAT_MJD_OFFSET = 2430000.0;

static const char *const SCALES[SRP_TIME_SCALE_COUNT] = {"TAI", "UTC", "TT", "TDB", "A1"};

const char *srp_time_scale_name(srp_time_scale scale) {
    return (unsigned)scale < SRP_TIME_SCALE_COUNT ? SCALES[scale] : NULL;
}

bool srp_time_scale_find(const char *name, srp_time_scale *out) {
    for (int i = 0; i < SRP_TIME_SCALE_COUNT; ++i) {
        if (strcmp(name, SCALES[i]) == 0) {
            *out = (srp_time_scale)i;
            return true;
        }
    }
    return false;
}

/* TDB - TT [s] as GMAT has it (Vallado's series cut after two terms). */
static double tdb_minus_tt(double jd_tt) {
    const double centuries = (jd_tt - ERFA_DJ00) / ERFA_DJC;
    const double m = (357.5277233 + 35999.05034 * centuries) * SRP_RAD_PER_DEG;
    return 0.001658 * sin(m) + 0.00001385 * sin(2.0 * m);
}

/* Scale - TAI [s] at a TAI date; not of UTC. */
static double offset_of(srp_time_scale scale, double jd_tai) {
    switch (scale) {
    case SRP_TIME_TT:
        return TT_MINUS_TAI;
    case SRP_TIME_TDB:
        return TT_MINUS_TAI + tdb_minus_tt(jd_tai + TT_MINUS_TAI / DAY);
    case SRP_TIME_A1:
        return A1_MINUS_TAI;
    default:
        return 0.0;
    }
}

srp_epoch srp_epoch_add(srp_epoch epoch, double seconds) {
    const double s = epoch.s + seconds;
    const double days = floor(s / DAY);
    srp_epoch out = {epoch.jd + days, s - days * DAY};
    return out;
}

double srp_epoch_difference(srp_epoch later, srp_epoch earlier) {
    return (later.jd - earlier.jd) * DAY + (later.s - earlier.s);
}

/* From a date in two parts. */
static srp_epoch normalised(double jd, double fraction) {
    const double whole = floor(jd - 0.5) + 0.5;
    srp_epoch start = {whole, 0.0};
    return srp_epoch_add(srp_epoch_add(start, (jd - whole) * DAY), fraction * DAY);
}

void srp_epoch_julian(srp_epoch epoch, srp_time_scale scale, double *jd, double *fraction) {
    if (scale == SRP_TIME_UTC) {
        eraTaiutc(epoch.jd, epoch.s / DAY, jd, fraction);
        return;
    }
    const double offset = offset_of(scale, epoch.jd + epoch.s / DAY);
    *jd = epoch.jd;
    *fraction = (epoch.s + offset) / DAY;
}

double srp_epoch_gmat_mjd(srp_epoch epoch, srp_time_scale scale) {
    double jd, fraction;
    srp_epoch_julian(epoch, scale, &jd, &fraction);
    return jd - GMAT_MJD_OFFSET + fraction;
}

/* ---- Reading -------------------------------------------------------------------------------- */

typedef struct date_fields {
    int year, month, day, hour, minute;
    double second;
} date_fields;

/* Exactly `digits` digits. */
static bool read_digits(const char **at, int digits, int *out) {
    int value = 0;
    for (int i = 0; i < digits; ++i, ++*at) {
        if (!isdigit((unsigned char)**at)) {
            return false;
        }
        value = 10 * value + (**at - '0');
    }
    *out = value;
    return true;
}

static bool read_mark(const char **at, char mark) {
    if (**at != mark) {
        return false;
    }
    ++*at;
    return true;
}

static bool read_seconds(const char **at, double *out) {
    int whole;
    if (!read_digits(at, 2, &whole)) {
        return false;
    }
    *out = whole;
    if (read_mark(at, '.')) {
        double digit = 0.1;
        for (; isdigit((unsigned char)**at); ++*at, digit *= 0.1) {
            *out += digit * (**at - '0');
        }
    }
    return true;
}

static bool read_date(const char **at, date_fields *out) {
    *out = (date_fields){0};
    if (!read_digits(at, 4, &out->year) || !read_mark(at, '-') ||
        !read_digits(at, 2, &out->month) || !read_mark(at, '-') || !read_digits(at, 2, &out->day)) {
        return false;
    }
    const bool time = **at == 'T' || (**at == ' ' && isdigit((unsigned char)(*at)[1]));
    if (!time) {
        return true;
    }
    ++*at;
    if (!read_digits(at, 2, &out->hour) || !read_mark(at, ':') ||
        !read_digits(at, 2, &out->minute)) {
        return false;
    }
    return !read_mark(at, ':') || read_seconds(at, &out->second);
}

static srp_status from_fields(const char *text, const date_fields *date, srp_time_scale scale,
                              srp_epoch *out, bool *beyond, srp_error *error) {
    double jd, fraction;
    const bool utc = scale == SRP_TIME_UTC;
    /* ERFA keeps the seconds of a leap second only within UTC. */
    int code = eraDtf2d(utc ? "UTC" : "TAI", date->year, date->month, date->day, date->hour,
                        date->minute, date->second, &jd, &fraction);
    if (code < 0 || code >= 2) {
        return srp_fail(error, SRP_BAD_DATA, "'%s': there is no such date", text);
    }
    if (utc) {
        double tai, tai_fraction;
        if (eraUtctai(jd, fraction, &tai, &tai_fraction) < 0) {
            return srp_fail(error, SRP_BAD_DATA, "'%s': there is no such date", text);
        }
        *out = normalised(tai, tai_fraction);
    } else {
        srp_epoch naive = normalised(jd, fraction);
        /* The offset is that of the instant in TAI: TDB's changes by 1e-8 s over itself. */
        const srp_epoch near = srp_epoch_add(naive, -offset_of(scale, naive.jd + naive.s / DAY));
        *out = srp_epoch_add(naive, -offset_of(scale, near.jd + near.s / DAY));
    }
    if (beyond != NULL) {
        *beyond = utc && code == 1;
    }
    return SRP_OK;
}

static srp_status no_date(const char *text, srp_error *error) {
    return srp_fail(error, SRP_BAD_FORMAT,
                    "found '%s', expected a date like 2024-03-20T00:00:00.000 UTC", text);
}

srp_status srp_epoch_parse_in(const char *text, srp_time_scale scale, srp_epoch *out, bool *beyond,
                              srp_error *error) {
    date_fields date;
    const char *at = text;
    if (!read_date(&at, &date) || (*at != '\0' && !(at[0] == 'Z' && at[1] == '\0'))) {
        return no_date(text, error);
    }
    return from_fields(text, &date, scale, out, beyond, error);
}

srp_status srp_epoch_parse(const char *text, srp_epoch *out, bool *beyond, srp_error *error) {
    date_fields date;
    srp_time_scale scale;
    const char *at = text;
    if (!read_date(&at, &date) || *at != ' ') {
        return no_date(text, error);
    }
    while (*at == ' ') {
        ++at;
    }
    if (!srp_time_scale_find(at, &scale)) {
        return srp_fail(error, SRP_BAD_FORMAT,
                        "'%s': '%s' is no time scale, expected UTC, TAI, TT, TDB or A1", text, at);
    }
    return from_fields(text, &date, scale, out, beyond, error);
}

const char *srp_epoch_format(srp_epoch epoch, srp_time_scale scale, int decimals,
                             char buffer[SRP_EPOCH_TEXT_SIZE]) {
    double jd, fraction;
    int year, month, day, time[4];
    srp_epoch_julian(epoch, scale, &jd, &fraction);
    eraD2dtf(scale == SRP_TIME_UTC ? "UTC" : "TAI", decimals, jd, fraction, &year, &month, &day,
             time);
    int length = snprintf(buffer, SRP_EPOCH_TEXT_SIZE, "%04d-%02d-%02dT%02d:%02d:%02d", year, month,
                          day, time[0], time[1], time[2]);
    if (decimals > 0 && length > 0 && length < SRP_EPOCH_TEXT_SIZE) {
        snprintf(buffer + length, SRP_EPOCH_TEXT_SIZE - (size_t)length, ".%0*d", decimals, time[3]);
    }
    return buffer;
}
