// SPDX-License-Identifier: Apache-2.0
#include "Script.hpp"

#include "ConfigManager.hpp"
#include "ODEModel.hpp"

namespace srp_plugin {

ForceModels force_models_with(const std::function<bool(const PhysicalModel *)> &is_ours) {
    ForceModels found;
    ConfigManager *script = ConfigManager::Instance();
    const StringArray all = script->GetListOfItems(Gmat::ODE_MODEL); // its list is used again
    for (const std::string &name : all) {
        ODEModel *model = dynamic_cast<ODEModel *>(script->GetItem(name));
        bool ours = false, gmats = false;
        for (Integer i = 0; model != nullptr && i < model->GetNumForces(); ++i) {
            const PhysicalModel *force = model->GetForce(i);
            ours = ours || is_ours(force);
            gmats = gmats || force->GetTypeName() == "SolarRadiationPressure";
        }
        if (ours) {
            found.names.push_back(name);
        }
        if (ours && gmats) {
            found.doubled.push_back(name);
        }
    }
    return found;
}

} // namespace srp_plugin
