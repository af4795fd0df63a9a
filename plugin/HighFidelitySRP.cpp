// SPDX-License-Identifier: Apache-2.0
#include "HighFidelitySRP.hpp"

#include "FileManager.hpp"
#include "MessageInterface.hpp"
#include "ODEModelException.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>

using srp_plugin::Field;
using srp_plugin::Settings;

namespace {

const char TYPE_NAME[] = "HighFidelitySRP";
const double METRES_PER_KM = 1000.0, SECONDS_PER_DAY = 86400.0;

[[noreturn]] void fail(const std::string &words) {
    throw ODEModelException(std::string(TYPE_NAME) + ": " + words);
}

void show(const std::string &words) {
    MessageInterface::ShowMessage("%s: %s\n", TYPE_NAME, words.c_str());
}

std::vector<std::string> names_of(const std::vector<GmatBase *> &objects) {
    std::vector<std::string> names;
    for (const GmatBase *one : objects) {
        names.push_back(one->GetName());
    }
    return names;
}

srp_vec3 metres(Real x, Real y, Real z) {
    return srp_vec3_make(METRES_PER_KM * x, METRES_PER_KM * y, METRES_PER_KM * z);
}

srp_vec3 place_of(CelestialBody *body, Real a1mjd) {
    const Rvector6 &state = body->GetState(a1mjd);
    return metres(state[0], state[1], state[2]);
}

// As given, or beside the script that is run.
std::string found(const std::string &name) {
    const std::filesystem::path path(name);
    std::error_code code;
    if (name.empty() || path.is_absolute() || std::filesystem::exists(path, code)) {
        return name;
    }
    const std::filesystem::path beside =
        std::filesystem::path(FileManager::Instance()->GetGmatWorkingDirectory()) / path;
    return std::filesystem::exists(beside, code) ? beside.string() : name;
}

} // namespace

// ---- Life ---------------------------------------------------------------------------------------

HighFidelitySRP::HighFidelitySRP(const std::string &name)
    : PhysicalModel(Gmat::PHYSICAL_MODEL, TYPE_NAME, name),
      shared_(std::make_shared<srp_plugin::SharedModel>(show)),
      params_(srp_acceleration_params_default()), sun_(nullptr), mass_id_(-1), introduced_(false) {
    objectTypeNames.push_back(TYPE_NAME);
    parameterCount = PhysicalModelParamCount + Integer(srp_plugin::fields().size());
    derivativeIds.push_back(Gmat::CARTESIAN_STATE);
    isConservative = false;
}

HighFidelitySRP::HighFidelitySRP(const HighFidelitySRP &other)
    : PhysicalModel(other), settings_(other.settings_), shared_(other.shared_),
      params_(other.params_), sun_(nullptr), mass_id_(-1), introduced_(false) {
    isInitialized = false;
}

HighFidelitySRP &HighFidelitySRP::operator=(const HighFidelitySRP &other) {
    if (this != &other) {
        PhysicalModel::operator=(other);
        settings_ = other.settings_;
        shared_ = other.shared_;
        model_.reset();
        params_ = other.params_;
        sun_ = nullptr;
        shadow_bodies_.clear();
        masses_.clear();
        mass_id_ = -1;
        attitudes_.forget_all();
        introduced_ = false;
        isInitialized = false;
    }
    return *this;
}

HighFidelitySRP::~HighFidelitySRP() {
}

GmatBase *HighFidelitySRP::Clone() const {
    return new HighFidelitySRP(*this);
}

bool HighFidelitySRP::HasLocalClones() {
    return false;
}

bool HighFidelitySRP::RenameRefObject(const UnsignedInt, const std::string &, const std::string &) {
    return true;
}

// ---- Fields -------------------------------------------------------------------------------------

// NULL: one of the base's.
const Field *HighFidelitySRP::field_of(Integer id) const {
    const Integer index = id - PhysicalModelParamCount;
    return index >= 0 && index < Integer(srp_plugin::fields().size())
               ? &srp_plugin::fields()[size_t(index)]
               : nullptr;
}

// A field is set: what the copies made so far have is not ours any more.
void HighFidelitySRP::changed() {
    shared_ = std::make_shared<srp_plugin::SharedModel>(show);
    isInitialized = false;
}

