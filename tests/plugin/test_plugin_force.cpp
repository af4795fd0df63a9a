// SPDX-License-Identifier: Apache-2.0
// The force type against a stand-in of GMAT, in the order in which GMAT calls it.
#include "Factory.hpp"
#include "FileManager.hpp"
#include "HighFidelitySRP.hpp"
#include "MessageInterface.hpp"

#include <fstream>
#include <memory>
#include <string>

// Last: libcheck has a macro that is called fail.
#include "../unit/srp_check.h"

extern "C" {
Integer GetFactoryCount();
Factory *GetFactoryPointer(Integer index);
void SetMessageReceiver(MessageReceiver *receiver);
}

static const char BOX_WING[] = SRP_MODELS_DIR "/box-wing.obj";
static const Real EPOCH = 30388.625;
static const Integer MASS_ID = 43;

// Earth at rest, Sun and Moon where they may be, [km, km/day].
struct Sky {
    CelestialBody earth{"Earth", Rvector6(), 6378.1363};
    CelestialBody sun{"Sun", Rvector6(1.2e8, -7.9e7, -3.4e7, 1.1e3, 2.0e3, 900.0), 695990.0};
    CelestialBody luna{"Luna", Rvector6(-2.9e5, 2.1e5, 1.1e5, 0, 0, 0), 1738.2};
    SolarSystem system;
    MessageReceiver messages;
    Sky() {
        system.bodies = {{"Earth", &earth}, {"Sun", &sun}, {"Luna", &luna}};
        MessageInterface::SetMessageReceiver(&messages);
    }
};

static void turn(Spacecraft &sc, Real angle) {
    const Real c = std::cos(angle), s = std::sin(angle);
    const Real rows[3][3] = {{c, s, 0}, {-0.6 * s, 0.6 * c, 0.8}, {0.8 * s, -0.8 * c, 0.6}};
    for (int i = 0; i < 9; ++i) {
        sc.attitude.m[i / 3][i % 3] = rows[i / 3][i % 3];
    }
}

typedef std::unique_ptr<HighFidelitySRP> Force;

static Force clone(const HighFidelitySRP &force) {
    return Force(dynamic_cast<HighFidelitySRP *>(force.Clone()));
}

// As a script makes one.
static Force configured() {
    Force force(new HighFidelitySRP("HighFidelitySRP"));
    force->SetStringParameter("SRPObjFile", BOX_WING);
    force->SetRealParameter("SRPAzimuthStep", 10.0);
    force->SetRealParameter("SRPElevationStep", 10.0);
    force->SetBooleanParameter("SRPCache", false);
    return force;
}

static void introduce(HighFidelitySRP &force, const std::vector<Spacecraft *> &craft,
                      const std::vector<Real> &masses) {
    for (size_t i = 0; i < craft.size(); ++i) {
        force.SetSpaceObject(Integer(i), craft[i]);
        force.SetSatelliteParameter(Integer(i), "ReferenceBody", "Earth");
        force.SetSatelliteParameter(Integer(i), "Mass", masses[i], MASS_ID);
        force.SetSatelliteParameter(Integer(i), "Cr", 1.8, MASS_ID + 3);
    }
}

// A Propagate command, up to its first derivatives (GMAT's order of calls).
static Force started(const HighFidelitySRP &force, Sky &sky, CelestialBody *centre,
                     const std::vector<Spacecraft *> &craft, const std::vector<Real> &masses,
                     bool stm = false, bool a_matrix = false) {
    Force own = clone(force);
    const Integer n = Integer(craft.size());
    Integer dimension = 6 * n, squares = 0;
    for (Spacecraft *sc : craft) {
        const Integer rows = sc->whole["FullSTMRowCount"];
        squares += rows * rows;
    }
    own->SetForceOrigin(centre);
    own->SetSolarSystem(&sky.system);
    own->SetDimension(dimension);
    ck_assert(own->Initialize());
    introduce(*own, craft, masses);
    ck_assert(own->SupportsDerivative(Gmat::CARTESIAN_STATE));
    ck_assert(own->SetStart(Gmat::CARTESIAN_STATE, 0, n, dimension));
    if (stm) {
        ck_assert(own->SupportsDerivative(Gmat::ORBIT_STATE_TRANSITION_MATRIX));
        ck_assert(own->SetStart(Gmat::ORBIT_STATE_TRANSITION_MATRIX, dimension, n, squares));
        dimension += squares;
    }
    if (a_matrix) {
        ck_assert(own->SetStart(Gmat::ORBIT_A_MATRIX, dimension, n, squares));
        dimension += squares;
    }
    own->SetDimension(dimension);
    ck_assert(own->Initialize());
    introduce(*own, craft, masses);
    own->ClearSatelliteParameters("");
    introduce(*own, craft, masses);
    own->SetEpoch(EPOCH);
    return own;
}

