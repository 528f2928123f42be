// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace tandem::command {

/// Compares the ports that a profile lists with those of the component (`ports` of describe_component()). Returns one
/// line for each port that the component does not have or has with another kind, direction or type, with the profile's
/// file and line. `initialized`: onInitialize has been run, so that the component has all its ports.
std::vector<std::string> find_port_mismatches(const engine::ComponentProfile& profile,
                                              const nlohmann::json& ports, bool initialized);

} // namespace tandem::command