std::string HighFidelitySRP::GetParameterText(const Integer id) const {
    const Field *field = field_of(id);
    return field != nullptr ? field->name : PhysicalModel::GetParameterText(id);
}

Integer HighFidelitySRP::GetParameterID(const std::string &label) const {
    const std::vector<Field> &all = srp_plugin::fields();
    for (size_t i = 0; i < all.size(); ++i) {
        if (label == all[i].name) {
            return PhysicalModelParamCount + Integer(i);
        }
    }
    return PhysicalModel::GetParameterID(label);
}

Gmat::ParameterType HighFidelitySRP::GetParameterType(const Integer id) const {
    const Field *field = field_of(id);
    if (field == nullptr) {
        return PhysicalModel::GetParameterType(id);
    }
    switch (field->member.index()) {
    case 0:
        return Gmat::REAL_TYPE;
    case 1:
        return Gmat::INTEGER_TYPE;
    case 2:
        return Gmat::BOOLEAN_TYPE;
    default:
        return field->is_file ? Gmat::FILENAME_TYPE : Gmat::STRING_TYPE;
    }
}

std::string HighFidelitySRP::GetParameterTypeString(const Integer id) const {
    return PARAM_TYPE_STRING[GetParameterType(id)];
}

Real HighFidelitySRP::GetRealParameter(const Integer id) const {
    const Field *field = field_of(id);
    const auto *member = field ? std::get_if<double Settings::*>(&field->member) : nullptr;
    return member ? settings_.**member : PhysicalModel::GetRealParameter(id);
}

Real HighFidelitySRP::SetRealParameter(const Integer id, const Real value) {
    const Field *field = field_of(id);
    if (field == nullptr || !std::holds_alternative<double Settings::*>(field->member)) {
        return PhysicalModel::SetRealParameter(id, value);
    }
    try {
        srp_plugin::set_number(settings_, *field, value);
    } catch (const srp_plugin::BadSetting &bad) {
        fail(bad.what());
    }
    changed();
    return value;
}

Integer HighFidelitySRP::GetIntegerParameter(const Integer id) const {
    const Field *field = field_of(id);
    const auto *member = field ? std::get_if<int Settings::*>(&field->member) : nullptr;
    return member ? settings_.**member : PhysicalModel::GetIntegerParameter(id);
}

Integer HighFidelitySRP::SetIntegerParameter(const Integer id, const Integer value) {
    const Field *field = field_of(id);
    if (field == nullptr || !std::holds_alternative<int Settings::*>(field->member)) {
        return PhysicalModel::SetIntegerParameter(id, value);
    }
    try {
        srp_plugin::set_integer(settings_, *field, value);
    } catch (const srp_plugin::BadSetting &bad) {
        fail(bad.what());
    }
    changed();
    return value;
}

bool HighFidelitySRP::GetBooleanParameter(const Integer id) const {
    const Field *field = field_of(id);
    const auto *member = field ? std::get_if<bool Settings::*>(&field->member) : nullptr;
    return member ? settings_.**member : PhysicalModel::GetBooleanParameter(id);
}

bool HighFidelitySRP::SetBooleanParameter(const Integer id, const bool value) {
    const Field *field = field_of(id);
    const auto *member = field ? std::get_if<bool Settings::*>(&field->member) : nullptr;
    if (member == nullptr) {
        return PhysicalModel::SetBooleanParameter(id, value);
    }
    settings_.**member = value;
    changed();
    return true;
}

std::string HighFidelitySRP::GetStringParameter(const Integer id) const {
    const Field *field = field_of(id);
    const auto *member = field ? std::get_if<std::string Settings::*>(&field->member) : nullptr;
    return member ? settings_.**member : PhysicalModel::GetStringParameter(id);
}

bool HighFidelitySRP::SetStringParameter(const Integer id, const std::string &value) {
    const Field *field = field_of(id);
    if (field == nullptr || !std::holds_alternative<std::string Settings::*>(field->member)) {
        return PhysicalModel::SetStringParameter(id, value);
    }
    try {
        srp_plugin::set_text(settings_, *field, value);
    } catch (const srp_plugin::BadSetting &bad) {
        fail(bad.what());
    }
    changed();
    return true;
}