static Spacecraft make_craft(const char *name, Real angle) {
    Spacecraft sc(name);
    sc.real["TotalMass"] = 850.0;
    sc.whole["FullSTMRowCount"] = 6;
    turn(sc, angle);
    return sc;
}

// Its attitude stays where it is.
static Spacecraft make_fixed_craft(const char *name, Real angle) {
    Spacecraft sc = make_craft(name, angle);
    sc.kind.BecomeKind("CoordinateSystemFixed");
    return sc;
}

static srp_vec3 acceleration_of(const HighFidelitySRP &force, Integer at) {
    const Real *d = force.GetDerivativeArray() + at;
    return srp_vec3_make(d[0], d[1], d[2]);
}

START_TEST(the_loader_finds_what_it_asks_for) {
    Sky sky;
    MessageReceiver receiver;
    ck_assert_int_eq(GetFactoryCount(), 1);
    ck_assert_ptr_null(GetFactoryPointer(1));
    std::unique_ptr<Factory> factory(GetFactoryPointer(0));
    ck_assert(factory->GetListOfCreatableObjects()[0] == "HighFidelitySRP");
    ck_assert_ptr_null(factory->CreateObject("Drag", "Drag"));
    std::unique_ptr<GmatBase> made(factory->CreateObject("HighFidelitySRP", "HighFidelitySRP"));
    std::unique_ptr<PhysicalModel> other(factory->CreatePhysicalModel("HighFidelitySRP", "X"));
    ck_assert(dynamic_cast<HighFidelitySRP *>(made.get()) != nullptr);
    ck_assert(other->GetName() == "X");
    ck_assert(other->IsUserForce() && other->IsUnique() && other->AttitudeAffectsDynamics());
    SetMessageReceiver(&receiver);
    MessageInterface::ShowMessage("%d", 5);
    ck_assert(receiver.text == "5");
}
END_TEST

START_TEST(fields_are_found_by_name_and_number) {
    HighFidelitySRP force("F");
    int found = 0;
    for (Integer id = 0; id < force.GetParameterCount(); ++id) {
        std::string name;
        try {
            name = force.GetParameterText(id);
        } catch (const std::out_of_range &) {
            continue; // one of the base's
        }
        ++found;
        ck_assert_int_eq(force.GetParameterID(name), id);
        switch (force.GetParameterType(id)) {
        case Gmat::REAL_TYPE:
            force.SetRealParameter(id, force.GetRealParameter(name));
            break;
        case Gmat::INTEGER_TYPE:
            force.SetIntegerParameter(id, force.GetIntegerParameter(name));
            break;
        case Gmat::BOOLEAN_TYPE:
            force.SetBooleanParameter(id, !force.GetBooleanParameter(name));
            break;
        default:
            force.SetStringParameter(id, force.GetStringParameter(name));
        }
    }
    ck_assert_int_eq(found, 20);
    ck_assert(force.GetParameterTypeString(force.GetParameterID("SRPFlux")) == "Real");
    ck_assert(force.GetParameterType(force.GetParameterID("SRPTableFile")) == Gmat::FILENAME_TYPE);
    ck_assert(!force.GetBooleanParameter("SRPOnDemand"));
    bool refused = false;
    try {
        force.SetRealParameter("SRPFlux", -3.0);
    } catch (const ODEModelException &bad) {
        refused = std::string(bad.what()).find("HighFidelitySRP: SRPFlux: found -3") == 0;
    }
    ck_assert(refused);
    ck_assert_double_eq(force.GetRealParameter("SRPFlux"), 1367.0);
}
END_TEST

