// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

#include <filesystem>
#include <string>

namespace tandem::command {

/// The component profile in a component's folder, or where OPRoS's tools put it; of several the one that `profile`
/// names, relative to the current folder or to the component's. Throws std::runtime_error if there is none or several.
engine::ComponentProfile select_component_profile(const std::filesystem::path& folder,
                                                  const std::string& profile);

} // namespace tandem::command
