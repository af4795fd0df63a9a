/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Missions: an orbit described in a YAML file (docs/file-formats.md), with everything that it names
 * read and checked, ready to run.
 *
 *     status = srp_mission_read("geo.yaml", NULL, &mission, &error);
 *     status = srp_mission_run(mission, &watch, &summary, &error);
 *     srp_mission_destroy(mission);
 */
#ifndef SRP_ORBIT_MISSION_H
#define SRP_ORBIT_MISSION_H

#include <srp/cache.h>
#include <srp/export.h>
#include <srp/method.h>
#include <srp/orbit/propagator.h>
#include <srp/status.h>
#include <srp/vec3.h>

#include <stdbool.h>
#include <stddef.h>

SRP_BEGIN_DECLS

typedef struct srp_mission srp_mission;

/* What a mission may use besides the files that it names; each may be NULL. */
typedef struct srp_mission_context {
    const srp_log *log;
    /* A method by name and device ("cpu", "gl"), of whichever library; NULL: there is none. Must
     * stay as long as the mission. NULL: those of srpcore, on "cpu". */
    const srp_method *(*find_method)(void *user, const char *name, const char *device);
    void *user;
    /* Where tables on demand are remembered, unless the mission says `cache: false`. NULL: nowhere.
     */
    const srp_cache_params *cache;
} srp_mission_context;

/*
 * Reads a mission and all files that it names, which are looked for beside it. Every complaint
 * about the content has the line and column of the entry at fault. `context` may be NULL. With a
 * table on demand, the nodes that every look-up needs are computed here, or taken from the cache.
 * SRP_NOT_FOUND, SRP_IO, SRP_BAD_FORMAT (not YAML, unknown or missing key, no number, no such
 * unit), SRP_BAD_DATA (a value that cannot be), SRP_UNSUPPORTED (a feature that is not there),
 * SRP_NO_MEMORY.
 */
SRP_API SRP_CHECK srp_status srp_mission_read(const char *path, const srp_mission_context *context,
                                              srp_mission **out, srp_error *error);
/* The same from memory; `name` stands for the file in messages and says where other files lie. */
SRP_API SRP_CHECK srp_status srp_mission_parse(const char *text, size_t size, const char *name,
                                               const srp_mission_context *context,
                                               srp_mission **out, srp_error *error);
/* Writes what is new of a table on demand to the cache. */
SRP_API void srp_mission_destroy(srp_mission *mission);

/* Columns of the report; some stand for several. */
typedef enum srp_column {
    SRP_COLUMN_EPOCH,    /* in the scale of the mission's epoch */
    SRP_COLUMN_ELAPSED,  /* elapsed_s */
    SRP_COLUMN_A1_MJD,   /* as GMAT has it */
    SRP_COLUMN_TDB_MJD,  /* as GMAT has it */
    SRP_COLUMN_POSITION, /* x_km y_km z_km */
    SRP_COLUMN_VELOCITY, /* vx_km_s ... */
    SRP_COLUMN_ELEMENTS, /* a_km e i_deg raan_deg argp_deg nu_deg */
    SRP_COLUMN_SUN,      /* s_x s_y s_z, body axes */
    SRP_COLUMN_AREA,     /* f_x_m2 ..., body axes */
    SRP_COLUMN_SRP,      /* ax_srp_m_s2 ..., inertial */
    SRP_COLUMN_SEEN,     /* share of the Sun */
    SRP_COLUMN_IMPULSE,  /* impulse_m_s */
    SRP_COLUMN_ATTITUDE, /* m11 ... m33, inertial to body */
    SRP_COLUMN_NODES,    /* of a table on demand, computed in this run; 0 for other models */
    SRP_COLUMN_MATRIX,   /* phi11 ... phi66: state transition, m and s */
    SRP_COLUMN_COUNT
} srp_column;
SRP_API const char *srp_column_name(srp_column column);
SRP_API bool srp_column_find(const char *name, srp_column *out);

