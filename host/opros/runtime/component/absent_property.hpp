// SPDX-License-Identifier: Apache-2.0
// For the engine; not part of the component API.
#pragma once

#include <PropertyInterface.h>

/// Called when a component asks getProperty() for a property that it does not have. [the component's thread]
using AbsentPropertyHandler = void (*)(PropertyInterface& component, const std::string& name);

/// Sets the handler of this process. NULL, as at the start, means no handler. [any-thread]
void set_absent_property_handler(AbsentPropertyHandler handler);

/// Returns the property that the calling thread has last asked for, through getProperty() or a Property, without getting it;
/// empty if there is none since the last call of this function. [any-thread]
std::string take_absent_property();
