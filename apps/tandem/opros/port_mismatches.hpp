// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace tandem::command {

/// Compares a profile's ports with those of the component (`ports` of describe_component()). Returns a line with the
/// profile's file and line for each port that is missing or has another kind, direction or type. `initialized`:
/// onInitialize has run, so that all ports exist.
std::vector<std::string> find_port_mismatches(const engine::ComponentProfile& profile,
                                              const nlohmann::json& ports, bool initialized);

} // namespace tandem::command
