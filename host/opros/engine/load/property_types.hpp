// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

namespace tandem::engine {

/// Returns one line for each property error that the profile alone shows: a missing name, a value that does not fit
/// its type, or a name that resembles a device library property. Does not throw for them: upstream's engine does not
/// read the types, and the component may not need the property.
std::vector<std::string> find_property_type_errors(const ComponentProfile& profile);

} // namespace tandem::engine
