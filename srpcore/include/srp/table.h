/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Tables: responses over azimuth and elevation of the direction spacecraft -> Sun in body axes,
 * s = (cos el cos az, cos el sin az, sin el); az in [-180, 180], el in [-90, 90] degrees, both ends
 * stored. Node (i, j) is azimuth i, elevation j.
 */
#ifndef SRP_TABLE_H
#define SRP_TABLE_H

#include <srp/material.h>
#include <srp/method.h>
#include <srp/status.h>
#include <srp/sunlight.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

SRP_BEGIN_DECLS

typedef struct srp_grid {
    uint32_t az_count; /* azimuth nodes, both ends: 360/step + 1, at least 2 */
    uint32_t el_count; /* elevation nodes, both ends: 180/step + 1, at least 2 */
} srp_grid;

/* Grid of the given steps [deg]; each must divide its range (to 1e-9 of a step), at least 0.01.
 * SRP_BAD_ARGUMENT. */
SRP_API SRP_CHECK srp_status srp_grid_from_steps(double az_step_deg, double el_step_deg,
                                                 srp_grid *out, srp_error *error);
SRP_API size_t srp_grid_node_count(srp_grid grid);
/* Angles of the nodes [deg]; the ends are exact. */
SRP_API double srp_grid_azimuth_deg(srp_grid grid, uint32_t i);
SRP_API double srp_grid_elevation_deg(srp_grid grid, uint32_t j);
/* Direction of a node. Multiples of 90 degrees give exact 0 and 1; mirror nodes give mirrored bits;
 * the two ends of azimuth, and all azimuths of a pole, give the same bits. */
SRP_API srp_vec3 srp_grid_direction(srp_grid grid, uint32_t i, uint32_t j);
/* Solid angle of a node's cell [sr]: the part within the grid of the cell that reaches half a step
 * to each side. Those of all nodes add up to 4 pi. */
SRP_API double srp_grid_solid_angle(srp_grid grid, uint32_t i, uint32_t j);
/* Unit vector of any azimuth and elevation [deg], with exact multiples of 90 degrees. */
SRP_API srp_vec3 srp_direction_from_deg(double az_deg, double el_deg);

typedef struct srp_table srp_table;

/* Interpolation error over some directions, by one scheme; NAN where the scheme does not take the
 * grid. t is 0 in tables without moments. */
typedef struct srp_table_error {
    double f_mean, f_max; /* of |difference of f| [m^2] */
    double t_mean, t_max; /* of |difference of t| [m^3] */
} srp_table_error;

/* What is known of a table's interpolation error: see srp_interp_check() (srp/interp.h). */
enum { SRP_TABLE_SCHEMES = 3 };
typedef struct srp_table_check {
    uint32_t count;                            /* directions that were computed; 0: not known */
    uint64_t seed;                             /* of the directions */
    srp_table_error errors[SRP_TABLE_SCHEMES]; /* in the order of srp_interp_list() */
} srp_table_check;

/* What a table tells about itself besides its numbers; strings are owned by the table. */
typedef struct srp_table_info {
    const char *title;  /* e.g. the name of the model file */
    const char *method; /* name and device of the method, "" when read from .spo, .txt */
    const char *device;
    const char *shape_hash; /* srp_scene_shape_hash, "" when unknown */
    const char *optics_hash;
    const char *version;      /* of the library that made it */
    const char *command_line; /* "" when unknown */
    /* Of a table that srp_table_reoptic() made: the hash of the optics that its sums were traced
     * with, and the command line of that run. "" for tables whose numbers are as traced. */
    const char *traced_optics_hash;
    const char *traced_command_line;
    srp_method_params
        params;         /* reference, seed, lattice, tolerance, bounces; threads is not stored */
    srp_sunlight light; /* P0 and AU that F and a are stated with */
    double mass;        /* [kg], NAN when not given */
    /* What the nodes hold. Without has_error they are f (and t) alone, read from a file that has no
     * more: errors, areas, unresolved flux, samples and flags are not known. */
    bool has_error, has_moment, has_basis;
    bool has_bounce;  /* light that was reflected before is in f and t, and known apart */
    bool bounce_kept; /* that part is of the traced optics, not of those of the materials here */
    srp_table_check check;
} srp_table_info;

