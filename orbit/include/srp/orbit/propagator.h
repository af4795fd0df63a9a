/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The propagator: Runge-Kutta integration (GSL's steppers) of the sum of a force list, exactly to
 * each time that is asked for, with events.
 *
 * GSL calls its error handler, which ends the program, when it lacks memory: programs switch it off
 * (gsl_set_error_handler_off), this library leaves it alone.
 */
#ifndef SRP_ORBIT_PROPAGATOR_H
#define SRP_ORBIT_PROPAGATOR_H

#include <srp/export.h>
#include <srp/orbit/force.h>
#include <srp/orbit/radiation.h>
#include <srp/status.h>
#include <srp/vec3.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

SRP_BEGIN_DECLS

typedef struct srp_integrator {
    const char *name;    /* "rk8pd" */
    const char *summary; /* one line for help texts */
    int order;           /* power of the step that the error over a fixed time falls with */
    bool embedded;       /* its error estimate is that of another order, not of halved steps */
} srp_integrator;

SRP_API extern const srp_integrator srp_integrator_rk8pd; /* Prince-Dormand 8(9) */
SRP_API extern const srp_integrator srp_integrator_rkf45; /* Fehlberg 4(5) */
SRP_API extern const srp_integrator srp_integrator_rkck;  /* Cash-Karp 4(5) */
SRP_API extern const srp_integrator srp_integrator_rk4;   /* the classical one, halved steps */
SRP_API const srp_integrator *const *srp_integrator_list(size_t *count);
SRP_API const srp_integrator *srp_integrator_find(const char *name);

typedef struct srp_propagator_params {
    const srp_integrator *integrator;
    double tolerance;  /* error of a step over |r|, and over |v|; > 0 */
    double fixed_step; /* [s] > 0: this step and no error test; NAN: adaptive */
    double first_step; /* [s] > 0, adaptive */
    double max_step;   /* [s] > 0; INFINITY allowed */
    bool partials;     /* integrate the state transition matrix, too */
    bool apsides;      /* find them */
    bool shadow_edges; /* find them, and restart there */
    srp_shadow shadow; /* of shadow_edges */
} srp_propagator_params;

/* rk8pd, 1e-12, adaptive, first step 60 s, no largest step, nothing else. */
SRP_API srp_propagator_params srp_propagator_params_default(void);

typedef enum srp_event_kind {
    SRP_EVENT_PENUMBRA_ENTRY,
    SRP_EVENT_PENUMBRA_EXIT,
    SRP_EVENT_UMBRA_ENTRY,
    SRP_EVENT_UMBRA_EXIT,
    SRP_EVENT_ANTUMBRA_ENTRY, /* the body's disk is whole within the Sun's */
    SRP_EVENT_ANTUMBRA_EXIT,
    SRP_EVENT_PERIAPSIS,
    SRP_EVENT_APOAPSIS,
    SRP_EVENT_KIND_COUNT
} srp_event_kind;
SRP_API const char *srp_event_name(srp_event_kind kind);

typedef struct srp_event {
    srp_event_kind kind;
    srp_celestial body; /* that casts the shadow, or is orbited */
    double t;           /* [s] since the epoch */
    srp_vec3 r, v;      /* [m], [m/s] */
} srp_event;

typedef struct srp_propagator_watch {
    void (*event)(void *user, const srp_event *event); /* NULL: dropped */
    bool (*step)(void *user, double t); /* after each step; false cancels; NULL: never */
    void *user;
} srp_propagator_watch;

typedef struct srp_propagator_counts {
    uint64_t steps;    /* accepted */
    uint64_t rejected; /* by the error test or by a force */
    uint64_t cut;      /* tried, and then shortened to a shadow edge */
    uint64_t calls;    /* of the force list */
} srp_propagator_counts;

typedef struct srp_propagator srp_propagator;

/* `forces` must outlive *out. SRP_BAD_ARGUMENT, SRP_UNSUPPORTED (partials, but a force has none),
 * SRP_NO_MEMORY. */
SRP_API SRP_CHECK srp_status srp_propagator_create(const srp_force_list *forces,
                                                   const srp_propagator_params *params,
                                                   srp_propagator **out, srp_error *error);
SRP_API void srp_propagator_destroy(srp_propagator *propagator);

/* Begins at t with this state, the matrix 1, impulse and counts 0. SRP_BAD_ARGUMENT: not finite, or
 * r = 0. */
SRP_API SRP_CHECK srp_status srp_propagator_start(srp_propagator *propagator, double t, srp_vec3 r,
                                                  srp_vec3 v, srp_error *error);
/*
 * Goes on exactly to t, forwards or backwards. SRP_BAD_DATA (a force stopped it or is not finite;
 * the step became too small for the tolerance), SRP_CANCELLED. On failure the state is that of the
 * last good step.
 */
SRP_API SRP_CHECK srp_status srp_propagator_advance(srp_propagator *propagator, double t,
                                                    const srp_propagator_watch *watch,
                                                    srp_error *error);

SRP_API double srp_propagator_time(const srp_propagator *propagator);
SRP_API srp_vec3 srp_propagator_position(const srp_propagator *propagator);
SRP_API srp_vec3 srp_propagator_velocity(const srp_propagator *propagator);
/* Integral of |a| of radiation pressure since the start [m/s]. */
SRP_API double srp_propagator_impulse(const srp_propagator *propagator);
/* (6 x 6) d state(t) / d state(start), row by row; NULL without partials. */
SRP_API const double *srp_propagator_matrix(const srp_propagator *propagator);
SRP_API srp_propagator_counts srp_propagator_get_counts(const srp_propagator *propagator);

SRP_END_DECLS

#endif
