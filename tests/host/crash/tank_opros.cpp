// SPDX-License-Identifier: Apache-2.0
// An OPRoS component that measures the level of a tank, until its property `fault` names a fault.
#include "tank_faults.hpp"

#include <Component.h>
#include <ServiceUtils.h>

class TankComp : public Component {
  protected:
    ReturnType onInitialize() override { return OPROS_SUCCESS; }
    ReturnType onStart() override { return OPROS_SUCCESS; }
    ReturnType onStop() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }

  public:
    ReturnType onExecute() override {
        have_fault(getProperty("fault"));
        return OPROS_SUCCESS;
    }
};

extern "C" {
Component* getComponent() { return new TankComp(); }
void releaseComponent(Component* component) { delete component; }
}