START_TEST(both_orders_and_two_spacecraft) {
    Sky sky;
    Spacecraft a = make_craft("A", 0.3), b = make_craft("B", 1.1);
    Force force = started(*configured(), sky, &sky.earth, {&a, &b}, {850.0, 212.5});
    Real state[12] = {36607.4, -20921.7, 11.0, 1.5, 2.6, 0.01,
                      -7000.0, 39000.0,  21.0, 0.1, 0.2, 0.3};
    ck_assert(force->GetDerivatives(state, 30.0, 1));
    assert_close(a.asked_at, EPOCH + 30.0 / 86400.0, 0.0, 1e-12);
    const srp_vec3 first = acceleration_of(*force, 3), second = acceleration_of(*force, 9);
    for (int i : {0, 1, 2, 6, 7, 8}) {
        ck_assert_double_eq(force->GetDerivativeArray()[i], 0.0);
    }
    // km/s^2: 30 m^2 at 4.6e-6 N/m^2 on 850 kg.
    ck_assert(srp_vec3_norm(first) > 1e-11 && srp_vec3_norm(first) < 1e-9);
    ck_assert(force->GetDerivatives(state, 30.0, 2));
    assert_vec3_close(acceleration_of(*force, 0), first, 0.0, 0.0);
    assert_vec3_close(acceleration_of(*force, 6), second, 0.0, 0.0);
    assert_vec3_close(acceleration_of(*force, 3), srp_vec3_make(0, 0, 0), 0.0, 0.0);
    ck_assert(!force->GetDerivatives(state, 30.0, 3));
    // One alone.
    Force alone = started(*configured(), sky, &sky.earth, {&b}, {212.5});
    ck_assert(alone->GetDerivatives(state + 6, 30.0, 1));
    assert_vec3_close(acceleration_of(*alone, 3), second, 0.0, 0.0);
}
END_TEST

START_TEST(it_is_what_the_library_says) {
    Sky sky;
    Spacecraft sc = make_craft("A", 0.3);
    Force force = started(*configured(), sky, &sky.earth, {&sc}, {850.0});
    Real r[6] = {36607.4, -20921.7, 11.0, 1.5, 2.6, 0.01};
    ck_assert(force->GetDerivatives(r, 0.0, 1));

    srp_plugin::Settings settings;
    settings.obj_file = BOX_WING;
    settings.azimuth_step_deg = settings.elevation_step_deg = 10.0;
    settings.cache = false;
    const srp_plugin::AreaModel model(settings, [](const std::string &) {});
    const Rvector6 sun = sky.sun.GetState(EPOCH);
    const srp_body earth = {srp_vec3_make(-1e3 * r[0], -1e3 * r[1], -1e3 * r[2]), 6378136.3};
    srp_acceleration_params params = srp_acceleration_params_default();
    params.light.au = 149597870691.0;
    params.sun_radius = 695990e3;
    srp_acceleration_state state = {};
    state.sun = srp_vec3_make(1e3 * (sun[0] - r[0]), 1e3 * (sun[1] - r[1]), 1e3 * (sun[2] - r[2]));
    state.count = 1;
    state.bodies = &earth;
    state.mass = 850.0;
    std::copy(&sc.attitude.m[0][0], &sc.attitude.m[0][0] + 9, &state.matrix[0][0]);
    srp_vec3 a;
    srp_error error;
    assert_ok(srp_acceleration_eval(&params, model.source(), &state, &a, nullptr, &error), error);
    assert_vec3_close(acceleration_of(*force, 3), srp_vec3_scale(1e-3, a), 1e-14, 0.0);
}
END_TEST

