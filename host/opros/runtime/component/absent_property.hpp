// SPDX-License-Identifier: Apache-2.0
// For the engine; not part of the component API.
#pragma once

#include <PropertyInterface.h>

/// Called, in the component's thread, when it asks getProperty() for a property that it does not have.
using AbsentPropertyHandler = void (*)(PropertyInterface& component, const std::string& name);

/// Replaces the handler of this process; NULL: there is none, as at the start. [any-thread]
void set_absent_property_handler(AbsentPropertyHandler handler);
