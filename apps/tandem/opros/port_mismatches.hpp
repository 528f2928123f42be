// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace tandem::command {

/// Where the ports that a profile lists are not those of the component (`ports` of describe()): one line
/// each, with file and line. `initialized`: also those that onInitialize makes are there.
std::vector<std::string> find_port_mismatches(const engine::ComponentProfile& profile,
                                              const nlohmann::json& ports, bool initialized);

} // namespace tandem::command
