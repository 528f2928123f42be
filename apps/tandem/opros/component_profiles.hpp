// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

#include <filesystem>
#include <string>

namespace tandem::command {

/// Returns the name of the first part in which two profiles differ, for messages; "" if they are copies.
std::string find_difference(const engine::ComponentProfile& one, const engine::ComponentProfile& other);

/// Returns the component profile in a component's folder or where OPRoS's tools put it. `profile` selects one of
/// several, relative to the current folder or to the component's. Otherwise several must have one library; a note says
/// how they differ. Throws std::runtime_error if there is none or the library is ambiguous.
engine::ComponentProfile select_component_profile(const std::filesystem::path& folder,
                                                  const std::string& profile);

} // namespace tandem::command