Real HighFidelitySRP::GetRealParameter(const std::string &label) const {
    return GetRealParameter(GetParameterID(label));
}

Real HighFidelitySRP::SetRealParameter(const std::string &label, const Real value) {
    return SetRealParameter(GetParameterID(label), value);
}

Integer HighFidelitySRP::GetIntegerParameter(const std::string &label) const {
    return GetIntegerParameter(GetParameterID(label));
}

Integer HighFidelitySRP::SetIntegerParameter(const std::string &label, const Integer value) {
    return SetIntegerParameter(GetParameterID(label), value);
}

bool HighFidelitySRP::GetBooleanParameter(const std::string &label) const {
    return GetBooleanParameter(GetParameterID(label));
}

bool HighFidelitySRP::SetBooleanParameter(const std::string &label, const bool value) {
    return SetBooleanParameter(GetParameterID(label), value);
}

std::string HighFidelitySRP::GetStringParameter(const std::string &label) const {
    return GetStringParameter(GetParameterID(label));
}

bool HighFidelitySRP::SetStringParameter(const std::string &label, const std::string &value) {
    return SetStringParameter(GetParameterID(label), value);
}

// ---- Setting up ---------------------------------------------------------------------------------

Settings HighFidelitySRP::with_paths() const {
    Settings settings = settings_;
    settings.table_file = found(settings.table_file);
    settings.obj_file = found(settings.obj_file);
    settings.mtl_file = found(settings.mtl_file);
    return settings;
}

void HighFidelitySRP::find_bodies() {
    if (solarSystem == nullptr) {
        fail("there is no solar system");
    }
    body = forceOrigin != nullptr ? forceOrigin : solarSystem->GetBody("Earth");
    sun_ = solarSystem->GetBody("Sun");
    if (body == nullptr || sun_ == nullptr) {
        fail("the solar system lacks the Sun or the central body");
    }
    find_shadow_bodies();
    params_.light.flux = settings_.flux;
    params_.light.au = METRES_PER_KM * settings_.au_km;
    params_.sun_radius = METRES_PER_KM * sun_->GetEquatorialRadius();
    params_.scale = settings_.scale;
}

void HighFidelitySRP::find_shadow_bodies() {
    shadow_bodies_.clear();
    for (const std::string &name : srp_plugin::names_in(settings_.shadow_bodies)) {
        if (name == "None") {
            continue;
        }
        CelestialBody *one = name == "CentralBody" ? body : solarSystem->GetBody(name);
        if (one == nullptr) {
            fail("SRPShadowBodies: there is no body '" + name +
                 "', expected CentralBody, None, or names such as 'Earth, Luna'");
        }
        if (one != sun_ &&
            std::find(shadow_bodies_.begin(), shadow_bodies_.end(), one) == shadow_bodies_.end()) {
            shadow_bodies_.push_back(one);
        }
    }
    if (shadow_bodies_.size() > SRP_ACCELERATION_BODIES_MAX) {
        fail("SRPShadowBodies: too many bodies, expected at most " +
             std::to_string(int(SRP_ACCELERATION_BODIES_MAX)));
    }
}

// Copies are of the force models that their original is of.
srp_plugin::ForceModels HighFidelitySRP::force_models() const {
    return srp_plugin::force_models_with([this](const PhysicalModel *force) {
        const auto *one = dynamic_cast<const HighFidelitySRP *>(force);
        return one != nullptr && one->shared_ == shared_;
    });
}

bool HighFidelitySRP::Initialize() {
    if (!PhysicalModel::Initialize()) {
        return false;
    }
    isInitialized = false;
    introduced_ = false;
    attitudes_.forget_all();
    find_bodies();
    const srp_plugin::ForceModels models = force_models();
    for (const std::string &name : models.doubled) {
        shared_->notes().add(name + ".SRP is On as well: the Sun pushes twice");
    }
    try {
        model_ = shared_->get(with_paths());
    } catch (const srp_plugin::BadSetting &bad) {
        shared_->notes().flush();
        const std::string of = srp_plugin::list_of(models.names);
        fail(bad.what() + (of.empty() ? "" : " (force model " + of + ")"));
    }
    isInitialized = true;
    return true;
}

