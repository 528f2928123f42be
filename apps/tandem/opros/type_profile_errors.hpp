// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

#include <string>
#include <vector>

namespace tandem::command {

/// What is wrong in the profiles of service and data types that a component's profile refers to, one line for
/// each file. Those that are not there are no fault: nothing needs them to run, and real ones are often left
/// behind.
std::vector<std::string> find_type_profile_errors(const engine::ComponentProfile& profile);

} // namespace tandem::command