/* What a mission says of itself; pointers are the mission's. */
typedef struct srp_mission_info {
    const char *file, *title, *object_name, *object_id;
    const char *oem, *report, *events; /* files to write, NULL: none */
    /* Files that were read, NULL: none. */
    const char *gravity_file, *radiation_file, *attitude_file;
    srp_epoch epoch;
    srp_time_scale scale;
    srp_celestial central;
    double mu;             /* of the central body [m^3/s^2] */
    double duration, step; /* [s], of the output */
    bool partials;
    const char *model;         /* of the radiation force, "none" without */
    const srp_column *columns; /* (column_count) */
    size_t column_count;
} srp_mission_info;
SRP_API const srp_mission_info *srp_mission_get_info(const srp_mission *mission);
SRP_API const srp_force_list *srp_mission_forces(const srp_mission *mission);

/* A moment of the output. */
typedef struct srp_mission_row {
    double t; /* [s] since the epoch */
    srp_vec3 r, v;
    bool lit; /* there is radiation pressure: `light` holds */
    srp_radiation_probe light;
    double impulse;       /* [m/s] */
    size_t nodes;         /* of a table on demand, computed since the mission was read */
    const double *matrix; /* (6 x 6); NULL without partials */
} srp_mission_row;

typedef struct srp_mission_watch {
    /* At t = 0, every step of the output, and the end; not SRP_OK stops. NULL: never. */
    srp_status (*row)(void *user, const srp_mission *mission, const srp_mission_row *row,
                      srp_error *error);
    void (*event)(void *user, const srp_event *event); /* NULL: dropped */
    bool (*progress)(void *user, double done);         /* share; false cancels; NULL: never */
    void *user;
} srp_mission_watch;

typedef struct srp_mission_summary {
    srp_propagator_counts counts;
    double impulse;               /* of radiation pressure [m/s] */
    size_t penumbras, umbras;     /* entered */
    double in_penumbra, in_umbra; /* [s]; the penumbra's without the umbra's */
    srp_vec3 r, v;                /* at the end */
    /* Of a table on demand, 0 for other models: directions of its grid, those computed since the
     * mission was read, those found in the cache. */
    size_t nodes_total, nodes_computed, nodes_cached;
} srp_mission_summary;

/* SRP_BAD_DATA (the orbit meets the surface of the central body, and as srp_propagator_advance()),
 * SRP_CANCELLED, SRP_NO_MEMORY, what `row` returned, and what a table on demand met. New nodes of
 * such a table are written to the cache at the end, also of a run that fails. */
SRP_API SRP_CHECK srp_status srp_mission_run(const srp_mission *mission,
                                             const srp_mission_watch *watch,
                                             srp_mission_summary *out, srp_error *error);

/* ---- Files ----------------------------------------------------------------------------------- */

/* Writers that rows go into one by one; the file appears under its name when it is whole. */
typedef struct srp_mission_file srp_mission_file;

/* Orbit Ephemeris Message (CCSDS 502.0-B-2, KVN). `created` is its CREATION_DATE. SRP_IO,
 * SRP_NO_MEMORY, as the others. */
SRP_API SRP_CHECK srp_status srp_oem_begin(const char *path, const srp_mission *mission,
                                           const char *created, srp_mission_file **out,
                                           srp_error *error);
/* Report with the mission's columns, comma-separated, names with units in the first line. */
SRP_API SRP_CHECK srp_status srp_report_begin(const char *path, const srp_mission *mission,
                                              srp_mission_file **out, srp_error *error);
/* Events: kind, body, epoch, elapsed_s, state. */
SRP_API SRP_CHECK srp_status srp_events_begin(const char *path, const srp_mission *mission,
                                              srp_mission_file **out, srp_error *error);
SRP_API SRP_CHECK srp_status srp_mission_file_row(srp_mission_file *file,
                                                  const srp_mission_row *row, srp_error *error);
SRP_API SRP_CHECK srp_status srp_mission_file_event(srp_mission_file *file, const srp_event *event,
                                                    srp_error *error);
/* Both end it. */
SRP_API SRP_CHECK srp_status srp_mission_file_commit(srp_mission_file *file, srp_error *error);
SRP_API void srp_mission_file_abandon(srp_mission_file *file);

SRP_END_DECLS

#endif