/* An empty table for `prepared`'s scene and method. `with_basis` keeps per-material sums.
 * SRP_BAD_ARGUMENT, SRP_UNSUPPORTED, SRP_NO_MEMORY. */
SRP_API SRP_CHECK srp_status srp_table_create(const srp_prepared *prepared, srp_grid grid,
                                              bool with_basis, srp_table **out, srp_error *error);
SRP_API void srp_table_destroy(srp_table *table);

/* Set after creation, copied. Flux, AU and mass from 1e-30 to 1e30; the mass may be NAN (not
 * given). SRP_BAD_ARGUMENT, SRP_NO_MEMORY. */
SRP_API SRP_CHECK srp_status srp_table_describe(srp_table *table, const char *title,
                                                const char *command_line, srp_sunlight light,
                                                double mass, srp_error *error);

/* Keeps what a check found. */
SRP_API void srp_table_set_check(srp_table *table, const srp_table_check *check);

typedef struct srp_table_progress {
    /* Called from the calling thread before the first batch and after each; false cancels. done and
     * total count directions, of which the seam and the poles have one for several nodes. `table`
     * may be written to a file from here. NULL: never. */
    bool (*report)(void *user, const srp_table *table, size_t done, size_t total);
    void *user;
} srp_table_progress;

/*
 * Computes every empty node; nodes that are there stay as they are, so that a cancelled table goes
 * on where it stopped. The nodes' values depend on neither threads nor order.
 * `prepared` must be of the scene, method and parameters that the table was created for
 * (SRP_MISMATCH). SRP_CANCELLED, SRP_NO_MEMORY: the nodes done so far are kept.
 */
SRP_API SRP_CHECK srp_status srp_table_fill(srp_table *table, const srp_prepared *prepared,
                                            const srp_table_progress *progress, srp_error *error);

SRP_API srp_grid srp_table_grid(const srp_table *table);
SRP_API const srp_table_info *srp_table_get_info(const srp_table *table);
SRP_API bool srp_table_is_complete(const srp_table *table);
SRP_API size_t srp_table_filled_count(const srp_table *table);
/* The response of a node, NULL while it is empty; owned by the table. */
SRP_API const srp_response *srp_table_node(const srp_table *table, uint32_t i, uint32_t j);
/* The (material count + 1) sums of a node; NULL when empty or not kept. */
SRP_API const srp_basis *srp_table_node_basis(const srp_table *table, uint32_t i, uint32_t j);
SRP_API size_t srp_table_material_count(const srp_table *table);
SRP_API const char *srp_table_material_name(const srp_table *table, size_t index);
SRP_API srp_optics srp_table_material_optics(const srp_table *table, size_t index);
/* Turns every f and t round: for tables whose signs follow the opposite convention. */
SRP_API void srp_table_flip(srp_table *table);
/* Share of pulling nodes above which a table follows the opposite convention. */
#define SRP_TABLE_PULL_LIMIT 0.5
/* Share of the nodes with |f| > 0 where light would pull (f.s > 0), weighted by solid angle. Near 0
 * for physics, near 1 for a table of the opposite convention. */
SRP_API double srp_table_pull_share(const srp_table *table);

/*
 * A new table, of the same nodes as `table`, for other optics: f and t of direct light come from
 * the sums per material that `table` keeps (PHYSICS: "Direct light is linear in the optics"), and
 * nothing is traced.
 *   materials    new optics by name; a material of the table that is not in it, or whose optics are
 *                not known there, keeps its own. Which sides a material has was settled when the
 *                sums were made: one_sided = false leaves it as it is.
 *   keep_bounce  what to do about light that was reflected before, which is not linear in the
 *                optics. False: a table with such a part (has_bounce, and params.reflections not 0)
 *                is refused. True: that part, its standard error and the unresolved flux stay as
 *                traced, and bounce_kept of the result says so. With no reflections the unresolved
 *                flux alone is what the traced optics sent on
 * The result keeps the sums, so that it can be given other optics again. It has the optics' hash of
 * its new optics, traced_optics_hash names those that the sums were made with, and it cannot be
 * filled further (srp_table_check_origin). command_line is "" until described. Areas and samples
 * stay. Where the sums are exact, f and t are what the method would give for the new optics, to
 * rounding. Where they are sampled (f_error > 0 without a bounce part), f_error and t_error are the
 * old ones times how much harder light may push now, a scale and no bound (docs/theory.md, "Other
 * optics"), and SRP_RESPONSE_TOLERANCE_MISSED is decided anew. Empty nodes stay empty.
 * SRP_UNSUPPORTED: no sums per material; a bounce part and not keep_bounce; one_sided = true for a
 * material that has two sides; part of a sampled model outside its window (SRP_RESPONSE_CUT): the
 * sums lack it. SRP_NOT_FOUND: a name that the table does not have; the message lists those that it
 * has. SRP_NO_MEMORY. `table` is not changed; any thread.
 */