bool HighFidelitySRP::SupportsDerivative(Gmat::StateElementId id) {
    return id == Gmat::CARTESIAN_STATE || id == Gmat::ORBIT_STATE_TRANSITION_MATRIX ||
           id == Gmat::ORBIT_A_MATRIX;
}

bool HighFidelitySRP::SetStart(Gmat::StateElementId id, Integer index, Integer quantity, Integer) {
    switch (id) {
    case Gmat::CARTESIAN_STATE:
        cartesianStart = index;
        cartesianCount = quantity;
        fillCartesian = true;
        return true;
    case Gmat::ORBIT_STATE_TRANSITION_MATRIX:
        stmStart = index;
        stmCount = quantity;
        fillSTM = true;
        return true;
    case Gmat::ORBIT_A_MATRIX:
        aMatrixStart = index;
        aMatrixCount = quantity;
        fillAMatrix = true;
        return true;
    default:
        return false;
    }
}

void HighFidelitySRP::SetSatelliteParameter(const Integer i, const std::string parmName,
                                            const Real parm, const Integer parmID) {
    if (parmName == "Mass" && i >= 0) {
        // Numbers of parameters differ between releases: this is the one that updates come by.
        mass_id_ = parmID;
        if (size_t(i) >= masses_.size()) {
            masses_.resize(size_t(i) + 1, 0.0);
        }
        masses_[size_t(i)] = parm;
    }
}

void HighFidelitySRP::SetSatelliteParameter(const Integer i, Integer parmID, const Real parm) {
    if (parmID >= 0 && parmID == mass_id_ && i >= 0 && size_t(i) < masses_.size()) {
        masses_[size_t(i)] = parm;
    }
}

void HighFidelitySRP::ClearSatelliteParameters(const std::string parmName) {
    if (parmName.empty() || parmName == "Mass") {
        masses_.clear();
    }
    if (parmName.empty()) {
        scObjs.clear();
        attitudes_.forget_all();
    }
}

// Also at the begin of every step.
void HighFidelitySRP::SetSpaceObject(const Integer i, GmatBase *obj) {
    PhysicalModel::SetSpaceObject(i, obj);
    attitudes_.forget(i);
}

bool HighFidelitySRP::IsUserForce() {
    return true;
}

bool HighFidelitySRP::IsUnique(const std::string &) {
    return true;
}

// Whether the spacecraft, and with it the attitude, must be at the state of the stage: GMAT copies
// that into it for each derivative. Asked when a Propagate begins, which has named its spacecraft.
bool HighFidelitySRP::AttitudeAffectsDynamics() {
    return scObjs.empty() || std::any_of(scObjs.begin(), scObjs.end(), [](GmatBase *one) {
               return one == nullptr ||
                      srp_plugin::may_follow_orbit(static_cast<Spacecraft *>(one));
           });
}

// ---- The force ----------------------------------------------------------------------------------

HighFidelitySRP::Sky HighFidelitySRP::sky_at(Real a1mjd) {
    Sky sky;
    const srp_vec3 centre = place_of(body, a1mjd);
    sky.sun =
        body == sun_ ? srp_vec3_make(0.0, 0.0, 0.0) : srp_vec3_sub(place_of(sun_, a1mjd), centre);
    for (size_t k = 0; k < shadow_bodies_.size(); ++k) {
        sky.bodies[k] = shadow_bodies_[k] == body
                            ? srp_vec3_make(0.0, 0.0, 0.0)
                            : srp_vec3_sub(place_of(shadow_bodies_[k], a1mjd), centre);
    }
    return sky;
}

