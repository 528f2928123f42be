// SPDX-License-Identifier: Apache-2.0
// Reads the keyboard in onExecute, as its property `how` says.
#include "simple_component.h"
#include "tests/integration/terminal/read_keys.hpp"

class KeyComp : public SimpleComponent {
  public:
    ReturnType onExecute() override {
        read_keys(getProperty("how"));
        return OPROS_SUCCESS;
    }
};

extern "C" {
Component* getComponent() { return new KeyComp; }
void releaseComponent(Component* component) { delete component; }
}