SRP_API SRP_CHECK srp_status srp_table_reoptic(const srp_table *table,
                                               const srp_materials *materials, bool keep_bounce,
                                               srp_table **out, srp_error *error);

/* What may be odd about the numbers of a table, as of one that went through a file. */
typedef struct srp_table_report {
    double pole_spread[2]; /* [m^2] largest |f - mean| among the nodes of the south and north pole,
                              which are one direction */
    double seam_spread;    /* [m^2] largest |difference of f| between the ends of azimuth */
    double quantum;        /* [m^2] power of ten that all components of f are multiples of, 0 when
                              it is less than 1e-7 of the largest */
    double f_max;          /* [m^2] largest |f| */
} srp_table_report;

/* Looks at a complete table. What an interpolant must make up for is sent to `log` (may be NULL) as
 * warnings about the file `name`: spreads above 1e-9 of the largest |f|, rounding, and a column of
 * |f| in a .spo that its components belie. */
SRP_API void srp_table_inspect(const srp_table *table, const char *name, const srp_log *log,
                               srp_table_report *out);

/* File formats. */
enum {
    SRP_FORMAT_PARTIAL = 1, /* can hold a table that is not complete */
    SRP_FORMAT_BASIS = 2,   /* keeps per-material sums */
    SRP_FORMAT_MASS = 4     /* needs the mass: it holds accelerations */
};

typedef struct srp_table_format {
    const char *name;    /* "netcdf", "spo", "txt" */
    const char *ending;  /* ".nc", ".spo", ".txt" */
    const char *summary; /* one line for help texts */
    unsigned capabilities;
    srp_status (*write)(const srp_table *table, const char *path, srp_error *error);
    srp_status (*read)(const char *path, srp_table **out, srp_error *error);
} srp_table_format;

/* NetCDF-C is not made for threads. Readers and writers of .nc files here take turns; a program
 * that calls NetCDF itself must not do so meanwhile. */
SRP_API extern const srp_table_format srp_table_format_netcdf;
SRP_API extern const srp_table_format srp_table_format_spo;
SRP_API extern const srp_table_format srp_table_format_txt;
SRP_API const srp_table_format *const *srp_table_format_list(size_t *count);
/* The format whose ending `path` has, in small or capital letters; NULL when none. */
SRP_API const srp_table_format *srp_table_format_of(const char *path);

/*
 * Writes beside `path` and renames, so that `path` is never half written.
 * SRP_BAD_ARGUMENT (incomplete table and a format that can't hold one; no mass), SRP_IO.
 */
SRP_API SRP_CHECK srp_status srp_table_write(const srp_table *table, const srp_table_format *format,
                                             const char *path, srp_error *error);
/* SRP_NOT_FOUND, SRP_IO, SRP_BAD_FORMAT, SRP_BAD_DATA (a force or moment beyond 1e100 in SI, among
 * others), SRP_NO_MEMORY. A sign that is wrong is not
 * an error here: ask srp_table_pull_share(). */
SRP_API SRP_CHECK srp_status srp_table_read(const srp_table_format *format, const char *path,
                                            srp_table **out, srp_error *error);
/* .spo from memory, for other containers and for tests. */
SRP_API SRP_CHECK srp_status srp_table_parse_spo(const char *text, size_t size, const char *name,
                                                 srp_table **out, srp_error *error);
/* SRP_OK when `table` (read from a file) is of the same scene, method, parameters and grid as an
 * empty one made for `prepared` would be, so that it may be filled further; else SRP_MISMATCH with
 * the first difference in words. A table that was given other optics is none. */
SRP_API SRP_CHECK srp_status srp_table_check_origin(const srp_table *table,
                                                    const srp_prepared *prepared, srp_grid grid,
                                                    bool with_basis, srp_error *error);

SRP_END_DECLS

#endif