START_TEST(mass_follows_the_tank) {
    Sky sky;
    Spacecraft sc = make_craft("A", 0.3);
    Force force = started(*configured(), sky, &sky.earth, {&sc}, {850.0});
    Real state[6] = {36607.4, -20921.7, 11.0, 1.5, 2.6, 0.01};
    ck_assert(force->GetDerivatives(state, 0.0, 1));
    const srp_vec3 full = acceleration_of(*force, 3);
    force->SetSatelliteParameter(0, MASS_ID + 3, 1.0); // Cr: none of ours
    ck_assert(force->GetDerivatives(state, 0.0, 1));
    assert_vec3_close(acceleration_of(*force, 3), full, 0.0, 0.0);
    force->SetSatelliteParameter(0, MASS_ID, 425.0);
    ck_assert(force->GetDerivatives(state, 0.0, 1));
    assert_vec3_close(acceleration_of(*force, 3), srp_vec3_scale(2.0, full), 1e-15, 0.0);
    force->SetSatelliteParameter(0, MASS_ID, 0.0);
    bool refused = false;
    try {
        force->GetDerivatives(state, 0.0, 1);
    } catch (const ODEModelException &bad) {
        refused = std::string(bad.what()).find("spacecraft A: a mass of 0 kg") != std::string::npos;
    }
    ck_assert(refused);
}
END_TEST

// A spacecraft that has this attitude, and how often it is asked for it in a step of three stages
// and a second step of two.
struct Asked {
    int first, second;
};
static Asked asked_in_steps(Spacecraft &sc, Sky &sky) {
    Force force = started(*configured(), sky, &sky.earth, {&sc}, {850.0});
    Real state[6] = {36607.4, -20921.7, 11.0, 1.5, 2.6, 0.01};
    Asked asked;
    sc.asked = 0;
    for (Real dt : {0.0, 10.0, 20.0}) {
        ck_assert(force->GetDerivatives(state, dt, 1));
    }
    asked.first = sc.asked;
    sc.asked = 0;
    force->SetSpaceObject(0, &sc);
    for (Real dt : {0.0, 10.0}) {
        ck_assert(force->GetDerivatives(state, dt, 1));
    }
    asked.second = sc.asked;
    return asked;
}

static void spin(Spacecraft &sc, Real z) {
    sc.kind.BecomeKind("Spinner");
    sc.kind.real = {{"AngularVelocityX", 0.0}, {"AngularVelocityY", 0.0}, {"AngularVelocityZ", z}};
}

START_TEST(attitude_is_asked_for_when_it_can_change) {
    Sky sky;
    Spacecraft sc = make_craft("A", 0.3);
    const struct {
        const char *kind;
        StringArray axes;
        bool constant, follows_orbit;
    } cases[] = {
        {"CoordinateSystemFixed", {"InertialAxes", "MJ2000EqAxes"}, true, false},
        {"CoordinateSystemFixed", {"InertialAxes", "MJ2000EcAxes"}, true, false},
        {"CoordinateSystemFixed", {"InertialAxes", "ICRFAxes"}, false, false},
        {"CoordinateSystemFixed", {"DynamicAxes", "ObjectReferencedAxes"}, false, true},
        {"NadirPointing", {"InertialAxes", "MJ2000EqAxes"}, false, true},
        {"CommandableNadirPointing", {"InertialAxes", "MJ2000EqAxes"}, false, true},
        {"OfAnotherPlugin", {"InertialAxes", "MJ2000EqAxes"}, false, true},
        {"", {"InertialAxes", "MJ2000EqAxes"}, false, true}, // of CommandableNadirPointing itself
        {"ThreeAxisKinematic", {"InertialAxes", "MJ2000EqAxes"}, false, false},
        {"PrecessingSpinner", {"InertialAxes", "MJ2000EqAxes"}, false, false},
        {"SpiceAttitude", {"InertialAxes", "MJ2000EqAxes"}, false, false},
        {"CCSDS-AEM", {"InertialAxes", "MJ2000EqAxes"}, false, false},
    };
    for (const auto &one : cases) {
        sc.kind.BecomeKind(one.kind);
        sc.kind.system.axes = one.axes;
        const Asked asked = asked_in_steps(sc, sky);
        ck_assert_msg(asked.first == (one.constant ? 1 : 3), "%s: %d", one.kind, asked.first);
        ck_assert_msg(asked.second == (one.constant ? 1 : 2), "%s: %d", one.kind, asked.second);
        Force force = started(*configured(), sky, &sky.earth, {&sc}, {850.0});
        ck_assert_msg(force->AttitudeAffectsDynamics() == one.follows_orbit, "%s", one.kind);
    }
    spin(sc, 0.0);
    ck_assert_int_eq(asked_in_steps(sc, sky).first, 1);
    spin(sc, 0.15);
    ck_assert_int_eq(asked_in_steps(sc, sky).first, 3);
    // One of them is enough, and nothing known is not nothing.
    Spacecraft nadir = make_craft("B", 1.1);
    Force force = started(*configured(), sky, &sky.earth, {&sc, &nadir}, {850.0, 212.5});
    ck_assert(force->AttitudeAffectsDynamics());
    ck_assert(configured()->AttitudeAffectsDynamics());
}
END_TEST

