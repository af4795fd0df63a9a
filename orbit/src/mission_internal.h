/* SPDX-License-Identifier: Apache-2.0 */
/* A mission as its file has it, and as it runs. Internal. */
#ifndef SRP_ORBIT_SRC_MISSION_INTERNAL_H
#define SRP_ORBIT_SRC_MISSION_INTERNAL_H

#include <srp/cache.h>
#include <srp/demand.h>
#include <srp/orbit/mission.h>

#include <stdint.h>

/* ---- The file -------------------------------------------------------------------------------- */

/* Values are texts: numbers have units, and are read by us. NULL: not given. */
typedef struct mission_state {
    char *position, *velocity;
} mission_state;

typedef struct mission_elements {
    char *semi_major_axis, *eccentricity, *inclination, *raan, *arg_periapsis, *true_anomaly;
} mission_elements;

typedef struct mission_attitude {
    char *mode, *quaternion, *axis, *rate, *file;
    char *align, *align_body, *constrain, *constrain_body;
} mission_attitude;

typedef struct mission_spacecraft {
    char *name, *id, *mass;
    mission_attitude *attitude;
} mission_spacecraft;

typedef struct mission_gravity {
    char *file, *degree, *order, *ut1_minus_utc, *pole_x, *pole_y;
} mission_gravity;

typedef struct mission_material {
    char *name, *rho_s, *rho_d, *one_sided;
} mission_material;

typedef struct mission_radiation {
    char *model, *file, *interpolation, *scale, *cr, *area, *flux, *au, *sun_radius;
    char *unit, *method, *device, *grid, *pixel, *tolerance, *max_grid, *seed;
    char *reflections, *diffuse, *beams, *threads;
    char *step, *az_step, *el_step, *cache;
    char **shadow;
    unsigned shadow_count;
    mission_material *materials;
    unsigned material_count;
} mission_radiation;

typedef struct mission_forces {
    mission_gravity *gravity;
    char **point_masses;
    unsigned point_mass_count;
    mission_radiation *radiation;
} mission_forces;

/* One text per body. */
typedef struct mission_worlds {
    char *of[SRP_CELESTIAL_COUNT];
} mission_worlds;

typedef struct mission_constants {
    mission_worlds *mu, *radius;
} mission_constants;

typedef struct mission_integrator {
    char *method, *tolerance, *fixed_step, *first_step, *max_step;
} mission_integrator;

typedef struct mission_output {
    char *step, *oem, *report, *events;
    char **columns;
    unsigned column_count;
} mission_output;

typedef struct mission_file {
    char *title, *epoch, *duration, *central_body, *hyperbolic, *partials;
    mission_state *state;
    mission_elements *elements;
    mission_spacecraft *spacecraft;
    mission_forces *forces;
    mission_constants *constants;
    mission_integrator *integrator;
    mission_output *output;
} mission_file;

/* The text with the places of its entries, for complaints. */
typedef struct mission_source mission_source;

srp_status mission_source_open(const char *text, size_t size, const char *name,
                               mission_source **out, srp_error *error);
void mission_source_close(mission_source *source);
const mission_file *mission_source_file(const mission_source *source);
const char *mission_source_name(const mission_source *source);
/* Whether there is an entry of this path, be it an empty list. */
bool mission_has(const mission_source *source, const char *path);
/* Fails at the entry of a path such as "forces.radiation.shadow.1": the nearest that is there. */
srp_status mission_fail(const mission_source *source, srp_error *error, srp_status status,
                        const char *path, const char *format, ...) SRP_PRINTF(5, 6);
void mission_warn(const mission_source *source, const srp_log *log, const char *path,
                  const char *format, ...) SRP_PRINTF(4, 5);

/* ---- Values ---------------------------------------------------------------------------------- */

typedef enum mission_kind {
    MISSION_NUMBER,
    MISSION_LENGTH,
    MISSION_SPEED,
    MISSION_TIME,
    MISSION_MASS,
    MISSION_ANGLE,
    MISSION_RATE,
    MISSION_AREA,
    MISSION_FLUX,
    MISSION_MU,
    MISSION_KIND_COUNT
} mission_kind;

