/* SPDX-License-Identifier: Apache-2.0 */
/* Shadow edges and apsides: where they are, that none is missed, that steps end on them. */
#include "mat3.h"
#include "orbit_fixture.h"
#include "shadow_edges.h"

#include <gsl/gsl_errno.h>

static const double DAY = 86400.0;

enum { EVENTS_MAX = 2000 };

typedef struct diary {
    srp_event events[EVENTS_MAX];
    size_t count;
} diary;

static void write_down(void *user, const srp_event *event) {
    diary *d = user;
    ck_assert(d->count < EVENTS_MAX);
    d->events[d->count++] = *event;
}

typedef struct run {
    srp_ephemeris *sky;
    srp_force_list *list;
    srp_propagator_params params;
} run;

static run begin(const char *date, double days) {
    run out;
    gsl_set_error_handler_off();
    srp_force force;
    srp_area_model ball;
    srp_error error;
    out.sky = fixture_sky(date, days);
    out.list = fixture_list(out.sky, true);
    srp_radiation_params radiation = fixture_radiation(NULL);
    assert_ok(srp_area_model_cannonball(1.5, 20.0, &ball, &error), error);
    radiation.model = ball;
    out.params = srp_propagator_params_default();
    out.params.shadow_edges = true;
    out.params.apsides = true;
    out.params.shadow = radiation.shadow;
    assert_ok(srp_force_radiation(&radiation, &force, &error), error);
    fixture_add(out.list, &force);
    return out;
}

static void end(run *r) {
    srp_force_list_destroy(r->list);
    srp_ephemeris_destroy(r->sky);
}

/* From `from` to `to`; where it ends. */
static srp_vec3 propagate(const run *r, srp_vec3 at, srp_vec3 v, double from, double to, diary *d,
                          srp_propagator_counts *counts) {
    srp_propagator *p = NULL;
    srp_error error;
    const srp_propagator_watch watch = {write_down, NULL, d};
    d->count = 0;
    assert_ok(srp_propagator_create(r->list, &r->params, &p, &error), error);
    assert_ok(srp_propagator_start(p, from, at, v, &error), error);
    assert_ok(srp_propagator_advance(p, to, &watch, &error), error);
    const srp_vec3 out = srp_propagator_position(p);
    if (counts != NULL) {
        *counts = srp_propagator_get_counts(p);
    }
    srp_propagator_destroy(p);
    return out;
}

static size_t count_of(const diary *d, srp_event_kind kind) {
    size_t n = 0;
    for (size_t i = 0; i < d->count; ++i) {
        n += d->events[i].kind == kind;
    }
    return n;
}

/* A second outside a penumbra the Sun is whole, a second inside it is not; in the umbra nothing of
 * it is left. Says srp_sunlight_fraction(), which knows nothing of edges. */
static void check_light(const run *r, const srp_event *e, size_t body) {
    const srp_shadow alone = {r->params.shadow.sun_radius,
                              1,
                              {r->params.shadow.body[body]},
                              {r->params.shadow.radius[body]}};
    const bool entry = (e->kind - SRP_EVENT_PENUMBRA_ENTRY) % 2 == 0;
    double seen[2]; /* outside, inside */
    for (int k = 0; k < 2; ++k) {
        const double dt = (k == 1) == entry ? 1.0 : -1.0;
        srp_vec3 bodies[SRP_CELESTIAL_COUNT];
        srp_ephemeris_positions(r->sky, SRP_EARTH, e->t + dt, bodies);
        seen[k] = srp_shadow_fraction(&alone, srp_vec3_add_scaled(e->r, dt, e->v), bodies);
    }
    if (e->kind <= SRP_EVENT_PENUMBRA_EXIT) {
        ck_assert_msg(seen[0] == 1.0 && seen[1] < 1.0, "%g %g", seen[0], seen[1]);
    } else if (e->kind <= SRP_EVENT_UMBRA_EXIT) {
        ck_assert_msg(seen[0] > 0.0 && seen[1] == 0.0, "%g %g", seen[0], seen[1]);
    }
}

