// SPDX-License-Identifier: Apache-2.0
// What GMAT's loader looks for, and nothing else.
#include "Factory.hpp"
#include "HighFidelitySRP.hpp"
#include "MessageInterface.hpp"

#if defined(_WIN32)
#define SRP_PLUGIN_API __declspec(dllexport)
#else
#define SRP_PLUGIN_API __attribute__((visibility("default")))
#endif

namespace {

class SrpForceFactory : public Factory {
  public:
    SrpForceFactory() : Factory(Gmat::PHYSICAL_MODEL) {
        creatables.push_back("HighFidelitySRP");
    }

    virtual GmatBase *CreateObject(const std::string &ofType, const std::string &withName) {
        return CreatePhysicalModel(ofType, withName);
    }
    virtual PhysicalModel *CreatePhysicalModel(const std::string &ofType,
                                               const std::string &withName) {
        return ofType == "HighFidelitySRP" ? new HighFidelitySRP(withName) : nullptr;
    }
};

} // namespace

extern "C" {

SRP_PLUGIN_API Integer GetFactoryCount() {
    return 1;
}

// GMAT's factory manager deletes it.
SRP_PLUGIN_API Factory *GetFactoryPointer(Integer index) {
    return index == 0 ? new SrpForceFactory : nullptr;
}

SRP_PLUGIN_API void SetMessageReceiver(MessageReceiver *receiver) {
    MessageInterface::SetMessageReceiver(receiver);
}
}
