// SPDX-License-Identifier: Apache-2.0
#include "Attitudes.hpp"

#include <algorithm>
#include <iterator>
#include <string>

namespace srp_plugin {

namespace {

// The names are those of GMAT's scripts; a kind that is derived from one of these is another one.
bool is_kind(GmatBase *attitude, const char *name) {
    return attitude != nullptr && attitude->GetTypeName() == name;
}

bool is_fixed_in(GmatBase *attitude, const char *axes) {
    if (!is_kind(attitude, "CoordinateSystemFixed")) {
        return false;
    }
    GmatBase *system = attitude->GetRefObject(Gmat::COORDINATE_SYSTEM,
                                              attitude->GetRefObjectName(Gmat::COORDINATE_SYSTEM));
    return system != nullptr && static_cast<CoordinateSystem *>(system)->AreAxesOfType(axes);
}

// To the last bit: in axes whose matrix is worked out once, or spun by nothing. (A spinner works
// out each attitude from the last one that was asked for: no more must be asked than is needed.)
bool is_constant(Spacecraft *sc) {
    GmatBase *attitude = sc->GetRefObject(Gmat::ATTITUDE, "");
    if (is_kind(attitude, "Spinner")) {
        return attitude->GetRealParameter("AngularVelocityX") == 0.0 &&
               attitude->GetRealParameter("AngularVelocityY") == 0.0 &&
               attitude->GetRealParameter("AngularVelocityZ") == 0.0;
    }
    return is_fixed_in(attitude, "MJ2000EqAxes") || is_fixed_in(attitude, "MJ2000EcAxes");
}

} // namespace

bool may_follow_orbit(Spacecraft *sc) {
    static const char *const OF_TIME_ALONE[] = {"Spinner", "PrecessingSpinner", "SpiceAttitude",
                                                "CCSDS-AEM"};
    GmatBase *attitude = sc->GetRefObject(Gmat::ATTITUDE, "");
    return std::none_of(std::begin(OF_TIME_ALONE), std::end(OF_TIME_ALONE),
                        [&](const char *name) { return is_kind(attitude, name); }) &&
           !is_fixed_in(attitude, "InertialAxes");
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
