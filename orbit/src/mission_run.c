/* SPDX-License-Identifier: Apache-2.0 */
/* A mission under way: rows, events, and what they add up to. */
#include "error.h"
#include "mission_internal.h"

#include <math.h>

typedef struct runner {
    const srp_mission *mission;
    const srp_mission_watch *watch;
    srp_mission_summary summary;
    srp_propagator *propagator;
    double since[2]; /* when the penumbra and the umbra were entered; NAN: not in one */
    bool fell;
} runner;

static void on_event(void *user, const srp_event *event) {
    runner *run = user;
    srp_mission_summary *sum = &run->summary;
    switch (event->kind) {
    case SRP_EVENT_PENUMBRA_ENTRY:
        ++sum->penumbras;
        run->since[0] = event->t;
        break;
    case SRP_EVENT_UMBRA_ENTRY:
        ++sum->umbras;
        run->since[1] = event->t;
        break;
    case SRP_EVENT_PENUMBRA_EXIT:
        sum->in_penumbra += isnan(run->since[0]) ? 0.0 : event->t - run->since[0];
        run->since[0] = NAN;
        break;
    case SRP_EVENT_UMBRA_EXIT:
        sum->in_umbra += isnan(run->since[1]) ? 0.0 : event->t - run->since[1];
        run->since[1] = NAN;
        break;
    default:
        break;
    }
    if (run->watch != NULL && run->watch->event != NULL) {
        run->watch->event(run->watch->user, event);
    }
}

static bool on_step(void *user, double t) {
    runner *run = user;
    const srp_mission *mission = run->mission;
    const double r = srp_vec3_norm(srp_propagator_position(run->propagator));
    run->fell = !(r > mission->radius[mission->info.central]);
    return !run->fell && (run->watch == NULL || run->watch->progress == NULL ||
                          run->watch->progress(run->watch->user, t / mission->info.duration));
}

static srp_status give_row(runner *run, srp_error *error) {
    const srp_mission *mission = run->mission;
    if (run->watch == NULL || run->watch->row == NULL) {
        return SRP_OK;
    }
    srp_mission_row row = {.t = srp_propagator_time(run->propagator),
                           .r = srp_propagator_position(run->propagator),
                           .v = srp_propagator_velocity(run->propagator),
                           .impulse = srp_propagator_impulse(run->propagator),
                           .matrix = srp_propagator_matrix(run->propagator)};
    if (mission->demand != NULL) {
        row.nodes = srp_demand_count(mission->demand).computed;
    }
    if (mission->radiation != NULL) {
        srp_vec3 bodies[SRP_CELESTIAL_COUNT];
        srp_ephemeris_positions(mission->ephemeris, mission->info.central, row.t, bodies);
        const srp_force_state state = {row.t, row.r, row.v, bodies};
        if (srp_force_radiation_probe(mission->radiation, &state, &row.light) != 0) {
            return srp_fail(error, SRP_BAD_DATA, "at t = %.6f s radiation pressure is not defined",
                            row.t);
        }
        row.lit = true;
    }
    return run->watch->row(run->watch->user, mission, &row, error);
}

static srp_status go(runner *run, srp_error *error) {
    const srp_mission *mission = run->mission;
    const srp_mission_info *info = &mission->info;
    const srp_propagator_watch watch = {on_event, on_step, run};
    srp_status status = srp_propagator_start(run->propagator, 0.0, mission->r, mission->v, error);
    if (status == SRP_OK) {
        status = give_row(run, error);
    }
    const double whole = floor(info->duration / info->step * (1.0 + 1e-12));
    for (double k = 1.0; status == SRP_OK && k <= whole + 1.0; k += 1.0) {
        /* The last row is the end, also where the step does not divide the duration. */
        const double t = fmin(k * info->step, info->duration);
        if (t == srp_propagator_time(run->propagator)) {
            break;
        }
        status = srp_propagator_advance(run->propagator, t, &watch, error);
        if (run->fell) {
            return srp_fail(error, SRP_BAD_DATA,
                            "at t = %.3f s the orbit meets the surface of the central body (%s)",
                            srp_propagator_time(run->propagator),
                            srp_celestial_get(info->central)->name);
        }
        if (status == SRP_OK) {
            status = give_row(run, error);
        }
    }
    return status;
}

/* Gives what is new to the cache. What goes wrong is said when the mission is destroyed, which
 * tries again. */
static void share_nodes(const srp_mission *mission) {
    srp_error why;
    if (mission->demand != NULL && srp_demand_count(mission->demand).computed > 0) {
        srp_status status = srp_demand_flush(mission->demand, &why);
        (void)status;
    }
}

static void sum_up(const runner *run, srp_mission_summary *sum) {
    const srp_mission *mission = run->mission;
    const srp_demand_counts none = {0, 0, 0, 0}, nodes = mission->demand != NULL
                                                             ? srp_demand_count(mission->demand)
                                                             : none;
    sum->nodes_total = nodes.total;
    sum->nodes_computed = nodes.computed;
    sum->nodes_cached = nodes.ready - nodes.computed;
    const double t = srp_propagator_time(run->propagator);
    sum->counts = srp_propagator_get_counts(run->propagator);
    sum->impulse = srp_propagator_impulse(run->propagator);
    sum->r = srp_propagator_position(run->propagator);
    sum->v = srp_propagator_velocity(run->propagator);
    sum->in_penumbra += isnan(run->since[0]) ? 0.0 : t - run->since[0];
    sum->in_umbra += isnan(run->since[1]) ? 0.0 : t - run->since[1];
    sum->in_penumbra = fmax(0.0, sum->in_penumbra - sum->in_umbra);
}

/* What happens under way is told of the mission, unless it has a file of its own. What is a wrong
 * argument to the propagator is wrong data here. */
static srp_status tell_of_run(const srp_mission *mission, srp_status status, srp_error *error) {
    status = status == SRP_BAD_ARGUMENT ? SRP_BAD_DATA : status;
    if (status == SRP_BAD_DATA && error != NULL && error->file[0] == '\0') {
        const srp_error what = *error;
        return srp_fail_at(error, status, mission->info.file, 0, 0, "%s", what.message);
    }
    return status;
}

srp_status srp_mission_run(const srp_mission *mission, const srp_mission_watch *watch,
                           srp_mission_summary *out, srp_error *error) {
    runner run = {.mission = mission, .watch = watch, .since = {NAN, NAN}};
    srp_status status =
        srp_propagator_create(mission->forces, &mission->propagator, &run.propagator, error);
    if (status != SRP_OK) {
        return status;
    }
    share_nodes(mission);
    status = go(&run, error);
    if (status == SRP_OK) {
        sum_up(&run, &run.summary);
        *out = run.summary;
    } else if (status != SRP_CANCELLED && mission_failure_get(mission->failure, error)) {
        status = error != NULL ? error->status : SRP_BAD_DATA;
    }
    share_nodes(mission); /* however the run has ended */
    srp_propagator_destroy(run.propagator);
    return tell_of_run(mission, status, error);
}
