// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tandem::command {

/// Compares the methods of a component's service ports (from describe_component()) with the referenced service
/// profiles. Returns a line for each method that exists on one side only, or has another result or arguments. Only the
/// code matters at run time. Reports a type's other name (a typedef) as a difference.
std::vector<std::string> find_service_differences(const engine::ComponentProfile& profile,
                                                  const nlohmann::json& ports);

} // namespace tandem::command
