// SPDX-License-Identifier: Apache-2.0
#include "Attitudes.hpp"

#include <algorithm>
#include <iterator>
#include <string>

namespace srp_plugin {

namespace {

// Names of GMAT; made once, for they are looked for in every step.
const std::string FIXED = "CoordinateSystemFixed", SPINNER = "Spinner", INERTIAL = "InertialAxes",
                  EQUATOR = "MJ2000EqAxes", ECLIPTIC = "MJ2000EcAxes",
                  ANGULAR_X = "AngularVelocityX", ANGULAR_Y = "AngularVelocityY",
                  ANGULAR_Z = "AngularVelocityZ";

// Of an attitude that is fixed in a coordinate system; may be NULL.
CoordinateSystem *system_of(GmatBase *attitude) {
    return static_cast<CoordinateSystem *>(attitude->GetRefObject(
        Gmat::COORDINATE_SYSTEM, attitude->GetRefObjectName(Gmat::COORDINATE_SYSTEM)));
}

// A kind that is derived from a known one has a name of its own, and is not known.
std::string kind_of(const GmatBase *attitude) {
    return attitude == nullptr ? "" : attitude->GetTypeName();
}

// To the last bit: in axes whose matrix is worked out once, or spun by nothing. (A spinner works
// out each attitude from the last one that was asked for: no more must be asked than is needed.)
bool is_constant(Spacecraft *sc) {
    GmatBase *attitude = sc->GetRefObject(Gmat::ATTITUDE, "");
    const std::string kind = kind_of(attitude);
    if (kind == SPINNER) {
        return attitude->GetRealParameter(ANGULAR_X) == 0.0 &&
               attitude->GetRealParameter(ANGULAR_Y) == 0.0 &&
               attitude->GetRealParameter(ANGULAR_Z) == 0.0;
    }
    if (kind != FIXED) {
        return false;
    }
    const CoordinateSystem *system = system_of(attitude);
    return system != nullptr && (system->AreAxesOfType(EQUATOR) || system->AreAxesOfType(ECLIPTIC));
}

} // namespace

bool may_follow_orbit(Spacecraft *sc) {
    // As in the sources of R2020a, R2022a and R2026a.
    static const char *const OF_TIME_ALONE[] = {"Spinner", "PrecessingSpinner",
                                                "ThreeAxisKinematic", "SpiceAttitude", "CCSDS-AEM"};
    GmatBase *attitude = sc->GetRefObject(Gmat::ATTITUDE, "");
    const std::string kind = kind_of(attitude);
    if (kind == FIXED) {
        const CoordinateSystem *system = system_of(attitude);
        return system == nullptr || !system->AreAxesOfType(INERTIAL);
    }
    return std::find(std::begin(OF_TIME_ALONE), std::end(OF_TIME_ALONE), kind) ==
           std::end(OF_TIME_ALONE);
}

void Attitudes::forget(Integer i) {
    if (i >= 0 && size_t(i) < kept_.size()) {
        kept_[size_t(i)].sc = nullptr;
    }
}

void Attitudes::forget_all() {
    kept_.clear();
}

void Attitudes::get(Integer i, Spacecraft *sc, Real a1mjd, double matrix[3][3]) {
    if (size_t(i) >= kept_.size()) {
        kept_.resize(size_t(i) + 1);
    }
    Kept &kept = kept_[size_t(i)];
    if (kept.sc != sc || !kept.constant) {
        const Rmatrix33 &now = sc->GetAttitude(a1mjd);
        for (Integer row = 0; row < 3; ++row) {
            for (Integer column = 0; column < 3; ++column) {
                kept.matrix[row][column] = now(row, column);
            }
        }
        if (kept.sc != sc) {
            kept.constant = is_constant(sc);
            kept.sc = sc;
        }
    }
    std::copy(&kept.matrix[0][0], &kept.matrix[0][0] + 9, &matrix[0][0]);
}

} // namespace srp_plugin
