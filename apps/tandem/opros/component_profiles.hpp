// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

#include <filesystem>
#include <string>

namespace tandem::command {

/// Returns the component profile in a component's folder or where OPRoS's tools put it. `profile` selects one of
/// several, relative to the current folder or to the component's. Throws std::runtime_error if there is none or the
/// choice is ambiguous.
engine::ComponentProfile select_component_profile(const std::filesystem::path& folder,
                                                  const std::string& profile);

} // namespace tandem::command
