// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/adaptor_comp.hpp"

#include <ServiceUtils.h>

// What an OPRoS host looks up in a component library.
extern "C" {
Component* getComponent() { return new tandem::adaptor::AdaptorComp(); }
void releaseComponent(Component* component) { delete component; }
}