/* Every edge is one: the disks touch there. */
static void check_edges(const run *r, const diary *d) {
    srp_edges edges = {r->list, &r->params.shadow, {false}};
    for (size_t i = 0; i < d->count; ++i) {
        const srp_event *e = &d->events[i];
        if (e->kind >= SRP_EVENT_PERIAPSIS) {
            assert_close(srp_vec3_dot(srp_unit(e->r), srp_unit(e->v)), 0.0, 0.0, 1e-9);
            continue;
        }
        size_t body = 0;
        while (r->params.shadow.body[body] != e->body) {
            ++body;
        }
        const int edge = (int)(3 * body) + (int)(e->kind - SRP_EVENT_PENUMBRA_ENTRY) / 2;
        assert_close(srp_edges_depth(&edges, edge, e->t, e->r), 0.0, 0.0, 1e-9);
        check_light(r, e, body);
        /* Going in is going deeper. */
        const bool deeper =
            srp_edges_depth(&edges, edge, e->t + 0.1, srp_vec3_add_scaled(e->r, 0.1, e->v)) > 0.0;
        ck_assert_int_eq(deeper, (e->kind - SRP_EVENT_PENUMBRA_ENTRY) % 2 == 0);
    }
}

static const srp_vec3 GEO_R = {36607358.26, -20921723.7, 0.0};
static const srp_vec3 GEO_V = {1525.6345, 2669.4515, 12.3456};

START_TEST(geo_eclipses_are_all_found) {
    static diary d;
    run r = begin("2024-03-20T00:00:00 UTC", 10.0);
    propagate(&r, GEO_R, GEO_V, 0.0, 10.0 * DAY, &d, NULL);
    ck_assert_uint_eq(count_of(&d, SRP_EVENT_PENUMBRA_ENTRY), 10);
    ck_assert_uint_eq(count_of(&d, SRP_EVENT_UMBRA_ENTRY), 10);
    ck_assert_uint_eq(count_of(&d, SRP_EVENT_UMBRA_EXIT), 10);
    ck_assert_uint_eq(count_of(&d, SRP_EVENT_PENUMBRA_EXIT), 10);
    check_edges(&r, &d);
    end(&r);
}
END_TEST

/* The end of the season: the last shadows are penumbras alone; two looks a minute see no more than
 * the events do. */
START_TEST(grazing_shadows_are_not_missed) {
    static diary d;
    run r = begin("2024-04-08T00:00:00 UTC", 10.0);
    propagate(&r, GEO_R, GEO_V, 0.0, 10.0 * DAY, &d, NULL);
    check_edges(&r, &d);
    srp_propagator *p = NULL;
    srp_error error;
    srp_propagator_params params = r.params;
    params.shadow_edges = params.apsides = false;
    assert_ok(srp_propagator_create(r.list, &params, &p, &error), error);
    assert_ok(srp_propagator_start(p, 0.0, GEO_R, GEO_V, &error), error);
    srp_edges edges = {r.list, &r.params.shadow, {false}};
    size_t entries[2] = {0, 0}, shortest = SIZE_MAX, now = 0;
    bool inside[2] = {false, false};
    for (double t = 0.0; t <= 10.0 * DAY; t += 30.0) {
        assert_ok(srp_propagator_advance(p, t, NULL, &error), error);
        for (int k = 0; k < 2; ++k) {
            const bool is = srp_edges_depth(&edges, k, t, srp_propagator_position(p)) > 0.0;
            entries[k] += is && !inside[k];
            if (k == 0 && inside[0] && !is) {
                shortest = now < shortest ? now : shortest;
            }
            now = k == 0 && is ? now + 1 : k == 0 ? 0 : now;
            inside[k] = is;
        }
    }
    printf("grazing: %zu penumbras, %zu umbras, the shortest about %zu s\n", entries[0], entries[1],
           30 * shortest);
    ck_assert_uint_gt(entries[0], entries[1]);
    ck_assert_uint_eq(count_of(&d, SRP_EVENT_PENUMBRA_ENTRY), entries[0]);
    ck_assert_uint_eq(count_of(&d, SRP_EVENT_UMBRA_ENTRY), entries[1]);
    srp_propagator_destroy(p);
    end(&r);
}
END_TEST

/* A shadow between two looks: 2 h of an orbit, 8 looks, and a penumbra that is left a minute after
 * it is entered. The body's size is chosen so. */