// What stays within a step is looked at anew in the next one, in the next Propagate, and in
// reports.
START_TEST(attitude_that_is_changed_is_noticed) {
    Sky sky;
    Spacecraft sc = make_fixed_craft("A", 0.3);
    Real state[6] = {36607.4, -20921.7, 11.0, 1.5, 2.6, 0.01};
    Force force = started(*configured(), sky, &sky.earth, {&sc}, {850.0});
    const auto now = [&](HighFidelitySRP &of, Real dt) {
        ck_assert(of.GetDerivatives(state, dt, 1));
        return acceleration_of(of, 3);
    };
    const srp_vec3 before = now(*force, 0.0);
    turn(sc, 1.1);
    assert_vec3_close(now(*force, 0.0), before, 0.0, 0.0); // nobody turns it within a step
    std::copy(state, state + 6, sc.state.values);
    sc.epoch = EPOCH;
    const Rvector6 reported = force->GetDerivativesForSpacecraft(&sc);
    const srp_vec3 after = srp_vec3_make(reported[3], reported[4], reported[5]);
    ck_assert(srp_vec3_norm(srp_vec3_sub(after, before)) > 0.01 * srp_vec3_norm(before));
    force->SetSpaceObject(0, &sc);
    assert_vec3_close(now(*force, 0.0), after, 1e-12, 0.0);
    // The next command, with a clone of its own; a copy does not remember either.
    turn(sc, 0.3);
    assert_vec3_close(now(*started(*force, sky, &sky.earth, {&sc}, {850.0}), 0.0), before, 0.0,
                      0.0);
    // Another spacecraft in its place, and another kind of attitude.
    Spacecraft other = make_fixed_craft("B", 1.1);
    force->SetSpaceObject(0, &other);
    assert_vec3_close(now(*force, 0.0), after, 1e-12, 0.0);
    spin(other, 0.15);
    force->SetSpaceObject(0, &other);
    now(*force, 0.0);
    turn(other, 0.3);
    assert_vec3_close(now(*force, 10.0), before, 1e-5, 0.0);
}
END_TEST

// A burn: the tank empties at each stage while the attitude stays.
START_TEST(a_burn_changes_the_mass_at_each_stage) {
    Sky sky;
    Spacecraft sc = make_fixed_craft("A", 0.3);
    Real state[6] = {36607.4, -20921.7, 11.0, 1.5, 2.6, 0.01};
    Force force = started(*configured(), sky, &sky.earth, {&sc}, {850.0});
    ck_assert(force->GetDerivatives(state, 0.0, 1));
    const srp_vec3 full = acceleration_of(*force, 3);
    for (Real mass : {850.0, 425.0, 212.5}) {
        force->SetSatelliteParameter(0, MASS_ID, mass);
        ck_assert(force->GetDerivatives(state, 0.0, 1));
        assert_vec3_close(acceleration_of(*force, 3), srp_vec3_scale(850.0 / mass, full), 1e-15,
                          0.0);
    }
}
END_TEST

START_TEST(the_centre_is_any_body) {
    Sky sky;
    Spacecraft sc = make_craft("A", 0.3);
    const Real at_earth[6] = {36607.4, -20921.7, 11.0, 1.5, 2.6, 0.01};
    srp_vec3 want = {0, 0, 0};
    for (CelestialBody *centre : {&sky.earth, &sky.luna, &sky.sun}) {
        Force conf = configured();
        conf->SetStringParameter("SRPShadowBodies", "Earth, Luna");
        Force force = started(*conf, sky, centre, {&sc}, {850.0});
        const Rvector6 origin = centre->GetState(EPOCH);
        Real state[6];
        for (int i = 0; i < 6; ++i) {
            state[i] = at_earth[i] - origin[i];
        }
        ck_assert(force->GetDerivatives(state, 0.0, 1));
        if (centre == &sky.earth) {
            want = acceleration_of(*force, 3);
        }
        assert_vec3_close(acceleration_of(*force, 3), want, 1e-9, 0.0);
        // For reports: GMAT's own state is Earth-centred.
        sc.epoch = EPOCH;
        std::copy(at_earth, at_earth + 6, sc.state.values);
        const Rvector6 d = force->GetDerivativesForSpacecraft(&sc);
        assert_vec3_close(srp_vec3_make(d[3], d[4], d[5]), want, 1e-9, 0.0);
        ck_assert_double_eq(d[0], 0.0);
    }
}
END_TEST

