// SPDX-License-Identifier: Apache-2.0
// What the script has around a force, which GMAT tells no force: the force models that it is of,
// and what else is in these.
#ifndef SRP_PLUGIN_SCRIPT_HPP
#define SRP_PLUGIN_SCRIPT_HPP

#include "GmatForce.hpp"

#include <functional>
#include <string>
#include <vector>

namespace srp_plugin {

struct ForceModels {
    std::vector<std::string> names;   // of those that have the force
    std::vector<std::string> doubled; // of those that have GMAT's own SRP as well
};

// Of the script's objects, not of the copies that fly.
ForceModels force_models_with(const std::function<bool(const PhysicalModel *)> &is_ours);

} // namespace srp_plugin

#endif