START_TEST(a_brief_shadow_within_a_step_is_found) {
    run r = begin("2024-03-20T00:00:00 UTC", 0.5);
    const double a = 42164e3, n = sqrt(FIXTURE_MU / (a * a * a)), t0 = 3000.0, h = 7200.0;
    const srp_vec3 behind =
        srp_unit(srp_vec3_scale(-1.0, srp_ephemeris_position(r.sky, SRP_SUN, t0 + 0.53 * h)));
    const srp_vec3 along = srp_unit(srp_vec3_cross(srp_axis(2), behind));
    const srp_vec3 tilted =
        srp_unit(srp_vec3_add_scaled(behind, 0.1, srp_vec3_cross(behind, along)));
    srp_arc arc = {.t = t0, .h = h};
    for (int k = 0; k < 2; ++k) {
        const double phi = n * h * (k - 0.53);
        arc.r[k] =
            srp_vec3_add(srp_vec3_scale(a * cos(phi), tilted), srp_vec3_scale(a * sin(phi), along));
        arc.v[k] = srp_vec3_add(srp_vec3_scale(-a * n * sin(phi), tilted),
                                srp_vec3_scale(a * n * cos(phi), along));
        arc.a[k] = srp_vec3_scale(-n * n, arc.r[k]);
    }
    srp_edges edges = {r.list, &r.params.shadow, {false}};
    double share = 0.0, low = 1e6, high = 1e7;
    for (int i = 0; i < 60; ++i) { /* the size at which the shadow is just touched */
        r.params.shadow.radius[0] = 0.5 * (low + high);
        double deepest = -1.0;
        for (int k = 0; k <= 4000; ++k) {
            deepest = fmax(deepest, srp_edges_depth(&edges, 0, t0 + h * k / 4000.0,
                                                    srp_arc_position(&arc, k / 4000.0)));
        }
        *(deepest > 0.0 ? &high : &low) = r.params.shadow.radius[0];
    }
    r.params.shadow.radius[0] = high * (1.0 - 1e-5);
    ck_assert_int_eq(srp_edges_first(&edges, &arc, &share), -1);
    r.params.shadow.radius[0] = high * (1.0 + 1e-5);
    ck_assert_int_eq(srp_edges_first(&edges, &arc, &share), 0);
    const double entry = share;
    edges.inside[0] = true; /* and from there out of it */
    arc.t = t0;
    double out = entry;
    while (srp_edges_depth(&edges, 0, t0 + h * (out + 1e-5), srp_arc_position(&arc, out + 1e-5)) >
           0.0) {
        out += 1e-5;
    }
    printf("a shadow of %.0f s in a step of %.0f s\n", (out - entry) * h, h);
    ck_assert((out - entry) * h < h / 8.0 / 2.0);
    assert_close(srp_edges_depth(&edges, 0, t0 + h * entry, srp_arc_position(&arc, entry)), 0.0,
                 0.0, 1e-12);
    end(&r);
}
END_TEST

START_TEST(leo_has_one_a_revolution) {
    static diary d;
    run r = begin("2024-03-20T00:00:00 UTC", 1.0);
    const double a = 7000e3, speed = sqrt(FIXTURE_MU / a);
    const srp_vec3 at = {a, 0, 0}, v = {0, speed * cos(0.9), speed * sin(0.9)};
    srp_propagator_counts with, without;
    const srp_vec3 there = propagate(&r, at, v, 0.0, DAY, &d, &with);
    const double revolutions = DAY / (2.0 * SRP_PI * sqrt(a * a * a / FIXTURE_MU));
    ck_assert(fabs((double)count_of(&d, SRP_EVENT_UMBRA_ENTRY) - revolutions) <= 1.0);
    check_edges(&r, &d);
    /* Finer steps go to the same place; without the edges, fewer digits. */
    run fine = r;
    fine.params.max_step = 10.0;
    fine.params.tolerance = 1e-14;
    const srp_vec3 exact = propagate(&fine, at, v, 0.0, DAY, &d, NULL);
    run blind = r;
    blind.params.shadow_edges = false;
    blind.params.fixed_step = 60.0;
    const srp_vec3 off = propagate(&blind, at, v, 0.0, DAY, &d, &without);
    printf("LEO, a day: %.3f mm from steps of 10 s (%llu steps); steps of 60 s that know no edges: "
           "%.0f mm\n",
           1e3 * srp_vec3_norm(srp_vec3_sub(there, exact)), (unsigned long long)with.steps,
           1e3 * srp_vec3_norm(srp_vec3_sub(off, exact)));
    assert_vec3_close(there, exact, 0.0, 10e-3);
    end(&r);
}
END_TEST