// Behind a body as seen from the Sun.
static void hide_behind(const CelestialBody &body, Sky &sky, Real distance, Real *state) {
    const Rvector6 b = body.GetState(EPOCH), s = sky.sun.GetState(EPOCH);
    const Real d[3] = {b[0] - s[0], b[1] - s[1], b[2] - s[2]};
    const Real n = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int i = 0; i < 3; ++i) {
        state[i] = b[i] + distance * d[i] / n;
    }
}

START_TEST(bodies_cast_the_shadows_that_are_asked_for) {
    Sky sky;
    Spacecraft sc = make_craft("A", 0.3);
    Real behind_earth[6] = {0, 0, 0, 0, 0, 0}, behind_luna[6] = {0, 0, 0, 0, 0, 0};
    hide_behind(sky.earth, sky, 42164.0, behind_earth);
    hide_behind(sky.luna, sky, 3000.0, behind_luna);
    const struct {
        const char *bodies;
        bool earth, luna;
    } cases[] = {{"CentralBody", true, false},
                 {"None", false, false},
                 {"{Earth, Luna}", true, true},
                 {"Luna", false, true}};
    for (const auto &one : cases) {
        Force conf = configured();
        conf->SetStringParameter("SRPShadowBodies", one.bodies);
        Force force = started(*conf, sky, &sky.earth, {&sc}, {850.0});
        ck_assert(force->GetDerivatives(behind_earth, 0.0, 1));
        ck_assert_msg((srp_vec3_norm(acceleration_of(*force, 3)) == 0.0) == one.earth, "%s",
                      one.bodies);
        ck_assert(force->GetDerivatives(behind_luna, 0.0, 1));
        ck_assert_msg((srp_vec3_norm(acceleration_of(*force, 3)) == 0.0) == one.luna, "%s",
                      one.bodies);
    }
}
END_TEST

START_TEST(partials_go_to_their_places) {
    Sky sky;
    Spacecraft a = make_craft("A", 0.3), b = make_craft("B", 1.1);
    a.whole["FullSTMRowCount"] = 7;
    Force force = started(*configured(), sky, &sky.earth, {&a, &b}, {850.0, 425.0}, true, true);
    const Integer size = 12 + 2 * (49 + 36);
    Real state[size] = {36607.4, -20921.7, 11.0, 1.5, 2.6, 0.01,
                        -7000.0, 39000.0,  21.0, 0.1, 0.2, 0.3};
    ck_assert(force->GetDerivatives(state, 0.0, 1));
    const std::vector<Real> got(force->GetDerivativeArray(), force->GetDerivativeArray() + size);
    const Integer begin[2] = {12, 12 + 49}, rows[2] = {7, 6};
    std::vector<bool> used(size_t(size), false);
    for (Integer k = 0; k < 2; ++k) {
        for (Integer j = 0; j < 3; ++j) {
            const Real h = 2000.0;
            Real moved[size] = {};
            std::copy(state, state + 12, moved);
            moved[6 * k + j] += h;
            ck_assert(force->GetDerivatives(moved, 0.0, 1));
            const srp_vec3 up = acceleration_of(*force, 6 * k + 3);
            moved[6 * k + j] -= 2.0 * h;
            ck_assert(force->GetDerivatives(moved, 0.0, 1));
            const srp_vec3 down = acceleration_of(*force, 6 * k + 3);
            const Real slope[3] = {(up.x - down.x) / (2 * h), (up.y - down.y) / (2 * h),
                                   (up.z - down.z) / (2 * h)};
            for (Integer i = 0; i < 3; ++i) {
                for (Integer block : {0, 85}) {
                    const Integer at = begin[k] + block + (3 + i) * rows[k] + j;
                    used[size_t(at)] = true;
                    assert_close(got[size_t(at)], slope[i], 1e-4, 1e-22);
                }
            }
        }
    }
    for (Integer i = 12; i < size; ++i) {
        ck_assert_msg(used[size_t(i)] || got[size_t(i)] == 0.0, "element %d is %g", i,
                      got[size_t(i)]);
    }
}
END_TEST