/* `count` numbers and a unit of this kind, in SI. *out is as it was when text is NULL. */
srp_status mission_values(const mission_source *source, const char *path, const char *text,
                          mission_kind kind, size_t count, double *out, srp_error *error);
/* One that is above 0. */
srp_status mission_positive(const mission_source *source, const char *path, const char *text,
                            mission_kind kind, double *out, srp_error *error);
srp_status mission_flag(const mission_source *source, const char *path, const char *text, bool *out,
                        srp_error *error);
srp_status mission_count(const mission_source *source, const char *path, const char *text,
                         unsigned min, unsigned max, unsigned *out, srp_error *error);
srp_status mission_bits(const mission_source *source, const char *path, const char *text,
                        uint64_t *out, srp_error *error);
/* Like strdup. */
char *mission_copy(const char *text);
/* `file` as seen from the directory of `mission`; freed by free(). */
char *mission_beside(const char *mission, const char *file);

/* ---- The mission ----------------------------------------------------------------------------- */

/* Why a model that computes as it goes could not; the first failure is kept. */
typedef struct mission_failure mission_failure;

/* Texts of the mission, by who keeps them. */
enum {
    MISSION_TEXT_FIRST = 7, /* before it: those of mission.c */
    MISSION_TEXT_GRAVITY = MISSION_TEXT_FIRST,
    MISSION_TEXT_RADIATION,
    MISSION_TEXT_ATTITUDE,
    MISSION_TEXT_COUNT
};

struct srp_mission {
    srp_mission_info info;
    char *texts[MISSION_TEXT_COUNT]; /* what info points to */
    srp_column columns[SRP_COLUMN_COUNT];
    double mu[SRP_CELESTIAL_COUNT], radius[SRP_CELESTIAL_COUNT];
    srp_vec3 r, v;
    double mass;
    srp_propagator_params propagator;
    srp_ephemeris *ephemeris;
    srp_gravity *gravity;
    srp_scene *scene;
    srp_prepared *prepared;
    srp_cache *cache;         /* NULL: none */
    srp_demand *demand;       /* NULL: none */
    mission_failure *failure; /* of the model on demand */
    srp_force_list *forces;
    const srp_force *radiation; /* in the list, or NULL */
};

/* ---- Building -------------------------------------------------------------------------------- */

/* What the parts of a mission are built from. */
typedef struct mission_site {
    const mission_source *source;
    const srp_mission_context *context;
    srp_mission *mission;
} mission_site;

/* mission_build.c */
srp_status mission_build_forces(const mission_site *site, srp_error *error);
/* Tells an error of a constructor at an entry of the mission; one that has a file keeps it. */
srp_status mission_at_entry(const mission_source *source, const char *path, srp_status status,
                            const srp_error *why, srp_error *error);
/* A file that cannot be opened, or is wrong as a whole, is told at the entry that names it. */
srp_status mission_at_file(const mission_source *source, const char *path, srp_status status,
                           const srp_error *why, srp_error *error);
/* `text` must be there. */
srp_status mission_need(const mission_source *source, const char *path, const char *text,
                        const char *key, srp_error *error);

/* `file` as seen from the directory of the mission, kept as text `slot` and in *out. */
srp_status mission_path(const mission_site *site, int slot, const char *file, const char **out,
                        srp_error *error);

/* mission_attitude.c */
srp_status mission_build_attitude(const mission_site *site, srp_attitude *out, srp_error *error);

/* mission_model.c */
srp_status mission_build_model(const mission_site *site, srp_area_model *out, srp_error *error);
void mission_failure_destroy(mission_failure *failure);
/* Whether there was one; then *error is it. */
bool mission_failure_get(const mission_failure *failure, srp_error *error);

/* mission_method.c: reads the OBJ file at `path` and prepares the method that the entries of
 * `forces.radiation` ask for; mission->scene and ->prepared. `threads`: where the file is silent.
 */
srp_status mission_prepare_mesh(const mission_site *site, const char *path, int threads,
                                srp_error *error);

/* Warns of entries that are given and mean nothing: `model` uses none of them. */
typedef struct mission_key {
    const char *name, *text;
} mission_key;
void mission_warn_unused(const mission_site *site, const char *group, const char *what,
                         size_t count, const mission_key *keys);

#endif