START_TEST(events_are_the_same_backwards) {
    static diary there, back;
    run r = begin("2024-03-20T00:00:00 UTC", 3.0);
    srp_propagator *p = NULL;
    srp_error error;
    srp_propagator_watch watch = {write_down, NULL, &there};
    there.count = back.count = 0;
    assert_ok(srp_propagator_create(r.list, &r.params, &p, &error), error);
    assert_ok(srp_propagator_start(p, 0.0, GEO_R, GEO_V, &error), error);
    assert_ok(srp_propagator_advance(p, 3.0 * DAY, &watch, &error), error);
    watch.user = &back;
    assert_ok(srp_propagator_advance(p, 0.0, &watch, &error), error);
    ck_assert_uint_eq(there.count, back.count);
    ck_assert_uint_ge(there.count, 12);
    for (size_t i = 0; i < there.count; ++i) {
        const srp_event *a = &there.events[i], *b = &back.events[back.count - 1 - i];
        ck_assert_int_eq(a->kind, b->kind);
        /* On a circle, nearly, an apsis is where a last digit says. */
        assert_close(a->t, b->t, 0.0, a->kind >= SRP_EVENT_PERIAPSIS ? 1e-2 : 1e-4);
    }
    srp_propagator_destroy(p);
    end(&r);
}
END_TEST

/* The Moon's shadow on 8 April 2024 fell on the Earth: one who flies 300 km above the place of the
 * greatest eclipse (25.3 N, 104.1 W, 18:17 UTC) stands in it. */
START_TEST(the_moon_eclipses_too) {
    static diary d;
    run r = begin("2024-04-08T17:00:00 UTC", 0.2);
    const double when = 77.0 * 60.0 + 18.0, a = 6678e3, speed = sqrt(FIXTURE_MU / a);
    const srp_vec3 sun = srp_ephemeris_position(r.sky, SRP_SUN, when);
    const srp_vec3 moon = srp_ephemeris_position(r.sky, SRP_MOON, when);
    /* Where the axis of the shadow meets the sphere of 6678 km. */
    const srp_vec3 n = srp_unit(srp_vec3_sub(moon, sun));
    const double along = srp_vec3_dot(moon, n);
    const double miss2 = srp_vec3_dot(moon, moon) - along * along;
    ck_assert(miss2 < a * a);
    const srp_vec3 at = srp_vec3_add_scaled(moon, -along - sqrt(a * a - miss2), n);
    const srp_vec3 v = srp_vec3_scale(speed, srp_unit(srp_vec3_cross(srp_axis(2), at)));
    r.params.shadow.body[1] = SRP_MOON;
    r.params.shadow.radius[1] = 1738.2e3;
    r.params.shadow.count = 2;
    /* From the middle of the shadow an hour on and an hour back. */
    propagate(&r, at, v, when, when + 3600.0, &d, NULL);
    check_edges(&r, &d);
    size_t of_moon = 0;
    for (size_t i = 0; i < d.count; ++i) {
        if (d.events[i].body == SRP_MOON) {
            ck_assert_int_eq(d.events[i].kind % 2, 1); /* exits */
            ++of_moon;
        }
    }
    ck_assert_uint_eq(of_moon, 2);
    end(&r);
}
END_TEST

START_TEST(apsides_alternate) {
    static diary d;
    run r = begin("2024-06-20T00:00:00 UTC", 3.0);
    const srp_elements el = {26600e3, 0.73, 1.1, 0.5, 4.7, 0.3};
    srp_vec3 at, v;
    srp_error error;
    assert_ok(srp_elements_to_state(FIXTURE_MU, &el, &at, &v, &error), error);
    propagate(&r, at, v, 0.0, 3.0 * DAY, &d, NULL);
    check_edges(&r, &d);
    srp_event_kind last = SRP_EVENT_PERIAPSIS;
    for (size_t i = 0; i < d.count; ++i) {
        if (d.events[i].kind >= SRP_EVENT_PERIAPSIS) {
            ck_assert_int_ne(d.events[i].kind, last);
            last = d.events[i].kind;
            const double radius = srp_vec3_norm(d.events[i].r);
            assert_close(radius, last == SRP_EVENT_PERIAPSIS ? 26600e3 * 0.27 : 26600e3 * 1.73,
                         0.02, 0.0);
        }
    }
    ck_assert_uint_eq(count_of(&d, SRP_EVENT_PERIAPSIS) + count_of(&d, SRP_EVENT_APOAPSIS), 12);
    end(&r);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("orbit_events");
    TCase *all = tcase_create("events");
    tcase_add_test(all, geo_eclipses_are_all_found);
    tcase_add_test(all, grazing_shadows_are_not_missed);
    tcase_add_test(all, a_brief_shadow_within_a_step_is_found);
    tcase_add_test(all, leo_has_one_a_revolution);
    tcase_add_test(all, events_are_the_same_backwards);
    tcase_add_test(all, the_moon_eclipses_too);
    tcase_add_test(all, apsides_alternate);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
