// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/factory.hpp"

#include <ServiceUtils.h>

// The functions that an OPRoS host looks up in a component library.
extern "C" {
Component* getComponent() { return tandem::adaptor::create_adaptor(); }
void releaseComponent(Component* component) { tandem::adaptor::delete_adaptor(component); }
}