START_TEST(clones_trace_once) {
    Sky sky;
    Spacecraft sc = make_craft("A", 0.3);
    Real state[6] = {36607.4, -20921.7, 11.0, 1.5, 2.6, 0.01};
    {
        Force conf = configured();
        Force first = started(*conf, sky, &sky.earth, {&sc}, {850.0});
        Force second = started(*first, sky, &sky.earth, {&sc}, {850.0});
        HighFidelitySRP third("T");
        third = *second;
        third.SetForceOrigin(&sky.earth);
        third.SetSolarSystem(&sky.system);
        ck_assert(third.Initialize());
        ck_assert(first->GetDerivatives(state, 0.0, 1));
        ck_assert(second->GetDerivatives(state, 0.0, 1));
        assert_vec3_close(acceleration_of(*second, 3), acceleration_of(*first, 3), 0.0, 0.0);
        ck_assert(sky.messages.text == "");
        // A clone whose field is set goes its own way; the others keep theirs.
        Force other = clone(*second);
        other->SetRealParameter("SRPScaleFactor", 0.5);
        Force run = started(*other, sky, &sky.earth, {&sc}, {850.0});
        ck_assert(run->GetDerivatives(state, 0.0, 1));
        assert_vec3_close(acceleration_of(*run, 3), srp_vec3_scale(0.5, acceleration_of(*first, 3)),
                          1e-15, 0.0);
        ck_assert(first->GetDerivatives(state, 0.0, 1));
    }
    // Told once for each model, at its end.
    size_t told = 0, at = 0;
    while ((at = sky.messages.text.find("directions traced", at)) != std::string::npos) {
        ++told;
        ++at;
    }
    ck_assert_uint_eq(told, 2);
}
END_TEST

START_TEST(files_lie_beside_the_script) {
    Sky sky;
    Spacecraft sc = make_craft("A", 0.3);
    Force force = configured();
    force->SetStringParameter("SRPObjFile", "box-wing.obj");
    FileManager::Instance()->directory = SRP_MODELS_DIR;
    Force own = started(*force, sky, &sky.earth, {&sc}, {850.0});
    FileManager::Instance()->directory = "";
    bool refused = false;
    try {
        started(*force, sky, &sky.earth, {&sc}, {850.0});
    } catch (const ODEModelException &bad) {
        refused = std::string(bad.what()).find("HighFidelitySRP: SRPObjFile: box-wing.obj") == 0;
    }
    ck_assert(refused);
    // It stays as the script says it.
    ck_assert(force->GetStringParameter("SRPObjFile") == "box-wing.obj");
}
END_TEST

// GMAT's own, as far as it matters here.
class Spherical : public HighFidelitySRP {
  public:
    std::string GetTypeName() const {
        return "SolarRadiationPressure";
    }
};

static std::string stops(HighFidelitySRP &force) {
    try {
        force.Initialize();
    } catch (const ODEModelException &bad) {
        return bad.what();
    }
    return "";
}

