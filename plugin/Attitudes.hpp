// SPDX-License-Identifier: Apache-2.0
// The attitude of spacecraft as GMAT holds it, asked for no more often than it can change, and
// whether it can change with the orbit. GMAT works an attitude out anew at each question.
#ifndef SRP_PLUGIN_ATTITUDES_HPP
#define SRP_PLUGIN_ATTITUDES_HPP

#include "GmatForce.hpp"

#include <cstddef>
#include <vector>

namespace srp_plugin {

// Whether the attitude may depend on where the spacecraft is. True of every kind that is not known
// here.
bool may_follow_orbit(Spacecraft *sc);

class Attitudes {
  public:
    // Spacecraft i may be another one, or have another attitude, from now on.
    void forget(Integer i);
    void forget_all();
    // Axes MJ2000Eq to body, of spacecraft i.
    void get(Integer i, Spacecraft *sc, Real a1mjd, double matrix[3][3]);

  private:
    struct Kept {
        Spacecraft *sc = nullptr; // NULL: nothing is known
        bool constant = false;
        double matrix[3][3];
    };
    std::vector<Kept> kept_;
};

} // namespace srp_plugin

#endif
