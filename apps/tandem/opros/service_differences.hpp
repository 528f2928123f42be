// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tandem::command {

/// Where the methods of a component's service ports, as describe_component() gives them, differ from the service
/// profiles that its profile refers to: one line for each method that only one of the two has, or that has another
/// result or other arguments. Only the code counts at run time. A type's other name (a typedef) is a difference, too.
std::vector<std::string> find_service_differences(const engine::ComponentProfile& profile,
                                                  const nlohmann::json& ports);

} // namespace tandem::command