START_TEST(what_is_missing_is_said) {
    Sky sky;
    Spacecraft sc = make_craft("A", 0.3);
    Real state[6] = {36607.4, -20921.7, 11.0, 1.5, 2.6, 0.01};
    Force force = configured();
    ck_assert(!force->GetDerivatives(state, 0.0, 1));
    ck_assert(stops(*force).find("no solar system") != std::string::npos);
    force->SetSolarSystem(&sky.system);
    force->SetStringParameter("SRPShadowBodies", "Vulcan");
    ck_assert(stops(*force).find("there is no body 'Vulcan'") != std::string::npos);
    force->SetStringParameter("SRPShadowBodies", "CentralBody");
    ck_assert(stops(*force) == "");
    ck_assert(force->SetStart(Gmat::CARTESIAN_STATE, 0, 1, 6));
    ck_assert(!force->SetStart(Gmat::MASS_FLOW, 0, 1, 1));
    ck_assert(!force->SupportsDerivative(Gmat::MASS_FLOW));
    bool refused = false;
    try {
        force->GetDerivatives(state, 0.0, 1);
    } catch (const ODEModelException &bad) {
        refused = std::string(bad.what()).find("only 0 spacecraft") != std::string::npos;
    }
    ck_assert(refused);
    sky.system.bodies.erase("Sun");
    ck_assert(stops(*force).find("lacks the Sun") != std::string::npos);
}
END_TEST

// Copies know the force model of the script that their original is of, and who flies by them.
START_TEST(messages_name_force_model_and_spacecraft) {
    Sky sky;
    Spacecraft a = make_craft("A", 0.3), b = make_craft("B", 1.1);
    Spherical spherical;
    ODEModel with("FM"), without("Other"), bare("Bare");
    Real state[12] = {36607.4, -20921.7, 11.0, 1.5, 2.6, 0.01,
                      -7000.0, 39000.0,  21.0, 0.1, 0.2, 0.3};
    {
        Force force = configured(), alone = configured();
        with.forces = {&spherical, force.get()};
        without.forces = {alone.get()};
        bare.forces = {&spherical};
        ConfigManager::Instance()->models = {&bare, &without, &with};
        Force own = started(*force, sky, &sky.earth, {&a, &b}, {850.0, 212.5});
        ck_assert(sky.messages.text == "");
        ck_assert(own->GetDerivatives(state, 0.0, 1));
        ck_assert_msg(sky.messages.text == "HighFidelitySRP: A, B: FM.SRP is On as well: the Sun "
                                           "pushes twice\n",
                      "%s", sky.messages.text.c_str());
        // Not for every copy, and not where it is off.
        Force again = started(*force, sky, &sky.earth, {&a}, {850.0});
        ck_assert(again->GetDerivatives(state, 0.0, 1));
        Force other = started(*alone, sky, &sky.earth, {&b}, {850.0});
        ck_assert(other->GetDerivatives(state, 0.0, 1));
        ck_assert(sky.messages.text.find("twice") == sky.messages.text.rfind("twice"));
        alone->SetStringParameter("SRPObjFile", "nowhere.obj");
        Force broken = clone(*alone);
        broken->SetForceOrigin(&sky.earth);
        broken->SetSolarSystem(&sky.system);
        ck_assert(stops(*broken).find("nowhere.obj") != std::string::npos);
        ck_assert(stops(*broken).find(" (force model Other)") != std::string::npos);
        ConfigManager::Instance()->models.clear();
    }
    // At the end of the models.
    ck_assert(sky.messages.text.find("HighFidelitySRP: A, B: ") != std::string::npos);
    ck_assert(sky.messages.text.find("HighFidelitySRP: B: ") != std::string::npos);
}
END_TEST

int main() {
    Suite *suite = suite_create("plugin_force");
    TCase *tcase = tcase_create("plugin_force");
    tcase_add_test(tcase, the_loader_finds_what_it_asks_for);
    tcase_add_test(tcase, fields_are_found_by_name_and_number);
    tcase_add_test(tcase, both_orders_and_two_spacecraft);
    tcase_add_test(tcase, it_is_what_the_library_says);
    tcase_add_test(tcase, mass_follows_the_tank);
    tcase_add_test(tcase, attitude_is_asked_for_when_it_can_change);
    tcase_add_test(tcase, attitude_that_is_changed_is_noticed);
    tcase_add_test(tcase, a_burn_changes_the_mass_at_each_stage);
    tcase_add_test(tcase, the_centre_is_any_body);
    tcase_add_test(tcase, bodies_cast_the_shadows_that_are_asked_for);
    tcase_add_test(tcase, partials_go_to_their_places);
    tcase_add_test(tcase, clones_trace_once);
    tcase_add_test(tcase, files_lie_beside_the_script);
    tcase_add_test(tcase, what_is_missing_is_said);
    tcase_add_test(tcase, messages_name_force_model_and_spacecraft);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