// `state` has the attitude and the mass.
void HighFidelitySRP::accelerate(const Spacecraft *sc, const Real *r_km, const Sky &sky,
                                 srp_acceleration_state *state, srp_vec3 *a, double (*da_dr)[3]) {
    srp_body bodies[SRP_ACCELERATION_BODIES_MAX];
    const srp_vec3 r = metres(r_km[0], r_km[1], r_km[2]);
    state->sun = srp_vec3_sub(sky.sun, r);
    state->count = shadow_bodies_.size();
    state->bodies = bodies;
    for (size_t k = 0; k < state->count; ++k) {
        bodies[k].position = srp_vec3_sub(sky.bodies[k], r);
        bodies[k].radius = METRES_PER_KM * shadow_bodies_[k]->GetEquatorialRadius();
    }
    srp_error error;
    if (srp_acceleration_eval(&params_, model_->source(), state, a, da_dr, &error) != SRP_OK) {
        fail("spacecraft " + sc->GetName() + ": " + srp_plugin::words_of(error));
    }
}

Real HighFidelitySRP::mass_of(Integer satellite) {
    return size_t(satellite) < masses_.size()
               ? masses_[size_t(satellite)]
               : scObjs[size_t(satellite)]->GetRealParameter("TotalMass");
}

// Rows 3 to 5, columns 0 to 2 of the satellite's block, behind `before` numbers of others'; returns
// how many it has: it may be larger than 6 x 6.
Integer HighFidelitySRP::add_partials(Integer satellite, Integer before, const double da_dr[3][3]) {
    const Integer n = scObjs[size_t(satellite)]->GetIntegerParameter("FullSTMRowCount");
    for (Integer i = 0; i < 3; ++i) {
        for (Integer j = 0; j < 3; ++j) {
            const Integer at = before + (3 + i) * n + j;
            if (fillSTM && satellite < stmCount) {
                deriv[stmStart + at] = da_dr[i][j];
            }
            if (fillAMatrix && satellite < aMatrixCount) {
                deriv[aMatrixStart + at] = da_dr[i][j];
            }
        }
    }
    return n * n;
}

bool HighFidelitySRP::GetDerivatives(Real *state, Real dt, Integer order, const Integer) {
    if (!isInitialized || order > 2) {
        return false;
    }
    if (Integer(scObjs.size()) < cartesianCount) {
        fail("there are " + std::to_string(cartesianCount) + " states, but only " +
             std::to_string(scObjs.size()) +
             " spacecraft: " + srp_plugin::list_of(names_of(scObjs)));
    }
    if (!introduced_) {
        shared_->notes().concern(names_of(scObjs));
        introduced_ = true;
    }
    const Real now = epoch + (elapsedTime + dt) / SECONDS_PER_DAY;
    const Sky sky = sky_at(now);
    const bool partials = fillSTM || fillAMatrix;
    Integer before = 0; // numbers of partials of the satellites that are done
    std::fill(deriv, deriv + dimension, 0.0);
    for (Integer i = 0; i < cartesianCount; ++i) {
        const Integer begin = cartesianStart + 6 * i;
        Spacecraft *sc = static_cast<Spacecraft *>(scObjs[size_t(i)]);
        srp_acceleration_state at;
        srp_vec3 a;
        double da_dr[3][3];
        attitudes_.get(i, sc, now, at.matrix);
        at.mass = mass_of(i);
        accelerate(sc, state + begin, sky, &at, &a, partials ? da_dr : nullptr);
        if (fillCartesian) {
            Real *out = deriv + begin + (order == 1 ? 3 : 0);
            out[0] = a.x / METRES_PER_KM;
            out[1] = a.y / METRES_PER_KM;
            out[2] = a.z / METRES_PER_KM;
        }
        if (partials) {
            before += add_partials(i, before, da_dr);
        }
    }
    return true;
}

Rvector6 HighFidelitySRP::GetDerivativesForSpacecraft(Spacecraft *sc) {
    if (model_ == nullptr || body == nullptr) {
        fail("asked for an acceleration before it was initialized");
    }
    shared_->notes().concern({sc->GetName()});
    const Real now = sc->GetEpoch();
    Real state[6];
    BuildModelState(now, state, sc->GetState().GetState());
    srp_acceleration_state at;
    srp_vec3 a;
    srp_plugin::Attitudes().get(0, sc, now, at.matrix); // not one of a propagation
    at.mass = sc->GetRealParameter("TotalMass");
    accelerate(sc, state, sky_at(now), &at, &a, nullptr);
    return Rvector6(0.0, 0.0, 0.0, a.x / METRES_PER_KM, a.y / METRES_PER_KM, a.z / METRES_PER_KM);
}
