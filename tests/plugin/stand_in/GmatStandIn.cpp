// SPDX-License-Identifier: Apache-2.0
#include "GmatStandIn.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

// What GMAT does with a parameter that nobody has.
static void refuse(const std::string &what) {
    throw std::out_of_range("no parameter " + what);
}
static void refuse(Integer id) {
    refuse(std::to_string(id));
}

void MessageInterface::ShowMessage(const char *format, ...) {
    char line[2000];
    va_list list;
    va_start(list, format);
    vsnprintf(line, sizeof line, format, list);
    va_end(list);
    if (to() != nullptr) {
        to()->text += line;
    }
}

MessageReceiver *&MessageInterface::to() {
    static MessageReceiver *receiver = nullptr;
    return receiver;
}

FileManager *FileManager::Instance() {
    static FileManager manager;
    return &manager;
}

ConfigManager *ConfigManager::Instance() {
    static ConfigManager manager;
    return &manager;
}

const StringArray &ConfigManager::GetListOfItems(UnsignedInt type) {
    list.clear();
    for (const ODEModel *one : models) {
        if (type == Gmat::ODE_MODEL) {
            list.push_back(one->GetName());
        }
    }
    return list;
}

GmatBase *ConfigManager::GetItem(const std::string &name) {
    const auto found = std::find_if(models.begin(), models.end(),
                                    [&](const ODEModel *one) { return one->GetName() == name; });
    return found == models.end() ? nullptr : *found;
}

// ---- Parameters ---------------------------------------------------------------------------------

const std::string GmatBase::PARAM_TYPE_STRING[] = {"Integer", "Real", "String", "Boolean",
                                                   "Filename"};

std::string GmatBase::GetParameterText(const Integer id) const {
    refuse(id);
    return "";
}
Integer GmatBase::GetParameterID(const std::string &label) const {
    refuse(label);
    return -1;
}
Gmat::ParameterType GmatBase::GetParameterType(const Integer id) const {
    refuse(id);
    return Gmat::STRING_TYPE;
}
std::string GmatBase::GetParameterTypeString(const Integer id) const {
    refuse(id);
    return "";
}
Real GmatBase::GetRealParameter(const Integer id) const {
    refuse(id);
    return 0.0;
}
Real GmatBase::SetRealParameter(const Integer id, const Real) {
    refuse(id);
    return 0.0;
}
Real GmatBase::GetRealParameter(const std::string &label) const {
    refuse(label);
    return 0.0;
}
Real GmatBase::SetRealParameter(const std::string &label, const Real) {
    refuse(label);
    return 0.0;
}
Integer GmatBase::GetIntegerParameter(const Integer id) const {
    refuse(id);
    return 0;
}
Integer GmatBase::SetIntegerParameter(const Integer id, const Integer) {
    refuse(id);
    return 0;
}
Integer GmatBase::GetIntegerParameter(const std::string &label) const {
    refuse(label);
    return 0;
}
Integer GmatBase::SetIntegerParameter(const std::string &label, const Integer) {
    refuse(label);
    return 0;
}
bool GmatBase::GetBooleanParameter(const Integer id) const {
    refuse(id);
    return false;
}
bool GmatBase::SetBooleanParameter(const Integer id, const bool) {
    refuse(id);
    return false;
}
bool GmatBase::GetBooleanParameter(const std::string &label) const {
    refuse(label);
    return false;
}
bool GmatBase::SetBooleanParameter(const std::string &label, const bool) {
    refuse(label);
    return false;
}
std::string GmatBase::GetStringParameter(const Integer id) const {
    refuse(id);
    return "";
}
bool GmatBase::SetStringParameter(const Integer id, const std::string &) {
    refuse(id);
    return false;
}
std::string GmatBase::GetStringParameter(const std::string &label) const {
    refuse(label);
    return "";
}
bool GmatBase::SetStringParameter(const std::string &label, const std::string &) {
    refuse(label);
    return false;
}

// ---- Bodies and forces --------------------------------------------------------------------------

Rvector6 CelestialBody::GetState(Real t) const {
    return Rvector6(state[0] + t * state[3], state[1] + t * state[4], state[2] + t * state[5],
                    state[3], state[4], state[5]);
}

PhysicalModel::PhysicalModel(UnsignedInt id, const std::string &type, const std::string &name)
    : GmatBase(id, type, name), body(nullptr), forceOrigin(nullptr), dimension(1), epoch(21545.0),
      elapsedTime(0.0), deriv(nullptr), solarSystem(nullptr), fillCartesian(true),
      cartesianStart(0), cartesianCount(0), fillSTM(false), stmStart(-1), stmCount(0),
      fillAMatrix(false), aMatrixStart(-1), aMatrixCount(0), isConservative(true) {
}

// As GMAT's: spacecraft do not come along.
PhysicalModel::PhysicalModel(const PhysicalModel &other)
    : GmatBase(other), body(other.body), forceOrigin(other.forceOrigin), dimension(other.dimension),
      epoch(other.epoch), elapsedTime(other.elapsedTime), deriv(nullptr),
      derivativeIds(other.derivativeIds), solarSystem(other.solarSystem),
      fillCartesian(other.fillCartesian), cartesianStart(other.cartesianStart),
      cartesianCount(other.cartesianCount), fillSTM(other.fillSTM), stmStart(other.stmStart),
      stmCount(other.stmCount), fillAMatrix(other.fillAMatrix), aMatrixStart(other.aMatrixStart),
      aMatrixCount(other.aMatrixCount), isConservative(other.isConservative) {
}

PhysicalModel &PhysicalModel::operator=(const PhysicalModel &other) {
    if (this != &other) {
        GmatBase::operator=(other);
        body = other.body;
        forceOrigin = other.forceOrigin;
        dimension = other.dimension;
        epoch = other.epoch;
        elapsedTime = other.elapsedTime;
        solarSystem = other.solarSystem;
        scObjs = other.scObjs;
        delete[] deriv;
        deriv = nullptr;
    }
    return *this;
}

PhysicalModel::~PhysicalModel() {
    delete[] deriv;
}

bool PhysicalModel::Initialize() {
    delete[] deriv;
    deriv = new Real[size_t(dimension)]();
    isInitialized = true;
    return true;
}

void PhysicalModel::SetSpaceObject(const Integer i, GmatBase *object) {
    if (size_t(i) >= scObjs.size()) {
        scObjs.resize(size_t(i) + 1);
    }
    scObjs[size_t(i)] = object;
}

bool PhysicalModel::BuildModelState(Real now, Real *state, Real *j2kState, Integer n) {
    const Rvector6 at = body->GetState(now);
    for (Integer i = 0; i < n; ++i) {
        state[i] = j2kState[i] - at[i % 6];
    }
    return true;
}
