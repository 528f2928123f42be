// SPDX-License-Identifier: Apache-2.0
// Finds two components to join in their folders.
#pragma once

#include "apps/tandem/link/commands.hpp"
#include "host/opros/engine/profile/component_profile.hpp"

#include <filesystem>
#include <string>

namespace tandem::command {

struct ComponentPair {
    engine::ComponentProfile opros; ///< location.file is absolute
    std::filesystem::path library;  ///< of the OPRoS component
    std::filesystem::path module;   ///< of the RTC, absolute
    std::string type, category;     ///< of the RTC
};

/// Determines which folder contains which model. Throws std::runtime_error if a folder has no built component, if both
/// components are of the same model, or if a choice is ambiguous.
ComponentPair find_component_pair(const LinkProfileOptions& options);

} // namespace tandem::command
