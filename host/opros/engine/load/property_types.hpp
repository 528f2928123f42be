// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

namespace tandem::engine {

/// What is wrong with the properties by the profile alone, a line each: no name, a value that does not fit its type, a
/// name that nearly is one of those of device libraries. None of it is an exception: upstream's engine reads no types,
/// and the component may do without.
std::vector<std::string> find_property_type_errors(const ComponentProfile& profile);

} // namespace tandem::engine
