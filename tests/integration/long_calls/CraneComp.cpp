// SPDX-License-Identifier: Apache-2.0
// Provides a crane.
#include "crane.h"
#include "tests/integration/opros/simple_component.h"

#include <ServiceUtils.h>

class CraneComp : public SimpleComponent {
  public:
    CraneComp() {
        auto* port = new ProvidedServicePort; // the component deletes its service ports
        port->addMethod("lift", makeProvidedMethod(&CraneComp::lift, this, "lift"));
        port->addMethod("lower", makeProvidedMethod(&CraneComp::lower, this, "lower"));
        addPort("crane", port);
    }
    int lift(int steps) { return work("lift", steps); }
    void lower(int steps) { work("lower", steps); }
};

extern "C" {
Component* getComponent() { return new CraneComp; }
void releaseComponent(Component* component) { delete component; }
}
