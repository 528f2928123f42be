// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

#include <string>
#include <vector>

namespace tandem::command {

/// Errors in the profiles of service and data types that a component's profile refers to, one line for each
/// file. A file that does not exist is not an error: nothing needs it at run time, and components are often
/// shipped without.
std::vector<std::string> find_type_profile_errors(const engine::ComponentProfile& profile);

} // namespace tandem::command
