/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Instants and the scales that they are written in. Inside, time runs in TAI: an orbit is
 * integrated over seconds of TAI since an epoch, so that leap seconds are met only where a date is
 * read or written. Conversions are ERFA's (SOFA).
 */
#ifndef SRP_ORBIT_EPOCH_H
#define SRP_ORBIT_EPOCH_H

#include <srp/export.h>
#include <srp/status.h>

#include <stdbool.h>
#include <stddef.h>

SRP_BEGIN_DECLS

/* An instant in TAI, good to 1e-11 s. */
typedef struct srp_epoch {
    double jd; /* Julian date of the day's beginning: a whole number and a half */
    double s;  /* seconds into the day, [0, 86400) */
} srp_epoch;

typedef enum srp_time_scale {
    SRP_TIME_TAI,
    SRP_TIME_UTC,
    SRP_TIME_TT,  /* TAI + 32.184 s */
    SRP_TIME_TDB, /* TT + 0.001658 sin M + 0.00001385 sin 2M, as GMAT has it; good to 50 us */
    SRP_TIME_A1,  /* TAI + 0.0343817 s, GMAT's own */
    SRP_TIME_SCALE_COUNT
} srp_time_scale;

/* "UTC", ...; NULL out of range. */
SRP_API const char *srp_time_scale_name(srp_time_scale scale);
/* False when there is no scale of this name; then *out is unchanged. */
SRP_API bool srp_time_scale_find(const char *name, srp_time_scale *out);

/*
 * Reads "2024-03-20T00:00:00.000 UTC": a date and time as ISO 8601 has them ('T' or a blank
 * between, the time may lack seconds or be left out), and the scale. beyond   set when a date of
 * UTC lies outside ERFA's table of leap seconds, so that UTC is a guess there; NULL allowed
 * SRP_BAD_FORMAT (not such a text), SRP_BAD_DATA (a date that does not exist, 60 s where there was
 * no leap second). Any thread.
 */
SRP_API SRP_CHECK srp_status srp_epoch_parse(const char *text, srp_epoch *out, bool *beyond,
                                             srp_error *error);
/* The same for a scale that is known from elsewhere, as in CCSDS files. */
SRP_API SRP_CHECK srp_status srp_epoch_parse_in(const char *text, srp_time_scale scale,
                                                srp_epoch *out, bool *beyond, srp_error *error);

SRP_API srp_epoch srp_epoch_add(srp_epoch epoch, double seconds);
/* later - earlier [s] of TAI. */
SRP_API double srp_epoch_difference(srp_epoch later, srp_epoch earlier);
/* Julian date in a scale, as ERFA takes it: *jd + *fraction. */
SRP_API void srp_epoch_julian(srp_epoch epoch, srp_time_scale scale, double *jd, double *fraction);
/* Modified Julian date as GMAT counts it: JD - 2430000. */
SRP_API double srp_epoch_gmat_mjd(srp_epoch epoch, srp_time_scale scale);

enum { SRP_EPOCH_TEXT_SIZE = 40 };
/* "2024-03-20T00:00:00.000", rounded to `decimals` (0 to 9) of a second. Returns `buffer`. */
SRP_API const char *srp_epoch_format(srp_epoch epoch, srp_time_scale scale, int decimals,
                                     char buffer[SRP_EPOCH_TEXT_SIZE]);

SRP_END_DECLS

#endif
