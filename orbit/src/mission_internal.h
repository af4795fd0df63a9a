/* SPDX-License-Identifier: Apache-2.0 */
/* A mission as its file has it, and as it runs. Internal. */
#ifndef SRP_ORBIT_SRC_MISSION_INTERNAL_H
#define SRP_ORBIT_SRC_MISSION_INTERNAL_H

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

typedef struct mission_radiation {
    char *model, *file, *interpolation, *method, *scale, *cr, *area, *flux, *au, *sun_radius;
    char **shadow;
    unsigned shadow_count;
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
                         unsigned max, unsigned *out, srp_error *error);
/* Like strdup. */
char *mission_copy(const char *text);
/* `file` as seen from the directory of the mission; freed by free(). */
char *mission_beside(const char *mission, const char *file);

/* ---- The mission ----------------------------------------------------------------------------- */

struct srp_mission {
    srp_mission_info info;
    char *texts[8]; /* what info points to */
    srp_column columns[SRP_COLUMN_COUNT];
    double mu[SRP_CELESTIAL_COUNT], radius[SRP_CELESTIAL_COUNT];
    srp_vec3 r, v;
    double mass;
    srp_propagator_params propagator;
    srp_ephemeris *ephemeris;
    srp_gravity *gravity;
    srp_scene *scene;
    srp_prepared *prepared;
    srp_force_list *forces;
    const srp_force *radiation; /* in the list, or NULL */
};

/* The parts of mission_build.c. */
srp_status mission_build_forces(const mission_source *source, const srp_log *log,
                                srp_mission *mission, srp_error *error);
srp_status mission_build_attitude(const mission_source *source, const srp_mission *mission,
                                  srp_attitude *out, srp_error *error);

#endif
