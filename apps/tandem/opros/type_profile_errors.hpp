// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

#include <string>
#include <vector>

namespace tandem::command {

/// Returns the errors in the service and data type profiles that a component's profile refers to, one line per file. A
/// missing file is not an error: it is not needed at run time, and components are often shipped without it.
std::vector<std::string> find_type_profile_errors(const engine::ComponentProfile& profile);

} // namespace tandem::command
